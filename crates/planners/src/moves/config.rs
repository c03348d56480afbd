use thiserror::Error;

/// Weights by which a [`MoveExplorer`](super::MoveExplorer) chooses its next stop.
///
/// None of this touches the proof: whatever the weights, the explorer stops only when no better run
/// is possible.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct MoveExplorerConfig {
    /// Weight of a step on known ground, relative to a step on the possible way beyond it; above 0.
    /// It applies while no way to the goal is known.
    pub known_step: f32,
    /// While no way to the goal is known: steps that each unknown wall on the hoped-for way counts
    /// as. ≥ 0.
    pub unknown_wall: f32,
    /// While no way to the goal is known: value of one more visible unknown side, steps. ≥ 0.
    pub sight: f32,
    /// Gain per distance from which a stop comes before the way to the goal, while no way to the
    /// goal is known. ≥ 0.
    pub early_proof: f32,
    /// Discount of a wall's weight once a way is known. It applies for each step by which the best
    /// possible run through the wall is longer than the best of all. Within 0 … 1.
    pub patience: f32,
    /// Minimum weight of a wall on a run better than the known one; walls on the best run weigh 1.
    /// ≥ 0.
    pub base: f32,
    /// Exponent of the distance in steps by which a stop's gain is divided. > 0.
    pub nearness: f32,
}

impl MoveExplorerConfig {
    /// Returns the configuration with which all figures of the project are made.
    /// `docs/micromouse.md` explains how it was chosen.
    #[must_use]
    pub const fn tuned() -> Self {
        Self {
            known_step: 0.971,
            unknown_wall: 0.113,
            sight: 0.593,
            early_proof: 1.0,
            patience: 0.234,
            base: 0.083,
            nearness: 1.57,
        }
    }

    pub(super) fn check(&self) -> Result<(), MoveExplorerConfigError> {
        let patience = (0.0..=1.0).contains(&self.patience);
        MoveExplorerConfigError::check([
            positive("known_step", self.known_step),
            at_least_0("unknown_wall", self.unknown_wall),
            at_least_0("sight", self.sight),
            at_least_0("early_proof", self.early_proof),
            ("patience", self.patience, patience, "a number from 0 to 1"),
            at_least_0("base", self.base),
            positive("nearness", self.nearness),
        ])
    }
}

/// A value out of its range.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("`{field}` is {value}; give {range}")]
pub struct MoveExplorerConfigError {
    /// Name of the field.
    pub field: &'static str,
    /// Value that was given.
    pub value: f32,
    /// Values that the field may have.
    pub range: &'static str,
}

impl MoveExplorerConfigError {
    /// Checks that each field is finite and within its range. The error names the first that is
    /// not.
    pub(super) fn check(fields: impl IntoIterator<Item = CheckedField>) -> Result<(), Self> {
        let wrong = fields
            .into_iter()
            .find(|(_, value, holds, _)| !(*holds && value.is_finite()));
        match wrong {
            Some((field, value, _, range)) => Err(Self {
                field,
                value,
                range,
            }),
            None => Ok(()),
        }
    }
}

/// A field's name, its value, whether the value is in range, and that range in words.
pub(super) type CheckedField = (&'static str, f32, bool, &'static str);

/// Returns a field that has to be above 0.
pub(super) fn positive(field: &'static str, value: f32) -> CheckedField {
    (field, value, value > 0.0, "a number above 0")
}

/// Returns a field that has to be 0 or more.
pub(super) fn at_least_0(field: &'static str, value: f32) -> CheckedField {
    (field, value, value >= 0.0, "0 or more")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_out_of_range_are_refused() {
        let check = |change: fn(&mut MoveExplorerConfig)| {
            let mut config = MoveExplorerConfig::tuned();
            change(&mut config);
            config.check().map_err(|error| error.field)
        };
        assert_eq!(check(|_| ()), Ok(()));
        assert_eq!(check(|config| config.known_step = 0.0), Err("known_step"));
        assert_eq!(check(|config| config.sight = f32::NAN), Err("sight"));
        assert_eq!(check(|config| config.patience = 1.1), Err("patience"));
        assert_eq!(
            check(|config| config.nearness = f32::INFINITY),
            Err("nearness")
        );
    }
}
