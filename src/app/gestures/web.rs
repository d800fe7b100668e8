//! Whether a finger is on the screen, as browsers tell it first: before the touch there is the press of a pointer, which
//! eframe handles at once and like a mouse's.

use std::cell::Cell;

use js_sys::Reflect;
use wasm_bindgen::prelude::*;

thread_local! {
    static FINGER: Cell<bool> = const { Cell::new(false) };
}

/// Listens from now on.
pub(super) fn listen() {
    // Who has no window has no pointer either.
    let Some(window) = web_sys::window() else { return };
    let pressed = Closure::<dyn Fn(JsValue)>::new(|event: JsValue| {
        let kind = Reflect::get(&event, &"pointerType".into()).ok().and_then(|kind| kind.as_string());
        FINGER.set(kind.as_deref() == Some("touch"));
    });
    // On the way down, so ahead of eframe, which listens on the canvas.
    let listener = pressed.into_js_value();
    let _ = window.add_event_listener_with_callback_and_bool("pointerdown", listener.unchecked_ref(), true);
}

/// Whether the last press was a finger's.
pub(super) fn is_finger() -> bool {
    FINGER.get()
}
