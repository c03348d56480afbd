use thiserror::Error;

use super::turn::SlalomTurns;

/// Parameters of driving a speed run, from which its times follow.
///
/// There is no default: take the preset of the kind of maze, [`SpeedRunConfig::classic`] or
/// [`SpeedRunConfig::half_size`], or [`SpeedRunConfig::beginner`] for a mouse without diagonals.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct SpeedRunConfig {
    /// Distance between the middles of two neighbouring cells. Millimetres, above 0. Rules of the
    /// competitions: 180 (classic), 90 (half-size).
    pub cell_mm: f64,
    /// Speed at the ends of every straight and turn. mm/s, above 0.
    pub turn_speed_mm_s: f64,
    /// Distance from where the mouse stands, its back to the wall, to the middle of the start cell.
    /// Millimetres, above 0. `None`: the run begins in that middle at the speed of the turns.
    #[cfg_attr(feature = "serde", serde(default))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub start_mm: Option<f64>,
    /// Distance that the mouse has to stop beyond the middle of the goal cell. Millimetres, above
    /// 0. `None`: the run ends in that middle at the speed of the turns.
    #[cfg_attr(feature = "serde", serde(default))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub stop_mm: Option<f64>,
    /// Straights from cell to cell.
    pub straight: SpeedProfile,
    /// Straights from wall to wall at 45°.
    pub diagonal: SpeedProfile,
    /// Turns. A turn that is left out is never made.
    pub slalom: SlalomTurns,
    /// Turns to the left, where they differ from those to the right.
    #[cfg_attr(feature = "serde", serde(default))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub slalom_left: Option<SlalomTurns>,
    /// Pace of the exploration. `None`: it is told in cells only.
    #[cfg_attr(feature = "serde", serde(default))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub search: Option<SearchPace>,
}

/// Profile of a straight: constant acceleration up to the top speed, and constant braking at the
/// end.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct SpeedProfile {
    /// Acceleration, mm/s², above 0.
    pub acceleration_mm_s2: f64,
    /// Deceleration, mm/s², above 0. `None`: as the acceleration.
    #[cfg_attr(feature = "serde", serde(default))]
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub braking_mm_s2: Option<f64>,
    /// Top speed, mm/s, at least the speed in the turns.
    pub top_speed_mm_s: f64,
}

/// Durations of an exploration. Each cell is counted from one of its sides to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct SearchPace {
    /// Duration of a cell driven straight through, ms.
    pub ahead_ms: u32,
    /// Duration of a cell in which the mouse turns by 90°, ms.
    pub turn_ms: u32,
    /// Duration of a cell in which the mouse turns back, ms.
    pub back_ms: u32,
}

impl SpeedProfile {
    /// Returns the same acceleration and braking up to a top speed.
    const fn new(acceleration_mm_s2: f64, top_speed_mm_s: f64) -> Self {
        Self {
            acceleration_mm_s2,
            braking_mm_s2: None,
            top_speed_mm_s,
        }
    }

    /// Returns the deceleration, mm/s².
    #[must_use]
    pub fn braking(&self) -> f64 {
        self.braking_mm_s2.unwrap_or(self.acceleration_mm_s2)
    }
}

impl SpeedRunConfig {
    /// Returns the configuration for half-size mazes, with the defaults of
    /// kerikun11/micromouse-maze-library (`StepMapSlalom::EdgeCost::RunParameter`). Cells are 90 mm
    /// wide and turns driven at 420 mm/s. Straights have 4200 mm/s² up to 1500 mm/s, diagonals 3600
    /// mm/s² up to 1200 mm/s.
    ///
    /// The library's sixth turn, FS90 (287 ms, within one cell), is left out, as in the library's
    /// own runs with diagonals. It is driven at 266 mm/s, slower than straights end, and serves its
    /// runs without diagonals: see [`SpeedRunConfig::beginner_half_size`].
    #[must_use]
    pub const fn half_size() -> Self {
        Self {
            cell_mm: 90.0,
            turn_speed_mm_s: 420.0,
            start_mm: None,
            stop_mm: None,
            straight: SpeedProfile::new(4200.0, 1500.0),
            diagonal: SpeedProfile::new(3600.0, 1200.0),
            slalom: SlalomTurns::timed([257, 375, 465, 563, 388]),
            slalom_left: None,
            search: None,
        }
    }

    /// Returns the configuration for classic mazes. Cells are 180 mm wide. Turns are the curves of
    /// [`SpeedRunConfig::half_size`] at twice the size, with the same lateral acceleration: speed
    /// and times are √2 times as high. Straights and diagonals accelerate alike.
    #[must_use]
    pub const fn classic() -> Self {
        Self {
            cell_mm: 180.0,
            turn_speed_mm_s: 594.0,
            slalom: SlalomTurns::timed([364, 531, 658, 797, 549]),
            ..Self::half_size()
        }
    }

