//! `tolman score`: the error of a trajectory.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use clap::ArgGroup;
use serde_json::{Value, json};
use tolman_arena::log_score::{
    ErrorStatistics, PosePair, RelationScore, SpatialScore, TrajectoryAlignment,
};
use tolman_formats::{ReadRelations, ReadTrajectory, SpacePose};

use super::words::{counted, words};
use super::{Failure, OrBadInput, Result};

/// Measures the error of trajectories: against another one, or against relative poses that a person
/// verified
#[derive(clap::Args)]
#[command(
    group(ArgGroup::new("judge").args(["relations", "truth"]).required(true)),
    after_help = "\
A trajectory has one pose per line: TUM (time x y z qx qy qz qw), EuRoC (with commas, the time in ns) or KITTI (12 numbers, no time); plain or packed.
Each pose of the shorter trajectory is compared with the nearest in time of the other, as evo does.

Example:
  tolman map --log logs/office.clf.gz --out office
  tolman score --trajectory office/trajectory.tum --truth office/noted.tum
  tolman score --trajectory office/trajectory.tum --trajectory office/odometry.tum --truth office/noted.tum
  tolman score --trajectory office/odometry.tum --truth office/noted.tum --json"
)]
pub(super) struct Arguments {
    /// Trajectory; repeat it for a table of several
    #[arg(long, value_name = "FILE", required = true)]
    trajectory: Vec<PathBuf>,
    /// Relative poses, one per line, `from to x y z roll pitch yaw`, in the times of the trajectory
    #[arg(long, value_name = "FILE")]
    relations: Option<PathBuf>,
    /// True trajectory
    #[arg(long, value_name = "FILE")]
    truth: Option<PathBuf>,
    /// How the trajectory is laid over the true one [default: plane if all positions are of one
    /// height, else space]
    #[arg(long, value_name = "HOW", value_parser = alignments())]
    align: Option<TrajectoryAlignment>,
    /// Number of poses over which relative errors are measured
    #[arg(long, value_name = "POSES", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    step: u32,
    /// Maximum difference in time of two poses that are compared, s
    #[arg(long, value_name = "S", default_value_t = 0.01)]
    max_diff: f64,
    /// Time that is added to those of the trajectory, s
    #[arg(
        long,
        value_name = "S",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    offset: f64,
    /// Write the figures as JSON
    #[arg(long)]
    json: bool,
}

fn alignments() -> impl clap::builder::TypedValueParser<Value = TrajectoryAlignment> {
    words([
        (
            "plane",
            "A turn about the vertical and a shift",
            TrajectoryAlignment::Plane,
        ),
        ("space", "Any turn and a shift", TrajectoryAlignment::Space),
        (
            "scale",
            "Any turn, a shift and a scale",
            TrajectoryAlignment::Scale,
        ),
        ("none", "Nothing", TrajectoryAlignment::None),
    ])
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    if let Some(path) = &arguments.relations {
        let relations = ReadRelations::open(path).or_bad_input()?.relations;
        for file in &arguments.trajectory {
            let trajectory = read(file)?.planar();
            let score = RelationScore::of(&trajectory, &relations);
            let score = score.ok_or_else(|| {
                Failure::BadInput(anyhow!(
                    "no relation lies within the times of {}; make both count time from the same moment",
                    file.display()
                ))
            })?;
            if arguments.trajectory.len() > 1 && !arguments.json {
                writeln!(out, "{}:", file.display())?;
            }
            tell_relations(arguments.json, &score, out)?;
        }
        return Ok(());
    }
    let Some(path) = &arguments.truth else {
        return Err(Failure::BadInput(anyhow!(
            "give --relations FILE or --truth FILE"
        )));
    };
    let truth = read(path)?;
    let scores = arguments.trajectory.iter().map(|file| {
        let compared = arguments.compared(file, &truth, path)?;
        Ok((file.as_path(), compared))
    });
    let scores = scores.collect::<Result<Vec<(&Path, Compared)>>>()?;
    tell(arguments, &scores, out)
}

