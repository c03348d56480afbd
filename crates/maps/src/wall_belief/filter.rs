use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::{FRAC_PI_2, TAU};

use rand::{Rng, RngExt};
use tolman_geom::{Heading, OutOfRange, POSITIVE, Point, Pose, Vector};
use tolman_maze::Knowledge;

use super::{RangeModel, RangeReading, WallBelief};

/// Parameters of a [`PoseFilter`]: the error model of wheels and sensors.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PoseFilterConfig {
    /// Number of particles, at least 1.
    pub particles: u32,
    /// Standard deviation of a distance or a turn, as a share of it. ≥ 0.
    pub slip: f64,
    /// Standard deviation of the turn that was not commanded, rad per metre. ≥ 0.
    pub drift: f64,
    /// Standard deviation added to a particle's position in every step, m, to keep particles apart.
    /// ≥ 0.
    pub spread: f64,
    /// Error model of the range sensors.
    pub sensor: RangeModel,
}

impl PoseFilterConfig {
    /// Returns the values for cells `pitch` m apart, and wheels and range sensors that err by a few
    /// percent.
    #[must_use]
    pub const fn for_pitch(pitch: f64) -> Self {
        Self {
            particles: 200,
            slip: 0.05,
            drift: 0.05,
            spread: 0.01 * pitch,
            sensor: RangeModel {
                absolute: 0.05 * pitch,
                relative: 0.03,
                outliers: 0.1,
            },
        }
    }
}

/// The mouse's pose as a cloud of particles: Monte Carlo localization (Probabilistic robotics,
/// table 8.2). The low variance sampler of table 4.4 runs when the effective number of particles
/// falls below half.
///
/// A ray is expected to end at any wall that may stand on its way ([`WallBelief::meetings`]); an
/// unknown one stops it as often as not.
#[derive(Clone, Debug)]
pub struct PoseFilter {
    config: PoseFilterConfig,
    particles: Vec<Particle>,
}

#[derive(Clone, Copy, Debug)]
struct Particle {
    pose: Pose,
    weight: f64,
}

impl PoseFilter {
    /// Returns a filter with all particles at `pose`.
    ///
    /// # Errors
    /// If a number of the configuration is out of its range.
    pub fn new(config: PoseFilterConfig, pose: Pose) -> Result<Self, OutOfRange> {
        let sensor = config.sensor;
        OutOfRange::check("particles", config.particles.into(), POSITIVE)?;
        OutOfRange::check("slip", config.slip, 0.0..)?;
        OutOfRange::check("drift", config.drift, 0.0..)?;
        OutOfRange::check("spread", config.spread, 0.0..)?;
        OutOfRange::check("sensor.absolute", sensor.absolute, POSITIVE)?;
        OutOfRange::check("sensor.relative", sensor.relative, 0.0..)?;
        OutOfRange::check("sensor.outliers", sensor.outliers, 0.0..=1.0)?;
        let weight = 1.0 / f64::from(config.particles);
        Ok(Self {
            config,
            particles: vec![Particle { pose, weight }; config.particles as usize],
        })
    }

    /// Puts all particles at `pose`, to which the mouse was carried.
    pub fn place(&mut self, pose: Pose) {
        let weight = 1.0 / self.particles.len() as f64;
        self.particles.fill(Particle { pose, weight });
    }

    /// Puts a particle at each of `poses`, to one of which the mouse was carried. Nothing happens
    /// without poses.
    ///
    /// The number of particles does not change until the next call of [`gather`](Self::gather),
    /// which is for when they agree.
    pub fn spread(&mut self, poses: impl IntoIterator<Item = Pose>) {
        let poses: Vec<Pose> = poses.into_iter().collect();
        let weight = 1.0 / poses.len() as f64;
        let particle = |pose| Particle { pose, weight };
        if !poses.is_empty() {
            self.particles = poses.into_iter().map(particle).collect();
        }
    }

    /// Draws the configured number of particles from the present ones. O(particles).
    pub fn gather(&mut self, rng: &mut impl Rng) {
        self.draw(self.config.particles as usize, rng);
    }

    /// Moves the particles like a mouse that was commanded to drive `distance`, m, and meanwhile to
    /// turn by `turn`, rad, counter-clockwise. O(particles).
    pub fn drive(&mut self, distance: f64, turn: f64, rng: &mut impl Rng) {
        let config = self.config;
        for particle in &mut self.particles {
            let [a, b] = gaussians(rng);
            let [c, d] = gaussians(rng);
            let [e, _] = gaussians(rng);
            let made = distance * (1.0 + config.slip * a);
            let turned = turn * (1.0 + config.slip * b) + config.drift * distance.abs() * e;
            let mut pose = particle.pose.displaced(made, turned);
            pose.position += Vector::new(c, d) * config.spread;
            particle.pose = pose;
        }
    }

