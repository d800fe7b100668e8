//! Panels: only a person changes their size, and nothing in them is out of reach.

#![cfg(feature = "app")]

use std::collections::BTreeSet;

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, Rect, Theme, TouchPhase, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use tautline::app::Tautline;
use tautline::compute::protocol::Topic;
use tautline::scenario::presets;

use interface::{app_with, drag, open_groups, paper, reach, settle, text_of, type_value};

#[path = "common/interface.rs"]
mod interface;

type App = Harness<'static, Tautline>;

const PLOTS: [(&str, &str); 13] = [
    ("Flight", "Deviation"),
    ("Flight", "Tensions"),
    ("Flight", "Gain"),
    ("Flight", "Speed on the path"),
    ("This pose", "Eigenvalues"),
    ("This pose", "Modes"),
    ("This pose", "Growth"),
    ("Workspace", "Along the line"),
    ("Workspace", "Directions"),
    ("Model", "Speed diagram"),
    ("Model", "What to change"),
    ("Model", "What if"),
    ("Model", "Mesh error"),
];

/// Clicks on all that have this role and name.
fn click_all(app: &mut App, role: Role, label: &str) {
    let places: Vec<Pos2> = app.query_all_by_role_and_label(role, label).map(|node| node.rect().center()).collect();
    for place in places {
        let node = app.query_all_by_role_and_label(role, label).find(|node| node.rect().center() == place);
        node.expect("it stays where it is").click();
        app.run_steps(3);
    }
}

/// Opens a plot wherever it can be opened.
fn open(app: &mut App, (group, title): (&str, &str)) {
    click_all(app, Role::RadioButton, group);
    if app.query_by_role_and_label(Role::ComboBox, "Plot group").is_some() {
        app.get_by_role_and_label(Role::ComboBox, "Plot group").click();
        app.run_steps(3);
        app.get_all_by_role_and_label(Role::Button, group).last().expect("an entry").click();
        app.run_steps(3);
    }
    click_all(app, Role::Tab, title);
    app.run_steps(10);
}

fn region(app: &App, name: &str) -> Rect {
    app.get_by_role_and_label(Role::Region, name).rect()
}

/// From the left panel to the right one.
fn between(app: &App) -> [f32; 2] {
    let canvas = app.get_by_label("Robot canvas").rect();
    [canvas.min.x, canvas.max.x]
}

/// Drags an edge by so much.
fn drag_edge(app: &mut App, edge: &str, by: Vec2) {
    let at = app.get_by_role_and_label(Role::Splitter, edge).rect().center();
    drag(app, at, at + by);
    settle(app);
}

/// Opens the controls where they are folded at first.
fn open_controls(app: &mut App) {
    if app.query_by_role_and_label(Role::Region, "Controls").is_none() {
        app.get_by_role_and_label(Role::Button, "Controls").click();
        app.run_steps(5);
    }
}

#[test]
fn no_content_changes_a_panels_width() {
    for width in [800.0, 1024.0, 1280.0, 1920.0] {
        let mut app = app_with(paper(), Vec2::new(width, 700.0), Theme::Light);
        open_controls(&mut app);
        // As a person sets them.
        drag_edge(&mut app, "Resize the controls", Vec2::new(11.0, 0.0));
        if width > 1200.0 {
            drag_edge(&mut app, "Resize the plots", Vec2::new(-7.0, 0.0));
        }
        drag_edge(&mut app, "Resize the dock", Vec2::new(0.0, -13.0));
        let set = app.get_by_label("Robot canvas").rect();
        let same = |app: &App, what: &str| {
            let now = app.get_by_label("Robot canvas").rect();
            let off = (now.min - set.min).abs().max((now.max - set.max).abs()).max_elem();
            assert!(off < 0.5, "{width}, {what}: {set:?} {now:?}");
        };
        open_groups(&mut app);
        let mut names: Vec<&str> = presets::PRESETS.iter().map(|preset| preset.title).collect();
        // The list is read from the top, where it is opened.
        names.rotate_left(1);
        for name in names {
            app.get_by_role_and_label(Role::ComboBox, "Robot").click();
            app.run_steps(5);
            app.get_all_by_label(name).last().expect("an entry").click();
            settle(&mut app);
            app.run_steps(5);
            same(&app, name);
        }
        for (field, typed) in
            [("Speed v", "1e6"), ("Speed v", "1.234567890123456"), ("Young's modulus E", "9.87654321e9")]
        {
            type_value(&mut app, field, typed);
            app.run_steps(5);
            same(&app, typed);
        }
        type_value(&mut app, "Speed v", "123456.789012");
        app.get_by_role_and_label(Role::Button, "Keep").click();
        settle(&mut app);
        type_value(&mut app, "Platform mass m", "3");
        same(&app, "a kept design");
        for plot in PLOTS {
            open(&mut app, plot);
            same(&app, plot.1);
        }
    }
}

