//! Statics judged without the crate's solver: shapes by their equations, refusals by the rule of docs/theory.md section 5.

use tautline::Robot;
use tautline::mechanics::{self, CableShape, Failure, Infeasible, LengthRates, Statics, StaticsError, length_rates};
use tautline::robot::{Cable, TensionLaw, Vec2};

use super::hung::{self, Hung, mass_per_length};
use super::{close, pair};

/// The tension that a cable's law prescribes.
pub fn prescribed(cable: &Cable, at: Vec2) -> Option<f64> {
    let part = |c: [f64; 3]| c[0] + c[1] * at.x + c[2] * at.y;
    match cable.tension {
        TensionLaw::Equilibrium => None,
        TensionLaw::Constant(tension) => Some(tension),
        TensionLaw::Hypot { horizontal, vertical } => Some(part(horizontal).hypot(part(vertical))),
    }
}

/// The shape of cable `i` satisfies the axial law and the balance of every node, and ends at the anchor. Its force is known to the
/// part `ill`: of that Newton's method leaves the square.
pub fn check_shape(robot: &Robot, platform: Vec2, i: usize, shape: &CableShape, ill: f64) {
    let (n, law, anchor) = (robot.elements, Hung::of(robot, i), robot.cables[i].anchor);
    let l = shape.length / n as f64;
    let weight = Vec2::new(0.0, mass_per_length(robot, i) * robot.gravity * l);
    let chord = (anchor - platform).norm();
    let size = shape.nodes.iter().map(Vec2::norm).fold(chord, f64::max);
    assert_eq!((shape.nodes.len(), shape.forces.len()), (n + 1, n));
    assert!(shape.length > 0.0 && shape.forces[0] == shape.t0);
    assert_eq!(shape.nodes[0], platform);
    // A rounding per element, each of the size of the coordinates.
    let rounding = f64::EPSILON * size * (n + 4) as f64;
    // A rounding of the forces, of the size of their terms, turns and stretches the elements: those most that carry least.
    let turned: f64 = shape.forces.iter().map(|t| l * law.stretch(t.norm()) / t.norm()).sum();
    let of_forces = f64::EPSILON * (shape.t0.norm() + weight.norm() * n as f64) * turned;
    let allowed = 10.0 * rounding + 2.0 * of_forces + chord * ill * ill;
    close((shape.nodes[n] - anchor).norm(), 0.0, allowed, "distance of the end from the anchor");
    for (k, (&t, ends)) in shape.forces.iter().zip(shape.nodes.windows(2)).enumerate() {
        let span = ends[1] - ends[0];
        let (force, slope) = law.law(span.norm() / l);
        // The difference of two nodes has their rounding: over l it is that of the stretch.
        let of_stretch = 4.0 * f64::EPSILON * size / l;
        close(force, t.norm(), slope * of_stretch, format_args!("axial law of element {k}"));
        let across = t.normalize().perp(&span);
        close(across, 0.0, of_stretch * l, format_args!("distance of element {k} from its force's line"));
        let next = if k + 1 < n { shape.forces[k + 1] } else { t + weight };
        let balance = (next - t - weight).norm();
        close(balance, 0.0, 2.0 * f64::EPSILON * next.norm(), format_args!("balance of node {}", k + 1));
    }
    let (first, last) = (shape.forces[0], shape.forces[n - 1]);
    let rounding = 4.0 * f64::EPSILON * (first.norm() + last.norm());
    close(shape.tension_at_platform, (first - weight / 2.0).norm(), rounding, "tension at the platform");
    close(shape.tension_at_winch, (last + weight / 2.0).norm(), rounding, "tension at the winch");
}

/// All shapes satisfy their equations, prescribed tensions are met, and the platform is in balance.
pub fn check_statics(robot: &Robot, found: &Statics) {
    let [a, b] = pair(robot).map(|i| (robot.cables[i].anchor - found.position).normalize());
    // Directions have rounding, in both coordinates of both equilibrium cables one of every element, and their tensions have as
    // much more as these are nearer to one line. Newton's method comes as near as that; the square of it is left.
    let ill = 8.0 * f64::EPSILON * (robot.elements + 8) as f64 / a.perp(&b).abs();
    let own_weight = Vec2::new(0.0, robot.platform_mass * robot.gravity);
    let (mut sum, mut size) = (-own_weight, own_weight.norm());
    for (i, (cable, shape)) in robot.cables.iter().zip(&found.cables).enumerate() {
        let ill = if robot.equilibrium().contains(&i) { ill } else { 0.0 };
        check_shape(robot, found.position, i, shape, ill);
        let force = Hung::of(robot, i).platform_force(shape);
        sum += force;
        size += force.norm();
        if let Some(tension) = prescribed(cable, found.position) {
            let rounding = 8.0 * f64::EPSILON * (tension + shape.t0.norm());
            close(shape.tension_at_platform, tension, rounding, format_args!("tension of cable {}", i + 1));
        }
    }
    // Newton's method ends where the rounding of all equations together does, that of n elements among them.
    let rounding = (robot.elements + 8) as f64 * f64::EPSILON;
    close(sum.norm(), 0.0, (rounding + ill * ill) * size, "balance of the platform");
}

/// The force with which the equilibrium cables have to pull together, given the shapes of the prescribed ones.
pub fn load<'a>(robot: &Robot, shape: impl Fn(usize) -> &'a CableShape) -> Vec2 {
    let own_weight = Vec2::new(0.0, robot.platform_mass * robot.gravity);
    robot.prescribed().fold(own_weight, |load, i| load - Hung::of(robot, i).platform_force(shape(i)))
}

