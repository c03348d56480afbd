//! The usual metric of a field.

use tolman_experiment::{Kind, Metric, Table};

/// Tables that take the usual metrics of some fields, in any order.
pub(crate) trait UsualMetrics: Sized {
    /// Adds the usual metric of each field: of a flag the percentage of runs, named
    /// `FIELD_percent`, and of a number the mean.
    #[must_use]
    fn metrics<const N: usize>(self, fields: [&str; N]) -> Self;
}

impl UsualMetrics for Table {
    fn metrics<const N: usize>(self, fields: [&str; N]) -> Self {
        fields.into_iter().fold(self, |table, field| {
            let kind = table.record.column(field).map(|column| column.kind);
            table.metric(match kind {
                Some(Kind::Flag) => Metric::percent(format!("{field}_percent"), field),
                _ => Metric::mean(field),
            })
        })
    }
}
