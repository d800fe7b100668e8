//! The lines at the foot of the window: what was done, and what went wrong.
//!
//! What was done is told until the next thing is done. A fault stays until what it is about succeeds, or the next action
//! does; no other line takes its place.

/// What a fault is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    /// The robot was not changed as somebody wanted.
    Robot,
    /// Something else was not done, or was lost.
    Action,
    /// What is done here is not kept. No action mends that.
    Storage,
}

/// One line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// What is said.
    pub text: String,
    /// What went wrong, or was refused; nothing where all is well.
    pub fault: Option<About>,
    /// It came while the pointer was down. The steps of a drag do not take it away, or nobody would have read it.
    in_drag: bool,
}

/// All lines, the newest last.
#[derive(Debug, Default)]
pub struct Notices {
    lines: Vec<Notice>,
    dragging: bool,
}

impl Notices {
    /// The lines, the newest last.
    pub fn lines(&self) -> &[Notice] {
        &self.lines
    }

    /// Says whether the pointer is down.
    pub fn drag(&mut self, dragging: bool) {
        self.dragging = dragging;
        if !dragging {
            for line in &mut self.lines {
                line.in_drag = false;
            }
        }
    }

    /// Tells what was done, in place of what was done before.
    pub fn tell(&mut self, text: String) {
        self.lines.retain(|line| line.fault.is_some());
        self.push(text, None);
    }

    /// Tells what went wrong. Several actions may each have a fault; of the robot and of the storage the newest counts.
    pub fn complain(&mut self, about: About, text: String) {
        self.lines.retain(|line| match line.fault {
            None => about == About::Storage,
            Some(fault) => line.text != text && (fault != about || about == About::Action),
        });
        self.push(text, Some(about));
    }

    /// Something has succeeded: what was told before is old, and so are faults, but for those of another kind that came
    /// in the middle of the drag.
    pub fn succeed(&mut self, what: About) {
        self.lines.retain(|line| match line.fault {
            Some(about) if about == what => about == About::Action && line.in_drag,
            Some(About::Storage) => true,
            _ => what == About::Storage || line.in_drag,
        });
    }

    /// Takes a line away, counted from the oldest.
    pub fn dismiss(&mut self, index: usize) {
        if index < self.lines.len() {
            self.lines.remove(index);
        }
    }

    fn push(&mut self, text: String, fault: Option<About>) {
        self.lines.push(Notice { text, fault, in_drag: self.dragging });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(notices: &Notices) -> Vec<&str> {
        notices.lines().iter().map(|line| line.text.as_str()).collect()
    }

    fn with(lines: &[(About, &str)]) -> Notices {
        let mut notices = Notices::default();
        for (about, text) in lines {
            notices.complain(*about, (*text).into());
        }
        notices
    }

    #[test]
    fn a_fault_goes_when_what_it_is_about_or_the_next_action_succeeds() {
        let faults = [(About::Robot, "refused"), (About::Action, "not saved"), (About::Storage, "full")];
        for (what, left) in
            [(About::Robot, &["full"][..]), (About::Action, &["full"]), (About::Storage, &["refused", "not saved"])]
        {
            let mut notices = with(&faults);
            notices.succeed(what);
            assert_eq!(texts(&notices), left, "{what:?}");
        }
    }

    #[test]
    fn no_fault_is_overwritten_by_another_line() {
        let mut notices = with(&[(About::Action, "a.json is no scenario"), (About::Action, "b.json is no scenario")]);
        notices.complain(About::Storage, "full".into());
        notices.tell("Saved c.json".into());
        notices.tell("Saved d.json".into());
        assert_eq!(texts(&notices), ["a.json is no scenario", "b.json is no scenario", "full", "Saved d.json"]);
        // The same twice is said once; what is refused now is what counts of the robot.
        notices.complain(About::Action, "a.json is no scenario".into());
        notices.complain(About::Robot, "x is not allowed".into());
        notices.complain(About::Robot, "y is not allowed".into());
        assert_eq!(texts(&notices), ["b.json is no scenario", "full", "a.json is no scenario", "y is not allowed"]);
        notices.dismiss(1);
        notices.dismiss(9);
        assert_eq!(texts(&notices), ["b.json is no scenario", "a.json is no scenario", "y is not allowed"]);
    }

    #[test]
    fn a_drag_takes_away_what_it_caused_and_nothing_that_came_meanwhile() {
        let mut notices = Notices::default();
        notices.drag(true);
        notices.complain(About::Robot, "at an anchor".into());
        notices.complain(About::Action, "computation lost".into());
        notices.succeed(About::Robot);
        assert_eq!(texts(&notices), ["computation lost"]);
        notices.drag(false);
        assert_eq!(texts(&notices), ["computation lost"], "still to be read");
        notices.succeed(About::Robot);
        assert!(texts(&notices).is_empty());
    }
}
