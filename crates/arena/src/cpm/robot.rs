use core::f64::consts::TAU;

use tolman_control::epuck::{
    Alignment, ForwardConfig, KeepOffConfig, MeetPointConfig, PilotConfig, RangeCurve,
    RangeCurveError, SegmentConfig,
};
use tolman_quantizers::{Denoising, SoinnConfig};
use tolman_sim::robots::EpuckConfig;

use super::walker::{HeadingBy, WalkerConfig};

/// "The robot samples the sensor value … 100 times" (section 4.1).
const SAMPLES: u32 = 100;

/// A sweep at 4.83 rad/s, just below what the wheels can, takes one sample a step.
const STEP_US: u64 = 13_000;

/// The paper's e-puck, with the wheels of the real one, so that a sweep takes 1.3 s.
#[must_use]
pub fn epuck() -> EpuckConfig {
    EpuckConfig {
        step_us: STEP_US,
        ..EpuckConfig::cpm()
    }
}

/// The paper's e-puck as if its wheels could turn fast enough to sweep at "2π rad/s", in 1 s (section 4.1).
#[must_use]
pub fn idealized_epuck() -> EpuckConfig {
    EpuckConfig {
        step_us: 10_000,
        most_wheel_speed: 9.0,
        ..EpuckConfig::cpm()
    }
}

/// The paper's e-puck at the speed of the real one, which swept at 3π/5 rad/s, in 3.3 s (section 7).
#[must_use]
pub fn slow_epuck() -> EpuckConfig {
    EpuckConfig {
        step_us: 33_333,
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

/// The least turn that the simulated encoders tell, rad, which count no steps.
const EXACT: f64 = 1e-9;

/// How the paper's robot drives and observes in corridors of this width, m: a sample of a sweep a time step, so that the time step says how
/// fast it sweeps.
///
/// # Errors
/// If the response curve cannot be turned round.
pub fn walker_config(robot: &EpuckConfig, width: f64) -> Result<WalkerConfig, RangeCurveError> {
    let reach = libm::round(robot.response.reach() * 1e3) as u32;
    let millimetres = (0..=reach).map(|millimetre| f64::from(millimetre) * 1e-3);
    let points = millimetres.map(|range| (range, robot.response.at(range).value));
    Ok(WalkerConfig {
        pilot: PilotConfig {
            step_us: robot.step_us,
            samples: SAMPLES,
            sweep_speed: TAU / f64::from(SAMPLES) / (robot.step_us as f64 * 1e-6),
            most_wheel_speed: robot.most_wheel_speed,
            turn_tolerance: EXACT,
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

#[cfg(test)]
mod tests {
    use tolman_control::epuck::Pilot;
    use tolman_robot::Robot;

    use super::*;
    use crate::cpm::placed;

    #[test]
    fn sweeps_last_as_long_as_the_paper_says() {
        let maze = include_str!("../../mazes/cpm-1.maze");
        let maze = tolman_maze::read(maze).unwrap().maze;
        let sweep = |robot: &EpuckConfig| {
            let body = placed(&maze, 0.25, robot.clone(), 1).unwrap();
            let config = walker_config(robot, 0.25).unwrap();
            let mut pilot = Pilot::new(body, config.pilot);
            let samples = pilot.sweep().unwrap().samples().len();
            assert_eq!(samples, 100);
            pilot.robot().sensing().time_us
        };
        assert_eq!(sweep(&idealized_epuck()), 1_000_000);
        assert_eq!(sweep(&slow_epuck()), 3_333_300);
        assert_eq!(sweep(&epuck()), 1_300_000);
        // Real wheels cannot turn a whole sample in 10 ms.
        let too_fast = EpuckConfig {
            most_wheel_speed: epuck().most_wheel_speed,
            ..idealized_epuck()
        };
        assert_eq!(sweep(&too_fast), 2_000_000);
    }
}
