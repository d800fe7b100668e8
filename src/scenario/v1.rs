//! placeholder
/// placeholder
pub struct Scenario;
