//! The engine in a web worker: both sides of the conversation, in bytes.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::rc::Rc;

use js_sys::Uint8Array;
use wasm_bindgen::prelude::*;
use web_sys::{DedicatedWorkerGlobalScope, ErrorEvent, MessageChannel, MessageEvent, Worker};

use super::Engine;
use super::protocol::{Reply, Request, Update};

/// Where the page finds the worker's loader, beside itself.
const WORKER: &str = "./worker_loader.js";
/// The element whose attribute `data-wasm` names the page's build.
const APP: &str = "tautline-app";
/// What the worker says when it can take requests.
const READY: &str = "ready";

/// The engine at work, seen from the page.
pub struct Compute {
    worker: Worker,
    shared: Rc<RefCell<Shared>>,
    /// Kept alive for as long as the worker may call them.
    _listeners: Listeners,
}

type Listeners = (Closure<dyn FnMut(MessageEvent)>, Closure<dyn FnMut(ErrorEvent)>);

#[derive(Default)]
struct Shared {
    ready: bool,
    /// Requests made before the worker was ready; what is sent earlier is lost.
    early: Vec<Vec<u8>>,
    replies: VecDeque<Reply>,
}

impl Compute {
    /// Starts the worker; `wake` is called whenever there are replies to poll for.
    ///
    /// # Errors
    /// Where the browser refuses a worker.
    pub fn start(wake: impl Fn() + 'static) -> Result<Self, String> {
        let worker =
            Worker::new(&worker_address()).map_err(|error| format!("the browser refuses a worker: {error:?}"))?;
        let shared = Rc::new(RefCell::new(Shared::default()));
        let wake = Rc::new(wake);
        let on_message = {
            let (shared, worker, wake) = (shared.clone(), worker.clone(), wake.clone());
            Closure::new(move |event: MessageEvent| {
                let data = event.data();
                if data.as_string().as_deref() == Some(READY) {
                    let early = std::mem::take(&mut shared.borrow_mut().early);
                    shared.borrow_mut().ready = true;
                    for bytes in early {
                        post(&worker, &bytes);
                    }
                    return;
                }
                let reply = decode(&data).unwrap_or_else(|reason| broken(&reason));
                shared.borrow_mut().replies.push_back(reply);
                wake();
            })
        };
        let on_error = {
            let shared = shared.clone();
            Closure::new(move |event: ErrorEvent| {
                // A script that could not be loaded gives a plain event, without a message.
                let message = js_sys::Reflect::get(&event, &"message".into()).ok().and_then(|text| text.as_string());
                let reply = broken(message.as_deref().unwrap_or("the worker could not be loaded"));
                shared.borrow_mut().replies.push_back(reply);
                wake();
            })
        };
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        Ok(Self { worker, shared, _listeners: (on_message, on_error) })
    }

    /// Sends a request; a newer one takes the place of an older one that has not begun.
    ///
    /// # Errors
    /// Where the request cannot be written as bytes.
    pub fn submit(&mut self, request: &Request) -> Result<(), String> {
        let bytes = postcard::to_stdvec(request).map_err(|error| error.to_string())?;
        let mut shared = self.shared.borrow_mut();
        if shared.ready {
            post(&self.worker, &bytes);
        } else {
            shared.early.push(bytes);
        }
        Ok(())
    }

    /// The replies since the last call.
    pub fn poll(&mut self) -> Vec<Reply> {
        self.shared.borrow_mut().replies.drain(..).collect()
    }
}

impl Drop for Compute {
    fn drop(&mut self) {
        self.worker.terminate();
    }
}

/// The loader's address with the page's build in it: a cached worker of an older build must not meet a newer page.
fn worker_address() -> String {
    let document = web_sys::window().and_then(|window| window.document());
    let app = document.and_then(|document| document.get_element_by_id(APP));
    let build = app.and_then(|app| app.get_attribute("data-wasm"));
    build.map_or_else(|| WORKER.into(), |build| format!("{WORKER}?v={}", js_sys::encode_uri_component(&build)))
}

fn post(worker: &Worker, bytes: &[u8]) {
    // Posting fails only for what cannot be cloned; bytes can.
    let _ = worker.post_message(&Uint8Array::from(bytes));
}

fn broken(reason: &str) -> Reply {
    Reply { revision: 0, update: Update::Broken(reason.into()) }
}

fn decode(data: &JsValue) -> Result<Reply, String> {
    let bytes = data.dyn_ref::<Uint8Array>().ok_or("the worker sent something else than bytes")?.to_vec();
    postcard::from_bytes(&bytes).map_err(|error| error.to_string())
}

/// The worker's side: serves requests for as long as the page lives.
///
/// # Errors
/// Where this is no worker, or the browser has no message channels.
pub fn run_worker() -> Result<(), JsValue> {
    let scope: DedicatedWorkerGlobalScope = js_sys::global().dyn_into()?;
    let engine = Rc::new(RefCell::new(Engine::default()));
    // A message to itself lets the worker take in newer requests between two slices.
    let again = MessageChannel::new()?;
    let at_work = Rc::new(Cell::new(false));
    let on_slice = {
        let (engine, scope, again, at_work) = (engine.clone(), scope.clone(), again.clone(), at_work.clone());
        Closure::<dyn FnMut()>::new(move || {
            let Some(replies) = engine.borrow_mut().work() else {
                at_work.set(false);
                return;
            };
            for reply in replies {
                if let Ok(bytes) = postcard::to_stdvec(&reply) {
                    let _ = scope.post_message(&Uint8Array::from(bytes.as_slice()));
                }
            }
            let _ = again.port2().post_message(&JsValue::NULL);
        })
    };
    again.port1().set_onmessage(Some(on_slice.as_ref().unchecked_ref()));
    on_slice.forget();
    let on_request = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
        let bytes = event.data().dyn_into::<Uint8Array>().map(|array| array.to_vec()).unwrap_or_default();
        if let Ok(request) = postcard::from_bytes(&bytes) {
            engine.borrow_mut().submit(request);
            if !at_work.replace(true) {
                let _ = again.port2().post_message(&JsValue::NULL);
            }
        }
    });
    scope.set_onmessage(Some(on_request.as_ref().unchecked_ref()));
    on_request.forget();
    scope.post_message(&READY.into())
}
