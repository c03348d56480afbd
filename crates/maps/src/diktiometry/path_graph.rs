//! The path graph: "nodes represent places, and arcs represent action transitions".

use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};
use tolman_planners::Graph;

use super::{
    Action, Constancy, Counts, Exits, FrameId, LinkId, PlaceId, PlanStep, Signature, TrackEntry,
};

/// A place, with its reference link: its position in its canonical frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Whether the place is still part of the map.
    pub fate: Fate,
    /// Frame in which the place's position is given.
    pub frame: FrameId,
    /// Bounds of the place's position in its frame, m.
    pub position: PointBox,
    /// The *nominal envelope*: the least box that holds all estimates of its position so far, m.
    pub envelope: PointBox,
    /// Weighted estimates of the place's position, m.
    pub estims: Vec<Estim>,
    /// Views of the place.
    pub views: Vec<Signature>,
    /// Links that leave the place, by id.
    pub outgoing: Vec<LinkId>,
    /// Links that lead to the place, by id.
    pub incoming: Vec<LinkId>,
    /// Actions that led nowhere when they were last tried here.
    pub blocked: Vec<Action>,
    /// Actions that seemed possible at the robot's last visit.
    pub exits: Exits,
    /// Number of times that the robot was believed to be here.
    pub visits: u32,
    /// Number of times that the robot was expected here, and number of times that it came.
    pub counts: Counts,
    /// Whether the place was there when it was last expected, and how often that changed.
    pub constancy: Constancy,
    /// Histories of tracks left here, the oldest first.
    pub histories: Vec<Vec<TrackEntry>>,
    /// Delayed gratification: decisions postponed until more is known.
    pub notes: Vec<MergeNote>,
}

impl Place {
    fn new(frame: FrameId, position: PointBox) -> Self {
        Self {
            fate: Fate::Standing,
            frame,
            position,
            envelope: position,
            estims: Vec::new(),
            views: Vec::new(),
            outgoing: Vec::new(),
            incoming: Vec::new(),
            blocked: Vec::new(),
            exits: Exits::Unknown,
            visits: 0,
            counts: Counts::default(),
            constancy: Constancy::default(),
            histories: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Returns whether an action was possible here at the robot's last visit, by its view and by
    /// the outcome.
    #[must_use]
    pub fn is_open(&self, action: Action) -> bool {
        self.exits.allow(action) && !self.blocked.contains(&action)
    }

    /// Returns the links that lead to the place, then those that leave it.
    pub(super) fn links(&self) -> Vec<LinkId> {
        [self.incoming.as_slice(), &self.outgoing].concat()
    }
}

/// State of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// The place is part of the map.
    Standing,
    /// The place turned out to be the same as another, made earlier.
    MergedInto(PlaceId),
    /// The place turned out not to exist.
    Elided,
}

/// "A weighted point-estimate of the place's position (in its canonical reference frame)."
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estim {
    /// Position in the place's canonical frame, m.
    pub position: Point,
    /// Number of estimates merged into this one.
    pub weight: f64,
}

impl Estim {
    /// Returns the estimate in a frame whose origin lies at `-shift`, m.
    pub(super) fn shifted(self, shift: Point) -> Self {
        Self {
            position: self.position + shift.coords,
            ..self
        }
    }
}

/// "A note is made of the operation to be performed": a merge that waits for a narrower box or for
/// more looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MergeNote {
    /// Place that may be the same as the place with the note.
    pub other: PlaceId,
    /// Reason for the suspicion.
    pub ground: Ground,
}

/// Reason why two places may be one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// The boxes of the two places overlap.
    Position,
    /// The places look alike, however far apart.
    Look,
}

/// An action link: the action led from one place to another. Several links may have the same
/// action.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Place where the link begins.
    pub from: PlaceId,
    /// Action that leads along the link.
    pub action: Action,
    /// Place to which the link leads.
    pub to: PlaceId,
    /// Number of times that the robot is believed to have gone along the link.
    pub traversed: u32,
    /// Number of times that the robot was expected to go along it, and number of times that it did.
    pub counts: Counts,
    /// Whether the link worked when it was last expected to, and how often that changed.
    pub constancy: Constancy,
    /// Links taken after this one, with counts.
    pub then: Vec<Successor>,
    /// Whether the link is still part of the map.
    pub standing: LinkStatus,
}

