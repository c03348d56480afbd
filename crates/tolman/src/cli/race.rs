//! `tolman race`: a competition micromouse explores mazes, proves its fast run with diagonals, and
//! writes its moves.

mod half_known;
mod params;
mod route;
mod shown;
mod speeds;
mod told;
mod written;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use anyhow::{Context, anyhow};
use tolman_arena::competition;
use tolman_maze::Maze;
use tolman_planners::speed_run::SpeedRunConfig;
use tolman_systems::micromouse::competition::{ExploreError, SpeedRunExploration};

use super::half_known::Whereabouts;
use super::looks::Looks;
use super::maze::{Collection, Marks};
use super::mice::{MazePath, maze_or, send_all};
use super::mouse::Way;
use super::outputs::{self, Output};
use super::words::words;
use super::{OrBadInput, Result, file, maze};
use params::Params;
use shown::Shown;
use written::{Route, WRITINGS, Writing};

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
  running     S a cell, s half a cell, w half a diagonal; to the left and right z c F45, q Q F90, a d F135, u U F180,
              p P FV90, L R FS90 (within a cell); Z C A D out of a diagonal

--live, --svg, --speeds, --trace and --replay need a single maze.

Examples:
  tolman race mazes/grid/braided-2.txt --svg race.svg --replay race.html
  tolman race mazes/grid
  tolman race --template > mine.toml
  tolman race mazes/grid/braided-2.txt --mouse mine.toml --json
  tolman race mazes/grid/braided-2.txt --no-diagonals --moves names"
)]
pub(super) struct Arguments {
    #[command(flatten)]
    maze: MazePath,
    /// File with the mouse's driving parameters: times, speeds, accelerations, cell size. Given
    /// several times, each of the mice races
    #[arg(long, value_name = "PARAMS.toml")]
    mouse: Vec<PathBuf>,
    #[command(flatten)]
    marks: Marks,
    #[command(flatten)]
    whereabouts: Whereabouts,
    /// Time and check this way instead of exploring: F, L, R and B for each cell, or a letter for
    /// each move
    #[arg(long, value_name = "LETTERS", conflicts_with_all = ["live", "svg", "trace", "replay"])]
    route: Option<String>,
    /// How the run's moves are written
    #[arg(long, value_name = "WRITING", default_value = "letters", value_parser = words(WRITINGS))]
    moves: Writing,
    /// Draw the speeds of the run over time, a line for each mouse
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["svg"]), conflicts_with = "route")]
    speeds: Option<Output>,
    /// Drive no diagonals; without --mouse, as a first mouse with turns of 90° within a cell only
    #[arg(long)]
    no_diagonals: bool,
    /// Print a file for --mouse that explains every number
    #[arg(long, value_name = "KIND", num_args = 0..=1, default_missing_value = "classic", value_parser = words(KINDS),
        conflicts_with_all = ["mouse", "jobs", "json", "live", "svg", "trace", "replay", "speeds"])]
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
    Beginner,
}

const KINDS: [(&str, &str, Kind); 3] = [
    ("classic", "Cells of 180 mm, up to 16 × 16", Kind::Classic),
    ("half-size", "Cells of 90 mm, up to 32 × 32", Kind::HalfSize),
    (
        "beginner",
        "Cells of 180 mm, no diagonals, turns within a cell",
        Kind::Beginner,
    ),
];

/// The explorations of a maze by all mice: one or more.
struct Heat(Vec<Raced>);

