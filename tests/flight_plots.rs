//! The plots of a move along a path: what they show and say, what a click sets, and what they need.
//!
//! With `TAUTLINE_PICTURES=FOLDER` pictures of them are written there to be looked at.

#![cfg(feature = "app")]

use std::path::PathBuf;
use std::time::{Duration, Instant};

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use tautline::app::Tautline;
use tautline::compute::protocol::Topic;
use tautline::scenario::Scenario;

use interface::{SIZE, app, app_in_pictures, app_with, open_plot, paper, settle, text_of, wait, wait_for_label};
use picture::{Textures, picture, write};

#[path = "common/interface.rs"]
mod interface;
#[path = "common/picture.rs"]
mod picture;

type App = Harness<'static, Tautline>;

/// The paper's robot on its way from x = −6 to 6 m, with this profile and peak speed (m/s).
fn moved(profile: &str, speed: f64) -> Scenario {
    let mut file: serde_json::Value = serde_json::from_str(&paper().to_json()).expect("JSON");
    file["schema"] = "tautline/scenario/2".into();
    file["motion"]["position"] = serde_json::json!([-6.0, 0.0]);
    file["path"] = serde_json::json!({ "points": [[6.0, 0.0]], "profile": profile, "speed": speed, "hold": 1.5 });
    if profile == "constant" {
        file["path"]["hold"] = 0.0.into();
    }
    Scenario::from_json(&file.to_string()).expect("a scenario")
}

/// The longest wait: tests may run without optimisation on a machine that has other work.
const PATIENCE: Duration = Duration::from_mins(5);

fn finish(app: &mut App, topics: &[Topic]) {
    app.run_steps(6);
    let begun = Instant::now();
    let ready = |app: &Tautline| topics.iter().all(|topic| !app.at_work().contains(topic) && app.study(*topic).2);
    while !ready(app.state()) {
        assert!(begun.elapsed() < PATIENCE, "{topics:?}: not after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(2));
        app.step();
    }
    app.run_steps(6);
}

/// The sentence of the plot whose sentence begins like this.
fn told(app: &App, begin: &str) -> String {
    let is = |label: Option<String>| label.is_some_and(|label| label.starts_with(begin));
    let mut all = app.get_all_by(|node| node.role() == Role::Image && is(node.label()));
    text_of(&all.next().expect("a plot"))
}

/// The largest deviations are those of an independent program, to the three digits that are shown.
#[test]
fn a_flight_is_told_with_its_deviation_tensions_and_stop() {
    let mut app = app_with(moved("quintic", 5.0), SIZE, Theme::Light);
    open_plot(&mut app, "Deviation");
    finish(&mut app, &[Topic::Flight]);
    let text = told(&app, "Deviation: ");
    for part in ["off its path by 102 mm at most, 45", "The move takes 4.50 s. No cable goes slack."] {
        assert!(text.contains(part), "{part:?} is not in {text:?}");
    }
    open_plot(&mut app, "Tensions");
    app.run_steps(6);
    assert!(told(&app, "Tensions: ").ends_with("No cable goes slack."));
    app.get_by_label("What am I seeing?").click();
    app.run_steps(6);
    wait_for_label(&mut app, "In this flight: cable 1 from ");

    let mut fast = app_with(moved("quintic", 7.0), SIZE, Theme::Light);
    open_plot(&mut fast, "Deviation");
    finish(&mut fast, &[Topic::Flight]);
    let text = told(&fast, "Deviation: ");
    assert!(text.contains("234 mm at most") && text.contains("Cable 4 goes slack at 2."), "{text}");
}

#[test]
fn the_speed_on_the_path_is_under_the_robot_with_both_limits() {
    let mut app = app_with(moved("quintic", 7.0), SIZE, Theme::Light);
    finish(&mut app, &[Topic::Path, Topic::Move]);
    let text = told(&app, "Speed on the path: ");
    // The least frozen critical speed and wave limit of docs/theory.md: both at the beginning.
    for part in [
        "up to 7.00 m/s",
        "The frozen critical speed is at least 4.88 m/s, x = −6.0 m.",
        "The wave limit is at least 9.16 m/s, x = −6.0 m.",
        "This move is at 59 % of the wave limit at most",
        "so nothing grows without bound",
    ] {
        assert!(text.contains(part), "{part:?} is not in {text:?}");
    }
    let tab = app.get_by_role_and_label(Role::Tab, "Speed on the path");
    assert!(tab.rect().center().y > 500.0, "under the robot");
}

#[test]
fn without_a_path_the_plots_offer_one() {
    let mut app = app();
    assert!(app.query_by_role_and_label(Role::Tab, "Speed on the path").is_none(), "nothing to see under the robot");
    let before = app.state().scenario().clone();
    for plot in ["Deviation", "Tensions", "Gain", "Speed on the path"] {
        open_plot(&mut app, plot);
        assert!(app.query_by_label_contains("There is no path yet").is_some(), "{plot}");
    }
    assert!(!app.state().at_work().iter().any(|topic| [Topic::Path, Topic::Move, Topic::Flight].contains(topic)));
    app.get_by_role_and_label(Role::Button, "Add a path").click();
    settle(&mut app);
    assert!(app.state().scenario().path.is_some());
    finish(&mut app, &[Topic::Path]);
    assert!(!told(&app, "Speed on the path: ").is_empty());
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut app);
    assert_eq!(*app.state().scenario(), before, "one step");
    assert!(app.query_by_label_contains("There is no path yet").is_some());
}

