use alloc::collections::BTreeMap;
use alloc::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use tolman_draw::Drawing;
use tolman_geom::{Heading, Interval, Point, Pose};
use tolman_maps::diktiometry::{
    Action, Config, DecidingWalk, JournalLength, Link, Observer, OpenPair, PlaceId, WorldKind,
};
use tolman_maze::Direction;
use tolman_robot::{Landmark, MapView, Mapper, Task};
use tolman_sim::Bounds;
use tolman_systems::diktiometry::{
    Diktiometer, DiktiometerConfig, ExploreUntil, LandmarkSpot, LaserEye,
};
use tolman_systems::stream;

use crate::contest::{Condition, PlaceRule};
use crate::course::{Course, Terrain};
use crate::diktiometry::{
    Office, OfficeConfig, PlaceCue, SurveyFile, Surveyed, SurveyorConfig, mapper, office_robot,
};
use crate::drawing::diktiometry::{PlaceMark, map_over_world, place_marks};
use crate::episode::START_STREAM;
use crate::registry::any_robot::any;
use crate::registry::view_file::ViewFile;
use crate::registry::{
    DrivesBy, LearnedMap, LogMapper, MapText, RobotEntry, RobotKind, Setup, Start, SystemEntry,
    SystemFacts, slug,
};
use crate::{BoxError, Founding, Outing, Sent};

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
    fn facts(&self) -> SystemFacts {
        let both = SystemFacts {
            needs: "needs a compass and a camera that sees colours, or a laser ring",
            kinds: &[RobotKind::Camera, RobotKind::Laser],
            own_robot: RobotEntry::CAMERA_PIONEER.name,
            presets: &PRESETS,
            arena_preset: Some(ARENA),
            why_no_log: "it keeps no journal of its moves: give diktiometry-better",
            delivers: true,
            drives: DrivesBy::AnyMap,
            places: PlaceRule::Corners,
            ..SystemFacts::new("diktiometry")
        };
        match self.is_paper {
            true => SystemFacts {
                title: "Diktiometry",
                about: "maps places with bounds on where they lie, and advises the planner",
                is_paper: true,
                for_robot: Ok(|measures, robot, seed| {
                    any(Diktiometer::for_robot(measures, robot, true, seed))
                }),
                ..both
            },
            false => SystemFacts {
                name: "diktiometry-better",
                title: "Diktiometry Better",
                about: "maps places that look alike, with a journal of all its moves, and advises the planner",
                log_mapper: Some(LogMapper::Diktiometry),
                for_robot: Ok(|measures, robot, seed| {
                    any(Diktiometer::for_robot(measures, robot, false, seed))
                }),
                ..both
            },
        }
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        if setup.settings.preset(&PRESETS, [false, true])? {
            return self.sent(setup);
        }
        if setup.start.is_some_and(|start| start != Start::Random) {
            return Err("the diktiometry begins at a random place: leave --start out".into());
        }
        let (surveyed, observer, moves) = match setup.from {
            Some(map) => self.gone_on_with(map, setup)?,
            None => Self::begun(setup)?,
        };
        let (sight, seed) = (surveyed.robot.sight, setup.seed);
        let mut mapper = self.mapper(&surveyed.office, &surveyed.robot);
        // The survey's file is the journal.
        mapper.journal = JournalLength::All;
        let mut config = surveyed.office.diktiometer(&surveyed.robot, mapper);
        (config.heed, config.until) = (surveyed.heed, ExploreUntil::Moves(moves));
        let system = match observer {
            Some(observer) => Diktiometer::with_map(config, sight, observer, seed),
            None => Diktiometer::new(config, sight, seed),
        };
        let steps = setup.steps.unwrap_or(u32::MAX);
        Ok(Box::new(surveyed.sent(system, steps, seed)?))
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let [map] = maps else {
            return Err("the diktiometry drives by one map: give --map once".into());
        };
        let file = map.parsed(SurveyFile::from_json)?;
        // The goal is where the robot came to it while learning.
        let goal = file.goal();
        let SurveyFile { surveyed, observer } = file;
        let Driving { heed } = setup.settings.over(&Driving {
            heed: surveyed.heed,
        })?;
        let office = refurnished(&surveyed, setup)?;
        let robot = &surveyed.robot;
        let mut config = office.diktiometer(robot, observer.config().clone());
        config.heed = heed;
        let steps = setup.steps.unwrap_or(100_000);
        let name = robot.name();
        let mut system = Diktiometer::with_map(config, robot.sight, observer, setup.seed);
        if let Some(goal) = goal {
            system.remember(Landmark::Goal, goal);
        }
        system.put_down();
        let pose = start_in(&office, robot, setup)?;
        let body = office_robot(&office, robot, pose, setup.seed)?;
        let sent = Sent::new(office.course, body, steps, system).called(name);
        Ok(Box::new(
            sent.laid_at(Pose::new(surveyed.start, Heading::EAST)),
        ))
    }

    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, BoxError> {
        // By the preset of the arena it keeps places and links alone.
        Ok(match ViewFile::read(self.name(), &map.text) {
            Some(file) => Box::new(file),
            None => Box::new(map.parsed(SurveyFile::from_json)?),
        })
    }
}