#[test]
fn long_names_do_not_change_a_panels_width() {
    for size in [Vec2::new(800.0, 700.0), Vec2::new(1280.0, 700.0)] {
        let usual = between(&app_with(paper(), size, Theme::Light));
        let mut scenario = paper();
        scenario.name = Some("Donaudampfschifffahrtsgesellschaftskapitän ".repeat(8));
        let app = app_with(scenario, size, Theme::Light);
        assert!(between(&app).iter().zip(usual).all(|(now, usual)| (now - usual).abs() < 0.5), "{usual:?}");
        assert_bar_fits(&app);
    }
}

/// What is in the bar lies side by side.
fn assert_bar_fits(app: &App) {
    let bar = region(app, "Bar");
    let mut all: Vec<(String, Rect)> = app
        .get_all_by(|node| matches!(node.role(), Role::Button | Role::ComboBox))
        .map(|node| (node.accesskit_node().label().unwrap_or_default(), node.rect()))
        .filter(|(_, rect)| bar.contains(rect.center()))
        .collect();
    all.sort_by(|(_, a), (_, b)| a.min.x.total_cmp(&b.min.x));
    assert!(all.len() >= 4, "{all:?}");
    for (name, rect) in &all {
        assert!(bar.expand(0.5).contains_rect(*rect), "{name}: {rect:?} in {bar:?}");
    }
    for pair in all.windows(2) {
        assert!(pair[0].1.max.x <= pair[1].1.min.x + 0.5, "{pair:?}");
    }
}

#[test]
fn the_edges_of_panels_can_be_dragged_and_the_canvas_keeps_some_room() {
    let mut app = app_with(paper(), Vec2::new(1280.0, 700.0), Theme::Light);
    let [left, right] = between(&app);
    drag_edge(&mut app, "Resize the controls", Vec2::new(60.0, 0.0));
    let [wider, same] = between(&app);
    assert!((wider - left - 60.0).abs() < 2.0 && (same - right).abs() < 0.5, "{left} {wider}, {right} {same}");
    drag_edge(&mut app, "Resize the plots", Vec2::new(-20.0, 0.0));
    let [same, wider_plots] = between(&app);
    assert!((wider_plots - right + 20.0).abs() < 2.0 && (same - wider).abs() < 0.5, "{right} {wider_plots}, {same}");
    // Neither edge pushes the other one, nor the canvas out.
    drag_edge(&mut app, "Resize the plots", Vec2::new(200.0 - wider_plots, 0.0));
    let [from, to] = between(&app);
    assert!((from - wider).abs() < 0.5 && to - from >= 315.0, "{from} {to}");
    drag_edge(&mut app, "Resize the controls", Vec2::new(1200.0 - from, 0.0));
    let now = between(&app);
    assert!((now[0] - from).abs() + (now[1] - to).abs() < 0.5, "there is no room left: {now:?}");
    // And back: an edge goes with the pointer at once.
    drag_edge(&mut app, "Resize the plots", Vec2::new(100.0, 0.0));
    assert!((between(&app)[1] - to - 100.0).abs() < 2.0, "{to} {:?}", between(&app));
}

