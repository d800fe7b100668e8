//! Words on the canvas: each takes a place where it meets no other and, where that is possible, no line.

use eframe::egui::{Color32, FontId, Painter, Pos2, Rect, Vec2};

use crate::app::theme::Tokens;

/// Points kept free between two words.
const APART: f32 = 3.0;
/// Meeting a word is worse than crossing this many lines.
const WORDS_OVER_LINES: usize = 1000;

/// The places that are taken.
#[derive(Clone, Debug)]
pub struct LabelRoom {
    room: Rect,
    words: Vec<Rect>,
    lines: Vec<[Pos2; 2]>,
}

impl LabelRoom {
    /// All of `room` is free.
    pub fn new(room: Rect) -> Self {
        Self { room, words: Vec::new(), lines: Vec::new() }
    }

    /// Nothing is to be written there.
    pub fn keep_free(&mut self, place: Rect) {
        self.words.push(place);
    }

    /// A line that words are not to cross.
    pub fn add_line(&mut self, points: &[Pos2]) {
        self.lines.extend(points.windows(2).map(|ends| [ends[0], ends[1]]));
    }

    /// Takes the best of some places, moved into the room: the first one that meets no word and crosses the fewest lines.
    pub fn take(&mut self, candidates: Vec<Rect>) -> Option<Rect> {
        let moved = candidates.into_iter().map(|place| into(self.room, place));
        let best = moved.min_by_key(|place| {
            let grown = place.expand(APART);
            let words = self.words.iter().filter(|word| word.intersects(grown)).count();
            WORDS_OVER_LINES * words + self.lines.iter().filter(|line| crosses(*place, **line)).count()
        })?;
        self.words.push(best);
        Some(best)
    }
}

/// The rectangle moved as little as possible to lie in `room`.
fn into(room: Rect, place: Rect) -> Rect {
    let along = |low: f32, high: f32, least: f32, most: f32| (most - high).min(0.0).max(least - low);
    let x = along(place.min.x, place.max.x, room.min.x, room.max.x);
    let y = along(place.min.y, place.max.y, room.min.y, room.max.y);
    place.translate(Vec2::new(x, y))
}

/// Whether a line between two points meets a rectangle.
fn crosses(rect: Rect, [from, to]: [Pos2; 2]) -> bool {
    let way = to - from;
    let (mut begin, mut end) = (0.0_f32, 1.0_f32);
    for (at, way, low, high) in [(from.x, way.x, rect.min.x, rect.max.x), (from.y, way.y, rect.min.y, rect.max.y)] {
        if way.abs() < 1e-6 {
            if at < low || at > high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - at) / way, (high - at) / way);
        (begin, end) = (begin.max(a.min(b)), end.min(a.max(b)));
    }
    begin <= end
}

/// A rectangle of this size beside a point, on the side of the unit vector `towards`, `gap` points away.
pub fn beside(point: Pos2, towards: Vec2, gap: f32, size: Vec2) -> Rect {
    let reach = 0.5 * (towards.x.abs() * size.x + towards.y.abs() * size.y);
    Rect::from_center_size(point + towards * (gap + reach), size)
}

/// Places for words of this size beside a line, at these parts of its length: first on the side that points up.
pub fn along(line: &[Pos2], parts: &[f32], gap: f32, size: Vec2) -> Vec<Rect> {
    let lengths: Vec<f32> = line.windows(2).map(|ends| (ends[1] - ends[0]).length()).collect();
    let whole: f32 = lengths.iter().sum();
    let mut places = Vec::new();
    for part in parts {
        let mut left = part * whole;
        for (ends, &length) in line.windows(2).zip(&lengths) {
            if left > length || length <= 0.0 {
                left -= length;
                continue;
            }
            let ahead = (ends[1] - ends[0]) / length;
            let across = ahead.rot90();
            let up = if across.y < 0.0 { across } else { -across };
            let point = ends[0] + ahead * left;
            places.extend([up, -up].map(|side| beside(point, side, gap, size)));
            break;
        }
    }
    places
}