#[test]
fn a_click_on_the_gains_sets_the_peak_speed() {
    let mut app = app_with(moved("quintic", 5.0), SIZE, Theme::Light);
    open_plot(&mut app, "Gain");
    finish(&mut app, &[Topic::Move, Topic::Gains]);
    let text = told(&app, "Gain of the move");
    assert!(text.contains("The move reaches the wave limit at a peak of 11.8 m/s"), "{text}");
    let node = app.get_by(|node| {
        node.role() == Role::Image && node.label().is_some_and(|label| label.starts_with("Gain of the move"))
    });
    let at = node.rect().center() + Vec2::new(40.0, 0.0);
    app.hover_at(at);
    app.step();
    app.drag_at(at);
    app.step();
    app.drop_at(at);
    settle(&mut app);
    let speed = app.state().scenario().path.as_ref().expect("a path").speed;
    assert!(speed > 6.0 && speed < 15.0, "{speed}");
    // The speed that is set does not begin the study anew: it has its own.
    app.run_steps(6);
    finish(&mut app, &[Topic::Move]);
    assert!(app.state().study(Topic::Gains).2 && !app.state().at_work().contains(&Topic::Gains));
}

/// The quintic's largest acceleration is 10 D/(√3 T²), T = 15 D/(8 v): it keeps to 3 m/s² up to 4.68 m/s. At 3 m/s² half of
/// the way is sped up and half braked, in 2 √(D/a) with a peak of √(a D), which is below 80 % of every wave limit there.
#[test]
fn the_fastest_move_is_told_and_its_speed_can_be_used() {
    let mut app = app_with(moved("quintic", 7.0), SIZE, Theme::Light);
    open_fastest(&mut app);
    wait_for_label(&mut app, "4.00 s, up to 6.00 m/s");
    wait_for_label(&mut app, "is too fast for these limits. It keeps to them up to 4.68 m/s");
    let before = app.state().scenario().clone();
    app.get_by_role_and_label(Role::Button, "Use it").click();
    settle(&mut app);
    let speed = app.state().scenario().path.as_ref().expect("a path").speed;
    assert!((speed - 4.681).abs() < 2e-3, "{speed}");
    app.key_press(Key::Escape);
    app.run_steps(3);
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut app);
    assert_eq!(*app.state().scenario(), before, "one step");
}

/// Opens the window by the menu of the plot under the robot.
fn open_fastest(app: &mut App) {
    app.get_by_role_and_label(Role::Button, "More for Speed on the path").click();
    app.run_steps(4);
    app.get_by_role_and_label(Role::Button, "Fastest allowed…").click();
    app.run_steps(6);
}

/// Writes pictures of all of them; nothing where none are wanted.
#[test]
fn all_pictures_that_are_wanted() {
    let Some(folder) = std::env::var_os("TAUTLINE_PICTURES").map(PathBuf::from) else { return };
    std::fs::create_dir_all(&folder).expect("a folder");
    for (word, theme) in [("light", Theme::Light), ("dark", Theme::Dark)] {
        let shot = |name: &str, size: Vec2, prepare: &dyn Fn(&mut App)| {
            let textures = Textures::default();
            let mut app = app_in_pictures(moved("quintic", 7.0), size, theme, textures.clone());
            app.key_press(Key::Space);
            settle(&mut app);
            prepare(&mut app);
            finish(&mut app, &[Topic::Path, Topic::Move]);
            wait(&mut app, "all studies", |app| app.at_work().is_empty());
            app.run_steps(10);
            write(&picture(&app, &textures), &folder.join(format!("{name}-{word}.png")));
        };
        for plot in ["Deviation", "Tensions", "Gain", "Speed on the path"] {
            shot(&format!("desktop-{plot}"), SIZE, &|app| open_plot(app, plot));
        }
        shot("desktop-fastest", SIZE, &|app| {
            open_fastest(app);
            wait_for_label(app, " s, up to ");
        });
        for plot in ["Deviation", "Tensions", "Gain", "Speed on the path"] {
            shot(&format!("phone-{plot}"), Vec2::new(360.0, 740.0), &|app| {
                app.get_by_role_and_label(Role::Tab, "Plots").click();
                app.run_steps(4);
                app.get_by_role_and_label(Role::ComboBox, "Plot group").click();
                app.run_steps(4);
                app.get_by_role_and_label(Role::Button, "Flight").click();
                app.run_steps(4);
                app.get_by_role_and_label(Role::Tab, plot).click();
                app.run_steps(4);
            });
        }
    }
}
