//! Maps for judging a system's own verdicts: enough right ones and enough wrong ones.

use tolman_arena::contest::{Claim, Condition, ContestRecord};
use tolman_arena::family::FamilySize;
use tolman_experiment::{BoxError, run_seed};

use super::worlds::{ArenaWorld, DrawnWorld};

/// Difficulties of the worlds in which maps are learned, the easiest first.
const RUNGS: [Rung; 7] = [
    Rung::new("small", FamilySize::Small, Condition::AsMade),
    Rung::new("middle", FamilySize::Middle, Condition::AsMade),
    Rung::new("large", FamilySize::Large, Condition::AsMade),
    Rung::new("middle, wheels 5", FamilySize::Middle, Condition::Wheels(5)),
    Rung::new(
        "middle, kidnapping",
        FamilySize::Middle,
        Condition::Kidnapping,
    ),
    Rung::new(
        "large, kidnapping",
        FamilySize::Large,
        Condition::Kidnapping,
    ),
    Rung::new(
        "large, constant odometry",
        FamilySize::Large,
        Condition::ConstantOdometry,
    ),
];

struct Rung {
    name: &'static str,
    size: FamilySize,
    condition: Condition,
}

impl Rung {
    const fn new(name: &'static str, size: FamilySize, condition: Condition) -> Self {
        Self {
            name,
            size,
            condition,
        }
    }
}

/// Maps of one system, collected until there are enough right and enough wrong ones.
///
/// Each [round](Self::round) is a fresh world of every family. While there are more right maps than
/// wrong ones, the next round is harder; otherwise it is easier. So both kinds grow alike. The
/// worlds depend only on the seed and on the results of earlier rounds.
#[derive(Clone, Debug)]
pub struct VerdictPool {
    seed: u64,
    worlds: Vec<ArenaWorld>,
    enough: u32,
    most_rounds: u32,
    rounds: u32,
    /// Index of the present difficulty.
    rung: usize,
    /// Results so far by difficulty.
    rungs: [RungJudgement; RUNGS.len()],
    abstained: u32,
    undecided: usize,
    /// Sum of the squared errors of the system's probabilities that its maps are right.
    squared_error: f64,
}

/// A round of a [`VerdictPool`]: worlds in which a map is to be learned, and their condition.
#[derive(Clone, Debug)]
pub struct PoolRound {
    /// One world of each family. No robot is put down in them.
    pub worlds: Vec<DrawnWorld>,
    /// Change of robot and worlds.
    pub condition: Condition,
}

/// Summary of a [`VerdictPool`]. Shares are in percent; `None` without a map of the kind.
#[derive(Clone, Debug, PartialEq)]
pub struct PoolJudgement {
    /// Number of right maps.
    pub right: usize,
    /// Number of wrong maps.
    pub wrong: usize,
    /// Number of worlds in which the system abstained.
    pub abstained: u32,
    /// Share of the wrong maps that the system called right.
    pub false_right_percent: Option<f64>,
    /// Share of the right maps that the system called wrong.
    pub false_alarm_percent: Option<f64>,
    /// Share of all maps on which the system gave no verdict.
    pub undecided_percent: Option<f64>,
    /// Brier skill of the system's verdicts over the share of right maps: 1 for perfect verdicts.
    /// `None` if all maps are right, or all wrong.
    pub brier_skill: Option<f64>,
    /// Results by difficulty, the easiest first.
    pub drawn: Vec<RungJudgement>,
}

/// Results in the worlds of one difficulty of a [`VerdictPool`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RungJudgement {
    /// Name of the difficulty.
    pub name: &'static str,
    /// Number of worlds.
    pub worlds: u32,
    /// Number of right maps.
    pub right: usize,
    /// Number of right maps that the system called wrong.
    pub false_alarms: usize,
    /// Number of wrong maps.
    pub wrong: usize,
    /// Number of wrong maps that the system called right.
    pub false_right: usize,
}

