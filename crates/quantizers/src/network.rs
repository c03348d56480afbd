//! Units, their prototypes and their edges: the graph that all quantizers grow.

mod clusters;
mod kernels;
mod links;
mod measure;
mod metric;
mod prototypes;
mod search;
mod snapshot;
mod sweep;
mod tree;

use alloc::vec::Vec;

use kernels::Kernels;
use links::Links;
use metric::Metric;
use prototypes::Prototypes;
use search::{Masked, Plain, Terms, Weighted, scan};
use tree::Tree;

use crate::{
    Event, Events, InputError, Nearest, NearestTwo, QuantizerConfigError, Scalar, UnitId,
    UnknownUnit,
};

pub use clusters::Clusters;
pub use kernels::{Lanes, UnitSearch};
pub use measure::QuantizationError;
pub(crate) use search::{Best, Candidate};
pub use snapshot::{NetworkSnapshot, SnapshotUnit};
pub(crate) use sweep::FEW;

/// The units of a quantizer, their prototypes and the edges between them.
///
/// Between calls that learn, the graph has no unit twice, no edge from a unit to itself, and each
/// edge both ways. Ids are ascending in the order in which units came.
///
/// # For those who write a quantizer
/// Inside this crate units are addressed by *slots*. Slots ascend with ids and stay what they are
/// until `tidy`, which closes the gaps that removed units leave.
///
/// ```
/// use tolman_quantizers::{Gng, GngConfig, Quantizer};
///
/// let mut gng = Gng::<f64>::new(1, GngConfig::fritzke())?;
/// gng.begin_with(&[[0.0], [10.0]])?;
/// let network = gng.network();
/// assert_eq!((network.len(), network.dimension()), (2, 1));
/// // Which unit stands for 3, and where does it lie?
/// let nearest = network.nearest(&[3.0])?;
/// assert_eq!(nearest.distance(), 3.0);
/// assert!(network.prototype(nearest.id)?.eq([0.0]));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Network<S> {
    metric: Metric<S>,
    prototypes: Prototypes<S>,
    links: Links,
    /// Id of the unit in each slot, ascending.
    ids: Vec<UnitId>,
    /// Whether the unit of the slot is still there.
    live: Vec<bool>,
    len: usize,
    next_id: u32,
    events: Events,
    search: UnitSearch,
    kernels: Kernels,
    /// Index for searches, if one is used.
    tree: Option<Tree<S>>,
    /// New numbers of the slots while gaps are closed. The vector is kept to avoid an allocation.
    renumbered: Vec<u32>,
}

impl<S: Scalar> Network<S> {
    /// Returns an empty network for inputs of `dimension` features.
    pub(crate) fn new(dimension: usize) -> Result<Self, QuantizerConfigError> {
        Ok(Self::with_metric(Metric::uniform(dimension)?))
    }

    /// Returns an empty network whose distance is Σ w (x − p)².
    pub(crate) fn weighted(weights: &[S]) -> Result<Self, QuantizerConfigError> {
        Ok(Self::with_metric(Metric::weighted(weights)?))
    }

    fn with_metric(metric: Metric<S>) -> Self {
        Self {
            prototypes: Prototypes::new(metric.dimension()),
            metric,
            links: Links::new(),
            ids: Vec::new(),
            live: Vec::new(),
            len: 0,
            next_id: 0,
            events: Events::default(),
            search: UnitSearch::default(),
            kernels: Kernels::from(Lanes::default()),
            tree: None,
            renumbered: Vec::new(),
        }
    }

    /// Returns the number of features of an input.
    pub fn dimension(&self) -> usize {
        self.prototypes.dimension()
    }

    /// Returns the weights of the features in the squared distance, or `None` if all are 1.
    pub fn weights(&self) -> Option<&[S]> {
        self.metric.weights()
    }

    /// Returns the number of units.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Returns whether there are no units, as before the first input.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Returns whether the network has a unit of this id.
    pub fn contains(&self, id: UnitId) -> bool {
        self.slot(id).is_ok()
    }

