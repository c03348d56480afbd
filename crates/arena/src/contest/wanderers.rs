use tolman_geom::{Point, path_length};
use tolman_maze::{Cell, Direction, MazeFile};
use tolman_robot::{Guess, Position};

use super::play::{Contest, Home, LocateOutcome, Located, Measured, NEAR};
use super::whereabouts::Squares;
use crate::BoxError;
use crate::cast::{Agent, Cast};
use crate::course::Course;
use crate::episode::{self, Episode, Trial};
use crate::mind::Mind;
use crate::pioneer::{body, calibrated};

/// Maximum number of time steps of a run for each metre that may be driven. Turning in place covers
/// no distance.
const STEPS_A_METRE: f64 = 20.0;

/// Minimum share of a wanderer's belief in one cell at which the wanderer is sure of its place, 0
/// to 1.
const SURE: f64 = 0.95;

/// Sends a baseline from the positions where systems are put down, on the laser Pioneer.
pub(super) struct Sender<'a> {
    contest: &'a Contest<'a>,
    agent: Agent,
    course: Course,
    cast: Cast,
}

impl<'a> Sender<'a> {
    pub(super) fn new(contest: &'a Contest<'a>, agent: Agent) -> Result<Self, BoxError> {
        let file = MazeFile::from(contest.maze_afterwards());
        Ok(Self {
            contest,
            agent,
            course: Course::for_body(contest.name, &file, &body())?,
            cast: Cast::default(),
        })
    }

    /// Returns a trial from `start` that ends when the robot may have driven `most` metres.
    fn trial(&self, number: u64, start: (Cell, Direction), most: f64) -> Trial<'_> {
        let Contest {
            condition, seed, ..
        } = *self.contest;
        Trial {
            course: &self.course,
            robot: condition.laser_pioneer(calibrated(), seed),
            start: self.course.in_cell(start.0, start.1),
            step_limit: (libm::ceil(most * STEPS_A_METRE) as u32).max(1),
            seed: seed.wrapping_add(number),
        }
    }

    fn mind(&self, trial: &Trial<'_>) -> Result<Mind, BoxError> {
        Ok(self.cast.mind(self.agent, &self.course, &trial.robot)?)
    }

    /// Lets the baseline drive to the goal from each place, and returns the results.
    pub(super) fn homes(&self) -> Result<Vec<Home>, BoxError> {
        let starts = (0_u64..).zip(self.contest.put_downs());
        starts
            .map(|(number, [_, start])| self.home(number, start))
            .collect()
    }

    fn home(&self, number: u64, start: (Cell, Direction)) -> Result<Home, BoxError> {
        let (maze, width) = (&self.course.maze, self.course.corridor_width);
        let shortest = maze.metres_to_goal(start.0, width);
        let most = Contest::most_home(shortest, maze.corridor_count() as f64 * width);
        let trial = self.trial(number, start, most);
        let Episode {
            reached,
            bumps,
            path,
            ..
        } = episode::run(&trial, &mut self.mind(&trial)?, |_| {})?;
        let way = path_length(&path);
        let arrived = reached && way <= most;
        Ok(Home {
            over_shortest: arrived.then_some(way / shortest),
            bumps,
            gave_up: String::new(),
        })
    }

    /// Lets the unlocalized oracle, which has the true map, localize on its way to the goal, and
    /// returns its answers. The other baselines give none.
    ///
    /// It is sure under the same condition as the systems: when most of its belief is in one cell.
    pub(super) fn found(&self) -> Result<Vec<Located>, BoxError> {
        if self.agent != Agent::UnlocalizedOracle {
            return Ok(Vec::new());
        }
        let starts = (0_u64..).zip(self.contest.put_downs());
        starts
            .map(|(number, [start, _])| self.located(number, start))
            .collect()
    }

    fn located(&self, number: u64, start: (Cell, Direction)) -> Result<Located, BoxError> {
        let squares = Squares::of(&self.course);
        let most = Contest::LIMIT * self.course.maze.corridor_count() as f64 * squares.pitch;
        let trial = self.trial(number, start, most);
        // Whether it was right when it was first sure, and the number of time steps until then.
        let mut first = None;
        let mut steps = 0_usize;
        let episode = episode::run(&trial, &mut self.mind(&trial)?, |step| {
            steps += 1;
            if first.is_none() && step.ends.is_some() {
                let here = step.robot.truth().pose.position;
                first = sure_of(&step.belief(), squares.pitch)
                    .map(|at| ((at - here).norm() < NEAR * squares.pitch, steps));
            }
        })?;
        let driven = first.map_or(episode.path.len(), |(_, steps)| steps + 1);
        let path = episode.path.get(..driven).unwrap_or(&episode.path);
        let observer = self.contest.observer(&self.course);
        Ok(Located {
            outcome: match first {
                Some((true, _)) => LocateOutcome::Right,
                Some((false, _)) => LocateOutcome::Wrong,
                None => LocateOutcome::Abstained {
                    why: "it came to the goal before it knew".to_owned(),
                },
            },
            ceiling: Some(observer.after(squares, start, path)),
            chances: Vec::new(),
            with_true_map: None,
        })
    }
}

/// Returns the most likely position of a belief, if enough of the belief is near that position.
fn sure_of(belief: &[Guess], pitch: f64) -> Option<Point> {
    let point = |guess: &Guess| match guess.at {
        Position::Point(point) => Some(point),
        Position::Place(_) => None,
    };
    let best = point(belief.first()?)?;
    let near = belief.iter().filter(|guess| {
        let at = point(guess);
        at.is_some_and(|at| (at - best).norm() < NEAR * pitch)
    });
    let mass: f64 = near.map(|guess| guess.weight).sum();
    (mass > SURE).then_some(best)
}
