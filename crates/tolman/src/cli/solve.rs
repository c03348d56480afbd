//! `tolman solve`: MSLST finds its way by a map it has learned.

use std::io::Write;
use std::path::PathBuf;

use alloc::sync::Arc;

use tolman_arena::Mind;
use tolman_systems::mslst::{MapFile, Navigator};

use super::run::{self, Name, Outing};
use super::{Failure, map};

/// Sends MSLST with a learned map through a maze and tells what became of it
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman learn --maze mazes/j.maze --out j-map.json
  tolman solve --map j-map.json --maze mazes/j.maze --seed 7 --svg run.svg")]
pub(super) struct Arguments {
    /// The map, made by `tolman learn`
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    #[command(flatten)]
    outing: Outing,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let file = map::read(&arguments.map, MapFile::from_json)?;
    let name = Name {
        word: "mslst",
        title: "MSLST",
        nodes: &file.learned.survey.positions,
    };
    let mind = |_: &_, _: &_| {
        let mslst = Navigator::new(Arc::new(file.learned.map), &file.config);
        Ok(Mind::Brain(Box::new(mslst)))
    };
    run::send(&arguments.outing, name, mind, out)
}
