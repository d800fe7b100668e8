//! One step in time: Alexander's three-stage SDIRK method of order 3, L-stable, whose last stage is the end of the step.
//!
//! Each stage is one non-linear equation, solved by Newton's method. Its matrix M + γh (C + D) + (γh)² (K + `K_dyn`) is that of
//! the small vibrations at a real λ = 1/(γh), so that it is eliminated along the cables in O(n). R. Alexander, SIAM J.
//! Numer. Anal. 14 (1977), 1006–1021. docs/theory.md section 14.

use super::equations::{Instant, Nodes, State, add, largest, plus};

/// γ, the root of x³ − 3x² + 3x/2 − 1/6 with which the method is L-stable.
pub(super) const GAMMA: f64 = 0.435_866_521_508_459;
/// What each stage takes of those before it, and γ of itself.
pub(super) const STAGES: [[f64; 3]; 3] = [[GAMMA, 0.0, 0.0], [0.5 * (1.0 - GAMMA), GAMMA, 0.0], WEIGHTS];
/// The last stage is the end of the step.
const WEIGHTS: [f64; 3] =
    [-0.25 * (6.0 * GAMMA * GAMMA - 16.0 * GAMMA + 1.0), 0.25 * (6.0 * GAMMA * GAMMA - 20.0 * GAMMA + 5.0), GAMMA];
/// When the stages are, as parts of the step.
pub(super) const TIMES: [f64; 3] = [GAMMA, 0.5 * (1.0 + GAMMA), 1.0];
/// The weights of order 2 that use the first two stages alone.
const EMBEDDED: [f64; 3] = [GAMMA / (1.0 - GAMMA), (1.0 - 2.0 * GAMMA) / (1.0 - GAMMA), 0.0];
/// Newton's method needs 2 or 3 iterations where the step is as it should be.
const ITERATIONS: usize = 10;
/// Positions cannot be found better than to this part of the robot's size.
const ROUNDING: f64 = 1e-14;

/// What a step leads to.
pub(super) struct Stepped {
    /// The state at its end.
    pub state: State,
    /// r̈ there.
    pub accelerations: Nodes,
    /// The positions of order 3 less those of order 2, in m.
    pub error: Nodes,
}

/// One step of `h` seconds, given the equations at the time of each stage.
///
/// `guess` is about what r̈ is. Positions of the stages are found to `tolerance` in m, or to rounding. `None` where Newton's
/// method fails.
pub(super) fn step(from: &State, h: f64, stages: &[Instant; 3], guess: &Nodes, tolerance: f64) -> Option<Stepped> {
    let g = GAMMA * h;
    let tolerance = tolerance.max(ROUNDING * largest(&from.positions));
    let mut error = plus(guess, -1.0, guess);
    // What stands at each stage before its own r̈ is added.
    let mut bases = [from.clone(), from.clone(), from.clone()];
    let mut accelerations = guess.clone();
    for (i, stage) in stages.iter().enumerate() {
        let base = &mut bases[i];
        // r = base + g ṙ, ṙ = base + g r̈.
        add(&mut base.positions, g, &base.velocities.clone());
        let state = solve(stage, base, g, &mut accelerations, tolerance)?;
        add(&mut error, h * (WEIGHTS[i] - EMBEDDED[i]), &state.velocities);
        for (j, base) in bases.iter_mut().enumerate().skip(i + 1) {
            add(&mut base.positions, h * STAGES[j][i], &state.velocities);
            add(&mut base.velocities, h * STAGES[j][i], &accelerations);
        }
        if i + 1 == stages.len() {
            return Some(Stepped { state, accelerations, error });
        }
    }
    None
}

/// Newton's method for the accelerations of a stage, whose state is `base` with g² and g times these added.
fn solve(stage: &Instant, base: &State, g: f64, accelerations: &mut Nodes, tolerance: f64) -> Option<State> {
    let state = |accelerations: &Nodes| State {
        positions: plus(&base.positions, g * g, accelerations),
        velocities: plus(&base.velocities, g, accelerations),
    };
    let mut before = f64::INFINITY;
    for _ in 0..ITERATIONS {
        let here = state(accelerations);
        let change = stage.matrix(&here.positions, g).solve(&stage.residual(&here, accelerations));
        add(accelerations, -1.0, &change);
        let size = g * g * largest(&change);
        if !size.is_finite() || size > 2.0 * before {
            return None;
        }
        if size <= tolerance {
            return Some(state(accelerations));
        }
        before = size;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The conditions of order 3, and those of order 2 for the embedded weights.
    #[test]
    fn the_method_has_the_orders_that_it_should() {
        let g = GAMMA;
        assert!((g * g * g - 3.0 * g * g + 1.5 * g - 1.0 / 6.0).abs() < 1e-16);
        let sum = |weights: [f64; 3], of: [f64; 3]| (0..3).map(|i| weights[i] * of[i]).sum::<f64>();
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} {b}");
        for i in 0..3 {
            close(STAGES[i].iter().sum(), TIMES[i]);
        }
        for weights in [WEIGHTS, EMBEDDED] {
            close(sum(weights, [1.0; 3]), 1.0);
            close(sum(weights, TIMES), 0.5);
        }
        close(sum(WEIGHTS, TIMES.map(|c| c * c)), 1.0 / 3.0);
        close(sum(WEIGHTS, STAGES.map(|row| sum(row, TIMES))), 1.0 / 6.0);
        // Far left in the complex plane nothing is left of a step: the last stage is the end, and bᵀ A⁻¹ 1 = 1.
        close(STAGES[2][2], WEIGHTS[2]);
    }
}
