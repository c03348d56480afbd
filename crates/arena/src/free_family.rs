//! Families of worlds whose walls stand anywhere.

use core::f64::consts::{PI, TAU};

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Point, Vector, nearest_on_segment};
use tolman_sim::{Area, Occupancy, World, WorldError, Zone};

use crate::course::FreeWorld;
use crate::pioneer::CORRIDOR_WIDTH;

/// A family of free worlds for a robot half a metre across.
#[derive(Clone, Copy, Debug)]
pub struct FreeFamily {
    /// Name, as in the rows of tables.
    pub name: &'static str,
    /// Description in one line.
    pub about: &'static str,
    draw: fn(&mut Plan, &mut ChaCha8Rng),
}

/// Side of a cell of the grid in which worlds are painted, m.
const CELL: f64 = 0.05;
/// Distance of the grid's edge from the floor, m.
const MARGIN: f64 = 0.2;
/// Half the usual width of corridors, m.
const HALF: f64 = 0.5 * CORRIDOR_WIDTH;
/// Radius of the zones `start` and `destination`, m.
const ZONE: f64 = 0.3;

/// What stands on a plan.
#[derive(Clone, Copy, Debug)]
enum Shape {
    /// All within a distance of a straight line, m.
    Stroke([Point; 2], f64),
    /// The rectangle between two corners.
    Rectangle([Point; 2]),
}

/// A plan: floor, pillars on it, and where robots start and go.
#[derive(Debug, Default)]
struct Plan {
    floor: Vec<Shape>,
    pillars: Vec<Shape>,
    start: Point,
    goal: Point,
}

impl Shape {
    fn contains(&self, at: Point) -> bool {
        match *self {
            Self::Stroke([a, b], radius) => (nearest_on_segment(at, a, b) - at).norm() < radius,
            Self::Rectangle([low, high]) => {
                (low.x..high.x).contains(&at.x) && (low.y..high.y).contains(&at.y)
            }
        }
    }

    /// Returns the low and the high corner of its bounding box.
    fn bounds(&self) -> [Point; 2] {
        match *self {
            Self::Stroke([a, b], radius) => {
                let beside = Vector::repeat(radius);
                [a.inf(&b) - beside, a.sup(&b) + beside]
            }
            Self::Rectangle(corners) => corners,
        }
    }
}

impl Plan {
    fn disc(at: Point, radius: f64) -> Shape {
        Shape::Stroke([at, at], radius)
    }

    fn is_floor(&self, at: Point) -> bool {
        let holds = |shapes: &[Shape]| shapes.iter().any(|shape| shape.contains(at));
        holds(&self.floor) && !holds(&self.pillars)
    }

    fn world(&self) -> Result<World, WorldError> {
        let all = self.floor.iter().map(Shape::bounds);
        let corners = all.reduce(|[a, b], [c, d]| [a.inf(&c), b.sup(&d)]);
        let [low, high] = corners.unwrap_or_default();
        let origin = low - Vector::repeat(MARGIN);
        let size = (high - origin).map(|side| ((side + MARGIN) / CELL).ceil() as usize);
        let (width, height) = (size.x, size.y);
        let middle = |cell: usize| (cell as f64 + 0.5) * CELL;
        let cells = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
        let is_wall =
            |(column, row)| !self.is_floor(origin + Vector::new(middle(column), middle(row)));
        let world = World::from_occupancy(&Occupancy {
            width,
            height,
            resolution: CELL,
            origin,
            occupied: cells.map(is_wall).collect(),
        })?;
        let zone = |name: &str, centre: Point| {
            let radius = ZONE;
            Zone::new(name, vec![Area::Disc { centre, radius }])
        };
        world.with_zones([zone("start", self.start), zone("destination", self.goal)])
    }
}

