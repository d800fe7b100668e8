//! Hanging cables against the elastic catenary, their in-plane modes, and Irvine and Caughey's shallow cable.
//!
//! The numbers are those of tests/reference/catenary.json: closed forms and independent codes, each with its source.

mod common;

use common::{close, list, number, numbers, read, reference_files};
use serde_json::Value;
use tautline::Robot;
use tautline::mechanics::{self, CableShape, Hub, LengthRates, Vibration};
use tautline::robot::{Cable, CableMaterial, Damping, Linearisation, RobotSpec, Strain, TensionLaw, Vec2};
use tautline::stability::Eigenproblem;

/// One cable from the platform to an anchor.
#[derive(Clone, Copy)]
struct Hanging {
    axial_stiffness: f64,
    mass_per_length: f64,
    gravity: f64,
    platform: Vec2,
    anchor: Vec2,
}

impl Hanging {
    /// The cable of `elements` elements with `tension` at the platform: its shape and its vibrations with both ends
    /// fixed. Two short cables on the other side hold the platform.
    fn with_tension(&self, elements: usize, tension: f64) -> (CableShape, Vibration) {
        let back = (self.platform - self.anchor).normalize();
        let aside = Vec2::new(-back.y, back.x);
        let holding = |sign: f64| Cable::new(self.platform + back + aside * sign, TensionLaw::Equilibrium);
        let cables = vec![holding(1.0), holding(-1.0), Cable::new(self.anchor, TensionLaw::Constant(tension))];
        let robot = Robot::new(RobotSpec {
            gravity: self.gravity,
            material: CableMaterial {
                youngs_modulus: self.axial_stiffness,
                area: 1.0,
                mass_per_length: self.mass_per_length,
                strain: Strain::Engineering,
            },
            platform_mass: 1e-3,
            cables,
            elements,
            damping: Damping { alpha: 0.0, beta: 0.0 },
            linearisation: Linearisation::Tangent,
        });
        let robot = robot.expect("a robot");
        let statics = mechanics::solve(&robot, self.platform).expect("a taut cable");
        let at_rest = vec![LengthRates { first: 0.0, second: 0.0 }; robot.cables.len()];
        let vibration = Vibration::new(&robot, &statics, &at_rest).expect("of the same robot");
        let own = vec![vibration.chains()[2].clone()];
        let alone = Vibration::of_cables(own, Hub::fixed(1), robot.damping, false).expect("a cable");
        (statics.cables[2].clone(), alone)
    }

    /// The same with a given unstretched length: the tension is found by the secant method, near `tension`.
    fn with_length(&self, elements: usize, length: f64, tension: f64) -> (CableShape, Vibration) {
        let excess = |tension: f64| self.with_tension(elements, tension).0.length - length;
        let (mut before, mut now) = (1.001 * tension, tension);
        let (mut excess_before, mut excess_now) = (excess(before), excess(now));
        for _ in 0..20 {
            if excess_now.abs() < 1e-13 * length || excess_now.total_cmp(&excess_before).is_eq() {
                break;
            }
            let next = now - excess_now * (now - before) / (excess_now - excess_before);
            (before, excess_before) = (now, excess_now);
            (now, excess_now) = (next, excess(next));
        }
        close(excess_now, 0.0, 1e-12 * length, "the length asked for");
        self.with_tension(elements, now)
    }
}

/// The limit of values at meshes n and 2n whose error is a/n² + b/n⁴ + …
fn limit(coarse: f64, fine: f64) -> f64 {
    fine + (fine - coarse) / 3.0
}

/// Natural frequencies in Hz, rising.
fn frequencies(vibration: &Vibration, count: usize) -> Vec<f64> {
    let spectrum = Eigenproblem::new(vibration).and_then(|problem| problem.spectrum(0.0)).expect("a spectrum");
    spectrum.modes().take(count).map(|mode| mode.frequency_hz()).collect()
}

fn reference() -> Value {
    let files = reference_files("catenary");
    assert_eq!(files.len(), 1);
    read(&files[0])
}

/// The reference's cable, held by its lower end.
fn reference_cable(reference: &Value) -> Hanging {
    let cable = &reference["cable"];
    Hanging {
        axial_stiffness: number(&cable["axial_stiffness"]),
        mass_per_length: number(&cable["mass_per_length"]),
        gravity: number(&cable["gravity"]),
        platform: Vec2::zeros(),
        anchor: Vec2::new(number(&cable["span"]), number(&cable["rise"])),
    }
}

