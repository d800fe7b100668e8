//! The equations of a flight against the model's matrices and against mechanics' own identities, a pendulum, and the order
//! of the method.

use nalgebra::Matrix2;
use num_dual::{Dual64, DualNum};

use super::equations::{Cable, Equations, Nodes, State, platform, plus};
use super::fly::{Steps, fly_by};
use super::quasi_static::{Path, QuasiStatic};
use super::sdirk;
use crate::flight::FlightOptions;
use crate::mechanics::{self, CableMotion, Hub, Material, Matrices, Vibration};
use crate::robot::{
    Damping, Linearisation, OwnMaterial, Profile, Robot, RobotSpec, Side, Strain, Trajectory, Vec2, paper_spec,
};
use crate::steps::finish;

/// The paper's robot with the tangent stiffness, and cables of four materials and both strain laws.
fn mixed() -> Robot {
    let mut spec = RobotSpec { linearisation: Linearisation::Tangent, ..paper_spec() };
    spec.cables[1].own = OwnMaterial { strain: Some(Strain::Engineering), ..OwnMaterial::default() };
    spec.cables[2].own = OwnMaterial { mass_per_length: Some(0.25), ..OwnMaterial::default() };
    spec.cables[3].own = OwnMaterial { youngs_modulus: Some(3e8), ..OwnMaterial::default() };
    Robot::new(spec).expect("a robot")
}

fn along(from: [f64; 2], to: [f64; 2], profile: Profile) -> Trajectory {
    Trajectory::straight(from.into(), &[to.into()], profile).expect("a path")
}

/// Numbers in −1..1 that follow no pattern, at every node.
fn scattered(like: &Nodes, seed: f64) -> Nodes {
    let mut nodes = like.clone();
    let all = nodes.hub.iter_mut().chain(nodes.chains.iter_mut().flatten().flat_map(|node| node.iter_mut()));
    for (k, value) in all.enumerate() {
        *value = 2.0 * ((seed + k as f64) * 0.618_033_988_749_895).fract() - 1.0;
    }
    nodes
}

fn largest(nodes: &Nodes) -> f64 {
    super::equations::largest(nodes)
}

/// What the vibration's matrices make of displacements: `over_nodes` of an element's, `elastic` times its A/l, and `hub` times
/// the platform's mass.
fn apply(
    vibration: &Vibration,
    x: &Nodes,
    over_nodes: impl Fn(&Matrices) -> Matrix2<f64>,
    elastic: f64,
    hub: f64,
) -> Nodes {
    let mut y = plus(x, -1.0, x);
    y.hub += vibration.hub().mass() * &x.hub * hub;
    for (i, chain) in vibration.chains().iter().enumerate() {
        let mut displacements = vec![platform(x)];
        displacements.extend(&x.chains[i]);
        displacements.push(Vec2::zeros());
        for (k, element) in chain.elements().iter().enumerate() {
            let matrices = element.matrices();
            let (over_nodes, ends) = (over_nodes(&matrices), [displacements[k], displacements[k + 1]]);
            for j in 0..2 {
                let mut force = ends[0] * over_nodes[(j, 0)] + ends[1] * over_nodes[(j, 1)];
                force += matrices.elastic * (ends[j] - ends[1 - j]) * elastic;
                match (k + j).checked_sub(1) {
                    None => y.hub += force,
                    Some(node) => {
                        if let Some(node) = y.chains[i].get_mut(node) {
                            *node += force;
                        }
                    }
                }
            }
        }
    }
    y
}

