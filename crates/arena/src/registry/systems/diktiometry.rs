use alloc::collections::BTreeMap;
use alloc::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use tolman_draw::Drawing;
use tolman_geom::{Heading, Interval, Point, Pose};
use tolman_maps::diktiometry::{
    Action, DecidingWalk, JournalLength, Link, Observer, OpenPair, PlaceId,
};
use tolman_maze::Direction;
use tolman_robot::{
    Guess, Landmark, MapView, Mapper, Scan, SensesLandmarks, Standing, Task, VisitNaming,
};
use tolman_sim::Bounds;
use tolman_systems::diktiometry::{
    Diktiometer, DiktiometerConfig, LandmarkSpot, LaserEye, Wayfinder,
};
use tolman_systems::stream;

use crate::contest::{Pathfinder, PlaceRule};
use crate::course::{Course, Terrain};
use crate::diktiometry::{
    Office, OfficeConfig, PlaceCue, Survey, SurveyConfig, SurveyFile, SurveyorConfig, mapper,
    office_robot,
};
use crate::drawing::diktiometry::map_over_world;
use crate::episode::START_STREAM;
use crate::registry::{
    LearnedMap, LogMapper, MapText, RobotEntry, RobotKind, Setup, Start, SystemEntry, because,
};
use crate::run::InRun;
use crate::{BoxError, Outing, RobotFacts, Sent};

/// The [diktiometry](tolman_systems::diktiometry) on a Pioneer in an office.
#[derive(Clone, Copy, Debug)]
pub(super) struct DiktiometryEntry {
    is_paper: bool,
}

impl DiktiometryEntry {
    /// With the paper's rules.
    pub(super) const PAPER: Self = Self { is_paper: true };
    /// With a journal of all its moves; it also merges places by their looks and by turns.
    pub(super) const BETTER: Self = Self { is_paper: false };
}

const PRESETS: [(&str, &str); 2] = [
    (
        "paper",
        "As the paper's robot, which heeds advice in 30 % of the cases",
    ),
    (
        ARENA,
        "As in the arena: until nothing is left to learn, with eight colours for a camera",
    ),
];

/// Preset for contests.
const ARENA: &str = "arena";

/// Number of colours of the walls in the arena, for robots with a camera.
const COLOURS: u32 = 8;

/// Number of moves between two questions whether the map grows without end.
const ASKED: u32 = 50;

/// The part of this system that needs mazes, for error messages.
const OFFICE: &str = "the diktiometry's office";

/// Settings for learning: of the robot's walk, and of the world made from the maze.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Learning {
    /// Number of moves to make, each from one place to the next.
    moves: u32,
    /// Probability that the robot begins a script when the map advises one, 0 … 1.
    heed: f64,
    /// Number of colours that the walls have.
    colours: u32,
    /// Share of the passages that are doorways, 0 … 1.
    doorways: f64,
}

const LEARNING: Learning = Learning {
    moves: 500,
    heed: 0.3,
    colours: 1,
    doorways: 0.0,
};

/// Settings for continuing a map. The world stays furnished as it was.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct GoingOn {
    moves: u32,
    heed: f64,
}

/// Settings for driving by a map.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Driving {
    heed: f64,
}

