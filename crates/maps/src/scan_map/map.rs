use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use tolman_geom::{Heading, Point, Vector};
use tolman_robot::{Landmark, MapView, Scan};

use super::chart::view;
use super::fit::{ScanFit, fit};
use super::wall_grid::GridIndex;
use super::{Clearings, ScanChart, ScanMapConfig, WallGrid};

/// A map of places, which are merged as it grows, with the links driven between them and the walls
/// that scans met.
///
/// Positions are in the map's own frame, whose axes are the compass's, and which has its origin
/// where the robot was first observed.
#[derive(Clone, Debug)]
pub struct ScanMap {
    config: ScanMapConfig,
    grid: WallGrid,
    places: Vec<ScanPlace>,
    links: BTreeSet<[u32; 2]>,
    /// Positions of the scans from which the walls are drawn.
    stands: Vec<Point>,
    /// Positions where the landmark of the goal was sensed.
    goal: Vec<Point>,
    /// Positions where the landmark of the start was sensed, unless the map begins there.
    start: Vec<Point>,
    /// Positions where numbered landmarks were sensed.
    numbered: BTreeMap<u32, Vec<Point>>,
    /// Cells of walls that have come since they were drawn as floor.
    come: BTreeSet<GridIndex>,
    position: Point,
    /// Variance of the position along each axis, m².
    variance: Vector,
    at: Option<u32>,
    agreement: f64,
    /// Share of the beams of the last scan that contradicted the walls.
    contradiction: f64,
    /// Largest surprise so far. The surprise of two consecutive scans is the smaller of their
    /// contradicting shares, that of a start elsewhere is 1.
    surprise: f64,
}

/// Minimum number of beams that can contradict walls.
const FEWEST: u32 = 20;

/// Distance from where the map begins, if that is at the start, within which the start can be
/// sensed, in distances of two places. Farther off, the robot was moved or the map is bent.
const START_WITHIN: f64 = 2.0;

/// Minimum distance between two stored points where a landmark was sensed, m.
const SPACING_OF_LANDMARK: f64 = 0.02;

/// Spacing of the positions that are searched where a scan contradicts the walls, m.
const SEARCHED: f64 = 0.05;
/// Standard deviation of a position at which a scan contradicts no walls, m: beams that miss by
/// less contradict nothing.
const ROUGHLY: f64 = 0.07;
/// Maximum contradiction where a scan fits better, as a share of what it contradicts elsewhere.
const MUCH_LESS: f64 = 0.5;

/// A place of a [`ScanMap`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ScanPlace {
    /// Position of the robot at the place's first visit, m.
    pub position: Point,
    /// Landmark that the robot sensed at the place.
    pub landmark: Option<Landmark>,
}

/// A robot's move and what it sensed at its end: the input of a [`ScanMap`].
#[derive(Clone, Copy, Debug)]
pub struct Advance<'a> {
    /// Displacement since the observation before, along the compass's axes, m.
    pub moved: Vector,
    /// Standard deviation of the displacement along each axis, m.
    pub sd: Vector,
    /// Heading of the robot.
    pub heading: Heading,
    /// Ranges of the robot's beams.
    pub scan: &'a Scan,
    /// Landmark at which the robot stands; `None` if there is none.
    pub landmark: Option<Landmark>,
    /// Whether walls may have come or gone since they were drawn. Else what contradicts them tells
    /// of a robot that was lifted.
    pub walls_change: bool,
}

impl ScanMap {
    /// [`surprise`](Self::surprise) above which a map is doubtful. Among 180 right maps of the
    /// arena the highest was 0.28; among 10 maps of kidnapped robots the lowest was 0.64.
    pub const DOUBTFUL: f64 = 0.35;

    /// Returns an empty map.
    #[must_use]
    pub fn new(config: ScanMapConfig) -> Self {
        Self {
            config,
            grid: WallGrid::default(),
            places: Vec::new(),
            links: BTreeSet::new(),
            stands: Vec::new(),
            goal: Vec::new(),
            start: Vec::new(),
            numbered: BTreeMap::new(),
            come: BTreeSet::new(),
            position: Point::origin(),
            variance: Vector::zeros(),
            at: None,
            agreement: 1.0,
            contradiction: 0.0,
            surprise: 0.0,
        }
    }

