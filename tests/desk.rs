//! What makes a robot one's own: ropes, cables from a spreadsheet, materials of single cables, hints.

#![cfg(feature = "app")]

use eframe::egui::accesskit::{Role, Toggled};
use eframe::egui::{Event, Key, Modifiers, OutputCommand, Theme};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use tautline::app::Tautline;
use tautline::robot::{OwnMaterial, Strain, TensionLaw};
use tautline::scenario::ropes::{Construction, Rope};
use tautline::scenario::{Scenario, presets};

use interface::{SIZE, app, app_with, cold, open_groups, paper, reach, report, settle, text_of, type_value};

#[path = "common/interface.rs"]
mod interface;

type App = Harness<'static, Tautline>;

fn press(app: &mut App, role: Role, label: &str) {
    reach(app, role, label);
    app.get_by_role_and_label(role, label).click();
    settle(app);
}

/// Chooses an entry of a list.
fn choose(app: &mut App, list: &str, entry: &str) {
    reach(app, Role::ComboBox, list);
    app.get_by_role_and_label(Role::ComboBox, list).click();
    app.run_steps(5);
    app.get_all_by_label(entry).last().expect("an entry").click();
    settle(app);
}

fn value(app: &App, role: Role, label: &str) -> String {
    app.get_by_role_and_label(role, label).accesskit_node().value().unwrap_or_default()
}

fn undo(app: &mut App) {
    // Apart from the step before by more than a second.
    app.run_steps(80);
    app.get_by_role_and_label(Role::Button, "Undo").click();
    settle(app);
}

fn scenario(app: &App) -> Scenario {
    app.state().scenario().clone()
}

/// The paper's robot as it is called once it is another one.
fn changed() -> Scenario {
    Scenario { name: Some("Paper robot, changed".into()), ..paper() }
}

fn notice(app: &App) -> String {
    app.state().notice().unwrap_or_default().to_owned()
}

#[test]
fn a_table_that_is_pasted_becomes_the_cables_in_one_step() {
    let mut app = app();
    let table =
        "x\ty\ttension\r\n-9,5\t5\tbalances\r\n9,5\t5\tbalances\r\n-9,5\t-5\t70\r\n9,5\t-5\t80\r\n0\t-6\t60\r\n";
    app.event(Event::Paste(table.into()));
    settle(&mut app);
    let cables = scenario(&app).cables;
    assert_eq!(cables.len(), 5, "{}", notice(&app));
    assert_eq!((cables[0].anchor, cables[0].tension), ([-9.5, 5.0], TensionLaw::Equilibrium));
    assert_eq!((cables[4].anchor, cables[4].tension), ([0.0, -6.0], TensionLaw::Constant(60.0)));
    assert_eq!(notice(&app), "5 cables are taken from the table.");
    assert_eq!(Scenario { cables: paper().cables, ..scenario(&app) }, changed(), "all else stays");
    app.get_by_role_and_label(Role::Button, "Undo").click();
    settle(&mut app);
    assert_eq!(scenario(&app), paper());
    app.get_by_role_and_label(Role::Button, "Redo").click();
    settle(&mut app);
    assert_eq!(scenario(&app).cables, cables);
}

#[test]
fn a_table_with_a_fault_changes_nothing_and_is_told() {
    let mut app = app();
    let pasted = |app: &mut App, text: &str| {
        app.event(Event::Paste(text.into()));
        settle(app);
        assert_eq!(scenario(app), paper());
        notice(app)
    };
    let rest = "9\t5\tbalances\n-9\t-5\t70\n9\t-5\t80\n";
    let told = pasted(&mut app, &format!("-9\tfive\tbalances\n{rest}"));
    assert_eq!(told, "Row 1, column y: \"five\" must be a number in m.");
    // What the table itself cannot know is told in the words of the robot.
    let told = pasted(&mut app, &format!("9\t5\tbalances\n{rest}"));
    assert_eq!(told, "Winch 2 must not be where winch 1 is.");
    assert!(app.get_by_role_and_label(Role::Button, "Undo").accesskit_node().is_disabled(), "there is nothing to undo");
}

#[test]
fn the_table_is_copied_as_it_is_pasted() {
    let mut app = app();
    reach(&mut app, Role::Button, "Copy the cables");
    app.get_by_role_and_label(Role::Button, "Copy the cables").click();
    let mut copied = None;
    for _ in 0..5 {
        app.step();
        let commands = &app.output().platform_output.commands;
        copied = copied.or(commands.iter().find_map(|command| match command {
            OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        }));
    }
    let copied = copied.expect("a text for the clipboard");
    assert!(copied.starts_with("number\tx\ty\ttension\n1\t-10\t5\tbalances\n"), "{copied}");
    assert_eq!(notice(&app), "The table of cables is on the clipboard.");
    app.event(Event::Paste(copied.replace("-10\t5", "-11\t5")));
    settle(&mut app);
    let mut wanted = changed();
    wanted.cables[0].anchor = [-11.0, 5.0];
    assert_eq!(scenario(&app), wanted);
}

