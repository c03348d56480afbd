//! What a run measures: the episode as the fields of a table.

use super::Venue;
use tolman_arena::episode::Episode;
use tolman_experiment::{BoxError, Field, Fields, Kind, Run, Table};

/// The fields of an episode.
pub(crate) fn fields(episode: &Episode) -> Fields {
    Fields::new()
        .flag("reached", episode.reached)
        .text("outcome", outcome(episode.reached))
        .count("actions", u64::from(episode.actions))
        .count("failed_actions", u64::from(episode.failed_actions))
        .count("steps", u64::from(episode.steps))
        .count("bumps", u64::from(episode.bumps))
}

/// How a run ended, in words.
const fn outcome(reached: bool) -> &'static str {
    if reached { "reached" } else { "timed out" }
}

impl Venue {
    /// The table of this world, with the [`fields`] of its runs.
    pub(crate) fn table(&self) -> Table {
        let table = Table::new(&self.table, &self.title)
            .field("reached", Kind::Flag)
            .field("outcome", Kind::Text)
            .field("actions", Kind::Count)
            .field("failed_actions", Kind::Count)
            .field("steps", Kind::Count)
            .field("bumps", Kind::Count)
            .note(format!(
                "A run ends when the robot's centre lies in the destination, or fails after {} time steps, \
                 which then count as its steps.",
                self.step_limit
            ));
        if self.paper.is_empty() {
            table
        } else {
            table.paper_runs(25)
        }
    }

    /// Refuses a run whose [`fields`] no episode here can have.
    pub(crate) fn check(&self, run: &Run) -> Result<(), BoxError> {
        let count = |name: &str| match run.fields.get(name) {
            Some(Field::Count(count)) => *count,
            _ => 0,
        };
        let reached = run.fields.get("reached").and_then(Field::as_flag);
        let told = run.fields.get("outcome").and_then(Field::as_text);
        let (actions, steps) = (count("actions"), count("steps"));
        if told != reached.map(outcome) {
            return Err("outcome and reached contradict each other".into());
        }
        let limit = self.step_limit;
        if steps > u64::from(limit) {
            return Err(format!("steps is {steps}, the limit {limit}").into());
        }
        if !(1..=steps).contains(&actions) {
            return Err(format!("actions is {actions} in {steps} steps").into());
        }
        if count("failed_actions") > actions || count("bumps") > steps {
            return Err("more failed actions or bumps than actions or steps".into());
        }
        Ok(())
    }
}
