//! The critical speed with other values of one number of a robot, or of two.

use crate::robot::{Motion, Robot, Vec2};
use crate::study::Verdict;
use crate::study::verdict::verdict_in_steps;

/// A number that takes several values.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Varied {
    /// Its path in the scenario. This room does not know what is there; a [`Variant`] does.
    pub path: String,
    /// The values in SI units, finite.
    pub values: Vec<f64>,
}

/// Builds the robot and its motion with these values of the varied numbers; `None` where that is not physical.
pub type Variant<'a> = dyn Fn(&[f64]) -> Option<(Robot, Motion)> + Send + Sync + 'a;

/// The critical speed at one pose and in one direction for every value of a number, or for all pairs of values of two. The
/// motion may be among the varied numbers.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct WhatIf {
    /// One number or two.
    pub numbers: Vec<Varied>,
    /// Searched up to this speed in m/s, finite and greater than 0.
    pub limit: f64,
}

impl WhatIf {
    /// How many places there are: one for each combination of values.
    pub fn len(&self) -> usize {
        self.numbers.iter().fold(1, |places: usize, number| places.saturating_mul(number.values.len()))
    }

    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The values at a place, one for each number. From place to place the first number changes first.
    pub fn values(&self, mut place: usize) -> Vec<f64> {
        let value = |number: &Varied| {
            let count = number.values.len().max(1);
            let value = number.values.get(place % count).copied();
            place /= count;
            value
        };
        self.numbers.iter().filter_map(value).collect()
    }

    /// What is known at one place, in [steps](crate::stability::steps): the motion's direction, the verdict, and the wave
    /// limit in m/s where there is one. Of values that are not physical nothing is known.
    pub async fn verdict_in_steps(&self, variant: &Variant<'_>, place: usize) -> (Vec2, Verdict, Option<f64>) {
        let Some((robot, motion)) = variant(&self.values(place)) else { return (Vec2::x(), Verdict::Unknown, None) };
        let (verdict, wave_limit) = verdict_in_steps(&robot, &motion, self.limit).await;
        (motion.direction(), verdict, wave_limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_number_changes_first() {
        let number = |path: &str, values: &[f64]| Varied { path: path.into(), values: values.to_vec() };
        let what_if = WhatIf { numbers: vec![number("a", &[1.0, 2.0, 3.0]), number("b", &[7.0, 8.0])], limit: 40.0 };
        let all: Vec<Vec<f64>> = (0..what_if.len()).map(|place| what_if.values(place)).collect();
        assert_eq!(all, [[1.0, 7.0], [2.0, 7.0], [3.0, 7.0], [1.0, 8.0], [2.0, 8.0], [3.0, 8.0]]);
        let none = WhatIf { numbers: vec![number("a", &[])], ..what_if };
        assert!(none.is_empty() && none.values(0).is_empty());
    }
}
