//! Analysis off the interface's thread, behind one interface: submit a request, poll for replies.
//!
//! In the browser a web worker (the second binary of this crate) does the work, on the desktop a thread. Both run the
//! same [`Engine`], in slices, and take the newest request as soon as a slice ends. Studies are shared out among more
//! of them by the [`Pool`].

mod engine;
#[cfg(target_arch = "wasm32")]
mod link;
#[cfg(not(target_arch = "wasm32"))]
mod native;
mod pool;
pub mod protocol;
mod robot_study;
mod variants;
#[cfg(any(target_arch = "wasm32", test))]
mod watch;
#[cfg(target_arch = "wasm32")]
mod web;
#[cfg(target_arch = "wasm32")]
mod worker;

pub use engine::Engine;
#[cfg(not(target_arch = "wasm32"))]
pub use native::Compute;
pub use pool::{Pool, PoolWorker};
pub use robot_study::RobotStudy;
#[cfg(target_arch = "wasm32")]
pub use web::Compute;
#[cfg(target_arch = "wasm32")]
pub use worker::run_worker;