fn read(path: &Path) -> Result<ReadTrajectory> {
    ReadTrajectory::open(path)
        .with_context(|| path.display().to_string())
        .or_bad_input()
}

/// A trajectory's score, and how much of it and of the truth it is of.
struct Compared {
    score: SpatialScore,
    alignment: TrajectoryAlignment,
    /// Number of poses of the trajectory and of the truth.
    of: [usize; 2],
    /// Longest time between two compared poses, s, and the usual one.
    gap: Option<(f64, f64)>,
}

impl Arguments {
    fn compared(&self, file: &Path, truth: &ReadTrajectory, path: &Path) -> Result<Compared> {
        let found = read(file)?;
        let (name, other) = (file.display(), path.display());
        let of = [found.poses.len(), truth.poses.len()];
        if found.is_timed != truth.is_timed {
            return Err(Failure::BadInput(anyhow!(
                "only one of {name} and {other} has times; give both in the same format"
            )));
        }
        if !found.is_timed && of[0] != of[1] {
            let [a, b] = of;
            return Err(Failure::BadInput(anyhow!(
                "{name} has {a} poses without times, and {other} has {b}; give as many of both"
            )));
        }
        let matched = self.matched(&found.poses, &truth.poses);
        let pairs: Vec<PosePair> = (matched.iter())
            .map(|(found, truth)| (found.pose, truth.pose))
            .collect();
        let heights = pairs.iter().flat_map(|(found, truth)| [found, truth]);
        let heights = heights.map(|pose| pose.translation.z);
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
            (low.min(z), high.max(z))
        });
        let alignment = self.align.unwrap_or(match high - low > FLAT {
            true => TrajectoryAlignment::Space,
            false => TrajectoryAlignment::Plane,
        });
        let score = SpatialScore::of(&pairs, alignment, self.step as usize);
        let score = score.ok_or_else(|| {
            Failure::BadInput(anyhow!(
                "{name} and {other} have {} in common, within {} s; a score needs {}: make both count time from the same moment, or give --max-diff or --offset",
                counted(pairs.len(), "pose"), self.max_diff, SpatialScore::FEWEST
            ))
        })?;
        let mut gaps: Vec<f64> = (matched.windows(2))
            .map(|two| two[1].1.time - two[0].1.time)
            .collect();
        gaps.sort_by(f64::total_cmp);
        let gap = gaps.last().zip(gaps.get(gaps.len() / 2));
        let gap = gap.map(|(longest, usual)| (*longest, *usual));
        let gap = gap.filter(|_| found.is_timed);
        Ok(Compared {
            score,
            alignment,
            of,
            gap,
        })
    }

    /// Returns pairs of a found and a true pose: each pose of the shorter trajectory with the
    /// nearest in time of the other.
    fn matched<'a>(
        &self,
        found: &'a [SpacePose],
        truth: &'a [SpacePose],
    ) -> Vec<(&'a SpacePose, &'a SpacePose)> {
        let time = |found: &SpacePose| found.time + self.offset;
        if found.len() <= truth.len() {
            let pairs = found.iter().filter_map(|found| {
                let nearest = nearest(truth, time(found), |truth| truth.time);
                let near =
                    nearest.filter(|truth| (truth.time - time(found)).abs() <= self.max_diff);
                Some((found, near?))
            });
            return pairs.collect();
        }
        let pairs = truth.iter().filter_map(|truth| {
            let nearest = nearest(found, truth.time, time);
            let near = nearest.filter(|found| (truth.time - time(found)).abs() <= self.max_diff);
            Some((near?, truth))
        });
        pairs.collect()
    }
}

/// Greatest difference of the heights of a flat trajectory, m.
const FLAT: f64 = 1e-3;

