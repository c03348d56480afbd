use alloc::vec::Vec;

use tolman_maze::Direction;

use super::evidence::Evidence;

/// What is known of one of the four ways out of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BumpWay {
    /// Nobody tried it.
    Untried,
    /// The robot bumped, and stayed.
    Closed,
    /// It leads to this place.
    To(u32),
}

/// Places and the ways between them, each of which leads back. Places can be made one, and parted
/// again as long as the change is not kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    places: Vec<Place>,
    /// Changes since the last ones that are kept.
    changes: Vec<Change>,
    /// Work of a merge; kept for its memory.
    pending: Vec<Pair>,
    /// Number of places that are not the same as an older one.
    count: usize,
}

#[derive(Clone, Copy, Debug)]
struct Place {
    ways: [BumpWay; 4],
    /// What the place looks like.
    look: u32,
    /// The place that it turned out to be; itself as long as it is no other.
    same_as: u32,
}

#[derive(Clone, Copy, Debug)]
enum Change {
    Way {
        place: u32,
        action: usize,
        was: BumpWay,
    },
    Same {
        place: u32,
    },
}

/// Two places that have to be one, and the way from both by which the merge came here.
#[derive(Clone, Copy, Debug)]
struct Pair {
    places: [u32; 2],
    back: Option<usize>,
}

impl Graph {
    /// Adds a place of which no way is known.
    pub(super) fn push(&mut self, look: u32) -> u32 {
        let id = self.places.len() as u32;
        self.places.push(Place {
            ways: [BumpWay::Untried; 4],
            look,
            same_as: id,
        });
        self.count += 1;
        id
    }

    /// Returns the place that `id` turned out to be.
    pub(super) fn place(&self, mut id: u32) -> u32 {
        while let Some(place) = self.places.get(id as usize)
            && place.same_as != id
        {
            id = place.same_as;
        }
        id
    }

