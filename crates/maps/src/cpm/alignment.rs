use alloc::vec;
use alloc::vec::Vec;

use super::pattern::{Dictionary, PatternId};

/// Similarity of sequences by edit distance (Wagner, Fischer 1974) in place of position by
/// position.
///
/// Sequences are aligned with insertions, deletions and changes of speed. A pattern may last longer
/// in one of the two, as in dynamic time warping (Sakoe, Chiba 1978). Ours, not the paper's. Costs
/// are fractions of the cost of a complete mismatch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Alignment {
    /// Cost of an observation that the other sequence lacks; 0 to 1.
    pub gap: f64,
    /// Cost of an observation that is repeated in one of the two, added to its difference; 0 to
    /// `gap`.
    pub stutter: f64,
    /// Distance of prototypes from which two patterns have nothing in common, as a fraction of the
    /// dictionary's greatest distance; above 0, at most 1.
    pub unlike: f64,
    /// Similarity above which two fragments are the same, 0 to 1.
    pub threshold: f64,
}

impl Alignment {
    /// Returns the costs chosen on random mazes (see `docs/notebook/cpm.md`).
    #[must_use]
    pub const fn tuned() -> Self {
        Self {
            gap: 1.0,
            stutter: 0.3,
            unlike: 0.6,
            threshold: 0.45,
        }
    }

    /// Returns the similarity of two sequences: 1 less the cheapest alignment's cost for each
    /// position of the longer one. Equal sequences score 1, sequences without anything in common
    /// about 0, and an empty one scores 0. O(length²) and the distances of prototypes.
    #[must_use]
    pub fn score(&self, dictionary: &Dictionary, a: &[PatternId], b: &[PatternId]) -> f64 {
        if a.is_empty() || b.is_empty() {
            return 0.0;
        }
        let unlike = self.unlike * dictionary.greatest_distance();
        let difference = |a: PatternId, b: PatternId| {
            if a == b {
                0.0
            } else if unlike > 0.0 {
                (dictionary.distance(a, b) / unlike).min(1.0)
            } else {
                1.0
            }
        };
        // The cost of an observation of one sequence that stays at what the other has shown last.
        let stay = |difference: f64| self.gap.min(self.stutter + difference);
        let mut row: Vec<f64> = vec![0.0; b.len() + 1];
        for j in 1..=b.len() {
            row[j] = row[j - 1] + self.gap;
        }
        for (i, a) in a.iter().enumerate() {
            let mut diagonal = row[0];
            row[0] = self.gap * (i + 1) as f64;
            for (j, b) in b.iter().enumerate() {
                let difference = difference(*a, *b);
                let along = diagonal + difference;
                let longer_a = row[j + 1] + stay(difference);
                let longer_b = row[j] + stay(difference);
                diagonal = row[j + 1];
                row[j + 1] = along.min(longer_a).min(longer_b);
            }
        }
        let longest = a.len().max(b.len()) as f64;
        1.0 - row[b.len()] / longest
    }
}
