//! Parameters of a SOINN.

use crate::QuantizerConfigError;
use crate::error::{AT_LEAST_1, NOT_NEGATIVE, SHARE, within};

/// The parameters of one layer of a SOINN. Its `Default` is [`shen_hasegawa`](Self::shen_hasegawa).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SoinnConfig {
    /// age_dead: age above which edges are removed, in inputs won by one of the edge's ends, at
    /// least 1.
    pub max_age: u32,
    /// λ: number of inputs between two insertions and removals of noise, at least 1. A unit has to
    /// find a neighbour within less than λ inputs.
    pub period: u32,
    /// Rule by which units are inserted where the error is large.
    pub insertion: ErrorInsertion,
    /// Units that count as noise.
    pub denoising: Denoising,
    /// Distance from its nearest units at which an input is new.
    pub threshold: SimilarityThreshold,
}

/// Inserts a unit r every λ inputs ("within-class insertion", Shen and Hasegawa 2006, algorithm
/// 3.1, step 10). Unit r lies half-way between the unit q of largest error and its neighbour f of
/// largest error. Unit r gets a sixth of the errors, and a quarter of the wins and of the
/// remembered radii. Units q and f keep ⅔ of their errors and ¾ of their wins. The insertion is
/// undone if the mean error E / M has grown beyond the radius remembered from the previous
/// insertion. For a unit without a previous insertion that radius is +∞.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ErrorInsertion {
    /// The insertion is undone if one of q, f and r has a mean error beyond its radius.
    #[default]
    UnlessOneGrew,
    /// The insertion is undone only if all three have grown: the paper's "∀ i ∈ {q, r, f}", taken
    /// literally. Networks become many times as large.
    UnlessAllGrew,
    /// No unit is inserted, as in E-SOINN (Furao, Ogura, Hasegawa 2007).
    Off,
}

/// Units that are removed every λ inputs, after the insertion. All are judged by the graph as it
/// was before; two units always stay.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Denoising {
    /// Units without a neighbour, and those with one that have won less than `c` times the mean of
    /// all units (Shen and Hasegawa 2006).
    ///
    /// It compares a new unit with units that have won since the beginning. The longer a stream,
    /// the fewer new units stay, until the network stops growing. A curve of units with a hole or
    /// an end is then never continued.
    FewWins {
        /// c: 0 to 1; the nearer to 1, the noisier the data are.
        c: f64,
    },
    /// Removes units without a neighbour. Also removes units with one neighbour that have won less
    /// than `c` times their share. A unit's share since it came is the number of inputs divided by
    /// the number of units. This rule is ours: it applies the paper's criterion in proportion to
    /// age.
    ///
    /// A part of the graph without inputs for long is removed from its ends inwards.
    LowRate {
        /// c: 0 to 1; the nearer to 1, the noisier the data are.
        c: f64,
    },
    /// No denoising: every input is worth remembering, even if it comes only once.
    Off,
}

/// Distance from one of its two nearest units at which an input is new and becomes a unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum SimilarityThreshold {
    /// Farther than the unit's farthest neighbour or, if it has none, than the unit nearest to it
    /// (Shen and Hasegawa 2006, algorithm 3.2). For the first layer.
    #[default]
    Adaptive,
    /// Farther than this distance: the second layer. Not negative.
    Constant(f64),
}

impl SoinnConfig {
    /// Returns the values of Shen and Hasegawa 2006 for their artificial data: λ = age_dead = 100,
    /// c = 1.
    pub fn shen_hasegawa() -> Self {
        Self {
            max_age: 100,
            period: 100,
            insertion: ErrorInsertion::UnlessOneGrew,
            denoising: Denoising::FewWins { c: 1.0 },
            threshold: SimilarityThreshold::Adaptive,
        }
    }

    /// Returns the values for noisy data: the paper's λ = 100 and c = 1, but units are judged [by
    /// their age](Denoising::LowRate). Its age_dead = 20 drops edges to noise (measured in
    /// `docs/notebook/quantizers.md`).
    pub fn noisy() -> Self {
        Self {
            max_age: 20,
            denoising: Denoising::LowRate { c: 1.0 },
            ..Self::shen_hasegawa()
        }
    }

    /// Returns the dictionary of "Reasoning on SOINN associative memory" (Kawewong, Honda,
    /// Tsuboyama, Hasegawa), section 4: λ = age_dead = 20. It does not give c; here 1, the value of
    /// the paper it follows.
    pub fn cpm() -> Self {
        Self {
            max_age: 20,
            period: 20,
            ..Self::shen_hasegawa()
        }
    }

    /// Returns the values for inputs without noise that count even if they come only once, as in an
    /// [`AssociativeMemory`](crate::AssociativeMemory) of single lessons. Every input that differs
    /// from all units becomes a new unit. Nothing is removed as noise, and nothing is inserted
    /// between learnt inputs. A repeated input makes two units, then an edge.
    pub fn exact() -> Self {
        Self {
            insertion: ErrorInsertion::Off,
            denoising: Denoising::Off,
            threshold: SimilarityThreshold::Constant(0.0),
            ..Self::shen_hasegawa()
        }
    }

    /// Checks the ranges of all fields.
    ///
    /// # Errors
    /// If a field is outside its range.
    pub(super) fn check(&self) -> Result<(), QuantizerConfigError> {
        within("max_age", self.max_age, AT_LEAST_1)?;
        within("period", self.period, AT_LEAST_1)?;
        if let Denoising::FewWins { c } | Denoising::LowRate { c } = self.denoising {
            within("denoising.c", c, SHARE)?;
        }
        if let SimilarityThreshold::Constant(distance) = self.threshold {
            within("threshold", distance, NOT_NEGATIVE)?;
        }
        Ok(())
    }
}

impl Default for SoinnConfig {
    fn default() -> Self {
        Self::shen_hasegawa()
    }
}
