//! Where a robot starts.

use core::str::FromStr;

use anyhow::anyhow;
use tolman_arena::course::Course;
use tolman_arena::episode::random_start;
use tolman_arena::pioneer::body;
use tolman_geom::{Heading, Point, Pose, Vector};

use super::Failure;

/// What `--start` can say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Start {
    /// Anywhere, as in the experiments.
    Random,
    /// In the middle of the cell that the maze marks.
    Marked,
    /// Exactly here.
    At(Pose),
}

impl Start {
    /// The pose on a course that this says.
    ///
    /// # Errors
    /// If the maze was to mark the start and does not, or no way leads on from there.
    pub(super) fn on(self, course: &Course, seed: u64) -> Result<Pose, Failure> {
        match self {
            Self::Random => Ok(random_start(course, &body(), seed)),
            Self::Marked => {
                let Some((cell, direction)) = course.maze.start() else {
                    let error =
                        anyhow!("{} marks no start; give --start random or X,Y", course.name);
                    return Err(Failure::BadInput(error));
                };
                let (east, north) = direction.step();
                let heading = Heading::of(Vector::new(f64::from(east), f64::from(north)));
                Ok(Pose::new(course.world.cell_centre(cell), heading))
            }
            Self::At(pose) if course.leads_on(pose.position) => Ok(pose),
            Self::At(Pose { position, .. }) => Err(Failure::BadInput(anyhow!(
                "no way leads from ({}, {}) m to the destination of {}; start in a corridor that leads there",
                position.x,
                position.y,
                course.name
            ))),
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
            number.ok_or_else(|| format!("`{text}` is no finite number"))
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
