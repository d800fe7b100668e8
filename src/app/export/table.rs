//! A table to be saved, and how what is known stands in it.

use crate::scenario::report::{CriticalReport, StatusReport};
use crate::study::{NoEigenvalues, Status, Verdict};

/// A table of numbers and words without commas, tabs and quotes.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    pub(super) header: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn new(header: &[&str]) -> Self {
        Self { header: header.iter().map(ToString::to_string).collect(), rows: Vec::new() }
    }

    /// With commas, as RFC 4180 has it.
    pub fn csv(&self) -> String {
        self.joined(",", "\r\n")
    }

    /// With tabs, as spreadsheets take it from the clipboard.
    pub fn tsv(&self) -> String {
        self.joined("\t", "\n")
    }

    fn joined(&self, separator: &str, end: &str) -> String {
        std::iter::once(&self.header).chain(&self.rows).map(|row| row.join(separator) + end).collect()
    }
}

/// The columns of what is known of a pose and direction, as on the command line.
pub(super) const VERDICT: [&str; 7] =
    ["feasible", "critical_speed", "frequency_hz", "kind", "cable", "wave_limit", "status"];

pub(super) fn verdict(verdict: &Verdict, wave_limit: Option<f64>) -> [String; 7] {
    let critical = verdict.critical().map(CriticalReport::from);
    let critical = critical.as_ref();
    [
        cell(verdict.feasible()),
        cell(critical.map(|critical| critical.speed)),
        cell(critical.map(|critical| critical.frequency_hz)),
        cell(critical.map(|critical| critical.kind)),
        cell(critical.map(|critical| critical.cable)),
        cell(wave_limit),
        StatusReport::from(verdict.status()).to_string(),
    ]
}

/// A value as text; empty where there is none.
pub(super) fn cell(value: Option<impl ToString>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// How the search for eigenvalues ended.
pub(super) fn status<T>(answer: &Result<T, NoEigenvalues>) -> String {
    let status = answer.as_ref().map_or_else(|reason| reason.status(), |_| Status::Found);
    StatusReport::from(status).to_string()
}
