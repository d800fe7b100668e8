//! What the canvas shows, in world coordinates and without colours.

use std::f64::consts::TAU;

use super::release::Release;
use crate::app::answers::Answers;
use crate::app::state::{Movement, Playback};
use crate::compute::protocol::{DrawnShape, FailedPose, ModeShape};
use crate::robot::{BoundingBox, TensionLaw};
use crate::scenario::Scenario;
use crate::stability::Instability;

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
    /// The first instability, where one is known.
    pub critical: Option<First>,
    /// The wave limit in m/s, where it is known.
    pub waves: Option<f64>,
    /// The highest speed that is marked beside the arrow, in m/s, also where a pose without an equilibrium has no marks: the
    /// arrow is not to change its length there.
    pub farthest_mark: f64,
    /// Whether it is unstable at this speed.
    pub unstable: bool,
    /// What is wrong, where the pose has no answer.
    pub trouble: Option<Trouble>,
}

/// The first instability as the speed rises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct First {
    /// The critical speed in m/s.
    pub speed: f64,
    /// The responsible cable, 0-based.
    pub cable: usize,
    /// How stability is lost.
    pub kind: Instability,
}

/// A pose without an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trouble {
    /// The cable to blame, 0-based.
    pub cable: Option<usize>,
    /// With how much it would have to push, in N, where it would.
    pub push: Option<f64>,
    /// The newest position in m at which the platform could rest, where the present one is known to have no equilibrium.
    pub rested: Option<[f64; 2]>,
}

/// One cable to draw.
#[derive(Clone, Debug)]
pub struct CableLine {
    /// The winch point in m.
    pub anchor: [f64; 2],
    /// How its tension comes about.
    pub law: TensionLaw,
    /// Nodes of its static shape from the platform on, in m; none where it has no shape.
    pub nodes: Vec<[f64; 2]>,
    /// Axial force of each element, in N.
    pub forces: Vec<f64>,
    /// Nodes displaced by the mode shape at this moment; none where no mode is shown.
    pub vibrating: Vec<[f64; 2]>,
    /// Whether it is the cable that the answer points at.
    pub marked: bool,
    /// What is known of it in numbers.
    pub figures: Option<Figures>,
}

/// A cable in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// The tension at the platform, in N.
    pub at_platform: f64,
    /// The tension at the winch, in N.
    pub at_winch: f64,
    /// The unstretched length in m.
    pub length: f64,
    /// How fast that grows at the present speed, in m/s: below 0 the cable is reeled in.
    pub reeling: f64,
}

impl Scene {
    /// The scene of `scenario` with what is known about it.
    pub fn new(scenario: &Scenario, answers: &Answers, playback: &Playback) -> Self {
        let frame = frame(scenario);
        let trouble = answers.failed().map(|failed| trouble(failed, answers));
        let first = answers.last_critical().and_then(|end| end.critical.as_ref());
        let first = first.map(|found| First { speed: found.speed, cable: found.cable, kind: found.kind });
        let waves = answers.last_pose().and_then(|(pose, _)| pose.report.wave_limit.as_ref()).map(|limit| limit.speed);
        let critical = first.filter(|_| trouble.is_none());
        let marked = trouble.map_or(critical.map(|first| first.cable), |trouble| trouble.cable);
        let report = answers.pose().map(|pose| &pose.report);
        // What stands before it flies does not swing.
        let flies = playback.movement == Movement::Fly && scenario.path.is_some();
        let swing = answers
            .shape()
            .filter(|_| !flies)
            .map(|mode| (mode, swing(mode, playback).map(|part| part * frame.size().x)));
        let cables = scenario.cables.iter().enumerate().map(|(i, cable)| {
            let DrawnShape { nodes, axial_forces: forces } = shape(answers, i);
            let vibrating = swing.map(|(mode, swing)| displaced(&nodes, mode, i, swing)).unwrap_or_default();
            let known = report.and_then(|report| report.cables.get(i));
            let figures = known.map(|known| Figures {
                at_platform: known.tension_at_platform,
                at_winch: known.tension_at_winch,
                length: known.unstretched_length,
                reeling: known.length_rate * scenario.motion.speed,
            });
            let marked = marked == Some(i);
            CableLine { anchor: cable.anchor, law: cable.tension, nodes, forces, vibrating, marked, figures }
        });
        let [x, y] = scenario.motion.direction;
        let length = x.hypot(y);
        Self {
            frame,
            cables: cables.collect(),
            platform: scenario.motion.position,
            direction: [x / length, y / length],
            speed: scenario.motion.speed,
            critical,
            waves: waves.filter(|_| trouble.is_none()),
            farthest_mark: first.map_or(0.0, |first| first.speed).max(waves.unwrap_or(0.0)),
            unstable: report.is_some_and(|report| report.stable == Some(false)),
            trouble,
        }
    }

