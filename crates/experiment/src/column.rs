//! Description of one field of a record, for the runner, the tables and the report.

use super::Tolerance;

/// One field of a [`Record`](super::Record).
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name of the field in serde's output.
    pub field: String,
    /// Type of the field's values.
    pub kind: Kind,
    /// Whether every run has the field.
    pub presence: Presence,
    /// Name of the field on a page.
    pub title: String,
    /// Unit, shown after the title; empty if there is none.
    pub unit: String,
    /// Direction in which values are better.
    pub better: Better,
    /// Definition, in a sentence.
    pub definition: String,
    /// Minimum value in a run; `None` for no limit.
    pub low: Option<f64>,
    /// Maximum value in a run; `None` for no limit.
    pub high: Option<f64>,
    /// Tolerance between our value and the paper's, unless a metric sets its own.
    pub tolerance: Option<Tolerance>,
    /// Number of decimals shown, unless a metric sets it.
    pub decimals: Option<u8>,
}

impl Column {
    /// Returns the column of a field of type `T`. Its title is its name, and no direction is
    /// better.
    pub fn of<T: Value>(field: impl Into<String>, definition: &str) -> Self {
        let field = field.into();
        Self {
            kind: T::KIND,
            presence: T::PRESENCE,
            title: field.replace('_', " "),
            field,
            unit: String::new(),
            better: Better::Neither,
            definition: definition.trim().to_owned(),
            low: None,
            high: None,
            tolerance: None,
            decimals: None,
        }
    }

    /// Sets the title of a field for which more is better.
    #[must_use]
    pub fn higher(self, title: impl Into<String>) -> Self {
        self.titled(title, Better::Higher)
    }

    /// Sets the title of a field for which less is better.
    #[must_use]
    pub fn lower(self, title: impl Into<String>) -> Self {
        self.titled(title, Better::Lower)
    }

    /// Sets the title of a field for which no direction is better.
    #[must_use]
    pub fn neither(self, title: impl Into<String>) -> Self {
        self.titled(title, Better::Neither)
    }

    fn titled(mut self, title: impl Into<String>, better: Better) -> Self {
        self.title = title.into();
        self.better = better;
        self
    }

    /// Sets the unit, which is shown after the title.
    #[must_use]
    pub fn unit(mut self, unit: impl Into<String>) -> Self {
        self.unit = unit.into();
        self
    }

    /// Refuses runs with less than `low`.
    #[must_use]
    pub fn at_least(mut self, low: impl Into<f64>) -> Self {
        self.low = Some(low.into());
        self
    }

    /// Refuses runs with more than `high`.
    #[must_use]
    pub fn at_most(mut self, high: impl Into<f64>) -> Self {
        self.high = Some(high.into());
        self
    }

    /// Limits the field to 0 … 1.
    #[must_use]
    pub fn share(self) -> Self {
        self.at_least(0).at_most(1)
    }

    /// Limits the field to 0 … 100 and sets the unit %.
    #[must_use]
    pub fn percent(self) -> Self {
        self.unit("%").at_least(0).at_most(100)
    }

    /// Sets the maximum difference between our value and the paper's.
    #[must_use]
    pub fn tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = Some(tolerance);
        self
    }

    /// Sets the number of decimals shown.
    #[must_use]
    pub fn decimals(mut self, decimals: u8) -> Self {
        self.decimals = Some(decimals);
        self
    }

    /// Returns the minimum and the maximum value of a run.
    pub(super) fn range(&self) -> (f64, f64) {
        let least = match self.kind {
            Kind::Count => 0.0,
            _ => f64::NEG_INFINITY,
        };
        (
            self.low.unwrap_or(least),
            self.high.unwrap_or(f64::INFINITY),
        )
    }

    /// Returns whether no value is in the range.
    pub(super) fn is_void(&self) -> bool {
        let sound = |bound: Option<f64>| bound.is_none_or(|bound| !bound.is_nan());
        let ordered = match (self.low, self.high) {
            (Some(low), Some(high)) => low <= high,
            _ => true,
        };
        !(sound(self.low) && sound(self.high) && ordered)
    }

    /// Returns why no run can have `value`; `None` if one can.
    pub(super) fn refusal(&self, value: f64) -> Option<String> {
        let Self { field, .. } = self;
        if !value.is_finite() {
            return Some(format!(
                "{field} is {value}; measured values must be finite"
            ));
        }
        match (self.low, self.high) {
            (Some(low), _) if value < low => {
                Some(format!("{field} is {value}, expected {low} or more"))
            }
            (_, Some(high)) if value > high => {
                Some(format!("{field} is {value}, expected {high} or less"))
            }
            _ => None,
        }
    }
}

/// Type of a field's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Yes or no.
    Flag,
    /// A count, from 0.
    Count,
    /// A measured number.
    Number,
    /// A text, such as the reason for an end.
    Text,
    /// Numbers at equally spaced steps.
    Curve,
}

/// Whether every run has a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// Every run has the field.
    Always,
    /// Some runs have the field.
    Sometimes,
}

/// Direction in which a measured value is better.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Better {
    /// More is better.
    Higher,
    /// Less is better.
    Lower,
    /// No direction is better.
    #[default]
    Neither,
}

impl Better {
    /// Returns the direction as a sentence; empty if there is none.
    pub const fn sentence(self) -> &'static str {
        match self {
            Self::Higher => "Higher is better.",
            Self::Lower => "Lower is better.",
            Self::Neither => "",
        }
    }
}

/// A type that a field of a record can have.
pub trait Value {
    /// Type of the values.
    const KIND: Kind;
    /// Whether every run has the field.
    const PRESENCE: Presence = Presence::Always;
}

impl Value for bool {
    const KIND: Kind = Kind::Flag;
}

impl Value for u32 {
    const KIND: Kind = Kind::Count;
}

impl Value for u64 {
    const KIND: Kind = Kind::Count;
}

impl Value for usize {
    const KIND: Kind = Kind::Count;
}

impl Value for f64 {
    const KIND: Kind = Kind::Number;
}

impl Value for String {
    const KIND: Kind = Kind::Text;
}

impl Value for Vec<f64> {
    const KIND: Kind = Kind::Curve;
}

impl<T: Value> Value for Option<T> {
    const KIND: Kind = T::KIND;
    const PRESENCE: Presence = Presence::Sometimes;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_outside_the_range_are_refused_by_name() {
        let column = Column::of::<f64>("share", "A share.").share();
        for (value, expect) in [
            (0.0, None),
            (1.0, None),
            (-0.5, Some("share is -0.5, expected 0 or more")),
            (1.5, Some("share is 1.5, expected 1 or less")),
            (
                f64::NAN,
                Some("share is NaN; measured values must be finite"),
            ),
        ] {
            assert_eq!(column.refusal(value).as_deref(), expect);
        }
        assert!(!column.is_void());
        for void in [
            column.clone().at_most(-1),
            column.clone().at_least(2),
            column.at_least(f64::NAN),
        ] {
            assert!(void.is_void(), "{void:?}");
        }
    }

    #[test]
    fn the_type_says_what_a_field_holds() {
        let column = Column::of::<Option<Vec<f64>>>("error_curve", " The error. ");
        assert_eq!(
            (column.kind, column.presence),
            (Kind::Curve, Presence::Sometimes)
        );
        assert_eq!(
            (column.title.as_str(), column.definition.as_str()),
            ("error curve", "The error.")
        );
    }
}
