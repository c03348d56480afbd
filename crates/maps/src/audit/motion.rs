//! Computes rigid motions that store their rotation, and transforms covariances.

use tolman_geom::Pose;
use tolman_geom::nalgebra::{Matrix3, Vector3};

/// A rigid motion in the plane. Its rotation is kept as cosine and sine, so that composing needs no
/// trigonometry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub(super) x: f64,
    pub(super) y: f64,
    cos: f64,
    sin: f64,
}

impl Motion {
    pub(super) const NONE: Self = Self {
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
    };

    pub(super) fn then(&self, next: &Self) -> Self {
        Self {
            x: self.x + self.cos * next.x - self.sin * next.y,
            y: self.y + self.sin * next.x + self.cos * next.y,
            cos: self.cos * next.cos - self.sin * next.sin,
            sin: self.sin * next.cos + self.cos * next.sin,
        }
    }

    pub(super) fn inverse(&self) -> Self {
        Self {
            x: -self.cos * self.x - self.sin * self.y,
            y: self.sin * self.x - self.cos * self.y,
            cos: self.cos,
            sin: -self.sin,
        }
    }

    /// Returns the logarithm: the twist that leads to this pose in one second.
    pub(super) fn log(&self) -> Vector3<f64> {
        let angle = libm::atan2(self.sin, self.cos);
        let half = 0.5 * angle;
        // (θ/2) / tan(θ/2), by its series where the quotient would lose digits.
        let along = if angle.abs() < 1e-2 {
            let square = angle * angle;
            1.0 - square / 12.0 - square * square / 720.0
        } else {
            half * self.sin / (1.0 - self.cos)
        };
        Vector3::new(
            along * self.x + half * self.y,
            along * self.y - half * self.x,
            angle,
        )
    }
}

impl From<Pose> for Motion {
    fn from(pose: Pose) -> Self {
        let unit = pose.heading.unit();
        Self {
            x: pose.position.x,
            y: pose.position.y,
            cos: unit.x,
            sin: unit.y,
        }
    }
}

/// A symmetric 3 × 3 matrix: the covariance of x, y and heading.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spread {
    pub(super) xx: f64,
    pub(super) xy: f64,
    pub(super) xt: f64,
    pub(super) yy: f64,
    pub(super) yt: f64,
    pub(super) tt: f64,
}

impl Spread {
    pub(super) fn of(matrix: &Matrix3<f64>) -> Self {
        Self {
            xx: matrix[(0, 0)],
            xy: matrix[(0, 1)],
            xt: matrix[(0, 2)],
            yy: matrix[(1, 1)],
            yt: matrix[(1, 2)],
            tt: matrix[(2, 2)],
        }
    }

    /// Returns the upper triangle, row by row.
    pub(super) const fn upper(&self) -> [f64; 6] {
        [self.xx, self.xy, self.xt, self.yy, self.yt, self.tt]
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        Self {
            xx: self.xx + other.xx,
            xy: self.xy + other.xy,
            xt: self.xt + other.xt,
            yy: self.yy + other.yy,
            yt: self.yt + other.yt,
            tt: self.tt + other.tt,
        }
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.plus(&other.scaled(-1.0))
    }

    pub(super) fn scaled(&self, by: f64) -> Self {
        Self {
            xx: self.xx * by,
            xy: self.xy * by,
            xt: self.xt * by,
            yy: self.yy * by,
            yt: self.yt * by,
            tt: self.tt * by,
        }
    }

    /// Returns Ad C Adᵀ: the covariance of an error given in the frame that `by` carries, as seen
    /// from the outer frame.
    pub(super) fn seen_from(&self, by: &Motion) -> Self {
        let (cos, sin) = (by.cos, by.sin);
        // The adjoint is [R w; 0 1] with w = (y, −x).
        let (wx, wy) = (by.y, -by.x);
        let (vx, vy) = (cos * self.xt - sin * self.yt, sin * self.xt + cos * self.yt);
        let (left, right) = (cos * self.xx - sin * self.xy, cos * self.xy - sin * self.yy);
        let (low, high) = (sin * self.xx + cos * self.xy, sin * self.xy + cos * self.yy);
        let tt = self.tt;
        Self {
            xx: cos * left - sin * right + 2.0 * vx * wx + tt * wx * wx,
            xy: sin * left + cos * right + vx * wy + vy * wx + tt * wx * wy,
            xt: vx + tt * wx,
            yy: sin * low + cos * high + 2.0 * vy * wy + tt * wy * wy,
            yt: vy + tt * wy,
            tt,
        }
    }

    /// Returns the covariance of x and y given the heading: (xx, xy, yy), m².
    fn without_heading(&self) -> (f64, f64, f64) {
        let (across, up) = (self.xt / self.tt, self.yt / self.tt);
        (
            self.xx - across * self.xt,
            self.xy - across * self.yt,
            self.yy - up * self.yt,
        )
    }

    pub(super) fn det(&self) -> f64 {
        let (xx, xy, yy) = self.without_heading();
        self.tt * (xx * yy - xy * xy)
    }

