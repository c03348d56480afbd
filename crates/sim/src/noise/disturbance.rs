use core::fmt::Debug;

use rand::distr::Distribution;

use super::Values;
use crate::Draws;

/// A change, by a crate of your own, of a sensor's readings or a motor's motion.
///
/// A [`Fault`](super::Fault) is named in a configuration; a disturbance is code, and is given to a
/// robot after it was built, for example with
/// [`LaserPioneer::with_disturbances`](crate::robots::LaserPioneer::with_disturbances). It comes
/// after the faults, farthest from the truth.
///
/// Runs stay reproducible if it draws all its random numbers from the [`Draws`] it is handed and
/// reads no clock, file or global state. Each disturbance has a channel of its own, so adding one
/// shifts no numbers of any other.
///
/// A reading that comes back broken counts as missing: see [`Values::is_sound`].
///
/// ```
/// use tolman_robot::Scan;
/// use tolman_sim::Draws;
/// use tolman_sim::noise::Disturbance;
/// use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig, LaserPioneerDisturbances};
///
/// /// Fog swallows echoes: the farther a wall, the likelier.
/// #[derive(Clone, Debug)]
/// struct Fog {
///     /// Mean free path of a beam, m.
///     visibility: f64,
/// }
///
/// impl Disturbance<Scan> for Fog {
///     fn disturb(&mut self, scan: &mut Option<Scan>, draws: &mut Draws) {
///         let Some(scan) = scan else { return };
///         let max_range = scan.ring.max_range;
///         for range in &mut scan.ranges {
///             if draws.uniform() > (1.0 + *range / self.visibility).recip() {
///                 *range = max_range;
///             }
///         }
///     }
/// }
///
/// let mut outside = LaserPioneerDisturbances::default();
/// outside.scan = vec![Box::new(Fog { visibility: 2.0 })];
/// let robot = LaserPioneer::new(LaserPioneerConfig::noiseless())?.with_disturbances(outside);
/// # Ok::<(), tolman_sim::robots::RobotConfigError>(())
/// ```
pub trait Disturbance<V>: CloneDisturbance<V> + Debug + Send + Sync {
    /// Changes a reading, or takes it away with `None`. Called once for each reading, in the order
    /// of time.
    ///
    /// `draws` begins again at every tick. State that must outlast a tick belongs in `self`.
    fn disturb(&mut self, value: &mut Option<V>, draws: &mut Draws);
}

/// Clones a boxed [`Disturbance`]. Every disturbance that is `Clone` has it; there is nothing to
/// implement.
pub trait CloneDisturbance<V> {
    /// Returns a copy in a box of its own.
    fn clone_box(&self) -> Box<dyn Disturbance<V>>;
}

impl<V, D: Disturbance<V> + Clone + 'static> CloneDisturbance<V> for D {
    fn clone_box(&self) -> Box<dyn Disturbance<V>> {
        Box::new(self.clone())
    }
}

impl<V> Clone for Box<dyn Disturbance<V>> {
    fn clone(&self) -> Self {
        self.as_ref().clone_box()
    }
}

/// Disturbances of one value, in order; the first is nearest to the truth.
pub type Disturbances<V> = Vec<Box<dyn Disturbance<V>>>;

/// Noise drawn from any distribution of [`rand`] or of the crate `rand_distr`, separately for each
/// number of a reading.
///
/// The bits it draws may differ between platforms and between builds. `rand_distr` takes `exp` and
/// `ln` from the standard library as soon as any crate of a program switches `num-traits/std` on,
/// and from libm otherwise. Where runs must repeat to the bit everywhere, use
/// [`Fault::Gaussian`](super::Fault::Gaussian), which stays the default, or a distribution that
/// needs no such function, such as [`rand::distr::Uniform`].
///
/// ```
/// use rand_distr::Cauchy;
/// use tolman_sim::noise::Noise;
/// use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig, LaserPioneerDisturbances};
///
/// let mut outside = LaserPioneerDisturbances::default();
/// let slip = Cauchy::new(0.0, 0.02).unwrap();
/// outside.odometry_distance = vec![Box::new(Noise::Relative(slip))];
/// let robot = LaserPioneer::new(LaserPioneerConfig::noiseless())?.with_disturbances(outside);
/// # Ok::<(), tolman_sim::robots::RobotConfigError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noise<D> {
    /// Adds a sample, in the value's own unit.
    Absolute(D),
    /// Adds a sample times the value.
    Relative(D),
}

impl<V, D> Disturbance<V> for Noise<D>
where
    V: Values,
    D: Distribution<f64> + Clone + Debug + Send + Sync + 'static,
{
    fn disturb(&mut self, value: &mut Option<V>, draws: &mut Draws) {
        match self {
            Self::Absolute(noise) => value.change(|number| number + noise.sample(draws)),
            Self::Relative(noise) => value.change(|number| number * (1.0 + noise.sample(draws))),
        }
    }
}
