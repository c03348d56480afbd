//! A replay of a run that is being watched.

use tolman_control::{CorridorDetector, Outcome, View};
use tolman_geom::Point;
use tolman_maze::Direction;
use tolman_robot::{Body, Robot};

use super::floor::Floor;
use super::{Fact, Mark, Marks, Notes, Replay, Scenery, Track};
use crate::episode::{Episode, Step, Trial};

/// Watches an episode and makes its replay: the robot's way, the action under way and how the last one
/// ended, whether it is in a corridor, how much of the maze it has seen, and where it bumped and failed.
///
/// ```
/// use tolman::agents::{Agent, Cast};
/// use tolman::course::Course;
/// use tolman::episode::{self, Trial, random_start};
/// use tolman::pioneer::{body, calibrated};
/// use tolman::replay::Recorder;
///
/// let maze = tolman_maze::read("o---o---o---o\n| S       G |\no---o---o---o\n")?;
/// let (course, robot) = (Course::new("corridor", &maze, &body())?, calibrated());
/// let start = random_start(&course, &body(), 7);
/// let trial = Trial { course: &course, robot, start, step_limit: 500, seed: 7 };
/// let mut mind = Cast::default().mind(Agent::Avoid, &course, &trial.robot)?;
///
/// let mut recorder = Recorder::new(&trial);
/// let episode = episode::run(&trial, &mut mind, |step| recorder.see(step))?;
/// let replay = recorder.finish("Avoid in a corridor", &episode);
/// assert_eq!(replay.steps(), episode.steps as usize);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Recorder<'a> {
    trial: &'a Trial<'a>,
    detector: Option<CorridorDetector>,
    step: u32,
    action: Notes,
    ended: Notes,
    corridor: Notes,
    bumps: Marks,
    failures: Marks,
}

impl<'a> Recorder<'a> {
    /// Watches a run of this trial.
    #[must_use]
    pub fn new(trial: &'a Trial<'a>) -> Self {
        Self {
            trial,
            // A ring it cannot read is one the episode refuses.
            detector: CorridorDetector::new(trial.robot.ring, trial.course.corridor_width).ok(),
            step: 0,
            action: Notes::new("action"),
            ended: Notes::new("last action"),
            corridor: Notes::new("corridor"),
            bumps: Marks::new(Mark::Bump, "bump"),
            failures: Marks::new(Mark::Failure, "failed action"),
        }
    }

    /// Sees one step.
    pub fn see(&mut self, seen: &Step<'_>) {
        self.step += 1;
        let step = self.step;
        self.action.say(step, word(seen.action));
        if let Some(outcome) = seen.ends {
            let outcome_word = match outcome {
                Outcome::Completed => "completed",
                Outcome::CutShort => "cut short",
                Outcome::Failed => "failed",
            };
            self.ended
                .say(step, format!("{}: {outcome_word}", word(seen.action)));
            if !outcome.moved() {
                self.failures.steps.push(step);
            }
        }
        if seen.robot.truth().bump {
            self.bumps.steps.push(step);
        }
        let sensing = seen.robot.sensing();
        if let (Some(detector), Some(scan), Some(heading)) =
            (&self.detector, &sensing.scan, sensing.compass)
        {
            let corridor = detector.detect(View { scan, heading });
            self.corridor
                .say(step, if corridor.is_some() { "yes" } else { "no" });
        }
    }

    /// The replay of the run that was seen and ended so.
    #[must_use]
    pub fn finish(self, title: impl Into<String>, episode: &Episode) -> Replay {
        let Trial { course, robot, .. } = self.trial;
        let body = Body::Circle {
            radius: robot.radius,
        };
        let mut track = Track::new("robot", body, episode.path.clone());
        track.ring = Some(robot.ring);
        let mut scenery = Scenery::of_world(&course.world);
        let path = || episode.path.iter().map(|pose| pose.position);
        let start: Point = self.trial.start.position;
        if let Some(floor) = Floor::from(&course.world, start) {
            scenery.zones.extend(floor.solid());
            track.series.push(floor.coverage(path()));
        }
        track.notes = vec![self.action, self.ended, self.corridor];
        let mut arrival = Marks::new(Mark::Arrival, "arrived");
        if episode.reached {
            arrival.steps.push(episode.steps);
        }
        track.marks = vec![self.bumps, self.failures, arrival];
        let mut replay = Replay::new(title, robot.step_us as f64 * 1e-6, scenery, vec![track]);
        replay.facts = vec![
            Fact::new("maze", &course.name),
            Fact::new("seed", self.trial.seed.to_string()),
            Fact::new("outcome", outcome(episode)),
        ];
        replay
    }
}

fn outcome(episode: &Episode) -> String {
    let Episode {
        reached,
        actions,
        failed_actions,
        steps,
        bumps,
        ..
    } = episode;
    let came = if *reached {
        "arrived"
    } else {
        "did not arrive"
    };
    format!("{came}: {steps} steps, {actions} actions, {failed_actions} failed, {bumps} bumps")
}

const fn word(action: Direction) -> &'static str {
    match action {
        Direction::North => "north",
        Direction::East => "east",
        Direction::South => "south",
        Direction::West => "west",
    }
}