impl FreeFamily {
    /// All families.
    pub const ALL: [Self; 10] = [
        Self::new("slanted", "corridors at any angle", |plan, rng| {
            let nodes = Lattice::new(4, 2.3).shaken(0.4, rng);
            nodes.tree(plan, rng, |_| HALF);
        }),
        Self::new("turned", "a maze askew to the compass", |plan, rng| {
            let turn = Heading::from_radians(rng.random_range(-PI..PI));
            Lattice::new(4, 1.6).turned(turn).tree(plan, rng, |_| HALF);
        }),
        Self::new("rings", "round corridors about one another", rings),
        Self::new("two widths", "corridors of 0.95 and 1.6 m", |plan, rng| {
            Lattice::new(4, 2.2).tree(
                plan,
                rng,
                |rng| if rng.random_bool(0.5) { HALF } else { 0.8 },
            );
        }),
        Self::new("narrow", "corridors of 0.78 m", |plan, rng| {
            Lattice::new(4, 1.5).tree(plan, rng, |_| 0.39);
        }),
        Self::new("caves", "ground without a straight wall", caves),
        Self::new("halls", "halls and corridors between them", halls),
        Self::new("doors", "rooms with doors of 0.8 m", doors),
        Self::new("columns", "a hall with round columns", columns),
        Self::new("star hall", "corridors from a round hall", star),
    ];

    const fn new(
        name: &'static str,
        about: &'static str,
        draw: fn(&mut Plan, &mut ChaCha8Rng),
    ) -> Self {
        Self { name, about, draw }
    }

    /// Returns a world of the family: the same seed draws the same one.
    ///
    /// # Errors
    /// [`WorldError`] if its plan makes no world.
    pub fn world(&self, seed: u64) -> Result<FreeWorld, WorldError> {
        let mut plan = Plan::default();
        (self.draw)(&mut plan, &mut ChaCha8Rng::seed_from_u64(seed));
        Ok(FreeWorld {
            world: plan.world()?,
            corridor_width: None,
        })
    }
}

/// Nodes in rows and columns, between which corridors may lead.
struct Lattice {
    side: usize,
    nodes: Vec<Point>,
}

impl Lattice {
    fn new(side: usize, spacing: f64) -> Self {
        let at = |index: usize| (index as f64) * spacing;
        let nodes = (0..side * side).map(|node| Point::new(at(node % side), at(node / side)));
        Self {
            side,
            nodes: nodes.collect(),
        }
    }

    fn shaken(mut self, most: f64, rng: &mut impl Rng) -> Self {
        for node in &mut self.nodes {
            *node += Vector::from_fn(|_, _| rng.random_range(-most..most));
        }
        self
    }

    fn turned(mut self, turn: Heading) -> Self {
        for node in &mut self.nodes {
            *node = turn.rotate(node.coords).into();
        }
        self
    }

    /// Returns the nodes beside a node.
    fn beside(&self, node: usize) -> Vec<usize> {
        let (column, row, side) = (node % self.side, node / self.side, self.side);
        let ways = [
            (column > 0).then(|| node - 1),
            (column + 1 < side).then(|| node + 1),
            (row > 0).then(|| node - side),
            (row + 1 < side).then(|| node + side),
        ];
        ways.into_iter().flatten().collect()
    }

    /// Paints a random tree of corridors and one more, with a loop: the robot starts in a corner
    /// and goes to the opposite one.
    fn tree(&self, plan: &mut Plan, rng: &mut ChaCha8Rng, half: fn(&mut ChaCha8Rng) -> f64) {
        let mut is_reached = vec![false; self.nodes.len()];
        let mut way = vec![0_usize];
        is_reached[0] = true;
        let mut ways = Vec::new();
        while let Some(here) = way.last().copied() {
            let mut new = self.beside(here);
            new.retain(|next| !is_reached[*next]);
            if new.is_empty() {
                way.pop();
                continue;
            }
            let next = new[rng.random_range(0..new.len())];
            is_reached[next] = true;
            ways.push([here, next]);
            way.push(next);
        }
        let here = rng.random_range(0..self.nodes.len());
        let beside = self.beside(here);
        ways.push([here, beside[rng.random_range(0..beside.len())]]);
        for [a, b] in ways {
            let ends = [self.nodes[a], self.nodes[b]];
            plan.floor.push(Shape::Stroke(ends, half(rng)));
        }
        (plan.start, plan.goal) = (self.nodes[0], self.nodes[self.nodes.len() - 1]);
    }
}

/// Returns a point at a distance from the origin.
fn polar(angle: f64, radius: f64) -> Point {
    Point::new(radius * libm::cos(angle), radius * libm::sin(angle))
}

