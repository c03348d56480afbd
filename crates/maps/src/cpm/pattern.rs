use alloc::vec::Vec;

use thiserror::Error;

/// A common pattern (CP): its number in a [`Dictionary`], from 0. It never changes its meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PatternId(pub u32);

/// C, the set of common patterns: the prototypes of what the robot observes.
///
/// A dictionary only grows: a pattern keeps its number and its prototype. Sequences written with an
/// earlier [version](Self::version) therefore stay readable beside new ones. A version is a number
/// of patterns. Its [fingerprint](Version::fingerprint) tells it from those of other robots.
///
/// ```
/// use tolman_maps::cpm::{Dictionary, PatternId};
///
/// let mut dictionary = Dictionary::new(2);
/// // A wall to the right, which seen the other way is a wall to the left; and no wall, which
/// // stays no wall.
/// let right = dictionary.learn(&[1.0, 0.0], &[0.0, 1.0], 0.1)?;
/// let open = dictionary.learn(&[0.0, 0.0], &[0.0, 0.0], 0.1)?;
/// assert_eq!((right, open, dictionary.len()), (PatternId(0), PatternId(2), 3));
/// // Walking right, right, open is, walked back, open, left, left.
/// let left = PatternId(1);
/// assert_eq!(dictionary.inverse(&[right, right, open])?, [open, left, left]);
/// // What is near enough is nothing new.
/// assert_eq!(dictionary.learn(&[0.95, 0.0], &[0.0, 0.95], 0.1)?, right);
/// # Ok::<(), tolman_maps::cpm::DictionaryError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Dictionary {
    dimension: usize,
    pub(super) patterns: Vec<Pattern>,
    /// Fingerprint of each version, beginning with the empty one.
    fingerprints: Vec<u64>,
    greatest_distance: f64,
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Pattern {
    pub(super) prototype: Vec<f64>,
    pub(super) half_turned: PatternId,
}

/// Version of the dictionary that a sequence or a map was written with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Version {
    /// Number of patterns.
    pub patterns: u32,
    /// Hash of the patterns.
    pub fingerprint: u64,
}

/// Reason why a dictionary refuses its input.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DictionaryError {
    /// A prototype has another number of features.
    #[error("the prototype has {found} features; give {expected}, as the dictionary has")]
    WrongDimension {
        /// Number of features of the dictionary.
        expected: usize,
        /// Number of features of the prototype.
        found: usize,
    },
    /// A feature is not finite or too large for distances.
    #[error("feature {feature} is {value}: it has to be finite and within ±1e100")]
    BadFeature {
        /// Number of the feature, from 0.
        feature: usize,
        /// The value given.
        value: f64,
    },
    /// A tolerance is negative or not a number.
    #[error("the tolerance is {value}: it has to be 0 or more")]
    BadTolerance {
        /// The value given.
        value: f64,
    },
    /// A pattern is not in the dictionary.
    #[error("pattern {} does not exist in this dictionary of {patterns}; use the one it was observed with", .pattern.0)]
    UnknownPattern {
        /// Id of the pattern.
        pattern: PatternId,
        /// Number of patterns in the dictionary.
        patterns: u32,
    },
    /// A map was written with the patterns of another dictionary.
    #[error("it was written with {} patterns of another dictionary; use the one it was learned with", .version.patterns)]
    OtherDictionary {
        /// Version of the dictionary with which the map was written.
        version: Version,
    },
    /// Two half-turned patterns do not name each other.
    #[error("the half turn of pattern {} is {}, whose half turn is another pattern; make the two point to each other", .pattern.0, .half_turned.0)]
    NotInvolutive {
        /// Id of the pattern.
        pattern: PatternId,
        /// The pattern stated as its half-turned partner.
        half_turned: PatternId,
    },
}

impl Dictionary {
    /// Returns an empty dictionary of patterns with `dimension` features; the paper has 11.
    #[must_use]
    pub fn new(dimension: usize) -> Self {
        Self {
            dimension,
            patterns: Vec::new(),
            fingerprints: alloc::vec![SEED],
            greatest_distance: 0.0,
        }
    }

