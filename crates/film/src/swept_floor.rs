//! The floor that a robot's body has been over, on which no wall stands.

use alloc::collections::BTreeSet;

use tolman_arena::course::Course;
use tolman_arena::{Outing, is_clear, taut_way};
use tolman_geom::{Heading, Point, Pose};
use tolman_robot::Body;

/// Number of cells that a body's radius spans.
const SPANNED: f64 = 3.0;

/// Distance from the cell in which a robot is of the cells that its body covers whole, in cells.
const COVERED: i32 = 1;

type Cell = (i32, i32);

/// The cells of a fine grid that the body of a robot has covered whole.
#[derive(Clone, Debug)]
pub(crate) struct SweptFloor {
    /// Side of a cell, m.
    pitch: f64,
    /// Distance from swept floor within which a position belongs to it, m.
    near: f64,
    /// World in which the robot is.
    course: Course,
    /// Radius of the largest disc that the robot's body holds, m.
    radius: f64,
    cells: BTreeSet<Cell>,
    /// Where the robot is, m; `None` if it was lifted.
    last: Option<Point>,
}

impl SweptFloor {
    /// Returns a floor that no robot has been on. A position belongs to swept floor nearer than
    /// `near`, m.
    pub(crate) fn new(outing: &dyn Outing, near: f64) -> Self {
        let radius = outing.robot().inner_radius();
        Self {
            pitch: radius / SPANNED,
            near,
            course: outing.course().clone(),
            radius,
            cells: BTreeSet::new(),
            last: None,
        }
    }

    /// Adds the floor under a robot that went straight to a position.
    pub(crate) fn sweep(&mut self, position: Point) {
        let from = self.last.replace(position);
        if from.is_some_and(|from| self.cell(from) == self.cell(position)) {
            return;
        }
        // Nobody told that it was lifted over a wall.
        let from = from.filter(|from| self.is_open(*from, position));
        let from = from.unwrap_or(position);
        let pieces = ((position - from).norm() / self.pitch).ceil().max(1.0);
        for piece in 1..=pieces as u32 {
            let at = self.cell(from + (f64::from(piece) / pieces) * (position - from));
            let by = || -COVERED..=COVERED;
            let square = by().flat_map(|dx| by().map(move |dy| (dx, dy)));
            let disc = square.filter(|(dx, dy)| dx * dx + dy * dy <= COVERED * COVERED);
            let covered = disc.map(|(dx, dy)| (at.0 + dx, at.1 + dy));
            self.cells.extend(covered);
        }
    }

    /// Takes in that the robot was lifted.
    pub(crate) const fn lift(&mut self) {
        self.last = None;
    }

    /// Returns the number of swept cells.
    pub(crate) fn size(&self) -> usize {
        self.cells.len()
    }

    /// Returns the corners of the shortest way from `a` to `b` over swept floor, without its ends;
    /// `None` if there is none. O(cells · log cells).
    pub(crate) fn way(&self, a: Point, b: Point) -> Option<Vec<Point>> {
        let is_swept = |at: Point| self.cells.contains(&self.cell(at));
        if is_clear(a, b, self.pitch, is_swept) {
            return Some(Vec::new());
        }
        let [from, to] = [self.nearest(a)?, self.nearest(b)?];
        let left = |at: Point| match self.cell(at) == self.cell(to) {
            true => 0.0,
            false => (at - to).norm(),
        };
        taut_way(from, self.pitch, is_swept, left)
    }

    /// Returns the turns of the shortest way from `a` to `b` from cell to cell; empty if no wall is
    /// between the two, or there is no way.
    pub(crate) fn shortest(&self, a: Point, b: Point) -> Vec<Point> {
        let is_near_wall = || {
            let radius = 0.5 * self.radius;
            let is_floor = |at: Point| {
                self.course
                    .world
                    .clear_for(&Body::Circle { radius }, Pose::new(at, Heading::EAST))
            };
            !is_clear(a, b, self.pitch, is_floor)
        };
        let way = is_near_wall().then(|| self.course.turns_between(a, b));
        way.flatten().unwrap_or_default()
    }

    /// Returns the middle of the swept cell nearest to a position, if it is near enough. No wall
    /// is between them.
    fn nearest(&self, position: Point) -> Option<Point> {
        let at = self.cell(position);
        let reach = (self.near / self.pitch).floor() as i32;
        let columns = (at.0 - reach, i32::MIN)..=(at.0 + reach, i32::MAX);
        let cells = self.cells.range(columns).map(|cell| self.middle(*cell));
        let far = cells.map(|middle| ((middle - position).norm(), middle));
        let mut near: Vec<(f64, Point)> = far.filter(|(far, _)| *far < self.near).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.into_iter()
            .map(|(_, middle)| middle)
            .find(|middle| self.is_open(position, *middle))
    }

    /// Returns whether no wall is between two positions.
    fn is_open(&self, a: Point, b: Point) -> bool {
        let mut walls = self.course.world.walls().iter();
        !walls.any(|wall| crosses([a, b], [wall.start, wall.end]))
    }

    fn cell(&self, position: Point) -> Cell {
        let along = |metres: f64| (metres / self.pitch).floor() as i32;
        (along(position.x), along(position.y))
    }

    fn middle(&self, (x, y): Cell) -> Point {
        let along = |cell: i32| (f64::from(cell) + 0.5) * self.pitch;
        Point::new(along(x), along(y))
    }
}

/// Returns whether two lines cross.
fn crosses([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |from: Point, to: Point, at: Point| (to - from).perp(&(at - from));
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}
