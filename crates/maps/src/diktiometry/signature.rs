use alloc::vec::Vec;

use thiserror::Error;

/// The look of a place: an image signature, "an array of values, each computed by a measurement
/// function from a subset of the image". Columns run around the robot, counter-clockwise from north
/// or, without a compass, from the robot's heading.
///
/// Source: paper, *Perceptual Indexing*.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked"))]
pub struct Signature {
    rows: usize,
    /// Values, column by column.
    values: Vec<f64>,
}

/// A signature as read from a file, unchecked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Unchecked {
    rows: usize,
    values: Vec<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for Signature {
    type Error = SignatureError;

    fn try_from(unchecked: Unchecked) -> Result<Self, SignatureError> {
        Self::new(unchecked.rows, unchecked.values)
    }
}

/// Reason why values do not make a signature.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SignatureError {
    /// There are no values.
    #[error("the signature has {values} values in {rows} rows; give at least one of each")]
    Empty {
        /// Number of rows that was asked for.
        rows: usize,
        /// Number of values given.
        values: usize,
    },
    /// The columns differ in length.
    #[error("{values} values do not make columns of {rows} rows; give a multiple of {rows}")]
    Ragged {
        /// Number of rows that was asked for.
        rows: usize,
        /// Number of values given.
        values: usize,
    },
    /// A value is NaN or infinite.
    #[error("column {column}, row {row} is {value}; give a finite number")]
    NotFinite {
        /// Number of the column, from 0.
        column: usize,
        /// Row of the value.
        row: usize,
        /// Value that is not finite.
        value: f64,
    },
}

impl Signature {
    /// Returns a signature of columns of `rows` values each, column by column.
    ///
    /// # Errors
    /// [`SignatureError`] if there are no values, the last column is not full, or a value is not
    /// finite.
    pub fn new(rows: usize, values: Vec<f64>) -> Result<Self, SignatureError> {
        let count = values.len();
        if rows == 0 || count == 0 {
            return Err(SignatureError::Empty {
                rows,
                values: count,
            });
        }
        if !count.is_multiple_of(rows) {
            return Err(SignatureError::Ragged {
                rows,
                values: count,
            });
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            return Err(SignatureError::NotFinite {
                column: at / rows,
                row: at % rows,
                value: values[at],
            });
        }
        Ok(Self { rows, values })
    }

    /// Returns the number of values in a column.
    #[must_use]
    pub const fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the number of columns.
    #[must_use]
    pub const fn columns(&self) -> usize {
        self.values.len() / self.rows
    }

    /// Returns the values of a column, from the first row on; empty beyond the last column.
    #[must_use]
    pub fn column(&self, number: usize) -> &[f64] {
        let from = number * self.rows;
        self.values.get(from..from + self.rows).unwrap_or_default()
    }

    /// Returns the number of columns that differ from those of `other` by at most `tolerance` in
    /// every row. `other` is rotated by `offset` columns: column c is compared with its column c +
    /// offset.
    pub(super) fn agreement(&self, other: &Self, offset: usize, tolerance: f64) -> usize {
        let columns = self.columns();
        (0..columns)
            .filter(|&number| {
                let there = other.column((number + offset) % columns);
                let mut pairs = self.column(number).iter().zip(there);
                pairs.all(|(a, b)| (a - b).abs() <= tolerance)
            })
            .count()
    }
}
