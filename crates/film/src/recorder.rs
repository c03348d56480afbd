//! Records runs for replays.

use tolman_control::{CorridorDetector, Outcome, View};
use tolman_geom::Point;
use tolman_robot::{Body, Guess, Robot};

use tolman_arena::episode::{Episode, Step, Trial};
use tolman_replay::{Belief, Mark, Marks, Notes, Replay, RobotTrack};

use crate::scenery::scenery_of;

/// Records an episode and makes its replay.
///
/// The replay shows the robot's way, the present action, how the last one ended, and whether the
/// robot is in a corridor. It also shows the robot's notes and believed position, how much of the
/// maze it has seen, and where it bumped and failed.
///
/// ```
/// use tolman_arena::cast::{Agent, Cast};
/// use tolman_arena::course::Course;
/// use tolman_arena::episode::{self, Trial, random_start};
/// use tolman_arena::pioneer::{body, calibrated};
/// use tolman_film::Recorder;
///
/// let maze = tolman_maze::read("o---o---o---o\n| S       G |\no---o---o---o\n")?;
/// let (course, robot) = (Course::for_body("corridor", &maze, &body())?, calibrated());
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
    between_actions: bool,
    action: Notes,
    ended: Notes,
    corridor: Notes,
    thoughts: Notes,
    belief: Belief,
    /// Positions of the nodes of the robot's map, m, by id.
    nodes: &'a [Point],
    bumps: Marks,
    failures: Marks,
}

impl<'a> Recorder<'a> {
    /// Returns a recorder for a run of this trial.
    #[must_use]
    pub fn new(trial: &'a Trial<'a>) -> Self {
        Self {
            trial,
            // The episode refuses a ring that the detector cannot read.
            detector: CorridorDetector::new(trial.robot.ring, trial.course.corridor_width).ok(),
            step: 0,
            between_actions: true,
            action: Notes::new("action"),
            ended: Notes::new("last action"),
            corridor: Notes::new("corridor"),
            thoughts: Notes::new("thinks"),
            belief: Belief::new("belief"),
            nodes: &[],
            bumps: Marks::new(Mark::Bump, "bump", []),
            failures: Marks::new(Mark::Failure, "failed action", []),
        }
    }

    /// Shows beliefs at the true positions of the map's nodes, by id. Without this they are shown
    /// only in words.
    #[must_use]
    pub const fn knowing(mut self, nodes: &'a [Point]) -> Self {
        self.nodes = nodes;
        self
    }

    /// Records the brain's notes and belief when it chose the action that begins after `step`.
    fn overhear(&mut self, step: u32, words: &str, belief: &[Guess]) {
        if !words.is_empty() {
            self.thoughts.say(step, words);
        }
        let site = |id: u32| self.nodes.get(id as usize).copied();
        self.belief.note(step, belief, site);
    }

    /// Records one step.
    pub fn see(&mut self, seen: &Step<'_>) {
        if self.between_actions {
            self.overhear(self.step, &seen.words(), &seen.belief());
        }
        self.between_actions = seen.ends.is_some();
        self.step += 1;
        let step = self.step;
        self.action.say(step, seen.action.to_string());
        if let Some(outcome) = seen.ends {
            let outcome_word = match outcome {
                Outcome::Completed => "completed",
                Outcome::CutShort => "cut short",
                Outcome::Failed => "failed",
                Outcome::TimedOut => "timed out",
            };
            self.ended
                .say(step, format!("{}: {outcome_word}", seen.action));
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

    /// Returns the replay of the recorded run.
    #[must_use]
    pub fn finish(self, title: impl Into<String>, episode: &Episode) -> Replay {
        let Trial { course, robot, .. } = self.trial;
        let body = Body::Circle {
            radius: robot.radius,
        };
        let mut track = RobotTrack::new("robot", body, episode.path.clone());
        track.ring = Some(robot.ring);
        let scenery = scenery_of(course, &mut track);
        track.notes = vec![self.action, self.ended, self.corridor];
        if !self.thoughts.notes.is_empty() {
            track.notes.push(self.thoughts);
        }
        if !self.belief.entries.is_empty() {
            track.beliefs.push(self.belief);
        }
        let arrived = episode.reached.then_some(episode.steps);
        let arrival = Marks::new(Mark::Arrival, "arrived", arrived);
        track.marks = vec![self.bumps, self.failures, arrival];
        Replay::new(title, robot.step_us as f64 * 1e-6, scenery, vec![track])
            .fact("maze", &course.name)
            .fact("seed", self.trial.seed.to_string())
            .fact("outcome", outcome(episode))
    }
}

fn outcome(episode: &Episode) -> String {
    let came = match episode.reached {
        true => "arrived",
        false => "did not arrive",
    };
    format!(
        "{came}: {} steps, {} actions, {} failed, {} bumps",
        episode.steps, episode.actions, episode.failed_actions, episode.bumps
    )
}
