//! An axis: which numbers it shows, where they are on the screen, and which of them are written beside it.

use crate::app::round::round_step;

/// Nothing is drawn farther away than this many lengths of the axis, since the screen's numbers end somewhere.
const FARTHEST: f64 = 1e4;

/// An axis of a chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The numbers at its two ends.
    pub range: [f64; 2],
    /// Where these are on the screen, in points.
    pub ends: [f32; 2],
    /// Whether equal ways are equal ratios, rather than equal differences.
    pub logarithmic: bool,
}

impl Axis {
    /// An axis on which equal ways are equal differences.
    pub fn linear(range: [f64; 2], ends: [f32; 2]) -> Self {
        Self { range, ends, logarithmic: false }
    }

    fn scaled(&self, value: f64) -> f64 {
        if self.logarithmic { value.max(f64::MIN_POSITIVE).log10() } else { value }
    }

    /// Where a number is on the screen, in points.
    pub fn pos(&self, value: f64) -> f32 {
        let [low, high] = self.range.map(|end| self.scaled(end));
        let part = (self.scaled(value) - low) / (high - low);
        let part = if part.is_nan() { 0.0 } else { part.clamp(-FARTHEST, FARTHEST) };
        #[expect(clippy::cast_possible_truncation)] // Screen coordinates are f32.
        let part = part as f32;
        self.ends[0] + part * (self.ends[1] - self.ends[0])
    }

    /// Which number is at a point of the screen.
    pub fn value(&self, pos: f32) -> f64 {
        let [low, high] = self.range.map(|end| self.scaled(end));
        let part = f64::from((pos - self.ends[0]) / (self.ends[1] - self.ends[0]));
        let value = low + part * (high - low);
        if self.logarithmic { 10.0_f64.powf(value) } else { value }
    }

    /// By how much the number changes per point of the screen, where equal ways are equal differences.
    pub fn per_point(&self) -> f64 {
        ((self.range[1] - self.range[0]) / f64::from(self.ends[1] - self.ends[0])).abs()
    }

    /// Round numbers to write, about `most` of them at most.
    pub fn ticks(&self, most: usize) -> Vec<f64> {
        let [low, high] = self.range;
        let usable = low.is_finite() && high.is_finite() && high > low && most > 0;
        match (usable, self.logarithmic) {
            (false, _) => Vec::new(),
            (true, false) => evenly_spaced(low, high, most),
            (true, true) => by_decades(low, high, most),
        }
    }

    /// What is written beside these numbers: as many decimals as tell them apart, and a proper minus.
    pub fn texts(&self, ticks: &[f64]) -> Vec<String> {
        let step = ticks.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(f64::INFINITY, f64::min);
        let alone = ticks.first().map(|tick| tick.abs()).filter(|tick| *tick > 0.0);
        let step = if step.is_finite() { step } else { alone.unwrap_or(1.0) };
        // From 0 to 9.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let decimals = (-step.max(1e-9).log10() - 1e-9).ceil().clamp(0.0, 9.0) as usize;
        let text = |&tick: &f64| {
            if self.logarithmic {
                // One digit each, whatever its size.
                let round: f64 = format!("{tick:.0e}").parse().unwrap_or(tick);
                round.to_string()
            } else if step >= 1e6 || (step < 1e-6 && tick != 0.0) {
                format!("{tick:.1e}")
            } else {
                // Not -0.
                format!("{:.decimals$}", tick + 0.0)
            }
        };
        ticks.iter().map(|tick| signed(&text(tick))).collect()
    }
}

fn evenly_spaced(low: f64, high: f64, most: usize) -> Vec<f64> {
    let step = round_step((high - low) / most as f64);
    // The step follows the range: these are small, and so few.
    #[expect(clippy::cast_possible_truncation)]
    let (first, last) = ((low / step - 1e-4).ceil() as i64, (high / step + 1e-4).floor() as i64);
    (first..=last).take(2 * most + 2).map(|tick| tick as f64 * step).collect()
}

/// 1, 2 and 5 times powers of ten. Where these are more than `most`, some are left out.
fn by_decades(low: f64, high: f64, most: usize) -> Vec<f64> {
    // Of a positive range of numbers: from -308 to 308.
    #[expect(clippy::cast_possible_truncation)]
    let decades = [low, high].map(|end| end.max(f64::MIN_POSITIVE).log10().floor() as i32);
    let all: Vec<f64> = (decades[0]..=decades[1])
        .flat_map(|decade| [1.0, 2.0, 5.0].map(|digit| digit * 10.0_f64.powi(decade)))
        .filter(|tick| (0.999 * low..=1.001 * high).contains(tick))
        .collect();
    let each = all.len().div_ceil(most);
    all.into_iter().step_by(each.max(1)).collect()
}

/// A number's text with a proper minus in front.
pub fn signed(text: &str) -> String {
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_go_to_the_screen_and_back() {
        let linear = Axis::linear([-10.0, 10.0], [100.0, 500.0]);
        assert!((linear.pos(0.0) - 300.0).abs() < 1e-3 && (linear.value(400.0) - 5.0).abs() < 1e-6);
        assert!((linear.per_point() - 0.05).abs() < 1e-9);
        // Upward on the screen y falls.
        let hertz = Axis { range: [0.1, 10.0], ends: [200.0, 0.0], logarithmic: true };
        assert!((hertz.pos(1.0) - 100.0).abs() < 1e-3 && (hertz.value(50.0) - 10.0_f64.sqrt()).abs() < 1e-4);
        // Far away is far away, and no number is nowhere.
        assert!(linear.pos(f64::INFINITY) > 1e5 && Axis::linear([0.0, 0.5], [0.0, 100.0]).pos(f64::MAX) > 1e5);
        assert!(hertz.pos(0.0).is_finite() && linear.pos(f64::NAN).is_finite());
    }

    #[test]
    fn what_is_written_is_round_and_has_room() {
        let axis = Axis::linear([-10.0, 10.0], [0.0, 580.0]);
        assert_eq!(axis.texts(&axis.ticks(4)), ["−10", "−5", "0", "5", "10"]);
        let growth = Axis::linear([-0.5, 0.1], [0.0, 222.0]);
        assert_eq!(growth.texts(&growth.ticks(3)), ["−0.4", "−0.2", "0.0"]);
        let hertz = Axis { range: [0.2, 5.0], ends: [0.0, 40.0], logarithmic: true };
        assert_eq!(hertz.texts(&hertz.ticks(3)), ["0.2", "1", "5"]);
        assert_eq!(axis.texts(&[0.0]), ["0"]);
        assert!(Axis::linear([1.0, 1.0], [0.0, 1.0]).ticks(4).is_empty());
        assert!(Axis::linear([f64::NAN, 1.0], [0.0, 1.0]).ticks(4).is_empty());
    }
}
