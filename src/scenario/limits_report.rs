//! The fastest move along a path as programs read it: `tautline/limits/1`, and as a table for a controller.

use std::fmt::Write as _;

use serde::Serialize;

use crate::flight::{CableRow, INTERVALS, LimitOptions, LimitsError, MoveRow, Place, legs, limits};
use crate::robot::{Robot, Trajectory};
use crate::scenario::flight_report::csv_header;
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::stability::Outcome;
use crate::stability::steps::step;
use crate::study::LocalProblem;

/// The name and version of the format.
pub const SCHEMA: &str = "tautline/limits/1";

/// The fastest move. SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LimitsReport {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// Whether there is a taut equilibrium all along the path.
    pub feasible: bool,
    /// Why there is no such move, as a sentence.
    pub reason: Option<String>,
    /// In s.
    pub duration: Option<f64>,
    /// In m/s.
    pub peak_speed: Option<f64>,
    /// At the places of a grid, in the order of time.
    pub rows: Vec<LimitsRow>,
}

/// The fastest move at one place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LimitsRow {
    /// In s.
    pub t: f64,
    /// Arc length in m.
    pub s: f64,
    /// In m.
    pub position: [f64; 2],
    /// In m/s.
    pub v: f64,
    /// In m/s², from here to the next row.
    pub a: f64,
    /// Of each cable, in m.
    pub unstretched_length: Vec<f64>,
    /// Of each cable, in m/s.
    pub rate: Vec<f64>,
    /// Of each cable, in m/s².
    pub acceleration: Vec<f64>,
    /// Of each cable, in N, at rest.
    pub tension_at_platform: Vec<f64>,
    /// Of each cable, in N, at rest.
    pub tension_at_winch: Vec<f64>,
}

impl From<&MoveRow> for LimitsRow {
    fn from(row: &MoveRow) -> Self {
        let each = |of: fn(&CableRow) -> f64| row.cables.iter().map(of).collect();
        Self {
            t: row.time,
            s: row.s,
            position: row.position.into(),
            v: row.v,
            a: row.a,
            unstretched_length: each(|cable| cable.length),
            rate: each(|cable| cable.rate),
            acceleration: each(|cable| cable.acceleration),
            tension_at_platform: each(|cable| cable.tension_at_platform),
            tension_at_winch: each(|cable| cable.tension_at_winch),
        }
    }
}

impl LimitsReport {
    /// The fastest move of `robot` along the path of `trajectory`, in [steps](crate::steps). Where frozen critical speeds act,
    /// each is searched for up to [`DEFAULT_MAX_SPEED`].
    pub async fn in_steps(robot: &Robot, trajectory: &Trajectory, options: &LimitOptions) -> Self {
        let nothing =
            Self { schema: SCHEMA, feasible: true, reason: None, duration: None, peak_speed: None, rows: Vec::new() };
        let found = match places(robot, trajectory, options).await {
            Ok(places) => limits(&places, options),
            Err(reason) => Err(reason),
        };
        match found {
            Ok(found) => Self {
                duration: found.rows.last().map(|last| last.time),
                peak_speed: found.rows.iter().map(|row| row.v).max_by(f64::total_cmp),
                rows: found.rows.iter().map(LimitsRow::from).collect(),
                ..nothing
            },
            Err(error) => {
                let statics =
                    matches!(&error, LimitsError::NoStatics { reason, .. } if reason.feasible() == Some(false));
                Self { feasible: !statics, reason: Some(error.to_string()), ..nothing }
            }
        }
    }

    /// The rows as CSV: `t,s,x,y,v,a`, then of each cable its length, rate, acceleration and tensions at rest.
    pub fn csv(&self, cables: usize) -> String {
        let mut text = csv_header("t,s,x,y,v,a", cables);
        for row in &self.rows {
            let [x, y] = row.position;
            // Writing to a string does not fail.
            let _ = write!(text, "{},{},{x},{y},{},{}", row.t, row.s, row.v, row.a);
            for i in 0..cables {
                let of_cable = [&row.unstretched_length, &row.rate, &row.acceleration, &row.tension_at_platform]
                    .into_iter()
                    .chain([&row.tension_at_winch]);
                for value in of_cable.filter_map(|values| values.get(i)) {
                    let _ = write!(text, ",{value}");
                }
            }
            text.push('\n');
        }
        text
    }
}

/// What is known of the path at the places of a grid, leg by leg.
async fn places(
    robot: &Robot,
    trajectory: &Trajectory,
    options: &LimitOptions,
) -> Result<Vec<Vec<Place>>, LimitsError> {
    let mut places = Vec::new();
    for leg in legs(trajectory, INTERVALS) {
        let mut of_leg = Vec::with_capacity(leg.len());
        for (s, point) in leg {
            let mut place = Place::at(robot, s, &point)?;
            // Of a place whose eigenvalues cannot be computed nothing is claimed.
            if options.frozen
                && let Ok(local) = LocalProblem::at(robot, &point)
                && let Ok(Outcome::Found(critical)) = local.critical_speed_in_steps(DEFAULT_MAX_SPEED).await
            {
                place.critical_speed = Some(critical.speed);
            }
            of_leg.push(place);
            step().await;
        }
        places.push(of_leg);
    }
    Ok(places)
}
