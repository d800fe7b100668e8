//! The path on the screen: added, dragged, typed, taken back, told in links.
#![expect(clippy::float_cmp, reason = "coordinates that are rounded, typed or copied")]
#![cfg(feature = "app")]

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use tautline::app::Tautline;
use tautline::scenario::{Corners, Path, ProfileKind, Scenario, link};

use interface::{SIZE, app, app_with, drag, paper, reach, settle, text_of, type_value};

#[path = "common/interface.rs"]
mod interface;

type App = Harness<'static, Tautline>;

fn with_path(points: &[[f64; 2]]) -> Scenario {
    Scenario { path: Some(Path::new(points.to_vec(), 5.0)), ..paper() }
}

fn path(app: &App) -> Path {
    app.state().scenario().path.clone().expect("a path")
}

fn open_path(app: &mut App) {
    if app.query_by_role_and_label(Role::Button, "Remove the path").is_none()
        && app.query_by_role_and_label(Role::Button, "Add a path").is_none()
    {
        press(app, "Path");
    }
}

fn press(app: &mut App, button: &str) {
    reach(app, Role::Button, button);
    app.get_by_role_and_label(Role::Button, button).click();
    settle(app);
}

fn choose(app: &mut App, name: &str) {
    reach(app, Role::RadioButton, name);
    app.get_by_role_and_label(Role::RadioButton, name).click();
    settle(app);
}

/// Points of the screen per metre, and where the world's origin is.
fn scale(app: &App) -> f32 {
    let [a, b] = ["Platform", "Path end"].map(|name| app.get_by_label(name).rect().center());
    let end = path(app).points.last().copied().expect("a point");
    let way = end[0] - app.state().scenario().motion.position[0];
    #[expect(clippy::cast_possible_truncation)] // Metres.
    let way = way as f32;
    (b.x - a.x) / way
}

fn close(found: [f64; 2], expected: [f64; 2], within: f64) {
    assert!((0..2).all(|i| (found[i] - expected[i]).abs() <= within), "{found:?}, not {expected:?}");
}

#[test]
fn a_path_is_added_removed_taken_back_and_told_in_a_link() {
    let mut app = app();
    press(&mut app, "Path");
    press(&mut app, "Add a path");
    assert_eq!(path(&app), Path { hold: 2.0, ..Path::new(vec![[6.0, 0.0]], 5.0) });
    // 6 m as a quintic with a peak of 5 m/s: 15 · 6/(8 · 5) s.
    app.get_by_label("2.25 s");
    // A path is no change of the robot.
    assert_eq!(app.state().scenario().name.as_deref(), Some("Paper robot"));
    let back = link::decode(&link::encode(app.state().scenario())).expect("a link");
    assert_eq!(&back, app.state().scenario());
    press(&mut app, "Remove the path");
    assert_eq!(app.state().scenario(), &paper());
    press(&mut app, "Undo");
    assert_eq!(path(&app).points, [[6.0, 0.0]]);
    app.run_steps(80);
    press(&mut app, "Undo");
    assert_eq!(app.state().scenario(), &paper());
    press(&mut app, "Redo");
    assert_eq!(path(&app).points, [[6.0, 0.0]]);
}

#[test]
fn the_end_is_drawn_out_of_the_platform_and_dragged() {
    let mut app = app();
    let handle = app.get_by_label("New path").rect().center();
    drag(&mut app, handle, handle + Vec2::new(120.0, -42.0));
    settle(&mut app);
    let first = path(&app).points;
    let end = app.get_by_label("Path end").rect().center();
    assert!((end - handle - Vec2::new(120.0, -42.0)).length() < 1.0, "{end:?}");
    let points_per_metre = f64::from(scale(&app));
    // One drag is one step.
    app.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut app);
    assert_eq!(app.state().scenario().path, None);
    app.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    settle(&mut app);
    assert_eq!(path(&app).points, first);
    drag(&mut app, end, end + Vec2::new(30.0, 60.0));
    settle(&mut app);
    let moved = path(&app).points[0];
    let expected = [first[0][0] + 30.0 / points_per_metre, first[0][1] - 60.0 / points_per_metre];
    // To the roundest number within the point.
    close(moved, expected, 1.0 / points_per_metre);
    // The path begins where the platform is.
    let platform = app.get_by_label("Platform").rect().center();
    drag(&mut app, platform, platform + Vec2::new(-40.0, 0.0));
    settle(&mut app);
    assert!(app.state().scenario().motion.position[0] < -0.5);
    assert_eq!(path(&app).points[0], moved);
}

#[test]
fn a_click_on_the_handle_adds_a_path_and_the_answers_stay() {
    let mut app = app();
    let before = app.state().analysis().expect("an analysis").revision;
    app.get_by_label("New path").click();
    settle(&mut app);
    assert_eq!(path(&app).points, [[6.0, 0.0]]);
    // Where the platform flies to is no matter of its pose.
    let after = app.state().analysis().expect("an analysis");
    assert!(after.current && after.revision == before);
    assert!(app.query_by_label("New path").is_none());
    // The group has opened.
    app.get_by_role_and_label(Role::Button, "Remove the path");
}

fn double_click(app: &mut App, at: Pos2) {
    app.hover_at(at);
    app.step();
    for _ in 0..2 {
        for pressed in [true, false] {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::default());
            app.event(Event::PointerButton { pos: at, button, pressed, modifiers });
            app.step();
        }
    }
    app.step();
}

