//! `tolman maze generate`: seeded mazes.

use std::io::Write;

use clap::Subcommand;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_maze::{Braided, Perfect, Rooms};

use super::output::Output;
use super::{Failure, OrBadInput};
use crate::cli::App;

/// Makes a maze by chance; the same seed makes the same maze
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman maze generate braided --size 12x8 --share 0.5 --seed 3 --out mine.maze
  tolman maze generate family rooms --size 12x8")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    kind: Kind,
}

#[derive(Subcommand)]
enum Kind {
    /// Exactly one way between any two cells
    Perfect {
        #[command(flatten)]
        common: Common,
    },
    /// A perfect maze with some of its dead ends opened, which makes loops
    Braided {
        /// The share of dead ends to open, 0 to 1
        #[arg(long, value_name = "SHARE", default_value_t = 1.0)]
        share: f64,
        #[command(flatten)]
        common: Common,
    },
    /// Rooms with winding corridors between them
    Rooms {
        /// How often a room is tried
        #[arg(long, value_name = "N", default_value_t = 20)]
        attempts: u32,
        /// Shortest side of a room, cells
        #[arg(long, value_name = "CELLS", default_value_t = 2)]
        smallest: u16,
        /// Longest side of a room, cells
        #[arg(long, value_name = "CELLS", default_value_t = 4)]
        largest: u16,
        /// Doors beyond those that join everything; each closes a loop
        #[arg(long, value_name = "N", default_value_t = 2)]
        extra_doors: u32,
        #[command(flatten)]
        common: Common,
    },
    /// One of a family of worlds, by its name
    Family {
        /// The family
        name: String,
        #[command(flatten)]
        common: Common,
    },
}

#[derive(clap::Args)]
struct Common {
    /// Columns and rows, as in 16x16
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "16x16", value_parser = size)]
    size: (u16, u16),
    /// What the chance starts from
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    output: Output,
}

pub(super) fn carry_out(
    app: &App<'_>,
    arguments: &Arguments,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let (Kind::Perfect { common }
    | Kind::Braided { common, .. }
    | Kind::Rooms { common, .. }
    | Kind::Family { common, .. }) = &arguments.kind;
    let (width, height) = common.size;
    let rng = &mut ChaCha8Rng::seed_from_u64(common.seed);
    let maze = match &arguments.kind {
        Kind::Family { name, .. } => {
            let drawn = (app.family(name)?.draw)(common.size, rng);
            let maze = drawn.map_err(anyhow::Error::from_boxed).or_bad_input()?;
            return common.output.write(&maze.into(), out);
        }
        Kind::Perfect { .. } => Perfect { width, height }.generate(rng),
        &Kind::Braided { share, .. } => Braided {
            width,
            height,
            share,
        }
        .generate(rng),
        &Kind::Rooms {
            attempts,
            smallest,
            largest,
            extra_doors,
            ..
        } => Rooms {
            width,
            height,
            attempts,
            smallest,
            largest,
            extra_doors,
        }
        .generate(rng),
    };
    common.output.write(&maze.or_bad_input()?.into(), out)
}

fn size(text: &str) -> Result<(u16, u16), String> {
    text.split_once('x')
        .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)))
        .ok_or_else(|| "expected columns x rows, as in 16x16".to_owned())
}
