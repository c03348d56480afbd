//! Constraints of corridors that wind.
//!
//! Beyond the paper, which concludes nothing from junctions that the robot did not see.

use alloc::vec::Vec;

use tolman_geom::{Interval, PointBox};

use super::Verdict;
use super::geometric::Pair;
use crate::diktiometry::{
    Action, Chain, Config, Corridors, Diktiometry, Exits, PlaceId, is_rectangle,
};

/// Returns the opinion on merging two places because the way from one to the other leads round a
/// rectangle. O(corridors²).
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    Verdict::propose_if(is_round(map, [pair.a, pair.b], config))
}

/// Returns whether one of two places is a round of a rectangle after the other. O(corridors²).
pub(super) fn is_round(map: &Diktiometry, places: [PlaceId; 2], config: &Config) -> bool {
    let Some(chain) = Chain::through(map, places, config) else {
        return false;
    };
    let corridors = chain.corners.windows(2).enumerate();
    let lengths = corridors.map(|(corner, ends)| {
        let way = map.related(ends[0], ends[1]).unwrap_or(PointBox::UNBOUNDED);
        chain.turns.length(corner, way, config)
    });
    is_rectangle(&lengths.collect::<Vec<Interval>>(), config)
}

impl Corridors for Diktiometry {
    type Place = PlaceId;

    fn exits(&self, place: PlaceId) -> &Exits {
        &self.place(place).exits
    }

    fn leads(&self, from: PlaceId, action: Action, config: &Config) -> Option<PlaceId> {
        let mut gone = self.paths.along(from, action);
        let came = || {
            let mut came = self.paths.incoming(from);
            let back = config.reverse(action);
            came.find(|(_, link)| Some(link.action) == back)
        };
        gone.next()
            .map(|(_, link)| link.to)
            .or_else(|| came().map(|(_, link)| link.from))
    }
}
