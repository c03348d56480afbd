//! Places that look like what the robot sees, wherever they are.

mod columns;
mod feature_tree;
mod triangles;

use alloc::vec::Vec;

use columns::ColumnIndex;
use feature_tree::Feature;
use triangles::{Seen, TriangleIndex};

use crate::diktiometry::config::{Config, Percepts, PerceptualIndexing, Rotation};
use crate::diktiometry::ids::PlaceId;
use crate::diktiometry::path_graph::PathGraph;
use crate::diktiometry::signature::Signature;

/// How often the hypercube's size is doubled at most: from the tolerance to eight times it.
const DOUBLINGS: u32 = 3;

/// All views of all places, by their columns and, if that is asked for, by triangles of their edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::diktiometry) struct ViewIndex {
    columns: ColumnIndex,
    triangles: TriangleIndex,
}

impl ViewIndex {
    /// Takes in a view of a place. O(features of the view · log² views), amortized.
    pub(in crate::diktiometry) fn insert(
        &mut self,
        place: PlaceId,
        view: &Signature,
        config: &Config,
    ) {
        let Percepts::Signatures(kind) = &config.percepts else {
            return;
        };
        self.columns.insert(place, view, kind);
        if config.indexing.perceptual == PerceptualIndexing::Triangles {
            self.triangles.insert(place, view, kind);
        }
    }

    /// The places that look most like a percept: of the sets that are found within more and more, the first that is not empty.
    /// Nobody asks for the sets after it. The places are those that stand now, by id.
    pub(in crate::diktiometry) fn most_alike(
        &self,
        percept: &Signature,
        config: &Config,
        paths: &PathGraph,
    ) -> Vec<PlaceId> {
        let Percepts::Signatures(kind) = &config.percepts else {
            return Vec::new();
        };
        let first = |set: &Vec<PlaceId>| !set.is_empty();
        let set = match config.indexing.perceptual {
            PerceptualIndexing::Off => None,
            PerceptualIndexing::Columns => sizes()
                .map(|size| self.columns.within(percept, kind, paths, size))
                .find(first),
            PerceptualIndexing::Triangles => {
                let seen = Seen::of(percept);
                sizes()
                    .map(|size| self.triangles.within(&seen, kind, paths, size))
                    .find(first)
            }
        };
        set.unwrap_or_default()
    }

    /// The places that look like a percept, by the measure that matchers use. By id.
    pub(in crate::diktiometry) fn alike(
        &self,
        percept: &Signature,
        config: &Config,
        paths: &PathGraph,
    ) -> Vec<PlaceId> {
        match &config.percepts {
            Percepts::None => Vec::new(),
            Percepts::Signatures(kind) => self.columns.within(percept, kind, paths, 1.0),
        }
    }
}

/// The half sizes of the growing hypercube, in those of the first.
fn sizes() -> impl Iterator<Item = f64> {
    (0..=DOUBLINGS).map(|doubling| f64::from(1_u32 << doubling))
}

/// A feature of a view is near one of the percept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Vote {
    view: u32,
    /// By how many columns the view is turned against the percept, if it is the same feature.
    offset: u32,
}

impl Vote {
    /// For a feature that the percept has at `column` of `columns`.
    fn of(known: &Feature, column: u32, columns: usize) -> Self {
        let columns = columns as u32;
        Self {
            view: known.view,
            offset: (known.column + columns - column) % columns,
        }
    }
}

/// The places of the views that have enough votes at one offset. By id.
fn elected(
    mut votes: Vec<Vote>,
    rotation: Rotation,
    enough: impl Fn(u32) -> usize,
    place: impl Fn(u32) -> PlaceId,
    paths: &PathGraph,
) -> Vec<PlaceId> {
    votes.retain(|vote| vote.offset == 0 || rotation == Rotation::Free);
    votes.sort_unstable();
    let mut set: Vec<PlaceId> = votes
        .chunk_by(|a, b| a == b)
        .filter(|alike| alike.len() >= enough(alike[0].view))
        .filter_map(|alike| paths.resolve(place(alike[0].view)))
        .collect();
    set.sort_unstable();
    set.dedup();
    set
}
