//! What can be said of critical speeds along a line: the paper's two findings, each on the stretch where it holds.

use std::ops::Range;

use super::Along;
use super::segments::{Sample, segments};
use crate::scenario::report::sentence;

/// A finding counts from this number of places on …
const PLACES: usize = 5;
/// … and where the quantity changes by this part altogether.
const CHANGE: f64 = 0.02;

impl Along {
    /// The paper's two findings, each on the stretches where it holds from place to place: toward the border the critical
    /// speed falls, and the frequency rises.
    pub fn findings(&self) -> Option<String> {
        let samples = self.samples();
        let mut found = findings(&samples);
        found.retain(|finding| finding.holds(&samples));
        told(self, &found)
    }
}

/// What a finding is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The critical speed falls toward the border.
    Speed,
    /// Its frequency rises toward the border.
    Frequency,
}

/// One of the paper's findings on one stretch: from place to place outward the critical speed falls, or its frequency
/// rises, without a jump to another mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// What it is about.
    pub quantity: Quantity,
    /// The stretch in m, from within toward the border.
    pub stretch: [f64; 2],
}

impl Finding {
    /// Whether the samples, by rising place, say so.
    pub fn holds(&self, samples: &[Option<Sample>]) -> bool {
        let [from, to] = self.stretch;
        let within = from.min(to)..=from.max(to);
        let mut run: Vec<usize> =
            (0..samples.len()).filter(|&i| samples[i].is_some_and(|sample| within.contains(&sample.at))).collect();
        if from > to {
            run.reverse();
        }
        let of_one_mode = segments(samples).iter().any(|segment| run.iter().all(|i| segment.contains(i)));
        of_one_mode
            && run.len() >= PLACES
            && run.windows(2).all(|pair| self.quantity.goes_on(samples, pair[0], pair[1]))
    }
}

impl Quantity {
    /// Whether it goes on as the finding says from one place to the next one outward.
    fn goes_on(self, samples: &[Option<Sample>], from: usize, to: usize) -> bool {
        match (samples[from], samples[to]) {
            (Some(Sample { values: from, .. }), Some(Sample { values: to, .. })) => match self {
                Self::Speed => to[0] < from[0],
                Self::Frequency => to[1] > from[1],
            },
            _ => false,
        }
    }

    /// The part by which it changes between two places.
    fn change(self, samples: &[Option<Sample>], from: usize, to: usize) -> f64 {
        let value = |i: usize| {
            samples[i].map_or(f64::NAN, |sample| match self {
                Self::Speed => sample.values[0],
                Self::Frequency => sample.values[1],
            })
        };
        (value(to) - value(from)).abs() / value(from).abs()
    }
}

/// On either side of the middle of the longest taut stretch, and for each quantity, the longest stretch on which it holds.
fn findings(samples: &[Option<Sample>]) -> Vec<Finding> {
    // What is taut in one piece, whatever its modes.
    let mut taut: Option<Range<usize>> = None;
    let mut i = 0;
    while i < samples.len() {
        let run = samples[i..].iter().take_while(|sample| sample.is_some()).count();
        if run > taut.as_ref().map_or(0, Range::len) {
            taut = Some(i..i + run);
        }
        i += run + 1;
    }
    let Some(taut) = taut else { return Vec::new() };
    let middle = taut.start + taut.len() / 2;
    let mut findings = Vec::new();
    for quantity in [Quantity::Speed, Quantity::Frequency] {
        for leftward in [true, false] {
            let mut longest: Option<[usize; 2]> = None;
            for segment in segments(samples) {
                let part = if leftward {
                    segment.start.max(taut.start)..segment.end.min(middle + 1)
                } else {
                    segment.start.max(middle)..segment.end.min(taut.end)
                };
                let outward: Vec<usize> = if leftward { part.rev().collect() } else { part.collect() };
                let mut begin = 0;
                for end in 0..outward.len() {
                    if end > 0 && !quantity.goes_on(samples, outward[end - 1], outward[end]) {
                        begin = end;
                    }
                    let length = |[from, to]: [usize; 2]| from.abs_diff(to);
                    let run = [outward[begin], outward[end]];
                    if longest.is_none_or(|longest| length(run) > length(longest)) {
                        longest = Some(run);
                    }
                }
            }
            let Some([from, to]) = longest else { continue };
            if from.abs_diff(to) + 1 >= PLACES
                && quantity.change(samples, from, to) >= CHANGE
                && let (Some(from), Some(to)) = (samples[from], samples[to])
            {
                findings.push(Finding { quantity, stretch: [from.at, to.at] });
            }
        }
    }
    findings
}