#[test]
fn the_docks_edge_can_be_dragged_and_the_canvas_keeps_some_room() {
    for width in [1024.0, 1280.0] {
        let mut app = app_with(paper(), Vec2::new(width, 700.0), Theme::Light);
        let canvas = |app: &App| app.get_by_label("Robot canvas").rect();
        let usual = canvas(&app);
        let bottom = region(&app, "Dock").max.y;
        drag_edge(&mut app, "Resize the dock", Vec2::new(0.0, -40.0));
        let lower = canvas(&app);
        assert!((usual.max.y - lower.max.y - 40.0).abs() < 2.0 && (lower.min - usual.min).length() < 0.5, "{lower:?}");
        drag_edge(&mut app, "Resize the dock", Vec2::new(0.0, -lower.max.y));
        assert!(canvas(&app).height() >= 200.0, "{:?}", canvas(&app));
        drag_edge(&mut app, "Resize the dock", Vec2::new(0.0, 700.0));
        let dock = region(&app, "Dock");
        assert!(dock.height() >= 140.0 && (dock.max.y - bottom).abs() < 0.5, "{dock:?}");
        assert!((dock.min.y - canvas(&app).max.y).abs() < 0.5, "{dock:?}");
    }
}

#[test]
fn folded_panels_give_their_room_to_the_canvas() {
    let size = Vec2::new(1280.0, 720.0);
    let mut app = app_with(paper(), size, Theme::Dark);
    let usual = app.get_by_label("Robot canvas").rect();
    let transport = region(&app, "Transport").height();
    for name in ["Controls", "Plots", "Dock"] {
        assert!(region(&app, name).is_positive());
        app.get_by_role_and_label(Role::Button, name).click();
        app.run_steps(5);
        assert!(app.query_by_role_and_label(Role::Region, name).is_none(), "{name}");
    }
    let whole = app.get_by_label("Robot canvas").rect();
    let expected = Rect::from_min_max(Pos2::new(0.0, usual.min.y), Pos2::new(size.x, size.y - transport));
    assert!((whole.min - expected.min).length() < 0.5 && (whole.max - expected.max).length() < 0.5, "{whole:?}");
    for name in ["Dock", "Plots", "Controls"] {
        app.get_by_role_and_label(Role::Button, name).click();
        app.run_steps(5);
    }
    assert_eq!(app.get_by_label("Robot canvas").rect(), usual);
}

fn wheel(app: &mut App, at: Pos2, by: f32) {
    app.event(Event::PointerMoved(at));
    app.step();
    for _ in 0..2 {
        app.event(Event::MouseWheel {
            unit: MouseWheelUnit::Point,
            delta: Vec2::new(0.0, by / 2.0),
            phase: TouchPhase::Move,
            source: MouseWheelSource::Unknown,
            modifiers: Modifiers::default(),
        });
        app.run_steps(15);
    }
}

/// The name of what is below all plots and does not scroll with them.
const FOOT: &str = "What am I seeing?";

/// What belongs to a part of the screen, also what is beyond its upper and lower end: names with their places.
fn contents(app: &App, part: Rect) -> Vec<(String, Rect)> {
    let known = [
        Role::Label,
        Role::Link,
        Role::Button,
        Role::Slider,
        Role::SpinButton,
        Role::ComboBox,
        Role::RadioButton,
        Role::Tab,
    ];
    let others: Vec<Rect> =
        app.get_all_by_role(Role::Region).map(|region| region.rect()).filter(|other| *other != part).collect();
    app.get_all_by(|node| known.contains(&node.role()) && node.raw_bounds().is_some())
        .map(|node| (format!("{:?} {}", node.accesskit_node().role(), text_of(&node)), node.rect()))
        .filter(|(_, rect)| part.x_range().contains(rect.center().x))
        .filter(|(_, rect)| others.iter().all(|other| !other.contains(rect.center())))
        .collect()
}

