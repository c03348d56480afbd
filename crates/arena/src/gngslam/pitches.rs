//! Builds the arenas that are always the same.

use alloc::sync::Arc;

use tolman_geom::{Heading, Point};
use tolman_sim::sensors::{Backdrop, Light};
use tolman_sim::{Bounds, Material};

use super::pitch::{Goals, Pitch, PitchError};
use super::room::{Room, Span};

pub(super) const WHITE: [u8; 3] = [235, 235, 228];
const BLUE: [u8; 3] = [30, 60, 190];
const YELLOW: [u8; 3] = [230, 200, 30];
const PLASTER: [u8; 3] = [205, 195, 170];
const WOOD: [u8; 3] = [120, 80, 50];
const STEEL: [u8; 3] = [110, 110, 120];
const CEILING: [u8; 3] = [200, 200, 195];
pub(super) const SKY: [u8; 3] = [200, 225, 255];

/// Height of the boarding, m (section 3.1).
pub(super) const BOARDING: f64 = 0.4;

/// Height of a goal, m. Not in the paper.
pub(super) const GOAL: f64 = 0.5;

/// Sill of a window behind the boarding, m.
pub(super) const SILL: f64 = 0.8;

/// Sill of a window in a wall of the floor itself, m. It is lower, since the robot is nearer to it.
pub(super) const LOW_SILL: f64 = 0.4;

/// Returns a window from its sill, m, to its lintel.
pub(super) fn window(sill: f64) -> Material {
    Material::painted(SKY).standing(sill, 2.2).glowing(1.0)
}

pub(super) fn goal(colour: [u8; 3]) -> Material {
    Material::painted(colour).standing(0.0, GOAL)
}

const fn span(side: usize, from: f64, to: f64) -> Span {
    Span { side, from, to }
}

const fn area(x: f64, y: f64, width: f64, height: f64) -> Bounds {
    Bounds {
        min: Point::new(x, y),
        max: Point::new(x + width, y + height),
    }
}

const fn backdrop(floor: [u8; 3]) -> Backdrop {
    Backdrop {
        floor,
        ceiling: CEILING,
        stains: 0.08,
    }
}

impl Pitch {
    /// Returns the paper's pitch (section 3.1): 4 × 4.6 m of green floor with white boarding 0.4 m
    /// high. A blue goal stands in the east and a yellow one in the west, on the short sides. It
    /// lies in a room with windows in the north, and a door and a cupboard in the south.
    ///
    /// # Errors
    /// None.
    pub fn paper() -> Result<Self, PitchError> {
        /// Distance from the boarding to the wall of the room, m. Not in the paper.
        const BEHIND: f64 = 1.2;
        let boarding = Material::painted(WHITE).standing(0.0, BOARDING);
        let corners = [(0.0, 0.0), (4.6, 0.0), (4.6, 4.0), (0.0, 4.0)];
        let mut room = Room::new(&corners, boarding);
        room.enclose(BEHIND, Material::painted(PLASTER));
        for place in [0.04, 0.29, 0.54, 0.79] {
            room.hang_behind(span(2, place, place + 0.18), BEHIND, window(SILL));
        }
        let door = Material::painted(WOOD).standing(0.0, 2.0);
        room.hang_behind(span(0, 0.25, 0.38), BEHIND, door);
        let cupboard = Material::painted(STEEL).standing(0.0, 1.1);
        room.hang_behind(span(0, 0.55, 0.75), BEHIND, cupboard);
        let board = Material::painted([60, 90, 70]).standing(0.9, 1.9);
        room.hang_behind(span(1, 0.55, 0.85), BEHIND, board);
        let (blue, yellow) = (span(1, 0.33, 0.67), span(3, 0.33, 0.67));
        let look = Look {
            light: Light::daylight(Heading::NORTH),
            floor: [40, 110, 60],
        };
        Self::with_goals("pitch", room, (blue, BLUE), (yellow, YELLOW), look)
    }

    /// Returns a hall of 8 × 6 m with walls as high as a room. It has windows in the west, four
    /// pieces of furniture, and goals in the north and in the south. Not in the paper.
    ///
    /// # Errors
    /// None.
    pub fn hall() -> Result<Self, PitchError> {
        let corners = [(0.0, 0.0), (8.0, 0.0), (8.0, 6.0), (0.0, 6.0)];
        let mut room = Room::new(&corners, Material::painted([214, 208, 196]));
        for place in [0.08, 0.4, 0.72] {
            room.hang(span(3, place, place + 0.2), window(LOW_SILL));
        }
        let door = Material::painted([70, 95, 85]).standing(0.0, 2.0);
        room.hang(span(1, 0.1, 0.28), door);
        let poster = Material::painted([190, 60, 50]).standing(0.3, 1.2);
        room.hang(span(1, 0.55, 0.7), poster);
        for (place, colour, height) in [
            (area(1.6, 1.4, 0.8, 0.5), WOOD, 0.75),
            (area(5.4, 3.6, 0.5, 1.0), STEEL, 1.4),
            (area(2.6, 3.9, 0.6, 0.6), [60, 110, 150], 0.45),
            (area(5.6, 1.3, 0.9, 0.45), [150, 60, 40], 0.5),
        ] {
            room.furnish(place, Material::painted(colour).standing(0.0, height));
        }
        let (blue, yellow) = (span(0, 0.42, 0.58), span(2, 0.42, 0.58));
        let look = Look {
            light: Light::daylight(Heading::WEST),
            floor: [150, 140, 125],
        };
        Self::with_goals("hall", room, (blue, BLUE), (yellow, YELLOW), look)
    }

    /// Returns a room of 5 × 5 m without its corner in the north-east, with windows in the south.
    /// Neither goal can be seen from the other. Not in the paper.
    ///
    /// # Errors
    /// None.
    pub fn l_room() -> Result<Self, PitchError> {
        let corners = [
            (0.0, 0.0),
            (5.0, 0.0),
            (5.0, 2.6),
            (2.6, 2.6),
            (2.6, 5.0),
            (0.0, 5.0),
        ];
        let mut room = Room::new(&corners, Material::painted([196, 206, 214]));
        for place in [0.1, 0.4, 0.7] {
            room.hang(span(0, place, place + 0.2), window(LOW_SILL));
        }
        let door = Material::painted(WOOD).standing(0.0, 2.0);
        room.hang(span(5, 0.5, 0.68), door);
        let shelf = Material::painted([90, 60, 110]).standing(0.4, 1.0);
        room.hang(span(3, 0.3, 0.8), shelf);
        let (blue, yellow) = (span(1, 0.25, 0.75), span(4, 0.25, 0.75));
        let look = Look {
            light: Light::daylight(Heading::SOUTH),
            floor: [95, 60, 55],
        };
        Self::with_goals("l-room", room, (blue, BLUE), (yellow, YELLOW), look)
    }

    /// Hangs the goals and finishes an arena.
    pub(super) fn with_goals(
        name: &str,
        mut room: Room,
        (blue, blue_colour): (Span, [u8; 3]),
        (yellow, yellow_colour): (Span, [u8; 3]),
        look: Look,
    ) -> Result<Self, PitchError> {
        room.put_goal(blue, goal(blue_colour));
        room.put_goal(yellow, goal(yellow_colour));
        Ok(Self {
            name: name.to_owned(),
            world: Arc::new(room.world()?),
            goals: Goals {
                blue: room.before(blue),
                yellow: room.before(yellow),
            },
            light: look.light,
            backdrop: backdrop(look.floor),
            room,
        })
    }
}

/// Appearance of an arena beside its walls.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    pub(super) light: Light,
    pub(super) floor: [u8; 3],
}
