use alloc::sync::Arc;
use std::sync::OnceLock;

use thiserror::Error;

use super::Caster;
use crate::WallSegment;

/// The ray caster of all worlds that a program makes.
///
/// The two agree to 10⁻⁹ m, so runs are alike and may differ in their last bits: that is why a
/// program chooses one, once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CasterChoice {
    /// This crate's own: [`LatticeWalk`](super::LatticeWalk) for mazes and occupancy grids,
    /// [`WallIndex`](super::WallIndex) for free walls.
    #[default]
    BuiltIn,
    /// parry2d's polyline, which needs the feature `parry2d`.
    Parry2d,
}

/// Reason why a caster cannot be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CasterChoiceError {
    /// The program was built without it.
    #[error("this build has no caster parry2d; build it with the feature `parry2d`")]
    NotBuilt,
    /// Another one was chosen before.
    #[error("the caster {} was chosen before; choose one, before worlds are made", before.name())]
    ChosenBefore {
        /// The one that was chosen.
        before: CasterChoice,
    },
}

static CHOSEN: OnceLock<CasterChoice> = OnceLock::new();

impl CasterChoice {
    /// Returns the name, as on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::BuiltIn => "built-in",
            Self::Parry2d => "parry2d",
        }
    }

    /// Makes this the caster of all worlds that are made from now on.
    ///
    /// # Errors
    /// If this build lacks it, or another one was chosen before.
    pub fn install(self) -> Result<(), CasterChoiceError> {
        if self == Self::Parry2d && cfg!(not(feature = "parry2d")) {
            return Err(CasterChoiceError::NotBuilt);
        }
        let before = *CHOSEN.get_or_init(|| self);
        match before == self {
            true => Ok(()),
            false => Err(CasterChoiceError::ChosenBefore { before }),
        }
    }

    /// Returns the one that was chosen.
    #[must_use]
    pub fn current() -> Self {
        CHOSEN.get().copied().unwrap_or_default()
    }

    /// Returns the caster of these walls, if the chosen one takes the place of the usual.
    pub(crate) fn made(self, walls: &[WallSegment]) -> Option<Arc<dyn Caster>> {
        match self {
            Self::BuiltIn => None,
            #[cfg(feature = "parry2d")]
            Self::Parry2d => Some(Arc::new(super::ParryPolyline::new(walls))),
            #[cfg(not(feature = "parry2d"))]
            Self::Parry2d => {
                let _ = walls;
                None
            }
        }
    }
}
