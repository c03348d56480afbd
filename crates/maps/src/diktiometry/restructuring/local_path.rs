//! Local path constraints: "each place has a consistent, if stochastic, input-output behavior (effects of performing
//! actions)".

use alloc::vec::Vec;

use tolman_geom::Point;

use super::geometric::Pair;
use super::{Diagnosis, Verdict};
use crate::diktiometry::config::{Config, Use};
use crate::diktiometry::ids::{LinkId, PlaceId};
use crate::diktiometry::map::Diktiometry;
use crate::diktiometry::path_graph::Link;

/// "If two places have nearly identical incoming and outgoing action link sets (greater than a large fraction go to the
/// same place via equivalent actions), then the places should be merged. The places also should have been visited often
/// enough." Where an action certainly leads to different places from the two, they are not one. O(degree²).
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    let limits = &config.restructuring;
    if limits.local_merge == Use::Off {
        return Verdict::Abstain;
    }
    let [a, b] = [pair.a, pair.b].map(|place| &map.paths.places[place.index()]);
    if a.visits.min(b.visits) < limits.visits {
        return Verdict::Abstain;
    }
    let ends = |place: PlaceId| -> Vec<(u32, bool, PlaceId)> {
        let out = map.paths.outgoing(place);
        let out = out.map(|(_, link)| (link.action.0, true, link.to));
        let into = map.paths.incoming(place);
        let into = into.map(|(_, link)| (link.action.0, false, link.from));
        out.chain(into).collect()
    };
    let (of_a, of_b) = (ends(pair.a), ends(pair.b));
    let shared = of_a.iter().filter(|end| of_b.contains(end)).count();
    let union = of_a.len() + of_b.len() - shared;
    if union > 0 && shared as f64 >= limits.links[0] * union as f64 {
        return Verdict::Propose;
    }
    // Of the actions done at both: how many may end at one place?
    let outs = || map.paths.outgoing(pair.a);
    let common = outs().filter(|(_, link)| map.paths.along(pair.b, link.action).next().is_some());
    let (mut all, mut possible) = (0, 0);
    for (_, link) in common {
        all += 1;
        let mut others = map.paths.along(pair.b, link.action);
        possible += usize::from(others.any(|(_, other)| may_end_alike(map, pair, link, other)));
    }
    if all > 0 && (possible as f64) < limits.links[1] * f64::from(all) {
        return Verdict::Reject;
    }
    Verdict::Abstain
}

/// Whether the ends of a link of each place may be one place, if the two places are.
fn may_end_alike(map: &Diktiometry, pair: &Pair, of_a: &Link, of_b: &Link) -> bool {
    if of_a.to == of_b.to {
        return true;
    }
    match (map.related(pair.a, of_a.to), map.related(pair.b, of_b.to)) {
        (Some(a), Some(b)) => (a - b).contains(Point::origin()),
        _ => true,
    }
}

/// "If the incoming links can be partitioned into two sets such that the sets' 'images' (the sets of outgoing links taken
/// after coming in on each link in a set) are (nearly) disjoint, then a split is indicated."
///
/// Images of different *actions* say only that the robot turned here or there; a split is indicated where the same
/// action led to different places. The paper's images are of links, so that is what they are compared by: two incoming
/// links belong together when some action led from both to the same place, and apart when it never did although both
/// know the action. O(degree²).
pub(super) fn split(map: &Diktiometry, place: PlaceId, config: &Config) -> Option<Diagnosis> {
    let limits = &config.restructuring;
    let here = &map.paths.places[place.index()];
    if limits.local_split == Use::Off || here.visits < limits.visits {
        return None;
    }
    // Only an action with two ends can tell, so that almost every place is done here.
    let several = here.outgoing.iter().any(|id| {
        let link = &map.paths.links[id.index()];
        map.paths.along(place, link.action).count() > 1
    });
    if !several {
        return None;
    }
    let images: Vec<Image> = here
        .incoming
        .iter()
        .map(|&id| Image::of(map, id, config))
        .filter(|image| !image.taken.is_empty())
        .collect();
    // The first image and all that agrees with it, directly or through others, against the rest.
    let mut side: Vec<bool> = images.iter().enumerate().map(|(at, _)| at == 0).collect();
    let mut grows = true;
    while grows {
        grows = false;
        for at in 0..images.len() {
            let joins = |(other, on): (&Image, &bool)| *on && images[at].agrees(other);
            if !side[at] && images.iter().zip(&side).any(joins) {
                side[at] = true;
                grows = true;
            }
        }
    }
    let of = |wanted: bool| {
        images
            .iter()
            .zip(&side)
            .filter(move |(_, on)| **on == wanted)
    };
    let weight =
        |wanted: bool| of(wanted).fold(0_u32, |sum, (image, _)| sum.saturating_add(image.weight()));
    let differ = of(true).any(|(one, _)| of(false).any(|(other, _)| one.contradicts(other)));
    let enough = weight(true).min(weight(false)) >= limits.visits;
    (differ && enough).then(|| Diagnosis::Links {
        incoming: of(false).map(|(image, _)| image.link).collect(),
    })
}

/// The links taken after one.
struct Image {
    link: LinkId,
    /// Action, place it led to, how often.
    taken: Vec<(u32, PlaceId, u32)>,
}

impl Image {
    fn of(map: &Diktiometry, id: LinkId, config: &Config) -> Self {
        let link = &map.paths.links[id.index()];
        let least = f64::from(link.then.iter().map(|one| one.count).max().unwrap_or(0))
            * config.restructuring.minority;
        let taken = link
            .then
            .iter()
            .filter(|one| f64::from(one.count) >= least)
            .map(|one| {
                let next = &map.paths.links[one.link.index()];
                (next.action.0, next.to, one.count)
            })
            .collect();
        Self { link: id, taken }
    }

    fn weight(&self) -> u32 {
        let counts = self.taken.iter().map(|(_, _, count)| *count);
        counts.fold(0, u32::saturating_add)
    }

    fn agrees(&self, other: &Self) -> bool {
        let same = |one: &(u32, PlaceId, u32)| {
            let alike = |two: &(u32, PlaceId, u32)| (one.0, one.1) == (two.0, two.1);
            other.taken.iter().any(alike)
        };
        self.taken.iter().any(same)
    }

    fn contradicts(&self, other: &Self) -> bool {
        let apart = |one: &(u32, PlaceId, u32)| {
            let differs = |two: &(u32, PlaceId, u32)| one.0 == two.0 && one.1 != two.1;
            other.taken.iter().any(differs)
        };
        self.taken.iter().any(apart)
    }
}
