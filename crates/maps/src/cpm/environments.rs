use alloc::vec::Vec;

use thiserror::Error;
use tolman_quantizers::{AssociativeMemory, InputError, QuantizerConfigError, SoinnConfig};

use super::map::{CpMap, End};
use super::pattern::{Dictionary, DictionaryError, PatternId, euclidean};
use super::similarity::Sense;

/// The paths of several environments in one associative memory: the paper's fourth layer,
/// "introduced for the case in which the robot must experience more than one environment. A single
/// environment is represented by the associated path-fragments."
///
/// "Unlike the original SOINN-AM, our method does not limit to associative pairs. Specifically, our
/// method create the association A → B → C → D". One sequence recalls all that follow it on the
/// path, and with them the environment. A fragment's code consists of the prototypes at
/// [`SAMPLES`](Self::SAMPLES) places along it.
///
/// ```
/// use tolman_maps::cpm::{CpMapperConfig, Dictionary, Environments, CpMapper, PatternId, Sighting, Sign, Traversal, Turn};
///
/// let mut dictionary = Dictionary::new(1);
/// for pattern in 0..12 {
///     let prototype = [f64::from(pattern)];
///     dictionary.learn(&prototype, &prototype, 0.1)?;
/// }
/// let mut environments = Environments::new(&dictionary)?;
/// let mut mapper = CpMapper::new(CpMapperConfig::offline(), Sighting::plain(1))?;
/// for (turn, patterns) in [(0, [0, 1, 2]), (1, [5, 4, 3]), (2, [9, 9, 11])] {
///     let patterns = patterns.map(PatternId).to_vec();
///     let walk = Traversal { patterns, motion: None, sighting: Sighting::plain(3), bearings: None };
///     mapper.arrive(Turn(turn), &walk, &dictionary)?;
/// }
/// let map = mapper.map();
/// let path: Vec<_> = map.fragments().map(|(id, _)| id.end(Sign::Minus)).collect();
/// environments.learn(7, map, &path, &dictionary)?;
/// // From the first fragment, seen a little differently, to the others.
/// let recalled = environments.recall(&[0, 1, 1, 2].map(PatternId), &dictionary)?;
/// assert_eq!(recalled.environment, 7);
/// assert_eq!(recalled.chain, path);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Environments {
    memory: AssociativeMemory<f64>,
    dimension: usize,
    learned: Vec<Learned>,
}

#[derive(Clone, Debug)]
struct Learned {
    environment: u32,
    enter: End,
    code: Vec<f64>,
}

/// Answer of the memory to one sequence.
#[derive(Clone, Debug, PartialEq)]
pub struct Recollection {
    /// Environment of the sequence.
    pub environment: u32,
    /// The recognized fragment and those that follow it on the learned path, each by the end at
    /// which it is entered. Stops at the end of the path, or before a repeated fragment.
    pub chain: Vec<End>,
    /// Distance of the sequence's code from that of the recognized fragment, per sample, in
    /// distances of prototypes.
    pub distance: f64,
}

