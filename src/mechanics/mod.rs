//! The cable and the platform: material, element, statics, quasi-static motion, linearisation.

mod cable;
mod element;
mod linearisation;
mod material;
mod motion;
mod parameters;
mod statics;
mod waves;

pub use element::{Block, elastic, flow_stiffness, mass, transfer};
pub use linearisation::{Chain, Element, Hub, Vibration};
pub use material::Material;
pub use motion::{LengthRates, length_rates};
pub use parameters::Knob;
pub use statics::{CableShape, Failure, Infeasible, Statics, StaticsError, solve};
pub use waves::{WaveLimit, wave_limit};