impl SystemEntry for DiktiometryEntry {
    fn name(&self) -> &'static str {
        match self.is_paper {
            true => "diktiometry",
            false => "diktiometry-better",
        }
    }

    fn title(&self) -> &'static str {
        match self.is_paper {
            true => "Diktiometry",
            false => "Diktiometry Better",
        }
    }

    fn about(&self) -> &'static str {
        match self.is_paper {
            true => "maps places with bounds on where they lie, and advises the planner",
            false => {
                "maps places that look alike, with a journal of all its moves, and advises the planner"
            }
        }
    }

    fn is_paper(&self) -> bool {
        self.is_paper
    }

    fn needs(&self) -> &'static str {
        "needs a compass and a camera that sees colours, or a laser ring"
    }

    fn kinds(&self) -> &'static [RobotKind] {
        &[RobotKind::Camera, RobotKind::Laser]
    }

    fn own_robot(&self) -> &'static str {
        RobotEntry::CAMERA_PIONEER.name
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        &PRESETS
    }

    fn arena_preset(&self) -> Option<&'static str> {
        Some(ARENA)
    }

    fn log_mapper(&self) -> Option<LogMapper> {
        (!self.is_paper).then_some(LogMapper::Diktiometry)
    }

    fn why_no_log(&self) -> &'static str {
        "it keeps no journal of its moves: give diktiometry-better"
    }

    fn drives(&self) -> bool {
        true
    }

    fn places(&self) -> PlaceRule {
        PlaceRule::Corners
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        if setup
            .settings
            .preset(PRESETS.map(|(name, _)| (name, name)))?
            == ARENA
        {
            return self.sent(setup);
        }
        if setup.start.is_some_and(|start| start != Start::Random) {
            return Err("the diktiometry begins at a random place: leave --start out".into());
        }
        if let Some(map) = setup.from {
            let mut before = read(map)?;
            let going_on: GoingOn = setup.settings.over(&GoingOn {
                moves: LEARNING.moves,
                heed: before.config.heed,
            })?;
            // The given maze, furnished like the one in which the map was learned.
            let maze = setup.terrain.maze(OFFICE)?;
            let office = Office::new(&maze.maze, before.office.config())?;
            before.office = Arc::new(office.named(setup.world));
            before.config.heed = going_on.heed;
            let survey = before.survey(setup.seed)?;
            return Ok(Box::new(Surveying {
                survey,
                moves: going_on.moves,
                most_steps: setup.steps.unwrap_or(u32::MAX),
                world: before.origin.world,
                seed: before.origin.seed,
                made: 0,
            }));
        }
        let learning: Learning = setup.settings.over(&LEARNING)?;
        let robot = surveyor(&setup.robot);
        let mut furniture = OfficeConfig::bare();
        furniture.doorway_share = learning.doorways;
        furniture.colours = learning.colours;
        furniture.seed = setup.seed;
        let maze = setup.terrain.maze(OFFICE)?;
        let office = Office::new(&maze.maze, &furniture)?;
        let office = Arc::new(office.named(setup.world));
        let mut config = SurveyConfig::of(&office, robot, learning.moves);
        config.heed = learning.heed;
        config.mapper.journal = JournalLength::All;
        if !self.is_paper {
            config.mapper.restructuring.merge_by_looks_and_turns();
        }
        let survey = Survey::new(&office, config, setup.seed)?;
        Ok(Box::new(Surveying {
            survey,
            moves: learning.moves,
            most_steps: setup.steps.unwrap_or(u32::MAX),
            world: setup.world.to_owned(),
            seed: setup.seed,
            made: 0,
        }))
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let [map] = maps else {
            return Err("the diktiometry drives by one map: give --map once".into());
        };
        let file = read(map)?;
        let heed = file.config.heed;
        let Driving { heed } = setup.settings.over(&Driving { heed })?;
        let SurveyFile {
            config,
            past,
            observer,
            ..
        } = &file;
        // The given maze, furnished like the one in which the map was learned.
        let maze = setup.terrain.maze(OFFICE)?;
        let office = Office::new(&maze.maze, file.office.config())?;
        let office = office.named(setup.world);
        let robot = &config.robot;
        let mut routines = robot.routines(office.config().corridor_width);
        routines.doorway_width = Some(office.config().doorway_width());
        let steps = setup.steps.unwrap_or(100_000);
        // The goal is where the robot came to it while learning.
        let goal = file.goal();
        let name = config.robot.name();
        if let Some(start) = setup.start {
            let rng = &mut stream(setup.seed, START_STREAM);
            let random = || Some(office.random_start(&robot.body(), rng));
            let start = start.on(&office.course, random)?;
            if !office.is_in_corridor(start.position) {
                let Point { coords: at, .. } = start.position;
                return Err(format!(
                    "({}, {}) m lies between the corridors, which are {} m wide and {} m apart; start in one",
                    at.x,
                    at.y,
                    office.config().corridor_width,
                    office.config().pitch()
                )
                .into());
            }
            let body = office_robot(&office, robot, start, setup.seed)?;
            let map = observer.clone();
            let system = Wayfinder::new(routines, robot.sight, map, goal, setup.seed);
            let sent = Sent::new(office.course, body, steps, system).called(name);
            return Ok(Box::new(sent));
        }
        let mut paper = DiktiometerConfig::paper(routines, observer.config().clone());
        paper.heed = heed;
        let mut system = Diktiometer::with_map(paper, robot.sight, observer.clone(), setup.seed);
        if let Some(goal) = goal {
            system.remember(Landmark::Goal, goal);
        }
        let pose = Pose::new(past.at, Heading::NORTH);
        let body = office_robot(&office, robot, pose, setup.seed)?;
        let sent = Sent::new(office.course, body, steps, system).called(name);
        Ok(Box::new(sent))
    }

    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, BoxError> {
        let file = read(map)?;
        // Showing a map takes no random numbers.
        let survey = file.survey(0)?;
        Ok(Box::new(Surveyed { file, survey }))
    }
}

