//! The panels beside the canvas: the answer, the controls, the plots.

pub mod answer;
mod cables;
pub mod controls;
mod moving;
mod path;
mod plausible;
pub mod plots;
mod ropes;
mod rows;
mod segments;
