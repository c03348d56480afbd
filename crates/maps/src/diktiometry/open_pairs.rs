use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};

use super::{Action, Diktiometry, Observer, PlaceId, share_a_view};

/// Two places of a map that may be one, and what would decide whether they are.
///
/// Beyond the paper. The bounds allow both, the places look alike, and so do all places along the
/// same actions from both.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenPair {
    /// The older place.
    pub older: PlaceId,
    /// The newer place.
    pub newer: PlaceId,
    /// Where the newer place lies as seen from the older one, m; `None` if they are not related. It
    /// decides once it excludes that they are one, or is too narrow for two places.
    pub offset: Option<PointBox>,
    /// Walk that would decide, if its end looks or bars otherwise than known; `None` if all ways
    /// from one of the places are known from the other too.
    pub walk: Option<DecidingWalk>,
}

/// A walk from one of two places to where the map knows more from the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DecidingWalk {
    /// Place from which it leads.
    pub from: PlaceId,
    /// Actions. All but the last were tried; the last was tried only along the same walk from the
    /// other place.
    pub actions: Vec<Action>,
}

/// Two places at the ends of the same actions, from two places that may be one.
#[derive(Clone, Copy)]
struct Joint {
    places: (PlaceId, PlaceId),
    /// Index of the joint before, and the action from there; `None` for the first.
    after: Option<(usize, Action)>,
}

/// Maximum number of pairs of places that are compared before two count as different.
const COMPARED: usize = 256;

impl Observer {
    /// Returns all pairs of places that may be one, in order of the newer place. O(places · a
    /// search, and for each pair near each other · ways from both).
    #[must_use]
    pub fn open_pairs(&self) -> Vec<OpenPair> {
        let places = self.map.paths.places().map(|(newer, _)| newer);
        let pairs = places.flat_map(|newer| {
            let mut older = self.near(newer);
            older.retain(|older| *older < newer);
            older.sort_unstable();
            older.into_iter().map(move |older| (older, newer))
        });
        let open = pairs.filter_map(|(older, newer)| {
            let joints = self.joints(older, newer)?;
            Some(OpenPair {
                older,
                newer,
                offset: self.map.related(older, newer),
                walk: self.deciding_walk(&joints),
            })
        });
        open.collect()
    }

    /// Returns whether two places may be one by everything along the same actions.
    pub(super) fn may_be_one(&self, one: PlaceId, other: PlaceId) -> bool {
        self.joints(one, other).is_some()
    }

    /// Returns the places along the same actions from two places; `None` if the two cannot be one.
    fn joints(&self, one: PlaceId, other: PlaceId) -> Option<Vec<Joint>> {
        let first = Joint {
            places: (one, other),
            after: None,
        };
        let mut joints = Vec::from([first]);
        let mut next = 0;
        while let Some(&Joint { places: (a, b), .. }) = joints.get(next) {
            if !self.seem_one(a, b) {
                return None;
            }
            for (_, way) in self.map.paths.ways(a) {
                let mut others = self.map.paths.ways(b);
                let Some((_, same)) = others.find(|(_, same)| same.action == way.action) else {
                    continue;
                };
                let places = (way.to, same.to);
                let is_known = || joints.iter().any(|joint| joint.places == places);
                if places.0 != places.1 && joints.len() < COMPARED && !is_known() {
                    let after = Some((next, way.action));
                    joints.push(Joint { places, after });
                }
            }
            next += 1;
        }
        Some(joints)
    }

    /// Returns whether two places look alike and may be one by the relation of their frames.
    fn seem_one(&self, a: PlaceId, b: PlaceId) -> bool {
        let map: &Diktiometry = &self.map;
        let [one, other] = [a, b].map(|place| map.place(place));
        let offset = map.related(a, b);
        self.config.may_be_same([&one.exits, &other.exits])
            && offset.is_none_or(|offset| offset.contains(Point::origin()))
            && share_a_view(one, other, &self.config.percepts)
    }

    /// Returns the shortest walk from one of the first two places to an action that was tried along
    /// the same walk from the other only.
    fn deciding_walk(&self, joints: &[Joint]) -> Option<DecidingWalk> {
        let first = joints.first()?.places;
        let mut steps = joints.iter().enumerate().flat_map(|(index, joint)| {
            let (a, b) = joint.places;
            [(index, a, b, first.1), (index, b, a, first.0)]
        });
        steps.find_map(|(index, known, unknown, from)| {
            let mut ways = self.map.paths.ways(known).map(|(_, way)| way.action);
            let untried = self.untried(unknown);
            let last = ways.find(|action| untried.contains(action))?;
            let mut actions = Vec::from([last]);
            let mut at = joints[index].after;
            while let Some((before, action)) = at {
                actions.push(action);
                at = joints[before].after;
            }
            actions.reverse();
            Some(DecidingWalk { from, actions })
        })
    }
}
