//! The keyboard's focus: F6 goes from region to region, and Tab after the last control leaves the app to the page around it.
//!
//! egui's own Tab goes round and round. So two stops that nobody sees stand before the first control and after the last
//! one; who comes to one of them wants to leave.

use eframe::egui::{Context, Event, Id, Key, Memory, Modifiers, Plugin, RawInput, Rect, Sense, Ui};

use crate::app::{regions, tree};

/// After the first request egui needs at most this many passes to make a tree.
const PASSES: u8 = 3;

/// An end of the app, as Tab goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum End {
    /// Before the first control.
    First,
    /// After the last one.
    Last,
}

impl End {
    fn stop(self) -> Id {
        Id::unique(("end of the app", self))
    }
}

pub(super) struct Focus {
    /// What gives the focus to the page; a window on a desktop has nothing around it.
    leave: Option<fn(End)>,
    /// The end at which the focus left last, until it is back on a control.
    left: Option<End>,
    /// Whether the stops are there in this pass.
    guarded: bool,
    /// F6 was pressed while there was no tree: whether backwards, and how many more passes to wait for one.
    waits: Option<(bool, u8)>,
}

impl Focus {
    /// With the way out that there is.
    pub(super) fn new(leave: Option<fn(End)>) -> Self {
        Self { leave, left: None, guarded: false, waits: None }
    }

    /// Gives the focus away at this end.
    fn go(&mut self, context: &Context, end: End) {
        context.memory_mut(|memory| {
            if let Some(focused) = memory.focused() {
                memory.surrender_focus(focused);
            }
        });
        self.left = Some(end);
        if let Some(leave) = self.leave {
            leave(end);
        }
        context.request_repaint();
    }

    /// Goes to the next region, or to the one before, once there is a tree to go by.
    fn next_region(&mut self, context: &Context, back: bool, passes: u8) {
        let items = tree::items(context);
        self.waits = (items.is_empty() && passes > 0).then(|| (back, passes - 1));
        if self.waits.is_some() {
            // On a desktop the tree is made only for those who want it.
            context.enable_accesskit();
        } else if let Some(node) = regions::next(&items, tree::focused(context), back)
            && let Some(id) = tree::widget(context, node)
        {
            context.memory_mut(|memory| memory.request_focus(id));
        }
        context.request_repaint();
    }
}

impl Plugin for Focus {
    fn debug_name(&self) -> &'static str {
        "Focus"
    }

    fn input_hook(&mut self, context: &Context, input: &mut RawInput) {
        let focused = context.memory(Memory::focused);
        if focused.is_some() {
            self.left = None;
        } else if self.leave.is_some() && self.left != Some(End::Last) {
            // Nothing here has the focus yet, so Shift+Tab goes back to where it came from. Only for one who went on at
            // the end it begins at the last control.
            let before = input.events.len();
            input.events.retain(|event| !is_back(event));
            if input.events.len() < before {
                self.go(context, End::First);
            }
        }
    }

    fn on_begin_pass(&mut self, ui: &mut Ui) {
        let context = ui.ctx().clone();
        let pressed = context.input_mut(|input| {
            let back = input.consume_key(Modifiers::SHIFT, Key::F6);
            (back || input.consume_key(Modifiers::NONE, Key::F6)).then_some((back, PASSES))
        });
        if let Some((back, passes)) = pressed.or(self.waits) {
            self.next_region(&context, back, passes);
        }
        let focused = context.memory(Memory::focused);
        // egui hands the focus on to the one before with the next pass.
        let left = [End::First, End::Last].into_iter().find(|end| focused == Some(end.stop()));
        if let Some(end) = left {
            self.go(&context, end);
        }
        self.guarded = self.leave.is_some() && focused.is_some() && left.is_none();
        self.stop(ui, End::First);
    }

    fn on_end_pass(&mut self, ui: &mut Ui) {
        self.stop(ui, End::Last);
        let context = ui.ctx().clone();
        if context.memory(Memory::focused) == Some(End::Last.stop()) {
            self.go(&context, End::Last);
        }
    }
}

