//! Charts as they are painted here: no frame, few round numbers, and words beside what they are about.

use std::sync::Arc;

use eframe::egui::epaint::{Mesh, TextShape};
use eframe::egui::{Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Shape, Stroke, TextStyle, Ui, Vec2};

use super::axis::Axis;
use super::labels::{Labels, beside};
use crate::app::designs::Letter;
use crate::app::theme::{self, Tokens};

/// Longer lines than this, in points, are not dashed: the dashes would be without number.
const LONGEST_DASHED: f32 = 1e4;
/// Points of the screen between two lines of a hatch.
const HATCH: f32 = 8.0;
/// Room around a word on its ground, in points.
const PILL: Vec2 = Vec2::new(3.0, 1.0);

/// The dashes of lines that belong together, each with the gaps that follow; the first has none.
const DASHES: [(&[f32], &[f32]); 5] =
    [(&[], &[]), (&[8.0], &[4.0]), (&[2.5], &[3.0]), (&[9.0, 2.0], &[3.0, 3.0]), (&[9.0, 2.0, 2.0], &[3.0, 3.0, 3.0])];

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// Without gaps.
    Solid,
    /// What is now.
    Dashed,
    /// The wave limit.
    Dotted,
    /// One of several lines that belong together, told apart by their dashes: 0 is without gaps.
    Pattern(usize),
    /// What belongs to a kept design.
    Design(Letter),
}

/// What stands beside the axes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Titles<'a> {
    /// Under the horizontal axis; its numbers stay away as well where this is `None` and `x_unit` is, too.
    pub x: Option<&'a str>,
    /// Behind the last number of the horizontal axis.
    pub x_unit: Option<&'a str>,
    /// Beside the vertical axis, upward.
    pub y: Option<&'a str>,
}

/// A chart that is being painted.
pub struct Chart {
    /// Where its curves are.
    pub rect: Rect,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis, from the bottom to the top.
    pub y: Axis,
    /// Colours.
    pub tokens: &'static Tokens,
    /// Within `rect`.
    pub painter: Painter,
    /// With all that stands around it.
    around: Painter,
    outer: Rect,
    font: FontId,
    labels: Labels,
    words: Vec<(Rect, Arc<Galley>)>,
}

/// The size of numbers and captions, in points.
pub fn font(ui: &Ui) -> FontId {
    TextStyle::Small.resolve(ui.style())
}

/// Where the curves of a chart are that has all of `outer` for itself, its numbers and its titles.
pub fn inner(ui: &Ui, outer: Rect, titles: Titles<'_>) -> Rect {
    let size = font(ui).size;
    let left = 3.2 * size + if titles.y.is_some() { 1.5 * size } else { 0.0 };
    let numbers = if titles.x.is_some() || titles.x_unit.is_some() { 1.6 * size } else { 0.5 * size };
    let bottom = numbers + if titles.x.is_some() { 1.4 * size } else { 0.0 };
    let rect = Rect::from_min_max(outer.min + Vec2::new(left, 0.5 * size), outer.max - Vec2::new(size, bottom));
    Rect::from_min_size(rect.min, rect.size().max(Vec2::splat(20.0)))
}

impl Chart {
    /// A chart within `outer` whose curves are in `rect`, with these axes.
    pub fn new(ui: &Ui, outer: Rect, rect: Rect, [x, y]: [Axis; 2]) -> Self {
        let around = ui.painter().with_clip_rect(outer.intersect(ui.clip_rect()));
        let painter = around.with_clip_rect(rect.intersect(around.clip_rect()));
        let (tokens, labels) = (theme::tokens(ui.visuals()), Labels::new(rect));
        Self { rect, x, y, tokens, painter, around, outer, font: font(ui), labels, words: Vec::new() }
    }

    /// The axes of a chart whose curves are in `rect`, from and to on each.
    pub fn axes(rect: Rect, [x, y]: [[f64; 2]; 2]) -> [Axis; 2] {
        [Axis::linear(x, [rect.left(), rect.right()]), Axis::linear(y, [rect.bottom(), rect.top()])]
    }

    /// Where a point of the chart is on the screen.
    pub fn pos(&self, [x, y]: [f64; 2]) -> Pos2 {
        Pos2::new(self.x.pos(x), self.y.pos(y))
    }

