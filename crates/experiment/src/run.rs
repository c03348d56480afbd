//! One run: what identifies it and what came of it.

use alloc::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// A run to be played.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job<'a> {
    /// The name of the table.
    pub table: &'a str,
    /// The name of the row.
    pub row: &'a str,
    /// The index of the run in its row, from 0.
    pub run: u32,
    /// The seed of the run, the same for all rows of the table; see [`run_seed`](super::run_seed).
    pub seed: u64,
}

/// A run that was played: one line of `runs.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The name of the table.
    pub table: String,
    /// The name of the row.
    pub row: String,
    /// The index of the run in its row, from 0.
    pub run: u32,
    /// The seed of the run.
    pub seed: u64,
    /// What was measured.
    #[serde(flatten)]
    pub fields: Fields,
}

impl Run {
    /// The job that plays this run again.
    pub fn job(&self) -> Job<'_> {
        Job {
            table: &self.table,
            row: &self.row,
            run: self.run,
            seed: self.seed,
        }
    }
}

/// What one run measured, by name. Alphabetical, so that equal fields are written equally.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Fields(BTreeMap<String, Field>);

impl Fields {
    /// No fields.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a yes or no.
    #[must_use]
    pub fn flag(self, name: impl Into<String>, value: bool) -> Self {
        self.field(name, Field::Flag(value))
    }

    /// Adds a count.
    #[must_use]
    pub fn count(self, name: impl Into<String>, value: u64) -> Self {
        self.field(name, Field::Count(value))
    }

    /// Adds a measured number. The runner refuses one that is not finite.
    #[must_use]
    pub fn number(self, name: impl Into<String>, value: f64) -> Self {
        self.field(name, Field::Number(value))
    }

    /// Adds a word, such as an outcome.
    #[must_use]
    pub fn text(self, name: impl Into<String>, value: impl Into<String>) -> Self {
        self.field(name, Field::Text(value.into()))
    }

    /// Adds numbers at equal steps. The runner refuses any that is not finite.
    #[must_use]
    pub fn curve(self, name: impl Into<String>, values: Vec<f64>) -> Self {
        self.field(name, Field::Curve(values))
    }

    /// Adds any field, in place of one of the same name.
    #[must_use]
    pub fn field(mut self, name: impl Into<String>, field: Field) -> Self {
        self.0.insert(name.into(), field);
        self
    }

    /// The field of a name.
    pub fn get(&self, name: &str) -> Option<&Field> {
        self.0.get(name)
    }

    /// All fields, alphabetically.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Field)> {
        self.0.iter().map(|(name, field)| (name.as_str(), field))
    }
}

/// One measured value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Field {
    /// Yes or no.
    Flag(bool),
    /// A count.
    Count(u64),
    /// A measured number.
    Number(f64),
    /// A word.
    Text(String),
    /// Numbers at equal steps.
    Curve(Vec<f64>),
}

/// What a field holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// [`Field::Flag`].
    Flag,
    /// [`Field::Count`].
    Count,
    /// [`Field::Number`].
    Number,
    /// [`Field::Text`].
    Text,
    /// [`Field::Curve`].
    Curve,
}

impl Field {
    /// What it holds.
    pub const fn kind(&self) -> Kind {
        match self {
            Self::Flag(_) => Kind::Flag,
            Self::Count(_) => Kind::Count,
            Self::Number(_) => Kind::Number,
            Self::Text(_) => Kind::Text,
            Self::Curve(_) => Kind::Curve,
        }
    }

    /// The number of a count or a number.
    #[expect(
        clippy::cast_precision_loss,
        reason = "counts of steps stay far below 2^53"
    )]
    pub fn as_number(&self) -> Option<f64> {
        match self {
            Self::Count(count) => Some(*count as f64),
            Self::Number(number) => Some(*number),
            Self::Flag(_) | Self::Text(_) | Self::Curve(_) => None,
        }
    }

    /// The flag.
    pub fn as_flag(&self) -> Option<bool> {
        match self {
            Self::Flag(flag) => Some(*flag),
            Self::Count(_) | Self::Number(_) | Self::Text(_) | Self::Curve(_) => None,
        }
    }

    /// The word.
    pub fn as_text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            Self::Flag(_) | Self::Count(_) | Self::Number(_) | Self::Curve(_) => None,
        }
    }

    /// The numbers of a curve.
    pub fn as_curve(&self) -> Option<&[f64]> {
        match self {
            Self::Curve(values) => Some(values),
            Self::Flag(_) | Self::Count(_) | Self::Number(_) | Self::Text(_) => None,
        }
    }
}
