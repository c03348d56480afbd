//! `tolman score`: the error of a trajectory.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use clap::ArgGroup;
use serde_json::json;
use tolman_arena::log_score::{AlignedScore, RelationScore};
use tolman_formats::{ReadRelations, ReadTrajectory};
use tolman_geom::Point;
use tolman_robot::Trajectory;

use super::words::counted;
use super::{Failure, OrBadInput, Result};

/// Measures the error of a trajectory: against relative poses that a person verified, or against
/// another trajectory
#[derive(clap::Args)]
#[command(
    group(ArgGroup::new("judge").args(["relations", "truth"]).required(true)),
    after_help = "\
Example:
  tolman map --log logs/office.clf.gz --out office
  tolman score --trajectory office/trajectory.tum --truth office/noted.tum
  tolman score --trajectory office/odometry.tum --truth office/noted.tum --json"
)]
pub(super) struct Arguments {
    /// Trajectory, one pose per line, `time x y z qx qy qz qw`; plain or gzipped
    #[arg(long, value_name = "FILE")]
    trajectory: PathBuf,
    /// Relative poses, one per line, `from to x y z roll pitch yaw`, in the times of the trajectory
    #[arg(long, value_name = "FILE")]
    relations: Option<PathBuf>,
    /// Another trajectory, which is aligned with the first by the best rotation and translation
    #[arg(long, value_name = "FILE")]
    truth: Option<PathBuf>,
    /// Write the figures as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let trajectory = ReadTrajectory::open(&arguments.trajectory)
        .or_bad_input()?
        .trajectory;
    if let Some(path) = &arguments.relations {
        let relations = ReadRelations::open(path).or_bad_input()?.relations;
        let score = RelationScore::of(&trajectory, &relations);
        let score = score.ok_or_else(|| no_times("relation"))?;
        return tell_relations(arguments.json, &score, out);
    }
    let Some(path) = &arguments.truth else {
        return Err(Failure::BadInput(anyhow!(
            "give --relations FILE or --truth FILE"
        )));
    };
    let truth = ReadTrajectory::open(path).or_bad_input()?.trajectory;
    let score = AlignedScore::of(&pairs(&trajectory, &truth));
    let score = score.ok_or_else(|| no_times("pose of the other trajectory"))?;
    tell_aligned(arguments.json, &score, out)
}

/// Returns pairs of positions, of both trajectories at the times of the second.
fn pairs(found: &Trajectory, truth: &Trajectory) -> Vec<(Point, Point)> {
    let times = truth.poses().iter();
    let pair = times.filter_map(|truth| {
        let found = found.at(truth.time)?;
        Some((found.position, truth.pose.position))
    });
    pair.collect()
}

fn no_times(what: &str) -> Failure {
    Failure::BadInput(anyhow!(
        "no {what} lies within the times of the trajectory; make both count time from the same moment"
    ))
}

fn tell_relations(as_json: bool, score: &RelationScore, out: &mut dyn Write) -> Result {
    let RelationScore {
        relations,
        missed,
        error,
        turn_error,
        far_relations,
        far_error,
    } = score;
    if as_json {
        let json = json!({
            "relations": relations, "missed": missed, "error_m": error, "turn_error_rad": turn_error,
            "far_relations": far_relations, "error_over_30s_m": far_error,
        });
        return Ok(writeln!(out, "{json:#}")?);
    }
    writeln!(
        out,
        "{}, mean error {error:.3} m and {:.2}°",
        counted(*relations, "relation"),
        turn_error.to_degrees()
    )?;
    if let Some(far) = far_error {
        writeln!(
            out,
            "over more than 30 s: {}, mean error {far:.3} m",
            counted(*far_relations, "relation")
        )?;
    }
    if *missed > 0 {
        writeln!(
            out,
            "left out, since not on the trajectory: {}",
            counted(*missed, "relation")
        )?;
    }
    Ok(())
}

fn tell_aligned(as_json: bool, score: &AlignedScore, out: &mut dyn Write) -> Result {
    let AlignedScore {
        pairs,
        rms,
        largest,
        ..
    } = score;
    if as_json {
        let json = json!({ "poses": pairs, "rms_m": rms, "largest_m": largest });
        return Ok(writeln!(out, "{json:#}")?);
    }
    Ok(writeln!(
        out,
        "{}, error {rms:.3} m (root mean square), at most {largest:.3} m",
        counted(*pairs, "pose")
    )?)
}
