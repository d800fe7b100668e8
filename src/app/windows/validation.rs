//! The checks of known numbers, computed anew where the program runs.

use eframe::egui::{Button, Context, Grid, Label, RichText, Ui};

use crate::app::theme;
use crate::study::validation::{CHECKS, Check, Failed, Outcome};

/// On a screen with less width, in points, the numbers of a check go below its name.
const NARROW: f32 = 760.0;

/// How far the checks have come.
#[derive(Debug, Default)]
pub struct Run {
    /// Of the first of [`CHECKS`], in their order.
    results: Vec<Result<Outcome, Failed>>,
}

impl Run {
    /// Does the next check, if one is left, and asks for a further frame.
    ///
    /// One in a frame: together they take long enough for the interface to halt.
    fn step(&mut self, context: &Context) {
        if let Some(check) = CHECKS.get(self.results.len()) {
            self.results.push((check.run)());
            context.request_repaint();
        }
    }

    fn passed(&self) -> usize {
        self.results.iter().filter(|result| passes(result)).count()
    }

    fn is_done(&self) -> bool {
        self.results.len() == CHECKS.len()
    }

    fn summary(&self) -> String {
        let (all, passed) = (CHECKS.len(), self.passed());
        if self.is_done() {
            format!("{passed} of {all} checks pass.")
        } else {
            format!("Computing: {} of {all} are done.", self.results.len())
        }
    }
}

fn passes(result: &Result<Outcome, Failed>) -> bool {
    result.as_ref().is_ok_and(Outcome::passes)
}

/// Draws the checks, and does the next one.
pub fn ui(ui: &mut Ui, run: &mut Run) {
    run.step(ui.ctx());
    ui.label(
        "Numbers that are known from closed forms or from programs that share nothing with this one, beside what \
         Tautline computes for them: now, on this device, anew each time this window is opened. A check passes when \
         the two differ by no more than what is allowed, which is what the mesh or the digits of the source leave.",
    );
    ui.add_space(4.0);
    ui.horizontal_wrapped(|ui| {
        let summary = RichText::new(run.summary()).strong();
        if run.passed() < run.results.len() {
            ui.colored_label(theme::warning(ui.visuals()), "▲");
        }
        ui.label(summary);
        if ui.add_enabled(run.is_done(), Button::new("Run again")).clicked() {
            *run = Run::default();
            ui.ctx().request_repaint();
        }
    });
    ui.separator();
    if ui.ctx().content_rect().width() < NARROW { narrow(ui, run) } else { wide(ui, run) }
}

fn wide(ui: &mut Ui, run: &Run) {
    Grid::new("validation").num_columns(5).striped(true).spacing([12.0, 6.0]).show(ui, |ui| {
        for title in ["Check", "Expected", "Got", "Error (allowed)", ""] {
            ui.strong(title);
        }
        ui.end_row();
        for (check, result) in CHECKS.iter().zip(&run.results) {
            ui.vertical(|ui| {
                ui.set_width(230.0);
                name(ui, check);
            });
            if let Ok(outcome) = result {
                let [expected, got] = values(check, outcome);
                ui.label(expected);
                ui.label(got);
                ui.label(difference(outcome));
            } else {
                (0..3).for_each(|_| drop(ui.label("–")));
            }
            verdict(ui, result);
            ui.end_row();
        }
    });
}

fn narrow(ui: &mut Ui, run: &Run) {
    for (check, result) in CHECKS.iter().zip(&run.results) {
        name(ui, check);
        if let Ok(outcome) = result {
            let [expected, got] = values(check, outcome);
            Grid::new(check.name).num_columns(2).spacing([12.0, 2.0]).show(ui, |ui| {
                for (title, value) in [("Expected", expected), ("Got", got), ("Error (allowed)", difference(outcome))] {
                    ui.weak(title);
                    ui.label(value);
                    ui.end_row();
                }
            });
        }
        verdict(ui, result);
        ui.separator();
    }
}

fn name(ui: &mut Ui, check: &Check) {
    ui.add(Label::new(check.name).wrap());
    ui.add(Label::new(RichText::new(check.source).weak().size(11.0)).wrap());
}

/// Expected and computed value, with as many digits as the tolerance gives a meaning to, and one more.
fn values(check: &Check, outcome: &Outcome) -> [String; 2] {
    // Of a tolerance that is no positive number the conversion makes 0 digits.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let decimals = ((1.0 - outcome.tolerance.log10().floor()) as usize).min(13);
    [outcome.expected, outcome.got].map(|value| format!("{value:.decimals$} {}", check.unit).trim_end().to_owned())
}

fn difference(outcome: &Outcome) -> String {
    let error = outcome.error();
    // Nothing to write with an exponent.
    let error = if error == 0.0 { "0".to_owned() } else { format!("{error:.1e}") };
    format!("{error} ({:.1e})", outcome.tolerance)
}

fn verdict(ui: &mut Ui, result: &Result<Outcome, Failed>) {
    let (calm, warning) = (theme::calm(ui.visuals()), theme::warning(ui.visuals()));
    match result {
        Ok(outcome) if outcome.passes() => ui.colored_label(calm, "passes"),
        Ok(_) => ui.colored_label(warning, "▲ fails"),
        Err(reason) => ui.colored_label(warning, format!("▲ fails: {reason}")),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: Outcome = Outcome { expected: 1.0, got: 1.0004, tolerance: 1e-3 };

    #[test]
    fn the_summary_counts_what_passes_and_waits_for_all() {
        let mut run = Run { results: vec![Ok(GOOD); CHECKS.len() - 1] };
        assert_eq!(run.summary(), format!("Computing: {0} of {1} are done.", CHECKS.len() - 1, CHECKS.len()));
        run.results.push(Ok(GOOD));
        assert_eq!(run.summary(), format!("{0} of {0} checks pass.", CHECKS.len()));
        run.results[0] = Ok(Outcome { got: 2.0, ..GOOD });
        run.results[1] = Err(Failed::Nothing("mode"));
        run.results[2] = Ok(Outcome { got: f64::NAN, ..GOOD });
        assert_eq!(run.summary(), format!("{} of {} checks pass.", CHECKS.len() - 3, CHECKS.len()));
    }

    #[test]
    fn values_have_the_digits_that_count() {
        let check = Check { name: "", source: "", unit: "m/s", run: || Ok(GOOD) };
        assert_eq!(values(&check, &GOOD), ["1.0000 m/s", "1.0004 m/s"]);
        let plain = Check { unit: "", ..check };
        assert_eq!(values(&plain, &Outcome { tolerance: 0.5, ..GOOD }), ["1.00", "1.00"]);
        for tolerance in [f64::NAN, 0.0, 1e-300, f64::INFINITY] {
            assert!(values(&plain, &Outcome { tolerance, ..GOOD })[0].len() < 20);
        }
    }
}
