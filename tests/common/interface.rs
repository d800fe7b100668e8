//! What the tests of the interface share: it is found by accessibility label and moved by real pointer events.

#![allow(dead_code, reason = "every test file takes only what it needs")]

use std::time::{Duration, Instant};

use eframe::egui::accesskit::{Role, Toggled};
use eframe::egui::{Key, Modifiers, Pos2, Theme, Vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, Node};
use tautline::app::{Start, Tautline};
use tautline::scenario::{Report, Scenario, presets};

/// Points of the screen per metre of the paper's robot at this window size; asserted in the drag test itself.
pub const SIZE: Vec2 = Vec2::new(1280.0, 800.0);
/// An analysis takes well under a second; a loaded machine gets a minute.
pub const PATIENCE: Duration = Duration::from_mins(1);

pub fn paper() -> Scenario {
    presets::PRESETS[0].scenario()
}

pub fn app_with(scenario: Scenario, size: Vec2, theme: Theme) -> Harness<'static, Tautline> {
    let start = Start { scenario: Some(scenario), ..Start::default() };
    build(start, size, theme)
}

pub fn app_started(start: Start) -> Harness<'static, Tautline> {
    build(start, SIZE, Theme::Light)
}

pub fn app_sized(start: Start, size: Vec2) -> Harness<'static, Tautline> {
    build(start, size, Theme::Dark)
}

/// An application whose textures are kept, so that pictures can be taken of it.
pub fn app_in_pictures(
    scenario: Scenario,
    size: Vec2,
    theme: Theme,
    renderer: impl egui_kittest::TestRenderer + 'static,
) -> Harness<'static, Tautline> {
    let start = Start { scenario: Some(scenario), ..Start::default() };
    let builder = Harness::builder().with_size(size).with_theme(theme).with_step_dt(1.0 / 60.0).renderer(renderer);
    builder.build_eframe(|context| Tautline::new(context, start))
}

fn build(start: Start, size: Vec2, theme: Theme) -> Harness<'static, Tautline> {
    let mut app = Harness::builder()
        .with_size(size)
        .with_theme(theme)
        .with_step_dt(1.0 / 60.0)
        .build_eframe(|context| Tautline::new(context, start));
    settle(&mut app);
    app
}

/// Steps until something with this in its label is there.
pub fn wait_for_label(app: &mut Harness<'static, Tautline>, label: &str) {
    let begun = Instant::now();
    while app.query_by_label_contains(label).is_none() {
        assert!(begun.elapsed() < PATIENCE, "no {label:?} after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(2));
        app.step();
    }
}

pub fn text_of(node: &Node<'_>) -> String {
    let node = node.accesskit_node();
    node.label().or_else(|| node.value()).unwrap_or_default()
}

/// Whether a text that follows `before` begins with a number that is `exact`, rounded to the digits that it has.
pub fn rounds(text: &str, before: &str, exact: f64) -> bool {
    let Some((_, rest)) = text.split_once(before) else { return false };
    let number: String = rest.chars().take_while(|c| c.is_ascii_digit() || "+-.".contains(*c)).collect();
    let decimals = number.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    // A full stop may end the sentence.
    let Ok(shown) = number.trim_end_matches('.').parse::<f64>() else { return false };
    let half = 0.5 * 10.0_f64.powi(-i32::try_from(decimals).expect("few digits"));
    let digits = number.chars().filter(char::is_ascii_digit).collect::<String>();
    let significant = digits.trim_start_matches('0').len();
    (shown - exact).abs() <= half * 1.000_001 && (1..=6).contains(&significant)
}

/// The label that contains `part`.
pub fn label(app: &Harness<'static, Tautline>, part: &str) -> String {
    text_of(&app.get_by_label_contains(part))
}

/// The large figure of the critical speed.
pub fn figure(app: &Harness<'static, Tautline>) -> String {
    let texts = app.get_all_by(|_| true).map(|node| text_of(&node));
    let is_figure = |text: &String| text.strip_suffix(" m/s").is_some_and(|number| number.parse::<f64>().is_ok());
    texts.into_iter().find(is_figure).expect("a critical speed")
}

pub fn app() -> Harness<'static, Tautline> {
    app_with(paper(), SIZE, Theme::Light)
}