#[test]
fn a_rope_sets_three_values_and_is_known_until_one_is_turned() {
    let mut app = app();
    open_groups(&mut app);
    assert_eq!(value(&app, Role::ComboBox, "Construction"), "own values");
    choose(&mut app, "Construction", "steel 6×19");
    // The cross-section is kept to a tenth of a millimetre: 0.357 d² = 0.5 cm².
    let rope = Rope { construction: Construction::Steel6x19, diameter: 11.8e-3 };
    assert_eq!(Rope::of(&scenario(&app).cable), Some(rope));
    assert_eq!(value(&app, Role::ComboBox, "Construction"), "steel 6×19");
    undo(&mut app);
    assert_eq!(scenario(&app), paper(), "one step");
    choose(&mut app, "Construction", "steel 6×19");
    type_value(&mut app, "Diameter d", "6");
    let material = scenario(&app).cable;
    // EN 12385-4 by hand: 0.357 · 36 mm², 0.346 · 36 kg per 100 m.
    assert!((material.area - 12.852e-6).abs() < 1e-12 && (material.mass_per_length - 0.124_56).abs() < 1e-12);
    // Another construction keeps the diameter.
    choose(&mut app, "Construction", "polyester");
    let polyester = Some(Rope { construction: Construction::Polyester, diameter: 6e-3 });
    assert_eq!(Rope::of(&scenario(&app).cable), polyester);
    type_value(&mut app, "Diameter d", "-1");
    assert_eq!(Rope::of(&scenario(&app).cable), polyester, "refused");
    type_value(&mut app, "Young's modulus E", "3 GPa");
    assert_eq!(value(&app, Role::ComboBox, "Construction"), "own values");
    assert!(app.query_by_role_and_label(Role::SpinButton, "Diameter d").is_none());
}

#[test]
fn the_folded_group_names_the_rope() {
    let rope = Rope { construction: Construction::Dyneema, diameter: 4e-3 };
    let mut scenario = paper();
    scenario.cable.youngs_modulus = rope.youngs_modulus();
    scenario.cable.area = rope.area();
    scenario.cable.mass_per_length = rope.mass_per_length();
    let app = app_with(scenario, SIZE, Theme::Light);
    assert_eq!(value(&app, Role::Button, "Rope"), "Dyneema SK78, 4 mm");
}

#[test]
fn a_cable_has_a_material_of_its_own() {
    let mut app = app();
    let before = report(&app).critical.expect("a critical speed").speed;
    press(&mut app, Role::Button, "Cable 3");
    assert!(!value(&app, Role::Button, "Cable 3").contains("own material"));
    press(&mut app, Role::CheckBox, "Own material");
    let all = OwnMaterial {
        youngs_modulus: Some(125e6),
        area: Some(5e-5),
        mass_per_length: Some(0.4),
        strain: Some(Strain::Green),
    };
    assert_eq!(scenario(&app).cables[2].cable, all);
    assert!(value(&app, Role::Button, "Cable 3").ends_with(", own material"));
    type_value(&mut app, "μ of cable 3", "0.6");
    let mut wanted = changed();
    wanted.cables[2].cable = OwnMaterial { mass_per_length: Some(0.6), ..all };
    assert_eq!(scenario(&app), wanted);
    let after = report(&app).critical.expect("a critical speed").speed;
    assert!((after - before).abs() > 0.01 * before, "{before} {after}");
    assert!((after - cold(&wanted).critical.expect("one").speed).abs() < 1e-9);
    // A value that is taken away is that of all cables again.
    press(&mut app, Role::Button, "Reset E of cable 3");
    wanted.cables[2].cable.youngs_modulus = None;
    assert_eq!(scenario(&app), wanted);
    type_value(&mut app, "E of cable 3", "130");
    wanted.cables[2].cable.youngs_modulus = Some(130e6);
    assert_eq!(scenario(&app), wanted);
    type_value(&mut app, "E of cable 3", "-1");
    assert_eq!(scenario(&app), wanted, "refused");
    choose(&mut app, "Strain of cable 3", "engineering");
    wanted.cables[2].cable.strain = Some(Strain::Engineering);
    assert_eq!(scenario(&app), wanted);
    choose(&mut app, "Construction of cable 3", "nylon");
    let rope = Rope::of(&scenario(&app).material_of(2)).expect("a rope");
    assert_eq!(rope.construction, Construction::Nylon);
    assert_eq!(scenario(&app).cable, paper().cable, "the others stay as they are");
    press(&mut app, Role::CheckBox, "Own material");
    assert_eq!(scenario(&app), paper());
}

