//! Panels: only a person changes their width, and nothing in them is out of reach.

#![cfg(feature = "app")]

use std::collections::BTreeSet;

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, Rect, Theme, TouchPhase, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use tautline::app::Tautline;
use tautline::scenario::presets;

use interface::{app_with, drag, paper, settle, type_value};

#[path = "common/interface.rs"]
mod interface;

type App = Harness<'static, Tautline>;

const TABS: [&str; 8] =
    ["Eigenvalues", "Growth rate", "Modes", "Along the line", "Directions", "Campbell", "Mesh", "Knobs"];

fn open(app: &mut App, tab: &str) {
    {
        let mut all = app.get_all_by_label(tab).filter(|node| node.accesskit_node().role() == Role::Button);
        // The tabs are below whatever else has such a name.
        let tab = all.next_back().expect("a tab");
        tab.scroll_to_me();
        tab.click();
    }
    app.run_steps(10);
}

/// From the left panel to the right one.
fn between(app: &App) -> [f32; 2] {
    let canvas = app.get_by_label("Robot canvas").rect();
    [canvas.min.x, canvas.max.x]
}

#[test]
fn no_content_changes_a_panels_width() {
    for width in [800.0, 1024.0, 1280.0, 1920.0] {
        let mut app = app_with(paper(), Vec2::new(width, 700.0), Theme::Light);
        if width > 1000.0 {
            // As a person sets them.
            for (i, by) in [(0, 11.0), (1, -7.0)] {
                let edge = Pos2::new(between(&app)[i] + [-1.0, 1.0][i], 500.0);
                drag(&mut app, edge, edge + Vec2::new(by, 0.0));
                settle(&mut app);
            }
        }
        let set = between(&app);
        let same = |app: &App, what: &str| {
            let now = between(app);
            assert!(now.iter().zip(set).all(|(now, set)| (now - set).abs() < 0.5), "{width}, {what}: {set:?} {now:?}");
        };
        let mut names: Vec<&str> = presets::PRESETS.iter().map(|preset| preset.title).collect();
        // The list is read from the top, where it is opened.
        names.rotate_left(1);
        for name in names {
            app.get_by_role_and_label(Role::ComboBox, "Robot").click();
            app.run_steps(5);
            app.get_all_by_label(name).last().expect("an entry").click();
            settle(&mut app);
            app.run_steps(5);
            same(&app, name);
        }
        for (field, typed) in
            [("Speed v", "1e6"), ("Speed v", "1.234567890123456"), ("Young's modulus E", "9.87654321e9")]
        {
            type_value(&mut app, field, typed);
            app.run_steps(5);
            same(&app, typed);
        }
        type_value(&mut app, "Speed v", "123456.789012");
        app.get_by_role_and_label(Role::Button, "Pin").click();
        settle(&mut app);
        type_value(&mut app, "Platform mass m", "3");
        for tab in TABS {
            open(&mut app, tab);
            same(&app, tab);
        }
    }
}

#[test]
fn long_names_do_not_change_a_panels_width() {
    let usual = between(&app_with(paper(), Vec2::new(1280.0, 700.0), Theme::Light));
    let mut scenario = paper();
    scenario.name = Some("Donaudampfschifffahrtsgesellschaftskapitän ".repeat(8));
    let app = app_with(scenario, Vec2::new(1280.0, 700.0), Theme::Light);
    assert!(between(&app).iter().zip(usual).all(|(now, usual)| (now - usual).abs() < 0.5), "{usual:?}");
}

#[test]
fn the_edges_of_panels_can_be_dragged_and_the_canvas_keeps_some_room() {
    let mut app = app_with(paper(), Vec2::new(1280.0, 700.0), Theme::Light);
    let [left, right] = between(&app);
    let at = |x| Pos2::new(x, 500.0);
    drag(&mut app, at(left - 1.0), at(left + 59.0));
    settle(&mut app);
    let [wider, same] = between(&app);
    assert!((wider - left - 60.0).abs() < 2.0 && (same - right).abs() < 0.5, "{left} {wider}, {right} {same}");
    // Neither edge pushes the other one, nor the canvas out.
    drag(&mut app, at(right + 1.0), at(200.0));
    settle(&mut app);
    let [from, to] = between(&app);
    assert!((from - wider).abs() < 0.5 && to - from >= 315.0, "{from} {to}");
    drag(&mut app, at(from - 1.0), at(1200.0));
    settle(&mut app);
    let now = between(&app);
    assert!((now[0] - from).abs() + (now[1] - to).abs() < 0.5, "there is no room left: {now:?}");
}

