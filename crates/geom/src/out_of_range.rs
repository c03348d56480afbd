use core::fmt;
use core::ops::Bound::{self, Excluded, Included, Unbounded};
use core::ops::RangeBounds;

/// A number of a configuration that is out of its range or not finite.
///
/// ```
/// use tolman_geom::OutOfRange;
///
/// let error = OutOfRange::check("share", 1.5, 0.0..=1.0).unwrap_err();
/// assert_eq!(error.to_string(), "`share` is 1.5; give a number from 0 to 1");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct OutOfRange {
    /// Name of the field.
    pub field: &'static str,
    /// Value that was given.
    pub value: f64,
    /// Lower bound of the field.
    pub least: Bound<f64>,
    /// Upper bound of the field.
    pub most: Bound<f64>,
}

/// Range of the numbers above 0.
pub const POSITIVE: (Bound<f64>, Bound<f64>) = (Excluded(0.0), Unbounded);

impl OutOfRange {
    /// Checks that the value of a field is finite and in its range.
    ///
    /// # Errors
    /// If it is not.
    pub fn check(
        field: &'static str,
        value: f64,
        range: impl RangeBounds<f64>,
    ) -> Result<(), Self> {
        if range.contains(&value) && value.is_finite() {
            return Ok(());
        }
        Err(Self {
            field,
            value,
            least: range.start_bound().cloned(),
            most: range.end_bound().cloned(),
        })
    }
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is {}; give a ", self.field, self.value)?;
        if let (Included(least), Included(most)) = (self.least, self.most) {
            return write!(f, "number from {} to {}", Short(least), Short(most));
        }
        f.write_str("finite number")?;
        match self.least {
            Included(least) => write!(f, ", at least {}", Short(least))?,
            Excluded(least) => write!(f, " above {}", Short(least))?,
            Unbounded => {}
        }
        match self.most {
            Included(most) => write!(f, ", at most {}", Short(most)),
            Excluded(most) => write!(f, ", below {}", Short(most)),
            Unbounded => Ok(()),
        }
    }
}

impl core::error::Error for OutOfRange {}

/// A bound in few letters: 0.5, but 1e-12.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.abs() {
            0.0 | 1e-5..1e16 => self.0.fmt(f),
            _ => fmt::LowerExp::fmt(&self.0, f),
        }
    }
}