    /// Returns the ids of all units, ascending.
    pub fn ids(&self) -> impl Iterator<Item = UnitId> + '_ {
        self.slots().map(|slot| self.ids[slot])
    }

    /// Returns the features of a unit's prototype, in order.
    ///
    /// # Errors
    /// If there is no such unit.
    pub fn prototype(
        &self,
        id: UnitId,
    ) -> Result<impl ExactSizeIterator<Item = S> + Clone + '_, UnknownUnit> {
        Ok(self.values(self.slot(id)?))
    }

    /// Returns the units that share an edge with a unit, ascending.
    ///
    /// # Errors
    /// If there is no such unit.
    pub fn neighbours(&self, id: UnitId) -> Result<impl Iterator<Item = UnitId> + '_, UnknownUnit> {
        let slot = self.slot(id)?;
        Ok(self.links.neighbours(slot).map(|other| self.ids[other]))
    }

    /// Returns all edges, each once with the smaller id first, in ascending order.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        self.slots().flat_map(move |slot| {
            self.links
                .ages(slot)
                .filter(move |(other, _)| slot < *other)
                .map(move |(other, age)| Edge {
                    ends: (self.ids[slot], self.ids[other]),
                    age,
                })
        })
    }

    /// Returns the unit nearest to `input`; of equally near ones, the one with the smaller id.
    ///
    /// # Errors
    /// If the input is invalid or there are no units.
    ///
    /// # Complexity
    /// Units × features.
    pub fn nearest(&self, input: &[S]) -> Result<Nearest<S>, InputError> {
        self.metric.check(input)?;
        self.found(self.search_first(input))
            .ok_or(InputError::NoUnits)
    }

    /// Returns the two units nearest to `input`; ties go to the smaller id.
    ///
    /// # Errors
    /// As [`nearest`](Self::nearest).
    pub fn nearest_two(&self, input: &[S]) -> Result<NearestTwo<S>, InputError> {
        self.metric.check(input)?;
        self.named(self.search(input))
    }

    /// Returns the two units nearest to `input` in the features whose `mask` is true. The other
    /// features of `input` are not read, and may have any value. Weights apply as usual.
    ///
    /// # Errors
    /// As [`nearest`](Self::nearest), or if the mask has the wrong size or leaves nothing to
    /// compare.
    pub fn nearest_two_masked(
        &self,
        input: &[S],
        mask: &[bool],
    ) -> Result<NearestTwo<S>, InputError> {
        self.metric.check_masked(input, mask)?;
        let mut best = Best::none();
        match self.metric.weights() {
            None => self.search_by(input, Masked(Plain, mask), &mut best),
            Some(weights) => self.search_by(input, Masked(Weighted(weights), mask), &mut best),
        }
        self.named(best)
    }

    /// Returns the slot of a unit, which holds until gaps are closed.
    pub(crate) fn slot(&self, id: UnitId) -> Result<usize, UnknownUnit> {
        match self.ids.binary_search(&id) {
            Ok(slot) if self.live[slot] => Ok(slot),
            _ => Err(UnknownUnit(id)),
        }
    }

    fn named(&self, best: Best<S>) -> Result<NearestTwo<S>, InputError> {
        Ok(NearestTwo {
            first: self.found(best.first).ok_or(InputError::NoUnits)?,
            second: self.found(best.second),
        })
    }
}

/// The operations of quantizers on the graph.
impl<S: Scalar> Network<S> {
    pub(crate) fn events(&mut self) -> &mut Events {
        &mut self.events
    }

    /// Chooses how the nearest units are searched for. It changes no result.
    pub(crate) fn set_search(&mut self, search: UnitSearch, lanes: Lanes) {
        self.search = search;
        self.kernels = lanes.into();
        self.tree = None;
        self.consider_tree();
    }

    /// Builds the index if it is wanted and does not exist yet.
    fn consider_tree(&mut self) {
        if self.tree.is_none() && self.search.wants_tree(self.dimension(), self.len) {
            self.tree = Some(Tree::new(&self.prototypes, self.slots(), self.ids.len()));
        }
    }

    /// Checks an input as [`observe`](crate::Quantizer::observe) does, and learns nothing.
    ///
    /// # Errors
    /// If the input has another number of features than the network, or one that is NaN, infinite
    /// or so large that squares overflow.
    pub fn check(&self, input: &[S]) -> Result<(), InputError> {
        self.metric.check(input)
    }

    pub(crate) fn check_prototype(&self, prototype: &[S]) -> Result<(), InputError> {
        self.metric.check_prototype(prototype)
    }

