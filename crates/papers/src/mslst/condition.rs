//! Deviations of a robot or its world from their usual state.

use tolman_arena::episode::{Lifted, random_start};
use tolman_arena::pioneer::{ENCODER_SD, body, with_sensor_noise};
use tolman_sim::DoorState;
use tolman_sim::noise::{Fault, Gaussian};
use tolman_sim::robots::{LaserPioneerConfig, StuckBeam};

use crate::venue::Venue;

/// Change while the better system drives. All but the last two conditions also hold while it
/// learns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Condition {
    AsJudged,
    NoNoise,
    Encoders,
    WithoutEncoders,
    Compass,
    CompassOff,
    BeamAside,
    BeamAhead,
    DropOuts,
    Motors,
    Lifted,
    DoorShut,
}

impl Condition {
    /// The conditions with the names of their rows.
    pub(super) const ALL: [(Self, &str); 12] = [
        (Self::AsJudged, "as judged"),
        (Self::NoNoise, "sensors without noise"),
        (Self::Encoders, "encoders 10 %"),
        (Self::WithoutEncoders, "without encoders"),
        (Self::Compass, "compass ± 3°"),
        (Self::CompassOff, "compass off by 10°"),
        (Self::BeamAside, "a stuck beam aside"),
        (Self::BeamAhead, "a stuck beam ahead"),
        (Self::DropOuts, "10 % drop-outs"),
        (Self::Motors, "doubled motor noise"),
        (Self::Lifted, "kidnapped"),
        (Self::DoorShut, "a door shut"),
    ];

    /// Returns the robot: with the noise that the better system is judged with, and with this
    /// condition's errors.
    pub(super) fn robot(self, calibrated: &LaserPioneerConfig) -> LaserPioneerConfig {
        let mut robot = with_sensor_noise(calibrated, ENCODER_SD);
        let faults = &mut robot.faults;
        let stuck = |beam| StuckBeam { beam, range: 0.4 };
        match self {
            Self::AsJudged | Self::Lifted | Self::DoorShut => {}
            Self::NoNoise => return calibrated.clone(),
            Self::Encoders => return with_sensor_noise(calibrated, 0.1),
            Self::WithoutEncoders => faults
                .odometry_distance
                .push(Fault::DropOut { probability: 1.0 }),
            Self::Compass => faults.compass.push(Fault::Bounded {
                share: 0.0,
                offset: 3_f64.to_radians(),
                steps: 1,
            }),
            Self::CompassOff => faults.compass.push(Fault::Bias {
                scale: 1.0,
                offset: 10_f64.to_radians(),
            }),
            Self::BeamAside => faults.stuck_beams.push(stuck(robot.ring.beams / 8)),
            Self::BeamAhead => faults.stuck_beams.push(stuck(0)),
            Self::DropOuts => {
                let missing = Fault::DropOut { probability: 0.1 };
                faults.scan.push(missing);
                faults.compass.push(missing);
                faults.odometry_distance.push(missing);
            }
            Self::Motors => {
                let noise = &mut robot.motor_noise;
                for gaussian in [&mut noise.turn, &mut noise.translate] {
                    *gaussian = Gaussian {
                        relative_sd: 2.0 * gaussian.relative_sd,
                        absolute_sd: 2.0 * gaussian.absolute_sd,
                    };
                }
                noise.drift_sd *= 2.0;
            }
        }
        robot
    }

    /// Returns the time of a lift and the pose where the robot is put down; `None` if the robot is
    /// not lifted.
    pub(super) fn lifted(self, venue: &Venue, seed: u64) -> Option<Lifted> {
        (self == Self::Lifted).then(|| Lifted {
            after: LIFTED_AFTER,
            to: random_start(&venue.course, &body(), seed),
        })
    }

    /// Returns the state of the door, which was open while the robot learned.
    pub(super) const fn door(self) -> DoorState {
        match self {
            Self::DoorShut => DoorState::Shut,
            _ => DoorState::Open,
        }
    }
}

/// Number of time steps after which a robot is lifted: about half of the way to the goal.
const LIFTED_AFTER: u32 = 30;
