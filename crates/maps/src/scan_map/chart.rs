use alloc::string::String;
use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::Point;
use tolman_planners::{Arcs, path_to};
use tolman_robot::{MapLink, MapPlace, MapView};

use super::{Clearings, GroundPlan, ScanMap, ScanPlace, WallGrid};

/// The final form of a [`ScanMap`] after learning: its ground, its places, and the links between
/// them.
///
/// Navigation needs no more, and a file holds no more.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanChart {
    ground: GroundPlan,
    places: Vec<ScanPlace>,
    /// Lower and higher end of each link, in order.
    links: Vec<[u32; 2]>,
    goal: Vec<Point>,
    start: Vec<Point>,
    /// Positions where numbered landmarks were sensed.
    numbered: Vec<(u32, Point)>,
    radius: f64,
    surprise: f64,
}

/// A [`ScanChart`] in the form in which it is written.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ChartParts {
    /// Distance that the robot keeps from walls, m.
    pub radius: f64,
    /// Places of the map, by id.
    pub places: Vec<ScanPlace>,
    /// Links between places, each once, the lower id first, in order.
    pub links: Vec<[u32; 2]>,
    /// Positions where the landmark of the goal was sensed, m.
    pub goal: Vec<Point>,
    /// Positions where the landmark of the start was sensed, m; empty if the map begins there.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Vec::is_empty")
    )]
    pub start: Vec<Point>,
    /// Positions where numbered landmarks were sensed, m, with their numbers.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Vec::is_empty")
    )]
    pub numbered: Vec<(u32, Point)>,
    /// Contradiction between the map's walls, 0 … 1: see [`ScanMap::surprise`]. Older files lack
    /// it.
    #[cfg_attr(feature = "serde", serde(default))]
    pub surprise: f64,
    /// Side of a cell of the ground, m: [`WallGrid::CELL`].
    pub cell: f64,
    /// Column and row of the first cell.
    pub first: [i32; 2],
    /// Cells of the ground, as [`GroundPlan::rows`] writes them.
    pub rows: Vec<String>,
}

/// Reason why parts cannot become a [`ScanChart`].
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ChartError {
    /// The distance from walls is not valid for a robot.
    #[error("its robot keeps {radius} m from walls, expected 0.01 to 10: learn the map again")]
    Radius {
        /// Distance that the file gives, m.
        radius: f64,
    },
    /// The share of contradicted beams lies outside 0 … 1.
    #[error("its walls contradict one another by {surprise}, expected 0 to 1: learn the map again")]
    Surprise {
        /// Share that the file gives.
        surprise: f64,
    },
    /// The cells are not as wide as this program's.
    #[error(
        "its cells are {found} m wide, expected {}: learn the map again",
        WallGrid::CELL
    )]
    Cell {
        /// Side of the file's cells, m.
        found: f64,
    },
    /// A place or a goal's position is not finite or too far away.
    #[error("{what} {number} is at ({}, {}) m, which is not a valid position: learn the map again", at.x, at.y)]
    Nowhere {
        /// Kind of the item at the position.
        what: &'static str,
        /// Index of the item, from 0.
        number: usize,
        /// Position that the file gives, m.
        at: Point,
    },
    /// A link does not join two places, or is out of order.
    #[error(
        "link {number} goes from place {from} to place {to} of {places}; expected the lower id first, and each link once and in order: learn the map again"
    )]
    Link {
        /// Number of the link, from 0.
        number: usize,
        /// Lower end of the link.
        from: u32,
        /// Higher end of the link.
        to: u32,
        /// Number of places.
        places: usize,
    },
    /// The cells lie too far from the origin.
    #[error("its first cell is {first:?}, which is too far away: learn the map again")]
    TooFar {
        /// Column and row of the first cell.
        first: [i32; 2],
    },
    /// A row is not as long as the first one.
    #[error("row {row} has {found} cells, expected {expected}: learn the map again")]
    Row {
        /// Index of the row, from 0.
        row: usize,
        /// Number of cells in the row.
        found: usize,
        /// Number of cells in the first row.
        expected: usize,
    },
    /// A letter stands for no kind of ground.
    #[error(
        "row {row}, cell {column}: {letter:?} is not ground; expected '#', '.' or a space: learn the map again"
    )]
    Letter {
        /// Index of the row, from 0.
        row: usize,
        /// Index of the cell in the row, from 0.
        column: usize,
        /// Letter that the file has there.
        letter: char,
    },
}

/// Maximum distance of anything from the origin, m.
const FARTHEST: f64 = 5e4;

impl ScanChart {
    /// Returns the memory of places, links, walls and the landmark's positions, bytes. O(1).
    #[must_use]
    pub const fn bytes(&self) -> usize {
        size_of_val(self.places.as_slice())
            + size_of_val(self.links.as_slice())
            + size_of_val(self.goal.as_slice())
            + size_of_val(self.start.as_slice())
            + size_of_val(self.numbered.as_slice())
            + self.ground.bytes()
    }

    /// Returns the chart of a map as learned so far. O(cells + places + links).
    #[must_use]
    pub fn of(map: &ScanMap) -> Self {
        Self {
            ground: GroundPlan::of(map.grid()),
            places: map.places().to_vec(),
            links: map.links().collect(),
            goal: map.goal().to_vec(),
            start: map.start().to_vec(),
            numbered: map.numbered().collect(),
            radius: map.radius(),
            surprise: map.surprise(),
        }
    }

