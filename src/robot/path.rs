//! Where the platform goes: a path as a curve in the plane, by its arc length.

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
}

impl Leg {
    /// The straight line between two points; `None` where they coincide.
    pub fn straight(from: Vec2, to: Vec2) -> Option<Self> {
        let tangent = (to - from).try_normalize(0.0)?;
        Some(Self::Straight { start: from, tangent, length: (to - from).norm() })
    }

    /// In m.
    pub fn length(&self) -> f64 {
        match self {
            Self::Straight { length, .. } => *length,
        }
    }

    /// The point at arc length `s` (m).
    pub fn at(&self, s: f64) -> PathPoint {
        match *self {
            Self::Straight { start, tangent, .. } => {
                PathPoint { position: start + tangent * s, tangent, curvature: Vec2::zeros() }
            }
        }
    }
}
