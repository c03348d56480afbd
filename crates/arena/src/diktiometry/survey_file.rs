use alloc::sync::Arc;

use serde::{Deserialize, Serialize};
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::diktiometry::{MapFile, MoveOutcome, Observer, PlaceId, Use};
use tolman_maze::{Cell, Direction, MazeFile};
use tolman_robot::Task;
use tolman_systems::diktiometry::{Diktiometer, LandmarkSpot};
use tolman_systems::{MapFiles, Origin, origin_of};

use super::{
    MapScore, Office, OfficeConfig, OfficeRobot, PlaceCue, SurveyorConfig, Visit, office_robot,
    score,
};
use crate::registry::because;
use crate::{BoxError, Founding, Sent};

/// Systems whose files hold surveys: as in the paper, and with merges by looks and turns.
const SYSTEMS: [&str; 2] = ["diktiometry", "diktiometry-better"];

/// A survey without its map: the world, the robot, and where it truly was so far.
#[derive(Clone, Debug)]
pub struct Surveyed {
    /// World, robot and seed of the survey's beginning. A continuation has other seeds.
    pub origin: Origin,
    /// World that was surveyed.
    pub office: Arc<Office>,
    /// The robot and its noise.
    pub robot: SurveyorConfig,
    /// Exploration probability of the walk, 0 to 1.
    pub heed: f64,
    /// True start of the robot, m.
    pub start: Point,
    /// True position of the robot, m.
    pub at: Point,
    /// True places where the robot was, each with the map's place at the time, from the start on.
    pub visits: Vec<Visit>,
}

/// Contents of a survey's file: JSON, read back bit for bit. It holds the world and the robot's
/// place in it, so that the survey can continue; the map is the journal of all moves.
#[derive(Clone, Debug)]
pub struct SurveyFile {
    /// World, robot and true places.
    pub surveyed: Surveyed,
    /// Observer that holds the map.
    pub observer: Observer,
}

#[derive(Serialize, Deserialize)]
struct Body {
    /// The maze as in maze files.
    maze: String,
    office: OfficeConfig,
    surveyor: SurveyorConfig,
    heed: f64,
    /// True start and true position of the robot, m.
    start: [f64; 2],
    at: [f64; 2],
    /// True site of every visit, and the place on the map where the robot believed it was, from the
    /// start on.
    visits: Vec<(u32, PlaceId)>,
    map: MapFile,
}

impl Surveyed {
    /// Returns a survey that begins at a random place of an office, by its seed.
    ///
    /// # Errors
    /// If the office has no place.
    pub fn begin(
        world: &str,
        office: Arc<Office>,
        robot: SurveyorConfig,
        heed: f64,
        seed: u64,
    ) -> Result<Self, BoxError> {
        let start = office.random_place(seed)?;
        Ok(Self {
            origin: Origin {
                world: world.to_owned(),
                drawing: Some(office.course.drawing()),
                robot: robot.name().to_owned(),
                seed,
            },
            office,
            robot,
            heed,
            start: start.position,
            at: start.position,
            visits: Vec::new(),
        })
    }

    /// Sends out a system that goes on from here, for at most `step_limit` time steps. It keeps its
    /// map as a file. `seed` seeds all noise.
    ///
    /// # Errors
    /// If the robot cannot be made or cannot stand here.
    pub fn sent(
        self,
        system: Diktiometer<PlaceCue>,
        step_limit: u32,
        seed: u64,
    ) -> Result<Sent<OfficeRobot, Diktiometer<PlaceCue>>, BoxError> {
        let pose = Pose::new(self.at, Heading::NORTH);
        let robot = office_robot(&self.office, &self.robot, pose, seed)?;
        let (course, name) = (self.office.course.clone(), self.robot.name());
        let origin = Pose::new(self.start, Heading::EAST);
        let sent = Sent::new(course, robot, step_limit, system);
        let sent = sent.called(name).laid_at(origin);
        let sent = sent.counting(|system| system.visited().len());
        Ok(sent.keeping(move |system, founded| {
            let file = self.after(system, founded)?;
            file.map(|file| file.to_json()).transpose()
        }))
    }

    /// Returns the survey after the moves of a system that went on from here, with its map; `None`
    /// without one. `founded` has the true positions of its visits.
    fn after(
        &self,
        system: &Diktiometer<PlaceCue>,
        founded: &[Founding],
    ) -> Result<Option<SurveyFile>, BoxError> {
        let Some(observer) = system.observer() else {
            return Ok(None);
        };
        let truth = self.office.places(&[]);
        let mut surveyed = self.clone();
        let known = usize::from(!self.visits.is_empty());
        let visits = system.visited().iter().zip(founded).enumerate();
        for (number, (place, founding)) in visits.skip(known) {
            // The first action begins at the first place and ends at the second.
            let at = if number == 0 {
                self.at
            } else {
                founding.position
            };
            let site = self.office.place_at(&truth, at)?.site;
            let visit = place.map(|place| Visit { site, place });
            surveyed.visits.extend(visit);
            surveyed.at = at;
        }
        let observer = observer.clone();
        Ok(Some(SurveyFile { surveyed, observer }))
    }
}

