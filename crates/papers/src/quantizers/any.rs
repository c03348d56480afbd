//! The quantizers that tables compare.

use tolman_quantizers::{
    Gng, GngConfig, GrowthGate, Quantizer, Removal, Soinn, SoinnConfig, Utility,
};

use tolman_experiment::BoxError;

/// Rows of the tables that compare quantizers.
pub(super) const ROWS: [&str; 4] = ["GNG", "GNG-U", "equilibrium GNG", "SOINN"];

/// Returns one of [`ROWS`] for inputs of `dimension` features. GNG grows to `units`. The
/// equilibrium GNG grows until the mean error of its units is below `threshold`.
pub(super) fn quantizer(
    row: &str,
    dimension: usize,
    units: usize,
    threshold: f64,
) -> Result<Box<dyn Quantizer<f64>>, BoxError> {
    let mut fritzke = GngConfig::fritzke();
    fritzke.max_units = units;
    let mut useful = fritzke;
    useful.utility = Some(Utility {
        threshold: 10.0,
        removal: Removal::EveryInput,
    });
    let mut gated = GngConfig::fritzke();
    gated.gate = GrowthGate::MeanError { threshold };
    let gng = |config| Gng::new(dimension, config);
    Ok(match row {
        "GNG" => Box::new(gng(fritzke)?),
        "GNG-U" => Box::new(gng(useful)?),
        "equilibrium GNG" => Box::new(gng(gated)?),
        _ => Box::new(Soinn::new(dimension, SoinnConfig::noisy())?),
    })
}
