//! Rows that are computed on all cores and printed in order, each as soon as all before it are there.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{self, IsTerminal as _, Write};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use crate::cli::progress::Progress;
use crate::cli::streams::{NOT_WRITTEN, complain, max_speed, write_out};
use crate::robot::Vec2;
use crate::scenario::report::{CriticalReport, DEFAULT_MAX_SPEED, StatusReport};
use crate::study::{Status, Verdict};

/// The columns of every table in CSV, after those of the swept numbers.
pub(super) const COLUMNS: &str = "x,y,feasible,critical_speed,frequency_hz,kind,cable,wave_limit,status";
/// The exit code after Ctrl-C: what shells give a program that ends by that signal.
const INTERRUPTED: u8 = 130;
/// How often the program looks whether it is to stop.
const WAIT: Duration = Duration::from_millis(50);

/// One row: where, and what is known there.
pub(super) struct Row {
    /// The values of the swept numbers.
    pub(super) swept: Vec<f64>,
    /// The pose in m.
    pub(super) position: Vec2,
    /// What is known of it.
    pub(super) verdict: Verdict,
    /// Its wave limit in m/s, where it has one.
    pub(super) wave_limit: Option<f64>,
}

impl Row {
    /// The critical speed as the analysis reports it.
    pub(super) fn critical(&self) -> Option<CriticalReport> {
        self.verdict.critical().map(CriticalReport::from)
    }

    /// As a line of CSV, without its end. No value needs quotes.
    fn csv(&self) -> String {
        let mut line = String::new();
        for &value in self.swept.iter().chain(&self.position) {
            line += &exact(value);
            line.push(',');
        }
        if let Some(feasible) = self.verdict.feasible() {
            line += if feasible { "true" } else { "false" };
        }
        // Writing to a string does not fail.
        let _ = match self.critical() {
            Some(CriticalReport { speed, frequency_hz, kind, cable }) => {
                write!(line, ",{},{},{kind},{cable}", exact(speed), exact(frequency_hz))
            }
            None => write!(line, ",,,,"),
        };
        let wave_limit = self.wave_limit.map(exact).unwrap_or_default();
        let _ = write!(line, ",{wave_limit},{}", StatusReport::from(self.verdict.status()));
        line
    }
}

/// The shortest text that reads back as the same number; with an exponent where it is very large or small.
pub(super) fn exact(number: f64) -> String {
    // Minus zero is zero.
    let number = number + 0.0;
    if number == 0.0 || (1e-5..1e16).contains(&number.abs()) { number.to_string() } else { format!("{number:e}") }
}

/// How rows are printed.
pub(super) enum Form {
    /// For programs: a line with the names of the columns, then one per row.
    Csv {
        /// The first line.
        header: String,
    },
    /// For people: laid out once all rows are there.
    Text(Box<Layout>),
}

type Layout = dyn FnOnce(&[Row]) -> String;

/// Rows to be computed and printed; their input has been checked.
pub(super) struct Rows {
    /// How many.
    pub(super) count: usize,
    /// Computes one.
    pub(super) row: Box<dyn Fn(usize) -> Row + Send + Sync>,
    /// How they are printed.
    pub(super) form: Form,
    /// On how many threads they are computed.
    pub(super) threads: usize,
}

