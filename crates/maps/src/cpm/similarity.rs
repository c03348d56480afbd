use alloc::borrow::Cow;

use super::alignment::Alignment;
use super::map::Sign;
use super::pattern::{Dictionary, DictionaryError, PatternId};
use super::traversal::DeadReckoning;

/// Method of comparing two fragments.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum FragmentMatching {
    /// Compares position by position, equations (3) to (5).
    Positions(Similarity),
    /// Compares with insertions, deletions and changes of speed.
    Alignment(Alignment),
}

/// Direction in which two sequences are similar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sense {
    /// 𝔸₁ ≅ 𝔸₂: − belongs to −.
    Same,
    /// 𝔸₁ ≅ 𝔸₂⁻¹: + belongs to −.
    Inverted,
}

impl Sense {
    /// Returns the sense in which a fragment is walked from an end: [`Same`](Self::Same) from the
    /// end −.
    pub(super) fn entered_at(sign: Sign) -> Self {
        Self::between(Sign::Minus, sign)
    }

    /// Returns the sense in which two fragments are one, if their ends of these signs coincide.
    pub(super) fn between(one: Sign, other: Sign) -> Self {
        match one == other {
            true => Self::Same,
            false => Self::Inverted,
        }
    }

    /// Returns the sign of the end of the other fragment at the place of an end.
    #[must_use]
    pub const fn of(self, sign: Sign) -> Sign {
        match self {
            Self::Same => sign,
            Self::Inverted => sign.opposite(),
        }
    }

    /// Returns the sequence observed along a fragment walked in this sense: 𝔸 or 𝔸⁻¹.
    ///
    /// # Errors
    /// If a pattern of an inverted sequence is not the dictionary's.
    pub(super) fn of_sequence<'s>(
        self,
        dictionary: &Dictionary,
        sequence: &'s [PatternId],
    ) -> Result<Cow<'s, [PatternId]>, DictionaryError> {
        match self {
            Self::Same => Ok(Cow::Borrowed(sequence)),
            Self::Inverted => dictionary.inverse(sequence).map(Cow::Owned),
        }
    }

    /// Returns a walk along one fragment as a walk along the other.
    pub(super) fn of_motion(self, motion: DeadReckoning) -> DeadReckoning {
        match self {
            Self::Same => motion,
            Self::Inverted => motion.reversed(),
        }
    }
}

/// Two fragments that are similar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Match {
    /// The better of the two senses; *same* if both are equal.
    pub sense: Sense,
    /// Similarity, at most 1.
    pub score: f64,
}

impl FragmentMatching {
    /// Returns the similarity of two sequences as they stand, at most 1; equal ones have 1.
    /// Patterns that the dictionary does not have are similar to none.
    #[must_use]
    pub fn score(&self, dictionary: &Dictionary, a: &[PatternId], b: &[PatternId]) -> f64 {
        match self {
            Self::Positions(similarity) => similarity.score(dictionary, a, b),
            Self::Alignment(alignment) => alignment.score(dictionary, a, b),
        }
    }

    /// Returns μ, the score above which two sequences are similar.
    #[must_use]
    pub const fn threshold(&self) -> f64 {
        match self {
            Self::Positions(similarity) => similarity.mu,
            Self::Alignment(alignment) => alignment.threshold,
        }
    }

    /// Returns the score above which two fragments at one port may be one, if the similarity of
    /// others implies it. It is below μ, as those others are evidence too.
    #[must_use]
    pub const fn threshold_at_port(&self) -> f64 {
        match self {
            Self::Positions(similarity) => similarity.mu_at_port,
            Self::Alignment(alignment) => alignment.threshold,
        }
    }

    /// Returns the similarity of two sequences, the second walked as the sense says.
    #[must_use]
    pub fn score_as(
        &self,
        dictionary: &Dictionary,
        a: &[PatternId],
        b: &[PatternId],
        sense: Sense,
    ) -> f64 {
        // What cannot be walked the other way is similar to nothing.
        sense
            .of_sequence(dictionary, b)
            .map_or(f64::NEG_INFINITY, |b| self.score(dictionary, a, &b))
    }

    /// Returns whether 𝔸₁ ≅ 𝔸₂, the second walked as the sense says.
    #[must_use]
    pub fn agrees(
        &self,
        dictionary: &Dictionary,
        a: &[PatternId],
        b: &[PatternId],
        sense: Sense,
    ) -> bool {
        self.score_as(dictionary, a, b, sense) > self.threshold()
    }

    /// Returns whether 𝔸₁ ≅ 𝔸₂ or 𝔸₁ ≅ 𝔸₂⁻¹: "The inverse of 𝔸₂ must also be compared with 𝔸₁."
    #[must_use]
    pub fn matches(
        &self,
        dictionary: &Dictionary,
        a: &[PatternId],
        b: &[PatternId],
    ) -> Option<Match> {
        let [same, inverted] = [Sense::Same, Sense::Inverted].map(|sense| Match {
            sense,
            score: self.score_as(dictionary, a, b, sense),
        });
        let is_inverted = inverted.score > same.score;
        let better = if is_inverted { inverted } else { same };
        (better.score > self.threshold()).then_some(better)
    }
}

