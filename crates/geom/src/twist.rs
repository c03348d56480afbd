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
    /// Standing still.
    pub const ZERO: Self = Self {
        linear: 0.0,
        angular: 0.0,
    };

    /// A twist of `linear` m/s and `angular` rad/s.
    #[must_use]
    pub const fn new(linear: f64, angular: f64) -> Self {
        Self { linear, angular }
    }

    /// The twist of a differential drive whose wheels roll at `left` and `right` m/s, `track` metres apart.
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
