use std::sync::OnceLock;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::diktiometry::JournalLength;
use tolman_maze::{Maze, MazeFile};
use tolman_robot::Ring;
use tolman_sim::robots::{Epuck, LaserPioneer, LaserPioneerConfig, Pioneer2dx, Pioneer2dxConfig};
use tolman_systems::Actor;
use tolman_systems::cpm::{
    CommonPatterns, Cpm, CpmConfig, Lesson, Mode, RingAsEpuck, Walker, WalkerConfig, soinn, wander,
};
use tolman_systems::diktiometry::{Diktiometer, DiktiometerConfig, LaserEye};
use tolman_systems::gngslam::{OfflineSlam, OfflineSlamConfig, OnlineSlam, OnlineSlamConfig};
use tolman_systems::micromouse::SIDE;
use tolman_systems::micromouse::noisy::{MotionSource, NoisyMouse, NoisyMouseConfig};
use tolman_systems::micromouse::system::{MazeMouse, MazeMouseConfig};
use tolman_systems::mslst::{BetterMslst, Mslst, MslstConfig};

use super::condition::Condition;
use super::pathfinder::Pathfinder;
use super::play::Contest;
use super::true_graph::PlaceRule;
use crate::cast::Agent;
use crate::course::Course;
use crate::cpm::{self, epuck, epuck_course, patience, ring_measures, walker_config};
use crate::diktiometry::{Office, OfficeConfig, PlaceCue, SurveyorConfig, mapper, office_robot};
use crate::episode::layers;
use crate::micromouse::brief;
use crate::mslst::better_config;
use crate::pioneer::{
    CAMERA_PIONEER, CORRIDOR_WIDTH, ENCODER_SD, LASER_PIONEER, body, calibrated, with_sensor_noise,
};
use crate::{BoxError, Depicted, HasSimulated, Outing, Sent};

/// A system or baseline that is sent into a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contestant {
    /// [`Mslst`], which learns until it has driven as far as it may.
    Mslst,
    /// [`BetterMslst`], which uses encoders.
    MslstBetter,
    /// [`Cpm`] online, as in the paper.
    Cpm,
    /// [`Cpm`] with dead reckoning and several hypotheses.
    CpmBetter,
    /// [`Diktiometer`] with the paper's rules.
    Diktiometry,
    /// [`Diktiometer`] with a journal of all its moves. It also merges places by their looks.
    DiktiometryBetter,
    /// [`OfflineSlam`], which gathers records until it has driven as far as it may, and then learns
    /// a map from them.
    GngSlam,
    /// [`OnlineSlam`], whose places are points on the floor.
    GngSlamBetter,
    /// [`MazeMouse`], which is told the grid, its start and the goal.
    Micromouse,
    /// [`NoisyMouse`], which is told the same and has no compass. It localizes with a particle
    /// filter over the walls it believes in: what many would choose instead.
    WallBelief,
    /// A baseline, which learns no map.
    Baseline(Agent),
}

/// The robot that a contestant drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ContestRobot {
    /// The robot of the contestant's paper.
    Own,
    /// The laser Pioneer with compass and encoders.
    Pioneer,
}

/// A contestant at the start of a world, which is scaled to its robot.
pub(super) struct Entered {
    /// The system with its robot.
    pub(super) outing: Box<dyn Outing>,
    /// Distance between the middles of two cells of the drawing, m.
    pub(super) pitch: f64,
}

/// Knowledge that contestants learn once, before they are sent out.
#[derive(Debug, Default)]
pub struct Schooling {
    epuck: OnceLock<CommonPatterns>,
    pioneer: OnceLock<CommonPatterns>,
}

/// Maze in which common patterns are learned.
const LEARNING_MAZE: &str = include_str!("../../mazes/cpm-learning.maze");

/// Seed for the knowledge learned before a contest.
const SCHOOL_SEED: u64 = 1;

/// Number of observations in that lesson on the Pioneer.
const LESSON: usize = 300;

