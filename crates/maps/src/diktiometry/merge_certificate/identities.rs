use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use crate::diktiometry::{Action, Config, WorldKind};

/// Visits known to be to one place, with all consequences. In a static world an action leads from
/// one place to one place, and its reverse back.
///
/// A class is named by the number of any visit in it.
#[derive(Clone, Debug)]
pub(super) struct Identities<'a> {
    config: &'a Config,
    /// For each visit, another visit of its class, or itself.
    parents: Vec<usize>,
    /// For each visit that represents a class, the visits to which actions lead from it.
    leads: Vec<BTreeMap<Action, usize>>,
}

/// Two classes have become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Joined {
    /// Visit that represents both.
    pub(super) kept: usize,
    /// Visit that represented the other class.
    pub(super) lost: usize,
}

impl<'a> Identities<'a> {
    /// Returns the initial state, with visit 0 only.
    pub(super) fn new(config: &'a Config) -> Self {
        Self {
            config,
            parents: Vec::from([0]),
            leads: Vec::from([BTreeMap::new()]),
        }
    }

    /// Returns the number of visits.
    pub(super) const fn len(&self) -> usize {
        self.parents.len()
    }

    /// Returns the visit that represents the class of a visit: the first of the class. O(joins) at
    /// worst.
    pub(super) fn find(&self, mut visit: usize) -> usize {
        while self.parents[visit] != visit {
            visit = self.parents[visit];
        }
        visit
    }

    /// Returns whether two visits are known to be to one place.
    pub(super) fn same(&self, one: usize, other: usize) -> bool {
        self.find(one) == self.find(other)
    }

    /// Returns the visit to which an action leads from the place of `visit`, or `None` if it is
    /// unknown.
    pub(super) fn leads(&self, visit: usize, action: Action) -> Option<usize> {
        let to = self.leads[self.find(visit)].get(&action)?;
        Some(self.find(*to))
    }

    /// Returns the actions taken from the place of a visit, each with the visit to which it led.
    pub(super) fn ways(&self, visit: usize) -> impl Iterator<Item = (Action, usize)> {
        let ways = self.leads[self.find(visit)].iter();
        ways.map(|(action, to)| (*action, self.find(*to)))
    }

    /// Takes in a visit after a blocked action: the robot has not moved.
    pub(super) fn stay(&mut self) {
        self.parents.push(self.find(self.len() - 1));
        self.leads.push(BTreeMap::new());
    }

    /// Takes in a visit after a successful action, and returns the classes that it joins.
    pub(super) fn arrive(&mut self, action: Action) -> Vec<Joined> {
        let (from, to) = (self.find(self.len() - 1), self.len());
        self.parents.push(to);
        self.leads.push(BTreeMap::new());
        let mut equal = Vec::new();
        equal.extend(self.lead(from, action, to));
        if let Some(back) = self.config.reverse(action)
            && self.config.world == WorldKind::Static
        {
            equal.extend(self.lead(to, back, from));
        }
        self.join_all(equal)
    }

    /// Takes in that two visits are to one place, and returns the classes that it joins.
    pub(super) fn join(&mut self, one: usize, other: usize) -> Vec<Joined> {
        self.join_all(Vec::from([[one, other]]))
    }

    /// Records that an action leads from one visit to another. Returns the pairs that are one place
    /// in a static world.
    fn lead(&mut self, from: usize, action: Action, to: usize) -> Option<[usize; 2]> {
        let known = self.leads[from].insert(action, to)?;
        (self.config.world == WorldKind::Static).then_some([known, to])
    }

    fn join_all(&mut self, mut equal: Vec<[usize; 2]>) -> Vec<Joined> {
        let mut joined = Vec::new();
        while let Some(pair) = equal.pop() {
            let [one, other] = pair.map(|visit| self.find(visit));
            if one == other {
                continue;
            }
            let (kept, lost) = (one.min(other), one.max(other));
            self.parents[lost] = kept;
            for (action, to) in core::mem::take(&mut self.leads[lost]) {
                equal.extend(self.lead(kept, action, to));
            }
            joined.push(Joined { kept, lost });
        }
        joined
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Computes the classes directly by the rules. Visits after the same action from one place are
    /// to one place, and so is a visit to which a reverse leads back.
    fn by_the_letter(config: &Config, actions: &[Action], joined: &[[usize; 2]]) -> Vec<usize> {
        let mut class: Vec<usize> = (0..=actions.len()).collect();
        let rename = |class: &mut Vec<usize>, one: usize, other: usize| {
            let (new, old) = (class[one].min(class[other]), class[one].max(class[other]));
            class
                .iter_mut()
                .filter(|name| **name == old)
                .for_each(|name| *name = new);
            new != old
        };
        for [one, other] in joined {
            rename(&mut class, *one, *other);
        }
        // Each move as it was made, and back.
        let forth = (0..)
            .zip(actions)
            .map(|(from, action)| (from, *action, from + 1));
        let back = forth
            .clone()
            .filter_map(|(from, action, to)| Some((to, config.reverse(action)?, from)));
        let ways: Vec<(usize, Action, usize)> = forth.chain(back).collect();
        loop {
            let mut changed = false;
            for &(from, action, to) in &ways {
                for &(other_from, other_action, other_to) in &ways {
                    if action == other_action && class[from] == class[other_from] {
                        changed |= rename(&mut class, to, other_to);
                    }
                }
            }
            if !changed {
                return class;
            }
        }
    }

    proptest! {
        #[test]
        fn all_that_follows_is_known_and_nothing_else(
            actions in prop::collection::vec(0_u32..4, 1..25),
            pairs in prop::collection::vec((0_usize..26, 0_usize..26), 0..4),
        ) {
            let mut config = Config::new(Config::compass_actions(), 1.0);
            config.world = WorldKind::Static;
            let actions: Vec<Action> = actions.into_iter().map(Action).collect();
            let last = actions.len();
            let pairs: Vec<[usize; 2]> = pairs.into_iter().map(|(a, b)| [a.min(last), b.min(last)]).collect();
            let mut identities = Identities::new(&config);
            for action in &actions {
                identities.arrive(*action);
            }
            for [one, other] in &pairs {
                identities.join(*one, *other);
            }
            let class = by_the_letter(&config, &actions, &pairs);
            for one in 0..=last {
                for other in 0..=last {
                    prop_assert_eq!(identities.same(one, other), class[one] == class[other]);
                }
            }
        }
    }

    #[test]
    fn nothing_follows_where_the_world_may_change() {
        let config = Config::new(Config::compass_actions(), 1.0);
        let mut identities = Identities::new(&config);
        assert!(identities.arrive(Action(0)).is_empty());
        assert!(identities.arrive(Action(2)).is_empty());
        assert!(!identities.same(0, 2));
        identities.stay();
        assert!(identities.same(2, 3));
    }
}