fn read(map: &MapText) -> Result<SurveyFile, BoxError> {
    SurveyFile::from_json(&map.text).map_err(|error| because(&map.name, error))
}

/// Returns the robot with its noise.
fn surveyor(robot: &RobotEntry) -> SurveyorConfig {
    match robot.kind() {
        RobotKind::Laser => {
            let mut config = SurveyorConfig::mslst();
            config.pioneer = robot.laser_config();
            config
        }
        _ => SurveyorConfig::paper(),
    }
}

impl DiktiometryEntry {
    /// Returns the system that learns until nothing is left, and finds its way after it was put
    /// down anywhere.
    fn sent(self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let furniture = OfficeConfig {
            colours: match setup.robot.kind() {
                RobotKind::Camera => COLOURS,
                _ => 1,
            },
            seed: setup.seed,
            ..OfficeConfig::bare()
        };
        let maze = &setup.terrain.maze(OFFICE)?.maze;
        let mut office = Office::new(maze, &furniture)?.named(setup.world);
        office.course = setup.with_door(office.course)?;
        let config = surveyor(&setup.robot);
        let made = setup.condition.surveyor(config.clone(), setup.seed);
        let random = || {
            let rng = &mut stream(setup.seed, START_STREAM);
            Some(office.random_start(&config.body(), rng))
        };
        let start = setup.start(&office.course, Start::Random, random)?;
        let pose = Pose::new(start.position, Heading::NORTH);
        let mut mapping = mapper(&office, &config);
        if !self.is_paper {
            mapping.journal = JournalLength::All;
            mapping.restructuring.merge_by_looks_and_turns();
        }
        let routines = config.routines(furniture.corridor_width);
        let paper = DiktiometerConfig::paper(routines, mapping);
        let (course, seed) = (office.course.clone(), setup.seed);
        let steps = setup.steps.unwrap_or(u32::MAX);
        let origin = setup.origin(&course);
        Ok(match config.sight {
            PlaceCue::Laser { columns } => {
                let robot = setup.robot.laser_model(made.laser_robot())?;
                let robot = course.robot_at(pose, robot, seed)?;
                let system = Pathfinder::learning(paper, LaserEye { columns }, seed);
                let sent = Sent::new(course, robot, steps, system);
                Box::new(sent.keeping_its_view(self.name(), origin))
            }
            _ => {
                let robot = office_robot(&office, &made, pose, seed)?;
                let system = Pathfinder::learning(paper, config.sight, seed);
                let sent = Sent::new(course, robot, steps, system);
                Box::new(sent.keeping_its_view(self.name(), origin))
            }
        })
    }
}

/// A survey in progress. Each of its moves counts as an action.
struct Surveying {
    survey: Survey,
    /// Number of moves to make.
    moves: u32,
    /// Number of time steps after which the survey ends in any case.
    most_steps: u32,
    world: String,
    seed: u64,
    /// Number of moves made so far.
    made: u32,
}

impl InRun for Surveying {
    fn steps(&self) -> u32 {
        self.path().len().saturating_sub(1) as u32
    }

    fn is_out_of_time(&self) -> bool {
        self.steps() >= self.most_steps
    }
}

impl Outing for Surveying {
    fn course(&self) -> &Course {
        &self.survey.office().course
    }

    fn robot(&self) -> RobotFacts {
        RobotFacts {
            name: self.survey.config().robot.name(),
            ..RobotFacts::of(self.survey.robot())
        }
    }

