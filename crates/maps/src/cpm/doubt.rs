use thiserror::Error;
use tolman_planners::steps_from;

use super::map::{CpMap, JunctionId};

/// Reason not to trust a map, as far as its learner can tell without the truth.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MapDoubt {
    /// No hypothesis explained a walk, so a new map was started beside the old one.
    #[error(
        "{places} of its places are not joined to the rest: the robot lost its way and began again there"
    )]
    Apart {
        /// Number of places that no known way joins to the robot's.
        places: u32,
    },
    /// Two places lie closer together than places can.
    #[error(
        "by dead reckoning its places {} and {} are at the same position: a loop was not closed",
        one.0, other.0
    )]
    Twice {
        /// Id of the older place.
        one: JunctionId,
        /// Id of the other place.
        other: JunctionId,
    },
    /// Another map explains the observations as well.
    #[error(
        "several maps explain the robot's observations, and this one has a probability of {percent:.0} %"
    )]
    Unsure {
        /// Probability of the map among those that explain the observations, %.
        percent: f64,
    },
}

impl CpMap {
    /// Returns the reason why the map cannot be one world of corridors with places at least `apart`
    /// m apart. `None` if nothing contradicts it. `from` is the robot's junction. O(places · ports
    /// · log places).
    #[must_use]
    pub fn doubt(&self, from: JunctionId, apart: f64) -> Option<MapDoubt> {
        let all = self.junctions().len();
        let reached = self.reached_from(from);
        if reached < all {
            let places = (all - reached) as u32;
            return Some(MapDoubt::Apart { places });
        }
        let mut twice = self.junctions().map(|(id, _)| self.twice_at(id, apart));
        twice.find_map(|twice| twice)
    }

    /// Returns a doubt if another place lies at the position of this one. O(ports · log places).
    #[must_use]
    pub fn twice_at(&self, place: JunctionId, apart: f64) -> Option<MapDoubt> {
        let positions = self.positions_from(place);
        let mut others = self.junctions().zip(positions);
        let ((other, _), _) = others.find(|((other, _), position)| {
            let off = position.map(|position| position.middle().coords.norm());
            *other != place && off.is_some_and(|off| off < apart)
        })?;
        Some(MapDoubt::Twice {
            one: place.min(other),
            other: place.max(other),
        })
    }

    /// Returns the number of places that known ways join to `from`, itself among them.
    fn reached_from(&self, from: JunctionId) -> usize {
        let Some(first) = self.junctions.rank(from) else {
            return 0;
        };
        steps_from(self, [first as u32])
            .into_iter()
            .flatten()
            .count()
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Interval, Point, PointBox};

    use super::super::traversal::{DeadReckoning, Sighting};
    use super::*;

    /// Returns a map of a chain of places: each step leads `(x, y)`, m, from one place to the next.
    fn chain(ways: &[(f64, f64)]) -> CpMap {
        let mut map = CpMap::default();
        let mut last = map.add_junction(Sighting::plain(1), None);
        for (x, y) in ways {
            let next = map.add_junction(Sighting::plain(2), None);
            let heading = Interval::new(-0.1, 0.1).unwrap();
            let motion = DeadReckoning {
                displacement: PointBox::about(Point::new(*x, *y), 0.08).unwrap(),
                departure: heading,
                arrival: heading,
            };
            let out = u32::from(last != JunctionId(0));
            map.add_fragment(alloc::vec![], Some(motion), last.port(out), next.port(0));
            last = next;
        }
        map
    }

    #[test]
    fn a_loop_that_is_open_is_noticed() {
        let square = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)];
        let open = chain(&square);
        assert_eq!(open.doubt(JunctionId(0), 0.12), None);
        let closed = [&square[..], &[(0.02, -1.03)]].concat();
        let doubt = chain(&closed).doubt(JunctionId(2), 0.12);
        let (one, other) = (JunctionId(0), JunctionId(4));
        assert_eq!(doubt, Some(MapDoubt::Twice { one, other }));
    }

    #[test]
    fn what_hangs_on_nothing_is_noticed() {
        let mut map = chain(&[(1.0, 0.0)]);
        let alone = map.add_junction(Sighting::plain(1), None);
        let doubt = map.doubt(JunctionId(0), 0.12);
        assert_eq!(doubt, Some(MapDoubt::Apart { places: 1 }));
        assert_eq!(map.doubt(alone, 0.12), Some(MapDoubt::Apart { places: 2 }));
    }
}
