//! Where the platform goes: a path as a curve in the plane, by its arc length.

use super::spline::{Ends, Spline};
use crate::robot::Vec2;

/// A point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// p in m.
    pub position: Vec2,
    /// p' = dp/ds, the unit tangent.
    pub tangent: Vec2,
    /// p'' = d²p/ds² in 1/m, perpendicular to the tangent.
    pub curvature: Vec2,
}

/// What stands at both sides of a corner or of a break: which of the two is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// What has been.
    Left,
    /// What comes.
    #[default]
    Right,
}

/// A smooth part of a path, by its own arc length from 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Leg {
    /// A straight line.
    Straight {
        /// Where it begins, in m.
        start: Vec2,
        /// Its unit vector.
        tangent: Vec2,
        /// In m.
        length: f64,
    },
    /// A cubic spline.
    Smooth(Spline),
}

impl Leg {
    /// The straight line between two points; `None` where they coincide.
    pub fn straight(from: Vec2, to: Vec2) -> Option<Self> {
        let tangent = (to - from).try_normalize(0.0)?;
        Some(Self::Straight { start: from, tangent, length: (to - from).norm() })
    }

    /// The cubic spline through the points, natural at its ends, by the lengths of the chords between them; `None` where two
    /// successive ones coincide, or where it turns back at a point.
    pub fn smooth(points: &[Vec2]) -> Option<Self> {
        if let [from, to] = points {
            return Self::straight(*from, *to);
        }
        let mut knots = vec![0.0];
        for pair in points.windows(2) {
            knots.push(knots.last().copied().unwrap_or_default() + (pair[1] - pair[0]).norm());
        }
        Spline::new(knots, points.to_vec(), Ends::Natural).filter(Spline::is_smooth).map(Self::Smooth)
    }

    /// In m.
    pub fn length(&self) -> f64 {
        match self {
            Self::Straight { length, .. } => *length,
            Self::Smooth(spline) => spline.length(),
        }
    }

    /// The point at arc length `s` (m).
    pub fn at(&self, s: f64) -> PathPoint {
        match self {
            Self::Straight { start, tangent, .. } => {
                PathPoint { position: start + tangent * s, tangent: *tangent, curvature: Vec2::zeros() }
            }
            Self::Smooth(spline) => {
                let [position, first, second] = spline.at(spline.parameter(s));
                let speed = first.norm();
                let tangent = first / speed;
                let curvature = (second - tangent * tangent.dot(&second)) / (speed * speed);
                PathPoint { position, tangent, curvature }
            }
        }
    }
}
