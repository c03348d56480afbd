use tolman_geom::{Point, Twist};

use super::Echoes;

/// Layer 1: drives forward along the path (section 3.2), in the middle of the corridor and round
/// its bends.
///
/// It keeps to the middle between the walls beside it, or at half a corridor's width from the one
/// it sees. Where it does not see along a wall, as beside a fork, it uses its turn since it last
/// did. Where a wall stands across the way, it turns in place to the side with more room. It keeps
/// to that side until the way ahead is free. It does not handle junctions; layer 3 does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forward {
    config: ForwardConfig,
    /// Side of the bend that the robot is turning in.
    bend: Option<Side>,
    /// Direction of the way in the robot's frame, rad: that of the walls when it last saw along
    /// one, corrected by the robot's turn since.
    way: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// The gains of layer 1. The paper gives none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct ForwardConfig {
    /// Speed of driving, m/s.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub speed: f64,
    /// Turn rate in a bend, rad/s.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub turn: f64,
    /// Half the width of a corridor, m.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub half_width: f64,
    /// Turn for a metre off the middle, rad/s.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_zero")
    )]
    pub to_middle: f64,
    /// Turn for a radian off the direction of the walls, rad/s.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_zero")
    )]
    pub along: f64,
}

impl ForwardConfig {
    /// Returns the values for corridors `width` wide, m. The speed is 4.5 cm/s, so that half a
    /// second takes the robot on by 2 cm. The gains bring the robot back to the middle without a
    /// swing.
    #[must_use]
    pub const fn for_width(width: f64) -> Self {
        Self {
            speed: 0.045,
            turn: 3.0,
            half_width: width / 2.0,
            to_middle: 30.0,
            along: 4.0,
        }
    }
}

/// A wall beside the robot.
#[derive(Clone, Copy, Debug)]
struct Beside {
    /// Distance of the wall from the robot's middle, m.
    distance: f64,
    /// Direction of the wall in the robot's frame, rad, or `None` if only one sensor sees it.
    angle: Option<f64>,
}

impl Forward {
    /// Returns a layer 1 at rest.
    #[must_use]
    pub const fn new(config: ForwardConfig) -> Self {
        Self {
            config,
            bend: None,
            way: 0.0,
        }
    }

    /// Tells the layer that the robot was turned to look along a way.
    pub const fn look_along(&mut self) {
        self.way = 0.0;
    }

    /// Tells the layer that the robot has turned by `radians`, rad, counter-clockwise, since the
    /// last [proposal](Self::propose).
    pub const fn turned(&mut self, radians: f64) {
        self.way -= radians;
    }

    /// Returns the twist that this layer proposes now.
    pub fn propose(&mut self, echoes: &Echoes) -> Twist {
        let (left, right) = (self.beside(echoes, 5, 6), self.beside(echoes, 2, 1));
        let ahead = echoes.ahead().unwrap_or(f64::INFINITY);
        // In the middle of a bend the wall across the way is half a width ahead.
        let is_blocked = ahead < self.config.half_width;
        self.bend = match self.bend {
            // The bend is complete when the way is free, the wall that was ahead is beside the
            // robot, and the robot looks along the way.
            Some(side) => {
                let outer = match side {
                    Side::Left => right,
                    Side::Right => left,
                };
                let angle = outer.and_then(|wall| wall.angle);
                let is_free = ahead > 1.6 * self.config.half_width;
                let is_round = is_free && angle.is_none_or(|angle| angle.abs() < 0.1);
                (!is_round).then_some(side)
            }
            None if is_blocked => {
                let room =
                    |beside: Option<Beside>| beside.map_or(f64::INFINITY, |beside| beside.distance);
                Some(if room(left) >= room(right) {
                    Side::Left
                } else {
                    Side::Right
                })
            }
            None => None,
        };
        if self.bend.is_some() {
            // A bend ends where the robot looks along the way again.
            self.look_along();
        }
        match self.bend {
            Some(Side::Left) => Twist::new(0.0, self.config.turn),
            Some(Side::Right) => Twist::new(0.0, -self.config.turn),
            None => self.keep_to_the_middle(left, right),
        }
    }

