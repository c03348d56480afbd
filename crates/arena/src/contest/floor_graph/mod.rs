//! The true places of a floor of any shape: the branches and ends of its skeleton, and its rooms.
//!
//! Nothing here is shared with a mapper: the truth must not make its mistakes.

mod raster;
mod skeleton;

use alloc::collections::{BTreeMap, BTreeSet, VecDeque};

use tolman_geom::Point;
use tolman_sim::{Area, World, Zone};

use self::raster::Raster;
use self::skeleton::skeleton;
use crate::course::Course;

/// The true places of a floor and the ways between them.
///
/// A place is where three or more passages meet, where one ends, a room, or a landmark. A room is
/// where a disc fits that fits in no corridor; it is one place, whatever its shape. A bend is part
/// of a way.
#[derive(Clone, Debug)]
pub(super) struct FloorGraph {
    /// Places, by number.
    pub(super) places: Vec<FloorPlace>,
    /// Ways between places, by number.
    pub(super) ways: Vec<FloorWay>,
    raster: Raster,
    /// The spot of each point of the raster that a robot can reach.
    spots: BTreeMap<usize, FloorSpot>,
}

/// A part of the floor: what is nearest to a place, or to a third of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FloorSpot {
    /// A place, by number.
    Place(usize),
    /// A way, by number, and which third of it, from its first end on.
    Way(usize, usize),
}

/// A place of a floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FloorPlace {
    /// Its middle, m.
    pub(super) middle: Point,
    /// Radius of a disc around the middle that touches no wall, m.
    pub(super) clearance: f64,
    /// Whether it is a room.
    pub(super) is_room: bool,
}

/// A way between two places of a floor.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FloorWay {
    /// Numbers of the places at its ends, which may be the same.
    pub(super) ends: [usize; 2],
    /// Points in the middle of the passage, from the first end to the second, m.
    pub(super) line: Vec<Point>,
}

/// What makes a floor's passages and rooms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FloorScale {
    /// Minimum distance of a robot's middle from a wall, m. It passes where there is as much on
    /// both sides.
    pub(super) radius: f64,
    /// Radius from which on a disc that touches no wall makes a room, m.
    pub(super) room: f64,
}

impl FloorScale {
    /// Returns the scale of a robot of this radius among corridors of this width, m. A crossing of
    /// two corridors holds a disc of √½ of their width; a square of two by two corridors holds one
    /// of their width.
    #[must_use]
    pub(super) fn of_corridors(radius: f64, width: f64) -> Self {
        Self {
            radius,
            room: 0.5 * (1.0 + core::f64::consts::FRAC_1_SQRT_2) * width,
        }
    }
}

/// Maximum length of a gap between two parts of a room, in radii of its disc. A gap as long as a
/// corridor is wide is one; twice as long, it is a corridor.
const GAP: f64 = 2.4;

/// Number of points of the raster in a robot's radius.
const POINTS: f64 = 4.0;

impl FloorGraph {
    /// Returns the graph of the floor that a robot can reach from `start`, with the landmarks at
    /// these positions as places. O(area / radius² · log(area / radius²)).
    #[must_use]
    pub(super) fn of(world: &World, scale: FloorScale, start: Point, landmarks: &[Point]) -> Self {
        let raster = Raster::of(world, scale.radius / POINTS);
        let floor = reachable(&raster, scale.radius, start);
        let rooms = rooms(&raster, &floor, scale.room);
        let skeleton = skeleton(&raster, &floor);
        let mut sketch = Sketch::of(&raster, &skeleton, &rooms, landmarks);
        sketch.fill_gaps(GAP * scale.room);
        sketch.contract();
        sketch.prune();
        let (places, ways, of_room) = sketch.finish();
        let mut graph = Self {
            places,
            ways,
            spots: BTreeMap::new(),
            raster,
        };
        graph.spread(&floor, &rooms, &of_room);
        graph
    }