    /// Returns a finished dictionary. Each prototype comes with the id of its half-turned partner,
    /// the pattern seen when walking the other way. O(patterns²).
    ///
    /// # Errors
    /// [`DictionaryError`] if a prototype is invalid, or two partners do not name each other.
    pub fn from_prototypes(
        dimension: usize,
        prototypes: &[(Vec<f64>, PatternId)],
    ) -> Result<Self, DictionaryError> {
        let mut dictionary = Self::new(dimension);
        for (id, (prototype, half_turned)) in (0..).map(PatternId).zip(prototypes) {
            let partner = prototypes.get(half_turned.0 as usize);
            if partner.is_none_or(|(_, back)| *back != id) {
                return Err(DictionaryError::NotInvolutive {
                    pattern: id,
                    half_turned: *half_turned,
                });
            }
            dictionary.check_prototype(prototype)?;
            dictionary.append(prototype, *half_turned);
        }
        Ok(dictionary)
    }

    /// Returns the pattern of an observation: the nearest if it lies within `tolerance`, else a new
    /// one with the observation as prototype. A new pattern gets a partner for `half_turned`, the
    /// view the other way, unless that is known or nearly the same. The paper asks for it: "the CPs
    /// must be learned incrementally". O(patterns · features).
    ///
    /// # Errors
    /// [`DictionaryError`] if one of the observations or the tolerance is invalid. Nothing is
    /// learned then.
    pub fn learn(
        &mut self,
        observation: &[f64],
        half_turned: &[f64],
        tolerance: f64,
    ) -> Result<PatternId, DictionaryError> {
        if tolerance.is_nan() || tolerance < 0.0 {
            return Err(DictionaryError::BadTolerance { value: tolerance });
        }
        self.check_prototype(half_turned)?;
        if let Some((id, distance)) = self.nearest(observation)?
            && distance <= tolerance
        {
            return Ok(id);
        }
        let new = PatternId(self.patterns.len() as u32);
        if euclidean(observation, half_turned) <= tolerance {
            self.append(observation, new);
        } else {
            self.append(observation, PatternId(new.0 + 1));
            self.append(half_turned, new);
        }
        Ok(new)
    }

    /// Returns the nearest pattern and its distance, the first of equals, or `None` if there are
    /// none. O(patterns · features).
    ///
    /// # Errors
    /// [`DictionaryError`] if the observation has another size, or a feature that is not finite.
    pub fn nearest(
        &self,
        observation: &[f64],
    ) -> Result<Option<(PatternId, f64)>, DictionaryError> {
        self.check_prototype(observation)?;
        let distances = self
            .patterns
            .iter()
            .map(|pattern| euclidean(&pattern.prototype, observation));
        Ok((0..)
            .map(PatternId)
            .zip(distances)
            .min_by(|(_, a), (_, b)| a.total_cmp(b)))
    }

    /// Returns the number of features of a pattern.
    #[must_use]
    pub const fn dimension(&self) -> usize {
        self.dimension
    }

