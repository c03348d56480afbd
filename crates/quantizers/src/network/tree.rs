//! Exact index of the nearest units, for few features and many units.
//!
//! A k-d tree whose leaves hold up to 16 units each, side by side. So a leaf is compared as fast as
//! a block of [`Prototypes`]. It gives the same answer as a scan of all units, to the bit. It skips
//! a subtree only if every unit in it is farther than the second nearest so far **as computed**.
//! This is decidable because rounding keeps order. Where |x − p| ≥ |x − s| in a feature, the same
//! holds for the rounded differences, squares and sums. Both have to be summed in the same order.

use alloc::vec;
use alloc::vec::Vec;

use super::prototypes::{LANES, Prototypes};
use super::search::{Best, Candidate, Terms};
use crate::Scalar;

/// Maximum number of features; with more, a search visits nearly all leaves.
pub(crate) const MOST_FEATURES: usize = 4;

/// Returns the maximum number of inner nodes on a path to a leaf in a tree of `units` units. It is
/// twice that of a balanced tree, plus two.
fn steepest(units: usize) -> u32 {
    2 * (units / (LANES / 2)).max(1).ilog2() + 2
}

#[derive(Clone, Copy, Debug)]
enum Node<S> {
    /// Units below the split in this feature are in the first child, units above it in the second,
    /// units on it in either.
    Inner {
        feature: u32,
        split: S,
        /// Index of the first child; the second child is the next node.
        children: u32,
    },
    Leaf(u32),
}

#[derive(Clone, Copy, Debug)]
struct Leaf<S> {
    /// Values of the units by feature. Lanes without a unit hold infinity.
    features: [[S; LANES]; MOST_FEATURES],
    slots: [u32; LANES],
    len: u32,
    /// A leaf's node, with the number of inner nodes above it.
    node: u32,
    depth: u32,
    /// Bounds of the units by the splits above, by feature, both ends included.
    low: [S; MOST_FEATURES],
    high: [S; MOST_FEATURES],
}

/// The leaf that holds a slot's unit, and the unit's lane in that leaf.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    leaf: u32,
    lane: u32,
}

/// An exact index of up to [`MOST_FEATURES`] features.
///
/// It stays balanced because it is built again when a path has become too long or leaves too empty.
/// That takes many units that came or moved since the last time.
#[derive(Clone, Debug)]
pub(crate) struct Tree<S> {
    dimension: usize,
    /// Nodes of the tree. The root is node 0, and the two children of a node are adjacent.
    nodes: Vec<Node<S>>,
    leaves: Vec<Leaf<S>>,
    /// Place of each slot's unit; arbitrary for a slot without a unit.
    places: Vec<Place>,
    len: usize,
    /// Working memory of a rebuild, kept to avoid allocation.
    slots: Vec<u32>,
}

impl<S: Scalar> Leaf<S> {
    fn root() -> Self {
        Self {
            features: [[S::INFINITY; LANES]; MOST_FEATURES],
            slots: [u32::MAX; LANES],
            len: 0,
            node: 0,
            depth: 0,
            low: [S::ZERO - S::INFINITY; MOST_FEATURES],
            high: [S::INFINITY; MOST_FEATURES],
        }
    }

    /// Removes all units.
    fn clear(&mut self) {
        self.features = [[S::INFINITY; LANES]; MOST_FEATURES];
        self.slots = [u32::MAX; LANES];
        self.len = 0;
    }
}

impl<S: Scalar> Tree<S> {
    /// Returns an index of the given slots, all of which are below `highest`.
    pub(crate) fn new(
        prototypes: &Prototypes<S>,
        slots: impl Iterator<Item = usize>,
        highest: usize,
    ) -> Self {
        let mut tree = Self {
            dimension: prototypes.dimension(),
            nodes: Vec::new(),
            leaves: Vec::new(),
            places: vec![Place::default(); highest],
            len: 0,
            slots: slots.map(|slot| slot as u32).collect(),
        };
        tree.len = tree.slots.len();
        tree.build(prototypes);
        tree
    }

    /// Builds a balanced tree of all units in `self.slots`.
    fn build(&mut self, prototypes: &Prototypes<S>) {
        self.nodes.clear();
        self.nodes.push(Node::Leaf(0));
        self.leaves.clear();
        self.leaves.push(Leaf::root());
        let mut slots = core::mem::take(&mut self.slots);
        self.fill(0, &mut slots, prototypes);
        slots.clear();
        self.slots = slots;
    }

    /// Enters units into the region of an empty leaf. The region is divided until every leaf has
    /// room for its units.
    fn fill(&mut self, leaf: u32, slots: &mut [u32], prototypes: &Prototypes<S>) {
        if slots.len() > LANES {
            return self.divide(leaf, slots, prototypes);
        }
        for slot in slots {
            self.put(leaf, *slot, prototypes);
        }
    }

