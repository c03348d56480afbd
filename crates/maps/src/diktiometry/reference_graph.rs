//! The reference graph: "nodes represent local coordinate frames, with links giving known geometric
//! relations".

mod dispute;
mod search;

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::cmp::Ordering;

use tolman_geom::PointBox;

use super::{CoverageGrid, FrameId, PlaceId};
use dispute::Dispute;
pub(super) use search::{Reached, search};

/// A local frame. All frames lie along the axes of the compass, so that a relation is a
/// displacement.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Places whose position is given in the frame, in order of their ids.
    pub places: Vec<PlaceId>,
    /// Relations to frames of higher ids, in order of these ids.
    pub above: Vec<Relation>,
    /// Related frames of lower ids, in order. Each keeps the relation.
    pub below: Vec<FrameId>,
    /// Number of traversals of each cell of the frame's area.
    pub grid: CoverageGrid,
}

impl Frame {
    /// Returns the index of the relation to a frame of a higher id, or the index at which it would
    /// be inserted.
    fn find(&self, to: FrameId) -> Result<usize, usize> {
        self.above.binary_search_by_key(&to, |relation| relation.to)
    }

    /// Returns whether the frame is related to any other.
    pub(super) const fn is_related(&self) -> bool {
        !self.above.is_empty() || !self.below.is_empty()
    }
}

/// Bounds of another frame's position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relation {
    /// The other frame.
    pub to: FrameId,
    /// Position of the other frame's origin in this frame, m: the intersection of all estimates
    /// that agree.
    pub position: PointBox,
    /// Smallest box that holds all estimates, m.
    pub envelope: PointBox,
    /// Number of estimates.
    pub estimates: u32,
}

impl Relation {
    /// Returns the relation as seen from the other frame.
    fn back_to(self, from: FrameId) -> Self {
        Self {
            to: from,
            position: -self.position,
            envelope: -self.envelope,
            ..self
        }
    }
}

/// Two estimates of one displacement that exclude each other. A bound was broken, or two places
/// were confused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excluded {
    /// Bounds before the estimate, m.
    pub known: PointBox,
    /// The new estimate, m.
    pub estimate: PointBox,
}

/// Frames and the relations between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReferenceGraph {
    pub(super) frames: Vec<Frame>,
    /// Estimates against relations, by the lower and the higher id of the two frames.
    disputes: BTreeMap<[FrameId; 2], Dispute>,
}

impl ReferenceGraph {
    /// Returns all frames, by id. Frames without places have no relations either.
    #[must_use]
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// Returns the relation of `to` to `from`, or `None` if it is not known. O(log degree).
    #[must_use]
    pub fn relation(&self, from: FrameId, to: FrameId) -> Option<Relation> {
        let frame = self.frames.get(from.min(to).index())?;
        let relation = frame.above[frame.find(from.max(to)).ok()?];
        Some(if from < to {
            relation
        } else {
            relation.back_to(to)
        })
    }

    /// Returns the relations of a frame to others, in order of their ids.
    pub fn relations(&self, from: FrameId) -> impl Iterator<Item = Relation> + Clone {
        let frame = self.frames.get(from.index()).into_iter();
        frame.flat_map(move |frame| {
            let below = frame.below.iter();
            let below = below.filter_map(move |to| self.relation(from, *to));
            below.chain(frame.above.iter().copied())
        })
    }

    /// Returns the position of the origin of `to` in `from` by the relation between the two, m, or
    /// `None` if they are not related.
    pub(super) fn known(&self, from: FrameId, to: FrameId) -> Option<PointBox> {
        if from == to {
            return Some(PointBox::ORIGIN);
        }
        self.relation(from, to).map(|relation| relation.position)
    }

    pub(super) fn add_frame(&mut self) -> FrameId {
        let id = FrameId(self.frames.len() as u32);
        self.frames.push(Frame::default());
        id
    }

    /// Checks that an estimate of the position of `to` in `from` agrees with the known relation.
    pub(super) fn allows(
        &self,
        from: FrameId,
        to: FrameId,
        estimate: PointBox,
    ) -> Result<(), Excluded> {
        match self.known(from, to) {
            Some(known) if !known.meets(estimate) => Err(Excluded { known, estimate }),
            _ => Ok(()),
        }
    }

    /// Takes in an estimate of the position of `to` in `from`. An estimate that contradicts the
    /// known relation changes only the envelope.
    pub(super) fn relate(
        &mut self,
        from: FrameId,
        to: FrameId,
        estimate: PointBox,
    ) -> Result<(), Excluded> {
        let allowed = self.allows(from, to, estimate);
        match from.cmp(&to) {
            Ordering::Less => self.relate_upwards(from, to, estimate),
            Ordering::Equal => {}
            Ordering::Greater => self.relate_upwards(to, from, -estimate),
        }
        allowed
    }

    /// Takes in an estimate of the position of `to`, the frame of the higher id.
    fn relate_upwards(&mut self, from: FrameId, to: FrameId, estimate: PointBox) {
        let below = &mut self.frames[to.index()].below;
        if let Err(at) = below.binary_search(&from) {
            // Few relations each, but of many frames: no room to spare.
            below.reserve_exact(1);
            below.insert(at, from);
        }
        let frame = &mut self.frames[from.index()];
        let at = frame.find(to).unwrap_or_else(|at| {
            let new = Relation {
                to,
                position: estimate,
                envelope: estimate,
                estimates: 0,
            };
            frame.above.reserve_exact(1);
            frame.above.insert(at, new);
            at
        });
        let relation = &mut frame.above[at];
        if let Some(both) = relation.position.intersection(estimate) {
            relation.position = both;
        }
        relation.envelope = relation.envelope.hull(estimate);
        relation.estimates = relation.estimates.saturating_add(1);
    }

    /// Notes an estimate that [`Self::relate`] found to contradict the relation. The relation gives
    /// way once more estimates contradict it and agree with each other than it rests on: one of
    /// its own was an outlier.
    ///
    /// Beyond the paper, whose intersection of all estimates keeps the first for good.
    pub(super) fn dispute(&mut self, from: FrameId, to: FrameId, estimate: PointBox) {
        let ends = [from.min(to), from.max(to)];
        let frame = &mut self.frames[ends[0].index()];
        let Ok(at) = frame.find(ends[1]) else {
            return;
        };
        let estimate = if from < to { estimate } else { -estimate };
        let dispute = self.disputes.entry(ends);
        dispute
            .and_modify(|dispute| dispute.join(estimate))
            .or_insert_with(|| Dispute::begun(estimate))
            .settle(&mut frame.above[at]);
    }

    /// Widens a relation to the envelope of all estimates, because one of the estimates was wrong.
    pub(super) fn open(&mut self, from: FrameId, to: FrameId) {
        let frame = &mut self.frames[from.min(to).index()];
        if let Ok(at) = frame.find(from.max(to)) {
            frame.above[at].position = frame.above[at].envelope;
        }
    }

    /// Removes all relations of a frame without places.
    pub(super) fn clear(&mut self, id: FrameId) {
        let Frame { above, below, .. } = core::mem::take(&mut self.frames[id.index()]);
        for relation in above {
            let others = &mut self.frames[relation.to.index()].below;
            others.retain(|other| *other != id);
        }
        for other in below {
            let others = &mut self.frames[other.index()].above;
            others.retain(|relation| relation.to != id);
        }
        self.disputes.retain(|ends, _| !ends.contains(&id));
    }
}
