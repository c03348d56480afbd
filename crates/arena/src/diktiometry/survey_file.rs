use alloc::sync::Arc;

use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_geom::Point;
use tolman_maps::diktiometry::{MapFile, MapFileError, Observer, PlaceId};
use tolman_maze::{Cell, Direction, MazeError, MazeFile};

use super::{
    Office, OfficeConfig, OfficeError, Past, RunError, Survey, SurveyConfig, SurveyorConfig, Visit,
};
use tolman_systems::diktiometry::LandmarkSpot;
use tolman_systems::{FileError, MapFiles, Origin};

const FILES: MapFiles = MapFiles {
    system: "diktiometry-better",
};

/// Contents of a survey's file: JSON, read back bit for bit. It holds the world and the robot's
/// place in it, so that the survey can continue; the map is the journal of all moves.
#[derive(Clone, Debug)]
pub struct SurveyFile {
    /// World, robot and seed of the survey's beginning. A continuation has other seeds.
    pub origin: Origin,
    /// World that was surveyed.
    pub office: Arc<Office>,
    /// Settings of the robot and its walk. Its mapper is that of the map.
    pub config: SurveyConfig,
    /// Truth of the run so far, for continuing and for scoring.
    pub past: Past,
    /// Observer that holds the map.
    pub observer: Observer,
}