impl VerdictPool {
    /// Returns an empty pool. It is full when it has `enough` right and `enough` wrong maps, or
    /// after `most_rounds` rounds.
    #[must_use]
    pub fn new(worlds: Vec<ArenaWorld>, seed: u64, enough: u32, most_rounds: u32) -> Self {
        Self {
            seed,
            worlds,
            enough,
            most_rounds,
            rounds: 0,
            rung: 0,
            rungs: RUNGS.map(|Rung { name, .. }| RungJudgement {
                name,
                ..RungJudgement::default()
            }),
            abstained: 0,
            undecided: 0,
            squared_error: 0.0,
        }
    }

    /// Returns the next round; `None` if the pool is full.
    ///
    /// # Errors
    /// If a family cannot draw a world.
    pub fn round(&self) -> Result<Option<PoolRound>, BoxError> {
        if self.is_enough() || self.rounds >= self.most_rounds {
            return Ok(None);
        }
        let Rung {
            size, condition, ..
        } = RUNGS[self.rung];
        let worlds = self.worlds.iter().map(|world| {
            let name = format!("{}, own verdict", world.name());
            let seed = run_seed(self.seed, &name, self.rounds);
            let drawn = world.draw_sized(seed, self.rounds, size)?;
            Ok(DrawnWorld { starts: 0, ..drawn })
        });
        let worlds: Result<Vec<DrawnWorld>, BoxError> = worlds.collect();
        Ok(Some(PoolRound {
            worlds: worlds?,
            condition,
        }))
    }

    /// Adds the results of a round.
    pub fn take(&mut self, held: &[ContestRecord]) {
        self.rounds += 1;
        let rung = &mut self.rungs[self.rung];
        rung.worlds += held.len() as u32;
        for record in held {
            self.abstained += u32::from(record.abstained.is_some());
            let Some(learned) = &record.learned else {
                continue;
            };
            let is_right = learned.judgement.is_right;
            let (maps, mistakes, mistake) = match is_right {
                true => (&mut rung.right, &mut rung.false_alarms, Claim::Wrong),
                false => (&mut rung.wrong, &mut rung.false_right, Claim::Right),
            };
            *maps += 1;
            *mistakes += usize::from(learned.claim == mistake);
            self.undecided += usize::from(learned.claim == Claim::Undecided);
            let error = learned.likelihood() - f64::from(u8::from(is_right));
            self.squared_error += error * error;
        }
        let (right, wrong) = self.counts();
        self.rung = match right > wrong {
            true => (self.rung + 1).min(RUNGS.len() - 1),
            false => self.rung.saturating_sub(1),
        };
    }

    /// Returns whether there are enough right and enough wrong maps.
    #[must_use]
    pub fn is_enough(&self) -> bool {
        let (right, wrong) = self.counts();
        right.min(wrong) >= self.enough as usize
    }

    /// Returns the numbers of right and of wrong maps.
    fn counts(&self) -> (usize, usize) {
        (self.sum(|rung| rung.right), self.sum(|rung| rung.wrong))
    }

    /// Returns the summary of all maps so far.
    #[must_use]
    pub fn judgement(&self) -> PoolJudgement {
        let (right, wrong) = self.counts();
        let drawn = self.rungs.iter().filter(|rung| rung.worlds > 0);
        PoolJudgement {
            right,
            wrong,
            abstained: self.abstained,
            false_right_percent: percent(self.sum(|rung| rung.false_right), wrong),
            false_alarm_percent: percent(self.sum(|rung| rung.false_alarms), right),
            undecided_percent: percent(self.undecided, right + wrong),
            brier_skill: self.brier_skill(),
            drawn: drawn.cloned().collect(),
        }
    }

    fn sum(&self, of: impl Fn(&RungJudgement) -> usize) -> usize {
        self.rungs.iter().map(of).sum()
    }

    fn brier_skill(&self) -> Option<f64> {
        let (right, wrong) = self.counts();
        let variance = right as f64 * wrong as f64 / (right + wrong) as f64;
        (right > 0 && wrong > 0).then(|| 1.0 - self.squared_error / variance)
    }
}

fn percent(part: usize, whole: usize) -> Option<f64> {
    (whole > 0).then(|| 100.0 * part as f64 / whole as f64)
}

