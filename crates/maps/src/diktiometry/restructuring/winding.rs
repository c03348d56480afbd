//! Constraints of corridors that wind.
//!
//! Beyond the paper, which concludes nothing from junctions that the robot did not see.

use alloc::vec::Vec;

use tolman_geom::{Interval, PointBox};

use super::geometric::Pair;
use super::look_agreement::offset_anywhere;
use super::{Verdict, one_way};
use crate::diktiometry::{
    Action, Chain, Config, Corridors, Diktiometry, Exits, PlaceId, Turns, is_rectangle,
};

/// Returns the pairs of a place and another that is a round of a rectangle away. Their box may be
/// too wide for a search to reach. O(corridors²).
pub(super) fn round(map: &Diktiometry, a: PlaceId, config: &Config) -> Vec<Pair> {
    let known = MapCorridors { map, config };
    let ends = Turns::from(known.exits(a), config).filter_map(|turns| turns.round(&known, a));
    let ends = ends.filter(|b| leads_round(&known, [a, *b]));
    let pair = |b| Pair {
        a,
        b,
        offset: offset_anywhere(map, a, b),
    };
    ends.map(pair).collect()
}

/// Returns the opinion on merging two places because the way from one to the other leads round a
/// rectangle. O(corridors²).
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    let known = MapCorridors { map, config };
    Verdict::propose_if(leads_round(&known, [pair.a, pair.b]))
}

fn leads_round(known: &MapCorridors<'_>, places: [PlaceId; 2]) -> bool {
    let MapCorridors { map, config } = *known;
    let Some(chain) = Chain::through(known, places, config) else {
        return false;
    };
    let corridors = chain.corners.windows(2).enumerate();
    let lengths = corridors.map(|(corner, ends)| {
        let way = map.related(ends[0], ends[1]).unwrap_or(PointBox::UNBOUNDED);
        chain.turns.length(corner, way, config)
    });
    is_rectangle(&lengths.collect::<Vec<Interval>>(), config)
}

/// Corridors as far as the map knows them.
struct MapCorridors<'a> {
    map: &'a Diktiometry,
    config: &'a Config,
}

impl Corridors for MapCorridors<'_> {
    type Place = PlaceId;

    fn exits(&self, place: PlaceId) -> &Exits {
        &self.map.place(place).exits
    }

    fn leads(&self, from: PlaceId, action: Action) -> Option<PlaceId> {
        let back = self.config.reverse(action)?;
        let mut ends = one_way::beside(self.map, from, self.config);
        ends.find_map(|(end, leads_here)| (leads_here == back).then_some(end))
    }
}