    /// Draws the grid with its numbers, and the axes' titles.
    pub fn grid(&self, titles: Titles<'_>) {
        let Tokens { line, numbers, weak, .. } = *self.tokens;
        let size = self.font.size;
        let stroke = Stroke::new(1.0, line);
        let rect = self.rect;
        // As many as have room beside each other.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Small and not negative.
        let most = |length: f32, each: f32| (length / each).floor().max(2.0) as usize;
        // Of what is in sight: the axis may be longer.
        let ends = [rect.left(), rect.right()];
        let seen = Axis { range: ends.map(|end| self.x.value(end)), ends, ..self.x };
        let ticks = seen.ticks(most(rect.width(), 6.5 * size).clamp(4, 10));
        let texts = self.x.texts(&ticks);
        let written = titles.x.is_some() || titles.x_unit.is_some();
        for (i, (tick, text)) in ticks.iter().zip(&texts).enumerate() {
            let x = self.x.pos(*tick);
            if !rect.x_range().expand(0.5).contains(x) {
                continue;
            }
            self.around.vline(x, rect.y_range(), stroke);
            let last = ticks.get(i + 1).is_none_or(|next| self.x.pos(*next) > rect.right() + 0.5);
            let text = match titles.x_unit {
                Some(unit) if last => format!("{text} {unit}"),
                _ => text.clone(),
            };
            if written {
                let at = Pos2::new(x, rect.bottom() + 0.3 * size);
                let galley = self.around.layout_no_wrap(text, self.font.clone(), numbers);
                let width = galley.size().x;
                // The last one keeps within the panel.
                let left = (at.x - 0.5 * width).min(self.outer.right() - width);
                self.around.galley(Pos2::new(left, at.y), galley, numbers);
            }
        }
        let ticks = self.y.ticks(most(rect.height(), 2.6 * size).min(8));
        for (tick, text) in ticks.iter().zip(self.y.texts(&ticks)) {
            let y = self.y.pos(*tick);
            if rect.y_range().expand(0.5).contains(y) {
                self.around.hline(rect.x_range(), y, stroke);
                let at = Pos2::new(rect.left() - 0.6 * size, y);
                self.around.text(at, Align2::RIGHT_CENTER, text, self.font.clone(), numbers);
            }
        }
        if let Some(title) = titles.x {
            let at = Pos2::new(rect.center().x, self.outer.bottom());
            self.around.text(at, Align2::CENTER_BOTTOM, title, self.font.clone(), weak);
        }
        if let Some(title) = titles.y {
            let galley = self.around.layout_no_wrap(title.to_owned(), self.font.clone(), weak);
            let at = Pos2::new(self.outer.left(), rect.center().y + 0.5 * galley.size().x);
            self.around.add(TextShape::new(at, galley, weak).with_angle(-std::f32::consts::FRAC_PI_2));
        }
    }

    /// Draws a curve, from which words keep away; one point alone is a dot.
    pub fn curve(&mut self, points: &[[f64; 2]], stroke: Stroke, dash: Dash) {
        let points: Vec<Pos2> = points.iter().map(|&point| self.pos(point)).collect();
        if let [alone] = points[..] {
            self.painter.circle_filled(alone, 2.0, stroke.color);
        }
        self.labels.avoid(&points);
        draw_line(&self.painter, points, stroke, dash);
    }

    /// A line at one height, all across.
    pub fn level(&mut self, y: f64, stroke: Stroke, dash: Dash) {
        let y = self.y.pos(y);
        let line = vec![Pos2::new(self.rect.left(), y), Pos2::new(self.rect.right(), y)];
        self.labels.avoid(&line);
        draw_line(&self.painter, line, stroke, dash);
    }

    /// A line from the bottom to the top.
    pub fn upright(&mut self, x: f64, stroke: Stroke, dash: Dash) {
        let x = self.x.pos(x);
        let line = vec![Pos2::new(x, self.rect.top()), Pos2::new(x, self.rect.bottom())];
        self.labels.avoid(&line);
        draw_line(&self.painter, line, stroke, dash);
    }

    /// Fills what is between a curve and the bottom.
    pub fn area(&self, points: &[[f64; 2]], fill: Color32) {
        let bottom = self.rect.bottom();
        let mut mesh = Mesh::default();
        for pair in points.windows(2) {
            let [a, b] = [self.pos(pair[0]), self.pos(pair[1])];
            quad(&mut mesh, [a, b, Pos2::new(b.x, bottom), Pos2::new(a.x, bottom)], fill);
        }
        self.painter.add(Shape::mesh(mesh));
    }

