//! What the canvas says of each cable: to those who point at it, to screen readers, and as labels where they are wanted.

use eframe::egui::{Label, PopupAnchor, Pos2, Rect, Response, Role, Sense, Tooltip, Ui, WidgetInfo};

use super::labels::{Pen, along};
use super::layout::Layout;
use super::model::{CableLine, Figures, Scene, Trouble};
use crate::app::digits;
use crate::robot::TensionLaw;

/// A pointer that is nearer to a cable than this, in points, is on it.
const NEAR: f32 = 7.0;
/// The middle of a cable, and where else along it its label may be.
const PLACES: [f32; 6] = [0.5, 0.42, 0.58, 0.34, 0.66, 0.26];

/// The cables as lines on the screen; a cable without a shape is the straight line to its winch.
pub fn lines(layout: &Layout, scene: &Scene) -> Vec<Vec<Pos2>> {
    let line = |(cable, &winch): (&CableLine, &Pos2)| match &cable.nodes[..] {
        [] => vec![layout.platform, winch],
        nodes => nodes.iter().map(|&node| layout.view.pos_in_ui(node)).collect(),
    };
    scene.cables.iter().zip(&layout.winches).map(line).collect()
}

/// The cable that the pointer is on, where it is on nothing else.
pub fn under_pointer(background: &Response, lines: &[Vec<Pos2>]) -> Option<usize> {
    let pointer = background.hover_pos().filter(|_| background.hovered() && !background.dragged())?;
    let distances = lines.iter().map(|line| distance(line, pointer)).enumerate();
    distances.filter(|(_, distance)| *distance < NEAR).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(cable, _)| cable)
}

/// How far a point is from a line, in points.
fn distance(line: &[Pos2], point: Pos2) -> f32 {
    let from_part = |ends: &[Pos2]| {
        let way = ends[1] - ends[0];
        let part = ((point - ends[0]).dot(way) / way.length_sq().max(1e-6)).clamp(0.0, 1.0);
        (point - (ends[0] + way * part)).length()
    };
    line.windows(2).map(from_part).fold(f32::INFINITY, f32::min)
}

/// Names the cables for screen readers, and says the figures of the one that the pointer is on.
pub fn ui(ui: &Ui, lines: &[Vec<Pos2>], scene: &Scene, canvas: Rect, pointed: Option<usize>) {
    for (i, (line, cable)) in lines.iter().zip(&scene.cables).enumerate() {
        let place = Rect::from_points(line).expand(4.0).intersect(canvas);
        if !place.is_positive() {
            continue;
        }
        let response = ui.interact(place, ui.scope_id().with(("cable", i)), Sense::hover());
        let name = format!("Cable {}", i + 1);
        let told = told(i, cable, scene.trouble);
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_description(told.as_str()));
        if pointed == Some(i) {
            let text = format!("{name}\n{told}");
            let tooltip = Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), response.id, PopupAnchor::Pointer);
            tooltip.gap(14.0).show(|ui| ui.add(Label::new(text).extend()));
        }
    }
}

/// Writes each cable's figures beside its middle.
pub fn labels(pen: &mut Pen<'_>, lines: &[Vec<Pos2>], scene: &Scene) {
    for (i, (line, cable)) in lines.iter().zip(&scene.cables).enumerate() {
        if let Some(figures) = cable.figures {
            pen.write(short(i, figures), pen.tokens.text, |size| along(line, &PLACES, 5.0, size));
        }
    }
}

/// A cable in one line: its number, its tension, and how it is reeled.
fn short(i: usize, Figures { at_platform, reeling, .. }: Figures) -> String {
    format!("{}: {} N, {}", i + 1, digits::certain(at_platform, Some(0.5)), reeled(reeling))
}

/// How a cable is reeled, in m/s without the unit.
fn reeled(speed: f64) -> String {
    if speed.abs() < 1e-6 {
        return "at rest".into();
    }
    format!("{} {}", if speed < 0.0 { "in" } else { "out" }, digits::certain(speed.abs(), Some(0.05)))
}

/// What is known of a cable, in lines.
fn told(i: usize, cable: &CableLine, trouble: Option<Trouble>) -> String {
    let law = match cable.law {
        TensionLaw::Equilibrium => "It balances the platform.",
        TensionLaw::Constant(_) => "Its tension is held.",
        TensionLaw::Hypot { .. } => "Its tension follows its law.",
    };
    let Some(Figures { at_platform, at_winch, length, reeling }) = cable.figures else {
        let push = trouble.filter(|trouble| trouble.cable == Some(i)).and_then(|trouble| trouble.push);
        return match push {
            Some(push) => format!("It would have to push, {} N.", digits::certain(push, Some(0.5))),
            None => format!("There is no equilibrium here. {law}"),
        };
    };
    let [at_platform, at_winch, length] = [at_platform, at_winch, length].map(|value| digits::certain(value, None));
    let unit = if reeling.abs() < 1e-6 { "" } else { " m/s" };
    format!(
        "{at_platform} N at the platform, {at_winch} N at the winch\n{length} m unstretched\n{}{unit}\n{law}",
        reeled(reeling)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cable(figures: Option<Figures>) -> CableLine {
        CableLine {
            anchor: [10.0, -5.0],
            law: TensionLaw::Constant(67.3),
            nodes: Vec::new(),
            forces: Vec::new(),
            vibrating: Vec::new(),
            marked: false,
            figures,
        }
    }

    #[test]
    fn a_cable_says_its_figures_in_words() {
        let figures = Figures { at_platform: 67.268, at_winch: 66.31, length: 11.234, reeling: -4.583 };
        assert_eq!(short(3, figures), "4: 67 N, in 4.6");
        assert_eq!(short(0, Figures { at_platform: 166.9, reeling: 4.45, ..figures }), "1: 167 N, out 4.5");
        assert_eq!(short(0, Figures { reeling: 0.0, ..figures }), "1: 67 N, at rest");
        let expected =
            "67.3 N at the platform, 66.3 N at the winch\n11.2 m unstretched\nin 4.6 m/s\nIts tension is held.";
        assert_eq!(told(3, &cable(Some(figures)), None), expected);
    }

    #[test]
    fn a_cable_that_would_push_says_so() {
        let trouble = Trouble { cable: Some(0), push: Some(34.2), rested: None };
        assert_eq!(told(0, &cable(None), Some(trouble)), "It would have to push, 34 N.");
        assert!(told(1, &cable(None), Some(trouble)).starts_with("There is no equilibrium here."));
    }

    #[test]
    fn the_distance_to_a_line_is_that_to_its_nearest_part() {
        let line = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]].map(Pos2::from);
        for (point, expected) in [([5.0, 3.0], 3.0), ([14.0, 5.0], 4.0), ([-3.0, -4.0], 5.0), ([10.0, 10.0], 0.0)] {
            assert!((distance(&line, point.into()) - expected).abs() < 1e-5, "{point:?}");
        }
        assert!(distance(&[], Pos2::ZERO).is_infinite());
    }
}
