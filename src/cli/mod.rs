//! The command line: one file per verb. Standard output carries results only, standard error one line per fault.

mod analyze;
mod course;
mod example;
mod fly;
mod limits;
mod link;
mod map;
mod output;
mod progress;
mod rows;
mod streams;
mod sweep;
mod text;

use std::ffi::OsString;
use std::io::{self, Read, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::cli::output::Output;
use crate::cli::streams::{BAD_INPUT, complain, read_scenario, write_out};
use crate::scenario::Scenario;

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
    Fly(fly::Args),
    Limits(limits::Args),
}

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
        Ok(Args { verb: Some(Verb::Fly(args)), .. }) => fly::run(&args, input),
        Ok(Args { verb: Some(Verb::Limits(args)), .. }) => limits::run(&args, input),
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

/// The first paragraph of clap's message.
fn one_line(error: &clap::Error) -> String {
    let message = error.to_string();
    let paragraph: Vec<&str> = message.lines().map(str::trim).take_while(|line| !line.is_empty()).collect();
    let paragraph = paragraph.join(" ");
    let what = paragraph.strip_prefix("error: ").unwrap_or(&paragraph);
    format!("tautline: {what}; tautline --help says what is possible")
}
