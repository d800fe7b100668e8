//! The engine on a thread of its own.

use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;

use super::Engine;
use super::protocol::{Reply, Request, Update};

/// The engine at work, seen from the interface.
pub struct Compute {
    requests: Sender<Request>,
    replies: Receiver<Reply>,
}

impl Compute {
    /// Starts the engine; it calls `wake` whenever there are replies to poll for.
    ///
    /// # Errors
    /// Where no thread can be started.
    pub fn start(wake: impl Fn() + Send + 'static) -> Result<Self, String> {
        let (requests, inbox) = channel();
        let (outbox, replies) = channel();
        let run = move || serve(&inbox, &outbox, wake);
        thread::Builder::new().name("tautline-engine".into()).spawn(run).map_err(|error| error.to_string())?;
        Ok(Self { requests, replies })
    }

    /// One that has said `replies` and hears nothing.
    #[cfg(test)]
    pub fn of_replies(replies: Receiver<Reply>) -> Self {
        Self { requests: channel().0, replies }
    }

    /// Sends a request; a newer one takes the place of an older one that has not begun.
    ///
    /// # Errors
    /// None here: an engine that has stopped is told by [`Self::poll`].
    pub fn submit(&mut self, request: &Request) -> Result<(), String> {
        let _ = self.requests.send(request.clone());
        Ok(())
    }

    /// The replies since the last call.
    pub fn poll(&mut self) -> Vec<Reply> {
        let mut replies = Vec::new();
        loop {
            match self.replies.try_recv() {
                Ok(reply) => replies.push(reply),
                Err(TryRecvError::Empty) => return replies,
                Err(TryRecvError::Disconnected) => {
                    replies.push(Reply { revision: 0, update: Update::Broken("its thread has stopped".into()) });
                    return replies;
                }
            }
        }
    }
}

/// Runs until the other side is dropped.
fn serve(inbox: &Receiver<Request>, outbox: &Sender<Reply>, wake: impl Fn()) {
    let mut engine = Engine::default();
    while let Ok(request) = inbox.recv() {
        engine.submit(request);
        loop {
            match inbox.try_recv() {
                Ok(newer) => {
                    engine.submit(newer);
                    continue;
                }
                Err(TryRecvError::Empty) => {}
                Err(TryRecvError::Disconnected) => return,
            }
            let Some(replies) = engine.work() else { break };
            if !replies.is_empty() {
                for reply in replies {
                    if outbox.send(reply).is_err() {
                        return;
                    }
                }
                wake();
            }
        }
    }
}
