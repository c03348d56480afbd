//! Wean Hall on several days: the corridors' topology, and the places found again on another day.

use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};
use tolman_geom::Point;
use tolman_maps::scan_matching::MapOverlay;
use tolman_robot::Mapper;
use tolman_systems::places::{PlacesConfig, PlacesMapper};

use super::RobotLog;
use super::relations::{file, missing_of};
use crate::rows::row_of;

/// Name of the table.
pub(super) const NAME: &str = "wean";

/// Rows with their logs. Each is compared with the first of the other logs that is here.
const ROWS: [(&str, &str); 3] = [
    ("wean 1", "logs/cmu-wean/robotdata1.log.gz"),
    ("wean 3", "logs/cmu-wean/robotdata3.log.gz"),
    ("wean 5", "logs/cmu-wean/robotdata5.log.gz"),
];

/// Distance within which a place of another day is the same, m.
const NEAR: f64 = 1.5;

record! {
    /// A map of one day, compared with a map of another day.
    struct WeanRun {
        /// Length of the robot's way, m.
        way_m: f64 => neither("way").unit("m").decimals(0),
        /// Number of places: junctions, bends, dead ends, rooms.
        places: usize => neither("places").decimals(0),
        /// Number of places that were recognized on the same day.
        closures: usize => neither("closures").decimals(0),
        /// Mean likelihood of its surfaces on those of the other day, 0 to 1.
        overlay_score: f64 => higher("overlay"),
        /// The best such likelihood if the map is laid elsewhere.
        rival_score: f64 => neither("best elsewhere"),
        /// Number of places that have one of the other day near by.
        found_again: usize => higher("found again").decimals(0),
        /// Number of places on ground that the other day's robot covered.
        on_known_ground: usize => neither("on known ground").decimals(0),
    }
}

/// Returns the message for a missing log.
pub(super) fn missing() -> Option<String> {
    missing_of(ROWS.map(|(_, name)| name), "the logs of Wean Hall")
}

pub(super) fn table() -> Table {
    let row = |(name, _): (&str, &str)| match missing() {
        Some(missing) => Row::new(name).missing(missing),
        None => Row::new(name).run_each(1),
    };
    Table::of::<WeanRun>(NAME, "Wean Hall on several days")
        .metrics_from(WeanRun::way_m)
        .rows(ROWS.map(row))
        .note(
            "Maps of places, each of one log; the truth is unknown. Each is laid over the map of the \
             next log of the three, turned by any quarter and put anywhere. A place is found again \
             if the other map has one within 1.5 m. Known ground is within 1.5 m of the other \
             robot's way.",
        )
}

/// Returns the map of places of a log.
fn mapped(number: usize) -> Result<PlacesMapper, BoxError> {
    let (row, name) = ROWS[number % ROWS.len()];
    let path = file(name).ok_or_else(|| format!("the log of {row} is gone"))?;
    let log = RobotLog::read(&path)?;
    let mut mapper = PlacesMapper::new(PlacesConfig::indoor())?;
    log.show(&mut mapper, &log.odometry(), |_| {})?;
    mapper.finish()?;
    Ok(mapper)
}

pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let rows = ROWS.into_iter().enumerate();
    let (number, _) = row_of(job, rows, |(_, (name, _))| *name == job.row)?;
    let (here, other) = (mapped(number)?, mapped(number + 1)?);
    let overlay = other.matching().overlay(here.matching());
    let overlay = overlay.ok_or("a map without walls lies nowhere")?;
    let places = points(&here);
    let on_other = |point: &Point| overlay.pose.transform(*point);
    let near =
        |known: &[Point], point: Point| known.iter().any(|known| (known - point).norm() < NEAR);
    let other_places = points(&other);
    let other_way: Vec<Point> = way(&other);
    let MapOverlay { score, rival, .. } = overlay;
    let run = WeanRun {
        way_m: way(&here)
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).norm())
            .sum(),
        places: places.len(),
        closures: here.matching().closures(),
        overlay_score: score,
        rival_score: rival,
        found_again: places
            .iter()
            .filter(|place| near(&other_places, on_other(place)))
            .count(),
        on_known_ground: places
            .iter()
            .filter(|place| near(&other_way, on_other(place)))
            .count(),
    };
    Ok(run.fields()?)
}

fn points(mapper: &PlacesMapper) -> Vec<Point> {
    let places = mapper.map().places.into_iter();
    places.filter_map(|place| place.position).collect()
}

fn way(mapper: &PlacesMapper) -> Vec<Point> {
    let poses = mapper.matching().graph().poses().iter();
    poses.map(|pose| pose.position).collect()
}
