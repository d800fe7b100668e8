//! Critical speed of cable-driven parallel robots, while you drag the platform.
//!
//! The model is that of M. Aminpur and S. Farhadi (2019): variable-length cable elements, static
//! equilibrium with sag, quasi-static motion, linearisation, eigenvalues. `docs/theory.md` has the
//! equations; the code keeps its letters.
//!
//! The layers, each using only those before it: [`robot`], [`mechanics`], [`stability`], [`flight`], [`study`]
//! (plain numerics: no interface, clock, files or threads), then the scenario file, the
//! compute engine, and the interfaces on top.
//!
//! ```
//! use tautline::{LocalProblem, Motion, Robot, robot};
//!
//! let robot: Robot = robot::paper()?;
//! let motion = Motion::new([0.0, 0.0], [1.0, 0.0], 5.0)?;
//! let local = LocalProblem::new(&robot, &motion).map_err(|failure| failure.reason)?;
//! assert!((local.statics.cables[0].length - 10.908_221_684_3).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod flight;
pub mod mechanics;
pub mod robot;
pub mod stability;
pub mod steps;
pub mod study;

#[cfg(feature = "app")]
pub mod app;
#[cfg(all(feature = "cli", not(target_arch = "wasm32")))]
pub mod cli;
#[cfg(feature = "compute")]
pub mod compute;
#[cfg(all(feature = "js", target_arch = "wasm32"))]
pub mod js;
#[cfg(feature = "scenario")]
pub mod scenario;

pub use robot::{Motion, Robot};
pub use study::LocalProblem;
