//! What is around the answer: undo, files, the robot's layout, settings, keys.

#![cfg(feature = "app")]
#![expect(clippy::float_cmp, reason = "values that are typed, dragged and brought back are the same to the last bit")]

#[path = "common/interface.rs"]
mod interface;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use eframe::egui::accesskit::Role;
use eframe::egui::{DroppedFile, Event, Key, Modifiers, Pos2, Shape, Theme, Vec2};
use egui_kittest::kittest::Queryable as _;
use egui_kittest::{Harness, Node};
use tautline::app::Tautline;
use tautline::compute::protocol::Topic;
use tautline::robot::TensionLaw;
use tautline::scenario::{Scenario, presets};

use interface::{app, app_with, drag, open_groups, open_plot, paper, report, settle, type_value};

type App = Harness<'static, Tautline>;

/// Chooses an entry of the menu that is called `menu`.
fn choose(app: &mut App, menu: &str, entry: &str) {
    let is_menu = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
        matches!(node.role(), Role::Button | Role::ComboBox) && node.label().as_deref() == Some(menu)
    };
    app.get_by(is_menu).click();
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

/// Lets winches, frame and balance be changed.
fn unlock(app: &mut App) {
    app.get_by_label("Unlock the winches").click();
    app.run_steps(3);
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
    open_groups(&mut app);
    type_value(&mut app, "Platform mass m", "3");
    app.key_press_modifiers(Modifiers::COMMAND, Key::Y);
    settle(&mut app);
    assert_eq!((position(&app), app.state().scenario().platform.mass), ([0.0, 0.0], 3.0));
}

#[test]
fn all_values_reset_at_once_and_come_back_with_undo() {
    let mut app = app();
    open_groups(&mut app);
    type_value(&mut app, "Platform mass m", "3");
    type_value(&mut app, "Gravity g", "1.62");
    choose(&mut app, "Robot", "Reset all values");
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
    open_groups(&mut app);
    type_value(&mut app, "Gravity g", "9");
    choose(&mut app, "Robot", "Reset all values");
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
    choose(&mut app, "More", "Copy the table of modes");
    assert!(!said(&app, "not JSON") && !said(&app, "second.json"), "{:?}", app.state().notice());
    assert_eq!(app.state().notice(), Some("The table of modes is on the clipboard."));
    second.drop_on(&mut app);
    interface::wait(&mut app, "the second", |app| app.notice().is_some_and(|notice| notice.contains("second.json")));
    app.run_steps(2);
    assert!(!said(&app, "on the clipboard"), "what was done is old");
    app.get_by_role_and_label(Role::Button, "Keep").click();
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
    unlock(&mut app);
    let winch = app.get_by_label("Winch 1").rect().center();
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
    unlock(&mut app);
    app.get_by_label("Add a cable").click();
    settle(&mut app);
    assert_eq!(app.state().scenario().cables.len(), 5);
    app.get_by_label("First cable at equilibrium").click();
    app.run_steps(3);
    // The list's entry; the row in the table of cables has the same name.
    let entries = app.get_all_by_role_and_label(Role::Button, "Cable 3");
    entries.min_by(|a, b| a.rect().width().total_cmp(&b.rect().width())).expect("an entry").click();
    settle(&mut app);
    let laws: Vec<TensionLaw> = app.state().scenario().cables.iter().map(|cable| cable.tension).collect();
    assert_eq!((laws[1], laws[2]), (TensionLaw::Equilibrium, TensionLaw::Equilibrium));
    assert_eq!(laws[0], paper().cables[2].tension, "the two have exchanged their laws");
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut app);
    // Back to four, and a fourth one goes; three stay.
    for cable in ["Cable 5", "Cable 4"] {
        app.get_by_role_and_label(Role::Button, cable).click();
        app.run_steps(20);
        app.get_by_label(&cable.replace("Cable", "Remove cable")).click();
        settle(&mut app);
    }
    assert_eq!(app.state().scenario().cables.len(), 3);
    app.get_by_role_and_label(Role::Button, "Cable 3").click();
    app.run_steps(20);
    app.get_by_label("Remove cable 3").click();
    settle(&mut app);
    assert_eq!(app.state().scenario().cables.len(), 3, "a robot has three cables at least");
}

