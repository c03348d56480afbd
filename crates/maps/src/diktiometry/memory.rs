use alloc::vec::Vec;

use super::{Diktiometry, Exits, Frame, Link, Place, Signature, TrackEntry};

impl Diktiometry {
    /// Returns the memory of the present places, links and frames, bytes, without the grids of
    /// traversals. O(places + links + frames).
    #[must_use]
    pub fn bytes(&self) -> usize {
        let frames = self.reference.frames().iter();
        let standing = frames.filter(|frame| !frame.places.is_empty());
        let places = self.paths.places().map(|(_, place)| of_place(place));
        let links = self.paths.links().map(|(_, link)| of_link(link));
        places.sum::<usize>() + links.sum::<usize>() + standing.map(of_frame).sum::<usize>()
    }
}

fn of_place(place: &Place) -> usize {
    size_of_val(place)
        + size_of_val(place.estims.as_slice())
        + place.views.iter().map(of_view).sum::<usize>()
        + size_of_val(place.outgoing.as_slice())
        + size_of_val(place.incoming.as_slice())
        + size_of_val(place.blocked.as_slice())
        + of_exits(&place.exits)
        + place.histories.iter().map(of_history).sum::<usize>()
        + size_of_val(place.notes.as_slice())
}

fn of_history(history: &Vec<TrackEntry>) -> usize {
    let doubts = history.iter();
    let doubts = doubts.map(|entry| size_of_val(entry.doubts.as_slice()));
    size_of_val(history) + size_of_val(history.as_slice()) + doubts.sum::<usize>()
}

fn of_exits(exits: &Exits) -> usize {
    match exits {
        Exits::Unknown => 0,
        Exits::Seen(actions) => size_of_val(actions.as_slice()),
    }
}

fn of_view(view: &Signature) -> usize {
    size_of_val(view) + view.columns() * view.rows() * size_of::<f64>()
}

fn of_link(link: &Link) -> usize {
    size_of_val(link) + size_of_val(link.then.as_slice())
}

fn of_frame(frame: &Frame) -> usize {
    size_of_val(frame)
        + size_of_val(frame.places.as_slice())
        + size_of_val(frame.above.as_slice())
        + size_of_val(frame.below.as_slice())
}
