use alloc::vec::Vec;

use super::feature_tree::{Feature, FeatureTree};
use super::{Vote, elected};
use crate::diktiometry::config::SignatureKind;
use crate::diktiometry::ids::PlaceId;
use crate::diktiometry::path_graph::PathGraph;
use crate::diktiometry::signature::Signature;

/// All views of all places, by their columns: "an input signature's columns are used to index the columns close to them,
/// marking each signature found at the offset implied by the column match. When enough of a database signature's
/// columns have been marked, the signature's place is suggested as a match candidate."
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ColumnIndex {
    tree: FeatureTree,
    /// Whose view it is, by number of the view.
    views: Vec<PlaceId>,
}

impl ColumnIndex {
    /// Takes in a view of a place. O(columns · log columns), and now and then all of them anew.
    pub(super) fn insert(&mut self, place: PlaceId, view: &Signature) {
        let number = self.views.len() as u32;
        self.views.push(place);
        for column in 0..view.columns() {
            self.tree.insert(Feature {
                values: view.column(column).to_vec(),
                view: number,
                column: column as u32,
            });
        }
    }

    /// The places with a view whose columns are near enough to those of a percept in a hypercube of `size` tolerances.
    pub(super) fn within(
        &self,
        percept: &Signature,
        kind: &SignatureKind,
        paths: &PathGraph,
        size: f64,
    ) -> Vec<PlaceId> {
        let columns = percept.columns();
        let enough = libm::ceil(kind.share * columns as f64 - 1e-9) as usize;
        let half_sizes = alloc::vec![kind.tolerance * size; kind.rows];
        let mut votes = Vec::new();
        for column in 0..columns {
            let values = percept.column(column);
            self.tree.within(values, &half_sizes, |known| {
                votes.push(Vote::of(known, column as u32, columns));
            });
        }
        let place = |view: u32| self.views[view as usize];
        elected(votes, kind.rotation, |_| enough, place, paths)
    }
}