#[test]
fn another_frame_moves_the_winches_in_proportion() {
    let mut app = app_with(paper(), Vec2::new(1280.0, 1600.0), Theme::Light);
    unlock(&mut app);
    type_value(&mut app, "Width", "30");
    let anchors: Vec<[f64; 2]> = app.state().scenario().cables.iter().map(|cable| cable.anchor).collect();
    assert_eq!(anchors, [[-15.0, 5.0], [15.0, 5.0], [-15.0, -5.0], [15.0, -5.0]]);
}

#[test]
fn settings_change_the_units_of_all_figures() {
    let mut app = app();
    choose(&mut app, "More", "Settings");
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
    let row = app.get_by_label("flutter").rect().y_range();
    let beside = |node: &Node<'_>| interface::text_of(node).ends_with(" rad/s") && row.contains(node.rect().center().y);
    let texts: Vec<String> =
        app.get_all_by_role(Role::Label).filter(beside).map(|node| interface::text_of(&node)).collect();
    let [text] = texts.as_slice() else { panic!("one frequency beside the word: {texts:?}") };
    let frequency = report(&app).critical.expect("a critical speed").frequency_hz * std::f64::consts::TAU;
    assert!(interface::rounds(text, "", frequency) && text.starts_with("1.7"), "{text}");
    open_groups(&mut app);
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
    app.get_by_role_and_label(Role::SpinButton, "Speed v").click();
    app.run_steps(3);
    app.key_press(Key::M);
    app.run_steps(3);
    app.get_by_label("Map quantity");
}

#[test]
fn the_menus_fit_a_phone() {
    let mut app = app_with(paper(), Vec2::new(360.0, 740.0), Theme::Dark);
    let bar = [(Role::ComboBox, "Robot"), (Role::Button, "Undo"), (Role::Button, "Map"), (Role::Button, "More")];
    let mut left = 0.0;
    for (role, name) in bar {
        let rect = app.get_by_role_and_label(role, name).rect();
        assert!(rect.min.x >= left && rect.max.x <= 360.0, "{name}: {rect:?}, from {left} on");
        left = rect.max.x;
    }
    for (role, name, entry) in
        [(Role::ComboBox, "Robot", "Reset all values"), (Role::Button, "More", "Keyboard shortcuts")]
    {
        app.get_by_role_and_label(role, name).click();
        app.run_steps(5);
        let rect = app.get_by_label_contains(entry).rect();
        assert!(rect.min.x >= 0.0 && rect.max.x <= 360.0 && rect.max.y <= 740.0, "{entry}: {rect:?}");
        app.key_press(Key::Escape);
        app.run_steps(5);
    }
    choose(&mut app, "More", "Settings");
    let settings = app.get_by_label("Theme").rect();
    assert!(settings.min.x >= 0.0 && settings.max.x <= 360.0, "{settings:?}");
}

#[test]
fn a_kept_design_is_compared_with_the_present_one() {
    let mut app = app();
    app.get_by_role_and_label(Role::Button, "Keep").click();
    app.run_steps(3);
    interface::wait_for_label(&mut app, "A: 11.3 m/s. Now +0 m/s (+0 %)");
    drag_platform(&mut app, Vec2::new(60.0, 0.0));
    let now = report(&app).critical.expect("a critical speed").speed;
    let difference = now - interface::cold(&paper()).critical.expect("a critical speed").speed;
    let text = interface::label(&app, "A: 11.3 m/s. Now ");
    assert!(interface::rounds(&text, "Now ", difference), "{text}: {difference}");
    // Every plot goes on with it.
    for plot in [
        "Eigenvalues",
        "Growth",
        "Modes",
        "Along the line",
        "Directions",
        "Speed diagram",
        "Mesh error",
        "What to change",
        "What if",
    ] {
        open_plot(&mut app, plot);
        settle(&mut app);
    }
    remove_design(&mut app);
    assert!(app.query_by_label_contains("A: 11.").is_none());
}

/// Lets design A go.
fn remove_design(app: &mut Harness<'static, Tautline>) {
    app.get_by_role_and_label(Role::Button, "Designs").click();
    app.run_steps(5);
    app.get_by_role_and_label(Role::Button, "Remove A").click();
    app.run_steps(3);
}

