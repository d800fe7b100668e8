//! What is asked of a flight, and what it gives.

use crate::mechanics::StaticsError;
use crate::robot::Vec2;

/// What is asked of a flight besides robot and trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct FlightOptions {
    /// An impulse on the platform at the beginning, in N s.
    pub kick: Vec2,
    /// How long the flight goes on after the end of a move from rest to rest, in s.
    pub hold: f64,
    /// The platform's error that the steps are chosen for, in m.
    pub accuracy: f64,
    /// How many samples there are, equally spaced from the beginning to the end: at least 2.
    pub samples: usize,
    /// Whether each sample has its nodes, for a picture.
    pub nodes: bool,
}

impl Default for FlightOptions {
    /// No kick, no hold, 1e-6 m, 21 samples without nodes.
    fn default() -> Self {
        Self { kick: Vec2::zeros(), hold: 0.0, accuracy: 1e-6, samples: 21, nodes: false }
    }
}

/// A flight from the quasi-static state at the beginning of a trajectory.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Flight {
    /// How long the move takes, in s.
    pub duration: f64,
    /// Until when the flight goes, in s: move and hold.
    pub end: f64,
    /// The largest distance of the platform from its path over everything that was computed, in m.
    pub max_deviation: f64,
    /// The same after the end of the move, on a grid of 1 ms or finer; `None` without a hold.
    pub residual: Option<f64>,
    /// Where an element had to push; from there on nothing is reliable.
    pub slack: Option<Slack>,
    /// When the flight could not go on, in s, because Newton's method failed or the steps became too many; all before is as it
    /// should be.
    pub lost: Option<f64>,
    /// How many steps were taken.
    pub steps: usize,
    /// Equally spaced, up to the end or to where the flight was lost.
    pub samples: Vec<Sample>,
}

/// An element that has to push.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Slack {
    /// The first moment at which an element's force is below 0, in s.
    pub time: f64,
    /// Its cable, 0-based.
    pub cable: usize,
    /// The least force of an element over the whole flight, in N.
    pub force: f64,
}

/// The flight at one time. At a break of the acceleration it is as it is after the break.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Sample {
    /// t in s.
    pub time: f64,
    /// Arc length on the path in m.
    pub s: f64,
    /// ṡ in m/s.
    pub v: f64,
    /// s̈ in m/s².
    pub a: f64,
    /// Where the path is, in m.
    pub position: Vec2,
    /// The platform less its place on the path, in m.
    pub deviation: Vec2,
    /// Its rate in m/s.
    pub deviation_velocity: Vec2,
    /// The least force of all elements, in N.
    pub smallest_element_force: f64,
    /// One per cable.
    pub cables: Vec<CableSample>,
}

/// A cable at one time of a flight.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct CableSample {
    /// L in m.
    pub length: f64,
    /// L̇ in m/s.
    pub rate: f64,
    /// L̈ in m/s².
    pub acceleration: f64,
    /// The tension at the platform, |N₀ e₀ − (0, μ g l/2)|, in N.
    pub tension: f64,
    /// The tension at the winch, |N e + (0, μ g l/2)| of the last element, in N.
    pub winch_tension: f64,
    /// The force of the last element, in N; below 0 where it pushes.
    pub winch_element_force: f64,
    /// The n + 1 nodes from the platform to the winch, in m; none unless they are asked for.
    pub nodes: Vec<[f32; 2]>,
}

/// How many times larger any vibration can be after a move, as amplitude ratios: the largest singular values of W₁ Φ W₀⁻¹.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Gain {
    /// By the root of the action, E/ω.
    pub action: f64,
    /// By the root of the energy.
    pub energy: f64,
    /// By the mass-weighted displacement.
    pub displacement: f64,
}

/// Why there is no flight.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FlightError {
    /// Somewhere on the path there is no taut equilibrium, or none that could be computed.
    #[error("at {s:.3} m of the path, ({:.3}, {:.3}) m, {reason}", position.x, position.y)]
    Statics {
        /// Arc length in m.
        s: f64,
        /// Where that is, in m.
        position: Vec2,
        /// Why.
        reason: StaticsError,
    },
    /// The numbers leave the range of floating point.
    #[error("the flight leaves the range of floating point at {time:.3} s")]
    OutOfRange {
        /// In s.
        time: f64,
    },
}
