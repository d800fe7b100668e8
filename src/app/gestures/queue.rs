//! Events of the pointer in portions that egui understands.
//!
//! egui looks at a drag once for each pass, at where the pointer is at its end. Where frames are slow, a press, a
//! movement and the release may all come before one pass: the press is then looked for where the drag has ended, and
//! the way there is dropped, since nothing is dragged any more. Here each waits for a pass of its own.

use std::collections::{BTreeSet, VecDeque};

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, TouchId, TouchPhase};

/// A finger that has moved this far, in points, shows where it wants to go. It is egui's own limit of clicks.
const DECIDED: f32 = 6.0;

/// What has come and was not handed on yet.
#[derive(Debug, Default)]
pub(super) struct Queue {
    waiting: VecDeque<Waiting>,
    /// Where the pointer is, as far as egui knows.
    at: Option<Pos2>,
    /// The buttons that are down, as far as egui knows.
    down: Vec<PointerButton>,
    /// Where the last of them went down.
    pressed_at: Option<Pos2>,
    /// The fingers on the screen.
    fingers: BTreeSet<TouchId>,
    finger: Finger,
}

#[derive(Debug)]
struct Waiting {
    event: Event,
    /// It is the press of a finger. What the finger wants is not known yet.
    finger: bool,
}

/// A finger that has come down on what turns or scrolls.
#[derive(Debug, Default)]
enum Finger {
    /// There is none.
    #[default]
    None,
    /// It may still want anything. Its press is kept back.
    Undecided { press: Event },
    /// It scrolls. egui is not told of its press.
    Scrolls { from: Pos2, begins: bool },
}

impl Queue {
    /// Takes in what has come; `by_finger` where presses are known to be a finger's.
    pub(super) fn extend(&mut self, events: Vec<Event>, by_finger: bool) {
        let start = |event: &Event| match event {
            Event::Touch { phase: TouchPhase::Start, pos, .. } => Some(*pos),
            _ => None,
        };
        let started: Vec<Pos2> = events.iter().filter_map(start).collect();
        self.waiting.extend(events.into_iter().map(|event| {
            // Backends tell of a finger twice, as a touch and as what a mouse would have done there, in either order.
            let finger = matches!(&event, Event::PointerButton { pos, button: PointerButton::Primary, pressed: true, .. }
                if by_finger || started.iter().any(|start| same(*start, *pos)));
            Waiting { event, finger }
        }));
    }

    /// Whether something waits for the next pass.
    pub(super) fn is_waiting(&self) -> bool {
        !self.waiting.is_empty()
    }

    /// Where the finger has come down that begins to scroll in this pass.
    pub(super) fn swipe(&self) -> Option<Pos2> {
        match self.finger {
            Finger::Scrolls { from, begins: true } => Some(from),
            _ => None,
        }
    }

