//! Studies of a robot: lists of tasks that do not depend on each other, so that they can be shared out and answered
//! in any order.

use nalgebra::Complex;

use crate::flight::FlightOptions;
use crate::robot::{Motion, Robot, RobotSpec, Vec2};
use crate::stability::steps::finish;
use crate::study::campbell::{self, Track};
use crate::study::grid::{coarse_first, coarse_first_in_a_row};
use crate::study::on_path::{self, MoveEffect, Moves, Station};
use crate::study::verdict::verdict_in_steps;
use crate::study::{
    Allowed, Directions, Fastest, Flown, Grid, Line, LocalProblem, NoEigenvalues, Reach, Stretch, Strip, Variant,
    Varied, Verdict, WhatIf, compass, evenly,
};

/// What a map shows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Mapped {
    /// The critical speed.
    Critical {
        /// Searched up to this speed in m/s, finite and greater than 0.
        limit: f64,
    },
    /// The largest growth rate at one speed.
    Growth {
        /// In m/s.
        speed: f64,
    },
}

/// A study: what is asked for, at [`Self::len`] places. Speeds in m/s; a `limit` is the speed up to which critical
/// speeds are searched for, finite and greater than 0.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Study {
    /// Critical speed and frequency along a motion: the paper's Fig. 3.
    Line {
        /// Where.
        line: Line,
        /// See [`Study`].
        limit: f64,
    },
    /// A map over the workspace.
    Map {
        /// Where.
        grid: Grid,
        /// In which directions.
        directions: Directions,
        /// What it shows.
        mapped: Mapped,
    },
    /// The critical speed in every direction, see [`compass`].
    Directions {
        /// The pose in m.
        position: Vec2,
        /// How many directions.
        count: usize,
        /// See [`Study`].
        limit: f64,
    },
    /// All eigenvalues from rest to a speed, see [`evenly`]: the Campbell diagram, once joined by
    /// [`campbell::track`](crate::study::campbell::track).
    Campbell {
        /// The pose in m.
        position: Vec2,
        /// The direction, of any length but zero.
        direction: Vec2,
        /// The highest speed in m/s.
        to: f64,
        /// How many speeds.
        count: usize,
    },
    /// The critical speed on several meshes, for [`convergence::richardson`](crate::study::convergence::richardson).
    Mesh {
        /// The pose in m.
        position: Vec2,
        /// The direction, of any length but zero.
        direction: Vec2,
        /// Elements per cable, each in [`ELEMENTS`](crate::robot::ELEMENTS).
        counts: Vec<usize>,
        /// See [`Study`].
        limit: f64,
    },
    /// The spectra of successive speeds joined to modes by [`campbell::track`](crate::study::campbell::track): one place,
    /// which no robot has a part in.
    Modes {
        /// Speeds (m/s) in rising order, each with its eigenvalues (1/s).
        spectra: Vec<(f64, Vec<Complex<f64>>)>,
    },
    /// The border of the feasible region, row by row. Poses, directions and speeds other than the grid's do not matter.
    Border {
        /// Where.
        grid: Grid,
    },
    /// The critical speed with other values of one number or two: only [`Study::varied_in_steps`] answers it.
    WhatIf(WhatIf),
    /// The value of a number at which the critical speed is the wanted one: only [`Study::varied_in_steps`] answers it.
    Reach(Reach),
    /// Local analysis at equally spaced stations of the scenario's path: only [`Study::moved_in_steps`] answers it.
    Path {
        /// How many stations, both ends among them.
        count: usize,
        /// See [`Study`].
        limit: f64,
    },
    /// What the move along the scenario's path does to vibrations, at several speeds of its profile: only
    /// [`Study::moved_in_steps`] answers it.
    Gains {
        /// In m/s, greater than 0, in rising order.
        speeds: Vec<f64>,
    },
    /// The same of the move as it is: only [`Study::moved_in_steps`] answers it.
    Move,
    /// The fastest move along the scenario's path that limits allow: only [`Study::moved_in_steps`] answers it.
    Allowed(Allowed),
    /// The flight along the scenario's path: one place, which only [`flown_in_steps`](crate::study::flown_in_steps) answers.
    Flight {
        /// What is asked of it.
        options: FlightOptions,
    },
}