    fn keep_to_the_middle(&mut self, left: Option<Beside>, right: Option<Beside>) -> Twist {
        let half = self.config.half_width;
        // Positive: there is more room on the left.
        let off = match (left, right) {
            (Some(left), Some(right)) => (left.distance - right.distance) / 2.0,
            (Some(left), None) => left.distance - half,
            (None, Some(right)) => half - right.distance,
            (None, None) => 0.0,
        };
        let angles = [left, right].map(|beside| beside.and_then(|beside| beside.angle));
        let (sum, count) = angles
            .into_iter()
            .flatten()
            .fold((0.0, 0.0), |(sum, count), angle| (sum + angle, count + 1.0));
        // A wall that ends ahead says how far off the middle the robot is, but not where it heads.
        // What is turned by that alone swings, and turned robots into the ways of forks.
        if count > 0.0 {
            self.way = sum / count;
        }
        let turn = self.config.to_middle * off.clamp(-0.03, 0.03) + self.config.along * self.way;
        Twist::new(
            self.config.speed,
            turn.clamp(-self.config.turn, self.config.turn),
        )
    }

    /// Returns the wall beside, by the sensor that looks straight aside and the one half ahead of
    /// it.
    fn beside(&self, echoes: &Echoes, aside: usize, half_ahead: usize) -> Option<Beside> {
        let near = |point: &Point| point.y.abs() < self.config.half_width * 1.6;
        let aside = echoes.of_sensor(aside).filter(near)?;
        let along = echoes.of_sensor(half_ahead).map(|point| point - aside);
        // Seen too steeply, it is a wall across the way, or a far one.
        let angle = along
            .map(|along| libm::atan2(along.y, along.x))
            .filter(|angle| angle.abs() < 0.6);
        let distance = aside.y.abs() * libm::cos(angle.unwrap_or(0.0));
        Some(Beside { distance, angle })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::epuck::RangeCurve;
    use tolman_robot::epuck::proximity_mounts;

    const WIDTH: f64 = 0.25;

    /// Returns the echoes 3 cm right of a corridor's middle, where the wall on the left ends
    /// `ahead`, m.
    fn beside_a_wall(ahead: f64) -> Echoes {
        let curve = RangeCurve::new(alloc::vec![(0.0, 1.0), (0.25, 0.0)]).unwrap();
        let to_wall = WIDTH / 2.0 + 0.03;
        let mut values = [0.0; 8];
        for (mount, value) in proximity_mounts().iter().zip(&mut values) {
            let (position, way) = (mount.position, mount.heading.unit());
            let range = (to_wall - position.y) / way.y;
            if range > 0.0 && position.x + range * way.x < ahead {
                *value = (1.0 - range / curve.reach()).max(0.0);
            }
        }
        Echoes::of(&values, &curve)
    }

    #[test]
    fn along_a_wall_it_turns_to_the_middle() {
        let mut forward = Forward::new(ForwardConfig::for_width(WIDTH));
        let twist = forward.propose(&beside_a_wall(1.0));
        assert!(twist.linear > 0.0 && twist.angular > 0.5, "{twist:?}");
    }

    #[test]
    fn where_the_wall_ends_it_does_not_swing() {
        const STEP_S: f64 = 0.01;
        let config = ForwardConfig::for_width(WIDTH);
        let mut forward = Forward::new(config);
        let echoes = beside_a_wall(0.05);
        let mut heading = 0.0;
        for _ in 0..300 {
            let twist = forward.propose(&echoes);
            assert!(twist.linear > 0.0);
            heading += twist.angular * STEP_S;
            forward.turned(twist.angular * STEP_S);
        }
        // The robot leaves the middle by 3 cm at most.
        let most = config.to_middle * 0.03 / config.along;
        assert!((0.9 * most..=most).contains(&heading), "{heading}");
        forward.look_along();
        assert!(forward.propose(&echoes).angular > 0.5);
    }
}