    /// Returns the graph of a free world; `None` for a maze.
    pub(super) fn of_course(course: &Course) -> Option<Self> {
        let radius = course.free_radius()?;
        let scale = FloorScale::of_corridors(radius, course.corridor_width);
        let start = course.start().ok().map(|pose| pose.position);
        let goals = course.destination().map(Zone::areas).unwrap_or_default();
        let goal = goals.first().map(Area::middle);
        let within = start.or_else(|| Some(course.cell_centre(course.starts().next()?)))?;
        let landmarks: Vec<Point> = start.into_iter().chain(goal).collect();
        Some(Self::of(&course.world, scale, within, &landmarks))
    }

    /// Returns the position that stands for a spot.
    pub(super) fn middle(&self, spot: FloorSpot) -> Point {
        match spot {
            FloorSpot::Place(place) => self.places[place].middle,
            FloorSpot::Way(way, third) => {
                let line = &self.ways[way].line;
                line[(line.len() * (2 * third + 1) / 6).min(line.len() - 1)]
            }
        }
    }

    /// Returns the spot of a position; `None` where the middle of a robot cannot come.
    pub(super) fn spot_at(&self, position: Point) -> Option<FloorSpot> {
        self.spots.get(&self.raster.index(position)).copied()
    }

    /// Gives each point of the floor the spot that is nearest along the floor. Rooms, and the discs
    /// around places, are spots as a whole.
    fn spread(
        &mut self,
        floor: &[bool],
        rooms: &BTreeMap<usize, usize>,
        of_room: &BTreeMap<usize, usize>,
    ) {
        let mut left = VecDeque::new();
        let mut add = |point: usize, spot: FloorSpot| {
            self.spots.entry(point).or_insert_with(|| {
                left.push_back(point);
                spot
            });
        };
        for (point, room) in rooms {
            if let Some(place) = of_room.get(room) {
                add(*point, FloorSpot::Place(*place));
            }
        }
        for (number, place) in self.places.iter().enumerate() {
            add(self.raster.index(place.middle), FloorSpot::Place(number));
        }
        for (number, way) in self.ways.iter().enumerate() {
            for (step, at) in way.line.iter().enumerate() {
                let mut ends = way.ends.iter();
                let end = ends.find(|end| {
                    let place = &self.places[**end];
                    (place.middle - at).norm() < place.clearance
                });
                let spot = match end {
                    Some(end) => FloorSpot::Place(*end),
                    None => FloorSpot::Way(number, 3 * step / way.line.len()),
                };
                add(self.raster.index(*at), spot);
            }
        }
        while let Some(point) = left.pop_front() {
            let spot = self.spots[&point];
            for next in self.raster.around(point).into_iter().flatten() {
                if floor[next] && !self.spots.contains_key(&next) {
                    self.spots.insert(next, spot);
                    left.push_back(next);
                }
            }
        }
    }
}

/// Returns for each point whether the middle of a robot can come there.
fn reachable(raster: &Raster, radius: f64, start: Point) -> Vec<bool> {
    let mut floor = vec![false; raster.len()];
    let first = raster.index(start);
    floor[first] = true;
    let mut left = vec![first];
    while let Some(point) = left.pop() {
        for next in raster.around(point).into_iter().flatten() {
            if !floor[next] && raster.clearance(next) >= radius {
                floor[next] = true;
                left.push(next);
            }
        }
    }
    floor
}

