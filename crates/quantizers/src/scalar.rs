//! The element types of quantizers.

use core::fmt::{Debug, Display};
use core::ops::{Add, AddAssign, Mul, MulAssign, Sub};

/// `f32` or `f64`: the type of the features of inputs and prototypes.
///
/// `f32` is twice as fast and precise enough for sensors; errors are summed in `f64` either way.
pub trait Scalar:
    sealed::Sealed
    + Copy
    + Debug
    + Default
    + Display
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + AddAssign
    + MulAssign
    + Send
    + Sync
    + 'static
{
    /// The number 0.
    const ZERO: Self;
    /// Positive infinity.
    const INFINITY: Self;

    /// Returns the nearest value of this type.
    fn from_f64(value: f64) -> Self;
    /// Returns the exact value as `f64`.
    fn to_f64(self) -> f64;
    /// Returns whether the number is neither infinite nor NaN.
    fn is_finite(self) -> bool {
        self.to_f64().is_finite()
    }

    /// Returns `self · factor + addend`, rounded once.
    #[doc(hidden)]
    fn mul_add(self, factor: Self, addend: Self) -> Self;

    /// The distance of 1 from the next number.
    #[doc(hidden)]
    const EPSILON: f64;

    /// The smallest positive number that is not subnormal.
    #[doc(hidden)]
    const TINY: f64;

    /// Maximum squared distance. It leaves room for sums of errors.
    #[doc(hidden)]
    const MAX_SQUARED_DISTANCE: f64;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

impl Scalar for f32 {
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        #[cfg(feature = "std")]
        return f32::mul_add(self, factor, addend);
        #[cfg(not(feature = "std"))]
        libm::fmaf(self, factor, addend)
    }

    const ZERO: Self = 0.0;
    const INFINITY: Self = f32::INFINITY;
    const EPSILON: f64 = f32::EPSILON as f64;
    const TINY: f64 = f32::MIN_POSITIVE as f64;
    const MAX_SQUARED_DISTANCE: f64 = 1e38;

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value as f32
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        #[cfg(feature = "std")]
        return f64::mul_add(self, factor, addend);
        #[cfg(not(feature = "std"))]
        libm::fma(self, factor, addend)
    }

    const ZERO: Self = 0.0;
    const INFINITY: Self = f64::INFINITY;
    const EPSILON: f64 = f64::EPSILON;
    const TINY: f64 = f64::MIN_POSITIVE;
    const MAX_SQUARED_DISTANCE: f64 = 1e240;

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
}