/// Reason why a file holds no survey.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SurveyFileError {
    /// The header or the JSON is invalid, names another system, or the survey cannot be written as
    /// JSON.
    #[error(transparent)]
    File(#[from] FileError),
    /// The exploration probability is outside 0 to 1.
    #[error("its `heed`, the exploration probability, is {found}: give a number from 0 to 1")]
    Heed {
        /// The value found.
        found: f64,
    },
    /// The maze is invalid.
    #[error("its maze is invalid; learn the map again")]
    Maze(#[from] MazeError),
    /// The maze cannot become a world.
    #[error("no world can be built from its maze; learn the map again")]
    Office(#[from] OfficeError),
    /// The map is invalid, or its journal was not kept.
    #[error("its map is invalid; learn the map again")]
    Map(#[from] MapFileError),
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
    /// True ways that the robot went: each by its site and direction.
    gone: Vec<(u32, Direction)>,
    map: MapFile,
}

impl SurveyFile {
    /// Returns the file of a survey of the maze `world` that began from `seed`.
    #[must_use]
    pub fn of(world: &str, seed: u64, survey: &Survey) -> Self {
        let office = survey.office();
        Self {
            origin: Origin {
                world: world.to_owned(),
                drawing: Some(office.course.drawing()),
                robot: survey.config().robot.name().to_owned(),
                seed,
            },
            office: Arc::clone(office),
            config: survey.config().clone(),
            past: survey.past(),
            observer: survey.observer().clone(),
        }
    }

    /// Returns the text of the file, with a line end.
    ///
    /// # Errors
    /// [`SurveyFileError::Map`] if the mapper kept no journal, [`SurveyFileError::File`] if it
    /// cannot be written.
    pub fn to_json(&self) -> Result<String, SurveyFileError> {
        let past = &self.past;
        let visits = past.visits.iter().map(|visit| (visit.site, visit.place));
        let body = Body {
            maze: self.office.course.maze.to_string(),
            office: *self.office.config(),
            surveyor: self.config.robot.clone(),
            heed: self.config.heed,
            start: past.start.into(),
            at: past.at.into(),
            visits: visits.collect(),
            gone: past.gone.clone(),
            map: MapFile::of(&self.observer)?,
        };
        Ok(FILES.write(&self.origin, &body)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`SurveyFileError`] with the place and the repair.
    pub fn from_json(text: &str) -> Result<Self, SurveyFileError> {
        let (origin, body): (_, Body) = FILES.read(text)?;
        if !(0.0..=1.0).contains(&body.heed) {
            return Err(SurveyFileError::Heed { found: body.heed });
        }
        // It need not have a goal.
        let MazeFile { maze, .. } = tolman_maze::parse(&body.maze)?;
        let observer = body.map.observer()?;
        let office = Office::new(&maze, &body.office)?;
        let visits = body.visits.into_iter();
        let visits = visits.map(|(site, place)| Visit { site, place });
        Ok(Self {
            office: Arc::new(office.named(&origin.world)),
            config: SurveyConfig {
                robot: body.surveyor,
                mapper: observer.config().clone(),
                heed: body.heed,
                moves: 0,
                door_period: 0,
            },
            origin,
            past: Past {
                start: Point::from(body.start),
                at: Point::from(body.at),
                visits: visits.collect(),
                gone: body.gone,
            },
            observer,
        })
    }

    /// Returns where on the map the robot came to a goal of the maze, if it did: at a place, or
    /// else on the way between two.
    #[must_use]
    pub fn goal(&self) -> Option<LandmarkSpot> {
        let paths = &self.observer.map().paths;
        let goals = self.office.course.maze.goals();
        let is_goal = |visit: &&Visit| {
            let cell = self.cell(visit);
            cell.is_some_and(|cell| goals.contains(&cell))
        };
        let mut visits = self.past.visits.iter().rev();
        if let Some(visit) = visits.find(is_goal) {
            return Some(LandmarkSpot::Place(paths.resolve(visit.place)?));
        }
        let mut moves = self.past.visits.windows(2).rev();
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
        self.office
            .course
            .maze
            .grid()
            .cells()
            .nth(visit.site as usize)
    }

    /// Returns whether a straight corridor from one cell to another goes over one of these between
    /// them.
    fn goes_over(&self, start: Cell, way: Direction, end: Cell, cells: &[Cell]) -> bool {
        let maze = &self.office.course.maze;
        let step = |at: &Cell| maze.beside(*at, way).filter(|_| maze.is_open(*at, way));
        let beyond = core::iter::successors(step(&start), step);
        let between: Vec<Cell> = beyond.take_while(|at| *at != end).collect();
        let leads_there = between.last().unwrap_or(&start);
        step(leads_there) == Some(end) && between.iter().any(|at| cells.contains(at))
    }

    /// Returns the survey, ready to continue. `seed` seeds all random numbers from now on.
    ///
    /// # Errors
    /// [`RunError`] if the robot cannot stand at the file's position.
    pub fn survey(&self, seed: u64) -> Result<Survey, RunError> {
        let past = self.past.clone();
        let observer = self.observer.clone();
        Survey::resumed(&self.office, self.config.clone(), past, observer, seed)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use tolman_maps::diktiometry::JournalLength;

    use super::super::blocks;
    use super::*;

    fn survey(moves: u32) -> SurveyFile {
        let maze = blocks(4, 0.3, &mut ChaCha8Rng::seed_from_u64(1));
        let furniture = OfficeConfig {
            doorway_share: 0.3,
            colours: 4,
            ..OfficeConfig::bare()
        };
        let office = Arc::new(Office::new(&maze, &furniture).unwrap());
        let mut config = SurveyConfig::paper(&office, moves);
        config.mapper.journal = JournalLength::All;
        let survey = Survey::new(&office, config, 3).unwrap().finish().unwrap();
        SurveyFile::of("blocks", 3, &survey)
    }

    #[test]
    fn a_survey_comes_back_and_goes_on() {
        let written = survey(30);
        let text = written.to_json().unwrap();
        let read = SurveyFile::from_json(&text).unwrap();
        assert_eq!(read.observer, written.observer);
        assert_eq!(read.past, written.past);
        assert_eq!(read.origin, written.origin);
        assert_eq!(read.origin.robot, "camera Pioneer");
        assert_eq!(read.to_json().unwrap(), text);
        let mut on = read.survey(5).unwrap();
        for _ in 0..20 {
            on.step().unwrap();
        }
        assert_eq!(on.observer().moves(), 50);
        assert_eq!(on.visits().len(), 51);
        let score = on.score();
        assert!((score.purity - 1.0).abs() < 1e-12, "{score:?}");
    }

    #[test]
    fn what_is_no_survey_is_refused_with_a_reason() {
        let text = survey(5).to_json().unwrap();
        let check = |changed: String, expect: &str| {
            let error = SurveyFile::from_json(&changed).unwrap_err();
            let told = format!("{error:?}");
            assert!(told.starts_with(expect), "{told} for {expect}");
        };
        check(text[..text.len() / 2].to_owned(), "File(CutOff");
        check(text.replacen("diktiometry", "mslst", 1), "File(System");
        check(text.replacen("\"heed\":", "\"heel\":", 1), "File(Body");
        check(
            text.replacen("\"moves\":5,", "\"moves\":6,", 1),
            "Map(Truncated",
        );
        check(text.replacen("o---o", "o~~~o", 1), "Maze");
        for colours in ["0", "4294967295"] {
            let colours = format!("\"colours\":{colours}");
            check(text.replacen("\"colours\":4", &colours, 1), "Office");
        }
    }
}
