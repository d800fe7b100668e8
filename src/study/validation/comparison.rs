//! What a check comes to.

use crate::mechanics::StaticsError;
use crate::robot::Faults;
use crate::stability::NotConverged;

/// What a check has come to, all in the check's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Comparison {
    /// From the check's source.
    pub expected: f64,
    /// Computed here.
    pub got: f64,
    /// By how much the two may differ: what the mesh or the digits of the source leave.
    pub tolerance: f64,
}

impl Comparison {
    /// |got − expected|.
    pub fn error(&self) -> f64 {
        (self.got - self.expected).abs()
    }

    /// Whether the error is within the tolerance; NaN and infinity anywhere fail.
    pub fn passes(&self) -> bool {
        self.tolerance.is_finite() && self.error() <= self.tolerance
    }
}

/// A check had nothing to compare with.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoComparison {
    /// The robot is not physical.
    #[error("the robot of the check is refused: {0}")]
    Refused(#[from] Faults),
    /// There is no static shape.
    #[error("no static shape: {0}")]
    Statics(#[from] StaticsError),
    /// Eigenvalues could not be computed.
    #[error(transparent)]
    Eigenvalues(#[from] NotConverged),
    /// Something that must be there is not.
    #[error("there is no {0}")]
    Nothing(&'static str),
}

/// The limit of values at n and 2n elements whose error is a/n² + b/n⁴ + … (Richardson).
pub(super) fn limit(coarse: f64, fine: f64) -> f64 {
    fine + (fine - coarse) / 3.0
}
