//! The windows that explain: Theory and Validation.

#![cfg(feature = "app")]

#[path = "common/interface.rs"]
mod interface;

use std::path::Path;
use std::time::Instant;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Rect, Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use tautline::app::Tautline;
use tautline::study::validation::CHECKS;

use interface::{PATIENCE, SIZE, app_with, paper, reach, settle};

type App = Harness<'static, Tautline>;

const PHONE: Vec2 = Vec2::new(360.0, 740.0);

/// Opens a window from the bar's menu.
fn open(size: Vec2, theme: Theme, window: &str) -> App {
    let mut app = app_with(paper(), size, theme);
    choose(&mut app, window);
    settle(&mut app);
    app.run_steps(5);
    app
}

/// Clicks on an entry of the bar's menu.
fn choose(app: &mut App, entry: &str) {
    app.get_by_role_and_label(Role::Button, "More").click();
    app.run_steps(3);
    reach(app, Role::Button, entry);
    app.get_by_role_and_label(Role::Button, entry).click();
    app.run_steps(3);
}

/// Name and place of all that is in the window.
fn content(app: &App, window: &str) -> Vec<(Role, String, Rect)> {
    let window = app.get_by_role_and_label(Role::Window, window);
    let mut found = Vec::new();
    let mut left: Vec<_> = window.children().collect();
    while let Some(node) = left.pop() {
        let inside = node.accesskit_node();
        let name = inside.label().or_else(|| inside.value()).unwrap_or_default();
        // Containers have no place of their own.
        if inside.raw_bounds().is_some() {
            found.push((inside.role(), name.clone(), node.rect()));
        }
        left.extend(node.children());
    }
    found
}

/// Nothing may be wider than the screen; what is below its end is scrolled to.
fn assert_fits(app: &App, window: &str, size: Vec2) {
    let content = content(app, window);
    assert!(content.len() > 20, "{content:?}");
    for (role, name, rect) in content {
        assert!(rect.min.x >= 0.0 && rect.max.x <= size.x, "{role:?} {name:?} at {rect:?} on {size:?}");
    }
    let frame = app.get_by_role_and_label(Role::Window, window).rect();
    assert!(frame.max.y <= size.y && frame.min.y >= 0.0, "{frame:?} on {size:?}");
}

#[test]
fn the_theory_is_one_page_on_every_screen() {
    for (size, theme) in [(SIZE, Theme::Light), (PHONE, Theme::Dark)] {
        let mut app = open(size, theme, "Theory");
        assert_fits(&app, "Theory", size);
        for heading in ["The cable element", "Static equilibrium with sag", "Limits of the criterion", "Sources"] {
            app.get_by_label(heading);
        }
        // The words of docs/theory.md section 9 in short.
        app.get_by_label_contains("It is not a safety margin");
        app.get_by_label_contains("A cable that is reeled in looks unstable");
        app.get_by_label_contains("Both must come from measurement");
        for source in ["[1] M. Aminpur, S. Farhadi", "[2] J. Du, C. Cui, H. Bao, Y. Qiu"] {
            app.get_by_label_contains(source);
        }
        app.key_press(Key::Escape);
        app.run_steps(5);
        assert!(app.query_by_label("Limits of the criterion").is_none(), "Escape closes the window");
    }
}

#[test]
fn every_equation_is_there_in_words_as_well() {
    let app = open(SIZE, Theme::Dark, "Theory");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/equations");
    let entries = std::fs::read_dir(folder).expect("the folder of equations");
    let drawn = entries
        .filter(|entry| entry.as_ref().expect("a file").path().extension().is_some_and(|extension| extension == "png"));
    let mut labels: Vec<String> = content(&app, "Theory")
        .into_iter()
        .filter(|(role, ..)| *role == Role::Image)
        .map(|(_, name, _)| name)
        .collect();
    assert_eq!(labels.len(), drawn.count(), "all that are drawn are on the page");
    assert!(labels.len() > 15 && labels.iter().all(|label| label.split(' ').count() > 3), "{labels:?}");
    labels.sort();
    labels.dedup();
    assert!(labels.iter().any(|label| label == "the determinant of Q of i omega and v is zero"), "{labels:?}");
}

/// Steps until all checks are done.
fn wait_for_all(app: &mut App) {
    let begun = Instant::now();
    while app.query_by_label_contains("Computing: ").is_some() {
        assert!(begun.elapsed() < PATIENCE, "not all checks done after {PATIENCE:?}");
        app.step();
    }
}

#[test]
fn the_validation_passes_here_and_now() {
    let summary = format!("{0} of {0} checks pass.", CHECKS.len());
    for (size, theme) in [(SIZE, Theme::Dark), (PHONE, Theme::Light)] {
        let mut app = open(size, theme, "Validation");
        wait_for_all(&mut app);
        app.run_steps(3);
        app.get_by_label(&summary);
        assert_eq!(app.get_all_by_label("passes").count(), CHECKS.len());
        assert!(app.query_by_label_contains("fails").is_none());
        for check in CHECKS {
            app.get_by_label(check.name);
        }
        assert_fits(&app, "Validation", size);
    }
}

#[test]
fn the_validation_runs_again_when_asked_and_when_opened_again() {
    let mut app = open(SIZE, Theme::Light, "Validation");
    wait_for_all(&mut app);
    app.run_steps(2);
    app.get_by_label("Run again").click();
    app.run_steps(2);
    app.get_by_label_contains("Computing: ");
    wait_for_all(&mut app);
    app.key_press(Key::Escape);
    app.run_steps(5);
    choose(&mut app, "Validation");
    app.get_by_label_contains("Computing: ");
}
