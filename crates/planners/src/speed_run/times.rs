use core::array;

use super::config::{SlalomTimes, SpeedProfile, SpeedRunConfig, SpeedRunConfigError};
use super::state::Facing;
use super::{RunMove, Slalom};

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
    /// Times of diagonals of 0 … 2 N − 1 half cell diagonals, ms.
    diagonal: [[u16; N]; 2],
    slalom: SlalomTimes,
    /// The same times in the order of [`Slalom`], for the search, which looks them up without a
    /// branch.
    turns: [u16; 5],
    /// 2¹⁶ by twice the time of the shortest move.
    bucket_scale: u32,
    /// What the fastest move takes for each cell that it leads on, 1/16 ms.
    per_cell: u32,
}

impl<const N: usize> SpeedRunTimes<N> {
    /// Returns the times that follow from `config`. O(N).
    ///
    /// A straight of length `d` begins and ends at the speed `s` of the turns. If a d < v² − s²,
    /// the mouse does not reach its top speed `v`. With acceleration `a` it then takes 2 (√(s² + a
    /// d) − s) / a. Otherwise it takes (a d + (v − s)²) / (a v).
    ///
    /// # Errors
    /// If a value is not a positive number, a top speed is below the speed in the turns, or a move
    /// takes no time or more than 65.535 s.
    pub fn new(config: &SpeedRunConfig) -> Result<Self, SpeedRunConfigError> {
        const {
            assert!(N >= 1 && N <= 32, "a row of cells is a word of 32 bits");
        }
        check(config)?;
        let speed = config.turn_speed_mm_s;
        let half_diagonal = config.cell_mm * core::f64::consts::FRAC_1_SQRT_2;
        let straight_ms =
            |cells: usize| milliseconds(config.straight, speed, config.cell_mm * cells as f64);
        let diagonal_ms =
            |halves: usize| milliseconds(config.diagonal, speed, half_diagonal * halves as f64);

        let slalom = config.slalom;
        let turns = slalom.all().map(u64::from);
        let straights = [straight_ms(N - 1), diagonal_ms(2 * N - 1)];
        let longest_ms = turns.into_iter().chain(straights).fold(0, u64::max);
        let straights = [straight_ms(1), diagonal_ms(1)];
        let shortest_ms = turns.into_iter().chain(straights).fold(u64::MAX, u64::min);
        if shortest_ms == 0 || longest_ms > u64::from(u16::MAX) {
            return Err(SpeedRunConfigError::OutOfRange {
                longest_ms,
                shortest_ms,
            });
        }
        // Wider buckets are fewer, narrower ones let less be driven again. This was fastest.
        let bucket_scale = (1_u32 << 16) / (2 * shortest_ms as u32);
        // All fit in 16 bits: none is longer than the longest.
        let mut times = Self {
            straight: array::from_fn(|cells| straight_ms(cells) as u16),
            diagonal: array::from_fn(|half| array::from_fn(|n| diagonal_ms(half * N + n) as u16)),
            slalom,
            turns: slalom.all(),
            bucket_scale,
            per_cell: 0,
        };
        times.per_cell = (16.0 * times.fastest_ms_per_cell()) as u32;
        Ok(times)
    }

    /// Returns the least time of a move for each cell that it leads on, ms. A diagonal of n half
    /// cell diagonals leads on by n √½ cells, or by one cell if n = 1; a turn by at most √2 cells.
    fn fastest_ms_per_cell(&self) -> f64 {
        use core::f64::consts::{FRAC_1_SQRT_2, SQRT_2};
        let per = |cells: f64| move |ms: &u16| f64::from(*ms) / cells;
        let straights = self.straights().iter().enumerate().skip(1);
        let straights = straights.map(|(cells, ms)| per(cells as f64)(ms));
        let diagonals = self.diagonals().iter().enumerate().skip(1);
        let diagonals =
            diagonals.map(|(halves, ms)| per(f64::max(1.0, FRAC_1_SQRT_2 * halves as f64))(ms));
        let turns = self.turns.iter().map(per(SQRT_2));
        straights
            .chain(diagonals)
            .chain(turns)
            .fold(f64::INFINITY, f64::min)
    }

    /// Returns the duration of a straight of `cells` cells, ms, from the middle of one cell to the
    /// middle of another. Returns `None` if the straight does not fit into the maze.
    #[must_use]
    pub fn straight_ms(&self, cells: usize) -> Option<u16> {
        self.straights().get(cells).copied()
    }

