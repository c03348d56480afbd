//! `tolman mouse`: a micromouse explores mazes, proves its run and drives it, under the rules of
//! the paper or of mms.

mod drawing;
mod half_known;
mod mms;
mod walls_known;
mod way;

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Error, anyhow};
use serde_json::{Value, json};
use tolman_arena::micromouse::{
    self, Judgement, MAX_STEPS, MouseTrial, RefereedStep, Ruling, sides_seen,
};
use tolman_geom::Pose;
use tolman_maze::Maze;
use tolman_systems::micromouse::{Movement, Order, Rotation, Searcher, Until};

use super::half_known::Whereabouts;
use super::looks::Looks;
use super::maze::{Collection, Marks};
use super::mice::{MazePath, MouseResult, ON_GOAL, maze_or, send_all};
use super::words::words;
use super::{Failure, OrBadInput, Result, Unboxed, maze};
pub(super) use way::{Came, PITCH, Way, WayStep, half_cells};

/// Sends a micromouse through mazes: it explores, proves its run, and drives it
#[derive(clap::Args)]
#[command(
    group(maze_or("mms")),
    after_help = "\
The rules are those of \"Plot and Navigate a Virtual Maze\": at most 1000 steps for both runs. A step is a quarter turn or
none, then up to three cells. The score is a thirtieth of the steps of the first run plus those of the second. The
floor is the score of a mouse that knows the maze.

In a maze with unknown walls, written as `.`, the mouse does not explore: it tells the best known run, the best possible
one, and what it does next, at the start or --at.

With --mms the rules are those of the simulator mms, which hosts the mouse. They exchange lines on stdin and stdout,
and the mouse logs to stderr.

--live, --svg, --trace and --replay need a single maze, whose cells are drawn 0.18 m wide. A line of --trace has a step's
\"rotation\" (-90, 0, 90 or \"Reset\") and \"movement\" (-3 to 3 cells or \"Reset\"), and where it led. It also has the number
of open cells that the mouse saw to its left, ahead and to its right before the step. --json writes one object per
maze, one per line.

Examples:
  tolman mouse mazes/grid/braided-2.txt
  tolman mouse mazes/grid --search certify-plain --worst 3
  tolman mouse mazes/grid/braided-1.txt --until worth
  tolman mouse mazes/grid/perfect-1.txt --replay mouse.html --trace mouse.jsonl
  tolman mms-host --mouse 'tolman mouse --mms' --maze mazes/grid/small-1.txt"
)]
pub(super) struct Arguments {
    #[command(flatten)]
    maze: MazePath,
    #[command(flatten)]
    marks: Marks,
    #[command(flatten)]
    whereabouts: Whereabouts,
    /// Speak the protocol of the simulator mms on stdin and stdout
    #[arg(long, conflicts_with_all = ["search", "seed", "worst", "jobs", "json", "live", "svg", "trace", "replay"])]
    mms: bool,
    /// When the mouse has explored enough [default: proof, with --mms goal]
    #[arg(long, value_parser = words(UNTIL), conflicts_with = "search")]
    until: Option<Until>,
    /// How to explore: certify (until the run is proven), certify-worth (like --until worth),
    /// certify-plain (like certify, without rollouts), or the paper's target, counter-50,
    /// counter-75, random
    #[arg(long, value_name = "SEARCH", default_value_t = Searcher::Certify)]
    search: Searcher,
    /// Seed of the searches that use random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Draw this many of the mazes, those with the worst score above the floor
    #[arg(long, value_name = "N", default_value_t = 1)]
    worst: usize,
    /// Number of mazes at a time, instead of one per core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    #[command(flatten)]
    looks: Looks,
}

/// Values of `--until`: when a mouse has explored enough.
const UNTIL: [(&str, &str, Until); 3] = [
    (
        "goal",
        "It has been at the goal (only with --mms)",
        Until::Goal,
    ),
    (
        "worth",
        "Exploring on is expected to cost more of the score than it gains (with --mms: as goal)",
        Until::Worth,
    ),
    (
        "proof",
        "No run can score less than the best one it knows",
        Until::Proof,
    ),
];

/// A maze, and the results of the mouse in it.
struct Tried<'a> {
    search: Searcher,
    maze: &'a Maze,
    trial: MouseTrial,
    judgement: Judgement,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    // clap requires one of the two.
    let Some(path) = arguments.maze.path() else {
        return mms::carry_out(arguments.until.unwrap_or(Until::Goal), out);
    };
    let search = arguments.search()?;
    let looks = &arguments.looks;
    let mut collection = Collection::read(path, Some(&arguments.marks), looks)?;
    arguments.whereabouts.check(&collection)?;
    let are_all = collection.tell_half_known(|path, file| {
        half_known::tell(path, (file, &arguments.whereabouts), looks, out)
    })?;
    if are_all {
        return collection.unsound.complain(collection.half_known.len());
    }
    send_all(
        &mut collection,
        arguments.jobs,
        looks,
        out,
        |file, maze| arguments.send(search, file, maze),
        |tried, out| draw_worst(tried, arguments.worst, out),
    )
}

impl Arguments {
    /// Returns the searcher for exploring under the paper's rules.
    ///
    /// # Errors
    /// Bad input if the options only fit `--mms`.
    fn search(&self) -> Result<Searcher> {
        match self.until {
            None => Ok(self.search),
            Some(Until::Proof) => Ok(Searcher::Certify),
            Some(Until::Worth) => Ok(Searcher::CertifyWorth),
            Some(Until::Goal) => Err(Failure::BadInput(anyhow!(
                "--until goal is for --mms; here give --until worth or proof"
            ))),
        }
    }

