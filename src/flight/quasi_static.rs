//! The quasi-static motion along a trajectory: what the winches do, and how the nodes would move if there were no inertia.

use crate::flight::FlightError;
use crate::mechanics::{CableMotion, Follower};
use crate::robot::{Moment, Robot, Side, Trajectory};

/// The border of what is feasible is told to this, in s.
const BORDER: f64 = 1e-6;

/// The quasi-static motion at one time.
#[derive(Clone, Debug)]
pub(super) struct QuasiStatic {
    /// What the trajectory prescribes.
    pub moment: Moment,
    /// One per cable.
    pub cables: Vec<CableMotion>,
}

/// The quasi-static motion of a robot along a trajectory.
pub(super) struct Path<'a> {
    trajectory: &'a Trajectory,
    follower: Follower<'a>,
    /// What was asked for last.
    last: Option<QuasiStatic>,
}

impl<'a> Path<'a> {
    pub fn new(robot: &'a Robot, trajectory: &'a Trajectory) -> Self {
        Self { trajectory, follower: Follower::new(robot), last: None }
    }

    /// Whether there is a quasi-static motion, up to a time in s: at this many places, equally spaced in time.
    pub fn check(&mut self, until: f64, places: usize) -> Result<(), FlightError> {
        (0..=places).try_for_each(|k| self.at(until * k as f64 / places as f64, Side::Left).map(|_| ()))
    }

    /// The motion at a time in s; where the acceleration jumps `side` tells which of the two is meant.
    pub fn at(&mut self, time: f64, side: Side) -> Result<QuasiStatic, FlightError> {
        let moment = self.trajectory.at(time, side);
        let rests = |moment: &Moment| moment.v == 0.0 && moment.a == 0.0;
        if let Some(last) = &self.last
            && rests(&last.moment)
            && rests(&moment)
            && last.moment.point == moment.point
        {
            return Ok(QuasiStatic { moment, cables: last.cables.clone() });
        }
        let cables = self.follow(&moment).map_err(|fault| self.border(time, side, fault))?;
        let found = QuasiStatic { moment, cables };
        self.last = Some(found.clone());
        Ok(found)
    }

    fn follow(&mut self, moment: &Moment) -> Result<Vec<CableMotion>, FlightError> {
        let position = moment.point.position;
        let followed = self.follower.at(moment.time, position, moment.velocity(), moment.acceleration());
        followed.map_err(|reason| FlightError::Statics { s: moment.s, position, reason })
    }

    /// The first fault between the last time that was feasible and `time`, where there is this `fault`.
    fn border(&mut self, time: f64, side: Side, fault: FlightError) -> FlightError {
        let (mut feasible, mut beyond, mut fault) = match &self.last {
            Some(last) if last.moment.time < time => (last.moment.time, time, fault),
            _ => return fault,
        };
        while beyond - feasible > BORDER {
            let middle = 0.5 * (feasible + beyond);
            match self.follow(&self.trajectory.at(middle, side)) {
                Ok(_) => feasible = middle,
                Err(nearer) => (beyond, fault) = (middle, nearer),
            }
        }
        fault
    }
}
