use serde_json::{Value, json};
use tolman_draw::Drawing;
use tolman_geom::Pose;
use tolman_maps::cpm::{CpMap, JunctionId, PlanLeg, Turn};
use tolman_maze::Maze;
use tolman_robot::{Landmark, MapView};
use tolman_sim::robots::Epuck;
use tolman_systems::Origin;
use tolman_systems::cpm::{
    self, CommonPatterns, CpmConfig, CpmRobot, MapFile, Mode, RingAsEpuck, WalkerConfig,
};

use crate::course::{Course, Terrain};
use crate::cpm::{Layout, epuck, epuck_course_on, patience, ring_measures, walker_config};
use crate::drawing;
use crate::pioneer::{CORRIDOR_WIDTH, body};
use crate::registry::any_robot::any;
use crate::registry::{
    DrivesBy, LearnedMap, LogMapper, MapText, Registry, RobotEntry, RobotKind, Setup, SystemEntry,
    SystemFacts,
};
use crate::{BoxError, HasSimulated, Outing, Sent};

/// [`cpm`] on the e-puck, or on a laser robot used as one.
#[derive(Clone, Copy, Debug)]
pub(super) struct CpmEntry {
    is_paper: bool,
}

impl CpmEntry {
    /// CPM online, as in the paper.
    pub(super) const PAPER: Self = Self { is_paper: true };
    /// CPM with dead reckoning and several hypotheses.
    pub(super) const BETTER: Self = Self { is_paper: false };
}

const PAPERS_PRESETS: [(&str, &str); 1] = [(
    "paper",
    "As the paper's robot, online: by common patterns alone",
)];

const PRESETS: [(&str, &str); 2] = [
    (
        "learned",
        "By dead reckoning too, for fragments that look alike",
    ),
    (
        "unlearned",
        "As learned, without a learning maze: patterns are learned on the way",
    ),
];

impl SystemEntry for CpmEntry {
    fn facts(&self) -> SystemFacts {
        let both = SystemFacts {
            needs: "needs infrared sensors or a plain laser ring",
            kinds: &[RobotKind::Epuck, RobotKind::Laser],
            own_robot: RobotEntry::EPUCK.name,
            why_no_log: "it tells ways apart by patterns of infrared readings: give cpm-better",
            delivers: true,
            drives: DrivesBy::AnyMap,
            ..SystemFacts::new("cpm")
        };
        match self.is_paper {
            true => SystemFacts {
                title: "CPM",
                about: "turns paths into sequences of common patterns, and reasons about junctions",
                is_paper: true,
                presets: &PAPERS_PRESETS,
                for_robot: Err(
                    "it learns its patterns in a maze of its own first: give cpm-better",
                ),
                ..both
            },
            false => SystemFacts {
                name: "cpm-better",
                title: "CPM Better",
                about: "adds dead reckoning and several hypotheses to common patterns; corridors alone",
                presets: &PRESETS,
                for_robot: Ok(|measures, robot, seed| {
                    any(cpm::Cpm::for_robot(measures, robot, seed))
                }),
                log_mapper: Some(LogMapper::Cpm),
                ..both
            },
        }
    }

