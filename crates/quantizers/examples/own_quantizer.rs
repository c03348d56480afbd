//! A quantizer of your own, which ignores inputs that lie far from all its units.

use core::error::Error;

use tolman_quantizers::{Events, Gng, GngConfig, InputError, NearestTwo, Network, Quantizer};

/// A growing neural gas that disregards outliers.
struct Wary {
    gas: Gng<f64>,
    /// Number of first inputs from which it learns without a check.
    trusting: u32,
    /// Maximum distance of an input from its nearest unit.
    limit: f64,
}

impl Quantizer<f64> for Wary {
    fn observe(&mut self, input: &[f64]) -> Result<NearestTwo<f64>, InputError> {
        if self.trusting == 0 && self.nearest(input)?.distance() > self.limit {
            return self.nearest_two(input);
        }
        self.trusting = self.trusting.saturating_sub(1);
        self.gas.observe(input)
    }

    fn network(&self) -> &Network<f64> {
        self.gas.network()
    }

    fn events(&mut self) -> &mut Events {
        self.gas.events()
    }
}

/// Trains on a line from 0 to 1 with a few inputs at 100, and returns the position of the farthest
/// unit.
fn farthest(quantizer: &mut impl Quantizer<f64>) -> Result<f64, Box<dyn Error>> {
    for step in 0..5000_u32 {
        let on_line = f64::from(step * 37 % 101) / 100.0;
        let is_outlier = step > 1000 && step % 50 == 0;
        quantizer.observe(&[if is_outlier { 100.0 } else { on_line }])?;
    }
    let network = quantizer.network();
    let units: Result<Vec<_>, _> = network.ids().map(|id| network.prototype(id)).collect();
    Ok(units?.into_iter().flatten().fold(0.0, f64::max))
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut config = GngConfig::default();
    config.max_units = 20;
    let mut wary = Wary {
        gas: Gng::new(1, config)?,
        trusting: 1000,
        limit: 1.0,
    };
    assert!(farthest(&mut wary)? < 1.1);
    assert!(farthest(&mut Gng::new(1, config)?)? > 10.0);
    Ok(())
}