    /// Returns the saved form of the map. O(cells + places + links).
    #[must_use]
    pub fn to_parts(&self) -> ChartParts {
        ChartParts {
            radius: self.radius,
            places: self.places.clone(),
            links: self.links.clone(),
            goal: self.goal.clone(),
            start: self.start.clone(),
            numbered: self.numbered.clone(),
            surprise: self.surprise,
            cell: WallGrid::CELL,
            first: self.ground.first(),
            rows: self.ground.rows().collect(),
        }
    }

    /// Returns the map of a saved form. O(cells + places + links).
    ///
    /// # Errors
    /// [`ChartError`] with the first part that is invalid.
    pub fn from_parts(parts: ChartParts) -> Result<Self, ChartError> {
        let ChartParts {
            radius,
            surprise,
            cell,
            ..
        } = parts;
        if !(0.01..=10.0).contains(&radius) {
            return Err(ChartError::Radius { radius });
        }
        if !(0.0..=1.0).contains(&surprise) {
            return Err(ChartError::Surprise { surprise });
        }
        if (cell - WallGrid::CELL).abs() > 1e-9 || cell.is_nan() {
            return Err(ChartError::Cell { found: cell });
        }
        lie_somewhere("place", parts.places.iter().map(|place| place.position))?;
        lie_somewhere("goal", parts.goal.iter().copied())?;
        lie_somewhere("start", parts.start.iter().copied())?;
        lie_somewhere("landmark", parts.numbered.iter().map(|(_, at)| *at))?;
        check_links(&parts.links, parts.places.len())?;
        Ok(Self {
            ground: GroundPlan::from_rows(parts.first, &parts.rows)?,
            places: parts.places,
            links: parts.links,
            goal: parts.goal,
            start: parts.start,
            numbered: parts.numbered,
            radius,
            surprise,
        })
    }

    /// Returns the chart with additional walls at these points, as far as they lie on its ground.
    /// O(cells + points).
    #[must_use]
    pub fn with_walls(&self, at: &[Point]) -> Self {
        Self {
            ground: self.ground.with_walls(at),
            ..self.clone()
        }
    }

    /// Returns the ground: walls, floor and unknown cells.
    #[must_use]
    pub const fn ground(&self) -> &GroundPlan {
        &self.ground
    }

    /// Returns the places, by id.
    #[must_use]
    pub fn places(&self) -> &[ScanPlace] {
        &self.places
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

    /// Returns the positions at which a numbered landmark was sensed, m.
    pub fn spots_of(&self, number: u32) -> impl Iterator<Item = Point> + '_ {
        let spots = self.numbered.iter().filter(move |(of, _)| *of == number);
        spots.map(|(_, at)| *at)
    }

    /// Returns the standpoints of the robot on a grid of [its ground](GroundPlan::grid).
    #[must_use]
    pub const fn clearings<'a>(&self, grid: &'a WallGrid) -> Clearings<'a> {
        Clearings::new(grid, self.radius)
    }

    /// Returns the reason in the map itself to doubt it, as a sentence without a full stop. `None`
    /// if there is none.
    #[must_use]
    pub fn doubt(&self) -> Option<&'static str> {
        if self.goal.is_empty() {
            return Some("the robot never sensed the goal");
        }
        (self.surprise > ScanMap::DOUBTFUL).then_some(
            "its walls contradict one another, as where a robot is lifted while it learns",
        )
    }

    /// Returns the distance that the robot keeps from walls, m.
    pub(super) const fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns the places along a way of fewest links from one place to the nearest of others, both
    /// ends included. `None` if there is no way. O(places + links).
    #[must_use]
    pub fn way(&self, from: u32, to: &[u32]) -> Option<Vec<u32>> {
        let both_ways = |[a, b]: &[u32; 2]| [(*a, *b, 1), (*b, *a, 1)];
        let arcs: Vec<(u32, u32, u32)> = self.links.iter().flat_map(both_ways).collect();
        let arcs = Arcs::new(self.places.len(), &arcs);
        path_to(&arcs, from, |place| to.contains(&place))
    }

    /// Returns places and links in the form that scorers and drawings read. O(places + links).
    #[must_use]
    pub fn view(&self) -> MapView {
        view(&self.places, self.links.iter().copied())
    }
}

/// Returns places and links in the form that scorers and drawings read; links lead both ways.
pub(super) fn view(places: &[ScanPlace], links: impl Iterator<Item = [u32; 2]>) -> MapView {
    let place = |(id, place): (u32, &ScanPlace)| MapPlace {
        id,
        position: Some(place.position),
        landmark: place.landmark,
    };
    let both_ways = |[a, b]: [u32; 2]| [MapLink { from: a, to: b }, MapLink { from: b, to: a }];
    MapView {
        places: (0..).zip(places).map(place).collect(),
        links: links.flat_map(both_ways).collect(),
        ..MapView::default()
    }
}

fn lie_somewhere(what: &'static str, all: impl Iterator<Item = Point>) -> Result<(), ChartError> {
    let lies = |at: Point| at.coords.iter().all(|along| along.abs() <= FARTHEST);
    match all.enumerate().find(|(_, at)| !lies(*at)) {
        Some((number, at)) => Err(ChartError::Nowhere { what, number, at }),
        None => Ok(()),
    }
}

fn check_links(links: &[[u32; 2]], places: usize) -> Result<(), ChartError> {
    let mut before = None;
    for (number, [from, to]) in links.iter().copied().enumerate() {
        if from >= to || to as usize >= places || before >= Some([from, to]) {
            return Err(ChartError::Link {
                number,
                from,
                to,
                places,
            });
        }
        before = Some([from, to]);
    }
    Ok(())
}
