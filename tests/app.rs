//! The interface without a browser or a window: found by accessibility label, moved by real pointer events.

#![cfg(feature = "app")]

use std::time::{Duration, Instant};

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, PointerButton, Pos2, Theme, Vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, Node};
use tautline::app::Tautline;
use tautline::compute::protocol::Topic;
use tautline::robot::{Linearisation, Strain, TensionLaw};
use tautline::scenario::{Scenario, presets};

use interface::{
    PATIENCE, SIZE, app, app_with, cold, drag, figure, label, open_groups, open_plot, paper, reach, report, rounds,
    settle, text_of, type_value, wait, wait_for_label,
};

#[path = "common/interface.rs"]
mod interface;

#[test]
fn shows_the_papers_robot_and_its_critical_speed() {
    let app = app();
    let critical = report(&app).critical.expect("a critical speed");
    // Independent figure: docs/theory.md, reference numbers.
    assert!((critical.speed - 11.2990).abs() < 1e-4, "{critical:?}");
    app.get_by_label("11.3 m/s");
    assert!(app.state().analysis().is_some_and(|analysis| analysis.current));
    let card = texts_in(&app, "Answer");
    let says = |text: &str| card.iter().any(|other| other == text);
    assert!(says("flutter") && says("cable 4") && says("stable now"), "{card:?}");
    let frequency = card.iter().find(|text| text.ends_with(" Hz")).expect("a frequency");
    assert!(rounds(frequency, "", critical.frequency_hz) && frequency.starts_with("0.27"), "{frequency}");
    // 6.30 m/s of 11.30 m/s.
    assert!(card.iter().any(|text| text.starts_with("56 % below. ")), "{card:?}");
    assert!(!card.iter().any(|text| text.starts_with("Recomputing")), "{card:?}");
}

/// What stands in a part of the screen.
fn texts_in(app: &Harness<'static, Tautline>, region: &str) -> Vec<String> {
    let part = app.get_by_role_and_label(Role::Region, region).rect();
    let all = app.get_all_by(|node| node.raw_bounds().is_some());
    all.filter(|node| part.contains_rect(node.rect())).map(|node| text_of(&node)).collect()
}

#[test]
fn dragging_the_platform_to_x_6_shows_the_reference_speed() {
    let mut app = app();
    app.get_by_label("Unlock the winches").click();
    app.run_steps(3);
    let scale = f64::from(winch(&app, 2).x - winch(&app, 1).x) / 20.0;
    assert!((10.0..60.0).contains(&scale), "{scale} points per metre");
    let platform = app.get_by_label("Platform").rect().center();
    let before = app.state().scenario().motion.position;
    drag(&mut app, platform, platform + Vec2::new(60.0, 0.0));
    settle(&mut app);
    let moved = app.state().scenario().motion.position;
    // To the roundest number within the point.
    assert!((moved[0] - before[0] - 60.0 / scale).abs() < 1.0 / scale, "{moved:?}");
    assert!((moved[1] - before[1]).abs() < 1e-3, "a horizontal drag moved y to {}", moved[1]);

    let platform = app.get_by_label("Platform").rect().center();
    let to = on_canvas(&app, [6.0, 0.0]);
    drag(&mut app, platform, to);
    settle(&mut app);
    let position = app.state().scenario().motion.position;
    assert!((position[0] - 6.0).abs() < 1e-3, "{position:?}");
    let critical = report(&app).critical.expect("a critical speed");
    // 10.0125 m/s at (6, 0); within the millimetre of a drag the speed changes by less than 1e-3 m/s.
    assert!((critical.speed - 10.0125).abs() < 1e-3, "{critical:?}");
    assert_eq!(report(&app), cold(app.state().scenario()), "a drag and a cold start differ");
}

#[test]
fn arrow_keys_move_the_platform_and_shift_makes_them_fine() {
    let mut app = app();
    app.get_by_label("Platform").focus();
    app.run_steps(2);
    app.key_press(Key::ArrowRight);
    settle(&mut app);
    let [x, _] = app.state().scenario().motion.position;
    assert!((x - 0.1).abs() < 1e-12, "{x}");
    app.key_press_modifiers(Modifiers::SHIFT, Key::ArrowUp);
    settle(&mut app);
    let [x, y] = app.state().scenario().motion.position;
    assert!((x - 0.1).abs() < 1e-12 && (y - 0.01).abs() < 1e-12, "{x} {y}");
}

