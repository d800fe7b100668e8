//! Statics and length rates of robots drawn at random: equations, taut branch, derivatives, symmetries.

mod common;

use common::hung::{self, Hung};
use common::random::{config, mirrored, moving_robot, statics};
use common::statics::check_statics;
use common::{close, pair};
use proptest::prelude::*;
use tautline::mechanics::{self, length_rates};
use tautline::robot::{TensionLaw, Vec2};
use tautline::{Motion, Robot};

proptest! {
    #![proptest_config(config(400))]

    #[test]
    fn statics_satisfy_their_equations((robot, motion) in moving_robot(2..25)) {
        let found = statics(&robot, motion.position());
        prop_assume!(found.is_some());
        let found = found.unwrap();
        check_statics(&robot, &found);
    }

    /// L' and L'' against differences of the statics of order 4. Halving the step tells the error of these: it falls to
    /// 1/16, so the finer difference is off by 1/15 of the distance between the two, or somewhat more if the next order
    /// counts.
    #[test]
    fn length_rates_are_derivatives_of_the_lengths((robot, motion) in moving_robot(2..25)) {
        let h = 0.005;
        let at = |steps: f64| statics(&robot, motion.position() + motion.direction() * (steps * h));
        let found: Option<Vec<_>> = [-4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0].into_iter().map(at).collect();
        prop_assume!(found.is_some());
        let found = found.unwrap();
        let rates = length_rates(&robot, &found[3], motion.direction()).expect("length rates");
        for (i, rate) in rates.iter().enumerate() {
            let length = |k: usize| found[k].cables[i].length;
            // Differences over −2h, −h, h, 2h, with h = `step`, and the numbers of those lengths.
            let first = |[a, b, c, d]: [usize; 4], step: f64| {
                (8.0 * (length(c) - length(b)) - (length(d) - length(a))) / (12.0 * step)
            };
            let second = |[a, b, c, d]: [usize; 4], step: f64| {
                let sum = 16.0 * (length(b) + length(c)) - (length(a) + length(d));
                (sum - 30.0 * length(3)) / (12.0 * step * step)
            };
            let (coarse, fine) = ([0, 1, 5, 6], [1, 2, 4, 5]);
            let (first_coarse, first_fine) = (first(coarse, 2.0 * h), first(fine, h));
            let (second_coarse, second_fine) = (second(coarse, 2.0 * h), second(fine, h));
            // Lengths are known to some roundings; 18/12 and 64/12 of them make up the differences.
            let rounding = 32.0 * f64::EPSILON * length(3);
            let first_allowed = 0.2 * (first_coarse - first_fine).abs() + 1.5 * rounding / h;
            let second_allowed = 0.2 * (second_coarse - second_fine).abs() + 5.4 * rounding / (h * h);
            close(rate.first, first_fine, first_allowed, format_args!("L' of cable {}", i + 1));
            close(rate.second, second_fine, second_allowed, format_args!("L'' of cable {}", i + 1));
        }
    }

    /// Turning the direction round turns L' round and leaves L''; its length does not matter; a mirror changes nothing.
    #[test]
    fn length_rates_know_no_left_and_right((robot, motion) in moving_robot(2..25), scale in 1e-3..1e3) {
        let (position, direction) = (motion.position(), motion.direction());
        let found = statics(&robot, position);
        prop_assume!(found.is_some());
        let found = found.unwrap();
        let rates = length_rates(&robot, &found, direction).expect("length rates");
        let back = length_rates(&robot, &found, -direction).expect("length rates");
        let longer = Motion::new(position, direction * scale, motion.speed()).expect("a motion");
        close((longer.direction() - direction).norm(), 0.0, 2.0 * f64::EPSILON, "a longer direction");
        let scaled = length_rates(&robot, &found, longer.direction()).expect("length rates");
        let (mirror, mirror_motion) = mirrored(&robot, &motion);
        let reflection = statics(&mirror, mirror_motion.position()).expect("statics in the mirror");
        let mirror_rates = length_rates(&mirror, &reflection, mirror_motion.direction()).expect("length rates");
        for (i, rate) in rates.iter().enumerate() {
            close(back[i].first, -rate.first, 0.0, "L' backwards");
            close(back[i].second, rate.second, 0.0, "L'' backwards");
            let j = rates.len() - 1 - i;
            // If the equilibrium cables pull nearly along one line, or a taut branch is about to end, derivatives lose
            // digits. A few thousand random robots lose at most 5 digits of L' and 9 of L''. A wrong sign would lose all.
            let size = (1.0 + rate.first.abs() + rate.second.abs()).powi(2);
            for (what, other) in [("for a longer direction", scaled[i]), ("in the mirror", mirror_rates[j])] {
                close(other.first, rate.first, 1e-11 * size, format_args!("L' {what}"));
                close(other.second, rate.second, 1e-7 * size, format_args!("L'' {what}"));
            }
        }
    }
}

