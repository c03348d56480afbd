//! Lesson 1: follow a wall. A rule without a map has to bring the robot to the goal.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_maze::Perfect;

use super::rule_run::{RuleEnd, run};
use super::{Answer, LessonMark, Task, TaskView};
use crate::{PlaygroundError, Sketch};

pub(super) const TASKS: &[Task] = &[Task {
    maze: "\
o---o---o---o---o---o---o
|                       |
o   o---o---o   o---o---o
|           |         G |
o---o---o---o---o---o   o
|           |           |
o---o---o   o   o---o   o
|       |   |       |   |
o   o---o   o   o   o   o
|       |   |   |   |   |
o   o   o   o---o   o   o
| S |               |   |
o---o---o---o---o---o---o
",
    view: |sketch, _| Ok(TaskView::of(sketch)),
    mark,
}];

/// Number of mazes that nobody has seen, in each of which the rule has to hold.
const UNSEEN: u32 = 3;

fn mark(sketch: &Sketch, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let run_here = run(sketch.maze(), &answer.rule)?;
    let told = match run_here.end {
        RuleEnd::Arrived => None,
        RuleEnd::Circles => Some(
            "It goes in circles. It has no memory: where it looks the same way again, it does the \
             same again.",
        ),
        RuleEnd::Stuck => Some("It stands still: no line of your rule names an open side."),
    };
    if let Some(told) = told {
        return Ok(LessonMark::new(false, told).showing(run_here.replay));
    }
    let mut rng = ChaCha8Rng::seed_from_u64(answer.seed.into());
    let grid = sketch.maze().grid();
    for number in 1..=UNSEEN {
        let (width, height) = (grid.width(), grid.height());
        let unseen = Perfect { width, height }.generate(&mut rng)?;
        let run_there = run(&unseen, &answer.rule)?;
        if run_there.end != RuleEnd::Arrived {
            let told = format!(
                "It arrives here, but not in maze {number} of {UNSEEN} that it has never seen. \
                 Watch it there."
            );
            return Ok(LessonMark::new(false, told).showing(run_there.replay));
        }
    }
    let told = format!(
        "It arrives, after {} cells. It also arrived in {UNSEEN} mazes that it had never seen.",
        run_here.cells
    );
    Ok(LessonMark::new(true, told).showing(run_here.replay))
}
