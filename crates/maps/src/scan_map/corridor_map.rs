use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use tolman_geom::{Point, Vector};
use tolman_robot::{Landmark, MapLink, MapPlace, MapView};

use super::branches::Branches;
use super::skeleton::Skeleton;
use super::squares::Squares;
use super::wall_grid::{GridIndex, index_of, middle};
use super::{ScanChart, WallGrid};

/// The places of a [`ScanChart`] where corridors meet or end or a landmark stands, and the ways
/// between them. They follow from the middle lines of its ground.
///
/// A room is one place from which ways lead through its gateways.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CorridorMap {
    places: Vec<CorridorPlace>,
    ways: Vec<CorridorWay>,
    /// Points of the ground where the robot can stand, m.
    floor: Vec<Point>,
    width: f64,
}

/// A place of a [`CorridorMap`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CorridorPlace {
    /// Middle of the place, m.
    pub position: Point,
    /// Landmark of the place; `None` without one.
    pub landmark: Option<Landmark>,
}

/// A way of a [`CorridorMap`], which can be gone either way.
#[derive(Clone, Debug, PartialEq)]
pub struct CorridorWay {
    /// Numbers of the places at the way's ends, which may be the same.
    pub ends: [u32; 2],
    /// Length of the way, m.
    pub length: f64,
    /// Points along the way from its first end to its second, m.
    pub points: Vec<Point>,
}

/// Minimum distance of open ground from all walls, as a share of the corridors' width. A crossing's
/// middle has 0.71.
const OPEN: f64 = 0.8;
/// Maximum distance between a knot and a sensed landmark that stands there, as a share of the
/// corridors' width.
const STANDS_BY: f64 = 0.65;
/// Distance from a knot within which a robot would sense the landmark that stands there, as a share
/// of the corridors' width.
const HAS_NOTHING: f64 = 0.3;
/// Maximum distance of a junction from the box of the points at which a landmark was sensed, as a
/// share of the corridors' width. A robot that explores a junction senses a landmark that stands
/// there on all sides.
const SENSED_BY: f64 = 0.25;
/// Distance from the middle of a place within which a robot is at it, as a share of the corridors'
/// width.
const REACH: f64 = 0.33;
/// The same for a robot that visited the place while the map grew: where the map is stretched, a
/// point farther off may belong to the next place.
const VISITED: f64 = 0.2;
/// Distance within which a robot passes a place, as a share of the corridors' width.
const PASSED: f64 = 0.6;
/// Minimum distance between two places that a way joins, as a share of the corridors' width: nearer
/// ones are one place. In 250 right maps of large worlds with constant odometry errors places are
/// 0.53 or more apart.
const APART: f64 = 0.52;
/// Distance from the edge of a square within which a point may belong to the next square, as a
/// share of the corridors' width.
const BORDER: f64 = 0.1;
/// Minimum number of points at which a goal was sensed in a square. One may be in the wrong square.
const LEAST_SENSED: usize = 2;

