//! What the papers' tables are held to.

use alloc::collections::BTreeMap;

use tolman_experiment::{Entry, Error, Metric, Options, Table, Tolerance, open};

/// Every metric of which a paper has a value to be judged by, with its table.
fn judged(entry: &Entry) -> Vec<(Table, Metric)> {
    let experiment = open(tolman_papers::catalogue(), entry.name, &Options::default()).unwrap();
    let tables = experiment.tables.into_iter();
    let metrics = tables.flat_map(|table| {
        let is_judged = |metric: &&Metric| {
            let values = table.rows.iter().flat_map(|row| &row.paper);
            let mut own = values.filter(|value| value.metric == metric.name);
            own.any(|value| value.aside.is_none())
        };
        let metrics: Vec<Metric> = table.metrics.iter().filter(is_judged).cloned().collect();
        metrics
            .into_iter()
            .map(move |metric| (table.clone(), metric))
    });
    metrics.collect()
}

#[test]
fn a_quantity_has_one_tolerance_in_all_experiments_and_a_reason() {
    let mut stated: BTreeMap<(String, String), Tolerance> = BTreeMap::new();
    for entry in tolman_papers::catalogue() {
        for (table, metric) in judged(entry) {
            let what = format!("{}, table {}, {}", entry.name, table.name, metric.name);
            let tolerance = metric
                .tolerance
                .unwrap_or_else(|| panic!("{what}: none is stated"));
            assert!(tolerance.reason.len() > 10, "{what}");
            // Scores of mice and scores of maps share a word.
            let quantity = (metric.name.clone(), metric.title.clone());
            let other = *stated.entry(quantity).or_insert(tolerance);
            assert_eq!(other, tolerance, "{what}");
        }
    }
    assert!(stated.len() > 10, "{stated:?}");
}

#[test]
fn tables_without_the_mazes_of_others_stand_with_the_papers_values() {
    let mouse = tolman_papers::catalogue()
        .iter()
        .find(|entry| entry.name == "micromouse");
    let experiment = open(
        tolman_papers::catalogue(),
        mouse.unwrap().name,
        &Options::default(),
    );
    for table in experiment.unwrap().tables.iter().take(4) {
        assert!(table.is_shown(), "{}", table.name);
        for row in &table.rows {
            let missing = row.missing.as_deref().unwrap_or("TOLMAN_DATA");
            assert_eq!(row.missing.is_some(), row.runs == Some(0), "{}", row.name);
            assert!(missing.contains("TOLMAN_DATA"), "{missing}");
        }
    }
}

/// A table of an experiment, asked for by its name, with a number of runs.
fn named(entry: &Entry, table: &str, runs: u32) -> Result<Table, Error> {
    let options = Options {
        runs: Some(runs),
        tables: vec![table.to_owned()],
        ..Options::default()
    };
    let experiment = open(tolman_papers::catalogue(), entry.name, &options)?;
    let mut tables = experiment.tables.into_iter();
    Ok(tables.find(|own| own.name == table).unwrap())
}

#[test]
fn every_table_of_every_experiment_obeys_the_number_of_runs_or_refuses_it() {
    // Fewer than there are of any thing that is tried, and enough for a search of maps.
    const RUNS: u32 = 100;
    let (mut obeyed, mut refused) = (0, 0);
    for entry in tolman_papers::catalogue() {
        let experiment = open(tolman_papers::catalogue(), entry.name, &Options::default());
        for Table { name, .. } in experiment.unwrap().tables {
            let what = format!("{}, table {name}", entry.name);
            let few = match named(entry, &name, RUNS) {
                Ok(few) => few,
                Err(Error::FixedRuns { .. } | Error::EmptyTable { .. }) => {
                    refused += 1;
                    continue;
                }
                Err(error) => panic!("{what}: {error}"),
            };
            let many = named(entry, &name, 2 * RUNS).unwrap();
            let counts = few.rows.iter().zip(&many.rows);
            let counts = counts.map(|(few, many)| [few.runs_of(RUNS), many.runs_of(2 * RUNS)]);
            let counts: Vec<[u32; 2]> = counts.collect();
            // What is left out, and what leaves nothing to chance, beside rows that obey.
            let obeys = |few: &[u32; 2]| *few == [0; 2] || *few == [1; 2] || few[0] < few[1];
            let grows = counts.iter().any(|few| few[0] < few[1]) && counts.iter().all(obeys);
            // Of as many mazes it has more starts in each, and says so.
            let told = few.note != many.note || !few.missing().is_empty();
            assert!(grows || told, "{what}: {counts:?}");
            obeyed += 1;
        }
    }
    assert!(obeyed > 30 && refused > 3, "{obeyed} {refused}");
}
