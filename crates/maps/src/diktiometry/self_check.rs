use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use tolman_geom::Point;

use super::{Action, Exits, Observer, Place, PlaceId, SearchLimits, WorldKind, search};

/// Signs in the map itself that it is wrong, without the truth.
///
/// Beyond the paper. A map that is not folded has places that may be one with others. A map in
/// which two places were confused has actions that lead to two places. See [`Self::certainty`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SelfCheck {
    /// Number of places of the map.
    pub places: usize,
    /// Number of places that may be one with another. The bounds allow it, the places look alike,
    /// and so do all places along the same actions.
    pub doubtful: usize,
    /// Number of these that may be one with an older place. All other places are certainly
    /// different from each other.
    #[cfg_attr(feature = "serde", serde(default))]
    pub repeated: usize,
    /// Number of places from which an action of a static world leads to two places, not back, or
    /// straight to where it begins.
    pub torn: usize,
    /// Number of places that are apart from another and nearer to it than δ_sep
    /// ([`Config::separation`](super::Config::separation)), by all estimates of two or more.
    #[cfg_attr(feature = "serde", serde(default))]
    pub crowded: usize,
    /// Number of places with an action that seemed possible and was never tried.
    pub open: usize,
}

/// State of a map by its own account.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapState {
    /// Nothing contradicts the map, and no action is left to try.
    Whole,
    /// Nothing contradicts the map, and some ways were never tried.
    Unfinished,
    /// Some places may be one, and the map cannot tell which.
    Unfolded,
    /// The map grows without end: nearly all of its places may be one with older places.
    Endless,
    /// The map contradicts itself: two places were confused, or an assumption about the robot or
    /// the world is wrong.
    Contradictory,
}

/// Minimum number of places that may be one with older ones, in a map that grows without end.
/// Ladders, eights and office floors that were folded later had at most 35.
const LEAST_REPEATED: usize = 50;

/// Minimum number of places for each certainly different one, in a map that grows without end.
const LEAST_PER_PLACE: usize = 6;

/// Returns whether a map grows without end. In a finite world new places become rare. If the map
/// has many times more places than it can tell apart, the robot goes round and recognizes nothing.
const fn is_endless(places: usize, different: usize) -> bool {
    places >= LEAST_PER_PLACE * different && places >= LEAST_REPEATED + different
}

/// Probability that a map without contradictions is wrong, and that a map with some is right.
const ERROR: f64 = 0.01;

impl SelfCheck {
    /// Returns the probability that the map is right for the part where the robot has been, 0 to 1.
    #[must_use]
    pub fn certainty(&self) -> f64 {
        match self.state() {
            MapState::Whole | MapState::Unfinished => 1.0 - ERROR,
            MapState::Unfolded | MapState::Endless | MapState::Contradictory => ERROR,
        }
    }

    /// Returns the contradiction of the map, as part of a sentence; `None` if there is none.
    #[must_use]
    pub fn complaint(&self) -> Option<String> {
        let Self {
            places,
            doubtful,
            torn,
            crowded,
            ..
        } = *self;
        match self.state() {
            MapState::Whole | MapState::Unfinished => None,
            MapState::Unfolded => Some(format!(
                "the map is not folded: {doubtful} of its {places} places may be one with another"
            )),
            MapState::Endless => Some(format!(
                "the map grows without end: only {} of its {places} places are certainly different from each other, and new ones are not recognized; give the robot narrower bounds of its odometry, or walls of more colours",
                self.different()
            )),
            MapState::Contradictory if crowded > torn => Some(format!(
                "the map contradicts itself: {crowded} of its {places} places are nearer to another than the least distance of places that it was told; tell it a smaller `separation`, or wider bounds of its odometry"
            )),
            MapState::Contradictory => Some(format!(
                "the map contradicts itself: from {torn} of its {places} places an action leads to two places, not back, or straight to where it begins"
            )),
        }
    }

    /// Returns the number of places that are certainly different from each other. The world has at
    /// least as many.
    #[must_use]
    pub const fn different(&self) -> usize {
        self.places.saturating_sub(self.repeated)
    }

    /// Returns the most likely state of the map.
    #[must_use]
    pub const fn state(&self) -> MapState {
        match self {
            Self { torn: 1.., .. } | Self { crowded: 1.., .. } => MapState::Contradictory,
            _ if is_endless(self.places, self.different()) => MapState::Endless,
            Self { doubtful: 1.., .. } => MapState::Unfolded,
            Self { open: 1.., .. } => MapState::Unfinished,
            _ => MapState::Whole,
        }
    }
}

