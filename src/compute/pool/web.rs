//! The pool's workers as web workers.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::{Rc, Weak};

use wasm_bindgen::prelude::*;

use super::core::{self, Crew, Event};
use super::scheduler::{MOST_WORKERS, Scheduler, WorkerId};
use crate::compute::link::{Heard, Link};
use crate::compute::protocol::{Incoming, Outgoing, Task};

type Core = core::Core<WebWorkers>;

/// While studies are at work, lost workers are looked for at this interval, in ms, whether the page draws or not.
const BEAT: i32 = 250;

/// What the page and the listeners to its workers share. A worker that has answered gets its next places at once.
pub struct SharedCore {
    core: Rc<RefCell<Core>>,
    heart: Heart,
}

impl SharedCore {
    /// A pool without workers.
    pub fn new(wake: impl Fn() + 'static) -> Self {
        let cores = web_sys::window().map_or(1.0, |window| window.navigator().hardware_concurrency());
        // The page draws on one core. During a drag, when the pool is held, the engine has another.
        let size = (1..=MOST_WORKERS).rev().find(|&size| size as f64 <= cores - 1.0).unwrap_or(1);
        let wake: Rc<dyn Fn()> = Rc::new(wake);
        let core = Rc::new_cyclic(|core| {
            let report = Messenger { core: Weak::clone(core), wake: wake.clone() };
            RefCell::new(Core::new(Scheduler::new(size, true), WebWorkers { links: BTreeMap::new(), report }))
        });
        let heart = Heart::new(Messenger { core: Rc::downgrade(&core), wake });
        Self { core, heart }
    }

    /// Does something with the scheduler.
    pub fn with<R>(&self, act: impl FnOnce(&mut Core) -> R) -> R {
        let mut core = self.core.borrow_mut();
        let result = act(&mut core);
        self.heart.beat(core.scheduler.at_work());
        result
    }
}

/// Where workers tell what becomes of them.
#[derive(Clone)]
struct Messenger {
    core: Weak<RefCell<Core>>,
    wake: Rc<dyn Fn()>,
}

impl Messenger {
    /// Does something with the scheduler that may give news.
    fn act(&self, act: impl FnOnce(&mut Core) -> bool) {
        let Some(core) = self.core.upgrade() else { return };
        let news = act(&mut core.borrow_mut());
        if news {
            (self.wake)();
        }
    }
}

/// The web workers.
pub struct WebWorkers {
    links: BTreeMap<WorkerId, Link>,
    report: Messenger,
}

impl Crew for WebWorkers {
    fn start(&mut self, worker: WorkerId) -> Result<(), String> {
        let report = self.report.clone();
        let link = Link::start(move |heard| {
            let event = match heard {
                Heard::Ready => Event::Ready,
                Heard::Message(Outgoing::Batch(batch)) => Event::Answered(batch),
                Heard::Message(Outgoing::Part(part)) => Event::Part(part),
                Heard::Message(Outgoing::Reply(_) | Outgoing::Alive) => return,
                Heard::Broken(reason) => Event::Lost(reason),
            };
            report.act(|core| core.hear(worker, event));
        })?;
        self.links.insert(worker, link);
        Ok(())
    }

    fn tell(&mut self, worker: WorkerId, task: Task) -> Result<(), String> {
        let link = self.links.get(&worker).ok_or("the worker has ended")?;
        link.send(&Incoming::Task(task))
    }

    fn stop(&mut self, worker: WorkerId) {
        self.links.remove(&worker);
    }
}

/// Wakes the scheduler again and again: workers that are lost say nothing, and a page at rest draws nothing.
struct Heart {
    on_beat: Closure<dyn FnMut()>,
    timer: Cell<Option<i32>>,
}

impl Heart {
    fn new(report: Messenger) -> Self {
        Self { on_beat: Closure::new(move || report.act(Core::go_on)), timer: Cell::new(None) }
    }

    /// Beats from now on, or no longer.
    fn beat(&self, wanted: bool) {
        if wanted == self.timer.get().is_some() {
            return;
        }
        let Some(window) = web_sys::window() else { return };
        if let Some(timer) = self.timer.take() {
            window.clear_interval_with_handle(timer);
        } else {
            let on_beat = self.on_beat.as_ref().unchecked_ref();
            self.timer.set(window.set_interval_with_callback_and_timeout_and_arguments_0(on_beat, BEAT).ok());
        }
    }
}

impl Drop for Heart {
    fn drop(&mut self) {
        self.beat(false);
    }
}