#[test]
fn the_arrows_tip_sets_speed_and_direction() {
    let mut app = app();
    let platform = app.get_by_label("Platform").rect().center();
    let tip = app.get_by_label("Velocity").rect().center();
    drag(&mut app, tip, platform + Vec2::new(0.0, -(tip - platform).length()));
    settle(&mut app);
    let motion = app.state().scenario().motion;
    // Up on the screen is +y; the same length of arrow is the same speed.
    assert!(motion.direction[0].abs() < 1e-3 && (motion.direction[1] - 1.0).abs() < 1e-3, "{motion:?}");
    assert!((motion.speed - 5.0).abs() < 0.05, "{motion:?}");
    // A critical speed does not depend on today's speed.
    let now = report(&app).critical.map(|c| c.speed);
    let tip = app.get_by_label("Velocity").rect().center();
    drag(&mut app, tip, tip + Vec2::new(0.0, -40.0));
    settle(&mut app);
    assert!(app.state().scenario().motion.speed > 5.5);
    assert_eq!(report(&app).critical.map(|c| c.speed), now);
}

#[test]
fn sliders_and_typed_values_change_the_robot() {
    type Get = fn(&Scenario) -> f64;
    let mut app = app();
    open_groups(&mut app);
    let cases: [(&str, &str, Get, f64); 8] = [
        ("Young's modulus E", "200", |s| s.cable.youngs_modulus, 200e6),
        ("Cross-section A", "0.6", |s| s.cable.area, 0.6e-4),
        ("Cable mass μ", "0.3", |s| s.cable.mass_per_length, 0.3),
        ("Platform mass m", "3", |s| s.platform.mass, 3.0),
        ("Gravity g", "1.62", |s| s.gravity, 1.62),
        ("Mass damping α", "0.4", |s| s.damping.alpha, 0.4),
        ("Stiffness damping β", "0.004", |s| s.damping.beta, 0.004),
        ("Elements per cable n", "8", |s| f64::from(u32::try_from(s.elements_per_cable).unwrap()), 8.0),
    ];
    for (label, text, get, expected) in cases {
        let before = report(&app).critical.map(|c| c.speed);
        type_value(&mut app, label, text);
        let value = get(app.state().scenario());
        assert!((value / expected - 1.0).abs() < 1e-12, "{label}: {value} in place of {expected}");
        assert_ne!(report(&app).critical.map(|c| c.speed), before, "{label} changed nothing");
    }
    assert_eq!(report(&app), cold(app.state().scenario()));

    // The slider beside the typed value.
    let slider = app.get_by_role_and_label(Role::Slider, "Speed v");
    slider.set_value_accesskit(12.0);
    settle(&mut app);
    let speed = app.state().scenario().motion.speed;
    assert!((speed - 12.0).abs() < 1e-9, "{speed}");

    // And back to what they were.
    for name in cases.map(|(name, ..)| name).into_iter().chain(["Speed v"]) {
        let reset = format!("Reset {name}");
        reach(&mut app, Role::Button, &reset);
        app.get_by_role_and_label(Role::Button, &reset).click();
        settle(&mut app);
        assert!(app.query_by_label(&reset).is_none(), "{reset} has nothing left to do");
    }
    assert_eq!(app.state().scenario(), &paper());
}

fn click_at(app: &mut Harness<'static, Tautline>, centre: Pos2) {
    app.hover_at(centre);
    app.step();
    for pressed in [true, false] {
        let modifiers = Modifiers::default();
        app.event(eframe::egui::Event::PointerButton {
            pos: centre,
            button: PointerButton::Primary,
            pressed,
            modifiers,
        });
        app.step();
    }
    app.step();
}

