use super::SpeedRunTimes;
use super::map::NEVER;
use super::state::Node;

/// What is known of a run while it is searched for: where it ends, how long it takes at most, and
/// how long from each cell at least. Without an end, nothing.
pub(super) struct Estimate<const N: usize> {
    /// Column and row of the cell in which the run ends.
    end: (usize, usize),
    /// 1/16 ms for each cell of the way to the end along an axis, and for each along both.
    per_cell: [u32; 2],
    /// Duration of the fastest run found so far, ms.
    pub(super) at_most: u32,
}

impl<const N: usize> Estimate<N> {
    pub(super) fn to(end: Option<Node>, times: &SpeedRunTimes<N>) -> Self {
        let cell = end.map_or(0, |end| end.cell);
        Self {
            end: (cell % N, cell / N),
            per_cell: end.map_or([0; 2], |_| times.per_cell()),
            at_most: NEVER,
        }
    }

    /// Returns how long a run takes at least, ms, if it is in `cell` after `time`. No move makes
    /// that less: it takes as long as it brings the run nearer, or longer.
    #[inline(always)]
    pub(super) fn of_run(&self, time: u32, cell: usize) -> u32 {
        let east = (cell % N).abs_diff(self.end.0) as u32;
        let north = (cell / N).abs_diff(self.end.1) as u32;
        let [along, across] = self.per_cell;
        let both = east.min(north);
        time + (((east.max(north) - both) * along + both * across) >> 4)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_maze::{Grid, Maze};

    use super::super::ways::{straights, turns};
    use super::*;
    use crate::speed_run::{Slalom, SlalomTurn, SlalomTurns, SpeedRunConfig, SpeedRunConfigError};
    use crate::{Passages, Unknown};

    /// Times of moves that last very differently, too. Each turn takes its factor times its least.
    fn times(
        factors: [f64; 6],
        cell_mm: f64,
        top_speed: f64,
    ) -> Result<SpeedRunTimes<9>, SpeedRunConfigError> {
        let mut config = SpeedRunConfig::classic();
        config.cell_mm = cell_mm;
        config.straight.top_speed_mm_s = top_speed;
        let turn = |number: usize| {
            let least = Slalom::ALL[number].least_cells() * cell_mm / config.turn_speed_mm_s;
            let time_ms = (1000.0 * least * factors[number]) as u32;
            Some(SlalomTurn::Timed { time_ms })
        };
        let mut slalom = SlalomTurns::NONE;
        (slalom.f45, slalom.f90, slalom.f135) = (turn(0), turn(1), turn(2));
        (slalom.f180, slalom.fv90) = (turn(3), turn(4));
        slalom.fs90 = turn(5).filter(|_| factors[5] < 2.0);
        config.slalom = slalom;
        SpeedRunTimes::new(&config)
    }

    proptest! {
        #[test]
        fn no_move_makes_the_estimate_less(
            factors in prop::array::uniform6(1.0..3.0),
            cell_mm in 20.0..300.0,
            top_speed in 594.0..3000.0,
            end in 0_usize..81,
            from in 0_usize..81,
            state in 0_usize..16,
        ) {
            let Ok(times) = times(factors, cell_mm, top_speed) else {
                return Ok(());
            };
            let maze = Maze::open(Grid::new(9, 9));
            let passages = Passages::<9>::new(&maze, Unknown::Closed).unwrap();
            let estimate = Estimate::to(Some(Node::numbered(end, 0)), &times);
            let from = Node::numbered(from, state);
            prop_assume!(times.has_halves() || state < 12);
            let before = estimate.of_run(0, from.cell);
            for (cells, to) in straights::<9, [u32; 16]>(&passages, from, times.has_halves()) {
                let takes = times.straights_of(from.facing(), times.has_halves())[cells].into();
                prop_assert!(estimate.of_run(takes, to.cell) >= before);
            }
            for turn in turns::<9, [u32; 16]>(&passages, from) {
                let takes = times.turn_ms(turn.slalom, turn.side).min(1 << 24);
                prop_assert!(estimate.of_run(takes, turn.end(from).cell) >= before);
            }
            prop_assert_eq!(estimate.of_run(7, end), 7);
        }
    }
}
