use tolman_maze::{Cell, Walls};

use super::chart::Chart;
use super::completion::Completions;
use super::sides::Sides;
use super::split_mix::SplitMix;
use super::{MoveDecision, MoveExplorer, MoveExplorerConfigError};
use crate::TooLarge;

/// How [`Rollouts`] choose.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct RolloutConfig {
    /// At most so many mazes are drawn for a decision. ≥ 1.
    pub completions: u16,
    /// A stop that does no better than the explorer's own in so many mazes, on average, is given up. ≥ 1.
    pub trial: u16,
    /// By how many standard errors a stop must save steps to be preferred to the explorer's own. ≥ 0.
    pub confidence: f32,
    /// What chance follows from: the same seed, the same decisions.
    pub seed: u64,
}

impl RolloutConfig {
    /// The one configuration that all our figures are made with: as many mazes as there is time for (`docs/micromouse.md`).
    #[must_use]
    pub const fn tuned() -> Self {
        Self {
            completions: 12,
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
            ("completions", f32::from(completions), completions > 0),
            ("trial", f32::from(trial), trial > 0),
            ("confidence", confidence, confidence >= 0.0),
        ])
    }
}

/// A [`MoveExplorer`] that plays the rest of the proof before it decides.
///
/// This is the rollout algorithm of Bertsekas and Tsitsiklis (Neuro-Dynamic Programming, 1996, section 6.1.3; Tesauro and Galperin,
/// On-line Policy Improvement Using Monte-Carlo Search, 1996). The explorer is the *base policy*. Where it has to choose
/// what to look at for the proof, mazes are drawn at random that agree with all that is known. In each of them each of the explorer's
/// five best stops is tried, and after it the explorer plays on until the proof is found. The stop
/// that saves steps against the explorer's own, by more than chance would, is taken; otherwise the explorer's own. All stops are tried in the
/// same mazes, so that it is their difference that is measured.
///
/// None of this touches the proof, nor the search for a way to the goal.
///
/// It keeps to a stop until there is something new to see, which it tells by the number of unknown walls, or until the stop tells
/// nothing any more; so walls may be forgotten again at any time.
///
/// `N` is at most 32. A decision takes some 10 kB of the stack for 16² cells, 35 kB for 32²; a [`MoveExplorer`]'s, 3 and 9 kB.
#[derive(Clone, Debug)]
pub struct Rollouts<const N: usize> {
    base: MoveExplorer<N>,
    config: RolloutConfig,
    aim: Option<Aim>,
}

/// A stop that was chosen.
#[derive(Clone, Copy, Debug)]
struct Aim {
    stop: Cell,
    /// How many walls were unknown then.
    unknown: u32,
}

/// A stop that is held against the explorer's own.
#[derive(Clone, Copy, Debug)]
struct Rival {
    stop: Cell,
    /// Steps that it costs more than the explorer's own, summed over the mazes, and their squares.
    sum: f32,
    squares: f32,
    mazes: f32,
}

impl Rival {
    const fn new(stop: Cell) -> Self {
        Self {
            stop,
            sum: 0.0,
            squares: 0.0,
            mazes: 0.0,
        }
    }

    fn add(&mut self, more: f32) {
        self.sum += more;
        self.squares += more * more;
        self.mazes += 1.0;
    }

    /// The steps it costs more, and `confidence` standard errors on top.
    fn at_worst(&self, confidence: f32) -> f32 {
        let mean = self.sum / self.mazes;
        let variance = (self.squares / self.mazes - mean * mean).max(LEAST_VARIANCE);
        mean + confidence * libm::sqrtf(variance / self.mazes)
    }
}

/// So many stops are tried, the explorer's own among them.
const STOPS: usize = 5;

/// Of steps in few mazes that happen to be equal.
const LEAST_VARIANCE: f32 = 0.25;