#[test]
fn choices_change_the_model() {
    let mut app = app();
    open_groups(&mut app);
    reach(&mut app, Role::RadioButton, "Tangent");
    app.get_by_label("Tangent").click();
    settle(&mut app);
    assert_eq!(app.state().scenario().linearisation, Linearisation::Tangent);
    let critical = report(&app).critical.expect("a critical speed");
    // Reference case 6: 10.906966 m/s.
    assert!((critical.speed - 10.906_966).abs() < 1e-4, "{critical:?}");
    app.get_by_label("Engineering").click();
    settle(&mut app);
    assert_eq!(app.state().scenario().cable.strain, Strain::Engineering);
    assert_eq!(report(&app), cold(app.state().scenario()));
}

#[test]
fn tension_laws_can_be_edited_and_replaced_by_constants() {
    let mut app = app();
    let cable = app.get_by_role_and_label(Role::Button, "Cable 3");
    assert!(cable.value().is_some_and(|value| value.contains("by law")), "{:?}", cable.value());
    cable.click();
    settle(&mut app);
    type_value(&mut app, "h0", "55");
    let TensionLaw::Hypot { horizontal, .. } = app.state().scenario().cables[2].tension else { panic!("no law") };
    assert!((horizontal[0] - 55.0).abs() < 1e-12, "{horizontal:?}");
    reach(&mut app, Role::ComboBox, "Tension law of cable 3");
    app.get_by_role_and_label(Role::ComboBox, "Tension law of cable 3").click();
    app.run_steps(3);
    app.get_by_label("constant").click();
    settle(&mut app);
    let TensionLaw::Constant(tension) = app.state().scenario().cables[2].tension else { panic!("no constant") };
    // The constant starts where the law was: hypot(55, 45).
    assert!((tension - 55.0_f64.hypot(45.0)).abs() < 1e-9, "{tension}");
    assert_eq!(report(&app), cold(app.state().scenario()));
}

#[test]
fn an_infeasible_pose_is_told_and_recovered_from() {
    let mut app = app();
    let platform = app.get_by_label("Platform").rect().center();
    drag(&mut app, platform, platform + Vec2::new(230.0, 0.0));
    settle(&mut app);
    assert!(app.state().scenario().motion.position[0] > 7.5, "{:?}", app.state().scenario().motion);
    let told = report(&app);
    assert!(told.feasible == Some(false) && told.critical.is_none() && told.eigenvalues.is_empty(), "{told:?}");
    let reason = told.reason.expect("a reason");
    assert!(reason.contains("able 1 would have to push") && reason.ends_with('.'), "{reason}");
    app.get_by_label(&reason);
    nothing_shows_nan(&app);

    let platform = app.get_by_label("Platform").rect().center();
    drag(&mut app, platform, platform - Vec2::new(100.0, 0.0));
    settle(&mut app);
    assert_eq!(report(&app).feasible, Some(true));
    let card = texts_in(&app, "Answer");
    assert!(card.iter().any(|text| text.contains("A disturbance halves every ")), "{card:?}");
    assert_eq!(report(&app), cold(app.state().scenario()));
}

#[test]
fn a_mode_is_chosen_in_the_table_and_followed() {
    let mut app = app();
    open_plot(&mut app, "Modes");
    settle(&mut app);
    let spectrum = report(&app).eigenvalues;
    // The third row's frequency cell; rows are sorted by frequency, each of two equal eigenvalues.
    let mut frequencies: Vec<f64> = spectrum.iter().map(|l| l[1]).filter(|im| *im > 0.0).collect();
    frequencies.sort_by(f64::total_cmp);
    let third = frequencies[4];
    let cell = |text: &str| text.parse::<f64>().is_ok() && rounds(text, "", third / std::f64::consts::TAU);
    let centre = app
        .get_all_by(|node| cell(&node.label().or(node.value()).unwrap_or_default()))
        .next()
        .expect("the third mode's row")
        .rect()
        .center();
    click_at(&mut app, centre);
    wait(&mut app, "the third mode", |app| app.mode_on_show().is_some_and(|l| (l[1] - third).abs() < 1e-9));

    // It is followed as the robot changes a little.
    app.get_by_label("Platform").focus();
    app.run_steps(2);
    app.key_press(Key::ArrowRight);
    settle(&mut app);
    let followed = app.state().mode_on_show().expect("a mode");
    assert!((followed[1] - third).abs() < 0.05 * third && (followed[1] - third).abs() > 0.0, "{followed:?} {third}");
    let at_critical = |label: &str| label.starts_with("Mode at ");
    let steady = app.get_by(|node| node.role() == Role::RadioButton && node.label().is_some_and(|l| at_critical(&l)));
    steady.click();
    let critical = report(&app).critical.expect("a critical speed").frequency_hz * std::f64::consts::TAU;
    wait(&mut app, "the critical mode", |app| app.mode_on_show().is_some_and(|l| (l[1] - critical).abs() < 1e-9));
}

