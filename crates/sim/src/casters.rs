//! Ray casters: three ways to answer the same question, which tests compare with each other.
//!
//! | caster | worlds | how |
//! | --- | --- | --- |
//! | [`LatticeWalk`] | mazes and occupancy grids | from grid line to grid line, lanes over beams |
//! | [`WallIndex`] | any | draws the walls near by into a one-dimensional depth buffer |
//! | `ParryPolyline` (feature `parry2d`) | any | parry2d's bounding volume hierarchy, ray by ray: the reference |
//!
//! A world chooses one of the first two itself, unless the program [chose](CasterChoice) the third,
//! which shares no code with them. If you write a caster, or doubt a range in a world of your own,
//! you can compare the two. So the feature `parry2d` is on by default. Without it the simulator
//! computes the same bits, builds 13 crates fewer, and `ParryPolyline` does not exist.
//!
//! **What touching means.** A wall is a closed segment, so a ray into the joint of two walls never
//! leaks. A ray that passes the free end of a wall within rounding (10⁻⁹ m) may read the end or
//! what lies behind it. Everywhere else the three agree to 10⁻⁹ m.

use core::fmt;

use tolman_geom::{Point, Vector};

mod beam_sweep;
mod choice;
mod lattice_walk;
#[cfg(feature = "parry2d")]
mod parry;
mod wall_index;

pub use beam_sweep::BeamSweep;
pub(crate) use beam_sweep::Seen;
pub use choice::{CasterChoice, CasterChoiceError};
pub use lattice_walk::LatticeWalk;
#[cfg(feature = "parry2d")]
pub use parry::ParryPolyline;
pub use wall_index::WallIndex;

/// Returns distances to the nearest wall in any direction.
pub trait Caster: fmt::Debug + Send + Sync {
    /// Returns the distance along a ray to the first wall, m; `max_range` if it meets none before.
    /// `direction` is a unit vector.
    fn cast(&self, origin: Point, direction: Vector, max_range: f64) -> f64;

    /// Shortens every beam of `sweep` to the wall it meets.
    fn scan(&self, sweep: &mut BeamSweep) {
        let origin = sweep.origin();
        sweep.shorten_each(|direction, range| self.cast(origin, direction, range));
    }
}

/// Number of beams that the casters of this crate compute at once. The results are the same bit for
/// bit: lanes do what scalars do, and nothing is fused.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lanes {
    /// The number of lanes that every processor of the target has: two on plain x86-64.
    Baseline,
    /// The number of lanes that this processor has, detected at run time.
    #[default]
    Widest,
}

/// Runs kernels compiled for some [`Lanes`].
#[derive(Clone, Copy, Debug)]
struct Kernels(Option<pulp::Arch>);

impl From<Lanes> for Kernels {
    fn from(lanes: Lanes) -> Self {
        match lanes {
            Lanes::Baseline => Self(None),
            Lanes::Widest => Self(Some(pulp::Arch::new())),
        }
    }
}

impl Kernels {
    /// Runs `kernel`, which is compiled for the lanes as far as it is inlined.
    #[inline(always)]
    fn run(self, kernel: impl FnOnce()) {
        match self.0 {
            None => kernel(),
            Some(arch) => arch.dispatch(kernel),
        }
    }
}
