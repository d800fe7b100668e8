//! What the canvas shows, in world coordinates and without colours.

use std::f64::consts::TAU;

use crate::app::answers::Answers;
use crate::app::state::Playback;
use crate::compute::protocol::{DrawnShape, ModeShape};
use crate::robot::{BoundingBox, TensionLaw};
use crate::scenario::Scenario;

/// What is to be drawn.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The workspace.
    pub frame: BoundingBox,
    /// The cables.
    pub cables: Vec<CableLine>,
    /// The platform's position in m.
    pub platform: [f64; 2],
    /// The unit vector of the motion.
    pub direction: [f64; 2],
    /// The speed in m/s.
    pub speed: f64,
    /// Smallest and largest axial force, in N, where there is any.
    pub tensions: Option<[f64; 2]>,
}

/// One cable to draw.
#[derive(Clone, Debug)]
pub struct CableLine {
    /// The winch point in m.
    pub anchor: [f64; 2],
    /// Whether its tension is prescribed.
    pub prescribed: bool,
    /// Nodes of its static shape from the platform on, in m; none where it has no shape.
    pub nodes: Vec<[f64; 2]>,
    /// Axial force of each element, in N.
    pub forces: Vec<f64>,
    /// Nodes displaced by the mode shape at this moment; none where no mode is shown.
    pub vibrating: Vec<[f64; 2]>,
    /// Whether it is the cable that the answer points at.
    pub marked: bool,
}

impl Scene {
    /// The scene of `scenario` with what is known about it.
    pub fn new(scenario: &Scenario, answers: &Answers, playback: &Playback) -> Self {
        let frame = frame(scenario);
        let width = frame.size().x;
        let critical = answers.last_critical().and_then(|answer| answer.critical.as_ref()).map(|c| c.cable);
        let marked = answers.failed().map_or(critical, |failed| failed.cable);
        let cables: Vec<CableLine> = scenario
            .cables
            .iter()
            .enumerate()
            .map(|(i, cable)| {
                let DrawnShape { nodes, axial_forces: forces } = shape(answers, i);
                let vibrating = answers.shape().map(|mode| displaced(&nodes, mode, i, playback, width));
                CableLine {
                    anchor: cable.anchor,
                    prescribed: cable.tension != TensionLaw::Equilibrium,
                    nodes,
                    forces,
                    vibrating: vibrating.unwrap_or_default(),
                    marked: marked == Some(i),
                }
            })
            .collect();
        let [x, y] = scenario.motion.direction;
        let length = x.hypot(y);
        Self {
            frame,
            platform: scenario.motion.position,
            direction: [x / length, y / length],
            speed: scenario.motion.speed,
            tensions: range(cables.iter().flat_map(|cable| cable.forces.iter().copied())),
            cables,
        }
    }
}

/// The workspace: the bounding box of all winches, with some height and width even where they are in a line.
pub fn frame(scenario: &Scenario) -> BoundingBox {
    let winches = BoundingBox::of(scenario.cables.iter().map(|cable| cable.anchor.into()));
    winches.unwrap_or(BoundingBox { low: [-1.0, -1.0].into(), high: [1.0, 1.0].into() }).with_area()
}

fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |range, value| {
        let [low, high] = range.unwrap_or([value, value]);
        Some([low.min(value), high.max(value)])
    })
}

/// The shape of cable i as far as it is known.
fn shape(answers: &Answers, i: usize) -> DrawnShape {
    if let Some(failed) = answers.failed() {
        return failed.shapes.get(i).cloned().flatten().unwrap_or_default();
    }
    let known = answers.pose().and_then(|pose| Some((pose.report.cables.get(i)?, pose.axial_forces.get(i)?)));
    known.map_or_else(DrawnShape::default, |(cable, forces)| DrawnShape {
        nodes: cable.nodes.clone(),
        axial_forces: forces.clone(),
    })
}

/// The nodes moved by Re(q e^{iφ}), the largest displacement `playback.amplitude` of the robot's width.
fn displaced(nodes: &[[f64; 2]], mode: &ModeShape, i: usize, playback: &Playback, width: f64) -> Vec<[f64; 2]> {
    let Some(displacement) = mode.displacement.get(i).filter(|d| d.len() == nodes.len()) else { return Vec::new() };
    let (sine, cosine) = playback.phase.sin_cos();
    let amplitude = playback.amplitude * width;
    let moved = |(node, q): (&[f64; 2], &[f64; 4])| {
        [0, 1].map(|j| node[j] + amplitude * (q[2 * j] * cosine - q[2 * j + 1] * sine))
    };
    nodes.iter().zip(displacement).map(moved).collect()
}

/// How far the phase of `mode` advances in `seconds` of the screen. A mode that does not oscillate is swung slowly.
pub fn phase_advance(mode: &ModeShape, playback: &Playback, seconds: f64) -> f64 {
    let slowest = TAU * 0.4;
    let own = mode.eigenvalue[1].abs();
    let shown = if own == 0.0 { slowest } else { own * playback.slow_motion };
    // Faster than this, 60 frames per second show no movement but flicker.
    shown.min(TAU * 6.0) * seconds
}

#[cfg(test)]
mod tests {
    // The frames compared are coordinates copied, not computed.
    #![expect(clippy::float_cmp)]

    use super::*;
    use crate::scenario::presets;

    #[test]
    fn frame_of_the_paper_robot_is_its_workspace() {
        let frame = frame(&presets::PRESETS[0].scenario());
        assert_eq!([frame.low, frame.high].map(<[f64; 2]>::from), [[-10.0, -5.0], [10.0, 5.0]]);
    }

    #[test]
    fn frame_of_anchors_in_a_line_has_height() {
        let mut scenario = presets::PRESETS[0].scenario();
        for (i, cable) in scenario.cables.iter_mut().enumerate() {
            cable.anchor = [i as f64, 2.0];
        }
        let frame = frame(&scenario);
        assert_eq!([frame.low.x, frame.high.x], [0.0, 3.0]);
        assert!(frame.size().y > 0.5, "{frame:?}");
    }

    #[test]
    fn displacement_is_the_real_part_of_the_rotating_shape() {
        let mode = ModeShape {
            eigenvalue: [0.0, 2.0],
            speed: 0.0,
            is_critical: false,
            displacement: vec![vec![[1.0, 0.0, 0.0, 1.0]]],
            cable_share: vec![1.0],
        };
        let playback = Playback { amplitude: 0.1, phase: TAU / 4.0, ..Playback::default() };
        let [moved] = displaced(&[[3.0, 4.0]], &mode, 0, &playback, 20.0)[..] else { panic!("one node") };
        // e^{iπ/2} = i: Re(i · 1) = 0 along x, Re(i · i) = −1 along y, times 0.1 × 20 m.
        assert!((moved[0] - 3.0).abs() < 1e-12 && (moved[1] - 2.0).abs() < 1e-12, "{moved:?}");
    }
}
