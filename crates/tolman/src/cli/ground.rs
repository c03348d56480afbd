//! The maze or world of a run: `MAZE` or `--maze FILE`, or `--world FILE` with `--goal` and
//! `--corridor`.

use std::path::{Path, PathBuf};

use anyhow::{Context, Error, anyhow};
use clap::ArgGroup;
use tolman_arena::course::{Course, FreeWorld, Terrain};
use tolman_formats::RosMap;
use tolman_geom::Point;
use tolman_papers::arena::world_of_map;
use tolman_sim::{Area, World, Zone};

use super::kind::Kind;
use super::unfinished::Call;
use super::{Failure, OrBadInput, Result, maze, outputs};

/// The maze or world that robots are sent into.
#[derive(clap::Args)]
#[command(group(ArgGroup::new("ground").args(["maze", "maze_file", "world"])))]
pub(super) struct Ground {
    /// Maze file of any format; - reads standard input
    #[arg(value_name = "MAZE")]
    maze: Option<PathBuf>,
    /// The same as MAZE
    #[arg(long = "maze", value_name = "FILE")]
    maze_file: Option<PathBuf>,
    /// World with free walls, instead of a maze: a tolman-world file (JSON), or the .yaml of a ROS
    /// map with its picture beside it. Unknown cells of a ROS map count as occupied; - reads a
    /// tolman-world from standard input
    #[arg(long, value_name = "FILE")]
    world: Option<PathBuf>,
    /// Put the destination of --world here: a disc around X,Y, m [default of RADIUS: 0.5]
    #[arg(
        long,
        value_name = "X,Y[,RADIUS]",
        requires = "world",
        allow_hyphen_values = true
    )]
    goal: Option<Goal>,
    /// Width of the corridors of --world that the robot assumes, m [default: that of the robot's
    /// mazes, 0.95 for the Pioneer, 0.25 for the e-puck]
    #[arg(long, value_name = "WIDTH", requires = "world", value_parser = width)]
    corridor: Option<f64>,
}

/// Returns the group that requires a maze or `--world`.
pub(super) fn required() -> ArgGroup {
    let either = ArgGroup::new("either").args(["maze", "maze_file", "world"]);
    either.required(true)
}

/// A destination as `--goal` gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Goal {
    centre: Point,
    /// Radius of the disc, m.
    radius: f64,
}

/// Radius of a destination if `--goal` gives none, m.
const RADIUS: f64 = 0.5;

impl Ground {
    /// Returns the maze or the world, with its name.
    ///
    /// # Errors
    /// Bad input if neither is given, or it cannot be read.
    pub(super) fn read(&self) -> Result<(String, Terrain)> {
        if let Some(path) = self.maze.as_ref().or(self.maze_file.as_ref()) {
            self.refuse_in_maze()?;
            let file = maze::read(path)?;
            return Ok((maze::world_name(path, &file), file.into()));
        }
        let Some(path) = &self.world else {
            return Err(Failure::BadInput(anyhow!(
                "give --maze FILE or --world FILE"
            )));
        };
        let world = world(path)?;
        let world = self.with_goal(world).with_context(|| maze::name(path));
        let free = FreeWorld {
            world: world.or_bad_input()?,
            corridor_width: self.corridor,
        };
        Ok((maze::name(path), Terrain::Free(free)))
    }

    /// Returns the first part of a call: everything about `course` on which a run of this verb
    /// depends.
    pub(super) fn call(&self, verb: &str, course: &Course) -> Call {
        Call::new(verb)
            .with("the world's name", Some(&course.name))
            .with("the checksum of the world", Some(course.drawing()))
            .with("--corridor", self.corridor)
    }

    /// Refuses flags for which a maze file has marks of its own.
    fn refuse_in_maze(&self) -> Result {
        let error = match self {
            Self { goal: Some(_), .. } => {
                "--goal is only for --world: in a maze file, mark the goal with G"
            }
            Self {
                corridor: Some(_), ..
            } => {
                "--corridor is only for --world: in a maze file, give `corridor_width` in the header"
            }
            _ => return Ok(()),
        };
        Err(Failure::BadInput(anyhow!(error)))
    }

    fn with_goal(&self, world: World) -> Result<World, Error> {
        let Some(goal) = self.goal else {
            return Ok(world);
        };
        if world.zone(DESTINATION).is_some() {
            return Err(anyhow!(
                "the world has a zone `{DESTINATION}` already: leave --goal out"
            ));
        }
        Ok(world.with_zone(goal.zone())?)
    }
}

/// Reads a world of either kind.
fn world(path: &Path) -> Result<World> {
    if is_yaml(path) {
        if let Ok((_, picture)) = RosMap::header(path) {
            outputs::reads("world", &picture)?;
        }
        let read = RosMap::read(path).map_err(Error::from);
        let world = read.and_then(|map| Ok(world_of_map(map)?));
        return world.with_context(|| maze::name(path)).or_bad_input();
    }
    let text = maze::text(path)?;
    World::from_json(&text)
        .map_err(|error| Kind::World.explain(&text, &maze::name(path), error))
        .or_bad_input()
}

const DESTINATION: &str = "destination";

fn is_yaml(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    matches!(extension, Some("yaml" | "yml"))
}

impl Goal {
    fn zone(self) -> Zone {
        let Self { centre, radius } = self;
        Zone::new(DESTINATION, vec![Area::Disc { centre, radius }])
    }
}

impl core::str::FromStr for Goal {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Vec<f64> = text.split(',').map(number).collect::<Result<_, _>>()?;
        let (centre, radius) = match numbers[..] {
            [x, y] => (Point::new(x, y), RADIUS),
            [x, y, radius] => (Point::new(x, y), radius),
            _ => return Err("expected X,Y or X,Y,RADIUS".to_owned()),
        };
        match radius > 0.0 {
            true => Ok(Self { centre, radius }),
            false => Err(format!("the radius is {radius} m; give a positive number")),
        }
    }
}

/// Returns the corridor width in `text`, m.
fn width(text: &str) -> Result<f64, String> {
    let width = number(text)?;
    match width > 0.0 {
        true => Ok(width),
        false => Err("give a positive number of metres".to_owned()),
    }
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok();
    let number = number.filter(|number| number.is_finite());
    number.ok_or_else(|| format!("`{text}` is not a finite number"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_goal_is_a_disc() {
        let goal = |x, y, radius| Goal {
            centre: Point::new(x, y),
            radius,
        };
        assert_eq!("-1, 2.5".parse(), Ok(goal(-1.0, 2.5, 0.5)));
        assert_eq!("1,2,0.3".parse(), Ok(goal(1.0, 2.0, 0.3)));
        for (text, expect) in [
            ("1", "expected X,Y"),
            ("1,2,3,4", "expected X,Y"),
            ("1,NaN", "`NaN`"),
            ("1,2,0", "the radius is 0 m"),
        ] {
            let error = text.parse::<Goal>().unwrap_err();
            assert!(error.contains(expect), "{text}: {error}");
        }
    }
}