    /// Returns all places that are not the same as another, oldest first.
    pub(super) fn places(&self) -> impl Iterator<Item = u32> + '_ {
        let each = self.places.iter().zip(0..);
        each.filter_map(|(place, id)| (place.same_as == id).then_some(id))
    }

    /// Returns the number of places.
    pub(super) const fn count(&self) -> usize {
        self.count
    }

    /// Returns the number of places with those that turned out to be another.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    pub(super) fn look(&self, place: u32) -> u32 {
        self.places
            .get(place as usize)
            .map_or(0, |place| place.look)
    }

    /// Returns the ways out of a place, by the index of their direction. They may lead to what
    /// turned out to be another place.
    pub(super) fn ways(&self, place: u32) -> [BumpWay; 4] {
        let place = self.places.get(place as usize);
        place.map_or([BumpWay::Untried; 4], |place| place.ways)
    }

    /// Returns what a way is and to which place it leads.
    pub(super) fn way(&self, place: u32, action: Direction) -> BumpWay {
        match self.ways(self.place(place))[action.index()] {
            BumpWay::To(id) => BumpWay::To(self.place(id)),
            way => way,
        }
    }

    /// Learns that a way is closed; `false` if it is known to lead somewhere.
    pub(super) fn close(&mut self, place: u32, action: Direction) -> bool {
        match self.way(place, action) {
            BumpWay::To(_) => return false,
            BumpWay::Closed => {}
            BumpWay::Untried => self.set(self.place(place), action.index(), BumpWay::Closed),
        }
        true
    }

    /// Forgets that a way is closed.
    pub(super) fn reopen(&mut self, place: u32, action: Direction) {
        self.set(self.place(place), action.index(), BumpWay::Untried);
    }

    /// Learns that a way leads from one place to another, and so back; `false` if that contradicts
    /// what is known.
    pub(super) fn join(&mut self, from: u32, action: Direction, to: u32) -> bool {
        for (place, action, other) in [(from, action, to), (to, action.opposite(), from)] {
            match self.way(place, action) {
                BumpWay::Closed => return false,
                BumpWay::Untried => self.set(self.place(place), action.index(), BumpWay::To(other)),
                BumpWay::To(known) => {
                    if self.merge([known, other], &Evidence::NONE).is_none() {
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Makes two places one, and all to which the same ways lead from them. Returns by how many
    /// bits what was known of both agrees; `None`, with nothing changed, if something contradicts.
    pub(super) fn merge(&mut self, places: [u32; 2], evidence: &Evidence) -> Option<f64> {
        let before = self.changes.len();
        let bits = self.merge_all(places, evidence);
        if bits.is_none() {
            self.undo(before);
        }
        bits
    }

    fn merge_all(&mut self, places: [u32; 2], evidence: &Evidence) -> Option<f64> {
        let mut bits = 0.0;
        self.pending.clear();
        self.pending.push(Pair { places, back: None });
        while let Some(Pair { places, back }) = self.pending.pop() {
            let [kept, gone] = places.map(|id| self.place(id));
            if kept == gone {
                continue;
            }
            let look = self.look(kept);
            if look != self.look(gone) {
                return None;
            }
            bits += evidence.of_look(look);
            let (ways, others) = (self.ways(kept), self.ways(gone));
            for (action, pair) in ways.into_iter().zip(others).enumerate() {
                match pair {
                    (BumpWay::Untried, _) | (_, BumpWay::Untried) => {}
                    (BumpWay::Closed, BumpWay::Closed) => bits += evidence.of_closed(action),
                    // The way by which the merge came here leads back by itself.
                    (BumpWay::To(_), BumpWay::To(_)) if back == Some(action) => {}
                    (BumpWay::To(_), BumpWay::To(_)) => bits += evidence.of_open(action),
                    (BumpWay::Closed, BumpWay::To(_)) | (BumpWay::To(_), BumpWay::Closed) => {
                        return None;
                    }
                }
            }
            self.unite(kept, gone);
        }
        Some(bits)
    }

    /// Makes `gone` the same as `kept`, and waits for the places behind both.
    fn unite(&mut self, kept: u32, gone: u32) {
        let (ways, others) = (self.ways(kept), self.ways(gone));
        if let Some(place) = self.places.get_mut(gone as usize) {
            place.same_as = kept;
            self.count -= 1;
            self.changes.push(Change::Same { place: gone });
        }
        for (action, pair) in ways.into_iter().zip(others).enumerate() {
            match pair {
                (BumpWay::Untried, way) if way != BumpWay::Untried => self.set(kept, action, way),
                (BumpWay::To(one), BumpWay::To(other)) => self.pending.push(Pair {
                    places: [one, other],
                    back: Some((action + 2) % 4),
                }),
                _ => {}
            }
        }
    }

    fn set(&mut self, place: u32, action: usize, way: BumpWay) {
        if let Some(known) = self.places.get_mut(place as usize)
            && let Some(known) = known.ways.get_mut(action)
        {
            let was = core::mem::replace(known, way);
            self.changes.push(Change::Way { place, action, was });
        }
    }

    /// Undoes the changes since there were `before` of them.
    pub(super) fn undo(&mut self, before: usize) {
        while self.changes.len() > before {
            match self.changes.pop() {
                Some(Change::Way { place, action, was }) => {
                    if let Some(known) = self.places.get_mut(place as usize)
                        && let Some(known) = known.ways.get_mut(action)
                    {
                        *known = was;
                    }
                }
                Some(Change::Same { place: id }) => {
                    if let Some(place) = self.places.get_mut(id as usize) {
                        place.same_as = id;
                        self.count += 1;
                    }
                }
                None => return,
            }
        }
    }

    /// Keeps all changes.
    pub(super) fn keep(&mut self) {
        self.changes.clear();
    }

    /// Shortens the ways to what places turned out to be. O(places).
    pub(super) fn shorten(&mut self) {
        for id in 0..self.places.len() as u32 {
            let same_as = self.place(id);
            let ways = self.ways(id).map(|way| match way {
                BumpWay::To(to) => BumpWay::To(self.place(to)),
                way => way,
            });
            if let Some(place) = self.places.get_mut(id as usize) {
                (place.same_as, place.ways) = (same_as, ways);
            }
        }
    }
}