/// Prints rows of CSV as soon as all before them are there, or all rows as text; gives the program's exit code.
///
/// After Ctrl-C no more is printed: what has been printed ends with a whole row. A second one ends at once.
pub(super) fn print(rows: Rows, output: &mut dyn Write, errors: &mut dyn Write) -> ExitCode {
    let Rows { count, row, form, threads } = rows;
    let interrupted = watch_for_interrupts();
    let answers = compute(count, row, threads);
    let csv = matches!(form, Form::Csv { .. });
    // Rows that scroll by on the same terminal tell enough.
    let mut progress = if csv && io::stdout().is_terminal() { Progress::hidden() } else { Progress::new() };
    let (mut text, layout) = match form {
        Form::Csv { header } => (header + "\n", None),
        Form::Text(layout) => (String::new(), Some(layout)),
    };
    let mut early = BTreeMap::new();
    let mut kept = Vec::new();
    let (mut done, mut unknown) = (0, 0);
    loop {
        if let Err(code) = write_out(output, errors, &text) {
            return code;
        }
        text.clear();
        if done == count {
            break;
        }
        if interrupted.load(Ordering::SeqCst) {
            progress.clear();
            complain(errors, &format!("tautline: interrupted after {done} of {count} rows"));
            return ExitCode::from(INTERRUPTED);
        }
        match answers.recv_timeout(WAIT) {
            Ok((index, row)) => {
                early.insert(index, row);
                early.extend(answers.try_iter());
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                progress.clear();
                complain(errors, &format!("tautline: row {} could not be computed", done + 1));
                return ExitCode::from(NOT_WRITTEN);
            }
        }
        while let Some(row) = early.remove(&done) {
            done += 1;
            unknown += usize::from(row.verdict.status() == Status::Failed);
            if csv {
                text += &row.csv();
                text.push('\n');
            } else {
                kept.push(row);
            }
        }
        progress.show_bar(done, count, "rows");
    }
    progress.clear();
    if unknown > 0 {
        complain(errors, &format!("tautline: in {unknown} of {count} rows the critical speed could not be computed"));
    }
    match layout.map(|layout| write_out(output, errors, &layout(&kept))) {
        Some(Err(code)) => code,
        _ => ExitCode::SUCCESS,
    }
}

/// All rows with their numbers, in the order in which they are done.
///
/// The threads are left alone when the program ends, so that it need not wait for a row that takes long.
fn compute(count: usize, row: Box<dyn Fn(usize) -> Row + Send + Sync>, threads: usize) -> Receiver<(usize, Row)> {
    let (sender, receiver) = mpsc::channel();
    let shared = Arc::new((AtomicUsize::new(0), row));
    for _ in 0..threads.clamp(1, count.max(1)) {
        let (shared, sender) = (Arc::clone(&shared), sender.clone());
        thread::spawn(move || {
            let (next, row) = &*shared;
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                // Nobody waits any more where the receiver is gone.
                if index >= count || sender.send((index, row(index))).is_err() {
                    return;
                }
            }
        });
    }
    receiver
}

/// Set by Ctrl-C from now on.
fn watch_for_interrupts() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let handler = Arc::clone(&interrupted);
    // Without a handler the signal ends the program as it always does.
    let _ = ctrlc::set_handler(move || {
        if handler.swap(true, Ordering::SeqCst) {
            std::process::exit(i32::from(INTERRUPTED));
        }
    });
    interrupted
}

/// What tables share on the command line.
#[derive(Debug, clap::Args)]
pub(super) struct Options {
    /// Print CSV for programs instead of text for people.
    #[arg(long)]
    pub(super) csv: bool,
    /// Search for critical speeds up to this speed, in m/s.
    #[arg(long, value_name = "V", default_value_t = DEFAULT_MAX_SPEED, value_parser = max_speed,
          allow_hyphen_values = true)]
    pub(super) max_speed: f64,
    /// Compute on so many threads; on all cores unless told otherwise.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

impl Options {
    /// How many threads to use.
    pub(super) fn threads(&self) -> usize {
        self.threads.map_or_else(|| thread::available_parallelism().map_or(1, usize::from), usize::from)
    }
}

#[cfg(test)]
mod tests {
    use super::exact;

    #[test]
    fn exact_numbers_read_back() {
        for number in [0.0, 0.1 + 0.2, -7.5, 125e6, 5e-5, 1e-7, -1e300, 9_007_199_254_740_993.0, 1e16] {
            assert_eq!(exact(number).parse(), Ok(number));
        }
        assert_eq!([-0.0, 125e6, 5e-5, 1e-7, 1e300].map(exact), ["0", "125000000", "0.00005", "1e-7", "1e300"]);
    }
}
