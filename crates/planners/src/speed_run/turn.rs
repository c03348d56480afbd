//! How a mouse drives its turns, and how long each takes.

use super::config::{SpeedProfile, SpeedRunConfig, SpeedRunConfigError, from_rest};
use super::{Side, Slalom};

/// Turns of a mouse. One that is `None` is never made. [`Slalom`] defines their beginnings and
/// ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, default))]
#[non_exhaustive]
pub struct SlalomTurns {
    /// Turn of 45° from a straight into a diagonal, or from a diagonal into a straight.
    #[cfg_attr(feature = "serde", serde(alias = "f45_ms"))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub f45: Option<SlalomTurn>,
    /// Turn of 90° from a straight into a straight, over two cells.
    #[cfg_attr(feature = "serde", serde(alias = "f90_ms"))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub f90: Option<SlalomTurn>,
    /// Turn of 135° from a straight into a diagonal, or from a diagonal into a straight.
    #[cfg_attr(feature = "serde", serde(alias = "f135_ms"))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub f135: Option<SlalomTurn>,
    /// Turn of 180° from a straight into the straight beside it.
    #[cfg_attr(feature = "serde", serde(alias = "f180_ms"))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub f180: Option<SlalomTurn>,
    /// Turn of 90° from a diagonal into a diagonal.
    #[cfg_attr(feature = "serde", serde(alias = "fv90_ms"))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub fv90: Option<SlalomTurn>,
    /// Turn of 90° within a cell, from the middle of one side to that of the next.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub fs90: Option<SlalomTurn>,
    /// Duration of a turn of 90° in place, in the middle of a cell, from rest to rest, ms. Braking
    /// before it and accelerating behind it are added. Not used where the mouse has an `fs90`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub in_place_ms: Option<u32>,
}

/// How long a turn takes, or how it is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SlalomTurn {
    /// A turn whose duration was measured.
    Timed {
        /// Duration, ms.
        time_ms: u32,
    },
    /// A turn whose duration follows from its curve.
    Driven(DrivenTurn),
}

/// A straight run-in, a curve at constant speed, and a straight run-out. The run-in begins and the
/// run-out ends at the speed of all turns, [`SpeedRunConfig::turn_speed_mm_s`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct DrivenTurn {
    /// Speed in the curve, mm/s, above 0.
    pub speed_mm_s: f64,
    /// Length of the curve, mm, above 0. Either this or the radius.
    #[cfg_attr(feature = "serde", serde(default))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub length_mm: Option<f64>,
    /// Radius of the curve, mm, above 0.
    #[cfg_attr(feature = "serde", serde(default))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub radius_mm: Option<f64>,
    /// Length of the run-in, mm, 0 or more.
    #[cfg_attr(feature = "serde", serde(default))]
    pub run_in_mm: f64,
    /// Length of the run-out, mm, 0 or more.
    #[cfg_attr(feature = "serde", serde(default))]
    pub run_out_mm: f64,
}

impl SlalomTurns {
    /// No turn.
    pub const NONE: Self = Self {
        f45: None,
        f90: None,
        f135: None,
        f180: None,
        fv90: None,
        fs90: None,
        in_place_ms: None,
    };

    /// Returns the five turns of a mouse with diagonals, which take these times, ms.
    #[must_use]
    pub const fn timed([f45, f90, f135, f180, fv90]: [u32; 5]) -> Self {
        const fn timed(time_ms: u32) -> Option<SlalomTurn> {
            Some(SlalomTurn::Timed { time_ms })
        }
        Self {
            f45: timed(f45),
            f90: timed(f90),
            f135: timed(f135),
            f180: timed(f180),
            fv90: timed(fv90),
            ..Self::NONE
        }
    }

    pub(super) const fn without_diagonals(self) -> Self {
        Self {
            f45: None,
            f135: None,
            fv90: None,
            ..self
        }
    }

    const fn of(&self, slalom: Slalom) -> Option<SlalomTurn> {
        match slalom {
            Slalom::F45 => self.f45,
            Slalom::F90 => self.f90,
            Slalom::F135 => self.f135,
            Slalom::F180 => self.f180,
            Slalom::Fv90 => self.fv90,
            Slalom::Fs90 => self.fs90,
        }
    }
}

