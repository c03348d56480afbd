use alloc::vec::Vec;

use super::column_tree::{Column, ColumnTree};
use crate::diktiometry::config::{Percepts, Rotation};
use crate::diktiometry::ids::PlaceId;
use crate::diktiometry::path_graph::PathGraph;
use crate::diktiometry::signature::Signature;

/// How often the hypercube's size is doubled at most: from the tolerance to eight times it.
const DOUBLINGS: u32 = 3;

/// All views of all places, by their columns: "an input signature's columns are used to index the columns close to them,
/// marking each signature found at the offset implied by the column match. When enough of a database signature's
/// columns have been marked, the signature's place is suggested as a match candidate."
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::diktiometry) struct ViewIndex {
    tree: ColumnTree,
    /// Whose view it is, by number of the view.
    views: Vec<PlaceId>,
}

impl ViewIndex {
    /// Takes in a view of a place. O(columns · log columns), and now and then all of them anew.
    pub(in crate::diktiometry) fn insert(&mut self, place: PlaceId, view: &Signature) {
        let number = self.views.len() as u32;
        self.views.push(place);
        for column in 0..view.columns() {
            self.tree.insert(Column {
                values: view.column(column).to_vec(),
                view: number,
                column: column as u32,
            });
        }
    }

    /// The places that look most like a percept: the first of the sets that an "iteratively growing hypercube" finds which is not
    /// empty. Nobody asks for the sets after it. The places are those that stand now, by id.
    pub(in crate::diktiometry) fn most_alike(
        &self,
        percept: &Signature,
        percepts: &Percepts,
        paths: &PathGraph,
    ) -> Vec<PlaceId> {
        let sizes = (0..=DOUBLINGS).map(|doubling| f64::from(1_u32 << doubling));
        let mut sets = sizes.map(|size| self.within(percept, percepts, paths, size));
        sets.find(|set| !set.is_empty()).unwrap_or_default()
    }

    /// The places that look like a percept, by the measure that matchers use. By id.
    pub(in crate::diktiometry) fn alike(
        &self,
        percept: &Signature,
        percepts: &Percepts,
        paths: &PathGraph,
    ) -> Vec<PlaceId> {
        self.within(percept, percepts, paths, 1.0)
    }

    /// The places with a view whose columns are near enough to those of a percept in a hypercube of `size` tolerances.
    fn within(
        &self,
        percept: &Signature,
        percepts: &Percepts,
        paths: &PathGraph,
        size: f64,
    ) -> Vec<PlaceId> {
        let Percepts::Signatures(kind) = percepts else {
            return Vec::new();
        };
        let columns = percept.columns();
        let enough = libm::ceil(kind.share * columns as f64 - 1e-9) as usize;
        // (view, offset) of every column that is near one of the percept's.
        let mut votes: Vec<(u32, usize)> = Vec::new();
        for column in 0..columns {
            let half_size = kind.tolerance * size;
            self.tree
                .within(percept.column(column), half_size, |found| {
                    let offset = (found.column as usize + columns - column) % columns;
                    if offset == 0 || kind.rotation == Rotation::Free {
                        votes.push((found.view, offset));
                    }
                });
        }
        votes.sort_unstable();
        let mut set: Vec<PlaceId> = votes
            .chunk_by(|a, b| a == b)
            .filter(|alike| alike.len() >= enough)
            .filter_map(|alike| self.views.get(alike[0].0 as usize))
            .filter_map(|place| paths.resolve(*place))
            .collect();
        set.sort_unstable();
        set.dedup();
        set
    }
}