/// About the quasi-static motion at constant speed the equations are those of the small vibrations, with the tangent stiffness:
/// M q̈ + (v C + αM + βK) q̇ + (K + v² D) q.
#[test]
fn small_deviations_meet_the_matrices_of_the_small_vibrations() {
    let robot = mixed();
    let v = 6.0;
    let trajectory = along([1.5, 0.5], [3.0, 2.5], Profile::Constant { speed: v });
    let equations = Equations::new(&robot);
    let at = Path::new(&robot, &trajectory).at(0.0, Side::Right).expect("statics");
    let statics = mechanics::solve(&robot, Vec2::new(1.5, 0.5)).expect("statics");
    let rates = mechanics::length_rates(&robot, &statics, Vec2::new(0.6, 0.8)).expect("rates");
    let vibration = Vibration::new(&robot, &statics, &rates).expect("a problem");
    let (state, instant) = (equations.start(&at), equations.at(&at));
    let Damping { alpha, beta } = robot.damping;
    let still = plus(&state.positions, -1.0, &state.positions);
    for seed in [0.1, 100.3] {
        let x = scattered(&state.positions, seed);
        let residual = |part: f64, which: usize| {
            let by = |j: usize| if which == j { part } else { 0.0 };
            let moved =
                State { positions: plus(&state.positions, by(0), &x), velocities: plus(&state.velocities, by(1), &x) };
            instant.residual(&moved, &plus(&still, by(2), &x))
        };
        // The error of a central difference is the square of ε over an element's length, 1e-10.
        let difference = |which: usize| {
            let epsilon = [1e-5, 1.0, 1.0][which];
            let mut difference = plus(&residual(epsilon, which), -1.0, &residual(-epsilon, which));
            difference = plus(&still, 0.5 / epsilon, &difference);
            difference
        };
        for (which, expected) in [
            (0, apply(&vibration, &x, |m| m.flow * (v * v), 1.0, 0.0)),
            (1, apply(&vibration, &x, |m| m.transfer * v + m.mass * alpha, beta, alpha)),
            (2, apply(&vibration, &x, |m| m.mass, 0.0, 1.0)),
        ] {
            let error = largest(&plus(&difference(which), -1.0, &expected));
            assert!(
                error < 1e-9 * largest(&expected),
                "derivative {which}: off by {error:e} of {:e}",
                largest(&expected)
            );
        }
        // What Newton's method takes for the derivative is just that.
        let g: f64 = 3e-3;
        let slope = plus(&plus(&difference(2), g, &difference(1)), g * g, &difference(0));
        let found = instant.matrix(&state.positions, g).solve(&slope);
        assert!(largest(&plus(&found, -1.0, &x)) < 1e-8);
    }
}

/// T₂ − T₀ + V and T − V, by quadrature along the elements, for what may be dual numbers.
fn energies<D: DualNum<Primitive = f64> + Copy>(
    equations: &Equations,
    positions: impl Fn(usize, usize) -> [D; 2],
    velocities: impl Fn(usize, usize) -> [D; 2],
    lengths: &[[D; 2]],
) -> [D; 2] {
    let norm = |v: [D; 2]| v[0] * v[0] + v[1] * v[1];
    let mass = equations.hub.mass()[(0, 0)];
    let of_platform = norm(velocities(0, 0)) * (0.5 * mass);
    let mut potential = positions(0, 0)[1] * (mass * equations.gravity);
    let (mut kinetic, mut quadratic, mut of_flow) = (of_platform, of_platform, D::from(0.0));
    let n = equations.elements as f64;
    // Gauss's rule with three points is exact here.
    let gauss = [(0.5 - 0.15_f64.sqrt(), 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.5 + 0.15_f64.sqrt(), 5.0 / 18.0)];
    for (i, cable) in equations.cables.iter().enumerate() {
        let [l, rate] = lengths[i].map(|value| value / n);
        let mass = l * cable.mass_per_length;
        for k in 0..equations.elements {
            let [r0, r1] = [positions(i, k), positions(i, k + 1)];
            let [v0, v1] = [velocities(i, k), velocities(i, k + 1)];
            let span = [r1[0] - r0[0], r1[1] - r0[1]];
            for (xi, weight) in gauss {
                let flow = -rate * (k as f64 + xi) / l;
                let own = [0, 1].map(|j| v0[j] * (1.0 - xi) + v1[j] * xi);
                let carried = span.map(|d| flow * d);
                let all = [own[0] + carried[0], own[1] + carried[1]];
                kinetic += norm(all) * mass * (0.5 * weight);
                quadratic += norm(own) * mass * (0.5 * weight);
                of_flow += norm(carried) * mass * (0.5 * weight);
            }
            let stretch = norm(span).sqrt() / l;
            let stiffness = cable.material.axial_stiffness;
            let stored = match cable.material.strain {
                Strain::Green => (stretch * stretch - 1.0).powi(2) * (stiffness / 8.0),
                Strain::Engineering => (stretch - 1.0).powi(2) * (stiffness / 2.0),
            };
            potential += l * stored + (r0[1] + r1[1]) * mass * (0.5 * equations.gravity);
        }
    }
    [quadratic - of_flow + potential, kinetic - potential]
}

