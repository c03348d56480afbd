use anyhow::{Context, Error, anyhow};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use tolman_arena::course::{Course, Terrain};
use tolman_arena::cpm::{
    Layout, SimulatedEpuck, TrueFragments, epuck, epuck_course, epuck_course_on,
    is_whole_map_right, learn, ring_measures, walker_config,
};
use tolman_arena::pioneer::{CoursePioneer, LASER_PIONEER, body, calibrated};
use tolman_arena::{BoxError, HasSimulated, Outing, Sent};
use tolman_draw::Drawing;
use tolman_geom::Pose;
use tolman_maps::cpm::{CpMap, JunctionId, PlanLeg, Turn};
use tolman_maze::{Cell, Maze};
use tolman_papers::cpm::drawing;
use tolman_robot::{Landmark, Task};
use tolman_sim::robots::Epuck;
use tolman_systems::Origin;
use tolman_systems::cpm::{
    self, CommonPatterns, CpmConfig, CpmRobot, Lesson, MapFile, Mode, RingAsEpuck, Walker,
    WalkerConfig, soinn, wander,
};

use crate::start::Start;
use crate::system::{LearnedMap, MapText, Setup, SystemEntry, pioneer_at};

/// [`cpm`] on the e-puck, or on the laser Pioneer used as one.
#[derive(Clone, Copy, Debug)]
pub struct CpmEntry;

const PRESETS: [(&str, &str); 3] = [
    (
        "better",
        "By dead reckoning too, for fragments that look alike",
    ),
    (
        "faithful",
        "As the paper's robot, online: by common patterns alone",
    ),
    (
        "unlearned",
        "As better, without a learning maze: patterns are learned on the way",
    ),
];

/// Returns the configurations of the presets.
fn modes() -> [Mode; 3] {
    [
        Mode::Reckoned(CpmConfig::robust()),
        Mode::Paper(CpmConfig::online()),
        Mode::Unlearned(CpmConfig::robust()),
    ]
}

const EPUCK: &str = "e-puck";

/// Maze in which common patterns are learned.
const LEARNING_MAZE: &str = include_str!("../../mazes/cpm-learning.maze");

