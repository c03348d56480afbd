//! Puts right what whole logs have wrong: their order, where the laser sits, odometry that jumps,
//! and ranges that stand for "nothing seen".

use tolman_geom::Pose;
use tolman_robot::TimedPose;

use super::{LogReport, LogScan};

/// Speed above which no robot drives, m/s and rad/s, and the step that is allowed at any time.
const FASTEST: f64 = 3.0;
const SLACK: f64 = 0.5;

/// Share of a log's steps that are usual, and the multiple of the longest of these above which a
/// step is a jump. Some logs have no true times.
const USUAL: f64 = 0.95;
const UNUSUAL: f64 = 4.0;

/// Poses by odometry without jumps, and the poses after each jump.
pub(crate) struct Bridged {
    pub(crate) poses: Vec<TimedPose>,
    pub(crate) jumps: Vec<TimedPose>,
}

/// Bridges jumps of the odometry that no robot can drive, as where it was reset: the robot goes on
/// as in the step before. O(n log n).
pub(crate) fn bridged(poses: &[TimedPose]) -> Bridged {
    let steps = || {
        poses
            .windows(2)
            .filter_map(|pair| step(pair.first()?, pair.last()?))
    };
    let usual = |size: fn(&Pose) -> f64| {
        let mut sizes: Vec<f64> = steps().map(|(step, _)| size(&step)).collect();
        sizes.sort_by(f64::total_cmp);
        let last = sizes.len().saturating_sub(1);
        // Cut off on purpose: the number of a step.
        #[expect(clippy::cast_possible_truncation, reason = "below the number of steps")]
        let place = (last as f64 * USUAL) as usize;
        sizes.get(place).copied().unwrap_or(0.0)
    };
    let (usual_way, usual_turn) = (usual(way), usual(turn));
    let mut bridged: Vec<TimedPose> = poses.iter().take(1).copied().collect();
    let mut jumps = Vec::new();
    let mut bridge: Option<Pose> = None;
    let mut going = Pose::IDENTITY;
    for (now, found) in poses.iter().skip(1).zip(steps()) {
        let (step, duration) = found;
        let most = SLACK + FASTEST * duration;
        let is_jump = way(&step) > most.max(UNUSUAL * usual_way)
            || turn(&step) > most.max(UNUSUAL * usual_turn);
        let before = bridged.last().map_or(now.pose, |before| before.pose);
        if is_jump {
            bridge = Some(before.compose(going).compose(now.pose.inverse()));
            jumps.push(*now);
        } else {
            going = step;
        }
        bridged.push(TimedPose {
            pose: bridge.map_or(now.pose, |bridge| bridge.compose(now.pose)),
            ..*now
        });
    }
    Bridged {
        poses: bridged,
        jumps,
    }
}

/// Returns the step from one pose to the next, and its duration, s.
fn step(before: &TimedPose, now: &TimedPose) -> Option<(Pose, f64)> {
    let duration = (now.time - before.time).max(0.0);
    Some((before.pose.between(now.pose), duration))
}

fn way(step: &Pose) -> f64 {
    step.position.coords.norm()
}

fn turn(step: &Pose) -> f64 {
    step.heading.radians().abs()
}

/// Puts scans right, in place.
pub(crate) fn tidy(scans: &mut [LogScan], report: &mut LogReport) {
    order(scans, report);
    mounts(scans, report);
    nothing_seen(scans, report);
    let timed = scans.iter().map(|scan| TimedPose {
        time: scan.time,
        pose: scan.odometry,
    });
    let timed: Vec<TimedPose> = timed.collect();
    let Bridged { poses, jumps } = bridged(&timed);
    for (scan, bridged) in scans.iter_mut().zip(poses) {
        scan.odometry = bridged.pose;
    }
    tell_jumps(report, "the odometry", &jumps);
}

/// Maximum number of jumps that are named.
const NAMED: usize = 5;

/// Reports jumps of the odometry that were bridged.
pub(crate) fn tell_jumps(report: &mut LogReport, what: &str, jumps: &[TimedPose]) {
    let named = jumps.iter().take(NAMED);
    let named: Vec<String> = named.map(|jump| format!("{:.3} s", jump.time)).collect();
    if !named.is_empty() {
        let (count, at) = (jumps.len(), named.join(", "));
        report.notes.push(format!(
            "{what} jumps {count} × as no robot drives, at {at}{}: the robot is taken to go on as before",
            if count > NAMED { ", …" } else { "" },
        ));
    }
}