/// Returns the room in which each point lies, by the point's index: all that discs of this radius
/// cover which touch no wall.
fn rooms(raster: &Raster, floor: &[bool], radius: f64) -> BTreeMap<usize, usize> {
    // The middles of such discs, and then what is near them.
    let is_middle = |point: &usize| floor[*point] && raster.clearance(*point) >= radius;
    let mut covered: BTreeMap<usize, usize> = BTreeMap::new();
    covered.extend(
        (0..raster.len())
            .filter(is_middle)
            .map(|middle| (middle, middle)),
    );
    let mut left: VecDeque<usize> = covered.keys().copied().collect();
    while let Some(point) = left.pop_front() {
        let middle = covered[&point];
        for next in raster.around(point).into_iter().flatten() {
            let far = (raster.position(next) - raster.position(middle)).norm();
            if floor[next] && far < radius && !covered.contains_key(&next) {
                covered.insert(next, middle);
                left.push_back(next);
            }
        }
    }
    let mut rooms: BTreeMap<usize, usize> = BTreeMap::new();
    let mut count = 0;
    for first in covered.keys() {
        if rooms.contains_key(first) {
            continue;
        }
        rooms.insert(*first, count);
        let mut left = vec![*first];
        while let Some(point) = left.pop() {
            for next in raster.around(point).into_iter().flatten() {
                if covered.contains_key(&next) && !rooms.contains_key(&next) {
                    rooms.insert(next, count);
                    left.push(next);
                }
            }
        }
        count += 1;
    }
    rooms
}

/// A graph that is not finished yet.
struct Sketch {
    places: Vec<SketchPlace>,
    ways: Vec<FloorWay>,
}

struct SketchPlace {
    place: FloorPlace,
    is_landmark: bool,
    rooms: BTreeSet<usize>,
}

impl Sketch {
    fn of(
        raster: &Raster,
        skeleton: &BTreeSet<usize>,
        rooms: &BTreeMap<usize, usize>,
        landmarks: &[Point],
    ) -> Self {
        let around = |point: usize| {
            let next = raster.around(point).into_iter().flatten();
            next.filter(|next| skeleton.contains(next))
        };
        let marked: BTreeSet<usize> = landmarks
            .iter()
            .filter_map(|at| {
                let far = |point: &usize| (raster.position(*point) - at).norm();
                skeleton
                    .iter()
                    .copied()
                    .min_by(|a, b| far(a).total_cmp(&far(b)))
            })
            .collect();
        let is_place = |point: usize| {
            around(point).count() != 2 || marked.contains(&point) || rooms.contains_key(&point)
        };
        let mut of_point: BTreeMap<usize, usize> = BTreeMap::new();
        let mut places: Vec<Vec<usize>> = Vec::new();
        let mut of_room: BTreeMap<usize, usize> = BTreeMap::new();
        let mut points: Vec<usize> = skeleton
            .iter()
            .copied()
            .filter(|point| is_place(*point))
            .collect();
        if points.is_empty() {
            // A ring without a landmark begins anywhere.
            points.extend(skeleton.first());
        }
        let are: BTreeSet<usize> = points.iter().copied().collect();
        for first in points {
            if of_point.contains_key(&first) {
                continue;
            }
            let room = rooms.get(&first);
            let number = room.and_then(|room| of_room.get(room).copied());
            let number = number.unwrap_or_else(|| {
                places.push(Vec::new());
                places.len() - 1
            });
            if let Some(room) = room {
                of_room.insert(*room, number);
            }
            let mut left = vec![first];
            of_point.insert(first, number);
            while let Some(point) = left.pop() {
                places[number].push(point);
                for next in around(point) {
                    let is_same = are.contains(&next) && rooms.get(&next) == room;
                    if is_same && !of_point.contains_key(&next) {
                        of_point.insert(next, number);
                        left.push(next);
                    }
                }
            }
        }
        let mut ways = Vec::new();
        let mut used: BTreeSet<usize> = BTreeSet::new();
        for (start, from) in &of_point {
            for first in around(*start) {
                if let Some(to) = of_point.get(&first) {
                    if from < to {
                        let line = [*start, first].map(|point| raster.position(point)).to_vec();
                        ways.push(FloorWay {
                            ends: [*from, *to],
                            line,
                        });
                    }
                    continue;
                }
                if used.contains(&first) {
                    continue;
                }
                let (mut line, mut point) = (vec![*start, first], first);
                used.insert(first);
                let to = loop {
                    let at_end = |next: &usize| of_point.contains_key(next) && line.len() > 2;
                    let onward = around(point)
                        .find(|next| !of_point.contains_key(next) && !used.contains(next));
                    match (onward, around(point).find(at_end)) {
                        (Some(next), _) => {
                            used.insert(next);
                            line.push(next);
                            point = next;
                        }
                        (None, Some(end)) => {
                            line.push(end);
                            break Some(of_point[&end]);
                        }
                        (None, None) => {
                            let mut ends = around(point)
                                .filter(|next| of_point.contains_key(next) && next != start);
                            break ends.next().map(|end| {
                                line.push(end);
                                of_point[&end]
                            });
                        }
                    }
                };
                if let Some(to) = to {
                    let line = line
                        .into_iter()
                        .map(|point| raster.position(point))
                        .collect();
                    ways.push(FloorWay {
                        ends: [*from, to],
                        line,
                    });
                }
            }
        }
        let places = places.into_iter().map(|points| {
            let widest = points
                .iter()
                .copied()
                .max_by(|a, b| raster.clearance(*a).total_cmp(&raster.clearance(*b)));
            let widest = widest.unwrap_or_default();
            SketchPlace {
                place: FloorPlace {
                    middle: raster.position(widest),
                    clearance: raster.clearance(widest),
                    is_room: rooms.contains_key(&widest),
                },
                is_landmark: points.iter().any(|point| marked.contains(point)),
                rooms: points
                    .iter()
                    .filter_map(|point| rooms.get(point).copied())
                    .collect(),
            }
        });
        Self {
            places: places.collect(),
            ways,
        }
    }