/// The equations are Lagrange's, so that H = T₂ − T₀ + V changes by −∂(T − V)/∂t and by the power of the damping, far from the
/// quasi-static state too.
#[test]
fn energy_comes_from_the_winches_and_goes_into_the_damping_alone() {
    let robot = mixed();
    let undamped =
        Robot::new(RobotSpec { damping: Damping { alpha: 0.0, beta: 0.0 }, ..(*robot).clone() }).expect("a robot");
    let trajectory = along([-4.0, 1.0], [5.0, -1.0], Profile::Quintic { speed: 6.0 });
    for time in [0.4, 1.3] {
        let [with, without] = [&robot, &undamped].map(Equations::new);
        let at = Path::new(&robot, &trajectory).at(time, Side::Right).expect("statics");
        let start = with.start(&at);
        let state = State {
            positions: plus(&start.positions, 0.05, &scattered(&start.positions, 3.7)),
            velocities: plus(&start.velocities, 2.0, &scattered(&start.positions, 11.2)),
        };
        let still = plus(&state.positions, -1.0, &state.positions);
        let instant = with.at(&at);
        let residual = instant.residual(&state, &still);
        let accelerations = plus(&still, -1.0, &instant.matrix(&state.positions, 0.0).solve(&residual));
        let damping = plus(&residual, -1.0, &without.at(&at).residual(&state, &still));
        let power = |force: &Nodes| {
            let chains = force.chains.iter().flatten().zip(state.velocities.chains.iter().flatten());
            force.hub.dot(&state.velocities.hub) + chains.map(|(f, v)| f.dot(v)).sum::<f64>()
        };
        let node = |nodes: &Nodes, i: usize, k: usize, last: Vec2| match k.checked_sub(1) {
            None => platform(nodes),
            Some(k) => nodes.chains[i].get(k).copied().unwrap_or(last),
        };
        let moving = |of: &Nodes, rates: Option<&Nodes>, i, k, last| {
            let rate = rates.map_or(Vec2::zeros(), |rates| node(rates, i, k, Vec2::zeros()));
            let value = node(of, i, k, last);
            [0, 1].map(|j| Dual64::new(value[j], rate[j]))
        };
        let lengths: Vec<[Dual64; 2]> = at
            .cables
            .iter()
            .map(|cable| {
                let [l, l1, l2] = cable.length;
                [Dual64::new(l, l1), Dual64::new(l1, l2)]
            })
            .collect();
        let anchor = |i: usize| with.cables[i].anchor;
        let [along_the_motion, held] = [true, false].map(|moves| {
            let rates = |of| moves.then_some(of);
            energies(
                &with,
                |i, k| moving(&state.positions, rates(&state.velocities), i, k, anchor(i)),
                |i, k| moving(&state.velocities, rates(&accelerations), i, k, Vec2::zeros()),
                &lengths,
            )
        });
        let (gained, by_winches, by_damping) = (along_the_motion[0].eps, -held[1].eps, -power(&damping));
        let exchange = by_winches.abs() + by_damping.abs();
        let error = gained - by_winches - by_damping;
        assert!(exchange > 1.0 && error.abs() < 1e-9 * exchange, "{gained} {by_winches} {by_damping}: {error:e}");
    }
}