#[cfg(test)]
mod tests {
    use alloc::collections::BTreeSet;

    use tolman_arena::contest::{Evidence, LearnRecord, MapJudgement};
    use tolman_arena::run::TaskEnd;

    use super::*;

    fn learned(is_right: bool, claim: Claim, certainty: f64) -> ContestRecord {
        let judgement = MapJudgement {
            is_right,
            is_right_of_visited: is_right,
            purity: None,
            places: 1.0,
            link_precision: None,
            link_recall: 1.0,
        };
        ContestRecord {
            learned: Some(LearnRecord {
                end: TaskEnd::Done,
                claim,
                certainty: Some(certainty),
                judgement,
                evidence: Evidence::default(),
                driven: 1.0,
                steps: 1,
                bumps: 0,
                places: 1,
                map_bytes: None,
                thinking: None,
            }),
            ..ContestRecord::default()
        }
    }

    fn pool() -> VerdictPool {
        let worlds = ArenaWorld::families().into_iter().take(2).collect();
        VerdictPool::new(worlds, 1, 6, 20)
    }

    #[test]
    fn worlds_are_harder_while_most_maps_are_right_and_easier_while_most_are_wrong() {
        let mut pool = pool();
        let mut sizes = Vec::new();
        for is_right in [true, true, false, false, false, true] {
            let round = pool.round().unwrap().unwrap();
            sizes.push(round.worlds[0].maze.grid().width());
            let record = learned(is_right, Claim::Right, 1.0);
            pool.take(&[record.clone(), record]);
        }
        assert_eq!(sizes, [5, 8, 16, 8, 16, 8], "{sizes:?}");
        assert!(pool.round().unwrap().is_none() && pool.is_enough());
        let drawn = pool.judgement().drawn;
        let told: Vec<_> = (drawn.iter())
            .map(|rung| (rung.name, rung.worlds, rung.right, rung.wrong))
            .collect();
        assert_eq!(
            told,
            [
                ("small", 2, 2, 0),
                ("middle", 4, 4, 0),
                ("large", 4, 0, 4),
                ("middle, wheels 5", 2, 0, 2)
            ]
        );
        assert!(drawn.iter().all(|rung| rung.false_right == rung.wrong));
    }

    #[test]
    fn no_world_is_drawn_twice_and_the_same_pool_draws_the_same() {
        let mut pool = pool();
        let mut seen = BTreeSet::new();
        for _ in 0..4 {
            let round = pool.round().unwrap().unwrap();
            let again = pool.clone().round().unwrap().unwrap();
            for (one, other) in round.worlds.iter().zip(&again.worlds) {
                assert_eq!((one.seed, &one.maze), (other.seed, &other.maze));
                assert!(seen.insert(one.seed));
            }
            pool.take(&[learned(true, Claim::Right, 1.0)]);
        }
    }

    #[test]
    fn a_pool_of_one_kind_ends_and_says_that_it_is_short() {
        let mut pool = pool();
        let mut rounds = 0;
        while pool.round().unwrap().is_some() {
            pool.take(&[learned(false, Claim::Undecided, 0.0)]);
            rounds += 1;
        }
        assert!(rounds == 20 && !pool.is_enough());
        let judged = pool.judgement();
        assert_eq!((judged.right, judged.wrong), (0, 20));
        assert_eq!(judged.brier_skill, None);
        assert_eq!(judged.false_alarm_percent, None);
        assert_eq!(judged.undecided_percent, Some(100.0));
    }

    #[test]
    fn who_always_knows_has_the_skill_1_and_who_calls_all_right_none() {
        let (mut knows, mut boasts) = (pool(), pool());
        for is_right in [true, false] {
            let claim = if is_right { Claim::Right } else { Claim::Wrong };
            knows.take(&[learned(is_right, claim, 1.0)]);
            boasts.take(&[learned(is_right, Claim::Right, 1.0)]);
        }
        assert_eq!(knows.judgement().brier_skill, Some(1.0));
        let boasts = boasts.judgement();
        assert_eq!(boasts.brier_skill, Some(-1.0));
        assert_eq!(boasts.false_right_percent, Some(100.0));
    }
}
