//! Growing neural gas: Fritzke's, the equilibrium GNG of SODA and MSLST, and GNG-U.

mod config;
mod decay;
mod saved;

use alloc::vec::Vec;

use decay::Decay;

pub use config::{ErrorKind, GngConfig, GrowthGate, Removal, StepOrder, Utility};
pub use saved::SavedGng;

use crate::network::{Best, Candidate, FEW};
use crate::{
    Events, InputError, Lanes, NearestTwo, Network, Quantizer, QuantizerConfigError, Scalar,
    UnitId, UnitSearch, UnknownUnit,
};

/// A growing neural gas.
///
/// It begins empty. The first input and the first one that differs from it become the first two
/// units, joined by an edge. Inputs until then do not count as steps.
///
/// ```
/// use tolman_quantizers::{Gng, GngConfig, Quantizer};
///
/// let mut config = GngConfig::default();
/// config.max_units = 20;
/// let mut gng = Gng::<f32>::new(2, config)?;
/// for step in 0..3000_u16 {
///     let angle = f32::from(step) * 2.4;
///     gng.observe(&[angle.cos(), angle.sin()])?;
/// }
/// assert_eq!(gng.network().len(), 20);
/// assert!(gng.nearest(&[1.0, 0.0])?.distance() < 0.3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "SavedGng<S>", into = "SavedGng<S>")
)]
pub struct Gng<S: Scalar> {
    config: GngConfig,
    network: Network<S>,
    /// Error and utility of each unit, by slot.
    sums: Vec<Sums>,
    decay: Decay,
    steps: u64,
}

/// Sums over the inputs a unit wins, as [`Decay`] keeps them.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    error: f64,
    utility: f64,
}

impl<S: Scalar> Gng<S> {
    /// Returns an empty network for inputs of `dimension` features.
    ///
    /// # Errors
    /// If the dimension is 0 or a field of `config` is outside its range.
    pub fn new(dimension: usize, config: GngConfig) -> Result<Self, QuantizerConfigError> {
        Self::around(Network::new(dimension)?, config)
    }

    /// Returns an empty network whose squared distance is Σ w (x − p)², with one weight w per
    /// feature.
    ///
    /// # Errors
    /// If there are no weights, one is negative or not finite, none is above zero, or a field of
    /// `config` is outside its range.
    pub fn weighted(weights: &[S], config: GngConfig) -> Result<Self, QuantizerConfigError> {
        Self::around(Network::weighted(weights)?, config)
    }

    fn around(network: Network<S>, config: GngConfig) -> Result<Self, QuantizerConfigError> {
        config.check()?;
        Ok(Self {
            config,
            network,
            sums: Vec::new(),
            decay: Decay::none_yet(),
            steps: 0,
        })
    }

    /// Inserts units at the given positions before the first input, each joined to the one before.
    ///
    /// # Errors
    /// If there are fewer than two units, one is not a valid input, or the network is not empty.
    pub fn begin_with<P: AsRef<[S]>>(
        &mut self,
        prototypes: &[P],
    ) -> Result<(), QuantizerConfigError> {
        if prototypes.len() < 2 || !self.network.is_empty() {
            return Err(QuantizerConfigError::TooFewUnits {
                found: prototypes.len(),
            });
        }
        for (unit, prototype) in prototypes.iter().enumerate() {
            self.network
                .check(prototype.as_ref())
                .map_err(|source| QuantizerConfigError::BadUnit { unit, source })?;
        }
        let mut last = None;
        for prototype in prototypes {
            last = Some(self.seed(prototype.as_ref(), last));
        }
        self.network.tidy(&mut self.sums);
        Ok(())
    }

    /// Chooses how the nearest units are searched for. It changes no result.
    pub fn set_search(&mut self, search: UnitSearch, lanes: Lanes) {
        self.network.set_search(search, lanes);
    }

    /// Returns the configuration.
    pub fn config(&self) -> &GngConfig {
        &self.config
    }