    fn path(&self) -> &[Pose] {
        self.survey.robot().path()
    }

    fn bumped(&self) -> &[u32] {
        self.survey.robot().bumped()
    }

    fn landmark(&self) -> Option<Landmark> {
        self.survey.robot().landmark()
    }

    fn scan(&self) -> Option<&Scan> {
        None
    }

    fn act(&mut self, task: Task) -> Result<Standing, BoxError> {
        if task != Task::Explore {
            return Ok(Standing::gave_up(
                "a survey ends after all its moves: leave --until out",
            ));
        }
        if self.made == self.moves {
            return Ok(Standing::Done);
        }
        self.survey.step()?;
        self.made += 1;
        let observer = self.survey.observer();
        if self.made.is_multiple_of(ASKED) && observer.grows_without_end() {
            let complaint = observer.self_check().complaint();
            return Ok(Standing::gave_up(complaint.unwrap_or_default()));
        }
        Ok(Standing::UnderWay)
    }

    fn words(&self) -> String {
        format!("at place {}", self.survey.observer().place().0)
    }

    fn map(&self) -> MapView {
        Mapper::map(self.survey.observer())
    }

    fn belief(&self) -> Vec<Guess> {
        self.survey.observer().belief()
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachArrival
    }

    fn visits(&self) -> Vec<Option<u32>> {
        let survey = &self.survey;
        let paths = &survey.observer().map().paths;
        let visits = survey.visits().iter();
        visits
            .map(|visit| Some(paths.resolve(visit.place)?.0))
            .collect()
    }

    fn put_down(&mut self, _pose: Pose) -> Result<Standing, BoxError> {
        Ok(Standing::gave_up(
            "a survey does not localize: its robot is never moved elsewhere",
        ))
    }

    fn sites(&self) -> BTreeMap<u32, Point> {
        let drawn = self.survey.drawn().into_iter();
        let middle = |Bounds { min, max }| min + (max - min) * 0.5;
        drawn
            .map(|drawn| (drawn.id, middle(drawn.bounds)))
            .collect()
    }

    fn map_file(&self) -> Result<Option<String>, BoxError> {
        let file = SurveyFile::of(&self.world, self.seed, &self.survey);
        Ok(Some(file.to_json()?))
    }

    fn doubt(&self) -> Option<String> {
        self.survey.observer().self_check().complaint()
    }

    fn trace(&self) -> Result<Vec<u8>, BoxError> {
        self.survey.robot().trace()
    }
}

/// A survey read from a file.
struct Surveyed {
    file: SurveyFile,
    survey: Survey,
}

impl LearnedMap for Surveyed {
    fn lines(&self) -> Vec<String> {
        let score = self.survey.score();
        let observer = &self.file.observer;
        let first = format!(
            "{}, {} moves: {} places for {} true ones, purity {:.3}; the robot is at place {}",
            self.file.origin.world,
            observer.moves(),
            score.places,
            score.visited,
            score.purity,
            observer.place().0
        );
        let mut lines = vec![first];
        let paths = &observer.map().paths;
        for place in self.survey.drawn() {
            let links = paths.outgoing(PlaceId(place.id)).map(|(_, link)| link);
            let ways = links.map(|link| format!("{} to {}", direction(link), link.to.0));
            let ways: Vec<String> = ways.collect();
            lines.push(format!("{}: {}", place.label, ways.join(", ")));
        }
        let open = observer.open_pairs();
        lines.extend(open.iter().map(|pair| open_line(pair, observer)));
        lines
    }

    fn json(&self) -> Value {
        let (file, score) = (&self.file, self.survey.score());
        let paths = &file.observer.map().paths;
        let links_of = |id: u32| paths.outgoing(PlaceId(id)).map(|(_, link)| link);
        let drawn = self.survey.drawn();
        let places = drawn.iter().map(|place| {
            let Bounds { min, max } = place.bounds;
            let links: Vec<Value> = links_of(place.id)
                .map(|link| json!({ "action": direction(link), "to": link.to.0, "traversed": link.traversed }))
                .collect();
            json!({
                "id": place.id,
                "box": { "west": min.x, "south": min.y, "east": max.x, "north": max.y },
                "visits": paths.place(PlaceId(place.id)).map(|place| place.visits),
                "links": links,
            })
        });
        json!({
            "system": "diktiometry-better",
            "maze": file.origin.world,
            "moves": file.observer.moves(),
            "here": file.observer.place().0,
            "true_places": score.visited,
            "purity": score.purity,
            "link_precision": score.link_precision,
            "places": places.collect::<Vec<Value>>(),
            "open_pairs": file.observer.open_pairs().iter().map(open_json).collect::<Vec<Value>>(),
        })
    }

