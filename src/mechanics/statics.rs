//! Static equilibrium with sag: the shape of every cable and its unstretched length at a pose.
//!
//! With `t_k` the force of element k, pointing away from the platform, t_{k+1} = `t_k` + (0, μ g l): a cable's whole
//! shape follows from (t₀, L) with no unknowns along the mesh. A prescribed cable has three unknowns (t₀, L) and
//! three equations (it ends at its anchor, its tension at the platform is given). The two equilibrium cables
//! together have six (both ends, force balance of the platform).
//!
//! Several shapes may satisfy the equations. The one wanted is the *taut* one: it grows out of the straight,
//! weightless cables as the cables' weight is turned on. Newton's method tries full weight at once; the sign of
//! the Jacobian's determinant, which changes only where the taut shape meets a slack one, tells whether it found
//! the right one. If not, the weight is turned on in steps. docs/theory.md section 5 has the argument.

use nalgebra::{Const, OMatrix, SVector, ToTypenum};
use num_dual::{DualSVec64, jacobian};

use super::cable::{CableModel, prescribed_tension};
use crate::mechanics::Material;
use crate::robot::{Robot, Vec2};

/// The unknowns of the two cables that hold a point, (t₀, L) of each.
pub(super) const POINT: usize = 6;
/// The platform is "at" an anchor when nearer than this, in metres.
pub(super) const AT_ANCHOR: f64 = 1e-9;
/// The equilibrium cables pull along one line when the sine of the angle between them is smaller than this: rounding of
/// the directions, 4e-16, would leave less than four digits of their tensions.
const ONE_LINE: f64 = 1e-12;
/// Newton's method gives up after this many steps; it needs 5 from a straight line.
const NEWTON_STEPS: usize = 40;
/// A residual below this part of the size of its equations is rounding. A larger limit would be wrong: where the equilibrium
/// cables pull nearly along one line, a residual of 1e-11 can be left although there is no solution.
const SOLVED: f64 = 1e-13;
/// A residual is also rounding where a change of the unknowns by this part of them makes as much. Rounding turns an element
/// that carries next to nothing, and then the residual can be far above [`SOLVED`].
const ROUNDING_OF_UNKNOWNS: f64 = 4.0 * f64::EPSILON;
/// Newton's method goes on beyond its usual number of steps where the residual is below this.
const NEARLY_SOLVED: f64 = 1e-10;
/// The smallest step of the cables' weight, as a part of the whole.
const SMALLEST_STEP: f64 = 1e-7;
/// At most this many steps of the weight.
const WEIGHT_STEPS: usize = 2000;

/// The static shape of one cable.
#[derive(Clone, Debug, PartialEq)]
pub struct CableShape {
    /// The force t₀ of the element at the platform, on the platform's side, in newtons.
    pub t0: Vec2,
    /// The unstretched length L, in metres.
    pub length: f64,
    /// Positions of the n + 1 nodes from the platform to the winch, in metres.
    pub nodes: Vec<Vec2>,
    /// Forces `t_k` of the n elements, pointing away from the platform, in newtons.
    pub forces: Vec<Vec2>,
    /// |t₀ − (0, μ g l/2)|, in newtons.
    pub tension_at_platform: f64,
    /// |t_{n−1} + (0, μ g l/2)|, in newtons.
    pub tension_at_winch: f64,
}

/// The robot at rest at a pose: every cable's shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Statics {
    /// The platform's position, in metres.
    pub position: Vec2,
    /// One shape per cable, in the robot's order.
    pub cables: Vec<CableShape>,
}

/// Why a pose has no taut equilibrium. Cables are 0-based here and told 1-based.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Infeasible {
    /// The platform sits on a winch point.
    #[error("the platform is at the winch of cable {}", cable + 1)]
    AtAnchor {
        /// The cable.
        cable: usize,
    },
    /// A tension law gives no positive tension here.
    #[error("the tension law of cable {} gives {tension:.3} N here; a cable can only pull", cable + 1)]
    NoTension {
        /// The cable.
        cable: usize,
        /// The law's value, in newtons.
        tension: f64,
    },
    /// The prescribed tension cannot carry the cable's own weight over this span.
    #[error("cable {} cannot hold its own weight over this span with {tension:.1} N at the platform", cable + 1)]
    TooSlack {
        /// The cable.
        cable: usize,
        /// The prescribed tension, in newtons.
        tension: f64,
    },
    /// An equilibrium cable would have to push.
    #[error("cable {} would have to push ({:.1} N along its line)", cable + 1, tension.abs())]
    WouldPush {
        /// The cable.
        cable: usize,
        /// The tension of its straight line in the platform's balance, in newtons: not positive.
        tension: f64,
    },
    /// The two equilibrium cables pull along one line and cannot balance the platform.
    #[error("cables {} and {} pull along one line here, so they cannot hold the platform", cables[0] + 1, cables[1] + 1)]
    OneLine {
        /// The two cables.
        cables: [usize; 2],
    },
    /// The equilibrium cables cannot carry their own weight here.
    #[error("cable {} would go slack under its own weight", cable + 1)]
    GoesSlack {
        /// The cable with the smallest tension for its length.
        cable: usize,
    },
}

