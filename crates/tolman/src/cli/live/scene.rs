//! Data that a run passes to its viewer.

use tolman_arena::Outing;
use tolman_arena::course::Course;
use tolman_arena::episode::{Step, Trial};
use tolman_control::Outcome;
use tolman_geom::Pose;
use tolman_robot::{Robot, Scan};

/// Properties of a run that do not change.
#[cfg_attr(
    not(feature = "live"),
    expect(dead_code, reason = "a line shows less than a picture")
)]
#[derive(Clone, Debug)]
pub(in crate::cli) struct Scene {
    pub(in crate::cli) course: Course,
    /// Name of the brain or system that chooses the actions.
    pub(in crate::cli) word: String,
    pub(in crate::cli) seed: u64,
    pub(in crate::cli) start: Pose,
    pub(in crate::cli) step_us: u64,
    /// Radius of the robot, m.
    pub(in crate::cli) radius: f64,
    /// Number of time steps after which the run ends; `None` without a limit.
    pub(in crate::cli) step_limit: Option<u32>,
}

impl Scene {
    /// Returns the scene of a trial, which is driven by the brain called `word`.
    pub(in crate::cli) fn of(trial: &Trial<'_>, word: &str) -> Self {
        Self {
            course: trial.course.clone(),
            word: word.to_owned(),
            seed: trial.seed,
            start: trial.start,
            step_us: trial.robot.step_us,
            radius: trial.robot.radius,
            step_limit: Some(trial.step_limit),
        }
    }

    /// Returns the scene of an outing, which is driven by the system called `word`.
    pub(in crate::cli) fn of_outing(
        outing: &dyn Outing,
        word: &str,
        seed: u64,
        step_limit: Option<u32>,
    ) -> Self {
        Self {
            course: outing.course().clone(),
            word: word.to_owned(),
            seed,
            start: outing.path()[0],
            step_us: outing.robot().step_us,
            radius: outing.robot().body.radius(),
            step_limit,
        }
    }
}

/// A time step that has just been made.
#[cfg_attr(
    not(feature = "live"),
    expect(dead_code, reason = "a line shows less than a picture")
)]
#[derive(Clone, Copy, Debug)]
pub(in crate::cli) struct Now<'a> {
    pub(in crate::cli) pose: Pose,
    /// Whether the step ended at a wall.
    pub(in crate::cli) bump: bool,
    /// Action in progress, or the robot's activity.
    pub(in crate::cli) action: &'a str,
    /// Outcome of an action that ended with this step; `None` if none did.
    pub(in crate::cli) ended: Option<&'a str>,
    pub(in crate::cli) scan: Option<&'a Scan>,
}

/// Passes a step of a trial to `show`.
pub(in crate::cli) fn see(step: &Step<'_>, mut show: impl FnMut(&Now<'_>)) {
    let action = step.action.to_string();
    let ended = step.ends.map(|outcome| {
        let outcome = match outcome {
            Outcome::Completed => "done",
            Outcome::CutShort => "cut short",
            Outcome::Failed => "failed",
            Outcome::TimedOut => "timed out",
        };
        format!("{action}: {outcome}")
    });
    let truth = step.robot.truth();
    show(&Now {
        pose: truth.pose,
        bump: truth.bump,
        action: &action,
        ended: ended.as_deref(),
        scan: step.robot.sensing().scan.as_ref(),
    });
}