    /// Returns the number of learnt inputs, not counting those before there were two units.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Merges one unit into another, for a caller who knows that both mean the same. The unit that
    /// stays keeps its prototype, takes over the edges with their ages, and adds the other's error
    /// and utility to its own. If they had only each other, it is joined to the unit nearest to it.
    /// Merging a unit with itself does nothing.
    ///
    /// # Errors
    /// If one of the units is not there.
    pub fn merge(&mut self, gone: UnitId, into: UnitId) -> Result<(), UnknownUnit> {
        let (from, to) = (self.network.slot(gone)?, self.network.slot(into)?);
        if from == to {
            return Ok(());
        }
        self.network.merge(from, to);
        let sums = self.sums[from];
        self.sums[to].error += sums.error;
        self.sums[to].utility += sums.utility;
        if self.network.links().degree(to) == 0
            && let Some(other) = self.network.nearest_other(to)
        {
            self.network.link(to, other, 0);
        }
        self.network.tidy(&mut self.sums);
        Ok(())
    }

    /// Returns the error a unit has gathered, decayed; squared units of the features for squared
    /// errors.
    ///
    /// # Errors
    /// If there is no such unit.
    pub fn error(&self, id: UnitId) -> Result<f64, UnknownUnit> {
        let slot = self.network.slot(id)?;
        Ok(self.decay.value(self.sums[slot].error))
    }

    /// Returns the utility a unit has gathered, decayed as errors are; 0 unless
    /// [`GngConfig::utility`] is chosen.
    ///
    /// # Errors
    /// If there is no such unit.
    pub fn utility(&self, id: UnitId) -> Result<f64, UnknownUnit> {
        let slot = self.network.slot(id)?;
        Ok(self.decay.value(self.sums[slot].utility))
    }

    /// Returns the mean of all units' errors, which the [`GrowthGate`] looks at; 0 if there are no
    /// units.
    ///
    /// # Complexity
    /// Units.
    pub fn mean_error(&self) -> f64 {
        let sum: f64 = self.network.slots().map(|slot| self.sums[slot].error).sum();
        self.decay.value(sum) / self.network.len().max(1) as f64
    }

    /// Adds a unit at `prototype`, joined to `other`, and returns its slot.
    fn seed(&mut self, prototype: &[S], other: Option<usize>) -> usize {
        let slot = self.network.insert(prototype);
        self.sums.push(Sums::default());
        if let Some(other) = other {
            self.network.link(other, slot, 0);
        }
        slot
    }

    /// Learns from an input while there are fewer than two units: each new point makes a unit.
    #[cold]
    fn begin(&mut self, input: &[S], best: Best<S>) -> NearestTwo<S> {
        let met = self.network.found(best.first);
        if let Some(first) = met.filter(|met| met.squared_distance <= S::ZERO) {
            // The input equals the only unit.
            let second = None;
            return NearestTwo { first, second };
        }
        let slot = self.seed(input, met.map(|_| best.first.slot as usize));
        NearestTwo {
            first: self.network.at(slot),
            second: met,
        }
    }

    /// Learns from one input, given its two nearest units.
    fn step(&mut self, input: &[S], best: Best<S>) {
        let (first, second) = (best.first.slot as usize, best.second.slot as usize);
        let max_age = self.config.max_age;
        self.steps += 1;
        match self.config.order {
            StepOrder::Fritzke => {
                self.network.age_edges(first);
                self.charge(input, best);
                self.adapt(first, input);
                self.network.link(first, second, 0);
                self.network.drop_edges(first, |age| age > max_age);
                self.grow_if_due();
                self.decay_sums();
            }
            StepOrder::Mslst => {
                self.network.link(first, second, 0);
                self.network.age_edges(first);
                self.charge(input, best);
                self.adapt(first, input);
                self.network.drop_edges(first, |age| age > max_age);
                self.decay_sums();
                self.grow_if_due();
            }
        }
        if let Some(utility) = self.config.utility
            && utility.removal == Removal::EveryInput
        {
            self.drop_useless(utility);
        }
    }

