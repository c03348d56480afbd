//! `tolman pitch`: arenas for the place map, and data sets gathered in them.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use clap::Subcommand;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde_json::json;
use tolman_arena::gngslam::{DataSet, Pitch, PlaceScorer, gather};
use tolman_draw::{Figure, FloorPlan, GraphNode, GraphPicture, NodeMark, Series};
use tolman_maps::place_map::ImageForm;

use super::outputs::{self, Output};
use super::share::share;
use super::{Failure, OrBadInput, Result, Unboxed, file};

/// Writes arenas for the place map of GNG-SLAM, and gathers data sets in them
///
/// An arena is `pitch`, the paper's, `hall`, `l-room`, or `random-` with a number, such as
/// `random-7`.
#[derive(Subcommand)]
pub(super) enum Verb {
    World(World),
    Gather(Gather),
    Show(Show),
    Score(Score),
}

/// Writes an arena as a tolman-world, for --world; the destination is in front of the blue goal,
/// the start in front of the yellow one
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman pitch world random-7 --out arena.json
  tolman learn --system gng-slam-better --world arena.json --out map.json")]
pub(super) struct World {
    /// Name of the arena
    #[arg(value_name = "ARENA")]
    name: String,
    /// File to write, instead of standard output
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["json"]))]
    out: Option<Output>,
}

/// Lets a Pioneer 2-DX wander in an arena, and writes its records of places with the true poses
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman pitch gather pitch --seed 1 --out records.jsonl")]
pub(super) struct Gather {
    /// Name of the arena
    #[arg(value_name = "ARENA")]
    name: String,
    /// Number of records; the paper has 1006
    #[arg(long, value_name = "N", default_value_t = 1006)]
    records: u32,
    /// Seed of all random numbers: the same seed gives the same result
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Maximum calibration error of each wheel, as a share of its distance
    #[arg(long, value_name = "SHARE", default_value = "0", value_parser = share)]
    calibration: f64,
    /// File to write: one line of JSON about the data set, then one per record
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["jsonl", "json", "ndjson"]))]
    out: Output,
}

/// Describes a data set, and draws the places of its records
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman pitch gather pitch --records 50 --out records.jsonl
  tolman pitch show records.jsonl --svg records.svg")]
pub(super) struct Show {
    /// Data set, written by `tolman pitch gather`
    file: PathBuf,
    /// Draw the places of the records
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["svg"]))]
    svg: Option<Output>,
    /// Write the figures as JSON
    #[arg(long)]
    json: bool,
}

/// Learns the paper's place map from a data set (40 × 30 pixels hsv and odometry, Table 3.1) and
/// scores it
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman pitch gather pitch --records 300 --out records.jsonl
  tolman pitch score records.jsonl --growth-period 60")]
pub(super) struct Score {
    /// Data set, written by `tolman pitch gather`
    file: PathBuf,
    /// Seed of all random numbers: the same seed gives the same result
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// λ: add a node per this many records [default: the middle of the paper's range]
    #[arg(long, value_name = "RECORDS", value_parser = clap::value_parser!(u32).range(1..))]
    growth_period: Option<u32>,
    /// Write the figures as JSON
    #[arg(long)]
    json: bool,
}

impl Verb {
    pub(super) fn carry_out(self, out: &mut dyn Write) -> Result {
        match self {
            Self::World(arguments) => world(&arguments, out),
            Self::Gather(arguments) => gathered(&arguments, out),
            Self::Show(arguments) => show(&arguments, out),
            Self::Score(arguments) => score(&arguments, out),
        }
    }
}

fn world(arguments: &World, out: &mut dyn Write) -> Result {
    let pitch = Pitch::named(&arguments.name).unboxed().or_bad_input()?;
    let text = pitch.course.world.to_json()? + "\n";
    file::write_or_show(arguments.out.as_deref(), &text, out)
}

fn gathered(arguments: &Gather, out: &mut dyn Write) -> Result {
    let seed = arguments.seed;
    let pitch = Pitch::named(&arguments.name).unboxed().or_bad_input()?;
    let robot = pitch.robot(seed, arguments.calibration).unboxed();
    let robot = robot.or_bad_input()?;
    let data = gather(&pitch, robot, seed, arguments.records).unboxed();
    let data = data.or_bad_input()?;
    file::write(&arguments.out, data.to_text().unboxed()?)?;
    tell(&data, out)
}

