/// Condition on which a mouse has explored enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Until {
    /// The mouse has been at the goal.
    Goal,
    /// Further exploration is expected to cost more of the score than it gains.
    Worth,
    /// No run can score less than the best known one, whatever the unknown walls are.
    Proof,
}