    /// Returns the duration of a diagonal across `cells` cells, ms, from the middle of one edge to
    /// the middle of another. Returns `None` if the diagonal does not fit into the maze.
    #[must_use]
    pub fn diagonal_ms(&self, cells: usize) -> Option<u16> {
        self.diagonals().get(cells).copied()
    }

    /// Returns the duration of a move, ms, or `None` if no such straight fits into the maze.
    #[must_use]
    pub fn of(&self, run_move: RunMove) -> Option<u16> {
        match run_move {
            RunMove::Straight { cells } => self.straight_ms(cells.into()),
            RunMove::Diagonal { cells } => self.diagonal_ms(cells.into()),
            RunMove::Turn { slalom, .. } => Some(self.turn_ms(slalom)),
        }
    }

    /// Returns the durations of the slalom turns.
    #[must_use]
    pub const fn slalom(&self) -> SlalomTimes {
        self.slalom
    }

    /// Returns the durations of the straights or diagonals that lead on from a state, by number of
    /// cells.
    #[inline(always)]
    pub(super) const fn straights_of(&self, facing: Facing) -> &[u16] {
        match facing {
            Facing::Straight(_) => self.straights(),
            Facing::Diagonal(..) => self.diagonals(),
        }
    }

    /// Returns the durations of straights, by number of cells.
    pub(super) const fn straights(&self) -> &[u16] {
        &self.straight
    }

    /// Returns the durations of diagonals, by number of cells.
    pub(super) const fn diagonals(&self) -> &[u16] {
        self.diagonal.as_flattened()
    }

    /// Returns the duration of a turn, ms.
    #[inline(always)]
    pub(super) fn turn_ms(&self, slalom: Slalom) -> u16 {
        self.turns.get(slalom as usize).copied().unwrap_or(u16::MAX)
    }

    pub(super) const fn per_cell(&self) -> u32 {
        self.per_cell
    }

    /// Returns the bucket of the search that a time belongs to.
    pub(super) const fn bucket(&self, time: u16) -> usize {
        bucket(self.bucket_scale, time)
    }
}

const fn bucket(scale: u32, time: u16) -> usize {
    ((time as u32 * scale) >> 16) as usize
}

impl SlalomTimes {
    /// Returns the times in the order of [`Slalom`].
    fn all(&self) -> [u16; 5] {
        use Slalom::{F45, F90, F135, F180, Fv90};
        [F45, F90, F135, F180, Fv90].map(|slalom| self.time_ms(slalom))
    }
}

/// Returns the duration of a straight of `length` millimetres, ms, rounded up.
fn milliseconds(drive: SpeedProfile, speed: f64, length: f64) -> u64 {
    let SpeedProfile {
        acceleration_mm_s2: acceleration,
        top_speed_mm_s: top,
    } = drive;
    let gained = acceleration * length;
    let seconds = if gained < top * top - speed * speed {
        2.0 * (libm::sqrt(speed * speed + gained) - speed) / acceleration
    } else {
        (gained + (top - speed) * (top - speed)) / (acceleration * top)
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
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::speed_run::{Side, Slalom};

    #[test]
    fn a_straight_takes_what_its_acceleration_allows() {
        let drive = SpeedProfile {
            acceleration_mm_s2: 1000.0,
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
                times.of(RunMove::Straight { cells }).map(u64::from),
                Some(straight)
            );
            assert_eq!(
                times.of(RunMove::Diagonal { cells }).map(u64::from),
                Some(diagonal)
            );
        }
        assert_eq!(times.of(RunMove::Straight { cells: 16 }), None);
        assert_eq!(times.of(RunMove::Diagonal { cells: 32 }), None);
        let turn = RunMove::Turn {
            slalom: Slalom::F135,
            side: Side::Left,
        };
        assert_eq!(times.of(turn), Some(config.slalom.f135_ms));
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
            [0, 1, 15, 16].map(|cells| times.straight_ms(cells))
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
            config.slalom.f45_ms = 100;
            let times = SpeedRunTimes::<16>::new(&config);
            for table in times
                .iter()
                .flat_map(|times| [times.straights(), times.diagonals()])
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
            outcome(|config| config.slalom.f90_ms = 0),
            Err(OutOfRange { shortest_ms: 0, .. })
        ));
        assert!(matches!(
            outcome(|config| config.cell_mm = 1e9),
            Err(OutOfRange { .. })
        ));
    }
}
