use thiserror::Error;

/// Parameters of driving a speed run, from which its times follow.
///
/// There is no default: take the preset of the kind of maze, [`SpeedRunConfig::classic`] or
/// [`SpeedRunConfig::half_size`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct SpeedRunConfig {
    /// Distance between the middles of two neighbouring cells. Millimetres, above 0. Rules of the
    /// competitions: 180 (classic), 90 (half-size).
    pub cell_mm: f64,
    /// Speed at the ends of every straight, that is in the slalom turns, and at the start. mm/s,
    /// above 0.
    pub turn_speed_mm_s: f64,
    /// Straights from cell to cell.
    pub straight: SpeedProfile,
    /// Straights from wall to wall at 45°.
    pub diagonal: SpeedProfile,
    /// Durations of the slalom turns.
    pub slalom: SlalomTimes,
}

/// Profile of a straight: constant acceleration up to the top speed, and the same deceleration at
/// the end.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct SpeedProfile {
    /// Acceleration, mm/s², above 0.
    pub acceleration_mm_s2: f64,
    /// Top speed, mm/s, at least the speed in the turns.
    pub top_speed_mm_s: f64,
}

/// Duration of each slalom turn, in whole milliseconds, 1 or more. [`Slalom`](super::Slalom)
/// defines their beginnings and ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct SlalomTimes {
    /// Turn of 45° from a straight into a diagonal, or from a diagonal into a straight.
    pub f45_ms: u16,
    /// Turn of 90° from a straight into a straight, over two cells.
    pub f90_ms: u16,
    /// Turn of 135° from a straight into a diagonal, or from a diagonal into a straight.
    pub f135_ms: u16,
    /// Turn of 180° from a straight into the straight beside it.
    pub f180_ms: u16,
    /// Turn of 90° from a diagonal into a diagonal.
    pub fv90_ms: u16,
}

impl SpeedRunConfig {
    /// Returns the configuration for half-size mazes, with the defaults of
    /// kerikun11/micromouse-maze-library (`StepMapSlalom::EdgeCost::RunParameter`). Cells are 90 mm
    /// wide and turns driven at 420 mm/s. Straights have 4200 mm/s² up to 1500 mm/s, diagonals 3600
    /// mm/s² up to 1200 mm/s.
    ///
    /// The library's sixth turn, FS90 (287 ms, within one cell), is left out, as in the library's
    /// own runs with diagonals. It is driven at 266 mm/s, slower than straights end, and serves its
    /// runs without diagonals.
    #[must_use]
    pub const fn half_size() -> Self {
        Self {
            cell_mm: 90.0,
            turn_speed_mm_s: 420.0,
            straight: SpeedProfile {
                acceleration_mm_s2: 4200.0,
                top_speed_mm_s: 1500.0,
            },
            diagonal: SpeedProfile {
                acceleration_mm_s2: 3600.0,
                top_speed_mm_s: 1200.0,
            },
            slalom: SlalomTimes {
                f45_ms: 257,
                f90_ms: 375,
                f135_ms: 465,
                f180_ms: 563,
                fv90_ms: 388,
            },
        }
    }

    /// Returns the configuration for classic mazes: like [`SpeedRunConfig::half_size`], with cells
    /// of 180 mm.
    #[must_use]
    pub const fn classic() -> Self {
        Self {
            cell_mm: 180.0,
            ..Self::half_size()
        }
    }
}

/// Reason why times cannot be worked out from a [`SpeedRunConfig`].
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SpeedRunConfigError {
    /// A length, speed or acceleration that is not a positive number.
    #[error("{field} is {value}; give a number above 0")]
    NotPositive {
        /// Name of the field.
        field: &'static str,
        /// Value that was given.
        value: f64,
    },
    /// A top speed below the speed in the turns.
    #[error(
        "{field} is {value} mm/s, below the {turn_speed_mm_s} mm/s in the turns: raise one or lower the other"
    )]
    TopSpeedTooLow {
        /// Name of the field.
        field: &'static str,
        /// Value that was given.
        value: f64,
        /// Speed in the turns, mm/s.
        turn_speed_mm_s: f64,
    },
    /// A move takes no time, or the longest straight that fits into the maze takes more than 65.535
    /// s.
    #[error("moves take {shortest_ms} to {longest_ms} ms: they have to take 1 to 65535 ms")]
    OutOfRange {
        /// Duration of the shortest move, ms.
        shortest_ms: u64,
        /// Duration of the longest move, ms.
        longest_ms: u64,
    },
}
