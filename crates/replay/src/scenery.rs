use serde::Serialize;
use tolman_geom::Point;
use tolman_sim::World;

/// Static parts of a world: walls, zones of the floor, and doors. Coordinates are in metres, x to
/// the right and y upwards.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scenery {
    /// Ends of each wall, m.
    pub walls: Vec<[Point; 2]>,
    /// Zones of the floor.
    pub zones: Vec<SceneryZone>,
    /// Doors of the world.
    pub doors: Vec<SceneryDoor>,
}

/// A part of the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneryZone {
    /// Meaning of the zone, which decides its colour.
    pub kind: ZoneKind,
    /// Name of the zone.
    pub name: String,
    /// Corners of the zone in order, m.
    pub corners: Vec<Point>,
}

/// Meaning of a [`SceneryZone`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ZoneKind {
    /// Destination of the robot.
    Destination,
    /// Start of the robot.
    Start,
    /// A part of the floor that is marked.
    Region,
    /// Walled off: no floor.
    Solid,
}

/// A wall that opens and shuts.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneryDoor {
    /// Name of the door.
    pub name: String,
    /// Ends of the door, m.
    pub ends: [Point; 2],
    /// Changes of the door, ascending by step; before the first one it is open.
    pub changes: Vec<DoorChange>,
}

/// One change of a [`SceneryDoor`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DoorChange {
    /// First step at which the state holds.
    pub step: u32,
    /// Whether the door is open.
    pub state: tolman_sim::DoorState,
}

impl Scenery {
    /// Returns the walls and zones of a simulated world, and its doors in their first states.
    #[must_use]
    pub fn of_world(world: &World) -> Self {
        let zones = world.zones().iter().flat_map(|zone| {
            let kind = match zone.name() {
                "destination" => ZoneKind::Destination,
                "start" => ZoneKind::Start,
                _ => ZoneKind::Region,
            };
            zone.areas().iter().map(move |area| SceneryZone {
                kind,
                name: zone.name().to_owned(),
                corners: area.outline(),
            })
        });
        let doors = world.doors().iter().map(|door| SceneryDoor {
            name: door.name.clone(),
            ends: [door.start, door.end],
            changes: vec![DoorChange {
                step: 0,
                state: door.state,
            }],
        });
        Self {
            walls: world
                .walls()
                .iter()
                .map(|wall| [wall.start, wall.end])
                .collect(),
            zones: zones.collect(),
            doors: doors.collect(),
        }
    }
}
