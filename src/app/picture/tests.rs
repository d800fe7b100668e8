//! Pictures of every plot and of the canvas. With `TAUTLINE_PICTURES=FOLDER` they are written there to be looked at.

// Sizes and places in pictures are positive and small.
#![expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]

use std::time::{Duration, Instant};

use eframe::egui::{ColorImage, Id, Theme, Vec2};
use egui_kittest::Harness;

use super::{Format, PLOT};
use crate::app::state::{Plot, PlotGroup};
use crate::app::{Start, Tautline, theme};
use crate::compute::protocol::Topic;
use crate::robot::Linearisation;
use crate::scenario::{Path, presets};

/// What stands on buttons, handles and cards beside the drawings.
const PRESSED: [&str; 10] = [
    "Fit",
    "All",
    "Reset",
    "Turn to lowest",
    "Cancel",
    "What am I seeing?",
    "Enlarge",
    "Highest frequency",
    "Go to",
    "▼ Lowest",
];

/// The texts in a drawing, once it is well-formed: every tag that is opened is closed, and no text has a bare sign of XML.
fn texts(svg: &str) -> Vec<String> {
    let (mut open, mut texts) = (Vec::new(), Vec::new());
    let mut rest = svg;
    while let Some(start) = rest.find('<') {
        let text = rest[..start].trim();
        assert!(!text.contains('>'), "{text}");
        for part in text.split('&').skip(1) {
            assert!(["amp;", "lt;", "gt;", "quot;"].iter().any(|entity| part.starts_with(entity)), "{text}");
        }
        if !text.is_empty() {
            texts.push(text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&"));
        }
        let end = start + rest[start..].find('>').expect("a tag ends");
        let tag = &rest[start + 1..end];
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        let name = tag.trim_start_matches('/').split([' ', '/']).next().expect("a name");
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "{tag}");
        } else if !tag.ends_with('/') {
            open.push(name);
        }
        rest = &rest[end + 1..];
    }
    assert!(open.is_empty(), "{open:?}");
    texts
}

/// The longest wait: tests may run without optimisation on a machine that has other work.
const PATIENCE: Duration = Duration::from_mins(10);

fn wait(app: &mut Harness<'static, Tautline>, ready: impl Fn(&Tautline) -> bool) {
    let begun = Instant::now();
    while !ready(app.state()) {
        assert!(begun.elapsed() < PATIENCE, "not ready after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(2));
        app.step();
    }
}

/// The paper's robot with everything computed, under a name that XML has to escape.
fn app(theme: Theme) -> Harness<'static, Tautline> {
    let mut scenario = presets::PRESETS[0].scenario();
    scenario.name = Some("A <robot> & its-name".into());
    scenario.path = Some(Path::new(vec![[4.0, 0.0]], 3.0));
    let start = Start { scenario: Some(scenario), ..Start::default() };
    let builder = Harness::builder().with_size(Vec2::new(1280.0, 800.0)).with_theme(theme);
    let mut app = builder.build_eframe(|context| Tautline::new(context, start));
    app.run_steps(3);
    wait(&mut app, |app| app.analysis().is_some_and(|analysis| analysis.current));
    app
}

fn plots() -> impl Iterator<Item = Plot> {
    PlotGroup::ALL.into_iter().flat_map(|(_, _, plots)| plots.iter().copied())
}

fn decoded(png: &[u8]) -> ColorImage {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG file");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut bytes).expect("pixels");
    ColorImage::from_rgba_unmultiplied([info.width as usize, info.height as usize], &bytes)
}

fn keep(name: &str, format: Format, bytes: &[u8]) {
    if let Some(folder) = std::env::var_os("TAUTLINE_PICTURES") {
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(std::path::Path::new(&folder).join(name.to_owned() + format.ending()), bytes).expect("a file");
    }
}

/// A drawing's texts, checked for what must be in every picture and what must be in none.
fn checked(svg: &[u8], what: &str) -> Vec<String> {
    let svg = std::str::from_utf8(svg).expect("text");
    for wrong in ["NaN", "\"inf", "-inf", " inf"] {
        assert!(!svg.contains(wrong), "{what}: {wrong}");
    }
    let texts = texts(svg);
    let all = texts.join("\n");
    let scenario = presets::PRESETS[0].scenario();
    let model = if scenario.linearisation == Linearisation::Secant { "secant" } else { "tangent" };
    let elements = format!("n = {} elements per cable", scenario.elements_per_cable);
    // The description has the caption in one line, however it is broken in the drawing.
    for part in
        ["A <robot> & its-name: E = ", ", A = ", ", μ = ", ", m = ", "v = ", "critical speed ", model, &elements]
    {
        assert!(texts.iter().any(|text| text.contains(part)), "{what}: {part} is not in {all}");
    }
    assert!(all.contains(concat!("Tautline ", env!("CARGO_PKG_VERSION"))), "{what}");
    for button in PRESSED {
        assert!(texts.iter().all(|text| text != button && !text.contains("Drag")), "{what} has {button}");
    }
    texts
}

/// A PNG file's pixels: exactly twice the drawing's size, and of more than one colour.
fn pixels(png: &[u8], svg: &[u8], what: &str) -> ColorImage {
    let image = decoded(png);
    let svg = std::str::from_utf8(svg).expect("text");
    let side = |name: &str| -> usize {
        let rest = svg.split_once(&format!(" {name}=\"")).expect("a size").1;
        rest.split('"').next().and_then(|number| number.parse().ok()).expect("whole points")
    };
    assert_eq!(image.size, [2 * side("width"), 2 * side("height")], "{what}");
    let ground = image[(1, 1)];
    let drawn = image.pixels.iter().filter(|pixel| **pixel != ground).count();
    assert!(drawn * 200 > image.pixels.len(), "{what}: {drawn} pixels");
    image
}