    /// Fills a band from left to right, or from the bottom to the top.
    pub fn band(&self, [from, to]: [f64; 2], upright: bool, fill: Color32) {
        let rect = if upright {
            Rect::from_x_y_ranges(self.x.pos(from)..=self.x.pos(to), self.rect.y_range())
        } else {
            Rect::from_x_y_ranges(self.rect.x_range(), self.y.pos(to)..=self.y.pos(from))
        };
        self.painter.rect_filled(rect.intersect(self.rect), 0.0, fill);
    }

    /// Hatches a stretch of the horizontal axis, where there is nothing to show.
    pub fn hatch(&self, [from, to]: [f64; 2]) {
        let rect = Rect::from_x_y_ranges(self.x.pos(from)..=self.x.pos(to), self.rect.y_range()).intersect(self.rect);
        if !rect.is_positive() {
            return;
        }
        let painter = self.painter.with_clip_rect(rect.intersect(self.painter.clip_rect()));
        let stroke = Stroke::new(1.0, self.tokens.line);
        let height = rect.height();
        // Lines that begin at multiples, so that neighbours go on into each other.
        let mut x = ((rect.left() - height) / HATCH).floor() * HATCH;
        while x < rect.right() {
            painter.line_segment([Pos2::new(x, rect.bottom()), Pos2::new(x + height, rect.top())], stroke);
            x += HATCH;
        }
    }

    /// A dot that is filled, a triangle that points up, a diamond, a ring or a cross.
    pub fn mark(&self, at: Pos2, mark: Symbol, radius: f32, colour: Color32) {
        let up = |x: f32, y: f32| at + radius * Vec2::new(x, y);
        match mark {
            Symbol::Dot => {
                self.painter.circle_filled(at, radius, colour);
            }
            Symbol::Ring => {
                self.painter.circle_stroke(at, radius, Stroke::new(1.75, colour));
            }
            Symbol::Triangle => {
                let corners = vec![up(0.0, -1.15), up(1.0, 0.75), up(-1.0, 0.75)];
                self.painter.add(Shape::convex_polygon(corners, colour, Stroke::NONE));
            }
            Symbol::Cross => {
                for line in [[up(-1.0, -1.0), up(1.0, 1.0)], [up(-1.0, 1.0), up(1.0, -1.0)]] {
                    self.painter.line_segment(line, Stroke::new(2.25, colour));
                }
            }
            Symbol::Diamond => {
                let corners = vec![up(0.0, -1.2), up(1.2, 0.0), up(0.0, 1.2), up(-1.2, 0.0)];
                self.painter.add(Shape::closed_line(corners, Stroke::new(1.5, colour)));
            }
        }
    }

    /// Words keep away from this point.
    pub fn keep_free(&mut self, at: Pos2, radius: f32) {
        self.labels.take(Rect::from_center_size(at, Vec2::splat(2.0 * radius)));
    }

    /// Writes a word beside one of these points, where it covers least; nowhere if it would lie on another word.
    pub fn label(&mut self, text: impl Into<String>, colour: Color32, spots: &[Pos2]) {
        let galley = self.painter.layout_no_wrap(text.into(), self.font.clone(), colour);
        let size = galley.size() + 2.0 * PILL;
        let middles: Vec<Pos2> = spots.iter().flat_map(|&spot| beside(spot, size)).collect();
        if let Some(rect) = self.labels.place(size, &middles) {
            self.words.push((rect, galley));
        }
    }

    /// Writes a word at a place: this point of the word lies there.
    pub fn label_at(&mut self, text: impl Into<String>, colour: Color32, at: Pos2, align: Align2) {
        let galley = self.painter.layout_no_wrap(text.into(), self.font.clone(), colour);
        let rect = align.anchor_size(at, galley.size() + 2.0 * PILL);
        if let Some(rect) = self.labels.place(rect.size(), &[rect.center()]) {
            self.words.push((rect, galley));
        }
    }

