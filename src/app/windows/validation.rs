//! The checks of known numbers, computed anew where the program runs.

use eframe::egui::{Button, Grid, Label, RichText, Ui};

use crate::app::command::Command;
use crate::app::meaning::Explain as _;
use crate::app::theme;
use crate::compute::protocol::CheckResult;
use crate::study::validation::Comparison;

/// On a screen with less width, in points, the numbers of a check go below its name.
const NARROW: f32 = 760.0;

/// How far the checks have come.
#[derive(Debug, Default)]
pub struct Run {
    /// Of the first ones, in their order.
    answers: Vec<CheckResult>,
    /// The next one has been asked for.
    asked: bool,
}

impl Run {
    /// Takes an answer in, unless an earlier run has asked for it.
    pub fn take(&mut self, answer: CheckResult) {
        if answer.index == self.answers.len() {
            self.answers.push(answer);
            self.asked = false;
        }
    }

    /// Whether an answer is to come.
    pub fn is_waiting(&self) -> bool {
        self.asked
    }

    /// What has been asked for will not be answered.
    pub fn ask_again(&mut self) {
        self.asked = false;
    }

    /// Asks for the next check, if one is left.
    fn step(&mut self, commands: &mut Vec<Command>) {
        if !self.asked && !self.is_done() {
            self.asked = true;
            commands.push(Command::Check(self.answers.len()));
        }
    }

    fn passed(&self) -> usize {
        self.answers.iter().filter(|answer| passes(answer)).count()
    }

    /// Whether all are done.
    pub fn is_done(&self) -> bool {
        self.answers.first().is_some_and(|first| self.answers.len() == first.count)
    }

    /// How many pass, or how far it has come.
    pub fn summary(&self) -> String {
        let (done, passed) = (self.answers.len(), self.passed());
        if self.is_done() { format!("{passed} of {done} checks pass.") } else { format!("Computing: {done} are done.") }
    }
}

fn passes(answer: &CheckResult) -> bool {
    answer.comparison.as_ref().is_ok_and(Comparison::passes)
}

/// Draws the checks, and asks for the next one.
pub fn ui(run: &mut Run, ui: &mut Ui, commands: &mut Vec<Command>) {
    run.step(commands);
    ui.label(
        "Numbers that are known from closed forms or from programs that share nothing with this one, beside what \
         Tautline computes for them: now, on this device, anew each time this window is opened. A check passes when \
         the two differ by no more than what is allowed, which is what the mesh or the digits of the source leave.",
    );
    ui.add_space(4.0);
    ui.horizontal_wrapped(|ui| {
        let summary = RichText::new(run.summary()).strong();
        if run.passed() < run.answers.len() {
            ui.colored_label(theme::warning(ui.visuals()), "▲");
        }
        ui.label(summary);
        if ui.add_enabled(run.is_done(), Button::new("Run again")).clicked() {
            *run = Run::default();
        }
    });
    ui.separator();
    if ui.ctx().content_rect().width() < NARROW { narrow(ui, run) } else { wide(ui, run) }
}

fn wide(ui: &mut Ui, run: &Run) {
    Grid::new("validation").num_columns(5).striped(true).spacing([12.0, 6.0]).show(ui, |ui| {
        let titles = [
            ("Check", "What is computed, and where its expected value comes from."),
            ("Expected", "The value that is known."),
            ("Got", "What Tautline has computed here, just now."),
            ("Error (allowed)", "By how much the two differ, and how much is allowed."),
        ];
        for (title, meaning) in titles {
            ui.strong(title).explained(meaning);
        }
        ui.label("");
        ui.end_row();
        for answer in &run.answers {
            ui.vertical(|ui| {
                ui.set_width(230.0);
                name(ui, answer);
            });
            if let Ok(comparison) = answer.comparison {
                let [expected, got] = values(&answer.unit, comparison);
                ui.label(expected);
                ui.label(got);
                ui.label(difference(comparison));
            } else {
                (0..3).for_each(|_| drop(ui.label("–")));
            }
            verdict(ui, answer);
            ui.end_row();
        }
    });
}