    /// Sends the mouse through a maze, and shows its way meanwhile if that is asked for.
    fn send<'a>(
        &self,
        search: Searcher,
        file: &'a Path,
        maze: &'a Maze,
    ) -> Result<(Tried<'a>, Option<Way>)> {
        let header = json!({
            "rules": "Plot and Navigate a Virtual Maze",
            "search": search.name(),
            "seed": self.seed,
        });
        let mut way = Way::watched(file, maze, header, PITCH, &self.looks, Some(MAX_STEPS))?;
        let mut at = maze.start();
        let tried = micromouse::try_on(maze, search, self.seed, |step| {
            let Some(way) = &mut way else {
                return;
            };
            if let Some((cell, heading)) = at {
                way.see(&sides_seen(step.sight, cell, heading));
            }
            at = Some((step.cell, step.heading));
            way.go(way_step(step, way.in_cell(step.cell, step.heading)));
        });
        let tried = tried.unboxed().with_context(|| maze::name(file));
        let (trial, judgement) = tried.or_bad_input()?;
        let tried = Tried {
            search,
            maze,
            trial,
            judgement,
        };
        Ok((tried, way))
    }
}

impl Tried<'_> {
    /// Returns the reason for which the mouse gave up; `None` if it did not.
    fn why(&self) -> Option<&str> {
        Some(self.trial.end.why()).filter(|why| !why.is_empty())
    }
}

impl MouseResult for Tried<'_> {
    fn json(&self) -> Result<Vec<Value>, Error> {
        let mut line = serde_json::to_value(self.judgement)?;
        line["search"] = json!(self.search.name());
        line["above_floor"] = json!(self.judgement.above_floor());
        line["gave_up"] = json!(self.why());
        Ok(vec![line])
    }

    fn has_solved(&self) -> bool {
        self.judgement.score.is_some()
    }

    fn outcome(&self) -> String {
        let judgement = &self.judgement;
        match (judgement.run_1, judgement.run_2, judgement.score) {
            (Some(0), Some(0), _) => format!("{ON_GOAL}: 0 steps, proven"),
            (Some(run_1), Some(run_2), Some(score)) => format!(
                "{score:.3} = {run_1} / 30 + {run_2}, {:.3} above the floor{}",
                score - judgement.floor,
                if judgement.certified { ", proven" } else { "" }
            ),
            _ => match self.why() {
                Some(why) => why.to_owned(),
                None => format!("not done after {} steps", self.trial.steps.len()),
            },
        }
    }

    fn summary(tried: &[(&Path, Self)]) -> String {
        let count = tried.len();
        let done: Vec<&Judgement> = tried
            .iter()
            .map(|(_, tried)| &tried.judgement)
            .filter(|judgement| judgement.score.is_some())
            .collect();
        let mean = |value: fn(&Judgement) -> Option<f64>| {
            done.iter()
                .filter_map(|judgement| value(judgement))
                .sum::<f64>()
                / done.len().max(1) as f64
        };
        let certified = done.iter().filter(|judgement| judgement.certified).count();
        format!(
            "{count} mazes: {} finished, {certified} proven; mean score {:.3}, {:.3} above the floor",
            done.len(),
            mean(|judgement| judgement.score),
            mean(Judgement::above_floor),
        )
    }
}

/// Returns a step as it is shown.
fn way_step(step: &RefereedStep, pose: Pose) -> WayStep {
    let RefereedStep { sight, order, .. } = *step;
    let line = json!({
        "rotation": order.rotation,
        "movement": order.movement,
        "cell": step.cell,
        "heading": step.heading.to_string(),
        "sensed": { "left": sight.left, "front": sight.front, "right": sight.right },
    });
    WayStep {
        pose,
        words: in_words(order),
        line,
        came: match step.event {
            Ruling::RunTwo => Came::PutBack,
            _ => Came::Moved,
        },
    }
}

/// Returns an order in words, such as "left, 3 cells".
fn in_words(order: Order) -> String {
    let turn = match order.rotation {
        Rotation::Degrees(-90) => "left",
        Rotation::Degrees(90) => "right",
        Rotation::Degrees(_) => "straight",
        Rotation::Reset(_) => return "back to the start, for the second run".to_owned(),
    };
    match order.movement {
        Movement::Cells(0) => turn.to_owned(),
        Movement::Cells(1) => format!("{turn}, 1 cell"),
        Movement::Cells(cells) => format!("{turn}, {cells} cells"),
        Movement::Reset(_) => turn.to_owned(),
    }
}

/// Draws `most` of the mazes: those not finished first, then those with the highest score above the
/// floor. A single maze is always drawn.
fn draw_worst(tried: &[(&Path, Tried<'_>)], most: usize, out: &mut dyn Write) -> Result {
    let mut order: Vec<&(&Path, Tried<'_>)> = tried.iter().collect();
    order.sort_by(|(_, a), (_, b)| {
        let above = |tried: &Tried<'_>| tried.judgement.above_floor().unwrap_or(f64::INFINITY);
        above(b).total_cmp(&above(a))
    });
    let count = if tried.len() > 1 { most } else { 1 };
    for (file, tried) in order.into_iter().take(count) {
        let name = maze::name(file);
        let drawing = drawing::of(tried.maze, &tried.trial);
        writeln!(
            out,
            "\n{name}, with the stops of the first run (.) and of the second (*):\n{drawing}"
        )?;
    }
    Ok(())
}
