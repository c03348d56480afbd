use core::array;

use super::config::{SpeedProfile, SpeedRunConfig, SpeedRunConfigError};
use super::map::NEVER;
use super::state::Facing;
use super::turn::room;
use super::{RunMove, Side, Slalom};

/// Durations of all moves of a speed run, in whole milliseconds, for mazes of up to `N` × `N`
/// cells. `N` is 16 for classic mazes and 32 for half-size ones. No cells, and more, do not
/// compile:
///
/// ```compile_fail
/// # use tolman_planners::speed_run::{SpeedRunConfig, SpeedRunTimes};
/// SpeedRunTimes::<0>::new(&SpeedRunConfig::classic()).ok();
/// ```
///
/// ```compile_fail
/// # use tolman_planners::speed_run::{SpeedRunConfig, SpeedRunTimes};
/// SpeedRunTimes::<33>::new(&SpeedRunConfig::classic()).ok();
/// ```
///
/// Times of straights are rounded up. So a straight never takes longer than its two parts one by
/// one, and the search need not look at straights that follow straights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpeedRunTimes<const N: usize> {
    /// Times of straights of 0 … N − 1 cells, ms.
    straight: [u16; N],
    /// Times of straights of 0 … 2 N − 1 half cells, ms.
    halves: [[u16; N]; 2],
    /// Times of diagonals of 0 … 2 N − 1 half cell diagonals, ms.
    diagonal: [[u16; N]; 2],
    /// Times of the turns to the left and to the right in the order of [`Slalom`], ms; [`NEVER`]
    /// for those that the mouse does not make.
    turns: [[u32; 6]; 2],
    /// 2¹⁶ by the time of the shortest move.
    bucket_scale: u32,
    /// What the fastest moves take for each cell along an axis, and for each along both axes, 1/16
    /// ms.
    per_cell: [u32; 2],
    /// Whether the mouse turns within a cell, from side to side: then straights have half cells.
    has_halves: bool,
}

impl<const N: usize> SpeedRunTimes<N> {
    /// Returns the times that follow from `config`. O(N).
    ///
    /// A straight of length `d` begins and ends at the speed `s` of the turns. With acceleration
    /// `a`, braking `b` and g = 2 a b / (a + b), it reaches the speed √(s² + g d) if that is at
    /// most its top speed, and then takes 2 (√(s² + g d) − s) / g. Otherwise it reaches the top
    /// speed `v` and takes (g d + (v − s)²) / (g v).
    ///
    /// # Errors
    /// If a value is not a positive number, a top speed is below the speed in the turns, a turn is
    /// faster or shorter than possible, the mouse cannot start or stop in the room that it has, or
    /// a move takes no time or more than 65.535 s.
    pub fn new(config: &SpeedRunConfig) -> Result<Self, SpeedRunConfigError> {
        const {
            assert!(N >= 1 && N <= 32, "a row of cells is a word of 32 bits");
        }
        check(config)?;
        let speed = config.turn_speed_mm_s;
        let half_diagonal = config.cell_mm * core::f64::consts::FRAC_1_SQRT_2;
        let straight_ms = |halves: usize| {
            milliseconds(config.straight, speed, config.cell_mm / 2.0 * halves as f64)
        };
        let diagonal_ms =
            |halves: usize| milliseconds(config.diagonal, speed, half_diagonal * halves as f64);

        let mut turns = [[NEVER; 6]; 2];
        for (turns, side) in turns.iter_mut().zip([Side::Left, Side::Right]) {
            for (turn, slalom) in turns.iter_mut().zip(Slalom::ALL) {
                *turn = config.turn_ms(slalom, side)?.unwrap_or(NEVER);
            }
        }
        let made = turns.iter().flatten().filter(|ms| **ms != NEVER);
        let has_halves = turns.iter().any(|[.., fs90]| *fs90 != NEVER);
        let straights = [straight_ms(2 * N - 1), diagonal_ms(2 * N - 1)];
        let longest_ms = made
            .clone()
            .map(|ms| u64::from(*ms))
            .chain(straights)
            .fold(0, u64::max);
        let straights = [straight_ms(2 - usize::from(has_halves)), diagonal_ms(1)];
        let shortest_ms = made
            .map(|ms| u64::from(*ms))
            .chain(straights)
            .fold(u64::MAX, u64::min);
        if shortest_ms == 0 || longest_ms > u64::from(u16::MAX) {
            return Err(SpeedRunConfigError::OutOfRange {
                longest_ms,
                shortest_ms,
            });
        }
        // Wider buckets are fewer, narrower ones let less be driven again. This was fastest.
        let bucket_scale = (1 << 16) / shortest_ms as u32;
        // All fit in 16 bits: none is longer than the longest.
        let mut times = Self {
            straight: array::from_fn(|cells| straight_ms(2 * cells) as u16),
            halves: array::from_fn(|half| array::from_fn(|n| straight_ms(half * N + n) as u16)),
            diagonal: array::from_fn(|half| array::from_fn(|n| diagonal_ms(half * N + n) as u16)),
            turns,
            bucket_scale,
            per_cell: [0; 2],
            has_halves,
        };
        // Times of cells beyond 8 s would not fit into the estimate.
        let [along, across] = times.fastest_ms_per_cell();
        let along = (16.0 * along).min(f64::from(1 << 17)) as u32;
        times.per_cell = [along, ((16.0 * across) as u32).min(2 * along)];
        Ok(times)
    }

