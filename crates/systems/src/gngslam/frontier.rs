//! Finds the ends of the map: points that a robot can reach and has not been near.

use core::f64::consts::TAU;

use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maps::place_graph::{Outline, PlaceGraph};
use tolman_robot::{Sounding, Soundings};

use super::route::Target;

/// Number of directions in which each place is checked for more floor.
const DIRECTIONS: u32 = 48;

/// Distance from an explored point within which nothing is left to explore, m.
const SAME: f64 = 0.3;

/// Room that a robot needs to go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lane {
    /// Half the width of the lane in which nothing may stand, m.
    pub(super) half_width: f64,
    /// Distance from the place to the lane's end, m.
    pub(super) reach: f64,
    /// Minimum distance of the lane's end from any other place, m.
    pub(super) apart: f64,
}

/// Returns the free ends of lanes from places that lie near no place and near none of `tried`, in
/// order of places. A lane is free if the place has seen nothing in it. O(places · (points +
/// places)).
pub(super) fn frontiers(map: &PlaceGraph, lane: Lane, tried: &[Point]) -> Vec<Target> {
    let places = map.poses().poses();
    let is_far = |point: Point| {
        let near = |place: &Pose| (place.position - point).norm() < lane.apart;
        let done = |tried: &Point| (tried - point).norm() < SAME;
        !places.iter().any(near) && !tried.iter().any(done)
    };
    let mut found = Vec::new();
    for (id, (pose, outline)) in (0..).zip(places.iter().zip(map.places())) {
        for direction in 0..DIRECTIONS {
            let heading = Heading::from_radians(f64::from(direction) * TAU / f64::from(DIRECTIONS));
            let ahead = heading.unit();
            let point = pose.transform(Point::from(ahead * lane.reach));
            if is_far(point) && is_clear(outline, ahead, lane) {
                found.push(Target { place: id, point });
            }
        }
    }
    found
}

/// Returns whether nothing that is seen or heard from a place stands in the lane.
fn is_clear(outline: &Outline, ahead: Vector, lane: Lane) -> bool {
    let seen = outline.points.iter().map(|point| point.position);
    let heard = outline.arcs.iter().map(end);
    !seen.chain(heard).any(|point| lane.holds(ahead, point))
}

/// Returns the point at a sounding's range along its axis, in the robot's frame.
fn end(sounding: &Sounding) -> Point {
    sounding.mount.transform(Point::new(sounding.range, 0.0))
}

/// Returns the turns after which the range sensors' points leave the lane ahead clear, rad. If some
/// of them lead on, those that lead back are left out. O(soundings).
pub(super) fn ways_on(sensing: &impl Soundings, lane: Lane) -> Vec<f64> {
    let met = sensing.soundings();
    let met = met.filter(|sounding| sounding.range < 0.999 * sounding.max_range);
    let met: Vec<Point> = met.map(|sounding| end(&sounding)).collect();
    let turns = (0..DIRECTIONS).map(|direction| {
        let turn = f64::from(direction) * TAU / f64::from(DIRECTIONS);
        Heading::from_radians(turn).radians()
    });
    let is_clear = |turn: &f64| {
        let ahead = Heading::from_radians(*turn).unit();
        !met.iter().any(|point| lane.holds(ahead, *point))
    };
    let clear: Vec<f64> = turns.filter(is_clear).collect();
    let on: Vec<f64> = clear
        .iter()
        .copied()
        .filter(|turn| turn.abs() < BACK)
        .collect();
    if on.is_empty() { clear } else { on }
}

/// Turn above which a lane leads back, rad.
const BACK: f64 = 2.3;

impl Lane {
    /// Returns whether a point stands in the lane that leads into a direction, a unit vector.
    fn holds(self, ahead: Vector, point: Point) -> bool {
        let along = point.coords.dot(&ahead);
        let across = point.coords.perp(&ahead);
        (0.0..self.reach + self.half_width).contains(&along) && across.abs() < self.half_width
    }
}

#[cfg(test)]
mod tests {
    use tolman_maps::place_graph::{PlaceGraphConfig, SeenThere};
    use tolman_robot::{LaserSensing, Mapper, Ring, Scan, TakesSnapshots};

    use super::*;

    const LANE: Lane = Lane {
        half_width: 0.15,
        reach: 0.95,
        apart: 0.6,
    };

    /// Returns a corridor 1 m wide that runs east and west, with the robot in its middle, turned by
    /// `heading`.
    fn corridor(heading: f64) -> LaserSensing {
        let ring = Ring::full(72, 2.0);
        let mut scan = Scan::clear(ring);
        for (beam, range) in scan.ranges.iter_mut().enumerate() {
            let across = libm::sin(heading + ring.bearing(beam as u32));
            *range = (0.5 / across.abs()).min(2.0);
        }
        LaserSensing {
            scan: Some(scan),
            ..LaserSensing::silent(ring)
        }
    }

    #[test]
    fn the_ways_on_lead_along_a_corridor_and_back_only_if_there_is_none() {
        for (heading, expect) in [(0.0, 0.0), (0.5, -0.5), (1.4, -1.4)] {
            let ways = ways_on(&corridor(heading), LANE);
            assert!(!ways.is_empty());
            let along = |way: &f64| libm::sin(heading + way).abs() < 0.4;
            assert!(ways.iter().all(along), "{heading}: {ways:?}");
            assert!(
                ways.iter().any(|way| (way - expect).abs() < 0.2),
                "{ways:?}"
            );
        }
    }

    #[test]
    fn the_floor_goes_on_at_both_ends_of_a_corridor_until_it_was_tried() {
        let mut map = PlaceGraph::new(PlaceGraphConfig::indoors());
        let snapshot = corridor(0.3).snapshot().unwrap();
        map.observe(&SeenThere {
            snapshot,
            ..SeenThere::default()
        })
        .unwrap();
        let found = frontiers(&map, LANE, &[]);
        // The map looks along x where the robot did.
        let along = Heading::from_radians(-0.3).unit();
        let side = |target: &Target| target.point.coords.dot(&along);
        assert!(found.iter().any(|target| side(target) > 0.9));
        assert!(found.iter().any(|target| side(target) < -0.9));
        assert!(found.iter().all(|target| side(target).abs() > 0.9));
        let tried: Vec<Point> = found.iter().map(|target| target.point).collect();
        assert_eq!(frontiers(&map, LANE, &tried), []);
    }
}