/// Returns the data set of a file.
///
/// # Errors
/// Bad input with the file's name.
fn read(path: &Path) -> Result<DataSet> {
    let text = file::read(path, "give a file that `tolman pitch gather` wrote")?;
    DataSet::from_text(&text)
        .unboxed()
        .with_context(|| path.display().to_string())
        .or_bad_input()
}

/// Returns the number of records with a wrong cell.
fn mislabelled(data: &DataSet) -> usize {
    let records = data.records.iter();
    records.filter(|record| record.label != record.cell).count()
}

/// Returns the distance between odometry and truth at the last record, m. Both begin at the first
/// record.
fn drift(data: &DataSet) -> f64 {
    let (Some(first), Some(last)) = (data.records.first(), data.records.last()) else {
        return 0.0;
    };
    let rolled = first.record.odometry.between(last.record.odometry);
    (first.truth.compose(rolled).position - last.truth.position).norm()
}

/// Writes what a data set holds.
fn tell(data: &DataSet, out: &mut dyn Write) -> Result {
    let count = data.records.len();
    writeln!(out, "{}, seed {}: {count} records", data.arena, data.seed)?;
    writeln!(out, "{} of them with a wrong cell", mislabelled(data))?;
    writeln!(
        out,
        "record {} shows the blue goal, record {} the yellow one",
        data.goals.blue, data.goals.yellow
    )?;
    let drift = drift(data);
    Ok(writeln!(
        out,
        "the odometry ends {drift:.2} m from the truth"
    )?)
}

fn show(arguments: &Show, out: &mut dyn Write) -> Result {
    let data = read(&arguments.file)?;
    if let Some(path) = &arguments.svg {
        file::write(path, picture(&data)?)?;
    }
    if arguments.json {
        let json = json!({
            "arena": data.arena,
            "seed": data.seed,
            "records": data.records.len(),
            "wrong_cells": mislabelled(&data),
            "goals": data.goals,
            "odometry_error_m": drift(&data),
        });
        return Ok(writeln!(out, "{json:#}")?);
    }
    tell(&data, out)
}

/// Width of the picture, user units.
const WIDTH: f64 = 640.0;

/// Returns the arena with the places of the records. Filled ones show the goals best.
fn picture(data: &DataSet) -> Result<String> {
    let pitch = Pitch::named(&data.arena).unboxed().or_bad_input()?;
    let mut plan = FloorPlan::of_world(&pitch.course.world, WIDTH);
    let mut graph = GraphPicture::new().radius(2.0);
    for (index, record) in data.records.iter().enumerate() {
        let shows_goal = [data.goals.blue, data.goals.yellow].contains(&index);
        let mark = match shows_goal {
            true => NodeMark::Disc,
            false => NodeMark::Ring,
        };
        let node = GraphNode::at(record.truth.position).mark(mark);
        graph.node(node.series(Series(0)));
    }
    plan.graph(&graph);
    let drawing = plan
        .drawing("Where the records were taken; from those that are filled a goal is seen best.");
    Ok(Figure::new("records", &data.arena, drawing).standalone())
}

fn score(arguments: &Score, out: &mut dyn Write) -> Result {
    let data = read(&arguments.file)?;
    let pitch = Pitch::named(&data.arena).unboxed().or_bad_input()?;
    let form = ImageForm::Span { left_out: 0.0 };
    let mut rng = ChaCha8Rng::seed_from_u64(arguments.seed);
    let learned = data.learn(form, arguments.growth_period, &mut rng);
    let (table, map) = learned.or_bad_input()?;
    let scored = PlaceScorer::paper(&data, &pitch).score(&map, &table, &mut rng)?;
    let nodes = map.network().ids().count();
    if arguments.json {
        let json = json!({
            "nodes": nodes,
            "score": scored.map(|score| score.mean.by_centre),
            "score_to_the_border": scored.map(|score| score.mean.by_border),
            "mirrored": scored.map(|score| score.mirrored),
        });
        writeln!(out, "{json:#}")?;
    }
    let Some(score) = scored else {
        return Err(Failure::Failed(anyhow!(
            "the map of {nodes} nodes has one node for both goals, so it cannot be turned and has no score"
        )));
    };
    if !arguments.json {
        let mirrored = if score.mirrored { ", mirrored" } else { "" };
        writeln!(
            out,
            "a map of {nodes} nodes{mirrored}: score {:.3}, to the border {:.3}; guesses have 0.175 and 0.184",
            score.mean.by_centre, score.mean.by_border
        )?;
    }
    Ok(())
}
