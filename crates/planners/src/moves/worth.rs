use tolman_maze::Cell;

use super::chart::{Chart, Driven};
use super::config::positive;
use super::rival::Rival;
use super::rivals::Rivals;
use super::sides::Sides;
use super::{MoveExplorerConfigError, Rollouts};

/// Condition on which [`Rollouts`] stop although the best run is not proven: when looking on costs
/// more than the expected gain.
///
/// Mazes are drawn that agree with all known walls. In each, each of the explorer's twelve best
/// stops is tried, and after it the proof is played to its end. A play costs its steps. It gains
/// the steps by which the drawn maze's best run is shorter than the known run. The mouse drives to
/// the best stop if its plays are on average worth more than they cost. Otherwise it stops.
///
/// It is unknown in advance when a proof is broken off. So a play counts half as if it were played
/// to its end, and half as if it were broken off at its best moment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct WorthConfig {
    /// Number of mazes drawn for a decision, in place of
    /// [`RolloutConfig::completions`](super::RolloutConfig::completions). ≥ 1.
    pub completions: u16,
    /// Factor on the gain of a play to its end, > 0. Above 1 it stands for a mouse that breaks off
    /// when looks turn out to gain nothing, which a play does not do.
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
            gain: 1.5,
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

impl Payoff {
    /// Returns the cost of the play, which is below 0 if it is better than to stop at once.
    fn cost(&self, worth: &WorthConfig) -> f32 {
        let at_end = self.steps - worth.gain * self.gain / worth.step_price;
        f32::midpoint(at_end, self.at_best)
    }
}

/// Number of stops that are tried, the explorer's own among them.
const STOPS: usize = 12;

impl<const N: usize> Rollouts<N> {
    /// Returns the best stop, among those that the base policy rates highest, from the cell `at`.
    /// Returns `None` if none is expected to gain more than it costs. The known run takes `closed`
    /// steps.
    pub(super) fn choose_worthwhile(
        &self,
        worth: &WorthConfig,
        chart: &Chart<N>,
        at: Cell,
        closed: u16,
    ) -> Option<Cell> {
        let mut rivals = Rivals::of(&self.base.proofs::<STOPS>(chart, at, closed))?;
        let mut own = Rival::new(rivals.own);
        let mut completions = self.completions(chart);
        for drawn in 1..=worth.completions {
            let maze = completions.draw();
            // A play without an end reveals nothing about this maze.
            let Some(cost) = self.hold_costs(worth, chart, &maze, at, &mut rivals) else {
                continue;
            };
            own.add(cost);
            if drawn >= self.config.trial {
                rivals.give_up_worse();
            }
        }
        let best = rivals.best(self.config.confidence);
        let (stop, saved) = best.map_or((own.stop, 0.0), |best| (best.stop, best.mean()));
        (own.mean() + saved < 0.0).then_some(stop)
    }

    /// Compares the rivals with the explorer's own stop by their costs in one maze, and returns the
    /// cost of the own stop.
    fn hold_costs(
        &self,
        worth: &WorthConfig,
        chart: &Chart<N>,
        maze: &Sides<N>,
        at: Cell,
        rivals: &mut Rivals<STOPS>,
    ) -> Option<f32> {
        let cost = |stop| {
            let payoff = self.payoff(worth, chart, maze, stop, at)?;
            Some(payoff.cost(worth))
        };
        let own = cost(rivals.own)?;
        for rival in rivals.iter_mut() {
            if let Some(its) = cost(rival.stop) {
                rival.add(its - own);
            }
        }
        Some(own)
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