    /// Returns the least times of moves for each cell that they lead on, ms: along an axis, and
    /// along both axes at once. A straight of n half cells leads on along an axis by n / 2 cells,
    /// rounded up. A diagonal of n half cell diagonals leads on along both by n / 2, rounded down,
    /// and along one of them by one more if n is odd; a turn at most along both by 1.
    fn fastest_ms_per_cell(&self) -> [f64; 2] {
        let turns = self.turns.as_flattened().iter();
        let turns = turns.fold(f64::INFINITY, |least, ms| least.min(f64::from(*ms)));
        let straights = self.halves.as_flattened().iter().enumerate().skip(1);
        let straights = straights.map(|(n, ms)| f64::from(*ms) / n.div_ceil(2) as f64);
        let one = self
            .diagonals()
            .get(1)
            .map_or(f64::INFINITY, |ms| f64::from(*ms));
        let along = straights.fold(one.min(turns), f64::min);
        let diagonals = self.diagonals().iter().enumerate().skip(2);
        let across = diagonals.map(|(n, ms)| {
            let rest = f64::from(*ms) - along * (n % 2) as f64;
            rest / (n / 2) as f64
        });
        [along, across.fold(turns.min(2.0 * along), f64::min)]
    }

    /// Returns the duration of a straight of `half_cells` half cells, ms, between the middles of
    /// cells and of their sides. Returns `None` if the straight does not fit into the maze.
    #[must_use]
    pub fn straight_ms(&self, half_cells: usize) -> Option<u16> {
        self.halves.as_flattened().get(half_cells).copied()
    }

    /// Returns the duration of a diagonal across `cells` cells, ms, from the middle of one edge to
    /// the middle of another. Returns `None` if the diagonal does not fit into the maze.
    #[must_use]
    pub fn diagonal_ms(&self, cells: usize) -> Option<u16> {
        self.diagonals().get(cells).copied()
    }

    /// Returns the duration of a move, ms, or `None` if no such straight fits into the maze or the
    /// mouse makes no such turn.
    #[must_use]
    pub fn of(&self, run_move: RunMove) -> Option<u32> {
        match run_move {
            RunMove::Straight { half_cells } => self.straight_ms(half_cells.into()).map(u32::from),
            RunMove::Diagonal { cells } => self.diagonal_ms(cells.into()).map(u32::from),
            RunMove::Turn { slalom, side } => {
                Some(self.turn_ms(slalom, side)).filter(|ms| *ms != NEVER)
            }
        }
    }

    /// Returns whether straights have half cells.
    #[inline(always)]
    pub(super) const fn has_halves(&self) -> bool {
        self.has_halves
    }

    /// Returns the durations of the straights or diagonals that lead on from a state, by number of
    /// cells, or of half cells.
    #[inline(always)]
    pub(super) const fn straights_of(&self, facing: Facing, has_halves: bool) -> &[u16] {
        match facing {
            Facing::Diagonal(..) => self.diagonals(),
            Facing::Straight(_) if !has_halves => &self.straight,
            Facing::Straight(_) | Facing::Edge(_) => self.halves.as_flattened(),
        }
    }

    /// Returns the durations of diagonals, by number of cells.
    pub(super) const fn diagonals(&self) -> &[u16] {
        self.diagonal.as_flattened()
    }

