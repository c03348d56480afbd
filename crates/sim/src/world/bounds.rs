use tolman_geom::Point;

/// A rectangle along the axes.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bounds {
    /// The south-west corner, m.
    pub min: Point,
    /// The north-east corner, m.
    pub max: Point,
}

impl Bounds {
    /// Returns the smallest rectangle round `points`; inside out if there are none.
    #[must_use]
    pub fn of(points: impl IntoIterator<Item = Point>) -> Self {
        let nothing = Self {
            min: Point::new(f64::INFINITY, f64::INFINITY),
            max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        };
        points.into_iter().fold(nothing, |bounds, point| Self {
            min: bounds.min.inf(&point),
            max: bounds.max.sup(&point),
        })
    }

    /// Returns the extent from west to east, m.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.max.x - self.min.x
    }

    /// Returns the extent from south to north, m.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.max.y - self.min.y
    }

    /// Returns the corners, counter-clockwise from the south-west.
    #[must_use]
    pub fn corners(&self) -> [Point; 4] {
        let Self { min, max } = *self;
        [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)]
    }

    /// Returns whether `point` lies inside or on the edge.
    #[must_use]
    pub fn contains(&self, point: Point) -> bool {
        self.min <= point && point <= self.max
    }
}
