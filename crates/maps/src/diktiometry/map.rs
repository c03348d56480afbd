use alloc::vec::Vec;

use tolman_geom::PointBox;
use tolman_planners::Graph;

use super::{
    Fate, Frame, FrameId, Link, LinkId, LinkStatus, Looks, PathGraph, Place, PlaceId,
    ReferenceGraph, SearchLimits, search,
};

/// "A diktiometric representation (a *diktiometry*) consists of two graphs, a path graph and a
/// reference graph … connected by reference links, giving the positions of places with respect to
/// particular local reference frames."
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diktiometry {
    /// Places and actions.
    pub paths: PathGraph,
    /// Frames and the relations between them.
    pub reference: ReferenceGraph,
    /// Reliability of looks for telling places apart.
    pub looks: Looks,
}

/// Position at which a place is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnPlace {
    /// Id of the place.
    pub place: PlaceId,
    /// Bounds of the place's position, m. The place is drawn in the middle.
    pub bounds: PointBox,
}

/// A broken invariant of the two graphs. [`Diktiometry::check`] finds none, whatever the robot's
/// input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Flaw {
    /// A standing link is missing from the list of a place at its end, or that place is gone.
    LooseLink(LinkId),
    /// Two links bear the same action between the same places.
    DoubleLink(LinkId),
    /// A place lists a link that is removed or does not belong to it.
    StrangeLink(PlaceId),
    /// A standing place is missing from its frame's list, or a removed place is on it.
    LostPlace(PlaceId),
    /// A position or an envelope is unbounded, or the envelope does not hold the position.
    BadBox(PlaceId),
    /// A frame's relations are not in order, differ from those of the other frame, or remain though
    /// the frame has no places.
    OneSided(FrameId),
    /// A link has an action beyond those of the configuration.
    StrangeAction(LinkId),
}

impl Diktiometry {
    /// Returns the bounds of the position of `to` as seen from `from`, m, from the relations within
    /// `limits`. `None` where they do not reach.
    #[must_use]
    pub fn displacement(
        &self,
        from: PlaceId,
        to: PlaceId,
        limits: &SearchLimits,
    ) -> Option<PointBox> {
        let (start, from) = self.site(self.paths.resolve(from)?);
        let (end, to) = self.site(self.paths.resolve(to)?);
        if start == end {
            return Some(to - from);
        }
        let reached = search(&self.reference, start, limits);
        let there = reached.iter().find(|reached| reached.frame == end)?;
        Some(there.position + to - from)
    }

    /// Returns the position of `to` relative to `from` by the relation between their frames alone,
    /// m, or `None` if they are not related.
    #[must_use]
    pub fn related(&self, from: PlaceId, to: PlaceId) -> Option<PointBox> {
        let (start, from) = self.site(self.paths.resolve(from)?);
        let (end, to) = self.site(self.paths.resolve(to)?);
        Some(self.reference.known(start, end)? + to - from)
    }

    /// Returns the distance from one place to another as the crow flies, m. Frames that are not
    /// related put them 1 m apart.
    #[must_use]
    pub fn distance(&self, from: PlaceId, to: PlaceId) -> f64 {
        let there = self.related(from, to);
        there.map_or(UNRELATED, |there| there.middle().coords.norm())
    }

    /// Returns the cost of a link on a plan, mm: its length. If it lowers the plan's probability of
    /// success by a factor of e, that costs 20 times as much. In a world that never
    /// changed, the cheapest plan is the shortest.
    #[must_use]
    pub fn cost(&self, id: LinkId, link: &Link) -> u32 {
        let doubt = -libm::log(self.paths.chance(id).max(LEAST));
        let metres = self.distance(link.from, link.to) * (1.0 + FAILURE * doubt);
        (1e3 * metres) as u32
    }

    /// Returns all places that can be reached from `origin` in the reference graph, by id, with
    /// positions for drawing relative to `origin`. O(frames · degree · log frames + places · log
    /// places).
    #[must_use]
    pub fn layout(&self, origin: PlaceId) -> Vec<DrawnPlace> {
        let Some(origin) = self.paths.resolve(origin) else {
            return Vec::new();
        };
        let (start, here) = self.site(origin);
        let reached = search(&self.reference, start, &SearchLimits::UNLIMITED);
        let places = reached.iter().flat_map(|frame| {
            let places = self.frame(frame.frame).places.iter();
            places.map(|&place| DrawnPlace {
                place,
                bounds: frame.position + self.place(place).position - here,
            })
        });
        let mut drawn: Vec<DrawnPlace> = places.collect();
        drawn.sort_by_key(|drawn| drawn.place);
        drawn
    }

    /// Returns a place of the map, whether it still stands or not.
    pub(super) fn place(&self, id: PlaceId) -> &Place {
        &self.paths.places[id.index()]
    }

    pub(super) fn place_mut(&mut self, id: PlaceId) -> &mut Place {
        &mut self.paths.places[id.index()]
    }

