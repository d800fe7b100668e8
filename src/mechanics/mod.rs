//! The cable and the platform: material, element, statics, quasi-static motion, linearisation.

mod arrow;
mod cable;
mod element;
mod hub;
mod linearisation;
mod material;
mod motion;
mod parameters;
mod quasi_static;
mod slack;
mod statics;
mod waves;

pub use arrow::{Arrow, ArrowVector, Blocks};
pub use element::{Element, Matrices, Stiffness};
pub use hub::{Hub, Joint};
pub use linearisation::{Chain, Vibration};
pub use material::Material;
pub use motion::{LengthRates, length_rates, length_rates_on, node_rates};
pub use parameters::Knob;
pub use quasi_static::{CableMotion, Follower};
pub use slack::{SlackAcceleration, SlackLimit, slack_acceleration};
pub use statics::{CableShape, Failure, Infeasible, Statics, StaticsError, solve};
pub use waves::{WaveLimit, wave_limit, wave_limit_shift};