#[test]
fn a_hint_is_told_quietly_and_leads_to_its_number() {
    const HINT: &str = "E is 125 Pa: MPa meant?";
    let mut app = app();
    open_groups(&mut app);
    type_value(&mut app, "Young's modulus E", "125 Pa");
    assert!(value(&app, Role::Button, "Plausible?").contains("hint"));
    assert!(app.query_by_role_and_label(Role::Button, HINT).is_none(), "folded");
    press(&mut app, Role::Button, "Plausible?");
    let group = app.get_by_role_and_label(Role::Button, "Plausible?").accesskit_node().toggled();
    assert_eq!(group, Some(Toggled::True));
    // It refuses nothing.
    assert_eq!(scenario(&app).cable.youngs_modulus.to_bits(), 125.0_f64.to_bits());
    // The group of the number is folded; the hint opens it.
    press(&mut app, Role::Button, "Rope");
    assert!(app.query_by_role_and_label(Role::SpinButton, "Young's modulus E").is_none());
    press(&mut app, Role::Button, HINT);
    app.run_steps(10);
    #[expect(clippy::redundant_closure_for_method_calls)] // The method's lifetime is too narrow.
    let focused = app.get_all_by(|node| node.is_focused()).map(|node| text_of(&node)).collect::<Vec<_>>();
    assert!(focused.iter().any(|text| text.starts_with("Young's modulus")), "{focused:?}");
}

/// The table of hints stays short and true for what the program itself offers.
#[test]
fn the_built_in_robots_open_without_alarm() {
    for preset in presets::PRESETS {
        let app = app_with(preset.scenario(), SIZE, Theme::Light);
        let told = value(&app, Role::Button, "Plausible?");
        println!("{}: {told}", preset.name);
        assert!(
            ["nothing unusual", "1 hint", "2 hints", "3 hints"].contains(&told.as_str()),
            "{}: {told}",
            preset.name
        );
    }
}

/// Texts in a field are the field's, tables included.
#[test]
fn a_table_pasted_into_a_field_is_no_robot() {
    let mut app = app();
    reach(&mut app, Role::SpinButton, "Speed v");
    app.get_by_role_and_label(Role::SpinButton, "Speed v").click();
    app.run_steps(2);
    app.key_press_modifiers(Modifiers::COMMAND, Key::A);
    app.event(Event::Paste("-9;5;balances\n9;5;balances\n0;-5;70".into()));
    app.run_steps(3);
    assert_eq!(scenario(&app), paper());
}

/// Four clicks make a robot that can be analysed; a winch that is dragged or typed is where it was put; one step of undo
/// brings the robot of before back.
#[test]
fn a_new_robot_starts_from_winch_points_that_are_clicked() {
    let mut app = app();
    app.get_by_role_and_label(Role::ComboBox, "Robot").click();
    app.run_steps(5);
    app.get_by_role_and_label(Role::Button, "New robot …").click();
    app.run_steps(5);
    let make = |app: &App| app.get_by_role_and_label(Role::Button, "Make the robot").accesskit_node().is_disabled();
    assert!(make(&app), "there are no winches yet");
    let area = app.get_by_role_and_label(Role::Canvas, "Area for winches").rect();
    let inner = area.shrink(16.0);
    // In metres of an area that is 20 m wide.
    let at = |x: f32, y: f32| inner.center() + eframe::egui::vec2(x, -y) * (inner.width() / 20.0);
    let click = |app: &mut App, at| {
        app.hover_at(at);
        app.step();
        app.drag_at(at);
        app.step();
        app.drop_at(at);
        app.run_steps(2);
    };
    for (x, y) in [(-8.0, 4.0), (8.0, 4.0), (-8.0, -4.0), (7.0, -4.0)] {
        click(&mut app, at(x, y));
    }
    assert_eq!(app.get_by_role_and_label(Role::Canvas, "Area for winches").rect(), area, "it moves under the hand");
    app.get_by_label("4 cables");
    interface::drag(&mut app, at(7.0, -4.0), at(8.1, -4.1));
    let cable_two = |app: &mut App, text: &str| {
        type_value(app, "Winch 2 x", text);
    };
    cable_two(&mut app, "7.25 m");
    press(&mut app, Role::Button, "Make the robot");
    assert!(app.query_by_label("Area for winches").is_none(), "the window closes");
    let made = scenario(&app);
    let anchors: Vec<[f64; 2]> = made.cables.iter().map(|cable| cable.anchor).collect();
    assert_eq!(anchors, [[-8.0, 4.0], [7.25, 4.0], [-8.0, -4.0], [8.0, -4.0]]);
    assert_eq!(made.name.as_deref(), Some("My robot"));
    assert_eq!(report(&app).feasible, Some(true));
    undo(&mut app);
    assert_eq!(scenario(&app), paper());
}
