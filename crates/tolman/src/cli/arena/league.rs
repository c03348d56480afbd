//! `tolman arena --league`: the rows of many entrants on one page.

use alloc::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Deserialize;
use tolman_arena::registry::Registry;
use tolman_experiment::files::files_in;
use tolman_experiment::{Better, League, LeagueTable, LeagueValue, league_html};
use tolman_stats::{bootstrap_means, percentile_interval, wilson_interval};

use super::super::failure::note;
use super::super::words::counted;
use super::super::{Failure, OrBadInput, Result, file};

/// Name of the page in the folder of the rows, where none is given.
const PAGE: &str = "league.html";

/// Column of all worlds.
const ALL: &str = "all";

/// Column of worlds that no family drew.
const OF_FILES: &str = "files";

/// A line of `tolman arena --json`, of either task.
#[derive(Debug, Deserialize)]
struct Row {
    system: String,
    robot: String,
    world: String,
    seed: u64,
    condition: String,
    version: String,
    command: String,
    abstained: Option<String>,
    right: Option<bool>,
    says: Option<String>,
    #[serde(default)]
    found: Vec<String>,
    #[serde(default)]
    home_over_shortest: Vec<Option<f64>>,
    /// Only lines of errands have this and the next.
    oracle_rate: Option<f64>,
    #[serde(default)]
    learns_first: bool,
}

/// What a row has done of a task, from 0 to 1; `None` if it has nothing of the task.
type Done = fn(&Row) -> Option<f64>;

/// The tasks: what the table is called, which values are good, and what a row has done of it.
const TASKS: [(&str, Better, Done); 5] = [
    ("Learn: right maps, % of worlds", Better::Higher, |row| {
        row.learned(|right| right == Some(true))
    }),
    (
        "Learn: wrong maps called right, % of worlds",
        Better::Lower,
        |row| row.learned(|right| right == Some(false) && row.says.as_deref() == Some("right")),
    ),
    (
        "Locate: told its place rightly, % of times",
        Better::Higher,
        |row| row.each_time(row.found.iter().map(|found| found == "right")),
    ),
    (
        "Home: reached the goal, % of times",
        Better::Higher,
        |row| row.each_time(row.home_over_shortest.iter().map(Option::is_some)),
    ),
    (
        "Errands: deliveries, % of an oracle's",
        Better::Higher,
        |row| row.oracle_rate,
    ),
];

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

fn share(is_done: bool) -> f64 {
    f64::from(u8::from(is_done))
}

impl Row {
    /// Returns whether it learned a map that is as asked; `None` for errands, and for a baseline,
    /// which learns none.
    fn learned(&self, is_as_asked: impl Fn(Option<bool>) -> bool) -> Option<f64> {
        let has_learned = self.right.is_some() || self.abstained.is_some();
        (has_learned && self.oracle_rate.is_none()).then(|| share(is_as_asked(self.right)))
    }

    /// Returns the share of the times that it was put down and did it. One that abstained did not.
    fn each_time(&self, done: impl Iterator<Item = bool>) -> Option<f64> {
        let has_abstained = self.abstained.is_some() && self.oracle_rate.is_none();
        let times: Vec<f64> = done.map(share).collect();
        mean(&times).or_else(|| has_abstained.then_some(0.0))
    }

    /// Returns the entrant: rows of one are one row of the page.
    fn entrant(&self) -> String {
        let first = if self.learns_first {
            ", learns first"
        } else {
            ""
        };
        let condition = match self.condition.as_str() {
            "as-made" => String::new(),
            other => format!(", {other}"),
        };
        let Self {
            system,
            robot,
            version,
            ..
        } = self;
        format!("{system}{first} on {robot}{condition} ({version})")
    }

    /// Returns the family that drew its world.
    fn family(&self) -> &str {
        let drawn = self.world.rsplit_once(' ');
        let is_family = |name: &str| {
            Registry::current()
                .families
                .iter()
                .any(|one| one.name == name)
        };
        match drawn {
            Some((family, _)) if is_family(family) => family,
            _ => OF_FILES,
        }
    }
}

/// Merges the rows of the files `*.jsonl` in `folder` into a page.
pub(super) fn merge(folder: &Path, page: Option<&Path>, out: &mut dyn Write) -> Result {
    let rows = rows(folder)?;
    let page = page.map_or_else(|| folder.join(PAGE), PathBuf::from);
    file::write(&page, league_html(&league(&rows)))?;
    Ok(writeln!(
        out,
        "{} on {}",
        counted(rows.len(), "row"),
        page.display()
    )?)
}

