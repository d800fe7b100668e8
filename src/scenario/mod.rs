//! Everything that is JSON: the scenario file, the presets, the analysis report, options; and the scenario as a link.

mod layout;
pub mod link;
pub mod options;
pub mod presets;
mod reader;
pub mod report;
pub mod v1;

pub use presets::Preset;
pub use report::Report;
pub use v1::Scenario;
