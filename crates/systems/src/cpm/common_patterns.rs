use rand::{Rng, RngExt};
use thiserror::Error;
use tolman_control::epuck::FEATURES;
use tolman_maps::cpm::{Dictionary, DictionaryError, PatternId};
use tolman_quantizers::{
    Denoising, InputError, Quantizer, QuantizerConfigError, Soinn, SoinnConfig,
};

use super::robot::CpmRobot;
use super::walker::{Observation, WalkResult, Walker};

/// C: the common patterns. In the paper "a representative vector of each cluster is a
/// common-pattern CP" (section 4.1). Ours are the units of SOINN, because with clusters the robot
/// recognizes fewer loops.
#[derive(Clone, Debug)]
pub struct CommonPatterns {
    dictionary: Dictionary,
    /// Units of SOINN with their patterns. A unit holds the observation and the one seen when
    /// walking the other way.
    units: Vec<([f64; FEATURES], PatternId)>,
    /// Number of SOINN's units.
    pub unit_count: u32,
    /// Number of clusters of the units.
    pub cluster_count: u32,
}

/// Value of the landmark element at a landmark.
///
/// Start and goal have a common pattern of their own, which no path has. It is the farthest from
/// all others. So it sets d_max, and with it how similar fragments have to be. The paper gives no
/// value.
const LANDMARK: f64 = 100.0;

/// Returns the configuration of SOINN in the paper, λ = age_dead = 20. Here no unit with a
/// neighbour counts as noise.
#[must_use]
pub fn soinn() -> SoinnConfig {
    let mut config = SoinnConfig::cpm();
    config.denoising = Denoising::FewWins { c: 0.0 };
    config
}

/// Length of the walk in which a robot learns its common patterns.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Lesson {
    /// Learns until it has this many observations. The paper's simulated robot had 1000 (section
    /// 5).
    Observations(usize),
    /// Learns for this many seconds, and then to the end of its current fragment. The paper's real
    /// robot had 5400 (section 7).
    Seconds(f64),
}

/// Lets a robot wander through a learning maze, taking random branches at junctions. Returns its
/// observations until the lesson was over: "the robot can learn the CPs for ca. 1500 s; thereby
/// 1000 steps are taken".
///
/// # Errors
/// [`WalkError`](super::WalkError).
pub fn wander<B: CpmRobot>(
    walker: &mut Walker<B>,
    lesson: Lesson,
    rng: &mut impl Rng,
) -> WalkResult<Vec<Observation>, B> {
    let mut seen = Vec::new();
    let begun = walker.time_us();
    let mut degree = walker.begin()?.degree;
    loop {
        let is_over = match lesson {
            Lesson::Observations(count) => seen.len() >= count,
            Lesson::Seconds(seconds) => (walker.time_us() - begun) as f64 * 1e-6 >= seconds,
        };
        if is_over {
            break;
        }
        let branch = if degree == 1 {
            0
        } else {
            rng.random_range(1..degree)
        };
        let walk = walker.walk(branch as usize, 0, None)?;
        if let Some(sighting) = walk.sighting {
            seen.extend(walk.observations);
            degree = sighting.degree;
        }
    }
    if let Lesson::Observations(count) = lesson {
        seen.truncate(count);
    }
    Ok(seen)
}

impl CommonPatterns {
    /// Learns the common patterns of observations by SOINN.
    ///
    /// # Errors
    /// [`LearnPatternsError`].
    pub fn learn(
        observations: &[Observation],
        config: SoinnConfig,
    ) -> Result<Self, LearnPatternsError> {
        let mut soinn = Soinn::<f64>::new(FEATURES, config)?;
        for observation in observations {
            soinn.observe(&observation.feature)?;
        }
        let network = soinn.network();
        // The representative of each unit: the mean of the observations nearest to it, with each
        // observation's view of the other direction.
        let mut means = vec![([0.0; FEATURES], [0.0; FEATURES], 0.0); network.len()];
        let ids: Vec<_> = network.ids().collect();
        for observation in observations {
            let nearest = network.nearest(&observation.feature)?.id;
            let rank = ids.iter().position(|id| *id == nearest).unwrap_or(0);
            let (ahead, back, count) = &mut means[rank];
            for feature in 0..FEATURES {
                ahead[feature] += observation.feature[feature];
                back[feature] += observation.half_turned[feature];
            }
            *count += 1.0;
        }
        let mut dictionary = Dictionary::new(FEATURES);
        let mut units = Vec::new();
        for (ahead, back, count) in means {
            if count > 0.0 {
                let [ahead, back] = [ahead, back].map(|sum| sum.map(|sum| sum / count));
                let pattern = dictionary.learn(&ahead, &back, 0.0)?;
                units.push((ahead, pattern));
                units.push((back, dictionary.half_turned(pattern)));
            }
        }
        learn_landmark(&mut dictionary)?;
        if units.is_empty() {
            return Err(LearnPatternsError::Nothing {
                observations: observations.len(),
            });
        }
        Ok(Self {
            dictionary,
            units,
            unit_count: network.len() as u32,
            cluster_count: network.clusters().count() as u32,
        })
    }