    fn drawing(&self, _terrain: &Terrain) -> Result<Drawing, BoxError> {
        Ok(map_over_world(&self.file.office, &self.survey))
    }

    fn plan(&self, from: Option<u32>, to: Option<u32>) -> Result<Option<Vec<String>>, BoxError> {
        let observer = &self.file.observer;
        let paths = &observer.map().paths;
        let place = |number: u32| {
            paths.resolve(PlaceId(number)).ok_or_else(|| {
                let known: Vec<String> = paths.places().map(|(id, _)| id.0.to_string()).collect();
                format!(
                    "there is no place {number}; choose one of: {}",
                    known.join(", ")
                )
            })
        };
        let from = from.map_or(Ok(observer.place()), place)?;
        let (to, beyond) = match (to, self.file.goal()) {
            (Some(to), _) => (place(to)?, None),
            (None, Some(LandmarkSpot::Place(goal))) => (goal, None),
            (None, Some(LandmarkSpot::Way(last, way))) => (last, Some(way)),
            (None, None) => return Err("the goal is not on this map: give --to PLACE".into()),
        };
        let Some(plan) = observer.plan(from, to) else {
            return Ok(None);
        };
        let mut at = from;
        let steps = plan.iter().map(|step| {
            let predicted = observer.predict(at, step.action);
            let likely = predicted
                .iter()
                .find(|predicted| predicted.place == step.to);
            let likely = likely.map_or(0.0, |predicted| predicted.probability);
            at = step.to;
            format!(
                "{} to place {} ({:.0} %)",
                way(step.action),
                step.to.0,
                100.0 * likely
            )
        });
        let beyond = beyond.map(|way| format!("{way}, to the goal on the way"));
        Ok(Some(steps.chain(beyond).collect()))
    }

    fn view(&self) -> Result<MapView, BoxError> {
        Ok(Mapper::map(&self.file.observer))
    }

    fn course(&self, _world: &str, terrain: &Terrain) -> Result<Course, BoxError> {
        let maze = &terrain.maze(OFFICE)?.maze;
        Ok(Office::new(maze, self.file.office.config())?.course)
    }
}

/// Returns a line about two places that may be one, and about what would decide that.
fn open_line(pair: &OpenPair, observer: &Observer) -> String {
    let OpenPair { older, newer, .. } = pair;
    let decides = match (&pair.walk, pair.offset) {
        (Some(walk), _) => format!(
            "go {} from place {} to see",
            walk_of(walk).join(", "),
            walk.from.0
        ),
        (None, Some(offset)) => format!(
            "only bounds can tell: these leave {:.1} × {:.1} m, and have to leave less than {:.1} m on each side",
            offset.x.width(),
            offset.y.width(),
            observer.config().separation
        ),
        (None, None) => "no way between them is known".to_owned(),
    };
    format!("place {} may be place {}: {decides}", newer.0, older.0)
}

fn open_json(pair: &OpenPair) -> Value {
    let walk = pair.walk.as_ref();
    let walk = walk.map(|walk| json!({ "from": walk.from.0, "actions": walk_of(walk) }));
    let side = |side: Interval| [side.low(), side.high()];
    let offset = pair
        .offset
        .map(|offset| json!({ "east": side(offset.x), "north": side(offset.y) }));
    json!({ "older": pair.older.0, "newer": pair.newer.0, "offset": offset, "walk": walk })
}

fn walk_of(walk: &DecidingWalk) -> Vec<String> {
    walk.actions.iter().map(|action| way(*action)).collect()
}

fn direction(link: &Link) -> String {
    way(link.action)
}

/// Returns the name of an action on a survey's map.
fn way(Action(action): Action) -> String {
    let direction = Direction::ALL.get(action as usize);
    direction.map_or_else(|| format!("action {action}"), ToString::to_string)
}