    /// Takes in the robot's arrival: corrects its position by the walls, and adds the place, the
    /// link and the walls that are new. The first observation is the origin, whatever the robot
    /// moved before. O(cells in range + positions tried · beams + places).
    pub fn observe(&mut self, seen: &Advance<'_>) {
        let (moved, sd) = match self.at {
            Some(_) => (seen.moved, seen.sd),
            None => (Vector::zeros(), Vector::zeros()),
        };
        let expected = self.position + moved;
        let variance = self.variance + sd.component_mul(&sd);
        let (fitted, contradicted) = self.fitted(expected, variance, seen);
        self.position = fitted.at;
        self.agreement = fitted.agreement;
        // After a scan is drawn, errors before it belong to the map, not to the robot.
        self.variance = fitted.variance;
        if seen.walls_change {
            let come = self.grid.renew(self.position, seen.heading, seen.scan);
            self.come.extend(come);
        } else {
            self.weigh(contradicted);
        }
        self.draw(seen);
        self.enter(seen.landmark);
        if let Some(landmark) = seen.landmark {
            self.sense(landmark, self.position);
        }
    }

    /// Takes in that the robot stands at a landmark on its way, `moved` from its position at the
    /// last observation, m. Before the first one it has no position, and nothing changes.
    pub fn pass(&mut self, moved: Vector, landmark: Landmark) {
        if self.at.is_some() {
            self.sense(landmark, self.position + moved);
        }
    }

    /// Returns the position of the robot, m.
    #[must_use]
    pub const fn position(&self) -> Point {
        self.position
    }

    /// Returns the place where the robot is; `None` before the first observation.
    #[must_use]
    pub const fn at(&self) -> Option<u32> {
        self.at
    }

    /// Returns the agreement of the last scan with known walls, 0 … 1; 1 if no beam could be
    /// compared.
    #[must_use]
    pub const fn agreement(&self) -> f64 {
        self.agreement
    }

    /// Returns the greatest surprise so far, 0 to 1: the largest share of the beams of two scans in
    /// a row that contradicted known walls. It is 1 if the start was sensed far from where it is on
    /// the map.
    #[must_use]
    pub const fn surprise(&self) -> f64 {
        self.surprise
    }

    /// Returns the places, by id.
    #[must_use]
    pub fn places(&self) -> &[ScanPlace] {
        &self.places
    }

    /// Returns the walls.
    #[must_use]
    pub const fn grid(&self) -> &WallGrid {
        &self.grid
    }

    /// Returns the positions at which the landmark of the goal was sensed, m.
    #[must_use]
    pub fn goal(&self) -> &[Point] {
        &self.goal
    }

    /// Returns the positions at which the landmark of the start was sensed, m; empty if the map
    /// begins there.
    #[must_use]
    pub fn start(&self) -> &[Point] {
        &self.start
    }

    /// Returns the positions at which a landmark was sensed, m.
    #[must_use]
    pub fn spots(&self, landmark: Landmark) -> Vec<Point> {
        let begins_there = self
            .places
            .first()
            .map(|first| (first.landmark, first.position));
        let first = begins_there.filter(|(of, _)| *of == Some(landmark));
        let known = match landmark {
            Landmark::Goal => Some(&self.goal),
            Landmark::Start => Some(&self.start),
            Landmark::Numbered(number) => self.numbered.get(&number),
        };
        let known = known.into_iter().flatten().copied();
        first.map(|(_, at)| at).into_iter().chain(known).collect()
    }

