//! `tolman survey`: a robot walks a maze while the diktiometry maps it.

use alloc::sync::Arc;
use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, anyhow};
use tolman_arena::diktiometry::{
    Office, OfficeConfig, Survey, SurveyConfig, SurveyFile, SurveyorConfig,
};
use tolman_maps::diktiometry::{JournalLength, Use};
use tolman_systems::Origin;

use super::share::share;
use super::{Failure, OrBadInput, file, map, maze};

/// Lets a robot walk a maze from place to place while the diktiometry maps it, and writes the map down
#[derive(clap::Args)]
#[command(after_help = "\
The maze becomes corridors 1.2 m wide and 4 m apart; its places are bends, junctions, dead ends and
doorways. With one colour they all look alike.

Examples:
  tolman survey --maze mazes/j.maze --out j-survey.json
  tolman survey --from j-survey.json --moves 200 --out j-survey.json
  tolman map show j-survey.json --svg j-survey.svg
  tolman map plan j-survey.json --to 3")]
#[command(group(clap::ArgGroup::new("beginning").required(true).args(["maze", "from"])))]
pub(super) struct Arguments {
    /// The maze file, of any format; - reads standard input
    #[arg(long, value_name = "FILE")]
    maze: Option<PathBuf>,
    /// Go on with a survey that was written before
    #[arg(long, value_name = "FILE", conflicts_with_all = ["colours", "doorways"])]
    from: Option<PathBuf>,
    /// What all chance follows from
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How many moves to make, each from a place to the next
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    moves: u32,
    /// How likely the robot begins a script when the map advises one, 0 to 1 [default: 0.3, or as in the survey gone on with]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    heed: Option<f64>,
    /// How many colours the walls have
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    colours: u32,
    /// Which share of the passages are doorways, 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, value_parser = share)]
    doorways: f64,
    /// The file to write the survey to
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// As the paper's robot: about 30 % of the time.
const HEED: f64 = 0.3;

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    if let Some(path) = &arguments.from {
        let mut before = map::read(path, SurveyFile::from_json)?;
        before.config.heed = arguments.heed.unwrap_or(before.config.heed);
        let survey = before.survey(arguments.seed).or_bad_input()?;
        let Origin { world, seed, .. } = &before.origin;
        return walk(arguments, (world, *seed), &before.office, survey, out);
    }
    let Some(path) = arguments.maze.as_deref() else {
        let error = anyhow!("give --maze FILE, or --from FILE to go on with a survey");
        return Err(Failure::BadInput(error));
    };
    let read = maze::read(path)?;
    let name = maze::world_name(path, &read);
    let furniture = OfficeConfig {
        doorway_share: arguments.doorways,
        colours: arguments.colours,
        seed: arguments.seed,
        ..OfficeConfig::bare()
    };
    let office = Office::new(&read.maze, &furniture)
        .with_context(|| name.clone())
        .or_bad_input()?;
    let office = Arc::new(office);
    let mut config = SurveyConfig::of(&office, SurveyorConfig::paper(), arguments.moves);
    config.heed = arguments.heed.unwrap_or(HEED);
    config.mapper.journal = JournalLength::All;
    config.mapper.restructuring.look_merge = Use::On;
    let survey = Survey::new(&office, config, arguments.seed)
        .with_context(|| name.clone())
        .or_bad_input()?;
    walk(arguments, (&name, arguments.seed), &office, survey, out)
}

/// Makes the moves and writes the survey down, with the world and the seed it began with.
fn walk(
    arguments: &Arguments,
    (world, seed): (&str, u64),
    office: &Arc<Office>,
    mut survey: Survey<'_>,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    for _ in 0..arguments.moves {
        survey.step()?;
    }
    let written = SurveyFile::of(world, seed, office, &survey);
    file::write(&arguments.out, written.to_json()?)?;
    let score = survey.score();
    Ok(writeln!(
        out,
        "{} places for {} true ones after {} moves, purity {:.3}",
        score.places,
        score.visited,
        survey.observer().moves(),
        score.purity
    )?)
}
