//! `tolman mms-host`: hosts a mouse that speaks the protocol of mms, and scores it.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use core::sync::atomic::Ordering;
use core::time::Duration;
use std::io::Write;
use std::path::Path;

use anyhow::{Context, Error, anyhow};
use serde_json::{Value, json};
use tolman_arena::foreign::{Launch, Log};
use tolman_arena::micromouse::SideSeen;
use tolman_arena::mms::{Exchange, Hosted, Limits, MouseExit, host};
use tolman_geom::{Heading, Pose};
use tolman_maze::{Cell, Direction, Grid, Maze};

use super::looks::Looks;
use super::maze::Collection;
use super::mice::{MazePath, MouseResult, all_solved, required, summarize, tell};
use super::mouse::{Came, PITCH, Way, WayStep, half_cells};
use super::{Failure, OrBadInput, Result, interrupt, keep, maze};

/// Hosts a mouse that speaks the protocol of the simulator mms, without a window, and scores it
#[derive(clap::Args)]
#[command(
    group(required()),
    after_help = "\
The mouse starts in the south-west cell and looks north; the goal is the middle of the maze. Its score
is the best run's turns and effective distance, plus a tenth of all turns and effective distance. Less is
better, and 2000 means unsolved. The code of mms measures in half-steps, its README in cells; both scores are shown.

--live, --svg, --trace and --replay need a single maze, whose cells are drawn 0.18 m wide. A line of --trace has a move or
turn, its answer, where it led, and the walls that the mouse had asked about before it. --json writes one object per
maze, one per line.

When this program ends, however it does, the mouse is ended with all processes that it started (on Linux).
Ctrl-C ends the mice and shows the scores so far.

Examples:
  tolman mms-host --mouse 'tolman mouse --mms' --maze mazes/grid/braided-2.txt
  tolman mms-host --mouse 'tolman mouse --mms' --maze mazes/grid/small-1.txt --json
  tolman mms-host --mouse 'tolman mouse --mms' --maze mazes/grid/small-1.txt --replay hosted.html"
)]
pub(super) struct Arguments {
    /// Command that starts the mouse. It is split into words as by a shell, but run without one
    #[arg(long, value_name = "CMD")]
    mouse: String,
    #[command(flatten)]
    maze: MazePath,
    /// Stop a mouse after this time in a maze
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0)]
    time_limit: f64,
    /// Stop a mouse after this many moves, turns and crashes in a maze
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    move_limit: u64,
    /// Press the reset button after this many moves and turns
    #[arg(long, value_name = "N")]
    reset_after: Option<u64>,
    /// Number of mazes at a time, instead of one per core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// Show what the mouse writes to stderr
    #[arg(long)]
    log: bool,
    #[command(flatten)]
    looks: Looks,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let words = shlex::split(&arguments.mouse)
        .ok_or_else(|| {
            anyhow!(
                "--mouse {}: a quotation mark is not closed; close it",
                arguments.mouse
            )
        })
        .or_bad_input()?;
    let limits = arguments.limits()?;
    let looks = &arguments.looks;
    let path = arguments.maze.path().context("a maze")?;
    let Collection {
        mazes, mut unsound, ..
    } = Collection::read(path, None, looks)?.known();
    let stop = interrupt::flag()?;
    let keeper = keep::keeper();
    let mouse = Launch {
        words: &words,
        keeper: &keeper,
        log: match arguments.log {
            true => Log::Shown,
            false => Log::Dropped,
        },
        stop: &stop,
    };
    let work = |file, maze| {
        if stop.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let mut watched = Watched::new(arguments, file, maze)?;
        let hosted = host(&mouse, maze, &limits, |exchange| {
            if let Some(watched) = &mut watched {
                watched.hear(exchange);
            }
        });
        let way = watched.map(|watched| watched.way);
        Ok(Some((file, hosted.or_bad_input()?, way)))
    };
    let mut tried = Vec::new();
    maze::each(&mazes, arguments.jobs, looks, work, |hosted| {
        if let Some((file, hosted, way)) = hosted {
            tell(file, &hosted, way, looks, out)?;
            tried.push((file, hosted));
        }
        Ok(())
    })?;
    summarize(&tried, looks, out, |_, _| Ok(()))?;
    if stop.load(Ordering::Relaxed) {
        let interrupted = |(_, hosted): &&(&Path, Hosted)| hosted.ended != MouseExit::Interrupted;
        let whole = tried.iter().filter(interrupted).count();
        return Err(Failure::Interrupted(anyhow!(
            "interrupted after {whole} of {} mazes",
            mazes.len()
        )));
    }
    unsound.complain(mazes.len())?;
    all_solved(&tried)
}

