use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use tolman_geom::Point;
use tolman_robot::{Guess, MapLink, MapPlace, MapView, Mapper, Position};

use super::{Diktiometry, Identity, ObservedMove, ObservedMoveError, Observer, PlaceId, Track};

/// An observer works on a log as on a robot: its observation is an [`ObservedMove`].
///
/// ```
/// use tolman_geom::{Interval, Point, PointBox, PoseBox};
/// use tolman_maps::diktiometry::{Action, Config, Exits, FirstPlace, MoveOutcome, ObservedMove, Observer};
/// use tolman_robot::Mapper;
///
/// let config = Config::new(Config::compass_actions(), 1.0);
/// let mut observer = Observer::new(config, FirstPlace::default())?;
/// let way = PointBox::about(Point::new(2.0, 0.0), 0.1)?;
/// observer.observe(&ObservedMove {
///     action: Action(1),
///     odometry: PoseBox::new(way, Interval::ZERO),
///     percept: None,
///     exits: Exits::Unknown,
///     outcome: MoveOutcome::Arrived,
/// })?;
/// let map = Mapper::map(&observer);
/// assert_eq!((map.places.len(), map.links.len()), (2, 1));
/// let second = map.places[1].position.unwrap();
/// assert!((second - Point::new(2.0, 0.0)).norm() < 1e-9);
/// assert_eq!(observer.belief().len(), 1);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
impl Mapper for Observer {
    type Observation = ObservedMove;
    type Error = ObservedMoveError;

    fn observe(&mut self, seen: &ObservedMove) -> Result<(), ObservedMoveError> {
        self.step(seen).map(|_| ())
    }

    /// Returns the places that stand, in the frame of the oldest: the axes are the compass's. A
    /// place that the reference graph does not relate to it has no position, and no place has a
    /// landmark.
    fn map(&self) -> MapView {
        view(self.map())
    }

    /// Returns the place of every track, the best first, by its confidence.
    fn belief(&self) -> Vec<Guess> {
        let guess = |track: &Track| Guess {
            at: Position::Place(track.place.0),
            weight: track.confidence,
        };
        self.tracks().iter().map(guess).collect()
    }

    /// Returns the probability that the map is right, by its [`SelfCheck`](super::SelfCheck).
    /// `None` by the paper's rule of matching, which does not estimate it.
    fn certainty(&self) -> Option<f64> {
        match self.config().matching.identity {
            Identity::Certain => Some(self.self_check().certainty()),
            Identity::Meets => None,
        }
    }

    /// Returns the memory of the map ([`Diktiometry::bytes`]), without tracks and journal.
    fn map_bytes(&self) -> Option<usize> {
        Some(self.map().bytes())
    }
}

fn view(map: &Diktiometry) -> MapView {
    let Some((oldest, _)) = map.paths.places().next() else {
        return MapView::default();
    };
    let layout = map.layout(oldest);
    let position = |id: PlaceId| -> Option<Point> {
        let at = layout.binary_search_by_key(&id, |drawn| drawn.place).ok()?;
        Some(layout[at].bounds.middle())
    };
    let place = |id: PlaceId| MapPlace {
        id: id.0,
        position: position(id),
        landmark: None,
    };
    let links = map.paths.links().map(|(_, link)| MapLink {
        from: link.from.0,
        to: link.to.0,
    });
    let links: BTreeSet<MapLink> = links.collect();
    MapView {
        places: map.paths.places().map(|(id, _)| place(id)).collect(),
        links: links.into_iter().collect(),
        ..MapView::default()
    }
}
