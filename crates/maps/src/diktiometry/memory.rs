use super::{Diktiometry, Frame, Link, Place, Signature};

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
    let histories = place.histories.iter();
    size_of_val(place)
        + size_of_val(place.estims.as_slice())
        + place.views.iter().map(of_view).sum::<usize>()
        + size_of_val(place.outgoing.as_slice())
        + size_of_val(place.incoming.as_slice())
        + size_of_val(place.blocked.as_slice())
        + histories
            .map(|one| size_of_val(one.as_slice()))
            .sum::<usize>()
        + size_of_val(place.notes.as_slice())
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
        + size_of_val(frame.relations.as_slice())
}
