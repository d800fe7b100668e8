//! Designs that are kept beside the present one, and names of changed robots, as people use them.

#[path = "common/interface.rs"]
mod interface;

use eframe::egui::accesskit::Role;
use eframe::egui::{Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use interface::{app, app_with, paper, settle, type_value};
use tautline::app::Tautline;

fn press(app: &mut Harness<'static, Tautline>, name: &str) {
    app.get_by_role_and_label(Role::Button, name).click();
    app.run_steps(4);
}

fn name(app: &Harness<'static, Tautline>) -> String {
    app.state().scenario().name.clone().expect("a name")
}

/// Letters and masses of the designs that are kept.
fn kept(app: &Harness<'static, Tautline>) -> Vec<(&'static str, f64)> {
    app.state().designs().iter().map(|(letter, scenario, _)| (*letter, scenario.platform.mass)).collect()
}

fn mass(app: &mut Harness<'static, Tautline>, text: &str) {
    interface::open_groups(app);
    type_value(app, "Platform mass m", text);
}

#[test]
fn a_changed_robot_has_a_name_of_its_own_until_it_is_as_it_was() {
    let mut app = app();
    assert_eq!(name(&app), "Paper robot");
    mass(&mut app, "3");
    assert_eq!(name(&app), "Paper robot, changed");
    let bar = app.get_by_role_and_label(Role::ComboBox, "Robot").accesskit_node().value();
    assert_eq!(bar.as_deref(), Some("Paper robot, changed"));
    press(&mut app, "Undo");
    settle(&mut app);
    assert_eq!(app.state().scenario(), &paper());
}

#[test]
fn a_kept_design_and_the_present_one_change_places_in_one_step_of_undo() {
    let mut app = app();
    press(&mut app, "Keep");
    mass(&mut app, "3");
    press(&mut app, "Keep");
    interface::wait(&mut app, "the designs", |app| app.designs().iter().all(|(_, _, complete)| *complete));
    assert_eq!(kept(&app), [("A", 2.0), ("B", 3.0)]);
    mass(&mut app, "4");
    press(&mut app, "Designs");
    // The table of what differs.
    for text in ["4 kg", "2 kg", "3 kg"] {
        assert!(app.query_all_by_label(text).next().is_some(), "{text}");
    }
    press(&mut app, "Work on A");
    settle(&mut app);
    assert_eq!((app.state().scenario(), kept(&app)), (&paper(), vec![("A", 4.0), ("B", 3.0)]));
    // Its critical speed is that of a start in it.
    let speed = interface::report(&app).critical.expect("a critical speed").speed;
    let cold = interface::cold(&paper()).critical.expect("a critical speed").speed;
    assert!((speed - cold).abs() < 1e-9, "{speed} {cold}");
    press(&mut app, "Exchange A and B");
    assert_eq!(kept(&app), [("A", 3.0), ("B", 4.0)]);
    press(&mut app, "Undo");
    settle(&mut app);
    assert!((app.state().scenario().platform.mass - 4.0).abs() < 1e-12, "undo is about the document");
    assert_eq!(kept(&app), [("A", 3.0), ("B", 4.0)]);
    press(&mut app, "Remove A");
    assert_eq!(kept(&app), [("B", 4.0)]);
}

#[test]
fn a_fifth_design_is_refused_in_words() {
    let mut app = app();
    for _ in 0..5 {
        press(&mut app, "Keep");
    }
    assert_eq!(kept(&app).len(), 4);
    assert!(app.state().notice().is_some_and(|notice| notice.contains("A to D are all taken")));
}

#[test]
fn the_window_of_designs_fits_a_phone() {
    let mut app = app_with(paper(), Vec2::new(360.0, 740.0), Theme::Light);
    for entry in ["Keep this design", "Designs"] {
        press(&mut app, "More");
        app.get_by_label_contains(entry).click();
        app.run_steps(5);
    }
    for button in ["Work on A", "Remove A", "Keep as the next letter"] {
        let rect = app.get_by_role_and_label(Role::Button, button).rect();
        assert!(rect.min.x >= 0.0 && rect.max.x <= 360.0, "{button}: {rect:?}");
    }
}
