//! The derivatives of the critical speed: against differences of whole searches, and against what units demand.

mod common;

use std::cell::Cell;

use common::close;
use common::random::{config, moving_robot};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use tautline::robot::{Damping, Linearisation, OwnMaterial, RobotSpec, Strain, TensionLaw, paper_spec};
use tautline::stability::{Critical, Instability, NoSensitivity, Outcome};
use tautline::study::{Knob, Sensitivity, sensitivities};
use tautline::{LocalProblem, Motion, Robot};

/// Only critical speeds above this one, in m/s, are compared.
const SLOWEST: f64 = 0.5;
/// The relative error of critical speeds and frequencies. A scan refines to 1e-9 m/s and gives the middle, so it is off by
/// half of that; the search by structure is off by far less. Frequencies change about as much as speeds, at most twice.
const SEARCHED: f64 = 2.0 * 0.5e-9 / SLOWEST;
/// The smallest step of the differences in ln p.
const STEP: f64 = 1e-3;
/// Critical speeds are searched up to this speed, in m/s.
const LIMIT: f64 = 40.0;

fn critical(robot: &Robot, motion: &Motion) -> Option<Critical> {
    match LocalProblem::new(robot, motion).ok()?.critical_speed(LIMIT).ok()? {
        Outcome::Found(critical) => Some(critical),
        Outcome::NoneUpTo(_) => None,
    }
}

/// The robot with a parameter times e^s.
fn turned(robot: &Robot, knob: Knob, s: f64) -> Robot {
    let mut spec = (**robot).clone();
    let factor = s.exp();
    match knob {
        Knob::YoungsModulus => spec.material.youngs_modulus *= factor,
        Knob::Area => spec.material.area *= factor,
        Knob::MassPerLength => spec.material.mass_per_length *= factor,
        Knob::OwnYoungsModulus(cable) => *spec.cables[cable].own.youngs_modulus.as_mut().expect("an own E") *= factor,
        Knob::OwnArea(cable) => *spec.cables[cable].own.area.as_mut().expect("an own A") *= factor,
        Knob::OwnMassPerLength(cable) => *spec.cables[cable].own.mass_per_length.as_mut().expect("an own μ") *= factor,
        Knob::PlatformMass => spec.platform_mass *= factor,
        Knob::Alpha => spec.damping.alpha *= factor,
        Knob::Beta => spec.damping.beta *= factor,
        Knob::Gravity => spec.gravity *= factor,
        Knob::Tension(cable) => match &mut spec.cables[cable].tension {
            TensionLaw::Equilibrium => panic!("cable {cable} has no tension of its own"),
            TensionLaw::Constant(tension) => *tension *= factor,
            TensionLaw::Hypot { horizontal, vertical } => {
                horizontal.iter_mut().chain(vertical).for_each(|coefficient| *coefficient *= factor);
            }
        },
    }
    Robot::new(spec).expect("a robot")
}

/// d ln v/d ln p and d ln ω/d ln p by Richardson's extrapolation of central differences over h and 2h, each with a bound of
/// its error. The error has two parts. One is the noise of the searches over h: the weights are 4/3 · 1/2h twice and
/// 1/3 · 1/4h twice. The other is the truncation, of order h⁴: a fifteenth of the difference to the extrapolation over 2h
/// and 4h. The whole difference bounds the truncation if half the step leaves no more than half of it, which holds even for
/// steps that are too large for the curve's bends. `None` if another mode crosses first somewhere.
fn differences(robot: &Robot, motion: &Motion, at: &Critical, knob: Knob) -> Option<[(f64, f64); 2]> {
    let mut logarithms = [[0.0; 2]; 6];
    for (k, step) in [-4.0, -2.0, -1.0, 1.0, 2.0, 4.0].into_iter().enumerate() {
        let beside = critical(&turned(robot, knob, step * STEP), motion)?;
        let frequency = beside.eigenvalue.im / at.eigenvalue.im;
        // A frequency that moves by a tenth in so small a step is that of another mode.
        if beside.kind != at.kind || (at.kind == Instability::Flutter && (frequency - 1.0).abs() > 0.1) {
            return None;
        }
        logarithms[k] =
            [(beside.speed / at.speed).ln(), if at.kind == Instability::Flutter { frequency.ln() } else { 0.0 }];
    }
    Some([0, 1].map(|i| {
        let values = logarithms.map(|pair| pair[i]);
        let [near, middle, far] = [(2, 3, 1.0), (1, 4, 2.0), (0, 5, 4.0)]
            .map(|(from, to, steps)| (values[to] - values[from]) / (2.0 * steps * STEP));
        let (fine, coarse) = ((4.0 * near - middle) / 3.0, (4.0 * middle - far) / 3.0);
        (fine, 1.5 * SEARCHED / STEP + (fine - coarse).abs())
    }))
}