#[test]
fn examples_load_from_the_list() {
    let mut app = app();
    app.get_by_role_and_label(Role::ComboBox, "Robot").click();
    app.run_steps(3);
    app.get_by_label(presets::PRESETS[1].title).click();
    settle(&mut app);
    assert_eq!(app.state().scenario(), &presets::PRESETS[1].scenario());
}

#[test]
fn works_on_a_phone_and_in_the_dark() {
    let mut app = app_with(paper(), Vec2::new(360.0, 740.0), Theme::Dark);
    app.get_by_label("11.3 m/s");
    let platform = app.get_by_label("Platform").rect().center();
    drag(&mut app, platform, platform + Vec2::new(20.0, 0.0));
    settle(&mut app);
    assert!(app.state().scenario().motion.position[0] > 0.5);
    app.get_by_role_and_label(Role::Tab, "Plots").click();
    settle(&mut app);
    app.get_by_label("Eigenvalues");
    let screen = Vec2::new(360.0, 740.0);
    for label in ["Platform", "Velocity", "Eigenvalues", "Modes"] {
        let rect = app.get_by_label(label).rect();
        assert!(rect.max.x <= screen.x + 1.0 && rect.min.x >= -1.0, "{label} sticks out: {rect:?}");
    }
    nothing_shows_nan(&app);
}

fn nothing_shows_nan(app: &Harness<'static, Tautline>) {
    let shown = |node: &Node<'_>| {
        let node = node.accesskit_node();
        format!("{} {}", node.label().unwrap_or_default(), node.value().unwrap_or_default())
    };
    let texts: Vec<String> = app.get_all_by(|_| true).map(|node| shown(&node)).collect();
    assert!(texts.len() > 20, "only {} nodes", texts.len());
    let bad: Vec<&String> = texts.iter().filter(|text| text.contains("NaN") || text.contains("inf ")).collect();
    assert!(bad.is_empty(), "{bad:?}");
}

#[test]
fn the_wheel_zooms_about_the_pointer_and_a_double_click_goes_back() {
    let mut app = app();
    let platform = |app: &Harness<'static, Tautline>| app.get_by_label("Platform").rect().center();
    let home = platform(&app);
    let fixed = home + Vec2::new(0.0, -100.0);
    app.hover_at(fixed);
    app.step();
    app.event(eframe::egui::Event::MouseWheel {
        unit: eframe::egui::MouseWheelUnit::Point,
        delta: Vec2::new(0.0, 120.0),
        phase: eframe::egui::TouchPhase::Move,
        source: eframe::egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::default(),
    });
    app.run_steps(60); // The wheel is smoothed over some frames.
    let zoomed = platform(&app);
    // The pointer's point stays; what is below it moves away from it, straight down.
    assert!(zoomed.y > home.y + 20.0 && (zoomed.x - home.x).abs() < 1.0, "{home:?} {zoomed:?}");

    drag(&mut app, fixed, fixed + Vec2::new(50.0, 10.0));
    let panned = platform(&app);
    assert!((panned - zoomed - Vec2::new(50.0, 10.0)).length() < 1.0, "{zoomed:?} {panned:?}");
    assert_eq!(app.state().scenario(), &paper(), "looking changes nothing");

    app.run_steps(30); // So that the drag's click is long past.
    for _ in 0..2 {
        click_at(&mut app, fixed);
    }
    app.run_steps(3);
    assert!((platform(&app) - home).length() < 0.5, "{:?}", platform(&app));
}

