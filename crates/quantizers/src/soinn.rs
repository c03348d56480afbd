//! The self-organizing incremental neural network of Shen and Hasegawa.

mod config;
mod saved;
mod second_layer;

use alloc::vec::Vec;

pub use config::{Denoising, ErrorInsertion, SimilarityThreshold, SoinnConfig};
pub use saved::SavedSoinn;
pub use second_layer::{SecondLayerConfig, SecondLayerError, SecondThreshold};

use crate::network::{Best, Candidate};
use crate::{
    Events, InputError, Lanes, NearestTwo, Network, Quantizer, QuantizerConfigError, Scalar,
    UnitId, UnitSearch, UnknownUnit,
};

/// One layer of a SOINN: "An incremental network for on-line unsupervised classification and
/// topology learning" (Shen and Hasegawa 2006), algorithm 3.1.
///
/// An input far from what is known becomes a unit of its own. Any other input joins its two nearest
/// units and moves them, less the more they have won. The number of units need not be chosen.
/// Clusters are connected units. A [second layer](Self::second_layer) separates clusters that noise
/// has joined.
///
/// ```
/// use tolman_quantizers::{Quantizer, Soinn, SoinnConfig};
///
/// let mut soinn = Soinn::<f32>::new(2, SoinnConfig::noisy())?;
/// for step in 0..20_000_u16 {
///     let angle = f32::from(step) * 2.4;
///     soinn.observe(&[angle.cos(), angle.sin()])?;
/// }
/// // What is new and alone is taken for noise.
/// soinn.remove_noise();
/// assert_eq!(soinn.network().clusters().count(), 1);
/// assert!(soinn.nearest(&[1.0, 0.0])?.distance() < 0.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Where the paper is silent: a new unit counts the input it was made of as a win. The first input
/// and the first one that differs from it are the first two units, and not counted in periods of λ.
///
/// # Complexity
/// A search of the two nearest units an input, and units once a period.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "SavedSoinn<S>", into = "SavedSoinn<S>")
)]
pub struct Soinn<S: Scalar> {
    config: SoinnConfig,
    network: Network<S>,
    /// Tally of each unit, by slot.
    tallies: Vec<Tally>,
    steps: u64,
    /// Slots to remove. The vector is kept to avoid an allocation.
    doomed: Vec<usize>,
}

/// Memory of a unit of a [`Soinn`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tally {
    /// E: sum of the distances (not squared) of the inputs that the unit won.
    pub error: f64,
    /// M: number of inputs that the unit won, a fraction after an insertion.
    pub wins: f64,
    /// Step at which the unit was made. A unit inserted between two others has the step of the
    /// older one.
    pub since: u64,
    /// R: mean error E / M after the last insertion that the unit took part in; `None` before the
    /// first.
    pub radius: Option<f64>,
}

impl Tally {
    /// Returns the tally of a unit that was made of an input.
    fn new(since: u64) -> Self {
        Self {
            error: 0.0,
            wins: 1.0,
            since,
            radius: None,
        }
    }

    fn mean_error(&self) -> f64 {
        self.error / self.wins
    }

    /// Returns whether the unit's mean error exceeds the remembered radius.
    fn has_grown(&self) -> bool {
        self.radius.is_some_and(|radius| self.mean_error() > radius)
    }

    /// Returns the tally that a unit keeps after a new unit is inserted between it and another.
    fn reduced(self) -> Self {
        Self {
            error: self.error * 2.0 / 3.0,
            wins: self.wins * 0.75,
            ..self
        }
    }

    /// Returns the tally of a unit inserted between two others.
    fn between(q: Self, f: Self) -> Self {
        Self {
            error: (q.error + f.error) / 6.0,
            wins: 0.25 * (q.wins + f.wins),
            since: q.since.min(f.since),
            radius: q.radius.zip(f.radius).map(|(q, f)| 0.25 * (q + f)),
        }
    }

    fn remembering(self) -> Self {
        Self {
            radius: Some(self.mean_error()),
            ..self
        }
    }
}

impl<S: Scalar> Soinn<S> {
    /// Returns an empty network for inputs of `dimension` features.
    ///
    /// # Errors
    /// If the dimension is 0 or a field of `config` is outside its range.
    pub fn new(dimension: usize, config: SoinnConfig) -> Result<Self, QuantizerConfigError> {
        Self::around(Network::new(dimension)?, config)
    }

    /// Returns an empty network whose squared distance is Σ w (x − p)², with one weight w per
    /// feature.
    ///
    /// # Errors
    /// If there are no weights, one is negative or not finite, none is above zero, or a field of
    /// `config` is outside its range.
    pub fn weighted(weights: &[S], config: SoinnConfig) -> Result<Self, QuantizerConfigError> {
        Self::around(Network::weighted(weights)?, config)
    }