/// Returns the pose nearest to a time; of two as near, the earlier.
fn nearest(
    poses: &[SpacePose],
    time: f64,
    time_of: impl Fn(&SpacePose) -> f64,
) -> Option<&SpacePose> {
    let after = poses.partition_point(|pose| time_of(pose) < time);
    let before = after.checked_sub(1).and_then(|before| poses.get(before));
    let beside = before.into_iter().chain(poses.get(after));
    beside.min_by(|a, b| {
        (time_of(a) - time)
            .abs()
            .total_cmp(&(time_of(b) - time).abs())
    })
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

/// Multiple of the usual time between compared poses above which a gap is told.
const GAP: f64 = 10.0;

fn tell(arguments: &Arguments, scores: &[(&Path, Compared)], out: &mut dyn Write) -> Result {
    let json = |compared: &Compared| -> Value {
        let Compared { score, of, gap, .. } = compared;
        let summary = |errors: &ErrorStatistics| {
            json!({
                "rms_m": errors.rms, "mean_m": errors.mean, "median_m": errors.median, "sd_m": errors.sd,
                "least_m": errors.least, "largest_m": errors.largest, "count": errors.count,
            })
        };
        json!({
            "poses": score.absolute.count, "poses_of_trajectory": of[0], "poses_of_truth": of[1],
            "rms_m": score.absolute.rms, "largest_m": score.absolute.largest, "scale": score.scale,
            "absolute": summary(&score.absolute), "relative": summary(&score.relative),
            "relative_turn_rms_rad": score.relative_turn_rms, "longest_gap_s": gap.map(|gap| gap.0),
        })
    };
    match (arguments.json, scores) {
        (true, [(_, one)]) => return Ok(writeln!(out, "{:#}", json(one))?),
        (true, all) => {
            let all: serde_json::Map<String, Value> = (all.iter())
                .map(|(file, compared)| (file.display().to_string(), json(compared)))
                .collect();
            return Ok(writeln!(out, "{:#}", Value::Object(all))?);
        }
        (false, [(_, one)]) => return tell_one(arguments, one, out),
        (false, _) => {}
    }
    writeln!(
        out,
        "{:>14} {:>9} {:>9} {:>9} {:>12}  trajectory",
        "poses", "rms, m", "mean, m", "max, m", "relative, m"
    )?;
    for (file, Compared { score, of, .. }) in scores {
        let ErrorStatistics {
            count,
            rms,
            mean,
            largest,
            ..
        } = score.absolute;
        let poses = format!("{count} of {}", of[0]);
        writeln!(
            out,
            "{poses:>14} {rms:>9.3} {mean:>9.3} {largest:>9.3} {:>12.3}  {}",
            score.relative.rms,
            file.display()
        )?;
    }
    Ok(())
}

fn tell_one(arguments: &Arguments, compared: &Compared, out: &mut dyn Write) -> Result {
    let Compared {
        score,
        alignment,
        of,
        gap,
    } = compared;
    let SpatialScore {
        absolute,
        relative,
        relative_turn_rms,
        scale,
    } = score;
    let [found, truth] = of;
    let how = match alignment {
        TrajectoryAlignment::Plane => "aligned in the plane".to_owned(),
        TrajectoryAlignment::Space => "aligned in space".to_owned(),
        TrajectoryAlignment::Scale => format!("aligned in space, scaled by {scale:.4}"),
        TrajectoryAlignment::None => "not aligned".to_owned(),
    };
    writeln!(
        out,
        "{} ({} of {found} of the trajectory, of {truth} of the truth), {how}",
        counted(absolute.count, "pose"),
        absolute.count,
    )?;
    writeln!(
        out,
        "error {:.3} m (root mean square), mean {:.3} m, at most {:.3} m",
        absolute.rms, absolute.mean, absolute.largest
    )?;
    if relative.count > 0 {
        writeln!(
            out,
            "from one pose to the next{}: {:.3} m and {:.2}° (root mean square)",
            if arguments.step > 1 {
                format!(" but {}", arguments.step - 1)
            } else {
                String::new()
            },
            relative.rms,
            relative_turn_rms.to_degrees()
        )?;
    }
    if let Some((longest, usual)) = gap
        && *longest > GAP * usual
    {
        writeln!(
            out,
            "the longest gap without a pose is {longest:.1} s; poses within it are left out"
        )?;
    }
    Ok(())
}