/// Sorts scans by time if their odometry is no longer that way than in the order of the file.
fn order(scans: &mut [LogScan], report: &mut LogReport) {
    if scans.is_sorted_by(|a, b| a.time <= b.time) {
        return;
    }
    let length = |scans: &[&LogScan]| -> f64 {
        let steps = scans.windows(2).filter_map(|pair| {
            let step = pair.first()?.odometry.between(pair.last()?.odometry);
            Some(way(&step) + turn(&step))
        });
        steps.sum()
    };
    let in_file: Vec<&LogScan> = scans.iter().collect();
    let mut by_time = in_file.clone();
    by_time.sort_by(|a, b| a.time.total_cmp(&b.time));
    let is_better = length(&by_time) <= length(&in_file);
    let how = match is_better {
        true => {
            scans.sort_by(|a, b| a.time.total_cmp(&b.time));
            "scans are not in the order of time: they are sorted"
        }
        false => {
            "the clock goes back, but the odometry goes on: scans are used in the order of the file"
        }
    };
    report.notes.push(how.to_owned());
}

/// Distance, m, and turn, rad, below which two poses of a laser on its robot are the same.
const SAME_MOUNT: f64 = 0.02;
/// Least share of the scans whose laser sits at the same place.
const MOST_SCANS: f64 = 0.9;

/// Takes the second pose of each scan for the laser's, if it sits at the same place of the robot
/// throughout the log. On corrected logs it does not.
fn mounts(scans: &mut [LogScan], report: &mut LogReport) {
    let mount = |scan: &LogScan| scan.odometry.between(scan.noted);
    let (Some(first), Some(middle)) = (scans.first(), scans.get(scans.len() / 2)) else {
        return;
    };
    let (first, sits) = (first.odometry, mount(middle));
    let is_same = |scan: &&LogScan| {
        let off = sits.between(mount(scan));
        way(&off) < SAME_MOUNT && turn(&off) < SAME_MOUNT
    };
    let same = scans.iter().filter(is_same).count();
    let is_given = scans
        .iter()
        .any(|scan| scan.robot_from_laser != Pose::IDENTITY);
    // The way of a robot that never turned may have been corrected by a shift.
    let turns = scans
        .iter()
        .any(|scan| turn(&first.between(scan.odometry)) > SLACK);
    let is_plain = turns || way(&sits) < SLACK;
    if is_given || !is_plain || (same as f64) < MOST_SCANS * scans.len() as f64 {
        return;
    }
    if way(&sits) > SAME_MOUNT || turn(&sits) > SAME_MOUNT {
        report.notes.push(format!(
            "the laser sits {:.2} m from the robot's middle, by the poses of the scans",
            way(&sits)
        ));
    }
    for scan in scans {
        scan.robot_from_laser = sits;
    }
}

/// Share of all readings above which the greatest reading stands for "nothing seen".
const OFTEN: f64 = 0.01;

/// Multiple of the readings just below it that the greatest reading must have, and how far "just
/// below" reaches, m.
const HEAP: usize = 10;
const BELOW: f64 = 0.2;

/// Takes a greatest reading that is met too often for a wall's as "nothing seen".
fn nothing_seen(scans: &mut [LogScan], report: &mut LogReport) {
    let hits = |scan: &LogScan| {
        let most = scan.scan.ring.max_range;
        let hits = scan.scan.ranges.clone().into_iter();
        hits.filter(move |range| *range < most)
            .collect::<Vec<f64>>()
    };
    let all: usize = scans.iter().map(|scan| scan.scan.ranges.len()).sum();
    let greatest = scans.iter().flat_map(hits).fold(0.0, f64::max);
    let [mut heap, mut below, mut met] = [0, 0, 0];
    for range in scans.iter().flat_map(hits) {
        met += 1;
        heap += usize::from(range >= greatest);
        below += usize::from((greatest - BELOW..greatest).contains(&range));
    }
    if (heap as f64) < OFTEN * all as f64 || heap < HEAP * (below + 1) || heap == met {
        return;
    }
    report.notes.push(format!(
        "{heap} of {all} ranges are {greatest} m, the greatest of the log: they are taken for beams that met nothing"
    ));
    for scan in scans {
        let most = &mut scan.scan.ring.max_range;
        *most = most.min(greatest);
        for range in &mut scan.scan.ranges {
            *range = range.min(*most);
        }
    }
}
