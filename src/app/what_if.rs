//! What the plot "What if" is asked: which numbers are varied, over which ranges, and which critical speed is looked for.

use crate::scenario::{Parameter, Scenario};
use crate::study::evenly;

/// From this ratio of its ends on, equal ways of a range are equal ratios.
const WIDE: f64 = 8.0;

/// What the plot "What if" is asked.
#[derive(Clone, Debug, Default)]
pub struct WhatIfView {
    /// The number that is varied; `None` until the plot has been opened.
    pub number: Option<Parameter>,
    /// A second number: the plot is a map then.
    pub against: Option<Parameter>,
    /// The ranges of all numbers that have been looked at.
    ranges: Vec<(Parameter, Range)>,
    /// The wanted critical speed in m/s; 0 until there is a first one.
    pub target: f64,
    /// Whether a value is looked for at which the critical speed is the wanted one.
    pub reaches: bool,
}

/// The range over which a number is varied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// From and to, in SI units, the smaller one first.
    pub ends: [f64; 2],
    /// Whether a person has chosen it.
    pub own: bool,
}

impl WhatIfView {
    /// Varies this number alone.
    pub fn choose(&mut self, parameter: Parameter) {
        self.number = Some(parameter);
        self.against = self.against.filter(|other| *other != parameter);
        self.reaches = false;
    }

    /// The numbers that are varied and that `scenario` has.
    pub fn numbers(&self, scenario: &Scenario) -> Vec<Parameter> {
        let all = [self.number, self.against].into_iter().flatten();
        all.filter(|parameter| parameter.is_in(scenario)).collect()
    }

    /// The range of a number.
    pub fn range(&self, parameter: Parameter) -> Option<Range> {
        self.ranges.iter().find(|(other, _)| *other == parameter).map(|(_, range)| *range)
    }

    /// Gives a number another range; ends that do not make one are ignored.
    pub fn set_range(&mut self, parameter: Parameter, range: Range) {
        let [low, high] = range.ends;
        if low < high && (high - low).is_finite() {
            self.forget(parameter);
            self.ranges.push((parameter, range));
        }
    }

    /// Forgets the range of a number.
    pub fn forget(&mut self, parameter: Parameter) {
        self.ranges.retain(|(other, _)| *other != parameter);
    }
}

impl Range {
    /// Whether equal ways of it are equal ratios.
    pub fn is_logarithmic(self) -> bool {
        self.ends[0] > 0.0 && self.ends[1] > WIDE * self.ends[0]
    }

    /// Values from end to end, `count` of them; of a number that is whole, whole ones, each once.
    pub fn values(self, count: usize, whole: bool) -> Vec<f64> {
        let [low, high] = self.ends;
        let logarithmic = self.is_logarithmic();
        let value = |i: usize| match i {
            0 => low,
            _ if i + 1 == count => high,
            _ if logarithmic => evenly(low.ln(), high.ln(), i, count).exp(),
            _ => evenly(low, high, i, count),
        };
        let mut values: Vec<f64> = (0..count).map(value).collect();
        if whole {
            for value in &mut values {
                *value = value.round();
            }
        }
        values.dedup();
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_spaced_evenly_or_by_ratios() {
        let range = |low, high| Range { ends: [low, high], own: false };
        assert_eq!(range(1.0, 3.0).values(5, false), [1.0, 1.5, 2.0, 2.5, 3.0]);
        let wide = range(1.0, 100.0).values(3, false);
        assert!((wide[1] - 10.0).abs() < 1e-12 && wide[2] > 99.999, "{wide:?}");
        assert_eq!(range(2.0, 5.0).values(9, true), [2.0, 3.0, 4.0, 5.0]);
        assert!(!range(-1.0, 100.0).is_logarithmic() && !range(0.0, 1.0).is_logarithmic());
    }

    #[test]
    fn ranges_are_kept_for_each_number_and_never_empty() {
        let mut view = WhatIfView::default();
        let range = |low, high| Range { ends: [low, high], own: true };
        view.set_range(Parameter::Area, range(1.0, 2.0));
        view.set_range(Parameter::Gravity, range(0.0, 20.0));
        view.set_range(Parameter::Area, range(3.0, 3.0));
        view.set_range(Parameter::Area, range(3.0, f64::NAN));
        assert_eq!(view.range(Parameter::Area), Some(range(1.0, 2.0)));
        view.forget(Parameter::Area);
        assert_eq!((view.range(Parameter::Area), view.range(Parameter::Gravity)), (None, Some(range(0.0, 20.0))));
        view.against = Some(Parameter::Beta);
        view.choose(Parameter::Beta);
        assert_eq!((view.number, view.against), (Some(Parameter::Beta), None));
    }
}
