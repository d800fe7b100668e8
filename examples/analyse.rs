//! One robot at one pose: its static shape, its eigenvalues at one speed, its critical speed.
//!
//! `cargo run --release --example analyse` prints:
//!
//! ```text
//! cable 1: 1.1169 m unstretched, 22.23 N at the platform, +1.790 m/s
//! cable 2: 0.7800 m unstretched, 27.85 N at the platform, -1.535 m/s
//! cable 3: 1.1174 m unstretched, 12.00 N at the platform, +1.788 m/s
//! cable 4: 0.7806 m unstretched, 12.00 N at the platform, -1.536 m/s
//! at 2 m/s the largest growth rate is -0.698 1/s, and the slowest modes are
//!   22.393 Hz with the growth rate -0.698 1/s
//!   32.356 Hz with the growth rate -0.913 1/s
//!   58.808 Hz with the growth rate -2.665 1/s
//! critical speed: 6.707 m/s, Flutter at 84.15 Hz in cable 4
//! ```

use std::error::Error;
use std::io::{self, Write};

use tautline::robot::{Cable, CableMaterial, Damping, Linearisation, RobotSpec, Strain, TensionLaw};
use tautline::stability::Outcome;
use tautline::{LocalProblem, Motion, Robot};

/// The critical speed is searched from rest up to this speed, in m/s.
const LIMIT: f64 = 40.0;

fn main() -> Result<(), Box<dyn Error>> {
    write(&mut io::stdout())
}

/// Writes what the program prints.
///
/// # Errors
/// A robot or a motion that is not physical, a pose without a taut equilibrium, an output that takes nothing.
pub fn write(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    let cable = |x, y, tension| Cable::new([x, y], tension);
    // `Robot::new` checks all of it and names every fault: whatever is a `Robot` is physical. SI units everywhere.
    let robot = Robot::new(RobotSpec {
        gravity: 9.81,
        material: CableMaterial { youngs_modulus: 30e9, area: 0.7e-6, mass_per_length: 0.7e-3, strain: Strain::Green },
        platform_mass: 1.5,
        // The upper two cables hold the platform. The lower two have winches that keep a constant tension.
        cables: vec![
            cable(-0.8, 1.0, TensionLaw::Equilibrium),
            cable(0.8, 1.0, TensionLaw::Equilibrium),
            cable(-0.8, 0.0, TensionLaw::Constant(12.0)),
            cable(0.8, 0.0, TensionLaw::Constant(12.0)),
        ],
        elements: 10,
        damping: Damping { alpha: 1.0, beta: 2e-5 },
        linearisation: Linearisation::Tangent,
    })?;
    // At (0.2, 0.5) m, to the right at 2 m/s.
    let motion = Motion::new([0.2, 0.5], [1.0, 0.0], 2.0)?;

    // All that does not depend on the speed. A pose without a taut equilibrium is an error that names the cable.
    let local = LocalProblem::new(&robot, &motion).map_err(|failure| failure.reason)?;
    for (number, (shape, rate)) in local.statics.cables.iter().zip(&local.rates).enumerate() {
        writeln!(
            out,
            "cable {}: {:.4} m unstretched, {:.2} N at the platform, {:+.3} m/s",
            number + 1,
            shape.length,
            shape.tension_at_platform,
            motion.speed() * rate.first, // L̇ = v L′: negative where the winch reels in
        )?;
    }

    let spectrum = local.spectrum(motion.speed())?;
    let growth = spectrum.growth_rate();
    writeln!(out, "at {} m/s the largest growth rate is {growth:.3} 1/s, and the slowest modes are", motion.speed())?;
    // Overdamped modes have no frequency.
    for mode in spectrum.modes().filter(|mode| mode.eigenvalue.im > 0.0).take(3) {
        writeln!(out, "  {:.3} Hz with the growth rate {:.3} 1/s", mode.frequency_hz(), mode.eigenvalue.re)?;
    }

    match local.critical_speed(LIMIT)? {
        Outcome::Found(critical) => writeln!(
            out,
            "critical speed: {:.3} m/s, {:?} at {:.2} Hz in cable {}",
            critical.speed,
            critical.kind,
            critical.frequency_hz(),
            critical.cable + 1,
        )?,
        Outcome::NoneUpTo(limit) => writeln!(out, "stable at every speed up to {limit} m/s")?,
    }
    Ok(())
}