impl Focus {
    /// Puts a stop here. It is nowhere on the screen, so that arrow keys do not find it.
    fn stop(&self, ui: &Ui, end: End) {
        if self.guarded {
            ui.interact(Rect::NOTHING, end.stop(), Sense::focusable_noninteractive());
        }
    }
}

/// Whether it is Shift+Tab.
fn is_back(event: &Event) -> bool {
    matches!(event, Event::Key { key: Key::Tab, pressed: true, modifiers, .. } if modifiers.shift_only())
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use eframe::egui::{Role, WidgetInfo, pos2, vec2};

    use super::*;

    thread_local! {
        static LEFT: Cell<Option<End>> = const { Cell::new(None) };
    }

    /// Three buttons in two regions.
    fn frame(context: &Context, key: Option<(Key, Modifiers)>) {
        let events =
            key.map(|(key, modifiers)| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers });
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0)));
        let input =
            RawInput { events: events.into_iter().collect(), screen_rect, focused: true, ..RawInput::default() };
        let output = context.run_ui(input, |ui| {
            for (index, region) in ["Bar", "Bar", "Canvas"].into_iter().enumerate() {
                let top = if region == "Bar" { 0.0 } else { 100.0 };
                regions::mark(ui, Rect::from_min_size(pos2(0.0, top), vec2(400.0, 100.0)), region);
                let rect = Rect::from_min_size(pos2(10.0 + 50.0 * index as f32, top + 10.0), vec2(40.0, 20.0));
                let button = ui.interact(rect, button(index), Sense::click());
                button.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Button {index}")));
            }
        });
        output.drop_without_applying_deltas();
    }

    fn button(index: usize) -> Id {
        Id::unique(("button", index))
    }

    fn app() -> Context {
        let context = Context::default();
        tree::install(&context);
        context.enable_accesskit();
        context.add_plugin(Focus::new(Some(|end| LEFT.set(Some(end)))));
        LEFT.set(None);
        frame(&context, None);
        context
    }

    /// The index of the button that has the focus after a key, and the end at which the focus has left.
    fn press(context: &Context, key: Key, modifiers: Modifiers) -> (Option<usize>, Option<End>) {
        LEFT.set(None);
        frame(context, Some((key, modifiers)));
        frame(context, None);
        let focused = context.memory(Memory::focused);
        ((0..3).find(|index| focused == Some(button(*index))), LEFT.get())
    }

    #[test]
    fn tab_goes_through_all_controls_and_then_leaves_at_the_end() {
        let context = app();
        let tab = || press(&context, Key::Tab, Modifiers::NONE);
        assert_eq!([tab(), tab(), tab()], [(Some(0), None), (Some(1), None), (Some(2), None)]);
        assert_eq!(tab(), (None, Some(End::Last)));
        // Back again it begins at the last one, and leaves before the first.
        let back = || press(&context, Key::Tab, Modifiers::SHIFT);
        assert_eq!([back(), back(), back()], [(Some(2), None), (Some(1), None), (Some(0), None)]);
        assert_eq!(back(), (None, Some(End::First)));
        // Who has come from there and has not gone on yet goes back there.
        assert_eq!(back(), (None, Some(End::First)));
        assert_eq!(press(&context, Key::Tab, Modifiers::NONE), (Some(0), None));
    }

    #[test]
    fn f6_goes_from_region_to_region() {
        let context = app();
        let mut go = |modifiers| press(&context, Key::F6, modifiers).0;
        assert_eq!([Modifiers::NONE; 3].map(&mut go), [Some(0), Some(2), Some(0)]);
        assert_eq!([Modifiers::SHIFT; 2].map(&mut go), [Some(2), Some(0)]);
    }
}
