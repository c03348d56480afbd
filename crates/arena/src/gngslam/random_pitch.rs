//! Arenas by seed.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_sim::sensors::Light;
use tolman_sim::{Area, Bounds, Material, WallSegment, World, Zone};
use tolman_systems::stream;

use super::pitch::{Goals, Pitch};
use crate::BoxError;

/// Length of a side, m.
const SIDE: core::ops::Range<f64> = 3.0..6.5;

/// Distance between furniture and anything else, m: a lane wide enough for the robot to drive along
/// and turn in.
const GAP: f64 = 0.95;

/// Maximum number of pieces of furniture.
const MOST_BOXES: u32 = 4;

/// Maximum number of tries for a place that leaves the lanes free.
const TRIES: u32 = 50;

/// Height of the boarding, m (section 3.1).
const BOARDING: f64 = 0.4;

/// Height of a goal, m. Not in the paper.
const GOAL: f64 = 0.5;

/// Sill of a window behind the boarding, m.
const SILL: f64 = 0.8;

/// Sill of a window in a wall of the floor itself, m. It is lower, since the robot is nearer to it.
const LOW_SILL: f64 = 0.4;

/// Distance of a hanging thing from its wall, m.
const PROUD: f64 = 0.002;

/// Distance of a goal from the wall, m. It hangs in front of everything else.
const GOAL_PROUD: f64 = 2.0 * PROUD;

/// Distance from a goal to the middle of its zone, and the zone's radius, m.
const ZONE_BEFORE: f64 = 0.8;
const ZONE_RADIUS: f64 = 0.5;

/// Direction of each side of a rectangle: 0 is the south.
const SIDES: [Heading; 4] = [Heading::SOUTH, Heading::EAST, Heading::NORTH, Heading::WEST];

/// A rectangular floor, and what stands on it and round it.
struct Room {
    floor: Bounds,
    furniture: Vec<Bounds>,
    walls: Vec<WallSegment>,
}

/// Part of a side, from `from` to `to` along it, both as shares of its length.
#[derive(Clone, Copy)]
struct Span {
    side: usize,
    from: f64,
    to: f64,
}

impl Span {
    /// Returns the middle of the span, looking onto the floor.
    fn middle(&self, round: Bounds) -> Pose {
        let (start, end) = side(round, self.side);
        let along = end - start;
        let middle = start + along * (0.5 * (self.from + self.to));
        Pose::new(middle, Heading::of(Vector::new(-along.y, along.x)))
    }
}

/// Returns the ends of a side of a rectangle, counter-clockwise.
fn side(round: Bounds, side: usize) -> (Point, Point) {
    let corners = round.corners();
    (corners[side % 4], corners[(side + 1) % 4])
}

impl Room {
    /// Puts up four walls round a rectangle.
    fn enclose(&mut self, round: Bounds, material: Material) {
        let sides = (0..4).map(|index| side(round, index));
        self.walls.extend(sides.map(|(start, end)| WallSegment {
            start,
            end,
            material,
        }));
    }

    /// Hangs a thing on part of a side of a rectangle, `inward` m before it.
    fn hang(&mut self, round: Bounds, span: Span, inward: f64, material: Material) {
        let (start, end) = side(round, span.side);
        let along = end - start;
        // The floor lies to the left.
        let inward = Vector::new(-along.y, along.x) * (inward / along.norm());
        self.walls.push(WallSegment {
            start: start + along * span.from + inward,
            end: start + along * span.to + inward,
            material,
        });
    }
}