    /// Learns from the inputs that `rows` holds in turn, faster than one by one where
    /// there are many features: for some inputs at once the two nearest units are found by their
    /// products with all units. Then each input is learned in its order, with its distances to the
    /// two as they are by then. The units so differ a little from those of
    /// [`observe`](Quantizer::observe), and they do not depend on how inputs are divided among
    /// calls only if each call has a multiple of `batch` inputs. The network never grows within a
    /// batch. With few features and many units it does what `observe` does.
    ///
    /// # Errors
    /// If `rows` is not a whole number of inputs, or one of them is invalid. Nothing is learned
    /// then.
    pub fn observe_batch(&mut self, rows: &[S], batch: usize) -> Result<(), InputError> {
        let dimension = self.network.dimension();
        for input in rows.chunks(dimension) {
            self.network.check(input)?;
        }
        for mut rows in rows.chunks(batch.max(1) * dimension) {
            while !rows.is_empty() {
                let now = match self.network.len() {
                    0..2 => 1,
                    _ => (rows.len() / dimension).min(self.until_growth()),
                };
                let (learned, later) = rows.split_at(now * dimension);
                let products = match now {
                    0..FEW => None,
                    _ => self.network.nearest_by_product(learned),
                };
                if let Some(products) = products {
                    self.network.lie_in_turn(true);
                    self.learn_by(learned, &products.best);
                } else {
                    self.network.lie_in_turn(false);
                    for input in learned.chunks_exact(dimension) {
                        self.observe(input)?;
                    }
                }
                rows = later;
            }
        }
        self.network.lie_in_turn(false);
        Ok(())
    }

    /// Returns the number of inputs up to the next at which the network may grow.
    fn until_growth(&self) -> usize {
        if self.network.len() >= self.config.max_units && self.config.utility.is_none() {
            return usize::MAX;
        }
        let period = u64::from(self.config.growth_period);
        usize::try_from(period - self.steps % period).unwrap_or(usize::MAX)
    }

    /// Learns from inputs, given the two units that were nearest to each before.
    fn learn_by(&mut self, rows: &[S], before: &[Best<S>]) {
        let inputs = rows.chunks_exact(self.network.dimension());
        for (input, before) in inputs.zip(before) {
            let now = |slot| self.network.candidate(slot, input);
            let best = match (now(before.first.slot), now(before.second.slot)) {
                (Some(first), Some(second)) => {
                    let mut best = Best::none();
                    best.offer(first);
                    best.offer(second);
                    best
                }
                // One of them has gone meanwhile.
                _ => {
                    self.network.lie_in_turn(false);
                    let best = self.network.search(input);
                    self.network.lie_in_turn(true);
                    best
                }
            };
            self.step(input, best);
        }
        self.network.tidy(&mut self.sums);
    }

    /// Adds to the winner's error and utility.
    fn charge(&mut self, input: &[S], best: Best<S>) {
        let error = |candidate: Candidate<S>| {
            let squared = candidate.squared_distance.to_f64();
            match self.config.error {
                ErrorKind::Squared => squared,
                ErrorKind::Absolute => libm::sqrt(squared),
                ErrorKind::Relative => relative_error(squared, self.network.squared_length(input)),
            }
        };
        let own = error(best.first);
        let sums = &mut self.sums[best.first.slot as usize];
        sums.error += self.decay.kept(own);
        if self.config.utility.is_some() {
            sums.utility += self.decay.kept(error(best.second) - own);
        }
    }

    /// Moves the winner and its neighbours towards the input.
    fn adapt(&mut self, winner: usize, input: &[S]) {
        let rate = S::from_f64(self.config.neighbour_rate);
        self.network
            .approach(winner, input, S::from_f64(self.config.winner_rate));
        self.network.approach_neighbours(winner, input, |_| rate);
    }