fn rings(plan: &mut Plan, rng: &mut ChaCha8Rng) {
    let radii = [1.6, 3.2, 4.8];
    for radius in radii {
        let steps = 64;
        for step in 0..steps {
            let ends = [step, step + 1].map(|step| polar(TAU * f64::from(step) / 64.0, radius));
            plan.floor.push(Shape::Stroke(ends, HALF));
        }
    }
    for between in radii.windows(2) {
        for _ in 0..2 {
            let angle = rng.random_range(0.0..TAU);
            let ends = [between[0], between[1]].map(|radius| polar(angle, radius));
            plan.floor.push(Shape::Stroke(ends, HALF));
        }
    }
    plan.start = polar(rng.random_range(0.0..TAU), radii[0]);
    plan.goal = polar(rng.random_range(0.0..TAU), radii[2]);
}

fn caves(plan: &mut Plan, rng: &mut ChaCha8Rng) {
    let mut at = Point::origin();
    let mut ahead = rng.random_range(0.0..TAU);
    plan.start = at;
    for _ in 0..26 {
        plan.floor.push(Plan::disc(at, rng.random_range(0.55..1.1)));
        ahead += rng.random_range(-0.9..0.9);
        let to_middle = libm::atan2(-at.y, -at.x);
        if at.coords.norm() > 4.0 {
            ahead = to_middle + rng.random_range(-0.9..0.9);
        }
        at += polar(ahead, 0.7).coords;
    }
    plan.floor.push(Plan::disc(at, 0.8));
    plan.goal = at;
}

fn halls(plan: &mut Plan, rng: &mut ChaCha8Rng) {
    let mut low = Point::origin();
    let mut middles = Vec::new();
    for _ in 0..3 {
        let size = Vector::from_fn(|_, _| rng.random_range(2.4..4.0));
        plan.floor.push(Shape::Rectangle([low, low + size]));
        middles.push(low + 0.5 * size);
        low = match rng.random_bool(0.5) {
            true => Point::new(low.x + size.x + rng.random_range(1.5..2.5), low.y),
            false => Point::new(low.x, low.y + size.y + rng.random_range(1.5..2.5)),
        };
    }
    for ends in middles.windows(2) {
        plan.floor.push(Shape::Stroke([ends[0], ends[1]], HALF));
    }
    (plan.start, plan.goal) = (middles[0], middles[2]);
}

fn doors(plan: &mut Plan, rng: &mut ChaCha8Rng) {
    let lattice = Lattice::new(3, 2.6);
    lattice.tree(plan, rng, |_| 0.4);
    for middle in &lattice.nodes {
        let half = Vector::repeat(1.2);
        plan.floor
            .push(Shape::Rectangle([middle - half, middle + half]));
    }
}

fn columns(plan: &mut Plan, rng: &mut ChaCha8Rng) {
    let side = 6.5;
    plan.floor
        .push(Shape::Rectangle([Point::origin(), Point::new(side, side)]));
    plan.start = Point::new(0.7, 0.7);
    plan.goal = Point::new(side - 0.7, side - 0.7);
    for node in Lattice::new(3, 1.9).shaken(0.2, rng).nodes {
        let at = node + Vector::repeat(1.35);
        plan.pillars
            .push(Plan::disc(at, rng.random_range(0.15..0.35)));
    }
}

fn star(plan: &mut Plan, rng: &mut ChaCha8Rng) {
    plan.floor.push(Plan::disc(Point::origin(), 1.3));
    let arms = rng.random_range(4..6_u32);
    let first = rng.random_range(0.0..TAU);
    let mut ends = Vec::new();
    for arm in 0..arms {
        let angle = first + TAU * f64::from(arm) / f64::from(arms) + rng.random_range(-0.15..0.15);
        let end = polar(angle, rng.random_range(3.0..4.5));
        plan.floor.push(Shape::Stroke([Point::origin(), end], HALF));
        ends.push(end);
    }
    (plan.start, plan.goal) = (ends[0], ends[ends.len() / 2]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::Course;
    use crate::pioneer::body;

    #[test]
    fn every_world_has_a_way_from_its_start_to_its_goal() {
        for family in FreeFamily::ALL {
            for seed in 0..3 {
                let drawn = family.world(seed).unwrap();
                let told = format!("{}, seed {seed}", family.name);
                let course = Course::in_free_world(&told, drawn.world, CORRIDOR_WIDTH, &body());
                let course = course.unwrap_or_else(|error| panic!("{told}: {error}"));
                let start = course.start().unwrap().position;
                let way = course.shortest_drive(start, 0.25);
                assert!(way.is_some_and(|metres| metres > 0.5), "{told}: {way:?}");
                let again = family.world(seed).unwrap().world;
                assert_eq!(again.walls(), course.world.walls(), "{told}");
            }
        }
    }
}