    fn around(network: Network<S>, config: SoinnConfig) -> Result<Self, QuantizerConfigError> {
        config.check()?;
        Ok(Self {
            config,
            network,
            tallies: Vec::new(),
            steps: 0,
            doomed: Vec::new(),
        })
    }

    /// Chooses how the nearest units are searched for. It changes no result.
    pub fn set_search(&mut self, search: UnitSearch, lanes: Lanes) {
        self.network.set_search(search, lanes);
    }

    /// Returns the configuration.
    pub fn config(&self) -> &SoinnConfig {
        &self.config
    }

    /// Returns the number of learnt inputs, not counting those before there were two units.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Returns M, the number of inputs that a unit has won, minus what it has passed to units
    /// inserted beside it.
    ///
    /// # Errors
    /// If there is no such unit.
    pub fn wins(&self, id: UnitId) -> Result<f64, UnknownUnit> {
        Ok(self.tallies[self.network.slot(id)?].wins)
    }

    /// Returns E, the sum of the distances (not squared) of the inputs that a unit has won. What it
    /// has passed to units inserted beside it is subtracted.
    ///
    /// # Errors
    /// If there is no such unit.
    pub fn error(&self, id: UnitId) -> Result<f64, UnknownUnit> {
        Ok(self.tallies[self.network.slot(id)?].error)
    }

    /// Learns a valid input.
    fn learn(&mut self, input: &[S]) -> NearestTwo<S> {
        let best = self.network.search(input);
        let Some(mut met) = self.network.found_two(best) else {
            return self.begin(input, best);
        };
        self.steps += 1;
        if self.is_similar(best.first) && self.is_similar(best.second) {
            self.adapt(input, best);
        } else if self.network.has_ids_left() {
            let slot = self.insert(input);
            met = NearestTwo {
                second: Some(met.first),
                first: self.network.at(slot),
            };
        }
        if self.steps.is_multiple_of(self.config.period.into()) {
            self.insert_where_error_is_large();
            self.remove_noise();
            if !self.network.contains(met.first.id) {
                // The unit that stood for the input was at once removed as noise.
                met = self.network.nearest_two(input).unwrap_or(met);
            }
        }
        self.network.tidy(&mut self.tallies);
        met
    }

    /// Learns from an input while there are fewer than two units: each new point makes a unit.
    #[cold]
    fn begin(&mut self, input: &[S], best: Best<S>) -> NearestTwo<S> {
        match self.network.found(best.first) {
            Some(first) if first.squared_distance <= S::ZERO => {
                self.tallies[best.first.slot as usize].wins += 1.0;
                let second = None;
                NearestTwo { first, second }
            }
            second => {
                let slot = self.insert(input);
                let first = self.network.at(slot);
                NearestTwo { first, second }
            }
        }
    }

    fn insert(&mut self, input: &[S]) -> usize {
        self.tallies.push(Tally::new(self.steps));
        self.network.insert(input)
    }

    /// Returns whether an input lies within the similarity threshold of a unit (algorithms 3.2 and
    /// 3.3).
    fn is_similar(&self, unit: Candidate<S>) -> bool {
        let (slot, squared) = (unit.slot as usize, unit.squared_distance);
        let reaches = |other| squared <= self.network.squared_distance(slot, other);
        match self.config.threshold {
            SimilarityThreshold::Constant(distance) => squared.to_f64() <= distance * distance,
            // A distance is at most the largest of several if it is at most any of them.
            SimilarityThreshold::Adaptive if self.network.links().degree(slot) > 0 => {
                self.network.links().neighbours(slot).any(reaches)
            }
            SimilarityThreshold::Adaptive => self
                .network
                .slots()
                .filter(|other| *other != slot)
                .all(reaches),
        }
    }

    /// Joins the two nearest units and moves the winner and its neighbours (steps 4 to 9).
    fn adapt(&mut self, input: &[S], best: Best<S>) {
        let (first, second) = (best.first.slot as usize, best.second.slot as usize);
        self.network.link(first, second, 0);
        self.network.age_edges(first);
        let tally = &mut self.tallies[first];
        tally.error += libm::sqrt(best.first.squared_distance.to_f64());
        tally.wins += 1.0;
        let rate = S::from_f64(1.0 / tally.wins);
        self.network.approach(first, input, rate);
        let tallies = &self.tallies;
        self.network.approach_neighbours(first, input, |other| {
            S::from_f64((0.01 / tallies[other].wins).min(1.0))
        });
        self.network.cut_old_edges(first, self.config.max_age);
    }

