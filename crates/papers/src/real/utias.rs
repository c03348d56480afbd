//! A place map of one robot's observations, on which other robots localize. It gives the score of
//! GNG-SLAM's paper on real robots.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_arena::gngslam::{CellGrid, LaidOver, PointScore};
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};
use tolman_formats::{BarcodeSighting, LogVelocity, UtiasRobot};
use tolman_geom::{Point, Pose};
use tolman_maps::place_map::{
    FeatureChoice, FeatureGroup, FeatureScaling, FeatureTable, FeatureWeights, ImageForm, PlaceMap,
    PlaceMapConfig, PlaceRecord,
};
use tolman_quantizers::GngConfig;
use tolman_robot::{Snapshot, Sounding, Trajectory};
use tolman_sim::Bounds;

use super::landmarks::{LandmarkMap, steps_of};
use super::relations::{file, missing_of};

/// Name of the table.
pub(super) const NAME: &str = "utias";

const FOLDER: &str = "logs/utias";
const PLACE_MAP: &str = "place map";
const RANDOM: &str = "random";

/// Numbers of the robot that learns, and of the robot that uses its map.
const PAIRS: [[u32; 2]; 6] = [[1, 2], [1, 3], [2, 1], [2, 3], [3, 1], [3, 2]];

/// Time for which a robot remembers its sightings, s.
const MEMORY_S: f64 = 10.0;
/// Minimum number of known landmarks for an answer.
const LEAST_SEEN: usize = 2;
/// Number of nodes of the map: two per cell.
const NODES: usize = 128;

record! {
    /// A robot that localizes on the map of another.
    struct UtiasRun {
        /// Mean score of its records: 1 inside the true cell of 8 × 8; otherwise 0.5 / distance to
        /// the cell's middle, in cells.
        score: f64 => higher("score").decimals(3),
        /// Mean distance from its true position, m.
        error_m: f64 => lower("error").unit("m").at_least(0),
        /// Root-mean-square error of the learning robot's corrected way, m.
        map_error_m: f64 => lower("error of the map").unit("m").at_least(0),
        /// Number of records that were scored.
        records: usize => neither("records").decimals(0),
    }
}

/// Returns the message for the missing set.
pub(super) fn missing() -> Option<String> {
    missing_of([FOLDER], "the UTIAS set of robots and landmarks")
}

pub(super) fn table() -> Table {
    let row = |name| match missing() {
        Some(missing) => Row::new(name).missing(missing),
        None => Row::new(name).run_each(PAIRS.len() as u32),
    };
    Table::of::<UtiasRun>(NAME, "A place map of one robot, tried by another")
        .metrics_from(UtiasRun::score)
        .rows([PLACE_MAP, RANDOM].map(row))
        .note(
            "Three robots among landmarks, each alone. Run n is pair n of the robots that learn and \
             try. The way of the learning robot is corrected by a pose graph of its wheels and of \
             the landmarks it saw. A growing neural gas learns its positions, with their distances \
             from the landmarks. The other robot believes that it is at the node with the ranges \
             nearest to those it has seen in the last ten seconds. The map is laid over the world by \
             the way of the robot that learned it. Random: at a random node.",
        )
}

pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let folder = file(FOLDER).ok_or("the UTIAS set is gone")?;
    let [learns, tries] = PAIRS[job.run as usize % PAIRS.len()];
    let learner = UtiasRobot::read(&folder, learns)?;
    let trier = UtiasRobot::read(&folder, tries)?;
    let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
    let known = LandmarkMap::of(&learner.odometry, &learner.sightings)?;
    let map = place_map(&known, &mut rng)?;
    let laid = laid_over(&known, &learner.truth).ok_or("nobody knows where the robot was")?;
    let been = learner
        .truth
        .poses()
        .iter()
        .map(|timed| timed.pose.position);
    let cells = CellGrid::over(Bounds::of(been));
    let nodes: Vec<Point> = map.positions().map(|(_, position)| position).collect();
    let names: Vec<u32> = known.landmarks.keys().copied().collect();
    let (mut score, mut error, mut records) = (0.0, 0.0, 0);
    for (time, ranges) in sensed(&trier.odometry, &trier.sightings, &names) {
        let Some(truth) = trier.truth.at(time).map(|pose| pose.position) else {
            continue;
        };
        let node = map
            .nearest_by_ranges(&ranges)
            .and_then(|node| map.position(node));
        let guess = match job.row {
            RANDOM => nodes
                .get(rng.random_range(0..nodes.len() as u32) as usize)
                .copied(),
            _ => node,
        };
        let guess = laid
            .world_from_map
            .transform(guess.ok_or("the map has no places")?);
        score += PointScore::of(cells.cell_of(truth), in_cells(&cells, guess)).by_centre;
        error += (guess - truth).norm();
        records += 1;
    }
    let count = f64::from(u32::try_from(records.max(1))?);
    let run = UtiasRun {
        score: score / count,
        error_m: error / count,
        map_error_m: laid.error_m,
        records,
    };
    Ok(run.fields()?)
}

