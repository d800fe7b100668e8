//! Hints at numbers that may not be meant: another unit, a cable that would break. A hint refuses nothing.

use crate::mechanics::Material as Law;
use crate::scenario::ropes::Rope;
use crate::scenario::{Parameter, Report, Scenario};

/// Something about a scenario that is unusual.
#[derive(Clone, Debug, PartialEq)]
pub struct Hint {
    /// What is unusual, in a few words with its numbers.
    pub what: String,
    /// Why that matters, and what is usual.
    pub why: &'static str,
    /// The number to look at.
    pub parameter: Parameter,
}

/// Below this Young's modulus (Pa) another unit may be meant: soft rubber has 1e6.
const SOFTEST: f64 = 1e6;
/// Above this Young's modulus (Pa) another unit may be meant: the stiffest fibres have 0.9e12.
const STIFFEST: f64 = 1e12;
/// Above this cross-section (m²) another unit may be meant: it is that of a rope of more than a third of a metre.
const THICKEST: f64 = 0.1;
/// Above this mass per length (kg/m) another unit may be meant: it is that of a steel rope of 120 mm.
const HEAVIEST: f64 = 50.0;
/// Above this strain a cable counts as stretched much.
const STRAIN: f64 = 0.02;
/// Waves that run slower than this many times the present speed are near it.
const WAVES: f64 = 2.0;

/// What is unusual about a scenario, and about its tensions where its analysis is known. Each hint comes once: of several
/// cables the worst is named.
///
/// - E < 1e6 Pa or > 1e12 Pa, A > 0.1 m², μ > 50 kg/m, of all cables or of one with its own
/// - the mass μ L of a cable is more than the platform's
/// - the strain λ − 1 at the largest tension of a cable is more than 2 %, with N(λ) of docs/theory.md, section 4
/// - the largest tension is more than a rope of that cross-section bears: the rope's own breaking force where E, A and μ
///   are a [`Rope`]'s, else a typical strength for this E
/// - waves √(T/μ), T the least tension of a cable, run less than twice as fast as the platform moves
///
/// Sources of what is usual: docs/ropes.md.
pub fn hints(scenario: &Scenario, report: Option<&Report>) -> Vec<Hint> {
    let mut hints = units(scenario);
    if let Some(report) = report {
        let cables: Vec<Loaded> = Loaded::all(scenario, report);
        let in_doubt = |parameter| hints.iter().any(|hint: &Hint| hint.parameter == parameter);
        // Where a unit is in doubt, what follows from the number says nothing new.
        let found: Vec<Hint> = [
            heavy(scenario, &cables),
            stretched(scenario, &cables),
            overloaded(scenario, &cables),
            slow_waves(scenario, &cables),
        ]
        .into_iter()
        .flatten()
        .filter(|hint| !in_doubt(hint.parameter))
        .collect();
        hints.extend(found);
    }
    hints
}

/// A cable under load.
struct Loaded {
    /// Its place, 0-based.
    cable: usize,
    /// Its largest and its least tension in N.
    most: f64,
    least: f64,
    /// Its mass in kg.
    mass: f64,
}

impl Loaded {
    fn all(scenario: &Scenario, report: &Report) -> Vec<Self> {
        let cables = report.cables.iter().take(scenario.cables.len()).enumerate();
        cables
            .map(|(cable, found)| {
                let (a, b) = (found.tension_at_platform, found.tension_at_winch);
                let mass = scenario.material_of(cable).mass_per_length * found.unstretched_length;
                Self { cable, most: a.max(b), least: a.min(b), mass }
            })
            .collect()
    }
}

