use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;

use super::map::FragmentId;
use super::nodes::Nodes;
use super::pattern::{Dictionary, PatternId};

/// Ranks the fragments of a large map by how promising a comparison is, in the way that texts are
/// ranked. "One can use the 'term frequency-inverse document frequency', *tf-idf*, for
/// path-fragment matching in more complex environment" (section 8).
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FragmentIndex {
    bags: Nodes<FragmentId, Bag>,
}

/// The patterns of a sequence without their order.
#[derive(Clone, Debug, PartialEq)]
struct Bag {
    /// Number of occurrences of each pattern.
    counts: Vec<(PatternId, u32)>,
    length: usize,
}

impl Bag {
    fn of(sequence: &[PatternId]) -> Self {
        let mut counts: BTreeMap<PatternId, u32> = BTreeMap::new();
        for pattern in sequence {
            *counts.entry(*pattern).or_default() += 1;
        }
        Self {
            counts: counts.into_iter().collect(),
            length: sequence.len(),
        }
    }
}

impl FragmentIndex {
    pub(super) fn insert(&mut self, id: FragmentId, patterns: &[PatternId]) {
        self.bags.insert(id, Bag::of(patterns));
    }

    pub(super) fn remove(&mut self, id: FragmentId) {
        self.bags.remove(id);
    }

    /// Returns up to `most` fragments: those that have the most in common with a sequence or its
    /// inverse, best first, ties by id. O(fragments · patterns of each).
    pub(super) fn candidates(
        &self,
        dictionary: &Dictionary,
        sequence: &[PatternId],
        most: usize,
    ) -> Option<Vec<FragmentId>> {
        if self.bags.len() <= most {
            return None;
        }
        let inverse = dictionary.inverse(sequence).unwrap_or_default();
        let [same, inverted] = [sequence, &inverse].map(|sequence| self.in_common(sequence));
        let scores = same.into_iter().zip(inverted).map(|(a, b)| a.max(b));
        let ids = self.bags.iter().map(|(id, _)| id);
        let mut ranked: Vec<(FragmentId, f64)> =
            ids.zip(scores).filter(|(_, score)| *score > 0.0).collect();
        ranked.sort_by(|(_, a), (_, b)| b.total_cmp(a));
        ranked.truncate(most);
        Some(ranked.into_iter().map(|(id, _)| id).collect())
    }

    /// Returns, for each fragment by id, its share of common occurrences with `sequence`. Rare
    /// patterns weigh more. The share is relative to the longer of the two. Otherwise long
    /// fragments would resemble all others.
    fn in_common(&self, sequence: &[PatternId]) -> Vec<f64> {
        let seen = Bag::of(sequence);
        let bags = || self.bags.iter().map(|(_, bag)| bag).chain([&seen]);
        let last = bags().filter_map(|bag| bag.counts.last()).max();
        let patterns = last.map_or(0, |(pattern, _)| pattern.0 as usize + 1);
        let mut fragments = vec![0_u32; patterns];
        for (pattern, _) in self.bags.iter().flat_map(|(_, bag)| &bag.counts) {
            fragments[pattern.0 as usize] += 1;
        }
        // By pattern, how often it is in the sequence, and what each time is worth.
        let mut worth = vec![(0, 0.0); patterns];
        for (pattern, count) in &seen.counts {
            let pattern = pattern.0 as usize;
            let fragments = fragments[pattern].max(1);
            let rarity = libm::log(1.0 + self.bags.len() as f64 / f64::from(fragments));
            worth[pattern] = (*count, rarity);
        }
        let shares = self.bags.iter().map(|(_, bag)| {
            let common = bag.counts.iter().map(|(pattern, there)| {
                let (count, rarity) = worth[pattern.0 as usize];
                rarity * f64::from(count.min(*there))
            });
            common.sum::<f64>() / bag.length.max(sequence.len()).max(1) as f64
        });
        shares.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Common occurrences by pairing them off one by one, each worth log(1 + fragments / those that
    /// have the pattern).
    #[test]
    fn rare_patterns_weigh_more_and_long_fragments_less() {
        let of = |patterns: &[u32]| patterns.iter().copied().map(PatternId).collect::<Vec<_>>();
        let fragments = [
            of(&[0, 0, 1, 2]),
            of(&[0, 3]),
            of(&[4, 4, 4, 0, 1]),
            of(&[5]),
        ];
        let mut index = FragmentIndex::default();
        for (id, fragment) in (0..).zip(&fragments) {
            index.insert(FragmentId(id), fragment);
        }
        for sequence in [of(&[0, 1]), of(&[4, 4, 0, 0, 0, 7]), of(&[6]), of(&[])] {
            let found = index.in_common(&sequence);
            assert_eq!(found.len(), fragments.len());
            for (fragment, found) in fragments.iter().zip(found) {
                let mut left = fragment.clone();
                let mut sum = 0.0;
                for pattern in &sequence {
                    if let Some(place) = left.iter().position(|other| other == pattern) {
                        left.swap_remove(place);
                        let having = fragments.iter().filter(|other| other.contains(pattern));
                        sum += f64::ln(1.0 + 4.0 / having.count() as f64);
                    }
                }
                let expected = sum / fragment.len().max(sequence.len()) as f64;
                assert!(
                    (found - expected).abs() < 1e-12,
                    "{fragment:?} {sequence:?}"
                );
            }
        }
    }

    /// Long fragments share some patterns with all. The same, nearly the same or inverted fragment
    /// still comes first.
    #[test]
    fn the_most_alike_comes_first() {
        let mut dictionary = Dictionary::new(1);
        for pattern in 0..20 {
            let feature = f64::from(pattern);
            dictionary
                .learn(&[feature], &[-feature - 1.0], 0.0)
                .unwrap();
        }
        let sequence = |id: u32| -> Vec<PatternId> {
            let length = if id.is_multiple_of(3) { 60 } else { 4 + id % 5 };
            (0..length)
                .map(|place| PatternId((id * 7 + place * (1 + id % 11)) % 40))
                .collect()
        };
        let mut index = FragmentIndex::default();
        for id in 0..50 {
            index.insert(FragmentId(id), &sequence(id));
        }
        for id in 0..50 {
            let mut seen = sequence(id);
            let inverse = dictionary.inverse(&seen).unwrap();
            seen.push(PatternId(39));
            for seen in [sequence(id), seen, inverse] {
                let found = index.candidates(&dictionary, &seen, 4).unwrap();
                assert!(found.contains(&FragmentId(id)), "{id}: {found:?}");
            }
        }
        assert_eq!(index.candidates(&dictionary, &sequence(0), 50), None);
        index.remove(FragmentId(7));
        let found = index.candidates(&dictionary, &sequence(7), 49);
        assert_eq!(found, None);
        let found = index
            .candidates(&dictionary, &sequence(7), 48)
            .unwrap_or(vec![]);
        assert!(!found.contains(&FragmentId(7)));
    }
}
