//! The browser's file dialog and its downloads.

use eframe::egui::DroppedFileHandle;
use js_sys::{Array, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::Hand;
use crate::scenario::file::{self, FileError};

fn element<T: JsCast>(name: &str) -> Option<T> {
    web_sys::window()?.document()?.create_element(name).ok()?.dyn_into().ok()
}

/// What the browser says of a failure.
fn reason(error: &JsValue) -> String {
    match error.dyn_ref::<js_sys::Error>() {
        Some(error) => error.message().into(),
        None => format!("{error:?}"),
    }
}

/// The text in a file. Its size is asked before anything is read.
async fn text(file: &web_sys::File) -> Result<String, FileError> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // A count of bytes.
    file::check_size(file.size() as u64)?;
    let buffer = JsFuture::from(file.array_buffer()).await;
    let buffer = buffer.map_err(|error| FileError::NotRead(reason(&error)))?;
    file::decode(&Uint8Array::new(&buffer).to_vec())
}

pub(super) fn open(hand: Hand) {
    let Some(input) = element::<web_sys::HtmlInputElement>("input") else { return };
    input.set_type("file");
    input.set_accept(".json,application/json");
    let chosen = input.clone();
    let take = Closure::once_into_js(move || {
        let Some(file) = chosen.files().and_then(|files| files.get(0)) else { return };
        spawn_local(async move { hand.over(&file.name(), text(&file).await) });
    });
    input.set_onchange(Some(take.unchecked_ref()));
    input.click();
}

pub(super) fn read(hand: Hand, files: Vec<DroppedFileHandle>) {
    spawn_local(async move {
        // One after the other, so that the last of them is the one on show.
        for file in files.iter().filter_map(|dropped| dropped.web_file()) {
            hand.over(&file.name(), text(file).await);
        }
    });
}

#[expect(clippy::needless_pass_by_value)] // As on the desktop, where writing goes on after the call.
pub(super) fn save(hand: Hand, file: &str, bytes: Vec<u8>) {
    // The browser says itself where a download has gone.
    hand.saved(file, download(file, &bytes).map(|()| None).map_err(|error| reason(&error)));
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