impl DiktiometryEntry {
    /// Returns the mapper for a robot in an office.
    fn mapper(self, office: &Office, robot: &SurveyorConfig) -> Config {
        let mut mapper = mapper(office, robot);
        if !self.is_paper {
            mapper.journal = JournalLength::All;
            mapper.restructuring.merge_by_looks_and_turns();
        }
        mapper
    }

    /// Returns a new survey and its number of moves.
    fn begun(setup: &Setup<'_>) -> Result<(Surveyed, Option<Observer>, u32), BoxError> {
        let learning: Learning = setup.settings.over(&LEARNING)?;
        let robot = surveyor(&setup.robot);
        let mut furniture = OfficeConfig::bare();
        furniture.doorway_share = learning.doorways;
        furniture.colours = learning.colours;
        furniture.seed = setup.seed;
        let maze = setup.terrain.maze(OFFICE)?;
        let office = Office::new(&maze.maze, &furniture)?.named(setup.world);
        let (office, heed) = (Arc::new(office), learning.heed);
        let surveyed = Surveyed::begin(setup.world, office, robot, heed, setup.seed)?;
        Ok((surveyed, None, learning.moves))
    }

    /// Returns an earlier survey with its map, and the number of moves to add.
    fn gone_on_with(
        self,
        map: &MapText,
        setup: &Setup<'_>,
    ) -> Result<(Surveyed, Option<Observer>, u32), BoxError> {
        let file = map.parsed(SurveyFile::from_json)?;
        let system = file.system();
        if system != self.name() {
            return Err(
                format!("{} is a map of {system}: give --system {system}", map.name).into(),
            );
        }
        let SurveyFile {
            mut surveyed,
            observer,
        } = file;
        if setup.robot.title != surveyed.robot.name() {
            return Err(format!(
                "{} was learned by the {}: give --robot {}",
                map.name,
                surveyed.robot.name(),
                slug(surveyed.robot.name())
            )
            .into());
        }
        let going_on: GoingOn = setup.settings.over(&GoingOn {
            moves: LEARNING.moves,
            heed: surveyed.heed,
        })?;
        let office = refurnished(&surveyed, setup)?;
        surveyed.origin.drawing = Some(office.course.drawing());
        surveyed.office = Arc::new(office);
        surveyed.heed = going_on.heed;
        Ok((surveyed, Some(observer), going_on.moves))
    }
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
        office.course = setup.with_doors(office.course)?;
        let config = surveyor(&setup.robot);
        let made = setup.condition.surveyor(config.clone(), setup.seed);
        let random = || {
            let rng = &mut stream(setup.seed, START_STREAM);
            Some(office.random_start(&config.body(), rng))
        };
        let start = setup.start(&office.course, random)?;
        let pose = Pose::new(start.position, Heading::NORTH);
        let routines = config.routines(furniture.corridor_width);
        let mut mapper = self.mapper(&office, &config);
        if setup.condition == Condition::MovingDoors || !setup.doors.is_empty() {
            mapper.world = WorldKind::Changing;
        }
        let paper = DiktiometerConfig::paper(routines, mapper);
        let (course, seed) = (office.course.clone(), setup.seed);
        let outing: Box<dyn Outing> = match config.sight {
            PlaceCue::Laser { columns } => {
                let robot = setup.robot.laser_model(made.laser_robot())?;
                let robot = course.robot_at(pose, robot, seed)?;
                let system = Diktiometer::new(paper, LaserEye { columns }, seed);
                Box::new(
                    setup
                        .sent(self.name(), course, robot, system)
                        .counting(visits)
                        .lying(lie),
                )
            }
            _ => {
                let robot = office_robot(&office, &made, pose, seed)?;
                let system = Diktiometer::new(paper, config.sight, seed);
                Box::new(
                    setup
                        .sent(self.name(), course, robot, system)
                        .counting(visits)
                        .lying(lie),
                )
            }
        };
        Ok(outing)
    }
}

