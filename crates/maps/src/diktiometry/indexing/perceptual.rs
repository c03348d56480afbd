//! Places that look like what the robot sees, wherever they are.

mod columns;
mod feature_tree;
mod triangles;

use alloc::vec::Vec;
use core::cell::LazyCell;

use columns::ColumnIndex;
use feature_tree::Feature;
use triangles::{Seen, TriangleIndex};

use crate::diktiometry::{Config, PathGraph, Percepts, PerceptualIndexing, PlaceId, Signature};

/// How often the hypercube's size is doubled at most: from the tolerance to eight times it.
const DOUBLINGS: u32 = 3;

/// All views of all places, by their columns and, if that is asked for, by triangles of their edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ViewIndex {
    columns: ColumnIndex,
    triangles: TriangleIndex,
}

impl ViewIndex {
    /// Takes in a view of a place. O(features of the view · log² views), amortized.
    pub(crate) fn insert(&mut self, place: PlaceId, view: &Signature, config: &Config) {
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
    pub(crate) fn most_alike(
        &self,
        percept: &Signature,
        config: &Config,
        paths: &PathGraph,
    ) -> Vec<PlaceId> {
        let Percepts::Signatures(kind) = &config.percepts else {
            return Vec::new();
        };
        let seen = LazyCell::new(|| Seen::of(percept));
        // The half sizes of the growing hypercube, in those of the first.
        let sizes = (0..=DOUBLINGS).map(|doubling| f64::from(1_u32 << doubling));
        let mut sets = sizes.map(|size| match config.indexing.perceptual {
            PerceptualIndexing::Off => Vec::new(),
            PerceptualIndexing::Columns => self.columns.within(percept, kind, paths, size),
            PerceptualIndexing::Triangles => self.triangles.within(&seen, kind, paths, size),
        });
        sets.find(|set| !set.is_empty()).unwrap_or_default()
    }

    /// The places that look like a percept, by the measure that matchers use. By id.
    pub(crate) fn alike(
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
