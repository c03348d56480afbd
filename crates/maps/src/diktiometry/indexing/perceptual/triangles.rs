//! Perceptual indexing, second form: triples of features as triangles.
//!
//! Source: S. Atiya, G. Hager, "Real-time vision-based robot localization", which the paper names
//! beside columns. Each three vertical edges of the image make a triangle. Triangles are sorted by
//! their longest side, and sides are compared as intervals. Theirs are in metres, from two cameras;
//! here they are angles, as an edge is known by its bearing.

use alloc::vec::Vec;

use super::Vote;
use super::feature_tree::{Feature, FeatureTree};
use crate::diktiometry::{Signature, SignatureKind, ViewRotation};

/// Maximum number of edges kept of a view, the clearest first: 56 triangles.
const EDGES: usize = 8;

/// Maximum number of borders used of a percept, the clearest first: 560 triangles, whatever the
/// number of columns. It is twice the number of kept edges, since noise can make others clearer
/// than those.
const BORDERS: usize = 2 * EDGES;

/// Index of all views of all places, by triangles of their edges.
///
/// An *edge* is the border between two columns that differ. Its *contrast* is the difference in
/// each row. Three edges form a triangle: its sides are the angles between them, its corners the
/// contrasts. Both do not depend on the robot's rotation, and contrasts do not depend on
/// brightness.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct TriangleIndex {
    tree: FeatureTree,
    /// Number of triangles that must be found, by view.
    enough: Vec<usize>,
}

/// The border before a column.
#[derive(Clone, Debug, PartialEq)]
struct Edge {
    column: usize,
    /// Contrast by row: the column's values minus those of the column before.
    contrast: Vec<f64>,
}

impl Edge {
    fn clearness(&self) -> f64 {
        let all = self.contrast.iter().map(|row| row.abs());
        all.fold(0.0, f64::max)
    }
}

/// Features of a percept that are searched for.
pub(super) struct Seen {
    /// Triangles of the percept, one from each of their longest sides.
    features: Vec<Feature>,
    columns: usize,
}

impl Seen {
    pub(super) fn of(percept: &Signature) -> Self {
        let columns = percept.columns();
        let edges = clearest(borders(percept), BORDERS);
        let features = triangles(&edges).flat_map(|triangle| turns(triangle, columns));
        Self {
            features: features.collect(),
            columns,
        }
    }
}

impl TriangleIndex {
    /// Adds a view. Views with fewer than three edges have no triangle and are never found.
    ///
    /// An edge is kept only if noise alone cannot make it. All borders of a percept are used. So a
    /// view seen again within the tolerance is found by all its triangles. This holds if it has no
    /// more borders than are used, or if its edges are clearer than all others by four tolerances.
    pub(super) fn insert(&mut self, view: &Signature, kind: &SignatureKind) {
        let mut edges = borders(view);
        edges.retain(|edge| edge.clearness() > kind.tolerance);
        let edges = clearest(edges, EDGES);
        // As many as the share of the edges makes that has to agree.
        let agreeing = libm::ceil(kind.share * edges.len() as f64 - 1e-9) as usize;
        let number = self.enough.len() as u32;
        self.enough.push(triples(agreeing).max(1));
        for triangle in triangles(&edges) {
            // A query has a triangle with several longest sides once for each of them.
            if let Some(kept) = turns(triangle, view.columns()).next() {
                self.tree.insert(Feature {
                    view: number,
                    ..kept
                });
            }
        }
    }

    /// Returns the views that share enough triangles with a percept, contrasts within `size` times
    /// the effect of noise. O(√(triangles)) for each triangle of the percept.
    pub(super) fn within(&self, percept: &Seen, kind: &SignatureKind, size: f64) -> Vec<u32> {
        // Each of the two columns at an edge may differ by the tolerance. Sides are whole columns.
        let mut half_sizes = Vec::from([0.0; SIDES]);
        half_sizes.resize(SIDES + 3 * kind.rows, 2.0 * kind.tolerance * size);
        let mut votes = Vec::new();
        for seen in &percept.features {
            self.tree.within(&seen.values, &half_sizes, |known| {
                votes.push(Vote::of(known, seen.column, percept.columns));
            });
        }
        votes.retain(|vote| vote.offset == 0 || kind.rotation == ViewRotation::Free);
        votes.sort_unstable();
        let views = votes.chunk_by(|a, b| a == b).filter_map(|alike| {
            let view = alike[0].view;
            (alike.len() >= self.enough[view as usize]).then_some(view)
        });
        views.collect()
    }
}

