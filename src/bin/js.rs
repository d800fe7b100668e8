//! The module of the npm package: it does nothing by itself, JavaScript calls its functions.

// Without this the functions would not be linked.
#[cfg(target_arch = "wasm32")]
extern crate tautline as _;

fn main() {}