    /// Returns the number of patterns.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.patterns.len()
    }

    /// Returns whether the dictionary has no patterns.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.patterns.is_empty()
    }

    /// Returns the features of a pattern, or `None` if it does not exist.
    #[must_use]
    pub fn prototype(&self, pattern: PatternId) -> Option<&[f64]> {
        let pattern = self.patterns.get(pattern.0 as usize)?;
        Some(&pattern.prototype)
    }

    /// Returns the pattern seen the other way; an unknown pattern itself.
    #[must_use]
    pub fn half_turned(&self, pattern: PatternId) -> PatternId {
        let known = self.patterns.get(pattern.0 as usize);
        known.map_or(pattern, |known| known.half_turned)
    }

    /// Returns the distance of two prototypes, infinite if one does not exist. O(features).
    #[must_use]
    pub fn distance(&self, a: PatternId, b: PatternId) -> f64 {
        if a == b {
            return 0.0;
        }
        match (self.prototype(a), self.prototype(b)) {
            (Some(a), Some(b)) => euclidean(a, b),
            _ => f64::INFINITY,
        }
    }

    /// Returns d_max, "maximum distance among all CPs".
    #[must_use]
    pub const fn greatest_distance(&self) -> f64 {
        self.greatest_distance
    }

    /// Returns A⁻¹, the sequence observed along a fragment walked the other way: its order
    /// reversed, each pattern half turned.
    ///
    /// # Errors
    /// If a pattern is not the dictionary's.
    pub fn inverse(&self, sequence: &[PatternId]) -> Result<Vec<PatternId>, DictionaryError> {
        self.check(sequence)?;
        let backward = sequence.iter().rev();
        Ok(backward.map(|pattern| self.half_turned(*pattern)).collect())
    }

    /// Refuses sequences with patterns that the dictionary does not have.
    ///
    /// # Errors
    /// If a pattern is not the dictionary's.
    pub fn check(&self, sequence: &[PatternId]) -> Result<(), DictionaryError> {
        let patterns = self.patterns.len() as u32;
        match sequence.iter().find(|pattern| pattern.0 >= patterns) {
            Some(&pattern) => Err(DictionaryError::UnknownPattern { pattern, patterns }),
            None => Ok(()),
        }
    }

    /// Returns the current version.
    #[must_use]
    pub fn version(&self) -> Version {
        Version {
            patterns: self.patterns.len() as u32,
            fingerprint: self.fingerprints.last().copied().unwrap_or(SEED),
        }
    }

    /// Returns the version that had `patterns` patterns, or `None` if no version had.
    #[cfg(feature = "serde")]
    pub(super) fn earlier(&self, patterns: u32) -> Option<Version> {
        let fingerprint = *self.fingerprints.get(patterns as usize)?;
        Some(Version {
            patterns,
            fingerprint,
        })
    }

    /// Refuses what was written with another dictionary, but accepts earlier versions of this one.
    ///
    /// # Errors
    /// [`DictionaryError::OtherDictionary`].
    pub fn check_version(&self, version: Version) -> Result<(), DictionaryError> {
        match self.fingerprints.get(version.patterns as usize) {
            Some(fingerprint) if *fingerprint == version.fingerprint => Ok(()),
            _ => Err(DictionaryError::OtherDictionary { version }),
        }
    }

    fn check_prototype(&self, prototype: &[f64]) -> Result<(), DictionaryError> {
        let (expected, found) = (self.dimension, prototype.len());
        if expected != found {
            return Err(DictionaryError::WrongDimension { expected, found });
        }
        let bad = |value: &f64| !(-LARGEST..=LARGEST).contains(value);
        match prototype.iter().position(bad) {
            Some(feature) => Err(DictionaryError::BadFeature {
                feature,
                value: prototype[feature],
            }),
            None => Ok(()),
        }
    }

    fn append(&mut self, prototype: &[f64], half_turned: PatternId) {
        let distances = self.patterns.iter();
        let distances = distances.map(|known| euclidean(&known.prototype, prototype));
        self.greatest_distance = distances.fold(self.greatest_distance, f64::max);
        let fingerprint = self.fingerprints.last().copied().unwrap_or(SEED);
        let fingerprint = hashed(fingerprint, u64::from(half_turned.0));
        let bits = prototype.iter().map(|value| value.to_bits());
        self.fingerprints.push(bits.fold(fingerprint, hashed));
        self.patterns.push(Pattern {
            prototype: prototype.to_vec(),
            half_turned,
        });
    }
}

/// Largest magnitude of a feature; beyond it squares could overflow.
const LARGEST: f64 = 1e100;

/// FNV-1a: its start and its step, a word at a time.
const SEED: u64 = 0xcbf2_9ce4_8422_2325;

const fn hashed(hash: u64, word: u64) -> u64 {
    (hash ^ word).wrapping_mul(0x0100_0000_01b3)
}

pub(super) fn euclidean(a: &[f64], b: &[f64]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
    libm::sqrt(squares.sum())
}
