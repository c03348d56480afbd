//! Chooses the topics that are used, and gives each scan the robot's pose by odometry.

use tolman_geom::Pose;
use tolman_robot::{Ring, Scan, TimedPose, Trajectory};

use super::frames::{Mount, moves, on_floor};
use super::message::{LaserScan, Times};
use super::topics::{Kept, Topics};
use crate::log::{
    Bridged, LogOptions, LogReport, LogScan, LogTimes, LogTrouble, bridged, tell_jumps,
};

/// Scans in the order of time, and the report on them.
pub(crate) type Placed = (Vec<LogScan>, LogReport);

/// Topic of transforms, in place of one of odometry.
const TRANSFORMS: &str = "/tf";

/// Least cosine of the angle between a laser's axis and the vertical: one that stands on its edge
/// sees no floor plan.
const LEVEL: f64 = 0.5;

/// The robot's poses by one source of odometry.
struct Wheels {
    topic: String,
    /// Part of the robot that the poses are of.
    base: String,
    poses: Vec<(Times, Pose)>,
}

/// Laser of a topic.
type Laser = (String, Vec<Kept<LaserScan>>);

pub(super) fn placed(
    mut topics: Topics,
    mut report: LogReport,
    options: &LogOptions,
) -> Result<Placed, String> {
    let lasers = lasers(&mut topics, &mut report, options)?;
    let wheels = wheels(&topics, &lasers, &mut report, options)?;
    let clock = clock(&lasers, &wheels, &mut report, options.times);
    let odometry = (wheels.poses.iter()).map(|(times, pose)| TimedPose {
        time: clock.of(times),
        pose: *pose,
    });
    let Bridged { poses, jumps } = bridged(Trajectory::new(odometry).poses());
    tell_jumps(
        &mut report,
        &format!("the odometry of {}", wheels.topic),
        &jumps,
    );
    let way = Trajectory::new(poses);
    report.odometry = wheels.poses.len() as u64;
    let mut placing = Placing {
        report,
        topics: &topics,
        wheels: &wheels,
        way: &way,
        clock,
    };
    let mut scans: Vec<LogScan> = Vec::new();
    for (topic, kept) in &lasers {
        let largest = largest(kept);
        let placed = kept.iter().map(|scan| placing.placed(topic, scan, largest));
        scans.extend(placed.flatten());
    }
    scans.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.line.cmp(&b.line)));
    let mut report = placing.report;
    report.scans = scans.len() as u64;
    for topic in topics.list() {
        let is_read = topic.name == wheels.topic
            || lasers.iter().any(|(laser, _)| *laser == topic.name)
            || topic.name.ends_with("tf_static");
        if !is_read {
            let kind = format!("{} ({})", topic.name, topic.kind);
            report.met_other_kinds(&kind, topic.first, topic.count);
        }
    }
    Ok((scans, report))
}

/// Returns the lasers that are used: those of the options, else the one whose beams met most.
fn lasers(
    topics: &mut Topics,
    report: &mut LogReport,
    options: &LogOptions,
) -> Result<Vec<Laser>, String> {
    let names: Vec<String> = topics.scans.keys().cloned().collect();
    if names.is_empty() {
        let all = topics.list();
        let all: Vec<String> = (all.iter())
            .map(|it| format!("{} ({})", it.name, it.kind))
            .collect();
        return Err(format!(
            "it has no laser scans; its topics: {}",
            all.join(", ")
        ));
    }
    if !options.scan_topics.is_empty() {
        let chosen = options.scan_topics.iter().map(|name| {
            let kept = topics.scans.remove_entry(name);
            kept.ok_or_else(|| {
                format!(
                    "it has no scans of topic {name}; give --scan-topic with one of: {}",
                    names.join(", ")
                )
            })
        });
        return chosen.collect();
    }
    let met = |name: &String| -> usize {
        let scans = topics.scans.get(name).into_iter().flatten();
        let met = scans.map(|kept| {
            let seen = kept.message.range_min.max(0.0)..;
            let ranges = kept.message.ranges.iter();
            ranges
                .filter(|range| range.is_finite() && seen.contains(range))
                .count()
        });
        met.sum()
    };
    let most = names.iter().map(|name| (met(name), name));
    // Of equal ones the first.
    let most = most.rev().max_by_key(|(met, _)| *met);
    let chosen = most.map(|(_, name)| name.clone()).unwrap_or_default();
    if names.len() > 1 {
        report.notes.push(format!(
            "{} lasers: {}; {chosen} is read, whose beams met most; choose by --scan-topic, once for each that is to be used",
            names.len(),
            names.join(", "),
        ));
    }
    Ok(topics.scans.remove_entry(&chosen).into_iter().collect())
}