/// Scrolls through a part of the screen from its beginning on. Everything comes into sight that belongs to it.
fn assert_all_in_reach(app: &mut App, part: Rect, what: &str) {
    let foot = app.query_all_by_label(FOOT).map(|node| node.rect()).find(|rect| part.contains_rect(*rect));
    let end = foot.map_or(part.max.y, |foot| foot.min.y);
    let at = Pos2::new(part.center().x, end - 14.0);
    // What scrolls within the plot goes first.
    wheel(app, at, 4000.0);
    wheel(app, at, 4000.0);
    let step = (0.3 * (end - part.min.y)).min(120.0);
    let mut known = BTreeSet::new();
    // What is higher than the room for it is seen end by end.
    let mut seen = [BTreeSet::new(), BTreeSet::new()];
    for _ in 0..60 {
        let all = contents(app, part);
        for (name, rect) in &all {
            let is_foot = foot.is_some_and(|foot| foot.y_range().contains(rect.center().y));
            let room = part.with_max_y(if is_foot { part.max.y } else { end }).expand(0.5);
            for (corner, seen) in [rect.min, rect.max].into_iter().zip(&mut seen) {
                if room.contains(corner) {
                    seen.insert(name.clone());
                }
            }
            known.insert(name.clone());
        }
        wheel(app, at, -step);
        if contents(app, part) == all {
            break;
        }
    }
    let never: Vec<&String> = known.iter().filter(|name| seen.iter().any(|seen| !seen.contains(*name))).collect();
    assert!(never.is_empty() && known.len() >= 8, "{what}: {never:?} of {}", known.len());
}

/// Opens what a plot means, below it.
fn explain(app: &mut App, plot: &str) {
    app.get_by_label(FOOT).click();
    settle(app);
    // Its words change while more is found out.
    interface::wait(app, "the studies", |app| app.at_work().is_empty());
    app.run_steps(10);
    let told = app.get_all_by_role(Role::Label).any(|node| text_of(&node).len() > 150);
    assert!(told, "{plot} is not explained");
}

/// All the controls with all that can be open in them.
fn open_all_controls(app: &mut App) {
    open_groups(app);
    for (role, name) in [(Role::Button, "Unlock the winches"), (Role::Button, "Cable 3")] {
        reach(app, role, name);
        app.get_by_role_and_label(role, name).click();
        app.run_steps(3);
    }
}

#[test]
fn nothing_is_out_of_reach_on_low_screens() {
    for size in [Vec2::new(1366.0, 625.0), Vec2::new(1280.0, 720.0)] {
        let mut app = app_with(paper(), size, Theme::Dark);
        assert_bar_fits(&app);
        open_all_controls(&mut app);
        let controls = region(&app, "Controls");
        assert_all_in_reach(&mut app, controls, &format!("{size:?}, controls"));
        for plot in PLOTS {
            open(&mut app, plot);
            explain(&mut app, plot.1);
            let plots = region(&app, "Plots");
            assert_all_in_reach(&mut app, plots, &format!("{size:?}, {}", plot.1));
        }
    }
}

/// Chooses a size of all text in the window with the settings.
fn set_text_size(app: &mut App, percent: &str) {
    app.get_by_role_and_label(Role::Button, "More").click();
    app.run_steps(3);
    reach(app, Role::Button, "Settings");
    app.get_by_role_and_label(Role::Button, "Settings").click();
    app.run_steps(5);
    reach(app, Role::ComboBox, "Text size");
    app.get_by_role_and_label(Role::ComboBox, "Text size").click();
    app.run_steps(5);
    reach(app, Role::Button, percent);
    app.get_by_role_and_label(Role::Button, percent).click();
    app.run_steps(10);
    app.key_press(Key::Escape);
    app.run_steps(5);
    assert!(app.query_by_role_and_label(Role::Window, "Settings").is_none());
    settle(app);
}

