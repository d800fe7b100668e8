//! The pool of workers, shared by the designs that have studies in it.

use std::collections::BTreeMap;

use super::Order;
use crate::compute::Pool;
use crate::compute::protocol::{StudyNews, Topic};

/// How many designs are kept at most.
pub const KEPT: usize = 4;

/// Whose study it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// The design that is edited.
    Present,
    /// A design that is kept, by its place among them.
    Kept(usize),
}

/// The pool with the owners of its studies. It has one study of each topic, whichever design wants it.
pub struct SharedPool {
    pool: Pool,
    owners: Owners,
}

/// Who has the study of each topic.
#[derive(Debug, Default)]
struct Owners(BTreeMap<Topic, Owner>);

impl Owners {
    /// Notes an order; says whether it counts. Nobody ends the study of another owner.
    fn note(&mut self, owner: Owner, order: &Order) -> bool {
        match order {
            Order::Want(job) => {
                self.0.insert(job.study.topic(), owner);
                true
            }
            Order::Cancel(topic) => {
                let own = self.0.get(topic) == Some(&owner);
                if own {
                    self.0.remove(topic);
                }
                own
            }
        }
    }

    /// Whom news is for; that there are no workers is for everybody.
    fn of(&self, news: &StudyNews) -> Vec<Owner> {
        match news {
            StudyNews::Part { topic, .. }
            | StudyNews::Places { topic, .. }
            | StudyNews::Finished { topic, .. }
            | StudyNews::Refused { topic, .. } => self.0.get(topic).copied().into_iter().collect(),
            StudyNews::Broken(_) => std::iter::once(Owner::Present).chain((0..KEPT).map(Owner::Kept)).collect(),
        }
    }
}

impl SharedPool {
    /// A pool in which nothing is wanted yet.
    pub fn new(pool: Pool) -> Self {
        Self { pool, owners: Owners::default() }
    }

    /// Tells the pool what `owner` wants.
    pub fn carry_out(&mut self, owner: Owner, orders: impl IntoIterator<Item = Order>) {
        for order in orders {
            if self.owners.note(owner, &order) {
                match order {
                    Order::Want(job) => self.pool.want(job),
                    Order::Cancel(topic) => self.pool.cancel(topic),
                }
            }
        }
    }

    /// While held, no new place is begun: a drag has priority.
    pub fn hold(&mut self, held: bool) {
        self.pool.hold(held);
    }

    /// The news since the last call, each with whom it is for.
    pub fn poll(&mut self) -> Vec<(Owner, StudyNews)> {
        let news = self.pool.poll().into_iter();
        news.flat_map(|news| self.owners.of(&news).into_iter().map(move |owner| (owner, news.clone()))).collect()
    }

    /// Whether a study of this topic is at work.
    pub fn is_at_work(&self, topic: Topic) -> bool {
        self.pool.progress(topic).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::protocol::StudyJob;
    use crate::robot::Vec2;
    use crate::scenario::presets;
    use crate::study::Study;

    #[test]
    fn news_goes_to_the_owner_of_the_topics_study_alone() {
        let mut owners = Owners::default();
        let study = Study::Directions { position: Vec2::zeros(), count: 8, limit: 40.0 };
        let job = StudyJob { revision: 1, scenario: presets::PRESETS[0].scenario().to_json(), study };
        // Both count from one: their studies have the same revision.
        let news = StudyNews::Finished { topic: Topic::Directions, revision: 1 };
        assert!(owners.of(&news).is_empty());
        assert!(owners.note(Owner::Present, &Order::Want(job.clone())));
        assert_eq!(owners.of(&news), [Owner::Present]);
        assert!(!owners.note(Owner::Kept(0), &Order::Cancel(Topic::Directions)), "the study of another owner");
        assert!(owners.note(Owner::Kept(0), &Order::Want(job.clone())));
        assert_eq!(owners.of(&news), [Owner::Kept(0)]);
        // One kept design after the other.
        assert!(owners.note(Owner::Kept(3), &Order::Want(job)));
        assert!(!owners.note(Owner::Kept(0), &Order::Cancel(Topic::Directions)));
        assert_eq!(owners.of(&news), [Owner::Kept(3)]);
        assert!(owners.note(Owner::Kept(3), &Order::Cancel(Topic::Directions)) && owners.of(&news).is_empty());
        let all = [Owner::Present, Owner::Kept(0), Owner::Kept(1), Owner::Kept(2), Owner::Kept(3)];
        assert_eq!(owners.of(&StudyNews::Broken("none".into())), all);
    }
}
