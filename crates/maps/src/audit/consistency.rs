//! Compares closures in pairs and finds the greatest consistent groups of them.
//!
//! Source: the idea of pairwise consistency is that of J. Mangelson et al.: Pairwise Consistent
//! Measurement Set Maximization for Robust Multi-robot Map Merging, 2018. Deviation: the set is
//! found greedily.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;
use core::cmp::Reverse;

use super::AuditConfig;
use super::chain::Chain;
use super::groups::Groups;
use super::link::Link;

/// Verdict of odometry alone on a closure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ByOdometry {
    /// Odometry does not join the closure's poses, or its bounds are too wide.
    Silent,
    /// The closure agrees, and is tight.
    Supports,
    /// The closure disagrees.
    Refutes,
}

impl ByOdometry {
    pub(super) fn of(link: &Link, chain: &Chain, config: &AuditConfig) -> Self {
        match link.gap_to_odometry(chain) {
            Some(gap) if gap.refutes_over(chain.doubt(link.first, link.second, config), config) => {
                Self::Refutes
            }
            Some(gap) if gap.supports(config) => Self::Supports,
            _ => Self::Silent,
        }
    }
}

/// Pairs of closures that agree or conflict.
pub(super) struct Pairs {
    /// Closures within whose bounds each closure lies, tightly.
    pub(super) agreeing: Vec<Vec<u32>>,
    /// Closures beyond whose bounds each closure lies.
    conflicting: Vec<Vec<u32>>,
}

impl Pairs {
    /// Compares each closure that odometry does not refute with those that begin and end near it.
    /// O(pairs).
    pub(super) fn of(
        links: &[Link],
        by_odometry: &[ByOdometry],
        chain: &Chain,
        config: &AuditConfig,
    ) -> Self {
        let mut pairs = Self {
            agreeing: alloc::vec![Vec::new(); links.len()],
            conflicting: alloc::vec![Vec::new(); links.len()],
        };
        let is_open = |index: usize| by_odometry[index] != ByOdometry::Refutes;
        for a in (0..links.len()).filter(|index| is_open(*index)) {
            let near = |b: &usize| links[*b].first - links[a].first <= config.pair_gap;
            for b in (a + 1..links.len()).take_while(near) {
                if is_open(b) {
                    pairs.compare(a, b, links, chain, config);
                }
            }
        }
        pairs
    }

    fn compare(&mut self, a: usize, b: usize, links: &[Link], chain: &Chain, config: &AuditConfig) {
        let apart = [
            links[a].first.abs_diff(links[b].first),
            links[a].second.abs_diff(links[b].second),
        ];
        // Neighbours are the same observation made twice.
        if apart[1] > config.pair_gap || (apart[0] <= 1 && apart[1] <= 1) {
            return;
        }
        let Some(gap) = links[a].gap_to(&links[b], chain) else {
            return;
        };
        let both = if gap.refutes(config) {
            &mut self.conflicting
        } else if gap.is_tight(config) {
            &mut self.agreeing
        } else {
            return;
        };
        both[a].push(b as u32);
        both[b].push(a as u32);
    }

    /// Returns groups of candidates without conflicts, joined by agreement, the largest first. A
    /// member that odometry supports counts six times. Conflicts are resolved by dropping, one by
    /// one, the closure with the most conflicts minus agreements. O(pairs · log closures).
    pub(super) fn groups(
        &self,
        is_candidate: &[bool],
        by_odometry: &[ByOdometry],
    ) -> Vec<Vec<u32>> {
        let lives = self.without_conflicts(is_candidate, by_odometry);
        let mut groups = Groups::new(lives.len());
        for (a, agreeing) in self.agreeing.iter().enumerate().filter(|(a, _)| lives[*a]) {
            for b in agreeing.iter().filter(|b| lives[**b as usize]) {
                groups.join(a, *b as usize);
            }
        }
        let mut members: Vec<Vec<u32>> = alloc::vec![Vec::new(); lives.len()];
        for one in (0..lives.len()).filter(|one| lives[*one]) {
            members[groups.find(one)].push(one as u32);
        }
        members.retain(|members| !members.is_empty());
        let witnessed = |one: &&u32| by_odometry[**one as usize] == ByOdometry::Supports;
        members.sort_by_cached_key(|members| {
            Reverse(members.len() + 5 * members.iter().filter(witnessed).count())
        });
        members
    }

