//! The engine in a web worker.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use web_time::Instant;

use super::link::{Heard, Link};
use super::protocol::{Incoming, Outgoing, Reply, Request, Update};
use super::watch::{Sign, Watch};
use crate::scenario::Scenario;

/// The engine at work, seen from the page.
pub struct Compute {
    link: Link,
    replies: Rc<RefCell<VecDeque<Reply>>>,
    watch: Rc<RefCell<Watch>>,
    started: Instant,
}

impl Compute {
    /// Starts the worker; `wake` is called whenever there are replies to poll for.
    ///
    /// # Errors
    /// Where the browser refuses a worker.
    pub fn start(wake: impl Fn() + 'static) -> Result<Self, String> {
        let replies = Rc::new(RefCell::new(VecDeque::new()));
        let watch = Rc::new(RefCell::new(Watch::default()));
        let (inbox, watched) = (replies.clone(), watch.clone());
        let link = Link::start(move |heard| {
            watched.borrow_mut().heard();
            let reply = match heard {
                Heard::Message(Outgoing::Reply(reply)) => reply,
                Heard::Broken(reason) => lost(reason),
                Heard::Ready | Heard::Message(Outgoing::Batch(_) | Outgoing::Part(_) | Outgoing::Alive) => return,
            };
            inbox.borrow_mut().push_back(reply);
            wake();
        })?;
        Ok(Self { link, replies, watch, started: Instant::now() })
    }

    /// Sends a request; a newer one takes the place of an older one that has not begun.
    ///
    /// # Errors
    /// Where the request cannot be written as bytes.
    pub fn submit(&mut self, request: &Request) -> Result<(), String> {
        if let Request::Analyze(job) = request
            && let Ok(scenario) = Scenario::from_json(&job.scenario)
        {
            self.watch.borrow_mut().expect(scenario.cables.len() * scenario.elements_per_cable);
        }
        self.link.send(&Incoming::Request(request.clone()))
    }

    /// The replies since the last call. Calls also keep an eye on the worker, at least once a second while something is
    /// awaited of it.
    pub fn poll(&mut self) -> Vec<Reply> {
        let mut replies: Vec<Reply> = self.replies.borrow_mut().drain(..).collect();
        match self.watch.borrow_mut().go_on(self.started.elapsed()) {
            Sign::Wait => {}
            Sign::Ask => {
                if let Err(reason) = self.link.send(&Incoming::AreYouThere) {
                    replies.push(lost(reason));
                }
            }
            Sign::Lost => replies.push(lost("it does not answer".into())),
        }
        replies
    }
}

fn lost(reason: String) -> Reply {
    Reply { revision: 0, update: Update::Broken(reason) }
}