/// A robot whose analysis takes many frames.
fn slow() -> Scenario {
    Scenario { elements_per_cable: 40, ..paper() }
}

#[test]
fn keep_while_recomputing_keeps_the_design_that_was_on_the_screen() {
    let mut app = app_with(slow(), Vec2::new(1280.0, 800.0), Theme::Light);
    app.get_by_label("Platform").focus();
    app.run_steps(2);
    let before = report(&app).critical.expect("a critical speed").speed;
    app.key_press(Key::ArrowRight);
    app.run_steps(2);
    assert!(app.state().analysis().is_some_and(|analysis| !analysis.current), "not recomputing");
    let wanted = app.state().scenario().clone();
    assert_eq!(wanted.motion.position, [0.1, 0.0]);
    app.get_by_role_and_label(Role::Button, "Keep").click();
    app.run_steps(2);
    app.get_by_label("Platform").focus();
    app.run_steps(1);
    for _ in 0..4 {
        app.key_press(Key::ArrowRight);
        app.run_steps(2);
    }
    settle(&mut app);
    interface::wait(&mut app, "the kept design", |app| app.designs().iter().any(|(_, _, complete)| *complete));
    app.run_steps(3);
    assert_eq!(app.state().designs().first().map(|(_, scenario, _)| (*scenario).clone()), Some(wanted.clone()));
    let now = report(&app).critical.expect("a critical speed").speed;
    let pinned = interface::cold(&wanted).critical.expect("a critical speed").speed;
    assert!(pinned != now && pinned != before);
    let text = interface::label(&app, "A: ");
    assert!(interface::rounds(&text, "A: ", pinned) && interface::rounds(&text, "Now ", now - pinned), "{text}");
}

#[test]
fn removing_a_design_stops_its_study() {
    let mut app = app_with(slow(), Vec2::new(1280.0, 800.0), Theme::Light);
    app.get_by_role_and_label(Role::Button, "Keep").click();
    app.run_steps(3);
    interface::wait(&mut app, "the kept design", |app| app.designs().iter().any(|(_, _, complete)| *complete));
    open_plot(&mut app, "Directions");
    // The same study is remembered; the other one belongs to the kept design.
    open_groups(&mut app);
    type_value(&mut app, "Elements per cable n", "4");
    interface::wait(&mut app, "the present design's study", |app| app.study(Topic::Directions).2);
    interface::wait(&mut app, "the kept design's study", |app| app.at_work().contains(&Topic::Directions));
    remove_design(&mut app);
    assert!(!app.state().at_work().contains(&Topic::Directions), "it goes on: {:?}", app.state().at_work());
}