/// Reads the rows, each of an entrant in a world once: the last one counts.
fn rows(folder: &Path) -> Result<Vec<Row>> {
    let listed = files_in(folder).map_err(|error| anyhow!("{}: {error}", folder.display()));
    let mut rows: BTreeMap<(String, String, u64), Row> = BTreeMap::new();
    for path in listed.or_bad_input()? {
        let name = path.display();
        if path.extension().is_none_or(|ending| ending != "jsonl") {
            if path.file_name().is_some_and(|file| file != PAGE) {
                note(&format!(
                    "{name} is left out: rows are in files that end in .jsonl"
                ));
            }
            continue;
        }
        let text = file::read(&path, "give a folder of what `tolman arena --json` wrote")?;
        for (number, line) in (1_u32..).zip(text.lines()) {
            let row: Row = serde_json::from_str(line).map_err(|error| {
                Failure::BadInput(anyhow!(
                    "{name}, line {number}: no row of `tolman arena --json` of this version: {error}"
                ))
            })?;
            rows.insert((row.entrant(), row.world.clone(), row.seed), row);
        }
    }
    match rows.is_empty() {
        true => Err(Failure::BadInput(anyhow!(
            "{}: no rows; write some by `tolman arena --json > {}`",
            folder.display(),
            folder.join("mine.jsonl").display()
        ))),
        false => Ok(rows.into_values().collect()),
    }
}

fn league(rows: &[Row]) -> League {
    let mut entrants: BTreeMap<String, Vec<&Row>> = BTreeMap::new();
    for row in rows {
        entrants.entry(row.entrant()).or_default().push(row);
    }
    let tables = TASKS.into_iter().filter_map(|task| table(task, &entrants));
    let commands = entrants.iter().flat_map(|(entrant, rows)| {
        let commands: BTreeSet<&str> = rows.iter().map(|row| row.command.as_str()).collect();
        commands
            .into_iter()
            .map(move |command| (entrant.clone(), command.to_owned()))
    });
    League {
        told: told(&entrants),
        tables: tables.collect(),
        commands: commands.collect(),
    }
}

/// Returns what is said above the tables.
fn told(entrants: &BTreeMap<String, Vec<&Row>>) -> Vec<String> {
    let worlds = |rows: &[&Row]| -> BTreeSet<(String, u64)> {
        rows.iter()
            .map(|row| (row.world.clone(), row.seed))
            .collect()
    };
    let sets: BTreeSet<BTreeSet<(String, u64)>> =
        entrants.values().map(|rows| worlds(rows)).collect();
    let of_whom = counted(entrants.len(), "entrant");
    let alike = match sets.iter().next() {
        Some(one) if sets.len() == 1 => {
            format!("All were in the same {}.", counted(one.len(), "world"))
        }
        _ => "They were not all in the same worlds: rows with other worlds cannot be compared."
            .to_owned(),
    };
    vec![
        format!("{of_whom}, judged by one judge that knows the worlds. {alike}"),
        "Each value is a mean over worlds with its 95 % interval. Worlds in which an entrant abstained or failed stay in the denominator.".to_owned(),
    ]
}

/// Returns the table of a task, the best entrant first; `None` if nobody has done anything of it.
fn table(
    (title, better, done): (&str, Better, Done),
    entrants: &BTreeMap<String, Vec<&Row>>,
) -> Option<LeagueTable> {
    let of = |rows: &[&Row], column: &str| {
        let rows = rows
            .iter()
            .filter(|row| column == ALL || row.family() == column);
        let values: Vec<f64> = rows.filter_map(|row| done(row)).collect();
        value(&values)
    };
    let played = entrants
        .values()
        .flatten()
        .filter(|row| done(row).is_some());
    let families: BTreeSet<&str> = played.map(|row| row.family()).collect();
    let mut columns = vec![ALL];
    columns.extend(families);
    let mut rows: Vec<(String, Vec<Option<LeagueValue>>)> = entrants
        .iter()
        .map(|(entrant, rows)| {
            let values = columns.iter().map(|column| of(rows, column));
            (entrant.clone(), values.collect())
        })
        .filter(|(_, values): &(_, Vec<Option<LeagueValue>>)| values.iter().any(Option::is_some))
        .collect();
    let overall = |values: &[Option<LeagueValue>]| values[0].map_or(0.0, |one| one.mean);
    rows.sort_by(|a, b| overall(&a.1).total_cmp(&overall(&b.1)));
    if better == Better::Higher {
        rows.reverse();
    }
    (!rows.is_empty()).then(|| LeagueTable {
        title: title.to_owned(),
        columns: columns.into_iter().map(str::to_owned).collect(),
        rows,
    })
}

/// Number of resamples of a mean's interval.
const RESAMPLES: u32 = 2000;

/// Returns the mean of values from 0 to 1, with its interval: Wilson's if each is one of both, else
/// the bootstrap's.
fn value(values: &[f64]) -> Option<LeagueValue> {
    let (mean, count) = (mean(values)?, values.len());
    // What is all done or not at all is a share of worlds.
    let done = values.iter().filter(|value| **value >= 1.0).count();
    let undone = values.iter().filter(|value| **value <= 0.0).count();
    let interval = match undone + done == count {
        true => wilson_interval(done as u64, count as u64, 0.95),
        false => {
            let rng = &mut ChaCha8Rng::seed_from_u64(1);
            let points = u32::try_from(count).unwrap_or(u32::MAX);
            bootstrap_means(values, points, RESAMPLES, rng)
                .and_then(|means| percentile_interval(&means, 0.95))
        }
    };
    Some(LeagueValue {
        mean: 100.0 * mean,
        interval: interval.ok()?.scaled(100.0),
        worlds: count,
    })
}