/// Number of colours of the walls, for robots with a camera.
const COLOURS: u32 = 8;

/// Initial limit of time steps, before the contest [allows](Outing::allow) more.
const NO_STEPS: u32 = 0;

/// Corridor width for robots that keep away from what is near, such as GNG-SLAM's, m.
const WIDE: f64 = 1.5;

/// Number of time steps per cell for which MSLST records scans. It also maps for this many actions
/// per cell. Together they use most of the distance that it may drive.
const SCANS_A_CELL: u32 = 10;
const ACTIONS_A_CELL: u32 = 6;

/// Number of the laser's beams that the wall belief's filter weighs.
const BEAMS: u32 = 8;

/// Number of records per cell that GNG-SLAM takes. They use most of the distance that it may drive.
const RECORDS_A_CELL: usize = 5;

impl Contestant {
    /// All contestants, systems first.
    pub const ALL: [Self; 15] = [
        Self::Mslst,
        Self::MslstBetter,
        Self::Cpm,
        Self::CpmBetter,
        Self::Diktiometry,
        Self::DiktiometryBetter,
        Self::GngSlam,
        Self::GngSlamBetter,
        Self::Micromouse,
        Self::WallBelief,
        Self::Baseline(Agent::Random),
        Self::Baseline(Agent::Avoid),
        Self::Baseline(Agent::WallFollow),
        Self::Baseline(Agent::Oracle),
        Self::Baseline(Agent::UnlocalizedOracle),
    ];