/// Returns the border before every column.
fn borders(view: &Signature) -> Vec<Edge> {
    let columns = view.columns();
    let border = |column: usize| {
        let before = view.column((column + columns - 1) % columns);
        let pairs = view.column(column).iter().zip(before);
        Edge {
            column,
            contrast: pairs.map(|(here, before)| here - before).collect(),
        }
    };
    (0..columns).map(border).collect()
}

/// Returns the clearest of some edges, by column.
fn clearest(mut edges: Vec<Edge>, count: usize) -> Vec<Edge> {
    edges.sort_by(|a, b| {
        let clearer = b.clearness().total_cmp(&a.clearness());
        clearer.then(a.column.cmp(&b.column))
    });
    edges.truncate(count);
    edges.sort_by_key(|edge| edge.column);
    edges
}

/// Returns the number of triples among `count` things.
const fn triples(count: usize) -> usize {
    count * count.saturating_sub(1) * count.saturating_sub(2) / 6
}

/// Three edges, counter-clockwise.
type Triangle<'a> = [&'a Edge; 3];

/// Number of sides that identify a triangle: the third is what is left of the circle.
const SIDES: usize = 2;

/// Returns all triples of edges that are sorted by column.
fn triangles(edges: &[Edge]) -> impl Iterator<Item = Triangle<'_>> {
    edges.iter().enumerate().flat_map(move |(second, middle)| {
        edges[..second].iter().flat_map(move |first| {
            let last = edges[second + 1..].iter();
            last.map(move |last| [first, middle, last])
        })
    })
}

/// Returns the columns from one edge counter-clockwise to another.
fn side(from: &Edge, to: &Edge, columns: usize) -> usize {
    (to.column + columns - from.column) % columns
}

