use tolman_maze::Cell;

use super::chart::{Chart, Driven};
use super::config::positive;
use super::rival::Rival;
use super::sides::Sides;
use super::{MoveExplorerConfigError, Rollouts};

/// Condition on which [`Rollouts`] stop although the best run is not proven: when looking on costs
/// more than the expected gain.
///
/// Mazes are drawn that agree with all known walls, and the rest of the proof is played in each.
/// The gain is how much shorter the drawn maze's best run is than the known run. The price is the
/// number of steps of the proof.
///
/// The stops are chosen by the score then, not by the steps of the proof. It is unknown in advance
/// when a proof is broken off. So a play counts half as if it were played to its end, and half as
/// if it were broken off at its best moment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct WorthConfig {
    /// Number of mazes drawn for a decision, in place of
    /// [`RolloutConfig::completions`](super::RolloutConfig::completions). ≥ 1.
    pub completions: u16,
    /// Factor on the expected gain, > 0. Drawn mazes are less odd than real ones, and the oddities
    /// that they never show can be worth most.
    pub gain: f32,
    /// Price of a step of the exploration, in steps of the run. > 0; the rules have a thirtieth.
    pub step_price: f32,
}

impl WorthConfig {
    /// Returns the configuration with which all figures of the project are made.
    /// `docs/micromouse.md` explains how it was chosen.
    #[must_use]
    pub const fn tuned() -> Self {
        Self {
            completions: 48,
            gain: 2.5,
            step_price: 1.0 / 30.0,
        }
    }

    pub(super) fn check(&self) -> Result<(), MoveExplorerConfigError> {
        let Self {
            completions,
            gain,
            step_price,
            ..
        } = *self;
        MoveExplorerConfigError::check([
            positive("completions", f32::from(completions)),
            positive("gain", gain),
            positive("step_price", step_price),
        ])
    }
}

/// Gain of a play against stopping at once, in steps of the exploration.
#[derive(Clone, Copy, Debug)]
struct Payoff {
    /// Steps of the whole proof.
    steps: f32,
    /// Number of steps by which the run gets shorter.
    gain: f32,
    /// Least cost at any moment: the steps until then, minus the worth of the gain.
    at_best: f32,
}

impl<const N: usize> Rollouts<N> {
    /// Returns whether further looks cost more than they are expected to gain, from the cell `at`,
    /// if the known run takes `closed` steps.
    pub(super) fn is_enough(
        &self,
        worth: &WorthConfig,
        chart: &Chart<N>,
        at: Cell,
        closed: u16,
    ) -> bool {
        let Some(stop) = self.base.proofs::<1>(chart, at, closed).best() else {
            return false;
        };
        let mut completions = self.completions(chart);
        let net: f32 = (0..worth.completions)
            .filter_map(|_| self.payoff(worth, chart, &completions.draw(), stop, at))
            .map(|payoff| worth.gain * payoff.gain - worth.step_price * payoff.steps)
            .sum();
        net <= 0.0
    }

    /// Compares the rivals with the explorer's own stop by the score in one maze.
    pub(super) fn hold_scores(
        &self,
        worth: &WorthConfig,
        chart: &Chart<N>,
        maze: &Sides<N>,
        (own, at): (Cell, Cell),
        rivals: &mut [Option<Rival>],
    ) -> Option<()> {
        let cost = |stop| {
            let payoff = self.payoff(worth, chart, maze, stop, at)?;
            let at_end = payoff.steps - payoff.gain / worth.step_price;
            Some(f32::midpoint(at_end, payoff.at_best))
        };
        let steps = cost(own)?;
        for rival in rivals.iter_mut().flatten() {
            if let Some(its) = cost(rival.stop) {
                rival.add(its - steps);
            }
        }
        Some(())
    }

    /// Plays from `at` over `stop` to the end of the proof, in a maze with the open sides `maze`.
    fn payoff(
        &self,
        worth: &WorthConfig,
        chart: &Chart<N>,
        maze: &Sides<N>,
        stop: Cell,
        at: Cell,
    ) -> Option<Payoff> {
        let before = chart.closed?;
        let mut chart = chart.clone();
        let (mut at, mut stop) = (at, stop);
        let mut payoff = Payoff {
            steps: 0.0,
            gain: 0.0,
            at_best: 0.0,
        };
        loop {
            let driven: Driven = chart.drive(maze, stop, at)?;
            at = driven.at;
            let (open, closed) = (chart.open()?, chart.closed?);
            payoff.steps += f32::from(driven.steps);
            payoff.gain = f32::from(before.saturating_sub(closed));
            let cost = payoff.steps - payoff.gain / worth.step_price;
            payoff.at_best = payoff.at_best.min(cost);
            if open == closed {
                return Some(payoff);
            }
            stop = self.base.proofs::<1>(&chart, at, closed).best()?;
        }
    }
}