    fn abstains(&self, maze: &Maze) -> Option<String> {
        let cell = maze.reachable().find(|cell| maze.is_room(*cell))?;
        Some(format!(
            "it follows corridors, and there is an open square of 2 × 2 cells at {cell}"
        ))
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        setup.anew(self.name())?;
        let robust = CpmConfig::robust();
        let mode = match self.is_paper {
            true => setup
                .settings
                .preset(&PAPERS_PRESETS, [papers_mode(setup)])?,
            false => {
                let modes = [Mode::Reckoned(robust), Mode::Unlearned(robust)];
                setup.settings.preset(&PRESETS, modes)?
            }
        };
        let config = setup.settings.over(&mode.config())?;
        let mode = mode.with(config);
        let ground = Ground::of(setup, mode)?;
        let walker = ground.walker.clone();
        let cpm = match mode {
            Mode::Unlearned(_) => cpm::Cpm::unlearned(walker, config, setup.seed)?,
            Mode::Paper(_) | Mode::Reckoned(_) => {
                let patterns = ground.patterns(setup)?;
                cpm::Cpm::new(walker, patterns, config, setup.seed)
            }
        };
        ground.send(setup, mode, cpm)
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let files = read_all(maps)?;
        let first = files.first().ok_or("no map is given")?;
        let mode = first.mode;
        let config = setup.settings.over(&mode.config())?;
        let ground = Ground::of(setup, mode)?;
        let known = files.iter().map(|file| file.map.clone()).collect();
        let (walker, patterns) = (ground.walker.clone(), first.patterns.clone());
        let cpm = cpm::Cpm::with_maps(walker, patterns, config, known, setup.seed)?;
        ground.send(setup, mode, cpm)
    }

    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, BoxError> {
        Ok(Box::new(map.parsed(MapFile::from_json)?))
    }
}

/// Returns the configuration of the paper's system. It does not notice that its map grows without
/// end; its patience does.
fn papers_mode(setup: &Setup<'_>) -> Mode {
    let mut config = CpmConfig::online();
    if let Terrain::Maze(file) = setup.terrain {
        config.most_traversals = patience(&file.maze);
    }
    Mode::Paper(config)
}

/// Returns the maps of all files, which must use the same patterns.
fn read_all(maps: &[MapText]) -> Result<Vec<MapFile>, BoxError> {
    let mut files: Vec<MapFile> = Vec::new();
    for map in maps {
        let file = map.parsed(MapFile::from_json)?;
        let version = |file: &MapFile| file.patterns.dictionary().version();
        if files
            .first()
            .is_some_and(|first| version(first) != version(&file))
        {
            return Err(format!(
                "{} is written in other patterns than {}: learn both again, without --preset unlearned",
                map.name, maps[0].name
            )
            .into());
        }
        files.push(file);
    }
    Ok(files)
}

/// Course that a robot is sent into, and the configuration of its walk.
struct Ground {
    course: Course,
    start: Pose,
    walker: WalkerConfig,
}

impl Ground {
    fn of(setup: &Setup<'_>, mode: Mode) -> Result<Self, BoxError> {
        let course = match setup.robot.kind() {
            RobotKind::Epuck => setup.with_doors(epuck_course_on(setup.world, setup.terrain)?)?,
            _ => setup.course(&body(), CORRIDOR_WIDTH)?,
        };
        let mut walker = match setup.robot.kind() {
            RobotKind::Epuck => walker_config(&epuck(), course.corridor_width)?,
            _ => ring_measures(&setup.robot.laser_config(), course.corridor_width).walker_config(),
        };
        walker.heading = mode.heading();
        let start = setup.start(&course, || course.anywhere(setup.seed))?;
        Ok(Self {
            course,
            start,
            walker,
        })
    }

    /// Returns the common patterns that the robot learns in the learning maze (section 4.1).
    fn patterns(&self, setup: &Setup<'_>) -> Result<CommonPatterns, BoxError> {
        match setup.robot.kind() {
            RobotKind::Epuck => setup.schooling.of_epuck(),
            _ => setup.schooling.of_pioneer(self.course.corridor_width),
        }
    }

    fn send(
        self,
        setup: &Setup<'_>,
        mode: Mode,
        cpm: cpm::Cpm,
    ) -> Result<Box<dyn Outing>, BoxError> {
        match setup.robot.kind() {
            RobotKind::Epuck => {
                let model = Epuck::new(setup.condition.epuck(epuck()))?;
                let robot = self.course.robot_at(self.start, model, setup.seed)?;
                Ok(self.send_with(robot, setup, mode, cpm))
            }
            _ => {
                let config = setup.robot.laser_config();
                let measures = ring_measures(&config, self.course.corridor_width);
                let robot = setup.laser_at(&self.course, self.start, config)?;
                let robot = RingAsEpuck::new(robot, measures)?;
                Ok(self.send_with(robot, setup, mode, cpm))
            }
        }
    }

