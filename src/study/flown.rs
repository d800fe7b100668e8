//! A flight as a study answers it: with the quasi-static shapes that it is compared with in a picture.

use crate::flight::{self, Flight, FlightOptions};
use crate::mechanics;
use crate::robot::{Robot, Side, Trajectory};
use crate::stability::steps::step;
use crate::study::evenly;

/// Quasi-static shapes along a path. Between two of them a picture goes straight.
const SHAPES: usize = 61;

/// A flight, with the quasi-static shapes along its path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct Flown {
    /// The flight.
    pub flight: Flight,
    /// Equally spaced along the path, from its beginning to its end; none unless the flight was asked for its nodes.
    pub shapes: Vec<PathShape>,
}

/// The quasi-static shape of all cables at one place of a path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct PathShape {
    /// Arc length in m.
    pub s: f64,
    /// Per cable its n + 1 nodes from the platform to the winch, in m.
    pub nodes: Vec<Vec<[f32; 2]>>,
}

/// Flies `robot` along `trajectory`, in [steps](crate::stability::steps), and tells `watch` which part of the time is flown.
///
/// # Errors
/// Why there is no flight, as a sentence: see [`flight::fly`].
pub async fn flown_in_steps(
    robot: &Robot,
    trajectory: &Trajectory,
    options: &FlightOptions,
    watch: impl Fn(f64),
) -> Result<Flown, String> {
    let flight =
        flight::fly_watched_in_steps(robot, trajectory, options, watch).await.map_err(|reason| reason.to_string())?;
    let mut shapes = Vec::new();
    for i in (0..SHAPES).filter(|_| options.nodes) {
        let s = evenly(0.0, trajectory.length(), i, SHAPES);
        let position = trajectory.point(s, Side::Left).position;
        // The flight has looked at the whole path before; a place that fails all the same leaves a gap in the picture.
        if let Ok(statics) = mechanics::solve(robot, position) {
            #[expect(clippy::cast_possible_truncation, reason = "for a picture")]
            let nodes =
                statics.cables.iter().map(|cable| cable.nodes.iter().map(|r| [r.x as f32, r.y as f32]).collect());
            shapes.push(PathShape { s, nodes: nodes.collect() });
        }
        step().await;
    }
    Ok(Flown { flight, shapes })
}
