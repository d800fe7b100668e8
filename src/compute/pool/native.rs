//! The pool's workers as threads.

use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread;

use super::core::{self, Crew, Event};
use super::pool_worker::PoolWorker;
use super::scheduler::{MOST_WORKERS, Scheduler, WorkerId};
use crate::compute::protocol::Task;
use crate::compute::robot_study::RobotStudy;
use crate::stability::Steps;
use crate::study::Answer;

type Core = core::Core<Threads>;
/// How a place is answered.
type AnswerAt = dyn Fn(&Arc<RobotStudy>, usize) -> Steps<Answer> + Send + Sync;

/// What the interface and the threads share. A thread that has an answer gets its next places at once.
pub struct SharedCore {
    core: Arc<Mutex<Core>>,
}

impl SharedCore {
    /// A pool without threads.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        let size = thread::available_parallelism().map_or(1, usize::from).min(MOST_WORKERS);
        Self::by(size, wake, RobotStudy::answer)
    }

    /// The same with up to `size` threads, each place answered by `answer`.
    pub(super) fn by(
        size: usize,
        wake: impl Fn() + Send + Sync + 'static,
        answer: impl Fn(&Arc<RobotStudy>, usize) -> Steps<Answer> + Send + Sync + 'static,
    ) -> Self {
        let (wake, answer) = (Arc::new(wake), Arc::new(answer));
        let core = Arc::new_cyclic(|core| {
            let crew =
                Threads { inboxes: BTreeMap::new(), report: Messenger { core: Weak::clone(core), wake }, answer };
            // No thread vanishes without a word.
            Mutex::new(Core::new(Scheduler::new(size, false), crew))
        });
        Self { core }
    }

    /// Does something with the scheduler.
    pub fn with<R>(&self, act: impl FnOnce(&mut Core) -> R) -> R {
        act(&mut lock(&self.core))
    }
}

/// Places are answered without the lock, so whoever panics with it is not at work on one.
fn lock(core: &Mutex<Core>) -> MutexGuard<'_, Core> {
    core.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Where threads tell what becomes of them.
#[derive(Clone)]
struct Messenger {
    core: Weak<Mutex<Core>>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl Messenger {
    fn tell(&self, worker: WorkerId, event: Event) {
        // Without a pool nobody wants to know.
        let Some(core) = self.core.upgrade() else { return };
        let news = lock(&core).hear(worker, event);
        // Not under the lock: whoever is woken may hold what `wake` waits for, and wait for the lock.
        if news {
            (self.wake)();
        }
    }
}

/// The threads.
pub struct Threads {
    /// A thread ends when its inbox is dropped.
    inboxes: BTreeMap<WorkerId, Sender<Task>>,
    report: Messenger,
    answer: Arc<AnswerAt>,
}

impl Crew for Threads {
    fn start(&mut self, worker: WorkerId) -> Result<(), String> {
        let (inbox, tasks) = channel();
        let (report, answer) = (self.report.clone(), self.answer.clone());
        let run = move || {
            report.tell(worker, Event::Ready);
            let end = catch_unwind(AssertUnwindSafe(|| serve(worker, &tasks, &report, answer)));
            if let Err(payload) = end {
                report.tell(worker, Event::Lost(reason(&*payload)));
            }
        };
        let name = format!("tautline-study-{worker}");
        thread::Builder::new().name(name).spawn(run).map_err(|error| error.to_string())?;
        self.inboxes.insert(worker, inbox);
        Ok(())
    }

    fn tell(&mut self, worker: WorkerId, task: Task) -> Result<(), String> {
        let sent = self.inboxes.get(&worker).is_some_and(|inbox| inbox.send(task).is_ok());
        if sent { Ok(()) } else { Err("the thread has ended".into()) }
    }

    fn stop(&mut self, worker: WorkerId) {
        self.inboxes.remove(&worker);
    }
}

/// Runs until the other side is dropped.
fn serve(worker: WorkerId, tasks: &Receiver<Task>, report: &Messenger, answer: Arc<AnswerAt>) {
    let mut pool_worker = PoolWorker::by(answer);
    while let Ok(task) = tasks.recv() {
        pool_worker.submit(task);
        loop {
            match tasks.try_recv() {
                Ok(newer) => {
                    pool_worker.submit(newer);
                    continue;
                }
                Err(TryRecvError::Empty) => {}
                Err(TryRecvError::Disconnected) => return,
            }
            let Some(answered) = pool_worker.work() else { break };
            if let Some(batch) = answered {
                report.tell(worker, Event::Answered(batch));
            }
            if let Some(part) = pool_worker.part() {
                report.tell(worker, Event::Part(part));
            }
        }
    }
}

/// What a panic says.
fn reason(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("a thread has panicked").into()
}
