//! What a verb gives.

use crate::cli::rows::Rows;

/// What a verb prints on standard output.
pub(super) enum Output {
    Text(String),
    /// Still to be computed, from input that has been checked.
    Rows(Rows),
}

/// A verb's output, or one line per fault.
pub(super) type CommandResult = Result<Output, Vec<String>>;