    /// The largest axial force in N, where there is one.
    pub fn largest_force(&self) -> Option<f64> {
        self.cables.iter().flat_map(|cable| cable.forces.iter().copied()).max_by(f64::total_cmp)
    }
}

fn trouble(failed: &FailedPose, answers: &Answers) -> Trouble {
    let infeasible = failed.report.feasible == Some(false);
    let rested = answers.last_feasible().filter(|_| infeasible);
    Trouble { cable: failed.cable, push: failed.push, rested }
}

/// The workspace: the bounding box of all winches, with some height and width even where they are in a line.
pub fn frame(scenario: &Scenario) -> BoundingBox {
    let winches = BoundingBox::of(scenario.cables.iter().map(|cable| cable.anchor.into()));
    winches.unwrap_or(BoundingBox { low: [-1.0, -1.0].into(), high: [1.0, 1.0].into() }).with_area()
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

/// The number that `mode` is multiplied by at this moment, its real and its imaginary part, in parts of the robot's width.
fn swing(mode: &ModeShape, playback: &Playback) -> [f64; 2] {
    match playback.movement {
        Movement::LetGo | Movement::Fly => Release::new(mode.eigenvalue, playback).swing(playback.since),
        Movement::Mode => {
            let (sine, cosine) = playback.phase.sin_cos();
            [playback.amplitude * cosine, playback.amplitude * sine]
        }
    }
}

/// The nodes moved by the real part of the shape times `swing`, in m.
fn displaced(nodes: &[[f64; 2]], mode: &ModeShape, i: usize, [re, im]: [f64; 2]) -> Vec<[f64; 2]> {
    let Some(displacement) = mode.displacement.get(i).filter(|d| d.len() == nodes.len()) else { return Vec::new() };
    let moved = |(node, q): (&[f64; 2], &[f64; 4])| [0, 1].map(|j| node[j] + q[2 * j] * re - q[2 * j + 1] * im);
    nodes.iter().zip(displacement).map(moved).collect()
}

/// Lets some seconds of the screen pass for what moves on the canvas.
pub fn advance(playback: &mut Playback, answers: &Answers, seconds: f64) {
    let Some(mode) = answers.shape() else { return };
    match playback.movement {
        Movement::LetGo | Movement::Fly => {
            playback.since = Release::new(mode.eigenvalue, playback).after(playback.since, seconds);
        }
        Movement::Mode => playback.phase = (playback.phase + phase_advance(mode, playback, seconds)) % TAU,
    }
}

/// Stops what moves on the canvas, and goes on by this number of steps. An oscillation has 24 steps.
pub fn step(playback: &mut Playback, answers: &Answers, steps: f64) {
    match (playback.movement, answers.shape()) {
        (Movement::LetGo | Movement::Fly, Some(mode)) => {
            playback.playing = false;
            playback.since = Release::new(mode.eigenvalue, playback).stepped(playback.since, steps);
        }
        _ => playback.step(steps),
    }
}

/// How far the phase of `mode` advances in `seconds` of the screen. A mode that does not oscillate is swung slowly.
fn phase_advance(mode: &ModeShape, playback: &Playback, seconds: f64) -> f64 {
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
        let playback = Playback { amplitude: 0.1, phase: TAU / 4.0, movement: Movement::Mode, ..Playback::default() };
        let [moved] = displaced(&[[3.0, 4.0]], &mode, 0, swing(&mode, &playback).map(|part| 20.0 * part))[..] else {
            panic!("one node")
        };
        // e^{iπ/2} = i: Re(i · 1) = 0 along x, Re(i · i) = −1 along y, times 0.1 × 20 m.
        assert!((moved[0] - 3.0).abs() < 1e-12 && (moved[1] - 2.0).abs() < 1e-12, "{moved:?}");
    }
}