/// The findings in a sentence; `None` where there are none.
fn told(along: &Along, findings: &[Finding]) -> Option<String> {
    let stretches = |quantity| {
        let all = findings.iter().filter(|finding| finding.quantity == quantity);
        let named: Vec<String> = all.map(|finding| stretch(along, finding.stretch)).collect();
        (!named.is_empty()).then(|| named.join(" and "))
    };
    let text = match (stretches(Quantity::Speed), stretches(Quantity::Frequency)) {
        (Some(falls), Some(rises)) if falls == rises => {
            format!("{falls} the critical speed falls and the frequency rises, as the paper found toward the border")
        }
        (Some(falls), Some(rises)) => {
            format!(
                "the critical speed falls {falls}, and the frequency rises {rises}, as the paper found toward the border"
            )
        }
        (Some(falls), None) => format!("{falls} the critical speed falls, as the paper found toward the border"),
        (None, Some(rises)) => format!("{rises} the frequency rises, as the paper found toward the border"),
        (None, None) => return None,
    };
    Some(sentence(&text))
}

/// A stretch in words: nothing beyond it, in as many digits as tell its places apart.
fn stretch(along: &Along, [from, to]: [f64; 2]) -> String {
    let spacing = (along.range[1] - along.range[0]) / along.points.len().max(2) as f64;
    // Of a length in m: from -9 to 9 or so.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let decimals = (-spacing.log10().floor()).clamp(0.0, 9.0) as usize;
    let unit = 10.0_f64.powf(-(decimals as f64));
    // Inward by less than a place; what rounding has moved outward is none of it.
    let inward = |at: f64, other: f64| {
        let steps = at / unit;
        let steps = if at < other { (steps - 1e-6).ceil() } else { (steps + 1e-6).floor() };
        steps * unit + 0.0
    };
    let [from, to] = [inward(from, to), inward(to, from)].map(|at| along.abscissa.place(at, decimals));
    format!("from {from} to {to}")
}

#[cfg(test)]
mod tests {
    use super::super::Abscissa;
    use super::*;
    use crate::stability::{Critical, Instability};
    use crate::study::Verdict;
    use nalgebra::Complex;
    use std::f64::consts::TAU;

