//! Makes the box plots that every experiment gets.

use super::{Centre, Experiment, Metric, Run, Statistic, Table};
use tolman_draw::{BoxGroup, BoxPlot, Dot, Figure, PaperMark, Series};

/// Returns one box plot for every field with a mean or a median as metric, in the order of tables
/// and metrics.
pub(super) fn box_plots(experiment: &Experiment, runs: &[Run]) -> Vec<Figure> {
    plotted(experiment)
        .map(|(name, table, metric, field)| box_plot(name, table, metric, field, runs))
        .collect()
}

/// Returns the names of the box plots, which are known before any run.
pub(super) fn names(experiment: &Experiment) -> Vec<String> {
    plotted(experiment).map(|(name, ..)| name).collect()
}

/// Returns every box plot to draw: its name, the table, the metric and the metric's field. Tables
/// are numbered, because their names may be any text from a maze file.
fn plotted(experiment: &Experiment) -> impl Iterator<Item = (String, &Table, &Metric, &str)> {
    (1_u32..)
        .zip(&experiment.tables)
        .filter(|(_, table)| table.is_filled())
        .flat_map(|(number, table)| {
            let mut seen: Vec<&str> = Vec::new();
            table.metrics.iter().filter_map(move |metric| {
                let Statistic::Of(Centre::Mean | Centre::Median, field) = &metric.statistic else {
                    return None;
                };
                // Mean and median of one field share a plot.
                if seen.contains(&field.as_str()) {
                    return None;
                }
                seen.push(field);
                let name = format!("box-{number}-{}", slug(&metric.name));
                Some((name, table, metric, field.as_str()))
            })
        })
}

fn box_plot(name: String, table: &Table, metric: &Metric, field: &str, runs: &[Run]) -> Figure {
    let groups = (0..).zip(&table.rows).map(|(i, row)| {
        let runs = runs.iter().filter(|run| run.is_of(&table.name, &row.name));
        let dots = runs.filter_map(|run| {
            let value = run.fields.number(field)?;
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
    let of_paper = table
        .rows
        .iter()
        .any(|row| row.paper_value(&metric.name).is_some());
    let caption = match of_paper {
        true => "Box: quartiles and median. Dots: every run. Diamond: the paper.",
        false => "Box: quartiles and median. Dots: every run.",
    };
    let plot = BoxPlot {
        table: table.name.clone(),
        axis,
        groups: groups.collect(),
    };
    Figure::new(
        name,
        format!("Table {}: {}", table.name, metric.title),
        plot.drawing(),
    )
    .caption(caption)
    .table(&table.name)
}

/// Returns the name with only lower-case letters, digits and single hyphens.
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
        assert_eq!(slug("Steps (of J)"), "steps-of-j");
        assert_eq!(slug("success_percent"), "success-percent");
    }
}
