use tolman_maze::{Cell, Walls};

use super::chart::Chart;
use super::completion::Completions;
use super::config::{at_least_0, positive};
use super::explorer::Task;
use super::play::{Play, Stage};
use super::rivals::Rivals;
use super::sides::Sides;
use super::split_mix::SplitMix;
use super::worth::WorthConfig;
use super::{MoveDecision, MoveExplorer, MoveExplorerConfigError};
use crate::TooLarge;

/// Parameters of [`Rollouts`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct RolloutConfig {
    /// Maximum number of mazes drawn for a decision. ≥ 1.
    pub completions: u16,
    /// Number of mazes after which a stop is given up that is on average no better than the
    /// explorer's own. ≥ 1.
    pub trial: u16,
    /// Number of standard errors by which a stop must save steps to be preferred to the explorer's
    /// own, at least 0.
    pub confidence: f32,
    /// Seed of all random numbers: the same seed gives the same decisions.
    pub seed: u64,
}

impl RolloutConfig {
    /// Returns the configuration with which all figures of the project are made. It draws as many
    /// mazes as there is time for (`docs/notebook/micromouse.md`).
    #[must_use]
    pub const fn tuned() -> Self {
        Self {
            completions: 32,
            trial: 3,
            confidence: 1.0,
            seed: 1,
        }
    }

    fn check(&self) -> Result<(), MoveExplorerConfigError> {
        let Self {
            completions,
            trial,
            confidence,
            ..
        } = *self;
        MoveExplorerConfigError::check([
            positive("completions", f32::from(completions)),
            positive("trial", f32::from(trial)),
            at_least_0("confidence", confidence),
        ])
    }
}

/// A [`MoveExplorer`] that plays the rest of the proof before it decides.
///
/// This is the rollout algorithm of Bertsekas and Tsitsiklis (Neuro-Dynamic Programming, 1996,
/// section 6.1.3; Tesauro and Galperin, On-line Policy Improvement Using Monte-Carlo Search, 1996).
/// The explorer is the *base policy*. Where it has to choose what to look at for the proof, mazes
/// are drawn at random that agree with all that is known. In each of them each of the explorer's
/// five best stops is tried, and after it the explorer plays on until the proof is found. The stop
/// that saves steps against the explorer's own, by more than chance would, is taken; otherwise the
/// explorer's own. All stops are tried in the same mazes, so that it is their difference that is
/// measured.
///
/// None of this touches the proof, nor the search for a way to the goal.
///
/// It keeps to a stop until the number of unknown walls changes, or until the stop tells nothing
/// any more. So walls may be forgotten again at any time.
///
/// `N` is at most 32. A decision takes some 10 kB of the stack for 16² cells, 35 kB for 32²; a
/// [`MoveExplorer`]'s, 3 and 9 kB.
#[derive(Clone, Debug)]
pub struct Rollouts<const N: usize> {
    pub(super) base: MoveExplorer<N>,
    pub(super) config: RolloutConfig,
    worth: Option<WorthConfig>,
    aim: Option<Aim>,
}

/// A stop that was chosen.
#[derive(Clone, Copy, Debug)]
struct Aim {
    stop: Cell,
    /// Number of unknown walls when the stop was chosen.
    unknown: u32,
}

/// Number of stops that are tried for the proof, the explorer's own among them.
const STOPS: usize = 5;

impl<const N: usize> Rollouts<N> {
    /// Returns `base`, improved by rollouts.
    ///
    /// # Errors
    /// If a value is out of its range.
    pub fn new(
        base: MoveExplorer<N>,
        config: RolloutConfig,
    ) -> Result<Self, MoveExplorerConfigError> {
        config.check()?;
        Ok(Self {
            base,
            config,
            worth: None,
            aim: None,
        })
    }

    /// Returns the same rollouts, which stop as soon as the rest of the proof is expected to cost
    /// more than it gains: see [`WorthConfig`].
    ///
    /// # Errors
    /// If a value is out of its range.
    pub fn until_worth(self, worth: WorthConfig) -> Result<Self, MoveExplorerConfigError> {
        worth.check()?;
        Ok(Self {
            worth: Some(worth),
            ..self
        })
    }

    /// Returns the decision in the cell `at`: see [`MoveExplorer::decide`]. O(completions × stops
    /// of the rest of the proof × N²).
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub fn decide(
        &mut self,
        walls: &impl Walls,
        goals: &[Cell],
        at: Cell,
    ) -> Result<MoveDecision, TooLarge> {
        let chart = self.base.chart(walls, goals, at)?;
        let task = self.base.task(&chart, at);
        if let Task::Prove { closed } = task {
            self.aim = self.next_aim(&chart, at, closed);
            if self.aim.is_none() && self.worth.is_some() {
                return Ok(MoveDecision::Enough { moves: closed });
            }
        }
        Ok(task.decide(&chart, at, |_| self.aim.map(|aim| aim.stop)))
    }

