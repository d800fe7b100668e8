//! Analysis off the interface's thread, behind one interface: submit a request, poll for replies.
//!
//! In the browser a web worker (the second binary of this crate) does the work, on the desktop a thread. Both run the
//! same [`Engine`], in slices, and take the newest request as soon as a slice ends.

mod engine;
#[cfg(not(target_arch = "wasm32"))]
mod native;
pub mod protocol;
#[cfg(target_arch = "wasm32")]
mod web;

pub use engine::Engine;
#[cfg(not(target_arch = "wasm32"))]
pub use native::Compute;
#[cfg(target_arch = "wasm32")]
pub use web::{Compute, run_worker};
