//! `tautline example`: the built-in scenarios.

use crate::cli::output::{CommandResult, Output};
use crate::scenario::presets::{self, PRESETS};

/// Print a built-in scenario as a scenario file; without a name, list them.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Which one.
    name: Option<String>,
}

pub(super) fn run(args: &Args) -> CommandResult {
    let Some(name) = &args.name else {
        let entry = |preset: &presets::Preset| {
            let sentences = preset.description.replace(". ", ".\n    ");
            format!("{}: {}\n    {sentences}\n", preset.name, preset.title)
        };
        return Ok(Output::Text(PRESETS.iter().map(entry).collect()));
    };
    let preset = presets::find(name).ok_or_else(|| {
        let names: Vec<&str> = PRESETS.iter().map(|preset| preset.name).collect();
        vec![format!("tautline: no built-in scenario is called {name:?}; there are {}", names.join(", "))]
    })?;
    Ok(Output::Text(preset.scenario().to_json() + "\n"))
}
