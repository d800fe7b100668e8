//! The panels beside the canvas: the answer, the controls, the plots.

pub mod answer;
mod cables;
pub mod controls;
pub mod plots;
mod rows;
