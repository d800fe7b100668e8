//! The numbers that people see and type: what is stored changes only where somebody types something else, and what
//! cannot be read or is not allowed is told beside the field.

#![cfg(feature = "app")]
#![expect(clippy::float_cmp, reason = "what is typed is stored to the last bit")]

#[path = "common/interface.rs"]
mod interface;

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use tautline::app::Tautline;
use tautline::robot::TensionLaw;
use tautline::scenario::Scenario;

use interface::{SIZE, app, app_with, open_groups, open_plot, paper, reach, settle, type_value};

type App = Harness<'static, Tautline>;

/// Every number has a value with more digits than are shown, some of them beyond their sliders' ranges.
fn awkward() -> Scenario {
    let mut scenario = paper();
    scenario.gravity = 9.806_650_000_000_001;
    scenario.cable.youngs_modulus = 1.234_567_890_123_456_7e12;
    scenario.cable.area = 5e-5_f64.next_up();
    scenario.cable.mass_per_length = 0.398_765_432_109_876_5;
    scenario.platform.mass = 2.000_000_123_456_789;
    scenario.damping.alpha = 0.1 + 0.2;
    scenario.damping.beta = 1.234_567_8e-5;
    scenario.motion.position = [1.0 / 3.0, -2.0 / 7.0];
    // Of another length than one, and at an angle that degrees do not hold.
    scenario.motion.direction = [0.3, 0.7];
    scenario.motion.speed = 55.555_555_555_555_55;
    scenario.cables[2].anchor = [-9.876_543_210_987_654, -5.1];
    scenario.cables[3].tension = TensionLaw::Constant(67.312_345_678_901_23);
    scenario
}

/// The numbers as they are stored, bit by bit.
fn bits(scenario: &Scenario) -> Vec<u64> {
    let Scenario { gravity, cable, platform, cables, damping, motion, .. } = scenario;
    let mut all = vec![*gravity, cable.youngs_modulus, cable.area, cable.mass_per_length, platform.mass];
    all.extend([damping.alpha, damping.beta, motion.speed]);
    all.extend(motion.position.into_iter().chain(motion.direction));
    for cable in cables {
        all.extend(cable.anchor);
        match cable.tension {
            TensionLaw::Equilibrium => {}
            TensionLaw::Constant(tension) => all.push(tension),
            TensionLaw::Hypot { horizontal, vertical } => all.extend(horizontal.into_iter().chain(vertical)),
        }
    }
    all.into_iter().map(f64::to_bits).chain([scenario.elements_per_cable as u64]).collect()
}

/// A window that is high enough for all controls at once, so that a click meets what it is meant for, with all groups open.
fn tall(scenario: Scenario) -> App {
    let mut app = app_with(scenario, Vec2::new(SIZE.x, 1900.0), Theme::Light);
    open_groups(&mut app);
    app
}

/// A window as most are, with all groups open.
fn with_groups(scenario: Scenario) -> App {
    let mut app = app_with(scenario, SIZE, Theme::Light);
    open_groups(&mut app);
    app
}

/// Opens the numbers of a cable, and folds those of the one before.
fn open_cable(app: &mut App, number: usize) {
    app.get_by_role_and_label(Role::Button, &format!("Cable {number}")).click();
    app.run_steps(5);
}

fn unlock(app: &mut App) {
    app.get_by_label("Unlock the winches").click();
    app.run_steps(5);
}

/// The fields on the screen, from the first to the last.
fn fields(app: &App) -> Vec<egui_kittest::Node<'_>> {
    app.get_all_by_role(Role::SpinButton).collect()
}

#[test]
fn looking_at_a_number_leaves_it_as_it_is_to_the_last_bit() {
    for stress in ["MPa", "GPa"] {
        let mut app = tall(awkward());
        choose_stress(&mut app, stress);
        unlock(&mut app);
        let before = bits(&awkward());
        // The groups have 12 numbers, the frame 2, a cable's winch 2, its law 6, its tension 1.
        for (cable, expected) in [(1, 16), (3, 22), (4, 17)] {
            open_cable(&mut app, cable);
            assert_eq!(bits(app.state().scenario()), before, "opening cable {cable}");
            let count = fields(&app).len();
            assert!(count >= expected, "cable {cable}: {count} fields");
            for leave in [Key::Tab, Key::Enter, Key::Escape] {
                for i in 0..count {
                    fields(&app)[i].click();
                    app.run_steps(3);
                    app.key_press(leave);
                    app.run_steps(3);
                    assert_eq!(bits(app.state().scenario()), before, "cable {cable}, field {i} left by {leave:?}");
                }
            }
            // A click elsewhere, too, and the sliders.
            for i in 0..count {
                fields(&app)[i].click();
                app.run_steps(2);
            }
            for slider in 0..app.get_all_by_role(Role::Slider).count() {
                app.get_all_by_role(Role::Slider).nth(slider).expect("a slider").focus();
                app.run_steps(2);
                app.key_press(Key::Tab);
                app.run_steps(2);
            }
            assert_eq!(bits(app.state().scenario()), before, "cable {cable}: sliders");
        }
        assert!(!can_undo(&app), "nothing has happened");
    }
}