/// A cable with the closed form's tension at one end has the closed form's length, and force at the other end.
#[test]
fn lengths_and_forces_converge_to_the_elastic_catenary() {
    let reference = reference();
    let given_to = number(&reference["elastic_catenary"]["relative_tolerance"]);
    let lower = reference_cable(&reference);
    let upper = Hanging { platform: lower.anchor, anchor: lower.platform, ..lower };
    for case in list(&reference["elastic_catenary"]["cases"]) {
        let get = |key: &str| number(&case[key]);
        let (length, horizontal) = (get("length"), get("horizontal"));
        let tension_below = horizontal.hypot(get("vertical_lower"));
        let tension_above = horizontal.hypot(get("vertical_upper"));
        for (cable, here, there) in [(lower, tension_below, tension_above), (upper, tension_above, tension_below)] {
            let what = format!("length {length}, held at {:?}", cable.platform.as_slice());
            let [coarse, fine] = [20, 40].map(|n| cable.with_tension(n, here).0);
            let order = ((coarse.length - length) / (fine.length - length)).log2();
            // Where the error is a/n² + b/n⁴, b of the size of a, the order is off by 1/n² or so.
            close(order, 2.0, 0.005, format_args!("{what}: order"));
            // What the extrapolation leaves, 1/n⁴ of a slight sag, is below the reference's own rounding.
            let limits = [limit(coarse.length, fine.length), limit(coarse.tension_at_winch, fine.tension_at_winch)];
            close(limits[0], length, given_to * length, format_args!("{what}: length"));
            close(limits[1], there, given_to * there, format_args!("{what}: tension at the other end"));
            close(fine.t0.x.abs(), horizontal, 1e-3 * horizontal, format_args!("{what}: horizontal force"));
        }
    }
}

#[test]
fn the_error_of_the_mesh_is_the_known_one() {
    let reference = reference();
    let cable = reference_cable(&reference);
    let mesh = &reference["mesh_convergence"];
    let length = number(&mesh["length"]);
    for (n, expected) in list(&mesh["elements"]).iter().zip(numbers(&mesh["horizontal"])) {
        let n = usize::try_from(n.as_u64().expect("a count")).expect("a count");
        let horizontal = cable.with_length(n, length, expected).0.t0.x;
        // Four decimals are given.
        close(horizontal, expected, 0.5001e-4, format_args!("horizontal force with {n} elements"));
    }
}

#[test]
fn in_plane_modes_of_hanging_cables() {
    let reference = reference();
    let cable = reference_cable(&reference);
    // Five decimals are given, 6e-6 of the lowest; the extrapolation leaves 3e-6 of the highest (j/n)⁴.
    let given_to = number(&reference["in_plane_modes"]["relative_tolerance"]);
    let statics = list(&reference["elastic_catenary"]["cases"]);
    for (case, statics) in list(&reference["in_plane_modes"]["cases"]).iter().zip(statics) {
        let length = number(&case["length"]);
        close(number(&statics["length"]), length, 0.0, "the same cable in both lists");
        let tension = number(&statics["horizontal"]).hypot(number(&statics["vertical_lower"]));
        let expected = numbers(&case["frequencies_hz"]);
        let [coarse, fine] = [40, 80].map(|n| frequencies(&cable.with_length(n, length, tension).1, expected.len()));
        for (j, &expected) in expected.iter().enumerate() {
            let what = format_args!("mode {} at length {length}", j + 1);
            close(limit(coarse[j], fine[j]), expected, given_to * expected, what);
        }
    }
}

/// A horizontal cable with a sag of a thousandth of its span, as stiff as the cable parameter λ² asks for.
#[test]
fn modes_of_shallow_cables() {
    let reference = &reference()["irvine_caughey"];
    let (span, weight, slope): (f64, f64, f64) = (10.0, 4.0, 8e-3);
    // w span/H = 8 × sag/span; λ² = (w span/H)² EA/H for a shallow cable.
    let horizontal = weight * span / slope;
    let tension = horizontal.hypot(0.5 * weight * span);
    for case in list(&reference["symmetric"]) {
        // Without an end: with 1e5, dΩ/Ω = −4/λ², from the derivative of tan z = z − (4/λ²) z³ at 4/λ² = 0.
        let endless = case["lambda_squared"].is_null();
        let lambda_squared = if endless { 1e5 } else { number(&case["lambda_squared"]) };
        let cable = Hanging {
            axial_stiffness: lambda_squared * horizontal / (slope * slope),
            mass_per_length: 0.4,
            gravity: weight / 0.4,
            platform: Vec2::zeros(),
            anchor: Vec2::new(span, 0.0),
        };
        // Symmetric and antisymmetric modes together, so that none can be missed or be there too often.
        let mut expected =
            [numbers(&case["omega_over_pi"]), numbers(&reference["antisymmetric_omega_over_pi"])].concat();
        expected.sort_by(f64::total_cmp);
        expected.truncate(4);
        let [coarse, fine] = [40, 80].map(|n| {
            let (shape, vibration) = cable.with_tension(n, tension);
            let wave_time = span / (shape.t0.x / cable.mass_per_length).sqrt();
            frequencies(&vibration, 4).iter().map(|f| 2.0 * f * wave_time).collect::<Vec<_>>()
        });
        // Shallow theory drops squares of the slope and, beside 1, the strain H/EA = slope²/λ² ≤ slope².
        let allowed = slope * slope + if endless { 4.0 / lambda_squared } else { 0.0 };
        for (j, &expected) in expected.iter().enumerate() {
            let what = format_args!("mode {} at λ² = {lambda_squared}", j + 1);
            close(limit(coarse[j], fine[j]), expected, allowed * expected, what);
        }
    }
}
