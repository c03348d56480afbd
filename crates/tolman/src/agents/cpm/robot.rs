use core::f64::consts::TAU;

use tolman_control::epuck::{
    Alignment, ForwardConfig, KeepOffConfig, MeetPointConfig, PilotConfig, RangeCurve,
    RangeCurveError, SegmentConfig,
};
use tolman_quantizers::{Denoising, SoinnConfig};
use tolman_sim::robots::EpuckConfig;
use tolman_sim::sensors::ResponseCurve;

use super::walker::{HeadingBy, WalkerConfig};

/// A sweep of 100 samples at 4.83 rad/s takes one sample a step.
const STEP_US: u64 = 13_000;

/// The paper's e-puck.
#[must_use]
pub fn epuck() -> EpuckConfig {
    EpuckConfig {
        step_us: STEP_US,
        ..EpuckConfig::cpm()
    }
}

/// SOINN as in the paper, λ = age_dead = 20; no unit with a neighbour counts as noise.
#[must_use]
pub fn soinn() -> SoinnConfig {
    SoinnConfig {
        denoising: Denoising::FewWins { c: 0.0 },
        ..SoinnConfig::cpm()
    }
}

/// How the paper's robot drives and observes in corridors of this width, m.
///
/// # Errors
/// If the response curve cannot be turned round; it can.
pub fn walker_config(width: f64) -> Result<WalkerConfig, RangeCurveError> {
    let response = ResponseCurve::cpm();
    let millimetres = (0..=250).map(|millimetre| f64::from(millimetre) * 1e-3);
    let points = millimetres.map(|range| (range, response.at(range).value));
    Ok(WalkerConfig {
        pilot: PilotConfig {
            step_us: STEP_US,
            samples: 100,
            sweep_speed: TAU / 100.0 / (STEP_US as f64 * 1e-6),
            curve: RangeCurve::new(points.collect())?,
            forward: ForwardConfig::for_width(width),
            keep_off: KeepOffConfig::ours(),
        },
        alignment: Alignment::Mounts,
        segments: SegmentConfig::cut(),
        features: SegmentConfig::joined(),
        meet_point: MeetPointConfig::for_width(width),
        corridor_width: width,
        stride_s: 0.5,
        heading: HeadingBy::Encoders,
        longest_fragment: 2000,
    })
}
