//! The panels beside the canvas: the answer, the controls, the plots. One file each.

pub mod answer;
pub mod controls;
pub mod eigenvalues;
pub mod growth;
pub mod modes;
pub mod plots;

use crate::compute::protocol::{ModeChoice, Which};

/// The mode choice that selects `eigenvalue`, keeping what else was chosen.
fn near(choice: ModeChoice, eigenvalue: [f64; 2]) -> ModeChoice {
    ModeChoice { which: Which::Near(eigenvalue), ..choice }
}
