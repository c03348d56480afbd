//! Start poses of robots.

use core::fmt;
use core::str::FromStr;

use tolman_geom::{Heading, Point, Pose};

use crate::BoxError;
use crate::course::Course;

/// A start as `--start` gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// A random pose, as in the experiments.
    Random,
    /// The middle of the cell that the maze marks.
    Marked,
    /// Start at this pose, in metres and radians.
    At(Pose),
}

impl Start {
    /// Returns the start of a robot that is given none: the one that the course marks, or else a
    /// random one.
    #[must_use]
    pub fn usual(course: &Course) -> Self {
        match course.start() {
            Ok(_) => Self::Marked,
            Err(_) => Self::Random,
        }
    }

    /// Returns the start pose on `course`. `random` is called for a random one.
    ///
    /// # Errors
    /// If the maze marks no start, or no way leads on from there.
    pub fn on(
        self,
        course: &Course,
        random: impl FnOnce() -> Option<Pose>,
    ) -> Result<Pose, BoxError> {
        let name = &course.name;
        match self {
            Self::Random => random().ok_or_else(|| format!("{name} has no way to a goal").into()),
            Self::Marked => {
                let start = course.start();
                start.map_err(|_| format!("{name} marks no start; give --start random or X,Y").into())
            }
            Self::At(pose) if course.leads_on(pose.position) => Ok(pose),
            Self::At(Pose { position, .. }) => Err(format!(
                "no way leads from ({}, {}) m to the destination of {name}; start in a corridor that leads there",
                position.x,
                position.y
            )
            .into()),
        }
    }
}

impl fmt::Display for Start {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Random => f.write_str("random"),
            Self::Marked => f.write_str("marked"),
            Self::At(Pose { position, heading }) => {
                write!(f, "{},{},{}", position.x, position.y, heading.degrees())
            }
        }
    }
}

impl FromStr for Start {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "random" => return Ok(Self::Random),
            "marked" => return Ok(Self::Marked),
            _ => {}
        }
        let number = |text: &str| {
            let number = text
                .trim()
                .parse::<f64>()
                .ok()
                .filter(|number| number.is_finite());
            number.ok_or_else(|| format!("`{text}` is not a finite number"))
        };
        let parts: Vec<&str> = text.split(',').collect();
        let (x, y, degrees) = match parts[..] {
            [x, y] => (x, y, "0"),
            [x, y, degrees] => (x, y, degrees),
            _ => return Err("expected random, marked, X,Y or X,Y,DEG".to_owned()),
        };
        let position = Point::new(number(x)?, number(y)?);
        Ok(Self::At(Pose::new(
            position,
            Heading::from_degrees(number(degrees)?),
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn says_what_it_does_not_understand() {
        assert_eq!("random".parse(), Ok(Start::Random));
        let east = Pose::new(Point::new(-1.0, 2.5), Heading::from_degrees(0.0));
        assert_eq!("-1, 2.5".parse(), Ok(Start::At(east)));
        for (text, expected) in [
            ("1", "expected random"),
            ("1,2,3,4", "expected random"),
            ("1,NaN", "`NaN`"),
            ("1,inf", "`inf`"),
            ("a,1", "`a`"),
        ] {
            let error = text.parse::<Start>().unwrap_err();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