    /// Takes the gaps of rooms out of the ways: those that lead from a room back into it, and are
    /// no longer than `length`, m.
    fn fill_gaps(&mut self, length: f64) {
        let long = |line: &[Point]| {
            line.windows(2)
                .map(|piece| (piece[1] - piece[0]).norm())
                .sum::<f64>()
        };
        self.ways.retain(|way| {
            let [a, b] = way.ends;
            a != b || !self.places[a].place.is_room || long(&way.line) > length
        });
    }

    /// Makes one place of two that a way joins, if the disc around one holds the middle of the
    /// other.
    fn contract(&mut self) {
        while let Some((number, [a, b])) = self.ways.iter().enumerate().find_map(|(number, way)| {
            let [a, b] = way.ends;
            let [one, other] = [a, b].map(|end| &self.places[end].place);
            let far = (one.middle - other.middle).norm();
            (a != b && far < one.clearance.max(other.clearance)).then_some((number, [a, b]))
        }) {
            self.ways.remove(number);
            let [keeps, goes] =
                match self.places[a].place.clearance >= self.places[b].place.clearance {
                    true => [a, b],
                    false => [b, a],
                };
            self.places[keeps].is_landmark |= core::mem::take(&mut self.places[goes].is_landmark);
            self.places[keeps].place.is_room |= self.places[goes].place.is_room;
            let rooms = core::mem::take(&mut self.places[goes].rooms);
            self.places[keeps].rooms.extend(rooms);
            for end in self.ways.iter_mut().flat_map(|way| &mut way.ends) {
                if *end == goes {
                    *end = keeps;
                }
            }
            // A loop that lies in the place is no way.
            let place = self.places[keeps].place;
            let is_outside = |at: &Point| (at - place.middle).norm() > place.clearance;
            self.ways
                .retain(|way| way.ends != [keeps, keeps] || way.line.iter().any(is_outside));
        }
    }

    /// Joins two ways that meet where nothing else is.
    fn prune(&mut self) {
        for place in 0..self.places.len() {
            let SketchPlace {
                place: at,
                is_landmark,
                ..
            } = &self.places[place];
            if *is_landmark || at.is_room {
                continue;
            }
            let ways: Vec<usize> = (0..self.ways.len())
                .filter(|way| self.ways[*way].ends.contains(&place))
                .collect();
            let [one, other] = ways[..] else { continue };
            if [one, other]
                .iter()
                .any(|way| self.ways[*way].ends == [place, place])
            {
                continue;
            }
            let mut second = self.ways.remove(other);
            let first = &mut self.ways[one];
            if first.ends[1] != place {
                first.ends.reverse();
                first.line.reverse();
            }
            if second.ends[0] != place {
                second.ends.reverse();
                second.line.reverse();
            }
            first.ends[1] = second.ends[1];
            first.line.extend(second.line);
        }
    }

