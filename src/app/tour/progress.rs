//! How far the tour has come: four tasks, each done when the robot or the screen is as it asks.

/// A task that is done is praised for so long before the next one comes, in seconds.
const PRAISE: f64 = 2.0;

/// A task of the tour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// Drag the platform out of the region where the robot can rest, and back.
    Drag,
    /// Set a speed above the critical one.
    Speed,
    /// Choose an eigenvalue.
    Eigenvalue,
    /// Open the map.
    Map,
}

/// What of a task is behind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TaskStage {
    /// Nothing has been looked at yet.
    #[default]
    New,
    /// It is asked for.
    Asked,
    /// The first of its two halves is done: the platform is outside.
    Halfway,
    /// It is done, since this time in seconds.
    Done {
        /// When it was done; while a button of the pointer is held, now.
        since: f64,
    },
    /// What it asks for was so when it began: it waits until a person goes on.
    Already,
}

/// What the tour looks at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools)] // One for each task; they know nothing of each other.
pub struct Seen {
    /// Whether the pose has an equilibrium, where that is known.
    pub rests: Option<bool>,
    /// Whether the speed is above the critical one.
    pub above: bool,
    /// Whether an eigenvalue has been chosen.
    pub chosen: bool,
    /// Whether the map is open.
    pub map: bool,
    /// Whether a button of the pointer is held, or a finger is down.
    pub held: bool,
}

/// The tour: which of its tasks is on show, and what of that is behind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tour {
    index: usize,
    stage: TaskStage,
}

impl Tour {
    /// The tasks in order.
    pub const TASKS: [Task; 4] = [Task::Drag, Task::Speed, Task::Eigenvalue, Task::Map];

    /// The task on show.
    pub fn task(&self) -> Task {
        Self::TASKS[self.index.min(Self::TASKS.len() - 1)]
    }

    /// Its number, from 1.
    pub fn number(&self) -> usize {
        self.index + 1
    }

    /// What of it is behind.
    pub fn stage(&self) -> TaskStage {
        self.stage
    }

    /// Whether it is done.
    pub fn is_done(&self) -> bool {
        matches!(self.stage, TaskStage::Done { .. } | TaskStage::Already)
    }

    /// Looks at the robot and the screen at a time in seconds, and goes on where a task has been praised long enough. Gives
    /// whether the tour goes on.
    #[must_use]
    pub fn look(&mut self, seen: Seen, time: f64) -> bool {
        let outside = self.task() == Task::Drag && seen.rests == Some(false);
        let holds = match self.task() {
            Task::Drag => false,
            Task::Speed => seen.above,
            Task::Eigenvalue => seen.chosen,
            Task::Map => seen.map,
        };
        let done = TaskStage::Done { since: time };
        self.stage = match self.stage {
            TaskStage::New if holds => TaskStage::Already,
            TaskStage::New | TaskStage::Asked if outside => TaskStage::Halfway,
            TaskStage::New => TaskStage::Asked,
            TaskStage::Asked if holds => done,
            TaskStage::Halfway if seen.rests == Some(true) => done,
            TaskStage::Done { .. } if seen.held => done,
            TaskStage::Done { since } if time - since >= PRAISE => return self.go_on(),
            stage => stage,
        };
        true
    }

    /// In how many seconds the next task comes by itself, where it does.
    pub fn next_in(&self, time: f64) -> Option<f64> {
        match self.stage {
            TaskStage::Done { since } => Some((since + PRAISE - time).max(0.0)),
            _ => None,
        }
    }

    /// Goes on to the next task, done or not. Gives whether there is one.
    #[must_use]
    pub fn go_on(&mut self) -> bool {
        let more = !self.is_last();
        if more {
            *self = Self { index: self.index + 1, stage: TaskStage::New };
        }
        more
    }

    /// Goes back to the task before.
    pub fn back(&mut self) {
        *self = Self { index: self.index.saturating_sub(1), stage: TaskStage::New };
    }

