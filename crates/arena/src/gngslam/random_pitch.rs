//! Arenas by seed.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Point, Vector};
use tolman_sim::sensors::Light;
use tolman_sim::{Bounds, Material};
use tolman_systems::stream;

use super::pitch::{Pitch, PitchError};
use super::pitches::{BOARDING, LOW_SILL, Look, SILL, WHITE, window};
use super::room::{Room, Span};

/// Length of a side, m.
const SIDE: core::ops::Range<f64> = 3.0..6.5;

/// Distance between furniture and anything else, m: a lane wide enough for the robot to drive along
/// and turn in.
const GAP: f64 = 0.95;

/// Maximum number of pieces of furniture.
const MOST_BOXES: u32 = 4;

/// Maximum number of tries for a place that leaves the lanes free.
const TRIES: u32 = 50;

/// Direction of each side of a rectangle: 0 is the south.
const SIDES: [Heading; 4] = [Heading::SOUTH, Heading::EAST, Heading::NORTH, Heading::WEST];

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
    pub fn random(seed: u64) -> Result<Self, PitchError> {
        let rng = &mut stream(seed, 0);
        let (width, height) = (rng.random_range(SIDE), rng.random_range(SIDE));
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        let windows = rng.random_range(0_u32..4) as usize;
        let mut room = if rng.random_range(0_u32..2) == 0 {
            open_floor(&corners, windows, rng)
        } else {
            closed_room(&corners, windows, rng)
        };
        for _ in 0..rng.random_range(0..=MOST_BOXES) {
            furnish(&mut room, rng);
        }
        let first = rng.random_range(0_u32..4) as usize;
        let second = (first + rng.random_range(1_u32..4) as usize) % 4;
        let goals = [first, second].map(|side| goal_on(&room, side, rng));
        let [one, other] = two_colours(rng);
        let look = look(SIDES[windows], rng);
        let name = format!("random-{seed}");
        Self::with_goals(&name, room, (goals[0], one), (goals[1], other), look)
    }
}

/// Returns boarding, and behind it the walls of a room with windows, doors and cupboards.
fn open_floor(corners: &[(f64, f64)], windows: usize, rng: &mut ChaCha8Rng) -> Room {
    let boarding = Material::painted(WHITE).standing(0.0, BOARDING);
    let behind = rng.random_range(0.8..1.6);
    let mut room = Room::new(corners, boarding);
    room.enclose(behind, Material::painted(pale(rng)));
    for (span, material) in decoration(windows, SILL, rng) {
        room.hang_behind(span, behind, material);
    }
    room
}

/// Returns high walls with windows, doors and cupboards on them.
fn closed_room(corners: &[(f64, f64)], windows: usize, rng: &mut ChaCha8Rng) -> Room {
    let mut room = Room::new(corners, Material::painted(pale(rng)));
    for (span, material) in decoration(windows, LOW_SILL, rng) {
        room.hang(span, material);
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
        (span, window(sill))
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
        room.furnish(place, material);
    }
}

/// Returns a random place of that size, if lanes are left all round it.
fn free_place(room: &Room, size: Vector, rng: &mut ChaCha8Rng) -> Option<Bounds> {
    let floor = room.bounds();
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
    let is_free = room
        .furniture()
        .iter()
        .all(|other| gap(&place, other) >= GAP);
    is_free.then_some(place)
}

/// Returns the gap between two boxes along the axis on which it is wider, m; negative if they
/// overlap.
fn gap(a: &Bounds, b: &Bounds) -> f64 {
    let x = (a.min.x - b.max.x).max(b.min.x - a.max.x);
    let y = (a.min.y - b.max.y).max(b.min.y - a.max.y);
    x.max(y)
}

/// Returns the part of a side that a goal covers, 0.9 to 1.6 m wide.
fn goal_on(room: &Room, side: usize, rng: &mut ChaCha8Rng) -> Span {
    let width = rng.random_range(0.9..1.6) / room.length(side);
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

/// Returns daylight through the windows of random brightness and tint, and a dark floor of random
/// colour.
fn look(windows: Heading, rng: &mut ChaCha8Rng) -> Look {
    let mut light = Light::daylight(windows);
    light.brightness = rng.random_range(0.65..0.95);
    light.cast = core::array::from_fn(|_| rng.random_range(0.9..1.1));
    Look {
        light,
        floor: core::array::from_fn(|_| rng.random_range(30_u32..150) as u8),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arenas_of_a_seed_are_the_same_and_of_others_are_not() {
        let json = |seed| Pitch::random(seed).unwrap().world.to_json().unwrap();
        assert_eq!(json(3), json(3));
        assert_ne!(json(3), json(4));
    }

    #[test]
    fn arenas_are_as_they_are_said_to_be() {
        let mut boxes = [0_u32; 5];
        for seed in 0..60 {
            let pitch = Pitch::random(seed).unwrap();
            let bounds = pitch.bounds();
            assert!((3.0..=6.5).contains(&bounds.width()), "{bounds:?}");
            assert!((3.0..=6.5).contains(&bounds.height()), "{bounds:?}");
            let apart = (pitch.goals.blue.position - pitch.goals.yellow.position).norm();
            assert!(apart > 0.3, "seed {seed}: {apart} m");
            for goal in [pitch.goals.blue, pitch.goals.yellow] {
                assert!(pitch.world.nearest_wall_distance(goal.position) < 1e-9);
            }
            boxes[pitch.room.furniture().len()] += 1;
        }
        assert!(boxes.iter().all(|count| *count > 0), "{boxes:?}");
    }
}
