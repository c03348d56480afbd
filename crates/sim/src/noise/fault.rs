use thiserror::Error;

use super::{
    Bias, Bounded, Delay, Disturbance, DropOut, Gaussian, Outliers, Past, Quantization, Slip,
    Stuck, Values,
};
use crate::Draws;

/// Any of the disturbances, as a configuration names them.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// Noise without bias.
    Gaussian(Gaussian),
    /// A constant error.
    Bias(Bias),
    /// An error of which nothing but its bounds is known.
    Bounded(Bounded),
    /// Wheels that slip.
    Slip(Slip),
    /// A resolution.
    Quantization(Quantization),
    /// Readings that do not come.
    DropOut(DropOut),
    /// Numbers that have nothing to do with the truth.
    Outliers(Outliers),
    /// A sensor that gets stuck.
    Stuck(Stuck),
    /// Readings that come late.
    Delay(Delay),
}

impl Fault {
    /// Checks that every number of it has a sense.
    ///
    /// # Errors
    /// The first that has none.
    pub fn check(&self) -> Result<(), FaultError> {
        let positive = f64::MIN_POSITIVE..=f64::MAX;
        let (any, share, size) = (f64::MIN..=f64::MAX, 0.0..=1.0, 0.0..=f64::MAX);
        let parts = match *self {
            Self::Gaussian(Gaussian {
                relative_sd,
                absolute_sd,
            }) => {
                vec![
                    ("relative_sd", relative_sd, size.clone()),
                    ("absolute_sd", absolute_sd, size),
                ]
            }
            Self::Bias(Bias { scale, offset }) => {
                vec![("scale", scale, any.clone()), ("offset", offset, any)]
            }
            Self::Bounded(Bounded {
                share,
                offset,
                steps,
            }) => vec![
                ("share", share, size.clone()),
                ("offset", offset, size),
                ("steps", f64::from(steps), 1.0..=f64::from(u32::MAX)),
            ],
            Self::Slip(Slip { share: largest }) => vec![("share", largest, size)],
            Self::Quantization(Quantization { step }) => vec![("step", step, positive)],
            Self::DropOut(DropOut { probability }) | Self::Stuck(Stuck { probability, .. }) => {
                vec![("probability", probability, share)]
            }
            Self::Outliers(Outliers {
                probability,
                low,
                high,
            }) => vec![
                ("probability", probability, share),
                ("low", low, any),
                ("high", high, low..=f64::MAX),
            ],
            Self::Delay(Delay { steps }) => vec![("steps", f64::from(steps), 0.0..=1e6)],
        };
        match parts
            .into_iter()
            .find(|(_, value, range)| !range.contains(value))
        {
            None => Ok(()),
            Some((part, value, range)) => Err(FaultError {
                part,
                value,
                least: *range.start(),
                most: *range.end(),
            }),
        }
    }
}

impl<V: Values> Disturbance<V> for Fault {
    fn disturb(&self, value: &mut Option<V>, past: &mut Past<V>, draws: &mut Draws) {
        match self {
            Self::Gaussian(fault) => fault.disturb(value, past, draws),
            Self::Bias(fault) => fault.disturb(value, past, draws),
            Self::Bounded(fault) => fault.disturb(value, past, draws),
            Self::Slip(fault) => fault.disturb(value, past, draws),
            Self::Quantization(fault) => fault.disturb(value, past, draws),
            Self::DropOut(fault) => fault.disturb(value, past, draws),
            Self::Outliers(fault) => fault.disturb(value, past, draws),
            Self::Stuck(fault) => fault.disturb(value, past, draws),
            Self::Delay(fault) => fault.disturb(value, past, draws),
        }
    }
}

/// A number of a fault without sense.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the fault's `{part}` is {value}; give a number from {least:e} to {most:e}")]
pub struct FaultError {
    /// Which number.
    pub part: &'static str,
    /// What it is.
    pub value: f64,
    /// The least that has a sense.
    pub least: f64,
    /// The most.
    pub most: f64,
}
