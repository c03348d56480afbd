//! CPM's e-puck as the robot of a diktiometry. Its layers 0 and 1 drive from one junction or dead
//! end to the next, which are the places. Encoders, with headings corrected by the walls, are its
//! odometry. A sweep is its view of a place.

use core::f64::consts::TAU;

use thiserror::Error;
use tolman_control::epuck::Profile;
use tolman_control::heading_of;
use tolman_geom::{Heading, IntervalError, Point, PointBox, Pose};
use tolman_maps::diktiometry::{
    ActionKind, Config, MoveOutcome, Percepts, Signature, SignatureError, SignatureKind,
    ViewRotation,
};
use tolman_maze::{Cell, Direction, Maze};
use tolman_robot::{Standing, Task};
use tolman_sim::robots::Epuck;
use tolman_sim::{StepError, World};
use tolman_systems::cpm::{HeadingBy, WalkError, Walker};
use tolman_systems::diktiometry::{
    Arrival, Diktiometer, DiktiometerConfig, ExploreUntil, MapError, NoEye, RoutineConfig, Rover,
};

use super::{MapScore, Places, TruePlace, Visit, least_distance, score};
use crate::BoxError;
use crate::course::Course;
use crate::cpm::{SimulatedEpuck, TrueFragments, direction_of, epuck, walker_config};
use crate::run::{InRun, until_done};

/// Parameters of an e-puck's survey of a maze.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct EpuckSurveyConfig {
    /// Number of moves, each from one place to the next.
    pub moves: u32,
    /// Exploration probability: how often an applicable script of the map's advice is begun, 0 to
    /// 1; "generally 30 % of the time".
    pub heed: f64,
    /// Error bound of odometry at the end of a move along either axis, m: how far from a place's
    /// middle the robot may stop.
    pub margin: f64,
    /// Additional bound after one metre, m. It grows as the square root of the distance, as the
    /// slips of ticks are independent.
    pub margin_per_root_metre: f64,
}

impl EpuckSurveyConfig {
    /// Returns bounds for wheels that slip by 10 %. They held for all of 3600 moves in Mazes 1 to 3
    /// with seeds 1 to 3. As slips are independent, they are not strict bounds.
    #[must_use]
    pub const fn usual(moves: u32) -> Self {
        Self {
            moves,
            heed: 0.3,
            margin: 0.025,
            margin_per_root_metre: 0.01,
        }
    }

    /// Returns the mapper for mazes whose places are at least `separation` apart, m.
    #[must_use]
    pub fn mapper(&self, separation: f64) -> Config {
        // Ways may bend: a robot that left to the north does not come back by going south.
        let actions = vec![ActionKind::default(); Direction::ALL.len()];
        let mut config = Config::new(actions, separation);
        config.place_radius = self.margin / 2.0;
        config.percepts = Percepts::Signatures(SignatureKind {
            rows: 1,
            columns: COLUMNS,
            tolerance: 0.5,
            share: 0.75,
            rotation: ViewRotation::Aligned,
            views: 4,
        });
        config
    }
}

/// Number of columns of a place's look.
const COLUMNS: usize = 20;

/// Raw value above which a sensor sees a wall, in any corridor. Only walls and their absence are
/// told apart.
const WALL: f64 = 60.0;

/// Result of a survey.
#[derive(Clone, Debug, PartialEq)]
pub struct EpuckSurvey {
    /// Quality of the map.
    pub score: MapScore,
    /// Number of moves that were made.
    pub moves: u32,
    /// Number of moves whose true displacement lies within odometry's bounds.
    pub bounded: u32,
    /// Reason why the run broke off.
    pub trouble: Option<String>,
}

