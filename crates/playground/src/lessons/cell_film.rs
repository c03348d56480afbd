//! Replays of robots that move from cell to cell.

use tolman_arena::course::Course;
use tolman_arena::pioneer::{CORRIDOR_WIDTH, body};
use tolman_film::scenery_of;
use tolman_geom::Pose;
use tolman_maze::{Cell, Direction, Maze};
use tolman_replay::{Belief, BeliefAt, Replay, RobotTrack, Shape, json};
use tolman_systems::control::heading_of;

use crate::PlaygroundError;

/// Number of time steps in which a robot turns, and of those in which it drives one cell.
const TURN: u32 = 2;
const DRIVE: u32 = 4;

/// Duration of a time step, s.
const STEP_S: f64 = 0.1;

/// Weight of the faintest pose that is drawn: of many, all are still seen.
const FAINTEST: f64 = 0.25;

/// A robot's poses, from cell to cell.
#[derive(Clone, Debug)]
pub(super) struct CellTrack {
    pub(super) name: String,
    /// The pose at the beginning and after every move.
    pub(super) poses: Vec<(Cell, Direction)>,
    /// Poses that the robot considered possible at each of them; empty if it had no belief.
    pub(super) beliefs: Vec<Vec<(Cell, Direction)>>,
}

impl CellTrack {
    pub(super) fn new(name: &str, poses: Vec<(Cell, Direction)>) -> Self {
        Self {
            name: name.to_owned(),
            poses,
            beliefs: Vec::new(),
        }
    }
}

/// Returns the replay of robots that move at the same time, in the replay player's form. All
/// tracks have at least one pose.
pub(super) fn film(
    title: &str,
    maze: &Maze,
    tracks: &[CellTrack],
) -> Result<String, PlaygroundError> {
    let course = Course::new("lesson", maze.clone(), CORRIDOR_WIDTH)?;
    let place = |(cell, heading): (Cell, Direction)| {
        Pose::new(course.cell_centre(cell), heading_of(heading))
    };
    let mut scenery = None;
    let tracks = tracks.iter().map(|track| {
        let mut poses: Vec<Pose> = track
            .poses
            .first()
            .copied()
            .map(place)
            .into_iter()
            .collect();
        // Steps at which the robot has come to each of its poses, and at which it was lifted.
        let (mut steps, mut lifts) = (vec![0], Vec::new());
        for pair in track.poses.windows(2) {
            if is_near(pair[0].0, pair[1].0) {
                poses.extend(between(place(pair[0]), place(pair[1])));
            } else {
                lifts.push(poses.len() as u32);
                poses.push(place(pair[1]));
            }
            steps.push(poses.len() as u32 - 1);
        }
        let mut robot = RobotTrack::new(track.name.clone(), body(), poses);
        robot.lifts = lifts;
        let entries = steps
            .into_iter()
            .zip(&track.beliefs)
            .map(|(step, believed)| {
                let weight = 1.0 / believed.len().max(1) as f64;
                let shapes = believed.iter().map(|pose| Shape::Pose {
                    pose: place(*pose),
                    weight: weight.max(FAINTEST),
                });
                let shapes = shapes.collect();
                BeliefAt { step, shapes }
            });
        let entries: Vec<BeliefAt> = entries.collect();
        if !entries.is_empty() {
            robot.beliefs.push(Belief {
                name: "possible places".to_owned(),
                entries,
            });
        }
        scenery.get_or_insert_with(|| scenery_of(&course, &mut robot));
        // How much of the floor it was on says nothing here.
        robot.series.clear();
        robot
    });
    let tracks: Vec<RobotTrack> = tracks.collect();
    let replay = Replay::new(title, STEP_S, scenery.unwrap_or_default(), tracks);
    Ok(json(&replay)?)
}

/// Returns whether a robot drives from one cell to the other in one move, or stays.
const fn is_near(one: Cell, other: Cell) -> bool {
    one.x.abs_diff(other.x) + one.y.abs_diff(other.y) <= 1
}

/// Returns the poses after `from` up to `to`: a turn, and a drive.
fn between(from: Pose, to: Pose) -> impl Iterator<Item = Pose> {
    let turn = from.heading.turn_to(to.heading);
    let turned = (1..=TURN).map(move |step| {
        let share = f64::from(step) / f64::from(TURN);
        Pose::new(from.position, from.heading.turned(share * turn))
    });
    let driven = (1..=DRIVE).map(move |step| {
        let share = f64::from(step) / f64::from(DRIVE);
        let on = from.position + (to.position - from.position) * share;
        Pose::new(on, to.heading)
    });
    turned.chain(driven)
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Heading, Point};

    use super::*;

    #[test]
    fn a_move_ends_at_its_pose() {
        let from = Pose::new(Point::new(0.5, 0.5), Heading::NORTH);
        let to = Pose::new(Point::new(1.5, 0.5), Heading::EAST);
        let poses: Vec<Pose> = between(from, to).collect();
        assert_eq!(poses.len(), (TURN + DRIVE) as usize);
        let last = poses[poses.len() - 1];
        assert!((last.position - to.position).norm() < 1e-12);
        assert!(last.heading.turn_to(to.heading).abs() < 1e-12);
        assert!((poses[1].position - from.position).norm() < 1e-12);
    }
}
