use tolman_geom::Twist;
use tolman_robot::epuck::BODY_RADIUS;

use super::Echoes;

/// Layer 0: keeps the robot away from walls and from anything that approaches it (section 3.2).
///
/// It slows the proposal down as something comes near ahead, and turns away from it.
/// The paper gives no values.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked"))]
#[non_exhaustive]
pub struct KeepOff {
    /// Distance between body and wall at which the robot begins to slow down, m.
    pub margin: f64,
    /// Distance between body and wall below which the robot no longer drives ahead, m. It must be
    /// below the margin.
    pub least: f64,
    /// Turn rate away from the wall where driving ends, rad/s.
    pub turn: f64,
}

/// A layer 0 as it stands in a file.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    #[serde(deserialize_with = "crate::read::positive")]
    margin: f64,
    #[serde(deserialize_with = "crate::read::at_least_zero")]
    least: f64,
    #[serde(deserialize_with = "crate::read::finite")]
    turn: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for KeepOff {
    type Error = alloc::string::String;

    fn try_from(unchecked: Unchecked) -> Result<Self, Self::Error> {
        let Unchecked {
            margin,
            least,
            turn,
        } = unchecked;
        if least < margin {
            Ok(Self {
                margin,
                least,
                turn,
            })
        } else {
            Err(alloc::format!(
                "`least` is {least} m: give less than the `margin` of {margin} m"
            ))
        }
    }
}

impl KeepOff {
    /// Returns our values: slower from 3 cm on, no nearer than 1 cm.
    #[must_use]
    pub const fn ours() -> Self {
        Self {
            margin: 0.03,
            least: 0.01,
            turn: 2.0,
        }
    }

    /// Corrects the proposal of the layer above.
    ///
    /// The nearer something is, the less of the proposed turn is left. If the two turns were added,
    /// they could cancel out in front of a post, and the robot would stand there for good. A turn
    /// in place is not corrected: a round robot touches nothing by it.
    #[must_use]
    pub fn correct(&self, proposal: Twist, echoes: &Echoes) -> Twist {
        if proposal.linear <= 0.0 {
            return proposal;
        }
        // Driving ahead leaves behind everything behind the wheels' axle.
        let ahead = echoes.iter().filter(|point| point.x > 0.0);
        let Some(nearest) = ahead.min_by(|a, b| a.coords.norm().total_cmp(&b.coords.norm())) else {
            return proposal;
        };
        let gap = nearest.coords.norm() - BODY_RADIUS;
        let freedom = ((gap - self.least) / (self.margin - self.least)).clamp(0.0, 1.0);
        let away = if nearest.y > 0.0 {
            -self.turn
        } else {
            self.turn
        };
        Twist::new(
            proposal.linear * freedom,
            proposal.angular * freedom + (1.0 - freedom) * away,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::epuck::RangeCurve;

    fn echoes(sensor: usize, range: f64) -> Echoes {
        let curve = RangeCurve::new(alloc::vec![(0.0, 1.0), (1.0, 0.0)]).unwrap();
        let mut values = [0.0; 8];
        values[sensor] = 1.0 - range;
        Echoes::of(&values, &curve)
    }

    const AHEAD: Twist = Twist {
        linear: 0.1,
        angular: 0.0,
    };

    #[test]
    fn what_is_far_changes_nothing() {
        let layer = KeepOff::ours();
        assert_eq!(layer.correct(AHEAD, &echoes(7, 0.2)), AHEAD);
        assert_eq!(layer.correct(AHEAD, &Echoes::default()), AHEAD);
        // Nor does what is behind.
        assert_eq!(layer.correct(AHEAD, &echoes(3, 0.001)), AHEAD);
    }

    #[test]
    fn no_turn_holds_it_before_what_is_near() {
        let layer = KeepOff::ours();
        // A wall comes nearer and goes away, and the layer above steers to it.
        for range in (0..100).map(|step| f64::from(step) * 0.001) {
            for angular in [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0] {
                let proposal = Twist::new(0.1, angular);
                for sensor in [0, 7] {
                    let twist = layer.correct(proposal, &echoes(sensor, range));
                    assert!(
                        twist.linear > 0.001 || twist.angular.abs() > 0.5,
                        "{twist:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_turn_in_place_is_left_as_it_is() {
        let turn = Twist::new(0.0, 3.0);
        assert_eq!(KeepOff::ours().correct(turn, &echoes(7, 0.005)), turn);
    }

    #[test]
    fn what_is_near_stops_it_and_turns_it_away() {
        let layer = KeepOff::ours();
        let left = layer.correct(AHEAD, &echoes(7, 0.005));
        assert!(left.linear.abs() < 1e-12 && left.angular < -1.0, "{left:?}");
        let right = layer.correct(AHEAD, &echoes(0, 0.005));
        assert!(
            right.linear.abs() < 1e-12 && right.angular > 1.0,
            "{right:?}"
        );
    }
}
