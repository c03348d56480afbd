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

/// The tables of an experiment by `--runs`.
fn tables(entry: &Entry, runs: u32) -> Vec<Table> {
    let options = Options {
        runs: Some(runs),
        ..Options::default()
    };
    let experiment = open(tolman_papers::catalogue(), entry.name, &options);
    experiment.unwrap().tables
}

#[test]
fn every_table_of_every_experiment_obeys_the_number_of_runs_or_refuses_it() {
    // Fewer than there are of any thing that is tried, and enough for a search of maps.
    const RUNS: u32 = 100;
    let (mut obeyed, mut refused) = (0, 0);
    for entry in tolman_papers::catalogue() {
        for (few, many) in tables(entry, RUNS).iter().zip(tables(entry, 2 * RUNS)) {
            let obeys = few.rows.iter().zip(&many.rows).all(|(few, many)| {
                let counts = [few.runs_of(RUNS), many.runs_of(2 * RUNS)];
                // What is left out, and what leaves nothing to chance, beside rows that obey.
                counts == [0; 2] || counts == [1; 2] || counts[0] < counts[1]
            });
            // Of as many mazes it has more starts in each, and says so.
            let grows = few.rows.iter().zip(&many.rows);
            let grows = grows.filter(|(few, many)| few.runs_of(RUNS) < many.runs_of(2 * RUNS));
            if obeys && grows.count() > 0 || few.note != many.note {
                obeyed += 1;
                continue;
            }
            let named = Options {
                runs: Some(RUNS),
                tables: vec![few.name.clone()],
                ..Options::default()
            };
            let told = open(tolman_papers::catalogue(), entry.name, &named).err();
            let what = format!("{}, table {}: {told:?}", entry.name, few.name);
            let is_refused = matches!(
                told,
                Some(Error::FixedRuns { .. } | Error::EmptyTable { .. })
            );
            assert!(is_refused || !few.missing().is_empty(), "{what}");
            refused += 1;
        }
    }
    assert!(obeyed > 30 && refused > 3, "{obeyed} {refused}");
}
