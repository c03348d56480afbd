use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use tolman_draw::Drawing;
use tolman_geom::Point;
use tolman_robot::{Landmark, MapLink, MapPlace, MapView};
use tolman_systems::{FileError, MapFiles, Origin};

use super::LearnedMap;
use crate::BoxError;
use crate::course::{Course, Terrain};
use crate::drawing::places_over_world;
use crate::pioneer::body;

/// The file of a map of which only places and links are kept: any system's.
#[derive(Clone, Debug)]
pub(super) struct ViewFile {
    system: String,
    origin: Origin,
    corridor_width: f64,
    view: MapView,
}

#[derive(Serialize, Deserialize)]
struct Body {
    /// Width of the corridors, m.
    corridor_width: f64,
    places: Vec<Place>,
    links: Vec<(u32, u32)>,
    /// Points along each link, m; empty if they are not known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    ways: Vec<Vec<Point>>,
    /// Points of the floor beside them, m.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    floor: Vec<Point>,
}

#[derive(Serialize, Deserialize)]
struct Place {
    id: u32,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    position: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    landmark: Option<Landmark>,
}

/// Returns the text of a file with the places and links of a map that `system` learned.
pub(crate) fn view_file(
    system: &'static str,
    origin: &Origin,
    corridor_width: f64,
    view: &MapView,
) -> Result<String, FileError> {
    let place = |place: &MapPlace| Place {
        id: place.id,
        position: place.position.map(Into::into),
        landmark: place.landmark,
    };
    let body = Body {
        corridor_width,
        places: view.places.iter().map(place).collect(),
        links: view.links.iter().map(|link| (link.from, link.to)).collect(),
        ways: view.ways.clone(),
        floor: view.floor.clone(),
    };
    MapFiles { system }.write(origin, &body)
}

impl ViewFile {
    /// Reads the text of a file that `system` wrote; `None` if it has other fields.
    pub(super) fn read(system: &'static str, text: &str) -> Option<Self> {
        let (origin, body) = MapFiles { system }.read(text).ok()?;
        let Body {
            corridor_width,
            places,
            links,
            ways,
            floor,
        } = body;
        let place = |place: Place| MapPlace {
            id: place.id,
            position: place.position.map(Point::from),
            landmark: place.landmark,
        };
        let view = MapView {
            places: places.into_iter().map(place).collect(),
            links: (links.into_iter())
                .map(|(from, to)| MapLink { from, to })
                .collect(),
            ways,
            floor,
            trail: Vec::new(),
        };
        let system = system.to_owned();
        Some(Self {
            system,
            origin,
            corridor_width,
            view,
        })
    }
}

impl LearnedMap for ViewFile {
    fn lines(&self) -> Vec<String> {
        let (places, links) = (self.view.places.len(), self.view.links.len());
        vec![
            format!("{}, seed {}", self.origin.world, self.origin.seed),
            format!("{places} places, {links} links"),
        ]
    }

    fn json(&self) -> Value {
        json!({
            "system": self.system,
            "maze": self.origin.world,
            "seed": self.origin.seed,
            "places": self.view.places.len(),
            "links": self.view.links.len(),
        })
    }

    fn view(&self) -> Result<MapView, BoxError> {
        Ok(self.view.clone())
    }

    fn drawing(&self, terrain: &Terrain) -> Result<Drawing, BoxError> {
        if self
            .view
            .places
            .iter()
            .all(|place| place.position.is_none())
        {
            return Err("the map has no positions of its places: leave --svg out".into());
        }
        let course = self.course(&self.origin.world, terrain)?;
        Ok(places_over_world(&course, &self.view))
    }

    fn course(&self, world: &str, terrain: &Terrain) -> Result<Course, BoxError> {
        Ok(match terrain {
            Terrain::Maze(file) => Course::new(world, file.maze.clone(), self.corridor_width)?,
            Terrain::Free(_) => terrain.course(world, &body())?,
        })
    }
}
