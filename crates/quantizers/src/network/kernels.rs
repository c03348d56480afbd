//! The same code compiled for several widths of lanes, chosen at run time.

use super::tree::MOST_FEATURES;

/// Number of units compared at once. The results are the same bit for bit: lanes do what scalars
/// do, and nothing is fused.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lanes {
    /// Number of lanes that every processor of the target has.
    Baseline,
    /// Number of lanes of this processor, detected at run time. Without the feature `std` it cannot
    /// be detected, and is that of [`Lanes::Baseline`].
    #[default]
    Widest,
}

/// Method of searching for the nearest units. All methods give the same result, bit for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UnitSearch {
    /// The fastest: the index for many units of few features, else the scan.
    #[default]
    Automatic,
    /// Every unit is compared.
    Scan,
    /// An exact index, a k-d tree, for up to four features; with more, the scan.
    Index,
}

impl UnitSearch {
    /// Returns whether an index is worth building for `units` units.
    pub(crate) fn wants_tree(self, dimension: usize, units: usize) -> bool {
        if dimension > MOST_FEATURES {
            return false;
        }
        let least = match self {
            Self::Scan => return false,
            Self::Index => 1,
            // Number of units at which both searches took equally long when measured.
            Self::Automatic => 64 << dimension,
        };
        units >= least
    }
}

/// Runs kernels compiled for some [`Lanes`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kernels {
    #[cfg(feature = "std")]
    arch: Option<pulp::Arch>,
}

impl From<Lanes> for Kernels {
    fn from(lanes: Lanes) -> Self {
        #[cfg(not(feature = "std"))]
        let _ = lanes;
        Self {
            #[cfg(feature = "std")]
            arch: match lanes {
                Lanes::Baseline => None,
                Lanes::Widest => Some(pulp::Arch::new()),
            },
        }
    }
}

impl Kernels {
    /// Runs `kernel`, which is compiled for the lanes as far as it is inlined.
    #[inline(always)]
    pub(crate) fn run<R>(self, kernel: impl FnOnce() -> R) -> R {
        #[cfg(feature = "std")]
        if let Some(arch) = self.arch {
            return arch.dispatch(kernel);
        }
        kernel()
    }

    /// Runs `kernel` in the same way, and tells it the registers, which are constants in each of
    /// its versions.
    #[inline(always)]
    pub(crate) fn run_in<R>(self, kernel: impl FnOnce(Registers) -> R) -> R {
        #[cfg(feature = "std")]
        if let Some(arch) = self.arch {
            return arch.dispatch(InRegisters(kernel));
        }
        kernel(Registers::default())
    }
}

/// The registers that hold lanes.
#[derive(Clone, Copy)]
pub(crate) struct Registers {
    pub(crate) count: usize,
    /// Number of bytes in each.
    pub(crate) size: usize,
}

impl Default for Registers {
    /// Returns those that every processor has.
    fn default() -> Self {
        Self {
            count: 16,
            size: 16,
        }
    }
}

/// A kernel that is told its registers.
#[cfg(feature = "std")]
struct InRegisters<K>(K);

#[cfg(feature = "std")]
impl<R, K: FnOnce(Registers) -> R> pulp::WithSimd for InRegisters<K> {
    type Output = R;

    #[inline(always)]
    fn with_simd<A: pulp::Simd>(self, _: A) -> R {
        self.0(Registers {
            count: A::REGISTER_COUNT,
            size: A::F64_LANES * size_of::<f64>(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_features_want_no_index() {
        for dimension in [MOST_FEATURES + 1, 63, 64, 72, 100_000] {
            for search in [UnitSearch::Automatic, UnitSearch::Scan, UnitSearch::Index] {
                assert!(
                    !search.wants_tree(dimension, usize::MAX),
                    "{search:?}, {dimension}"
                );
            }
        }
        assert!(UnitSearch::Automatic.wants_tree(2, 256));
        assert!(!UnitSearch::Automatic.wants_tree(2, 255));
    }
}