    fn without_conflicts(&self, is_candidate: &[bool], by_odometry: &[ByOdometry]) -> Vec<bool> {
        let mut lives = is_candidate.to_vec();
        let count = |others: &Vec<u32>| {
            let living = others.iter().filter(|other| is_candidate[**other as usize]);
            living.count() as i64
        };
        let mut conflicts: Vec<i64> = self.conflicting.iter().map(count).collect();
        let mut friends: Vec<i64> = self.agreeing.iter().map(count).collect();
        for (friends, by) in friends.iter_mut().zip(by_odometry) {
            *friends += 3 * i64::from(*by == ByOdometry::Supports);
        }
        let doubted = (0..lives.len()).filter(|one| lives[*one] && conflicts[*one] > 0);
        let mut heap: BinaryHeap<Reverse<(i64, usize)>> = doubted
            .map(|one| Reverse((friends[one] - conflicts[one], one)))
            .collect();
        while let Some(Reverse((standing, one))) = heap.pop() {
            let is_out_of_date = standing != friends[one] - conflicts[one];
            if !lives[one] || conflicts[one] == 0 {
                continue;
            }
            if is_out_of_date {
                heap.push(Reverse((friends[one] - conflicts[one], one)));
                continue;
            }
            lives[one] = false;
            for other in &self.agreeing[one] {
                friends[*other as usize] -= 1;
            }
            for other in self.conflicting[one].iter().map(|other| *other as usize) {
                conflicts[other] -= 1;
                if lives[other] && conflicts[other] > 0 {
                    heap.push(Reverse((friends[other] - conflicts[other], other)));
                }
            }
        }
        lives
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Returns pairs of `count` closures.
    fn pairs(count: usize, agreeing: &[(u32, u32)], conflicting: &[(u32, u32)]) -> Pairs {
        let both = |all: &[(u32, u32)]| {
            let mut by_closure = alloc::vec![Vec::new(); count];
            for (a, b) in all {
                by_closure[*a as usize].push(*b);
                by_closure[*b as usize].push(*a);
            }
            by_closure
        };
        Pairs {
            agreeing: both(agreeing),
            conflicting: both(conflicting),
        }
    }

    fn any_pairs() -> impl Strategy<Value = Vec<(u32, u32)>> {
        prop::collection::vec((0..8_u32, 0..8_u32), 0..14).prop_map(|pairs| {
            let mut pairs: Vec<(u32, u32)> = pairs.into_iter().filter(|(a, b)| a < b).collect();
            pairs.sort_unstable();
            pairs.dedup();
            pairs
        })
    }

    proptest! {
        #[test]
        fn groups_hold_candidates_without_conflicts_that_hang_together(
            agreeing in any_pairs(),
            conflicting in any_pairs(),
            candidates in prop::collection::vec(prop::bool::weighted(0.8), 8),
            supported in prop::collection::vec(any::<bool>(), 8),
        ) {
            let by = supported.iter().map(|supported| match supported {
                true => ByOdometry::Supports,
                false => ByOdometry::Silent,
            });
            let by: Vec<ByOdometry> = by.collect();
            let conflicting: Vec<_> = conflicting.into_iter().filter(|pair| !agreeing.contains(pair)).collect();
            let groups = pairs(8, &agreeing, &conflicting).groups(&candidates, &by);
            let of = |one: u32| groups.iter().position(|group| group.contains(&one));
            for (a, b) in &conflicting {
                prop_assert!(of(*a).is_none() || of(*b).is_none(), "{groups:?}");
            }
            for one in 0..8_u32 {
                let is_free = !conflicting.iter().any(|(a, b)| *a == one || *b == one);
                prop_assert!(of(one).is_none() || candidates[one as usize]);
                prop_assert!(of(one).is_some() || !candidates[one as usize] || !is_free);
            }
            for (a, b) in &agreeing {
                if let (Some(a), Some(b)) = (of(*a), of(*b)) {
                    prop_assert_eq!(a, b);
                }
            }
            for group in &groups {
                // From the first all others are reached.
                let mut reached = Vec::from([group[0]]);
                for _ in 0..8 {
                    for (a, b) in &agreeing {
                        for (from, to) in [(a, b), (b, a)] {
                            if reached.contains(from) && group.contains(to) && !reached.contains(to) {
                                reached.push(*to);
                            }
                        }
                    }
                }
                prop_assert_eq!(reached.len(), group.len());
            }
            let worth = |group: &Vec<u32>| {
                group.iter().map(|one| if supported[*one as usize] { 6 } else { 1 }).sum::<usize>()
            };
            prop_assert!(groups.windows(2).all(|pair| worth(&pair[0]) >= worth(&pair[1])));
        }
    }

    #[test]
    fn the_closure_with_most_conflicts_and_fewest_friends_is_dropped() {
        let silent = [ByOdometry::Silent; 6];
        let all = [true; 6];
        // 0 conflicts with three that agree.
        let groups = pairs(6, &[(1, 2), (2, 3)], &[(0, 1), (0, 2), (0, 3)]).groups(&all, &silent);
        assert_eq!(groups, [&[1, 2, 3][..], &[4], &[5]]);
        // 5 has two friends, which is more than 0 has.
        let groups = pairs(6, &[(1, 5), (2, 5)], &[(0, 5)]).groups(&all, &silent);
        assert_eq!(groups, [&[1, 2, 5][..], &[3], &[4]]);
        // Odometry counts as three friends, and only that of the supported one.
        let mut by = silent;
        by[0] = ByOdometry::Supports;
        let groups = pairs(6, &[(1, 5), (2, 5)], &[(0, 5)]).groups(&all, &by);
        assert_eq!(groups, [&[0][..], &[1], &[2], &[3], &[4]]);
        let four = [(1, 5), (2, 5), (3, 5), (4, 5)];
        let groups = pairs(6, &four, &[(0, 5)]).groups(&all, &by);
        assert_eq!(groups, [&[1, 2, 3, 4, 5]]);
    }
}
