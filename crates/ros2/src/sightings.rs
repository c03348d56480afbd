use tolman_geom::{Point, Pose, Vector};
use tolman_maps::scan_matching::OccupancyGrid;
use tolman_robot::{MapView, Scan};
use tolman_systems::AnyOnRobot;

/// All scans that were taken at rest, each with the place of the map at which it was taken. When
/// the system moves a place, its scans move with it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sightings {
    anchored: Vec<Sighting>,
    /// Scans since the last action, with their poses by odometry.
    fresh: Vec<(Pose, Scan)>,
}

#[derive(Clone, Debug)]
struct Sighting {
    scan: Scan,
    /// Number of the visit at which it was taken, if the system names visits.
    visit: Option<usize>,
    /// Pose on the map when it was taken.
    map_from_robot: Pose,
    /// Position on the map when it was taken, relative to the place of the visit.
    from_place: Option<Vector>,
}

impl Sightings {
    /// Adds a scan that was taken at a pose by odometry.
    pub(crate) fn add(&mut self, odom_from_robot: Pose, scan: Scan) {
        self.fresh.push((odom_from_robot, scan));
    }

    /// Gives the scans since the last action their place on the map.
    pub(crate) fn anchor(&mut self, map_from_odom: Pose, system: &dyn AnyOnRobot) {
        if self.fresh.is_empty() {
            return;
        }
        let (map, visits) = (system.map(), system.visits());
        let visit = visits.len().checked_sub(1);
        let place = visits.last().copied().flatten();
        let place = place.and_then(|place| position_of(&map, place));
        for (odom_from_robot, scan) in self.fresh.drain(..) {
            let map_from_robot = map_from_odom.compose(odom_from_robot);
            self.anchored.push(Sighting {
                scan,
                visit,
                map_from_robot,
                from_place: place.map(|at| map_from_robot.position - at),
            });
        }
    }

    /// Moves the scans with their places.
    fn settle(&mut self, system: &dyn AnyOnRobot) {
        let (map, visits) = (system.map(), system.visits());
        for sighting in &mut self.anchored {
            let visit = sighting.visit.and_then(|visit| visits.get(visit));
            let at = visit.copied().flatten();
            let at = at.and_then(|place| position_of(&map, place));
            if let (Some(at), Some(from)) = (at, sighting.from_place) {
                sighting.map_from_robot.position = at + from;
            }
        }
    }

    /// Draws all scans where their places are now, in cells of `cell` m. O(scans · beams · range /
    /// cell).
    pub(crate) fn grid(
        &mut self,
        system: &dyn AnyOnRobot,
        laser: Pose,
        cell: f64,
    ) -> OccupancyGrid {
        self.settle(system);
        let poses = self.anchored.iter();
        let poses = poses.map(|sighting| sighting.map_from_robot.compose(laser));
        let poses: Vec<Pose> = poses.collect();
        let reach = |(pose, sighting): (&Pose, &Sighting)| {
            let ring = sighting.scan.ring;
            let far = sighting.scan.ranges.iter().copied();
            let far = far
                .filter(|range| *range < ring.max_range)
                .fold(0.0, f64::max);
            [-far, far].map(|far| pose.position + Vector::new(far, far))
        };
        let bounds = poses.iter().zip(&self.anchored).flat_map(reach);
        let mut grid = OccupancyGrid::around(bounds, cell);
        for (pose, sighting) in poses.iter().zip(&self.anchored) {
            grid.add(&sighting.scan, *pose, f64::INFINITY);
        }
        grid
    }
}

/// Returns the position of a place on the map.
pub(crate) fn position_of(map: &MapView, place: u32) -> Option<Point> {
    let found = map.places.iter().find(|other| other.id == place);
    found.and_then(|place| place.position)
}
