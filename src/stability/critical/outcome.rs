//! What a search for the critical speed finds.

use std::f64::consts::TAU;

use nalgebra::Complex;

use crate::mechanics::Vibration;
use crate::stability::modes::{Polarisation, mode, responsible_cable};

/// How stability is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Instability {
    /// An oscillation grows.
    Flutter,
    /// A displacement grows without oscillating.
    Divergence,
}

/// The first crossing.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Critical {
    /// The critical speed in m/s.
    pub speed: f64,
    /// The eigenvalue that crosses, with Im λ ≥ 0, in 1/s.
    pub eigenvalue: Complex<f64>,
    /// Flutter, or divergence where Im λ = 0.
    pub kind: Instability,
    /// The cable with the largest share of the mode's kinetic energy, 0-based.
    pub cable: usize,
}

impl Critical {
    /// The crossing at `speed` (m/s) by an eigenvalue (1/s) whose mode is looked at where the speed is `seen_at` (m/s).
    pub(in crate::stability) fn at(
        vibration: &Vibration,
        speed: f64,
        seen_at: f64,
        eigenvalue: Complex<f64>,
        kind: Instability,
    ) -> Self {
        let mode = mode(vibration, seen_at, eigenvalue, Polarisation::default());
        Self { speed, eigenvalue, kind, cable: responsible_cable(vibration, &mode) }
    }

    /// |Im λ|/2π of the crossing eigenvalue in Hz; 0 for divergence.
    pub fn frequency_hz(&self) -> f64 {
        match self.kind {
            Instability::Flutter => self.eigenvalue.im.abs() / TAU,
            Instability::Divergence => 0.0,
        }
    }
}

/// How a search ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// A crossing was found.
    Found(Critical),
    /// Every speed up to the limit (m/s) is stable.
    NoneUpTo(f64),
}

impl Outcome {
    /// The first crossing, where one was found.
    pub fn critical(&self) -> Option<&Critical> {
        match self {
            Self::Found(critical) => Some(critical),
            Self::NoneUpTo(_) => None,
        }
    }
}
