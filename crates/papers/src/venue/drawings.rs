//! The rule by which the paper's two mazes are drawn. From a sequence of random drawings with the
//! features that the paper names, it keeps those that agree with the paper's own figures.
//!
//! MSLST plays no part in the rule. The paper's drawings are lost. Two facts about them are known.
//! One is the results of the two baselines. The other is that a robot with a map of the maze is
//! faster than the paper's MSLST.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::{GenerateError, Hook, Maze, MazeFile, OneLoop};

use super::paper::{PAPER_RUNS, PaperRow};
use super::{Played, Venue, right_hand};
use tolman_arena::cast::Agent;
use tolman_arena::course::Course;
use tolman_arena::episode::{self, EpisodeError};
use tolman_arena::pioneer;
use tolman_experiment::{BoxError, run_seed};
use tolman_stats::wilson_interval;

/// Seed of both sequences, and of the runs that judge them.
const SEED: u64 = 1;

/// Number of runs of each agent that judge a drawing.
const RUNS: u32 = 1000;

/// The normal quantile of a 95 % interval.
const Z: f64 = 1.96;

/// Share of tours that an exact Wall-follow may lose on the loop, per cent: the 95 % interval of
/// the paper's 28 % of 25.
const TRAPPED: (f64, f64) = (12.0, 49.0);

/// A maze of the paper, which drawings stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Drawing {
    /// "A simple J shape."
    J,
    /// "Several dead ends, a four-way intersection, and a loop."
    Large,
}

/// Number of the first kept J drawing: `mazes/j.maze`.
const J_DRAWING: u32 = 4;

/// Numbers of the first kept Large drawings, as `tolman experiment mslst-drawings` finds them.
/// The first is `mazes/large.maze`.
pub(crate) const LARGE_DRAWINGS: [u32; 150] = [
    0, 17, 21, 31, 37, 43, 49, 52, 63, 69, 76, 93, 109, 110, 114, 130, 143, 156, 163, 170, 175,
    202, 214, 218, 230, 231, 243, 247, 248, 252, 259, 267, 279, 288, 292, 297, 312, 325, 326, 327,
    341, 346, 347, 352, 367, 370, 372, 374, 376, 377, 379, 398, 403, 407, 423, 428, 432, 433, 438,
    452, 456, 469, 472, 479, 505, 511, 533, 534, 541, 542, 544, 547, 552, 572, 573, 575, 581, 584,
    589, 601, 603, 612, 619, 622, 623, 625, 626, 632, 635, 645, 648, 651, 677, 678, 703, 706, 717,
    738, 742, 754, 758, 761, 779, 783, 788, 792, 796, 798, 810, 820, 822, 831, 839, 842, 844, 858,
    874, 875, 877, 878, 893, 921, 938, 940, 942, 944, 953, 980, 983, 991, 1004, 1009, 1015, 1016,
    1027, 1035, 1044, 1049, 1051, 1060, 1064, 1075, 1080, 1095, 1101, 1102, 1105, 1106, 1113, 1116,
];

/// Measurements of a drawing.
#[derive(Clone, Debug)]
pub(crate) struct Judged {
    /// Share of right-hand tours that never arrive.
    pub(crate) trapped_percent: f64,
    pub(crate) avoid: Played,
    pub(crate) wall_follow: Played,
    pub(crate) oracle: Played,
    /// The conditions, each with the amount by which the drawing misses it: the excess as a share
    /// of the bound; 0 if the condition is met.
    conditions: Vec<(Condition, f64)>,
}

/// A condition that a drawing must meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Condition {
    /// Right-hand tours arrive as often as the paper's Wall-follow may have arrived.
    Traps,
    /// The Oracle is no slower than the paper's MSLST was.
    OracleSteps,
    /// Avoid succeeds as often as in the paper: its rate is within the 95 % interval of the paper's
    /// 25 runs. So are the three numbers of the conditions that follow.
    AvoidSuccess,
    AvoidSteps,
    WallFollowSuccess,
    WallFollowSteps,
}

impl Drawing {
    /// Returns the drawing with this number, by geometry alone.
    pub(crate) fn maze(self, number: u32) -> Result<Maze, GenerateError> {
        let stream = format!("drawings of {}", self.name());
        let rng = &mut ChaCha8Rng::seed_from_u64(run_seed(SEED, &stream, number));
        let mut between = |least: u32, most: u32| rng.random_range(least..=most) as u16;
        match self {
            Self::J => {
                let (width, height) = (between(3, 14), between(5, 18));
                Hook { width, height }.generate(rng)
            }
            Self::Large => {
                let drawing = OneLoop {
                    width: between(9, 13),
                    height: between(5, 8),
                    dead_ends: 4,
                    // That is 7.6 robot units; MSLST remembers eight actions of one unit.
                    short: 4,
                };
                drawing.generate(rng)
            }
        }
    }