impl Default for SlalomTurns {
    fn default() -> Self {
        Self::NONE
    }
}

impl Slalom {
    /// All turns.
    pub const ALL: [Self; 6] = [
        Self::F45,
        Self::F90,
        Self::F135,
        Self::F180,
        Self::Fv90,
        Self::Fs90,
    ];

    /// Returns the length of the shortest way from the turn's beginning to its end, round the posts
    /// between them, in cells. No curve is shorter.
    #[must_use]
    pub const fn least_cells(self) -> f64 {
        use core::f64::consts::{FRAC_1_SQRT_2, SQRT_2};
        match self {
            // √5 / 2: one cell on and half a cell aside.
            Self::F45 => 1.118_033_988_749_895,
            Self::F90 | Self::F180 => SQRT_2,
            Self::F135 => FRAC_1_SQRT_2 + 0.5,
            Self::Fv90 => 1.0,
            Self::Fs90 => FRAC_1_SQRT_2,
        }
    }

    /// Returns the angle of the turn, rad.
    const fn angle(self) -> f64 {
        use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
        match self {
            Self::F45 => FRAC_PI_4,
            Self::F90 | Self::Fv90 | Self::Fs90 => FRAC_PI_2,
            Self::F135 => 3.0 * FRAC_PI_4,
            Self::F180 => PI,
        }
    }

    /// Returns the name of the turn, as builders write it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::F45 => "F45",
            Self::F90 => "F90",
            Self::F135 => "F135",
            Self::F180 => "F180",
            Self::Fv90 => "FV90",
            Self::Fs90 => "FS90",
        }
    }

    const fn field(self) -> &'static str {
        match self {
            Self::F45 => "slalom.f45",
            Self::F90 => "slalom.f90",
            Self::F135 => "slalom.f135",
            Self::F180 => "slalom.f180",
            Self::Fv90 => "slalom.fv90",
            Self::Fs90 => "slalom.fs90",
        }
    }
}

impl SpeedRunConfig {
    /// Returns the duration of a turn to `side`, ms, or `None` if the mouse does not make it.
    ///
    /// # Errors
    /// If the turn cannot be driven in that time or on that way.
    pub fn turn_ms(&self, slalom: Slalom, side: Side) -> Result<Option<u32>, SpeedRunConfigError> {
        let turns = match side {
            Side::Left => self.slalom_left.as_ref().unwrap_or(&self.slalom),
            Side::Right => &self.slalom,
        };
        match (turns.of(slalom), turns.in_place_ms) {
            (Some(SlalomTurn::Timed { time_ms }), _) => self.timed(slalom, time_ms).map(Some),
            (Some(SlalomTurn::Driven(turn)), _) => self.driven(slalom, &turn).map(Some),
            (None, Some(time_ms)) if slalom == Slalom::Fs90 => self.in_place(time_ms).map(Some),
            (None, _) => Ok(None),
        }
    }

    fn timed(&self, slalom: Slalom, time_ms: u32) -> Result<u32, SpeedRunConfigError> {
        let least_mm = slalom.least_cells() * self.cell_mm;
        let least_ms = (1000.0 * least_mm / self.turn_speed_mm_s) as u32;
        if time_ms < least_ms {
            return Err(SpeedRunConfigError::TurnTooFast {
                turn: slalom.name(),
                field: slalom.field(),
                speed_mm_s: self.turn_speed_mm_s,
                least_mm,
                least_ms,
            });
        }
        Ok(time_ms)
    }

