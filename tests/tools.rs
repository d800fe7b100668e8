//! What is around the answer: undo, files, the robot's layout, settings, keys.

#![cfg(feature = "app")]
#![expect(clippy::float_cmp, reason = "values that are typed, dragged and brought back are the same to the last bit")]

#[path = "common/interface.rs"]
mod interface;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use eframe::egui::accesskit::Role;
use eframe::egui::{DroppedFile, Event, Key, Modifiers, Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use tautline::app::Tautline;
use tautline::compute::protocol::Topic;
use tautline::robot::TensionLaw;
use tautline::scenario::{Scenario, presets};

use interface::{app, app_with, drag, paper, report, settle, type_value};

type App = Harness<'static, Tautline>;

/// Chooses an entry of a menu.
fn choose(app: &mut App, menu: &str, entry: &str) {
    app.get_by_label(menu).click();
    app.run_steps(3);
    app.get_by_label_contains(entry).click();
    settle(app);
}

fn position(app: &App) -> [f64; 2] {
    app.state().scenario().motion.position
}

fn drag_platform(app: &mut App, by: Vec2) {
    let platform = app.get_by_label("Platform").rect().center();
    drag(app, platform, platform + by);
    settle(app);
}

/// Opens the folded part of the controls.
fn open_layout(app: &mut App) {
    app.get_by_label("Layout of the robot").click();
    app.run_steps(20);
}

#[test]
fn every_drag_is_one_step_that_can_be_undone_and_redone() {
    let mut app = app();
    drag_platform(&mut app, Vec2::new(60.0, 10.0));
    let first = position(&app);
    drag_platform(&mut app, Vec2::new(-20.0, 40.0));
    let second = position(&app);
    assert!(first != second && first != [0.0, 0.0], "{first:?} {second:?}");
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut app);
    assert_eq!(position(&app), first, "back to the end of the first drag, not into the middle of one");
    app.get_by_role_and_label(Role::Button, "Undo").click();
    settle(&mut app);
    assert_eq!(position(&app), [0.0, 0.0]);
    app.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    settle(&mut app);
    app.get_by_role_and_label(Role::Button, "Redo").click();
    settle(&mut app);
    assert_eq!(position(&app), second);
    // The critical speed on show is that of the state brought back.
    assert_eq!(report(&app), interface::cold(app.state().scenario()));
}

#[test]
fn what_is_done_after_an_undo_cannot_be_redone_over() {
    let mut app = app();
    drag_platform(&mut app, Vec2::new(60.0, 10.0));
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut app);
    type_value(&mut app, "Platform mass m", "3");
    app.key_press_modifiers(Modifiers::COMMAND, Key::Y);
    settle(&mut app);
    assert_eq!((position(&app), app.state().scenario().platform.mass), ([0.0, 0.0], 3.0));
}

#[test]
fn all_values_reset_at_once_and_come_back_with_undo() {
    let mut app = app();
    type_value(&mut app, "Platform mass m", "3");
    type_value(&mut app, "Gravity g", "1.62");
    choose(&mut app, "Edit", "Reset all values");
    assert_eq!(*app.state().scenario(), paper());
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut app);
    assert_eq!((app.state().scenario().platform.mass, app.state().scenario().gravity), (3.0, 1.62));
}

/// A file on the disk for one test, as if it had been dropped.
#[derive(Clone, Debug)]
struct OnDisk {
    path: PathBuf,
    /// Somebody has asked for all that is in it, however long that takes.
    read_whole: Arc<AtomicBool>,
}

impl OnDisk {
    fn new(name: &str, bytes: &[u8]) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let folder = format!("tautline-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(folder).join(name);
        std::fs::create_dir(path.parent().unwrap()).unwrap();
        std::fs::write(&path, bytes).unwrap();
        Self { path, read_whole: Arc::default() }
    }

    fn drop_on(&self, app: &mut App) {
        app.input_mut().dropped_files.push(Arc::new(self.clone()));
        app.step();
    }

    fn remove(&self) {
        std::fs::remove_dir_all(self.path.parent().unwrap()).unwrap();
    }
}

impl DroppedFile for OnDisk {
    fn path(&self) -> &Path {
        &self.path
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        self.read_whole.store(true, Ordering::Relaxed);
        let size = std::fs::metadata(&self.path).unwrap().len();
        if size > 1_000_000_000 { Err("too much".into()) } else { Ok(std::fs::read(&self.path).unwrap()) }
    }
}

