//! The web worker's side: the engine for a drag, or places for the page's pool. Every worker can do both; the page
//! gives each one kind of work. The text version's worker answers its messages, which are text and not bytes.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use js_sys::Uint8Array;
use wasm_bindgen::prelude::*;
use web_sys::{DedicatedWorkerGlobalScope, MessageChannel, MessageEvent};

use super::Engine;
use super::link::READY;
use super::pool::PoolWorker;
use super::protocol::{Incoming, Outgoing};
use crate::scenario::messages;

/// Serves messages for as long as the page wants.
///
/// # Errors
/// Where this is no worker, or the browser has no message channels.
pub fn run_worker() -> Result<(), JsValue> {
    let scope: DedicatedWorkerGlobalScope = js_sys::global().dyn_into()?;
    let engine = Rc::new(RefCell::new(Engine::default()));
    // A message to itself lets the worker take in newer requests between two slices.
    let again = MessageChannel::new()?;
    let at_work = Rc::new(Cell::new(false));
    let pool_worker = Rc::new(RefCell::new(PoolWorker::default()));
    let on_slice = {
        let (engine, pool_worker, scope) = (engine.clone(), pool_worker.clone(), scope.clone());
        let (again, at_work) = (again.clone(), at_work.clone());
        Closure::<dyn FnMut()>::new(move || {
            let replies = engine.borrow_mut().work();
            let answered = if replies.is_none() { pool_worker.borrow_mut().work() } else { None };
            if replies.is_none() && answered.is_none() {
                at_work.set(false);
                return;
            }
            for reply in replies.into_iter().flatten() {
                send(&scope, &Outgoing::Reply(reply));
            }
            if let Some(batch) = answered.flatten() {
                send(&scope, &Outgoing::Batch(batch));
            }
            if let Some(part) = pool_worker.borrow_mut().part() {
                send(&scope, &Outgoing::Part(part));
            }
            let _ = again.port2().post_message(&JsValue::NULL);
        })
    };
    again.port1().set_onmessage(Some(on_slice.as_ref().unchecked_ref()));
    on_slice.forget();
    let outbox = scope.clone();
    let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
        let data = event.data();
        if let Some(request) = data.as_string() {
            // Posting fails only for what cannot be cloned; text can.
            let _ = outbox.post_message(&messages::answer(&request).into());
            return;
        }
        let bytes = data.dyn_into::<Uint8Array>().map(|array| array.to_vec()).unwrap_or_default();
        match postcard::from_bytes(&bytes) {
            Ok(Incoming::Request(request)) => engine.borrow_mut().submit(request),
            Ok(Incoming::Task(task)) => pool_worker.borrow_mut().submit(task),
            Ok(Incoming::AreYouThere) => return send(&outbox, &Outgoing::Alive),
            Err(_) => return,
        }
        if !at_work.replace(true) {
            let _ = again.port2().post_message(&JsValue::NULL);
        }
    });
    scope.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
    on_message.forget();
    scope.post_message(&READY.into())
}

fn send(scope: &DedicatedWorkerGlobalScope, message: &Outgoing) {
    if let Ok(bytes) = postcard::to_stdvec(message) {
        // Posting fails only for what cannot be cloned; bytes can.
        let _ = scope.post_message(&Uint8Array::from(bytes.as_slice()));
    }
}
