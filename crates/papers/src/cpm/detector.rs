//! How well junctions and dead ends are told by one sweep: section 4.1, with what each step of ours adds to it.

use alloc::sync::Arc;

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_control::epuck::{Alignment, Pilot, Place, Profile, SegmentConfig};
use tolman_control::heading_of;
use tolman_geom::{Pose, Vector};
use tolman_robot::Robot as _;
use tolman_robot::epuck::WheelSpeeds;
use tolman_sim::robots::Epuck;

use tolman_arena::cpm::{SimulatedEpuck, Venue, epuck, survey, walker_config};
use tolman_experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table};

/// The name of the table.
pub(super) const DETECTOR: &str = "detector";

/// How a row looks.
#[derive(Debug)]
struct Setting {
    name: &'static str,
    alignment: Alignment,
    segments: SegmentConfig,
}

const SETTINGS: [Setting; 3] = [
    Setting {
        name: "Literal averaging",
        alignment: Alignment::Literal,
        segments: SegmentConfig::paper(),
    },
    Setting {
        name: "Aligned averaging",
        alignment: Alignment::Mounts,
        segments: SegmentConfig::paper(),
    },
    Setting {
        name: "Ours",
        alignment: Alignment::Mounts,
        segments: SegmentConfig::cut(),
    },
];

/// How wide corridors are in the rows that do not take the mazes as they are drawn, m.
const WIDE: f64 = 0.30;

/// How far from the middle of a cell the robot stands at most along either axis, m.
const OFF: f64 = 0.02;

/// How far it looks askew at most, rad.
const ASKEW: f64 = 0.15;

/// What is told apart: its name, and which cells of a maze are such.
const KINDS: [(&str, &str, Place); 2] = [
    ("junction", "junctions", Place::Junction),
    ("dead_end", "dead ends", Place::DeadEnd),
];

/// The row of a robot that walks and looks again from the middle of what it takes for a place.
const ON_THE_WAY: &str = "Ours, on the way";

/// The rows of single sweeps: each in the mazes as they are drawn, and with wide corridors.
fn settings() -> impl Iterator<Item = (&'static Setting, Option<f64>)> {
    let widths = [None, Some(WIDE)];
    let each = |width| SETTINGS.iter().map(move |setting| (setting, width));
    widths.into_iter().flat_map(each)
}

fn row(setting: &Setting, width: Option<f64>) -> String {
    match width {
        Some(width) => format!("{}, corridors of {width:.2} m", setting.name),
        None => setting.name.to_owned(),
    }
}

pub(super) fn table() -> Table {
    let mut table = Table::new(DETECTOR, "Junctions and dead ends told by one sweep")
        .field("looks", Kind::Count)
        .field("counted", Kind::Count)
        .metric(
            Metric::ratio("openings_right", "counted", "looks").titled("openings counted rightly"),
        );
    for (name, title, _) in KINDS {
        let [right, told, true_ones] = counts(name);
        let [precision, recall] = shares(name);
        table = table
            .field(right, Kind::Count)
            .field(told, Kind::Count)
            .field(true_ones, Kind::Count)
            .optional_field(&precision, Kind::Number)
            .optional_field(&recall, Kind::Number)
            .metric(Metric::mean(precision).titled(format!("{title}: precision")))
            .metric(Metric::mean(recall).titled("recall"));
    }
    for (setting, width) in settings() {
        table = table.row(Row::new(row(setting, width)));
    }
    table = table.row(Row::new(ON_THE_WAY));
    table.note(format!(
        "One sweep in every cell that the robot can come to, up to {:.0} cm off its middle and {ASKEW} rad askew. Literal: the eight vectors are averaged as they come, aligned: each turned by its sensor's mounting angle \
         first; both cut by the paper's rule. Ours: values above 60 are cut before steps are taken. On the way: every \
         fragment is walked both ways by a robot that drives to the middle of what looks like a place and looks again.",
        100.0 * OFF
    ))
}

/// What the runs depend on.
pub(super) fn config() -> String {
    format!("{SETTINGS:?}, {WIDE}, {OFF}, {ASKEW}")
}

/// The fields of a kind: told and true, told, true.
fn counts(kind: &str) -> [String; 3] {
    ["right", "told", "there"].map(|what| format!("{kind}s_{what}"))
}

/// The fields that are shares of those; none where nothing is told, or nothing there.
fn shares(kind: &str) -> [String; 2] {
    ["precision", "recall"].map(|what| format!("{kind}_{what}"))
}

/// What was told of places, and what they were.
#[derive(Default)]
struct Tally {
    looks: u64,
    /// Looks that counted the openings rightly.
    counted: u64,
    /// For each kind: told and true, told, true.
    kinds: [[u64; 3]; KINDS.len()],
}

impl Tally {
    /// A place of so many openings looked as one of that many.
    fn told(&mut self, openings: usize, truth: usize) {
        self.looks += 1;
        self.counted += u64::from(openings == truth);
        for ((_, _, kind), [right, told, there]) in KINDS.iter().zip(&mut self.kinds) {
            let (is_told, is_there) = (place_of(openings) == *kind, place_of(truth) == *kind);
            *right += u64::from(is_told && is_there);
            *told += u64::from(is_told);
            *there += u64::from(is_there);
        }
    }