/// Drops a file, and waits until it has been opened or refused.
fn drop_file(app: &mut App, name: &str, bytes: &[u8]) {
    let before = (app.state().scenario().clone(), app.state().notice().map(str::to_owned));
    let file = OnDisk::new(name, bytes);
    file.drop_on(app);
    interface::wait(app, name, |app| (app.scenario(), app.notice()) != (&before.0, before.1.as_deref()));
    settle(app);
    file.remove();
}

#[test]
fn a_dropped_scenario_is_opened_and_the_one_before_comes_back_with_undo() {
    let mut app = app();
    drag_platform(&mut app, Vec2::new(60.0, 0.0));
    let before = app.state().scenario().clone();
    let other = Scenario { name: Some("Dropped".into()), gravity: 1.62, ..presets::PRESETS[1].scenario() };
    drop_file(&mut app, "other.json", other.to_json().as_bytes());
    assert_eq!(*app.state().scenario(), other);
    assert_eq!(report(&app), interface::cold(&other));
    // A reset gives back the values of the file.
    type_value(&mut app, "Gravity g", "9");
    choose(&mut app, "Edit", "Reset all values");
    assert_eq!(app.state().scenario().gravity, 1.62);
    for _ in 0..3 {
        app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        settle(&mut app);
    }
    assert_eq!(*app.state().scenario(), before);
}

#[test]
fn what_is_no_scenario_is_refused_with_the_reason_and_the_robot_stays() {
    let mut app = app();
    let negative = paper().to_json().replace("2.0", "-2.0");
    let cases: [(&[u8], &str); 4] = [
        (b"no JSON", "scenario"),
        (negative.as_bytes(), "platform.mass"),
        (&[0xff, 0xfe, 0x00], "in the middle of a character"),
        (&vec![b' '; 2_000_000], "larger than 1 MB"),
    ];
    for (bytes, reason) in cases {
        drop_file(&mut app, "bad.json", bytes);
        let notice = app.state().notice().expect("a message");
        assert!(notice.contains(reason), "{notice}");
        assert_eq!(*app.state().scenario(), paper());
    }
    // All are there to be read, the newest three first.
    for left in [3, 3, 2, 1] {
        assert_eq!(app.get_all_by_label("Dismiss").count(), left);
        app.get_all_by_label("Dismiss").next().expect("one").click();
        app.run_steps(3);
    }
    assert_eq!(app.state().notice(), None);
}

#[test]
fn a_fault_stays_until_the_next_thing_succeeds() {
    let mut app = app();
    let said = |app: &App, text: &str| app.query_by_label_contains(text).is_some();
    // Two at once: both are told.
    let (first, second) = (OnDisk::new("first.json", b"no JSON"), OnDisk::new("second.json", b"Gr\xf6\xdfe"));
    app.input_mut().dropped_files.push(Arc::new(first.clone()));
    second.drop_on(&mut app);
    interface::wait(&mut app, "the second", |app| app.notice().is_some_and(|notice| notice.contains("second.json")));
    app.run_steps(2);
    assert!(said(&app, "text that is not JSON") && said(&app, "second.json is not UTF-8"));
    choose(&mut app, "Edit", "Copy the table of modes");
    assert!(!said(&app, "not JSON") && !said(&app, "second.json"), "{:?}", app.state().notice());
    assert_eq!(app.state().notice(), Some("The table of modes is on the clipboard."));
    second.drop_on(&mut app);
    interface::wait(&mut app, "the second", |app| app.notice().is_some_and(|notice| notice.contains("second.json")));
    app.run_steps(2);
    assert!(!said(&app, "on the clipboard"), "what was done is old");
    app.get_by_role_and_label(Role::Button, "Pin").click();
    app.run_steps(3);
    assert_eq!(app.state().notice(), None);
    first.remove();
    second.remove();
}

#[test]
fn a_pasted_scenario_is_opened() {
    let mut app = app();
    let other = presets::PRESETS[1].scenario();
    app.event(Event::Paste(other.to_json()));
    settle(&mut app);
    assert_eq!(*app.state().scenario(), other);
}

