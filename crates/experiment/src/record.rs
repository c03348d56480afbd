//! Defines records: the measurements of a run, as a struct with a column for each field.

use core::any::type_name;

use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

use super::{BoxError, Column, Fields, Run};

/// Measurements of one run of a table. [`record!`](crate::record) declares the struct with its
/// columns.
pub trait Record: Serialize + DeserializeOwned {
    /// Returns one column for each field that serde writes.
    fn columns() -> Vec<Column>;

    /// Refuses a record whose values are in their columns' ranges, but do not fit together.
    ///
    /// # Errors
    /// The first fault of the record.
    fn check(&self) -> Result<(), String> {
        Ok(())
    }

    /// Returns the records of a row's runs, in order.
    ///
    /// # Errors
    /// [`FieldsError::Read`] if a run has other fields.
    fn of_row(runs: &[Run], table: &str, row: &str) -> Result<Vec<Self>, FieldsError> {
        let own = runs.iter().filter(|run| run.is_of(table, row));
        own.map(Run::record).collect()
    }

    /// Returns the record as the fields of a run.
    ///
    /// # Errors
    /// [`FieldsError`] if a value cannot be a field.
    fn fields(&self) -> Result<Fields, FieldsError> {
        Fields::of(self)
    }
}

/// Declares a [`Record`]: a struct with its columns, one line per field.
///
/// - The doc comment of a field is the column's definition, and its type is the type of the values.
///   An `Option` says that not every run has it.
/// - After `=>` come the methods of [`Column`](crate::Column).
/// - Each field gives a constant of its name, for metrics to refer to.
/// - `#[check(function)]` names the [check](Record::check).
/// - `..base: Base` includes the fields of another record.
///
/// The crate needs serde as a dependency.
///
/// ```
/// use tolman_experiment::{Metric, Record, Table, record, require};
///
/// record! {
///     /// One throw.
///     #[check(Throw::is_possible)]
///     struct Throw {
///         /// Whether the dart hit the board.
///         hit: bool => higher("hits"),
///         /// Distance from the middle, where it hit.
///         miss: Option<f64> => lower("miss").unit("cm").at_least(0),
///     }
/// }
///
/// impl Throw {
///     fn is_possible(&self) -> Result<(), String> {
///         require(self.hit == self.miss.is_some(), "a dart has a distance where it hit")
///     }
/// }
///
/// let table = Table::of::<Throw>("1", "Throws").metric(Metric::mean(Throw::miss));
/// assert_eq!((table.metrics[0].title.as_str(), table.metrics[0].unit.as_str()), ("miss", "cm"));
/// let throw = Throw { hit: true, miss: Some(2.5) };
/// assert_eq!(throw.fields()?.record::<Throw>()?, throw);
/// # Ok::<(), tolman_experiment::FieldsError>(())
/// ```
#[macro_export]
macro_rules! record {
    (
        $(#[doc = $about:literal])*
        $(#[check($check:path)])?
        $vis:vis struct $name:ident {
            $(..$base:ident: $base_type:ty,)?
            $(
                $(#[doc = $definition:literal])+
                $field:ident: $type:ty => $($method:ident($($argument:expr),*)).+
            ),+ $(,)?
        }
    ) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, Default, PartialEq, ::serde::Serialize, ::serde::Deserialize)]
        $vis struct $name {
            $(
                /// Fields that the struct has in common with others.
                #[serde(flatten)]
                $vis $base: $base_type,
            )?
            $($(#[doc = $definition])+ $vis $field: $type,)+
        }

        #[allow(dead_code, non_upper_case_globals, reason = "one for each field, named as it is")]
        impl $name {
            $(
                #[doc = concat!("Name of the field `", stringify!($field), "`.")]
                $vis const $field: &'static str = stringify!($field);
            )+
        }

        impl $crate::Record for $name {
            fn columns() -> Vec<$crate::Column> {
                let own = [$(
                    $crate::Column::of::<$type>(stringify!($field), concat!($($definition),+))
                        $(.$method($($argument),*))+
                ),+];
                let base: [Vec<$crate::Column>; _] =
                    [$(<$base_type as $crate::Record>::columns())?];
                base.into_iter().flatten().chain(own).collect()
            }

            fn check(&self) -> Result<(), String> {
                $($crate::Record::check(&self.$base)?;)?
                $($check(self)?;)?
                Ok(())
            }
        }
    };
}

/// Checks a relation between the fields of a record: refuses it with `why` unless it `holds`.
///
/// # Errors
/// `why`.
pub fn require(holds: bool, why: &str) -> Result<(), String> {
    match holds {
        true => Ok(()),
        false => Err(why.to_owned()),
    }
}

/// Reason why a record and the fields of a run do not fit each other.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FieldsError {
    /// Serde cannot write the record as fields.
    #[error("the record {record} cannot be written as fields")]
    Write {
        /// Name of the record's type.
        record: &'static str,
        /// Error of serde.
        source: toml::ser::Error,
    },
    /// A value cannot be a field.
    #[error("{field} is {value}; a field is a flag, a count, a number, a word or a curve")]
    NoField {
        /// Name of the field.
        field: String,
        /// Value that was given.
        value: String,
    },
    /// The fields are not those of the record.
    #[error("the fields do not match record {record}")]
    Read {
        /// Name of the record's type.
        record: &'static str,
        /// Error of serde.
        source: toml::de::Error,
    },
}

/// The type of a table's records, without the Rust type.
#[derive(Clone, Debug)]
pub struct RecordType {
    name: &'static str,
    columns: Vec<Column>,
    check: fn(&Fields) -> Result<(), BoxError>,
}

impl RecordType {
    pub(super) fn of<T: Record>() -> Self {
        Self {
            name: type_name::<T>(),
            columns: T::columns(),
            check: |fields| Ok(fields.record::<T>()?.check()?),
        }
    }

    /// Returns the column of a field; `None` if there is none.
    pub fn column(&self, field: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.field == field)
    }

    /// Returns the columns, in the order of their declaration.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    pub(super) fn column_mut(&mut self, field: &str) -> Option<&mut Column> {
        let mut columns = self.columns.iter_mut();
        columns.find(|column| column.field == field)
    }

    /// Refuses fields that do not form such a record, or one that [`Record::check`] refuses.
    pub(super) fn check(&self, fields: &Fields) -> Result<(), BoxError> {
        (self.check)(fields)
    }
}

