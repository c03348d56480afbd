//! Finds places that look like the robot's view, wherever they are.

mod columns;
mod feature_tree;
mod triangles;

use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use core::cell::LazyCell;

use columns::ColumnIndex;
use feature_tree::Feature;
use triangles::{Seen, TriangleIndex};

use crate::diktiometry::{Config, PathGraph, Percepts, PerceptualIndexing, PlaceId, Signature};

/// Maximum number of times that the hypercube's size is doubled: from the tolerance to eight times
/// it.
const DOUBLINGS: u32 = 3;

/// Index of all views of all places, by their columns and, if configured, by triangles of their
/// edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ViewIndex {
    /// Place of each view, by the view's number.
    places: Vec<PlaceId>,
    columns: ColumnIndex,
    triangles: TriangleIndex,
}

impl ViewIndex {
    /// Takes in a view of a place. O(features of the view · log² views), amortized.
    pub(crate) fn insert(&mut self, place: PlaceId, view: &Signature, config: &Config) {
        let Percepts::Signatures(kind) = &config.percepts else {
            return;
        };
        self.places.push(place);
        self.columns.insert(view, kind);
        if config.indexing.perceptual == PerceptualIndexing::Triangles {
            self.triangles.insert(view, kind);
        }
    }

    /// Returns the places that look most like a percept, by id. They are the first nonempty set
    /// within ever larger distances; larger distances are not searched.
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
        let sets = sizes.map(|size| match config.indexing.perceptual {
            PerceptualIndexing::Off => Vec::new(),
            PerceptualIndexing::Columns => self.columns.within(percept, kind, size),
            PerceptualIndexing::Triangles => self.triangles.within(&seen, kind, size),
        });
        let mut sets = sets.map(|views| self.standing(&views, paths));
        sets.find(|set| !set.is_empty()).unwrap_or_default()
    }

    /// Returns the places that look like a percept by the matchers' measure, in order of id.
    pub(crate) fn alike(
        &self,
        percept: &Signature,
        config: &Config,
        paths: &PathGraph,
    ) -> Vec<PlaceId> {
        match &config.percepts {
            Percepts::None => Vec::new(),
            Percepts::Signatures(kind) => {
                self.standing(&self.columns.within(percept, kind, 1.0), paths)
            }
        }
    }

    /// Returns the standing places of some views.
    fn standing(&self, views: &[u32], paths: &PathGraph) -> Vec<PlaceId> {
        let places = views.iter().map(|view| self.places[*view as usize]);
        let standing: BTreeSet<PlaceId> = places.filter_map(|place| paths.resolve(place)).collect();
        Vec::from_iter(standing)
    }
}

/// Sign that a view matches the percept: one feature of each are near each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Vote {
    view: u32,
    /// Rotation of the view against the percept, in columns, if this is the same feature.
    offset: u32,
}

impl Vote {
    /// Returns the vote for a feature that the percept has at `column` of `columns`.
    fn of(known: &Feature, column: u32, columns: usize) -> Self {
        let columns = columns as u32;
        Self {
            view: known.view,
            offset: (known.column + columns - column) % columns,
        }
    }
}
