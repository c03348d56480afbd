use alloc::string::String;
use alloc::vec::Vec;

use tolman_geom::Point;

use crate::Landmark;

/// Learns a map from a robot's readings and actions. It watches and never drives, so it works on a
/// log as on a robot.
///
/// Each mapper names in [`Observation`](Self::Observation) what it observes at a time. MSLST
/// observes a time step with its scan and the action under way. CPM observes a fragment walked from
/// place to place, and the diktiometry a move with bounds on its odometry. Make these observations
/// from your log. A log that lacks one of their fields does not suit the mapper.
pub trait Mapper {
    /// One observation of the mapper.
    type Observation;
    /// Reason why the mapper refuses an observation.
    type Error;

    /// Takes in one observation.
    ///
    /// # Errors
    /// If the observation is not a number, or cannot follow what was seen before. The map is then
    /// unchanged.
    fn observe(&mut self, seen: &Self::Observation) -> Result<(), Self::Error>;

    /// Returns the learned map as places and links, which any scorer and any drawing can read.
    /// Empty if the mapper learns no map. O(map).
    fn map(&self) -> MapView {
        MapView::default()
    }

    /// Returns the positions where it believes the robot to be, the likeliest first. Empty if the
    /// mapper does not localize.
    fn belief(&self) -> Vec<Guess> {
        Vec::new()
    }

    /// Returns when the mapper names a place of [`visits`](Self::visits).
    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::Never
    }

    /// Returns the places that it visited, in order, given all later observations: as many as its
    /// [naming](Self::visit_naming) says. A place that is not on its map is `None`. O(visits · log
    /// map).
    fn visits(&self) -> Vec<Option<u32>> {
        Vec::new()
    }

    /// Returns the number of elements of [`visits`](Self::visits).
    fn visit_count(&self) -> usize {
        self.visits().len()
    }

    /// Returns why the map may be wrong or unfinished, by the mapper's own account and without the
    /// truth, in a sentence without a full stop; `None` if it sees no reason.
    fn doubt(&self) -> Option<String> {
        None
    }

    /// Returns the probability that its map is right for its observations, 0 … 1; `None` if it does
    /// not estimate that.
    fn certainty(&self) -> Option<f64> {
        None
    }

    /// Returns the memory of its map, bytes: places and links with their contents. The data from
    /// which it was learned (journals, records), derived data and spare memory do not count. `None`
    /// if it is not known. O(map).
    fn map_bytes(&self) -> Option<usize> {
        None
    }
}

impl<M: Mapper + ?Sized> Mapper for &mut M {
    type Observation = M::Observation;
    type Error = M::Error;

    fn observe(&mut self, seen: &M::Observation) -> Result<(), M::Error> {
        (**self).observe(seen)
    }

    fn map(&self) -> MapView {
        (**self).map()
    }

    fn belief(&self) -> Vec<Guess> {
        (**self).belief()
    }

    fn visit_naming(&self) -> VisitNaming {
        (**self).visit_naming()
    }

    fn visits(&self) -> Vec<Option<u32>> {
        (**self).visits()
    }

    fn doubt(&self) -> Option<String> {
        (**self).doubt()
    }

    fn visit_count(&self) -> usize {
        (**self).visit_count()
    }

    fn certainty(&self) -> Option<f64> {
        (**self).certainty()
    }

    fn map_bytes(&self) -> Option<usize> {
        (**self).map_bytes()
    }
}

/// When a mapper names a place that it visited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VisitNaming {
    /// It names none: its places keep their names, so that its former beliefs still hold.
    Never,
    /// It names one before the first time step of its robot, and one after each.
    EachStep,
    /// It names one whenever it comes to a place. An action may lead to none, or to several.
    EachArrival,
}

/// A learned map as any scorer and any drawing can read it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapView {
    /// The places, by id.
    pub places: Vec<MapPlace>,
    /// Ways between the places. A way that can be gone in both directions is listed twice.
    pub links: Vec<MapLink>,
    /// Points along each of the links, in their order, m: from the place that it leaves to the one
    /// to which it leads. Empty if the map does not know them.
    pub ways: Vec<Vec<Point>>,
    /// Points all over the floor that the map knows, at most 1 m apart, m. It may be empty where
    /// places and ways have it all, as in corridors.
    pub floor: Vec<Point>,
    /// Where on the map the robot was at each of the mapper's [`visits`](Mapper::visits), m. Empty
    /// if the mapper does not keep that.
    pub trail: Vec<Option<Point>>,
}

/// A place of a learned map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapPlace {
    /// Id by which links and beliefs name the place.
    pub id: u32,
    /// Position, m, in the map's own frame; `None` if the map does not know it.
    pub position: Option<Point>,
    /// The landmark of the place; `None` without one.
    pub landmark: Option<Landmark>,
}

/// A way from one place of a learned map to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MapLink {
    /// Place that the link leaves.
    pub from: u32,
    /// Place to which the link leads.
    pub to: u32,
}

impl MapLink {
    /// Returns the links of a way between two places, there and back.
    #[must_use]
    pub const fn both_ways(a: u32, b: u32) -> [Self; 2] {
        [Self { from: a, to: b }, Self { from: b, to: a }]
    }
}

/// A place where a robot may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guess {
    /// Position of the place.
    pub at: Position,
    /// Probability, 0 to 1.
    pub weight: f64,
}

/// A position as a robot knows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Position {
    /// A point of the world, m.
    Point(Point),
    /// A place of the robot's map, by id. Its position need not be known.
    Place(u32),
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use super::*;

    /// Knows every place that was named to it, in the order it was visited.
    #[derive(Default)]
    struct Visits(Vec<u32>);

    impl Mapper for Visits {
        type Observation = u32;
        type Error = core::convert::Infallible;

        fn observe(&mut self, seen: &u32) -> Result<(), Self::Error> {
            self.0.push(*seen);
            Ok(())
        }

        fn map(&self) -> MapView {
            let mut places: Vec<u32> = self.0.clone();
            places.sort_unstable();
            places.dedup();
            let place = |id| MapPlace {
                id,
                position: None,
                landmark: None,
            };
            let link = |pair: &[u32]| MapLink {
                from: pair[0],
                to: pair[1],
            };
            MapView {
                places: places.into_iter().map(place).collect(),
                links: self.0.windows(2).map(link).collect(),
                ..MapView::default()
            }
        }

        fn belief(&self) -> Vec<Guess> {
            let guess = |id: &u32| Guess {
                at: Position::Place(*id),
                weight: 1.0,
            };
            self.0.last().map(guess).into_iter().collect()
        }
    }

    #[test]
    fn a_mapper_works_on_a_log() {
        let mut visits = Visits::default();
        for seen in [3, 1, 3] {
            visits.observe(&seen).unwrap();
        }
        let map = visits.map();
        assert_eq!(map.places.len(), 2);
        assert_eq!(
            map.links,
            vec![MapLink { from: 3, to: 1 }, MapLink { from: 1, to: 3 }]
        );
        assert_eq!(visits.belief()[0].at, Position::Place(3));
    }
}
