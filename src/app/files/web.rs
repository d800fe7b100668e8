//! The browser's file dialog, its downloads and its clipboard.

use std::sync::mpsc::Sender;

use eframe::egui::{Context, DroppedFileHandle, FullOutput, Key, KeyboardShortcut, Modifiers, OutputCommand, Plugin};
use js_sys::{Array, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::outbox::{Clip, Outbox};
use crate::app::command::Command;
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

pub(super) fn open(outbox: Outbox) {
    let Some(input) = element::<web_sys::HtmlInputElement>("input") else { return };
    input.set_type("file");
    input.set_accept(".json,application/json");
    let chosen = input.clone();
    let take = Closure::once_into_js(move || {
        let Some(file) = chosen.files().and_then(|files| files.get(0)) else { return };
        spawn_local(async move { outbox.read(&file.name(), text(&file).await) });
    });
    input.set_onchange(Some(take.unchecked_ref()));
    input.click();
}

pub(super) fn read(outbox: Outbox, files: Vec<DroppedFileHandle>) {
    spawn_local(async move {
        // One after the other, so that the last of them is the one on show.
        for file in files.iter().filter_map(|dropped| dropped.web_file()) {
            outbox.read(&file.name(), text(file).await);
        }
    });
}

#[expect(clippy::needless_pass_by_value)] // As on the desktop, where writing goes on after the call.
pub(super) fn save(outbox: Outbox, file: &str, bytes: Vec<u8>) {
    // The browser alone knows where a download goes.
    outbox.saved(file, download(file, &bytes).map(|()| None).map_err(|error| reason(&error)));
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

/// Has the texts that are copied out of labels and fields go the same way as the others. The drawing library's own way
/// drops them without a word where the browser refuses.
pub(super) fn prepare(outbox: &Outbox) {
    outbox.context.add_plugin(Copies(outbox.sender.clone()));
}

/// Takes the texts for the clipboard out of the drawing library's output.
struct Copies(Sender<Command>);

impl Plugin for Copies {
    fn debug_name(&self) -> &'static str {
        "clipboard"
    }

    fn output_hook(&mut self, context: &Context, output: &mut FullOutput) {
        output.platform_output.commands.retain(|command| {
            let OutputCommand::CopyText(text) = command else { return true };
            let outbox = Outbox { sender: self.0.clone(), context: context.clone() };
            put(outbox, "The text", text.clone(), None);
            false
        });
    }
}

pub(super) fn copy(outbox: Outbox, clip: Clip) {
    let done = clip.done();
    put(outbox, clip.what, clip.text, Some(done));
}

/// Puts a text on the clipboard, and tells that it is `done` once the browser says so.
fn put(outbox: Outbox, what: &'static str, text: String, done: Option<String>) {
    let Some(clipboard) = clipboard() else {
        return by_hand(&outbox, what, &text, "the browser has no clipboard for a page that did not come over https");
    };
    // Begun at once: browsers allow it only while they handle a click.
    let written = clipboard.write_text(&text);
    spawn_local(async move {
        match JsFuture::from(written).await {
            Ok(_) => done.into_iter().for_each(|done| outbox.command(Command::Done(Some(done)))),
            Err(error) => {
                let reason = reason(&error);
                // Chromium begins with the names of functions.
                let reason = reason.rsplit("': ").next().unwrap_or(&reason).trim_end_matches('.');
                by_hand(&outbox, what, &text, &format!("the browser does not allow it here ({reason})"));
            }
        }
    });
}

pub(super) fn paste(outbox: &Outbox) {
    let keys = outbox.context.format_shortcut(&KeyboardShortcut::new(Modifiers::COMMAND, Key::V));
    let refused = format!("The browser does not let the page read the clipboard. Press {keys} in its place.");
    let outbox = outbox.clone();
    // Some browsers have a clipboard that can only be written to.
    let can_read = |clipboard: &web_sys::Clipboard| {
        Reflect::get(clipboard, &"readText".into()).is_ok_and(|function| function.is_function())
    };
    let Some(clipboard) = clipboard().filter(can_read) else { return outbox.command(Command::Complain(refused)) };
    // Begun at once: browsers allow it only while they handle a click.
    let text = clipboard.read_text();
    spawn_local(async move {
        let text = JsFuture::from(text).await.ok().and_then(|text| text.as_string());
        outbox.command(text.map_or(Command::Complain(refused), Command::Read));
    });
}

/// Browsers have none for pages that came over plain http; the bindings take it for granted.
fn clipboard() -> Option<web_sys::Clipboard> {
    let navigator = web_sys::window()?.navigator();
    let clipboard = Reflect::get(&navigator, &"clipboard".into()).ok()?;
    (!clipboard.is_undefined()).then(|| clipboard.unchecked_into())
}

/// Shows a text to be copied by hand, and why. Its field is the browser's own, for what is selected there can be copied
/// everywhere.
fn by_hand(outbox: &Outbox, what: &str, text: &str, why: &str) {
    let why = format!("{what} could not be put on the clipboard: {why}.");
    let keys = outbox.context.format_shortcut(&KeyboardShortcut::new(Modifiers::COMMAND, Key::C));
    if show(&format!("{why} It is selected here, to be copied by hand ({keys})."), text).is_none() {
        outbox.command(Command::Complain(format!("{why} To be copied by hand: {text}")));
    }
}

fn show(why: &str, text: &str) -> Option<()> {
    let document = web_sys::window()?.document()?;
    document.get_element_by_id("tautline-copy-why")?.set_text_content(Some(why));
    let field: web_sys::HtmlTextAreaElement = document.get_element_by_id("tautline-copy-text")?.dyn_into().ok()?;
    field.set_value(text);
    let dialog: web_sys::HtmlDialogElement = document.get_element_by_id("tautline-copy")?.dyn_into().ok()?;
    if !dialog.open() {
        dialog.show_modal().ok()?;
    }
    field.focus().ok()?;
    field.select();
    Some(())
}
