//! `tolman race`: a competition micromouse explores mazes, proves its fast run with diagonals, and
//! writes its moves.

mod params;
mod shown;
mod told;

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use tolman_arena::competition;
use tolman_maze::Maze;
use tolman_planners::speed_run::SpeedRunConfig;
use tolman_systems::micromouse::competition::{ExploreError, SpeedRunExploration};

use super::looks::Looks;
use super::maze::Collection;
use super::mice::{MazePath, maze_or, send_all};
use super::mouse::Way;
use super::words::words;
use super::{OrBadInput, Result, maze};
use params::Params;
use shown::Shown;

/// Sends a competition micromouse through mazes: it explores, proves its fast run, and writes its
/// moves
#[derive(clap::Args)]
#[command(
    group(maze_or("template")),
    after_help = "\
The mouse drives cell by cell and looks at the walls around it. It drives home once it has been at a goal, and no run
can be faster than the one it knows, whatever the unseen walls are. The fast run has straights, diagonals and slalom
turns; --mouse sets their speeds. Without it, mazes of more than 16 cells a side are driven as half-size ones. A mouse
with a wall ahead of its start turns to the next open side, clockwise.

The search is the way until the mouse is first at a goal. The proof is the way from there until no run can be faster.
--json writes one object per maze, one per line: the cells of search, proof and way home, and the run's moves with
their times. Both ways are also given as the letters of kerikun11/micromouse-maze-library:
  exploring   S a cell ahead, L and R to the left and right, T back
  running     S a cell, w half a diagonal; to the left and right z c F45, q Q F90, a d F135, u U F180, p P FV90;
              Z C A D out of a diagonal

--live, --svg, --trace and --replay need a single maze.

Examples:
  tolman race mazes/grid/braided-2.txt --svg race.svg --replay race.html
  tolman race mazes/grid
  tolman race --template > mine.toml
  tolman race mazes/grid/braided-2.txt --mouse mine.toml --json"
)]
pub(super) struct Arguments {
    #[command(flatten)]
    maze: MazePath,
    /// File with the mouse's driving parameters: times, speeds, accelerations, cell size
    #[arg(long, value_name = "PARAMS.toml")]
    mouse: Option<PathBuf>,
    /// Print a file for --mouse that explains every number
    #[arg(long, value_name = "KIND", num_args = 0..=1, default_missing_value = "classic", value_parser = words(KINDS),
        conflicts_with_all = ["mouse", "jobs", "json", "live", "svg", "trace", "replay"])]
    template: Option<Kind>,
    /// Number of mazes at a time, instead of one per core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    #[command(flatten)]
    looks: Looks,
}

/// Kinds of mazes.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Classic,
    HalfSize,
}

const KINDS: [(&str, &str, Kind); 2] = [
    ("classic", "Cells of 180 mm, up to 16 × 16", Kind::Classic),
    ("half-size", "Cells of 90 mm, up to 32 × 32", Kind::HalfSize),
];

/// The mouse's exploration of a maze.
struct Raced {
    config: SpeedRunConfig,
    /// The exploration; `None` if there is no way to a goal that the mouse can drive.
    explored: Option<SpeedRunExploration>,
    /// Cells that the exploration drove through, as letters.
    search_path: String,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    if let Some(kind) = arguments.template {
        return Ok(out.write_all(params::template(kind.config()).as_bytes())?);
    }
    let Some(path) = arguments.maze.path() else {
        return Err(anyhow!("name a maze or a folder of mazes")).or_bad_input();
    };
    let params = Params::read(arguments.mouse.as_deref())?;
    let looks = &arguments.looks;
    send_all(
        &mut Collection::read(path, looks)?,
        arguments.jobs,
        looks,
        out,
        |file, maze| send(file, maze, &params, looks),
        |_, _| Ok(()),
    )
}

/// Explores a maze, and shows the way meanwhile if that is asked for.
fn send(file: &Path, maze: &Maze, params: &Params, looks: &Looks) -> Result<(Raced, Option<Way>)> {
    let config = params.config_for(maze);
    let mut cells = Vec::new();
    let mut way = Shown::new(file, maze, &config, looks)?;
    let explored = competition::explore(maze, &config, |cell, open| {
        if let Some(way) = &mut way {
            way.arrive(cell, open);
        }
        cells.push(cell);
    });
    let explored = match explored {
        Ok(explored) => Some(explored),
        Err(ExploreError::NoWay { .. }) => None,
        Err(error) => return Err(error).with_context(|| maze::name(file)).or_bad_input(),
    };
    if let (Some(way), Some(explored)) = (&mut way, &explored) {
        way.run(&explored.run);
    }
    let raced = Raced {
        config,
        search_path: told::search_path(maze, &cells),
        explored,
    };
    Ok((raced, way.map(Shown::into_way)))
}

impl Kind {
    const fn config(self) -> SpeedRunConfig {
        match self {
            Self::Classic => SpeedRunConfig::classic(),
            Self::HalfSize => SpeedRunConfig::half_size(),
        }
    }
}