/// A point on a cable whose length varies, hung from the origin: where it is after two seconds.
fn pendulum(mass_per_length: f64, elements: usize) -> Vec2 {
    let material = Material::new(2e4, Strain::Green).expect("a material");
    let equations = Equations {
        gravity: 9.81,
        damping: Damping { alpha: 0.0, beta: 0.0 },
        cables: vec![Cable { anchor: Vec2::zeros(), material, mass_per_length }],
        elements,
        hub: Hub::point(2.0, 1),
    };
    let moment = along([0.0, 0.0], [1.0, 0.0], Profile::Constant { speed: 1.0 }).at(0.0, Side::Right);
    let direction = pendulum_start() / 3.0;
    let at = |time: f64| {
        let length = pendulum_length(time);
        let node = |k: usize| direction * (length[0] * (1.0 - k as f64 / elements as f64));
        let cable = CableMotion {
            length,
            pull: -direction.normalize(),
            // Without damping it does not matter what these are.
            forces: vec![-direction.normalize(); elements],
            nodes: (0..=elements).map(node).collect(),
            velocities: vec![Vec2::zeros(); elements + 1],
        };
        QuasiStatic { moment, cables: vec![cable] }
    };
    let mut state = equations.start(&at(0.0));
    let mut guess = plus(&state.positions, -1.0, &state.positions);
    let h = 5e-4;
    for k in 0..4000 {
        let motions = sdirk::TIMES.map(|part| at((f64::from(k) + part) * h));
        let stages = [0, 1, 2].map(|i| equations.at(&motions[i]));
        let next = sdirk::step(&state, h, &stages, &guess, 1e-13).expect("a step");
        (state, guess) = (next.state, next.accelerations);
    }
    platform(&state.positions)
}

/// Where the cable, of 3 m, carries the platform's weight in its own direction, so that it hardly swings along it.
fn pendulum_start() -> Vec2 {
    let material = Material::new(2e4, Strain::Green).expect("a material");
    Vec2::new(0.6, -0.8) * (3.0 * material.stretch(2.0 * 9.81 * 0.8))
}

fn pendulum_length(time: f64) -> [f64; 3] {
    let (amplitude, rate) = (0.3, 1.3);
    let (sine, cosine) = (rate * time).sin_cos();
    [3.0 - amplitude * (1.0 - cosine), -amplitude * rate * sine, -amplitude * rate * rate * cosine]
}

/// A platform on a cable without mass: the spring of varying unstretched length, by Runge and Kutta's method.
fn spring() -> Vec2 {
    let material = Material::new(2e4, Strain::Green).expect("a material");
    let slope = |time: f64, [r, v]: [Vec2; 2]| {
        let force = material.force(r.norm() / pendulum_length(time)[0]);
        [v, r.normalize() * (-force / 2.0) - Vec2::new(0.0, 9.81)]
    };
    let (steps, mut state) = (200_000, [pendulum_start(), Vec2::zeros()]);
    let h = 2.0 / f64::from(steps);
    for k in 0..steps {
        let time = f64::from(k) * h;
        let to = |slope: [Vec2; 2], part: f64| [state[0] + slope[0] * part, state[1] + slope[1] * part];
        let first = slope(time, state);
        let second = slope(time + h / 2.0, to(first, h / 2.0));
        let third = slope(time + h / 2.0, to(second, h / 2.0));
        let fourth = slope(time + h, to(third, h));
        state = [0, 1].map(|j| state[j] + (first[j] + (second[j] + third[j]) * 2.0 + fourth[j]) * (h / 6.0));
    }
    state[0]
}

/// The lighter the cable, the nearer is the pendulum to a point on a spring: by its mass, whatever the mesh.
#[test]
fn a_pendulum_of_varying_length_tends_to_a_point_on_a_spring() {
    let limit = spring();
    for elements in [1, 4] {
        let errors = [1e-3, 1e-4, 1e-5].map(|mass| (pendulum(mass, elements) - limit).norm());
        for pair in errors.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((9.0..11.0).contains(&ratio), "{elements} elements: {errors:?}");
        }
    }
}

/// From one step to half of it the error falls by 2³.
#[test]
fn the_order_in_time_is_three() {
    let robot = Robot::new(RobotSpec { elements: 5, ..paper_spec() }).expect("a robot");
    let trajectory = along([-6.0, 0.0], [6.0, 0.0], Profile::Quintic { speed: 5.0 });
    let options = FlightOptions { hold: 0.5, accuracy: 1e-9, samples: 11, ..FlightOptions::default() };
    let flown = [0.01, 0.005, 0.0025].map(|h| {
        let flight = finish(fly_by(&robot, &trajectory, &options, Steps::Fixed(h))).expect("a flight");
        flight.samples.iter().map(|sample| sample.deviation).collect::<Vec<Vec2>>()
    });
    let difference = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    let order = (difference(&flown[0], &flown[1]) / difference(&flown[1], &flown[2])).log2();
    assert!((2.8..3.3).contains(&order), "{order}");
}
