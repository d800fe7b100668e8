//! Everything that is JSON: the scenario file, the presets, the analysis report, options; the text in a file, and the
//! scenario as a link; the messages of the text version.

pub mod file;
pub mod flight_report;
pub mod json;
mod layout;
pub mod limits_report;
pub mod link;
pub mod messages;
pub mod options;
mod parameter;
mod path;
pub mod plausible;
pub mod presets;
mod reader;
pub mod report;
pub mod ropes;
pub mod table;
pub mod trajectory;
mod winches;

pub use json::Scenario;
pub use parameter::Parameter;
pub use path::{Corners, MOST_POINTS as MOST_PATH_POINTS, Path, ProfileKind};
pub use presets::Preset;
pub use report::Report;
pub use winches::{NoRobot, from_winches};