/// Compares all of them; gives how many could be.
fn compare(robot: &Robot, motion: &Motion) -> usize {
    let Some(at) = critical(robot, motion).filter(|critical| critical.speed > SLOWEST) else { return 0 };
    let all = match sensitivities(robot, motion, &at) {
        Ok(all) => all,
        Err(NoSensitivity::NotSimple | NoSensitivity::NotTransversal) => return 0,
        Err(reason) => panic!("{reason}: {robot:?} {motion:?}"),
    };
    let mut compared = 0;
    for Sensitivity { knob, speed, frequency, .. } in all {
        let what = format!("{knob:?} at {:?} along {:?} of {robot:?}", motion.position(), motion.direction());
        assert_eq!(frequency.is_some(), at.kind == Instability::Flutter, "{what}");
        let Some([by_speed, by_frequency]) = differences(robot, motion, &at, knob) else { continue };
        close(speed, by_speed.0, by_speed.1, format!("speed by {what}"));
        close(frequency.unwrap_or(0.0), by_frequency.0, by_frequency.1, format!("frequency by {what}"));
        compared += 1;
    }
    compared
}

fn paper(linearisation: Linearisation, position: [f64; 2], direction: [f64; 2]) -> (Robot, Motion) {
    let robot = Robot::new(RobotSpec { linearisation, ..paper_spec() }).expect("a robot");
    (robot, Motion::new(position, direction, 0.0).expect("a motion"))
}

#[test]
fn of_the_papers_robot_they_are_what_differences_give() {
    for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
        for (position, direction) in [
            ([0.0, 0.0], [1.0, 0.0]),
            ([0.0, 0.0], [0.0, 1.0]),
            ([2.0, 0.0], [1.0, 0.0]),
            ([-3.0, 1.5], [1.0, 0.4]),
            ([4.5, -2.0], [-0.3, -1.0]),
            ([6.0, 0.5], [1.0, 0.0]),
        ] {
            let (robot, motion) = paper(linearisation, position, direction);
            let compared = compare(&robot, &motion);
            assert_eq!(compared, 9, "{linearisation:?} {position:?} {direction:?}");
        }
    }
}

#[test]
fn of_random_robots_they_are_what_differences_give() {
    let compared = Cell::new(0);
    TestRunner::new(config(48))
        .run(&moving_robot(2..8), |(robot, motion)| {
            prop_assume!(common::random::statics(&robot, motion.position()).is_some());
            compared.set(compared.get() + compare(&robot, &motion));
            Ok(())
        })
        .unwrap_or_else(|failure| panic!("{failure}"));
    assert!(compared.get() > 100, "only {} were compared", compared.get());
}

