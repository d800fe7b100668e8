//! What only a browser knows or does. Whether a finger is on the screen, as browsers tell it first: before the touch there
//! is the press of a pointer, which eframe handles at once and like a mouse's. And where the focus goes that leaves the app.

use std::cell::Cell;

use js_sys::Reflect;
use wasm_bindgen::prelude::*;

use super::focus::End;

thread_local! {
    static FINGER: Cell<bool> = const { Cell::new(false) };
    static NUMBER: Cell<bool> = const { Cell::new(false) };
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

/// Has a phone show its keyboard for numbers, or the one for texts. It is the one of eframe's own field for what is
/// typed, which comes right behind the canvas.
pub(super) fn keyboard_for(number: bool) {
    if NUMBER.replace(number) == number {
        return;
    }
    let canvas = web_sys::window().and_then(|window| window.document()?.get_element_by_id("tautline-canvas"));
    if let Some(field) = canvas.and_then(|canvas| canvas.next_element_sibling()) {
        // A browser that knows no such keyboard shows its usual one.
        let _ = field.set_attribute("inputmode", if number { "decimal" } else { "text" });
    }
}

/// Gives the focus to the element at this end of the app. The next Tab goes on from there: through the page, or out of the
/// frame that the page is in.
pub(super) fn leave(end: End) {
    let name = match end {
        End::First => "tautline-start",
        End::Last => "tautline-end",
    };
    let element = web_sys::window().and_then(|window| window.document()?.get_element_by_id(name));
    if let Some(element) = element.and_then(|element| element.dyn_into::<web_sys::HtmlElement>().ok()) {
        // Where there is no such element the focus stays.
        let _ = element.focus();
    }
}
