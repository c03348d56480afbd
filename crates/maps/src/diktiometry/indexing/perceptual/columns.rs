use alloc::vec;
use alloc::vec::Vec;

use super::Vote;
use super::feature_tree::{Feature, FeatureTree};
use crate::diktiometry::{Signature, SignatureKind, ViewRotation};

/// Index of all views of all places, by their columns: "an input signature's columns are used to
/// index the columns close to them, marking each signature found at the offset implied by the
/// column match. When enough of a database signature's columns have been marked, the signature's
/// place is suggested as a match candidate."
///
/// The result is the paper's, the method is not. One column says little, so columns are indexed in
/// groups. If `enough` columns agree, at least one of `columns - enough + 1` groups agrees as a
/// whole: the others are too few to spoil each group. Only views that share a group with the
/// percept are compared with it column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ColumnIndex {
    /// One tree per group, or a single one for groups beginning at any column if views may be
    /// rotated.
    trees: Vec<FeatureTree>,
    /// Views in order of insertion; the index is the view's number.
    views: Vec<Signature>,
}

impl ColumnIndex {
    /// Inserts a view. O(groups · log² views), amortized.
    pub(super) fn insert(&mut self, view: &Signature, kind: &SignatureKind) {
        let number = self.views.len() as u32;
        self.views.push(view.clone());
        let groups = Groups::of(kind);
        let turned = kind.rotation == ViewRotation::Free;
        self.trees
            .resize_with(if turned { 1 } else { groups.count }, FeatureTree::default);
        let starts: Vec<usize> = if turned {
            (0..kind.columns).collect()
        } else {
            groups.starts().collect()
        };
        let trees = self.trees.len();
        for (at, start) in starts.into_iter().enumerate() {
            self.trees[at % trees].insert(Feature {
                values: groups.values(view, start),
                view: number,
                column: start as u32,
            });
        }
    }

    /// Returns the views with enough columns near those of a percept, within a hypercube of `size`
    /// tolerances.
    pub(super) fn within(&self, percept: &Signature, kind: &SignatureKind, size: f64) -> Vec<u32> {
        let groups = Groups::of(kind);
        let tolerance = kind.tolerance * size;
        let half_sizes = vec![tolerance; groups.size * kind.rows];
        let mut votes = Vec::new();
        // One tree answers for all groups where views may be turned.
        let trees = self.trees.iter().cycle();
        for (start, tree) in groups.starts().zip(trees) {
            tree.within(&groups.values(percept, start), &half_sizes, |known| {
                votes.push(Vote::of(known, start as u32, kind.columns));
            });
        }
        votes.sort_unstable();
        votes.dedup();
        let agrees = |vote: &Vote| {
            let view = &self.views[vote.view as usize];
            percept.agreement(view, vote.offset as usize, tolerance) >= kind.enough()
        };
        let elected = votes.iter().filter(|vote| agrees(vote));
        elected.map(|vote| vote.view).collect()
    }
}

/// Neighbouring columns that are indexed together.
struct Groups {
    count: usize,
    /// Number of columns in each group.
    size: usize,
}

impl Groups {
    fn of(kind: &SignatureKind) -> Self {
        let count = kind.columns - kind.enough() + 1;
        let size = kind.columns / count;
        Self { count, size }
    }

    /// Returns the first column of each group.
    fn starts(&self) -> impl Iterator<Item = usize> + use<> {
        let size = self.size;
        (0..self.count).map(move |group| group * size)
    }

    /// Returns the values of the columns of a group that begins at `start`, round the circle.
    fn values(&self, view: &Signature, start: usize) -> Vec<f64> {
        let columns = (start..start + self.size).map(|column| column % view.columns());
        let values = columns.flat_map(|column| view.column(column));
        values.copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const ROWS: usize = 2;
    const COLUMNS: usize = 7;

    fn view() -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec((0_i8..3).prop_map(f64::from), ROWS * COLUMNS)
    }

    proptest! {
        /// Checks that the index finds the same views as a comparison with all.
        #[test]
        fn it_finds_all_that_look_alike(
            views in prop::collection::vec(view(), 1..100),
            percept in view(),
            share in 0.1..1.0,
            tolerance in 0.0..2.0,
            turned in any::<bool>(),
        ) {
            let rotation = if turned { ViewRotation::Free } else { ViewRotation::Aligned };
            let kind = SignatureKind { rows: ROWS, columns: COLUMNS, tolerance, share, rotation, views: 1 };
            let signature = |values: &Vec<f64>| Signature::new(ROWS, values.clone()).unwrap();
            let percept = signature(&percept);
            let mut index = ColumnIndex::default();
            let mut expected = Vec::new();
            let offsets = if turned { COLUMNS } else { 1 };
            let alike = |view: &Signature| {
                (0..offsets).any(|offset| {
                    percept.agreement(view, offset, tolerance) >= kind.enough()
                })
            };
            for (number, view) in (0..).zip(views.iter().map(signature)) {
                index.insert(&view, &kind);
                if alike(&view) {
                    expected.push(number);
                }
            }
            let mut found = index.within(&percept, &kind, 1.0);
            found.dedup();
            prop_assert_eq!(found, expected);
        }
    }
}