/// Reason why a path cannot be learned or recalled.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RecallError {
    /// Nothing was learned yet.
    #[error("no path was learned yet; learn one first")]
    NothingLearned,
    /// A sequence without patterns, or a path of fewer than two fragments, has nothing to
    /// associate.
    #[error("nothing to associate: a path needs two fragments, each with an observation")]
    TooShort,
    /// A fragment of the path is not on the map.
    #[error("fragment {} of the path is not on the map; give the map on which the path was walked", .0.fragment.0)]
    NoSuchFragment(End),
    /// A pattern is not in the dictionary.
    #[error(transparent)]
    Dictionary(#[from] DictionaryError),
    /// Prototypes without features.
    #[error(transparent)]
    Config(#[from] QuantizerConfigError),
    /// The memory refuses a code.
    #[error(transparent)]
    Input(#[from] InputError),
}

impl Environments {
    /// Number of places along a fragment that its code holds.
    pub const SAMPLES: usize = 16;

    /// Returns an empty memory for sequences of a dictionary and of all its later versions.
    ///
    /// # Errors
    /// [`RecallError::Config`] if its patterns have no features.
    pub fn new(dictionary: &Dictionary) -> Result<Self, RecallError> {
        let dimension = dictionary.dimension() * Self::SAMPLES;
        Ok(Self {
            memory: AssociativeMemory::new(dimension, dimension, SoinnConfig::exact())?,
            dimension,
            learned: Vec::new(),
        })
    }

    /// Associates each fragment of a path with the next. A fragment is given by the end at which it
    /// is entered. O(fragments · learned).
    ///
    /// # Errors
    /// [`RecallError`] if the path is too short or not on the map. Nothing is learned then.
    pub fn learn(
        &mut self,
        environment: u32,
        map: &CpMap,
        path: &[End],
        dictionary: &Dictionary,
    ) -> Result<(), RecallError> {
        let mut codes = Vec::with_capacity(path.len());
        for enter in path {
            let fragment = map
                .fragment(enter.fragment)
                .ok_or(RecallError::NoSuchFragment(*enter))?;
            let walked = Sense::entered_at(enter.sign);
            let sequence = walked.of_sequence(dictionary, &fragment.patterns)?;
            codes.push(self.code(&sequence, dictionary)?);
        }
        if codes.len() < 2 {
            return Err(RecallError::TooShort);
        }
        for (key, response) in codes.iter().zip(&codes[1..]) {
            self.memory.associate(key, response)?;
        }
        for (enter, code) in path.iter().zip(codes) {
            let is_known =
                |known: &Learned| known.environment == environment && known.enter == *enter;
            if !self.learned.iter().any(is_known) {
                self.learned.push(Learned {
                    environment,
                    enter: *enter,
                    code,
                });
            }
        }
        Ok(())
    }

    /// Returns the fragment most similar to a sequence, its environment, and the fragments that
    /// follow. O(learned · chain).
    ///
    /// # Errors
    /// [`RecallError`] if nothing was learned, or a pattern is not in the dictionary.
    pub fn recall(
        &self,
        sequence: &[PatternId],
        dictionary: &Dictionary,
    ) -> Result<Recollection, RecallError> {
        let code = self.code(sequence, dictionary)?;
        let (first, distance) = self.nearest(&code).ok_or(RecallError::NothingLearned)?;
        let mut chain = Vec::from([first.enter]);
        // What is recalled is what was learned, up to the mean of equal lessons.
        let reach = 1e-6 * (1.0 + dictionary.greatest_distance());
        for recall in self.memory.chain(&first.code, reach)? {
            let Some((next, _)) = self.nearest(&recall.values) else {
                break;
            };
            if next.environment != first.environment || chain.contains(&next.enter) {
                break;
            }
            chain.push(next.enter);
        }
        Ok(Recollection {
            environment: first.environment,
            chain,
            distance: distance / libm::sqrt(Self::SAMPLES as f64),
        })
    }

    /// Returns the learned fragment with the nearest code and its distance; the first of equals.
    fn nearest(&self, code: &[f64]) -> Option<(&Learned, f64)> {
        let all = self.learned.iter();
        let all = all.map(|known| (known, euclidean(&known.code, code)));
        all.min_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Returns the prototypes at evenly spaced positions of a sequence, one by one.
    fn code(
        &self,
        sequence: &[PatternId],
        dictionary: &Dictionary,
    ) -> Result<Vec<f64>, RecallError> {
        dictionary.check(sequence)?;
        let mut code = Vec::with_capacity(self.dimension);
        for sample in 0..Self::SAMPLES {
            let place = (2 * sample + 1) * sequence.len() / (2 * Self::SAMPLES);
            let pattern = sequence.get(place).ok_or(RecallError::TooShort)?;
            code.extend(dictionary.prototype(*pattern).into_iter().flatten());
        }
        Ok(code)
    }
}
