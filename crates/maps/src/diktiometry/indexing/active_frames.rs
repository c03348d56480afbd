use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};

use crate::diktiometry::{Diktiometry, FrameId, PlaceId, Reached};

/// A frame whose relation to the robot's position is informative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveFrame {
    /// Id of the frame.
    pub frame: FrameId,
    /// Position of the robot in the frame, m.
    pub robot: PointBox,
}

impl ActiveFrame {
    /// Returns the frame of the robot's place.
    pub(crate) fn at(map: &Diktiometry, place: PlaceId) -> Self {
        let (frame, robot) = map.site(place);
        Self { frame, robot }
    }

    /// Returns the frame as reached by a search from the frame in which the robot is at `here`.
    pub(crate) fn seen_from(&self, here: PointBox) -> Reached {
        Reached {
            frame: self.frame,
            position: here - self.robot,
            hops: 0,
        }
    }
}

/// Returns the active frames after a displacement: "dropping frames which are not informative, and
/// adding neighbors of active frames which appear both informative and relevant".
///
/// `here` is the frame of the robot's place, with the robot in it. It is always active. If its box
/// for a neighbour is narrower than the one carried along, the narrower one is used. At most `cap`
/// frames are kept, those with the narrowest box. O(active frames · degree · log).
pub(crate) fn moved(
    map: &Diktiometry,
    active: &[ActiveFrame],
    displacement: PointBox,
    here: ActiveFrame,
    cap: usize,
) -> Vec<ActiveFrame> {
    let carried = active.iter().map(|frame| ActiveFrame {
        robot: frame.robot + displacement,
        ..*frame
    });
    let mut next: Vec<ActiveFrame> = carried.collect();
    next.push(here);
    let around = next.iter().flat_map(|frame| {
        let relations = map.reference.relations(frame.frame);
        relations.map(|relation| ActiveFrame {
            frame: relation.to,
            robot: frame.robot - relation.position,
        })
    });
    let neighbours = around.filter(|frame| is_relevant(map, frame));
    let neighbours: Vec<ActiveFrame> = neighbours.collect();
    next.extend(neighbours);
    next.sort_by_key(|frame| frame.frame);
    // What several ways say of one frame holds together; where they exclude each other, the
    // narrower counts.
    next.dedup_by(|other, kept| {
        let same = other.frame == kept.frame;
        if same {
            let narrower = if other.robot.width() < kept.robot.width() {
                other.robot
            } else {
                kept.robot
            };
            kept.robot = kept.robot.intersection(other.robot).unwrap_or(narrower);
        }
        same
    });
    next.retain(|frame| is_informative(map, frame));
    if next.len() > cap {
        next.sort_by(|a, b| {
            let width = a.robot.width().total_cmp(&b.robot.width());
            width.then(a.frame.cmp(&b.frame))
        });
        next.truncate(cap);
        next.sort_by_key(|frame| frame.frame);
    }
    next
}

/// Returns the envelope of a frame, "the bounding interval of the position intervals of F's
/// places". It is that of the nominal envelopes, as a frame defined by one place would otherwise be
/// a point. `None` without places.
fn envelope(map: &Diktiometry, frame: FrameId) -> Option<PointBox> {
    let places = map.frame(frame).places.iter();
    let boxes = places.map(|place| map.place(*place).envelope);
    boxes.reduce(PointBox::hull)
}

/// Returns whether a frame is informative. It is not if "(a) the robot's estimated position
/// interval with respect to F contains the origin (ie, F), and (b) the center of the interval … is
/// not within F's envelope".
fn is_informative(map: &Diktiometry, frame: &ActiveFrame) -> bool {
    envelope(map, frame.frame).is_some_and(|envelope| {
        !frame.robot.contains(Point::origin()) || envelope.contains(frame.robot.middle())
    })
}

/// Returns whether "the current position estimate intersects the frame's envelope".
fn is_relevant(map: &Diktiometry, frame: &ActiveFrame) -> bool {
    envelope(map, frame.frame).is_some_and(|envelope| envelope.meets(frame.robot))
}