    /// Returns rᵀ C⁻¹ r. The heading is eliminated first, so that long levers cancel.
    pub(super) fn chi2(&self, off: &Vector3<f64>) -> f64 {
        let (xx, xy, yy) = self.without_heading();
        let turn = off.z / self.tt;
        let (x, y) = (off.x - self.xt * turn, off.y - self.yt * turn);
        let det = xx * yy - xy * xy;
        off.z * turn + (yy * x * x - 2.0 * xy * x * y + xx * y * y) / det
    }

    /// Returns the greatest standard deviation of x and y over all directions.
    pub(super) fn widest(&self) -> f64 {
        let (middle, half) = (0.5 * (self.xx + self.yy), 0.5 * (self.xx - self.yy));
        libm::sqrt(middle + libm::hypot(half, self.xy))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::{Heading, Point};

    use super::*;

    fn pose() -> impl Strategy<Value = Pose> {
        (-9.0..9.0, -9.0..9.0, -3.1..3.1)
            .prop_map(|(x, y, h)| Pose::new(Point::new(x, y), Heading::from_radians(h)))
    }

    fn full(spread: &Spread) -> Matrix3<f64> {
        let Spread {
            xx,
            xy,
            xt,
            yy,
            yt,
            tt,
        } = *spread;
        Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt)
    }

    fn spread() -> impl Strategy<Value = Spread> {
        prop::array::uniform6(-1.0..1.0).prop_map(|n: [f64; 6]| {
            let root = Matrix3::new(n[3], n[4], n[5], 0.0, n[0], n[1], 0.0, 0.0, n[2]);
            Spread::of(&(root * root.transpose() + Matrix3::identity() * 0.1))
        })
    }

    /// The series near 0 and the quotient beyond it agree, and neither divides by zero.
    #[test]
    fn the_logarithm_is_smooth_where_its_form_changes() {
        for angle in [
            0.0, 1e-12, -1e-6, 0.009_999, -0.009_999, 0.010_001, -0.010_001,
        ] {
            let at = Pose::new(Point::new(2.0, -1.0), Heading::from_radians(angle));
            let log = Motion::from(at).log();
            // Of small angles θ cot θ is 1 − θ² / 3.
            let (half, along) = (0.5 * angle, 1.0 - angle * angle / 12.0);
            let expect = Vector3::new(2.0 * along - half, -along - 2.0 * half, angle);
            assert!((log - expect).norm() < 1e-9, "{angle}: {log}");
        }
    }

    proptest! {
        #[test]
        fn motions_are_poses(a in pose(), b in pose()) {
            let both = Motion::from(a).then(&Motion::from(b).inverse());
            let expect = Motion::from(a.compose(b.inverse()));
            prop_assert!((both.x - expect.x).abs() + (both.y - expect.y).abs() < 1e-9);
            prop_assert!((both.sin - expect.sin).abs() + (both.cos - expect.cos).abs() < 1e-9);
        }

        #[test]
        fn the_logarithm_leads_there(a in pose()) {
            let log = Motion::from(a).log();
            let twist = tolman_geom::nalgebra::Matrix3::new(0.0, -log.z, log.x, log.z, 0.0, log.y, 0.0, 0.0, 0.0);
            let there = twist.exp();
            prop_assert!((there[(0, 2)] - a.position.x).abs() < 1e-6 && (there[(1, 2)] - a.position.y).abs() < 1e-6);
        }

        #[test]
        fn covariances_are_as_nalgebra_has_them(by in pose(), c in spread(), off in prop::array::uniform3(-1.0..1.0)) {
            let motion = Motion::from(by);
            let adjoint = Matrix3::new(
                motion.cos, -motion.sin, motion.y, motion.sin, motion.cos, -motion.x, 0.0, 0.0, 1.0,
            );
            let expect = adjoint * full(&c) * adjoint.transpose();
            let moved = c.seen_from(&motion);
            prop_assert!((full(&moved) - expect).abs().max() < 1e-9);
            prop_assert!((moved.det() - c.det()).abs() < 1e-6 * c.det());
            let off = Vector3::from(off);
            let expect = off.dot(&(full(&c).try_inverse().unwrap() * off));
            prop_assert!((c.chi2(&off) - expect).abs() < 1e-6 * (1.0 + expect));
            // No frame changes how far off a cycle is.
            prop_assert!((moved.chi2(&(adjoint * off)) - expect).abs() < 1e-6 * (1.0 + expect));
        }

        #[test]
        fn covariances_add_up_as_matrices_do(a in spread(), b in spread(), by in -3.0..3.0) {
            let off = |found: Spread, expect: Matrix3<f64>| (full(&found) - expect).abs().max();
            prop_assert!(off(a.scaled(by), full(&a) * by) < 1e-12);
            prop_assert!(off(a.plus(&b), full(&a) + full(&b)) < 1e-12);
            prop_assert!(off(a.minus(&b), full(&a) - full(&b)) < 1e-12);
            prop_assert!(off(Spread::of(&full(&a)), full(&a)) < 1e-12);
        }

        #[test]
        fn the_widest_deviation_is_the_root_of_the_greatest_eigenvalue(c in spread()) {
            let greatest = full(&c).fixed_view::<2, 2>(0, 0).symmetric_eigenvalues().max();
            prop_assert!((c.widest() - greatest.sqrt()).abs() < 1e-9);
        }
    }
}