    /// Divides an empty leaf's region at the median of the feature in which the units spread most,
    /// and enters the units. Equal values are ordered by slot, so that the division does not depend
    /// on the order before.
    fn divide(&mut self, leaf: u32, slots: &mut [u32], prototypes: &Prototypes<S>) {
        let feature = widest(slots, self.dimension, prototypes);
        let at = |slot: u32| prototypes.at(slot as usize, feature);
        let middle = slots.len() / 2;
        let (_, median, _) = slots.select_nth_unstable_by(middle, |a, b| {
            let order = at(*a).partial_cmp(&at(*b));
            order.unwrap_or(core::cmp::Ordering::Equal).then(a.cmp(b))
        });
        let upper = self.fork(leaf, feature, at(*median));
        let (below, above) = slots.split_at_mut(middle);
        self.fill(upper, above, prototypes);
        self.fill(leaf, below, prototypes);
    }

    /// Divides an empty leaf's region; the leaf keeps the lower part, and the new leaf for the
    /// upper part is returned.
    fn fork(&mut self, lower: u32, feature: usize, split: S) -> u32 {
        let mut below = self.leaves[lower as usize];
        let mut above = below;
        let (upper, pair) = (self.leaves.len() as u32, self.nodes.len() as u32);
        self.nodes.extend([Node::Leaf(lower), Node::Leaf(upper)]);
        self.nodes[below.node as usize] = Node::Inner {
            feature: feature as u32,
            split,
            children: pair,
        };
        (below.node, above.node) = (pair, pair + 1);
        below.depth += 1;
        above.depth += 1;
        below.high[feature] = split;
        above.low[feature] = split;
        self.leaves[lower as usize] = below;
        self.leaves.push(above);
        upper
    }

    /// Enters a unit into a leaf that has room.
    fn put(&mut self, leaf: u32, slot: u32, prototypes: &Prototypes<S>) {
        let place = &mut self.places[slot as usize];
        let inside = &mut self.leaves[leaf as usize];
        *place = Place {
            leaf,
            lane: inside.len,
        };
        let lane = inside.len as usize;
        for feature in 0..self.dimension {
            inside.features[feature][lane] = prototypes.at(slot as usize, feature);
        }
        inside.slots[lane] = slot;
        inside.len += 1;
    }

    /// Enters a unit.
    pub(crate) fn insert(&mut self, slot: usize, prototypes: &Prototypes<S>) {
        if self.places.len() <= slot {
            self.places.resize(slot + 1, Place::default());
        }
        self.len += 1;
        loop {
            let leaf = self.leaf_at(slot, prototypes);
            let Leaf { len, depth, .. } = &self.leaves[leaf as usize];
            if (*len as usize) < LANES {
                return self.put(leaf, slot as u32, prototypes);
            }
            if self.is_sparse() || *depth >= steepest(self.len) {
                self.rebuild(prototypes);
            } else {
                self.divide_leaf(leaf, prototypes);
            }
        }
    }

    /// Returns whether enough leaves are nearly empty for a new tree to pay.
    fn is_sparse(&self) -> bool {
        self.leaves.len() > self.len / 4 + 8
    }

    /// Returns the leaf whose region a unit is in.
    fn leaf_at(&self, slot: usize, prototypes: &Prototypes<S>) -> u32 {
        let (mut node, mut depth) = (0, 0);
        loop {
            match self.nodes[node as usize] {
                Node::Leaf(leaf) => return leaf,
                Node::Inner {
                    feature,
                    split,
                    children,
                } => {
                    let value = prototypes.at(slot, feature as usize);
                    let side = if value < split {
                        0
                    } else if value > split {
                        1
                    } else {
                        // Many equal units spread over both sides.
                        (slot >> (depth % 32)) as u32 & 1
                    };
                    node = children + side;
                    depth += 1;
                }
            }
        }
    }

    /// Divides a full leaf into two.
    fn divide_leaf(&mut self, leaf: u32, prototypes: &Prototypes<S>) {
        let mut slots = self.leaves[leaf as usize].slots;
        self.leaves[leaf as usize].clear();
        self.divide(leaf, &mut slots, prototypes);
    }

    /// Builds the tree again.
    #[cold]
    fn rebuild(&mut self, prototypes: &Prototypes<S>) {
        for leaf in &self.leaves {
            let slots = &leaf.slots[..leaf.len as usize];
            self.slots.extend_from_slice(slots);
        }
        self.build(prototypes);
    }

    /// Removes a unit.
    pub(crate) fn remove(&mut self, slot: usize) {
        let Place { leaf, lane } = self.places[slot];
        let inside = &mut self.leaves[leaf as usize];
        inside.len -= 1;
        let (lane, last) = (lane as usize, inside.len as usize);
        for row in &mut inside.features {
            row[lane] = row[last];
            row[last] = S::INFINITY;
        }
        inside.slots[lane] = inside.slots[last];
        inside.slots[last] = u32::MAX;
        if lane != last {
            self.places[inside.slots[lane] as usize].lane = lane as u32;
        }
        self.len -= 1;
    }