/// The paper's robot, whose cables have all kinds of own values: E alone, all three, A and μ, none.
fn mixed() -> RobotSpec {
    let mut spec = paper_spec();
    spec.cables[0].own.youngs_modulus = Some(2.5e8);
    spec.cables[1].own = OwnMaterial {
        youngs_modulus: Some(9e7),
        area: Some(7e-5),
        mass_per_length: Some(0.3),
        strain: Some(Strain::Engineering),
    };
    spec.cables[2].own = OwnMaterial { area: Some(4e-5), mass_per_length: Some(0.5), ..OwnMaterial::default() };
    spec
}

#[test]
fn own_values_have_sensitivities_of_their_own() {
    for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
        let robot = Robot::new(RobotSpec { linearisation, ..mixed() }).expect("a robot");
        let motion = Motion::new([1.0, 0.5], [1.0, -0.3], 0.0).expect("a motion");
        let at = critical(&robot, &motion).expect("a critical speed");
        let all = sensitivities(&robot, &motion, &at).expect("derivatives");
        let knobs: Vec<Knob> = all.iter().map(|one| one.knob).collect();
        let expected = [
            Knob::YoungsModulus,
            Knob::OwnYoungsModulus(0),
            Knob::OwnYoungsModulus(1),
            Knob::Area,
            Knob::OwnArea(1),
            Knob::OwnArea(2),
            Knob::MassPerLength,
            Knob::OwnMassPerLength(1),
            Knob::OwnMassPerLength(2),
            Knob::PlatformMass,
            Knob::Tension(2),
            Knob::Tension(3),
            Knob::Alpha,
            Knob::Beta,
            Knob::Gravity,
        ];
        assert_eq!(knobs, expected);
        assert_eq!(compare(&robot, &motion), expected.len(), "{linearisation:?}");
    }
}

/// Where every cable has an own E, the common one does nothing, and is not asked about. If each has what is common anyway,
/// the parts of the cables add up to the whole.
#[test]
fn a_common_value_that_no_cable_uses_has_no_sensitivity() {
    let (common, motion) = paper(Linearisation::Tangent, [1.0, 0.5], [1.0, -0.3]);
    let mut spec = (*common).clone();
    for cable in &mut spec.cables {
        cable.own.youngs_modulus = Some(spec.material.youngs_modulus);
        cable.own.mass_per_length = Some(spec.material.mass_per_length);
    }
    let own = Robot::new(spec).expect("a robot");
    let at = critical(&common, &motion).expect("a critical speed");
    assert_eq!(critical(&own, &motion).as_ref(), Some(&at), "the same robot in other words");
    let [all, parts] = [&common, &own].map(|robot| sensitivities(robot, &motion, &at).expect("derivatives"));
    let sum = |list: &[Sensitivity], wanted: fn(Knob) -> bool| -> f64 {
        list.iter().filter(|one| wanted(one.knob)).map(|one| one.speed).sum()
    };
    assert!(parts.iter().all(|one| !matches!(one.knob, Knob::YoungsModulus | Knob::MassPerLength)));
    assert_eq!(parts.iter().filter(|one| matches!(one.knob, Knob::OwnYoungsModulus(_))).count(), 4);
    let of_modulus = |knob| matches!(knob, Knob::YoungsModulus | Knob::OwnYoungsModulus(_));
    let of_mass = |knob| matches!(knob, Knob::MassPerLength | Knob::OwnMassPerLength(_));
    close(sum(&parts, of_modulus), sum(&all, of_modulus), 1e-9, "E");
    close(sum(&parts, of_mass), sum(&all, of_mass), 1e-9, "μ");
}

