use alloc::vec::Vec;

use tolman_geom::PointBox;

use super::config::SearchLimits;
use super::ids::{FrameId, LinkId, PlaceId};
use super::looks::Looks;
use super::path_graph::{Fate, PathGraph, Standing};
use super::reference_graph::{ReferenceGraph, search};

/// "A diktiometric representation (a *diktiometry*) consists of two graphs, a path graph and a reference graph …
/// connected by reference links, giving the positions of places with respect to particular local reference frames."
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diktiometry {
    /// Places and actions.
    pub paths: PathGraph,
    /// Frames and what is known of where they lie.
    pub reference: ReferenceGraph,
    /// How well looks tell places apart.
    pub looks: Looks,
}

/// Where a place is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    /// The place.
    pub place: PlaceId,
    /// What is known of its position, m: it is drawn in the middle.
    pub bounds: PointBox,
}

/// What the two graphs promise and do not keep. [`Diktiometry::check`] finds none, whatever the robot tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Flaw {
    /// A link that stands is not in the list of a place at its end, or that place is gone.
    LooseLink(LinkId),
    /// Two links bear the same action between the same places.
    DoubleLink(LinkId),
    /// A place lists a link that is removed or does not belong to it.
    StrangeLink(PlaceId),
    /// A place is not listed by its frame, or listed where it is not.
    LostPlace(PlaceId),
    /// A position or an envelope is unbounded, or the envelope does not hold the position.
    BadBox(PlaceId),
    /// A relation is not known from both sides alike, or not sorted.
    OneSided(FrameId),
    /// An action beyond those of the configuration.
    StrangeAction(LinkId),
}

impl Diktiometry {
    /// Where `to` lies as seen from `from`, from the relations within `limits`; none where they do not reach. m.
    #[must_use]
    pub fn displacement(
        &self,
        from: PlaceId,
        to: PlaceId,
        limits: &SearchLimits,
    ) -> Option<PointBox> {
        let start = self.paths.place(self.paths.resolve(from)?)?;
        let end = self.paths.place(self.paths.resolve(to)?)?;
        if start.frame == end.frame {
            return Some(end.position - start.position);
        }
        let reached = search(&self.reference, start.frame, limits);
        let there = reached.iter().find(|reached| reached.frame == end.frame)?;
        Some(there.position + end.position - start.position)
    }

    /// Where `to` lies as seen from `from` by the relation between their frames alone, m; none if they are not related.
    pub(super) fn related(&self, from: PlaceId, to: PlaceId) -> Option<PointBox> {
        let [start, end] = [from, to].map(|place| &self.paths.places[place.index()]);
        let frames = self.reference.known(start.frame, end.frame)?;
        Some(frames + end.position - start.position)
    }

    /// All places that can be reached from `origin` in the reference graph, where they are for the eye: as seen from
    /// `origin`, which is at (0, 0). By id. O(frames · degree · log frames + places · log places).
    #[must_use]
    pub fn layout(&self, origin: PlaceId) -> Vec<Drawn> {
        let Some(start) = self
            .paths
            .resolve(origin)
            .and_then(|origin| self.paths.place(origin))
        else {
            return Vec::new();
        };
        let everything = SearchLimits {
            width: f64::INFINITY,
            frames: usize::MAX,
            depth: u32::MAX,
        };
        let mut drawn: Vec<Drawn> = search(&self.reference, start.frame, &everything)
            .into_iter()
            .flat_map(|reached| {
                let places = &self.reference.frames[reached.frame.index()].places;
                places.iter().map(move |&place| {
                    let position = self.paths.places[place.index()].position;
                    Drawn {
                        place,
                        bounds: reached.position + position - start.position,
                    }
                })
            })
            .collect();
        drawn.sort_by_key(|drawn| drawn.place);
        drawn
    }

    /// Opens a frame with a place at its origin, or adds the place to a frame.
    pub(super) fn new_place(&mut self, site: Site) -> PlaceId {
        match site {
            Site::InFrame { frame, position } => {
                let place = self.paths.add_place(frame, position);
                self.reference.frames[frame.index()].places.push(place);
                place
            }
            Site::OwnFrame => {
                let frame = self.reference.add_frame();
                let place = self.paths.add_place(frame, PointBox::ORIGIN);
                self.reference.frames[frame.index()].places.push(place);
                place
            }
        }
    }

    /// What the two graphs promise and do not keep; none if all is well. O(places + links · degree + relations · log degree).
    #[must_use]
    pub fn check(&self, actions: usize) -> Option<Flaw> {
        self.flawed_link(actions)
            .or_else(|| self.flawed_place())
            .or_else(|| self.flawed_frame())
    }

    fn flawed_link(&self, actions: usize) -> Option<Flaw> {
        self.paths.links().find_map(|(id, link)| {
            let ends = [link.from, link.to].map(|end| &self.paths.places[end.index()]);
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
        let all = (0..).map(PlaceId).zip(&self.paths.places);
        all.into_iter().find_map(|(id, place)| {
            let frame = &self.reference.frames[place.frame.index()];
            let stands = place.fate == Fate::Standing;
            if frame.places.contains(&id) != stands {
                return Some(Flaw::LostPlace(id));
            }
            let link = |id: &LinkId| &self.paths.links[id.index()];
            let leaves = |out: &LinkId| {
                link(out).standing == Standing::Standing && link(out).from == id && stands
            };
            let leads = |into: &LinkId| {
                link(into).standing == Standing::Standing && link(into).to == id && stands
            };
            if !place.outgoing.iter().all(leaves) || !place.incoming.iter().all(leads) {
                return Some(Flaw::StrangeLink(id));
            }
            let bounded = place.position.is_bounded() && place.envelope.is_bounded();
            let held = place.envelope.encloses(place.position);
            (stands && !(bounded && held)).then_some(Flaw::BadBox(id))
        })
    }

    fn flawed_frame(&self) -> Option<Flaw> {
        let all = (0..).map(FrameId).zip(&self.reference.frames);
        all.into_iter().find_map(|(id, frame)| {
            let sorted = frame.relations.is_sorted_by(|a, b| a.to < b.to);
            let mutual = frame.relations.iter().all(|relation| {
                let back = self.reference.relation(relation.to, id);
                back.is_some_and(|back| {
                    back.position == -relation.position && back.envelope == -relation.envelope
                })
            });
            let used = !frame.places.is_empty() || frame.relations.is_empty();
            (!(sorted && mutual && used)).then_some(Flaw::OneSided(id))
        })
    }
}

/// Where a new place is put.
#[derive(Clone, Copy, Debug)]
pub(super) enum Site {
    /// Into a frame that there is.
    InFrame { frame: FrameId, position: PointBox },
    /// At the origin of a frame of its own.
    OwnFrame,
}