    /// Returns the duration of a turn, ms; [`NEVER`] if the mouse does not make it.
    #[inline(always)]
    pub(super) fn turn_ms(&self, slalom: Slalom, side: Side) -> u32 {
        self.numbered_turn_ms(turn_number(slalom, side))
    }

    /// Returns the same for a turn with this [`turn_number`].
    #[inline(always)]
    pub(super) fn numbered_turn_ms(&self, number: usize) -> u32 {
        let turns = self.turns.as_flattened();
        turns.get(number).copied().unwrap_or(NEVER)
    }

    pub(super) const fn per_cell(&self) -> [u32; 2] {
        self.per_cell
    }

    /// Returns the bucket of the search that a time belongs to.
    pub(super) const fn bucket(&self, time: u32) -> usize {
        ((time as u64 * self.bucket_scale as u64) >> 16) as usize
    }
}

/// Returns the number of a turn: those to the left come first.
pub(super) const fn turn_number(slalom: Slalom, side: Side) -> usize {
    side as usize * 6 + slalom as usize
}

/// Returns the duration of a straight of `length` millimetres, ms, rounded up.
fn milliseconds(drive: SpeedProfile, speed: f64, length: f64) -> u64 {
    let (up, down, top) = (
        drive.acceleration_mm_s2,
        drive.braking(),
        drive.top_speed_mm_s,
    );
    // Up and down take as long as with one gain both ways.
    let gain = 2.0 * up * down / (up + down);
    let gained = gain * length;
    let seconds = if gained < top * top - speed * speed {
        2.0 * (libm::sqrt(speed * speed + gained) - speed) / gain
    } else {
        (gained + (top - speed) * (top - speed)) / (gain * top)
    };
    // What misses a whole number by rounding errors alone is that number.
    libm::ceil(seconds * 1000.0 - 1e-6) as u64
}