    /// Carries out the first half of step 10. An insertion that would be undone is not begun, so
    /// the network stays the same to the bit.
    fn insert_where_error_is_large(&mut self) {
        if self.config.insertion == ErrorInsertion::Off || !self.network.has_ids_left() {
            return;
        }
        let error = |slot: usize| self.tallies[slot].error;
        let Some((q, f)) = self.network.worst_edge(error) else {
            return;
        };
        let (old_q, old_f) = (self.tallies[q], self.tallies[f]);
        let tallies = [
            old_q.reduced(),
            old_f.reduced(),
            Tally::between(old_q, old_f),
        ];
        let mut grown = tallies.iter().map(Tally::has_grown);
        let undone = match self.config.insertion {
            ErrorInsertion::UnlessAllGrew => grown.all(|grown| grown),
            _ => grown.any(|grown| grown),
        };
        if undone {
            return;
        }
        self.network.split_edge(q, f);
        let [q_tally, f_tally, r_tally] = tallies.map(Tally::remembering);
        self.tallies[q] = q_tally;
        self.tallies[f] = f_tally;
        self.tallies.push(r_tally);
    }

    /// Removes the units that [`Denoising`] counts as noise. It is called automatically at the end
    /// of every period of λ inputs (step 10, its second half). Call it before you count clusters in
    /// the middle of a period, when some units are too new to have a neighbour.
    ///
    /// # Complexity
    /// Units.
    pub fn remove_noise(&mut self) {
        let units = self.network.len().max(1) as f64;
        let fewest = |tally: &Tally, mean: f64| match self.config.denoising {
            Denoising::FewWins { c } => c * mean,
            Denoising::LowRate { c } => c * ((self.steps - tally.since) as f64 / units),
            Denoising::Off => 0.0,
        };
        if self.config.denoising == Denoising::Off {
            return;
        }
        let wins = self.network.slots().map(|slot| self.tallies[slot].wins);
        let mean = wins.sum::<f64>() / units;
        self.doomed.clear();
        for slot in self.network.slots() {
            let tally = &self.tallies[slot];
            let is_noise = match self.network.links().degree(slot) {
                0 => true,
                1 => tally.wins < fewest(tally, mean),
                _ => false,
            };
            if is_noise {
                self.doomed.push(slot);
            }
        }
        for slot in &self.doomed {
            if self.network.len() > 2 {
                self.network.remove(*slot);
            }
        }
        self.network.tidy(&mut self.tallies);
    }
}

impl<S: Scalar> Quantizer<S> for Soinn<S> {
    fn observe(&mut self, input: &[S]) -> Result<NearestTwo<S>, InputError> {
        self.network.check(input)?;
        Ok(self.learn(input))
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
    use alloc::format;

    use super::*;

    #[test]
    fn an_insertion_undone_leaves_no_trace() {
        let mut soinn = Soinn::<f64>::new(2, SoinnConfig::noisy()).unwrap();
        soinn.events().listen();
        let (mut undone, mut done) = (0, 0);
        for step in 0..4000_u32 {
            let (angle, radius) = (f64::from(step) * 2.4, 1.0 + 0.1 * f64::from(step % 7));
            soinn
                .observe(&[radius * libm::cos(angle), radius * libm::sin(angle)])
                .unwrap();
            if step % 40 == 0 {
                let (before, units) = (format!("{soinn:?}"), soinn.network.len());
                soinn.insert_where_error_is_large();
                if soinn.network.len() == units {
                    assert_eq!(format!("{soinn:?}"), before);
                    undone += 1;
                } else {
                    done += 1;
                }
            }
        }
        assert!(undone > 5 && done > 5, "{undone} undone, {done} done");
    }

    fn tally(error: f64, wins: f64, since: u64, radius: Option<f64>) -> Tally {
        Tally {
            error,
            wins,
            since,
            radius,
        }
    }

    /// The shares of the dissertation's step 10: a third of the errors and a quarter of the wins go
    /// to the unit between.
    #[test]
    fn an_insertion_hands_on_errors_and_wins() {
        let q = tally(6.0, 8.0, 3, Some(0.5));
        let f = tally(3.0, 4.0, 2, Some(1.5));
        assert_eq!(q.reduced(), tally(4.0, 6.0, 3, Some(0.5)));
        assert_eq!(Tally::between(q, f), tally(1.5, 3.0, 2, Some(0.5)));
        let new = tally(3.0, 4.0, 2, None);
        assert_eq!(Tally::between(q, new).radius, None);
        assert_eq!(Tally::between(new, q).radius, None);
        assert_eq!(q.remembering(), tally(6.0, 8.0, 3, Some(0.75)));
        assert!(q.has_grown() && !q.remembering().has_grown() && !new.has_grown());
        assert_eq!(Tally::new(7), tally(0.0, 1.0, 7, None));
    }
}
