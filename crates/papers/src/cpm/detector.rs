//! Recognition of junctions and dead ends from one sweep (section 4.1), and the effect of each of
//! our additions.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Serialize;
use tolman_control::epuck::{Pilot, PlaceKind, Profile, SegmentConfig, SensorAlignment};
use tolman_control::heading_of;
use tolman_geom::{Pose, Vector};
use tolman_robot::Robot as _;
use tolman_robot::epuck::WheelSpeeds;
use tolman_sim::robots::Epuck;

use crate::rows::row_of;
use tolman_arena::course::Course;
use tolman_arena::cpm::{epuck, survey, walker_config};
use tolman_experiment::{
    Better, BoxError, Fields, Job, Metric, Record, Row, Table, record, require,
};

/// Name of the table.
pub(super) const DETECTOR: &str = "detector";

/// Setting of a row.
#[derive(Clone, Copy, Debug, Serialize)]
struct Setting {
    name: &'static str,
    alignment: SensorAlignment,
    segments: SegmentConfig,
}

const SETTINGS: [Setting; 3] = [
    Setting {
        name: "Literal averaging",
        alignment: SensorAlignment::Literal,
        segments: SegmentConfig::paper(),
    },
    Setting {
        name: "Aligned averaging",
        alignment: SensorAlignment::Mounts,
        segments: SegmentConfig::paper(),
    },
    Setting {
        name: "Ours",
        alignment: SensorAlignment::Mounts,
        segments: SegmentConfig::cut(),
    },
];

/// Width of corridors in the rows that do not use that of the mazes, m.
const WIDE: f64 = 0.30;

/// Maximum offset of the robot from the middle of a cell along either axis, m.
const OFF: f64 = 0.02;

/// Maximum error of the robot's heading, rad.
const ASKEW: f64 = 0.15;

record! {
    /// Looks at the places of all mazes.
    #[check(DetectorRun::relations)]
    struct DetectorRun {
        /// Number of looks at places.
        looks: u32 => neither("looks"),
        /// Number of looks that counted the openings correctly.
        counted: u32 => higher("counted"),
        /// Number of looks that recognized a junction as one.
        junctions_right: u32 => higher("junctions recognized correctly"),
        /// Number of looks that reported a junction.
        junctions_told: u32 => neither("junctions reported"),
        /// Number of looks at a junction.
        junctions_there: u32 => neither("true junctions"),
        /// Number of looks that recognized a dead end as one.
        dead_ends_right: u32 => higher("dead ends recognized correctly"),
        /// Number of looks that reported a dead end.
        dead_ends_told: u32 => neither("dead ends reported"),
        /// Number of looks at a dead end.
        dead_ends_there: u32 => neither("true dead ends"),
        /// Share of the reported junctions that are junctions.
        junction_precision: Option<f64> => higher("junctions: precision").share(),
        /// Share of the true junctions that are reported.
        junction_recall: Option<f64> => higher("junctions: recall").share(),
        /// Share of the reported dead ends that are dead ends.
        dead_end_precision: Option<f64> => higher("dead ends: precision").share(),
        /// Share of the true dead ends that are reported.
        dead_end_recall: Option<f64> => higher("dead ends: recall").share(),
    }
}

impl DetectorRun {
    fn relations(&self) -> Result<(), String> {
        let counted = self.counted <= self.looks;
        require(counted, "more looks counted rightly than were taken")?;
        let mut again = self.clone();
        for (_, [right, told, there]) in again.kinds() {
            let possible = *right <= *told.min(there) && *told <= self.looks;
            require(possible, "more places of a kind than there are")?;
        }
        let shares = again.finished() == *self;
        require(shares, "precision or recall is not that of its counts")
    }

    /// Returns the kinds of places with their counts: recognized correctly, reported, and existing.
    const fn kinds(&mut self) -> [(PlaceKind, [&mut u32; 3]); 2] {
        let junctions = [
            &mut self.junctions_right,
            &mut self.junctions_told,
            &mut self.junctions_there,
        ];
        let dead_ends = [
            &mut self.dead_ends_right,
            &mut self.dead_ends_told,
            &mut self.dead_ends_there,
        ];
        [
            (PlaceKind::Junction, junctions),
            (PlaceKind::DeadEnd, dead_ends),
        ]
    }

    /// Counts a place with `truth` openings that looked like one with `openings`.
    fn told(&mut self, openings: usize, truth: usize) {
        self.looks += 1;
        self.counted += u32::from(openings == truth);
        self.place(Some(place_of(openings)), place_of(truth));
    }

    /// Counts a place with `truth` openings that was not reported.
    fn missed(&mut self, truth: usize) {
        self.place(None, place_of(truth));
    }

    fn place(&mut self, seen: Option<PlaceKind>, truth: PlaceKind) {
        for (kind, [right, told, there]) in self.kinds() {
            let (is_told, is_there) = (seen == Some(kind), truth == kind);
            *right += u32::from(is_told && is_there);
            *told += u32::from(is_told);
            *there += u32::from(is_there);
        }
    }

    /// Returns the record with the shares computed from its counts.
    fn finished(mut self) -> Self {
        self.junction_precision = share(self.junctions_right, self.junctions_told);
        self.junction_recall = share(self.junctions_right, self.junctions_there);
        self.dead_end_precision = share(self.dead_ends_right, self.dead_ends_told);
        self.dead_end_recall = share(self.dead_ends_right, self.dead_ends_there);
        self
    }
}

