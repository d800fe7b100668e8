//! A trajectory from a table: when the platform is to be where.

use crate::robot::{Fault, Faults, Trajectory, Vec2};
use crate::scenario::file::without_mark;

/// The columns, in this order.
const COLUMNS: [&str; 3] = ["t", "x", "y"];

/// The trajectory in a CSV text with the columns t (s), x and y (m): the cubic spline in time through all places, at rest at
/// both ends. It begins at its first time.
///
/// # Errors
/// The lines and columns that are not as they should be, with what stands there; times that do not rise.
pub fn from_csv(text: &str) -> Result<Trajectory, Faults> {
    let mut lines = without_mark(text).lines().map(str::trim).enumerate().filter(|(_, line)| !line.is_empty());
    let header = lines.next().map_or("", |(_, line)| line);
    let names: Vec<String> = header.split(',').map(|name| name.trim().to_ascii_lowercase()).collect();
    if names != COLUMNS {
        return Err(Fault::new("line 1", format!("{header:?}"), "the columns t,x,y").into());
    }
    let (mut times, mut points, mut faults) = (Vec::new(), Vec::new(), Vec::new());
    for (number, line) in lines {
        let path = |column: &str| format!("line {}, column {column}", number + 1);
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if cells.len() != COLUMNS.len() {
            faults.push(Fault::new(format!("line {}", number + 1), format!("{line:?}"), "three numbers t,x,y"));
            continue;
        }
        let mut row = [0.0; 3];
        for ((value, cell), column) in row.iter_mut().zip(cells).zip(COLUMNS) {
            match cell.parse::<f64>().ok().filter(|number| number.is_finite()) {
                Some(number) => *value = number,
                None => faults.push(Fault::new(path(column), format!("{cell:?}"), "a finite number")),
            }
        }
        let [time, x, y] = row;
        if let Some(before) = times.last().filter(|before| **before >= time) {
            faults.push(Fault::new(path("t"), time, format!("a time after {before}, that of the row before")));
        }
        times.push(time);
        points.push(Vec2::new(x, y));
    }
    Faults::check(faults)?;
    if times.len() < 2 {
        return Err(Fault::new("trajectory", format!("{} rows", times.len()), "at least 2 rows").into());
    }
    Trajectory::timed(&times, &points)
        .ok_or_else(|| Fault::new("trajectory", "one place only", "at least two places that differ").into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::Side;

    #[test]
    fn a_table_becomes_a_trajectory() {
        let trajectory =
            from_csv("\u{feff}t, x, y\r\n1.0, -2, 0\r\n\r\n2.0, 0, 0.5\n3.5, 2, 0\n").expect("a trajectory");
        assert!((trajectory.duration() - 2.5).abs() < 1e-15);
        for (time, place) in [(0.0, [-2.0, 0.0]), (1.0, [0.0, 0.5]), (2.5, [2.0, 0.0])] {
            let found = trajectory.at(time, Side::Left).point.position;
            assert!((found - Vec2::from(place)).norm() < 1e-12, "{time}: {found}");
        }
    }

    #[test]
    fn faults_name_line_and_column() {
        for (text, expected) in [
            ("", "line 1: \"\" is not allowed; allowed: the columns t,x,y"),
            ("t,x,y,z\n0,0,0,0", "line 1: \"t,x,y,z\" is not allowed"),
            ("t,x,y\n0,0,0", "trajectory: 1 rows is not allowed; allowed: at least 2 rows"),
            ("t,x,y\n0,0,0\n1,a,0", "line 3, column x: \"a\" is not allowed; allowed: a finite number"),
            ("t,x,y\n0,0,0\n1,0", "line 3: \"1,0\" is not allowed; allowed: three numbers t,x,y"),
            ("t,x,y\n0,0,0\n1,inf,0", "line 3, column x: \"inf\" is not allowed"),
            ("t,x,y\n1,0,0\n1,1,0", "line 3, column t: 1 is not allowed; allowed: a time after 1"),
            ("t,x,y\n0,1,0\n1,1,0", "trajectory: one place only is not allowed"),
        ] {
            let message = from_csv(text).expect_err(text).to_string();
            assert!(message.starts_with(expected), "{text:?}: {message}");
        }
    }
}
