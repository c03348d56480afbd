use alloc::vec::Vec;
use core::f64::consts::PI;
use core::fmt;

use tolman_geom::{Interval, PointBox, PoseBox};

use super::bearings::Bearings;
use super::pattern::PatternId;
use tolman_robot::Landmark;

/// What the robot sees at a place that ends a fragment: a junction, a dead end (one port) or a
/// landmark. A landmark may stand in a corridor (two ports): "other CP (some extra landmarks) might
/// also be used to divide fragment as well".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sighting {
    /// Number of ways out, including the port of entry; at least 1.
    pub degree: u32,
    /// Landmark at the place.
    pub landmark: Option<Landmark>,
}

impl Sighting {
    /// Returns a place of `degree` ports without a landmark.
    #[must_use]
    pub const fn plain(degree: u32) -> Self {
        Self {
            degree,
            landmark: None,
        }
    }
}

/// Writes the sighting in words: `a dead end`, `a junction of 3 ways, the start`.
impl fmt::Display for Sighting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.degree {
            0 => f.write_str("a place without ways")?,
            1 => f.write_str("a dead end")?,
            2 => f.write_str("a corridor")?,
            ways => write!(f, "a junction of {ways} ways")?,
        }
        match self.landmark {
            None => Ok(()),
            Some(Landmark::Start) => f.write_str(", the start"),
            Some(Landmark::Goal) => f.write_str(", the goal"),
            Some(Landmark::Numbered(number)) => write!(f, ", landmark {number}"),
        }
    }
}

/// One fragment walked from one place to the next. It becomes an A-pattern.
#[derive(Clone, Debug, PartialEq)]
pub struct Traversal {
    /// 𝔸 of Definition 1: the common patterns observed on the way, without those of the places at
    /// its ends.
    pub patterns: Vec<PatternId>,
    /// Dead reckoning of the walk, or `None` if the robot has none, like the paper's.
    pub motion: Option<DeadReckoning>,
    /// Sighting of the place to which the walk led.
    pub sighting: Sighting,
    /// Bearings of the ways out, counted from the one by which the robot came. `None` if it did not
    /// look, like the paper's.
    pub bearings: Option<Bearings>,
}

/// Dead reckoning of a walk. Its axes are the same for all walks: the robot's at its start. Bounds
/// allow for the drift of its heading since then.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DeadReckoning {
    /// Position of the end relative to the beginning, m.
    pub displacement: PointBox,
    /// Heading in which the robot left, rad, counter-clockwise from east; not wrapped.
    pub departure: Interval,
    /// Heading in which the robot arrived, rad, counter-clockwise from east; not wrapped.
    pub arrival: Interval,
}

impl DeadReckoning {
    /// Returns the dead reckoning of the same walk the other way.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self {
            displacement: -self.displacement,
            departure: half_turned(self.arrival),
            arrival: half_turned(self.departure),
        }
    }

    /// Returns the bounds that satisfy both, for two walks along one fragment. Headings count up to
    /// full circles. `None` if they contradict each other.
    #[must_use]
    pub fn intersection(self, other: Self) -> Option<Self> {
        let pose = |motion: Self, heading| PoseBox::new(motion.displacement, heading);
        let left = pose(self, self.departure).intersection(pose(other, other.departure))?;
        let came = pose(self, self.arrival).intersection(pose(other, other.arrival))?;
        Some(Self {
            displacement: left.position,
            departure: left.heading,
            arrival: came.heading,
        })
    }
}

fn half_turned(heading: Interval) -> Interval {
    Interval::new(heading.low() + PI, heading.high() + PI).unwrap_or(Interval::UNBOUNDED)
}