    /// Whether there is a task before this one.
    pub fn is_first(&self) -> bool {
        self.index == 0
    }

    /// Whether there is none after it.
    pub fn is_last(&self) -> bool {
        self.number() == Self::TASKS.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A robot that rests below its critical speed, with nothing chosen.
    const CALM: Seen = Seen { rests: Some(true), above: false, chosen: false, map: false, held: false };

    fn at(task: Task) -> Tour {
        let mut tour = Tour::default();
        while tour.task() != task {
            assert!(tour.go_on());
        }
        tour
    }

    #[test]
    fn the_platform_has_to_leave_and_to_come_back() {
        let mut tour = Tour::default();
        assert!(tour.look(CALM, 0.0) && tour.stage() == TaskStage::Asked);
        // Being computed is neither outside nor inside.
        let unknown = Seen { rests: None, ..CALM };
        assert!(tour.look(unknown, 0.1) && tour.stage() == TaskStage::Asked);
        let outside = Seen { rests: Some(false), held: true, ..CALM };
        assert!(tour.look(outside, 0.2) && tour.stage() == TaskStage::Halfway);
        assert!(tour.look(unknown, 0.3) && tour.stage() == TaskStage::Halfway);
        assert!(tour.look(Seen { held: true, ..CALM }, 0.4) && tour.is_done());
        // The praise lasts from the moment at which the platform is let go.
        assert!(tour.look(Seen { held: true, ..CALM }, 9.0) && tour.task() == Task::Drag);
        assert!(tour.look(CALM, 9.5) && tour.task() == Task::Drag);
        assert_eq!(tour.next_in(9.5), Some(PRAISE - 0.5));
        assert!(tour.look(CALM, 9.0 + PRAISE) && tour.task() == Task::Speed);
        assert!(!tour.is_done() && tour.next_in(20.0).is_none());
    }

    #[test]
    fn a_robot_that_begins_outside_has_only_to_come_back() {
        let mut tour = Tour::default();
        assert!(tour.look(Seen { rests: Some(false), ..CALM }, 0.0) && tour.stage() == TaskStage::Halfway);
        assert!(tour.look(CALM, 0.1) && tour.is_done());
    }

    #[test]
    fn each_other_task_is_done_by_one_thing_alone() {
        let things = [
            (Task::Speed, Seen { above: true, ..CALM }),
            (Task::Eigenvalue, Seen { chosen: true, ..CALM }),
            (Task::Map, Seen { map: true, ..CALM }),
        ];
        for (task, _) in things {
            for (of, seen) in things {
                let mut tour = at(task);
                assert!(tour.look(CALM, 0.0) && tour.look(seen, 0.1));
                assert_eq!(tour.is_done(), of == task, "{task:?} by what {of:?} asks for");
            }
        }
    }

    #[test]
    fn what_is_so_already_waits_for_the_person() {
        let mut tour = at(Task::Map);
        let open = Seen { map: true, ..CALM };
        assert!(tour.look(open, 0.0) && tour.stage() == TaskStage::Already && tour.is_done());
        assert!(tour.look(open, 1e3) && tour.task() == Task::Map);
        assert!(tour.look(CALM, 1e3) && tour.stage() == TaskStage::Already);
    }

    #[test]
    fn the_tour_ends_after_its_last_task_and_can_be_skipped_through() {
        let mut tour = at(Task::Map);
        assert!(tour.is_last() && !tour.is_first() && tour.number() == 4);
        assert!(tour.look(CALM, 0.0) && tour.look(Seen { map: true, ..CALM }, 1.0));
        assert!(!tour.look(CALM, 1.0 + PRAISE), "after the praise it is over");
        let mut tour = at(Task::Speed);
        tour.back();
        assert!(tour.is_first() && tour == Tour::default());
        tour.back();
        assert!(tour == Tour::default());
        assert!(!at(Task::Map).go_on());
    }
}