/// Chooses an entry of the bar's menu.
fn choose(app: &mut App, entry: &str) {
    app.get_by_role_and_label(Role::Button, "More").click();
    app.run_steps(3);
    app.get_by_label_contains(entry).click();
    app.run_steps(3);
}

fn choose_stress(app: &mut App, unit: &str) {
    choose(app, "Settings");
    app.get_by_role_and_label(Role::ComboBox, "Young's modulus in").click();
    app.run_steps(3);
    app.get_by_role_and_label(Role::Button, unit).click();
    app.run_steps(3);
    app.key_press(Key::Escape);
    app.run_steps(3);
}

fn can_undo(app: &App) -> bool {
    !app.get_by_role_and_label(Role::Button, "Undo").accesskit_node().is_disabled()
}

/// What a field shows while nobody edits it.
fn shown(app: &App, label: &str) -> String {
    app.get_by_role_and_label(Role::SpinButton, label).accesskit_node().value().unwrap_or_default()
}

#[test]
fn small_and_large_numbers_are_shown_with_an_exponent() {
    let mut scenario = paper();
    scenario.damping.beta = 4e-7;
    scenario.platform.mass = 2.1e11;
    let mut app = with_groups(scenario);
    assert_eq!(shown(&app, "Stiffness damping β"), "4e-7 s");
    assert_eq!(shown(&app, "Platform mass m"), "2.1e11 kg");
    assert_eq!(shown(&app, "Elements per cable n"), "10");
    click(&mut app, "Stiffness damping β");
    app.key_press(Key::Tab);
    settle(&mut app);
    assert_eq!(app.state().scenario().damping.beta.to_bits(), 4e-7_f64.to_bits());
    let mut scenario = paper();
    scenario.damping.beta = 1.234_567_8e-5;
    let mut app = with_groups(scenario);
    assert_eq!(shown(&app, "Stiffness damping β"), "1.235e-5 s");
    click(&mut app, "Stiffness damping β");
    assert_eq!(edited_text(&app), "1.2345678e-5", "all digits are there to be edited");
    app.key_press(Key::Tab);
    settle(&mut app);
    assert_eq!(app.state().scenario().damping.beta.to_bits(), 1.234_567_8e-5_f64.to_bits());
}

fn click(app: &mut App, label: &str) {
    reach(app, Role::SpinButton, label);
    app.get_by_role_and_label(Role::SpinButton, label).click();
    app.run_steps(3);
}

/// The text in the field that has the focus.
fn edited_text(app: &App) -> String {
    let focused = app.root().children_recursive().find(|node| node.accesskit_node().is_focused());
    focused.expect("a focus").accesskit_node().value().unwrap_or_default()
}

/// Types over what a field holds, without leaving it.
fn type_into(app: &mut App, label: &str, text: &str) {
    click(app, label);
    app.key_press_modifiers(Modifiers::COMMAND, Key::A);
    app.step();
    app.key_press(Key::Backspace);
    app.event(Event::Text(text.into()));
    app.run_steps(2);
}

/// The message beside a field, and what the field itself says of it.
fn told(app: &App, label: &str) -> Option<String> {
    let message = app.query_by_label_contains("▲ ").map(|node| interface::text_of(&node));
    let message = message.map(|text| text.trim_start_matches("▲ ").to_owned());
    if message.is_some() {
        let field = app.get_by_role_and_label(Role::SpinButton, label);
        assert_eq!(field.accesskit_node().description(), message, "the field says so, too");
    }
    message
}

