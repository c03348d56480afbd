//! What the papers' tables are held to.

use alloc::collections::BTreeMap;

use tolman_experiment::{Entry, Metric, Options, Table, Tolerance, open};

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