fn check(config: &SpeedRunConfig) -> Result<(), SpeedRunConfigError> {
    let (straight, diagonal) = (config.straight, config.diagonal);
    let top_speeds = [
        ("straight.top_speed_mm_s", straight.top_speed_mm_s),
        ("diagonal.top_speed_mm_s", diagonal.top_speed_mm_s),
    ];
    let others = [
        ("cell_mm", config.cell_mm),
        ("turn_speed_mm_s", config.turn_speed_mm_s),
        ("straight.acceleration_mm_s2", straight.acceleration_mm_s2),
        ("diagonal.acceleration_mm_s2", diagonal.acceleration_mm_s2),
        ("straight.braking_mm_s2", straight.braking()),
        ("diagonal.braking_mm_s2", diagonal.braking()),
        ("start_mm", config.start_mm.unwrap_or(1.0)),
        ("stop_mm", config.stop_mm.unwrap_or(1.0)),
    ];
    for (field, value) in others.into_iter().chain(top_speeds) {
        if !(value > 0.0 && value.is_finite()) {
            return Err(SpeedRunConfigError::NotPositive { field, value });
        }
    }
    let turn_speed_mm_s = config.turn_speed_mm_s;
    for (field, value) in top_speeds {
        if value < turn_speed_mm_s {
            return Err(SpeedRunConfigError::TopSpeedTooLow {
                field,
                value,
                turn_speed_mm_s,
            });
        }
    }
    if let Some(way) = config.start_mm {
        room(
            "start_mm",
            (0.0, turn_speed_mm_s),
            straight.acceleration_mm_s2,
            way,
        )?;
    }
    if let Some(way) = config.stop_mm {
        room("stop_mm", (turn_speed_mm_s, 0.0), straight.braking(), way)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::format;
    use alloc::string::ToString;

    use crate::speed_run::{DrivenTurn, SlalomTurn, SlalomTurns};

    #[test]
    fn a_straight_takes_what_its_acceleration_allows() {
        let mut drive = SpeedProfile {
            acceleration_mm_s2: 1000.0,
            braking_mm_s2: None,
            top_speed_mm_s: 500.0,
        };
        // 100 mm from 200 mm/s: up to √(200² + 1000 · 100) mm/s in the middle and down again.
        let half = (f64::sqrt(200.0 * 200.0 + 1000.0 * 100.0) - 200.0) / 1000.0;
        assert_eq!(
            milliseconds(drive, 200.0, 100.0),
            (2000.0 * half).ceil() as u64
        );
        // 1000 mm: 105 mm up to the top speed in 0.3 s, 105 mm down, 790 mm at it.
        assert_eq!(milliseconds(drive, 200.0, 1000.0), 600 + 1580);
        assert_eq!(milliseconds(drive, 500.0, 1000.0), 2000);
        // Braking twice as hard: 105 mm up in 0.3 s, 52.5 mm down in 0.15 s, 842.5 mm at 500 mm/s.
        drive.braking_mm_s2 = Some(2000.0);
        assert_eq!(milliseconds(drive, 200.0, 1000.0), 450 + 1685);
    }

    #[test]
    fn a_move_takes_as_long_as_its_kind() {
        let config = SpeedRunConfig::classic();
        let times = SpeedRunTimes::<16>::new(&config).unwrap();
        for cells in 0..16_u16 {
            let [straight, diagonal] = [
                milliseconds(
                    config.straight,
                    config.turn_speed_mm_s,
                    config.cell_mm * f64::from(cells),
                ),
                milliseconds(
                    config.diagonal,
                    config.turn_speed_mm_s,
                    config.cell_mm * f64::from(cells) * core::f64::consts::FRAC_1_SQRT_2,
                ),
            ];
            assert_eq!(
                times
                    .of(RunMove::Straight {
                        half_cells: 2 * cells
                    })
                    .map(u64::from),
                Some(straight)
            );
            assert_eq!(
                times.of(RunMove::Diagonal { cells }).map(u64::from),
                Some(diagonal)
            );
        }
        assert_eq!(times.of(RunMove::Straight { half_cells: 32 }), None);
        assert_eq!(times.of(RunMove::Diagonal { cells: 32 }), None);
        let turn = RunMove::Turn {
            slalom: Slalom::F135,
            side: Side::Left,
        };
        assert_eq!(times.of(turn), Some(658));
    }

    /// Returns whether the classic preset is accepted after `change`.
    fn outcome(change: impl FnOnce(&mut SpeedRunConfig)) -> Result<(), SpeedRunConfigError> {
        let mut config = SpeedRunConfig::classic();
        change(&mut config);
        SpeedRunTimes::<16>::new(&config).map(drop)
    }

    #[test]
    fn straights_take_what_the_law_of_motion_says() {
        let times = SpeedRunTimes::<16>::new(&SpeedRunConfig::half_size());
        let straights = times.as_ref().map(|times| {
            // 1 cell: 2 (√(420² + 4200 · 90) − 420) / 4200 = 0.15455 s.
            // 15 cells reach 1500 mm/s: (4200 · 1350 + 1080²) / (4200 · 1500) = 1.08514 s.
            [0, 2, 30, 32].map(|halves| times.straight_ms(halves))
        });
        assert_eq!(straights, Ok([Some(0), Some(155), Some(1086), None]));
        // 1: 2 (√(420² + 3600 · 63.64) − 420) / 3600 = 0.12035 s.
        assert_eq!(times.map(|times| times.diagonal_ms(1)), Ok(Some(121)));
    }

    #[test]
    fn a_straight_never_takes_longer_than_its_parts() {
        for (turn_speed, top_speed) in [(420.0, 1500.0), (333.0, 333.0), (1000.0, 1000.1)] {
            let mut config = SpeedRunConfig::half_size();
            config.turn_speed_mm_s = turn_speed;
            config.straight.top_speed_mm_s = top_speed;
            config.diagonal.top_speed_mm_s = top_speed;
            config.slalom.f45 = Some(SlalomTurn::Timed { time_ms: 100 });
            config = config.without_diagonals();
            config.slalom.f90 = None;
            config.slalom.f180 = None;
            let times = SpeedRunTimes::<16>::new(&config);
            for table in times
                .iter()
                .flat_map(|times| [times.halves.as_flattened(), times.diagonals()])
            {
                for (whole, time) in table.iter().enumerate() {
                    for part in 0..=whole {
                        assert!(table[part] + table[whole - part] >= *time);
                    }
                }
            }
        }
    }

    #[test]
    fn what_cannot_be_driven_is_refused() {
        use SpeedRunConfigError::{NotPositive, OutOfRange, TopSpeedTooLow};
        assert_eq!(outcome(|_| ()), Ok(()));
        assert!(matches!(
            outcome(|config| config.cell_mm = f64::NAN),
            Err(NotPositive {
                field: "cell_mm",
                ..
            })
        ));
        assert!(matches!(
            outcome(|config| config.diagonal.acceleration_mm_s2 = f64::INFINITY),
            Err(NotPositive {
                field: "diagonal.acceleration_mm_s2",
                ..
            })
        ));
        assert!(matches!(
            outcome(|config| config.straight.top_speed_mm_s = 400.0),
            Err(TopSpeedTooLow {
                field: "straight.top_speed_mm_s",
                ..
            })
        ));
        assert!(matches!(
            outcome(|config| config.cell_mm = 1e-9),
            Err(OutOfRange { shortest_ms: 0, .. })
        ));
        assert!(matches!(
            outcome(|config| {
                config.cell_mm = 1e9;
                config.slalom = SlalomTurns::NONE;
            }),
            Err(OutOfRange { .. })
        ));
    }

    #[test]
    fn turns_take_the_time_of_their_way_at_least() {
        let told = |change: &dyn Fn(&mut SpeedRunConfig)| {
            let mut config = SpeedRunConfig::classic();
            (config.turn_speed_mm_s, config.slalom) = (420.0, SlalomTurns::NONE);
            change(&mut config);
            SpeedRunTimes::<16>::new(&config)
                .err()
                .map(|error| error.to_string())
        };
        let timed = |time_ms| Some(SlalomTurn::Timed { time_ms });
        // The least times of the five turns and of that within a cell at 420 mm/s.
        for (least, set) in [
            (
                479,
                (|turns, turn| turns.f45 = turn) as fn(&mut SlalomTurns, Option<SlalomTurn>),
            ),
            (606, |turns, turn| turns.f90 = turn),
            (517, |turns, turn| turns.f135 = turn),
            (606, |turns, turn| turns.f180 = turn),
            (428, |turns, turn| turns.fv90 = turn),
            (303, |turns, turn| turns.fs90 = turn),
        ] {
            assert_eq!(told(&|config| set(&mut config.slalom, timed(least))), None);
            let why = told(&|config| set(&mut config.slalom, timed(least - 1))).unwrap();
            assert!(
                why.contains(&format!("takes at least {least} ms at 420 mm/s: ")),
                "{why}"
            );
        }
        let driven = |speed_mm_s, radius_mm, run_in_mm, run_out_mm| {
            Some(SlalomTurn::Driven(DrivenTurn {
                speed_mm_s,
                length_mm: None,
                radius_mm: Some(radius_mm),
                run_in_mm,
                run_out_mm,
            }))
        };
        // A quarter circle in a cell: 90 mm · π / 2 at 420 mm/s.
        let mut config = SpeedRunConfig::classic();
        config.turn_speed_mm_s = 420.0;
        config.slalom.fs90 = driven(420.0, 90.0, 0.0, 0.0);
        assert_eq!(config.turn_ms(Slalom::Fs90, Side::Left), Ok(Some(337)));
        // At 360 mm/s with 20 mm on both sides, where braking takes 5.6 mm.
        config.slalom.fs90 = driven(360.0, 70.0, 20.0, 20.0);
        assert_eq!(config.turn_ms(Slalom::Fs90, Side::Left), Ok(Some(403)));
        let why = told(&|config| config.slalom.fs90 = driven(300.0, 90.0, 0.0, 0.0)).unwrap();
        assert!(
            why.contains("needs 10 mm to get from 420 to 300 mm/s, and has 0 mm"),
            "{why}"
        );
        let why = told(&|config| config.slalom.f90 = driven(420.0, 90.0, 0.0, 0.0)).unwrap();
        assert!(why.contains("F90 is 141 mm long"), "{why}");
        // In place: 90 mm to rest and 90 mm from it, with 0.1 s of braking each, and the turn.
        config.slalom.fs90 = None;
        config.slalom.in_place_ms = Some(300);
        assert_eq!(
            config.turn_ms(Slalom::Fs90, Side::Left),
            Ok(Some(300 + 529))
        );
        let why = told(&|config| {
            config.slalom.in_place_ms = Some(300);
            config.straight.braking_mm_s2 = Some(500.0);
        });
        assert!(why.is_some_and(|why| why.contains("needs 176 mm to get from 420 to 0 mm/s")));
        config.start_mm = Some(42.0);
        config.stop_mm = Some(10.0);
        assert_eq!(config.start_ms(), 150);
        let why = SpeedRunTimes::<16>::new(&config).unwrap_err().to_string();
        assert!(why.contains("`stop_mm`: the mouse needs 21 mm"), "{why}");
    }
}