/// What a study is about: of each topic at most one study is at work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Topic {
    /// Critical speeds along the motion.
    Line,
    /// A map over the workspace.
    Map,
    /// Critical speeds in every direction.
    Directions,
    /// All eigenvalues against speed.
    Campbell,
    /// Critical speeds on several meshes.
    Mesh,
    /// Eigenvalues joined to modes.
    Modes,
    /// The border of the feasible region.
    Border,
    /// Critical speeds with other values of a number.
    WhatIf,
    /// The value at which the critical speed is the wanted one.
    Reach,
    /// Local analysis along the path.
    Path,
    /// What the move does to vibrations, against its speed.
    Gains,
    /// What the move does to vibrations.
    Move,
    /// The fastest move along the path.
    Allowed,
    /// The flight along the path.
    Flight,
}

impl Topic {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::Line,
        Self::Map,
        Self::Directions,
        Self::Campbell,
        Self::Mesh,
        Self::Modes,
        Self::Border,
        Self::WhatIf,
        Self::Reach,
        Self::Path,
        Self::Gains,
        Self::Move,
        Self::Allowed,
        Self::Flight,
    ];

    /// Its name for programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Map => "map",
            Self::Directions => "directions",
            Self::Campbell => "campbell",
            Self::Mesh => "mesh",
            Self::Modes => "modes",
            Self::Border => "border",
            Self::WhatIf => "what_if",
            Self::Reach => "reach",
            Self::Path => "path",
            Self::Gains => "gains",
            Self::Move => "move",
            Self::Allowed => "allowed",
            Self::Flight => "flight",
        }
    }
}

/// What a study has found at one of its places.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Answer {
    /// The critical speed: of a line, a map, a polar diagram, a mesh.
    Critical {
        /// The unit vector of the motion; of several directions the worst one.
        direction: Vec2,
        /// What is known.
        verdict: Verdict,
        /// The wave limit in m/s, of several directions the lowest; `None` where there is none.
        wave_limit: Option<f64>,
    },
    /// The largest growth rate max Re λ in 1/s, or why it is not known.
    Growth(Result<f64, NoEigenvalues>),
    /// The eigenvalues in 1/s in rising order of frequency: of a complex pair the one with Im λ > 0, real ones each, of
    /// those that are equal by the problem's structure one. Or why they are not known.
    Spectrum(Result<Vec<Complex<f64>>, NoEigenvalues>),
    /// The modes, or why they are not known.
    Modes(Result<Vec<Track>, NoEigenvalues>),
    /// The feasible region from one row of a grid to the next.
    Border(Strip),
    /// Where the critical speed is the wanted one, from one value to the next.
    Reach(Stretch),
    /// Local analysis at a station of a path; `None` where nothing is known.
    Station(Option<Box<Station>>),
    /// What a move does to vibrations, or why there is no such move.
    Move(Result<MoveEffect, String>),
    /// The fastest move, or why there is none.
    Fastest(Box<Result<Fastest, String>>),
    /// The flight, or why there is none.
    Flight(Box<Result<Flown, String>>),
}

impl Study {
    /// What it is about.
    pub fn topic(&self) -> Topic {
        match self {
            Self::Line { .. } => Topic::Line,
            Self::Map { .. } => Topic::Map,
            Self::Directions { .. } => Topic::Directions,
            Self::Campbell { .. } => Topic::Campbell,
            Self::Mesh { .. } => Topic::Mesh,
            Self::Modes { .. } => Topic::Modes,
            Self::Border { .. } => Topic::Border,
            Self::WhatIf(_) => Topic::WhatIf,
            Self::Reach(_) => Topic::Reach,
            Self::Path { .. } => Topic::Path,
            Self::Gains { .. } => Topic::Gains,
            Self::Move => Topic::Move,
            Self::Allowed(_) => Topic::Allowed,
            Self::Flight { .. } => Topic::Flight,
        }
    }

