//! Lesson 2: why a wall follower fails. A wall that is joined to no other keeps it from the goal.

use tolman_maze::Direction;

use super::edits::Edited;
use super::rule_run::{RuleEnd, run};
use super::{Answer, LessonMark, Task, TaskView};
use crate::session::count;
use crate::{PlaygroundError, Sketch};

pub(super) const TASKS: &[Task] = &[
    Task {
        maze: "\
o---o---o---o---o---o---o
|                       |
o---o---o   o---o---o   o
|       |   |       |   |
o   o   o   o   o---o   o
|   |   |     G |       |
o---o   o---o   o   o---o
|   |       |   |       |
o   o---o   o---o---o   o
|       |           |   |
o   o   o---o---o   o   o
| S |                   |
o---o---o---o---o---o---o
",
        view,
        mark: break_it,
    },
    Task {
        maze: "\
o---o---o---o---o---o---o
|   |                   |
o   o   o   o---o---o   o
|   |   |           |   |
o   o   o---o---o   o---o
|   |           |       |
o   o   o---o   o---o   o
|         G |   |       |
o   o   o---o   o   o---o
|   |       |   |   |   |
o   o---o   o   o   o   o
| S     |               |
o---o---o---o---o---o---o
",
        view,
        mark: repair_it,
    },
];

/// The rule of a robot that keeps its right hand on the wall.
const RIGHT_HAND: [Direction; 4] = [
    Direction::East,
    Direction::North,
    Direction::West,
    Direction::South,
];

fn view(sketch: &Sketch, answer: &Answer) -> Result<TaskView, PlaygroundError> {
    Ok(TaskView::of(&Edited::new(sketch, answer).sketch))
}

fn break_it(sketch: &Sketch, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let edited = Edited::new(sketch, answer);
    if (edited.removed, edited.built) != (1, 0) {
        return Ok(refused(&edited, "Remove exactly one wall and build none"));
    }
    let run = run(edited.sketch.maze(), &RIGHT_HAND)?;
    let mark = match run.end {
        RuleEnd::Arrived => LessonMark::new(
            false,
            format!(
                "It still arrives, after {}. Watch which walls its right hand touches.",
                count(run.cells, "cell")
            ),
        ),
        RuleEnd::Circles | RuleEnd::Stuck => LessonMark::new(
            true,
            "It goes round and round and never arrives, although a way to the goal is open. The \
             walls around the goal are now an island: no wall joins them to those on its right.",
        ),
    };
    Ok(mark.showing(run.replay))
}

fn repair_it(sketch: &Sketch, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let edited = Edited::new(sketch, answer);
    if (edited.removed, edited.built) != (0, 1) {
        return Ok(refused(&edited, "Build exactly one wall and remove none"));
    }
    if edited.sketch.fault().is_some() {
        let told = "Nobody can reach the goal now: your wall closes the last way to it.";
        return Ok(LessonMark::new(false, told));
    }
    let run = run(edited.sketch.maze(), &RIGHT_HAND)?;
    let mark = match run.end {
        RuleEnd::Arrived => LessonMark::new(
            true,
            format!(
                "It arrives, after {}. Your wall joins the island to the other walls, so its hand \
                 is led around the goal.",
                count(run.cells, "cell")
            ),
        ),
        RuleEnd::Circles | RuleEnd::Stuck => LessonMark::new(
            false,
            "It still goes round and round. Watch which walls its right hand never touches.",
        ),
    };
    Ok(mark.showing(run.replay))
}

/// Returns the mark of a maze with other changes than those that are asked for.
fn refused(edited: &Edited, wanted: &str) -> LessonMark {
    let told = format!(
        "{wanted}. You removed {} and built {}.",
        count(edited.removed, "wall"),
        edited.built
    );
    LessonMark::new(false, told)
}