impl Arguments {
    fn limits(&self) -> Result<Limits> {
        let time = Duration::try_from_secs_f64(self.time_limit)
            .ok()
            .filter(|time| (Duration::from_millis(1)..=LONGEST).contains(time))
            .ok_or_else(|| {
                anyhow!(
                    "--time-limit {:?}: give seconds, from 0.001 to {}",
                    self.time_limit,
                    LONGEST.as_secs()
                )
            })
            .or_bad_input()?;
        Ok(Limits {
            time,
            movements: self.move_limit,
            reset_after: self.reset_after,
        })
    }
}

/// A mouse whose movements are shown.
struct Watched {
    way: Way,
    grid: Grid,
    /// Sides that the mouse has asked about since its last movement.
    sensed: Vec<SideSeen>,
}

impl Watched {
    /// Returns a mouse that is about to begin; `None` if it is not to be shown.
    fn new(arguments: &Arguments, file: &Path, maze: &Maze) -> Result<Option<Self>> {
        let header = json!({ "rules": "mms", "mouse": arguments.mouse });
        let way = Way::watched(file, &of_mms(maze), header, PITCH, &arguments.looks, None)?;
        Ok(way.map(|way| Self {
            way,
            grid: maze.grid(),
            sensed: Vec::new(),
        }))
    }

    fn hear(&mut self, exchange: &Exchange) {
        let way = &self.way;
        let mut seen = exchange.sides_seen(self.grid, |cell, side| way.knows_open(cell, side));
        self.way.see(&seen);
        seen.retain(|side| !self.sensed.contains(side));
        self.sensed.extend(seen);
        if exchange.is_movement {
            self.way.go(way_step(exchange, &self.sensed));
            self.sensed.clear();
        }
    }
}

/// Returns a maze under mms's rules, whatever the file says: the mouse starts in the south-west,
/// and the goal is the middle.
fn of_mms(maze: &Maze) -> Maze {
    let mut maze = maze.clone();
    maze.set_start(Some((Cell::new(0, 0), Direction::North)));
    maze.set_goals(maze.grid().middle().collect());
    maze
}

/// Returns a movement as a step to show.
fn way_step(exchange: &Exchange, sensed: &[SideSeen]) -> WayStep {
    let Exchange {
        line, reply, pose, ..
    } = exchange;
    let clockwise = f64::from(pose.heading.index()) * FRAC_PI_4;
    let heading = Heading::from_radians(FRAC_PI_2 - clockwise);
    let cell = pose.place.cell();
    let seen = sensed.iter().map(|seen| {
        let SideSeen { cell, side, stands } = seen;
        json!({ "cell": cell, "side": side.to_string(), "wall": stands })
    });
    WayStep {
        pose: Pose::new(
            half_cells(pose.place.x.into(), pose.place.y.into()),
            heading,
        ),
        words: line.clone(),
        line: json!({
            "move": line,
            "reply": reply,
            "cell": cell,
            "heading_deg": heading.degrees(),
            "sensed": seen.collect::<Vec<_>>(),
        }),
        came: match reply.as_deref() {
            Some("crash") => Came::Crashed,
            _ if line == "ackReset" => Came::PutBack,
            _ => Came::Moved,
        },
    }
}

impl MouseResult for Hosted {
    fn outcome(&self) -> String {
        let came = if self.solved { "solved" } else { "not solved" };
        let Self {
            score,
            score_in_cells,
            movements,
            crashes,
            ..
        } = self;
        format!(
            "{came}, score {score:.1} ({score_in_cells:.1} in cells), {movements} movements, {crashes} crashes, {}",
            how(self.ended)
        )
    }

    fn json(&self) -> Result<Vec<Value>, Error> {
        Ok(vec![serde_json::to_value(self)?])
    }

    fn has_solved(&self) -> bool {
        self.solved
    }

    fn summary(hosted: &[(&Path, Self)]) -> String {
        let whole = hosted.iter().map(|(_, hosted)| hosted);
        let whole = whole.filter(|hosted| hosted.ended != MouseExit::Interrupted);
        let count = whole.clone().count();
        if count == 0 {
            return "no maze was finished".to_owned();
        }
        let mean = |score: fn(&Self) -> f32| whole.clone().map(score).sum::<f32>() / count as f32;
        let solved = whole.clone().filter(|hosted| hosted.solved).count();
        format!(
            "{solved} of {count} solved, mean score {:.1} ({:.1} in cells)",
            mean(|hosted| hosted.score),
            mean(|hosted| hosted.score_in_cells)
        )
    }
}

/// Longest time limit that can be given: a day.
const LONGEST: Duration = Duration::from_secs(24 * 60 * 60);

fn how(ended: MouseExit) -> &'static str {
    match ended {
        MouseExit::Done => "done",
        MouseExit::Failed => "ended with a failure",
        MouseExit::OutOfTime => "out of time",
        MouseExit::OutOfMovements => "out of movements",
        MouseExit::LineTooLong => "wrote a line longer than any command",
        MouseExit::TooMuchOutput => "wrote more than a mouse ever needs to",
        MouseExit::ClosedOutput => "closed its stdout and ran on",
        MouseExit::Interrupted => "interrupted",
        _ => "stopped",
    }
}
