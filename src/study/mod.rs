//! Whole analyses, put together from mechanics and stability: one pose, and studies over many of them.
//!
//! A study is a list of tasks that do not depend on each other. Whoever has threads or workers shares them out in the
//! study's order, from coarse to fine:
//!
//! ```
//! use tautline::study::{Answer, Line, Study};
//! use tautline::{Motion, robot};
//!
//! let robot = robot::paper()?;
//! let motion = Motion::new([0.0, 0.0], [1.0, 0.0], 5.0)?;
//! let line = Line::through(&robot, &motion, 11);
//! let study = Study::Line { line, limit: 40.0 };
//! let mut speeds = vec![None; study.len()];
//! for index in study.order() {
//!     if let Answer::Critical { verdict, .. } = study.answer(&robot, index) {
//!         speeds[index] = verdict.critical().map(|critical| critical.speed);
//!     }
//! }
//! assert_eq!((line.position(5).x, speeds[0]), (0.0, None));
//! assert!(speeds[5].is_some_and(|speed| (speed - 11.299).abs() < 1e-3));
//! # Ok::<(), tautline::robot::Faults>(())
//! ```

mod allowed;
mod border;
pub mod campbell;
pub mod convergence;
mod flown;
mod grid;
mod local;
mod on_path;
mod path;
pub mod reach;
mod sensitivity;
mod studies;
pub mod validation;
mod verdict;
mod what_if;

pub use crate::mechanics::Knob;
pub use allowed::{Allowed, Fastest};
pub use border::Strip;
pub use flown::{Flown, PathShape, flown_in_steps};
pub use grid::{Grid, Line, evenly, workspace};
pub use local::LocalProblem;
pub use on_path::{MoveEffect, Moves, Station};
pub use path::{LeastSpeed, PathSummary, WaveRatio, frozen_growth_in_steps, wave_ratio_in_steps};
pub use reach::{Reach, Reached, Stretch};
pub use sensitivity::{Sensitivity, sensitivities, sensitivities_in_steps};
pub use studies::{Answer, Mapped, Study, Topic};
pub use verdict::{Directions, NoEigenvalues, Status, Verdict, compass, verdict};
pub use what_if::{Variant, Varied, WhatIf};
