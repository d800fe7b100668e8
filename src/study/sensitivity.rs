//! Which parameter to turn: how much the critical speed and the wave limit change with each, in percent per percent.

use crate::mechanics::{self, Knob, Vibration};
use crate::robot::{Damping, Motion, Robot};
use crate::stability::steps::{finish, step};
use crate::stability::{Critical, Crossing, Instability, NoSensitivity};

/// What one parameter does to the crossing, as relative derivatives: percent per percent.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Sensitivity {
    /// The parameter p.
    pub knob: Knob,
    /// d ln `v_c`/d ln p of the critical speed.
    pub speed: f64,
    /// d ln ω/d ln p of the frequency with which stability is lost; none for divergence.
    pub frequency: Option<f64>,
    /// d ln `v_w`/d ln p of the wave limit; none where no cable moves.
    pub wave_limit: Option<f64>,
}

/// The relative derivatives of the critical speed and of the wave limit of `robot` on `motion`, which is that of `critical`, with respect to E,
/// A, μ, m, each prescribed tension (a factor on its law), α, β and g, in this order; 0 for those that are 0.
///
/// Exact to rounding and to the accuracy of `critical`: the dependence of the static shapes, of L' and of L'' is in
/// them. They are those of the mode that crosses: where a small change lets another mode cross first, `v_c` has a kink.
/// docs/theory.md section 12.
///
/// # Errors
/// [`NoSensitivity`], where the critical speed is 0 or has no derivative.
pub fn sensitivities(robot: &Robot, motion: &Motion, critical: &Critical) -> Result<Vec<Sensitivity>, NoSensitivity> {
    finish(sensitivities_in_steps(robot, motion, critical))
}

/// The same in [steps](crate::stability::steps) of one parameter.
///
/// # Errors
/// As [`sensitivities`].
pub async fn sensitivities_in_steps(
    robot: &Robot,
    motion: &Motion,
    critical: &Critical,
) -> Result<Vec<Sensitivity>, NoSensitivity> {
    let out_of_range = NoSensitivity::OutOfRange;
    let statics = mechanics::solve(robot, motion.position()).map_err(|_| out_of_range)?;
    let rates = mechanics::length_rates(robot, &statics, motion.direction()).ok_or(out_of_range)?;
    let vibration = Vibration::new(robot, &statics, &rates).ok_or(out_of_range)?;
    step().await;
    let crossing = Crossing::new(&vibration, critical)?;
    let damping = robot.damping;
    let waves = mechanics::wave_limit(robot, &statics, &rates);
    let sensitivity = |knob: Knob| {
        // The shift per unit of ln p. Waves know no damping.
        let (shift, wave_limit) = match knob {
            Knob::Alpha => (crossing.shift_by_damping(Damping { beta: 0.0, ..damping }), waves.map(|_| 0.0)),
            Knob::Beta => (crossing.shift_by_damping(Damping { alpha: 0.0, ..damping }), waves.map(|_| 0.0)),
            _ => {
                let along = Vibration::along(robot, &statics, motion.direction(), knob).ok_or(out_of_range)?;
                let of_waves = waves.and_then(|limit| mechanics::wave_limit_shift(&along, &limit));
                (crossing.shift(&along), of_waves)
            }
        };
        let speed = shift.speed / critical.speed;
        let frequency = (critical.kind == Instability::Flutter).then(|| shift.omega / critical.eigenvalue.im);
        let finite = speed.is_finite() && frequency.is_none_or(f64::is_finite);
        if finite { Ok(Sensitivity { knob, speed, frequency, wave_limit }) } else { Err(out_of_range) }
    };
    let mut found = Vec::new();
    for knob in Knob::all(robot) {
        found.push(sensitivity(knob)?);
        step().await;
    }
    Ok(found)
}