    /// How many places there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Line { line, .. } => line.count,
            Self::Map { grid, .. } => grid.len(),
            Self::Directions { count, .. } | Self::Campbell { count, .. } | Self::Path { count, .. } => *count,
            Self::Mesh { counts, .. } => counts.len(),
            Self::Modes { .. } | Self::Move | Self::Allowed(_) | Self::Flight { .. } => 1,
            Self::Border { grid } => grid.ny,
            Self::WhatIf(what_if) => what_if.len(),
            Self::Reach(reach) => reach.len(),
            Self::Gains { speeds } => speeds.len(),
        }
    }

    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All places, each once, in the order in which a picture becomes finer: every 8th first, then every 4th, every
    /// 2nd, all; meshes from the coarsest to the finest.
    pub fn order(&self) -> Vec<usize> {
        match self {
            Self::Map { grid, .. } => grid.coarse_first(),
            Self::WhatIf(WhatIf { numbers, .. }) => match &numbers[..] {
                [columns, rows] => coarse_first(columns.values.len(), rows.values.len()),
                _ => coarse_first_in_a_row(self.len()),
            },
            Self::Mesh { counts, .. } => {
                let mut order: Vec<usize> = (0..counts.len()).collect();
                order.sort_by_key(|&index| counts[index]);
                order
            }
            _ => coarse_first_in_a_row(self.len()),
        }
    }

    /// The answer at one place, which depends on `robot` and the study alone.
    ///
    /// Nothing here is an error: a place without a pose (an infeasible one, a position or direction that is not
    /// finite, no direction) is infeasible, and of a mesh that is not allowed nothing is known.
    pub fn answer(&self, robot: &Robot, index: usize) -> Answer {
        finish(self.answer_in_steps(robot, index))
    }

    /// The same in [steps](crate::stability::steps).
    pub async fn answer_in_steps(&self, robot: &Robot, index: usize) -> Answer {
        match self {
            Self::Line { line, limit } => critical(robot, line.position(index), line.direction, *limit).await,
            Self::Map { grid, directions, mapped } => match *mapped {
                Mapped::Critical { limit } => {
                    let (direction, verdict, wave_limit) = directions.verdict(robot, grid.position(index), limit).await;
                    Answer::Critical { direction, verdict, wave_limit }
                }
                Mapped::Growth { speed } => Answer::Growth(directions.growth(robot, grid.position(index), speed).await),
            },
            Self::Directions { position, count, limit } => {
                critical(robot, *position, compass(index, *count), *limit).await
            }
            Self::Campbell { position, direction, to, count } => {
                Answer::Spectrum(spectrum(robot, *position, *direction, evenly(0.0, *to, index, *count)).await)
            }
            Self::Mesh { position, direction, counts, limit } => {
                let elements = counts.get(index).copied().unwrap_or_default();
                match Robot::new(RobotSpec { elements, ..(**robot).clone() }) {
                    Ok(robot) => critical(&robot, *position, *direction, *limit).await,
                    Err(_) => unknown(*direction),
                }
            }
            Self::Modes { spectra } => Answer::Modes(Ok(campbell::track_in_steps(spectra).await)),
            Self::Border { grid } => Answer::Border(Strip::new(robot, grid, index).await),
            // One robot alone has no other values, and no path.
            Self::WhatIf(_)
            | Self::Reach(_)
            | Self::Path { .. }
            | Self::Gains { .. }
            | Self::Move
            | Self::Allowed(_)
            | Self::Flight { .. } => self.unknown(index),
        }
    }

    /// The answer at one place of a study that varies numbers, whose robots `variant` builds; `None` of other studies. In
    /// [steps](crate::stability::steps).
    pub async fn varied_in_steps(&self, variant: &Variant<'_>, index: usize) -> Option<Answer> {
        match self {
            Self::WhatIf(what_if) => {
                let (direction, verdict, wave_limit) = what_if.verdict_in_steps(variant, index).await;
                Some(Answer::Critical { direction, verdict, wave_limit })
            }
            Self::Reach(reach) => Some(Answer::Reach(reach.stretch_in_steps(variant, index).await)),
            _ => None,
        }
    }

    /// The answer at one place of a study of a path, whose trajectories `moves` builds; `None` of other studies. In
    /// [steps](crate::steps).
    pub async fn moved_in_steps(&self, robot: &Robot, moves: &Moves<'_>, index: usize) -> Option<Answer> {
        let speed = match self {
            Self::Path { count, limit } => {
                let Some(trajectory) = moves(None) else { return Some(self.unknown(index)) };
                let s = evenly(0.0, trajectory.length(), index, *count);
                let station = on_path::station_in_steps(robot, &trajectory, s, *limit).await;
                return Some(Answer::Station(Some(Box::new(station))));
            }
            Self::Allowed(allowed) => {
                let Some(trajectory) = moves(None) else { return Some(self.unknown(index)) };
                return Some(Answer::Fastest(Box::new(allowed.fastest_in_steps(robot, &trajectory).await)));
            }
            Self::Gains { speeds } => speeds.get(index).copied(),
            Self::Move => None,
            _ => return None,
        };
        let Some(trajectory) = moves(speed) else { return Some(self.unknown(index)) };
        Some(Answer::Move(on_path::effect_in_steps(robot, &trajectory).await))
    }

    /// The numbers that it varies.
    pub fn varied(&self) -> &[Varied] {
        match self {
            Self::WhatIf(what_if) => &what_if.numbers,
            Self::Reach(reach) => std::slice::from_ref(&reach.number),
            _ => &[],
        }
    }

    /// The answer at one place where the attempt at one was lost: nothing is known.
    pub fn unknown(&self, index: usize) -> Answer {
        match self {
            Self::Line { line, .. } => unknown(line.direction),
            Self::Map { mapped: Mapped::Growth { .. }, .. } => Answer::Growth(Err(NoEigenvalues::Failed)),
            Self::Map { directions: Directions::One(direction), .. } | Self::Mesh { direction, .. } => {
                unknown(*direction)
            }
            Self::Map { directions: Directions::Worst(_), .. } | Self::WhatIf(_) => unknown(Vec2::x()),
            Self::Directions { count, .. } => unknown(compass(index, *count)),
            Self::Campbell { .. } => Answer::Spectrum(Err(NoEigenvalues::Failed)),
            Self::Modes { .. } => Answer::Modes(Err(NoEigenvalues::Failed)),
            Self::Border { grid } => Answer::Border(Strip::unknown(grid.nx)),
            Self::Reach(_) => Answer::Reach(Stretch::default()),
            Self::Path { .. } => Answer::Station(None),
            Self::Allowed(_) => Answer::Fastest(Box::new(Err("it could not be computed".into()))),
            Self::Flight { .. } => Answer::Flight(Box::new(Err("it could not be computed".into()))),
            Self::Gains { .. } | Self::Move => Answer::Move(Err("it could not be computed".into())),
        }
    }
}