impl Link {
    pub(super) const fn step(&self) -> PlanStep {
        PlanStep {
            action: self.action,
            to: self.to,
        }
    }

    /// Counts that another link was taken after this one.
    pub(super) fn follow(&mut self, next: Successor) {
        match self.then.iter_mut().find(|one| one.link == next.link) {
            Some(one) => one.count = one.count.saturating_add(next.count),
            None => self.then.push(next),
        }
    }
}

/// Count of how often a link was followed by another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Successor {
    /// The link taken next.
    pub link: LinkId,
    /// Number of times that the link was taken next.
    pub count: u32,
}

/// Whether a link is still part of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkStatus {
    /// The link is part of the map.
    Standing,
    /// The link was removed.
    Removed,
}

/// Places and the actions between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathGraph {
    pub(super) places: Vec<Place>,
    pub(super) links: Vec<Link>,
    /// Number of standing places.
    standing: usize,
    /// Number of moves so far.
    pub(super) now: u64,
}

impl PathGraph {
    /// Returns the place of an id, whether it still stands or not, or `None` for ids never given.
    #[must_use]
    pub fn place(&self, id: PlaceId) -> Option<&Place> {
        self.places.get(id.index())
    }

    /// Returns the link of an id, whether it still stands or not, or `None` for ids never given.
    #[must_use]
    pub fn link(&self, id: LinkId) -> Option<&Link> {
        self.links.get(id.index())
    }

    /// Returns the standing places, by id.
    pub fn places(&self) -> impl Iterator<Item = (PlaceId, &Place)> {
        let all = (0..).map(PlaceId).zip(&self.places);
        all.filter(|(_, place)| place.fate == Fate::Standing)
    }

    /// Returns the standing links, by id.
    pub fn links(&self) -> impl Iterator<Item = (LinkId, &Link)> {
        let all = (0..).map(LinkId).zip(&self.links);
        all.filter(|(_, link)| link.standing == LinkStatus::Standing)
    }

    /// Returns the present id of a place, after all merges; `None` if it was elided or never
    /// existed.
    #[must_use]
    pub fn resolve(&self, mut id: PlaceId) -> Option<PlaceId> {
        loop {
            match self.place(id)?.fate {
                Fate::Standing => return Some(id),
                Fate::MergedInto(other) => id = other,
                Fate::Elided => return None,
            }
        }
    }

    /// Returns the links that leave a place, by id.
    pub fn outgoing(&self, place: PlaceId) -> impl Iterator<Item = (LinkId, &Link)> {
        let ids = self.place(place).map_or(&[][..], |place| &place.outgoing);
        ids.iter().map(|&id| (id, &self.links[id.index()]))
    }

    /// Returns the links that lead to a place, by id.
    pub fn incoming(&self, place: PlaceId) -> impl Iterator<Item = (LinkId, &Link)> {
        let ids = self.place(place).map_or(&[][..], |place| &place.incoming);
        ids.iter().map(|&id| (id, &self.links[id.index()]))
    }

    /// Returns the links by which an action has led from a place so far, by id.
    pub fn along(&self, place: PlaceId, action: Action) -> impl Iterator<Item = (LinkId, &Link)> {
        self.outgoing(place)
            .filter(move |(_, link)| link.action == action)
    }

    /// Returns the link that an action took most often from a place. Recent moves weigh more; of
    /// equals the older link.
    #[must_use]
    pub fn likeliest(&self, place: PlaceId, action: Action) -> Option<LinkId> {
        let best = self.along(place, action).max_by(|(a, one), (b, other)| {
            let met = one.counts.met().total_cmp(&other.counts.met());
            met.then(b.cmp(a))
        });
        best.map(|(id, _)| id)
    }

    /// Returns the link of an action between two places, or `None` if there is none.
    #[must_use]
    pub fn between(&self, from: PlaceId, action: Action, to: PlaceId) -> Option<LinkId> {
        let mut along = self.along(from, action);
        along.find(|(_, link)| link.to == to).map(|(id, _)| id)
    }