    /// What the next pass is to know. `turns` tells where a finger may turn something or scroll, `drags` whether
    /// something is being dragged.
    pub(super) fn next(&mut self, turns: impl Fn(Pos2) -> bool, drags: bool) -> Vec<Event> {
        let mut out = Vec::new();
        if let Finger::Scrolls { begins, .. } = &mut self.finger {
            *begins = false;
        }
        // Whether a button has changed in this pass, and whether something was dragged.
        let (mut changed, mut dragged) = (false, false);
        // Whether a key was pressed in this pass, and whether one that hands the focus on.
        let (mut typed, mut handed_on) = (false, false);
        while let Some(Waiting { event, finger }) = self.waiting.pop_front() {
            // What has the focus is settled between passes. So keys wait until a click or a key has given it away, and
            // those wait for the keys before them.
            let (types, hands_on) = (is_typed(&event), hands_focus_on(&event));
            let gives_focus = hands_on || matches!(event, Event::PointerButton { .. });
            if (types && (changed || handed_on)) || (gives_focus && typed) {
                self.waiting.push_front(Waiting { event, finger });
                break;
            }
            typed |= types;
            handed_on |= hands_on;
            match event {
                Event::PointerMoved(to) if self.is_undecided() => {
                    let way = to - self.at.unwrap_or(to);
                    if way.length() <= DECIDED {
                        continue;
                    }
                    if way.y.abs() <= way.x.abs() {
                        self.waiting.push_front(Waiting { event, finger });
                        self.press();
                        continue;
                    }
                    self.finger = Finger::Scrolls { from: to - way, begins: true };
                    dragged = true;
                }
                Event::PointerMoved(to) if self.at != Some(to) => {
                    if changed {
                        self.waiting.push_front(Waiting { event, finger });
                        break;
                    }
                    dragged |= self.drags(to, drags);
                }
                Event::PointerButton { pos, button, pressed, .. } => {
                    let (undecided, is_down) = (self.is_undecided(), self.down.contains(&button));
                    // Browsers tell of a finger as a pointer and as a touch: every press and every release comes twice.
                    let again = match self.at {
                        Some(at) if pressed => same(at, pos) && (undecided || is_down),
                        _ => !pressed && !is_down && matches!(self.finger, Finger::None),
                    };
                    if again {
                        continue;
                    }
                    if undecided {
                        // A tap, or another finger.
                        self.waiting.push_front(Waiting { event, finger: false });
                        self.press();
                        continue;
                    }
                    let moves = self.at != Some(pos);
                    // A click is over at once: browsers allow some things only while they tell of it.
                    let ends = !pressed && (dragged || (moves && self.drags(pos, drags)));
                    if moves && !changed {
                        self.at = Some(pos);
                        out.push(Event::PointerMoved(pos));
                    }
                    if changed || ends {
                        self.waiting.push_front(Waiting { event, finger });
                        break;
                    }
                    if finger && self.fingers.len() <= 1 && turns(pos) {
                        self.finger = Finger::Undecided { press: event };
                        continue;
                    }
                    changed = true;
                    self.change(button, pos, pressed);
                }
                Event::Touch { id, phase: TouchPhase::Start, .. } => {
                    self.fingers.insert(id);
                    if self.fingers.len() > 1 {
                        // Two fingers zoom, so the first one's press counts as any other.
                        self.press();
                    }
                }
                Event::Touch { id, phase: TouchPhase::End, .. } => drop(self.fingers.remove(&id)),
                Event::Touch { id, phase: TouchPhase::Cancel, .. } => {
                    self.fingers.remove(&id);
                    // What it has done counts, and it is no tap. egui knows of no drag without an end.
                    let acts = !self.down.is_empty() || matches!(self.finger, Finger::Scrolls { .. });
                    if self.is_undecided() {
                        self.finger = Finger::None;
                    }
                    if let Some(pos) = self.at.filter(|_| acts) {
                        let (button, modifiers) = (PointerButton::Primary, Modifiers::default());
                        let event = Event::PointerButton { pos, button, pressed: false, modifiers };
                        self.waiting.push_front(Waiting { event, finger: false });
                    }
                }
                _ => {}
            }
            match event {
                Event::PointerMoved(to) => self.at = Some(to),
                Event::PointerGone => self.at = None,
                _ => {}
            }
            out.push(event);
        }
        out
    }

    /// Hands a press on that was kept back.
    fn press(&mut self) {
        match std::mem::take(&mut self.finger) {
            Finger::Undecided { press } => self.waiting.push_front(Waiting { event: press, finger: false }),
            other => self.finger = other,
        }
    }

    /// Notes that a button has changed.
    fn change(&mut self, button: PointerButton, at: Pos2, pressed: bool) {
        self.down.retain(|other| *other != button);
        if pressed {
            self.down.push(button);
            self.pressed_at = Some(at);
        } else {
            self.finger = Finger::None;
        }
    }

    fn is_undecided(&self) -> bool {
        matches!(self.finger, Finger::Undecided { .. })
    }

    /// Whether a movement to this place drags something, or is too far for a click.
    fn drags(&self, to: Pos2, drags: bool) -> bool {
        let far = self.pressed_at.is_none_or(|from| from.distance(to) > DECIDED);
        matches!(self.finger, Finger::Scrolls { .. }) || (!self.down.is_empty() && (drags || far))
    }
}