/// Why there are no statics at a pose.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StaticsError {
    /// No taut equilibrium exists.
    #[error(transparent)]
    Infeasible(#[from] Infeasible),
    /// An equilibrium may exist but was not found.
    #[error("the static shape of cable {} could not be computed", cable + 1)]
    NotConverged {
        /// The cable, 0-based.
        cable: usize,
    },
    /// The shapes were found, but their motion or their vibration leaves the range of floating point.
    #[error("the motion or the vibration of this robot cannot be computed in floating point")]
    OutOfRange,
}

impl StaticsError {
    /// What the statics say: `false` where there is no taut equilibrium, `true` where there is one but the rest could not
    /// be computed, `None` where that is not known.
    pub fn feasible(&self) -> Option<bool> {
        match self {
            Self::Infeasible(_) => Some(false),
            Self::NotConverged { .. } => None,
            Self::OutOfRange => Some(true),
        }
    }

    /// The cable to blame, 0-based, where it is one.
    pub fn cable(&self) -> Option<usize> {
        Some(match *self {
            Self::OutOfRange => return None,
            Self::NotConverged { cable } => cable,
            Self::Infeasible(reason) => match reason {
                Infeasible::AtAnchor { cable }
                | Infeasible::NoTension { cable, .. }
                | Infeasible::TooSlack { cable, .. }
                | Infeasible::WouldPush { cable, .. }
                | Infeasible::GoesSlack { cable } => cable,
                Infeasible::OneLine { cables } => cables[0],
            },
        })
    }
}

/// Statics that failed, with the shapes that could be found all the same.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason}")]
pub struct Failure {
    /// Why.
    pub reason: StaticsError,
    /// The shapes of those cables that have one.
    pub cables: Vec<Option<CableShape>>,
}

/// Static equilibrium of `robot` with its platform at `position`.
///
/// Ends meet anchors and forces balance to rounding. The result depends on nothing but the arguments.
///
/// # Errors
/// [`Infeasible`] with the reason and the cable; `NotConverged` where an iteration failed.
pub fn solve(robot: &Robot, position: Vec2) -> Result<Statics, Failure> {
    let shape = |i, (t0, length)| CableModel::<f64>::of(robot, i).shape(position, t0, length);
    let mut shapes: Vec<Option<CableShape>> = vec![None; robot.cables.len()];
    // Every cable that has a shape gets one, so that as much as possible can be drawn; the first fault counts.
    let mut fault = None;
    for i in robot.prescribed() {
        match prescribed(robot, i, position) {
            Ok(end) => shapes[i] = Some(shape(i, end)),
            Err(reason) => fault = fault.or(Some(reason)),
        }
    }
    let reason = match fault {
        Some(reason) => reason,
        None => match equilibrium(robot, position, load(robot, &shapes)) {
            Ok(ends) => {
                for (&i, end) in robot.equilibrium().iter().zip(ends) {
                    shapes[i] = Some(shape(i, end));
                }
                let cables = shapes.into_iter().flatten().collect();
                return Ok(Statics { position, cables });
            }
            Err(reason) => reason,
        },
    };
    Err(Failure { reason, cables: shapes })
}

/// What the equilibrium cables have to balance: minus the platform's weight and the forces of the prescribed cables, those
/// that have a shape.
fn load(robot: &Robot, shapes: &[Option<CableShape>]) -> Vec2 {
    let own_weight = Vec2::new(0.0, robot.platform_mass * robot.gravity);
    let prescribed = shapes.iter().enumerate().filter_map(|(i, shape)| Some((i, shape.as_ref()?)));
    prescribed.fold(own_weight, |load, (i, shape)| {
        let force = CableModel::<f64>::of(robot, i).platform_force([shape.t0.x, shape.t0.y], shape.length);
        load - Vec2::from(force)
    })
}

