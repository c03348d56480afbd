//! `tolman arena --task errands`: systems deliver from landmark to landmark from the first minute.

use alloc::collections::BTreeMap;
use std::io::{self, Write};

use anyhow::anyhow;
use rayon::prelude::*;
use serde::Serialize;
use tolman_arena::contest::{Condition, Contest, ContestError, Errands, ErrandsRecord};
use tolman_arena::registry::{RobotEntry, Schooling};
use tolman_papers::arena::DrawnWorld;

use super::{Arguments, Contestant, Failure, Made, Result, carrier, or_dash};

/// Result of a run, for `--json`.
#[derive(Serialize)]
struct Line<'a> {
    system: &'a str,
    robot: &'a str,
    world: &'a str,
    seed: u64,
    learns_first: bool,
    abstained: Option<&'a str>,
    metres: f64,
    oracle_rate: f64,
    oracle_rate_last_third: f64,
    /// Number of errands given up, by the reason.
    given_up: &'a BTreeMap<String, u32>,
    wrong_arrivals: u32,
    /// Metres until each delivery.
    deliveries: &'a [f64],
    /// The same of the oracle.
    oracle: &'a [f64],
    #[serde(flatten)]
    made: &'a Made,
}

/// A contestant, whether it learns the world first, and its record in each world.
struct Sent<'a> {
    contestant: Contestant,
    learns_first: bool,
    records: &'a [ErrandsRecord],
}

pub(super) fn run(
    arguments: &Arguments,
    contestants: &[Contestant],
    robot: Option<RobotEntry>,
    (condition, made): (Condition, &Made),
    worlds: &[DrawnWorld],
    out: &mut dyn Write,
) -> Result {
    check(arguments, contestants, worlds)?;
    let delivers = |one: &&Contestant| one.facts().delivers;
    let entrants: Vec<(Contestant, bool)> = contestants
        .iter()
        .filter(delivers)
        .flat_map(|one| {
            let both = [false, true].into_iter();
            both.filter(|first| !first || one.learns())
                .map(|first| (*one, first))
        })
        .collect();
    let jobs: Vec<((Contestant, bool), &DrawnWorld)> = entrants
        .iter()
        .flat_map(|entrant| worlds.iter().map(|world| (*entrant, world)))
        .collect();
    let schooling = Schooling::default();
    let play = |((contestant, learns_first), world): &((Contestant, bool), &DrawnWorld)| {
        let contest = Contest {
            condition,
            ..world.contest(*contestant, robot)
        };
        let errands = Errands {
            contest,
            learns_first: *learns_first,
        };
        errands.play(&schooling, |_, _| {})
    };
    let held: Result<Vec<ErrandsRecord>, ContestError> = jobs.par_iter().map(play).collect();
    let held = held?;
    let of_each = held.chunks(worlds.len().max(1));
    let rows = entrants.iter().zip(of_each);
    let rows: Vec<Sent<'_>> = rows
        .map(|((contestant, learns_first), records)| Sent {
            contestant: *contestant,
            learns_first: *learns_first,
            records,
        })
        .collect();
    match arguments.json {
        true => lines(&rows, robot, worlds, made, out),
        false => Ok(table(&rows, robot, out)?),
    }
}

/// Refuses what errands do not have.
fn check(arguments: &Arguments, contestants: &[Contestant], worlds: &[DrawnWorld]) -> Result {
    let refused = |why: String| Err(Failure::BadInput(anyhow!(why)));
    if let [only] = contestants
        && !only.facts().delivers
    {
        return refused(format!(
            "{} runs no errands: it does not look for landmarks; leave --task errands out",
            only.name()
        ));
    }
    if let Some(world) = worlds.iter().find(|world| world.floor.is_some()) {
        let name = &world.name;
        return refused(format!(
            "errands need mazes of cells, and walls of {name} stand anywhere: give mazes"
        ));
    }
    match (arguments.cost, &arguments.replay) {
        (true, _) => refused("--cost measures learning: leave it or --task errands out".to_owned()),
        (_, Some(_)) => {
            refused("--replay shows learning: leave it or --task errands out".to_owned())
        }
        _ => Ok(()),
    }
}

fn lines(
    rows: &[Sent<'_>],
    robot: Option<RobotEntry>,
    worlds: &[DrawnWorld],
    made: &Made,
    out: &mut dyn Write,
) -> Result {
    for row in rows {
        for (world, record) in worlds.iter().zip(row.records) {
            let line = Line {
                system: row.contestant.name(),
                robot: carrier(row.contestant, robot).name,
                world: &world.name,
                seed: world.seed,
                learns_first: row.learns_first,
                abstained: record.abstained.as_deref(),
                metres: record.metres,
                oracle_rate: record.oracle_rate(),
                oracle_rate_last_third: record.oracle_rate_last_third(),
                given_up: &record.given_up,
                wrong_arrivals: record.wrong_arrivals,
                deliveries: &record.deliveries,
                oracle: &record.oracle,
                made,
            };
            writeln!(out, "{}", serde_json::to_string(&line)?)?;
        }
    }
    Ok(())
}

/// Writes the table with one row for each entrant: means over the worlds in which it drove.
fn table(rows: &[Sent<'_>], robot: Option<RobotEntry>, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "{:40} {:13} {:>6} {:>9} {:>9} {:>10} {:>9} {:>8} {:>5}",
        "system",
        "robot",
        "worlds",
        "abstained",
        "oracle, %",
        "at last, %",
        "third, m",
        "given up",
        "wrong"
    )?;
    for row in rows {
        let drove: Vec<&ErrandsRecord> = row
            .records
            .iter()
            .filter(|record| record.abstained.is_none())
            .collect();
        let mean = |of: &dyn Fn(&ErrandsRecord) -> Option<f64>| {
            let values: Vec<f64> = drove.iter().filter_map(|record| of(record)).collect();
            let sum: f64 = values.iter().sum();
            (!values.is_empty()).then(|| format!("{:.1}", sum / values.len() as f64))
        };
        let total =
            |of: fn(&ErrandsRecord) -> u32| drove.iter().map(|record| of(record)).sum::<u32>();
        let learns_first = match row.learns_first {
            true => ", learns first",
            false => "",
        };
        writeln!(
            out,
            "{:40} {:13} {:>6} {:>9} {:>9} {:>10} {:>9} {:>8} {:>5}",
            format!("{}{learns_first}", row.contestant.title()),
            carrier(row.contestant, robot).title,
            row.records.len(),
            row.records.len() - drove.len(),
            or_dash(mean(&|record| Some(100.0 * record.oracle_rate()))),
            or_dash(mean(&|record| Some(
                100.0 * record.oracle_rate_last_third()
            ))),
            or_dash(mean(&|record| record.metres_until(3))),
            total(|record| record.given_up.values().sum()),
            total(|record| record.wrong_arrivals),
        )?;
    }
    Ok(())
}