/// Returns the odometry that is used: that of the options, else the one that moves during most
/// scans; without poses if there is none.
fn wheels(
    topics: &Topics,
    lasers: &[Laser],
    report: &mut LogReport,
    options: &LogOptions,
) -> Result<Wheels, String> {
    let mut all: Vec<Wheels> = Vec::new();
    for (topic, kept) in &topics.odometry {
        let finite = kept.iter().filter(|kept| {
            let is_finite = on_floor(&kept.message.pose).is_finite();
            if !is_finite {
                let what = format!("{topic}: a pose that is not a number");
                report.met_trouble(LogTrouble::NoNumber, kept.number, what);
            }
            is_finite
        });
        all.push(Wheels {
            topic: topic.clone(),
            poses: (finite.map(|kept| (kept.times, on_floor(&kept.message.pose)))).collect(),
            base: kept
                .last()
                .map_or_else(String::new, |kept| kept.message.child.clone()),
        });
    }
    let frame = lasers.iter().find_map(|(_, kept)| kept.first());
    let frame = frame.map_or("", |kept| kept.message.header.frame.as_str());
    if let Some((base, poses)) = topics.frames.odometry(frame) {
        all.push(Wheels {
            topic: TRANSFORMS.to_owned(),
            base: base.to_owned(),
            poses,
        });
    }
    let names: Vec<String> = all.iter().map(|wheels| wheels.topic.clone()).collect();
    if let Some(name) = &options.odom_topic {
        let chosen = all.into_iter().find(|wheels| wheels.topic == *name);
        let all = if names.is_empty() {
            "no topic".to_owned()
        } else {
            names.join(", ")
        };
        return chosen
            .ok_or_else(|| format!("it has no odometry of topic {name}; it has that of {all}"));
    }
    let scans = lasers.iter().flat_map(|(_, kept)| kept);
    let scans: Vec<&Times> = scans.map(|kept| &kept.times).collect();
    let covered = |wheels: &Wheels| match moves(wheels.poses.iter().map(|(_, pose)| pose)) {
        true => {
            1 + Clock::Header
                .covered(&scans, wheels)
                .max(Clock::Receipt.covered(&scans, wheels))
        }
        false => 0,
    };
    let best = all.into_iter().map(|wheels| (covered(&wheels), wheels));
    // Of equal ones the first: a topic of odometry before the transforms.
    let best = best.rev().max_by_key(|(covered, _)| *covered);
    let Some((_, wheels)) = best.filter(|(covered, _)| *covered > 0) else {
        let what = match names.is_empty() {
            true => "it has no odometry, neither as a topic nor in /tf".to_owned(),
            false => format!("the odometry of {} never moves", names.join(" and of ")),
        };
        report
            .notes
            .push(format!("{what}: the way is found from the scans alone"));
        return Ok(Wheels {
            topic: String::new(),
            base: String::new(),
            poses: Vec::new(),
        });
    };
    if names.len() > 1 || wheels.topic == TRANSFORMS {
        let all = names.join(", ");
        let read = &wheels.topic;
        report.notes.push(format!(
            "odometry of {all}; {read} is read; choose by --odom-topic"
        ));
    }
    Ok(wheels)
}

/// The clock by which scans and odometry are put together.
#[derive(Clone, Copy, Debug)]
enum Clock {
    Header,
    Receipt,
}

impl Clock {
    const fn of(self, times: &Times) -> f64 {
        match self {
            Self::Header => times.header,
            Self::Receipt => times.received,
        }
    }

    /// Returns the number of scans within the time of the odometry.
    fn covered(self, scans: &[&Times], wheels: &Wheels) -> usize {
        let times = wheels.poses.iter().map(|(times, _)| self.of(times));
        let ends = times.fold(None, |ends: Option<(f64, f64)>, time| {
            let (low, high) = ends.unwrap_or((time, time));
            Some((low.min(time), high.max(time)))
        });
        let Some((low, high)) = ends else { return 0 };
        let scans = scans.iter().map(|times| self.of(times));
        scans.filter(|time| (low..=high).contains(time)).count()
    }

    /// Returns whether the times of the scans differ.
    fn runs(self, scans: &[&Times]) -> bool {
        let mut times = scans.iter().map(|times| self.of(times));
        let first = times.next();
        scans.len() < 2 || times.any(|time| Some(time) != first)
    }
}

