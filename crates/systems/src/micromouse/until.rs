/// When a mouse has explored enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Until {
    /// When it has been at the goal.
    Goal,
    /// When to look on is expected to cost more than it gains in the score.
    Worth,
    /// When no run can score less than the best known one, whatever the unknown walls are.
    Proof,
}
