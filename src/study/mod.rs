//! Whole analyses, put together from mechanics and stability.

mod local;

pub use local::Local;