impl Pitch {
    /// Returns the arena of this seed. Not in the paper. It has:
    ///
    /// - a rectangle of 3 to 6.5 m a side;
    /// - either boarding in a larger room, or walls as high as a room, each with probability 1/2;
    /// - goals of two colours on two sides, and windows on one;
    /// - 0 to 4 boxes of furniture that the robot can drive round;
    /// - random light and floor.
    ///
    /// # Errors
    /// None.
    pub fn random(seed: u64) -> Result<Self, BoxError> {
        let rng = &mut stream(seed, 0);
        let corner = Point::new(rng.random_range(SIDE), rng.random_range(SIDE));
        let windows = rng.random_range(0_u32..4) as usize;
        let mut room = empty(corner, windows, rng);
        for _ in 0..rng.random_range(0..=MOST_BOXES) {
            furnish(&mut room, rng);
        }
        let first = rng.random_range(0_u32..4) as usize;
        let second = (first + rng.random_range(1_u32..4) as usize) % 4;
        let spans = [first, second].map(|side| goal_on(room.floor, side, rng));
        for (span, colour) in spans.into_iter().zip(two_colours(rng)) {
            let goal = Material::painted(colour).standing(0.0, GOAL);
            room.hang(room.floor, span, GOAL_PROUD, goal);
        }
        let light = light(SIDES[windows], rng);
        let floor = core::array::from_fn(|_| rng.random_range(30_u32..150) as u8);
        let [blue, yellow] = spans.map(|span| span.middle(room.floor));
        let before = |name: &str, goal: Pose| {
            let centre = goal.position + goal.heading.unit() * ZONE_BEFORE;
            let radius = ZONE_RADIUS;
            Zone::new(name, vec![Area::Disc { centre, radius }])
        };
        let zones = [before("destination", blue), before("start", yellow)];
        let world = World::from_segments(room.walls)?.with_zones(zones)?;
        let name = format!("random-{seed}");
        Self::of(&name, world, corner, Goals { blue, yellow }, light, floor)
    }
}

/// Returns a floor without furniture. It has boarding, and behind it the walls of a room with
/// windows, doors and cupboards, or such walls themselves.
fn empty(corner: Point, windows: usize, rng: &mut ChaCha8Rng) -> Room {
    let min = Point::origin();
    let floor = Bounds { min, max: corner };
    let mut room = Room {
        floor,
        furniture: Vec::new(),
        walls: Vec::new(),
    };
    let (mut behind, mut sill) = (floor, LOW_SILL);
    if rng.random_range(0_u32..2) == 0 {
        let boarding = Material::painted([235, 235, 228]).standing(0.0, BOARDING);
        room.enclose(floor, boarding);
        let by = rng.random_range(0.8..1.6);
        let (middle, by) = (min + (corner - min) * 0.5, Vector::new(by, by));
        behind = Bounds {
            min: middle + (min - middle - by),
            max: middle + (corner - middle + by),
        };
        sill = SILL;
    }
    room.enclose(behind, Material::painted(pale(rng)));
    for (span, material) in decoration(windows, sill, rng) {
        room.hang(behind, span, PROUD, material);
    }
    room
}

/// Returns two to four windows on one side, and one thing on each other side.
fn decoration(windows: usize, sill: f64, rng: &mut ChaCha8Rng) -> Vec<(Span, Material)> {
    let count = rng.random_range(2_u32..=4);
    let share = f64::from(count).recip();
    let windows_on = (0..count).map(|index| {
        let from = (f64::from(index) + 0.15) * share;
        let span = Span {
            side: windows,
            from,
            to: from + 0.7 * share,
        };
        let window = Material::painted([200, 225, 255]).standing(sill, 2.2);
        (span, window.glowing(1.0))
    });
    let mut all: Vec<(Span, Material)> = windows_on.collect();
    let others = (0..4).filter(|side| *side != windows);
    for side in others {
        let width = rng.random_range(0.15..0.35);
        all.push((part_of(side, width, rng), thing(rng)));
    }
    all
}

/// Returns a random part of a side. `width` is its share of the side's length.
fn part_of(side: usize, width: f64, rng: &mut ChaCha8Rng) -> Span {
    let from = rng.random_range(0.05..0.95 - width);
    Span {
        side,
        from,
        to: from + width,
    }
}

/// Returns the material of a door, a cupboard or a poster, drawn at random.
fn thing(rng: &mut ChaCha8Rng) -> Material {
    let (base, height) = match rng.random_range(0_u32..3) {
        0 => (0.0, 2.0),
        1 => (0.0, rng.random_range(0.9..1.5)),
        _ => (rng.random_range(0.3..0.7), rng.random_range(1.0..1.6)),
    };
    Material::painted(any_colour(rng)).standing(base, height)
}

/// Puts a box on the floor so that it leaves lanes all round; does nothing if there is no such
/// place.
fn furnish(room: &mut Room, rng: &mut ChaCha8Rng) {
    let size = Vector::new(rng.random_range(0.3..0.8), rng.random_range(0.3..0.8));
    let height = rng.random_range(0.25..1.3);
    let material = Material::painted(any_colour(rng)).standing(0.0, height);
    let place = (0..TRIES).find_map(|_| free_place(room, size, rng));
    if let Some(place) = place {
        room.furniture.push(place);
        room.enclose(place, material);
    }
}

