use crate::diktiometry::{Percepts, Place, Signature, SignatureKind, Similarity, ViewRotation};

/// Returns whether a place may have this look: one of its views is similar, or none is known.
pub(crate) fn agrees(place: &Place, percept: Option<&Signature>, percepts: &Percepts) -> bool {
    let (Percepts::Signatures(kind), Some(percept)) = (percepts, percept) else {
        return true;
    };
    place.views.is_empty() || place.views.iter().any(|view| alike(view, percept, kind))
}

/// Returns whether two places may look alike: a view of one is like one of the other's, or a place
/// has no view.
pub(crate) fn share_a_view(a: &Place, b: &Place, percepts: &Percepts) -> bool {
    a.views.is_empty() || a.views.iter().any(|view| agrees(b, Some(view), percepts))
}

/// Returns the similarity of two places by their views, from which the map learns.
pub(crate) fn similarity(a: &Place, b: &Place, percepts: &Percepts) -> Similarity {
    Similarity::of(share_a_view(a, b, percepts))
}

impl Percepts {
    /// Returns whether two looks may be of one place, rotated by at most one column, as a compass
    /// errs differently each time. True if one is missing.
    #[must_use]
    pub fn are_alike(&self, one: Option<&Signature>, other: Option<&Signature>) -> bool {
        let (Self::Signatures(kind), Some(one), Some(other)) = (self, one, other) else {
            return true;
        };
        let turned = [0, 1, kind.columns.saturating_sub(1)].into_iter();
        let agreement = turned.map(|offset| one.agreement(other, offset, kind.tolerance));
        agreement.max() >= Some(kind.enough())
    }
}

/// Returns whether two signatures may be views of one place.
pub(crate) fn alike(view: &Signature, other: &Signature, kind: &SignatureKind) -> bool {
    let offsets = match kind.rotation {
        ViewRotation::Aligned => 1,
        ViewRotation::Free => kind.columns,
    };
    (0..offsets).any(|offset| view.agreement(other, offset, kind.tolerance) >= kind.enough())
}

/// Adds a percept to a place's view set if no view is like it and there is room. Returns whether it
/// did.
pub(crate) fn remember(
    place: &mut Place,
    percept: Option<&Signature>,
    percepts: &Percepts,
) -> bool {
    let (Percepts::Signatures(kind), Some(percept)) = (percepts, percept) else {
        return false;
    };
    let known = place.views.iter().any(|view| alike(view, percept, kind));
    let new = !known && place.views.len() < kind.views;
    if new {
        place.views.push(percept.clone());
    }
    new
}
