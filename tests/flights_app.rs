//! Flights on the screen, by accessibility label.

#![cfg(feature = "app")]

use eframe::egui::accesskit::{Role, Toggled};
use eframe::egui::{Key, Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use tautline::app::Tautline;
use tautline::compute::protocol::Topic;
use tautline::scenario::Scenario;

use interface::{SIZE, app, app_sized, app_with, label, paper, settle, wait, wait_for_label};
use picture::{Textures, picture, write};
use tautline::app::Start;

#[path = "common/interface.rs"]
mod interface;
#[path = "common/picture.rs"]
mod picture;

type App = Harness<'static, Tautline>;

/// The paper's robot with coarse cables, from x = −half to half (m) with this peak speed in m/s, and `hold` s after the stop.
fn moving(half: f64, speed: f64, hold: f64) -> Scenario {
    let text = paper().to_json();
    let mut file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    file["schema"] = "tautline/scenario/2".into();
    file["elements_per_cable"] = 3.into();
    file["motion"]["position"] = serde_json::json!([-half, 0.0]);
    file["path"] = serde_json::json!({ "points": [[half, 0.0]], "speed": speed, "hold": hold });
    Scenario::from_json(&file.to_string()).expect("a path")
}

/// One metre in 15/8 s, accelerating by up to 5.77/(15/8)² = 1.6 m/s²: far below the 6.7 m/s² at which a cable of the paper's
/// robot goes slack.
fn gentle() -> Scenario {
    moving(0.5, 1.0, 0.625)
}

/// The same in a quarter of the time: 26 m/s².
fn violent() -> Scenario {
    moving(0.5, 4.0, 0.625)
}

/// Has the flight fly, and waits until it is computed.
fn flying(scenario: Scenario) -> App {
    let mut app = app_with(scenario, SIZE, Theme::Light);
    // It stands at its beginning.
    app.key_press(Key::Space);
    app.run_steps(2);
    app.get_by_role_and_label(Role::RadioButton, "Fly").click();
    app.run_steps(2);
    wait_for_flight(&mut app);
    app
}

/// Flights take long without optimisation: several times the usual patience.
fn wait_for_flight(app: &mut App) {
    let begun = std::time::Instant::now();
    while !app.state().study(Topic::Flight).2 {
        assert!(begun.elapsed() < 4 * interface::PATIENCE, "no flight");
        std::thread::sleep(std::time::Duration::from_millis(2));
        app.step();
    }
    app.run_steps(2);
}

/// The moment on show and the end, in s.
fn times(app: &App) -> [f64; 2] {
    let mut texts = app.query_all_by_label_contains(" / ").map(|node| interface::text_of(&node));
    let text = texts.rfind(|text| text.ends_with(" s")).expect("the moment");
    let text = text.trim_end_matches(" s");
    let (now, end) = text.split_once(" / ").expect("two times");
    [now.parse().expect("a number"), end.parse().expect("a number")]
}

fn press(app: &mut App, name: &str) {
    app.get_by_role_and_label(Role::Button, name).click();
    app.run_steps(2);
}

fn has(app: &App, part: &str) -> bool {
    app.query_all_by_label_contains(part).next().is_some()
}

#[test]
fn without_a_path_nothing_flies() {
    let app = app();
    assert!(app.query_by_role_and_label(Role::RadioButton, "Fly").is_none());
    assert!(!app.state().at_work().contains(&Topic::Flight));
}

#[test]
fn a_flight_is_played_paused_and_scrubbed() {
    let mut app = flying(gentle());
    let [paused, end] = times(&app);
    // 15 · 1 m/(8 · 1 m/s) = 1.875 s, and 0.625 s after the stop.
    assert!((end - 2.5).abs() < 1e-9, "{end}");
    app.run_steps(10);
    assert_eq!(times(&app)[0].to_bits(), paused.to_bits(), "it stands");
    app.key_press(Key::Space);
    app.run_steps(30);
    assert!(has(&app, "mm off its path"), "the platform flies");
    app.key_press(Key::Space);
    app.run_steps(2);
    let [later, _] = times(&app);
    // Thirty frames at a sixtieth of a second, and a few more around the keys.
    assert!(later - paused > 0.4 && later - paused < 0.8, "{paused} → {later}");
    // By stepping, as those who want no motion do.
    app.key_press(Key::Period);
    app.run_steps(2);
    let step = times(&app)[0] - later;
    assert!((step - 0.05).abs() < 0.011, "{step}");
    app.key_press(Key::Comma);
    app.run_steps(2);
    assert!((times(&app)[0] - later).abs() < 0.011);
    // By the slider.
    let slider = app.get_by_role_and_label(Role::Slider, "Time of the flight").rect();
    app.hover_at(slider.center());
    app.step();
    app.drag_at(slider.center());
    app.step();
    app.drop_at(slider.center());
    app.run_steps(3);
    let [sought, _] = times(&app);
    assert!((sought - 1.25).abs() < 0.05, "{sought}");
    assert!(has(&app, "no cable goes slack"));
}

#[test]
fn slack_is_told_and_what_follows_is_doubtful() {
    let mut app = flying(violent());
    let told = label(&app, "doubtful from there");
    assert!(told.starts_with("at ") && told.contains(" s: "), "{told}");
    // The word opens its card.
    app.get_by_role_and_label(Role::Link, "slack").click();
    app.run_steps(3);
    assert!(has(&app, "Slack"));
}

#[test]
fn a_kick_is_another_flight() {
    let mut app = flying(gentle());
    let before = label(&app, "Off its path by");
    // How far it is off a tenth of a second after the beginning.
    let off = |app: &mut App| -> f64 {
        for _ in 0..2 {
            app.key_press(Key::Period);
            app.run_steps(2);
        }
        let text = label(app, "mm off its path");
        let number = text.trim_start_matches("The platform, ").split(' ').next().expect("a number");
        number.parse().expect("a number")
    };
    let alone = off(&mut app);
    press(&mut app, "Kick");
    wait_for_flight(&mut app);
    let kick = app.get_by_role_and_label(Role::Button, "Kick").accesskit_node().toggled();
    assert_eq!(kick, Some(Toggled::True));
    assert_ne!(label(&app, "Off its path by"), before);
    // 1 N s moves the platform's 2 kg, with what it takes along of 18 kg of cables, by more than 5 mm in that time.
    let kicked = off(&mut app);
    assert!(kicked > 5.0 && kicked > 2.0 * alone, "{alone} mm, {kicked} mm");
    press(&mut app, "Kick");
    wait_for_flight(&mut app);
    assert_eq!(label(&app, "Off its path by"), before, "remembered");
}

#[test]
fn a_flight_of_an_earlier_document_is_not_shown_as_this_ones() {
    let mut app = flying(gentle());
    let before = label(&app, "Off its path by");
    interface::open_groups(&mut app);
    interface::type_value(&mut app, "Platform mass m", "6");
    // The flight is either told as under way, or is the new one.
    wait_for_label(&mut app, "Off its path by");
    wait_for_flight(&mut app);
    assert_ne!(label(&app, "Off its path by"), before);
}

#[test]
fn the_computation_of_a_flight_can_be_cancelled() {
    let mut app = app_with(moving(6.0, 0.5, 5.0), SIZE, Theme::Light);
    app.get_by_role_and_label(Role::RadioButton, "Fly").click();
    app.run_steps(2);
    wait(&mut app, "the flight at work", |app| app.at_work().contains(&Topic::Flight));
    app.run_steps(2);
    press(&mut app, "Cancel the flight");
    assert!(!app.state().at_work().contains(&Topic::Flight));
    assert!(has(&app, "Stopped") && has(&app, "not computed to its end"));
    press(&mut app, "Resume the flight");
    wait(&mut app, "the flight at work again", |app| app.at_work().contains(&Topic::Flight));
}

#[test]
fn a_phone_flies_with_one_button() {
    let start = Start { scenario: Some(gentle()), ..Start::default() };
    let mut app = app_sized(start, Vec2::new(360.0, 740.0));
    wait_for_flight(&mut app);
    press(&mut app, "Fly");
    app.run_steps(20);
    assert!(has(&app, "mm off its path"));
    press(&mut app, "Fly");
    let at = label(&app, "mm off its path");
    app.run_steps(20);
    assert_eq!(label(&app, "mm off its path"), at, "it stands");
}

/// Pictures to be looked at, where `TAUTLINE_PICTURES` names a folder.
#[test]
fn pictures() {
    let Some(folder) = std::env::var_os("TAUTLINE_PICTURES").map(std::path::PathBuf::from) else { return };
    std::fs::create_dir_all(&folder).expect("a folder");
    let textures = Textures::default();
    let mut app = interface::app_in_pictures(gentle(), SIZE, Theme::Light, textures.clone());
    settle(&mut app);
    app.key_press(Key::Space);
    app.step();
    app.get_by_role_and_label(Role::RadioButton, "Fly").click();
    app.run_steps(2);
    wait_for_flight(&mut app);
    for _ in 0..14 {
        app.key_press(Key::Period);
        app.step();
    }
    app.run_steps(3);
    write(&picture(&app, &textures), &folder.join("flight-desktop-light-gentle.png"));
    drop(app);
    for (size, place) in [(SIZE, "desktop"), (Vec2::new(360.0, 740.0), "phone")] {
        for (theme, name) in [(Theme::Light, "light"), (Theme::Dark, "dark")] {
            let textures = Textures::default();
            let mut app = interface::app_in_pictures(moving(3.0, 7.0, 0.5), size, theme, textures.clone());
            settle(&mut app);
            wait_for_flight(&mut app);
            if place == "desktop" {
                app.get_by_role_and_label(Role::RadioButton, "Fly").click();
                app.run_steps(2);
            } else {
                press(&mut app, "Fly");
            }
            for (moment, steps) in [("middle", 100), ("late", 90)] {
                app.run_steps(steps);
                app.key_press(Key::Space);
                app.run_steps(3);
                write(&picture(&app, &textures), &folder.join(format!("flight-{place}-{name}-{moment}.png")));
                app.key_press(Key::Space);
            }
        }
    }
}