#[test]
fn every_plot_makes_a_picture_with_titles_units_and_numbers_and_nothing_to_press() {
    for theme in [Theme::Light, Theme::Dark] {
        let mut app = app(theme);
        for plot in plots() {
            app.state_mut().state.plot = plot;
            app.run_steps(3);
            wait(&mut app, |app| app.at_work().is_empty());
            wait(&mut app, |app| {
                app.present.answers.sensitivities().is_some() && app.plot_picture(plot, Id::NULL, Format::Svg).is_some()
            });
            app.run_steps(3);
            let make = |format| {
                let file = app.state().plot_picture(plot, Id::NULL, format).expect("something to see");
                file.expect("a picture")
            };
            let (svg, png) = (make(Format::Svg), make(Format::Png));
            let name = format!("{}-{theme:?}", plot.name());
            keep(&name, Format::Svg, &svg);
            keep(&name, Format::Png, &png);
            let texts = checked(&svg, &name);
            let parts: &[&str] = match plot.name() {
                "eigenvalues" => &["Eigenvalues", "growth rate Re λ, 1/s", "frequency, Hz"],
                "modes" => &["Modes", "grows, 1/s", "Hz"],
                "growth" => &["Largest growth rate against speed", "speed, m/s", "largest growth rate, 1/s"],
                "line" => &["y = 0 m", "x, m", "critical speed, m/s", "frequency, Hz"],
                "directions" => &["Critical speed by direction, m/s"],
                "speed" => &["frequency, Hz", "growth rate, 1/s", "speed, m/s"],
                "mesh" => &["Critical speed against the mesh", "elements per cable", "critical speed, m/s"],
                "path" => &["Speed on the path", "x, m", "speed, m/s", "wave limit", "flown"],
                "deviation" => &["off its path", "time, s", "deviation, mm", "along x", "along y"],
                "tensions" => &["Cable tensions", "time, s", "tension at the platform, N"],
                "gain" => &["Gain of the move", "peak speed, m/s", "vibration after / before", "frozen"],
                "change" => &["What to change", "Percent of critical speed"],
                _ => &[],
            };
            for part in parts {
                assert!(texts.iter().any(|text| text.contains(part)), "{name}: {part} is not in {texts:?}");
            }
            if plot == Plot::Modes {
                // The table is whole: its last row is there.
                let count = app.state().present.answers.last_pose().map_or(0, |(pose, _)| pose.modes.len());
                let last = |text: &String| text.split('×').next() == Some(count.to_string().as_str());
                assert!(count > 20 && texts.iter().any(last), "{name}: {count} rows");
            }
            let image = pixels(&png, &svg, &name);
            if !matches!(plot, Plot::Modes | Plot::Sensitivities) {
                assert_eq!(image.size, [2 * PLOT.x as usize, 2 * PLOT.y as usize]);
            }
        }
    }
}

/// The circle that is drawn for a winch has its colour in both files, at the same place.
#[test]
fn the_canvas_makes_a_picture_with_and_without_the_map() {
    for theme in [Theme::Light, Theme::Dark] {
        let mut app = app(theme);
        for map in [false, true] {
            app.state_mut().state.map.on = map;
            app.run_steps(3);
            if map {
                wait(&mut app, |app| app.study(Topic::Map).2);
                app.run_steps(30);
            }
            let make = |format| app.state().canvas_picture(format).expect("a picture");
            let (svg, png) = (make(Format::Svg), make(Format::Png));
            let name = format!("canvas-{map}-{theme:?}");
            keep(&name, Format::Svg, &svg);
            keep(&name, Format::Png, &png);
            let texts = checked(&svg, &name);
            let legend = if map { "Critical speed, m/s" } else { "Cable tension, N" };
            assert!(texts.iter().any(|text| text == legend), "{name}: {texts:?}");
            let svg_text = std::str::from_utf8(&svg).expect("text");
            assert_eq!(svg_text.contains("data:image/png;base64,"), map, "{name}");
            let image = pixels(&png, &svg, &name);
            // Filled circles that nothing lies on at their lowest points: their colour is there in the pixels.
            let mut seen = 0;
            for circle in svg_text.lines().filter(|line| line.starts_with("<circle") && !line.contains("opacity")) {
                let value =
                    |name: &str| circle.split_once(&format!(" {name}=\"")).and_then(|(_, rest)| rest.split('"').next());
                let number = |name: &str| value(name).and_then(|text| text.parse::<f32>().ok()).expect("a number");
                let Some(fill) = value("fill").filter(|fill| *fill != "none") else { continue };
                let (x, y, radius) = (number("cx"), number("cy"), number("r"));
                if radius < 4.0 {
                    continue;
                }
                let middle = image[((2.0 * x) as usize, (2.0 * (y + 0.7 * radius)) as usize)];
                let hex = format!("#{:02x}{:02x}{:02x}", middle.r(), middle.g(), middle.b());
                seen += usize::from(hex == fill);
            }
            assert!(seen > 0, "{name}: no circle has its colour");
            let tokens = theme::tokens(&app.ctx.global_style().visuals);
            assert_eq!(image[(1, 1)], tokens.canvas);
        }
    }
}

/// A plot that shows nothing yet makes no picture.
#[test]
fn there_is_no_picture_of_what_is_not_known() {
    let app = app(Theme::Light);
    assert!(app.state().plot_picture(Plot::Directions, Id::NULL, Format::Png).is_none());
}
