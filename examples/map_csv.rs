//! The critical speed over the workspace as CSV, of the built-in facade robot or of a scenario file.
//!
//! `cargo run --release --example map_csv > map.csv`, or with the name of a file:
//! `cargo run --release --example map_csv -- robot.json`. Without a file it prints:
//!
//! ```text
//! x_m,y_m,critical_speed_m_per_s,frequency_hz,status
//! -20,0,,,Infeasible
//! -10,0,6.3539,1.5417,Found
//! 0,0,6.1411,4.3572,Found
//! 10,0,3.9567,4.3591,Found
//! 20,0,,,Infeasible
//! -20,10,,,Infeasible
//! -10,10,6.9613,1.4467,Found
//! 0,10,6.0680,2.8310,Found
//! 10,10,4.7841,3.0223,Found
//! 20,10,,,Infeasible
//! -20,20,,,Infeasible
//! -10,20,,,Infeasible
//! 0,20,,,Infeasible
//! 10,20,,,Infeasible
//! 20,20,,,Infeasible
//! ```

use std::error::Error;
use std::io::{self, Write};
use std::path::Path;

use tautline::scenario::{Scenario, file, presets};
use tautline::study::{Answer, Directions, Grid, Mapped, Study};

fn main() -> Result<(), Box<dyn Error>> {
    let scenario = match std::env::args().nth(1) {
        Some(path) => Scenario::from_json(&file::open(Path::new(&path))?)?,
        None => built_in()?,
    };
    write(&scenario, &mut io::stdout())
}

/// The robot that is mapped where no file is named.
///
/// # Errors
/// A preset that is not there.
pub fn built_in() -> Result<Scenario, Box<dyn Error>> {
    Ok(presets::find("building").ok_or("no such preset")?.scenario())
}

/// Writes the map of `scenario`, moving in its direction.
///
/// # Errors
/// A robot that is not physical, an output that takes nothing.
pub fn write(scenario: &Scenario, out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    let (robot, motion) = scenario.to_robot()?;
    let grid = Grid::of(&robot, 5, 3);
    let directions = Directions::One(motion.direction());
    let study = Study::Map { grid, directions, mapped: Mapped::Critical { limit: 40.0 } };

    writeln!(out, "x_m,y_m,critical_speed_m_per_s,frequency_hz,status")?;
    // Places do not depend on each other: threads may share them out. `study.order()` begins with a coarse picture.
    for index in 0..study.len() {
        let Answer::Critical { verdict, .. } = study.answer(&robot, index) else { continue };
        let position = grid.position(index);
        write!(out, "{},{},", position.x, position.y)?;
        match verdict.critical() {
            Some(critical) => write!(out, "{:.4},{:.4},", critical.speed, critical.frequency_hz())?,
            None => write!(out, ",,")?,
        }
        // Found, none up to the limit, infeasible (no taut equilibrium), or failed (could not be computed).
        writeln!(out, "{:?}", verdict.status())?;
    }
    Ok(())
}
