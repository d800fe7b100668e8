//! The plot "What if": a number, a range, a value set by a click, a wanted critical speed, two numbers.

#![cfg(feature = "app")]
#![expect(clippy::float_cmp, reason = "values that are taken back are the same to the last bit")]

#[path = "common/interface.rs"]
mod interface;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use tautline::app::Tautline;
use tautline::compute::protocol::Topic;

use interface::{app, cold, open_plot, settle, text_of, type_value, wait, wait_for_label};

type App = Harness<'static, Tautline>;

fn mass(app: &App) -> f64 {
    app.state().scenario().platform.mass
}

/// Chooses an entry of a list of numbers.
fn choose(app: &mut App, list: &str, entry: &str) {
    app.get_by_role_and_label(Role::ComboBox, list).click();
    app.run_steps(3);
    app.get_by_role_and_label(Role::Button, entry).click();
    finish(app);
}

/// Waits for the study.
fn finish(app: &mut App) {
    app.run_steps(6);
    wait(app, "the study", |app| !app.at_work().contains(&Topic::WhatIf) && app.study(Topic::WhatIf).2);
    app.run_steps(6);
}

/// The plot with its sentence.
fn told(app: &App) -> (String, Pos2) {
    let node = app
        .get_by(|node| node.role() == Role::Image && node.label().is_some_and(|label| label.starts_with("What if: ")));
    (text_of(&node), node.rect().center())
}

fn with_mass() -> App {
    let mut app = app();
    open_plot(&mut app, "What if");
    finish(&mut app);
    choose(&mut app, "Number to vary", "Platform mass m");
    app
}

fn undo(app: &mut App) {
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(app);
}

#[test]
fn a_number_is_varied_over_a_range_and_a_click_sets_it() {
    let mut app = with_mass();
    let (text, at) = told(&app);
    assert!(text.starts_with("What if: Platform mass m from 1 kg to 4 kg. Critical from "), "{text}");
    let before = app.state().scenario().clone();
    app.hover_at(at + Vec2::new(30.0, -10.0));
    app.step();
    app.drag_at(at + Vec2::new(30.0, -10.0));
    app.step();
    app.drop_at(at + Vec2::new(30.0, -10.0));
    settle(&mut app);
    assert!(mass(&app) != before.platform.mass && (1.0..4.0).contains(&mass(&app)), "{}", mass(&app));
    // What the study varies does not begin it anew.
    assert!(app.state().study(Topic::WhatIf).2);
    undo(&mut app);
    assert_eq!(*app.state().scenario(), before, "one step");

    type_value(&mut app, "to", "10");
    finish(&mut app);
    assert!(told(&app).0.starts_with("What if: Platform mass m from 1 kg to 10 kg. "), "{}", told(&app).0);
    app.get_by_role_and_label(Role::Button, "Fit What if").click();
    finish(&mut app);
    assert!(told(&app).0.starts_with("What if: Platform mass m from 1 kg to 4 kg. "), "{}", told(&app).0);
    // Values that are not allowed are gaps.
    type_value(&mut app, "from", "-1");
    finish(&mut app);
    assert!(told(&app).0.contains("No equilibrium or not allowed from −1 kg to "), "{}", told(&app).0);
}

#[test]
fn a_wanted_critical_speed_is_taken_in_one_step_or_out_of_reach() {
    let mut app = with_mass();
    let before = app.state().scenario().clone();
    let mut heavier = before.clone();
    heavier.platform.mass = 2.5;
    let wanted = (cold(&heavier).critical.expect("a critical speed").speed * 1e3).round() / 1e3;
    type_value(&mut app, "Critical speed", &wanted.to_string());
    wait_for_label(&mut app, " gives ");
    app.get_by_role_and_label(Role::Button, "Take it").click();
    settle(&mut app);
    let speed = cold(app.state().scenario()).critical.expect("a critical speed").speed;
    assert!((speed - wanted).abs() <= 1e-6 * wanted, "{speed} for {wanted}");
    app.run_steps(3);
    assert!(app.query_by_role_and_label(Role::Button, "Take it").is_none(), "it is taken");
    undo(&mut app);
    assert_eq!(*app.state().scenario(), before, "one step");
    type_value(&mut app, "Critical speed", "39");
    wait_for_label(&mut app, "No value between 1 kg and 4 kg reaches 39");
}

#[test]
fn two_numbers_are_a_map_and_a_click_sets_both() {
    let mut app = with_mass();
    choose(&mut app, "Second number to vary", "Gravity g");
    let (text, at) = told(&app);
    assert!(text.starts_with("What if: the critical speed over Platform mass m from "), "{text}");
    assert_eq!(app.state().study(Topic::WhatIf).1, 31 * 21);
    let before = app.state().scenario().clone();
    let at = at + Vec2::new(25.0, -15.0);
    app.hover_at(at);
    app.step();
    app.drag_at(at);
    app.step();
    app.drop_at(at);
    settle(&mut app);
    let after = app.state().scenario().clone();
    assert!(after.platform.mass != before.platform.mass && after.gravity != before.gravity);
    undo(&mut app);
    assert_eq!(*app.state().scenario(), before, "one step");
}

#[test]
fn a_bar_of_what_to_change_opens_it_with_its_number() {
    let mut app = app();
    open_plot(&mut app, "What to change");
    wait_for_label(&mut app, "A, area: ");
    app.get_by_role_and_label(Role::Button, "What if m, platform").click();
    finish(&mut app);
    assert!(told(&app).0.starts_with("What if: Platform mass m from "), "{}", told(&app).0);
}