    fn decay_sums(&mut self) {
        if let Some(due) = self.decay.decay(self.config.decay) {
            for sums in &mut self.sums {
                sums.error *= due;
                sums.utility *= due;
            }
        }
    }

    fn grow_if_due(&mut self) {
        let due = self.steps.is_multiple_of(self.config.growth_period.into());
        if !due || !self.network.has_ids_left() || !self.gate_is_open() {
            return;
        }
        if self.network.len() >= self.config.max_units
            && let Some(utility) = self.config.utility
        {
            self.drop_useless(utility);
        }
        if self.network.len() < self.config.max_units {
            self.grow();
        }
    }

    fn gate_is_open(&self) -> bool {
        match self.config.gate {
            GrowthGate::Open => true,
            GrowthGate::MeanError { threshold } => self.mean_error() > threshold,
            GrowthGate::Rate { threshold } => {
                self.mean_error() * (1.0 - self.config.decay) > threshold
            }
        }
    }

    /// Inserts a unit half-way between the unit of largest error and its neighbour of largest
    /// error.
    fn grow(&mut self) {
        let error = |slot: usize| self.sums[slot].error;
        let Some((q, f)) = self.network.worst_edge(error) else {
            return;
        };
        self.network.split_edge(q, f);
        self.sums[q].error *= self.config.split_factor;
        self.sums[f].error *= self.config.split_factor;
        self.sums.push(Sums {
            error: self.sums[q].error,
            utility: 0.5 * (self.sums[q].utility + self.sums[f].utility),
        });
    }

    /// Removes the unit of least utility if the largest error is many times that utility (GNG-U).
    fn drop_useless(&mut self, utility: Utility) {
        let mut most_error = 0.0_f64;
        let mut least: Option<(usize, f64)> = None;
        for slot in self.network.slots() {
            let sums = self.sums[slot];
            most_error = most_error.max(sums.error);
            if least.is_none_or(|(_, utility)| sums.utility < utility) {
                least = Some((slot, sums.utility));
            }
        }
        if let Some((slot, least)) = least
            && most_error > utility.threshold * least
        {
            self.remove_slot(slot);
        }
    }

    /// Removes a unit and the neighbours that it leaves without an edge, unless fewer than two
    /// units would remain.
    fn remove_slot(&mut self, slot: usize) {
        let links = self.network.links();
        let alone = links
            .neighbours(slot)
            .filter(|other| links.degree(*other) == 1)
            .count();
        if self.network.len() < alone + 3 {
            return;
        }
        self.network.drop_edges(slot, |_| true);
        self.network.remove(slot);
    }
}

/// Returns ‖x − w‖ / ‖x‖, given both squared.
fn relative_error(squared_distance: f64, squared_length: f64) -> f64 {
    if squared_distance <= 0.0 {
        0.0
    } else if squared_length <= 0.0 {
        1.0
    } else {
        libm::sqrt(squared_distance) / libm::sqrt(squared_length)
    }
}

impl<S: Scalar> Quantizer<S> for Gng<S> {
    fn observe(&mut self, input: &[S]) -> Result<NearestTwo<S>, InputError> {
        self.network.check(input)?;
        let best = self.network.search(input);
        let Some(met) = self.network.found_two(best) else {
            return Ok(self.begin(input, best));
        };
        self.step(input, best);
        self.network.tidy(&mut self.sums);
        Ok(met)
    }

    fn network(&self) -> &Network<S> {
        &self.network
    }