impl<const N: usize> Rollouts<N> {
    /// `base`, improved.
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
            aim: None,
        })
    }

    /// Returns what to do in the cell `at`: see [`MoveExplorer::decide`]. O(completions × stops of the rest of the proof × N²).
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
        Ok(task.decide(&chart, at, |closed| self.aim(&chart, at, closed)))
    }

    fn aim(&mut self, chart: &Chart<N>, at: Cell, closed: u16) -> Option<Cell> {
        let unknown = chart.unknown().len();
        let kept = self.aim.filter(|aim| {
            aim.unknown == unknown
                && self.base.tells(chart, aim.stop, closed)
                && chart.course(aim.stop, at).is_some()
        });
        self.aim = match kept {
            Some(aim) => Some(aim),
            None => {
                let stop = self.choose(chart, at, closed)?;
                Some(Aim { stop, unknown })
            }
        };
        self.aim.map(|aim| aim.stop)
    }

    /// The stop to drive to, of those that the base policy thinks best.
    fn choose(&self, chart: &Chart<N>, at: Cell, closed: u16) -> Option<Cell> {
        let stops = self.base.proofs::<{ STOPS }>(chart, at, closed);
        let own = stops.best()?;
        let mut rivals = [None; STOPS];
        for (slot, stop) in rivals.iter_mut().zip(stops.iter().skip(1)) {
            *slot = Some(Rival::new(stop));
        }
        // Where as much is unknown as before, the same mazes are drawn.
        let seed = self.config.seed ^ u64::from(chart.unknown().len()) << 32;
        let mut completions = Completions::new(chart, SplitMix::new(seed));
        for drawn in 1..=self.config.completions {
            if rivals.iter().flatten().next().is_none() {
                break;
            }
            let maze = completions.draw();
            let mut play = Play::new();
            // A play that comes to no end tells nothing of this maze.
            let Some(steps) = self.play(chart, &maze, own, at, |stage, steps| {
                play.record(stage, steps);
                None
            }) else {
                continue;
            };
            for slot in &mut rivals {
                let Some(rival) = slot else {
                    continue;
                };
                let met = |stage, so_far| play.steps_at(stage).map(|at| steps - at + so_far);
                if let Some(its) = self.play(chart, &maze, rival.stop, at, met) {
                    rival.add(its - steps);
                }
                if drawn >= self.config.trial && rival.sum >= 0.0 {
                    *slot = None;
                }
            }
        }
        let better = rivals
            .iter()
            .flatten()
            .map(|rival| (rival.at_worst(self.config.confidence), rival.stop));
        let best = better.fold(
            (0.0, own),
            |best, rival| if rival.0 < best.0 { rival } else { best },
        );
        Some(best.1)
    }

    /// Steps from `at` over `stop` to the end of the proof, in a maze with the open sides `maze`. After each drive `met` is told where the
    /// play is and after how many steps, and may know how many there are in all.
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

/// How far a play has come: plays of one maze that are at the same stage go on alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stage {
    at: Cell,
    /// [`Chart::learned`].
    learned: u64,
}

/// The stages of the explorer's own play, and after how many steps it came to each; the first of them.
#[derive(Clone, Copy, Debug)]
struct Play {
    stages: [Option<(Stage, f32)>; Self::MOST],
    count: usize,
}

impl Play {
    /// So many stages are kept.
    const MOST: usize = 64;

    const fn new() -> Self {
        Self {
            stages: [None; Self::MOST],
            count: 0,
        }
    }

    fn record(&mut self, stage: Stage, steps: f32) {
        if let Some(slot) = self.stages.get_mut(self.count) {
            *slot = Some((stage, steps));
            self.count += 1;
        }
    }

    /// After how many steps it came to a stage, if it did.
    fn steps_at(&self, stage: Stage) -> Option<f32> {
        let mut stages = self.stages.iter().map_while(|stage| *stage);
        stages
            .find(|(known, _)| *known == stage)
            .map(|(_, steps)| steps)
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

    #[test]
    fn a_rival_is_better_only_by_more_than_its_standard_error() {
        let mut rival = Rival::new(Cell::new(0, 0));
        for more in [-3.0, 1.0, -3.0, 1.0] {
            rival.add(more);
        }
        // Mean −1, variance 4, of four mazes: the standard error is 1.
        assert!(rival.at_worst(0.9) < 0.0);
        assert!(rival.at_worst(1.1) > 0.0);
    }
}