    /// Returns the drawing with this number as a world.
    pub(crate) fn venue(self, number: u32) -> Result<Venue, BoxError> {
        let file = MazeFile::from(self.maze(number)?);
        let course = Course::for_body(self.name(), &file, &pioneer::body())?;
        Ok(match self {
            Self::J => super::j_like(course),
            Self::Large => super::large_like(course),
        })
    }

    /// Returns whether the lists keep this drawing; `None` beyond their end.
    pub(crate) fn listed(self, number: u32) -> Option<bool> {
        match self {
            Self::J => (number <= J_DRAWING).then_some(number == J_DRAWING),
            Self::Large => {
                let last = LARGE_DRAWINGS.last().copied().unwrap_or_default();
                (number <= last).then(|| LARGE_DRAWINGS.contains(&number))
            }
        }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::J => "J",
            Self::Large => "Large",
        }
    }

    /// Returns the maximum mean number of steps of the Oracle. In Large it is that of the paper's
    /// MSLST 20, over the runs in which it arrived. In J it is the upper end of what the paper's
    /// MSLST 100 may have needed.
    const fn oracle_steps(self) -> f64 {
        match self {
            Self::J => 47.0,
            Self::Large => 84.0,
        }
    }

    /// Returns the conditions for a drawing. In J success is not a condition: we never saw a J maze
    /// in which our Wall-follow misses the destination as often as the paper's.
    pub(crate) const fn conditions(self) -> &'static [Condition] {
        match self {
            Self::J => &[
                Condition::OracleSteps,
                Condition::AvoidSteps,
                Condition::WallFollowSteps,
            ],
            Self::Large => &[
                Condition::Traps,
                Condition::OracleSteps,
                Condition::AvoidSuccess,
                Condition::AvoidSteps,
                Condition::WallFollowSuccess,
                Condition::WallFollowSteps,
            ],
        }
    }

    /// Judges the drawing with this number by [`RUNS`] runs of each agent; `None` if its loop alone
    /// rules it out.
    pub(crate) fn judged(self, number: u32) -> Result<Option<Judged>, BoxError> {
        let venue = self.venue(number)?;
        let trapped_percent = right_hand::trapped_percent(&venue.course.maze);
        if self.conditions().contains(&Condition::Traps) && beyond(trapped_percent, TRAPPED) > 0.0 {
            return Ok(None);
        }
        let mut judged = Judged {
            trapped_percent,
            avoid: played(&venue, Agent::Avoid)?,
            wall_follow: played(&venue, Agent::WallFollow)?,
            oracle: played(&venue, Agent::Oracle)?,
            conditions: Vec::new(),
        };
        for condition in self.conditions() {
            let excess = self.excess(*condition, &venue, &judged)?;
            judged.conditions.push((*condition, excess));
        }
        Ok(Some(judged))
    }

    fn excess(self, condition: Condition, venue: &Venue, judged: &Judged) -> Result<f64, BoxError> {
        let paper = |agent: Agent| {
            let row = venue.paper(agent.name());
            row.ok_or_else(|| format!("the paper has no row {:?}", agent.name()))
        };
        let success = |agent, played: &Played| -> Result<_, BoxError> {
            let interval = success_interval(paper(agent)?)?;
            Ok(beyond(played.success_percent(), interval))
        };
        let steps = |agent, played: &Played| -> Result<_, BoxError> {
            Ok(beyond(played.steps(), steps_interval(paper(agent)?)))
        };
        match condition {
            Condition::Traps => Ok(beyond(judged.trapped_percent, TRAPPED)),
            Condition::OracleSteps => Ok(beyond(judged.oracle.steps(), (0.0, self.oracle_steps()))),
            Condition::AvoidSuccess => success(Agent::Avoid, &judged.avoid),
            Condition::AvoidSteps => steps(Agent::Avoid, &judged.avoid),
            Condition::WallFollowSuccess => success(Agent::WallFollow, &judged.wall_follow),
            Condition::WallFollowSteps => steps(Agent::WallFollow, &judged.wall_follow),
        }
    }
}

