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
    fragments: usize,
}

impl FragmentIndex {
    pub(super) fn insert(&mut self, id: FragmentId, patterns: &[PatternId]) {
        self.fragments += 1;
        for pattern in patterns {
            let posting = self.postings.entry(*pattern).or_default();
            *posting.entry(id).or_default() += 1;
        }
    }

    pub(super) fn remove(&mut self, id: FragmentId, patterns: &[PatternId]) {
        self.fragments -= 1;
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
        if self.fragments <= most {
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

    /// For each fragment, the occurrences of patterns it shares with a sequence, the rarer the more.
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
            let rarity = libm::log(1.0 + self.fragments as f64 / posting.len() as f64);
            for (id, there) in posting {
                *common.entry(*id).or_default() += rarity * f64::from(count.min(*there));
            }
        }
        common
    }
}