/// The tensions of the equilibrium cables if they were straight, by Cramer's rule.
pub fn straight_tensions(robot: &Robot, platform: Vec2, load: Vec2) -> [f64; 2] {
    let [a, b] = pair(robot).map(|i| (robot.cables[i].anchor - platform).normalize());
    let determinant = a.x * b.y - a.y * b.x;
    [(load.x * b.y - load.y * b.x) / determinant, (a.x * load.y - a.y * load.x) / determinant]
}

/// Checks a pose's verdict by the rule of docs/theory.md section 5; listing all shapes is slow, so only if `thorough`.
pub fn check_verdict(robot: &Robot, platform: Vec2, found: &Result<Statics, Failure>, thorough: bool) {
    let law = |i: usize| Hung::of(robot, i);
    let chord = |i: usize| robot.cables[i].anchor - platform;
    let failure = match found {
        Ok(statics) => {
            let load = load(robot, |i| &statics.cables[i]);
            let tensions = straight_tensions(robot, platform, load);
            assert!(tensions[0] > 0.0 && tensions[1] > 0.0, "{platform:?} has a shape, with {tensions:?}");
            return;
        }
        Err(failure) => failure,
    };
    let StaticsError::Infeasible(reason) = failure.reason else {
        panic!("{failure} at {platform:?} of {robot:?}");
    };
    let load = || load(robot, |i| failure.cables[i].as_ref().expect("a prescribed cable's shape"));
    match reason {
        Infeasible::AtAnchor { cable } => close(chord(cable).norm(), 0.0, 1e-9, "distance from the anchor"),
        Infeasible::NoTension { tension, .. } => assert!(tension <= 0.0, "{tension} N at {platform:?}"),
        Infeasible::TooSlack { cable, tension } => {
            assert!(robot.cables[cable].tension != TensionLaw::Equilibrium);
            let curve = if thorough { law(cable).curve(chord(cable)) } else { Vec::new() };
            let least = curve.iter().map(|(_, force)| force.norm()).fold(f64::INFINITY, f64::min);
            assert!(least > tension, "{tension} N at {platform:?}: a cable can have {least} N");
        }
        Infeasible::WouldPush { cable, tension } => {
            let tensions = straight_tensions(robot, platform, load());
            assert!(tension <= 0.0, "{tensions:?} at {platform:?}");
            let size = tensions[0].abs() + tensions[1].abs();
            // Their directions have rounding, which counts as much more as the cables are nearer to one line.
            let [a, b] = pair(robot).map(|i| chord(i).normalize());
            let rounding = 8.0 * f64::EPSILON / a.perp(&b).abs() * size;
            let weakest = usize::from(tensions[1] < tensions[0]);
            let tie = (tensions[0] - tensions[1]).abs() <= rounding;
            assert!(tie || cable == pair(robot)[weakest], "{tensions:?} at {platform:?}");
            close(tension, tensions[weakest], 1e-9 * size + rounding, "the tension of the cable that would push");
        }
        Infeasible::OneLine { .. } => {
            let [a, b] = pair(robot).map(|i| chord(i).normalize());
            close(a.perp(&b), 0.0, 1e-6, "sine of the angle between the two cables");
        }
        Infeasible::GoesSlack { cable } => {
            assert!(robot.equilibrium().contains(&cable));
            let tensions = straight_tensions(robot, platform, load());
            assert!(tensions[0] > 0.0 && tensions[1] > 0.0, "{tensions:?} at {platform:?}");
            if thorough {
                let curves = pair(robot).map(|i| law(i).curve(chord(i)));
                let shapes = hung::crossings(&curves, load());
                assert!(shapes.is_empty(), "{reason} at {platform:?}, but there is {shapes:?}");
            }
        }
    }
}

/// A pose that has a shape, with the length rates along `direction`.
pub struct Pose {
    pub position: Vec2,
    pub statics: Statics,
    pub rates: Vec<LengthRates>,
}

pub fn pose(robot: &Robot, position: Vec2, direction: Vec2) -> Option<Pose> {
    let statics = mechanics::solve(robot, position).ok()?;
    let rates = length_rates(robot, &statics, direction).expect("length rates");
    Some(Pose { position, statics, rates })
}

/// Fails if lengths jump between two poses: L(b) − L(a) is the trapezium of L' but for h³/12 of L''', taken here to be
/// less than 1/3 of L''/h. Where it is not, the middle is looked at; a jump does not vanish by that, however often.
pub fn check_continuous(robot: &Robot, a: &Pose, b: &Pose, halvings: u32) {
    let step = b.position - a.position;
    let h = step.norm();
    let smooth = (0..robot.cables.len()).all(|i| {
        let change = b.statics.cables[i].length - a.statics.cables[i].length;
        let expected = 0.5 * h * (a.rates[i].first + b.rates[i].first);
        let bound = 0.25 * h * h * a.rates[i].second.abs().max(b.rates[i].second.abs()).max(1e-3);
        (change - expected).abs() <= bound
    });
    if !smooth {
        assert!(halvings > 0, "lengths jump between {:?} and {:?} of {robot:?}", a.position, b.position);
        // Without a shape in the middle the two poses belong to different parts of the workspace.
        if let Some(middle) = pose(robot, a.position + 0.5 * step, step / h) {
            check_continuous(robot, a, &middle, halvings - 1);
            check_continuous(robot, &middle, b, halvings - 1);
        }
    }
}
