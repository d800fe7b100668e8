//! A pose without an equilibrium: which cable would have to push, and where the robot could rest last.

use eframe::egui::{Pos2, Rect, Shape, Stroke, Vec2};

use super::Scene;
use super::labels::{Pen, along, beside};
use super::layout::Layout;
use super::paint::dashed;
use crate::app::digits;

/// The heads of the arrow along a cable are so far from its ends, in points, where it is long enough.
const INSET: f32 = 40.0;
/// The ring where the robot could rest last.
const GHOST: f32 = 7.0;

/// Draws what is wrong with the pose, where something is.
pub fn ui(pen: &mut Pen<'_>, layout: &Layout, scene: &Scene) {
    let Some(trouble) = scene.trouble else { return };
    let (painter, tokens) = (pen.painter, pen.tokens);
    if let Some(rested) = trouble.rested {
        let (ghost, platform) = (layout.view.pos_in_ui(rested), layout.platform);
        let way = platform - ghost;
        if way.length() > GHOST + 10.0 {
            let ahead = way.normalized();
            let line = [ghost + ahead * GHOST, platform - ahead * 10.0];
            dashed(painter, line, Stroke::new(1.75, tokens.accent), [2.0, 4.0]);
        }
        painter.circle(ghost, GHOST, tokens.canvas, Stroke::new(2.0, tokens.accent));
        pen.places.keep_free(Rect::from_center_size(ghost, Vec2::splat(2.0 * GHOST)));
    }
    let Some((cable, &winch)) = trouble.cable.and_then(|cable| Some((cable, layout.winches.get(cable)?))) else {
        return;
    };
    let line = [layout.platform, winch];
    let way = winch - layout.platform;
    let Some(push) = trouble.push else {
        dashed(painter, line, Stroke::new(2.0, tokens.critical), [6.0, 6.0]);
        write_beside(pen, line, format!("cable {} is the reason", cable + 1));
        return;
    };
    let ahead = way.normalized();
    let inset = INSET.min(0.25 * way.length());
    dashed(
        painter,
        [layout.platform + ahead * 12.0, winch - ahead * 8.0],
        Stroke::new(4.0, tokens.critical),
        [10.0, 6.0],
    );
    for (tip, ahead) in [(winch - ahead * inset, ahead), (layout.platform + ahead * inset, -ahead)] {
        let across = ahead.rot90();
        let head = vec![tip, tip - ahead * 17.0 + across * 8.0, tip - ahead * 17.0 - across * 8.0];
        painter.add(Shape::convex_polygon(head, tokens.critical, Stroke::new(1.5, tokens.canvas)));
    }
    let text = format!("cable {} would have to push, {} N", cable + 1, digits::certain(push, Some(0.5)));
    write_beside(pen, line, text);
}

fn write_beside(pen: &mut Pen<'_>, line: [Pos2; 2], text: String) {
    pen.places.add_line(&line);
    pen.write(text, pen.tokens.critical, |size| along(&line, &[0.5, 0.4, 0.6, 0.3, 0.7], 10.0, size));
}

/// What the border of the region means in which the robot can rest, in words at the foot of the workspace.
pub fn border_words(pen: &mut Pen<'_>, layout: &Layout, scene: &Scene) {
    let frame = layout.view.rect_in_ui(scene.frame).intersect(layout.view.rect);
    let places = |size: Vec2| {
        let (foot, top) = (frame.center_bottom() - Vec2::new(0.0, 16.0), frame.center_top() + Vec2::new(0.0, 10.0));
        let at_foot = [0.0, -0.5, 0.5].map(|part| beside(foot + Vec2::new(part * size.x, 0.0), Vec2::UP, 0.0, size));
        at_foot.into_iter().chain([beside(top, Vec2::DOWN, 0.0, size)]).collect()
    };
    pen.write("the robot can rest inside the green line".into(), pen.tokens.stable, places);
}
