//! Eigenvalues, mode shapes and the critical speed of a [`crate::mechanics::Vibration`].

mod aberth;
mod axis;
mod bisection;
mod bounds;
mod characteristic;
mod count;
mod critical;
mod crossing;
mod dense;
mod jet;
mod modes;
mod polynomial;
#[cfg(test)]
mod problems;
mod rest;
mod sensitivity;
mod spectrum;
pub use crate::steps;
mod ties;
mod undamped;

pub use aberth::Spectra;
pub use bisection::bisect;
pub use characteristic::{Characteristic, LogDeterminant};
pub use count::unstable_eigenvalues;
pub use critical::{
    ALLOWED_LIMIT, Critical, CriticalSearch, Instability, LARGEST_LIMIT, Method, Outcome, SCAN_STEP, Sample, is_limit,
    structured,
};
pub use crossing::Doubt;
pub use dense::Eigenproblem;
pub use modes::{Mode, Polarisation, mode};
pub use sensitivity::{Crossing, NoSensitivity, Shift};
pub use spectrum::{ModeValue, Solver, Spectrum};
pub use steps::Steps;
pub use ties::{TIE_OF_SHARES, TIE_OF_SPEEDS, first_largest, first_lowest, is_lower};

/// An eigenvalue iteration did not converge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the eigenvalues could not be computed")]
pub struct NotConverged;