    /// Returns the name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mslst => "MSLST",
            Self::MslstBetter => "MSLST Better",
            Self::Cpm => "CPM",
            Self::CpmBetter => "CPM Better",
            Self::Diktiometry => "Diktiometry",
            Self::DiktiometryBetter => "Diktiometry Better",
            Self::GngSlam => "GNG-SLAM",
            Self::GngSlamBetter => "GNG-SLAM Better",
            Self::Micromouse => "Micromouse",
            Self::WallBelief => "Wall belief",
            Self::Baseline(agent) => agent.name(),
        }
    }

    /// Returns the contestant of a name, as in tables or as typed: `cpm-better` is CPM Better.
    /// `None` if there is none.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let slug = |name: &str| name.to_lowercase().replace(' ', "-");
        let mut all = Self::ALL.into_iter();
        all.find(|contestant| slug(contestant.name()) == slug(name))
    }

    /// Returns whether the contestant learns a map. Only the baselines do not.
    #[must_use]
    pub const fn learns(self) -> bool {
        !matches!(self, Self::Baseline(_))
    }

    /// Returns the name of the robot that it drives.
    #[must_use]
    pub const fn robot(self, robot: ContestRobot) -> &'static str {
        match (self, robot) {
            (Self::Cpm | Self::CpmBetter, ContestRobot::Own) => "e-puck",
            (Self::Diktiometry | Self::DiktiometryBetter, ContestRobot::Own) => CAMERA_PIONEER,
            (Self::GngSlam | Self::GngSlamBetter, ContestRobot::Own) => Pioneer2dx::NAME,
            _ => LASER_PIONEER,
        }
    }

    /// Returns whether the contestant's robot knows where north is.
    pub(super) const fn has_compass(self, robot: ContestRobot) -> bool {
        !matches!(
            (self, robot),
            (
                Self::Cpm | Self::CpmBetter | Self::GngSlam | Self::GngSlamBetter,
                ContestRobot::Own
            )
        )
    }

    /// Returns the maximum number of cells that its robot sees straight on through an opening.
    pub(super) const fn sees_cells(self, robot: ContestRobot) -> u32 {
        match (self, robot) {
            (Self::GngSlam | Self::GngSlamBetter, _) => 3,
            (Self::Diktiometry | Self::DiktiometryBetter, ContestRobot::Own) => 5,
            _ => 1,
        }
    }

    /// Returns whether the contestant's robot sees the colours of walls.
    pub(super) const fn sees_colours(self, robot: ContestRobot) -> bool {
        matches!(
            (self, robot),
            (
                Self::Diktiometry | Self::DiktiometryBetter,
                ContestRobot::Own
            )
        )
    }

    /// Returns the pose of the map's frame in the world, for a robot that started at `start`. Only
    /// pictures use it.
    #[must_use]
    pub const fn world_from_map(self, start: Pose) -> Pose {
        match self {
            // Its axes are those of the compass.
            Self::MslstBetter => Pose::new(start.position, Heading::EAST),
            Self::GngSlamBetter => start,
            _ => Pose::new(Point::new(0.0, 0.0), Heading::EAST),
        }
    }

    /// Returns the rule for the cells that are places of this system. If it treats another cell
    /// with two ways as a place, that cell counts as part of a way.
    #[must_use]
    pub const fn places(self) -> PlaceRule {
        match self {
            Self::Diktiometry | Self::DiktiometryBetter => PlaceRule::Corners,
            _ => PlaceRule::Landmarks,
        }
    }

    /// Returns whether being done means that it claims its map is that of the whole world. MSLST is
    /// done when it has used up its actions, and GNG-SLAM when it has its records. Neither claims
    /// that its places are right.
    #[must_use]
    pub const fn claims(self) -> bool {
        matches!(
            self,
            Self::MslstBetter
                | Self::Cpm
                | Self::CpmBetter
                | Self::Diktiometry
                | Self::DiktiometryBetter
                | Self::Micromouse
                | Self::WallBelief
        )
    }

    /// Returns the reason why it cannot work in a drawing, in a sentence without a full stop;
    /// `None` if it can.
    ///
    /// It decides by its own features and the robot's sensors alone. A system that cannot work
    /// abstains, and is not sent. O(cells).
    #[must_use]
    pub fn abstains(self, maze: &Maze, robot: ContestRobot) -> Option<String> {
        let room = maze.reachable().find(|cell| maze.is_room(*cell));
        let grid = maze.grid();
        match (self, robot, room) {
            (Self::Cpm | Self::CpmBetter, _, Some(cell)) => Some(format!(
                "it follows corridors, and there is an open square of 2 × 2 cells at {cell}"
            )),
            (Self::GngSlam, ContestRobot::Pioneer, _) => Some(
                "it tells places by what a camera sees, and the laser Pioneer has none".to_owned(),
            ),
            (Self::Micromouse | Self::WallBelief, ..)
                if grid.width().max(grid.height()) as usize > SIDE =>
            {
                Some(format!("it knows mazes of at most {SIDE} × {SIDE} cells"))
            }
            _ => None,
        }
    }

    /// Puts the contestant at the start of the contest's drawing, in corridors as wide as its robot
    /// needs.
    ///
    /// # Errors
    /// If it is a baseline, which is sent by other means, or robot and drawing do not fit together.
    pub(super) fn enter(
        self,
        contest: &Contest<'_>,
        schooling: &Schooling,
    ) -> Result<Entered, BoxError> {
        let Contest {
            maze,
            name,
            robot,
            seed,
            condition,
            ..
        } = *contest;
        match (self, robot) {
            (Self::Cpm | Self::CpmBetter, ContestRobot::Own) => {
                let course = contest.with_door(epuck_course(name, maze.clone().into())?)?;
                let (start, width) = (course.start()?, course.corridor_width);
                let robot = Epuck::new(condition.epuck(epuck()))?;
                let body = course.robot_at(start, robot, seed)?;
                let walker = walker_config(&epuck(), width)?;
                let patterns = schooling.of_epuck()?;
                Ok(self.sent_by_patterns(course, body, walker, patterns, maze, seed))
            }
            (Self::Cpm | Self::CpmBetter, ContestRobot::Pioneer) => {
                let course = contest.with_door(pioneer_course(name, maze)?)?;
                let body = ring_as_epuck(&course, condition, seed)?;
                let measures = ring_measures(&calibrated(), course.corridor_width);
                let (walker, patterns) = (measures.walker_config(), schooling.of_pioneer()?);
                Ok(self.sent_by_patterns(course, body, walker, patterns, maze, seed))
            }
            (Self::Diktiometry | Self::DiktiometryBetter, _) => self.sent_through_office(contest),
            (Self::Mslst, _) => {
                let course = contest.with_door(pioneer_course(name, maze)?)?;
                let stack = layers(&course, &calibrated())?;
                let cells = maze.reachable().count() as u32;
                let mut config = MslstConfig::large(50.0);
                config.scan_steps = SCANS_A_CELL * cells;
                config.graph_actions = ACTIONS_A_CELL * cells;
                let actor = Actor::seeded(Mslst::new(config), stack, seed);
                let body = laser_pioneer(&course, condition, seed)?;
                Ok(sent(course, body, actor))
            }
            (Self::MslstBetter, _) => {
                let course = contest.with_door(pioneer_course(name, maze)?)?;
                let robot = match robot {
                    ContestRobot::Own => with_sensor_noise(&calibrated(), ENCODER_SD),
                    ContestRobot::Pioneer => calibrated(),
                };
                let config = better_config(course.corridor_width, &robot);
                let stack = layers(&course, &robot)?;
                let brain = BetterMslst::new(config, robot.ring);
                let actor = Actor::seeded(brain, stack, seed);
                let robot = LaserPioneer::new(condition.laser_pioneer(robot, seed))?;
                let body = course.robot_at(course.start()?, robot, seed)?;
                Ok(sent(course, body, actor))
            }
            (Self::Micromouse, _) => {
                let course = contest.with_door(pioneer_course(name, maze)?)?;
                let robot = calibrated();
                let config = MazeMouseConfig::new(
                    course.corridor_width,
                    robot.turn_per_step,
                    robot.translate_per_step,
                );
                let mouse = MazeMouse::whole_maze(brief(maze)?, config)?;
                let body = laser_pioneer(&course, condition, seed)?;
                Ok(sent(course, body, mouse))
            }
            (Self::WallBelief, _) => {
                let course = contest.with_door(pioneer_course(name, maze)?)?;
                let mut robot = calibrated();
                robot.ring = Ring::full(BEAMS, calibrated().ring.max_range);
                let config = believing(&robot, course.corridor_width);
                let mouse = NoisyMouse::new(brief(maze)?, config, seed)?;
                let robot = LaserPioneer::new(condition.laser_pioneer(robot, seed))?;
                let body = course.robot_at(course.start()?, robot, seed)?;
                Ok(sent(course, body, mouse))
            }
            (Self::GngSlam, _) => {
                let course = contest.with_door(Course::new(name, maze.clone(), WIDE)?)?;
                let robot = condition.pioneer_2dx(Pioneer2dxConfig::paper(), seed);
                let robot = Pioneer2dx::new(robot)?;
                let body = course.robot_at(course.start()?, robot, seed)?;
                let records = RECORDS_A_CELL * maze.reachable().count();
                let mut config = OfflineSlamConfig::paper();
                config.records = records.max(2);
                Ok(sent(course, body, OfflineSlam::new(config, seed)))
            }
            (Self::GngSlamBetter, ContestRobot::Own) => {
                let course = contest.with_door(Course::new(name, maze.clone(), WIDE)?)?;
                let robot = condition.pioneer_2dx(Pioneer2dxConfig::paper(), seed);
                let robot = Pioneer2dx::new(robot)?;
                let body = course.robot_at(course.start()?, robot, seed)?;
                let config = OnlineSlamConfig::pioneer_2dx();
                Ok(sent(course, body, OnlineSlam::new(config, seed)))
            }
            (Self::GngSlamBetter, ContestRobot::Pioneer) => {
                let course = contest.with_door(Course::new(name, maze.clone(), WIDE)?)?;
                let mut robot = calibrated();
                robot.ring = Ring::full(90, 4.0);
                let mut config = OnlineSlamConfig::pioneer_2dx();
                // The same distance and turn per time step as the Pioneer 2-DX.
                config.drive.translate = 0.04 / robot.translate_per_step;
                config.drive.turn = 0.1;
                let body = LaserPioneer::new(condition.laser_pioneer(robot, seed))?;
                let body = course.robot_at(course.start()?, body, seed)?;
                Ok(sent(course, body, OnlineSlam::new(config, seed)))
            }
            (Self::Baseline(agent), _) => Err(format!("{} learns no map", agent.name()).into()),
        }
    }

    fn sent_by_patterns<R>(
        self,
        course: Course,
        robot: R,
        mut walker: WalkerConfig,
        patterns: CommonPatterns,
        maze: &Maze,
        seed: u64,
    ) -> Entered
    where
        R: cpm_robot::Any + HasSimulated + 'static,
    {
        let mode = match self {
            // It does not notice that its map grows without end; the contest does.
            Self::Cpm => {
                let mut config = CpmConfig::online();
                config.most_traversals = patience(maze);
                Mode::Paper(config)
            }
            _ => Mode::Reckoned(CpmConfig::robust()),
        };
        let config = mode.config();
        walker.heading = mode.heading();
        let system = Cpm::new(walker, patterns, config, seed);
        sent(course, robot, system)
    }

    fn sent_through_office(self, contest: &Contest<'_>) -> Result<Entered, BoxError> {
        let Contest {
            maze,
            name,
            robot,
            seed,
            condition,
            ..
        } = *contest;
        let furniture = OfficeConfig {
            colours: match robot {
                ContestRobot::Own => COLOURS,
                ContestRobot::Pioneer => 1,
            },
            seed,
            ..OfficeConfig::bare()
        };
        let mut office = Office::new(maze, &furniture)?.named(name);
        office.course = contest.with_door(office.course)?;
        let (start, _) = maze.start().ok_or("the drawing marks no start")?;
        let at = super::whereabouts::Squares {
            grid: maze.grid(),
            pitch: furniture.pitch(),
        }
        .middle(start);
        let config = match robot {
            ContestRobot::Own => SurveyorConfig::paper(),
            ContestRobot::Pioneer => SurveyorConfig::mslst(),
        };
        let made = condition.surveyor(config.clone(), seed);
        let routines = config.routines(furniture.corridor_width);
        let mut mapping = mapper(&office, &config);
        if self == Self::DiktiometryBetter {
            mapping.journal = JournalLength::All;
            mapping.restructuring.merge_by_looks_and_turns();
        }
        let paper = DiktiometerConfig::paper(routines, mapping);
        let course = office.course.clone();
        let pitch = furniture.pitch();
        let pose = tolman_geom::Pose::new(at, tolman_geom::Heading::NORTH);
        Ok(match (robot, config.sight) {
            (ContestRobot::Pioneer, PlaceCue::Laser { columns }) => {
                let body = LaserPioneer::new(made.laser_robot())?;
                let body = course.robot_at(pose, body, seed)?;
                sent_at(course, body, eyed(paper, LaserEye { columns }, seed), pitch)
            }
            _ => {
                let body = office_robot(&office, &made, pose, seed)?;
                sent_at(course, body, eyed(paper, config.sight, seed), pitch)
            }
        })
    }
}

