use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::wrong;

/// The parameters of an estimator by name, as Python passes them.
pub(crate) struct Params<'a, 'py>(pub(crate) &'a Bound<'py, PyDict>);

impl Params<'_, '_> {
    /// Returns a number, or `None` if Python passes `None` or nothing.
    pub(crate) fn optional(&self, name: &str) -> PyResult<Option<f64>> {
        let Some(value) = self.0.get_item(name)?.filter(|value| !value.is_none()) else {
            return Ok(None);
        };
        match value.extract::<f64>() {
            Ok(number) => Ok(Some(number)),
            Err(_) => Err(self.refused(name, "a number")),
        }
    }

    /// Returns a number.
    pub(crate) fn number(&self, name: &str) -> PyResult<f64> {
        let number = self.optional(name)?;
        number.ok_or_else(|| self.refused(name, "a number"))
    }

    /// Returns a whole number from 0 to 2³² − 1, or `None` as [`Self::optional`] does.
    pub(crate) fn optional_count(&self, name: &str) -> PyResult<Option<u32>> {
        let Some(number) = self.optional(name)? else {
            return Ok(None);
        };
        let is_count = number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number);
        match is_count {
            true => Ok(Some(number as u32)),
            false => Err(self.refused(name, "a whole number from 0 to 4294967295")),
        }
    }

    /// Returns a whole number from 0 to 2³² − 1.
    pub(crate) fn count(&self, name: &str) -> PyResult<u32> {
        let count = self.optional_count(name)?;
        count.ok_or_else(|| self.refused(name, "a whole number"))
    }

    /// Returns the value of the name that Python passes.
    pub(crate) fn choice<T: Copy>(&self, name: &str, known: &[(&str, T)]) -> PyResult<T> {
        let value = self.0.get_item(name)?;
        let text = value.and_then(|value| value.extract::<String>().ok());
        let found = known
            .iter()
            .find(|(known, _)| Some(*known) == text.as_deref());
        found.map(|(_, choice)| *choice).ok_or_else(|| {
            let names: Vec<String> = known.iter().map(|(name, _)| format!("'{name}'")).collect();
            self.refused(name, &format!("one of {}", names.join(", ")))
        })
    }

    /// Returns whether Python passes something else than `None`.
    pub(crate) fn is_given(&self, name: &str) -> PyResult<bool> {
        let value = self.0.get_item(name)?;
        Ok(value.is_some_and(|value| !value.is_none()))
    }

    fn refused(&self, name: &str, range: &str) -> PyErr {
        let value = self.0.get_item(name).ok().flatten();
        let shown = value.and_then(|value| Some(value.repr().ok()?.to_string()));
        let shown = shown.unwrap_or_else(|| "missing".to_owned());
        wrong(format!("{name} is {shown} but has to be {range}"))
    }
}