/// What words are written with.
pub struct Pen<'a> {
    /// Where they are drawn.
    pub painter: &'a Painter,
    /// The colours.
    pub tokens: &'static Tokens,
    /// The letters.
    pub font: FontId,
    /// What is taken.
    pub places: LabelRoom,
}

impl Pen<'_> {
    /// Writes words at the best of the places that `candidates` gives for their size.
    pub fn write(&mut self, text: String, colour: Color32, candidates: impl FnOnce(Vec2) -> Vec<Rect>) {
        let galley = self.painter.layout_no_wrap(text, self.font.clone(), colour);
        if let Some(place) = self.places.take(candidates(galley.size())) {
            // So that it can be read over lines and colours.
            self.painter.rect_filled(place.expand2(Vec2::new(3.0, 0.0)), 3.0, self.tokens.canvas.gamma_multiply(0.8));
            self.painter.galley(place.min, galley, colour);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Vec2 = Vec2::new(60.0, 14.0);

    fn places() -> LabelRoom {
        LabelRoom::new(Rect::from_min_size(Pos2::ZERO, Vec2::new(400.0, 300.0)))
    }

    #[test]
    fn words_that_would_meet_swap_sides() {
        let mut places = places();
        let sides = |point| [Vec2::UP, Vec2::DOWN].map(|side| beside(point, side, 10.0, SIZE)).to_vec();
        let first = places.take(sides(Pos2::new(200.0, 100.0))).expect("a place");
        let second = places.take(sides(Pos2::new(210.0, 100.0))).expect("a place");
        assert_eq!((first.center(), second.center()), (Pos2::new(200.0, 83.0), Pos2::new(210.0, 117.0)));
        // Far enough from both it is above again.
        assert!(places.take(sides(Pos2::new(300.0, 100.0))).is_some_and(|third| third.center().y < 100.0));
        assert_eq!(places.take(Vec::new()), None);
    }

    #[test]
    fn words_keep_clear_of_lines_where_they_can_and_stay_in_the_room() {
        let mut places = places();
        places.add_line(&[Pos2::new(0.0, 80.0), Pos2::new(400.0, 90.0)]);
        let sides = |point| [Vec2::UP, Vec2::DOWN].map(|side| beside(point, side, 10.0, SIZE)).to_vec();
        assert!(places.take(sides(Pos2::new(200.0, 100.0))).is_some_and(|place| place.center().y > 100.0));
        let edge = places.take(sides(Pos2::new(395.0, 200.0))).expect("a place");
        assert_eq!((edge.max.x, edge.center().y), (400.0, 183.0));
    }

    #[test]
    fn a_line_crosses_what_it_enters() {
        let rect = Rect::from_min_max(Pos2::new(10.0, 10.0), Pos2::new(20.0, 20.0));
        let line = |a: [f32; 2], b: [f32; 2]| crosses(rect, [a.into(), b.into()]);
        assert!(line([0.0, 0.0], [30.0, 30.0]) && line([12.0, 12.0], [13.0, 13.0]) && line([15.0, 0.0], [15.0, 30.0]));
        assert!(
            !line([0.0, 12.0], [8.0, 12.0]) && !line([0.0, 25.0], [25.0, 50.0]) && !line([25.0, 0.0], [25.0, 30.0])
        );
    }

    #[test]
    fn places_along_a_line_are_beside_it() {
        let line = [Pos2::new(0.0, 100.0), Pos2::new(100.0, 100.0), Pos2::new(100.0, 0.0)];
        let found = along(&line, &[0.25, 0.75], 6.0, SIZE);
        let centres: Vec<Pos2> = found.iter().map(Rect::center).collect();
        let expected = [[50.0, 87.0], [50.0, 113.0]].map(Pos2::from);
        assert_eq!(centres[..2], expected);
        assert!(centres[2..].iter().all(|centre| (centre.y - 50.0).abs() < 1e-3 && (centre.x - 100.0).abs() > 35.0));
        assert!(along(&[], &[0.5], 6.0, SIZE).is_empty());
    }
}