    /// Puts all words over the curves, each on a ground of the panel's colour.
    pub fn finish(&mut self) {
        let ground = self.tokens.panel.gamma_multiply(0.88);
        for (rect, galley) in self.words.drain(..) {
            self.painter.rect_filled(rect, 3.0, ground);
            self.painter.galley(rect.min + PILL, galley, self.tokens.text);
        }
    }

    /// A card beside a point that stays inside the chart: the first line says what it is, the others say more.
    pub fn card(&self, at: Pos2, lines: &[String]) {
        card(&self.around, self.outer, self.tokens, &self.font, at, lines);
    }
}

/// What stands for a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// Stable, or where we are.
    Dot,
    /// Chosen, or a crossing.
    Ring,
    /// Unstable.
    Triangle,
    /// Of a kept design.
    Diamond,
    /// Where a cable goes slack.
    Cross,
}

/// Draws a line.
pub fn draw_line(painter: &Painter, points: Vec<Pos2>, stroke: Stroke, dash: Dash) {
    if points.len() < 2 {
        return;
    }
    let length: f32 = points.windows(2).map(|pair| (pair[1] - pair[0]).length()).sum();
    // A length that is no number, too, is not dashed.
    let short = length < LONGEST_DASHED;
    match dash {
        Dash::Dashed if short => painter.extend(Shape::dashed_line(&points, stroke, 6.0, 4.0)),
        Dash::Design(letter) if short => {
            let (dashes, gaps): (&[f32], &[f32]) = match letter {
                Letter::A => (&[6.0], &[4.0]),
                Letter::B => (&[9.0, 2.0], &[3.0, 3.0]),
                Letter::C => (&[15.0], &[4.0]),
                Letter::D => (&[9.0, 2.0, 2.0], &[3.0, 3.0, 3.0]),
            };
            painter.extend(Shape::dashed_line_with_offset(&points, stroke, dashes, gaps, 0.0));
        }
        Dash::Pattern(which) if short && which % DASHES.len() > 0 => {
            let (dashes, gaps) = DASHES[which % DASHES.len()];
            painter.extend(Shape::dashed_line_with_offset(&points, stroke, dashes, gaps, 0.0));
        }
        Dash::Dotted if short => painter.extend(Shape::dashed_line(&points, stroke, 2.5, 3.0)),
        _ => {
            painter.line(points, stroke);
        }
    }
}

/// Adds a quadrilateral.
pub fn quad(mesh: &mut Mesh, corners: [Pos2; 4], fill: Color32) {
    let Ok(first) = u32::try_from(mesh.vertices.len()) else { return };
    for corner in corners {
        mesh.colored_vertex(corner, fill);
    }
    mesh.add_triangle(first, first + 1, first + 2);
    mesh.add_triangle(first, first + 2, first + 3);
}

/// A card beside a point, within `outer`.
pub fn card(painter: &Painter, outer: Rect, tokens: &Tokens, font: &FontId, at: Pos2, lines: &[String]) {
    const PADDING: Vec2 = Vec2::new(8.0, 5.0);
    let widest = (outer.width() - 2.0 * PADDING.x - 4.0).max(60.0);
    let galleys: Vec<Arc<Galley>> = lines
        .iter()
        .enumerate()
        .map(|(i, line)| {
            let colour = if i == 0 { tokens.text } else { tokens.weak };
            painter.layout(line.clone(), font.clone(), colour, widest)
        })
        .collect();
    let width = galleys.iter().map(|galley| galley.size().x).fold(0.0, f32::max);
    let height: f32 = galleys.iter().map(|galley| galley.size().y).sum();
    let size = Vec2::new(width, height) + 2.0 * PADDING;
    // Above or below the point, whichever has room, and never on it.
    let above = at.y - size.y - 12.0;
    let top = if above >= outer.top() { above } else { (at.y + 12.0).min(outer.bottom() - size.y) };
    let left = (at.x - 0.5 * size.x).clamp(outer.left(), (outer.right() - size.x).max(outer.left()));
    let rect = Rect::from_min_size(Pos2::new(left, top.max(outer.top())), size);
    painter.rect_filled(rect, 6.0, tokens.card);
    painter.rect_stroke(rect, 6.0, Stroke::new(1.0, tokens.frame), eframe::egui::StrokeKind::Inside);
    let mut pos = rect.min + PADDING;
    for galley in galleys {
        let height = galley.size().y;
        painter.galley(pos, galley, tokens.text);
        pos.y += height;
    }
}
