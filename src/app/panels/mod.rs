//! The panels beside the canvas: the answer, the controls, the plots. One file each.

pub mod answer;
pub mod controls;
pub mod eigenvalues;
pub mod growth;
pub mod modes;
pub mod plots;

use crate::compute::protocol::{ModeChoice, Which};

/// Said over what belongs to an earlier state.
const STALE: &str = "Being recomputed: this belongs to an earlier state.";

/// The mode choice that selects `eigenvalue`, keeping what else was chosen.
fn near(choice: ModeChoice, eigenvalue: [f64; 2]) -> ModeChoice {
    ModeChoice { which: Which::Near(eigenvalue), ..choice }
}