#[test]
fn what_is_typed_is_stored_in_si_units() {
    type Number = fn(&Scenario) -> f64;
    let mut app = with_groups(paper());
    let cases: [(&str, &str, Number, f64); 9] = [
        ("Platform mass m", "1,5", |robot| robot.platform.mass, 1.5),
        ("Platform mass m", "1/3", |robot| robot.platform.mass, 1.0 / 3.0),
        ("Speed v", "2*pi", |robot| robot.motion.speed, 2.0 * std::f64::consts::PI),
        ("Position x", "-12 mm", |robot| robot.motion.position[0], -0.012),
        ("Position y", "2 ft", |robot| robot.motion.position[1], 0.6096),
        ("Young's modulus E", "200 GPa", |robot| robot.cable.youngs_modulus, 200e9),
        ("Young's modulus E", "125", |robot| robot.cable.youngs_modulus, 125e6),
        ("Cross-section A", "50 mm²", |robot| robot.cable.area, 5e-5),
        ("Speed v", "18 km/h", |robot| robot.motion.speed, 5.0),
    ];
    for (label, text, value, expected) in cases {
        type_value(&mut app, label, text);
        assert_eq!(value(app.state().scenario()), expected, "{text:?} into {label}");
        assert_eq!(told(&app, label), None);
    }
    // The footer has nothing to say of it.
    assert_eq!(app.state().notice(), None);
}

#[test]
fn what_is_not_read_or_not_allowed_is_told_beside_the_field_and_the_old_value_stays() {
    let cases = [
        ("Young's modulus E", "abc", "“abc” is neither a number nor a unit"),
        ("Young's modulus E", "12 kg", "E is a stress; kg is a mass"),
        ("Young's modulus E", "1e999", "“1e999” is too large a number"),
        ("Young's modulus E", "-5", "E must be more than 0 MPa, not -5 MPa"),
        ("Cross-section A", "0", "A must be more than 0 cm², not 0 cm²"),
        ("Position x", "12 kg", "x is a length; kg is a mass"),
        ("Speed v", "-1", "v must be 0 m/s or more, not -1 m/s: turn the direction round to go back"),
        ("Elements per cable n", "2,5", "n must be a whole number from 2 to 200, not 2.5"),
        ("Elements per cable n", "1000", "n must be a whole number from 2 to 200, not 1000"),
        ("Mass damping α", "1,234.5", "“1,234.5” has commas or points between thousands: write 1234.5"),
        ("Mass damping α", "NaN", "“NaN” is neither a number nor a unit"),
        ("Platform mass m", "", "m needs a number"),
    ];
    for leave in [Key::Enter, Key::Tab] {
        let mut app = with_groups(paper());
        for (label, text, expected) in cases {
            type_into(&mut app, label, text);
            app.key_press(leave);
            settle(&mut app);
            assert_eq!(told(&app, label).as_deref(), Some(expected), "{text:?} into {label}");
            assert_eq!(*app.state().scenario(), paper());
            assert_eq!(app.state().notice(), None, "the footer is for other things");
            let message = app.get_by_label_contains(expected).rect();
            assert!(message.left() >= 0.0 && message.right() <= 400.0, "{message:?} is beside the controls");
            if leave == Key::Enter {
                // The text is still there to be mended.
                assert_eq!(edited_text(&app), text);
                app.key_press(Key::Escape);
            } else {
                click(&mut app, label);
                assert_eq!(told(&app, label), None, "{label} is edited again");
                app.key_press(Key::Tab);
            }
            app.run_steps(3);
            assert_eq!(told(&app, label), None, "{label} has been left");
        }
        assert!(!can_undo(&app));
    }
}

#[test]
fn a_message_goes_when_its_text_is_mended_or_the_robot_changes() {
    let mut app = with_groups(paper());
    type_into(&mut app, "Platform mass m", "-1");
    app.key_press(Key::Enter);
    app.run_steps(3);
    assert!(told(&app, "Platform mass m").is_some());
    app.key_press(Key::Backspace);
    app.run_steps(2);
    assert_eq!(told(&app, "Platform mass m"), None);
    app.event(Event::Text("\u{8}".into()));
    app.key_press_modifiers(Modifiers::COMMAND, Key::A);
    app.event(Event::Text("3".into()));
    app.key_press(Key::Enter);
    settle(&mut app);
    assert_eq!(app.state().scenario().platform.mass, 3.0);

    type_into(&mut app, "Platform mass m", "-1");
    app.key_press(Key::Tab);
    app.run_steps(3);
    assert!(told(&app, "Platform mass m").is_some());
    type_value(&mut app, "Gravity g", "1.62");
    assert_eq!(told(&app, "Platform mass m"), None);
}