    /// Returns the two nearest slots to a valid input.
    pub(crate) fn search(&self, input: &[S]) -> Best<S> {
        let mut best = Best::none();
        match self.metric.weights() {
            None => self.search_by(input, Plain, &mut best),
            Some(weights) => self.search_by(input, Weighted(weights), &mut best),
        }
        best
    }

    /// Returns the nearest slot to a valid input.
    fn search_first(&self, input: &[S]) -> Candidate<S> {
        let Some(tree) = &self.tree else {
            return self.search(input).first;
        };
        let mut best = Best::none();
        match self.metric.weights() {
            None => tree.search_first(input, Plain, &mut best),
            Some(weights) => tree.search_first(input, Weighted(weights), &mut best),
        }
        best.first
    }

    #[inline]
    fn search_by(&self, input: &[S], terms: impl Terms<S>, best: &mut Best<S>) {
        match &self.tree {
            Some(tree) => tree.search(input, terms, best),
            None => self.kernels.run(
                #[inline(always)]
                || scan(&self.prototypes, input, terms, best),
            ),
        }
    }

    /// Returns the unit nearest to another unit, if there are two.
    pub(crate) fn nearest_other(&self, slot: usize) -> Option<usize> {
        let prototype: Vec<S> = self.values(slot).collect();
        let best = self.search(&prototype);
        let candidates = [best.first, best.second];
        let mut slots = candidates.iter().map(|candidate| candidate.slot as usize);
        slots.find(|other| *other != slot && *other < self.ids.len())
    }

    /// Returns both candidates by their ids, if there are two.
    pub(crate) fn found_two(&self, best: Best<S>) -> Option<NearestTwo<S>> {
        let second = Some(self.found(best.second)?);
        let first = self.found(best.first)?;
        Some(NearestTwo { first, second })
    }

    /// Returns a candidate by its id, if there is one.
    pub(crate) fn found(&self, candidate: Candidate<S>) -> Option<Nearest<S>> {
        let id = self.ids.get(candidate.slot as usize)?;
        Some(Nearest {
            id: *id,
            squared_distance: candidate.squared_distance,
        })
    }

    /// Returns the unit of a slot at distance 0, for a unit that was made of the input.
    pub(crate) fn at(&self, slot: usize) -> Nearest<S> {
        Nearest {
            id: self.ids[slot],
            squared_distance: S::ZERO,
        }
    }

    /// Returns the squared distance between two units.
    #[inline]
    pub(crate) fn squared_distance(&self, a: usize, b: usize) -> S {
        let mut sum = S::ZERO;
        for feature in 0..self.dimension() {
            let difference = self.prototypes.at(a, feature) - self.prototypes.at(b, feature);
            let square = difference * difference;
            sum += self
                .weights()
                .map_or(square, |weights| weights[feature] * square);
        }
        sum
    }

    /// Returns a slot as a candidate for a valid input, summed in lanes, while the prototypes lie
    /// in turn; `None` if its unit is gone.
    pub(crate) fn candidate(&self, slot: u32, input: &[S]) -> Option<Candidate<S>> {
        let own = self.prototypes.vector(slot as usize)?;
        if !self.live[slot as usize] {
            return None;
        }
        let squared_distance = self.kernels.run(
            #[inline(always)]
            || squared_distance(input, own, self.weights()),
        );
        Some(Candidate {
            squared_distance,
            slot,
        })
    }

    /// Lets prototypes lie in turn, for many moves, or no longer, for searches.
    pub(crate) fn lie_in_turn(&mut self, in_turn: bool) {
        self.prototypes.lie_in_turn(in_turn);
    }

    /// Returns ‖x‖² of an input, as the distance measures it.
    pub(crate) fn squared_length(&self, input: &[S]) -> f64 {
        let squares = input.iter().enumerate().map(|(feature, value)| {
            let weight = self
                .weights()
                .map_or(1.0, |weights| weights[feature].to_f64());
            weight * (value.to_f64() * value.to_f64())
        });
        squares.sum()
    }

    /// Returns the edge that needs a new unit most: from the unit of largest error to its neighbour
    /// of largest error. Among equal errors, the first counts.
    pub(crate) fn worst_edge(&self, error: impl Fn(usize) -> f64) -> Option<(usize, usize)> {
        let worse = |worst, slot| {
            if error(slot) > error(worst) {
                slot
            } else {
                worst
            }
        };
        let worst = self.slots().reduce(worse)?;
        Some((worst, self.links.neighbours(worst).reduce(worse)?))
    }