/// Reason why a routine of the e-puck comes to no end.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EpuckRoverError {
    /// A walk of the robot failed.
    #[error(transparent)]
    Walk(#[from] WalkError<StepError>),
    /// A sweep gives no valid signature.
    #[error(transparent)]
    Signature(#[from] SignatureError),
    /// Odometry is not a number.
    #[error(transparent)]
    Interval(#[from] IntervalError),
}

/// Walks through a maze, maps its places, and returns the result.
///
/// # Errors
/// If it cannot be begun, or the observer refuses an observation. A robot that
/// gets stuck is a result.
pub fn survey_maze(
    maze: &Maze,
    corridor_width: f64,
    config: &EpuckSurveyConfig,
    seed: u64,
) -> Result<EpuckSurvey, BoxError> {
    let mut rover = EpuckRover::new(maze, corridor_width, config, seed)?;
    let truth = true_places(maze, rover.world());
    let mapper = config.mapper(least_distance(&truth).unwrap_or(corridor_width));
    // The e-puck has routines of its own.
    let routines = RoutineConfig::new(corridor_width, 1.0, 1.0);
    let mut paper = DiktiometerConfig::paper(routines, mapper);
    (paper.heed, paper.until) = (config.heed, ExploreUntil::Never);
    let mut system = Diktiometer::new(paper, NoEye, seed);
    let mut sites = vec![rover.site(maze)];
    let (mut gone, mut bounded, mut trouble) = (Vec::new(), 0, None);
    until_done(&mut rover, |rover| {
        let (site, before) = (rover.site(maze), rover.truth().position);
        match system.act_with(rover, Task::Explore) {
            Ok(Standing::GaveUp { why }) => trouble = Some(why),
            Err(MapError::Robot(error)) => trouble = Some(error.to_string()),
            acted => drop(acted?),
        }
        let Some(moved) = system.last_move().filter(|_| trouble.is_none()) else {
            return Ok(Standing::Done);
        };
        let truly = rover.truth().position - before;
        bounded += u32::from(moved.arrival.moved.contains(truly.into()));
        gone.push((site, moved.direction));
        sites.push(rover.site(maze));
        Ok::<_, BoxError>(match (gone.len() as u32) < config.moves {
            true => Standing::UnderWay,
            false => Standing::Done,
        })
    })?;
    let visits = Visit::all(&system, &sites);
    Ok(EpuckSurvey {
        score: score(system.observer(), &visits, &gone, &truth),
        moves: gone.len() as u32,
        bounded,
        trouble,
    })
}

/// The robot with its compass. Headings are relative to the start and corrected by the walls.
struct EpuckRover {
    walker: Walker<SimulatedEpuck>,
    config: EpuckSurveyConfig,
    /// Heading at the start.
    ahead: Heading,
    /// Branch that leads in each direction, by [`Direction::index`].
    ways: [Option<usize>; 4],
}

impl EpuckRover {
    fn new(
        maze: &Maze,
        corridor_width: f64,
        config: &EpuckSurveyConfig,
        seed: u64,
    ) -> Result<Self, BoxError> {
        let course = Course::new("", maze.clone(), corridor_width)?;
        let body = course.robot_at(course.start()?, Epuck::new(epuck())?, seed)?;
        let ahead = body.truth().pose.heading;
        let mut walker_config = walker_config(&epuck(), corridor_width)?;
        walker_config.heading = HeadingBy::Walls;
        let mut rover = Self {
            walker: Walker::new(body, walker_config),
            config: *config,
            ahead,
            ways: [None; 4],
        };
        rover.walker.begin()?;
        rover.orient();
        Ok(rover)
    }

    fn world(&self) -> &World {
        self.walker.body().world()
    }

    fn truth(&self) -> Pose {
        self.walker.body().truth().pose
    }

    /// Returns the number of the cell in which the robot truly stands.
    fn site(&self, maze: &Maze) -> u32 {
        let cell = self.world().cell_at(self.truth().position);
        cell.map_or(0, |cell| maze.grid().index(cell) as u32)
    }

    /// Returns the heading by the compass.
    fn heading(&self) -> Heading {
        self.walker.pose().heading.turned(self.ahead.radians())
    }

    /// Assigns each branch to the direction in which it leads.
    fn orient(&mut self) {
        self.ways = [None; 4];
        for (number, branch) in self.walker.branches().iter().enumerate() {
            let way = direction_of(self.heading().turned(*branch));
            self.ways[way.index()].get_or_insert(number);
        }
    }

    /// Returns the arrival at the robot's present place.
    fn arrival(
        &mut self,
        outcome: MoveOutcome,
        moved: PointBox,
    ) -> Result<Arrival, EpuckRoverError> {
        let profile = self.walker.look_around()?;
        let values = (0..COLUMNS).map(|column| {
            let east = column as f64 * TAU / COLUMNS as f64;
            value_at(&profile, east - self.heading().radians())
        });
        Ok(Arrival {
            outcome,
            moved,
            look: Some(Signature::new(1, values.collect())?),
            exits: self.ways.map(|branch| branch.is_some()),
        })
    }
}

impl InRun for EpuckRover {
    fn steps(&self) -> u32 {
        self.walker.steps()
    }

    fn is_out_of_time(&self) -> bool {
        false
    }
}

impl Rover for EpuckRover {
    type Error = EpuckRoverError;

    fn look(&mut self) -> Result<Arrival, EpuckRoverError> {
        self.arrival(MoveOutcome::Arrived, PointBox::ORIGIN)
    }

    fn go(&mut self, direction: Direction) -> Result<Arrival, EpuckRoverError> {
        let Some(branch) = self.ways[direction.index()] else {
            return self.arrival(MoveOutcome::Blocked, PointBox::ORIGIN);
        };
        let (from, driven) = (self.walker.pose(), self.walker.driven());
        let walk = self.walker.walk(branch, 0, None)?;
        walk.sighting.ok_or(WalkError::Lost)?;
        let way = self.walker.driven() - driven;
        let margin = self.config.margin + self.config.margin_per_root_metre * libm::sqrt(way);
        // From the axes of the start to those of the compass, which lie at right angles.
        let moved = self.walker.pose().position - from.position;
        let moved = Pose::new(Point::origin(), self.ahead).transform(moved.into());
        self.orient();
        let moved = PointBox::about(moved, margin)?;
        self.arrival(MoveOutcome::Arrived, moved)
    }
}

/// Returns the mean value of a profile about a bearing, as a share of that of a wall.
fn value_at(profile: &Profile, bearing: f64) -> f64 {
    let values = profile.values();
    let width = (values.len() / COLUMNS).max(1);
    let middle = bearing / TAU * values.len() as f64 - (width - 1) as f64 / 2.0;
    let first = libm::round(middle).rem_euclid(values.len() as f64) as usize;
    let cut = (0..width).map(|by| values[(first + by) % values.len()].min(WALL));
    cut.sum::<f64>() / width as f64 / WALL
}

/// Returns the junctions, dead ends, start and goals of a maze and where their ways lead, by the
/// number of their cell.
fn true_places(maze: &Maze, world: &World) -> Places {
    let fragments = TrueFragments::of(maze);
    let site = |cell: Cell| maze.grid().index(cell) as u32;
    let places = fragments.ways().map(|(cell, ..)| {
        let leads = |way| fragments.way(cell, heading_of(way)).map(|way| site(way.to));
        let place = TruePlace {
            site: site(cell),
            position: world.cell_centre(cell),
            ways: Direction::ALL.map(leads),
        };
        (site(cell), place)
    });
    places.collect()
}

#[cfg(test)]
mod tests {
    use core::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn a_sweep_says_where_walls_are() {
        let mut values = vec![0.0; 100];
        values[20..30].fill(500.0);
        let profile = Profile::from_values(values).unwrap();
        assert!((value_at(&profile, FRAC_PI_2) - 1.0).abs() < 1e-12);
        assert!(value_at(&profile, -FRAC_PI_2).abs() < 1e-12);
        assert_eq!(direction_of(Heading::from_degrees(80.0)), Direction::North);
        assert_eq!(
            direction_of(Heading::from_degrees(-100.0)),
            Direction::South
        );
    }
}