    /// Returns the stop to drive to: the one chosen before, or a new one.
    fn next_aim(&self, chart: &Chart<N>, at: Cell, closed: u16) -> Option<Aim> {
        let kept = self.kept_aim(chart, at, closed);
        kept.or_else(|| {
            let stop = match &self.worth {
                None => self.choose(chart, at, closed),
                Some(worth) => self.choose_worthwhile(worth, chart, at, closed),
            };
            let unknown = chart.unknown().len();
            stop.map(|stop| Aim { stop, unknown })
        })
    }

    /// Returns the stop chosen before, if nothing new was seen since and it can still tell
    /// something.
    fn kept_aim(&self, chart: &Chart<N>, at: Cell, closed: u16) -> Option<Aim> {
        self.aim.filter(|aim| {
            aim.unknown == chart.unknown().len()
                && self.base.tells(chart, aim.stop, closed)
                && chart.course(aim.stop, at).is_some()
        })
    }

    /// Returns the best stop for the proof, among those that the base policy rates highest.
    fn choose(&self, chart: &Chart<N>, at: Cell, closed: u16) -> Option<Cell> {
        let mut rivals = Rivals::of(&self.base.proofs::<STOPS>(chart, at, closed))?;
        let mut completions = self.completions(chart);
        for drawn in 1..=self.config.completions {
            if rivals.is_empty() {
                break;
            }
            let tried = self.hold_proofs(chart, &completions.draw(), at, &mut rivals);
            // A play without an end reveals nothing about this maze.
            if tried.is_some() && drawn >= self.config.trial {
                rivals.give_up_worse();
            }
        }
        let best = rivals.best(self.config.confidence);
        Some(best.map_or(rivals.own, |rival| rival.stop))
    }

    /// Returns mazes that agree with all known walls. They stay the same as long as the number of
    /// unknown walls does.
    pub(super) fn completions<'a>(&self, chart: &'a Chart<N>) -> Completions<'a, N> {
        let seed = self.config.seed ^ u64::from(chart.unknown().len()) << 32;
        Completions::new(chart, SplitMix::new(seed))
    }

    /// Compares the rivals with the explorer's own stop by the steps of the proof in one maze.
    fn hold_proofs(
        &self,
        chart: &Chart<N>,
        maze: &Sides<N>,
        at: Cell,
        rivals: &mut Rivals<STOPS>,
    ) -> Option<()> {
        let mut play = Play::new();
        let steps = self.play(chart, maze, rivals.own, at, |stage, steps| {
            play.record(stage, steps);
            None
        })?;
        for rival in rivals.iter_mut() {
            let met = |stage, so_far| play.steps_at(stage).map(|at| steps - at + so_far);
            if let Some(its) = self.play(chart, maze, rival.stop, at, met) {
                rival.add(its - steps);
            }
        }
        Some(())
    }

    /// Returns the number of steps from `at` over `stop` to the end of the proof, in a maze with
    /// the open sides `maze`. Calls `met` after each drive with the stage of the play and its steps
    /// so far; it may return the total.
    fn play(
        &self,
        chart: &Chart<N>,
        maze: &Sides<N>,
        stop: Cell,
        at: Cell,
        mut met: impl FnMut(Stage, f32) -> Option<f32>,
    ) -> Option<f32> {
        let mut chart = chart.clone();
        let (mut at, mut stop, mut steps) = (at, stop, 0.0);
        loop {
            let driven = chart.drive(maze, stop, at)?;
            at = driven.at;
            steps += f32::from(driven.steps);
            let (open, closed) = (chart.open()?, chart.closed?);
            if open == closed {
                return Some(steps);
            }
            let learned = chart.learned;
            if let Some(all) = met(Stage { at, learned }, steps) {
                return Some(all);
            }
            stop = self.base.proofs::<1>(&chart, at, closed).best()?;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_out_of_range_are_refused() {
        let check = |change: fn(&mut RolloutConfig)| {
            let mut config = RolloutConfig::tuned();
            change(&mut config);
            config.check().map_err(|error| error.field)
        };
        assert_eq!(check(|_| ()), Ok(()));
        assert_eq!(check(|config| config.completions = 0), Err("completions"));
        assert_eq!(check(|config| config.trial = 0), Err("trial"));
        assert_eq!(check(|config| config.confidence = -1.0), Err("confidence"));
        assert_eq!(
            check(|config| config.confidence = f32::NAN),
            Err("confidence")
        );
    }
}
