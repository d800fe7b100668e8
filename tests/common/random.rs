//! Robots and motions drawn at random.

use std::f64::consts::TAU;
use std::ops::Range;

use proptest::prelude::*;
use tautline::mechanics::{self, Failure, Statics, StaticsError};
use tautline::robot::{Cable, CableMaterial, Damping, Linearisation, OwnMaterial, RobotSpec, Strain, TensionLaw, Vec2};
use tautline::{Motion, Robot};

/// The same robots in every run, `cases` of them; `PROPTEST_RNG_SEED` and `PROPTEST_CASES` give others, and more.
pub fn config(cases: u32) -> ProptestConfig {
    let given = ProptestConfig::default();
    let chosen = |name: &str| std::env::var_os(name).is_some();
    ProptestConfig {
        cases: if chosen("PROPTEST_CASES") { given.cases } else { cases },
        rng_seed: if chosen("PROPTEST_RNG_SEED") { given.rng_seed } else { prop::test_runner::RngSeed::Fixed(1) },
        // Most poses of most robots have no equilibrium; those are passed over where a test needs one.
        max_global_rejects: 1_000_000,
        // Simplified robots are degenerate in ways of their own: vertical cables, anchors at one place.
        max_shrink_iters: 0,
        failure_persistence: None,
        ..given
    }
}

/// The statics where the pose has any. An iteration that gives up is a failure.
pub fn statics(robot: &Robot, position: Vec2) -> Option<Statics> {
    match mechanics::solve(robot, position) {
        Ok(statics) => Some(statics),
        Err(Failure { reason: StaticsError::Infeasible(_), .. }) => None,
        Err(failure) => panic!("{failure} at {position:?}: {robot:?}"),
    }
}

/// A robot of 3 to 8 cables with a pose inside its anchors or somewhat outside.
pub fn moving_robot(elements: Range<usize>) -> impl Strategy<Value = (Robot, Motion)> {
    let motion = (-7.0..7.0, -4.0..4.0, 0.0..TAU, 0.0..8.0).prop_map(|(x, y, angle, speed): (f64, f64, f64, f64)| {
        Motion::new([x, y], [angle.cos(), angle.sin()], speed).expect("a motion")
    });
    (robot(elements), motion)
}

/// A robot of 3 to 8 cables.
pub fn robot(elements: Range<usize>) -> impl Strategy<Value = Robot> {
    let physics = (
        prop_oneof![Just(0.0), Just(9.81), 0.0..20.0],  // g
        (3.0..7.0).prop_map(|e: f64| 10.0_f64.powf(e)), // EA
        0.02..0.6,                                      // μ
        0.5..30.0,                                      // m
        prop_oneof![Just(Strain::Green), Just(Strain::Engineering)],
        prop_oneof![Just(Linearisation::Secant), Just(Linearisation::Tangent)],
        (0.0..2.0, 0.0..0.01).prop_map(|(alpha, beta)| Damping { alpha, beta }),
        elements,
    );
    let together = |(physics, mut cables, own): (_, Vec<Cable>, Vec<OwnFactors>)| {
        let (gravity, stiffness, mu, mass, strain, linearisation, damping, elements) = physics;
        let material = CableMaterial { youngs_modulus: stiffness / 5e-5, area: 5e-5, mass_per_length: mu, strain };
        for (cable, (modulus, area, mass, strain)) in cables.iter_mut().zip(own) {
            cable.own = OwnMaterial {
                youngs_modulus: modulus.map(|factor| factor * material.youngs_modulus),
                area: area.map(|factor| factor * material.area),
                mass_per_length: mass.map(|factor| factor * mu),
                strain,
            };
        }
        let spec = RobotSpec { gravity, material, platform_mass: mass, cables, elements, damping, linearisation };
        Robot::new(spec).expect("a robot")
    };
    // One robot in three has cables with a material of their own.
    let own = prop_oneof![2 => Just(Vec::new()), 1 => prop::collection::vec(own_factors(), 8)];
    (physics, cables(), own).prop_map(together)
}

/// What a cable has of its own: E, A and μ in parts of those of the robot, and the strain measure.
type OwnFactors = (Option<f64>, Option<f64>, Option<f64>, Option<Strain>);

/// Each is there for one cable in two. E and A are up to five times larger or smaller than those of the robot, μ three times.
fn own_factors() -> impl Strategy<Value = OwnFactors> {
    let factor = |most: f64| prop::option::of((-1.0..1.0_f64).prop_map(move |part| most.powf(part)));
    let strain = prop::option::of(prop_oneof![Just(Strain::Green), Just(Strain::Engineering)]);
    (factor(5.0), factor(5.0), factor(3.0), strain)
}