    /// Returns the links that a plan may follow from a place: for each action that is open there,
    /// the likeliest.
    pub fn ways(&self, place: PlaceId) -> impl Iterator<Item = (LinkId, &Link)> {
        self.outgoing(place).filter(move |(id, link)| {
            let here = &self.places[place.index()];
            here.is_open(link.action) && self.likeliest(place, link.action) == Some(*id)
        })
    }

    /// Returns the probability that a link still works. It is the smaller of the constancies of the
    /// link and of the place at its end. 0 for unknown ids.
    #[must_use]
    pub fn chance(&self, id: LinkId) -> f64 {
        let Some(link) = self.link(id) else {
            return 0.0;
        };
        let there = self.places[link.to.index()].constancy.chance(self.now);
        link.constancy.chance(self.now).min(there)
    }

    /// Returns, for each action at a place, the link that most probably works now. Of equals it is
    /// the one met more often lately, then the older one.
    pub fn likely(&self, place: PlaceId) -> impl Iterator<Item = (LinkId, &Link)> {
        self.outgoing(place).filter(move |(id, link)| {
            let along = self.along(place, link.action);
            let best = along.max_by(|(a, one), (b, other)| {
                let chance = self.chance(*a).total_cmp(&self.chance(*b));
                let met = one.counts.met().total_cmp(&other.counts.met());
                chance.then(met).then(b.cmp(a))
            });
            best.is_some_and(|(best, _)| best == *id)
        })
    }

    pub(super) fn add_place(&mut self, frame: FrameId, position: PointBox) -> PlaceId {
        let id = PlaceId(self.places.len() as u32);
        self.places.push(Place::new(frame, position));
        self.standing += 1;
        id
    }

    /// Removes a standing place from the graph and returns its contents. The entry left behind
    /// keeps only frame and position.
    pub(super) fn bury(&mut self, id: PlaceId, fate: Fate) -> Place {
        self.standing -= 1;
        let place = &mut self.places[id.index()];
        let grave = Place {
            fate,
            ..Place::new(place.frame, place.position)
        };
        core::mem::replace(place, grave)
    }

    /// Notes at both places that they may be one.
    pub(super) fn note(&mut self, a: PlaceId, b: PlaceId, ground: Ground) {
        for (at, other) in [(a, b), (b, a)] {
            let notes = &mut self.places[at.index()].notes;
            match notes.iter_mut().find(|note| note.other == other) {
                // Nearness is asked for more often than looks are.
                Some(note) if ground == Ground::Position => note.ground = ground,
                Some(_) => {}
                None => notes.push(MergeNote { other, ground }),
            }
        }
    }

    /// Returns the number of places that were not merged away.
    pub(super) const fn standing(&self) -> usize {
        self.standing
    }

    /// Returns the link for an action between two places, which is created if it does not exist.
    pub(super) fn link_to(&mut self, from: PlaceId, action: Action, to: PlaceId) -> LinkId {
        if let Some(known) = self.between(from, action, to) {
            return known;
        }
        let id = LinkId(self.links.len() as u32);
        self.links.push(Link {
            from,
            action,
            to,
            traversed: 0,
            counts: Counts::default(),
            constancy: Constancy::default(),
            then: Vec::new(),
            standing: LinkStatus::Standing,
        });
        self.places[from.index()].outgoing.push(id);
        self.places[to.index()].incoming.push(id);
        id
    }

    /// Removes a link from the graph.
    pub(super) fn remove_link(&mut self, id: LinkId) {
        let link = &mut self.links[id.index()];
        link.standing = LinkStatus::Removed;
        link.then.clear();
        let (from, to) = (link.from, link.to);
        self.places[from.index()].outgoing.retain(|&out| out != id);
        self.places[to.index()].incoming.retain(|&into| into != id);
    }
}

/// Each action at a place along the link that most probably works now, all at the same cost. The
/// nodes are the ids of places.
impl Graph for PathGraph {
    fn node_count(&self) -> usize {
        self.places.len()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        for (_, link) in self.likely(PlaceId(node)) {
            visit(link.to.0, 1);
        }
    }
}