fn clock(
    lasers: &[Laser],
    wheels: &Wheels,
    report: &mut LogReport,
    wanted: Option<LogTimes>,
) -> Clock {
    match wanted {
        Some(LogTimes::Header) => return Clock::Header,
        Some(LogTimes::Receipt) => return Clock::Receipt,
        None => {}
    }
    let scans = lasers.iter().flat_map(|(_, kept)| kept);
    let scans: Vec<&Times> = scans.map(|kept| &kept.times).collect();
    let [by_header, by_receipt] =
        [Clock::Header, Clock::Receipt].map(|clock| clock.covered(&scans, wheels));
    let why = if !Clock::Header.runs(&scans) && Clock::Receipt.runs(&scans) {
        "the scans' headers all have the same time"
    } else if 2 * by_header < by_receipt {
        "by their headers most scans lie outside the time of the odometry"
    } else {
        return Clock::Header;
    };
    report.notes.push(format!(
        "{why}: the times of receipt are used; choose by --times"
    ));
    Clock::Receipt
}

/// Returns the largest range that a laser has measured, m.
fn largest(kept: &[Kept<LaserScan>]) -> f64 {
    let ranges = kept.iter().flat_map(|kept| &kept.message.ranges);
    let finite = ranges.filter(|range| range.is_finite());
    f64::from(finite.copied().fold(0.0, f32::max))
}

struct Placing<'a> {
    report: LogReport,
    topics: &'a Topics,
    wheels: &'a Wheels,
    way: &'a Trajectory,
    clock: Clock,
}

impl Placing<'_> {
    /// Returns a scan with the robot's pose by odometry at that time. `largest` is the largest
    /// range of its laser.
    fn placed(&mut self, topic: &str, kept: &Kept<LaserScan>, largest: f64) -> Option<LogScan> {
        let Kept {
            number,
            times,
            message,
        } = kept;
        let time = self.clock.of(times);
        let odometry = match self.way.poses().is_empty() {
            true => Some(Pose::IDENTITY),
            false => self.way.at(time),
        };
        let mut met = |trouble, what: &str| {
            let what = format!("{topic}: {what}");
            self.report.met_trouble(trouble, *number, what);
        };
        let Some(odometry) = odometry else {
            met(LogTrouble::NoOdometry, &format!("at {time:.3} s"));
            return None;
        };
        let frame = &message.header.frame;
        let mount = self.topics.frames.mount(&self.wheels.base, frame);
        let mount = mount.unwrap_or_else(|| {
            met(LogTrouble::NoMount, frame);
            Mount {
                robot_from_laser: Pose::IDENTITY,
                upright: 1.0,
            }
        });
        if mount.upright.abs() < LEVEL {
            met(LogTrouble::OnEdge, frame);
            return None;
        }
        let max_range = match f64::from(message.range_max) {
            most if most.is_finite() && most > 0.0 => most,
            most => {
                met(LogTrouble::NoMaxRange, &format!("range_max is {most}"));
                largest
            }
        };
        let Some((scan, bad)) = scan(message, max_range, mount.upright < 0.0) else {
            met(
                LogTrouble::NoNumber,
                "angles that are not numbers, or no ranges",
            );
            return None;
        };
        if bad > 0 {
            met(
                LogTrouble::NoRange,
                &format!("{bad} of {}", scan.ranges.len()),
            );
        }
        let hits = scan
            .ranges
            .iter()
            .filter(|range| **range < max_range)
            .count();
        self.report.empty_scans += u64::from(hits == 0);
        Some(LogScan {
            line: *number,
            time,
            odometry,
            noted: odometry,
            robot_from_laser: mount.robot_from_laser,
            scan,
        })
    }
}

/// Returns the scan of a message and the number of its ranges that say nothing; `None` if its
/// angles are invalid. A laser that hangs upside down sees its beams mirrored.
fn scan(message: &LaserScan, max_range: f64, is_mirrored: bool) -> Option<(Scan, usize)> {
    let side = if is_mirrored { -1.0 } else { 1.0 };
    let [first, spacing] =
        [message.angle_min, message.angle_increment].map(|angle| side * f64::from(angle));
    if !(first.is_finite() && spacing.is_finite()) || message.ranges.is_empty() {
        return None;
    }
    let least = f64::from(message.range_min).max(f64::MIN_POSITIVE);
    let ranges = message.ranges.iter().map(|range| f64::from(*range));
    // Neither a beam that says nothing nor one that met nothing has an end on the map.
    let says_nothing = |range: &f64| range.is_nan() || *range < least;
    let bad = ranges.clone().filter(says_nothing).count();
    let ring = Ring {
        beams: u32::try_from(message.ranges.len()).ok()?,
        first_bearing: first,
        spacing,
        max_range,
    };
    let length = |range: f64| match says_nothing(&range) {
        true => max_range,
        false => range.min(max_range),
    };
    let ranges = ranges.map(length).collect();
    Some((Scan { ring, ranges }, bad))
}
