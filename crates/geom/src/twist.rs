/// A velocity in the robot's own frame: ahead in m/s, counter-clockwise in rad/s.
///
/// The robots here have no sideways drive, so a twist has two numbers, not three.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Twist {
    /// Speed ahead, m/s; negative is backward.
    pub linear: f64,
    /// Turn rate, rad/s; positive is counter-clockwise.
    pub angular: f64,
}

impl Twist {
    /// Twist of a body that stands still.
    pub const ZERO: Self = Self::new(0.0, 0.0);

    /// Returns a twist of `linear` m/s and `angular` rad/s.
    #[must_use]
    pub const fn new(linear: f64, angular: f64) -> Self {
        Self { linear, angular }
    }

    /// Returns the twist of a differential drive whose wheels roll at `left` and `right` m/s,
    /// `track` metres apart.
    ///
    /// Wheels on one spot (`track` 0) have no twist: the result is then not finite.
    ///
    /// ```
    /// use tolman_geom::Twist;
    /// let spin = Twist::of_wheels(-0.1, 0.1, 0.2);
    /// assert_eq!(spin, Twist::new(0.0, 1.0));
    /// ```
    #[must_use]
    pub fn of_wheels(left: f64, right: f64, track: f64) -> Self {
        Self::new(0.5 * (left + right), (right - left) / track)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// A wheel goes as fast as the body at the wheel's place: v ∓ ω · track / 2.
        #[test]
        fn wheels_and_twist_agree(left in -1.0..1.0, right in -1.0..1.0, track in 0.05..1.0) {
            let twist = Twist::of_wheels(left, right, track);
            prop_assert!((twist.linear - 0.5 * twist.angular * track - left).abs() < 1e-12);
            prop_assert!((twist.linear + 0.5 * twist.angular * track - right).abs() < 1e-12);
        }
    }

    #[cfg(feature = "serde")]
    #[test]
    fn twists_survive_json() {
        let twist = Twist::new(0.1, -0.2);
        let json = serde_json::to_string(&twist).unwrap();
        assert_eq!(json, r#"{"linear":0.1,"angular":-0.2}"#);
        assert_eq!(serde_json::from_str::<Twist>(&json).unwrap(), twist);
    }
}
