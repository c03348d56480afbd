use tolman_geom::Point;
use tolman_robot::{Guess, Position};

use super::contestant::pioneer_course;
use super::play::{Contest, Home, LocateOutcome, Located, Measured, NEAR, length};
use super::whereabouts::Squares;
use crate::BoxError;
use crate::cast::{Agent, Cast};
use crate::episode::{self, Episode, Trial};
use crate::pioneer::calibrated;

/// Time steps of a run at most for each metre that may be driven: whoever turns on the spot drives nowhere.
const STEPS_A_METRE: f64 = 20.0;

/// Lets a baseline go to the goal from where a system is put down, on the laser Pioneer.
pub(super) fn homes(contest: &Contest<'_>, agent: Agent) -> Result<Vec<Home>, BoxError> {
    let course = pioneer_course(contest.name, &contest.maze_afterwards())?;
    let cast = Cast::default();
    let mut homes = Vec::new();
    for (number, [_, (cell, way)]) in (0_u64..).zip(contest.put_downs()) {
        let shortest = course.maze.metres_to_goal(cell, course.corridor_width);
        let most = Contest::LIMIT * shortest;
        let start = course.in_cell(cell, way);
        let trial = Trial {
            course: &course,
            robot: contest.condition.laser_pioneer(calibrated(), contest.seed),
            start,
            step_limit: (libm::ceil(most * STEPS_A_METRE) as u32).max(1),
            seed: contest.seed.wrapping_add(number),
        };
        let mut mind = cast.mind(agent, &course, &trial.robot)?;
        let Episode {
            reached,
            bumps,
            path,
            ..
        } = episode::run(&trial, &mut mind, |_| {})?;
        let way = length(&path);
        let arrived = reached && way <= most;
        homes.push(Home {
            over_shortest: arrived.then_some(way / shortest),
            bumps,
            gave_up: String::new(),
        });
    }
    Ok(homes)
}

/// It knows where it is when so much of its belief lies about one cell.
const SURE: f64 = 0.95;

/// Lets the baseline that has the true map, and no idea where it is, find that out on its way to the goal, on the laser Pioneer; of the others none.
///
/// It is as sure as the systems have to be: when it has most of its belief about one cell.
pub(super) fn found(contest: &Contest<'_>, agent: Agent) -> Result<Vec<Located>, BoxError> {
    if agent != Agent::UnlocalizedOracle {
        return Ok(Vec::new());
    }
    let course = pioneer_course(contest.name, &contest.maze_afterwards())?;
    let squares = Squares {
        grid: contest.maze.grid(),
        pitch: course.corridor_width,
    };
    let cast = Cast::default();
    let mut all = Vec::new();
    for (number, [start, _]) in (0_u64..).zip(contest.put_downs()) {
        let most = Contest::LIMIT * contest.maze.corridor_count() as f64 * squares.pitch;
        let trial = Trial {
            course: &course,
            robot: contest.condition.laser_pioneer(calibrated(), contest.seed),
            start: course.in_cell(start.0, start.1),
            step_limit: (libm::ceil(most * STEPS_A_METRE) as u32).max(1),
            seed: contest.seed.wrapping_add(number),
        };
        let mut mind = cast.mind(agent, &course, &trial.robot)?;
        // Whether it was right when it was sure first, and how many time steps it had made.
        let mut first = None;
        let mut steps = 0_usize;
        let episode = episode::run(&trial, &mut mind, |step| {
            steps += 1;
            if first.is_none() && step.ends.is_some() {
                let here = step.robot.truth().pose.position;
                first = sure_of(&step.belief(), squares.pitch)
                    .map(|at| ((at - here).norm() < NEAR * squares.pitch, steps));
            }
        })?;
        let driven = first.map_or(episode.path.len(), |(_, steps)| steps + 1);
        let path = episode.path.get(..driven).unwrap_or(&episode.path);
        all.push(Located {
            outcome: match first {
                Some((true, _)) => LocateOutcome::Right,
                Some((false, _)) => LocateOutcome::Wrong,
                None => LocateOutcome::Abstained {
                    why: "it came to the goal before it knew".to_owned(),
                },
            },
            ceiling: Some(contest.observer().after(squares, start, path)),
        });
    }
    Ok(all)
}

/// Where it likeliest is, if enough of the belief lies about there.
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