    /// Returns the places that are left, the ways, and the place of each room.
    fn finish(self) -> (Vec<FloorPlace>, Vec<FloorWay>, BTreeMap<usize, usize>) {
        let mut number = BTreeMap::new();
        let mut of_room = BTreeMap::new();
        let used: BTreeSet<usize> = self.ways.iter().flat_map(|way| way.ends).collect();
        let mut places = Vec::new();
        for (old, sketched) in self.places.into_iter().enumerate() {
            // What was joined with another place has no room left.
            if used.contains(&old) || sketched.is_landmark || !sketched.rooms.is_empty() {
                number.insert(old, places.len());
                of_room.extend(sketched.rooms.iter().map(|room| (*room, places.len())));
                places.push(sketched.place);
            }
        }
        let ways = self.ways.into_iter().map(|way| FloorWay {
            ends: way.ends.map(|end| number[&end]),
            line: way.line,
        });
        (places, ways.collect(), of_room)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use tolman_maze::Cell;

    use super::*;
    use crate::contest::{PlaceRule, TrueGraph};
    use crate::family::Family;

    /// Returns how the graph of a drawing's floor differs from that of its cells, in words; `None`
    /// if it does not.
    fn difference(family: &Family, seed: u64) -> Option<String> {
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        let maze = (family.draw)(family.sizes[(seed % 2) as usize], rng).unwrap();
        let course = Course::new(family.name, maze.clone(), 1.0).unwrap();
        let truth = TrueGraph::of(&maze, PlaceRule::Landmarks);
        let start = maze.start().map(|(cell, _)| cell).into_iter();
        let marks = start.chain(maze.goals().iter().copied());
        let marks: Vec<Point> = marks.map(|cell| course.cell_centre(cell)).collect();
        let scale = FloorScale::of_corridors(0.25, 1.0);
        let graph = FloorGraph::of(&course.world, scale, marks[0], &marks);
        let cell = |place: usize| {
            let cell = course.world.cell_at(graph.places[place].middle).unwrap();
            truth.spots().at(cell)
        };
        let sorted = |ends: &mut Vec<[Cell; 2]>| {
            ends.iter_mut().for_each(|ends| ends.sort_unstable());
            ends.sort_unstable();
        };
        let mut own: Vec<[Cell; 2]> = graph.ways.iter().map(|way| way.ends.map(cell)).collect();
        let mut drawn: Vec<[Cell; 2]> = truth.ways().iter().map(|way| way.ends).collect();
        sorted(&mut own);
        sorted(&mut drawn);
        let places: BTreeSet<Cell> = (0..graph.places.len()).map(cell).collect();
        let is_same = own == drawn && places == *truth.places();
        (!is_same).then(|| {
            format!(
                "{}, seed {seed}: {own:?}, not {drawn:?}\n{maze}",
                family.name
            )
        })
    }

    fn check(seeds: core::ops::Range<u64>) {
        let all = Family::ARENA
            .iter()
            .flat_map(|family| seeds.clone().map(move |seed| (family, seed)));
        let wrong: Vec<String> = all
            .filter_map(|(family, seed)| difference(family, seed))
            .collect();
        assert!(
            wrong.is_empty(),
            "{} differ:\n{}",
            wrong.len(),
            wrong.join("\n")
        );
    }

    #[test]
    fn it_is_the_graph_of_the_drawing() {
        check(0..4);
    }

    #[test]
    #[ignore = "a thousand drawings take a quarter of a minute"]
    fn it_is_the_graph_of_a_thousand_drawings() {
        check(520_000..520_072);
    }
}
