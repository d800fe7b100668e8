//! The page's side of one web worker: bytes to it, and what is heard of it.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::Uint8Array;
use wasm_bindgen::prelude::*;
use web_sys::{ErrorEvent, MessageEvent, Worker};

use super::protocol::{Incoming, Outgoing};

/// The element whose attribute `data-worker` tells where the workers' loader of the page's build is.
const APP: &str = "tautline-app";
/// What a worker says when it can take messages.
pub const READY: &str = "ready";

/// What is heard of a worker.
pub enum Heard {
    /// It can take messages.
    Ready,
    /// It sent something.
    Message(Outgoing),
    /// It does not work, with the reason.
    Broken(String),
}

/// A web worker, which ends when this is dropped.
pub struct Link {
    worker: Worker,
    /// Messages from before the worker was ready, when they would be lost; `None` from then on.
    early: Rc<RefCell<Option<Vec<Vec<u8>>>>>,
    /// Kept alive for as long as the worker may call them.
    _listeners: Listeners,
}

type Listeners = (Closure<dyn FnMut(MessageEvent)>, Closure<dyn FnMut(ErrorEvent)>);

impl Link {
    /// Starts a worker; `hear` is called with whatever is heard of it.
    ///
    /// # Errors
    /// Where the browser refuses a worker.
    pub fn start(hear: impl Fn(Heard) + 'static) -> Result<Self, String> {
        let address = worker_address().ok_or("the page does not say where its workers are")?;
        let worker = Worker::new(&address).map_err(|error| format!("the browser refuses a worker: {error:?}"))?;
        let early = Rc::new(RefCell::new(Some(Vec::new())));
        let hear = Rc::new(hear);
        let on_message = {
            let (early, worker, hear) = (early.clone(), worker.clone(), hear.clone());
            Closure::new(move |event: MessageEvent| {
                let data = event.data();
                if data.as_string().as_deref() == Some(READY) {
                    let waiting: Option<Vec<Vec<u8>>> = early.borrow_mut().take();
                    for bytes in waiting.into_iter().flatten() {
                        post(&worker, &bytes);
                    }
                    hear(Heard::Ready);
                } else {
                    hear(decode(&data).map_or_else(Heard::Broken, Heard::Message));
                }
            })
        };
        let on_error = Closure::new(move |event: ErrorEvent| {
            // A script that could not be loaded gives a plain event, without a message.
            let message = js_sys::Reflect::get(&event, &"message".into()).ok().and_then(|text| text.as_string());
            hear(Heard::Broken(message.unwrap_or_else(|| "the worker could not be loaded".into())));
        });
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        Ok(Self { worker, early, _listeners: (on_message, on_error) })
    }

    /// Sends a message; it waits until the worker is ready.
    ///
    /// # Errors
    /// Where the message cannot be written as bytes.
    pub fn send(&self, message: &Incoming) -> Result<(), String> {
        let bytes = postcard::to_stdvec(message).map_err(|error| error.to_string())?;
        match &mut *self.early.borrow_mut() {
            Some(early) => early.push(bytes),
            None => post(&self.worker, &bytes),
        }
        Ok(())
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        self.worker.set_onmessage(None);
        self.worker.set_onerror(None);
        self.worker.terminate();
    }
}

fn worker_address() -> Option<String> {
    web_sys::window()?.document()?.get_element_by_id(APP)?.get_attribute("data-worker")
}

fn post(worker: &Worker, bytes: &[u8]) {
    // Posting fails only for what cannot be cloned; bytes can.
    let _ = worker.post_message(&Uint8Array::from(bytes));
}

fn decode(data: &JsValue) -> Result<Outgoing, String> {
    let bytes = data.dyn_ref::<Uint8Array>().ok_or("the worker sent something else than bytes")?.to_vec();
    postcard::from_bytes(&bytes).map_err(|error| error.to_string())
}
