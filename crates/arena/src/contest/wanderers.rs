use super::contestant::pioneer_course;
use super::play::{Contest, Home, Measured, length};
use crate::BoxError;
use crate::cast::{Agent, Cast};
use crate::episode::{self, Episode, Trial};
use crate::pioneer::calibrated;

/// Time steps of a run at most for each metre that may be driven: whoever turns on the spot drives nowhere.
const STEPS_A_METRE: f64 = 20.0;

/// Lets a baseline go to the goal from where a system is put down, on the laser Pioneer.
pub(super) fn homes(contest: &Contest<'_>, agent: Agent) -> Result<Vec<Home>, BoxError> {
    let course = pioneer_course(contest.name, contest.maze)?;
    let cast = Cast::default();
    let mut homes = Vec::new();
    for (number, [_, (cell, way)]) in (0_u64..).zip(contest.put_downs()) {
        let shortest = contest.maze.metres_to_goal(cell, course.corridor_width);
        let most = Contest::LIMIT * shortest;
        let start = course.in_cell(cell, way);
        let trial = Trial {
            course: &course,
            robot: calibrated(),
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