#[test]
fn nothing_moves_when_a_message_appears() {
    let mut app = tall(paper());
    let rects = |app: &App| -> Vec<_> { fields(app).iter().map(egui_kittest::Node::rect).collect() };
    let before = rects(&app);
    type_into(&mut app, "Young's modulus E", "a text that is far longer than the field is wide, and no number");
    app.key_press(Key::Tab);
    app.run_steps(5);
    assert!(told(&app, "Young's modulus E").is_some());
    assert_eq!(rects(&app), before);
    // Nor by a number that has many digits.
    type_value(&mut app, "Position x", "-1.23456789012345e-12");
    type_value(&mut app, "Young's modulus E", "1.23456789012345e11");
    assert_eq!(rects(&app), before);
}

#[test]
fn a_fault_of_another_field_is_told_beside_the_one_edited() {
    let mut app = tall(paper());
    unlock(&mut app);
    open_cable(&mut app, 1);
    // Onto winch 3, which comes later in the file, so that it is the file's fault there.
    type_into(&mut app, "y", "-5");
    app.key_press(Key::Enter);
    settle(&mut app);
    assert_eq!(told(&app, "y").as_deref(), Some("Winch 3 must not be where winch 1 is"));
    assert_eq!(*app.state().scenario(), paper());
    app.key_press(Key::Escape);
    app.run_steps(3);
    type_into(&mut app, "Width", "-3");
    app.key_press(Key::Tab);
    settle(&mut app);
    assert_eq!(told(&app, "Width").as_deref(), Some("Width must be more than 0 m"));
}

#[test]
fn esc_takes_back_what_was_typed_and_closes_nothing_else() {
    let mut app = with_groups(paper());
    choose(&mut app, "Keyboard shortcuts");
    let window = "Undo the last step; a drag is one step";
    assert!(app.query_by_label_contains(window).is_some());
    type_into(&mut app, "Platform mass m", "7");
    app.key_press(Key::Escape);
    settle(&mut app);
    assert_eq!(*app.state().scenario(), paper());
    assert_eq!(shown(&app, "Platform mass m"), "2 kg");
    assert!(app.query_by_label_contains(window).is_some(), "the window stays open");
    assert!(!can_undo(&app), "there is nothing to take back");
    app.run_steps(90);
    assert_eq!(*app.state().scenario(), paper());
    // The next one closes the window.
    app.key_press(Key::Escape);
    app.run_steps(5);
    assert!(app.query_by_label_contains(window).is_none());
}

#[test]
fn reset_brings_back_the_very_number() {
    let mut app = tall(awkward());
    let labels =
        ["Speed v", "Direction θ", "Position x", "Young's modulus E", "Cross-section A", "Stiffness damping β"];
    for label in labels {
        type_value(&mut app, label, "3");
        assert_ne!(bits(app.state().scenario()), bits(&awkward()));
        app.get_by_role_and_label(Role::Button, &format!("Reset {label}")).click();
        settle(&mut app);
        assert!(app.query_by_label_contains("Reset ").is_none(), "there is nothing to reset any more");
        assert_eq!(bits(app.state().scenario()), bits(&awkward()), "{label}");
    }
}

#[test]
fn what_plots_are_looked_at_with_is_typed_alike() {
    let mut app = app();
    open_plot(&mut app, "Speed diagram");
    let label = "Highest frequency";
    let begun = std::time::Instant::now();
    while app.query_all_by_label(label).next().is_none() {
        assert!(begun.elapsed() < interface::PATIENCE, "no {label}");
        std::thread::sleep(std::time::Duration::from_millis(2));
        app.step();
    }
    assert_eq!(shown(&app, label), "5 Hz");
    type_into(&mut app, label, "62,83185 rad/s");
    app.key_press(Key::Enter);
    app.run_steps(5);
    assert_eq!(shown(&app, label), "10 Hz");
    type_into(&mut app, label, "2 kHz");
    app.key_press(Key::Tab);
    app.run_steps(5);
    assert_eq!(told(&app, label).as_deref(), Some("Highest frequency must be from 0.5 Hz to 100 Hz"));
    assert_eq!(shown(&app, label), "10 Hz");
    type_into(&mut app, label, "5/3");
    app.key_press(Key::Enter);
    app.run_steps(5);
    assert_eq!(shown(&app, label), "1.667 Hz");
    click(&mut app, label);
    let thirds = edited_text(&app);
    assert_eq!(thirds.parse(), Ok(5.0 / 3.0), "{thirds}");
}