fn eyed<E: Clone>(config: DiktiometerConfig, eye: E, seed: u64) -> Pathfinder<E> {
    let learner = Diktiometer::new(config, eye.clone(), seed);
    Pathfinder::new(learner, eye, seed)
}

/// Robots that CPM can drive, whatever their errors are.
mod cpm_robot {
    use tolman_robot::Robot;
    use tolman_systems::cpm::CpmRobot;

    pub(super) trait Any:
        CpmRobot + Robot<Error: core::error::Error + Send + Sync + 'static>
    {
    }

    impl<R> Any for R where R: CpmRobot + Robot<Error: core::error::Error + Send + Sync + 'static> {}
}

fn sent<R, S>(course: Course, robot: R, system: S) -> Entered
where
    R: tolman_robot::SensesLandmarks + HasSimulated + 'static,
    S: tolman_robot::System<crate::run::Limited<R>, Failure: Into<BoxError>> + 'static,
{
    let pitch = course.corridor_width;
    sent_at(course, robot, system, pitch)
}

fn sent_at<R, S>(course: Course, robot: R, system: S, pitch: f64) -> Entered
where
    R: tolman_robot::SensesLandmarks + HasSimulated + 'static,
    S: tolman_robot::System<crate::run::Limited<R>, Failure: Into<BoxError>> + 'static,
{
    let outing = Box::new(Sent::new(course, robot, NO_STEPS, system));
    Entered { outing, pitch }
}

