//! Identifies one run, and holds its results.

use alloc::collections::BTreeMap;
use core::any::type_name;

use serde::{Deserialize, Serialize};

use super::{FieldsError, Kind, Record, run_seed};

/// A run to be played.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job<'a> {
    /// Name of the table.
    pub table: &'a str,
    /// Name of the row.
    pub row: &'a str,
    /// Index of the run in its row, from 0.
    pub run: u32,
    /// Seed of the run, the same for all rows of the table; see [`run_seed`](super::run_seed).
    pub seed: u64,
}

/// A run that was played: a line of `runs.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Name of the table.
    pub table: String,
    /// Name of the row.
    pub row: String,
    /// Index of the run in its row, from 0.
    pub run: u32,
    /// Seed of the run.
    pub seed: u64,
    /// Measurements of the run.
    #[serde(flatten)]
    pub fields: Fields,
}

impl<'a> Job<'a> {
    /// Returns the job with this index in a row.
    pub(super) fn of(master_seed: u64, table: &'a str, row: &'a str, run: u32) -> Self {
        let seed = run_seed(master_seed, table, run);
        Self {
            table,
            row,
            run,
            seed,
        }
    }
}

impl Run {
    /// Returns whether the run belongs to `row` of `table`.
    pub fn is_of(&self, table: &str, row: &str) -> bool {
        self.table == table && self.row == row
    }

    /// Returns the job that plays this run again.
    pub fn job(&self) -> Job<'_> {
        Job {
            table: &self.table,
            row: &self.row,
            run: self.run,
            seed: self.seed,
        }
    }

    /// Returns the measurements as the record of its table.
    ///
    /// # Errors
    /// [`FieldsError::Read`] if the fields are not those of the record.
    pub fn record<T: Record>(&self) -> Result<T, FieldsError> {
        self.fields.record()
    }
}

/// Measurements of one run by name: a [`Record`](super::Record) without its type. Sorted by name,
/// so that equal fields give equal text.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Fields(BTreeMap<String, Field>);

impl Fields {
    /// Returns the fields of a record; `None` values are left out.
    pub(super) fn of<T: Record>(record: &T) -> Result<Self, FieldsError> {
        let written = toml::Table::try_from(record).map_err(|source| FieldsError::Write {
            record: type_name::<T>(),
            source,
        })?;
        Self::of_table(written)
    }

    /// Returns the record with these fields.
    ///
    /// # Errors
    /// [`FieldsError::Read`] if a field is missing or has another type.
    pub fn record<T: Record>(&self) -> Result<T, FieldsError> {
        self.table().try_into().map_err(|source| FieldsError::Read {
            record: type_name::<T>(),
            source,
        })
    }

    /// Does the part of [`of`](Self::of) that is compiled once for all records.
    fn of_table(written: toml::Table) -> Result<Self, FieldsError> {
        let fields = written.into_iter().map(|(name, value)| {
            let field = Field::read(&value).ok_or_else(|| FieldsError::NoField {
                field: name.clone(),
                value: value.to_string(),
            })?;
            Ok((name, field))
        });
        fields.collect::<Result<_, _>>().map(Self)
    }

    /// Does the part of [`record`](Self::record) that is compiled once for all records.
    fn table(&self) -> toml::Table {
        let fields = self.0.iter();
        fields
            .map(|(name, field)| (name.clone(), field.written()))
            .collect()
    }

    /// Returns the field called `name`.
    pub(super) fn get(&self, name: &str) -> Option<&Field> {
        self.0.get(name)
    }

    /// Returns the value of a count or a number.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            Field::Count(count) => Some(*count as f64),
            Field::Number(number) => Some(*number),
            Field::Flag(_) | Field::Text(_) | Field::Curve(_) => None,
        }
    }

    /// Returns the value of a flag.
    pub(super) fn flag(&self, name: &str) -> Option<bool> {
        match self.get(name)? {
            Field::Flag(flag) => Some(*flag),
            _ => None,
        }
    }

    /// Returns the numbers of a curve.
    pub(super) fn curve(&self, name: &str) -> Option<&[f64]> {
        match self.get(name)? {
            Field::Curve(values) => Some(values),
            _ => None,
        }
    }

    /// Returns all fields, sorted by name.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&str, &Field)> {
        self.0.iter().map(|(name, field)| (name.as_str(), field))
    }
}

/// One measured value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(super) enum Field {
    /// Yes or no.
    Flag(bool),
    /// A count.
    Count(u64),
    /// A measured number.
    Number(f64),
    /// A word.
    Text(String),
    /// Numbers at equally spaced steps.
    Curve(Vec<f64>),
}

impl Field {
    /// Returns the field that serde wrote as `value`; `None` if `value` cannot be a field.
    fn read(value: &toml::Value) -> Option<Self> {
        Some(match value {
            toml::Value::Boolean(flag) => Self::Flag(*flag),
            toml::Value::Integer(count) => Self::Count(u64::try_from(*count).ok()?),
            toml::Value::Float(number) => Self::Number(*number),
            toml::Value::String(text) => Self::Text(text.clone()),
            toml::Value::Array(values) => {
                let values = values.iter().map(toml::Value::as_float);
                Self::Curve(values.collect::<Option<_>>()?)
            }
            toml::Value::Datetime(_) | toml::Value::Table(_) => return None,
        })
    }

    /// Returns the value that serde reads as this field.
    fn written(&self) -> toml::Value {
        match self {
            Self::Flag(flag) => (*flag).into(),
            Self::Count(count) => (*count as i64).into(),
            Self::Number(number) => (*number).into(),
            Self::Text(text) => text.as_str().into(),
            Self::Curve(values) => values.clone().into(),
        }
    }

    /// Returns the numbers to which a column's range applies.
    pub(super) fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Count(count) => vec![*count as f64],
            Self::Number(number) => vec![*number],
            Self::Curve(values) => values.clone(),
            Self::Flag(_) | Self::Text(_) => Vec::new(),
        }
    }

    /// Returns the type of the value.
    pub(super) const fn kind(&self) -> Kind {
        match self {
            Self::Flag(_) => Kind::Flag,
            Self::Count(_) => Kind::Count,
            Self::Number(_) => Kind::Number,
            Self::Text(_) => Kind::Text,
            Self::Curve(_) => Kind::Curve,
        }
    }
}
