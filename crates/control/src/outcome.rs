/// How a high-level action ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outcome {
    /// Carried out: turned and translated.
    Completed,
    /// A wall came close after at least one step of translation. MSLST does not record this as a failure.
    CutShort,
    /// Not carried out: no step was made in the direction of travel.
    Failed,
}

impl Outcome {
    /// Whether the robot got anywhere: everything but [`Outcome::Failed`].
    #[must_use]
    pub const fn moved(self) -> bool {
        !matches!(self, Self::Failed)
    }
}