/// Checks the sums that units demand, for the speed and the frequency. In a unit of mass 1/s as large, the values of E, μ,
/// m and all tensions are s times as large, and nothing else changes. In a unit of time s times as long, the values of E,
/// the tensions and g are s² times as large, α is s times, β 1/s times, and speeds and frequencies are s times as large. E
/// and A occur in EA only. Tells whether the crossing has derivatives.
fn check_units(robot: &Robot, motion: &Motion) -> bool {
    let Some(at) = critical(robot, motion).filter(|critical| critical.speed > SLOWEST) else { return false };
    let Ok(all) = sensitivities(robot, motion, &at) else { return false };
    let of = |value: fn(&Sensitivity) -> f64| {
        let by = |wanted: fn(Knob) -> bool| all.iter().filter(|s| wanted(s.knob)).map(value).sum::<f64>();
        let modulus = by(|knob| matches!(knob, Knob::YoungsModulus | Knob::OwnYoungsModulus(_)));
        let area = by(|knob| matches!(knob, Knob::Area | Knob::OwnArea(_)));
        let forces = modulus + by(|knob| matches!(knob, Knob::Tension(_)));
        let of_mass = |knob| matches!(knob, Knob::MassPerLength | Knob::OwnMassPerLength(_) | Knob::PlatformMass);
        let masses = by(of_mass);
        let rates = 2.0 * (forces + by(|knob| knob == Knob::Gravity)) + by(|knob| knob == Knob::Alpha);
        let size = all.iter().map(|s| value(s).abs()).fold(1.0, f64::max);
        (forces + masses, rates - by(|knob| knob == Knob::Beta), [modulus, area], size)
    };
    let values: [fn(&Sensitivity) -> f64; 2] = [|s| s.speed, |s| s.frequency.unwrap_or_default()];
    for (i, value) in values.into_iter().enumerate() {
        let (mass, time, [e, a], size) = of(value);
        // Exact for an eigenvalue on the axis. One that is off it because the speed is off by a part ε of itself leaves ε
        // in the second sum; SEARCHED bounds ε for speeds above SLOWEST, and rounding in the sums comes on top.
        let allowed = SEARCHED + 1e-9 * size;
        let what = format!("{} of {robot:?} {motion:?}", ["speed", "frequency"][i]);
        close(mass, 0.0, allowed, format!("mass, {what}"));
        let rate = if i == 0 || at.kind == Instability::Flutter { 1.0 } else { 0.0 };
        close(time, rate, allowed, format!("time, {what}"));
        // With own materials the two sums have different terms, each with a rounding of its own.
        let own = robot.cables.iter().any(|cable| !cable.own.is_empty());
        close(e, a, if own { 1e-9 } else { 1e-12 } * size, format!("E and A, {what}"));
    }
    true
}

/// Those of the wave limit, against differences: rounding of ln v over h, and a fifteenth of what two steps differ by.
#[test]
fn those_of_the_wave_limit_are_what_differences_give() {
    let waves = |robot: &Robot, motion: &Motion| {
        LocalProblem::new(robot, motion).ok().and_then(|local| local.wave_limit).expect("a wave limit")
    };
    let robots = [Linearisation::Secant, Linearisation::Tangent]
        .map(|linearisation| [RobotSpec { linearisation, ..paper_spec() }, RobotSpec { linearisation, ..mixed() }]);
    for (spec, position, direction) in robots.into_iter().flatten().flat_map(|spec| {
        [([2.0, 0.0], [1.0, 0.0]), ([-3.0, 1.5], [1.0, 0.4]), ([6.0, 0.5], [1.0, 0.0])]
            .map(|(position, direction)| (spec.clone(), position, direction))
    }) {
        let (robot, motion) = (Robot::new(spec).expect("a robot"), Motion::new(position, direction, 0.0).expect("one"));
        let (limit, at) = (waves(&robot, &motion), critical(&robot, &motion).expect("a critical speed"));
        let all = sensitivities(&robot, &motion, &at).expect("derivatives");
        let mut sums = [0.0; 2];
        for Sensitivity { knob, wave_limit, .. } in all {
            let found = wave_limit.expect("a derivative");
            let change = |s: f64| (waves(&turned(&robot, knob, s), &motion).speed / limit.speed).ln();
            let slope = |h: f64| (change(h) - change(-h)) / (2.0 * h);
            let (near, far) = (slope(STEP), slope(2.0 * STEP));
            close(found, (4.0 * near - far) / 3.0, 1e-10 / STEP + (near - far).abs(), format!("{knob:?} {position:?}"));
            // What units of mass and of time demand, as of the critical speed.
            let force = matches!(knob, Knob::YoungsModulus | Knob::OwnYoungsModulus(_) | Knob::Tension(_));
            let of_mass = |knob| matches!(knob, Knob::MassPerLength | Knob::OwnMassPerLength(_) | Knob::PlatformMass);
            sums[0] += if force || of_mass(knob) { found } else { 0.0 };
            sums[1] += if force || knob == Knob::Gravity { 2.0 * found } else { 0.0 };
        }
        close(sums[0], 0.0, 1e-9, format!("mass {position:?}"));
        close(sums[1], 1.0, 1e-9, format!("time {position:?}"));
    }
}

