//! Makes replays of logs: the estimated trajectory, the odometry, the laser's readings, and the map
//! as it grew.

use tolman_geom::Point;
use tolman_maps::scan_matching::OccupancyGrid;
use tolman_replay::{
    EdgeKind, MapEdge, MapGrowth, MapNode, Replay, RobotTrack, Scans, Scenery, TimeSeries,
};
use tolman_robot::{Body, Ring};

use super::{FoundClosure, MapPicture, MappedLog, RobotLog};

/// Radius at which the robot is drawn, m; a log does not give it.
const RADIUS: f64 = 0.25;
/// Maximum number of beams shown of a reading.
const SHOWN_BEAMS: u32 = 90;
/// Maximum number of keyframes shown as nodes.
const MOST_NODES: usize = 400;

impl MappedLog {
    /// Returns the replay of a log, with one step per scan.
    #[must_use]
    pub fn replay(&self, log: &RobotLog, picture: &MapPicture, title: &str) -> Replay {
        let body = Body::Circle { radius: RADIUS };
        let mut found = RobotTrack::new("found", body.clone(), self.poses.clone());
        found.scans = self.readings(log);
        found.maps.push(match self.places.places.is_empty() {
            true => self.keyframe_map(),
            false => self.place_map(),
        });
        let mut closures = TimeSeries::new("closures", "");
        let mut closed: Vec<usize> = self.closed.iter().map(|closure| closure.later).collect();
        closed.sort_unstable();
        for (count, later) in (1..).zip(closed) {
            closures.sample(self.scan_of(later), f64::from(count));
        }
        found.series.push(closures);
        let raw = log.odometry_over(&self.poses);
        let by_wheels = RobotTrack::new("by the wheels", body, raw);
        let scenery = Scenery {
            walls: walls(&picture.occupancy),
            ..Scenery::default()
        };
        Replay::new(title, pace(log), scenery, vec![found, by_wheels])
    }

    fn scan_of(&self, keyframe: usize) -> u32 {
        self.keyframes.get(keyframe).map_or(0, |scan| *scan as u32)
    }

    /// Returns the scans at the keyframes, thinned to the beams that are shown. `None` if the log
    /// has no scan.
    fn readings(&self, log: &RobotLog) -> Option<Scans> {
        let of_first = log.scans.first()?.scan.ring;
        let every = of_first.beams.div_ceil(SHOWN_BEAMS).max(1);
        let ring = Ring {
            beams: of_first.beams.div_ceil(every),
            spacing: of_first.spacing * f64::from(every),
            ..of_first
        };
        // If a log has two lasers, the first is shown.
        let of_ring = |scan: &&usize| log.scans[**scan].scan.ring == of_first;
        let shown: Vec<usize> = self.keyframes.iter().filter(of_ring).copied().collect();
        let ranges = shown.iter().map(|scan| {
            let ranges = log.scans[*scan].scan.ranges.iter();
            ranges.step_by(every as usize).copied().collect()
        });
        Some(Scans {
            ring,
            ranges: ranges.collect(),
            steps: shown.iter().map(|scan| *scan as u32).collect(),
        })
    }

    /// Returns the keyframes as nodes in order, and the closures between them.
    fn keyframe_map(&self) -> MapGrowth {
        let every = self.keyframes.len().div_ceil(MOST_NODES).max(1);
        let node = |number: usize| {
            let scan = self.scan_of(number);
            let at = self.poses.get(scan as usize).map(|pose| pose.position);
            MapNode::new((number / every) as u32, at.unwrap_or(Point::origin()), scan)
        };
        let numbers = (0..self.keyframes.len()).step_by(every);
        let nodes: Vec<MapNode> = numbers.map(node).collect();
        let ways = nodes
            .windows(2)
            .map(|pair| MapEdge::new(pair[0].id, pair[1].id, pair[1].born));
        let mut edges: Vec<MapEdge> = ways.collect();
        for FoundClosure { earlier, later, .. } in &self.closed {
            let ends = [earlier, later].map(|end| (end / every) as u32);
            let mut closure = MapEdge::new(ends[0], ends[1], self.scan_of(*later));
            closure.kind = EdgeKind::Relation;
            edges.push(closure);
        }
        edges.sort_by_key(|edge| (edge.a, edge.b));
        edges.dedup_by_key(|edge| (edge.a, edge.b));
        MapGrowth {
            name: "keyframes".to_owned(),
            nodes,
            edges,
        }
    }

    /// Returns the places and the ways between them.
    fn place_map(&self) -> MapGrowth {
        let born = |id: u32| self.founded.get(&id).map_or(0, |scan| *scan as u32);
        let places = self.places.places.iter();
        let nodes = places.filter_map(|place| {
            let mut node = MapNode::new(place.id, place.position?, born(place.id));
            node.label_from(node.born, &place.id.to_string());
            Some(node)
        });
        let links = self.places.links.iter().filter(|link| link.from < link.to);
        let edges =
            links.map(|link| MapEdge::new(link.from, link.to, born(link.from).max(born(link.to))));
        MapGrowth {
            name: "places".to_owned(),
            nodes: nodes.collect(),
            edges: edges.collect(),
        }
    }
}

/// Returns the mean time between two scans, s.
fn pace(log: &RobotLog) -> f64 {
    let ends = log.scans.first().zip(log.scans.last());
    let lasted = ends.map_or(0.0, |(first, last)| last.time - first.time);
    let pace = lasted / log.scans.len().max(1) as f64;
    pace.clamp(0.01, 1.0)
}

/// Returns adjacent occupied cells as walls.
fn walls(grid: &OccupancyGrid) -> Vec<[Point; 2]> {
    let occupied: Vec<bool> = grid.occupancy().map(super::drawing::is_wall).collect();
    let is_wall = |column: usize, row: usize| occupied[row * grid.columns + column];
    let middle = |column: f64, row: f64| {
        let cells = tolman_geom::Vector::new(column + 0.5, row + 0.5);
        grid.origin + cells * grid.cell
    };
    let mut walls = Vec::new();
    for row in 0..grid.rows {
        for (first, last) in runs(grid.columns, |column| is_wall(column, row)) {
            let ends = [first, last].map(|column| middle(column as f64, row as f64));
            walls.push(ends);
        }
    }
    for column in 0..grid.columns {
        for (first, last) in runs(grid.rows, |row| is_wall(column, row)) {
            let ends = [first, last].map(|row| middle(column as f64, row as f64));
            walls.push(ends);
        }
    }
    walls
}

/// Returns the runs of at least three consecutive cells.
fn runs(count: usize, is: impl Fn(usize) -> bool) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut first = None;
    for place in 0..=count {
        match (place < count && is(place), first) {
            (true, None) => first = Some(place),
            (false, Some(begun)) => {
                if place - begun >= 3 {
                    found.push((begun, place - 1));
                }
                first = None;
            }
            _ => {}
        }
    }
    found
}