impl SystemEntry for CpmEntry {
    fn name(&self) -> &'static str {
        "cpm"
    }

    fn about(&self) -> &'static str {
        "Turns paths into sequences of common patterns, and reasons about junctions"
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        &PRESETS
    }

    fn robots(&self) -> &'static [&'static str] {
        &[EPUCK, LASER_PIONEER]
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, Error> {
        setup.anew(self.name())?;
        let names = PRESETS.map(|(name, _)| name);
        let mode = setup.settings.preset(names.into_iter().zip(modes()))?;
        let config = setup.settings.over(&mode.config())?;
        let mode = mode.with(config);
        let ground = Ground::of(setup, mode, Start::Marked)?;
        let walker = ground.walker.clone();
        let cpm = match mode {
            Mode::Unlearned(_) => cpm::Cpm::unlearned(walker, config, setup.seed)?,
            Mode::Paper(_) | Mode::Reckoned(_) => {
                let patterns = ground.patterns(setup.seed)?;
                cpm::Cpm::new(walker, patterns, config, setup.seed)
            }
        };
        ground.send(setup, mode, cpm)
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, Error> {
        let files = read_all(maps)?;
        let first = files.first().ok_or_else(|| anyhow!("no map is given"))?;
        let mode = first.mode;
        let config = setup.settings.over(&mode.config())?;
        let ground = Ground::of(setup, mode, Start::Random)?;
        let known = files.iter().map(|file| file.map.clone()).collect();
        let (walker, patterns) = (ground.walker.clone(), first.patterns.clone());
        let cpm = cpm::Cpm::with_maps(walker, patterns, config, known, setup.seed)?;
        ground.send(setup, mode, cpm)
    }

    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, Error> {
        let file = MapFile::from_json(&map.text).with_context(|| map.name.clone())?;
        Ok(Box::new(file))
    }
}

/// Returns the maps of all files, which must use the same patterns.
fn read_all(maps: &[MapText]) -> Result<Vec<MapFile>, Error> {
    let mut files: Vec<MapFile> = Vec::new();
    for map in maps {
        let file = MapFile::from_json(&map.text).with_context(|| map.name.clone())?;
        let version = |file: &MapFile| file.patterns.dictionary().version();
        if files
            .first()
            .is_some_and(|first| version(first) != version(&file))
        {
            return Err(anyhow!(
                "{} is written in other patterns than {}: learn both with the same --seed, and no --preset unlearned",
                map.name,
                maps[0].name
            ));
        }
        files.push(file);
    }
    Ok(files)
}

/// Course that a robot is sent into, and the configuration of its walk.
struct Ground {
    robot: &'static str,
    course: Course,
    start: Pose,
    walker: WalkerConfig,
}

impl Ground {
    fn of(setup: &Setup<'_>, mode: Mode, usual: Start) -> Result<Self, Error> {
        let robot = setup.robot(CpmEntry.robots())?;
        let course = match robot {
            EPUCK => epuck_course_on(setup.world, setup.terrain)?,
            _ => setup.terrain.course(setup.world, &body())?,
        };
        let mut walker = walker(robot, course.corridor_width)?;
        walker.heading = mode.heading();
        let start = setup.start(&course, usual, || course.anywhere(setup.seed))?;
        Ok(Self {
            robot,
            course,
            start,
            walker,
        })
    }

    /// Returns the common patterns that the robot learns in the learning maze (section 4.1).
    fn patterns(&self, seed: u64) -> Result<CommonPatterns, Error> {
        match self.robot {
            EPUCK => patterns_of_epuck(seed),
            _ => {
                let maze = tolman_maze::read(LEARNING_MAZE)?.maze;
                let course = Course::new("learning", maze, self.course.corridor_width)?;
                let robot = ring_at(&course, course.start()?, seed)?;
                let config = walker(self.robot, course.corridor_width)?;
                let mut walker = Walker::new(robot, config);
                let mut rng = ChaCha8Rng::seed_from_u64(seed);
                let seen = wander(&mut walker, Lesson::Observations(300), &mut rng)?;
                Ok(CommonPatterns::learn(&seen, soinn())?)
            }
        }
    }

    fn send(self, setup: &Setup<'_>, mode: Mode, cpm: cpm::Cpm) -> Result<Box<dyn Outing>, Error> {
        let (start, seed) = (self.start, setup.seed);
        match self.robot {
            EPUCK => {
                let robot = epuck_at(&self.course, start, seed)?;
                Ok(self.send_with(robot, setup, mode, cpm))
            }
            _ => {
                let robot = ring_at(&self.course, start, seed)?;
                Ok(self.send_with(robot, setup, mode, cpm))
            }
        }
    }

    fn send_with<R>(self, robot: R, setup: &Setup<'_>, mode: Mode, cpm: cpm::Cpm) -> Box<dyn Outing>
    where
        R: CpmRobot<Error: core::error::Error + Send + Sync + 'static> + HasSimulated + 'static,
    {
        let origin = setup.origin(&self.course, self.robot);
        let course = self.course;
        let at_start = course.start().is_ok_and(|start| start == self.start);
        let steps = setup.steps.unwrap_or_else(|| patient(&course));
        if course.is_free() {
            let sent = Sent::new(course, robot, steps, cpm)
                .choosing(cpm::Cpm::on)
                .keeping(move |cpm, _| keep(cpm, mode, &origin))
                .judged(|cpm, task| {
                    let map = cpm.explorer()?.mapper.map();
                    (task == Task::Explore).then(|| unfinished(map))?
                });
            return Box::new(sent);
        }
        let (world, maze) = (course.world.clone(), course.maze.clone());
        let ours = maze.clone();
        let sent = Sent::new(course, robot, steps, cpm)
            .choosing(cpm::Cpm::on)
            .keeping(move |cpm, _| keep(cpm, mode, &origin))
            .judged(move |cpm, task| {
                let map = cpm.explorer()?.mapper.map();
                (task == Task::Explore).then(|| complaint(map, &maze, at_start))?
            })
            .lying(move |cpm| {
                let layout = cpm
                    .explorer()
                    .map(|explorer| Layout::of(explorer.mapper.map(), &ours));
                let places = layout.iter().flat_map(Layout::places);
                places
                    .map(|(JunctionId(id), cell)| (id, world.cell_centre(cell)))
                    .collect()
            });
        Box::new(sent)
    }
}

/// Returns the default limit of time steps. In a maze there is none: the robot's own patience ends
/// its walk.
fn patient(course: &Course) -> u32 {
    match course.is_free() {
        true => course.step_limit().saturating_mul(FREE_STEPS),
        false => u32::MAX,
    }
}

/// Maximum number of time steps in a world with free walls, as a multiple of those of a run to the
/// goal.
const FREE_STEPS: u32 = 500;

fn walker(robot: &str, width: f64) -> Result<WalkerConfig, Error> {
    Ok(match robot {
        EPUCK => walker_config(&epuck(), width)?,
        _ => ring_measures(&calibrated(), width).walker_config(),
    })
}

fn epuck_at(course: &Course, start: Pose, seed: u64) -> Result<SimulatedEpuck, Error> {
    Ok(course.robot_at(start, Epuck::new(epuck())?, seed)?)
}

/// Returns the laser Pioneer, used as an e-puck.
fn ring_at(course: &Course, start: Pose, seed: u64) -> Result<RingAsEpuck<CoursePioneer>, Error> {
    let pioneer = pioneer_at(course, start, seed)?;
    let measures = ring_measures(&calibrated(), course.corridor_width);
    Ok(RingAsEpuck::new(pioneer, measures)?)
}

/// Returns the common patterns that the e-puck learns in the learning maze (section 4.1).
pub(crate) fn patterns_of_epuck(seed: u64) -> Result<CommonPatterns, Error> {
    let course = epuck_course("learning", tolman_maze::read(LEARNING_MAZE)?)?;
    Ok(learn(&course, seed)?)
}

fn keep(cpm: &cpm::Cpm, mode: Mode, origin: &Origin) -> Result<Option<String>, BoxError> {
    let Some(explorer) = cpm.explorer() else {
        return Ok(None);
    };
    let file = MapFile {
        origin: origin.clone(),
        mode,
        patterns: cpm.patterns().clone(),
        map: explorer.mapper.map().clone(),
    };
    Ok(Some(file.to_json()?))
}

/// Returns why a map of a world with free walls is unfinished, by its own account; `None` if it is
/// not. The true number of fragments is unknown there.
fn unfinished(map: &CpMap) -> Option<String> {
    let open = map.open_ports().count();
    (open > 0).then(|| {
        format!("{open} of its ports are unexplored: give it more --steps, or another --seed")
    })
}

/// Returns why a map is not that of the whole maze; `None` if it is. `at_start` says whether the
/// robot began at the maze's start.
fn complaint(map: &CpMap, maze: &Maze, at_start: bool) -> Option<String> {
    let (found, there_are) = (map.fragments().len(), TrueFragments::of(maze).count());
    if found != there_are as usize {
        let mut cells = maze.grid().cells();
        let room = cells.find(|cell| maze.is_room(*cell)).map(|Cell { x, y }| {
            format!(", which has an open room at cell {x}, {y}, where the robot finds no corridors")
        });
        return Some(format!(
            "{found} fragments for the {there_are} of the maze{}: the robot took some for others, or overlooked them; try \
             --preset better, or another --seed",
            room.unwrap_or_default()
        ));
    }
    if at_start && !is_whole_map_right(map, maze) {
        return Some(format!(
            "its {found} fragments are not joined as those of the maze: try --preset better, or another --seed"
        ));
    }
    None
}

impl LearnedMap for MapFile {
    fn lines(&self) -> Vec<String> {
        let Self {
            origin: Origin { world, seed, .. },
            patterns,
            map,
            ..
        } = self;
        let way = match observations_to_goal(map) {
            Some(length) => format!("the goal is {length} observations from the start"),
            None => "no way to the goal is known: learn until it is found".to_owned(),
        };
        vec![
            format!("{world}, seed {seed}"),
            format!(
                "a dictionary of {} patterns, of {} units in {} clusters",
                patterns.dictionary().len(),
                patterns.unit_count(),
                patterns.cluster_count()
            ),
            format!(
                "{} fragments, {} junctions, {} unexplored ports",
                map.fragments().len(),
                map.junctions().len(),
                map.open_ports().count()
            ),
            way,
        ]
    }

    fn json(&self) -> Value {
        let Self {
            origin: Origin { world, seed, .. },
            mode,
            patterns,
            map,
        } = self;
        json!({
            "system": CpmEntry.name(),
            "maze": world,
            "seed": seed,
            "mode": mode,
            "units": patterns.unit_count(),
            "clusters": patterns.cluster_count(),
            "fragments": map.fragments().len(),
            "junctions": map.junctions().len(),
            "unexplored_ports": map.open_ports().count(),
            "observations_to_goal": observations_to_goal(map),
        })
    }

    fn drawing(&self, terrain: &Terrain) -> Result<Drawing, Error> {
        if let Terrain::Free(_) = terrain {
            return Err(anyhow!(
                "a common-pattern map has no positions of its junctions, and a world of free walls has no cells to draw them \
                 over: leave --svg out; `tolman learn --replay` shows where the robot took them to be"
            ));
        }
        Ok(drawing::over_maze(&self.map, &course_of(self, terrain)?))
    }

    fn plan(&self, from: Option<u32>, to: Option<u32>) -> Result<Option<Vec<String>>, Error> {
        let map = &self.map;
        let known = |id: u32| match map.junction(JunctionId(id)) {
            Some(_) => Ok(JunctionId(id)),
            None => {
                let ids: Vec<String> = map.junctions().map(|(id, _)| id.0.to_string()).collect();
                Err(anyhow!(
                    "there is no junction {id}; choose one of: {}",
                    ids.join(", ")
                ))
            }
        };
        let from = match from {
            Some(id) => known(id)?.port(0),
            None => map
                .start()
                .ok_or_else(|| anyhow!("the map has no start: give --from"))?,
        };
        let to = to.map(known).transpose()?;
        let plan = map.plan(from, |id| match to {
            Some(to) => id == to,
            None => map.has(id, Landmark::Goal),
        });
        let step = |leg: &PlanLeg| {
            let (observations, to) = (leg.observations, leg.arrive.junction.0);
            match leg.turn {
                Turn::BACK => format!("back, {observations} observations to junction {to}"),
                Turn(way) => {
                    format!(
                        "way {way} from the right, {observations} observations to junction {to}"
                    )
                }
            }
        };
        Ok(plan.map(|plan| plan.legs.iter().map(step).collect()))
    }

    fn complaint(&self, terrain: &Terrain) -> Result<Option<String>, Error> {
        if let Terrain::Free(_) = terrain {
            return match unfinished(&self.map) {
                Some(why) => Ok(Some(why)),
                None => Err(anyhow!(
                    "the map has no unexplored ports, but nobody knows the true fragments of a world with free walls: \
                     drive by it with `tolman drive`"
                )),
            };
        }
        let course = course_of(self, terrain)?;
        Ok(complaint(&self.map, &course.maze, true))
    }
}

/// Returns the maze that a map was learned in, prepared for the robot that learned it.
fn course_of(file: &MapFile, terrain: &Terrain) -> Result<Course, Error> {
    Ok(match &*file.origin.robot {
        EPUCK => epuck_course_on(&file.origin.world, terrain)?,
        _ => terrain.course(&file.origin.world, &body())?,
    })
}

/// Returns the number of observations from the start of the map to the goal, by the best way that
/// it knows.
fn observations_to_goal(map: &CpMap) -> Option<u32> {
    let plan = map.plan(map.start()?, |junction| map.has(junction, Landmark::Goal));
    plan.map(|plan| plan.length)
}