/// The answer where a critical speed is asked for and nothing is known.
fn unknown(direction: Vec2) -> Answer {
    Answer::Critical { direction, verdict: Verdict::Unknown, wave_limit: None }
}

async fn critical(robot: &Robot, position: Vec2, direction: Vec2, limit: f64) -> Answer {
    let Ok(motion) = Motion::new(position, direction, 0.0) else {
        return Answer::Critical { direction, verdict: Verdict::Infeasible, wave_limit: None };
    };
    let (verdict, wave_limit) = verdict_in_steps(robot, &motion, limit).await;
    Answer::Critical { direction: motion.direction(), verdict, wave_limit }
}

async fn spectrum(
    robot: &Robot,
    position: Vec2,
    direction: Vec2,
    speed: f64,
) -> Result<Vec<Complex<f64>>, NoEigenvalues> {
    let motion = Motion::new(position, direction, speed).map_err(|_| NoEigenvalues::Infeasible)?;
    let local = LocalProblem::new(robot, &motion).map_err(|failure| NoEigenvalues::from(&failure))?;
    let spectrum = local.spectrum_in_steps(speed).await.map_err(|_| NoEigenvalues::Failed)?;
    Ok(spectrum.modes().map(|mode| mode.eigenvalue).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// The compiler asks for a new topic here, and the list that lacks it fails.
    #[test]
    fn every_topic_is_in_the_list() {
        let after = |topic: Topic| match topic {
            Topic::Line => Some(Topic::Map),
            Topic::Map => Some(Topic::Directions),
            Topic::Directions => Some(Topic::Campbell),
            Topic::Campbell => Some(Topic::Mesh),
            Topic::Mesh => Some(Topic::Modes),
            Topic::Modes => Some(Topic::Border),
            Topic::Border => Some(Topic::WhatIf),
            Topic::WhatIf => Some(Topic::Reach),
            Topic::Reach => Some(Topic::Path),
            Topic::Path => Some(Topic::Gains),
            Topic::Gains => Some(Topic::Move),
            Topic::Move => Some(Topic::Allowed),
            Topic::Allowed => Some(Topic::Flight),
            Topic::Flight => None,
        };
        let all: Vec<Topic> = std::iter::successors(Some(Topic::Line), |topic| after(*topic)).collect();
        assert_eq!(all, Topic::ALL);
        let names: BTreeSet<&str> = all.iter().map(|topic| topic.name()).collect();
        assert_eq!(names.len(), all.len(), "two topics have one name");
    }
}