impl PartialEq for RecordType {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.columns == other.columns
    }
}

#[cfg(test)]
mod tests {
    use serde::{Deserialize, Serialize};

    use super::*;
    use crate::{Better, Kind, Presence};

    record! {
        /// Where a dart hit.
        struct Hit {
            /// Distance from the middle.
            miss: f64 => lower("miss").unit("cm").at_least(0),
        }
    }

    record! {
        /// A throw.
        #[check(Throw::is_possible)]
        struct Throw {
            ..hit: Hit,
            /// Number of throws before, of the same player.
            before: u32 => neither("throws before"),
            /// Whether it counts.
            counts: bool => higher("counted"),
            /// Message of the player.
            said: Option<String> => neither("words"),
            /// The way of the dart.
            way: Vec<f64> => neither("way"),
        }
    }

    impl Throw {
        fn is_possible(&self) -> Result<(), String> {
            let is_beside = self.hit.miss > 20.0;
            require(!self.counts || !is_beside, "it is counted beside the board")
        }
    }

    fn throw() -> Throw {
        Throw {
            hit: Hit { miss: 2.0 },
            before: 7,
            counts: true,
            said: None,
            way: vec![1.0, 0.1],
        }
    }

    #[test]
    fn fields_are_written_alphabetically_without_what_is_absent() {
        let text = |throw: &Throw| serde_json::to_string(&throw.fields().unwrap()).unwrap();
        let expect = r#"{"before":7,"counts":true,"miss":2.0,"way":[1.0,0.1]}"#;
        assert_eq!(text(&throw()), expect);
        let said = Throw {
            said: Some("ha".into()),
            way: vec![],
            ..throw()
        };
        let expect = r#"{"before":7,"counts":true,"miss":2.0,"said":"ha","way":[]}"#;
        assert_eq!(text(&said), expect);
    }

    #[test]
    fn fields_go_back_into_their_record() {
        for throw in [
            throw(),
            Throw {
                said: Some("ha".into()),
                way: vec![],
                ..throw()
            },
        ] {
            assert_eq!(throw.fields().unwrap().record::<Throw>().unwrap(), throw);
        }
        let read = Hit { miss: 1.0 }.fields().unwrap().record::<Throw>();
        assert!(matches!(read, Err(FieldsError::Read { .. })));
    }

    #[test]
    fn a_number_that_is_not_finite_stays_one_for_the_runner_to_refuse() {
        let fields = Hit { miss: f64::NAN }.fields().unwrap();
        assert!(fields.number("miss").unwrap().is_nan());
    }

    #[test]
    fn columns_are_declared_beside_the_fields() {
        let columns = Throw::columns();
        let names: Vec<&str> = columns.iter().map(|column| column.field.as_str()).collect();
        assert_eq!(names, ["miss", "before", "counts", "said", "way"]);
        assert_eq!((Throw::before, Hit::miss), ("before", "miss"));
        let [miss, before, _, said, way] = &columns[..] else {
            panic!("five columns");
        };
        assert_eq!((miss.better, miss.low), (Better::Lower, Some(0.0)));
        assert_eq!(
            before.definition,
            "Number of throws before, of the same player."
        );
        assert_eq!((before.kind, way.kind), (Kind::Count, Kind::Curve));
        assert_eq!(said.presence, Presence::Sometimes);
    }

    #[test]
    fn the_check_is_that_of_the_type_and_of_its_base() {
        let kind = RecordType::of::<Throw>();
        let wide = Throw {
            hit: Hit { miss: 30.0 },
            ..throw()
        };
        kind.check(&throw().fields().unwrap()).unwrap();
        let refused = kind.check(&wide.fields().unwrap()).unwrap_err();
        assert_eq!(refused.to_string(), "it is counted beside the board");
    }

    #[test]
    fn a_value_that_is_no_field_is_refused() {
        #[derive(Serialize, Deserialize)]
        struct Nested {
            here: (f64, bool),
        }
        impl Record for Nested {
            fn columns() -> Vec<Column> {
                Vec::new()
            }
        }
        let error = Nested { here: (1.0, true) }.fields().unwrap_err();
        assert!(matches!(error, FieldsError::NoField { field, .. } if field == "here"));
    }
}
