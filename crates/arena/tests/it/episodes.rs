//! Episodes in which the robot is lifted.

use tolman_arena::cast::{Agent, Cast};
use tolman_arena::course::Course;
use tolman_arena::episode::{Episode, EpisodeError, Lifted, Trial, run_lifted};
use tolman_arena::pioneer::{body, calibrated};
use tolman_geom::{Heading, Point, Pose};
use tolman_maze::{Cell, Direction};

const CORRIDOR: &str = "\
+---+---+---+---+---+---+
| S                   G |
+---+---+---+---+---+---+
";

fn episode(lifted: Option<Lifted>) -> Result<Episode, EpisodeError> {
    let file = tolman_maze::read(CORRIDOR).unwrap();
    let course = Course::for_body("corridor", &file, &body()).unwrap();
    let trial = Trial {
        course: &course,
        robot: calibrated(),
        start: course.in_cell(Cell::new(0, 0), Direction::East),
        step_limit: 60,
        seed: 1,
    };
    let mut mind = Cast::default().mind(Agent::Avoid, &course, &trial.robot)?;
    run_lifted(&trial, &mut mind, lifted, |_| {})
}

#[test]
fn a_robot_is_lifted_once_and_after_its_time() {
    let plain = episode(None).unwrap();
    // The middle of the last cell but one.
    let to = Pose::new(Point::new(4.5 * 0.95, 0.475), Heading::EAST);
    let lifted = episode(Some(Lifted { after: 6, to })).unwrap();
    assert_eq!(lifted.path[..=6], plain.path[..=6]);
    let ways = lifted.path.windows(2);
    let jumps = ways.filter(|two| (two[1].position - two[0].position).norm() > 0.6);
    assert_eq!(jumps.count(), 1);
    assert!(lifted.reached);
}

#[test]
fn a_robot_cannot_be_put_into_a_wall() {
    let to = Pose::IDENTITY;
    let refused = episode(Some(Lifted { after: 1, to }));
    assert!(
        matches!(refused, Err(EpisodeError::Start(_))),
        "{refused:?}"
    );
}