    fn send_with<R>(self, robot: R, setup: &Setup<'_>, mode: Mode, cpm: cpm::Cpm) -> Box<dyn Outing>
    where
        R: CpmRobot<Error: core::error::Error + Send + Sync + 'static> + HasSimulated + 'static,
    {
        let origin = setup.origin(&self.course);
        let course = self.course;
        let steps = setup.steps.unwrap_or_else(|| patient(&course));
        let has_cells = !course.is_free();
        let (world, ours) = (course.world.clone(), course.maze.clone());
        let sent = Sent::new(course, robot, steps, cpm)
            .choosing(cpm::Cpm::on)
            .keeping(move |cpm, _| keep(cpm, mode, &origin))
            .lying(move |cpm, _| {
                let explorer = cpm.explorer().filter(|_| has_cells);
                let layout = explorer.map(|explorer| Layout::of(explorer.mapper.map(), &ours));
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

impl LearnedMap for MapFile {
    fn lines(&self) -> Vec<String> {
        let Self {
            origin,
            patterns,
            map,
            ..
        } = self;
        let way = match observations_to_goal(map) {
            Some(length) => format!("the goal is {length} observations from the start"),
            None => "no way to the goal is known: learn until it is found".to_owned(),
        };
        vec![
            format!("{}, seed {}", origin.world, origin.seed),
            format!(
                "a dictionary of {} patterns, of {} units in {} clusters",
                patterns.dictionary().len(),
                patterns.unit_count,
                patterns.cluster_count
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
            origin,
            mode,
            patterns,
            map,
        } = self;
        json!({
            "system": self.system(),
            "maze": origin.world,
            "seed": origin.seed,
            "mode": mode,
            "units": patterns.unit_count,
            "clusters": patterns.cluster_count,
            "fragments": map.fragments().len(),
            "junctions": map.junctions().len(),
            "unexplored_ports": map.open_ports().count(),
            "observations_to_goal": observations_to_goal(map),
        })
    }

    fn drawing(&self, terrain: &Terrain) -> Result<Drawing, BoxError> {
        if let Terrain::Free(_) = terrain {
            return Err(
                "a common-pattern map has no positions of its junctions, and a world of free walls has no cells to draw them \
                 over: leave --svg out; `tolman learn --replay` shows where the robot took them to be"
                    .into(),
            );
        }
        Ok(drawing::cpm::over_maze(
            &self.map,
            &self.course(&self.origin.world, terrain)?,
        ))
    }

    fn plan(&self, from: Option<u32>, to: Option<u32>) -> Result<Option<Vec<String>>, BoxError> {
        let map = &self.map;
        let known = |id: u32| match map.junction(JunctionId(id)) {
            Some(_) => Ok(JunctionId(id)),
            None => {
                let ids: Vec<String> = map.junctions().map(|(id, _)| id.0.to_string()).collect();
                Err(format!(
                    "there is no junction {id}; choose one of: {}",
                    ids.join(", ")
                ))
            }
        };
        let from = match from {
            Some(id) => known(id)?.port(0),
            None => map.start().ok_or("the map has no start: give --from")?,
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

    fn view(&self) -> Result<MapView, BoxError> {
        Ok(cpm::view(&self.map))
    }

    fn course(&self, world: &str, terrain: &Terrain) -> Result<Course, BoxError> {
        let robot = Registry::current().robot(&self.origin.robot);
        Ok(match robot.map(|robot| robot.kind()) {
            Some(RobotKind::Laser | RobotKind::Camera) => terrain.course(world, &body())?,
            _ => epuck_course_on(world, terrain)?,
        })
    }
}

/// Returns the number of observations from the start of the map to the goal, by the best way that
/// it knows.
fn observations_to_goal(map: &CpMap) -> Option<u32> {
    let plan = map.plan(map.start()?, |junction| map.has(junction, Landmark::Goal));
    plan.map(|plan| plan.length)
}