    /// Numbers from 0 to 1, the same in every run.
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        }

        /// A whole number below `end`.
        fn below(&mut self, end: f64) -> usize {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Small and not negative.
            let number = (self.next() * end) as usize;
            number
        }
    }

    fn critical(speed: f64, frequency_hz: f64, cable: usize) -> Critical {
        Critical { speed, eigenvalue: Complex::new(0.0, frequency_hz * TAU), kind: Instability::Flutter, cable }
    }

    /// A line of some modes, each smooth, with gaps, on a robot of some size.
    fn line(random: &mut Random) -> Along {
        let (count, size) = (20 + random.below(180.0), 10.0_f64.powf(3.0 * random.next() - 1.5));
        let mut points = Vec::new();
        let (mut left, mut cable, mut curve) = (0, 0, [0.0; 6]);
        for i in 0..count {
            if left == 0 {
                left = 1 + random.below(0.6 * count as f64);
                // Another mode, or none.
                cable = random.below(5.0);
                curve = [0; 6].map(|_| 2.0 * random.next() - 1.0);
            }
            left -= 1;
            let at = size * (2.0 * i as f64 / (count - 1) as f64 - 1.0);
            let [a, b, c, d, e, f] = curve;
            let x = at / size;
            let speed = 10.0 + 3.0 * a + 4.0 * b * x + 3.0 * c * (6.0 * x).sin();
            let frequency_hz = (1.0 + d + e * x * x + f * (5.0 * x).cos()).max(0.0);
            let verdict = if cable == 0 {
                Verdict::Infeasible
            } else {
                Verdict::Critical(critical(speed, frequency_hz, cable - 1))
            };
            points.push((at, verdict));
        }
        let range = [points[0].0, points[count - 1].0];
        let (from, wave_limits) = ([range[0], 0.0], Vec::new());
        Along { abscissa: Abscissa::X, points, wave_limits, range, from, direction: [1.0, 0.0] }
    }

    /// The stretches that a sentence names before or after `words`: pairs of numbers, read as a person would.
    fn named(text: &str, quantity: Quantity) -> Vec<[f64; 2]> {
        let lower = text.to_lowercase();
        let both = lower.contains("the critical speed falls and the frequency rises");
        let part = match (quantity, lower.split_once(", and the frequency rises")) {
            _ if both => lower.clone(),
            (Quantity::Speed, Some((before, _))) => before.to_owned(),
            (Quantity::Frequency, Some((_, after))) => after.to_owned(),
            (Quantity::Speed, None) if lower.contains("critical speed falls") => lower.clone(),
            (Quantity::Frequency, None) if lower.contains("frequency rises") => lower.clone(),
            _ => String::new(),
        };
        let numbers: Vec<f64> = part
            .split("x = ")
            .skip(1)
            .map(|rest| rest.split_once(" m").expect("a unit").0.parse().expect("a number"))
            .collect();
        numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    /// Whatever the curve, what the sentence says of a stretch is so at every place of it, and no other mode or gap lies
    /// in it.
    #[test]
    fn a_finding_holds_on_the_whole_stretch_that_it_names() {
        let mut random = Random(3);
        let (mut told, mut silent) = (0, 0);
        for _ in 0..3000 {
            let along = line(&mut random);
            let Some(text) = along.findings() else {
                silent += 1;
                continue;
            };
            for quantity in [Quantity::Speed, Quantity::Frequency] {
                for [from, to] in named(&text, quantity) {
                    told += 1;
                    let mut within: Vec<&(f64, Verdict)> =
                        along.points.iter().filter(|(at, _)| (from.min(to)..=from.max(to)).contains(at)).collect();
                    if from > to {
                        within.reverse();
                    }
                    assert!(within.len() + 2 >= PLACES, "{text}: {} places", within.len());
                    // Outward: away from the middle of what is named.
                    for pair in within.windows(2) {
                        let (Verdict::Critical(a), Verdict::Critical(b)) = (&pair[0].1, &pair[1].1) else {
                            panic!("{text}: a gap at {}", pair[0].0)
                        };
                        assert_eq!(a.cable, b.cable, "{text}: another mode at {}", pair[1].0);
                        match quantity {
                            Quantity::Speed => assert!(b.speed < a.speed, "{text}: not at {}", pair[1].0),
                            Quantity::Frequency => {
                                assert!(b.frequency_hz() > a.frequency_hz(), "{text}: not at {}", pair[1].0);
                            }
                        }
                    }
                }
            }
        }
        assert!(told > 3000 && silent > 20, "{told} told, silent {silent} times");
    }

    /// A frequency that peaks on the way and falls to zero does not rise to the border.
    #[test]
    fn a_peak_on_the_way_ends_what_is_told() {
        let points = (0..41)
            .map(|i| {
                let x = -5.0 + 0.25 * f64::from(i);
                let frequency_hz = if x < 3.0 { 0.5 + x.max(0.0) } else { (3.5 - 2.0 * (x - 3.0)).max(0.0) };
                (x, Verdict::Critical(critical(9.0, frequency_hz, 0)))
            })
            .collect();
        let (from, wave_limits) = ([-5.0, 0.0], Vec::new());
        let (abscissa, direction) = (Abscissa::X, [1.0, 0.0]);
        let along = Along { abscissa, points, wave_limits, range: [-5.0, 5.0], from, direction };
        let text = along.findings().expect("a finding");
        assert_eq!(text, "From x = 0.0 m to x = 3.0 m the frequency rises, as the paper found toward the border.");
    }
}