    /// Weighs every particle by the sensors' readings. O(particles · readings · cells along a ray).
    pub fn sense<const N: usize>(
        &mut self,
        walls: &WallBelief<N>,
        readings: &[RangeReading],
        rng: &mut impl Rng,
    ) {
        for reading in readings {
            let nothing = self.config.sensor.density(reading.range, reading.max_range);
            for particle in &mut self.particles {
                particle.weight *=
                    likelihood(&self.config.sensor, walls, particle.pose, *reading, nothing);
            }
        }
        let sum: f64 = self.particles.iter().map(|particle| particle.weight).sum();
        let even = 1.0 / self.particles.len() as f64;
        // If no particle fits, all get the same weight: a sum of 0 would make them NaN.
        let usable = sum.is_normal();
        for particle in &mut self.particles {
            particle.weight = if usable { particle.weight / sum } else { even };
        }
        let squares: f64 = self.particles.iter().map(|p| p.weight * p.weight).sum();
        if 2.0 < even.recip() * squares {
            self.draw(self.particles.len(), rng);
        }
    }

    /// Draws `count` particles, each by its weight.
    fn draw(&mut self, count: usize, rng: &mut impl Rng) {
        let even = 1.0 / count as f64;
        let mut mark = uniform(rng) * even;
        let mut sum = 0.0;
        let mut drawn = Vec::with_capacity(count);
        for particle in &self.particles {
            sum += particle.weight;
            while mark < sum && drawn.len() < count {
                drawn.push(Particle {
                    pose: particle.pose,
                    weight: even,
                });
                mark += even;
            }
        }
        // By rounding, the last place may remain empty.
        while let (Some(last), true) = (drawn.last().copied(), drawn.len() < count) {
            drawn.push(last);
        }
        self.particles = drawn;
    }

    /// Returns the mean of the particles.
    #[must_use]
    pub fn estimate(&self) -> Pose {
        mean(&self.particles, 1.0)
    }

    /// Returns the mean of the heaviest group of particles, and its weight, 0 … 1. A group is the
    /// particles in one cell of a grid of `pitch` metres whose headings are nearest to one axis.
    /// O(particles · log cells).
    #[must_use]
    pub fn likeliest(&self, pitch: f64) -> (Pose, f64) {
        let cell = |along: f64| libm::floor(along / pitch) as i64;
        let quarter = |heading: Heading| libm::round(heading.radians() / FRAC_PI_2) as i64;
        let mut groups: BTreeMap<_, Vec<Particle>> = BTreeMap::new();
        for particle in &self.particles {
            let Pose { position, heading } = particle.pose;
            let group = (
                cell(position.x),
                cell(position.y),
                quarter(heading).rem_euclid(4),
            );
            groups.entry(group).or_default().push(*particle);
        }
        let weight = |group: &[Particle]| group.iter().map(|particle| particle.weight).sum();
        let weighed = groups.values().map(|group| (weight(group), group));
        let heaviest = weighed.max_by(|(a, _): &(f64, _), (b, _)| a.total_cmp(b));
        heaviest.map_or_else(|| (self.estimate(), 1.0), |(w, group)| (mean(group, w), w))
    }
}

/// Returns the mean pose of particles whose weights add up to `sum`.
fn mean(particles: &[Particle], sum: f64) -> Pose {
    let (mut position, mut direction) = (Vector::zeros(), Vector::zeros());
    for Particle { pose, weight } in particles {
        position += pose.position.coords * *weight;
        direction += pose.heading.unit() * *weight;
    }
    Pose::new(Point::from(position / sum), Heading::of(direction))
}

/// Returns the likelihood of a reading for a mouse at `pose`, up to a factor. `nothing` is the
/// density where no wall is met.
fn likelihood<const N: usize>(
    sensor: &RangeModel,
    walls: &WallBelief<N>,
    pose: Pose,
    reading: RangeReading,
    nothing: f64,
) -> f64 {
    let heading = pose.heading.turned(reading.bearing);
    let mut left = 1.0;
    let mut hit = 0.0;
    for meeting in walls.meetings(pose.position, heading, reading.max_range) {
        let share = if meeting.known == Knowledge::Wall {
            left
        } else {
            left / 2.0
        };
        hit += share * sensor.density(reading.range, meeting.range);
        left -= share;
        if left < 0.05 {
            break;
        }
    }
    // The rest of the probability is that of meeting nothing.
    sensor.mixed(reading, hit + left * nothing)
}

/// Returns two independent normal numbers (Box and Muller 1958).
fn gaussians(rng: &mut impl Rng) -> [f64; 2] {
    let radius = libm::sqrt(-2.0 * libm::log(1.0 - uniform(rng)));
    let angle = TAU * uniform(rng);
    [radius * libm::cos(angle), radius * libm::sin(angle)]
}

/// Returns a random number, uniform in [0, 1).
fn uniform(rng: &mut impl Rng) -> f64 {
    f64::from(rng.random::<u32>()) / 4_294_967_296.0
}
