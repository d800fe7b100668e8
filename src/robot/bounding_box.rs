//! The box that the winches span.

use super::Vec2;

/// Of the larger side, what the other one is widened to where all points are in a line.
const LEAST_SIDE: f64 = 0.2;

/// A rectangle along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    /// The lower left corner, in m.
    pub low: Vec2,
    /// The upper right corner, in m.
    pub high: Vec2,
}

impl BoundingBox {
    /// The smallest box that holds all `points`; `None` where there is no point.
    pub fn of(points: impl IntoIterator<Item = Vec2>) -> Option<Self> {
        let mut points = points.into_iter();
        let first = points.next()?;
        let grown = |around: Self, point| Self { low: around.low.inf(&point), high: around.high.sup(&point) };
        Some(points.fold(Self { low: first, high: first }, grown))
    }

    /// The same box, but where it has no width or no height: there it gets a fifth of the other side, half of it on
    /// either side.
    #[must_use]
    pub fn with_area(mut self) -> Self {
        let least = LEAST_SIDE * self.size().amax();
        for i in 0..2 {
            if self.high[i] <= self.low[i] {
                self.low[i] -= 0.5 * least;
                self.high[i] += 0.5 * least;
            }
        }
        self
    }

    /// Width and height, in m.
    pub fn size(&self) -> Vec2 {
        self.high - self.low
    }

    /// The point in the middle, in m.
    pub fn middle(&self) -> Vec2 {
        0.5 * (self.low + self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_holds_its_points_and_has_an_area_even_where_they_are_in_a_line() {
        let points = [[1.0, -2.0], [4.0, 3.0], [2.0, 5.0]].map(Vec2::from);
        let around = BoundingBox::of(points).expect("points");
        assert_eq!((around.low, around.high), (Vec2::new(1.0, -2.0), Vec2::new(4.0, 5.0)));
        assert_eq!(around.with_area(), around);
        let flat = BoundingBox::of(points.map(|point| Vec2::new(point.x, 2.0))).expect("points").with_area();
        assert_eq!((flat.low.x, flat.high.x, flat.middle().y), (1.0, 4.0, 2.0));
        assert!((flat.size().y - 0.6).abs() < 1e-15);
        assert_eq!(BoundingBox::of([]), None);
    }
}
