use alloc::vec::Vec;

use tolman_geom::PointBox;

use super::{
    Action, ActiveFrame, Diktiometry, LinkId, Matcher, PlaceId, Predicted, TrackId, TrackReport,
};

/// A track: one state estimate ("each tracks a possible true state").
///
/// A track is at a place: matching puts it there, and its box is then the place's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Id of the track.
    pub id: TrackId,
    /// The robot's place if the track is right.
    pub place: PlaceId,
    /// Confidence of the track by its recent matches, 0 to 1.
    pub confidence: f64,
    /// Link by which the track came, or `None` where it began or came by no link.
    pub link: Option<LinkId>,
    /// Distance gone since the last CONTINUE, m.
    pub astray: f64,
    /// Latest matches of the track, the newest last.
    pub history: Vec<TrackEntry>,
    /// Frames about which the track's position is informative.
    pub active: Vec<ActiveFrame>,
}

/// One entry of a track's history.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackEntry {
    /// Matched place.
    pub place: PlaceId,
    /// Action that led there, or `None` where the track began.
    pub action: Option<Action>,
    /// Places that "were considered as matches but rejected" and might still be the same.
    pub doubts: Vec<PlaceId>,
    /// Displacement of the robot since this entry by odometry, m; unbounded if a move since then is
    /// doubtful.
    pub since: PointBox,
}

impl Track {
    /// Returns a track that begins at a place of a map.
    pub(super) fn begun(map: &Diktiometry, id: TrackId, place: PlaceId, confidence: f64) -> Self {
        Self {
            id,
            place,
            confidence,
            link: None,
            astray: 0.0,
            history: Vec::from([TrackEntry {
                place,
                action: None,
                doubts: Vec::new(),
                since: PointBox::ORIGIN,
            }]),
            active: Vec::from([ActiveFrame::at(map, place)]),
        }
    }

    /// Returns the report of the track after a move, without the map's own motion.
    pub(super) const fn report(
        &self,
        from: PlaceId,
        matcher: Option<Matcher>,
        predicted: Option<Predicted>,
    ) -> TrackReport {
        TrackReport {
            track: self.id,
            from,
            matcher,
            place: self.place,
            confidence: self.confidence,
            predicted,
            motion: None,
        }
    }

    /// Adds a match. The displacements since all earlier entries grow by the last move.
    pub(super) fn remember(&mut self, entry: TrackEntry, moved: PointBox, length: usize) {
        for before in &mut self.history {
            before.since = before.since + moved;
        }
        self.history.push(entry);
        let surplus = self.history.len().saturating_sub(length);
        self.history.drain(..surplus);
    }
}
