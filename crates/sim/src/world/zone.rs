use core::f64::consts::TAU;

use tolman_geom::{Point, Vector};
use tolman_maze::Cell;

use super::{Bounds, WorldError};

/// A named part of the floor, such as a destination, a start or the place of a landmark.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Zone {
    name: String,
    areas: Vec<Area>,
}

/// A piece of a [`Zone`].
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Area {
    /// A rectangle along the axes.
    Rectangle(Bounds),
    /// A disc.
    Disc {
        /// Middle of the disc, m.
        centre: Point,
        /// Radius of the disc, m.
        radius: f64,
    },
}

/// Number of corners of the polygon that a disc is drawn as.
const DISC_CORNERS: u32 = 48;

impl Area {
    /// Returns the middle, m.
    #[must_use]
    pub fn middle(&self) -> Point {
        match self {
            Self::Rectangle(bounds) => bounds.min + 0.5 * (bounds.max - bounds.min),
            Self::Disc { centre, .. } => *centre,
        }
    }

    /// Returns whether `point` lies in it or on its edge.
    #[must_use]
    pub fn contains(&self, point: Point) -> bool {
        match self {
            Self::Rectangle(bounds) => bounds.contains(point),
            Self::Disc { centre, radius } => (point - centre).norm() <= *radius,
        }
    }

    /// Returns its corners, counter-clockwise: of a disc, those of a polygon with 48 corners in it.
    #[must_use]
    pub fn outline(&self) -> Vec<Point> {
        match *self {
            Self::Rectangle(bounds) => bounds.corners().to_vec(),
            Self::Disc { centre, radius } => (0..DISC_CORNERS)
                .map(|corner| {
                    let angle = TAU * f64::from(corner) / f64::from(DISC_CORNERS);
                    let (sin, cos) = libm::sincos(angle);
                    centre + Vector::new(cos, sin) * radius
                })
                .collect(),
        }
    }
}

impl Zone {
    /// Returns the zone that consists of `areas`.
    #[must_use]
    pub fn new(name: impl Into<String>, areas: Vec<Area>) -> Self {
        Self {
            name: name.into(),
            areas,
        }
    }

    pub(super) fn of_cells(name: &str, cells: &[Cell], pitch: f64) -> Self {
        let corner = |x: u32, y: u32| Point::new(f64::from(x) * pitch, f64::from(y) * pitch);
        let area = |cell: &Cell| {
            let (x, y) = (u32::from(cell.x), u32::from(cell.y));
            Area::Rectangle(Bounds {
                min: corner(x, y),
                max: corner(x + 1, y + 1),
            })
        };
        Self::new(name, cells.iter().map(area).collect())
    }

    /// Returns the name of the zone.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the parts that it consists of.
    #[must_use]
    pub fn areas(&self) -> &[Area] {
        &self.areas
    }

    /// Returns whether `point` lies in it or on its edge.
    #[must_use]
    pub fn contains(&self, point: Point) -> bool {
        self.areas.iter().any(|area| area.contains(point))
    }

    pub(super) fn check(&self) -> Result<(), WorldError> {
        let extent = |area: &Area| match area {
            Area::Rectangle(bounds) => bounds.width().min(bounds.height()),
            Area::Disc { centre, radius } => radius + 0.0 * (centre.x + centre.y),
        };
        match self
            .areas
            .iter()
            .position(|area| !(extent(area).is_finite() && extent(area) > 0.0))
        {
            Some(index) => Err(WorldError::Zone {
                name: self.name.clone(),
                index,
            }),
            None => Ok(()),
        }
    }
}