    /// Nothing was told of a place.
    fn missed(&mut self, truth: usize) {
        for ((_, _, kind), [_, _, there]) in KINDS.iter().zip(&mut self.kinds) {
            *there += u64::from(place_of(truth) == *kind);
        }
    }

    fn fields(&self) -> Fields {
        let mut fields = Fields::new()
            .count("looks", self.looks)
            .count("counted", self.counted);
        for ((kind, ..), found) in KINDS.iter().zip(self.kinds) {
            for (name, count) in counts(kind).into_iter().zip(found) {
                fields = fields.count(name, count);
            }
            let [right, told, there] = found;
            for (name, whole) in shares(kind).into_iter().zip([told, there]) {
                if whole > 0 {
                    fields = fields.number(name, right as f64 / whole as f64);
                }
            }
        }
        fields
    }
}

/// Looks at places of all mazes.
pub(super) fn run(venues: &[Venue], job: &Job<'_>) -> Result<Fields, BoxError> {
    let mut tally = Tally::default();
    let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
    for venue in venues {
        if job.row == ON_THE_WAY {
            walk(venue, job.seed, &mut tally)?;
            continue;
        }
        let (setting, width) = settings()
            .find(|(setting, width)| row(setting, *width) == job.row)
            .ok_or("there is no such row")?;
        let venue = Venue {
            corridor_width: width.unwrap_or(venue.corridor_width),
            ..venue.clone()
        };
        sweep_all(setting, &venue, job.seed, &mut rng, &mut tally)?;
    }
    Ok(tally.fields())
}

/// One sweep in every cell that the robot can come to.
fn sweep_all(
    setting: &Setting,
    venue: &Venue,
    seed: u64,
    rng: &mut impl Rng,
    tally: &mut Tally,
) -> Result<(), BoxError> {
    let world = Arc::new(venue.world()?);
    let mut pilot = None;
    for cell in venue.maze.reachable() {
        let ways: Vec<_> = venue.maze.neighbours(cell).collect();
        let Some((way, _)) = ways.get(rng.random_range(0..ways.len().max(1) as u32) as usize)
        else {
            continue;
        };
        let mut off = || rng.random_range(-OFF..=OFF);
        let position = world.cell_centre(cell) + Vector::new(off(), off());
        let heading = heading_of(*way).turned(rng.random_range(-ASKEW..=ASKEW));
        let pose = Pose::new(position, heading);
        let pilot = match &mut pilot {
            Some(pilot) => pilot,
            None => {
                let robot = Epuck::new(epuck())?;
                let body = SimulatedEpuck::new(Arc::clone(&world), robot, pose, seed)?;
                let config = walker_config(&epuck(), venue.corridor_width)?.pilot;
                pilot.insert(Pilot::new(body, config))
            }
        };
        let body = pilot.robot_mut();
        body.place(pose)?;
        // What it senses is of its last step, before it was lifted.
        body.step(&WheelSpeeds::default())?;
        let sweep = pilot.sweep()?;
        let profile = Profile::of(&sweep, setting.alignment)?;
        let segments = profile.segments(&setting.segments)?;
        tally.told(segments.spaces().count(), ways.len());
    }
    Ok(())
}

/// The robot walks every fragment both ways; what is told of the place at its end counts, and a place that it does not come to is missed.
fn walk(venue: &Venue, seed: u64, tally: &mut Tally) -> Result<(), BoxError> {
    let config = walker_config(&epuck(), venue.corridor_width)?;
    for walk in survey(&venue.maze, &epuck(), &config, seed)? {
        let degree = |cell| venue.maze.degree(cell);
        tally.told(walk.sighting.degree as usize, walk.to.map_or(0, degree));
        if walk.to != Some(walk.way.to) {
            tally.missed(degree(walk.way.to));
        }
    }
    Ok(())
}

/// What a cell with so many ways out is.
const fn place_of(degree: usize) -> Place {
    match degree {
        0 => Place::Closed,
        1 => Place::DeadEnd,
        2 => Place::Path,
        _ => Place::Junction,
    }
}

/// What no run of this table can be.
pub(super) fn check(run: &Run) -> Result<(), BoxError> {
    let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
    if number("counted") > number("looks") {
        return Err("more looks counted rightly than were taken".into());
    }
    for (kind, ..) in KINDS {
        let [right, told, there] = counts(kind).map(|name| number(&name));
        if right > told || right > there || told > number("looks") {
            return Err(format!("more {kind}s than there are").into());
        }
        for (name, whole) in shares(kind).into_iter().zip([told, there]) {
            let expected = right.zip(whole).filter(|(_, whole)| *whole > 0.0);
            let expected = expected.map(|(right, whole)| right / whole);
            let is_that = match (number(&name), expected) {
                (Some(found), Some(expected)) => (found - expected).abs() < 1e-9,
                (found, expected) => found == expected,
            };
            if !is_that {
                return Err(format!("{name} is not {expected:?}").into());
            }
        }
    }
    Ok(())
}