#[test]
fn units_of_mass_and_time_do_not_matter() {
    for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
        for x in [0.0, 1.0, 3.5, 5.0, 6.5, 7.0] {
            let (robot, motion) = paper(linearisation, [x, 0.3], [1.0, -0.2]);
            assert!(check_units(&robot, &motion), "{linearisation:?} {x}");
        }
    }
    let checked = Cell::new(0);
    TestRunner::new(config(64))
        .run(&moving_robot(2..12), |(robot, motion)| {
            prop_assume!(common::random::statics(&robot, motion.position()).is_some());
            checked.set(checked.get() + usize::from(check_units(&robot, &motion)));
            Ok(())
        })
        .unwrap_or_else(|failure| panic!("{failure}"));
    assert!(checked.get() > 20, "only {} were checked", checked.get());
}

#[test]
fn without_damping_there_is_nothing_to_turn() {
    let damping = Damping { alpha: 0.0, beta: 0.0 };
    let robot = Robot::new(RobotSpec { damping, ..paper_spec() }).expect("a robot");
    let motion = Motion::new([1.0, 0.0], [1.0, 0.0], 0.0).expect("a motion");
    let at = critical(&robot, &motion).expect("a critical speed");
    assert!(at.speed <= 0.0, "{at:?}");
    assert_eq!(sensitivities(&robot, &motion, &at), Err(NoSensitivity::FromRest));
}

/// Cables 3 and 4 are each other's mirror image. Only the platform couples them, and one that is a hundred million times as
/// heavy as the cables does not move. A change of one tension, up or down, lets one of the cables cross first: the critical
/// speed has a kink.
#[test]
fn two_modes_that_cross_together_have_no_derivative() {
    let mut spec = RobotSpec { platform_mass: 4e8, ..paper_spec() };
    spec.material.youngs_modulus = 1e20;
    let robot = Robot::new(spec).expect("a robot");
    let motion = Motion::new([0.0, 0.0], [0.0, -1.0], 0.0).expect("a motion");
    let at = critical(&robot, &motion).expect("a critical speed");
    assert!([2, 3].contains(&at.cable), "{at:?}");
    assert_eq!(sensitivities(&robot, &motion, &at), Err(NoSensitivity::NotSimple));
}

/// A parameter that is zero has no part in the speed, the others still do.
#[test]
fn a_parameter_that_is_zero_counts_for_nothing() {
    let damping = Damping { alpha: 0.5, beta: 0.0 };
    let robot = Robot::new(RobotSpec { damping, gravity: 0.0, ..paper_spec() }).expect("a robot");
    let motion = Motion::new([1.0, 0.0], [1.0, 0.0], 0.0).expect("a motion");
    let at = critical(&robot, &motion).expect("a critical speed");
    for Sensitivity { knob, speed, frequency, .. } in sensitivities(&robot, &motion, &at).expect("a simple crossing") {
        let nothing = matches!(knob, Knob::Beta | Knob::Gravity);
        assert_eq!(nothing, speed == 0.0 && frequency.is_none_or(|f| f == 0.0), "{knob:?}: {speed}");
    }
}