impl SurveyFile {
    /// Returns the name of the system that learned the map. Files of earlier versions name both
    /// systems alike.
    #[must_use]
    pub fn system(&self) -> &'static str {
        let [paper, better] = SYSTEMS;
        match self.observer.config().restructuring.look_merge {
            Use::On => better,
            Use::Off => paper,
        }
    }

    /// Returns the text of the file, with a line end.
    ///
    /// # Errors
    /// If the mapper kept no journal, or it cannot be written.
    pub fn to_json(&self) -> Result<String, BoxError> {
        let surveyed = &self.surveyed;
        let visits = surveyed
            .visits
            .iter()
            .map(|visit| (visit.site, visit.place));
        let body = Body {
            maze: surveyed.office.course.maze.to_string(),
            office: *surveyed.office.config(),
            surveyor: surveyed.robot.clone(),
            heed: surveyed.heed,
            start: surveyed.start.into(),
            at: surveyed.at.into(),
            visits: visits.collect(),
            map: MapFile::of(&self.observer).map_err(invalid("its map is invalid"))?,
        };
        let system = self.system();
        Ok(MapFiles { system }.write(&surveyed.origin, &body)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// With the place and the repair.
    pub fn from_json(text: &str) -> Result<Self, BoxError> {
        let (found, _) = origin_of(text)?;
        let mut systems = SYSTEMS.into_iter();
        let system = systems
            .find(|system| *system == found)
            .unwrap_or(SYSTEMS[0]);
        let (origin, body): (_, Body) = MapFiles { system }.read(text)?;
        if !(0.0..=1.0).contains(&body.heed) {
            return Err(format!(
                "its `heed`, the exploration probability, is {}: give a number from 0 to 1",
                body.heed
            )
            .into());
        }
        // It need not have a goal.
        let parsed = tolman_maze::parse(&body.maze);
        let MazeFile { maze, .. } = parsed.map_err(invalid("its maze is invalid"))?;
        let observer = body.map.observer().map_err(invalid("its map is invalid"))?;
        let office = Office::new(&maze, &body.office)
            .map_err(invalid("no world can be built from its maze"))?;
        let visits = body.visits.into_iter();
        let visits = visits.map(|(site, place)| Visit { site, place });
        let surveyed = Surveyed {
            office: Arc::new(office.named(&origin.world)),
            robot: body.surveyor,
            heed: body.heed,
            origin,
            start: Point::from(body.start),
            at: Point::from(body.at),
            visits: visits.collect(),
        };
        Ok(Self { surveyed, observer })
    }

    /// Returns the score of the map.
    #[must_use]
    pub fn score(&self) -> MapScore {
        let Surveyed { office, visits, .. } = &self.surveyed;
        let moves = self.observer.journal().map_or(&[][..], |all| &all.moves);
        let went = visits.iter().zip(moves);
        let went = went.filter(|(_, made)| made.outcome == MoveOutcome::Arrived);
        let gone = went.filter_map(|(from, made)| {
            let direction = Direction::ALL.get(made.action.0 as usize)?;
            Some((from.site, *direction))
        });
        let gone: Vec<(u32, Direction)> = gone.collect();
        score(Some(&self.observer), visits, &gone, &office.places(&[]))
    }

    /// Returns why the map is wrong, by the truth, or, after exploration, unfinished; `None` if it
    /// is right.
    #[must_use]
    pub fn complaint(&self, task: Task) -> Option<String> {
        let MapScore {
            places,
            visited,
            purity,
            is_isomorphic,
            ..
        } = self.score();
        let there_are = self.surveyed.office.places(&[]).len();
        if !is_isomorphic {
            return Some(format!(
                "{places} places for the {visited} that were visited, purity {purity:.3}: places look too much alike. `tolman map show` lists the places that may be one"
            ));
        }
        (task == Task::Explore && visited < there_are)
            .then(|| format!("{visited} of {there_are} places were visited"))
    }

    /// Returns where on the map the robot came to a goal of the maze, if it did: at a place, or
    /// else on the way between two.
    #[must_use]
    pub fn goal(&self) -> Option<LandmarkSpot> {
        let paths = &self.observer.map().paths;
        let goals = self.surveyed.office.course.maze.goals();
        let is_goal = |visit: &&Visit| {
            let cell = self.cell(visit);
            cell.is_some_and(|cell| goals.contains(&cell))
        };
        let mut visits = self.surveyed.visits.iter().rev();
        if let Some(visit) = visits.find(is_goal) {
            return Some(LandmarkSpot::Place(paths.resolve(visit.place)?));
        }
        let mut moves = self.surveyed.visits.windows(2).rev();
        let (from, way) = moves.find_map(|pair| {
            let [from, to] = pair else { return None };
            let (start, end) = (self.cell(from)?, self.cell(to)?);
            let ways = Direction::ALL.into_iter();
            let mut over = ways.filter(|way| self.goes_over(start, *way, end, goals));
            Some((from, over.next()?))
        })?;
        Some(LandmarkSpot::Way(paths.resolve(from.place)?, way))
    }

    /// Returns the cell of a visited place; `None` for a doorway.
    fn cell(&self, visit: &Visit) -> Option<Cell> {
        self.surveyed
            .office
            .course
            .maze
            .grid()
            .cells()
            .nth(visit.site as usize)
    }

    /// Returns whether a straight corridor from one cell to another goes over one of these between
    /// them.
    fn goes_over(&self, start: Cell, way: Direction, end: Cell, cells: &[Cell]) -> bool {
        let maze = &self.surveyed.office.course.maze;
        let step = |at: &Cell| maze.beside(*at, way).filter(|_| maze.is_open(*at, way));
        let beyond = core::iter::successors(step(&start), step);
        let between: Vec<Cell> = beyond.take_while(|at| *at != end).collect();
        let leads_there = between.last().unwrap_or(&start);
        step(leads_there) == Some(end) && between.iter().any(|at| cells.contains(at))
    }
}

/// Returns the error of a survey of which `what` holds, for this reason.
fn invalid<E: Into<BoxError>>(what: &str) -> impl FnOnce(E) -> BoxError {
    move |error| because(format!("{what}; learn the map again"), error)
}
