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
        // No critical speed depends on the path, which must not forbid a position, such as that of its end.
        let scenario = Scenario { path: None, ..scenario };
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
    use crate::scenario::{Path, presets};

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
        let path = Path::new(vec![[6.0, 0.0]], 5.0);
        let moving = Scenario { path: Some(path), ..presets::PRESETS[0].scenario() };
        let along = Variants::new(moving, &[varied("motion.position[0]")]).expect("a number");
        assert!(
            along.at(&[6.0]).is_some_and(|(_, motion)| (motion.position().x - 6.0).abs() < 1e-15),
            "the end of the path"
        );
        assert!(variants(&["cable.colour"]).is_err_and(|reason| reason.starts_with("cable.colour: ")));
        assert!(variants(&["gravity", "gravity"]).is_err_and(|reason| reason.contains("twice")));
    }
}
