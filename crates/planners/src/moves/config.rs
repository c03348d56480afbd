/// How a [`MoveExplorer`](super::MoveExplorer) weighs what it could do next.
///
/// None of this touches the proof: whatever the weights, the explorer stops only when no better run is
/// possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveExplorerConfig {
    /// While no way to the goal is known: how much a step on known ground counts against a step of the way
    /// that is hoped for beyond it. ≥ 0.
    pub known_step: f32,
    /// While no way to the goal is known: steps that each unknown wall on the hoped-for way counts as. ≥ 0.
    pub unknown_wall: f32,
    /// While no way to the goal is known: steps that seeing one more unknown side of a cell is worth. ≥ 0.
    pub sight: f32,
    /// While no way to the goal is known: steps that it is worth if that side lies on one of the best runs
    /// that can be hoped for. ≥ 0.
    pub relevant_sight: f32,
    /// Once a way is known: by how much less a wall counts for each step that the best run hoped for
    /// through it is longer than the best of all. Within 0 … 1.
    pub patience: f32,
    /// Once a way is known: what every wall on a run better than the known one counts at least, where
    /// those on the best run count 1. ≥ 0.
    pub base: f32,
    /// Once a way is known: the power of the distance in steps that what a stop would tell is divided by. ≥ 0.
    pub nearness: f32,
}

impl MoveExplorerConfig {
    /// The one configuration that all our figures are made with, chosen on every second of the mazes we
    /// have (`docs/micromouse.md`).
    #[must_use]
    pub const fn tuned() -> Self {
        Self {
            known_step: 1.11,
            unknown_wall: 0.1,
            sight: 0.5,
            relevant_sight: 0.23,
            patience: 0.595,
            base: 0.034,
            nearness: 1.74,
        }
    }
}
