use core::f64::consts::{FRAC_PI_2, PI};

use tolman_geom::{OutOfRange, Pose};
use tolman_robot::pioneer_2dx;

use super::Sensor;
use super::cone::{Cone, ConeEcho};
use crate::noise::Gaussian;
use crate::{Chance, Channel, Draws, Surroundings, WallSegment};

/// Parameters of a robot's sonars.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct SonarConfig {
    /// Half-width of a sonar's cone, rad; above 0, below π/2.
    pub half_width: f64,
    /// Minimum reading, m; nearer things read as this.
    pub least: f64,
    /// Maximum reading, m; farther or unheard things read as this.
    pub most: f64,
    /// Noise of each range that was heard, m.
    pub noise: Gaussian,
    /// Echoes that never come back.
    pub misses: Misses,
    /// Echoes of other sonars.
    pub cross_talk: CrossTalk,
}

/// Echoes lost at walls that are hit at an angle. The probability that no echo comes back grows
/// linearly from 0 at `from` to `probability` at `to`, and stays there.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Misses {
    /// Angle of incidence below which no echo is missed, rad; 0 is head-on.
    pub from: f64,
    /// Angle of incidence above which the probability is constant, rad.
    pub to: f64,
    /// Probability that an echo is missed at that angle, 0 to 1.
    pub probability: f64,
}

/// Cross-talk: a sonar reads another one's echo if that comes sooner.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CrossTalk {
    /// Probability of cross-talk for each reading, 0 to 1.
    pub probability: f64,
    /// Number of groups of sonars that fire in turn. Sonars whose numbers differ by a multiple of
    /// this number fire at once. With 0 each sonar fires alone.
    pub slots: u32,
}

impl SonarConfig {
    /// Returns the Pioneer 2-DX's cones of 15° from 0.1 to 5 m, which hear the nearest thing in
    /// them exactly.
    #[must_use]
    pub const fn noiseless() -> Self {
        Self {
            half_width: pioneer_2dx::SONAR_HALF_WIDTH,
            least: pioneer_2dx::SONAR_LEAST,
            most: pioneer_2dx::SONAR_MOST,
            noise: Gaussian::NONE,
            misses: Misses {
                from: 0.0,
                to: 0.0,
                probability: 0.0,
            },
            cross_talk: CrossTalk {
                probability: 0.0,
                slots: 0,
            },
        }
    }

    /// Returns the same sonars with noise: 1 % and 5 mm. From 25° on echoes are missed, at 65° two
    /// in five. One reading in 200 is that of the sonar that fires at the same time at the robot's
    /// other end. The paper calls them noisy but gives no values (section 3.2).
    #[must_use]
    pub const fn noisy() -> Self {
        Self {
            noise: Gaussian {
                relative_sd: 0.01,
                absolute_sd: 0.005,
            },
            misses: Misses {
                from: 25.0 * PI / 180.0,
                to: 65.0 * PI / 180.0,
                probability: 0.4,
            },
            cross_talk: CrossTalk {
                probability: 0.005,
                slots: 8,
            },
            ..Self::noiseless()
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        let parts = [
            ("half_width", self.half_width, 1e-6, FRAC_PI_2 - 1e-6),
            ("least", self.least, 0.0, 1e3),
            ("most", self.most, self.least, 1e3),
            ("noise.relative_sd", self.noise.relative_sd, 0.0, 1e3),
            ("noise.absolute_sd", self.noise.absolute_sd, 0.0, 1e3),
            ("misses.from", self.misses.from, 0.0, FRAC_PI_2),
            ("misses.to", self.misses.to, self.misses.from, FRAC_PI_2),
            ("misses.probability", self.misses.probability, 0.0, 1.0),
            (
                "cross_talk.probability",
                self.cross_talk.probability,
                0.0,
                1.0,
            ),
        ];
        for (field, value, least, most) in parts {
            OutOfRange::check(field, value, least..=most)?;
        }
        Ok(())
    }
}

/// Sonars round the body. Each hears in a cone and reads the distance of the nearest point of any
/// wall, shut door or other robot within it. The geometry is exact, not a fan of rays.
///
/// An echo that is [missed](Misses) reads as nothing met, although something farther might have
/// been heard.
///
/// # Complexity
/// `N` times the walls within reach.
#[derive(Clone, Debug)]
pub struct Sonars<const N: usize> {
    /// Poses of the sonars in the robot's frame.
    mounts: [Pose; N],
    config: SonarConfig,
    /// Walls of the last reading, kept for their memory.
    near: Vec<WallSegment>,
}

impl<const N: usize> Sonars<N> {
    /// Returns sonars with the poses `mounts` in the robot's frame.
    ///
    /// # Errors
    /// If a number of the configuration is invalid.
    pub fn new(mounts: [Pose; N], config: SonarConfig) -> Result<Self, OutOfRange> {
        config.check()?;
        Ok(Self {
            mounts,
            config,
            near: Vec::new(),
        })
    }

