//! What a mapper says of its own map during a walk, beside the truth.

use tolman_arena::diktiometry::Survey;
use tolman_maps::diktiometry::MapState;

/// Number of moves between two questions, the same as the system's own.
const ASKED: u32 = 10;

/// Number of moves within which a mapper should object to a map that has become wrong.
const SOON: u32 = 200;

/// Listens to a mapper during a walk. A map is *wrong* if it does not match what was visited.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Listener {
    /// Move from which the map has been wrong without interruption.
    wrong_since: Option<u32>,
    /// Number of moves from then until the mapper objected.
    delay: Option<u32>,
}

/// A mapper's statement about its map at the end of a walk, and the delay of its objection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Statement {
    pub(super) state: MapState,
    /// Number of moves from when the map became wrong for good until the mapper objected. `None`
    /// if the map is right, or the mapper never objected.
    pub(super) delay: Option<u32>,
}

impl Listener {
    /// Takes in the state after a move. Only a wrong map that was not objected to is checked,
    /// because the check is slow on large maps.
    pub(super) fn listen(&mut self, survey: &Survey) {
        let number = survey.moves();
        if !number.is_multiple_of(ASKED) {
            return;
        }
        if survey.score().is_isomorphic {
            *self = Self::default();
            return;
        }
        let since = *self.wrong_since.get_or_insert(number);
        if self.delay.is_none() && is_objection(said(survey)) {
            self.delay = Some(number - since);
        }
    }

    /// Returns the statement at the end of the walk.
    pub(super) fn statement(self, survey: &Survey) -> Statement {
        Statement {
            state: said(survey),
            delay: self.delay,
        }
    }
}

impl Statement {
    /// Returns whether the mapper objects to its map at the end.
    pub(super) const fn objects(self) -> bool {
        is_objection(self.state)
    }

    /// Returns whether the mapper says that its map is not folded.
    pub(super) const fn says_unfolded(self) -> bool {
        is_unfolded(self.state)
    }

    /// Returns whether the mapper objects at the end, and did so soon after the map became wrong.
    pub(super) fn objected_soon(self) -> bool {
        self.objects() && self.delay.is_some_and(|delay| delay <= SOON)
    }
}

fn said(survey: &Survey) -> MapState {
    let observer = survey.observer();
    observer.map_or(MapState::Unfinished, |observer| {
        observer.self_check().state()
    })
}

const fn is_objection(state: MapState) -> bool {
    is_unfolded(state) || matches!(state, MapState::Contradictory)
}

const fn is_unfolded(state: MapState) -> bool {
    matches!(state, MapState::Unfolded | MapState::Endless)
}