impl CorridorMap {
    /// Returns the corridor map of a chart whose corridors are about `width` m wide. O(cells · log
    /// cells + knots³).
    #[must_use]
    pub fn of(chart: &ScanChart, width: f64) -> Self {
        let grid = chart.ground().grid();
        let stood = chart.places().iter().map(|place| place.position);
        let ground = chart.clearings(&grid).reached(stood);
        let floor = lattice(&grid, &ground);
        let skeleton = Skeleton::of(&grid, ground);
        let mut branches = Branches::of(&skeleton, chart.radius());
        branches.prune();
        branches.mark_rooms(OPEN * width, |at| skeleton.depth(at) + chart.radius());
        branches.merge(APART * width, OPEN * width);
        let reach = STANDS_BY * width / WallGrid::CELL;
        let degrees = branches.degrees();
        let is_junction = |number| degrees.get(&number).is_some_and(|degree| *degree > 2);
        let mut marks: Vec<(usize, Option<Landmark>)> = Vec::new();
        for Sensed { landmark, within } in landmarks(chart, &grid, width) {
            let may_stand_at = |number, knot| {
                let is_taken = marks.contains(&(number, landmark));
                let is_beside =
                    is_junction(number) && aside(within, middle(knot)) > SENSED_BY * width;
                landmark.is_none()
                    || !(is_taken || is_beside || has_nothing(chart, middle(knot), width))
            };
            let knot = branches.knot_at(index_of(middle_of(within)), reach, may_stand_at);
            marks.extend(knot.map(|knot| (knot, landmark)));
        }
        let numbers: BTreeMap<usize, u32> = branches.knots().keys().copied().zip(0..).collect();
        let place = |(number, knot): (&usize, &super::branches::Knot)| CorridorPlace {
            position: middle(knot.at),
            landmark: marks
                .iter()
                .find(|(at, _)| at == number)
                .and_then(|(_, mark)| *mark),
        };
        let ways = branches.branches().iter().map(|branch| CorridorWay {
            ends: branch.ends.map(|end| numbers[&end]),
            length: branch.length(),
            points: points(&branch.cells),
        });
        Self {
            places: branches.knots().iter().map(place).collect(),
            ways: ways.collect(),
            floor,
            width,
        }
    }

    /// Returns the places, by number.
    #[must_use]
    pub fn places(&self) -> &[CorridorPlace] {
        &self.places
    }

    /// Returns the ways between places.
    #[must_use]
    pub fn ways(&self) -> &[CorridorWay] {
        &self.ways
    }

    /// Returns the place where a robot is; `None` if it is on its way. O(places).
    #[must_use]
    pub fn at(&self, position: Point) -> Option<u32> {
        self.within(REACH, position)
    }

    /// Returns the nearest place within a share of the corridors' width.
    fn within(&self, share: f64, position: Point) -> Option<u32> {
        let far = (0..)
            .zip(&self.places)
            .map(|(number, place)| ((place.position - position).norm(), number));
        let near = far.filter(|(far, _)| *far < share * self.width);
        near.min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, number)| number)
    }

    /// Returns the place of a robot at each point of its trail; `None` where it was on its way. A
    /// place that it passed between two points counts at the nearest point. O(points · places).
    #[must_use]
    pub fn visits(&self, trail: &[Point]) -> Vec<Option<u32>> {
        let mut visits: Vec<Option<u32>> =
            trail.iter().map(|at| self.within(VISITED, *at)).collect();
        for (number, place) in (0..).zip(&self.places) {
            let far = trail.iter().map(|at| (at - place.position).norm());
            let nearest = far.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((index, far)) = nearest
                && far < PASSED * self.width
                && visits[index].is_none()
            {
                visits[index] = Some(number);
            }
        }
        visits
    }

    /// Returns places and ways in the form that scorers and drawings read. O(places + ways).
    #[must_use]
    pub fn view(&self) -> MapView {
        let place = |(id, place): (u32, &CorridorPlace)| MapPlace {
            id,
            position: Some(place.position),
            landmark: place.landmark,
        };
        let both_ways = |way: &CorridorWay| {
            let [a, b] = way.ends;
            MapLink::both_ways(a, b)
        };
        let there_and_back = |way: &CorridorWay| {
            let back = way.points.iter().rev().copied().collect();
            [way.points.clone(), back]
        };
        MapView {
            places: (0..).zip(&self.places).map(place).collect(),
            links: self.ways.iter().flat_map(both_ways).collect(),
            ways: self.ways.iter().flat_map(there_and_back).collect(),
            floor: self.floor.clone(),
            ..MapView::default()
        }
    }
}

/// Number of cells from one point of a way to the next.
const CELLS_TO_A_POINT: usize = 4;

/// Returns points along a line of cells, its ends among them.
fn points(cells: &[GridIndex]) -> Vec<Point> {
    let some = cells.iter().copied().step_by(CELLS_TO_A_POINT);
    some.chain(cells.last().copied()).map(middle).collect()
}

/// Number of cells from one point of the floor to the next.
const CELLS_BETWEEN: i32 = 10;

