//! Learns about looks from new places, and notes places that look alike. Beyond the paper.

use alloc::vec::Vec;

use super::{
    Config, Diktiometry, Fate, Ground, Hints, Observer, PlaceId, Signature, Similarity, Use,
    learn_of_two, search, wanted_anywhere,
};

impl Observer {
    /// Learns from a new place: which places around it are certainly different, and whether they
    /// look like it.
    ///
    /// Amortized cost: one search per place if looks are used. The notes are weighed again once
    /// fewer agreeing looks suffice.
    pub(super) fn learn_looks(&mut self, place: PlaceId, view: &Signature, hints: &mut Hints) {
        if self.config.restructuring.look_merge == Use::Off {
            return;
        }
        let alike = self.views.alike(view, &self.config, &self.map.paths);
        let apart = apart(&self.map, place, &self.config);
        for &other in &apart {
            let look = match alike.binary_search(&other) {
                Ok(_) => Similarity::Alike,
                Err(_) => Similarity::Unlike,
            };
            learn_of_two(&mut self.map, [place, other], look, &self.config);
        }
        if alike.is_empty() {
            self.map.looks.kinds = self.map.looks.kinds.saturating_add(1);
        }
        let Some(wanted) = wanted_anywhere(&self.map, &self.config) else {
            return;
        };
        // Places that came while looks told nothing, and this one.
        while self.map.looks.noted < self.map.paths.places.len() {
            let id = PlaceId(self.map.looks.noted as u32);
            self.map.looks.noted += 1;
            if id == place {
                self.note_alike(place, &alike, &apart);
            } else if self.map.place(id).fate == Fate::Standing {
                self.note_all_alike(id);
            }
        }
        // Looks tell more than ever, of places where the robot may never come again, too.
        let least = &mut self.map.looks.least_wanted;
        if least.is_none_or(|least| wanted.kinds < least.kinds || wanted.places < least.places) {
            *least = Some(wanted);
            let places = self.map.paths.places();
            let waiting = places.filter(|(_, place)| !place.notes.is_empty());
            hints.near.extend(waiting.map(|(id, _)| id));
        }
    }

    fn note_all_alike(&mut self, place: PlaceId) {
        let Some(view) = self.map.place(place).views.first() else {
            return;
        };
        let alike = self.views.alike(view, &self.config, &self.map.paths);
        if alike.len() > 1 {
            let apart = apart(&self.map, place, &self.config);
            self.note_alike(place, &alike, &apart);
        }
    }

    /// Notes the places that look like a place, except those that are certainly different.
    fn note_alike(&mut self, place: PlaceId, alike: &[PlaceId], apart: &[PlaceId]) {
        for &other in alike {
            if other != place && apart.binary_search(&other).is_err() {
                self.map.paths.note(place, other, Ground::Look);
            }
        }
    }
}

/// Returns the places near a place that are certainly different from it, by id.
fn apart(map: &Diktiometry, place: PlaceId, config: &Config) -> Vec<PlaceId> {
    let here = map.place(place);
    let reached = search(&map.reference, here.frame, &config.search);
    let all = reached.iter().flat_map(|around| {
        let places = &map.frame(around.frame).places;
        places.iter().map(|other| (*other, around.position))
    });
    let excluded = all.filter(|(other, frame)| {
        let there = *frame + map.place(*other).position;
        *other != place && !there.meets(here.position)
    });
    let mut apart: Vec<PlaceId> = excluded.map(|(other, _)| other).collect();
    apart.sort_unstable();
    apart
}
