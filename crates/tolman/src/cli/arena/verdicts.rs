//! `tolman arena --own-verdict`: compares the systems' verdicts on their own maps with the truth.

use std::io::Write;

use rayon::prelude::*;
use tolman_arena::contest::{Contest, ContestError, ContestRecord};
use tolman_arena::registry::{RobotEntry, Schooling};
use tolman_papers::arena::{ArenaWorld, DrawnWorld, PoolRound, RungJudgement, VerdictPool};

use super::{Arguments, Contestant, MOST_WORLDS, Result, Unboxed, carrier, or_dash};

/// Number of right maps, and of wrong maps, to collect for each system.
const ENOUGH: u32 = 100;

/// Heading of the table: "wrong maps called right, %" takes two lines.
const HEADING: &str = "\
\x20                                right wrong                wrong maps      right maps               Brier
system             robot          maps  maps abstained called right, % called wrong, % undecided, %  skill";

pub(super) fn judge(
    arguments: &Arguments,
    contestants: &[Contestant],
    robot: Option<RobotEntry>,
    kinds: &[ArenaWorld],
    out: &mut dyn Write,
) -> Result {
    writeln!(out, "{HEADING}")?;
    let most = arguments.worlds.unwrap_or(MOST_WORLDS);
    let schooling = Schooling::default();
    let learning = contestants.iter().filter(|one| one.learns());
    for contestant in learning {
        let mut pool = VerdictPool::new(kinds.to_vec(), arguments.seed, ENOUGH, most);
        while let Some(round) = pool.round().unboxed()? {
            let held = held(*contestant, robot, &round, &schooling)?;
            pool.take(&held);
        }
        row(*contestant, robot, &pool, out)?;
    }
    Ok(())
}

fn held(
    contestant: Contestant,
    robot: Option<RobotEntry>,
    round: &PoolRound,
    schooling: &Schooling,
) -> Result<Vec<ContestRecord>, ContestError> {
    let play = |world: &DrawnWorld| {
        let contest = Contest {
            condition: round.condition,
            ..world.contest(contestant, robot)
        };
        contest.play(schooling, |_, _| {})
    };
    round.worlds.par_iter().map(play).collect()
}

fn row(
    contestant: Contestant,
    robot: Option<RobotEntry>,
    pool: &VerdictPool,
    out: &mut dyn Write,
) -> std::io::Result<()> {
    let judged = pool.judgement();
    let number = |value: Option<f64>, decimals: usize| {
        or_dash(value.map(|value| format!("{value:.decimals$}")))
    };
    writeln!(
        out,
        "{:18} {:13} {:>5} {:>5} {:>9} {:>15} {:>15} {:>12} {:>6}",
        contestant.title(),
        carrier(contestant, robot).title,
        judged.right,
        judged.wrong,
        judged.abstained,
        number(judged.false_right_percent, 1),
        number(judged.false_alarm_percent, 1),
        number(judged.undecided_percent, 1),
        number(judged.brier_skill, 2),
    )?;
    for rung in &judged.drawn {
        writeln!(out, "  {}", of_rung(rung))?;
    }
    match pool.is_enough() {
        true => Ok(()),
        false => writeln!(
            out,
            "  too few: {ENOUGH} right and {ENOUGH} wrong maps were wanted"
        ),
    }
}

/// Returns the line about the worlds of one difficulty.
fn of_rung(rung: &RungJudgement) -> String {
    let RungJudgement {
        name,
        worlds,
        right,
        false_alarms,
        wrong,
        false_right,
    } = rung;
    format!(
        "{name}: worlds {worlds}; right maps {right}, called wrong {false_alarms}; wrong maps {wrong}, called right {false_right}"
    )
}
