//! A study that the library does not have: the platform goes round a circle, and each place is asked for the critical
//! speed along the circle's tangent.
//!
//! `cargo run --release --example own_study` prints:
//!
//! ```text
//! ( 1.848,  0.765) m   12.041 m/s, cable 4
//! ( 0.765,  1.848) m   10.428 m/s, cable 4
//! (-0.765,  1.848) m    8.257 m/s, cable 3
//! (-1.848,  0.765) m    9.901 m/s, cable 3
//! (-1.848, -0.765) m   14.458 m/s, cable 4
//! (-0.765, -1.848) m   11.056 m/s, cable 4
//! ( 0.765, -1.848) m   10.119 m/s, cable 4
//! ( 1.848, -0.765) m   16.884 m/s, cable 1
//! the lowest of these is 8.257 m/s at (-0.765, 1.848) m
//! ```

use std::error::Error;
use std::f64::consts::TAU;
use std::io::{self, Write};

use tautline::robot::Vec2;
use tautline::study::{Verdict, verdict};
use tautline::{Motion, robot};

/// The circle's radius in m; its centre is the origin.
const RADIUS: f64 = 2.0;
/// Places on the circle.
const PLACES: u32 = 8;
/// The critical speed is searched from rest up to this speed, in m/s.
const LIMIT: f64 = 40.0;

fn main() -> Result<(), Box<dyn Error>> {
    write(&mut io::stdout())
}

/// Writes what the program prints.
///
/// # Errors
/// A robot or a motion that is not physical, an output that takes nothing.
pub fn write(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    let robot = robot::paper()?;
    let mut slowest: Option<(f64, Vec2)> = None;
    for place in 0..PLACES {
        let (sine, cosine) = (TAU * (f64::from(place) + 0.5) / f64::from(PLACES)).sin_cos();
        let position = RADIUS * Vec2::new(cosine, sine);
        let tangent = Vec2::new(-sine, cosine);
        // The critical speed does not depend on the motion's own speed.
        let (found, _wave_limit) = verdict(&robot, &Motion::new(position, tangent, 0.0)?, LIMIT);
        write!(out, "({:6.3}, {:6.3}) m  ", position.x, position.y)?;
        match found {
            Verdict::Critical(critical) => {
                writeln!(out, "{:7.3} m/s, cable {}", critical.speed, critical.cable + 1)?;
                if slowest.is_none_or(|(speed, _)| critical.speed < speed) {
                    slowest = Some((critical.speed, position));
                }
            }
            Verdict::NoneUpTo(limit) => writeln!(out, "stable up to {limit} m/s")?,
            Verdict::Infeasible => writeln!(out, "no taut equilibrium")?,
            Verdict::Unknown | Verdict::NotConverged => writeln!(out, "could not be computed")?,
        }
    }
    if let Some((speed, position)) = slowest {
        let (x, y) = (position.x, position.y);
        writeln!(out, "the lowest of these is {speed:.3} m/s at ({x:.3}, {y:.3}) m")?;
    }
    Ok(())
}