/// f_S, equations (3) to (5), with the possible readings of them.
///
/// ```
/// use tolman_maps::cpm::{Dictionary, PatternDifference, PatternId, Similarity};
///
/// // 31 patterns, as the paper's dictionary.
/// let mut dictionary = Dictionary::new(1);
/// for pattern in 0..31 {
///     let prototype = [f64::from(pattern)];
///     dictionary.learn(&prototype, &prototype, 0.0)?;
/// }
/// let long = [1, 2, 2, 3, 4, 4].map(PatternId);
/// let short = [2, 2, 3, 4, 4].map(PatternId);
/// let paper = Similarity::paper();
/// assert!(paper.score(&dictionary, &long, &short) > paper.mu);
/// # Ok::<(), tolman_maps::cpm::DictionaryError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Similarity {
    /// Measure of the difference aⱼ − a'ⱼ.
    pub difference: PatternDifference,
    /// Positions that are compared.
    pub span: Span,
    /// Rule by which differences add up.
    pub sum: Sum,
    /// μ: above it two fragments are the same; 0 to 1. "We simply set μ = 0.9."
    pub mu: f64,
    /// Similarity above which two fragments at one port are the same, if other similar fragments
    /// imply it; 0 to `mu`. Ours.
    pub mu_at_port: f64,
}

/// Measure of the difference of two patterns, aⱼ − a'ⱼ in (4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum PatternDifference {
    /// Distance of the patterns' prototypes. d_max is the greatest distance of two prototypes.
    Prototypes,
    /// Difference of the patterns' numbers, taken literally, though numbers are names. d_max is the
    /// difference of the last number and the first.
    Indices,
}

/// Positions that are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Span {
    /// Both sequences whole: the shorter one is stretched over the longer one.
    Whole,
    /// Up to the end of the shorter one, taken literally: a fragment is similar to all that begin
    /// like it.
    Shorter,
}

/// Rule by which differences add up to ε_b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Sum {
    /// Mean over the positions: the sum and the division of (3). Long and short fragments are
    /// measured alike.
    Mean,
    /// The root of the sum of the squared differences, (4). The sum of (3) over n times the same E,
    /// divided by n, is E.
    Euclidean,
}

impl Similarity {
    /// Returns our reading of the paper: distances of prototypes, whole sequences, means, μ = 0.9.
    /// At one port μ is half-way from there to 0.8, below which distinctive fragments stay.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            difference: PatternDifference::Prototypes,
            span: Span::Whole,
            sum: Sum::Mean,
            mu: 0.9,
            mu_at_port: 0.85,
        }
    }

    /// Returns the equations taken literally: differences of numbers, up to the shorter one's
    /// length, E as in (4), μ = 0.9.
    #[must_use]
    pub const fn literal() -> Self {
        Self {
            difference: PatternDifference::Indices,
            span: Span::Shorter,
            sum: Sum::Euclidean,
            mu: 0.9,
            mu_at_port: 0.9,
        }
    }

    /// Returns f_S of two sequences: 1 for equal ones, less otherwise. An empty sequence scores 0
    /// against any, even another empty one. With [`Sum::Euclidean`] the score may be negative.
    /// O(length · features).
    #[must_use]
    pub fn score(&self, dictionary: &Dictionary, a: &[PatternId], b: &[PatternId]) -> f64 {
        let positions = match self.span {
            Span::Whole => a.len().max(b.len()),
            Span::Shorter => a.len().min(b.len()),
        };
        if a.is_empty() || b.is_empty() {
            return 0.0;
        }
        let difference = |a: PatternId, b: PatternId| match self.difference {
            PatternDifference::Prototypes => dictionary.distance(a, b),
            PatternDifference::Indices => f64::from(a.0.abs_diff(b.0)),
        };
        // In the middle of the position's share of the longer one; where that is a border, the two
        // beside it count by halves.
        let at = |sequence: &[PatternId], position: usize| match self.span {
            Span::Whole => {
                let (middle, unit) = ((2 * position + 1) * sequence.len(), 2 * positions);
                (sequence[(middle - 1) / unit], sequence[middle / unit])
            }
            Span::Shorter => (sequence[position], sequence[position]),
        };
        let (mut sum, mut squares) = (0.0, 0.0);
        for position in 0..positions {
            let (a, b) = (at(a, position), at(b, position));
            let difference = (difference(a.0, b.0) + difference(a.1, b.1)) / 2.0;
            sum += difference;
            squares += difference * difference;
        }
        let epsilon = match self.sum {
            Sum::Mean => sum / positions as f64,
            Sum::Euclidean => libm::sqrt(squares),
        };
        let greatest = match self.difference {
            PatternDifference::Prototypes => dictionary.greatest_distance(),
            PatternDifference::Indices => dictionary.len().saturating_sub(1) as f64,
        };
        if epsilon > 0.0 {
            1.0 - epsilon / greatest
        } else {
            1.0
        }
    }
}
