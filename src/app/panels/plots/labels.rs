//! Words beside curves: each takes the best of its places, on no other word and on as little of the curves as it can.

use eframe::egui::{Pos2, Rect, Vec2};

/// Curves are felt at points so far apart, in points of the screen.
const FELT: f32 = 7.0;
/// Room between a word and what it is about.
const GAP: f32 = 6.0;

/// Where words may be.
#[derive(Clone, Debug)]
pub struct Labels {
    within: Rect,
    curves: Vec<Pos2>,
    taken: Vec<Rect>,
}

impl Labels {
    /// All of `within` is free.
    pub fn new(within: Rect) -> Self {
        Self { within, curves: Vec::new(), taken: Vec::new() }
    }

    /// Words keep off this line.
    pub fn avoid(&mut self, line: &[Pos2]) {
        for pair in line.windows(2) {
            let way = pair[1] - pair[0];
            // What is far outside is not felt, so few steps are enough.
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let steps = (way.length() / FELT).ceil().clamp(1.0, 400.0) as u16;
            let felt = (0..steps).map(|step| pair[0] + way * (f32::from(step) / f32::from(steps)));
            self.curves.extend(felt.filter(|at| self.within.contains(*at)));
        }
        self.curves.extend(line.last().filter(|at| self.within.contains(**at)));
    }

    /// No word comes here.
    pub fn take(&mut self, rect: Rect) {
        self.taken.push(rect);
    }

    /// The best place for a word of this size, by the middles it may have, the earlier the better; `None` where each lies on
    /// another word.
    pub fn place(&mut self, size: Vec2, middles: &[Pos2]) -> Option<Rect> {
        let room = Rect::from_min_max(self.within.min + 0.5 * size, self.within.max - 0.5 * size);
        if room.is_negative() {
            return None;
        }
        let rects = middles.iter().map(|&middle| Rect::from_center_size(room.clamp(middle), size));
        let free = rects.filter(|rect| !self.taken.iter().any(|taken| taken.intersects(*rect)));
        let covered = |rect: &Rect| self.curves.iter().filter(|at| rect.contains(**at)).count();
        let best = free.min_by_key(covered)?;
        self.taken.push(best);
        Some(best)
    }
}

/// The middles of a word of this size that stands beside a point: above, below, right, left, and between these.
pub fn beside(at: Pos2, size: Vec2) -> [Pos2; 8] {
    let away = 0.5 * size + Vec2::splat(GAP);
    [(0.0, -1.0), (0.0, 1.0), (1.0, 0.0), (-1.0, 0.0), (1.0, -1.0), (-1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| at + Vec2::new(x * away.x, y * away.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_keep_off_curves_and_off_each_other() {
        let within = Rect::from_min_max(Pos2::ZERO, Pos2::new(200.0, 100.0));
        let mut labels = Labels::new(within);
        labels.avoid(&[Pos2::new(0.0, 40.0), Pos2::new(200.0, 40.0)]);
        let size = Vec2::new(60.0, 16.0);
        let on_the_line = [Pos2::new(100.0, 40.0), Pos2::new(100.0, 60.0)];
        let first = labels.place(size, &on_the_line).expect("room");
        assert_eq!(first.center(), Pos2::new(100.0, 60.0));
        let second = labels.place(size, &[Pos2::new(110.0, 62.0), Pos2::new(100.0, 80.0)]).expect("room");
        assert!(!second.intersects(first));
        assert_eq!(labels.place(size, &[Pos2::new(100.0, 60.0)]), None, "nothing overlaps");
        // Nothing leaves the room.
        let corner = labels.place(size, &[Pos2::new(-50.0, -50.0)]).expect("room");
        assert!(within.contains_rect(corner));
        assert!(labels.place(Vec2::new(300.0, 10.0), &[Pos2::ZERO]).is_none());
    }

    #[test]
    fn beside_a_point_is_not_on_it() {
        let (at, size) = (Pos2::new(50.0, 50.0), Vec2::new(30.0, 10.0));
        for middle in beside(at, size) {
            assert!(!Rect::from_center_size(middle, size).contains(at), "{middle}");
        }
    }
}
