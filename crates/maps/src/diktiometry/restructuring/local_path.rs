//! Local path constraints: "each place has a consistent, if stochastic, input-output behavior
//! (effects of performing actions)".

use alloc::vec::Vec;

use tolman_geom::Point;

use super::geometric::Pair;
use super::{Diagnosis, Verdict};
use crate::diktiometry::{Action, Config, Diktiometry, Link, LinkId, PlaceId, Use, WorldKind};

/// Returns the opinion on merging by links. "If two places have nearly identical incoming and
/// outgoing action link sets (greater than a large fraction go to the same place via equivalent
/// actions), then the places should be merged. The places also should have been visited often
/// enough."
///
/// It abstains where proofs are required. It rejects if an action certainly leads to different
/// places from the two. O(degree²).
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    let limits = &config.restructuring;
    if limits.local_merge == Use::Off {
        return Verdict::Abstain;
    }
    let [a, b] = [pair.a, pair.b].map(|place| map.place(place));
    if a.visits.min(b.visits) < limits.visits {
        return Verdict::Abstain;
    }
    let ends = |place: PlaceId| -> Vec<(Action, bool, PlaceId)> {
        let out = map.paths.outgoing(place);
        let out = out.map(|(_, link)| (link.action, true, link.to));
        let into = map.paths.incoming(place);
        let into = into.map(|(_, link)| (link.action, false, link.from));
        out.chain(into).collect()
    };
    let (of_a, of_b) = (ends(pair.a), ends(pair.b));
    let shared = of_a.iter().filter(|end| of_b.contains(end)).count();
    let union = of_a.len() + of_b.len() - shared;
    if union > 0 && shared as f64 >= limits.links[0] * union as f64 {
        return Verdict::propose_if(limits.geometric_merge.trusts_paths());
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

/// Returns whether the ends of two links may be one place, given that their beginnings are.
fn may_end_alike(map: &Diktiometry, pair: &Pair, of_a: &Link, of_b: &Link) -> bool {
    let (a, b) = (map.related(pair.a, of_a.to), map.related(pair.b, of_b.to));
    of_a.to == of_b.to
        || a.zip(b)
            .is_none_or(|(a, b)| (a - b).contains(Point::origin()))
}

/// Returns the diagnosis by which links show that a place is two. "If the incoming links can be
/// partitioned into two sets such that the sets' 'images' (the sets of outgoing links taken after
/// coming in on each link in a set) are (nearly) disjoint, then a split is indicated."
///
/// Images of different *actions* only show that the robot turned in different ways. A split is
/// indicated if the same action led to different places, which cannot be one ([`are_copies`]). Two
/// incoming links belong together if some action led from both to the same place. They are separate
/// if none did although both know the action. O(degree²), and a search if there is such an action.
pub(super) fn split(map: &Diktiometry, place: PlaceId, config: &Config) -> Option<Diagnosis> {
    let limits = &config.restructuring;
    let here = map.place(place);
    if limits.local_split == Use::Off || here.visits < limits.visits {
        return None;
    }
    // Only an action with two ends can tell, so that almost every place is done here.
    let mut outgoing = map.paths.outgoing(place);
    let several = outgoing.any(|(_, link)| map.paths.along(place, link.action).count() > 1);
    if !several {
        return None;
    }
    let images = here.incoming.iter().map(|&id| Image::of(map, id, config));
    let mut rest: Vec<Image> = images.filter(|image| !image.taken.is_empty()).collect();
    if rest.is_empty() {
        return None;
    }
    // The first image and all that agrees with it, directly or through others, against the rest.
    let mut side = Vec::from([rest.remove(0)]);
    let agrees = |side: &[Image], image: &Image| side.iter().any(|other| image.agrees(other));
    while let Some(at) = rest.iter().position(|image| agrees(&side, image)) {
        side.push(rest.remove(at));
    }
    let apart = |one, other| !are_copies(map, one, other, config);
    let contradicted = |one: &Image| rest.iter().any(|other| one.contradicts(other, apart));
    let differ = side.iter().any(contradicted);
    let [weight, others] = [&side, &rest].map(|images| {
        let weights = images.iter().map(Image::weight);
        weights.fold(0, u32::saturating_add)
    });
    (differ && weight.min(others) >= limits.visits).then(|| Diagnosis::Links {
        incoming: rest.iter().map(|image| image.link).collect(),
    })
}

/// Returns whether two ends of one action may be one place, where proofs are required. In a static
/// world the action has one end then, which is on the map twice.
fn are_copies(map: &Diktiometry, one: PlaceId, other: PlaceId, config: &Config) -> bool {
    let is_proved = !config.restructuring.geometric_merge.trusts_paths();
    let offset = || map.displacement(one, other, &config.search);
    let may_be_one = || offset().is_none_or(|offset| offset.contains(Point::origin()));
    is_proved && config.world == WorldKind::Static && may_be_one()
}

/// Links taken after one link.
struct Image {
    link: LinkId,
    taken: Vec<Taken>,
}

/// Link that was taken after another.
struct Taken {
    action: Action,
    to: PlaceId,
    /// Number of times.
    count: u32,
}

impl Image {
    fn of(map: &Diktiometry, link: LinkId, config: &Config) -> Self {
        let then = &map.link(link).then;
        let most = then.iter().map(|one| one.count).max().unwrap_or(0);
        let least = f64::from(most) * config.restructuring.minority;
        let often = then.iter().filter(|one| f64::from(one.count) >= least);
        let taken = often.map(|one| {
            let Link { action, to, .. } = *map.link(one.link);
            let count = one.count;
            Taken { action, to, count }
        });
        let taken = taken.collect();
        Self { link, taken }
    }

    fn weight(&self) -> u32 {
        let counts = self.taken.iter().map(|one| one.count);
        counts.fold(0, u32::saturating_add)
    }

    fn agrees(&self, other: &Self) -> bool {
        self.any(other, |one, two| {
            one.action == two.action && one.to == two.to
        })
    }

    fn contradicts(&self, other: &Self, apart: impl Fn(PlaceId, PlaceId) -> bool) -> bool {
        self.any(other, |one, two| {
            one.action == two.action && one.to != two.to && apart(one.to, two.to)
        })
    }

    fn any(&self, other: &Self, holds: impl Fn(&Taken, &Taken) -> bool) -> bool {
        let mut all = self.taken.iter();
        all.any(|one| other.taken.iter().any(|two| holds(one, two)))
    }
}