    fn driven(&self, slalom: Slalom, turn: &DrivenTurn) -> Result<u32, SpeedRunConfigError> {
        let field = slalom.field();
        let curve_mm = match (turn.length_mm, turn.radius_mm) {
            (Some(length), None) => length,
            (None, Some(radius)) => radius * slalom.angle(),
            _ => return Err(SpeedRunConfigError::TurnLength { field }),
        };
        for value in [turn.speed_mm_s, curve_mm] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SpeedRunConfigError::NotPositive { field, value });
            }
        }
        for value in [turn.run_in_mm, turn.run_out_mm] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(SpeedRunConfigError::NotPositive { field, value });
            }
        }
        let length_mm = turn.run_in_mm + curve_mm + turn.run_out_mm;
        let least_mm = slalom.least_cells() * self.cell_mm;
        // Builders round to millimetres.
        if length_mm < least_mm - 1.0 {
            return Err(SpeedRunConfigError::TurnTooShort {
                turn: slalom.name(),
                field,
                length_mm,
                least_mm,
            });
        }
        let profile = match slalom {
            Slalom::Fv90 => self.diagonal,
            _ => self.straight,
        };
        let (ends, curve) = (self.turn_speed_mm_s, turn.speed_mm_s);
        let seconds = change(field, &profile, (ends, curve), turn.run_in_mm)?
            + curve_mm / curve
            + change(field, &profile, (curve, ends), turn.run_out_mm)?;
        Ok(libm::ceil(seconds * 1000.0 - 1e-6) as u32)
    }

    /// Returns the time from one side of a cell to the next, with a stop and a turn in its middle.
    fn in_place(&self, time_ms: u32) -> Result<u32, SpeedRunConfigError> {
        let (half, speed) = (self.cell_mm / 2.0, self.turn_speed_mm_s);
        room(
            "slalom.in_place_ms",
            (speed, 0.0),
            self.straight.braking(),
            half,
        )?;
        room(
            "slalom.in_place_ms",
            (0.0, speed),
            self.straight.acceleration_mm_s2,
            half,
        )?;
        let seconds = from_rest(speed, self.straight.braking(), half)
            + from_rest(speed, self.straight.acceleration_mm_s2, half);
        Ok(time_ms.saturating_add(libm::ceil(seconds * 1000.0 - 1e-6) as u32))
    }
}

/// Returns the time of a straight on which the speed changes, s. What is left of it is driven at
/// the higher speed.
fn change(
    field: &'static str,
    profile: &SpeedProfile,
    (from, to): (f64, f64),
    way: f64,
) -> Result<f64, SpeedRunConfigError> {
    let gain = if to > from {
        profile.acceleration_mm_s2
    } else {
        profile.braking()
    };
    let needed = room(field, (from, to), gain, way)?;
    Ok((to - from).abs() / gain + (way - needed).max(0.0) / from.max(to))
}

/// Returns the distance on which the speed changes, mm.
///
/// # Errors
/// If it is longer than `way_mm`.
pub(super) fn room(
    field: &'static str,
    (from_mm_s, to_mm_s): (f64, f64),
    gain: f64,
    way_mm: f64,
) -> Result<f64, SpeedRunConfigError> {
    let needed_mm = (to_mm_s * to_mm_s - from_mm_s * from_mm_s).abs() / (2.0 * gain);
    if needed_mm > way_mm + 1e-6 {
        return Err(SpeedRunConfigError::TooLittleRoom {
            field,
            from_mm_s,
            to_mm_s,
            needed_mm,
            way_mm,
        });
    }
    Ok(needed_mm)
}

#[cfg(feature = "serde")]
mod saved {
    use core::fmt;

    use serde::de::value::MapAccessDeserializer;
    use serde::de::{Error, MapAccess, Visitor};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::{DrivenTurn, SlalomTurn};

    impl Serialize for SlalomTurn {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            match self {
                Self::Timed { time_ms } => time_ms.serialize(serializer),
                Self::Driven(turn) => turn.serialize(serializer),
            }
        }
    }

    impl<'de> Deserialize<'de> for SlalomTurn {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            deserializer.deserialize_any(Turn)
        }
    }

    struct Turn;

    impl<'de> Visitor<'de> for Turn {
        type Value = SlalomTurn;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("a whole number of ms, or a table with speed_mm_s and the curve")
        }

        fn visit_u64<E: Error>(self, number: u64) -> Result<SlalomTurn, E> {
            let time_ms = u32::try_from(number)
                .map_err(|_| E::custom("a turn of more than 49 days; give its time in ms"))?;
            Ok(SlalomTurn::Timed { time_ms })
        }

        fn visit_i64<E: Error>(self, number: i64) -> Result<SlalomTurn, E> {
            let number = u64::try_from(number)
                .map_err(|_| E::custom("a turn takes no negative time; give its time in ms"))?;
            self.visit_u64(number)
        }

        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<SlalomTurn, A::Error> {
            DrivenTurn::deserialize(MapAccessDeserializer::new(map)).map(SlalomTurn::Driven)
        }
    }
}
