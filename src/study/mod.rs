//! Whole analyses, put together from mechanics and stability: one pose, and studies over many of them.

pub mod campbell;
pub mod convergence;
mod grid;
mod local;
mod studies;
mod verdict;

pub use grid::{Grid, Line, evenly, workspace};
pub use local::Local;
pub use studies::{Answer, Asked, Study};
pub use verdict::{Directions, Verdict, compass, verdict};
