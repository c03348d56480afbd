use tolman_maze::Cell;

use super::rival::Rival;
use super::stops::Stops;

/// The explorer's own stop, and up to `K` − 1 stops that are compared with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rivals<const K: usize> {
    pub(super) own: Cell,
    rivals: [Option<Rival>; K],
}

impl<const K: usize> Rivals<K> {
    /// Takes the best of some stops for the explorer's own, and the others for its rivals. Returns
    /// `None` without a stop.
    pub(super) fn of(stops: &Stops<K>) -> Option<Self> {
        let mut rivals = [None; K];
        for (slot, stop) in rivals.iter_mut().zip(stops.iter().skip(1)) {
            *slot = Some(Rival::new(stop));
        }
        let own = stops.best()?;
        Some(Self { own, rivals })
    }

    /// Returns whether all rivals were given up.
    pub(super) fn is_empty(&self) -> bool {
        self.rivals.iter().flatten().next().is_none()
    }

    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Rival> {
        self.rivals.iter_mut().flatten()
    }

    /// Gives up the rivals that are on average no better than the own stop.
    pub(super) fn give_up_worse(&mut self) {
        for slot in &mut self.rivals {
            *slot = slot.filter(|rival| rival.sum < 0.0);
        }
    }

    /// Returns the rival that is better than the own stop by most, after `confidence` standard
    /// errors are taken off. Returns `None` if none is better.
    pub(super) fn best(&self, confidence: f32) -> Option<Rival> {
        let rivals = self.rivals.iter().flatten();
        let better = rivals
            .map(|rival| (rival.at_worst(confidence), *rival))
            .filter(|(at_worst, _)| *at_worst < 0.0);
        // Of equals the first.
        let best = better.reduce(|best, next| if next.0 < best.0 { next } else { best });
        best.map(|(_, rival)| rival)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELLS: [Cell; 3] = [Cell::new(0, 0), Cell::new(1, 0), Cell::new(2, 0)];

    /// Returns the rivals of the first of the [`CELLS`]. Each costs as much more in four mazes.
    fn rivals(more: [f32; 2]) -> Rivals<3> {
        let mut stops = Stops::new();
        for (cell, score) in CELLS.into_iter().zip([3.0, 2.0, 1.0]) {
            stops.offer(score, cell);
        }
        let mut rivals = Rivals::of(&stops).unwrap();
        for (rival, more) in rivals.iter_mut().zip(more) {
            (0..4).for_each(|_| rival.add(more));
        }
        rivals
    }

    #[test]
    fn the_best_rival_is_the_one_that_saves_most() {
        let stop = |rivals: Rivals<3>| rivals.best(1.0).map(|rival| rival.stop);
        assert_eq!(rivals([-1.0, -2.0]).own, CELLS[0]);
        assert_eq!(stop(rivals([-1.0, -2.0])), Some(CELLS[2]));
        assert_eq!(stop(rivals([-1.0, -1.0])), Some(CELLS[1]));
        assert_eq!(stop(rivals([1.0, 0.0])), None);
        assert!(Rivals::<3>::of(&Stops::new()).is_none());
    }

    #[test]
    fn rivals_that_save_nothing_are_given_up() {
        let mut some = rivals([1.0, -2.0]);
        some.give_up_worse();
        assert_eq!(some.iter_mut().count(), 1);
        let mut none = rivals([1.0, 0.0]);
        assert!(!none.is_empty());
        none.give_up_worse();
        assert!(none.is_empty());
    }
}