    /// Returns the slots of all units, ascending.
    pub(crate) fn slots(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.live
            .iter()
            .enumerate()
            .filter(|(_, live)| **live)
            .map(|(slot, _)| slot)
    }

    pub(crate) fn links(&self) -> &Links {
        &self.links
    }

    pub(crate) fn values(&self, slot: usize) -> impl ExactSizeIterator<Item = S> + Clone + '_ {
        self.prototypes.values(slot)
    }

    /// Returns whether there is an id for another unit. After 2³² − 1 there are no more ids.
    pub(crate) fn has_ids_left(&self) -> bool {
        self.next_id < u32::MAX
    }

    /// Inserts a unit at `prototype`, without edges, and returns its slot, which is the last.
    pub(crate) fn insert(&mut self, prototype: &[S]) -> usize {
        let slot = self.prototypes.push();
        for (feature, value) in prototype.iter().enumerate() {
            self.prototypes.put(slot, feature, *value);
        }
        self.enter(None)
    }

    /// Inserts a unit half-way between two units, joined to both in place of their edge. Its slot
    /// is the last.
    pub(crate) fn split_edge(&mut self, a: usize, b: usize) {
        let half = S::from_f64(0.5);
        let slot = self.prototypes.push();
        for feature in 0..self.dimension() {
            let middle = half * (self.prototypes.at(a, feature) + self.prototypes.at(b, feature));
            self.prototypes.put(slot, feature, middle);
        }
        self.enter(Some((self.ids[a], self.ids[b])));
        self.cut(a, b);
        self.link(a, slot, 0);
        self.link(slot, b, 0);
    }

    fn enter(&mut self, between: Option<(UnitId, UnitId)>) -> usize {
        let id = UnitId(self.next_id);
        self.next_id += 1;
        self.links.push();
        self.ids.push(id);
        self.live.push(true);
        self.len += 1;
        self.events.push(Event::Inserted { id, between });
        let slot = self.ids.len() - 1;
        if let Some(tree) = &mut self.tree {
            tree.insert(slot, &self.prototypes);
        }
        slot
    }

    /// Removes a unit and its edges.
    pub(crate) fn remove(&mut self, slot: usize) {
        while let Some((other, _)) = self.links.last(slot) {
            self.cut(slot, other);
        }
        self.leave(slot);
        self.events.push(Event::Removed { id: self.ids[slot] });
    }

    /// Merges a unit into another, which takes over its edges with their ages. Where both had an
    /// edge, the younger age counts.
    pub(crate) fn merge(&mut self, gone: usize, into: usize) {
        while let Some((other, age)) = self.links.last(gone) {
            self.cut(gone, other);
            if other != into {
                let own = self.links.ages(into).find(|(end, _)| *end == other);
                self.link(into, other, own.map_or(age, |(_, own)| own.min(age)));
            }
        }
        self.leave(gone);
        self.events.push(Event::Merged {
            gone: self.ids[gone],
            into: self.ids[into],
        });
    }

    fn leave(&mut self, slot: usize) {
        if let Some(tree) = &mut self.tree {
            tree.remove(slot);
        }
        self.prototypes.vacate(slot);
        self.live[slot] = false;
        self.len -= 1;
    }

    /// Sets the age of the edge between two units, and makes the edge if it does not exist.
    #[inline]
    pub(crate) fn link(&mut self, a: usize, b: usize, age: u32) {
        if self.links.renew(a, b, age) {
            let (low, high) = (self.ids[a.min(b)], self.ids[a.max(b)]);
            self.events.push(Event::Linked(low, high));
        }
    }

    /// Removes an edge, if it exists.
    pub(crate) fn cut(&mut self, a: usize, b: usize) {
        if self.links.cut(a, b) {
            let (low, high) = (self.ids[a.min(b)], self.ids[a.max(b)]);
            self.events.push(Event::Unlinked(low, high));
        }
    }

    /// Ages the edges of a unit by one.
    #[inline]
    pub(crate) fn age_edges(&mut self, slot: usize) {
        self.links.age(slot);
    }

    /// Removes the edges of a unit that are too old, then its former neighbours without an edge.
    #[inline]
    pub(crate) fn drop_edges(&mut self, slot: usize, is_old: impl Fn(u32) -> bool) {
        for place in (0..self.links.degree(slot)).rev() {
            let (other, age) = self.links.at(slot, place);
            if is_old(age) {
                self.cut(slot, other);
                if self.links.degree(other) == 0 {
                    self.remove(other);
                }
            }
        }
    }

    /// Removes the edges of a unit that are older than `max_age`.
    #[inline]
    pub(crate) fn cut_old_edges(&mut self, slot: usize, max_age: u32) {
        for place in (0..self.links.degree(slot)).rev() {
            let (other, age) = self.links.at(slot, place);
            if age > max_age {
                self.cut(slot, other);
            }
        }
    }

    /// Moves a unit by `rate` of the way to `target`.
    #[inline]
    pub(crate) fn approach(&mut self, slot: usize, target: &[S], rate: S) {
        self.prototypes.approach(slot, target, rate);
        if let Some(tree) = &mut self.tree {
            tree.follow(slot, &self.prototypes);
        }
    }

    /// Moves each neighbour of a unit towards `target`, by the part of the way that `rate` gives
    /// for its slot.
    #[inline]
    pub(crate) fn approach_neighbours(
        &mut self,
        slot: usize,
        target: &[S],
        rate: impl Fn(usize) -> S,
    ) {
        for other in self.links.neighbours(slot) {
            self.prototypes.approach(other, target, rate(other));
            if let Some(tree) = &mut self.tree {
                tree.follow(other, &self.prototypes);
            }
        }
    }

    /// Finishes the processing of an input. Builds the index once it pays, and closes the gaps that
    /// removed units left if it is worthwhile. It closes them in `per_unit` as well, which has one
    /// item per slot. Earlier slots are no longer valid.
    #[inline]
    pub(crate) fn tidy<T: Copy>(&mut self, per_unit: &mut Vec<T>) {
        let blocks = |units: usize| units.div_ceil(prototypes::LANES);
        let used = blocks(self.ids.len());
        // The limit is an eighth of the blocks, so that gaps cost little per removal and little per
        // search.
        if blocks(self.len) + (used / 8).max(1) <= used {
            self.close_gaps(per_unit);
        }
        self.consider_tree();
    }

    #[cold]
    fn close_gaps<T: Copy>(&mut self, per_unit: &mut Vec<T>) {
        self.renumbered.clear();
        let mut to = 0;
        for from in 0..self.ids.len() {
            if !self.live[from] {
                self.renumbered.push(u32::MAX);
                continue;
            }
            self.renumbered.push(to as u32);
            self.prototypes.copy(from, to);
            self.ids[to] = self.ids[from];
            per_unit[to] = per_unit[from];
            to += 1;
        }
        self.prototypes.truncate(to);
        self.links.renumber(&self.renumbered);
        if let Some(tree) = &mut self.tree {
            tree.renumber(&self.renumbered);
        }
        self.ids.truncate(to);
        self.live.clear();
        self.live.resize(to, true);
        per_unit.truncate(to);
    }
}

