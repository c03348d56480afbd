use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use super::map::FragmentId;
use super::pattern::{Dictionary, PatternId};

/// Which fragments of a large map are worth comparing: an inverted index, as of text. "One can use the 'term frequency-inverse
/// document frequency', *tf-idf*, for path-fragment matching in more complex environment" (section 8).
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FragmentIndex {
    /// How often a pattern is in each fragment that has it.
    postings: BTreeMap<PatternId, BTreeMap<FragmentId, u32>>,
    lengths: BTreeMap<FragmentId, usize>,
}

impl FragmentIndex {
    pub(super) fn insert(&mut self, id: FragmentId, patterns: &[PatternId]) {
        self.lengths.insert(id, patterns.len());
        for pattern in patterns {
            let posting = self.postings.entry(*pattern).or_default();
            *posting.entry(id).or_default() += 1;
        }
    }

    pub(super) fn remove(&mut self, id: FragmentId, patterns: &[PatternId]) {
        self.lengths.remove(&id);
        for pattern in patterns {
            if let Some(posting) = self.postings.get_mut(pattern) {
                posting.remove(&id);
            }
        }
    }

    /// At most so many fragments that have the most in common with a sequence or its inverse, best first, ties by id. All
    /// if there are no more than that. O(fragments that share a pattern · length).
    pub(super) fn candidates(
        &self,
        dictionary: &Dictionary,
        sequence: &[PatternId],
        most: usize,
    ) -> Option<Vec<FragmentId>> {
        if self.lengths.len() <= most {
            return None;
        }
        let inverse = dictionary.inverse(sequence).unwrap_or_default();
        let mut best: BTreeMap<FragmentId, f64> = BTreeMap::new();
        for sequence in [sequence, &inverse] {
            for (id, common) in self.in_common(sequence) {
                let score = best.entry(id).or_default();
                *score = score.max(common);
            }
        }
        let mut ranked: Vec<(FragmentId, f64)> = best.into_iter().collect();
        ranked.sort_by(|(_, a), (_, b)| b.total_cmp(a));
        ranked.truncate(most);
        Some(ranked.into_iter().map(|(id, _)| id).collect())
    }

    /// For each fragment, the occurrences of patterns it shares with a sequence, the rarer the more, as a part of the longer of the
    /// two: else long fragments would have something in common with all.
    fn in_common(&self, sequence: &[PatternId]) -> BTreeMap<FragmentId, f64> {
        let mut counts: BTreeMap<PatternId, u32> = BTreeMap::new();
        for pattern in sequence {
            *counts.entry(*pattern).or_default() += 1;
        }
        let mut common: BTreeMap<FragmentId, f64> = BTreeMap::new();
        for (pattern, count) in counts {
            let Some(posting) = self
                .postings
                .get(&pattern)
                .filter(|posting| !posting.is_empty())
            else {
                continue;
            };
            let rarity = libm::log(1.0 + self.lengths.len() as f64 / posting.len() as f64);
            for (id, there) in posting {
                *common.entry(*id).or_default() += rarity * f64::from(count.min(*there));
            }
        }
        for (id, common) in &mut common {
            let length = self.lengths.get(id).copied().unwrap_or(0);
            *common /= length.max(sequence.len()).max(1) as f64;
        }
        common
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use super::*;

    /// Long fragments share some patterns with all; the one that is the same, or nearly or inverted, comes first all the same.
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
        index.remove(FragmentId(7), &sequence(7));
        let found = index.candidates(&dictionary, &sequence(7), 49);
        assert_eq!(found, None);
        let found = index
            .candidates(&dictionary, &sequence(7), 48)
            .unwrap_or(vec![]);
        assert!(!found.contains(&FragmentId(7)));
    }
}
