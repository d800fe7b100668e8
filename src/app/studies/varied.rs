//! The studies behind the plot "What if", with the scenario that they depend on.

use crate::app::what_if::{Range, WhatIfView};
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::scenario::{Parameter, Scenario};
use crate::study::{Reach, Study, Varied, WhatIf};

/// Values of one number.
const VALUES: usize = 81;
/// Values of two numbers.
const GRID: [usize; 2] = [31, 21];
/// Stretches in which a wanted critical speed is looked for.
const STRETCHES: usize = 41;

/// The studies that are wanted, each with a scenario that is the same whatever the varied numbers are.
pub fn varied(scenario: &Scenario, view: &WhatIfView) -> Vec<(Scenario, Study)> {
    let limit = DEFAULT_MAX_SPEED;
    let ranged = view.numbers(scenario).into_iter().map(|number| Some((number, view.range(number)?)));
    let Some(numbers) = ranged.collect::<Option<Vec<(Parameter, Range)>>>().filter(|numbers| !numbers.is_empty())
    else {
        return Vec::new();
    };
    let values = |(number, range): (Parameter, Range), count: usize| Varied {
        path: number.path(),
        values: range.values(count, number == Parameter::Elements),
    };
    let counts = if numbers.len() > 1 { GRID } else { [VALUES; 2] };
    let all: Vec<Varied> = numbers.iter().zip(counts).map(|(number, count)| values(*number, count)).collect();
    let mut studies = vec![(independent(scenario, &numbers), Study::WhatIf(WhatIf { numbers: all, limit }))];
    if view.reaches && view.target > 0.0 && view.target <= limit {
        let number = values(numbers[0], STRETCHES);
        let study = Study::Reach(Reach { number, target: view.target, limit });
        studies.push((independent(scenario, &numbers[..1]), study));
    }
    studies
}

/// The scenario with values of the varied numbers that follow from their ranges, so that it does not change where one of
/// these numbers does. Of a range without a physical value it is the scenario as it is.
fn independent(scenario: &Scenario, numbers: &[(Parameter, Range)]) -> Scenario {
    let Ok((_, motion)) = scenario.to_robot() else { return scenario.clone() };
    let mut fixed = Scenario { name: None, path: None, ..scenario.clone() };
    // No critical speed depends on the present one, or on the length of the direction.
    fixed.motion.direction = motion.direction().into();
    fixed.motion.speed = 0.0;
    let places = [0.0, 0.5, 1.0];
    let at = |Range { ends: [low, high], .. }: Range, part: f64| low + part * (high - low);
    for first in places {
        for second in places {
            let mut varied = fixed.clone();
            for ((number, range), part) in numbers.iter().zip([first, second]) {
                number.set(&mut varied, at(*range, part));
            }
            if varied.to_robot().is_ok() {
                return varied;
            }
        }
    }
    fixed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Path, presets};

    fn view(numbers: &[(Parameter, [f64; 2])]) -> WhatIfView {
        let mut view = WhatIfView::default();
        view.number = numbers.first().map(|(number, _)| *number);
        view.against = numbers.get(1).map(|(number, _)| *number);
        for (number, ends) in numbers {
            view.set_range(*number, Range { ends: *ends, own: false });
        }
        view
    }

    #[test]
    fn a_study_depends_on_everything_but_what_it_varies() {
        let paper = presets::PRESETS[0].scenario();
        let mass = [(Parameter::PlatformMass, [1.0, 4.0])];
        let mut view = view(&mass);
        view.target = 8.0;
        view.reaches = true;
        let studies = |edit: fn(&mut Scenario)| {
            let mut scenario = paper.clone();
            edit(&mut scenario);
            varied(&scenario, &view)
        };
        let as_it_is = studies(|_| {});
        assert_eq!(as_it_is.len(), 2);
        let same: [fn(&mut Scenario); 5] = [
            |s| s.platform.mass = 3.5,
            |s| s.motion.speed = 9.0,
            |s| s.motion.direction = [4.0, 0.0],
            |s| s.name = Some("Another".into()),
            |s| s.path = Some(Path::new(vec![[6.0, 0.0]], 5.0)),
        ];
        for edit in same {
            assert_eq!(studies(edit), as_it_is);
        }
        let other: [fn(&mut Scenario); 4] = [
            |s| s.cable.youngs_modulus *= 2.0,
            |s| s.motion.position = [1.0, 0.0],
            |s| s.motion.direction = [0.0, 1.0],
            |s| s.elements_per_cable = 12,
        ];
        for edit in other {
            let after = studies(edit);
            assert!(after.iter().zip(&as_it_is).all(|(after, before)| after != before));
        }
    }

    #[test]
    fn the_scenario_of_a_study_is_physical_where_a_value_of_the_range_is() {
        let paper = presets::PRESETS[0].scenario();
        let two = [(Parameter::Alpha, [-1.0, 1.0]), (Parameter::PlatformMass, [-2.0, 2.0])];
        let studies = varied(&paper, &view(&two));
        let [(scenario, Study::WhatIf(what_if))] = &studies[..] else { panic!("{studies:?}") };
        assert!(scenario.to_robot().is_ok(), "a worker refuses any other");
        assert_eq!(what_if.len(), GRID[0] * GRID[1]);
        let nothing = varied(&paper, &WhatIfView::default());
        assert!(nothing.is_empty());
    }
}