impl CableModel<f64> {
    /// The shape of the cable that leaves the platform with t₀.
    fn shape(&self, position: Vec2, t0: Vec2, length: f64) -> CableShape {
        let mut nodes = vec![position];
        let mut forces = Vec::with_capacity(self.elements);
        self.walk(position.into(), t0.into(), length, |t, r| {
            forces.push(Vec2::from(t));
            nodes.push(Vec2::from(r));
        });
        let half = Vec2::new(0.0, 0.5 * self.weight * length / self.elements as f64);
        let last = forces[forces.len() - 1];
        CableShape {
            t0,
            length,
            nodes,
            forces,
            tension_at_platform: (t0 - half).norm(),
            tension_at_winch: (last + half).norm(),
        }
    }
}

/// The vector from the platform to the anchor of cable i and its length.
fn chord(robot: &Robot, i: usize, position: Vec2) -> Result<(Vec2, f64), Infeasible> {
    let chord = robot.cables[i].anchor - position;
    let distance = chord.norm();
    if distance < AT_ANCHOR { Err(Infeasible::AtAnchor { cable: i }) } else { Ok((chord, distance)) }
}

/// (t₀, L) of the prescribed cable i.
fn prescribed(robot: &Robot, i: usize, position: Vec2) -> Result<(Vec2, f64), StaticsError> {
    let (material, dual_cable) = (Material::of(robot, i), CableModel::of(robot, i));
    let (chord, distance) = chord(robot, i, position)?;
    let tension = prescribed_tension(robot.cables[i].tension, position.into());
    if !(tension > 0.0 && tension.is_finite()) {
        return Err(Infeasible::NoTension { cable: i, tension }.into());
    }
    let straight = chord * (tension / distance);
    let start = SVector::from([straight.x, straight.y, distance / material.stretch(tension)]);
    let scale = SVector::from([distance, distance, tension]);
    let residual = |part: f64, z: SVector<DualSVec64<3>, 3>| {
        let tension = DualSVec64::from(tension);
        let position = [DualSVec64::from(position.x), DualSVec64::from(position.y)];
        SVector::from(dual_cable.with_weight(part).prescribed_residual(position, tension, z.into()))
    };
    let z = turn_weight_on(start, &scale, residual, |z| z[2] > 0.0).map_err(|stop| match stop {
        Stop::Fold { .. } => Infeasible::TooSlack { cable: i, tension }.into(),
        Stop::Failed => StaticsError::NotConverged { cable: i },
    })?;
    Ok((Vec2::new(z[0], z[1]), z[2]))
}

/// (t₀, L) of the equilibrium cables, which together pull with `load`.
fn equilibrium(robot: &Robot, position: Vec2, load: Vec2) -> Result<Vec<(Vec2, f64)>, StaticsError> {
    let cables = robot.equilibrium();
    let models: Vec<CableModel<f64>> = cables.iter().map(|&i| CableModel::of(robot, i)).collect();
    let dual_models: Vec<_> = cables.iter().map(|&i| CableModel::of(robot, i)).collect();
    let chords: Vec<(Vec2, f64)> = cables.iter().map(|&i| chord(robot, i, position)).collect::<Result<_, _>>()?;
    let directions: Vec<Vec2> = chords.iter().map(|&(chord, distance)| chord / distance).collect();
    let tensions = straight_tensions(robot, &directions, load)?;
    let start = SVector::from_fn(|i, _| {
        let (k, tension) = (i / 3, tensions[i / 3]);
        match i % 3 {
            2 => chords[k].1 / models[k].material.stretch(tension),
            axis => directions[k][axis] * tension,
        }
    });
    let force = tensions.iter().copied().fold(0.0, f64::max);
    let scale = SVector::from_fn(|i, _| chords.get(i / 2).map_or(force, |&(_, distance)| distance));
    let residual = |part: f64, z: SVector<DualSVec64<POINT>, POINT>| {
        let dual = |v: Vec2| [DualSVec64::from(v.x), DualSVec64::from(v.y)];
        let models: Vec<_> = dual_models.iter().map(|cable| cable.with_weight(part)).collect();
        SVector::from(CableModel::equilibrium_residual::<POINT>(&models, dual(position), dual(load), z.into()))
    };
    let each = |z: &SVector<f64, POINT>| -> Vec<(Vec2, f64)> {
        z.as_slice().chunks_exact(3).map(|z| (Vec2::new(z[0], z[1]), z[2])).collect()
    };
    let admissible = |z: &SVector<f64, POINT>| each(z).iter().all(|&(_, length)| length > 0.0);
    match turn_weight_on(start, &scale, residual, admissible) {
        Ok(z) => Ok(each(&z)),
        Err(Stop::Fold { last }) => {
            // The slackest one has the smallest tension for its length; of equal ones it is the last.
            let tautness = each(&last)
                .into_iter()
                .zip(&models)
                .map(|((t0, length), cable)| Vec2::from(cable.platform_force([t0.x, t0.y], length)).norm() / length);
            let slackest = cables.iter().zip(tautness).rev().min_by(|a, b| a.1.total_cmp(&b.1));
            Err(Infeasible::GoesSlack { cable: slackest.map_or(cables[0], |(&cable, _)| cable) }.into())
        }
        Err(Stop::Failed) => Err(StaticsError::NotConverged { cable: cables[0] }),
    }
}