/// Steps until the analysis on show belongs to the document as it is, and everything drawn knows it.
pub fn settle(app: &mut Harness<'static, Tautline>) {
    // One step takes the input in, the next carries the command out.
    app.run_steps(3);
    let begun = Instant::now();
    while !app.state().analysis().is_some_and(|analysis| analysis.current) {
        assert!(begun.elapsed() < PATIENCE, "no analysis after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(2));
        app.step();
    }
    app.run_steps(3);
}

/// Steps until `condition` holds.
pub fn wait(app: &mut Harness<'static, Tautline>, what: &str, condition: impl Fn(&Tautline) -> bool) {
    let begun = Instant::now();
    while !condition(app.state()) {
        assert!(begun.elapsed() < PATIENCE, "{what}: not after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(2));
        app.step();
    }
}

pub fn report(app: &Harness<'static, Tautline>) -> Report {
    app.state().analysis().expect("an analysis").report.clone()
}

/// What the core answers for the document, computed anew.
pub fn cold(scenario: &Scenario) -> Report {
    let (robot, motion) = scenario.to_robot().expect("physical");
    Report::analyze(&robot, &motion, 40.0)
}

pub fn drag(app: &mut Harness<'static, Tautline>, from: Pos2, to: Pos2) {
    app.hover_at(from);
    app.step();
    app.drag_at(from);
    app.step();
    for part in 1..=10_u8 {
        app.hover_at(from + (to - from) * (f32::from(part) / 10.0));
        app.step();
    }
    app.drop_at(to);
    app.step();
}

pub fn type_value(app: &mut Harness<'static, Tautline>, label: &str, text: &str) {
    reach(app, Role::SpinButton, label);
    app.get_by_role_and_label(Role::SpinButton, label).click();
    app.run_steps(2);
    let select_all = Modifiers::COMMAND;
    app.key_press_modifiers(select_all, Key::A);
    app.step();
    app.event(eframe::egui::Event::Text(text.into()));
    app.step();
    app.key_press(Key::Enter);
    settle(app);
}

/// Scrolls until this is in sight.
pub fn reach(app: &mut Harness<'static, Tautline>, role: Role, label: &str) {
    app.get_by_role_and_label(role, label).scroll_to_me();
    app.run_steps(20);
}

/// Opens all groups of controls.
pub fn open_groups(app: &mut Harness<'static, Tautline>) {
    for group in ["Motion", "Cables", "Rope", "Mass and gravity", "Damping", "Model"] {
        let open = |app: &Harness<'static, Tautline>| {
            app.get_by_role_and_label(Role::Button, group).accesskit_node().toggled() == Some(Toggled::True)
        };
        if !open(app) {
            reach(app, Role::Button, group);
            app.get_by_role_and_label(Role::Button, group).click();
            app.run_steps(3);
            assert!(open(app), "{group}");
        }
    }
}

/// Opens a plot in the column on the right; the dock has some of the same tabs.
pub fn open_plot(app: &mut Harness<'static, Tautline>, title: &str) {
    let group = match title {
        "Eigenvalues" | "Modes" | "Growth" => "This pose",
        "Along the line" | "Directions" => "Workspace",
        "Deviation" | "Tensions" | "Gain" | "Speed on the path" => "Flight",
        _ => "Model",
    };
    app.get_by_role_and_label(Role::RadioButton, group).click();
    app.run_steps(3);
    let tabs = app.get_all_by_role_and_label(Role::Tab, title);
    tabs.max_by(|a, b| a.rect().min.x.total_cmp(&b.rect().min.x)).expect("a tab").click();
    app.run_steps(3);
}
