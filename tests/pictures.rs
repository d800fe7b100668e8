//! Pictures of the whole screen, compared with those in tests/pictures.
//!
//! With `TAUTLINE_PICTURES=FOLDER` all of them, those of further sizes, themes and states as well, are written there to be
//! looked at. To take over what has changed on purpose: copy the ones that are kept from there to tests/pictures.

#![cfg(feature = "app")]

use std::path::{Path, PathBuf};

use eframe::egui::accesskit::Role;
use eframe::egui::{ColorImage, Key, Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use tautline::app::Tautline;
use tautline::compute::protocol::Topic;
use tautline::scenario::{self, Corners, ProfileKind, Scenario};

use interface::{app_in_pictures, paper, settle, wait};
use picture::{Textures, picture, read, write};

#[path = "common/interface.rs"]
mod interface;
#[path = "common/picture.rs"]
mod picture;

type App = Harness<'static, Tautline>;

const SIZES: [(&str, Vec2); 7] = [
    ("phone", Vec2::new(360.0, 740.0)),
    ("small", Vec2::new(320.0, 640.0)),
    ("across", Vec2::new(740.0, 360.0)),
    ("upright", Vec2::new(768.0, 1024.0)),
    ("middle", Vec2::new(1024.0, 768.0)),
    ("desktop", Vec2::new(1280.0, 800.0)),
    ("wide", Vec2::new(1920.0, 1080.0)),
];
const PHONE: Vec2 = SIZES[0].1;
const DESKTOP: Vec2 = SIZES[5].1;
const THEMES: [(&str, Theme); 2] = [("light", Theme::Light), ("dark", Theme::Dark)];

/// A channel of a pixel that is off by more than this looks different.
const OFF: u8 = 40;
/// So many parts of all pixels may look different. Rounding on another machine moves edges by less than a pixel; a label
/// that is missing, or a panel elsewhere, is more than this.
const PART: f64 = 0.002;

/// Where all pictures are wanted.
fn folder() -> Option<PathBuf> {
    std::env::var_os("TAUTLINE_PICTURES").map(PathBuf::from)
}

/// The screen after `prepare`, once nothing is computed and nothing moves any more.
fn shot(scenario: &Scenario, size: Vec2, theme: Theme, prepare: impl FnOnce(&mut App)) -> ColorImage {
    let textures = Textures::default();
    let mut app = app_in_pictures(scenario.clone(), size, theme, textures.clone());
    app.key_press(Key::Space);
    settle(&mut app);
    // Back to the beginning of the movement, which depends on when it was stopped.
    for _ in 0..100 {
        app.key_press(Key::Comma);
        app.step();
    }
    prepare(&mut app);
    for topic in
        [Topic::Border, Topic::Line, Topic::Directions, Topic::Campbell, Topic::Mesh, Topic::WhatIf, Topic::Map]
    {
        wait(&mut app, "a study", |app| !app.at_work().contains(&topic));
    }
    app.run_steps(10);
    picture(&app, &textures)
}

fn keep(name: &str, image: &ColorImage) {
    if let Some(folder) = folder() {
        std::fs::create_dir_all(&folder).expect("a folder");
        write(image, &folder.join(format!("{name}.png")));
    }
}

fn press(app: &mut App, key: Key) {
    app.key_press(key);
    app.run_steps(6);
}

fn with_map(app: &mut App) {
    press(app, Key::M);
    wait(app, "a map", |app| app.study(Topic::Map).2);
}

/// Which part of all pixels looks different.
fn difference(a: &ColorImage, b: &ColorImage) -> f64 {
    assert_eq!(a.size, b.size);
    let differs = |(a, b): (&eframe::egui::Color32, &eframe::egui::Color32)| {
        (0..3).any(|i| a.to_array()[i].abs_diff(b.to_array()[i]) > OFF)
    };
    let count = a.pixels.iter().zip(&b.pixels).filter(|pair| differs(*pair)).count();
    count as f64 / a.pixels.len() as f64
}

#[test]
fn the_screen_looks_as_it_did() {
    let mut fast = paper();
    fast.motion.speed = 12.0;
    let mut out = paper();
    out.motion.position = [8.0, -3.0];
    let shots = [
        ("desktop-light", shot(&paper(), DESKTOP, Theme::Light, |_| {})),
        ("desktop-dark-map", shot(&paper(), DESKTOP, Theme::Dark, with_map)),
        ("phone-light", shot(&paper(), PHONE, Theme::Light, |_| {})),
        ("unstable-dark", shot(&fast, DESKTOP, Theme::Dark, |_| {})),
        ("infeasible-light", shot(&out, DESKTOP, Theme::Light, |_| {})),
    ];
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/pictures");
    let mut different = Vec::new();
    for (name, now) in &shots {
        keep(name, now);
        let file = kept.join(format!("{name}.png"));
        let Some(before) = read(&file) else {
            different.push(format!("{} cannot be read", file.display()));
            continue;
        };
        let part = difference(&before, now);
        if part > PART {
            let shown = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
            write(now, &shown);
            different.push(format!("{name}: {:.2} % of the pixels, see {}", 100.0 * part, shown.display()));
        }
    }
    assert!(different.is_empty(), "{different:#?}");
}

#[test]
fn pictures_that_differ_are_told_apart() {
    let white = ColorImage::filled([100, 100], eframe::egui::Color32::WHITE);
    let mut other = white.clone();
    assert!(difference(&white, &other) < 1e-12);
    for x in 0..30 {
        other[(x, 7)] = eframe::egui::Color32::BLACK;
    }
    assert!((difference(&white, &other) - 0.003).abs() < 1e-12 && difference(&white, &other) > PART);
}

/// Writes pictures of every size, of every plot and of what can be opened; nothing where none are wanted.
#[test]
fn all_pictures_that_are_wanted() {
    if folder().is_none() {
        return;
    }
    for (word, theme) in THEMES {
        for (name, size) in SIZES {
            keep(&format!("{name}-{word}"), &shot(&paper(), size, theme, |_| {}));
        }
        for (group, tab) in [
            ("This pose", "Modes"),
            ("This pose", "Growth"),
            ("Workspace", "Along the line"),
            ("Workspace", "Directions"),
            ("Model", "Speed diagram"),
            ("Model", "What to change"),
            ("Model", "What if"),
            ("Model", "Mesh error"),
        ] {
            let open = |app: &mut App| {
                app.get_by_role_and_label(Role::RadioButton, group).click();
                app.run_steps(3);
                app.get_all_by_role_and_label(Role::Tab, tab).last().expect("a tab").click();
                app.run_steps(6);
            };
            keep(&format!("{tab}-{word}"), &shot(&paper(), DESKTOP, theme, open));
        }
        for tab in ["Robot", "Plots", "Explain"] {
            let open = |app: &mut App| {
                app.get_by_role_and_label(Role::Tab, tab).click();
                app.run_steps(6);
            };
            keep(&format!("phone-{tab}-{word}"), &shot(&paper(), PHONE, theme, open));
        }
        let present = shot(&paper(), Vec2::new(1280.0, 720.0), theme, |app| press(app, Key::F));
        keep(&format!("present-{word}"), &present);
    }
}

/// Pictures of a path and its controls; nothing where none are wanted.
#[test]
fn pictures_of_a_path_that_are_wanted() {
    if folder().is_none() {
        return;
    }
    let straight = scenario::Path::new(vec![[6.0, 0.0]], 7.0);
    let mut smooth = scenario::Path::new(vec![[-2.0, 2.5], [3.0, -1.5], [6.0, 1.0]], 4.0);
    (smooth.corners, smooth.profile) = (Corners::Smooth, ProfileKind::Scurve);
    for (word, theme) in THEMES {
        for (shape, path) in [("straight", &straight), ("smooth", &smooth)] {
            for (name, size) in [("phone", PHONE), ("desktop", DESKTOP)] {
                let mut scenario = Scenario { path: Some(path.clone()), ..paper() };
                scenario.motion.position = [-6.0, 0.0];
                let open = |app: &mut App| {
                    // The controls of the path alone.
                    for group in ["Motion", "Path"] {
                        if app.query_by_role_and_label(Role::Button, group).is_some() {
                            app.get_by_role_and_label(Role::Button, group).scroll_to_me();
                            app.run_steps(20);
                            app.get_by_role_and_label(Role::Button, group).click();
                            app.run_steps(6);
                        }
                    }
                    if size == PHONE {
                        app.get_by_role_and_label(Role::Slider, "Peak speed v").scroll_to_me();
                        app.run_steps(20);
                    }
                };
                keep(&format!("path-{shape}-{name}-{word}"), &shot(&scenario, size, theme, open));
            }
        }
    }
}
