//! `tolman map plan`: a way over a survey's map.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use tolman_arena::diktiometry::SurveyFile;
use tolman_maps::diktiometry::PlaceId;

use super::Failure;

/// Plans a way from place to place over the map of a survey
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman survey --maze mazes/j.maze --out j-survey.json
  tolman map plan j-survey.json --from 0 --to 3")]
pub(crate) struct Arguments {
    /// The survey, made by `tolman survey`
    file: PathBuf,
    /// The place to go to, by its number in `tolman map show`
    #[arg(long, value_name = "PLACE")]
    to: u32,
    /// The place to begin at, instead of where the robot believes to be
    #[arg(long, value_name = "PLACE")]
    from: Option<u32>,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let survey = super::read(&arguments.file, SurveyFile::from_json)?;
    let observer = &survey.observer;
    let paths = &observer.map().paths;
    let place = |number: u32| {
        paths.resolve(PlaceId(number)).ok_or_else(|| {
            let known: Vec<String> = paths.places().map(|(id, _)| id.0.to_string()).collect();
            let known = known.join(", ");
            Failure::BadInput(anyhow!(
                "there is no place {number}; choose one of: {known}"
            ))
        })
    };
    let from = arguments.from.map_or(Ok(observer.place()), place)?;
    let to = place(arguments.to)?;
    let Some(plan) = observer.plan(from, to) else {
        return Err(Failure::Failed(anyhow!(
            "no way is known from place {} to place {}; let the robot go on with `tolman survey --from {}`",
            from.0,
            to.0,
            arguments.file.display()
        )));
    };
    if from == to {
        writeln!(out, "that is place {}, where the plan begins", from.0)?;
    }
    let mut at = from;
    for step in &plan {
        let predicted = observer.predict(at, step.action);
        let likely = predicted
            .iter()
            .find(|predicted| predicted.place == step.to);
        let likely = likely.map_or(0.0, |predicted| predicted.probability);
        writeln!(
            out,
            "{} to place {} ({:.0} %)",
            super::way(step.action),
            step.to.0,
            100.0 * likely
        )?;
        at = step.to;
    }
    Ok(())
}
