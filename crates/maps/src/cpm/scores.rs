use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::cell::RefCell;

use super::pattern::PatternId;
use super::similarity::Sense;

/// Cache of the similarity of sequences. The hypotheses of a walk ask for the same pairs
/// repeatedly.
#[derive(Debug, Default)]
pub(super) struct Scores(RefCell<BTreeMap<Vec<PatternId>, Row>>);

/// Scores of one sequence against others, in both senses.
type Row = BTreeMap<Vec<PatternId>, BTreeMap<Sense, f64>>;

impl Scores {
    /// Returns the score of a pair, which is computed the first time only. O(length · log pairs)
    /// from then on.
    pub(super) fn of(
        &self,
        one: &[PatternId],
        other: &[PatternId],
        sense: Sense,
        compute: impl FnOnce() -> f64,
    ) -> f64 {
        let known = |rows: &BTreeMap<_, Row>| rows.get(one)?.get(other)?.get(&sense).copied();
        if let Some(score) = known(&self.0.borrow()) {
            return score;
        }
        let score = compute();
        let mut rows = self.0.borrow_mut();
        let row = rows.entry(one.to_vec()).or_default();
        row.entry(other.to_vec()).or_default().insert(sense, score);
        score
    }
}
