//! Start-up of the web worker: the engine without an interface.

#[cfg(target_arch = "wasm32")]
fn main() -> Result<(), wasm_bindgen::JsValue> {
    console_error_panic_hook::set_once();
    tautline::compute::run_worker()
}

/// On the desktop a thread does the worker's work.
#[cfg(not(target_arch = "wasm32"))]
fn main() {}