/// Whether two places are the same, but for rounding.
fn same(a: Pos2, b: Pos2) -> bool {
    a.distance(b) < 1.0
}

/// Whether it is for what has the keyboard's focus.
fn is_typed(event: &Event) -> bool {
    matches!(event, Event::Key { pressed: true, .. } | Event::Text(_) | Event::Paste(_) | Event::Cut | Event::Ime(_))
}

/// Whether it is a key that may take the focus elsewhere.
fn hands_focus_on(event: &Event) -> bool {
    matches!(event, Event::Key { key: Key::Tab | Key::Enter | Key::Escape, pressed: true, .. })
}

#[cfg(test)]
mod tests {
    use eframe::egui::{TouchDeviceId, pos2};

    use super::*;

    const A: Pos2 = pos2(10.0, 10.0);
    const RIGHT: Pos2 = pos2(40.0, 12.0);
    const DOWN: Pos2 = pos2(12.0, 40.0);

    fn button(pos: Pos2, pressed: bool) -> Event {
        Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::default() }
    }

    fn touch(id: u64, phase: TouchPhase, pos: Pos2) -> Event {
        Event::Touch { device_id: TouchDeviceId(0), id: TouchId(id), phase, pos, force: None }
    }

    /// What a finger's way is to a browser.
    fn swipe(to: Pos2) -> Vec<Event> {
        let start = [button(A, true), touch(1, TouchPhase::Start, A)];
        let moved = [Event::PointerMoved(to), touch(1, TouchPhase::Move, to)];
        let end = [button(to, false), Event::PointerGone, touch(1, TouchPhase::End, to)];
        [&start[..], &moved, &end].concat()
    }

    /// The passes that events come in, without the touches.
    fn passes(events: Vec<Event>, turns: bool) -> Vec<Vec<Event>> {
        let mut queue = Queue::default();
        queue.extend(events, false);
        let mut passes = Vec::new();
        while queue.is_waiting() {
            let mut pass = queue.next(|_| turns, false);
            pass.retain(|event| !matches!(event, Event::Touch { .. }));
            passes.push(pass);
            assert!(passes.len() < 20, "it never ends: {passes:?}");
        }
        passes
    }

    #[test]
    fn a_press_its_movement_and_its_release_each_get_a_pass() {
        let moved = Event::PointerMoved;
        let events = vec![moved(A), button(A, true), moved(RIGHT), moved(DOWN), button(DOWN, false)];
        let expected = [vec![moved(A), button(A, true)], vec![moved(RIGHT), moved(DOWN)], vec![button(DOWN, false)]];
        assert_eq!(passes(events, true), expected);
    }

    #[test]
    fn keys_wait_for_what_gives_the_focus_and_it_waits_for_them() {
        let text = |letter: &str| Event::Text(letter.into());
        let key = |key| {
            let modifiers = Modifiers::default();
            Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
        };
        let click = [button(A, true), button(A, false)];
        let mut events = vec![Event::PointerMoved(A)];
        events.extend(click.clone());
        events.extend([text("1"), text("2"), key(Key::Tab), text("3"), key(Key::Enter)]);
        events.extend(click.clone());
        let expected = [
            vec![Event::PointerMoved(A), button(A, true)],
            vec![button(A, false)],
            vec![text("1"), text("2")],
            vec![key(Key::Tab)],
            vec![text("3")],
            vec![key(Key::Enter)],
            vec![button(A, true)],
            vec![button(A, false)],
        ];
        assert_eq!(passes(events, false), expected);
    }

    #[test]
    fn a_release_where_the_pointer_has_not_been_is_a_movement_first() {
        let moved = Event::PointerMoved;
        let events = vec![moved(A), button(A, true), button(RIGHT, false), moved(A)];
        let expected =
            [vec![moved(A), button(A, true)], vec![moved(RIGHT)], vec![button(RIGHT, false)], vec![moved(A)]];
        assert_eq!(passes(events, true), expected);
    }

    #[test]
    fn a_finger_turns_sideways_scrolls_up_and_down_and_taps() {
        let moved = Event::PointerMoved;
        let press = vec![moved(A), button(A, true)];
        let up = |at| vec![button(at, false), Event::PointerGone];
        assert_eq!(passes(swipe(RIGHT), true), [press.clone(), vec![moved(RIGHT)], up(RIGHT)]);
        assert_eq!(passes(swipe(A), true), [press.clone(), up(A)]);
        // Of a finger that scrolls there is no press.
        assert_eq!(passes(swipe(DOWN), true), [vec![moved(A), moved(DOWN)], up(DOWN)]);
        // Where nothing turns it is a press like any other.
        assert_eq!(passes(swipe(DOWN), false), [press, vec![moved(DOWN)], up(DOWN)]);
    }

    /// A browser tells of a finger as a pointer, in a pass of its own, and then as a touch.
    #[test]
    fn what_comes_twice_counts_once() {
        for (turns, to, presses) in [(true, DOWN, 0), (true, A, 1), (true, RIGHT, 1), (false, DOWN, 1)] {
            let mut queue = Queue::default();
            let mut told = Vec::new();
            let touch_start = [button(A, true), touch(1, TouchPhase::Start, A)];
            let touch_end = [button(to, false), Event::PointerGone, touch(1, TouchPhase::End, to)];
            let moved = [Event::PointerMoved(to), touch(1, TouchPhase::Move, to)];
            for batch in [&[button(A, true)][..], &touch_start, &moved, &[button(to, false)], &touch_end, &[], &[]] {
                queue.extend(batch.to_vec(), true);
                told.extend(queue.next(|_| turns, false));
            }
            let count = |pressed| {
                let same =
                    |event: &&Event| matches!(event, Event::PointerButton { pressed: now, .. } if *now == pressed);
                told.iter().filter(same).count()
            };
            assert_eq!((count(true), count(false)), (presses, 1), "{turns} {to:?}: {told:?}");
        }
    }

    /// Browsers copy to the clipboard only while they tell of a click.
    #[test]
    fn a_click_of_a_hand_that_trembles_is_over_at_once() {
        let mut queue = Queue::default();
        queue.extend(vec![Event::PointerMoved(A), button(A, true)], false);
        queue.next(|_| true, false);
        let near = pos2(12.0, 11.0);
        queue.extend(vec![Event::PointerMoved(near), button(near, false)], false);
        assert!(queue.next(|_| true, false).contains(&button(near, false)));
        // What is dragged waits for the movement.
        queue.extend(vec![Event::PointerMoved(A), button(A, true)], false);
        queue.next(|_| true, false);
        queue.extend(vec![Event::PointerMoved(near), button(near, false)], false);
        assert!(!queue.next(|_| true, true).contains(&button(near, false)));
    }

    #[test]
    fn two_fingers_are_no_swipe() {
        let mut queue = Queue::default();
        queue.extend(vec![button(A, true), touch(1, TouchPhase::Start, A)], false);
        assert!(!queue.next(|_| true, false).contains(&button(A, true)));
        queue.extend(vec![touch(2, TouchPhase::Start, DOWN), Event::PointerMoved(DOWN)], false);
        assert!(queue.next(|_| true, false).contains(&button(A, true)));
        assert_eq!(queue.swipe(), None);
    }

    #[test]
    fn what_the_system_takes_away_is_no_tap_and_ends_a_drag() {
        let mut queue = Queue::default();
        queue.extend(vec![button(A, true), touch(1, TouchPhase::Start, A), touch(1, TouchPhase::Cancel, A)], false);
        let events = queue.next(|_| true, false);
        assert!(!queue.is_waiting() && !events.iter().any(|event| matches!(event, Event::PointerButton { .. })));
        queue.extend(vec![button(A, true), touch(1, TouchPhase::Start, A)], false);
        queue.next(|_| false, false);
        queue.extend(vec![touch(1, TouchPhase::Cancel, A)], false);
        assert!(queue.next(|_| false, false).contains(&button(A, false)));
    }
}
