use alloc::collections::BTreeMap;
use alloc::sync::Arc;

use anyhow::{Context, Error, anyhow};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use tolman_arena::course::{Course, Terrain};
use tolman_arena::diktiometry::{
    MapScore, Office, OfficeConfig, Survey, SurveyConfig, SurveyFile, SurveyorConfig, office_robot,
};
use tolman_arena::episode::START_STREAM;
use tolman_arena::pioneer::{CAMERA_PIONEER, LASER_PIONEER};
use tolman_arena::run::InRun;
use tolman_arena::{BoxError, Outing, RobotFacts, Sent};
use tolman_draw::Drawing;
use tolman_geom::{Heading, Interval, Point, Pose};
use tolman_maps::diktiometry::{
    Action, DecidingWalk, JournalLength, Link, Observer, OpenPair, PlaceId,
};
use tolman_maze::Direction;
use tolman_papers::diktiometry::drawing::map_over_world;
use tolman_robot::{Guess, Landmark, MapView, Mapper, Scan, SensesLandmarks, Standing, Task};
use tolman_sim::Bounds;
use tolman_systems::diktiometry::{Diktiometer, DiktiometerConfig, LandmarkSpot, Wayfinder};
use tolman_systems::stream;

use crate::start::Start;
use crate::system::{LearnedMap, MapText, Setup, SystemEntry};

/// The [diktiometry](tolman_systems::diktiometry) on a Pioneer in an office.
#[derive(Clone, Copy, Debug)]
pub struct DiktiometryEntry;

const PRESETS: [(&str, &str); 1] = [(
    "paper",
    "As the paper's robot, which heeds advice in 30 % of the cases",
)];

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
        "diktiometry"
    }

    fn about(&self) -> &'static str {
        "Maps places that look alike, with bounds on where they lie, and advises the planner"
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        &PRESETS
    }

    fn robots(&self) -> &'static [&'static str] {
        &[CAMERA_PIONEER, LASER_PIONEER]
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, Error> {
        setup.settings.preset(PRESETS)?;
        if setup.start.is_some_and(|start| start != Start::Random) {
            return Err(anyhow!(
                "the diktiometry begins at a random place: leave --start out"
            ));
        }
        if let Some(map) = setup.from {
            let mut before = SurveyFile::from_json(&map.text).with_context(|| map.name.clone())?;
            setup.robot(&[before.config.robot.name()])?;
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
        let robot = match setup.robot(self.robots())? {
            LASER_PIONEER => SurveyorConfig::mslst(),
            _ => SurveyorConfig::paper(),
        };
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
        config.mapper.restructuring.merge_by_looks_and_turns();
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

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, Error> {
        let [map] = maps else {
            return Err(anyhow!(
                "the diktiometry drives by one map: give --map once"
            ));
        };
        let file = SurveyFile::from_json(&map.text).with_context(|| map.name.clone())?;
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
        let name = setup.robot(&[config.robot.name()])?;
        if let Some(start) = setup.start {
            let rng = &mut stream(setup.seed, START_STREAM);
            let random = || Some(office.random_start(&robot.body(), rng));
            let start = start.on(&office.course, random)?;
            if !office.is_in_corridor(start.position) {
                let Point { coords: at, .. } = start.position;
                return Err(anyhow!(
                    "({}, {}) m lies between the corridors, which are {} m wide and {} m apart; start in one",
                    at.x,
                    at.y,
                    office.config().corridor_width,
                    office.config().pitch()
                ));
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

    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, Error> {
        let file = SurveyFile::from_json(&map.text).with_context(|| map.name.clone())?;
        // Showing a map takes no random numbers.
        let survey = file.survey(0)?;
        Ok(Box::new(Surveyed { file, survey }))
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

    fn complaint(&self, _task: Task) -> Option<String> {
        complaint(&self.survey)
    }

    fn trace(&self) -> Result<Vec<u8>, BoxError> {
        self.survey.robot().trace()
    }
}

fn complaint(survey: &Survey) -> Option<String> {
    let MapScore {
        places,
        visited,
        purity,
        is_isomorphic,
        ..
    } = survey.score();
    let there_are = survey.office().places(&[]).len();
    if !is_isomorphic {
        return Some(format!(
            "{places} places for the {visited} that were visited, purity {purity:.3}: places look too much alike; try walls of more colours, --set colours=8. `tolman map show` lists the places that may be one"
        ));
    }
    if visited < there_are {
        return Some(format!(
            "{visited} of {there_are} places were visited: give it more moves, --set moves=2000"
        ));
    }
    None
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
            "system": DiktiometryEntry.name(),
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

    fn drawing(&self, _terrain: &Terrain) -> Result<Drawing, Error> {
        Ok(map_over_world(&self.file.office, &self.survey))
    }

    fn plan(&self, from: Option<u32>, to: Option<u32>) -> Result<Option<Vec<String>>, Error> {
        let observer = &self.file.observer;
        let paths = &observer.map().paths;
        let place = |number: u32| {
            paths.resolve(PlaceId(number)).ok_or_else(|| {
                let known: Vec<String> = paths.places().map(|(id, _)| id.0.to_string()).collect();
                anyhow!(
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
            (None, None) => return Err(anyhow!("the goal is not on this map: give --to PLACE")),
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

    fn complaint(&self, _terrain: &Terrain) -> Result<Option<String>, Error> {
        Ok(complaint(&self.survey))
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