    /// Returns the echo that each sonar would hear without faults, or `None` if it hears nothing.
    fn echoes(&mut self, around: &Surroundings<'_>) -> [Option<ConeEcho>; N] {
        let here = around.truth.pose;
        let spread = self.mounts.map(|mount| mount.position.coords.norm());
        let reach = self.config.most + spread.into_iter().fold(0.0, f64::max);
        around.standing_near(here.position, reach, &mut self.near);
        self.mounts.map(|mount| {
            let cone = Cone::new(here.compose(mount), self.config.half_width);
            cone.nearest(&self.near)
                .filter(|echo| echo.range < self.config.most)
        })
    }
}

impl<const N: usize> Sensor for Sonars<N> {
    type Reading = [f64; N];

    fn sense(
        &mut self,
        around: &Surroundings<'_>,
        chance: &Chance,
        reading: &mut Option<[f64; N]>,
    ) {
        let echoes = self.echoes(around);
        let config = &self.config;
        let mut draws = chance.draws(Channel::named("sonar misses"));
        let heard = echoes.map(|echo| config.misses.heard(echo, &mut draws));
        let mut draws = chance.draws(Channel::named("sonar cross-talk"));
        let taken = config.cross_talk.taken(&heard, &mut draws);
        let mut draws = chance.draws(Channel::named("sonar noise"));
        *reading = Some(taken.map(|range| match range {
            Some(range) => {
                let range = config.noise.around(range, &mut draws);
                range.clamp(config.least, config.most)
            }
            None => config.most,
        }));
    }
}

impl Misses {
    /// Returns the range of an echo that comes back.
    fn heard(&self, echo: Option<ConeEcho>, draws: &mut Draws) -> Option<f64> {
        let ConeEcho { range, incidence } = echo?;
        let beyond = incidence - self.from;
        if !(self.probability > 0.0 && beyond > 0.0) {
            return Some(range);
        }
        let share = (beyond / (self.to - self.from)).min(1.0);
        (draws.uniform() >= self.probability * share).then_some(range)
    }
}

impl CrossTalk {
    /// Returns the range that each sonar reports, which may be another sonar's echo.
    fn taken<const N: usize>(
        &self,
        heard: &[Option<f64>; N],
        draws: &mut Draws,
    ) -> [Option<f64>; N] {
        let slots = self.slots as usize;
        core::array::from_fn(|own| {
            if !(self.probability > 0.0 && slots > 0 && draws.uniform() < self.probability) {
                return heard[own];
            }
            let at_once = (own % slots..N).step_by(slots);
            at_once
                .filter_map(|sonar| heard[sonar])
                .min_by(f64::total_cmp)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_aslant_is_missed_the_more_the_more_it_is_aslant() {
        let misses = SonarConfig::noisy().misses;
        let mut draws = Chance::of_run(1).draws(Channel::named("test"));
        let mut share = |degrees: f64| {
            let incidence = degrees.to_radians();
            let echo = Some(ConeEcho {
                range: 1.0,
                incidence,
            });
            let missed = (0..5000).filter(|_| misses.heard(echo, &mut draws).is_none());
            missed.count() as f64 / 5000.0
        };
        assert!(share(20.0) < 1e-9);
        assert!((share(45.0) - 0.2).abs() < 0.03);
        assert!((share(65.0) - 0.4).abs() < 0.03);
        assert!((share(85.0) - 0.4).abs() < 0.03);
    }

    #[test]
    fn cross_talk_takes_the_sooner_echo_of_those_that_fire_at_once() {
        let always = CrossTalk {
            probability: 1.0,
            slots: 2,
        };
        let mut draws = Chance::of_run(1).draws(Channel::named("test"));
        let taken = always.taken(&[Some(2.0), Some(0.1), Some(1.0), None], &mut draws);
        assert_eq!(taken, [Some(1.0), Some(0.1), Some(1.0), Some(0.1)]);
    }

    #[test]
    fn numbers_without_sense_are_named() {
        let mut config = SonarConfig::noisy();
        config.half_width = 0.0;
        let error = Sonars::new([Pose::IDENTITY], config).unwrap_err();
        assert_eq!(error.field, "half_width");
        let mut config = SonarConfig::noisy();
        config.misses.to = 0.1;
        let error = Sonars::new([Pose::IDENTITY], config).unwrap_err();
        assert_eq!(error.field, "misses.to");
    }
}