/// Returns the squared distance of two vectors, in which each lane sums its own features.
#[inline(always)]
fn squared_distance<S: Scalar>(a: &[S], b: &[S], weights: Option<&[S]>) -> S {
    match weights {
        None => sum_in_lanes(a, b, |_, square| square),
        Some(weights) => sum_in_lanes(a, b, |at, square| weights[at] * square),
    }
}

#[inline(always)]
fn sum_in_lanes<S: Scalar>(a: &[S], b: &[S], term: impl Fn(usize, S) -> S) -> S {
    const LANES: usize = prototypes::LANES;
    let mut sums = [S::ZERO; LANES];
    let pieces = a.chunks_exact(LANES).zip(b.chunks_exact(LANES));
    for (piece, (a, b)) in pieces.enumerate() {
        for (lane, sum) in sums.iter_mut().enumerate() {
            let difference = a[lane] - b[lane];
            *sum += term(piece * LANES + lane, difference * difference);
        }
    }
    let whole = a.len() / LANES * LANES;
    let mut sum = sums.into_iter().fold(S::ZERO, |sum, lane| sum + lane);
    for at in whole..a.len() {
        let difference = a[at] - b[at];
        sum += term(at, difference * difference);
    }
    sum
}

/// An edge and how often its ends have won since it was made or renewed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Edge {
    /// Units that the edge joins, the smaller id first.
    pub ends: (UnitId, UnitId),
    /// Number of inputs that one of the edge's ends has won since it was renewed.
    pub age: u32,
}
