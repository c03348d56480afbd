//! Distances of inputs from their prototypes.

use super::Network;
use crate::{InputError, Scalar};

/// Distances of inputs from their nearest units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuantizationError {
    /// Mean of the squared distances (MSE).
    pub mean_squared: f64,
    /// Mean of the distances, in the unit of the features.
    pub mean: f64,
    /// Largest distance, in the unit of the features.
    pub largest: f64,
    /// Number of inputs measured.
    pub inputs: usize,
}

impl<S: Scalar> Network<S> {
    /// Returns the quantization error over a set of inputs, in the distance of the network.
    ///
    /// # Errors
    /// If an input is invalid, there are none, or the network has no units.
    ///
    /// # Complexity
    /// A search of the nearest unit for each input.
    pub fn quantization_error<I>(&self, inputs: I) -> Result<QuantizationError, InputError>
    where
        I: IntoIterator<Item: AsRef<[S]>>,
    {
        let (mut squares, mut distances, mut largest, mut count) = (0.0, 0.0, 0.0_f64, 0_usize);
        for input in inputs {
            let squared = self.nearest(input.as_ref())?.squared_distance.to_f64();
            let distance = libm::sqrt(squared);
            squares += squared;
            distances += distance;
            largest = largest.max(distance);
            count += 1;
        }
        if count == 0 {
            return Err(InputError::NoInputs);
        }
        Ok(QuantizationError {
            mean_squared: squares / count as f64,
            mean: distances / count as f64,
            largest,
            inputs: count,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_is_measured_from_the_nearest_unit() {
        let mut network = Network::<f64>::new(2).unwrap();
        for unit in [[0.0, 0.0], [10.0, 0.0]] {
            network.insert(&unit);
        }
        let inputs = [[0.0, 3.0], [10.0, -4.0], [6.0, 0.0], [0.0, 0.0], [1.0, 0.0]];
        let error = network.quantization_error(inputs).unwrap();
        let distances = [3.0_f64, 4.0, 4.0, 0.0, 1.0];
        let squares: f64 = distances.iter().map(|distance| distance * distance).sum();
        assert!((error.mean_squared - squares / 5.0).abs() < 1e-12);
        assert!((error.mean - distances.iter().sum::<f64>() / 5.0).abs() < 1e-12);
        assert!((error.largest - 4.0).abs() < 1e-12);
        assert_eq!(error.inputs, 5);
    }
}