/// The cable for which `size` is largest, with that.
fn worst(cables: &[Loaded], size: impl Fn(&Loaded) -> Option<f64>) -> Option<(&Loaded, f64)> {
    let sizes = cables.iter().filter_map(|cable| Some((cable, size(cable)?)));
    sizes.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Numbers of the material that look like another unit.
fn units(scenario: &Scenario) -> Vec<Hint> {
    let [modulus, area, mass] = [Parameter::YoungsModulus, Parameter::Area, Parameter::MassPerLength];
    let mut hints = Vec::new();
    for common in [modulus, area, mass] {
        let own = (0..scenario.cables.len()).filter_map(|cable| common.own(cable));
        let own: Vec<Parameter> = own.filter(|own| own.is_in(scenario)).collect();
        // The common value does not matter where every cable has its own.
        let common_counts = own.len() < scenario.cables.len();
        let all = common_counts.then_some(common).into_iter().chain(own);
        hints.extend(all.filter_map(|parameter| unit(common, parameter, parameter.get(scenario))));
    }
    hints
}

fn unit(kind: Parameter, parameter: Parameter, value: f64) -> Option<Hint> {
    let (what, why) = match kind {
        Parameter::YoungsModulus if value < SOFTEST => (
            format!("E is {} Pa: MPa meant?", short(value)),
            "Even soft rubber has 1 MPa, fibre ropes have 1 to 60 GPa, steel ropes 50 to 140 GPa.",
        ),
        Parameter::YoungsModulus if value > STIFFEST => (
            format!("E is {} GPa: MPa meant?", short(value / 1e9)),
            "Steel has 210 GPa, which is 210 000 MPa; ropes of it have 50 to 140 GPa.",
        ),
        Parameter::Area if value > THICKEST => (
            format!("A is {} m²: mm² meant?", short(value)),
            "That is a rope of more than 35 cm. A steel rope of 6 mm has 0.13 cm², which is 13 mm².",
        ),
        Parameter::MassPerLength if value > HEAVIEST => (
            format!("μ is {} kg/m: g/m meant?", short(value)),
            "A steel rope of 6 mm has 0.125 kg/m, one of 100 mm has 35 kg/m.",
        ),
        _ => return None,
    };
    Some(Hint { what: format!("{what}{}", of_cable(parameter)), why, parameter })
}

/// Which cable's own value it is, where it is one's own.
fn of_cable(parameter: Parameter) -> String {
    match parameter {
        Parameter::OwnYoungsModulus(cable) | Parameter::OwnArea(cable) | Parameter::OwnMassPerLength(cable) => {
            format!(" (cable {})", cable + 1)
        }
        _ => String::new(),
    }
}

/// A cable's own number where it has one, else the common one.
fn effective(scenario: &Scenario, parameter: Parameter, cable: usize) -> Parameter {
    parameter.own(cable).filter(|own| own.is_in(scenario)).unwrap_or(parameter)
}

fn heavy(scenario: &Scenario, cables: &[Loaded]) -> Option<Hint> {
    let (cable, mass) = worst(cables, |cable| Some(cable.mass))?;
    (mass > scenario.platform.mass).then(|| Hint {
        what: format!(
            "Cable {} is heavier than the platform: {} kg, {} kg",
            cable.cable + 1,
            short(mass),
            short(scenario.platform.mass)
        ),
        why: "Most robots carry a platform that is several times as heavy as a cable. Heavy cables sag and vibrate slowly.",
        parameter: effective(scenario, Parameter::MassPerLength, cable.cable),
    })
}

fn stretched(scenario: &Scenario, cables: &[Loaded]) -> Option<Hint> {
    let (cable, strain) = worst(cables, |cable| {
        let material = scenario.material_of(cable.cable);
        let law = Law::new(material.youngs_modulus * material.area, material.strain)?;
        Some(law.stretch(cable.most.max(0.0)) - 1.0)
    })?;
    (strain > STRAIN).then(|| Hint {
        what: format!("Cable {} is stretched by {} %", cable.cable + 1, short(100.0 * strain)),
        why: "Steel ropes stretch by less than 1 % in use, fibre ropes by a few percent, rubber by more. Beyond 2 % the two \
              strain laws differ, and ropes may follow neither.",
        parameter: effective(scenario, Parameter::YoungsModulus, cable.cable),
    })
}

/// The tensile strength in Pa that is typical for a rope's load-bearing area at Young's modulus `modulus` (Pa), with words that
/// say what is assumed. High values, so that a hint is not a false alarm.
fn strength(modulus: f64) -> (f64, &'static str) {
    match modulus {
        50e9.. => (2e9, "at 2 GPa, as of the best steel wires, it bears"),
        10e9.. => (1.6e9, "at 1.6 GPa, as of Dyneema and aramid ropes, it bears"),
        0.2e9.. => (0.5e9, "at 500 MPa, as of good polyester and nylon ropes, it bears"),
        _ => (30e6, "at 30 MPa, as of strong rubber, it bears"),
    }
}

fn overloaded(scenario: &Scenario, cables: &[Loaded]) -> Option<Hint> {
    let breaking = |cable: usize| {
        let material = scenario.material_of(cable);
        let assumed = strength(material.youngs_modulus);
        let of_class = (assumed.0 * material.area, assumed.1);
        Rope::of(&material).map_or(of_class, |rope| (rope.breaking_force(), "such a rope bears"))
    };
    let (cable, ratio) = worst(cables, |cable| Some(cable.most / breaking(cable.cable).0))?;
    let (force, of) = breaking(cable.cable);
    (ratio > 1.0).then(|| Hint {
        what: format!(
            "Cable {} would break: it has {} N, and {of} {} N",
            cable.cable + 1,
            short(cable.most),
            short(force)
        ),
        why: "Where E, A and μ are no rope's in the list, the strength is assumed from E. In use a rope bears a fifth of its \
              breaking force or less.",
        parameter: effective(scenario, Parameter::Area, cable.cable),
    })
}

fn slow_waves(scenario: &Scenario, cables: &[Loaded]) -> Option<Hint> {
    let slowness = |cable: &Loaded| {
        let mass = scenario.material_of(cable.cable).mass_per_length;
        (cable.least > 0.0).then(|| (mass / cable.least).sqrt())
    };
    let (cable, slowness) = worst(cables, slowness)?;
    let speed = scenario.motion.speed;
    (speed * slowness * WAVES > 1.0).then(|| Hint {
        what: format!(
            "Waves run along cable {} at {} m/s, the platform at {} m/s",
            cable.cable + 1,
            short(1.0 / slowness),
            short(speed)
        ),
        why: "Robots usually move at less than half the speed of the waves √(T/μ) in their cables. A cable that is reeled in \
              as fast as waves run along it cannot hold its shape.",
        parameter: Parameter::Speed,
    })
}

/// A number to three digits.
fn short(value: f64) -> String {
    if !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    // To three significant digits, and then as short as it is.
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    rounded.to_string()
}

#[cfg(test)]
mod tests {
    use std::sync::OnceLock;

    use super::*;
    use crate::robot::Strain;
    use crate::scenario::presets;

    fn paper() -> Scenario {
        presets::PRESETS[0].scenario()
    }

    /// The report of a scenario in which every cable has this tension and this length; the rest is left alone.
    fn report(scenario: &Scenario, tension: f64, length: f64) -> Report {
        static PAPER: OnceLock<Report> = OnceLock::new();
        let mut report = PAPER.get_or_init(|| analysis(&paper())).clone();
        report.cables.truncate(scenario.cables.len());
        for cable in &mut report.cables {
            cable.tension_at_platform = tension;
            cable.tension_at_winch = tension;
            cable.unstretched_length = length;
        }
        report
    }

    fn analysis(scenario: &Scenario) -> Report {
        let (robot, motion) = scenario.to_robot().expect("physical");
        Report::analyze(&robot, &motion, 1.0)
    }

    fn parameters(hints: &[Hint]) -> Vec<Parameter> {
        hints.iter().map(|hint| hint.parameter).collect()
    }

    /// Just within is silent, just beyond is said.
    #[test]
    fn numbers_that_look_like_another_unit() {
        let cases = [
            (Parameter::YoungsModulus, 1e6, 0.99e6, "990000 Pa: MPa meant?"),
            (Parameter::YoungsModulus, 1e12, 1.01e12, "1010 GPa: MPa meant?"),
            (Parameter::Area, 0.1, 0.101, "0.101 m²: mm² meant?"),
            (Parameter::MassPerLength, 50.0, 50.1, "50.1 kg/m: g/m meant?"),
        ];
        for (parameter, within, beyond, said) in cases {
            for place in [parameter, parameter.own(2).expect("an own one")] {
                let mut scenario = paper();
                place.give(&mut scenario, within);
                assert_eq!(hints(&scenario, None), [], "{place:?}");
                place.give(&mut scenario, beyond);
                let found = hints(&scenario, None);
                assert_eq!(parameters(&found), [place]);
                assert!(found[0].what.contains(said), "{found:?}");
                assert_eq!(found[0].what.contains("(cable 3)"), place != parameter, "{found:?}");
            }
        }
        // The common number does not count where every cable has its own.
        let mut scenario = paper();
        scenario.cable.area = 50.0;
        assert_eq!(hints(&scenario, None).len(), 1);
        scenario.cables.iter_mut().for_each(|cable| cable.cable.area = Some(5e-5));
        assert_eq!(hints(&scenario, None), []);
    }

    #[test]
    fn the_mistakes_of_the_text_books_are_said_plainly() {
        let mut scenario = paper();
        scenario.cable.youngs_modulus = 125.0;
        assert_eq!(hints(&scenario, None)[0].what, "E is 125 Pa: MPa meant?");
        scenario.cable.youngs_modulus = 210_000e9;
        assert_eq!(hints(&scenario, None)[0].what, "E is 210000 GPa: MPa meant?");
    }

    #[test]
    fn a_cable_heavier_than_the_platform() {
        let mut scenario = paper();
        scenario.platform.mass = 5.0; // and 0.4 kg/m
        assert_eq!(hints(&scenario, Some(&report(&scenario, 70.0, 12.4))), []);
        let found = hints(&scenario, Some(&report(&scenario, 70.0, 12.6)));
        assert_eq!(parameters(&found), [Parameter::MassPerLength]);
        assert!(found[0].what.ends_with("heavier than the platform: 5.04 kg, 5 kg"), "{found:?}");
        scenario.cables[1].cable.mass_per_length = Some(0.41);
        let found = hints(&scenario, Some(&report(&scenario, 70.0, 12.4)));
        assert_eq!(parameters(&found), [Parameter::OwnMassPerLength(1)]);
    }

    /// N = EA (λ − 1), and ½ EA (λ³ − λ), at λ = 1.02 with EA = 6250 N.
    #[test]
    fn a_cable_stretched_by_more_than_two_percent() {
        let mut scenario = paper();
        scenario.platform.mass = 100.0;
        let edges = [(Strain::Engineering, 6250.0 * 0.02), (Strain::Green, 0.5 * 6250.0 * (1.061_208 - 1.02))];
        for (strain, edge) in edges {
            scenario.cable.strain = strain;
            assert_eq!(hints(&scenario, Some(&report(&scenario, 0.999 * edge, 11.0))), [], "{strain:?}");
            let found = hints(&scenario, Some(&report(&scenario, 1.001 * edge, 11.0)));
            assert_eq!(parameters(&found), [Parameter::YoungsModulus], "{strain:?}");
            assert!(found[0].what.ends_with("is stretched by 2 %"), "{found:?}");
        }
    }

    #[test]
    fn a_cable_that_would_break() {
        let mut scenario = paper();
        scenario.platform.mass = 100.0;
        // E, and what a square centimetre bears at it.
        let classes = [(125e6, 3e3), (1e9, 50e3), (40e9, 160e3), (100e9, 200e3)];
        for (modulus, edge) in classes {
            scenario.cable.youngs_modulus = modulus;
            scenario.cable.area = 1e-4;
            let said = |tension: f64| {
                let found = hints(&scenario, Some(&report(&scenario, tension, 11.0)));
                found.into_iter().find(|hint| hint.parameter == Parameter::Area)
            };
            assert_eq!(said(0.999 * edge), None);
            assert!(said(1.001 * edge).is_some_and(|hint| hint.what.contains("would break")), "{modulus}");
        }
        // A rope of the list is known by its own breaking force: steel 6×19 of 6 mm bears 19.6 kN.
        let rope = Rope { construction: crate::scenario::ropes::Construction::Steel6x19, diameter: 6e-3 };
        scenario.cable.youngs_modulus = rope.youngs_modulus();
        scenario.cable.area = rope.area();
        scenario.cable.mass_per_length = rope.mass_per_length();
        let breaks = |tension: f64| {
            let found = hints(&scenario, Some(&report(&scenario, tension, 11.0)));
            found.iter().any(|hint| hint.what.contains("would break"))
        };
        assert!(!breaks(19.5e3) && breaks(19.6e3));
    }

    /// 64 N and 0.4 kg/m: 12.65 m/s.
    #[test]
    fn waves_near_the_present_speed() {
        let mut scenario = paper();
        scenario.platform.mass = 100.0;
        scenario.motion.speed = 6.32;
        assert_eq!(hints(&scenario, Some(&report(&scenario, 64.0, 11.0))), []);
        scenario.motion.speed = 6.33;
        let found = hints(&scenario, Some(&report(&scenario, 64.0, 11.0)));
        assert_eq!(parameters(&found), [Parameter::Speed]);
        assert!(found[0].what.contains("at 12.6 m/s, the platform at 6.33 m/s"), "{found:?}");
    }

    /// No built-in robot looks like a mistake of units or like one that breaks. What else is said of them is true.
    #[test]
    fn the_built_in_robots_raise_no_false_alarm() {
        for preset in presets::PRESETS {
            let scenario = preset.scenario();
            let found = hints(&scenario, Some(&analysis(&scenario)));
            println!("{}: {found:#?}", preset.name);
            assert_eq!(units(&scenario), [], "{}", preset.name);
            assert!(!found.iter().any(|hint| hint.what.contains("would break")), "{}: {found:?}", preset.name);
        }
    }
}