/// Returns the triangle from the beginning of its longest side on. If several are the longest, one
/// from each.
fn turns(triangle: Triangle<'_>, columns: usize) -> impl Iterator<Item = Feature> + use<'_> {
    let [a, b, c] = triangle;
    let turns = [[a, b, c], [b, c, a], [c, a, b]];
    let first = move |turn: &Triangle<'_>| side(turn[0], turn[1], columns);
    let longest = turns.iter().map(first).max();
    let told = turns
        .into_iter()
        .filter(move |turn| Some(first(turn)) == longest);
    told.map(move |turn| feature(turn, columns))
}

/// Returns the feature of a triangle: its sides, the longest first, and the contrasts of its
/// corners.
fn feature(triangle: Triangle<'_>, columns: usize) -> Feature {
    let [a, b, c] = triangle;
    let sides = [side(a, b, columns), side(b, c, columns)].map(|side| side as f64);
    let mut values = Vec::from(sides);
    values.extend(triangle.iter().flat_map(|edge| &edge.contrast));
    Feature {
        values,
        view: 0,
        column: a.column as u32,
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use proptest::prelude::*;

    use super::*;

    const ROWS: usize = 2;
    const COLUMNS: usize = 12;

    fn kind(rotation: ViewRotation) -> SignatureKind {
        SignatureKind {
            rows: ROWS,
            columns: COLUMNS,
            tolerance: 0.2,
            share: 0.6,
            rotation,
            views: 1,
        }
    }

    /// Returns the view of a robot rotated by `turned` columns, with `noise` on each value and all
    /// values brighter.
    fn seen(view: &[f64], turned: usize, noise: &[f64], brighter: f64) -> Signature {
        let values = (0..view.len()).map(|at| {
            let there = (at + turned * ROWS) % view.len();
            view[there] + noise[at] + brighter
        });
        Signature::new(ROWS, values.collect()).unwrap()
    }

    fn index(views: &[Vec<f64>], kind: &SignatureKind) -> TriangleIndex {
        let mut index = TriangleIndex::default();
        for view in views {
            let view = Signature::new(ROWS, view.clone()).unwrap();
            index.insert(&view, kind);
        }
        index
    }

    fn view() -> impl Strategy<Value = Vec<f64>> {
        // Walls of few colours, so that there are borders without contrast and sides of one length.
        prop::collection::vec(prop_oneof![Just(0.0), Just(0.5), Just(1.0)], ROWS * COLUMNS)
    }

    fn edges(view: &[f64], kind: &SignatureKind) -> usize {
        let all = borders(&Signature::new(ROWS, view.to_vec()).unwrap());
        let clear = all.iter().filter(|edge| edge.clearness() > kind.tolerance);
        clear.count()
    }

    proptest! {
        #[test]
        fn the_true_place_is_found_however_the_robot_is_turned(
            views in prop::collection::vec(view(), 1..8),
            truth in any::<prop::sample::Index>(),
            turned in 0..COLUMNS,
            noise in prop::collection::vec(-0.1..0.1, ROWS * COLUMNS),
            wrong in prop::collection::vec(-0.1..0.1, ROWS * COLUMNS),
            brighter in -2.0..2.0,
        ) {
            let kind = kind(ViewRotation::Free);
            // What is stored was seen with an error, too.
            let stored: Vec<Vec<f64>> = views
                .iter()
                .map(|view| view.iter().zip(&wrong).map(|(value, wrong)| value + wrong).collect())
                .collect();
            let truth = truth.index(views.len());
            let percept = seen(&views[truth], turned, &noise, brighter);
            let found = index(&stored, &kind).within(&Seen::of(&percept), &kind, 1.0);
            prop_assert_eq!(found.contains(&(truth as u32)), edges(&stored[truth], &kind) >= 3);
        }

        /// The result does not depend on the rotation of the percept.
        #[test]
        fn what_is_found_does_not_depend_on_how_the_robot_is_turned(
            views in prop::collection::vec(view(), 1..8),
            percept in view(),
            turned in 0..COLUMNS,
        ) {
            let kind = kind(ViewRotation::Free);
            let index = index(&views, &kind);
            let still = vec![0.0; ROWS * COLUMNS];
            let [north, other] = [0, turned].map(|turned| {
                let percept = seen(&percept, turned, &still, 0.0);
                index.within(&Seen::of(&percept), &kind, 1.0)
            });
            prop_assert_eq!(north, other);
        }
    }

    #[test]
    fn with_a_compass_a_view_is_found_as_it_lies_alone() {
        let kind = kind(ViewRotation::Aligned);
        let mut view = vec![0.0; ROWS * COLUMNS];
        // Walls from columns 1 to 3 and 5 to 9: four edges.
        for column in [1, 2, 5, 6, 7, 8] {
            view[column * ROWS] = 1.0;
        }
        let index = index(core::slice::from_ref(&view), &kind);
        let still = vec![0.0; ROWS * COLUMNS];
        let found = |turned: usize| {
            let percept = seen(&view, turned, &still, 0.0);
            index.within(&Seen::of(&percept), &kind, 1.0)
        };
        assert_eq!(found(0), [0]);
        assert!((1..COLUMNS).all(|turned| found(turned).is_empty()));
    }

    /// A laser has many beams, most of them on one wall. Four clear edges are found among the
    /// borders that noise makes.
    #[test]
    fn views_of_many_columns_are_asked_for_by_few_triangles() {
        const MANY: usize = 2000;
        let kind = SignatureKind {
            columns: MANY,
            ..kind(ViewRotation::Free)
        };
        let mut view = vec![0.0; ROWS * MANY];
        for column in (100..300).chain(700..1600) {
            view[column * ROWS] = 2.0;
        }
        let noise: Vec<f64> = (0..view.len())
            .map(|at| 0.1 * libm::sin(at as f64))
            .collect();
        let index = index(core::slice::from_ref(&view), &kind);
        for turned in [0, 1, 250, 1999] {
            let percept = Seen::of(&seen(&view, turned, &noise, 1.0));
            assert!(percept.features.len() <= 3 * triples(BORDERS));
            let found = index.within(&percept, &kind, 1.0);
            assert_eq!(found, [0], "turned by {turned}");
        }
    }
}