    /// Returns a link of the map, whether it still stands or not.
    pub(super) fn link(&self, id: LinkId) -> &Link {
        &self.paths.links[id.index()]
    }

    pub(super) fn link_mut(&mut self, id: LinkId) -> &mut Link {
        &mut self.paths.links[id.index()]
    }

    pub(super) fn frame(&self, id: FrameId) -> &Frame {
        &self.reference.frames[id.index()]
    }

    pub(super) fn frame_mut(&mut self, id: FrameId) -> &mut Frame {
        &mut self.reference.frames[id.index()]
    }

    /// Returns the reference link of a place: its frame, and its position there, m.
    pub(super) fn site(&self, place: PlaceId) -> (FrameId, PointBox) {
        let place = self.place(place);
        (place.frame, place.position)
    }

    /// Adds a place to a frame.
    pub(super) fn add_place(&mut self, frame: FrameId, position: PointBox) -> PlaceId {
        let place = self.paths.add_place(frame, position);
        self.frame_mut(frame).places.push(place);
        place
    }

    /// Opens a frame with a place at its origin.
    pub(super) fn found_place(&mut self) -> PlaceId {
        let frame = self.reference.add_frame();
        self.add_place(frame, PointBox::ORIGIN)
    }

    /// Returns the first invariant of the two graphs that does not hold, or `None` if all hold.
    /// O(places + links · degree + relations · log degree).
    #[must_use]
    pub fn check(&self, actions: usize) -> Option<Flaw> {
        self.flawed_link(actions)
            .or_else(|| self.flawed_place())
            .or_else(|| self.flawed_frame())
    }

    fn flawed_link(&self, actions: usize) -> Option<Flaw> {
        self.paths.links().find_map(|(id, link)| {
            let ends = [link.from, link.to].map(|end| self.place(end));
            let [from, to] = ends;
            let listed = from.outgoing.contains(&id) && to.incoming.contains(&id);
            if !listed || ends.iter().any(|end| end.fate != Fate::Standing) {
                return Some(Flaw::LooseLink(id));
            }
            if link.action.0 as usize >= actions {
                return Some(Flaw::StrangeAction(id));
            }
            let along = self.paths.along(link.from, link.action);
            let same = along.filter(|(_, other)| other.to == link.to).count();
            (same != 1).then_some(Flaw::DoubleLink(id))
        })
    }

    fn flawed_place(&self) -> Option<Flaw> {
        let mut all = (0..).map(PlaceId).zip(&self.paths.places);
        all.find_map(|(id, place)| {
            let stands = place.fate == Fate::Standing;
            if self.frame(place.frame).places.contains(&id) != stands {
                return Some(Flaw::LostPlace(id));
            }
            let belongs = |link: &LinkId, end: fn(&Link) -> PlaceId| {
                let link = self.link(*link);
                stands && link.standing == LinkStatus::Standing && end(link) == id
            };
            let mut outgoing = place.outgoing.iter();
            let mut incoming = place.incoming.iter();
            if !outgoing.all(|link| belongs(link, |link| link.from))
                || !incoming.all(|link| belongs(link, |link| link.to))
            {
                return Some(Flaw::StrangeLink(id));
            }
            let bounded = place.position.is_bounded() && place.envelope.is_bounded();
            let held = place.envelope.encloses(place.position);
            (stands && !(bounded && held)).then_some(Flaw::BadBox(id))
        })
    }

    fn flawed_frame(&self) -> Option<Flaw> {
        let mut all = (0..).map(FrameId).zip(&self.reference.frames);
        all.find_map(|(id, frame)| {
            let sorted = frame.above.is_sorted_by(|a, b| a.to < b.to)
                && frame.below.is_sorted_by(|a, b| a < b);
            let above = frame.above.iter().all(|relation| {
                let other = self.reference.frames.get(relation.to.index());
                id < relation.to && other.is_some_and(|other| other.below.contains(&id))
            });
            let below = frame.below.iter();
            let below = below
                .copied()
                .all(|other| other < id && self.reference.relation(other, id).is_some());
            let used = !frame.places.is_empty() || !frame.is_related();
            (!(sorted && above && below && used)).then_some(Flaw::OneSided(id))
        })
    }
}

/// Graph for planning: from every place, each action along the link that most probably works now,
/// at its [cost](Diktiometry::cost). The nodes are the ids of places.
impl Graph for Diktiometry {
    fn node_count(&self) -> usize {
        self.paths.node_count()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        for (id, link) in self.paths.likely(PlaceId(node)) {
            visit(link.to.0, self.cost(id, link));
        }
    }
}

/// Cost of a move that fails, in its lengths. The failure is noticed half-way and a new plan is
/// made: some dozen moves in worlds of dozens of places.
const FAILURE: f64 = 20.0;

/// Probability below which a link counts as impossible.
const LEAST: f64 = 1e-3;

/// Distance of places whose frames are not related, m.
const UNRELATED: f64 = 1.0;