/// Some programs begin a text with a byte order mark, on the clipboard, too.
#[test]
fn a_pasted_text_may_begin_with_a_mark() {
    let mut app = app();
    // A scenario that holds the text before a link is not a link.
    let other = Scenario { name: Some("As in …/#s=1".into()), ..presets::PRESETS[1].scenario() };
    app.event(Event::Paste(format!("\u{feff}{}", other.to_json())));
    settle(&mut app);
    assert_eq!(*app.state().scenario(), other, "{:?}", app.state().notice());
    app.event(Event::Paste(format!("\u{feff}#s={}", tautline::scenario::link::encode(&paper()))));
    settle(&mut app);
    assert_eq!(*app.state().scenario(), paper(), "{:?}", app.state().notice());
    app.event(Event::Paste(" ".repeat(1_000_001)));
    settle(&mut app);
    assert_eq!(app.state().notice(), Some("The text is larger than 1 MB, which no scenario is."));
}

#[test]
fn a_dropped_file_may_be_utf_16_with_a_mark() {
    let mut app = app();
    let other = Scenario { name: Some("Größe".into()), ..presets::PRESETS[1].scenario() };
    let bytes: Vec<u8> = format!("\u{feff}{}", other.to_json()).encode_utf16().flat_map(u16::to_le_bytes).collect();
    drop_file(&mut app, "windows.json", &bytes);
    assert_eq!(*app.state().scenario(), other, "{:?}", app.state().notice());
    drop_file(&mut app, "latin.json", b"{ \"name\": \"Gr\xf6\xdfe\" }");
    let notice = app.state().notice().unwrap_or_default();
    assert!(notice.contains("latin.json is not UTF-8: the byte 0xF6 at position 14"), "{notice}");
}

#[test]
fn a_dropped_file_that_is_too_large_is_refused_without_being_read() {
    let mut app = app();
    let file = OnDisk::new("film.json", b"");
    // Larger than the memory. Most file systems give it no room on the disk; the one of Windows does, so there it is smaller.
    let size = if cfg!(windows) { 1 << 30 } else { 1 << 40 };
    std::fs::OpenOptions::new().write(true).open(&file.path).unwrap().set_len(size).unwrap();
    file.drop_on(&mut app);
    interface::wait(&mut app, "a message", |app| app.notice().is_some());
    assert_eq!(app.state().notice(), Some("film.json is larger than 1 MB, which no scenario is."));
    assert!(!file.read_whole.load(Ordering::Relaxed));
    file.remove();
}

#[cfg(unix)]
#[test]
fn a_dropped_file_is_read_while_the_window_goes_on() {
    let mut app = app();
    let file = OnDisk::new("slow.json", b"");
    // A read from a pipe waits until somebody writes, like a read from a sleeping disk or from a network.
    std::fs::remove_file(&file.path).unwrap();
    assert!(std::process::Command::new("mkfifo").arg(&file.path).status().unwrap().success());
    let (go, wait) = std::sync::mpsc::channel();
    let other = presets::PRESETS[1].scenario();
    let (path, json) = (file.path.clone(), other.to_json());
    let writer = std::thread::spawn(move || {
        let told = wait.recv_timeout(std::time::Duration::from_secs(20)).is_ok();
        std::fs::write(path, json).unwrap();
        told
    });
    file.drop_on(&mut app);
    drag_platform(&mut app, Vec2::new(60.0, 0.0));
    let _ = go.send(());
    assert!(writer.join().unwrap(), "the window waited for the file");
    interface::wait(&mut app, "the scenario", |app| *app.scenario() == other);
    file.remove();
}

#[test]
fn winches_can_be_dragged_once_unlocked() {
    let mut app = app();
    assert!(app.query_by_label("Winch 1").is_none(), "locked at first");
    open_layout(&mut app);
    app.get_by_label("Unlock the winches").click();
    app.run_steps(3);
    // The first is the handle on the canvas or the part of the controls: the one with the winch's size is the handle.
    let handle = |app: &App| {
        app.get_all_by_label("Winch 1").map(|node| node.rect()).find(|rect| rect.width() < 60.0).expect("a handle")
    };
    let winch = handle(&app).center();
    drag(&mut app, winch, winch + Vec2::new(30.0, 20.0));
    settle(&mut app);
    let [x, y] = app.state().scenario().cables[0].anchor;
    assert!((-10.0..-8.0).contains(&x) && (4.0..5.0).contains(&y), "({x}, {y})");
    assert!(x > -9.9 && y < 4.9, "({x}, {y})");
    // Right and down by the same scale, to half a point of 30 and of 20: the ground has not moved during the drag.
    assert!(((x + 10.0) / (5.0 - y) / 1.5 - 1.0).abs() < 0.5 / 30.0 + 0.5 / 20.0, "({x}, {y})");
    assert_eq!(report(&app), interface::cold(app.state().scenario()));
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut app);
    assert_eq!(*app.state().scenario(), paper());
}