impl Judged {
    /// Returns whether it misses a condition.
    pub(crate) fn misses(&self, condition: Condition) -> bool {
        let mut conditions = self.conditions.iter();
        conditions.any(|(missed, excess)| *missed == condition && *excess > 0.0)
    }

    /// Returns the sum of the excesses over all conditions, as shares of their bounds; 0 for a
    /// kept drawing.
    pub(crate) fn summed_excess(&self) -> f64 {
        self.conditions.iter().map(|(_, excess)| excess).sum()
    }
}

/// Returns the distance of a value from an interval, as a share of the nearer end.
fn beyond(value: f64, (low, high): (f64, f64)) -> f64 {
    if value < low {
        (low - value) / low
    } else if value > high {
        (value - high) / high
    } else {
        0.0
    }
}

/// Returns Wilson's 95 % interval of the paper's success, per cent.
fn success_interval(paper: &PaperRow) -> Result<(f64, f64), BoxError> {
    let runs = f64::from(PAPER_RUNS);
    let successes = libm::round(paper.success_percent * runs / 100.0) as u64;
    let interval = wilson_interval(successes, PAPER_RUNS.into(), 0.95)?;
    Ok((100.0 * interval.low, 100.0 * interval.high))
}

/// Returns the 95 % interval of the paper's mean steps.
fn steps_interval(paper: &PaperRow) -> (f64, f64) {
    let (mean, sd) = paper.steps;
    let half = Z * sd / f64::from(PAPER_RUNS).sqrt();
    (mean - half, mean + half)
}

/// Returns the runs of an agent, the same as those of its row in the table of that maze with seed
/// 1.
fn played(venue: &Venue, agent: Agent) -> Result<Played, EpisodeError> {
    Played::of(RUNS, |run| {
        let trial = venue.trial(run_seed(SEED, &venue.table, run));
        episode::run(&trial, &mut venue.mind(agent)?, |_| {})
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::venue::paper::{TABLE_2, TABLE_3};

    /// Checks that intervals are those of the paper's 25 runs.
    #[test]
    fn intervals_are_those_of_25_runs() {
        let check = |(low, high): (f64, f64), expect: (f64, f64)| {
            assert!((low - expect.0).abs() < 0.1, "{low}");
            assert!((high - expect.1).abs() < 0.1, "{high}");
        };
        check(success_interval(&TABLE_3[0]).unwrap(), (23.4, 59.3));
        check(success_interval(&TABLE_3[1]).unwrap(), (52.4, 85.7));
        check(steps_interval(&TABLE_3[0]), (315.9, 451.6));
        check(steps_interval(&TABLE_3[1]), (215.0, 342.1));
        check(steps_interval(&TABLE_2[0]), (78.7, 140.3));
        check(steps_interval(&TABLE_2[1]), (69.6, 113.9));
    }

    #[test]
    fn excess_is_a_share_of_the_end_that_is_passed() {
        for (value, expect) in [(5.0, 0.5), (10.0, 0.0), (20.0, 0.0), (25.0, 0.25)] {
            assert!((beyond(value, (10.0, 20.0)) - expect).abs() < 1e-12);
        }
    }

    #[test]
    fn a_drawing_follows_from_its_number() {
        for drawing in [Drawing::J, Drawing::Large] {
            let maze = drawing.maze(3).unwrap();
            assert_eq!(maze, drawing.maze(3).unwrap());
            assert_ne!(maze, drawing.maze(4).unwrap());
        }
    }

    /// Checks that the mazes are the first drawings that are kept, to the cell.
    #[test]
    fn the_papers_mazes_are_the_first_that_are_kept() {
        let mazes = [
            (Drawing::J, J_DRAWING, "j", crate::venue::j_maze().unwrap()),
            (
                Drawing::Large,
                LARGE_DRAWINGS[0],
                "large",
                crate::venue::large_maze().unwrap(),
            ),
        ];
        for (drawing, number, file, course) in mazes {
            let maze = drawing.maze(number).unwrap();
            assert_eq!(course.maze, maze, "mazes/{file}.maze should be\n{maze}");
        }
    }

    /// Judges some of each sequence again; `tolman experiment mslst-drawings` judges all.
    #[test]
    fn the_lists_agree_with_the_rule() {
        for (drawing, numbers) in [(Drawing::J, 4..5), (Drawing::Large, 0..2)] {
            for number in numbers {
                let judged = drawing.judged(number).unwrap();
                let kept = judged.is_some_and(|judged| judged.summed_excess() <= 0.0);
                assert_eq!(drawing.listed(number), Some(kept), "{drawing:?} {number}");
            }
        }
    }
}