#[test]
fn the_bars_say_which_knob_to_turn_and_lead_to_it() {
    let mut app = app();
    open_plot(&mut app, "What to change");
    // E and A only occur as EA in the stiffness, so their bars are equal.
    interface::wait_for_label(&mut app, "A, area: ");
    let value = |app: &App, name: &str| -> f64 {
        let node = app.get_by_label_contains(name);
        let text = interface::text_of(&node);
        let number = text.split(": ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a number");
        number.replace('−', "-").parse().expect("a number")
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
fn the_tour_has_four_tasks_that_can_be_skipped_and_repeated() {
    use tautline::app::Start;
    for size in [Vec2::new(1280.0, 800.0), Vec2::new(360.0, 740.0)] {
        let start = Start { scenario: Some(paper()), tour: true, ..Start::default() };
        let mut app = interface::app_sized(start, size);
        for step in 1..=4 {
            let count = app.get_by_label(&format!("{step} of 4")).rect();
            assert!(count.max.x <= size.x && count.max.y <= size.y, "{count:?}");
            let next = if step < 4 { "Skip" } else { "Skip the tour" };
            app.get_by_role_and_label(Role::Button, next).click();
            app.run_steps(3);
        }
        assert!(app.query_by_label_contains("of 4").is_none());
        choose(&mut app, "More", "Tour");
        app.get_by_label("Skip the tour").click();
        app.run_steps(3);
        assert!(app.query_by_label_contains("of 4").is_none());
    }
}

#[test]
fn mode_shapes_can_be_stepped_through() {
    let mut app = app();
    app.get_by_role_and_label(Role::RadioButton, "Mode at 11.3 m/s").click();
    app.run_steps(3);
    interface::wait(&mut app, "the critical mode", |app| {
        app.mode_on_show().is_some_and(|[growth, _]| growth.abs() < 1e-3)
    });
    app.key_press(Key::Period);
    app.run_steps(3);
    app.get_by_role_and_label(Role::Button, "Play");
    // The robot as it is painted: the lines of the cables are its only long ones with this many points.
    let cables = |app: &App| -> Vec<Vec<Pos2>> {
        let canvas = app.get_by_label("Robot canvas").rect();
        let lines = app.output().shapes.iter().filter_map(|clipped| match &clipped.shape {
            Shape::Path(path) if path.points.len() == 11 && path.points.iter().all(|at| canvas.contains(*at)) => {
                Some(path.points.clone())
            }
            _ => None,
        });
        lines.collect()
    };
    let apart = |a: &[Vec<Pos2>], b: &[Vec<Pos2>]| {
        assert!(a.len() == b.len() && a.len() >= 4, "{} and {} lines", a.len(), b.len());
        let distances = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (*a - *b).length());
        distances.fold(0.0, f32::max)
    };
    let before = cables(&app);
    app.get_by_role_and_label(Role::Button, "One step forward").click();
    app.run_steps(3);
    let step = apart(&before, &cables(&app));
    assert!(step > 0.05, "{step}");
    // A step is 15°: half of an oscillation after 12 of them, all of it after 24.
    let mut farthest = step;
    for steps in 2..=24 {
        app.get_by_role_and_label(Role::Button, "One step forward").click();
        app.run_steps(3);
        let away = apart(&before, &cables(&app));
        if steps == 24 {
            assert!(away < 0.02, "{away} points away after a whole oscillation");
        } else {
            assert!(away > 0.05, "back after {steps} steps already");
        }
        farthest = farthest.max(away);
    }
    assert!(farthest > 10.0, "{farthest}");
    app.get_by_role_and_label(Role::Button, "One step forward").click();
    app.run_steps(3);
    app.get_by_role_and_label(Role::Button, "One step back").click();
    app.run_steps(3);
    let away = apart(&before, &cables(&app));
    assert!(away < 0.02, "{away} points away after a step back");
}

#[test]
fn two_fingers_zoom() {
    use eframe::egui::{TouchDeviceId, TouchId, TouchPhase};
    let mut app = app();
    let platform = |app: &App| app.get_by_label("Platform").rect().center();
    let before = platform(&app);
    // Under the robot's middle, where nothing else is.
    let middle = before + Vec2::new(-60.0, 70.0);
    let canvas = app.get_by_label("Robot canvas").rect();
    assert!(
        canvas.contains(middle - Vec2::new(80.0, 0.0)) && canvas.contains(middle + Vec2::new(80.0, 0.0)),
        "{canvas:?}"
    );
    // The first finger is the pointer, too.
    app.drag_at(middle - Vec2::new(30.0, 0.0));
    app.step();
    let mut touch = |phase, apart: f32| {
        app.event(Event::PointerMoved(middle - Vec2::new(apart, 0.0)));
        for (id, side) in [(1, -1.0), (2, 1.0)] {
            let pos = middle + Vec2::new(side * apart, 0.0);
            app.event(Event::Touch { device_id: TouchDeviceId(0), id: TouchId(id), phase, pos, force: None });
        }
        app.step();
    };
    touch(TouchPhase::Start, 30.0);
    for apart in [40.0, 60.0, 80.0] {
        touch(TouchPhase::Move, apart);
    }
    touch(TouchPhase::End, 80.0);
    app.drop_at(middle - Vec2::new(80.0, 0.0));
    app.run_steps(3);
    let zoomed = platform(&app);
    let expected = middle + (before - middle) * (80.0 / 30.0);
    assert!((zoomed - expected).length() < 2.0, "{zoomed:?} in place of {expected:?}, from {before:?}");
    app.get_by_label("Fit robot").click();
    app.run_steps(3);
    assert!((platform(&app) - before).length() < 0.1, "the whole robot is back");
}