/// The tensions of the two straight cables without weight that hold a point: T₁ e₁ + T₂ e₂ = `load`, for the unit vectors
/// `directions`.
pub(super) fn straight_tensions(robot: &Robot, directions: &[Vec2], load: Vec2) -> Result<[f64; 2], Infeasible> {
    let cables = [robot.equilibrium()[0], robot.equilibrium()[1]];
    let (e_a, e_b) = (directions[0], directions[1]);
    let sine = e_a.perp(&e_b);
    let tensions = [load.perp(&e_b) / sine, e_a.perp(&load) / sine];
    // Nearly collinear, or so that the tensions leave every scale of the materials.
    let stiffest = robot.axial_stiffness(cables[0]).max(robot.axial_stiffness(cables[1]));
    let largest = 1e9 * stiffest.max(load.norm());
    if sine.abs() < ONE_LINE || !tensions.iter().all(|tension| tension.abs() < largest) {
        return Err(Infeasible::OneLine { cables });
    }
    let weakest = usize::from(tensions[1] <= tensions[0]);
    if tensions[weakest] <= 0.0 {
        return Err(Infeasible::WouldPush { cable: cables[weakest], tension: tensions[weakest] });
    }
    Ok(tensions)
}

/// Why the taut shape could not be followed to full weight.
enum Stop<const N: usize> {
    /// It meets a slack shape and ends before; the last unknowns on it.
    Fold { last: SVector<f64, N> },
    /// Numbers left the range of floating point.
    Failed,
}

/// Follows the solution of F(s, z) = 0 from the straight `start` at s = 0 to s = 1, s the part of the cables' weight.
///
/// `scale` is the size of each equation. A step is taken where Newton's method converges to a shape that is
/// `admissible` and has the same sign of the Jacobian's determinant as the start; the first one tried is the whole.
fn turn_weight_on<const N: usize>(
    start: SVector<f64, N>,
    scale: &SVector<f64, N>,
    residual: impl Fn(f64, SVector<DualSVec64<N>, N>) -> SVector<DualSVec64<N>, N>,
    admissible: impl Fn(&SVector<f64, N>) -> bool,
) -> Result<SVector<f64, N>, Stop<N>>
where
    Const<N>: ToTypenum + nalgebra::DimMin<Const<N>, Output = Const<N>>,
{
    let (_, straight_jacobian) = jacobian(|z| residual(0.0, z), &start);
    let orientation = straight_jacobian.determinant();
    if !orientation.is_finite() || orientation == 0.0 {
        return Err(Stop::Failed);
    }
    let (mut part, mut step, mut last) = (0.0_f64, 1.0_f64, start);
    let mut before: Option<(f64, SVector<f64, N>)> = None;
    for _ in 0..WEIGHT_STEPS {
        let next = (part + step).min(1.0);
        // From the second step on, the guess continues the line through the last two shapes.
        let guess = before.map_or(last, |(s, z)| last + (last - z) * ((next - part) / (part - s)));
        let found = newton(guess, scale, |z| residual(next, z))
            .filter(|(z, jacobian)| admissible(z) && jacobian.determinant() * orientation.signum() > 0.0);
        match found {
            Some((z, _)) if next >= 1.0 => return Ok(z),
            Some((z, _)) => {
                before = Some((part, last));
                (part, last, step) = (next, z, 2.0 * step);
            }
            None => {
                step *= 0.25;
                // Near the straight start the weight that matters may be far smaller than near full weight.
                if step < SMALLEST_STEP * part.max(SMALLEST_STEP) {
                    return Err(Stop::Fold { last });
                }
            }
        }
    }
    Err(Stop::Fold { last })
}