/// Anchors near the corners of a rectangle 20 m × 10 m and then anywhere, or all of them anywhere; any two cables at
/// equilibrium, more often the first two: the upper ones of the rectangle.
fn cables() -> impl Strategy<Value = Vec<Cable>> {
    let anywhere = || (-12.0..12.0, -7.0..7.0).prop_map(|(x, y)| Vec2::new(x, y));
    let rectangle = prop::collection::vec((-2.0..2.0, -2.0..2.0), 4).prop_map(|jitter| {
        let corners = [(-10.0, 5.0), (10.0, 5.0), (-10.0, -5.0), (10.0, -5.0)];
        corners.into_iter().zip(jitter).map(|((x, y), (dx, dy))| Vec2::new(x + dx, y + dy)).collect::<Vec<_>>()
    });
    let anchors = prop_oneof![
        (rectangle, prop::collection::vec(anywhere(), 0..5)).prop_map(|(corners, more)| [corners, more].concat()),
        prop::collection::vec(anywhere(), 3..9),
    ];
    let constant = || (20.0..300.0).prop_map(TensionLaw::Constant);
    let slope = || -4.0..4.0;
    let law = move || {
        (30.0..150.0, slope(), slope(), 30.0..150.0, slope(), slope())
            .prop_map(|(h, hx, hy, v, vx, vy)| TensionLaw::Hypot { horizontal: [h, hx, hy], vertical: [v, vx, vy] })
    };
    let laws = prop::collection::vec(prop_oneof![constant(), law()], 8);
    let pair = prop_oneof![Just((0, 1)), (0..8_usize, 1..8_usize)];
    (anchors, laws, pair).prop_map(|(anchors, laws, (a, step))| {
        let (a, b) = (a % anchors.len(), (a + step) % anchors.len());
        let b = if a == b { (a + 1) % anchors.len() } else { b };
        let tension = |i: usize| if i == a || i == b { TensionLaw::Equilibrium } else { laws[i] };
        anchors.iter().enumerate().map(|(i, &anchor)| Cable::new(anchor, tension(i))).collect()
    })
}

/// The robot and its motion seen in a mirror, its cables numbered from the other side.
pub fn mirrored(robot: &Robot, motion: &Motion) -> (Robot, Motion) {
    let flip = |v: Vec2| Vec2::new(-v.x, v.y);
    let flip_law = |law| match law {
        TensionLaw::Hypot { horizontal: [h, hx, hy], vertical: [v, vx, vy] } => {
            TensionLaw::Hypot { horizontal: [h, -hx, hy], vertical: [v, -vx, vy] }
        }
        other => other,
    };
    let cable = |cable: &Cable| Cable { anchor: flip(cable.anchor), tension: flip_law(cable.tension), ..*cable };
    let cables = robot.cables.iter().rev().map(cable).collect();
    let robot = Robot::new(RobotSpec { cables, ..(**robot).clone() }).expect("a robot");
    let motion = Motion::new(flip(motion.position()), flip(motion.direction()), motion.speed());
    (robot, motion.expect("a motion"))
}

/// Ten to an exponent.
fn decades(exponents: Range<f64>) -> impl Strategy<Value = f64> {
    exponents.prop_map(|exponent| 10.0_f64.powf(exponent))
}

/// A robot at the ends of what is legal, with a pose: EA from 10 N to 1e10 N, μ from 1e-6 to 100 kg/m, m from 1e-6 to
/// 1e6 kg, one in three without gravity, without α, without β; prescribed tensions from a thousandth to ten thousand
/// times the usual ones, or a few times the cable's weight.
pub fn extreme_robot(elements: Range<usize>) -> impl Strategy<Value = (Robot, Motion)> {
    let none_or = |other| prop_oneof![1 => Just(0.0), 2 => other];
    let physics = (
        prop_oneof![Just(0.0), Just(9.81), 0.0..20.0], // g
        decades(1.0..10.0),                            // EA
        decades(-6.0..2.0),                            // μ
        decades(-6.0..6.0),                            // m
        none_or(decades(-6.0..2.0).boxed()),           // α
        none_or(decades(-7.0..0.0).boxed()),           // β
        decades(-3.0..4.0),
        prop::option::of(decades(-0.5..2.0)),
    );
    (moving_robot(elements), physics).prop_map(
        |((robot, motion), (gravity, stiffness, mass_per_length, platform_mass, alpha, beta, factor, weights))| {
            let mut spec = (*robot).clone();
            let common = spec.material;
            spec.material.youngs_modulus = stiffness / spec.material.area;
            spec.material.mass_per_length = mass_per_length;
            spec.damping = Damping { alpha, beta };
            (spec.gravity, spec.platform_mass) = (gravity, platform_mass);
            // What a cable has of its own stays as many times the common value as it was.
            for own in spec.cables.iter_mut().map(|cable| &mut cable.own) {
                own.youngs_modulus =
                    own.youngs_modulus.map(|e| e / common.youngs_modulus * spec.material.youngs_modulus);
                own.mass_per_length = own.mass_per_length.map(|mu| mu / common.mass_per_length * mass_per_length);
            }
            // The usual tensions are about 100 N, the usual cables 10 m.
            let of_weight = weights.filter(|_| gravity > 0.0).map(|times| times * mass_per_length * gravity * 0.1);
            let factor = of_weight.unwrap_or(factor);
            for cable in &mut spec.cables {
                cable.tension = scaled(cable.tension, factor);
            }
            (Robot::new(spec).expect("a robot"), motion)
        },
    )
}

fn scaled(law: TensionLaw, factor: f64) -> TensionLaw {
    let all = |coefficients: [f64; 3]| coefficients.map(|c| c * factor);
    match law {
        TensionLaw::Equilibrium => law,
        TensionLaw::Constant(tension) => TensionLaw::Constant(tension * factor),
        TensionLaw::Hypot { horizontal, vertical } => {
            TensionLaw::Hypot { horizontal: all(horizontal), vertical: all(vertical) }
        }
    }
}
