//! The box plots that every experiment gets.

use super::{Experiment, Field, Metric, Run, Statistic, Table};
use crate::draw::{BoxGroup, BoxPlot, Dot, Figure, PaperMark, Series};

/// One box plot for every metric that is a mean, in the order of tables and metrics.
pub(super) fn box_plots(experiment: &dyn Experiment, runs: &[Run]) -> Vec<Figure> {
    let mut figures = Vec::new();
    for table in experiment.tables() {
        for metric in &table.metrics {
            if let Statistic::Mean { field } = &metric.statistic {
                figures.push(box_plot(table, metric, field, runs));
            }
        }
    }
    figures
}

fn box_plot(table: &Table, metric: &Metric, field: &str, runs: &[Run]) -> Figure {
    let groups = (0..).zip(&table.rows).map(|(i, row)| {
        let runs = runs
            .iter()
            .filter(|run| run.table == table.name && run.row == row.name);
        let dots = runs.filter_map(|run| {
            let value = run.fields.get(field).and_then(Field::as_number)?;
            Some(Dot {
                value,
                run: run.run,
                seed: run.seed,
            })
        });
        BoxGroup {
            row: row.name.clone(),
            series: Series(i),
            dots: dots.collect(),
            paper: row.paper_value(&metric.name).map(|paper| PaperMark {
                mean: paper.value,
                sd: paper.sd,
            }),
        }
    });
    let axis = match metric.unit.as_str() {
        "" => metric.title.clone(),
        unit => format!("{}, {unit}", metric.title),
    };
    let plot = BoxPlot {
        table: table.name.clone(),
        axis,
        groups: groups.collect(),
    };
    Figure::new(
        format!("box-{}-{}", slug(&table.name), slug(&metric.name)),
        format!("Table {}: {}", table.name, metric.title),
        plot.drawing(),
    )
    .table(&table.name)
}

/// Lower-case letters, digits and single hyphens.
fn slug(name: &str) -> String {
    let mut slug = String::new();
    for c in name.chars() {
        if c.is_ascii_alphanumeric() {
            slug.push(c.to_ascii_lowercase());
        } else if !slug.ends_with('-') {
            slug.push('-');
        }
    }
    slug.trim_matches('-').to_owned()
}

#[cfg(test)]
mod tests {
    use super::slug;

    #[test]
    fn names_of_files() {
        assert_eq!(slug("2 (J)"), "2-j");
        assert_eq!(slug("success_percent"), "success-percent");
    }
}