#[test]
fn a_click_on_an_eigenvalue_shows_its_mode() {
    let mut app = app();
    let first = app.state().mode_on_show().expect("a mode");
    let plot = app.get_by_label_contains("Eigenvalues: ").rect();
    let mut chosen = None;
    'search: for up in 0..12_u8 {
        for left in 0..8_u8 {
            let point = plot.right_bottom() - Vec2::new(30.0 * (f32::from(left) + 1.0), 30.0 * (f32::from(up) + 1.0));
            assert!(plot.contains(point), "searched the whole plot");
            click_at(&mut app, point);
            app.run_steps(2);
            std::thread::sleep(Duration::from_millis(20));
            app.step();
            chosen = app.state().mode_on_show().filter(|mode| mode.map(f64::to_bits) != first.map(f64::to_bits));
            if chosen.is_some() {
                break 'search;
            }
        }
    }
    let chosen = chosen.expect("a click near an eigenvalue chooses it");
    let known = report(&app).eigenvalues;
    assert!(known.contains(&chosen), "{chosen:?} is none of the eigenvalues");
}

#[test]
fn the_growth_plot_belongs_to_the_robot_on_show() {
    let mut app = app();
    open_plot(&mut app, "Growth");
    wait_for_label(&mut app, "Growth: the largest growth rate against speed. ");
    let told = label(&app, "Growth: the largest growth rate against speed. ");
    assert!(told.ends_with("It crosses zero at 11.3 m/s."), "{told}");
}

/// Steps until a study is finished.
fn finish(app: &mut Harness<'static, Tautline>, topic: Topic) {
    app.run_steps(3);
    wait(app, "a study", |app| app.study(topic).2);
    app.run_steps(20); // The picture is made anew every tenth of a second.
}

/// Moves the pointer to a point of the world on the canvas, in m.
fn on_canvas(app: &Harness<'static, Tautline>, [x, y]: [f64; 2]) -> Pos2 {
    let [left, right] = [1, 2].map(|cable| winch(app, cable));
    let scale = (right.x - left.x) / 20.0;
    #[expect(clippy::cast_possible_truncation)]
    let [x, y] = [x as f32, y as f32];
    Pos2::new(left.x + (x + 10.0) * scale, left.y - (y - 5.0) * scale)
}

/// Where a winch is on the screen; it can be grabbed there once it is unlocked.
fn winch(app: &Harness<'static, Tautline>, cable: usize) -> Pos2 {
    app.get_by_role_and_label(Role::Button, &format!("Winch {cable}")).rect().center()
}

fn switch_the_map_on(app: &mut Harness<'static, Tautline>) {
    app.get_by_role_and_label(Role::Button, "Map").click();
    app.run_steps(3);
}

/// Has the map on the canvas, and nothing else at work.
fn switch_the_map_alone_on(app: &mut Harness<'static, Tautline>) {
    finish(app, Topic::Line);
    app.get_by_label("Unlock the winches").click();
    app.run_steps(3);
    switch_the_map_on(app);
}