#[test]
fn cables_are_added_removed_and_put_at_equilibrium() {
    // Without scrolling.
    let mut app = app_with(paper(), Vec2::new(1280.0, 1600.0), Theme::Light);
    open_layout(&mut app);
    app.get_by_label("Add a cable").click();
    settle(&mut app);
    assert_eq!(app.state().scenario().cables.len(), 5);
    app.get_by_label("First cable at equilibrium").click();
    app.run_steps(3);
    app.get_by_role_and_label(Role::Button, "Cable 3").click();
    settle(&mut app);
    let laws: Vec<TensionLaw> = app.state().scenario().cables.iter().map(|cable| cable.tension).collect();
    assert_eq!((laws[1], laws[2]), (TensionLaw::Equilibrium, TensionLaw::Equilibrium));
    assert_eq!(laws[0], paper().cables[2].tension, "the two have exchanged their laws");
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut app);
    // Back to four, and a fourth one goes; three stay.
    for cable in ["Winch 5", "Winch 4"] {
        app.get_by_label(cable).click();
        app.run_steps(20);
        app.get_by_label(&cable.replace("Winch", "Remove cable")).click();
        settle(&mut app);
    }
    assert_eq!(app.state().scenario().cables.len(), 3);
    app.get_by_label("Winch 3").click();
    app.run_steps(20);
    app.get_by_label("Remove cable 3").click();
    settle(&mut app);
    assert_eq!(app.state().scenario().cables.len(), 3, "a robot has three cables at least");
}

#[test]
fn another_frame_moves_the_winches_in_proportion() {
    let mut app = app_with(paper(), Vec2::new(1280.0, 1600.0), Theme::Light);
    open_layout(&mut app);
    type_value(&mut app, "Width", "30");
    let anchors: Vec<[f64; 2]> = app.state().scenario().cables.iter().map(|cable| cable.anchor).collect();
    assert_eq!(anchors, [[-15.0, 5.0], [15.0, 5.0], [-15.0, -5.0], [15.0, -5.0]]);
}

#[test]
fn settings_change_the_units_of_all_figures() {
    let mut app = app();
    choose(&mut app, "View", "Settings");
    for (list, entry) in [("Frequencies in", "rad/s"), ("Young's modulus in", "GPa")] {
        app.get_by_role_and_label(Role::ComboBox, list).click();
        app.run_steps(3);
        app.get_by_role_and_label(Role::Button, entry).click();
        app.run_steps(5);
    }
    app.key_press(Key::Escape);
    app.run_steps(5);
    assert!(app.query_by_label("Frequencies in").is_none(), "Escape closes the window");
    // 0.2716 Hz (docs/theory.md, reference numbers) is 1.7065 rad/s.
    let text = interface::label(&app, "Flutter at 1.7");
    let frequency = report(&app).critical.expect("a critical speed").frequency_hz * std::f64::consts::TAU;
    assert!(interface::rounds(&text, "Flutter at ", frequency) && text.contains("rad/s"), "{text}");
    type_value(&mut app, "Young's modulus E", "0.25");
    assert_eq!(app.state().scenario().cable.youngs_modulus, 0.25e9);
}

#[test]
fn keys_open_the_list_of_keys_and_switch_the_map() {
    let mut app = app();
    app.event(Event::Text("?".into()));
    app.run_steps(5);
    app.get_by_label("This list");
    app.key_press(Key::Escape);
    app.run_steps(5);
    assert!(app.query_by_label("This list").is_none());
    assert!(app.query_by_label("Map quantity").is_none());
    app.key_press(Key::M);
    app.run_steps(3);
    app.get_by_label("Map quantity");
    // Not while a number is being typed.
    app.get_by_role_and_label(Role::SpinButton, "Gravity g").click();
    app.run_steps(3);
    app.key_press(Key::M);
    app.run_steps(3);
    app.get_by_label("Map quantity");
}