#[test]
fn nothing_is_out_of_reach_in_large_text() {
    // A large window becomes a middle one, a small one as low as that of a phone held across.
    for size in [Vec2::new(1920.0, 1080.0), Vec2::new(1366.0, 768.0)] {
        let mut app = app_with(paper(), size, Theme::Light);
        set_text_size(&mut app, "200 %");
        let ratio = app.ctx.pixels_per_point();
        assert!((ratio - 2.0).abs() < 1e-3, "{ratio}");
        assert_bar_fits(&app);
        if app.query_by_role_and_label(Role::Region, "Sheet").is_some() {
            let sheet = region(&app, "Sheet");
            for tab in ["Move", "Explain", "Robot"] {
                app.get_by_role_and_label(Role::Tab, tab).click();
                app.run_steps(3);
                if tab == "Robot" {
                    for group in ["Rope", "Mass and gravity", "Damping", "Model"] {
                        reach(&mut app, Role::Button, group);
                        app.get_by_role_and_label(Role::Button, group).click();
                        app.run_steps(3);
                    }
                }
                assert_all_in_reach(&mut app, sheet, &format!("{size:?}, {tab}"));
            }
            app.get_by_role_and_label(Role::Tab, "Plots").click();
            app.run_steps(3);
        } else {
            open_controls(&mut app);
            open_all_controls(&mut app);
            let controls = region(&app, "Controls");
            assert_all_in_reach(&mut app, controls, &format!("{size:?}, controls"));
        }
        for plot in PLOTS {
            open(&mut app, plot);
            explain(&mut app, plot.1);
            let name = if app.query_by_role_and_label(Role::Region, "Sheet").is_some() { "Sheet" } else { "Dock" };
            let part = region(&app, name);
            assert_all_in_reach(&mut app, part, &format!("{size:?}, {}", plot.1));
        }
        set_text_size(&mut app, "100 %");
        assert!((app.ctx.pixels_per_point() - 1.0).abs() < 1e-3);
    }
}

#[test]
fn plots_shrink_to_a_sensible_height_and_then_the_panel_scrolls() {
    for (size, moves) in [(Vec2::new(1366.0, 480.0), true), (Vec2::new(1280.0, 1000.0), false)] {
        let mut app = app_with(paper(), size, Theme::Light);
        let diagrams = |app: &App| {
            let all = app.get_all_by_role(Role::Image).filter(|node| text_of(node).starts_with("Speed diagram: "));
            let mut places: Vec<Rect> = all.map(|node| node.rect()).collect();
            places.sort_by(|a, b| a.min.y.total_cmp(&b.min.y));
            places
        };
        for plot in PLOTS {
            open(&mut app, plot);
            let panel = region(&app, "Plots");
            let plots = app.get_all_by_role(Role::Image).filter(|node| panel.contains(node.rect().center()));
            for plot in plots {
                assert!(plot.rect().height() >= 115.0, "{size:?}, {}: {:?}", text_of(&plot), plot.rect());
            }
        }
        open(&mut app, ("Model", "Speed diagram"));
        interface::wait(&mut app, "a study", |app| app.study(Topic::Campbell).2);
        app.get_by_label(FOOT).click();
        app.run_steps(10);
        let end = app.get_by_label(FOOT).rect().min.y;
        let [upper, lower] = diagrams(&app)[..] else { panic!("two plots") };
        assert!(upper.height() >= 115.0 && lower.height() >= 115.0, "{size:?}: {upper:?} {lower:?}");
        // Over what the plot means, which is below it.
        wheel(&mut app, Pos2::new(lower.center().x, end - 8.0), -3000.0);
        let moved = upper.min.y - diagrams(&app)[0].min.y;
        assert_eq!(moved > 20.0, moves, "{size:?}: {moved}");
        // The lower plot is in sight: a click on it sets the speed.
        let lower = diagrams(&app)[1];
        let seen = Rect::from_min_max(lower.min, Pos2::new(lower.max.x, lower.max.y.min(end)));
        assert!(seen.height() > 40.0, "{size:?}: {lower:?} above {end}");
        let pos = Pos2::new(lower.lerp_inside(Vec2::new(0.6, 0.0)).x, seen.center().y);
        for pressed in [true, false] {
            let (button, modifiers) = (eframe::egui::PointerButton::Primary, Modifiers::default());
            app.event(Event::PointerMoved(pos));
            app.event(Event::PointerButton { pos, button, pressed, modifiers });
            app.step();
        }
        settle(&mut app);
        let speed = app.state().scenario().motion.speed;
        assert!((5.5..15.0).contains(&speed), "{size:?}: {speed}");
    }
}