fn visits<E>(system: &Diktiometer<E>) -> usize {
    system.visited().len()
}

/// Returns where the places of a map truly lie, if its axes are the world's. `made` has the true
/// positions of the robot's visits. It began the map at a place, and its first visit may be noted
/// at the second: the map is laid over the world there.
fn lie<E>(system: &Diktiometer<E>, made: &[Founding]) -> BTreeMap<u32, Point> {
    let places = Mapper::map(system).places.into_iter();
    let placed = places.filter_map(|place| Some((place.id, place.position?)));
    let placed: BTreeMap<u32, Point> = placed.collect();
    let visits = system.visits().into_iter().zip(made);
    let visits = visits.filter_map(|(place, made)| Some(made.position - placed.get(&place?)?));
    let Some(offset) = visits.take(2).last() else {
        return BTreeMap::new();
    };
    placed
        .into_iter()
        .map(|(id, at)| (id, at + offset))
        .collect()
}

/// Returns a start in the corridors of an office.
fn start_in(office: &Office, robot: &SurveyorConfig, setup: &Setup<'_>) -> Result<Pose, BoxError> {
    let rng = &mut stream(setup.seed, START_STREAM);
    let random = || Some(office.random_start(&robot.body(), rng));
    let start = setup.start(&office.course, random)?;
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
    Ok(start)
}

/// Returns the given maze, furnished like the one in which a map was learned.
fn refurnished(surveyed: &Surveyed, setup: &Setup<'_>) -> Result<Office, BoxError> {
    let maze = setup.terrain.maze(OFFICE)?;
    Ok(Office::new(&maze.maze, surveyed.office.config())?.named(setup.world))
}

fn places(file: &SurveyFile) -> Vec<PlaceMark> {
    place_marks(&file.observer, file.surveyed.start)
}

impl LearnedMap for SurveyFile {
    fn lines(&self) -> Vec<String> {
        let (observer, score) = (&self.observer, self.score());
        let first = format!(
            "{}, {}, {} moves: {} places for {} true ones, purity {:.3}; the robot is at place {}",
            self.system(),
            self.surveyed.origin.world,
            observer.moves(),
            score.places,
            score.visited,
            score.purity,
            observer.place().0
        );
        let mut lines = vec![first];
        let paths = &observer.map().paths;
        for place in places(self) {
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
        let (file, score) = (self, self.score());
        let paths = &file.observer.map().paths;
        let links_of = |id: u32| paths.outgoing(PlaceId(id)).map(|(_, link)| link);
        let drawn = places(self);
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
            "system": file.system(),
            "maze": file.surveyed.origin.world,
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
        let world = &self.surveyed.office.course.world;
        Ok(map_over_world(world, &self.observer, &places(self)))
    }

    fn plan(&self, from: Option<u32>, to: Option<u32>) -> Result<Option<Vec<String>>, BoxError> {
        let observer = &self.observer;
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
        let (to, beyond) = match (to, self.goal()) {
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
        Ok(Mapper::map(&self.observer))
    }

    fn course(&self, _world: &str, terrain: &Terrain) -> Result<Course, BoxError> {
        let maze = &terrain.maze(OFFICE)?.maze;
        Ok(Office::new(maze, self.surveyed.office.config())?.course)
    }

    /// Doorways are true places, and lie between cells.
    fn judged_apart(&self) -> Option<Option<String>> {
        let doorways = self.surveyed.office.doorways();
        (doorways > 0).then(|| self.complaint(Task::Explore))
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
