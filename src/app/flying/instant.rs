//! One moment of a flight, between its samples, as it is drawn.

use crate::flight::Sample;
use crate::study::{Flown, PathShape};

/// A moment of a flight. Deviations from the quasi-static motion are drawn so many times larger.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    /// Arc length on the path in m.
    pub s: f64,
    /// Speed along the path in m/s.
    pub speed: f64,
    /// Where the platform would be without a deviation, in m.
    pub on_path: [f64; 2],
    /// Where the platform is drawn, in m.
    pub platform: [f64; 2],
    /// Its true deviation in m.
    pub deviation: [f64; 2],
    /// One per cable.
    pub cables: Vec<CableInstant>,
    /// Whether a cable has been slack before.
    pub doubtful: bool,
}

/// A cable at a moment of a flight.
#[derive(Clone, Debug, PartialEq)]
pub struct CableInstant {
    /// Where its nodes are drawn, from the platform to the winch, in m.
    pub nodes: Vec<[f64; 2]>,
    /// Where they would be without a deviation; none where that is not known.
    pub quasi_static: Vec<[f64; 2]>,
    /// The tension at the platform and at the winch, in N.
    pub tensions: [f64; 2],
    /// The unstretched length in m, and its rate in m/s.
    pub length: [f64; 2],
}

impl Instant {
    /// The flight at `time` (s), deviations `factor` times larger. Between two samples, and between two shapes, all goes
    /// straight; before the first one and after the last one it is as there. `None` of a flight without samples.
    pub fn new(flown: &Flown, time: f64, factor: f64) -> Option<Self> {
        let (before, after, part) = between(&flown.flight.samples, time, |sample| sample.time)?;
        let mix = |of: &dyn Fn(&Sample) -> f64| of(before) + part * (of(after) - of(before));
        let s = mix(&|sample| sample.s);
        let shapes = between(&flown.shapes, s, |shape: &PathShape| shape.s);
        let pair = |of: &dyn Fn(&Sample) -> [f64; 2]| mixed(of(before), of(after), part);
        let deviation = pair(&|sample| sample.deviation.into());
        let on_path = pair(&|sample| sample.position.into());
        let cables = before.cables.iter().zip(&after.cables).enumerate().map(|(i, (a, b))| {
            let flown = nodes(&a.nodes, &b.nodes, part);
            let quasi_static = shapes.and_then(|(a, b, part)| Some(nodes(a.nodes.get(i)?, b.nodes.get(i)?, part)));
            let quasi_static = quasi_static.filter(|shape| shape.len() == flown.len()).unwrap_or_default();
            let drawn = |(node, base): (&[f64; 2], &[f64; 2])| exaggerated(*node, *base, factor);
            let drawn = if quasi_static.is_empty() {
                flown.clone()
            } else {
                flown.iter().zip(&quasi_static).map(drawn).collect()
            };
            CableInstant {
                nodes: drawn,
                quasi_static,
                tensions: mixed([a.tension, a.winch_tension], [b.tension, b.winch_tension], part),
                length: mixed([a.length, a.rate], [b.length, b.rate], part),
            }
        });
        let cables = cables.collect();
        let doubtful = flown.flight.slack.is_some_and(|slack| time >= slack.time);
        Some(Self {
            s,
            speed: mix(&|sample| sample.v),
            on_path,
            platform: [0, 1].map(|i| on_path[i] + factor * deviation[i]),
            deviation,
            cables,
            doubtful,
        })
    }
}

/// Where the platform is drawn at every sample, each with its time in s.
pub fn trace(flown: &Flown, factor: f64) -> Vec<(f64, [f64; 2])> {
    let place = |sample: &Sample| (sample.time, (sample.position + factor * sample.deviation).into());
    flown.flight.samples.iter().map(place).collect()
}

/// The two entries around `at`, and how far it is from the first to the second, from 0 to 1. The entries rise by `key`.
fn between<T>(entries: &[T], at: f64, key: impl Fn(&T) -> f64) -> Option<(&T, &T, f64)> {
    let next = entries.partition_point(|entry| key(entry) <= at);
    let (first, second) = (entries.get(next.saturating_sub(1))?, entries.get(next).or(entries.last())?);
    let width = key(second) - key(first);
    let part = if width > 0.0 { ((at - key(first)) / width).clamp(0.0, 1.0) } else { 0.0 };
    Some((first, second, part))
}

fn mixed(a: [f64; 2], b: [f64; 2], part: f64) -> [f64; 2] {
    [0, 1].map(|i| a[i] + part * (b[i] - a[i]))
}