/// The places with which a place may be one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Doubles {
    None,
    /// Newer places only.
    Newer,
    /// An older place, at least.
    Older,
}

impl Observer {
    /// Looks for contradictions of the map and returns the counts. O(places · a search, and for
    /// each pair near each other · ways from both).
    #[must_use]
    pub fn self_check(&self) -> SelfCheck {
        let mut check = SelfCheck::default();
        for (id, place) in self.map.paths.places() {
            check.places += 1;
            let doubles = self.doubles(id);
            check.doubtful += usize::from(doubles != Doubles::None);
            check.repeated += usize::from(doubles == Doubles::Older);
            check.torn += usize::from(self.is_torn(id));
            check.crowded += usize::from(self.is_crowded(id));
            check.open += usize::from(self.is_open(id, place));
        }
        check
    }

    /// Returns whether the map grows without end, by its [`MapState`]. Sooner than
    /// [`Self::self_check`] where it does not: O(places / 6 · a search, and for each pair near each
    /// other · ways from both).
    #[must_use]
    pub fn grows_without_end(&self) -> bool {
        let paths = &self.map.paths;
        let (places, mut different) = (paths.standing(), 0);
        paths.places().all(|(id, _)| {
            different += usize::from(self.doubles(id) != Doubles::Older);
            is_endless(places, different)
        })
    }

    /// Returns whether a place may be one with another.
    fn doubles(&self, place: PlaceId) -> Doubles {
        let near = self.near(place);
        let may_be_one_of =
            |others: Vec<PlaceId>| others.iter().any(|other| self.may_be_one(place, *other));
        let (older, newer) = near.into_iter().partition(|other| *other < place);
        if may_be_one_of(older) {
            Doubles::Older
        } else if may_be_one_of(newer) {
            Doubles::Newer
        } else {
            Doubles::None
        }
    }

    /// Returns the other places whose boxes meet that of `place`.
    pub(super) fn near(&self, place: PlaceId) -> Vec<PlaceId> {
        let map = &self.map;
        let (frame, here) = map.site(place);
        let reached = search(&map.reference, frame, &SearchLimits::UNLIMITED);
        let all = reached.iter().flat_map(|around| {
            let places = &map.frame(around.frame).places;
            places.iter().map(|other| (*other, around.position))
        });
        let near = all.filter(|(other, frame)| {
            *other != place && (*frame + map.place(*other).position).meets(here)
        });
        near.map(|(other, _)| other).collect()
    }

    /// Returns whether an action leads from a place to two places or not back, or a straight one
    /// leads to where it begins.
    fn is_torn(&self, place: PlaceId) -> bool {
        let paths = &self.map.paths;
        self.config.world == WorldKind::Static
            && paths.outgoing(place).any(|(_, link)| {
                let back = self.config.reverse(link.action);
                let leads_elsewhere = |back: Action| {
                    let mut ways = paths.along(link.to, back).peekable();
                    ways.peek().is_some() && ways.all(|(_, way)| way.to != place)
                };
                let leads_nowhere = link.to == place && self.config.leads(link.action).is_some();
                paths.along(place, link.action).count() > 1
                    || leads_nowhere
                    || back.is_some_and(leads_elsewhere)
            })
    }

    /// Returns whether all estimates of the way to another place agree that it is nearer than δ_sep
    /// and not the same. A single estimate may be an outlier.
    fn is_crowded(&self, id: PlaceId) -> bool {
        let (map, least) = (&self.map, self.config.least_distance());
        let (frame, here) = map.site(id);
        let often = map.reference.relations(frame);
        let mut often = often.filter(|relation| relation.estimates > 1);
        often.any(|relation| {
            let places = &map.frame(relation.to).places;
            places.iter().any(|other| {
                let offset = relation.envelope + map.place(*other).position - here;
                !offset.contains(Point::origin()) && self.config.apart.most(offset) < least
            })
        })
    }

    fn is_open(&self, id: PlaceId, place: &Place) -> bool {
        let Exits::Seen(exits) = &place.exits else {
            return false;
        };
        let untried = |action: &Action| self.map.paths.along(id, *action).next().is_none();
        exits
            .iter()
            .any(|action| place.is_open(*action) && untried(action))
    }
}
