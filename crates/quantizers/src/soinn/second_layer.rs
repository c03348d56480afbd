//! The second layer: a SOINN that learns the units of the first, to tell clusters apart.

use alloc::vec;
use alloc::vec::Vec;

use rand::{Rng, RngExt};
use thiserror::Error;

use super::{SimilarityThreshold, Soinn, SoinnConfig};
use crate::error::within;
use crate::{QuantizerConfigError, Scalar};

/// Parameters by which the second layer learns.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SecondLayerConfig {
    /// Parameters of the layer itself. Its threshold is computed, so the value here is not used.
    pub layer: SoinnConfig,
    /// Rule for the threshold from the first layer.
    pub threshold: SecondThreshold,
    /// Number of its inputs: units of the first layer, drawn at random. The paper gives no number.
    pub inputs: u32,
}

/// The constant threshold T_c of the second layer.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum SecondThreshold {
    /// The smallest distance between two clusters of the first layer that is at least its mean edge
    /// length (Shen and Hasegawa 2006, algorithm 3.3). If no distance is that large, the largest
    /// one. If there is only one cluster, its longest edge.
    ///
    /// It assumes that the first layer has separated the clusters, which is the purpose of a second
    /// layer. Where noise joins two of them, the smallest remaining distance is too large, and they
    /// stay together.
    BetweenClusters,
    /// A multiple of the mean length of the first layer's edges. That length is algorithm 3.3's
    /// measure of how far apart units of one cluster lie. It does not depend on whether clusters
    /// are already separated.
    WithinClusters {
        /// Multiple, above 1 because the second layer has to be coarser than the first. 4 works
        /// where clusters are 5 or more edges apart.
        factor: f64,
    },
}

impl SecondLayerConfig {
    /// Returns the values of Shen and Hasegawa 2006: the parameters of the first layer, algorithm
    /// 3.3, and 25,000 inputs, which is ours.
    pub fn shen_hasegawa() -> Self {
        Self {
            layer: SoinnConfig::shen_hasegawa(),
            threshold: SecondThreshold::BetweenClusters,
            inputs: 25_000,
        }
    }

    /// Returns the values for noisy data. T_c is four times the mean length of the first layer's
    /// edges. λ = 500, because its few units have to find neighbours. The rest is the paper's
    /// (measured in `docs/notebook/quantizers.md`).
    pub fn noisy() -> Self {
        Self {
            layer: SoinnConfig {
                period: 500,
                ..SoinnConfig::shen_hasegawa()
            },
            threshold: SecondThreshold::WithinClusters { factor: 4.0 },
            inputs: 25_000,
        }
    }
}

/// Reason why there can be no second layer.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SecondLayerError {
    /// A field is outside its range.
    #[error(transparent)]
    Config(#[from] QuantizerConfigError),
    /// The first layer has fewer than two units, so it has no distances.
    #[error("the first layer has {found} units and needs two: let it observe more")]
    TooFewUnits {
        /// Number of units of the first layer.
        found: usize,
    },
}

impl<S: Scalar> Soinn<S> {
    /// Returns a second layer that has learnt the units of this one. Its clusters are those of the
    /// data.
    ///
    /// ```
    /// use rand_chacha::ChaCha8Rng;
    /// use rand_chacha::rand_core::SeedableRng;
    /// use tolman_quantizers::{Quantizer, SecondLayerConfig, Soinn, SoinnConfig};
    ///
    /// // Two bars, 1 apart.
    /// let mut first = Soinn::<f64>::new(2, SoinnConfig::noisy())?;
    /// for step in 0..20_000_u32 {
    ///     let along = f64::from(step) * 0.618_034 % 1.0;
    ///     first.observe(&[f64::from(step % 2), along])?;
    /// }
    /// first.remove_noise();
    /// let mut rng = ChaCha8Rng::seed_from_u64(1);
    /// let second = first.second_layer(&SecondLayerConfig::noisy(), &mut rng)?;
    /// assert_eq!(second.network().clusters().count(), 2);
    /// assert!(second.network().len() < first.network().len());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If a field of `config` is outside its range or this layer has fewer than two units.
    ///
    /// # Complexity
    /// Units² for the distances between clusters, then as many searches as `config.inputs`.
    pub fn second_layer(
        &self,
        config: &SecondLayerConfig,
        rng: &mut impl Rng,
    ) -> Result<Self, SecondLayerError> {
        let threshold = self.second_threshold(config.threshold)?;
        let layer = SoinnConfig {
            threshold: SimilarityThreshold::Constant(threshold),
            ..config.layer
        };
        let mut second = match self.network.weights() {
            None => Self::new(self.network.dimension(), layer)?,
            Some(weights) => Self::weighted(weights, layer)?,
        };
        let units: Vec<Vec<S>> = self
            .network
            .slots()
            .map(|slot| self.network.values(slot).collect())
            .collect();
        for _ in 0..config.inputs {
            let unit = rng.random_range(0..units.len() as u32);
            second.learn(&units[unit as usize]);
        }
        second.remove_noise();
        Ok(second)
    }

    /// Returns the constant threshold T_c.
    fn second_threshold(&self, threshold: SecondThreshold) -> Result<f64, SecondLayerError> {
        let found = self.network.len();
        if found < 2 {
            return Err(SecondLayerError::TooFewUnits { found });
        }
        let lengths = self.edge_lengths();
        let mean = lengths.iter().sum::<f64>() / lengths.len().max(1) as f64;
        match threshold {
            SecondThreshold::WithinClusters { factor } => {
                let above_1 = |value: f64| value > 1.0 && value.is_finite();
                within("threshold.factor", factor, (above_1, "finite and above 1"))?;
                Ok(factor * mean)
            }
            SecondThreshold::BetweenClusters => {
                let between = self.cluster_distances();
                let smallest = between.iter().copied().filter(|d| *d >= mean);
                let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
                Ok(match smallest.reduce(f64::min) {
                    Some(distance) => distance,
                    None if between.is_empty() => largest(&lengths),
                    None => largest(&between),
                })
            }
        }
    }

    fn edge_lengths(&self) -> Vec<f64> {
        let links = self.network.links();
        let edges = self.network.slots().flat_map(|a| {
            let later = links.neighbours(a).filter(move |b| a < *b);
            later.map(move |b| libm::sqrt(self.network.squared_distance(a, b).to_f64()))
        });
        edges.collect()
    }

    /// Returns, for every two clusters, the distance between their nearest units.
    fn cluster_distances(&self) -> Vec<f64> {
        let clusters = self.network.clusters();
        let labelled: Vec<(usize, usize)> = self
            .network
            .slots()
            .zip(clusters.iter().map(|(_, label)| label as usize))
            .collect();
        let count = clusters.count();
        // Distances by the greater label of the pair, then by the smaller.
        let mut nearest = vec![f64::INFINITY; count * count.saturating_sub(1) / 2];
        for (place, (a, label)) in labelled.iter().enumerate() {
            for (b, other) in &labelled[..place] {
                let (low, high) = (*label.min(other), *label.max(other));
                if low < high {
                    let nearest = &mut nearest[high * (high - 1) / 2 + low];
                    *nearest = nearest.min(self.network.squared_distance(*a, *b).to_f64());
                }
            }
        }
        nearest.into_iter().map(libm::sqrt).collect()
    }
}
