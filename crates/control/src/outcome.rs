/// Outcome of a high-level action.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outcome {
    /// Carried out: turned and translated.
    Completed,
    /// A wall came close after at least one step of translation. MSLST does not record this as a
    /// failure.
    CutShort,
    /// The action was not carried out: no step was made in the direction of travel.
    Failed,
    /// No layer ended the action: [`Drive`](crate::Drive) broke it off after its [longest
    /// action](crate::Drive::longest_action). Counts as not carried out.
    TimedOut,
}

impl Outcome {
    /// Returns whether the robot moved on: [`Outcome::Completed`] or [`Outcome::CutShort`].
    #[must_use]
    pub const fn moved(self) -> bool {
        matches!(self, Self::Completed | Self::CutShort)
    }
}