/// The mouse's exploration of a maze.
struct Raced {
    /// File of the mouse, if several race.
    driver: Option<String>,
    writing: Writing,
    config: SpeedRunConfig,
    /// The exploration; `None` if there is no way to a goal that the mouse can drive.
    explored: Option<SpeedRunExploration>,
    /// Cells that the exploration drove through, as letters.
    search_path: String,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    if let Some(kind) = arguments.template {
        let (config, source) = kind.config();
        return Ok(out.write_all(params::template(config, source).as_bytes())?);
    }
    let Some(path) = arguments.maze.path() else {
        return Err(anyhow!("name a maze or a folder of mazes")).or_bad_input();
    };
    let mice: Vec<Params> = match arguments.mouse.as_slice() {
        [] => vec![Params::read(None, arguments.no_diagonals)?],
        files => files
            .iter()
            .map(|file| Params::read(Some(file), arguments.no_diagonals))
            .collect::<Result<_>>()?,
    };
    let looks = &arguments.looks;
    let told = (looks, arguments.moves);
    let mut collection = Collection::read(path, Some(&arguments.marks), looks)?;
    if let Some(route) = &arguments.route {
        let route = Route::read(route)?;
        for ((file, maze), params) in pairs(&collection.mazes, &mice) {
            route::tell(file, maze, &params.config_for(maze), &route, told, out)?;
        }
        if let Some((file, _)) = collection.half_known.first() {
            let name = maze::name(file);
            return Err(anyhow!("{name} has unknown walls: leave --route out")).or_bad_input();
        }
        return collection.unsound.complain(collection.mazes.len());
    }
    let whereabouts = &arguments.whereabouts;
    whereabouts.check(&collection)?;
    let are_all = collection.tell_half_known(|path, file| {
        mice.iter().try_for_each(|params| {
            let config = params.config_for(&file.maze);
            half_known::tell(path, (file, whereabouts), &config, told, out)
        })
    })?;
    if are_all {
        return collection.unsound.complain(collection.half_known.len());
    }
    if mice.len() > 1 {
        looks.of_one(path, mice.len())?;
    }
    let mazes = collection.mazes.len();
    if arguments.speeds.is_some() && mazes != 1 {
        let path = path.display();
        return Err(anyhow!(
            "--speeds needs a single maze, but {path} holds {mazes}: name a file"
        ))
        .or_bad_input();
    }
    let speeds = Mutex::new(Vec::new());
    send_all(
        &mut collection,
        arguments.jobs,
        looks,
        out,
        |file, maze| {
            let (mut heat, mut way) = (Vec::new(), None);
            for (number, params) in mice.iter().enumerate() {
                let driver = arguments.mouse.get(number).filter(|_| mice.len() > 1);
                let driver = driver.map(|file| file.display().to_string());
                let (raced, shown) = send(file, maze, params, (driver, arguments.moves), looks)?;
                if let (Some(_), Some(explored)) = (&arguments.speeds, &raced.explored) {
                    let line = speeds::over_time(&explored.run, &raced.config);
                    let mut all = speeds.lock().unwrap_or_else(PoisonError::into_inner);
                    all.push((raced.driver.clone().unwrap_or_default(), line));
                }
                heat.push(raced);
                way = shown;
            }
            Ok((Heat(heat), way))
        },
        |_, _| Ok(()),
    )?;
    match &arguments.speeds {
        Some(path) => {
            let speeds = speeds.into_inner().unwrap_or_else(PoisonError::into_inner);
            file::write(path, speeds::picture(speeds))
        }
        None => Ok(()),
    }
}

/// Returns every maze with every mouse.
fn pairs<'a, M, P>(mazes: &'a [M], mice: &'a [P]) -> impl Iterator<Item = (&'a M, &'a P)> {
    mazes
        .iter()
        .flat_map(|maze| mice.iter().map(move |mouse| (maze, mouse)))
}

/// Explores a maze, and shows the way meanwhile if that is asked for.
fn send(
    file: &Path,
    maze: &Maze,
    params: &Params,
    (driver, writing): (Option<String>, Writing),
    looks: &Looks,
) -> Result<(Raced, Option<Way>)> {
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
        driver,
        writing,
        config,
        search_path: told::search_path(maze, &cells),
        explored,
    };
    Ok((raced, way.map(Shown::into_way)))
}

impl Kind {
    /// Returns the values of a template, and where they come from.
    const fn config(self) -> (SpeedRunConfig, &'static str) {
        match self {
            Self::Classic => (
                SpeedRunConfig::classic(),
                "The curves of the half-size template at twice the size, with the same lateral acceleration.",
            ),
            Self::HalfSize => (
                SpeedRunConfig::half_size(),
                "Values of kerikun11/micromouse-maze-library, StepMapSlalom::EdgeCost::RunParameter.",
            ),
            Self::Beginner => (
                SpeedRunConfig::beginner(),
                "FS90 of kerikun11/micromouse-maze-library at twice the size, with the same lateral acceleration.",
            ),
        }
    }
}