#[test]
fn the_map_reads_what_the_core_says_and_a_click_moves_the_platform() {
    let mut app = app();
    switch_the_map_alone_on(&mut app);
    finish(&mut app, Topic::Map);
    assert_eq!(app.state().study(Topic::Map).1, 41 * 21);
    assert!(app.query_by_label("Cancel").is_none(), "nothing is left to cancel");

    // Near (3, 1), a point of the map.
    app.hover_at(on_canvas(&app, [3.05, 1.04]));
    app.run_steps(3);
    let mut scenario = paper();
    scenario.motion.position = [3.0, 1.0];
    let expected = cold(&scenario).critical.expect("a critical speed");
    let text = text_of(&app.get_by_label_contains("At (3.00, 1.00) m"));
    assert!(
        rounds(&text, "At (3.00, 1.00) m:\ncritical speed ", expected.speed)
            && text.contains(&format!("cable {}\nwave limit ", expected.cable)),
        "{text}"
    );
    app.hover_at(on_canvas(&app, [9.9, 0.0]));
    app.run_steps(3);
    assert!(app.query_by_label_contains("At (10.00, 0.00) m:\nno equilibrium").is_some());

    let before = app.state().study(Topic::Map);
    let there = on_canvas(&app, [3.0, 1.0]);
    click_at(&mut app, there);
    settle(&mut app);
    let [x, y] = app.state().scenario().motion.position;
    assert!((x - 3.0).abs() < 0.05 && (y - 1.0).abs() < 0.05, "{x} {y}");
    assert_eq!(app.state().study(Topic::Map), before, "the map does not depend on the pose");

    // Another quantity of the same study, then another study and back: nothing is computed twice.
    for (quantity, again) in [("Frequency", true), ("Cable", true), ("Growth rate", false), ("Critical speed", true)] {
        app.get_by_role_and_label(Role::ComboBox, "Map quantity").click();
        app.run_steps(3);
        // A tab has the same name; the last one of that name is the entry of the list.
        let entry = app.get_all_by_label(quantity).last().expect("an entry").rect().center();
        click_at(&mut app, entry);
        app.run_steps(2);
        assert_eq!(app.state().study(Topic::Map).2, again, "{quantity}");
    }
    nothing_shows_nan(&app);
}

#[test]
fn a_map_can_be_cancelled_resumed_and_begins_anew_with_another_robot() {
    let mut app = app();
    switch_the_map_alone_on(&mut app);
    wait(&mut app, "the map", |app| app.study(Topic::Map).0 > 0);
    app.get_by_label("Cancel").click();
    app.run_steps(5);
    let stopped = app.state().study(Topic::Map);
    assert!(stopped.0 < stopped.1 && !stopped.2, "{stopped:?}");
    std::thread::sleep(Duration::from_millis(200));
    app.run_steps(5);
    assert_eq!(app.state().study(Topic::Map), stopped, "it goes on");
    app.get_by_label("Resume").click();
    finish(&mut app, Topic::Map);
    open_groups(&mut app);

    let reading = |app: &mut Harness<'static, Tautline>| {
        app.hover_at(on_canvas(app, [1.0, 1.0]));
        app.run_steps(3);
        text_of(&app.get_by_label_contains("At (1.00, 1.00) m"))
    };
    let before = reading(&mut app);
    type_value(&mut app, "Young's modulus E", "200");
    finish(&mut app, Topic::Map);
    let after = reading(&mut app);
    assert_ne!(before, after);
    let mut scenario = app.state().scenario().clone();
    scenario.motion.position = [1.0, 1.0];
    let expected = cold(&scenario).critical.expect("a critical speed").speed;
    assert!(rounds(&after, "critical speed ", expected), "{after} in place of {expected}");

    // Nothing is computed while the map is switched off.
    app.get_by_role_and_label(Role::Button, "Map").click();
    app.run_steps(3);
    type_value(&mut app, "Young's modulus E", "210");
    app.run_steps(5);
    assert!(!app.state().study(Topic::Map).2);
}

/// The words above or below a plot that contain `part`; the plot itself may say the same to those who do not see it.
fn words(app: &Harness<'static, Tautline>, part: &str) -> String {
    let mut texts = app.get_all_by_role(Role::Label).map(|node| text_of(&node).replace('\u{a0}', " "));
    texts.rfind(|text| text.contains(part)).unwrap_or_else(|| panic!("no {part:?}"))
}

#[test]
fn the_line_shows_both_findings_and_follows_the_robot() {
    let mut app = app();
    open_plot(&mut app, "Along the line");
    finish(&mut app, Topic::Line);
    // The paper's findings hold for its robot on the middle line.
    let text = words(&app, "as the paper found");
    // docs/theory.md section 10: both from the middle to the place where another mode comes first, and not beyond.
    assert!(text.contains("critical speed falls") && text.contains("the frequency rises"), "{text}");
    assert!(text.contains("x = 0.0 m to x = 2.") && !text.contains("x = 7"), "{text}");
    app.get_by_label("What am I seeing?").click();
    app.run_steps(30);
    assert!(app.query_by_label_contains("The platform passes every point of the straight line").is_some());

    // Along the line nothing changes; beside it everything does.
    app.get_by_label("Platform").focus();
    app.run_steps(2);
    app.key_press(Key::ArrowRight);
    settle(&mut app);
    assert!(app.state().study(Topic::Line).2);
    app.key_press(Key::ArrowUp);
    app.run_steps(2);
    assert!(!app.state().study(Topic::Line).2);
    finish(&mut app, Topic::Line);
    nothing_shows_nan(&app);
}

