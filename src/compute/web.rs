//! The engine in a web worker.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use super::link::{Heard, Link};
use super::protocol::{Incoming, Outgoing, Reply, Request, Update};

/// The engine at work, seen from the page.
pub struct Compute {
    link: Link,
    replies: Rc<RefCell<VecDeque<Reply>>>,
}

impl Compute {
    /// Starts the worker; `wake` is called whenever there are replies to poll for.
    ///
    /// # Errors
    /// Where the browser refuses a worker.
    pub fn start(wake: impl Fn() + 'static) -> Result<Self, String> {
        let replies = Rc::new(RefCell::new(VecDeque::new()));
        let inbox = replies.clone();
        let link = Link::start(move |heard| {
            let reply = match heard {
                Heard::Message(Outgoing::Reply(reply)) => reply,
                Heard::Broken(reason) => Reply { revision: 0, update: Update::Broken(reason) },
                Heard::Ready | Heard::Message(Outgoing::Batch(_)) => return,
            };
            inbox.borrow_mut().push_back(reply);
            wake();
        })?;
        Ok(Self { link, replies })
    }

    /// Sends a request; a newer one takes the place of an older one that has not begun.
    ///
    /// # Errors
    /// Where the request cannot be written as bytes.
    pub fn submit(&mut self, request: &Request) -> Result<(), String> {
        self.link.send(&Incoming::Request(request.clone()))
    }

    /// The replies since the last call.
    pub fn poll(&mut self) -> Vec<Reply> {
        self.replies.borrow_mut().drain(..).collect()
    }
}
