//! SOINN-AM: an associative memory on a SOINN.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use crate::{
    InputError, Nearest, NearestTwo, Network, Quantizer, QuantizerConfigError, Scalar, Soinn,
    SoinnConfig, UnitId,
};

/// An associative memory: a one-layer SOINN that learns each key and its response as one vector. It
/// recalls by searching on the features of only one of them. ("Associative memory for online
/// learning in noisy environments using self-organizing incremental neural network", Sudo, Sato,
/// Hasegawa 2009.)
///
/// A key may have many responses and a response many keys. Where responses are keys themselves,
/// associations can be followed as a [chain](Self::chain).
///
/// ```
/// use tolman_quantizers::{AssociativeMemory, SoinnConfig};
///
/// // Four patterns, each followed by the next.
/// let patterns = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
/// let mut memory = AssociativeMemory::<f64>::new(2, 2, SoinnConfig::exact())?;
/// for pair in patterns.windows(2) {
///     memory.associate(&pair[0], &pair[1])?;
/// }
/// // Forth, from a noisy key, and back.
/// assert_eq!(memory.response(&[0.1, 0.9])?.values, [1.0, 1.0]);
/// assert_eq!(memory.key(&[1.0, 0.0])?.values, [1.0, 1.0]);
/// // From one pattern to all that follow, as far as any is known within 0.2.
/// let chain: Vec<_> = memory.chain(&patterns[0], 0.2)?.map(|recall| recall.values).collect();
/// assert_eq!(chain, [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct AssociativeMemory<S: Scalar> {
    soinn: Soinn<S>,
    /// Number of features of a key. In each unit, the features of the response follow those of the
    /// key.
    key_dimension: usize,
}

/// One recalled answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Recall<S> {
    /// Unit that holds the association, with the distance of its part from the query.
    pub unit: Nearest<S>,
    /// Other part of the association: the recalled response or key.
    pub values: Vec<S>,
}

/// One part of an association.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Key,
    Response,
}

impl<S: Scalar> AssociativeMemory<S> {
    /// Returns an empty memory for keys and responses of the given numbers of features.
    ///
    /// # Errors
    /// If one of them has no features or a field of `config` is outside its range.
    pub fn new(
        key_dimension: usize,
        response_dimension: usize,
        config: SoinnConfig,
    ) -> Result<Self, QuantizerConfigError> {
        if key_dimension == 0 || response_dimension == 0 {
            return Err(QuantizerConfigError::NoFeatures);
        }
        Ok(Self {
            soinn: Soinn::new(key_dimension + response_dimension, config)?,
            key_dimension,
        })
    }

    /// Learns that `response` belongs to `key`.
    ///
    /// # Errors
    /// If one of them is invalid. Nothing is learnt then.
    pub fn associate(&mut self, key: &[S], response: &[S]) -> Result<NearestTwo<S>, InputError> {
        self.check_size(Part::Key, key)?;
        self.check_size(Part::Response, response)?;
        self.soinn.observe(&[key, response].concat())
    }

    /// Returns the response to the nearest key.
    ///
    /// # Errors
    /// If `key` is invalid or nothing was learnt yet.
    ///
    /// # Complexity
    /// Units × features of a key.
    pub fn response(&self, key: &[S]) -> Result<Recall<S>, InputError> {
        self.recall(Part::Key, key)
    }

    /// Returns the key of the nearest response.
    ///
    /// # Errors
    /// If `response` is invalid or nothing was learnt yet.
    pub fn key(&self, response: &[S]) -> Result<Recall<S>, InputError> {
        self.recall(Part::Response, response)
    }

    /// Returns all responses to keys not farther than `reach`, one for each cluster of
    /// associations, the nearest key first.
    ///
    /// # Errors
    /// If `key` is invalid or nothing was learnt yet.
    ///
    /// # Complexity
    /// Units × features of a key, and the clusters.
    pub fn responses(&self, key: &[S], reach: S) -> Result<Vec<Recall<S>>, InputError> {
        self.recall_all(Part::Key, key, reach)
    }

    /// Returns all keys of responses not farther than `reach`, one for each cluster of
    /// associations, the nearest response first.
    ///
    /// # Errors
    /// If `response` is invalid or nothing was learnt yet.
    pub fn keys(&self, response: &[S], reach: S) -> Result<Vec<Recall<S>>, InputError> {
        self.recall_all(Part::Response, response, reach)
    }

