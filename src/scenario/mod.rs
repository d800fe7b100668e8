//! Everything that is JSON: the scenario file, the presets, the analysis report.

pub mod report;
pub mod v1;

pub use report::Report;
pub use v1::Scenario;