    /// Returns the configuration of a first mouse in half-size mazes: without diagonals, with turns
    /// of 90° within a cell only. The turn is the FS90 of kerikun11/micromouse-maze-library: 287 ms
    /// at 266 mm/s.
    #[must_use]
    pub const fn beginner_half_size() -> Self {
        let mut slalom = SlalomTurns::NONE;
        slalom.fs90 = Some(super::SlalomTurn::Timed { time_ms: 287 });
        Self {
            turn_speed_mm_s: 266.0,
            slalom,
            ..Self::half_size()
        }
    }

    /// Returns the configuration of a first mouse in classic mazes, scaled as
    /// [`SpeedRunConfig::classic`] is.
    #[must_use]
    pub const fn beginner() -> Self {
        let mut slalom = SlalomTurns::NONE;
        slalom.fs90 = Some(super::SlalomTurn::Timed { time_ms: 406 });
        Self {
            turn_speed_mm_s: 376.0,
            slalom,
            ..Self::classic()
        }
    }

    /// Returns the same mouse, which makes no diagonal.
    #[must_use]
    pub const fn without_diagonals(mut self) -> Self {
        self.slalom = self.slalom.without_diagonals();
        if let Some(left) = self.slalom_left {
            self.slalom_left = Some(left.without_diagonals());
        }
        self
    }

    /// Returns the time from rest to the middle of the start cell, in which the mouse reaches the
    /// speed of the turns, ms. 0 without [`SpeedRunConfig::start_mm`].
    #[must_use]
    pub fn start_ms(&self) -> u32 {
        self.standing_ms(self.start_mm, self.straight.acceleration_mm_s2)
    }

    /// Returns the time from the middle of the goal cell to rest, ms. 0 without
    /// [`SpeedRunConfig::stop_mm`].
    #[must_use]
    pub fn stop_ms(&self) -> u32 {
        self.standing_ms(self.stop_mm, self.straight.braking())
    }

    fn standing_ms(&self, way_mm: Option<f64>, gain: f64) -> u32 {
        way_mm.map_or(0, |way| {
            // What misses a whole number by rounding errors alone is that number.
            libm::ceil(from_rest(self.turn_speed_mm_s, gain, way) * 1000.0 - 1e-6) as u32
        })
    }
}

/// Returns the time to reach `speed` from rest and drive on at it, `way` millimetres in all,
/// seconds. The same to brake.
pub(super) fn from_rest(speed: f64, gain: f64, way: f64) -> f64 {
    speed / gain + (way - speed * speed / (2.0 * gain)) / speed
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
    /// The mouse would have to drive a turn faster than it can.
    #[error(
        "{turn} takes at least {least_ms} ms at {speed_mm_s} mm/s: its shortest way is {least_mm:.0} mm; give `{field}` {least_ms} or more, or raise `turn_speed_mm_s`"
    )]
    TurnTooFast {
        /// Name of the turn.
        turn: &'static str,
        /// Name of its field.
        field: &'static str,
        /// Speed in the turns, mm/s.
        speed_mm_s: f64,
        /// Length of its shortest way, mm.
        least_mm: f64,
        /// Duration of that, ms.
        least_ms: u32,
    },
    /// A turn with a length does not reach its end.
    #[error(
        "{turn} is {length_mm:.0} mm long with its run-in and run-out, but its shortest way is {least_mm:.0} mm: give `{field}` a greater length or radius"
    )]
    TurnTooShort {
        /// Name of the turn.
        turn: &'static str,
        /// Name of its field.
        field: &'static str,
        /// Length of run-in, curve and run-out, mm.
        length_mm: f64,
        /// Length of the shortest way, mm.
        least_mm: f64,
    },
    /// A turn says not how long its curve is, or says it twice.
    #[error("`{field}` needs either `length_mm` or `radius_mm`, the length or radius of its curve")]
    TurnLength {
        /// Name of the turn's field.
        field: &'static str,
    },
    /// The mouse cannot change its speed within a distance.
    #[error(
        "`{field}`: the mouse needs {needed_mm:.0} mm to get from {from_mm_s} to {to_mm_s} mm/s, and has {way_mm:.0} mm: give it more room, or bring the speeds nearer to each other"
    )]
    TooLittleRoom {
        /// Name of the field.
        field: &'static str,
        /// Speed at the beginning, mm/s.
        from_mm_s: f64,
        /// Speed at the end, mm/s.
        to_mm_s: f64,
        /// Distance that this takes, mm.
        needed_mm: f64,
        /// Distance that there is, mm.
        way_mm: f64,
    },
}