#[test]
fn the_menus_fit_a_phone() {
    let mut app = app_with(paper(), Vec2::new(360.0, 740.0), Theme::Dark);
    for menu in ["File", "Edit", "View", "Help"] {
        let rect = app.get_by_label(menu).rect();
        assert!(rect.max.x <= 360.0, "{menu}: {rect:?}");
    }
    choose(&mut app, "View", "Settings");
    let settings = app.get_by_label("Theme").rect();
    assert!(settings.min.x >= 0.0 && settings.max.x <= 360.0, "{settings:?}");
}

#[test]
fn a_pinned_design_is_compared_with_the_present_one() {
    let mut app = app();
    app.get_by_role_and_label(Role::Button, "Pin").click();
    app.run_steps(3);
    interface::wait_for_label(&mut app, "Pinned: 11.3 m/s. Now +0 m/s (+0 %)");
    drag_platform(&mut app, Vec2::new(60.0, 0.0));
    let now = report(&app).critical.expect("a critical speed").speed;
    let difference = now - interface::cold(&paper()).critical.expect("a critical speed").speed;
    let text = interface::label(&app, "Pinned: 11.3 m/s. Now ");
    assert!(interface::rounds(&text, "Now ", difference), "{text}: {difference}");
    // Every plot goes on with it.
    for tab in ["Eigenvalues", "Growth rate", "Modes", "Along the line", "Directions", "Campbell", "Mesh", "Knobs"] {
        app.get_by_role_and_label(Role::Button, tab).click();
        settle(&mut app);
    }
    app.get_by_role_and_label(Role::Button, "Unpin").click();
    app.run_steps(3);
    assert!(app.query_by_label_contains("Pinned: 11.").is_none());
}

/// A robot whose analysis takes many frames.
fn slow() -> Scenario {
    Scenario { elements_per_cable: 40, ..paper() }
}

#[test]
fn pin_while_recomputing_pins_the_design_that_was_on_the_screen() {
    let mut app = app_with(slow(), Vec2::new(1280.0, 800.0), Theme::Light);
    app.get_by_label("Platform").focus();
    app.run_steps(2);
    let before = report(&app).critical.expect("a critical speed").speed;
    app.key_press(Key::ArrowRight);
    app.run_steps(2);
    assert!(app.state().analysis().is_some_and(|analysis| !analysis.current), "not recomputing");
    let wanted = app.state().scenario().clone();
    assert_eq!(wanted.motion.position, [0.1, 0.0]);
    app.get_by_role_and_label(Role::Button, "Pin").click();
    app.run_steps(2);
    app.get_by_label("Platform").focus();
    app.run_steps(1);
    for _ in 0..4 {
        app.key_press(Key::ArrowRight);
        app.run_steps(2);
    }
    settle(&mut app);
    interface::wait(&mut app, "the pinned design", |app| app.pinned().is_some_and(|(_, complete)| complete));
    app.run_steps(3);
    assert_eq!(app.state().pinned().map(|(scenario, _)| scenario.clone()), Some(wanted.clone()));
    let now = report(&app).critical.expect("a critical speed").speed;
    let pinned = interface::cold(&wanted).critical.expect("a critical speed").speed;
    assert!(pinned != now && pinned != before);
    let text = interface::label(&app, "Pinned: ");
    assert!(interface::rounds(&text, "Pinned: ", pinned) && interface::rounds(&text, "Now ", now - pinned), "{text}");
}

#[test]
fn unpinning_stops_the_pinned_designs_study() {
    let mut app = app_with(slow(), Vec2::new(1280.0, 800.0), Theme::Light);
    app.get_by_role_and_label(Role::Button, "Pin").click();
    app.run_steps(3);
    interface::wait(&mut app, "the pinned design", |app| app.pinned().is_some_and(|(_, complete)| complete));
    app.get_by_role_and_label(Role::Button, "Directions").click();
    app.run_steps(3);
    // The same study is remembered; the other one belongs to the pinned design.
    type_value(&mut app, "Elements per cable n", "4");
    interface::wait(&mut app, "the present design's study", |app| app.study(Topic::Polar).2);
    interface::wait(&mut app, "the pinned design's study", |app| app.at_work().contains(&Topic::Polar));
    app.get_by_role_and_label(Role::Button, "Unpin").click();
    app.run_steps(3);
    assert!(!app.state().at_work().contains(&Topic::Polar), "it goes on: {:?}", app.state().at_work());
}

