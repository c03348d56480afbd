//! Parameters of a growing neural gas.

use crate::QuantizerConfigError;
use crate::error::{AT_LEAST_1, NOT_NEGATIVE, SHARE, within};

/// The parameters of a growing neural gas. Its `Default` is [`fritzke`](Self::fritzke).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct GngConfig {
    /// ε_b: the part of the way to the input that the nearest unit moves; 0 to 1.
    pub winner_rate: f64,
    /// ε_n: the part of the way that its neighbours move; 0 to 1.
    pub neighbour_rate: f64,
    /// a_max: age above which edges are removed, in inputs won by one of the edge's ends, at
    /// least 1.
    pub max_age: u32,
    /// λ: the network may grow at every λ-th input; at least 1.
    pub growth_period: u32,
    /// α: factor on the errors of the two units between which a unit is put; 0 to 1.
    pub split_factor: f64,
    /// d: factor on all errors after each input; above 0, at most 1.
    pub decay: f64,
    /// Maximum number of units; at least 2. `usize::MAX` for no bound.
    pub max_units: usize,
    /// Order of the parts of a step.
    pub order: StepOrder,
    /// Addition to the error of the nearest unit.
    pub error: ErrorKind,
    /// Further condition for the network to grow.
    pub gate: GrowthGate,
    /// Condition on which units of little utility are removed (GNG-U); `None` for never.
    pub utility: Option<Utility>,
}

/// The order of the parts of a step. The sources agree on the parts, not on their order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum StepOrder {
    /// "A growing neural gas network learns topologies" (Fritzke 1995), section 2. The order is age
    /// the winner's edges, add to its error, move, **then** link the two nearest, drop old edges,
    /// **grow, then decay** all errors. The input does not move a second unit it has just linked,
    /// and a new edge ends the step with age 0.
    #[default]
    Fritzke,
    /// "Maze Solving by Learning State Topologies" (Tingle, Ball, Augat), related work, steps 1 to
    /// 6. The order is: **first** link the two nearest with age 0. Then age the winner's edges, add
    /// to its error, move, drop old edges, **decay all errors, then grow**. The second unit moves
    /// as a neighbour, and the new edge ends the step with age 1.
    Mslst,
}

/// Error charged to the nearest unit w of an input x.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ErrorKind {
    /// ‖x − w‖² (Fritzke 1995, equation 4): units come where they lower the mean squared error
    /// most.
    #[default]
    Squared,
    /// ‖x − w‖ (the GNG of the Python library MDP): less pull towards outliers.
    Absolute,
    /// ‖x − w‖ / ‖x‖ (Provost's code for SODA): the same ratio counts the same near and far. An
    /// input of length 0 that is not met exactly counts as 1.
    Relative,
}

/// Condition on which an equilibrium GNG may grow. E is the vector of all errors as they are kept,
/// decayed; N is the number of units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum GrowthGate {
    /// Always while there is room (Fritzke 1995).
    #[default]
    Open,
    /// mean(E) > threshold (the likely reading of MSLST's "error threshold"). In equilibrium the
    /// sum of E is the mean error of an input / (1 − d), so growth ends where MSE(N) = N ·
    /// threshold · (1 − d).
    MeanError {
        /// Threshold in units of the error: squared units of the features for squared errors. Not
        /// negative.
        threshold: f64,
    },
    /// mean(E) · (1 − d) > threshold (Provost's code for SODA, where 1 − d is called β). Growth
    /// ends where the mean error of an input is N · threshold, whatever the decay.
    Rate {
        /// Threshold in units of the error per unit of the network. Not negative.
        threshold: f64,
    },
}

/// GNG-U, "A self-organizing network that can follow non-stationary distributions" (Fritzke 1997).
/// The utility of a unit is how much larger the error of its inputs would be without it. It is
/// summed and decayed like errors.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Utility {
    /// k: after each input, the unit of least utility U goes if max(E) > k · U. Small values forget
    /// quickly. Above 0.
    pub threshold: f64,
    /// Moments at which units are removed.
    pub removal: Removal,
}