#[test]
fn a_hand_that_drags_too_far_stops_at_zero() {
    let mut app = with_groups(paper());
    reach(&mut app, Role::SpinButton, "Speed v");
    let field = app.get_by_role_and_label(Role::SpinButton, "Speed v").rect().center();
    interface::drag(&mut app, field, field - Vec2::new(300.0, 0.0));
    settle(&mut app);
    assert_eq!(app.state().scenario().motion.speed, 0.0);
    assert_eq!(told(&app, "Speed v"), None);
    reach(&mut app, Role::SpinButton, "Stiffness damping β");
    let field = app.get_by_role_and_label(Role::SpinButton, "Stiffness damping β").rect().center();
    interface::drag(&mut app, field, field + Vec2::new(20.0, 0.0));
    settle(&mut app);
    let beta = app.state().scenario().damping.beta;
    assert!(beta > 0.0055 && beta < 0.0065, "{beta}");
}

#[test]
fn an_edit_on_the_canvas_is_refused_in_the_same_words() {
    let mut app = app();
    unlock(&mut app);
    let handle = |name: &str| app.get_by_label(name).rect().center();
    let (from, to) = (handle("Winch 3"), handle("Winch 1"));
    interface::drag(&mut app, from, to);
    settle(&mut app);
    assert_eq!(app.state().notice(), Some("Winch 3 must not be where winch 1 is."));
}

#[test]
fn a_drag_changes_only_what_it_moves() {
    // Not so far from the middle that there is no equilibrium, and at a speed whose arrow fits.
    let mut scenario = awkward();
    scenario.motion.speed = 4.987_654_321;
    let mut app = app_with(scenario.clone(), SIZE, Theme::Light);
    let place = |app: &App, name: &str| app.get_by_label(name).rect().center();

    let platform = place(&app, "Platform");
    interface::drag(&mut app, platform, platform + Vec2::new(40.0, 0.0));
    settle(&mut app);
    let motion = app.state().scenario().motion;
    assert!(motion.position[0] > scenario.motion.position[0] + 0.5, "{motion:?}");
    assert_eq!(motion.position[1].to_bits(), scenario.motion.position[1].to_bits());
    scenario.motion.position[0] = motion.position[0];
    assert_eq!(bits(app.state().scenario()), bits(&scenario));

    // The arrow is drawn longer in its own direction: faster, and not turned.
    let (platform, tip) = (place(&app, "Platform"), place(&app, "Velocity"));
    interface::drag(&mut app, tip, tip + (tip - platform) * 0.3);
    settle(&mut app);
    let motion = app.state().scenario().motion;
    assert!(motion.speed > scenario.motion.speed + 0.5, "{motion:?}");
    scenario.motion.speed = motion.speed;
    assert_eq!(bits(app.state().scenario()), bits(&scenario));

    // There and back again.
    for name in ["Platform", "Velocity"] {
        let from = place(&app, name);
        app.hover_at(from);
        app.step();
        app.drag_at(from);
        app.step();
        for by in [Vec2::new(30.0, 25.0), Vec2::new(-20.0, 10.0), Vec2::ZERO] {
            app.hover_at(from + by);
            app.run_steps(2);
        }
        app.drop_at(from);
        settle(&mut app);
        assert_eq!(bits(app.state().scenario()), bits(&scenario), "{name}");
    }
}

/// Where frames are slow a click and all that is typed after it come in one.
#[test]
fn what_is_typed_faster_than_frames_are_drawn_is_not_lost() {
    let mut app = with_groups(paper());
    let modifiers = Modifiers::default();
    for name in ["Cable mass μ", "Young's modulus E"] {
        reach(&mut app, Role::SpinButton, name);
    }
    let typed = [("Young's modulus E", "0.2 GPa"), ("Cross-section A", "60 mm²"), ("Cable mass μ", "500 g/m")];
    for (name, text) in typed {
        let pos = app.get_by_role_and_label(Role::SpinButton, name).rect().center();
        let button = |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers };
        let letters = text.chars().map(|letter| Event::Text(letter.into()));
        app.input_mut()
            .events
            .extend([Event::PointerMoved(pos), button(true), button(false)].into_iter().chain(letters));
    }
    let key = |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
    app.input_mut().events.push(key(Key::Enter));
    app.run_steps(30);
    settle(&mut app);
    let cable = app.state().scenario().cable;
    assert_eq!((cable.youngs_modulus, cable.area, cable.mass_per_length), (0.2e9, 6e-5, 0.5));
}