#[test]
fn one_click_moves_in_the_worst_direction() {
    let mut app = app();
    open_plot(&mut app, "Directions");
    finish(&mut app, Topic::Directions);
    let lowest = (0..72)
        .filter_map(|k| {
            let (sine, cosine) = (f64::from(k) * 5.0).to_radians().sin_cos();
            let mut scenario = paper();
            scenario.motion.direction = [cosine, sine];
            cold(&scenario).critical.map(|critical| critical.speed)
        })
        .fold(f64::INFINITY, f64::min);
    assert!(rounds(&label(&app, "Directions: "), ", lowest ", lowest), "{lowest}");
    app.get_by_label("Turn to lowest").click();
    settle(&mut app);
    let speed = report(&app).critical.expect("a critical speed").speed;
    assert!((speed - lowest).abs() < 1e-6, "{speed} in place of {lowest}");
    assert!(app.state().study(Topic::Directions).2, "the diagram does not depend on the direction");
    nothing_shows_nan(&app);
}

#[test]
fn a_click_on_the_campbell_diagram_sets_the_speed() {
    let mut app = app();
    open_plot(&mut app, "Speed diagram");
    finish(&mut app, Topic::Campbell);
    let plot = app.get_by_label_contains("Speed diagram: growth rates of all modes").rect();
    click_at(&mut app, plot.lerp_inside(Vec2::new(0.6, 0.5)));
    settle(&mut app);
    let speed = app.state().scenario().motion.speed;
    assert!((5.5..15.0).contains(&speed), "{speed}");
    assert!(app.state().study(Topic::Campbell).2, "the diagram does not depend on the speed");
    nothing_shows_nan(&app);
}

#[test]
fn the_mesh_tells_its_error() {
    let mut app = app();
    open_groups(&mut app);
    open_plot(&mut app, "Mesh error");
    finish(&mut app, Topic::Mesh);
    words(&app, "With 10 elements the critical speed is ");
    type_value(&mut app, "Elements per cable n", "20");
    words(&app, "With 20 elements the critical speed is ");
    assert!(app.state().study(Topic::Mesh).2, "20 elements were among the meshes");
    nothing_shows_nan(&app);
}

/// Once the app is at rest it finds out which digits are certain, even if no plot of meshes is open.
#[test]
fn figures_show_what_is_certain_and_the_exact_number_on_hovering() {
    let mut app = app();
    open_groups(&mut app);
    let exact = report(&app).critical.expect("a critical speed").speed;
    // docs/theory.md section 10: 10 elements are 0.306 m/s off.
    let text = explained(&mut app, 10);
    assert_eq!(figure(&app), "11.3 m/s");
    assert!(text.starts_with(&format!("{exact} m/s")), "{text}");
    assert!(rounds(&text, "Finer meshes lead to ", 10.993), "{text}");
    // A finer mesh makes more digits certain. A divergence makes fewer certain, since its error falls as 1/n only.
    type_value(&mut app, "Elements per cable n", "40");
    explained(&mut app, 40);
    let exact = report(&app).critical.expect("a critical speed").speed;
    assert!(rounds(&figure(&app), "", exact) && figure(&app).starts_with("11.0"), "{}", figure(&app));
    type_value(&mut app, "Elements per cable n", "10");
    type_value(&mut app, "Mass damping α", "50");
    // 12.84 where the limit is 11.87.
    let text = explained(&mut app, 10);
    assert_eq!(figure(&app), "13 m/s");
    let (_, limit) = text.split_once("Finer meshes lead to ").expect("a limit");
    let [limit, off] = limit.split(' ').filter_map(|word| word.parse::<f64>().ok()).take(2).collect::<Vec<_>>()[..]
    else {
        panic!("no limit: {text}")
    };
    // The limit's own last digit may be off by as much.
    assert!((limit - 11.87).abs() <= off + 0.05 && off < 0.2, "{text}");
}