    /// Moves the entry of a unit whose prototype has moved.
    #[inline]
    pub(crate) fn follow(&mut self, slot: usize, prototypes: &Prototypes<S>) {
        let Place { leaf, lane } = self.places[slot];
        let inside = &mut self.leaves[leaf as usize];
        let mut stays = true;
        for feature in 0..self.dimension {
            let value = prototypes.at(slot, feature);
            stays &= inside.low[feature] <= value && value <= inside.high[feature];
            inside.features[feature][lane as usize] = value;
        }
        if !stays {
            self.remove(slot);
            self.insert(slot, prototypes);
        }
    }

    /// Renumbers slots, as [`super::links::Links::renumber`] does.
    pub(crate) fn renumber(&mut self, new: &[u32]) {
        for leaf in &mut self.leaves {
            for slot in &mut leaf.slots[..leaf.len as usize] {
                *slot = new[*slot as usize];
            }
        }
        for (slot, to) in new.iter().enumerate() {
            if *to != u32::MAX {
                self.places[*to as usize] = self.places[slot];
            }
        }
    }

    /// Offers the two nearest units to `best`.
    #[inline]
    pub(crate) fn search(&self, input: &[S], terms: impl Terms<S>, best: &mut Best<S>) {
        self.visit::<false>(0, input, terms, &mut [S::ZERO; MOST_FEATURES], best);
    }

    /// Offers the nearest unit to `best`, whose second is some other unit: it skips what is farther
    /// than the nearest so far.
    #[inline]
    pub(crate) fn search_first(&self, input: &[S], terms: impl Terms<S>, best: &mut Best<S>) {
        self.visit::<true>(0, input, terms, &mut [S::ZERO; MOST_FEATURES], best);
    }

    /// Offers the units below `node` to `best`; with `FIRST`, only those that may be the nearest.
    /// `gaps` holds the distance of the input from the node's region in each feature.
    fn visit<const FIRST: bool>(
        &self,
        node: u32,
        input: &[S],
        terms: impl Terms<S>,
        gaps: &mut [S; MOST_FEATURES],
        best: &mut Best<S>,
    ) {
        match self.nodes[node as usize] {
            Node::Leaf(leaf) => self.compare::<FIRST>(leaf, input, terms, best),
            Node::Inner {
                feature,
                split,
                children,
            } => {
                let feature = feature as usize;
                let gap = input[feature] - split;
                let (near, far) = if gap < S::ZERO {
                    (children, children + 1)
                } else {
                    (children + 1, children)
                };
                self.visit::<FIRST>(near, input, terms, gaps, best);
                let before = core::mem::replace(&mut gaps[feature], gap);
                let mut bound = S::ZERO;
                for (feature, gap) in gaps.iter().enumerate().take(self.dimension) {
                    if terms.compares(feature) {
                        bound += terms.square(feature, *gap);
                    }
                }
                if bound <= best.worst::<FIRST>() {
                    self.visit::<FIRST>(far, input, terms, gaps, best);
                }
                gaps[feature] = before;
            }
        }
    }

    #[inline(always)]
    fn compare<const FIRST: bool>(
        &self,
        leaf: u32,
        input: &[S],
        terms: impl Terms<S>,
        best: &mut Best<S>,
    ) {
        let leaf = &self.leaves[leaf as usize];
        let mut sums = [S::ZERO; LANES];
        for (feature, value) in input.iter().enumerate() {
            if terms.compares(feature) {
                for (sum, other) in sums.iter_mut().zip(&leaf.features[feature]) {
                    *sum += terms.square(feature, *value - *other);
                }
            }
        }
        for (lane, squared_distance) in sums.into_iter().enumerate() {
            if squared_distance <= best.worst::<FIRST>() {
                best.offer(Candidate {
                    squared_distance,
                    slot: leaf.slots[lane],
                });
            }
        }
    }
}

/// Returns the feature in which units are spread most.
fn widest<S: Scalar>(slots: &[u32], dimension: usize, prototypes: &Prototypes<S>) -> usize {
    let mut widest = (0, S::ZERO - S::INFINITY);
    for feature in 0..dimension {
        let (mut low, mut high) = (S::INFINITY, S::ZERO - S::INFINITY);
        for slot in slots {
            let value = prototypes.at(*slot as usize, feature);
            if value < low {
                low = value;
            }
            if value > high {
                high = value;
            }
        }
        if high - low > widest.1 {
            widest = (feature, high - low);
        }
    }
    widest.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_that_wander_leave_no_crowd_of_empty_leaves() {
        let mut prototypes = Prototypes::<f64>::new(1);
        for _ in 0..200 {
            let slot = prototypes.push();
            prototypes.put(slot, 0, slot as f64);
        }
        let mut tree = Tree::new(&prototypes, 0..200, 200);
        for step in 1..40 {
            for slot in 0..200_usize {
                prototypes.put(slot, 0, (slot + 200 * step) as f64);
                tree.follow(slot, &prototypes);
            }
            assert_eq!(tree.len, 200);
            assert!(tree.leaves.len() <= 200 / 4 + 9, "{}", tree.leaves.len());
        }
    }
}