#[test]
fn the_bars_say_which_knob_to_turn_and_lead_to_it() {
    let mut app = app();
    app.get_by_role_and_label(Role::Button, "Knobs").click();
    // E and A only occur as EA in the stiffness, so their bars are equal.
    interface::wait_for_label(&mut app, "A, area: ");
    let value = |app: &App, name: &str| -> f64 {
        let node = app.get_by_label_contains(name);
        let text = interface::text_of(&node);
        let number = text.split(": ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a number");
        number.parse().expect("a number")
    };
    assert_eq!(value(&app, "E, Young's mod.: "), value(&app, "A, area: "));
    // More damping, a higher critical speed: docs/theory.md section 9.
    assert!(value(&app, "α, damping: ") > 0.0);
    app.get_by_label_contains("T, cable 4: ").click();
    app.run_steps(30);
    assert!(app.query_by_role_and_label(Role::SpinButton, "h0").is_some(), "the tension's law is open");
}

#[test]
fn a_link_opens_the_robot_that_it_names_and_a_damaged_one_is_told() {
    use tautline::app::Start;
    use tautline::scenario::link;
    let other = presets::PRESETS[3].scenario();
    let start = |link: String| Start { link: Some(link), ..Start::default() };
    let good = format!("https://example.org/tautline/#s={}", link::encode(&other));
    let mut app = interface::app_started(start(good.clone()));
    assert_eq!(*app.state().scenario(), other);
    // Pasted, too.
    app.event(Event::Paste(format!("Look: #s={} ", link::encode(&paper()))));
    settle(&mut app);
    assert_eq!(*app.state().scenario(), paper());
    let app = interface::app_started(start(good[..good.len() - 3].to_owned()));
    assert_eq!(*app.state().scenario(), paper());
    assert!(app.state().notice().is_some_and(|notice| notice.contains("damaged")), "{:?}", app.state().notice());
}

#[test]
fn the_tour_shows_six_things_and_can_be_skipped_and_repeated() {
    use tautline::app::Start;
    for size in [Vec2::new(1280.0, 800.0), Vec2::new(360.0, 740.0)] {
        let start = Start { scenario: Some(paper()), tour: true, ..Start::default() };
        let mut app = interface::app_sized(start, size);
        for step in 1..=6 {
            let count = app.get_by_label(&format!("{step} of 6")).rect();
            assert!(count.max.x <= size.x && count.max.y <= size.y, "{count:?}");
            let next = if step < 6 { "Next" } else { "Done" };
            app.get_by_role_and_label(Role::Button, next).click();
            app.run_steps(3);
        }
        assert!(app.query_by_label_contains("of 6").is_none());
        choose(&mut app, "Help", "Tour");
        app.get_by_label("Skip the tour").click();
        app.run_steps(3);
        assert!(app.query_by_label_contains("of 6").is_none());
    }
}

#[test]
fn mode_shapes_can_be_stepped_through() {
    let mut app = app();
    app.get_by_role_and_label(Role::Button, "One step forward").click();
    app.run_steps(3);
    app.get_by_label("▶ Play");
    let phase =
        |app: &App| app.get_by_role_and_label(Role::Slider, "Phase").accesskit_node().numeric_value().expect("a value");
    let before = phase(&app);
    app.get_by_role_and_label(Role::Button, "One step forward").click();
    app.run_steps(3);
    let after = phase(&app);
    assert!(((after - before).rem_euclid(360.0) - 15.0).abs() < 1e-6, "{before} {after}");
}

#[test]
fn two_fingers_zoom() {
    use eframe::egui::{Pos2, TouchDeviceId, TouchId, TouchPhase};
    let mut app = app();
    assert!(app.query_by_label("Show all").is_none());
    // The first finger is the pointer, too.
    app.drag_at(Pos2::new(610.0, 650.0));
    app.step();
    let mut touch = |phase, apart: f32| {
        for (id, side) in [(1, -1.0), (2, 1.0)] {
            let pos = Pos2::new(640.0 + side * apart, 650.0);
            app.event(Event::Touch { device_id: TouchDeviceId(0), id: TouchId(id), phase, pos, force: None });
        }
        app.step();
    };
    touch(TouchPhase::Start, 30.0);
    for apart in [40.0, 60.0, 80.0] {
        touch(TouchPhase::Move, apart);
    }
    touch(TouchPhase::End, 80.0);
    app.drop_at(Pos2::new(560.0, 650.0));
    app.run_steps(3);
    app.get_by_label("Show all").click();
    app.run_steps(3);
    assert!(app.query_by_label("Show all").is_none(), "the whole robot is back");
}