/// Returns a map of the robot's positions, each with its distances from the landmarks.
fn place_map(known: &LandmarkMap, rng: &mut ChaCha8Rng) -> Result<PlaceMap, BoxError> {
    let record = |pose: Pose| {
        let landmarks = known.landmarks.values();
        let sounding = |landmark: &Point| Sounding {
            mount: Pose::IDENTITY,
            half_width: 0.0,
            range: (landmark - pose.position).norm(),
            max_range: f64::INFINITY,
        };
        PlaceRecord {
            odometry: pose,
            snapshot: Snapshot {
                soundings: landmarks.map(sounding).collect(),
                picture: None,
            },
        }
    };
    let records: Vec<PlaceRecord> = known.way.iter().map(|timed| record(timed.pose)).collect();
    let choice = FeatureChoice {
        groups: vec![FeatureGroup::Odometry, FeatureGroup::Sonar],
        scaling: FeatureScaling::Group,
    };
    let table = FeatureTable::of(&records, &choice, ImageForm::Pixels)?;
    let weights = FeatureWeights {
        image: 0.0,
        odometry: 1.0,
        sonar: 1.0,
    };
    let mut gng = GngConfig::fritzke();
    gng.max_units = NODES;
    gng.growth_period = 30;
    let mut config = PlaceMapConfig::new(gng, weights);
    config.passes = 10;
    Ok(PlaceMap::learn(&table, 0..table.len(), config, rng)?)
}

fn laid_over(known: &LandmarkMap, truth: &Trajectory) -> Option<LaidOver> {
    let pairs = known.way.iter();
    let pairs =
        pairs.filter_map(|timed| Some((timed.pose.position, truth.at(timed.time)?.position)));
    let (found, sites): (Vec<Point>, Vec<Point>) = pairs.unzip();
    LaidOver::of_places(found.into_iter(), &sites)
}

fn in_cells(cells: &CellGrid, point: Point) -> Point {
    let from_corner = point - cells.bounds().min;
    Point::from(from_corner.component_div(&cells.size()))
}

/// Returns the distances of landmarks, m, for each second at which enough are known. Earlier
/// sightings are corrected for the robot's motion since then.
fn sensed(
    odometry: &[LogVelocity],
    sightings: &[BarcodeSighting],
    names: &[u32],
) -> Vec<(f64, Vec<Option<f64>>)> {
    let reckoned = LogVelocity::dead_reckoning(odometry);
    let of = |time: f64| {
        let here = reckoned.at(time)?;
        let mut ranges = vec![None; names.len()];
        let recent = |seen: &&BarcodeSighting| seen.time <= time && seen.time > time - MEMORY_S;
        for seen in sightings.iter().filter(recent) {
            let index = names.iter().position(|name| *name == seen.subject);
            if let (Some(index), Some(then)) = (index, reckoned.at(seen.time)) {
                let bearing = then.heading.turned(seen.bearing);
                let landmark = then.position + seen.range * bearing.unit();
                ranges[index] = Some((landmark - here.position).norm());
            }
        }
        let is_enough = ranges.iter().flatten().count() >= LEAST_SEEN;
        is_enough.then_some((time, ranges))
    };
    steps_of(&reckoned).into_iter().filter_map(of).collect()
}