fn wheel(app: &mut App, at: Pos2, by: f32) {
    app.event(Event::PointerMoved(at));
    app.step();
    for _ in 0..2 {
        app.event(Event::MouseWheel {
            unit: MouseWheelUnit::Point,
            delta: Vec2::new(0.0, by / 2.0),
            phase: TouchPhase::Move,
            source: MouseWheelSource::Unknown,
            modifiers: Modifiers::default(),
        });
        app.run_steps(15);
    }
}

/// What is in a part of the screen and beyond its upper and lower end: labels with their places.
fn contents(app: &App, part: Rect) -> Vec<(String, Rect)> {
    let known = [Role::Label, Role::Button, Role::Slider, Role::SpinButton, Role::ComboBox, Role::RadioButton];
    app.get_all_by(|node| known.contains(&node.role()))
        .map(|node| (node.accesskit_node().label().unwrap_or_default(), node.rect()))
        .filter(|(label, rect)| !label.is_empty() && part.x_range().contains(rect.center().x))
        .collect()
}

#[test]
fn nothing_is_out_of_reach_on_low_screens() {
    for size in [Vec2::new(1366.0, 625.0), Vec2::new(1280.0, 720.0)] {
        let mut app = app_with(paper(), size, Theme::Dark);
        let [left, right] = between(&app);
        let screen = Rect::from_min_size(Pos2::ZERO, size);
        let panels = [
            Rect::from_min_max(Pos2::ZERO, Pos2::new(left, size.y)),
            Rect::from_min_max(Pos2::new(right, 0.0), size.to_pos2()),
        ];
        for (panel, tab) in panels.iter().zip(["", "x"]).flat_map(|(panel, kind)| {
            let tabs: &[&str] = if kind.is_empty() { &[""] } else { &TABS };
            tabs.iter().map(move |tab| (*panel, *tab))
        }) {
            if !tab.is_empty() {
                open(&mut app, tab);
                settle(&mut app);
            }
            // Over its lower end, which is a plot on the right.
            let at = Pos2::new(panel.center().x, size.y - 60.0);
            wheel(&mut app, at, 4000.0);
            let mut beyond: BTreeSet<String> = BTreeSet::new();
            let mut seen: BTreeSet<String> = BTreeSet::new();
            for _ in 0..12 {
                for (label, rect) in contents(&app, panel) {
                    if screen.expand(0.5).contains_rect(rect) {
                        seen.insert(label)
                    } else {
                        beyond.insert(label)
                    };
                }
                wheel(&mut app, at, -160.0);
            }
            let never: Vec<&String> = beyond.difference(&seen).collect();
            assert!(never.is_empty() && seen.len() > 8, "{size:?} {tab}: {never:?} of {}", seen.len());
        }
    }
}

#[test]
fn plots_shrink_to_a_sensible_height_and_then_the_panel_scrolls() {
    for (size, moves) in [(Vec2::new(1366.0, 480.0), true), (Vec2::new(1280.0, 1000.0), false)] {
        let mut app = app_with(paper(), size, Theme::Light);
        open(&mut app, "Campbell");
        interface::wait(&mut app, "a study", |app| app.study(tautline::compute::protocol::Topic::Campbell).2);
        app.run_steps(10);
        let top = |app: &App| app.get_by_role_and_label(Role::Button, "Campbell").rect().min.y;
        let before = top(&app);
        wheel(&mut app, Pos2::new(size.x - 150.0, size.y - 60.0), -3000.0);
        let moved = before - top(&app);
        assert_eq!(moved > 20.0, moves, "{size:?}: {moved}");
        // At the end there is the lower plot: a click on it sets the speed.
        for pressed in [true, false] {
            let (pos, modifiers) = (Pos2::new(size.x - 100.0, size.y - 90.0), Modifiers::default());
            let button = eframe::egui::PointerButton::Primary;
            app.event(Event::PointerMoved(pos));
            app.event(Event::PointerButton { pos, button, pressed, modifiers });
            app.step();
        }
        settle(&mut app);
        let speed = app.state().scenario().motion.speed;
        assert!((5.5..15.0).contains(&speed), "{size:?}: {speed}");
    }
}