/// Returns the share of a part in the whole; `None` if the whole is 0.
fn share(part: u32, whole: u32) -> Option<f64> {
    (whole > 0).then(|| f64::from(part) / f64::from(whole))
}

/// Row of a robot that walks, and looks again from the believed middle of a place.
const ON_THE_WAY: &str = "Ours, on the way";

/// Returns the rows of single sweeps: each setting in the mazes as they are drawn, and with wide
/// corridors.
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
    let right = Metric::ratio("openings_right", DetectorRun::counted, DetectorRun::looks);
    let rows = settings().map(|(setting, width)| row(setting, width));
    let rows = rows.chain([ON_THE_WAY.to_owned()]);
    let table = Table::of::<DetectorRun>(DETECTOR, "Junctions and dead ends told by one sweep")
        .metric(
            right
                .titled("openings counted correctly")
                .better(Better::Higher),
        )
        .metrics_from(DetectorRun::junction_precision)
        .rows(rows.map(Row::new));
    table.note(format!(
        "One sweep in every cell that the robot can reach, up to {:.0} cm off its middle and {ASKEW} \
         rad askew. Literal: the eight vectors are averaged as they come. Aligned: each is turned by \
         its sensor's mounting angle first. Both are cut by the paper's rule. Ours: values above 60 \
         are cut before steps are computed. On the way: a robot walks every fragment both ways, \
         drives to the middle of what looks like a place, and looks again.",
        100.0 * OFF
    ))
}

/// Returns the configuration that the runs depend on.
pub(super) fn config() -> impl Serialize {
    #[derive(Serialize)]
    struct Config {
        settings: [Setting; SETTINGS.len()],
        /// Width of wide corridors, m.
        wide: f64,
        /// Maximum offset from the middle of a cell, m.
        off: f64,
        /// Maximum error of the heading, rad.
        askew: f64,
    }
    Config {
        settings: SETTINGS,
        wide: WIDE,
        off: OFF,
        askew: ASKEW,
    }
}

/// Plays a run: looks at the places of all mazes.
pub(super) fn run(courses: &[Course], job: &Job<'_>) -> Result<Fields, BoxError> {
    let mut tally = DetectorRun::default();
    let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
    for course in courses {
        if job.row == ON_THE_WAY {
            walk(course, job.seed, &mut tally)?;
            continue;
        }
        let is_of_row = |(setting, width): &(&Setting, _)| row(setting, *width) == job.row;
        let (setting, width) = row_of(job, settings(), is_of_row)?;
        let width = width.unwrap_or(course.corridor_width);
        let course = Course::new(&course.name, course.maze.clone(), width)?;
        sweep_all(setting, &course, job.seed, &mut rng, &mut tally)?;
    }
    Ok(tally.finished().fields()?)
}

/// Makes one sweep from every cell that the robot can reach, and adds it to the tally.
fn sweep_all(
    setting: &Setting,
    course: &Course,
    seed: u64,
    rng: &mut impl Rng,
    tally: &mut DetectorRun,
) -> Result<(), BoxError> {
    let mut pilot = None;
    for cell in course.maze.reachable() {
        let ways: Vec<_> = course.maze.neighbours(cell).collect();
        let Some((way, _)) = ways.get(rng.random_range(0..ways.len().max(1) as u32) as usize)
        else {
            continue;
        };
        let mut off = || rng.random_range(-OFF..=OFF);
        let position = course.world.cell_centre(cell) + Vector::new(off(), off());
        let heading = heading_of(*way).turned(rng.random_range(-ASKEW..=ASKEW));
        let pose = Pose::new(position, heading);
        let pilot = match &mut pilot {
            Some(pilot) => pilot,
            None => {
                let body = course.robot_at(pose, Epuck::new(epuck())?, seed)?;
                let config = walker_config(&epuck(), course.corridor_width)?.pilot;
                pilot.insert(Pilot::new(body, config))
            }
        };
        let body = pilot.robot_mut();
        body.place(pose)?;
        // Its readings are those of its last step, before it was lifted.
        body.step(&WheelSpeeds::default())?;
        let sweep = pilot.sweep()?;
        let profile = Profile::of(&sweep, setting.alignment)?;
        let segments = profile.segments(&setting.segments)?;
        tally.told(segments.spaces().count(), ways.len());
    }
    Ok(())
}

/// Counts the places at the ends of all fragments, each walked both ways. A place that the robot
/// does not reach counts as missed.
fn walk(course: &Course, seed: u64, tally: &mut DetectorRun) -> Result<(), BoxError> {
    let config = walker_config(&epuck(), course.corridor_width)?;
    for walk in survey(course, &epuck(), &config, seed)? {
        let degree = |cell| course.maze.degree(cell);
        tally.told(walk.sighting.degree as usize, walk.to.map_or(0, degree));
        if walk.to != Some(walk.way.to) {
            tally.missed(degree(walk.way.to));
        }
    }
    Ok(())
}

/// Returns the kind of a cell with `degree` ways out.
const fn place_of(degree: usize) -> PlaceKind {
    match degree {
        0 => PlaceKind::Closed,
        1 => PlaceKind::DeadEnd,
        2 => PlaceKind::Path,
        _ => PlaceKind::Junction,
    }
}
