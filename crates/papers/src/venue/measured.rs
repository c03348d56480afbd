//! The record of an episode for a table.

use super::{PAPER_RUNS, Venue};
use crate::tolerances::{SUCCESS, TIME};
use tolman_arena::episode::Episode;
use tolman_experiment::{Metric, Record, Table, record, require};

record! {
    /// A run of a brain in a maze.
    #[check(MazeRun::relations)]
    pub(crate) struct MazeRun {
        /// Whether the robot's centre was in the destination within the time limit.
        reached: bool => higher("success"),
        /// End of the run, in words.
        outcome: String => neither("outcome"),
        /// Number of actions that the brain chose.
        actions: u32 => lower("actions").at_least(1),
        /// Number of actions that did not move the robot.
        failed_actions: u32 => lower("failed actions"),
        /// Number of actions that failed in their first time step.
        failed_at_once: u32 => lower("failed at once"),
        /// Number of time steps to the destination; the limit if it was not reached.
        steps: u32 => lower("steps"),
        /// Number of time steps of a run that reached the destination.
        steps_arrived: Option<u32> => lower("steps, arrived"),
        /// Number of time steps in which the robot touched a wall.
        bumps: u32 => lower("bumps"),
    }
}

impl MazeRun {
    pub(crate) fn of(episode: &Episode) -> Self {
        Self {
            reached: episode.reached,
            outcome: outcome(episode.reached).to_owned(),
            actions: episode.actions,
            failed_actions: episode.failed_actions,
            failed_at_once: episode.failed_at_once,
            steps: episode.steps,
            steps_arrived: episode.reached.then_some(episode.steps),
            bumps: episode.bumps,
        }
    }

    fn relations(&self) -> Result<(), String> {
        let contradicted = "outcome and reached contradict each other";
        require(self.outcome == outcome(self.reached), contradicted)?;
        require(self.actions <= self.steps, "more actions than steps")?;
        let failed = self.failed_actions <= self.actions;
        require(failed, "more failed actions than actions")?;
        let at_once = self.failed_at_once <= self.failed_actions;
        require(at_once, "more actions failed at once than failed")?;
        let arrived = self.reached.then_some(self.steps);
        require(
            self.steps_arrived == arrived,
            "steps_arrived is not the steps of a run that arrived",
        )?;
        require(self.bumps <= self.steps, "more bumps than steps")
    }
}

/// Returns the outcome of a run in words.
const fn outcome(reached: bool) -> &'static str {
    if reached { "reached" } else { "timed out" }
}

impl Venue {
    /// Returns the table of this world with its first metrics. Each of its runs has a [`MazeRun`]
    /// in its record.
    pub(crate) fn table<T: Record>(&self) -> Table {
        let table = Table::of::<T>(&self.table, &self.title)
            .metric(Metric::percent("success_percent", MazeRun::reached).tolerance(SUCCESS))
            .metric(Metric::mean(MazeRun::actions).tolerance(TIME))
            .metric(Metric::mean(MazeRun::steps).tolerance(TIME))
            .at_most(MazeRun::steps, self.step_limit)
            .note(format!(
                "A run ends when the robot's centre lies in the destination, or fails after {} time steps, \
                 which then count as its steps.",
                self.step_limit
            ));
        if self.paper.is_empty() {
            table
        } else {
            table.paper_runs(PAPER_RUNS)
        }
    }
}
