use core::f64::consts::{FRAC_PI_2, PI};

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::Ring;

use crate::fields::Fields;

/// Range above which a beam has hit nothing, m.
pub(super) const NOTHING_HIT: f64 = 80.0;

/// Parameters of the front laser, from PARAM lines.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Parameters {
    /// Distance of the laser ahead of the robot's middle, m.
    offset: Option<f64>,
    /// Angle between two beams, degrees.
    spacing_deg: Option<f64>,
    /// Range from which a reading stands for "nothing seen", m.
    max_range: Option<f64>,
}

impl Parameters {
    /// Takes in a parameter line. Lines about other parameters are ignored.
    pub(crate) fn take(&mut self, fields: &mut Fields<'_>) {
        let (Ok(name), Ok(value)) = (fields.word("name"), fields.number("value")) else {
            return;
        };
        let known = match name {
            "robot_frontlaser_offset" => &mut self.offset,
            "laser_front_laser_resolution" => &mut self.spacing_deg,
            "robot_front_laser_max" | "robot_frontlaser_max" => &mut self.max_range,
            _ => return,
        };
        *known = Some(value);
    }

    /// Returns the geometry of the beams of a FLASER with this many ranges. They start at −90° and
    /// cover half a circle in whole or half degrees. So 180 beams are 1° apart like 181, and 360
    /// half a degree like 361.
    pub(crate) fn ring(&self, beams: u32) -> Ring {
        let even = beams - beams % 2;
        let usual = PI / f64::from(even.max(1));
        let said = self.spacing_deg.map(f64::to_radians);
        let fits = |spacing: &f64| (f64::from(even) * spacing - PI).abs() < 1.5 * usual;
        Ring {
            beams,
            first_bearing: -FRAC_PI_2,
            spacing: said.filter(fits).unwrap_or(usual),
            max_range: (self.max_range)
                .filter(|most| *most > 0.0)
                .map_or(NOTHING_HIT, |most| most.min(NOTHING_HIT)),
        }
    }

    /// Returns the pose of the laser on the robot, as far as it is told.
    pub(crate) fn mount(&self) -> Pose {
        Pose::new(Point::new(self.offset.unwrap_or(0.0), 0.0), Heading::EAST)
    }

    /// Returns the pose of the laser on the robot. It is that of the parameters if the two poses of
    /// a FLASER agree with it, otherwise the middle.
    pub(crate) fn robot_from_laser(&self, odometry: Pose, laser: Pose) -> Pose {
        let offset = self.mount();
        let off = odometry.compose(offset).between(laser);
        let agrees = off.position.coords.norm() < 0.01 && off.heading.radians().abs() < 0.01;
        if agrees { offset } else { Pose::IDENTITY }
    }
}