/// A solution of F(z) = 0 near `z` and the Jacobian there, by damped Newton's method down to rounding.
fn newton<const N: usize>(
    mut z: SVector<f64, N>,
    scale: &SVector<f64, N>,
    residual: impl Fn(SVector<DualSVec64<N>, N>) -> SVector<DualSVec64<N>, N>,
) -> Option<(SVector<f64, N>, OMatrix<f64, Const<N>, Const<N>>)>
where
    Const<N>: ToTypenum + nalgebra::DimMin<Const<N>, Output = Const<N>>,
{
    let evaluate = |z: &SVector<f64, N>| {
        let (f, j) = jacobian(&residual, z);
        let size = f.component_div(scale).norm();
        (f, j, size)
    };
    let solved = |z: &SVector<f64, N>, j: &OMatrix<f64, Const<N>, Const<N>>, size: f64| {
        size < SOLVED || size < ROUNDING_OF_UNKNOWNS * (j.abs() * z.abs()).component_div(scale).norm()
    };
    let (mut f, mut j, mut size) = evaluate(&z);
    for steps in 0..2 * NEWTON_STEPS {
        // Near the line through both anchors Newton's method is slow. A nearly solved problem goes on to rounding.
        if !size.is_finite() || (steps >= NEWTON_STEPS && size >= NEARLY_SOLVED) {
            return None;
        }
        let lu = j.lu();
        let step = lu.solve(&f)?;
        let mut damping = 1.0;
        let (next, values) = loop {
            let next = z - step * damping;
            let values = evaluate(&next);
            if values.2 < (1.0 - 0.25 * damping) * size {
                break (next, values);
            }
            damping *= 0.5;
            if damping < 1e-3 {
                // No part of the step makes the residual smaller. Where cables pull nearly along one line, large changes of
                // their tensions hide in small residuals. There the whole step is right if it makes the next step smaller.
                // Otherwise the residual is rounding, or there is no solution here.
                let next = z - step;
                let values = evaluate(&next);
                let after = lu.solve(&values.0)?;
                if relative(&after, &z) < 0.5 * relative(&step, &z) {
                    break (next, values);
                }
                return solved(&z, &j, size).then_some((z, j));
            }
        };
        z = next;
        (f, j, size) = values;
    }
    solved(&z, &j, size).then_some((z, j))
}