/// Returns a drawing as a course in corridors of the laser Pioneer's width.
///
/// # Errors
/// If the drawing has no goal that can be reached.
pub(super) fn pioneer_course(name: &str, maze: &Maze) -> Result<Course, BoxError> {
    let file = MazeFile::from(maze.clone());
    Ok(Course::for_body(name, &file, &body())?)
}

/// Returns the noisy mouse's configuration for a Pioneer among thin walls, whose encoders and
/// ranges are off by a few percent.
const fn believing(robot: &LaserPioneerConfig, pitch: f64) -> NoisyMouseConfig {
    let mut config = NoisyMouseConfig::new(pitch, robot.turn_per_step, robot.translate_per_step);
    config.motion = MotionSource::Encoders;
    config
}

fn laser_pioneer(
    course: &Course,
    condition: Condition,
    seed: u64,
) -> Result<crate::Simulated<LaserPioneer>, BoxError> {
    let robot = LaserPioneer::new(condition.laser_pioneer(calibrated(), seed))?;
    Ok(course.robot_at(course.start()?, robot, seed)?)
}

fn ring_as_epuck(
    course: &Course,
    condition: Condition,
    seed: u64,
) -> Result<RingAsEpuck<crate::Simulated<LaserPioneer>>, BoxError> {
    let measures = ring_measures(&calibrated(), course.corridor_width);
    Ok(RingAsEpuck::new(
        laser_pioneer(course, condition, seed)?,
        measures,
    )?)
}