/// Returns a random place of that size, if lanes are left all round it.
fn free_place(room: &Room, size: Vector, rng: &mut ChaCha8Rng) -> Option<Bounds> {
    let floor = room.floor;
    let mut along = |least: f64, most: f64, size: f64| {
        let play = most - least - size - 2.0 * GAP;
        (play > 0.0).then(|| least + GAP + rng.random_range(0.0..play))
    };
    let x = along(floor.min.x, floor.max.x, size.x)?;
    let y = along(floor.min.y, floor.max.y, size.y)?;
    let min = Point::new(x, y);
    let place = Bounds {
        min,
        max: min + size,
    };
    let mut others = room.furniture.iter();
    others
        .all(|other| gap(&place, other) >= GAP)
        .then_some(place)
}

/// Returns the gap between two boxes along the axis on which it is wider, m; negative if they
/// overlap.
fn gap(a: &Bounds, b: &Bounds) -> f64 {
    let x = (a.min.x - b.max.x).max(b.min.x - a.max.x);
    let y = (a.min.y - b.max.y).max(b.min.y - a.max.y);
    x.max(y)
}

/// Returns the part of a side that a goal covers, 0.9 to 1.6 m wide.
fn goal_on(floor: Bounds, side: usize, rng: &mut ChaCha8Rng) -> Span {
    let (start, end) = self::side(floor, side);
    let width = rng.random_range(0.9..1.6) / (end - start).norm();
    part_of(side, width, rng)
}

/// Returns two strong colours that are easy to tell apart.
fn two_colours(rng: &mut ChaCha8Rng) -> [[u8; 3]; 2] {
    let first = rng.random_range(0.0..1.0);
    let second = first + rng.random_range(0.25..0.75);
    [first, second].map(|hue| strong(hue, rng.random_range(0.6..0.95)))
}

/// Returns the nearly saturated colour of this hue, in turns.
fn strong(hue: f64, brightness: f64) -> [u8; 3] {
    [0.0, 2.0, 4.0].map(|shift: f64| {
        let along = (6.0 * hue + shift) % 6.0;
        let share = ((along - 3.0).abs() - 1.0).clamp(0.1, 1.0);
        (255.0 * brightness * share) as u8
    })
}

fn any_colour(rng: &mut ChaCha8Rng) -> [u8; 3] {
    core::array::from_fn(|_| rng.random_range(30_u32..220) as u8)
}

/// Returns a pale colour, as walls of living rooms have.
fn pale(rng: &mut ChaCha8Rng) -> [u8; 3] {
    core::array::from_fn(|_| rng.random_range(160_u32..235) as u8)
}

/// Returns daylight through the windows of random brightness and tint.
fn light(windows: Heading, rng: &mut ChaCha8Rng) -> Light {
    let mut light = Light::daylight(windows);
    light.brightness = rng.random_range(0.65..0.95);
    light.cast = core::array::from_fn(|_| rng.random_range(0.9..1.1));
    light
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arenas_of_a_seed_are_the_same_and_of_others_are_not() {
        let json = |seed| Pitch::random(seed).unwrap().course.world.to_json().unwrap();
        assert_eq!(json(3), json(3));
        assert_ne!(json(3), json(4));
    }

    #[test]
    fn arenas_are_as_they_are_said_to_be() {
        let mut boxes = [0_u32; 5];
        for seed in 0..60 {
            let pitch = Pitch::random(seed).unwrap();
            let bounds = pitch.cells.bounds();
            assert!((3.0..=6.5).contains(&bounds.width()), "{bounds:?}");
            assert!((3.0..=6.5).contains(&bounds.height()), "{bounds:?}");
            let apart = (pitch.goals.blue.position - pitch.goals.yellow.position).norm();
            assert!(apart > 0.3, "seed {seed}: {apart} m");
            for goal in [pitch.goals.blue, pitch.goals.yellow] {
                assert!(pitch.course.world.nearest_wall_distance(goal.position) < 1e-9);
            }
            let off = Vector::new(0.9, 0.9);
            let middle = Bounds {
                min: bounds.min + off,
                max: bounds.max - off,
            };
            let walls = pitch.course.world.walls().iter();
            let walls = walls.filter(|wall| middle.contains(wall.start.lerp(&wall.end, 0.5)));
            boxes[walls.count() / 4] += 1;
        }
        assert!(boxes.iter().all(|count| *count > 0), "{boxes:?}");
    }
}