proptest! {
    #![proptest_config(config(100))]

    /// No shorter cable has the prescribed tension, and no shorter pair balances the platform.
    #[test]
    fn the_shape_found_is_the_taut_one((robot, motion) in moving_robot(2..25)) {
        let platform = motion.position();
        let found = statics(&robot, platform);
        prop_assume!(found.is_some());
        let found = found.unwrap();
        let mut load = Vec2::new(0.0, robot.platform_mass * robot.gravity);
        for i in robot.prescribed() {
            let (law, shape, chord) = (Hung::of(&robot, i), &found.cables[i], robot.cables[i].anchor - platform);
            let force = law.platform_force(shape);
            load -= force;
            let hung = law.force(chord, shape.length).expect("a cable of the same length");
            // The stretch is known to some roundings, and with it the force to those of the stiffness.
            let rounding = 64.0 * f64::EPSILON * (robot.axial_stiffness(i) + force.norm());
            close((hung - force).norm(), 0.0, rounding, format_args!("force of cable {}", i + 1));
            for (length, other) in law.curve(chord) {
                prop_assert!(length >= shape.length * (1.0 - 1e-9) || other.norm() > force.norm(),
                    "cable {}: {} m and {length} m both have the tension", i + 1, shape.length);
            }
        }
        let pair = pair(&robot);
        let curves = pair.map(|i| Hung::of(&robot, i).curve(robot.cables[i].anchor - platform));
        let ours = [0, 1].map(|k| hung::place(&curves[k], found.cables[pair[k]].length));
        // Beyond the curves: more than 1e5 N or thrice the length of the chord.
        prop_assume!((0..2).all(|k| ours[k] > 1 && ours[k] + 2 < curves[k].len()));
        let all = hung::crossings(&curves, load);
        let at_ours = |at: &[usize; 2]| (0..2).all(|k| at[k].abs_diff(ours[k]) <= 1);
        prop_assert!(all.iter().any(at_ours), "{ours:?} is not among {all:?}");
        let total = |at: &[usize; 2]| curves[0][at[0]].0 + curves[1][at[1]].0;
        for other in all.iter().filter(|at| !at_ours(at)) {
            prop_assert!(total(other) > total(&ours), "{ours:?} is not the tautest of {all:?}");
        }
    }

    /// Close to the least tension that carries a cable, a slack shape is near the taut one, and Newton's method may find it.
    #[test]
    fn the_taut_branch_is_kept_up_to_its_end((robot, motion) in moving_robot(2..25), exponent in -6.0..-0.5) {
        let i = robot.prescribed().next().expect("a prescribed cable");
        let least = Hung::of(&robot, i).least_tension(robot.cables[i].anchor - motion.position());
        prop_assume!(least.is_some());
        let (length, least) = least.unwrap();
        let with_tension = |tension: f64| {
            let mut spec = (*robot).clone();
            spec.cables[i].tension = TensionLaw::Constant(tension);
            let robot = Robot::new(spec).expect("a robot");
            let found = mechanics::solve(&robot, motion.position());
            found.map_or_else(|failure| failure.cables[i].clone(), |statics| Some(statics.cables[i].clone()))
        };
        let above = 10.0_f64.powf(exponent);
        let shape = with_tension(least * (1.0 + above));
        let found = shape.expect("a shape with somewhat more than the least tension").length;
        prop_assert!(found < length, "{found} m is slack: the tension is least at {length} m");
        prop_assert!(with_tension(least * (1.0 - 1e-6)).is_none(), "a shape with less than the least tension");
    }
}
