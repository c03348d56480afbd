use alloc::collections::VecDeque;
use core::ops::Bound::{Included, Unbounded};

use thiserror::Error;
use tolman_geom::OutOfRange;

use super::{Gaussian, Values};
use crate::Draws;

/// A fault of a sensor or motor, as a configuration names it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Fault {
    /// Noise without bias.
    Gaussian(Gaussian),
    /// A constant error: `scale · value + offset`.
    Bias {
        /// Factor of the value; 1 for none.
        scale: f64,
        /// Offset added after scaling, in the value's own unit.
        offset: f64,
    },
    /// An error of which only the bounds are known: `(1 + a) · value + b`, `a` uniform in ± `share`
    /// and `b` in ± `offset`. It is drawn again after every `steps` readings, and is the same for
    /// all numbers of a reading.
    ///
    /// Unlike those of [`Slip`](Self::Slip), these errors do not average out while they hold. With
    /// many steps they are a constant calibration error.
    Bounded {
        /// The largest share gained or lost.
        share: f64,
        /// Largest amount gained or lost, in the value's own unit.
        offset: f64,
        /// Number of readings for which one draw holds, at least 1.
        steps: u32,
    },
    /// An error beyond all bounds, now and then: the value times 1 ± `share`, drawn again after
    /// every `steps` readings.
    Lapse {
        /// Probability that a draw is such an error, 0 to 1.
        probability: f64,
        /// The share gained or lost.
        share: f64,
        /// Number of readings for which one draw holds, at least 1.
        steps: u32,
    },
    /// A gyro that drifts: after n readings the value is `rate` · n too large, or too small, drawn
    /// once.
    Drift {
        /// Growth of the error with every reading, in the value's own unit.
        rate: f64,
    },
    /// Wheels that slip: the value times a factor uniform in 1 ± `share`, as Webots has it.
    Slip {
        /// The largest share gained or lost.
        share: f64,
    },
    /// A resolution: every number is rounded to the nearest multiple of `step`, halves away from 0.
    Quantization {
        /// The resolution, in the value's own unit.
        step: f64,
    },
    /// Readings that do not come.
    DropOut {
        /// Probability that a reading is missing, 0 to 1.
        probability: f64,
    },
    /// Numbers unrelated to the truth: uniform between `low` and `high`.
    Outliers {
        /// Probability that a number is an outlier, 0 to 1.
        probability: f64,
        /// Least outlier, in the value's own unit.
        low: f64,
        /// The greatest, in the value's own unit.
        high: f64,
    },
    /// A sensor that sometimes gets stuck and repeats its reading.
    Stuck {
        /// Probability that the sensor gets stuck at a reading, 0 to 1.
        probability: f64,
        /// Number of readings that the sensor repeats before it comes free.
        steps: u32,
    },
    /// Readings that come late. Before the first has arrived, readings are missing.
    Delay {
        /// Delay, time steps.
        steps: u32,
    },
}