/// How large a `change` of the unknowns `z` is: the largest ratio to a cable's force or length.
fn relative<const N: usize>(change: &SVector<f64, N>, z: &SVector<f64, N>) -> f64 {
    let parts = (0..N).step_by(3).map(|i| {
        let force = change[i].hypot(change[i + 1]) / z[i].hypot(z[i + 1]);
        force.max((change[i + 2] / z[i + 2]).abs())
    });
    parts.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Cable, CableMaterial, RobotSpec, Strain, TensionLaw, paper, paper_spec};

    /// The platform near an anchor and far from the origin: positions have 1e-15 m of rounding, the cable 1e-6 m.
    #[test]
    fn a_platform_near_an_anchor_has_a_shape_up_to_a_micrometre() {
        let robot = paper().expect("the paper's robot");
        for gap in [1e-2, 1e-4, 1e-5, 1e-6] {
            let position = robot.cables[1].anchor - Vec2::new(gap, gap);
            let statics = solve(&robot, position).unwrap_or_else(|failure| panic!("{gap} m away: {failure}"));
            let shape = &statics.cables[1];
            let stretched = gap * std::f64::consts::SQRT_2;
            // So short a cable is straight: its length follows from its tension alone.
            let expected = stretched / Material::of(&robot, 1).stretch(shape.tension_at_platform);
            let error = (shape.length / expected - 1.0).abs();
            assert!(error < 1e-3 * gap.max(1e-5) + 4e-15 / gap, "{gap} m away: {error}");
        }
    }

    /// A platform of half a gram holds a cable of 4 kg whose middle element carries less and less: rounding turns it by more
    /// than it moves anything else.
    #[test]
    fn a_shape_is_found_where_an_element_carries_next_to_nothing() {
        let cable = |x, y, tension| Cable::new([x, y], tension);
        let robot = Robot::new(RobotSpec {
            material: CableMaterial {
                youngs_modulus: 1.84e6,
                area: 5e-5,
                mass_per_length: 0.128,
                strain: Strain::Engineering,
            },
            platform_mass: 4.84e-4,
            cables: vec![
                cable(-9.81, -2.125, TensionLaw::Equilibrium),
                cable(-0.142, 5.528, TensionLaw::Equilibrium),
                cable(
                    -0.217,
                    -6.563,
                    TensionLaw::Hypot { horizontal: [38.62, 0.70, -1.00], vertical: [62.64, 1.43, 0.86] },
                ),
                cable(0.236, 1.874, TensionLaw::Constant(17.38)),
            ],
            elements: 3,
            ..paper_spec()
        })
        .expect("a legal robot");
        let (towards, first) = (Vec2::new(-0.906, 0.423), Vec2::new(0.047_78, 1.348_56));
        // The force falls to zero at k = −11.
        for k in -8..100 {
            let position = first + towards * 1e-6 * f64::from(k);
            let statics = solve(&robot, position).unwrap_or_else(|failure| panic!("{position:?}: {failure}"));
            let middle = statics.cables[0].forces[1].norm();
            assert!(middle < 0.01, "{middle} N at {position:?}");
        }
        let beyond = solve(&robot, first - towards * 1e-4).expect_err("beyond the end").reason;
        assert_eq!(beyond, Infeasible::GoesSlack { cable: 0 }.into());
    }

    /// Two cables pull down against a third: the heavier they are, the less is left for them to pull with. Of two at equal
    /// angles the longer one sags to its end first, of two at different angles the flatter one, which pulls less.
    #[test]
    fn the_cable_with_the_smaller_tension_for_its_length_goes_slack() {
        for (slack, anchors) in [
            (0, [[-2.0, -2.0], [1.0, -1.0]]),
            (1, [[-1.0, -1.0], [2.0, -2.0]]),
            (1, [[-0.5, -2.0], [1.0, -1.0]]),
            (0, [[-1.0, -1.0], [0.5, -2.0]]),
        ] {
            let cables = vec![
                Cable::new(anchors[0], TensionLaw::Equilibrium),
                Cable::new(anchors[1], TensionLaw::Equilibrium),
                Cable::new([0.0, 5.0], TensionLaw::Constant(20.0)),
            ];
            let robot = |mass_per_length| {
                let material = CableMaterial { mass_per_length, ..paper_spec().material };
                let spec = RobotSpec { material, platform_mass: 0.1, cables: cables.clone(), ..paper_spec() };
                Robot::new(spec).expect("a legal robot")
            };
            // 19 N are for them, and half of what they weigh hangs from the platform: 2 N, and 20 N or more.
            assert!(solve(&robot(0.1), Vec2::zeros()).is_ok(), "{anchors:?}");
            let reason = solve(&robot(1.2), Vec2::zeros()).expect_err("no force left").reason;
            assert_eq!(reason, Infeasible::GoesSlack { cable: slack }.into(), "{anchors:?}");
        }
    }

    /// Of 5 N and 2 m, and of 13 N and 4 m.
    #[test]
    fn a_change_is_measured_in_parts_of_forces_and_lengths() {
        let z = SVector::from([3.0, -4.0, 2.0, 5.0, 12.0, 4.0]);
        for (change, part) in [
            ([0.6, 0.8, 0.1, 0.1, 0.0, 0.2], 0.2),
            ([0.0, 0.1, -0.6, 0.1, 0.0, 0.2], 0.3),
            ([0.0, 0.1, 0.6, -1.2, 5.0 * 1.04, 0.2], 5.336_665_625_65 / 13.0),
            ([0.0, 0.1, 0.6, 0.1, 0.5, 2.0], 0.5),
        ] {
            let found = relative(&SVector::from(change), &z);
            assert!((found - part).abs() < 1e-9, "{found}, not {part}");
        }
    }

    #[test]
    fn a_law_without_tension_is_named() {
        let mut spec = paper_spec();
        spec.cables[2].tension = TensionLaw::Hypot { horizontal: [0.0, 60.0, 0.0], vertical: [0.0, 80.0, 0.0] };
        let robot = Robot::new(spec).expect("a legal robot");
        assert!(solve(&robot, Vec2::new(1.0, 0.0)).is_ok(), "100 N");
        let reason = solve(&robot, Vec2::zeros()).expect_err("0 N").reason;
        assert_eq!(reason, Infeasible::NoTension { cable: 2, tension: 0.0 }.into());
    }
}
