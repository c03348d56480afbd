use thiserror::Error;
use tolman_quantizers::{Gng, GngConfig, InputError, Quantizer, QuantizerConfigError};

/// Reason why states cannot be learned.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StatesError {
    /// There are no scans.
    #[error("no time step had both a scan and a heading: check ranges and compass")]
    NoScans,
    /// The quantizer cannot begin.
    #[error("no states can be made; correct the configuration of the GNG")]
    Config(#[from] QuantizerConfigError),
    /// A scan cannot be used.
    #[error("scan {scan} cannot be used; leave it out")]
    Scan {
        /// Number of the scan, from 0.
        scan: usize,
        /// The underlying error.
        source: InputError,
    },
}

/// The states that Phase I learned: model scans, numbered from 0 in the order in which the GNG made
/// them.
#[derive(Clone, Debug)]
pub struct States {
    models: Vec<Vec<f64>>,
    /// Holds the models and learns no more.
    quantizer: Gng<f64>,
}

impl States {
    /// Learns the states: "We then ran equilibrium GNG on the sensor data to categorize these
    /// vectors into discrete states." The scans are shown once, in the order they were recorded.
    ///
    /// # Errors
    /// If there are no scans, their lengths differ, or one holds NaN.
    pub fn learn(scans: &[Vec<f64>], threshold: f64) -> Result<Self, StatesError> {
        let beams = scans.first().ok_or(StatesError::NoScans)?.len();
        let mut gng = Gng::new(beams, GngConfig::mslst(threshold))?;
        for (index, scan) in scans.iter().enumerate() {
            gng.observe(scan).map_err(|source| StatesError::Scan {
                scan: index,
                source,
            })?;
        }
        let network = gng.network();
        let prototypes = network.ids().filter_map(|id| network.prototype(id).ok());
        Self::from_models(prototypes.map(Iterator::collect).collect())
    }

    /// Returns states that were learned before.
    ///
    /// # Errors
    /// If there are fewer than two, they differ in length, or one holds a value that is not a
    /// number.
    pub fn from_models(models: Vec<Vec<f64>>) -> Result<Self, StatesError> {
        let beams = models.first().map_or(0, Vec::len);
        let mut quantizer = Gng::new(beams, GngConfig::fritzke())?;
        quantizer.begin_with(&models)?;
        Ok(Self { models, quantizer })
    }

    /// Returns "the number of the GNG state that most closely matches the current input vector";
    /// ties go to the lower number.
    ///
    /// # Errors
    /// If the scan's length differs from the models', or a value is not a number.
    pub fn nearest(&self, scan: &[f64]) -> Result<u32, InputError> {
        Ok(self.quantizer.nearest(scan)?.id.0)
    }

    /// Returns the model scans, robot units, beam 0 to the north.
    #[must_use]
    pub fn models(&self) -> &[Vec<f64>] {
        &self.models
    }
}
