//! The browser's file dialog and its downloads.

use std::sync::Arc;

use eframe::egui::DroppedFile;
use js_sys::{Array, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::Hand;

fn element<T: JsCast>(name: &str) -> Option<T> {
    web_sys::window()?.document()?.create_element(name).ok()?.dyn_into().ok()
}

pub(super) fn open(hand: Hand) {
    let Some(input) = element::<web_sys::HtmlInputElement>("input") else { return };
    input.set_type("file");
    input.set_accept(".json,application/json");
    let chosen = input.clone();
    let take = Closure::once_into_js(move || {
        let Some(file) = chosen.files().and_then(|files| files.get(0)) else { return };
        spawn_local(async move {
            let bytes = JsFuture::from(file.array_buffer()).await;
            let bytes = bytes.map(|buffer| Uint8Array::new(&buffer).to_vec());
            hand.over(&file.name(), bytes.map_err(|error| format!("{error:?}")));
        });
    });
    input.set_onchange(Some(take.unchecked_ref()));
    input.click();
}

pub(super) fn read(hand: Hand, file: Arc<dyn DroppedFile>) {
    spawn_local(async move {
        let bytes = file.bytes_async().await;
        hand.over(&file.path().to_string_lossy(), bytes);
    });
}

#[expect(clippy::needless_pass_by_value)] // As on the desktop, where writing goes on after the call.
pub(super) fn save(hand: Hand, file: &str, bytes: Vec<u8>) {
    // The browser says itself where a download has gone.
    hand.saved(file, download(file, &bytes).map(|()| None).map_err(|error| format!("{error:?}")));
}

fn download(file: &str, bytes: &[u8]) -> Result<(), JsValue> {
    let link = element::<web_sys::HtmlAnchorElement>("a").ok_or("the page has no document")?;
    let blob = web_sys::Blob::new_with_u8_array_sequence(&Array::of1(&Uint8Array::from(bytes)))?;
    let address = web_sys::Url::create_object_url_with_blob(&blob)?;
    link.set_href(&address);
    link.set_download(file);
    link.click();
    web_sys::Url::revoke_object_url(&address)
}
