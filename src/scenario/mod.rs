//! Everything that is JSON: the scenario file, the presets, the analysis report.

mod layout;
pub mod presets;
mod reader;
pub mod report;
pub mod v1;

pub use presets::Preset;
pub use report::Report;
pub use v1::Scenario;