    /// Returns the response to `start`, the response to that, and so on, until no key lies within
    /// `reach` of a response. A memory of a cycle goes round forever.
    ///
    /// # Errors
    /// If `start` is invalid, responses have another number of features than keys, or nothing was
    /// learnt yet.
    pub fn chain(&self, start: &[S], reach: S) -> Result<Chain<'_, S>, InputError> {
        InputError::check_size(self.key_dimension, self.features(Part::Response).len())?;
        self.response(start)?;
        Ok(Chain {
            memory: self,
            next: start.to_vec(),
            reach,
        })
    }

    /// Returns the SOINN below; the features of its units are those of a key, then those of its
    /// response.
    pub fn soinn(&self) -> &Soinn<S> {
        &self.soinn
    }

    fn network(&self) -> &Network<S> {
        self.soinn.network()
    }

    /// Returns the features of a part.
    fn features(&self, part: Part) -> Range<usize> {
        match part {
            Part::Key => 0..self.key_dimension,
            Part::Response => self.key_dimension..self.network().dimension(),
        }
    }

    fn check_size(&self, part: Part, values: &[S]) -> Result<(), InputError> {
        InputError::check_size(self.features(part).len(), values.len())
    }

    /// Returns the other part of the association whose `part` is nearest.
    fn recall(&self, part: Part, asked: &[S]) -> Result<Recall<S>, InputError> {
        let (input, mask) = self.query(part, asked)?;
        let unit = self.network().nearest_two_masked(&input, &mask)?.first;
        let values = self.other_part(part, unit);
        Ok(Recall { unit, values })
    }

    fn recall_all(&self, part: Part, asked: &[S], reach: S) -> Result<Vec<Recall<S>>, InputError> {
        // The search refuses an invalid query.
        self.recall(part, asked)?;
        let clusters = self.network().clusters();
        let mut nearest: Vec<Option<Nearest<S>>> = vec![None; clusters.count()];
        for (id, label) in clusters.iter() {
            let mut squared_distance = S::ZERO;
            for (value, asked) in self.part(part, id).zip(asked) {
                let difference = *asked - value;
                squared_distance += difference * difference;
            }
            let best = &mut nearest[label as usize];
            if squared_distance <= reach * reach
                && best.is_none_or(|best| squared_distance < best.squared_distance)
            {
                *best = Some(Nearest {
                    id,
                    squared_distance,
                });
            }
        }
        let mut found: Vec<Nearest<S>> = nearest.into_iter().flatten().collect();
        found.sort_by(|a, b| {
            let (a, b) = (a.squared_distance.to_f64(), b.squared_distance.to_f64());
            a.total_cmp(&b)
        });
        let mut recalls: Vec<Recall<S>> = Vec::new();
        for unit in found {
            let values = self.other_part(part, unit);
            // A lesson learnt twice has two units without an edge.
            if recalls.iter().all(|known| known.values != values) {
                recalls.push(Recall { unit, values });
            }
        }
        Ok(recalls)
    }

    /// Returns a whole vector with only the given part, and the mask that selects it.
    fn query(&self, part: Part, asked: &[S]) -> Result<(Vec<S>, Vec<bool>), InputError> {
        self.check_size(part, asked)?;
        let dimension = self.network().dimension();
        let (mut input, mut mask) = (vec![S::ZERO; dimension], vec![false; dimension]);
        input[self.features(part)].copy_from_slice(asked);
        mask[self.features(part)].fill(true);
        Ok((input, mask))
    }

    /// Returns a part of a unit; empty if there is no such unit.
    fn part(&self, part: Part, id: UnitId) -> impl Iterator<Item = S> + '_ {
        let features = self.features(part);
        let values = self.network().prototype(id).into_iter().flatten();
        values.skip(features.start).take(features.len())
    }

    fn other_part(&self, asked: Part, unit: Nearest<S>) -> Vec<S> {
        let other = match asked {
            Part::Key => Part::Response,
            Part::Response => Part::Key,
        };
        self.part(other, unit.id).collect()
    }
}

/// A chain of associations; see [`AssociativeMemory::chain`].
#[derive(Clone, Debug)]
pub struct Chain<'a, S: Scalar> {
    memory: &'a AssociativeMemory<S>,
    next: Vec<S>,
    reach: S,
}

impl<S: Scalar> Iterator for Chain<'_, S> {
    type Item = Recall<S>;

    fn next(&mut self) -> Option<Recall<S>> {
        let recall = self.memory.response(&self.next).ok()?;
        if recall.unit.squared_distance <= self.reach * self.reach {
            self.next.clone_from(&recall.values);
            Some(recall)
        } else {
            None
        }
    }
}