/// What the large figure says to those who rest on it, once the meshes have told how certain it is.
fn explained(app: &mut Harness<'static, Tautline>, elements: usize) -> String {
    let told = format!("m/s with {elements} elements per cable. Finer meshes lead to ");
    let deadline = Instant::now() + PATIENCE;
    while app.query_by_label_contains(&told).is_none() {
        assert!(Instant::now() < deadline, "not told: {told}");
        let figure = figure(app);
        let place = app.get_by_label(&figure).rect().center();
        app.hover_at(place);
        app.run_steps(60);
    }
    label(app, &told)
}

#[test]
fn without_a_critical_speed_no_mode_is_told_as_one_that_becomes_unstable() {
    let mut scenario = paper();
    scenario.motion.position = [0.0, -1.0];
    scenario.motion.direction = [0.0, -1.0];
    scenario.damping = tautline::robot::Damping { alpha: 1000.0, beta: 10.0 };
    scenario.cable.mass_per_length = 0.01;
    let mut app = app_with(scenario, SIZE, Theme::Light);
    assert_eq!(report(&app).critical, None);
    app.get_by_label("None found");
    app.get_by_role_and_label(Role::RadioButton, "Mode shape").click();
    settle(&mut app);
    let transport = app.get_by_role_and_label(Role::Region, "Transport").rect();
    let how = |node: &Node<'_>| {
        transport.contains_rect(node.rect()) && [" Hz", " 1/s"].iter().any(|unit| text_of(node).ends_with(unit))
    };
    app.get_all_by_role(Role::Label).find(how).expect("how the mode swings").hover();
    app.run_steps(60);
    let text = label(&app, "The least stable one");
    assert!(text.starts_with("No mode becomes unstable.") && !text.contains("0.000"), "{text}");
    assert!(app.query_by_label_contains("Chosen mode").is_none());
}

#[test]
fn a_critical_speed_of_zero_says_why() {
    let mut scenario = paper();
    scenario.damping = tautline::robot::Damping { alpha: 0.0, beta: 0.0 };
    scenario.motion.position = [4.0, 0.0];
    let app = app_with(scenario, SIZE, Theme::Light);
    assert_eq!(report(&app).critical.expect("a critical speed").speed.to_bits(), 0.0_f64.to_bits());
    assert_eq!(figure(&app), "0 m/s");
    label(&app, "Without damping every cable that is reeled in looks unstable at any speed");
}

#[test]
fn maps_and_plots_of_studies_fit_a_phone() {
    let mut app = app_with(paper(), Vec2::new(360.0, 740.0), Theme::Dark);
    switch_the_map_on(&mut app);
    app.get_by_role_and_label(Role::Tab, "Plots").click();
    app.run_steps(3);
    for (group, tab) in [
        ("Workspace", "Along the line"),
        ("Workspace", "Directions"),
        ("Model", "Speed diagram"),
        ("Model", "What if"),
        ("Model", "Mesh error"),
    ] {
        app.get_by_role_and_label(Role::ComboBox, "Plot group").click();
        app.run_steps(3);
        app.get_all_by_label(group).last().expect("an entry").click();
        app.run_steps(3);
        app.get_by_role_and_label(Role::Tab, tab).click();
        app.run_steps(3);
        for (role, label) in [(Role::Button, "Map"), (Role::Tab, tab), (Role::Button, "What am I seeing?")] {
            let deadline = Instant::now() + PATIENCE;
            while app.query_by_role_and_label(role, label).is_none() {
                assert!(Instant::now() < deadline, "no {label}");
                std::thread::sleep(Duration::from_millis(2));
                app.step();
            }
            let rect = app.get_by_role_and_label(role, label).rect();
            assert!(rect.max.x <= 361.0 && rect.min.x >= -1.0, "{label} sticks out: {rect:?}");
        }
    }
    let list = app.get_by_role_and_label(Role::ComboBox, "Map quantity").rect();
    assert!(list.min.x >= 0.0, "{list:?}");
}