impl Schooling {
    /// Returns the common patterns that the e-puck learns in the learning maze (section 4.1 of
    /// CPM's paper).
    fn of_epuck(&self) -> Result<CommonPatterns, BoxError> {
        let learned = self.epuck.get().cloned();
        if let Some(learned) = learned {
            return Ok(learned);
        }
        let course = epuck_course("learning", tolman_maze::read(LEARNING_MAZE)?)?;
        let learned = cpm::learn(&course, SCHOOL_SEED)?;
        Ok(self.epuck.get_or_init(|| learned).clone())
    }

    /// Returns the common patterns that the Pioneer learns in the learning maze.
    fn of_pioneer(&self) -> Result<CommonPatterns, BoxError> {
        let learned = self.pioneer.get().cloned();
        if let Some(learned) = learned {
            return Ok(learned);
        }
        let maze = tolman_maze::read(LEARNING_MAZE)?.maze;
        let course = Course::new("learning", maze, CORRIDOR_WIDTH)?;
        let robot = ring_as_epuck(&course, Condition::AsMade, SCHOOL_SEED)?;
        let config = ring_measures(&calibrated(), CORRIDOR_WIDTH).walker_config();
        let mut walker = Walker::new(robot, config);
        let mut rng = ChaCha8Rng::seed_from_u64(SCHOOL_SEED);
        let seen = wander(&mut walker, Lesson::Observations(LESSON), &mut rng)?;
        let learned = CommonPatterns::learn(&seen, soinn())?;
        Ok(self.pioneer.get_or_init(|| learned).clone())
    }
}