    /// Returns the patterns of a robot without observations: landmarks only. It
    /// [learns](Self::learn_on) the others on its way.
    ///
    /// # Errors
    /// As [`Dictionary::learn`].
    pub fn none() -> Result<Self, DictionaryError> {
        let mut dictionary = Dictionary::new(FEATURES);
        learn_landmark(&mut dictionary)?;
        Ok(Self::restored(dictionary, 0, 0))
    }

    /// Returns the patterns of observations and learns new ones.
    ///
    /// An observation farther than `tolerance` from all known patterns becomes a pattern itself:
    /// "the CPs must be learned incrementally" (section 8). Older sequences stay valid.
    ///
    /// # Errors
    /// If an observation or the tolerance is not a number, or the tolerance is negative.
    pub fn learn_on(
        &mut self,
        observations: &[Observation],
        tolerance: f64,
    ) -> Result<Vec<PatternId>, DictionaryError> {
        let mut patterns = Vec::with_capacity(observations.len());
        for Observation {
            feature,
            half_turned,
        } in observations
        {
            let known = self.dictionary.len() as u32;
            patterns.push(self.dictionary.learn(feature, half_turned, tolerance)?);
            let new = (known..self.dictionary.len() as u32).map(PatternId);
            self.units.extend(
                new.zip([*feature, *half_turned])
                    .map(|(id, unit)| (unit, id)),
            );
        }
        Ok(patterns)
    }

    /// Returns the patterns from a dictionary and the counts of SOINN, as learned before.
    #[must_use]
    pub fn restored(dictionary: Dictionary, unit_count: u32, cluster_count: u32) -> Self {
        let patterns = (0..dictionary.len() as u32).map(PatternId);
        let units = patterns.filter_map(|pattern| {
            let prototype = dictionary.prototype(pattern)?;
            let unit = <[f64; FEATURES]>::try_from(prototype).ok()?;
            // A landmark's pattern belongs to no unit.
            (unit[FEATURES - 1] < LANDMARK / 2.0).then_some((unit, pattern))
        });
        Self {
            units: units.collect(),
            dictionary,
            unit_count,
            cluster_count,
        }
    }

    /// Returns the common pattern of a feature: that of the nearest unit ("classified to the
    /// corresponded CP").
    #[must_use]
    pub fn pattern(&self, feature: &[f64; FEATURES]) -> PatternId {
        let distance = |unit: &[f64; FEATURES]| {
            let squares = unit.iter().zip(feature).map(|(a, b)| (a - b) * (a - b));
            squares.sum::<f64>()
        };
        let nearest = self
            .units
            .iter()
            .min_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b)));
        nearest.map_or(PatternId(0), |(_, pattern)| *pattern)
    }

    /// Returns the patterns of observations.
    #[must_use]
    pub fn patterns(&self, observations: &[Observation]) -> Vec<PatternId> {
        let each = observations.iter();
        each.map(|observation| self.pattern(&observation.feature))
            .collect()
    }

    /// Returns the patterns as the map's dictionary.
    #[must_use]
    pub const fn dictionary(&self) -> &Dictionary {
        &self.dictionary
    }
}

/// Adds the pattern of start and goal.
fn learn_landmark(dictionary: &mut Dictionary) -> Result<(), DictionaryError> {
    let mut landmark = [0.0; FEATURES];
    landmark[FEATURES - 1] = LANDMARK;
    dictionary.learn(&landmark, &landmark, 0.0)?;
    Ok(())
}

/// Reason why no patterns were learned.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LearnPatternsError {
    /// SOINN's configuration is invalid.
    #[error(transparent)]
    Config(#[from] QuantizerConfigError),
    /// An observation is invalid.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A prototype is invalid.
    #[error(transparent)]
    Dictionary(#[from] DictionaryError),
    /// SOINN kept no unit.
    #[error("SOINN made no pattern from {observations} observations; let the robot wander longer")]
    Nothing {
        /// Number of observations.
        observations: usize,
    },
}