    /// Returns the positions at which numbered landmarks were sensed, m, with their numbers.
    pub(super) fn numbered(&self) -> impl Iterator<Item = (u32, Point)> + '_ {
        let all = self.numbered.iter();
        all.flat_map(|(number, spots)| spots.iter().map(|at| (*number, *at)))
    }

    /// Takes away the walls that have come since the map was drawn: they may have gone again.
    /// Returns whether there were any. O(cells).
    pub fn reopen(&mut self) -> bool {
        let come = core::mem::take(&mut self.come);
        let were_any = !come.is_empty();
        self.grid.reopen(come);
        were_any
    }

    /// Returns the cells where the robot has been and could still stand.
    #[must_use]
    pub fn clearings(&self) -> Clearings<'_> {
        Clearings::new(&self.grid, self.config.radius)
    }

    /// Returns the memory of places, links, walls and the landmark's positions, bytes. O(1).
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.places.as_slice())
            + self.links.len() * size_of::<[u32; 2]>()
            + size_of_val(self.stands.as_slice())
            + size_of_val(self.goal.as_slice())
            + size_of_val(self.start.as_slice())
            + self
                .numbered
                .values()
                .map(|spots| size_of_val(spots.as_slice()))
                .sum::<usize>()
            + self.grid.bytes()
    }

    /// Returns places and links in the form that scorers and drawings read. O(places + links).
    #[must_use]
    pub fn view(&self) -> MapView {
        view(&self.places, self.links())
    }

    /// Returns the chart: the map in its final form. O(cells + places + links).
    #[must_use]
    pub fn chart(&self) -> ScanChart {
        ScanChart::of(self)
    }

    /// Returns the links, each once, the lower id first, in order.
    pub(super) fn links(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.links.iter().copied()
    }

    /// Returns the distance that the robot keeps from walls, m.
    pub(super) const fn radius(&self) -> f64 {
        self.config.radius
    }

    /// Records the position where a landmark was sensed, unless one is stored near it.
    fn sense(&mut self, landmark: Landmark, at: Point) {
        let first = self.places.first();
        let begins_there = first.is_none_or(|first| first.landmark == Some(landmark));
        let known = match landmark {
            Landmark::Goal => &mut self.goal,
            Landmark::Start if !begins_there => &mut self.start,
            Landmark::Start if at.coords.norm() > START_WITHIN * self.config.spacing_of_places => {
                self.surprise = 1.0;
                return;
            }
            Landmark::Start => return,
            Landmark::Numbered(number) => self.numbered.entry(number).or_default(),
        };
        let is_new = |known: &Point| (at - known).norm() >= SPACING_OF_LANDMARK;
        if known.iter().all(is_new) {
            known.push(at);
        }
    }

    /// Returns where a scan fits the walls, and the share of its beams that contradict them there,
    /// if enough can. If many do, odometry is worse than it told, as where a long loop closes: then
    /// the scan fits near where far fewer do, if there is such a position. O(positions tried ·
    /// beams).
    fn fitted(
        &self,
        expected: Point,
        variance: Vector,
        seen: &Advance<'_>,
    ) -> (ScanFit, Option<f64>) {
        let farthest = self.config.farthest_fit;
        let near = |at, variance| fit(&self.grid, at, variance, farthest, seen.heading, seen.scan);
        let told = near(expected, variance);
        let told = (told, self.contradicted(told.at, seen));
        let Some(contradicted) = told.1.filter(|share| *share > Self::DOUBTFUL) else {
            return told;
        };
        match self.least_contradicted(expected, seen) {
            Some((least, at)) if least < MUCH_LESS * contradicted => {
                let fitted = near(at, variance.sup(&Vector::repeat(ROUGHLY * ROUGHLY)));
                (fitted, self.contradicted(fitted.at, seen))
            }
            _ => told,
        }
    }

    /// Returns the share of the beams of a scan that contradict the walls where fewest do, and the
    /// nearest such position about the expected one. O(positions · beams · range).
    fn least_contradicted(&self, expected: Point, seen: &Advance<'_>) -> Option<(f64, Point)> {
        let steps = (self.config.farthest_fit / SEARCHED) as i32;
        let along = move || (-steps..=steps).map(|step| f64::from(step) * SEARCHED);
        let shifts = along().flat_map(|x| along().map(move |y| Vector::new(x, y)));
        let tried = shifts.filter_map(|shift| {
            let contradicted = self.contradicted(expected + shift, seen)?;
            Some((contradicted, shift.norm(), expected + shift))
        });
        let nearer = |a: &(f64, f64, Point), b: &(f64, f64, Point)| {
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        };
        let (contradicted, _, at) = tried.min_by(nearer)?;
        Some((contradicted, at))
    }

    /// Returns the share of the beams of a scan that contradict the known walls.
    fn contradicted(&self, at: Point, seen: &Advance<'_>) -> Option<f64> {
        self.grid.contradiction(at, seen.heading, seen.scan, FEWEST)
    }

    /// Records how much of a scan contradicts the known walls.
    fn weigh(&mut self, contradicted: Option<f64>) {
        if let Some(now) = contradicted {
            self.surprise = self.surprise.max(now.min(self.contradiction));
            self.contradiction = now;
        }
    }

    /// Draws the walls of a scan if none was taken near its position before.
    fn draw(&mut self, seen: &Advance<'_>) {
        let near = |stand: &Point| {
            let way = (stand - self.position).norm();
            way < self.config.spacing_of_scans && self.grid.sees(*stand, self.position)
        };
        if !self.stands.iter().any(near) {
            self.grid.add(self.position, seen.heading, seen.scan);
            self.stands.push(self.position);
        }
        self.grid.visit(self.position, self.config.reach_of_visit);
    }

    /// Finds or adds the place that the robot has reached, and links it with the place before.
    fn enter(&mut self, landmark: Option<Landmark>) {
        let before = self.at;
        let here = self.nearest().unwrap_or_else(|| {
            self.places.push(ScanPlace {
                position: self.position,
                landmark: None,
            });
            self.places.len() as u32 - 1
        });
        let place = &mut self.places[here as usize];
        place.landmark = place.landmark.or(landmark);
        if let Some(before) = before
            && before != here
        {
            self.links.insert([before.min(here), before.max(here)]);
        }
        self.at = Some(here);
    }

    /// Returns the nearest place within a place's reach and in sight.
    fn nearest(&self) -> Option<u32> {
        let places = (0..).zip(&self.places).filter_map(|(id, place)| {
            let way = (place.position - self.position).norm();
            (way < self.config.spacing_of_places && self.grid.sees(place.position, self.position))
                .then_some((way, id))
        });
        places.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, id)| id)
    }
}