    fn events(&mut self) -> &mut Events {
        self.network.events()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns three units, at 0, 1 and 5, that never move, and whose sums never decay.
    fn resting(error: ErrorKind) -> Gng<f64> {
        let mut config = GngConfig::fritzke();
        (config.winner_rate, config.neighbour_rate) = (0.0, 0.0);
        (config.decay, config.error) = (1.0, error);
        (config.growth_period, config.max_units) = (1000, 3);
        config.utility = Some(Utility {
            threshold: 1e9,
            removal: Removal::WhenFull,
        });
        let mut gng = Gng::weighted(&[4.0], config).unwrap();
        gng.begin_with(&[[0.0], [1.0], [5.0]]).unwrap();
        gng
    }

    /// Distances count twice, as their squares have a weight of 4.
    #[test]
    fn the_winner_gathers_its_error_and_what_it_spares() {
        for error in [ErrorKind::Squared, ErrorKind::Absolute, ErrorKind::Relative] {
            let mut gng = resting(error);
            let (mut errors, mut utilities) = ([0.0; 3], [0.0; 3]);
            for input in [0.2, 0.4, 0.9, 4.0, 6.5, -1.0] {
                gng.observe(&[input]).unwrap();
                let by = |unit: f64| {
                    let distance = 2.0 * (input - unit).abs();
                    match error {
                        ErrorKind::Squared => distance * distance,
                        ErrorKind::Absolute => distance,
                        ErrorKind::Relative => distance / (2.0 * input.abs()),
                    }
                };
                let mut all = [0.0, 1.0, 5.0]
                    .map(by)
                    .into_iter()
                    .enumerate()
                    .collect::<Vec<_>>();
                all.sort_by(|a, b| a.1.total_cmp(&b.1));
                errors[all[0].0] += all[0].1;
                utilities[all[0].0] += all[1].1 - all[0].1;
            }
            for slot in 0..3 {
                let sums = gng.sums[slot];
                assert!((gng.decay.value(sums.error) - errors[slot]).abs() < 1e-9);
                assert!((gng.decay.value(sums.utility) - utilities[slot]).abs() < 1e-9);
                assert!((gng.error(UnitId(slot as u32)).unwrap() - errors[slot]).abs() < 1e-9);
            }
            let mean = errors.iter().sum::<f64>() / 3.0;
            assert!((gng.mean_error() - mean).abs() < 1e-9);
        }
    }

    /// Two units that had only each other: the one that stays is joined to the nearest of the rest.
    #[test]
    fn a_merged_unit_is_joined_only_if_it_has_no_edge() {
        for is_joined in [false, true] {
            let mut gng = Gng::new(1, GngConfig::fritzke()).unwrap();
            gng.begin_with(&[[0.0], [1.0], [6.0], [5.0]]).unwrap();
            for (slot, sums) in gng.sums.iter_mut().enumerate() {
                (sums.error, sums.utility) = (slot as f64 + 1.0, 10.0 * slot as f64);
            }
            if !is_joined {
                gng.network.link(1, 2, 99);
                gng.network.cut_old_edges(1, 50);
            }
            gng.merge(UnitId(0), UnitId(1)).unwrap();
            let mut ends: Vec<_> = gng.network.edges().map(|edge| edge.ends).collect();
            ends.sort_unstable();
            let joined = if is_joined { 2 } else { 3 };
            let joined = (UnitId(1), UnitId(joined));
            assert_eq!(ends, [joined, (UnitId(2), UnitId(3))], "{is_joined}");
            let slot = gng.network.slot(UnitId(1)).unwrap();
            let Sums { error, utility } = gng.sums[slot];
            assert!((error - 3.0).abs() < 1e-12 && (utility - 10.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_relative_error_is_a_share_of_the_input_s_length() {
        for (squared, length, expected) in [
            (4.0, 16.0, 0.5),
            (9.0, 1.0, 3.0),
            (0.0, 16.0, 0.0),
            (0.0, 0.0, 0.0),
            // Any distance from an input at the origin counts as 1.
            (4.0, 0.0, 1.0),
        ] {
            let found = relative_error(squared, length);
            assert!(
                (found - expected).abs() < 1e-12,
                "{squared} {length}: {found}"
            );
        }
    }
}
