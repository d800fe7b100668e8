//! Long computations in steps, so that whoever runs them can do something else in between, or give them up.
//!
//! Such a computation is an `async fn` that awaits [`step`] after each part of its work. Nothing waits for anything in it:
//! the compiler makes a state machine of the function, which [`Steps`] takes from one step to the next and [`finish`] to the
//! end. Both do the same work in the same order. Nobody here knows a clock: the caller decides how many steps it takes.

use std::future::Future;
use std::pin::{Pin, pin};
use std::task::{Context, Poll, Waker};

/// Ends a step: the caller has its turn.
pub fn step() -> impl Future<Output = ()> + Send {
    Step { ended: false }
}

struct Step {
    ended: bool,
}

impl Future for Step {
    type Output = ();

    fn poll(mut self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<()> {
        if std::mem::replace(&mut self.ended, true) { Poll::Ready(()) } else { Poll::Pending }
    }
}

/// A computation of a `T` that goes on step by step; dropping it gives it up.
pub struct Steps<T> {
    work: Option<Pin<Box<dyn Future<Output = T> + Send>>>,
}

impl<T> Steps<T> {
    /// The computation `work`, of which nothing is done yet.
    pub fn new(work: impl Future<Output = T> + Send + 'static) -> Self {
        Self { work: Some(Box::pin(work)) }
    }

    /// Does the next step; gives the result after the last one, and nothing from then on.
    pub fn advance(&mut self) -> Option<T> {
        let work = self.work.as_mut()?;
        match work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Pending => None,
            Poll::Ready(result) => {
                self.work = None;
                Some(result)
            }
        }
    }
}

/// Does all of a computation at once.
pub fn finish<T>(work: impl Future<Output = T>) -> T {
    finish_watched(work, || {})
}

/// Does all of a computation at once and calls `watch` after each step but the last.
pub fn finish_watched<T>(work: impl Future<Output = T>, mut watch: impl FnMut()) -> T {
    let mut work = pin!(work);
    loop {
        if let Poll::Ready(result) = work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            return result;
        }
        watch();
    }
}

#[cfg(test)]
mod tests {
    use crate::steps::*;

    async fn sum(numbers: Vec<u32>) -> u32 {
        let mut sum = 0;
        for number in numbers {
            sum += number;
            step().await;
        }
        sum
    }

    #[test]
    fn a_computation_in_steps_comes_to_the_same_end() {
        let mut steps = Steps::new(sum(vec![1, 2, 3]));
        let results: Vec<Option<u32>> = (0..6).map(|_| steps.advance()).collect();
        assert_eq!(results, [None, None, None, Some(6), None, None]);
        assert_eq!(finish(sum(vec![1, 2, 3])), 6);
        let mut watched = 0;
        assert_eq!((finish_watched(sum(vec![1, 2, 3]), || watched += 1), watched), (6, 3));
    }
}