#[test]
fn a_double_click_adds_a_point_and_keys_move_and_delete_it() {
    let mut app = app_with(with_path(&[[-4.0, 2.0]]), SIZE, Theme::Light);
    let [start, end] = ["Platform", "Path end"].map(|name| app.get_by_label(name).rect().center());
    let middle = start + (end - start) * 0.5;
    double_click(&mut app, middle + Vec2::new(0.0, 3.0));
    settle(&mut app);
    assert_eq!(path(&app).points.len(), 2);
    close(path(&app).points[0], [-2.0, 1.0], 0.1);
    assert_eq!(path(&app).points[1], [-4.0, 2.0]);
    let before = path(&app).points[0];
    app.get_by_label("Path point 1").focus();
    app.run_steps(2);
    app.key_press(Key::ArrowRight);
    settle(&mut app);
    close(path(&app).points[0], [before[0] + 0.1, before[1]], 1e-12);
    app.key_press_modifiers(Modifiers::SHIFT, Key::ArrowUp);
    settle(&mut app);
    close(path(&app).points[0], [before[0] + 0.1, before[1] + 0.01], 1e-12);
    app.key_press(Key::Delete);
    settle(&mut app);
    assert_eq!(path(&app).points, [[-4.0, 2.0]]);
    // Elsewhere a double click shows the whole robot, as ever.
    let canvas = app.get_by_label("Robot canvas").rect();
    double_click(&mut app, canvas.right_bottom() - Vec2::new(60.0, 60.0));
    settle(&mut app);
    assert_eq!(path(&app).points, [[-4.0, 2.0]]);
    app.get_by_label("Path end").focus();
    app.run_steps(2);
    app.key_press(Key::Delete);
    settle(&mut app);
    assert_eq!(app.state().scenario(), &paper());
}

#[test]
fn what_is_typed_and_chosen_is_the_path() {
    let mut app = app_with(with_path(&[[6.0, 0.0]]), SIZE, Theme::Light);
    open_path(&mut app);
    type_value(&mut app, "To x", "-4");
    type_value(&mut app, "To y", "2.5");
    assert_eq!(path(&app).points, [[-4.0, 2.5]]);
    type_value(&mut app, "From x", "1");
    close(app.state().scenario().motion.position, [1.0, 0.0], 0.0);
    press(&mut app, "Add a point");
    assert_eq!(path(&app).points, [[-1.5, 1.25], [-4.0, 2.5]]);
    type_value(&mut app, "Point 1 y", "-1");
    choose(&mut app, "smooth");
    assert_eq!((path(&app).corners, path(&app).points[0]), (Corners::Smooth, [-1.5, -1.0]));
    choose(&mut app, "trapezoid");
    type_value(&mut app, "Peak speed v", "2");
    type_value(&mut app, "Acceleration a", "0.5");
    type_value(&mut app, "Hold", "3");
    assert!(app.query_by_role_and_label(Role::SpinButton, "Jerk j").is_none());
    choose(&mut app, "S-curve");
    type_value(&mut app, "Jerk j", "7");
    let Path { profile, speed, acceleration, jerk, hold, .. } = path(&app);
    assert_eq!(
        (profile, [speed, acceleration, jerk, hold].map(|value| (10.0 * value).round())),
        (ProfileKind::Scurve, [20.0, 5.0, 70.0, 30.0])
    );
    // Without rest at its end there is nothing to wait for.
    choose(&mut app, "constant");
    assert!(path(&app).profile == ProfileKind::Constant && path(&app).hold.abs() < 1e-12);
    assert!(app.query_by_role_and_label(Role::SpinButton, "Acceleration a").is_none());
    press(&mut app, "Remove point 1");
    assert_eq!((path(&app).points, path(&app).corners), (vec![[-4.0, 2.5]], Corners::Stop));
    // A path that leads nowhere is refused.
    type_value(&mut app, "To y", "0");
    type_value(&mut app, "To x", "1");
    assert_eq!(path(&app).points, [[-4.0, 0.0]]);
    assert!(app.query_by_label_contains("must not be where its start is").is_some());
}

/// Everything of the group is in reach and within the panel, at every width.
#[test]
fn nothing_of_the_group_is_cut_off() {
    for (size, region) in [(Vec2::new(360.0, 740.0), "Sheet"), (Vec2::new(320.0, 640.0), "Sheet"), (SIZE, "Controls")] {
        let mut scenario = with_path(&[[-3.25, 1.125], [6.0, -2.0]]);
        if let Some(path) = &mut scenario.path {
            path.profile = ProfileKind::Scurve;
        }
        let mut app = app_with(scenario, size, Theme::Light);
        open_path(&mut app);
        let panel: Rect = app.get_by_role_and_label(Role::Region, region).rect();
        let things = [
            (Role::SpinButton, "From x"),
            (Role::SpinButton, "From y"),
            (Role::SpinButton, "Point 1 x"),
            (Role::Button, "Remove point 1"),
            (Role::SpinButton, "To y"),
            (Role::Button, "Remove to"),
            (Role::RadioButton, "stop at points"),
            (Role::RadioButton, "smooth"),
            (Role::RadioButton, "quintic"),
            (Role::RadioButton, "constant"),
            (Role::SpinButton, "Peak speed v"),
            (Role::Slider, "Peak speed v"),
            (Role::SpinButton, "Acceleration a"),
            (Role::SpinButton, "Jerk j"),
            (Role::SpinButton, "Hold"),
            (Role::Button, "Add a point"),
            (Role::Button, "Remove the path"),
        ];
        for (role, name) in things {
            reach(&mut app, role, name);
            let rect = app.get_by_role_and_label(role, name).rect();
            assert!(panel.expand(0.5).contains_rect(rect), "{size:?}: {name} {rect:?} in {panel:?}");
        }
        let shown = app.get_by_label("Peak acceleration").rect();
        assert!(panel.x_range().contains(shown.min.x), "{}", text_of(&app.get_by_label("Peak acceleration")));
    }
}
