//! Checks of this very program against numbers that it did not compute: closed forms and independent programs.
//!
//! Most of the numbers are those of docs/theory.md section 10; the tests of the project compare many more. Here is a
//! selection that any device computes within a second or two, one check after the other, so that people can see it done
//! where they are.

mod comparison;
mod hanging;
mod robots;
mod strings;

pub use comparison::{Comparison, NoComparison};

/// Something that this program computes, and what it should come to.
#[derive(Debug)]
pub struct Check {
    /// What is computed.
    pub name: &'static str,
    /// Where the expected value is from.
    pub source: &'static str,
    /// The unit of the expected and the computed value; empty for plain numbers.
    pub unit: &'static str,
    /// Computes it, within some tens of milliseconds.
    pub run: fn() -> Result<Comparison, NoComparison>,
}

const CLOSED_FORM: &str = "closed form";
const THEORY: &str = "exact by theory";
const INDEPENDENT: &str = "independent program";

/// All checks, in the order of docs/theory.md section 10.
pub static CHECKS: &[Check] = &[
    Check { name: "Taut string: first frequency", source: CLOSED_FORM, unit: "Hz", run: strings::at_rest },
    Check { name: "Travelling string: first frequency", source: CLOSED_FORM, unit: "Hz", run: strings::travelling },
    Check {
        name: "Travelling string: critical speed is the wave speed",
        source: THEORY,
        unit: "m/s",
        run: strings::critical_speed,
    },
    Check {
        name: "String reeled in to its half: displacement",
        source: "exact solution (moving boundary, Balazs)",
        unit: "m",
        run: || Ok(strings::reeled_in()),
    },
    Check {
        name: "String reeled in slowly: growth rate at one instant, −(dL/dt)/2L",
        source: "exact to first order",
        unit: "1/s",
        run: strings::frozen_growth,
    },
    Check {
        name: "Elastic catenary of 11.00 m, nearly straight: length",
        source: "closed form (Irvine)",
        unit: "m",
        run: || hanging::length(&hanging::NEARLY_STRAIGHT),
    },
    Check {
        name: "Elastic catenary of 11.18 m: tension at the upper end",
        source: "closed form (Irvine)",
        unit: "N",
        run: || hanging::upper_tension(&hanging::SAGGING),
    },
    Check {
        name: "Elastic catenary of 11.50 m, below its lower end: length",
        source: "closed form (Irvine)",
        unit: "m",
        run: || hanging::length(&hanging::DEEP),
    },
    Check {
        name: "Elastic catenary: order of the mesh's error",
        source: "theory of linear elements",
        unit: "",
        run: hanging::order,
    },
    Check {
        name: "Hanging cable of 11.00 m: first frequency",
        source: "two independent programs",
        unit: "Hz",
        run: || hanging::first_frequency(&hanging::NEARLY_STRAIGHT),
    },
    Check {
        name: "Hanging cable of 11.18 m: first frequency",
        source: "two independent programs",
        unit: "Hz",
        run: || hanging::first_frequency(&hanging::SAGGING),
    },
    Check {
        name: "Shallow cable, λ² = 10: first Ω/π",
        source: "closed form (Irvine and Caughey)",
        unit: "",
        run: hanging::shallow,
    },
    Check {
        name: "Forces on the platform: their vertical sum",
        source: "the platform's weight, m g",
        unit: "N",
        run: robots::balance,
    },
    Check {
        name: "Straight cable without weight: dL/dσ",
        source: CLOSED_FORM,
        unit: "",
        run: || robots::straight(robots::Rate::First),
    },
    Check {
        name: "Straight cable without weight: d²L/dσ²",
        source: CLOSED_FORM,
        unit: "1/m",
        run: || robots::straight(robots::Rate::Second),
    },
    Check { name: "Paper's robot at x = 6 m: length of cable 1", source: INDEPENDENT, unit: "m", run: robots::length },
    Check {
        name: "Paper's robot at x = 6 m: dL/dσ of cable 1",
        source: INDEPENDENT,
        unit: "",
        run: || robots::rate(robots::Rate::First),
    },
    Check {
        name: "Paper's robot at x = 6 m: d²L/dσ² of cable 1",
        source: INDEPENDENT,
        unit: "1/m",
        run: || robots::rate(robots::Rate::Second),
    },
    Check {
        name: "Paper's robot at rest, mass damping alone: growth rate −α/2",
        source: THEORY,
        unit: "1/s",
        run: robots::at_rest,
    },
    Check {
        name: "Paper's robot at x = 7 m and 5 m/s: growth rate",
        source: INDEPENDENT,
        unit: "1/s",
        run: robots::growth,
    },
    Check {
        name: "Paper's robot at x = 0: critical speed",
        source: INDEPENDENT,
        unit: "m/s",
        run: || robots::critical_speed(&robots::ORIGIN),
    },
    Check {
        name: "Paper's robot at x = 0: its frequency",
        source: INDEPENDENT,
        unit: "Hz",
        run: || robots::critical_frequency(&robots::ORIGIN),
    },
    Check {
        name: "Paper's robot at x = 6 m: critical speed",
        source: INDEPENDENT,
        unit: "m/s",
        run: || robots::critical_speed(&robots::OUTSIDE),
    },
    Check {
        name: "Paper's robot at x = 0, tangent stiffness: critical speed",
        source: INDEPENDENT,
        unit: "m/s",
        run: || robots::critical_speed(&robots::TANGENT),
    },
    Check {
        name: "Paper's robot at x = −2 m moving left: critical speed",
        source: "that at x = 2 m moving right: its mirror image",
        unit: "m/s",
        run: robots::mirrored,
    },
    Check {
        name: "Paper's robot: border of the workspace at y = 0",
        source: INDEPENDENT,
        unit: "m",
        run: robots::border,
    },
    Check {
        name: "Paper's robot at x = 0: critical speed for ever finer meshes",
        source: "independent program with 20, 40 and 80 elements",
        unit: "m/s",
        run: robots::fine_mesh,
    },
    Check {
        name: "Straight cable reeled in along its own line: critical speed for ever finer meshes",
        source: "closed form, sqrt(N λ/μ) of the platform's speed",
        unit: "m/s",
        run: robots::along_its_line,
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_checks_pass_and_would_not_with_another_expected_value() {
        for check in CHECKS {
            let comparison = (check.run)().unwrap_or_else(|failed| panic!("{}: {failed}", check.name));

            assert!(comparison.passes(), "{}: {comparison:?}, off by {:e}", check.name, comparison.error());
            // What is right to a percent only would say little.
            assert!(comparison.tolerance <= 0.01 * comparison.expected.abs(), "{}: {comparison:?}", check.name);
            assert!(comparison.tolerance > 0.0, "{}: rounding is not zero everywhere", check.name);
            for sign in [1.0, -1.0] {
                let wrong =
                    Comparison { expected: comparison.expected + sign * 2.01 * comparison.tolerance, ..comparison };
                assert!(!wrong.passes(), "{}: {wrong:?}", check.name);
            }
        }
    }

    #[test]
    fn no_number_is_no_success() {
        let good = Comparison { expected: 1.0, got: 1.0, tolerance: 0.1 };
        assert!(good.passes() && Comparison { got: 1.1, tolerance: 0.11, ..good }.passes());
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!Comparison { got: value, ..good }.passes());
            assert!(!Comparison { expected: value, ..good }.passes());
            assert!(!Comparison { tolerance: value, ..good }.passes());
            assert!(!Comparison { expected: value, got: value, tolerance: value }.passes());
        }
        assert!(!Comparison { got: 1.2, ..good }.passes());
        assert!(!Comparison { tolerance: -0.1, ..good }.passes());
    }

    #[test]
    fn names_are_different_and_everything_is_said() {
        for (i, check) in CHECKS.iter().enumerate() {
            assert!(!check.name.is_empty() && !check.source.is_empty());
            assert!(CHECKS[..i].iter().all(|other| other.name != check.name), "{}", check.name);
        }
    }
}