fn narrow(ui: &mut Ui, run: &Run) {
    for answer in &run.answers {
        name(ui, answer);
        if let Ok(comparison) = answer.comparison {
            let [expected, got] = values(&answer.unit, comparison);
            Grid::new(&answer.name).num_columns(2).spacing([12.0, 2.0]).show(ui, |ui| {
                for (title, value) in
                    [("Expected", expected), ("Got", got), ("Error (allowed)", difference(comparison))]
                {
                    ui.weak(title);
                    ui.label(value);
                    ui.end_row();
                }
            });
        }
        verdict(ui, answer);
        ui.separator();
    }
}

fn name(ui: &mut Ui, answer: &CheckResult) {
    ui.add(Label::new(&answer.name).wrap());
    ui.add(Label::new(RichText::new(&answer.source).weak().size(11.0)).wrap());
}

/// Expected and computed value, with as many digits as the tolerance gives a meaning to, and one more.
fn values(unit: &str, comparison: Comparison) -> [String; 2] {
    // Of a tolerance that is no positive number the conversion makes 0 digits.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let decimals = ((1.0 - comparison.tolerance.log10().floor()) as usize).min(13);
    [comparison.expected, comparison.got].map(|value| format!("{value:.decimals$} {unit}").trim_end().to_owned())
}

fn difference(comparison: Comparison) -> String {
    let error = comparison.error();
    // Nothing to write with an exponent.
    let error = if error == 0.0 { "0".to_owned() } else { format!("{error:.1e}") };
    format!("{error} ({:.1e})", comparison.tolerance)
}

fn verdict(ui: &mut Ui, answer: &CheckResult) {
    let (calm, warning) = (theme::calm(ui.visuals()), theme::warning(ui.visuals()));
    match &answer.comparison {
        Ok(comparison) if comparison.passes() => ui.colored_label(calm, "passes"),
        Ok(_) => ui.colored_label(warning, "▲ fails"),
        Err(reason) => ui.colored_label(warning, format!("▲ fails: {reason}")),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: Comparison = Comparison { expected: 1.0, got: 1.0004, tolerance: 1e-3 };
    const COUNT: usize = 4;

    fn answer(index: usize, comparison: Result<Comparison, String>) -> CheckResult {
        let (name, source, unit) = ("a length".into(), "closed form".into(), "m".into());
        CheckResult { index, count: COUNT, name, source, unit, comparison }
    }

    fn take_all(comparisons: [Result<Comparison, String>; COUNT]) -> Run {
        let mut run = Run::default();
        for (index, comparison) in comparisons.into_iter().enumerate() {
            let mut commands = Vec::new();
            run.step(&mut commands);
            run.step(&mut commands);
            assert!(matches!(commands[..], [Command::Check(asked)] if asked == index), "{commands:?}");
            assert_eq!(run.summary(), format!("Computing: {index} are done."));
            run.take(answer(index, comparison));
        }
        let mut commands = Vec::new();
        run.step(&mut commands);
        assert!(commands.is_empty(), "all are done: {commands:?}");
        run
    }

    #[test]
    fn the_summary_counts_what_passes_and_waits_for_all() {
        let good = || Ok(GOOD);
        assert_eq!(take_all([good(), good(), good(), good()]).summary(), "4 of 4 checks pass.");
        let wrong = |got: f64| Ok(Comparison { got, ..GOOD });
        let run = take_all([wrong(2.0), Err("There is no mode.".into()), wrong(f64::NAN), good()]);
        assert_eq!(run.summary(), "1 of 4 checks pass.");
    }

    #[test]
    fn answers_to_an_earlier_run_are_not_taken_in() {
        let mut run = Run::default();
        run.take(answer(2, Ok(GOOD)));
        assert_eq!(run.summary(), "Computing: 0 are done.");
    }

    #[test]
    fn values_have_the_digits_that_count() {
        assert_eq!(values("m/s", GOOD), ["1.0000 m/s", "1.0004 m/s"]);
        assert_eq!(values("", Comparison { tolerance: 0.5, ..GOOD }), ["1.00", "1.00"]);
        for tolerance in [f64::NAN, 0.0, 1e-300, f64::INFINITY] {
            assert!(values("", Comparison { tolerance, ..GOOD })[0].len() < 20);
        }
    }
}