fn nodes(a: &[[f32; 2]], b: &[[f32; 2]], part: f64) -> Vec<[f64; 2]> {
    a.iter().zip(b).map(|(a, b)| mixed(a.map(f64::from), b.map(f64::from), part)).collect()
}

/// A place `factor` times further from its base.
fn exaggerated(place: [f64; 2], base: [f64; 2], factor: f64) -> [f64; 2] {
    [0, 1].map(|i| base[i] + factor * (place[i] - base[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::{CableSample, Flight, Slack};
    use crate::robot::Vec2;

    /// A platform that goes along x at 2 m/s and rises off its path by 0.1 m per second; one cable of one element.
    fn flown() -> Flown {
        let sample = |time: f64| {
            let at = [2.0 * time, 0.1 * time];
            #[expect(clippy::cast_possible_truncation)]
            let nodes = vec![at.map(|part| part as f32), [10.0, 5.0]];
            let cable = CableSample {
                length: 9.0 - time,
                rate: -1.0,
                acceleration: 0.0,
                tension: 50.0 + 10.0 * time,
                winch_tension: 60.0,
                winch_element_force: 59.0,
                nodes,
            };
            Sample {
                time,
                s: 2.0 * time,
                v: 2.0,
                a: 0.0,
                position: Vec2::new(2.0 * time, 0.0),
                deviation: Vec2::new(0.0, 0.1 * time),
                deviation_velocity: Vec2::new(0.0, 0.1),
                smallest_element_force: 1.0,
                cables: vec![cable],
            }
        };
        let flight = Flight {
            duration: 2.0,
            end: 2.0,
            max_deviation: 0.2,
            residual: None,
            slack: Some(Slack { time: 1.5, cable: 0, force: -1.0 }),
            lost: None,
            steps: 2,
            samples: vec![sample(0.0), sample(1.0), sample(2.0)],
        };
        let shape = |s: f32| PathShape { s: f64::from(s), nodes: vec![vec![[s, 0.0], [10.0, 5.0]]] };
        Flown { flight, shapes: vec![shape(0.0), shape(1.0), shape(4.0)] }
    }

    fn near(a: [f64; 2], b: [f64; 2]) -> bool {
        // Nodes come in single precision.
        a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-6)
    }

    #[test]
    fn between_samples_all_goes_straight() {
        let instant = Instant::new(&flown(), 0.75, 1.0).expect("samples");
        assert!(near(instant.on_path, [1.5, 0.0]) && near(instant.platform, [1.5, 0.075]), "{instant:?}");
        assert!(near([instant.s, instant.speed], [1.5, 2.0]) && !instant.doubtful);
        let cable = &instant.cables[0];
        assert!(near(cable.tensions, [57.5, 60.0]) && near(cable.length, [8.25, -1.0]));
        // The cable ends at the platform, and its quasi-static shape on the path.
        assert!(near(cable.nodes[0], instant.platform) && near(cable.quasi_static[0], instant.on_path), "{cable:?}");
    }

    #[test]
    fn deviations_are_drawn_larger_and_anchors_stay() {
        let instant = Instant::new(&flown(), 1.0, 20.0).expect("samples");
        assert!(near(instant.deviation, [0.0, 0.1]) && near(instant.platform, [2.0, 2.0]), "{instant:?}");
        let cable = &instant.cables[0];
        assert!(near(cable.nodes[0], [2.0, 2.0]) && near(cable.nodes[1], [10.0, 5.0]), "{cable:?}");
        assert_eq!(trace(&flown(), 20.0)[2], (2.0, [4.0, 4.0]));
        // Without shapes to compare with, cables are where they are.
        let bare = Flown { shapes: Vec::new(), ..flown() };
        let cable = &Instant::new(&bare, 1.0, 20.0).expect("samples").cables[0];
        assert!(near(cable.nodes[0], [2.0, 0.1]) && cable.quasi_static.is_empty());
    }

    #[test]
    fn before_and_after_it_is_as_at_the_ends_and_what_follows_slack_is_doubtful() {
        let flown = flown();
        let at = |time| Instant::new(&flown, time, 1.0).expect("samples");
        assert_eq!((at(-1.0).on_path, at(99.0).on_path), ([0.0, 0.0], [4.0, 0.0]));
        assert!(!at(1.49).doubtful && at(1.5).doubtful && at(2.0).doubtful);
        let mut empty = flown.clone();
        empty.flight.samples.clear();
        assert_eq!(Instant::new(&empty, 1.0, 1.0), None);
        // A flight with one sample stands still.
        let mut one = flown.clone();
        one.flight.samples.truncate(1);
        assert!(Instant::new(&one, 1.0, 1.0).is_some_and(|instant| near(instant.on_path, [0.0, 0.0])));
    }
}
