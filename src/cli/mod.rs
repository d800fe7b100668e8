//! The command line: one file per verb. Standard output carries results only, standard error one line per fault.

mod analyze;
mod example;
mod link;
mod map;
mod progress;
mod rows;
mod sweep;
mod text;

use std::ffi::OsString;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::scenario::{Scenario, file};
use crate::stability::{ALLOWED_LIMIT, is_limit};

/// What the command line asks for.
#[derive(Debug)]
pub enum Start {
    /// The desktop application, with this scenario if one is given.
    App {
        /// Read from the file on the command line, and physical.
        scenario: Option<Box<Scenario>>,
    },
    /// Nothing more: all is done and told.
    Done(ExitCode),
}

/// The exit code for bad input.
const BAD_INPUT: u8 = 2;
/// The exit code where results could not be written.
const NOT_WRITTEN: u8 = 1;

/// Critical speed of cable-driven parallel robots.
///
/// Without a command, opens the desktop application, with the scenario FILE if one is given.
#[derive(Debug, Parser)]
#[command(name = "tautline", version, args_conflicts_with_subcommands = true, after_help = EXIT_CODES)]
struct Args {
    /// A scenario file (JSON) to open in the desktop application; - reads standard input.
    file: Option<PathBuf>,
    #[command(subcommand)]
    verb: Option<Verb>,
}

const EXIT_CODES: &str = "\
Start from a built-in scenario:
  tautline example paper > robot.json
  tautline analyze robot.json

Exit codes: 0 done, also where the robot cannot be at rest in its pose; 2 bad input, one line per fault on standard \
error; 130 stopped by Ctrl-C, after a whole row.";

#[derive(Debug, Subcommand)]
enum Verb {
    Analyze(analyze::Args),
    Map(map::Args),
    Sweep(sweep::Args),
    Example(example::Args),
    Link(link::Args),
}

/// What a verb prints on standard output.
enum Output {
    Text(String),
    /// Still to be computed, from input that has been checked.
    Rows(rows::Rows),
}

/// A verb's output, or one line per fault.
type CommandResult = Result<Output, Vec<String>>;

/// Where the program reads and writes: the process's own streams, or a test's.
pub struct Streams<'a> {
    /// What a scenario file called `-` is read from.
    pub input: &'a mut dyn Read,
    /// Results.
    pub output: &'a mut dyn Write,
    /// One line per fault.
    pub errors: &'a mut dyn Write,
}

/// Does what the program's arguments ask for, but for opening the application.
pub fn run() -> Start {
    let streams = Streams { input: &mut io::stdin(), output: &mut io::stdout(), errors: &mut io::stderr() };
    run_with(std::env::args_os(), streams)
}

/// The same for these arguments, the program's name first, and with these streams.
pub fn run_with(arguments: impl IntoIterator<Item = OsString>, streams: Streams) -> Start {
    let Streams { input, output, errors } = streams;
    let answer = match Args::try_parse_from(arguments) {
        Err(error) if error.use_stderr() => Err(vec![one_line(&error)]),
        Err(help) => Ok(Output::Text(help.to_string())),
        Ok(Args { verb: Some(Verb::Analyze(args)), .. }) => analyze::run(&args, input),
        Ok(Args { verb: Some(Verb::Map(args)), .. }) => map::run(&args, input),
        Ok(Args { verb: Some(Verb::Sweep(args)), .. }) => sweep::run(&args, input),
        Ok(Args { verb: Some(Verb::Example(args)), .. }) => example::run(&args),
        Ok(Args { verb: Some(Verb::Link(args)), .. }) => link::run(&args, input),
        Ok(Args { verb: None, file: None }) => return Start::App { scenario: None },
        Ok(Args { verb: None, file: Some(file) }) => match read_scenario(&file, input) {
            Ok(scenario) => return Start::App { scenario: Some(Box::new(scenario)) },
            Err(faults) => Err(faults),
        },
    };
    Start::Done(match answer {
        Ok(Output::Text(text)) => write_out(output, errors, &text).err().unwrap_or(ExitCode::SUCCESS),
        Ok(Output::Rows(rows)) => rows::print(rows, output, errors),
        Err(faults) => {
            for fault in &faults {
                complain(errors, fault);
            }
            ExitCode::from(BAD_INPUT)
        }
    })
}

/// Says on standard error what is wrong with the input, and gives the exit code for it.
pub fn fail(fault: &str) -> ExitCode {
    complain(&mut io::stderr(), &format!("tautline: {fault}"));
    ExitCode::from(BAD_INPUT)
}

/// A line on standard error; where that is closed there is nobody to tell.
fn complain(errors: &mut dyn Write, line: &str) {
    let _ = writeln!(errors, "{line}");
}

/// Writes to standard output, and to `errors` why that is not possible.
///
/// # Errors
/// The exit code to end with, where nothing more can be written. Standard output closed by its reader is no fault: it
/// has seen enough.
fn write_out(output: &mut dyn Write, errors: &mut dyn Write, text: &str) -> Result<(), ExitCode> {
    output.write_all(text.as_bytes()).and_then(|()| output.flush()).map_err(|error| {
        if error.kind() == io::ErrorKind::BrokenPipe {
            return ExitCode::SUCCESS;
        }
        complain(errors, &format!("standard output: {error}"));
        ExitCode::from(NOT_WRITTEN)
    })
}

/// A speed up to which to search, in m/s.
fn max_speed(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|&speed| is_limit(speed)).ok_or_else(|| format!("allowed: {ALLOWED_LIMIT}"))
}

/// The first paragraph of clap's message.
fn one_line(error: &clap::Error) -> String {
    let message = error.to_string();
    let paragraph: Vec<&str> = message.lines().map(str::trim).take_while(|line| !line.is_empty()).collect();
    let paragraph = paragraph.join(" ");
    let what = paragraph.strip_prefix("error: ").unwrap_or(&paragraph);
    format!("tautline: {what}; tautline --help says what is possible")
}

/// The scenario in a file, or in the standard `input` where `path` is `-`; faults with the file's name in front.
fn read_scenario(path: &Path, input: &mut dyn Read) -> Result<Scenario, Vec<String>> {
    let standard_input = path.as_os_str() == "-";
    let name = if standard_input { "standard input".into() } else { path.display().to_string() };
    let fault = |what: &dyn std::fmt::Display| format!("{name}: {what}");
    let text = if standard_input { file::read(input) } else { file::open(path) };
    let text = text.map_err(|error| vec![fault(&error)])?;
    Scenario::from_json(&text).map_err(|faults| faults.list().iter().map(|one| fault(one)).collect())
}
