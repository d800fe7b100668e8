//! Flights: the non-linear motion of platform and cables along a trajectory, what it does to vibrations, and how fast a path
//! may be passed.
//!
//! All lengths are prescribed by the quasi-static motion. Every type here is for a point in the plane.

mod equations;
mod fly;
mod growth;
mod limits;
mod quasi_static;
mod record;
mod sdirk;
#[cfg(test)]
mod tests;
mod watch;

pub use fly::{fly, fly_in_steps, fly_watched_in_steps};
pub use growth::{gain, gain_in_steps, gain_of_few_modes_in_steps};
pub use limits::{CableRow, FastestMove, INTERVALS, LimitOptions, LimitsError, MoveRow, Place, legs, limits};
pub use record::{CableSample, Flight, FlightError, FlightOptions, Gain, Sample, Slack};