/// Moments at which a unit of little utility is removed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Removal {
    /// After every input (Fritzke 1997): the number of units follows the stream as well.
    #[default]
    EveryInput,
    /// When only `max_units` stops the network from growing. Then a unit moves from where it is
    /// least useful to where the error is largest. LBG-U does the same (Fritzke, "The LBG-U method
    /// for vector quantization", 1997).
    WhenFull,
}

impl GngConfig {
    /// Returns the growing neural gas of Fritzke 1995, section 4: ε_b 0.2, ε_n 0.006, a_max 50, λ
    /// 100, α 0.5, d 0.995.
    pub fn fritzke() -> Self {
        Self {
            winner_rate: 0.2,
            neighbour_rate: 0.006,
            max_age: 50,
            growth_period: 100,
            split_factor: 0.5,
            decay: 0.995,
            max_units: usize::MAX,
            order: StepOrder::Fritzke,
            error: ErrorKind::Squared,
            gate: GrowthGate::Open,
            utility: None,
        }
    }

    /// Returns the equilibrium GNG of MSLST with an error threshold of its table 1, in squared
    /// robot units for scans in robot units. The paper gives no rates; these are Fritzke's. His
    /// decay d = 0.995 was chosen because it gives the paper's 26 units for the Large maze at
    /// threshold 50 (see `docs/notebook/quantizers.md`).
    pub fn mslst(threshold: f64) -> Self {
        Self {
            decay: 0.995,
            order: StepOrder::Mslst,
            gate: GrowthGate::MeanError { threshold },
            ..Self::fritzke()
        }
    }

    /// Returns the equilibrium GNG of Provost's code for SODA: ε_b 0.05, ε_n 0.0006, a_max 100, λ
    /// 200, d 1 − 0.0005. Errors are relative, and the rate is the gate.
    pub fn provost(threshold: f64) -> Self {
        Self {
            winner_rate: 0.05,
            neighbour_rate: 0.0006,
            max_age: 100,
            growth_period: 200,
            decay: 1.0 - 0.0005,
            error: ErrorKind::Relative,
            gate: GrowthGate::Rate { threshold },
            ..Self::fritzke()
        }
    }

    /// Returns the values for inputs in the order of a robot's way, for use inside a
    /// [`ReplayQuantizer`](crate::ReplayQuantizer). They are Fritzke's with two changes. Units move
    /// to where they are needed ([`Removal::WhenFull`], k = 4). Errors are remembered long enough
    /// to tell where that is (d = 0.9995). Our own; measured in `docs/quantizers.md`.
    pub fn in_order(max_units: usize) -> Self {
        Self {
            max_units,
            decay: 0.9995,
            utility: Some(Utility {
                threshold: 4.0,
                removal: Removal::WhenFull,
            }),
            ..Self::fritzke()
        }
    }

    /// Checks the ranges of all fields.
    ///
    /// # Errors
    /// If a field is outside its range.
    pub(super) fn check(&self) -> Result<(), QuantizerConfigError> {
        within("winner_rate", self.winner_rate, SHARE)?;
        within("neighbour_rate", self.neighbour_rate, SHARE)?;
        within("max_age", self.max_age, AT_LEAST_1)?;
        within("growth_period", self.growth_period, AT_LEAST_1)?;
        within("split_factor", self.split_factor, SHARE)?;
        let above_0 = |value| value > 0.0 && value <= 1.0;
        within("decay", self.decay, (above_0, "above 0 and at most 1"))?;
        let at_least_2 = |value| value >= 2.0;
        within(
            "max_units",
            self.max_units as f64,
            (at_least_2, "at least 2"),
        )?;
        if let GrowthGate::MeanError { threshold } | GrowthGate::Rate { threshold } = self.gate {
            within("gate.threshold", threshold, NOT_NEGATIVE)?;
        }
        if let Some(Utility { threshold, .. }) = self.utility {
            let above_0 = |value: f64| value > 0.0 && value.is_finite();
            within(
                "utility.threshold",
                threshold,
                (above_0, "finite and above 0"),
            )?;
        }
        Ok(())
    }
}

impl Default for GngConfig {
    fn default() -> Self {
        Self::fritzke()
    }
}
