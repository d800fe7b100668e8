//! A scenario with other values of some of its numbers, as robots.

use crate::robot::{Motion, Robot};
use crate::scenario::{Parameter, Scenario};
use crate::study::Varied;

/// A scenario and the numbers that are varied.
#[derive(Debug)]
pub struct Variants {
    scenario: Scenario,
    numbers: Vec<Parameter>,
}

impl Variants {
    /// Those of `scenario` in `numbers`.
    ///
    /// # Errors
    /// A path where the scenario has no number, or one that is there twice.
    pub fn new(scenario: Scenario, numbers: &[Varied]) -> Result<Self, String> {
        let mut parameters = Vec::new();
        for Varied { path, .. } in numbers {
            let all = Parameter::all(&scenario).into_iter().chain([Parameter::Direction]);
            let Some(parameter) = all.into_iter().find(|parameter| parameter.path() == *path) else {
                return Err(format!("{path}: the scenario has no such number"));
            };
            if parameters.contains(&parameter) {
                return Err(format!("{path}: varied twice; allowed: two different numbers"));
            }
            parameters.push(parameter);
        }
        Ok(Self { scenario, numbers: parameters })
    }

    /// The robot and its motion with these values in SI units; `None` where that is not physical.
    pub fn at(&self, values: &[f64]) -> Option<(Robot, Motion)> {
        let mut scenario = self.scenario.clone();
        for (parameter, value) in self.numbers.iter().zip(values) {
            parameter.set(&mut scenario, *value);
        }
        scenario.to_robot().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::presets;

    #[test]
    fn values_are_put_in_by_path_and_paths_are_checked() {
        let varied = |path: &str| Varied { path: path.into(), values: Vec::new() };
        let variants = |paths: &[&str]| {
            let numbers: Vec<Varied> = paths.iter().map(|path| varied(path)).collect();
            Variants::new(presets::PRESETS[0].scenario(), &numbers)
        };
        let two = variants(&["cable.youngs_modulus", "motion.direction"]).expect("two numbers");
        let (robot, motion) = two.at(&[3e8, 0.0]).expect("physical");
        assert!((robot.material.youngs_modulus - 3e8).abs() < 1e-3 && (motion.direction().x - 1.0).abs() < 1e-15);
        assert!(two.at(&[-1.0, 0.0]).is_none(), "a negative modulus");
        assert!(variants(&["cable.colour"]).is_err_and(|reason| reason.starts_with("cable.colour: ")));
        assert!(variants(&["gravity", "gravity"]).is_err_and(|reason| reason.contains("twice")));
    }
}