/// Returns points all over the cells of a grid that are in `ground`, by slot.
fn lattice(grid: &WallGrid, ground: &[bool]) -> Vec<Point> {
    let cells = grid.indices().zip(ground).filter(|(_, ground)| **ground);
    let on_lattice = |cell: &GridIndex| cell.iter().all(|at| at % CELLS_BETWEEN == 0);
    let cells = cells.map(|(cell, _)| cell).filter(on_lattice);
    cells.map(middle).collect()
}

/// Returns whether the robot stood near a point and sensed no landmark.
fn has_nothing(chart: &ScanChart, at: Point, width: f64) -> bool {
    let mut places = chart.places().iter();
    places
        .any(|place| place.landmark.is_none() && (place.position - at).norm() < HAS_NOTHING * width)
}

/// A landmark, or none where the robot was put down, and the low and the high corner of the box in
/// which it was sensed.
struct Sensed {
    landmark: Option<Landmark>,
    within: [Point; 2],
}

/// Returns the landmarks, and the point where the robot was put down, which may have none.
fn landmarks<'a>(
    chart: &'a ScanChart,
    grid: &WallGrid,
    width: f64,
) -> impl Iterator<Item = Sensed> + use<'a> {
    let sensed = |landmark: Landmark| {
        move |within| Sensed {
            landmark: Some(landmark),
            within,
        }
    };
    let goals = goals(chart, grid, width).into_iter();
    let goals = goals.map(sensed(Landmark::Goal));
    let start = bounds(chart.start()).map(sensed(Landmark::Start));
    let mut known = alloc::vec![Some(Landmark::Goal)];
    known.extend(start.as_ref().map(|start| start.landmark));
    // A map that knows its start elsewhere begins where the robot was put down after a lift.
    let begins_anywhere = start.is_some();
    // Of the places where another landmark was sensed, the first is nearest to the landmark. The
    // extent of such a landmark is unknown.
    let places = chart.places().iter().enumerate();
    let others = places.filter_map(move |(number, place)| {
        let is_new = !known.contains(&place.landmark);
        known.push(place.landmark);
        let is_first = number == 0 && !begins_anywhere;
        let is_meant = is_first || (place.landmark.is_some() && is_new);
        let reach = Vector::repeat(STANDS_BY * width);
        is_meant.then(|| Sensed {
            landmark: place.landmark.filter(|_| is_new),
            within: [place.position - reach, place.position + reach],
        })
    });
    goals.chain(start).chain(others)
}

/// Returns the distance of a point from a box, m.
fn aside([low, high]: [Point; 2], at: Point) -> f64 {
    (at - at.sup(&low).inf(&high)).norm()
}

/// Returns boxes around the goals: each square of the corridors in which the goal was sensed at
/// several points is one.
fn goals(chart: &ScanChart, grid: &WallGrid, width: f64) -> Vec<[Point; 2]> {
    let Some(within) = bounds(chart.goal()) else {
        return Vec::new();
    };
    let Some(squares) = Squares::of(grid, within, width) else {
        return alloc::vec![within];
    };
    let mut sensed: BTreeMap<[i32; 2], usize> = BTreeMap::new();
    for at in chart.goal() {
        if let Some(square) = squares.inside(*at, BORDER) {
            *sensed.entry(square).or_default() += 1;
        }
    }
    sensed.retain(|_, points| *points >= LEAST_SENSED);
    if sensed.is_empty() {
        return alloc::vec![within];
    }
    let beside = Vector::repeat(SENSED_BY * width);
    let around = |square: &[i32; 2]| {
        let middle = squares.middle(*square);
        [middle - beside, middle + beside]
    };
    sensed.keys().map(around).collect()
}

fn middle_of([low, high]: [Point; 2]) -> Point {
    low + 0.5 * (high - low)
}

/// Returns the low and the high corner of the bounding box of points.
fn bounds(points: &[Point]) -> Option<[Point; 2]> {
    let first = *points.first()?;
    Some(points.iter().fold([first, first], |[low, high], at| {
        [low.inf(at), high.sup(at)]
    }))
}