impl Fault {
    /// Checks the range of every number.
    ///
    /// # Errors
    /// [`OutOfRange`] names the first number out of its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let (any, size) = ((Unbounded, Unbounded), (Included(0.0), Unbounded));
        let count = (Included(1.0), Unbounded);
        let probable = |probability| ("probability", probability, (Included(0.0), Included(1.0)));
        let parts = match *self {
            Self::Gaussian(noise) => vec![
                ("relative_sd", noise.relative_sd, size),
                ("absolute_sd", noise.absolute_sd, size),
            ],
            Self::Bias { scale, offset } => {
                vec![("scale", scale, any), ("offset", offset, any)]
            }
            Self::Bounded {
                share,
                offset,
                steps,
            } => vec![
                ("share", share, size),
                ("offset", offset, size),
                ("steps", f64::from(steps), count),
            ],
            Self::Lapse {
                probability,
                share,
                steps,
            } => vec![
                probable(probability),
                ("share", share, size),
                ("steps", f64::from(steps), count),
            ],
            Self::Drift { rate } => vec![("rate", rate, size)],
            Self::Slip { share } => vec![("share", share, size)],
            Self::Quantization { step } => {
                vec![("step", step, (Included(f64::MIN_POSITIVE), Unbounded))]
            }
            Self::DropOut { probability } | Self::Stuck { probability, .. } => {
                vec![probable(probability)]
            }
            Self::Outliers {
                probability,
                low,
                high,
            } => vec![
                probable(probability),
                ("low", low, any),
                ("high", high, (Included(low), Unbounded)),
            ],
            Self::Delay { steps } => {
                vec![("steps", f64::from(steps), (Included(0.0), Included(1e6)))]
            }
        };
        for (part, value, range) in parts {
            OutOfRange::check(part, value, range)?;
        }
        Ok(())
    }

    /// Checks the faults of one value, which the configuration calls `field`.
    pub(crate) fn check_all(field: &'static str, faults: &[Self]) -> Result<(), FaultsError> {
        for (index, fault) in faults.iter().enumerate() {
            fault.check().map_err(|source| FaultsError {
                field,
                index,
                source,
            })?;
        }
        Ok(())
    }

    /// Changes `value`, or takes it away.
    pub(super) fn disturb<V: Values>(
        &self,
        value: &mut Option<V>,
        past: &mut Past<V>,
        draws: &mut Draws,
    ) {
        match *self {
            Self::Gaussian(noise) if noise == Gaussian::NONE => {}
            Self::Gaussian(noise) => value.change(|number| noise.around(number, draws)),
            Self::Bias { scale, offset } => value.change(|number| scale * number + offset),
            Self::Bounded {
                share,
                offset,
                steps,
            } => {
                let [a, b] = past.drawn(steps, draws);
                value.change(|number| number * (1.0 + share * a) + offset * b);
            }
            Self::Lapse {
                probability,
                share,
                steps,
            } => {
                let [a, b] = past.drawn(steps, draws);
                if 0.5 * (b + 1.0) < probability {
                    value.change(|number| number * (1.0 + share.copysign(a)));
                }
            }
            Self::Drift { rate } => {
                let [sign, _] = past.drawn(u32::MAX, draws);
                let error = rate.copysign(sign) * f64::from(u32::MAX - past.steps_left);
                value.change(|number| number + error);
            }
            Self::Slip { share } => {
                value.change(|number| number * (1.0 + share * (2.0 * draws.uniform() - 1.0)));
            }
            Self::Quantization { step } => value.change(|number| (number / step).round() * step),
            Self::Outliers {
                probability,
                low,
                high,
            } => value.change(|number| {
                let (chance, place) = (draws.uniform(), draws.uniform());
                if chance < probability {
                    low + place * (high - low)
                } else {
                    number
                }
            }),
            Self::DropOut { probability } => {
                if draws.uniform() < probability {
                    *value = None;
                }
            }
            Self::Stuck { probability, steps } => {
                past.stick(value, draws.uniform() < probability, steps);
            }
            Self::Delay { steps } => past.delay(value, steps),
        }
    }
}

/// Memory of a fault between readings; empty before the first.
#[derive(Clone, Debug)]
pub(super) struct Past<V> {
    /// Earlier values, the oldest first.
    values: VecDeque<Option<V>>,
    /// Number of readings for which the present fault still lasts.
    steps_left: u32,
    /// Numbers drawn for that many readings.
    drawn: [f64; 2],
}

impl<V> Default for Past<V> {
    fn default() -> Self {
        Self {
            values: VecDeque::new(),
            steps_left: 0,
            drawn: [0.0; 2],
        }
    }
}

impl<V: Values> Past<V> {
    /// Returns two numbers uniform in ± 1, which hold for `steps` readings.
    fn drawn(&mut self, steps: u32, draws: &mut Draws) -> [f64; 2] {
        if self.steps_left == 0 {
            self.drawn = [draws.uniform(), draws.uniform()].map(|draw| 2.0 * draw - 1.0);
            self.steps_left = steps;
        }
        self.steps_left = self.steps_left.saturating_sub(1);
        self.drawn
    }

    /// Repeats the reading at which a sensor is stuck, or lets it get stuck at this one for `steps`
    /// readings.
    fn stick(&mut self, value: &mut Option<V>, gets_stuck: bool, steps: u32) {
        if self.steps_left > 0 {
            self.steps_left -= 1;
            if let Some(held) = self.values.front() {
                value.clone_from(held);
            }
        } else if gets_stuck {
            self.steps_left = steps;
            self.values.clear();
            self.values.push_front(value.clone());
        }
    }

    /// Replaces this reading by the one `steps` steps before.
    fn delay(&mut self, value: &mut Option<V>, steps: u32) {
        self.values.push_back(value.take());
        if self.values.len() > steps as usize {
            *value = self.values.pop_front().flatten();
        }
    }
}

/// A fault without sense in a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("`{field}`, fault {index}: {source}")]
pub struct FaultsError {
    /// Name of the field.
    pub field: &'static str,
    /// Number of the fault, from 0.
    pub index: usize,
    /// Fault of the configuration.
    pub source: OutOfRange,
}
