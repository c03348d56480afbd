use alloc::collections::{BTreeMap, VecDeque};
use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::PointBox;

use super::JournalSpan;
use super::identities::Joined;

/// The journal's knowledge of positions, as constraints on differences. A constraint bounds, along
/// one axis, how far one place lies beyond another. The tightest of each pair is kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Constraints {
    /// Tightest bounds from class to class of places.
    tightest: BTreeMap<usize, BTreeMap<usize, [Most; 2]>>,
    /// Whether the constraints were found to contradict each other, which later ones cannot undo.
    contradict: bool,
}

/// Upper bound of the distance by which one place lies beyond another along an axis, m.
#[derive(Clone, Copy, Debug)]
struct Most {
    by: f64,
    span: JournalSpan,
}

impl Constraints {
    /// Takes in the position of the end of a span relative to its beginning, m.
    pub(super) fn add(&mut self, ends: [usize; 2], span: JournalSpan, displacement: PointBox) {
        let [begin, end] = ends;
        let PointBox { x, y } = displacement;
        self.tighten(begin, end, [x.high(), y.high()].map(|by| Most { by, span }));
        let span = span.reversed();
        self.tighten(end, begin, [-x.low(), -y.low()].map(|by| Most { by, span }));
    }

    fn tighten(&mut self, from: usize, to: usize, new: [Most; 2]) {
        let known = self
            .tightest
            .entry(from)
            .or_default()
            .entry(to)
            .or_insert(new);
        for (known, new) in known.iter_mut().zip(new) {
            if new.by < known.by {
                *known = new;
            }
        }
    }

    /// Merges the constraints of two classes that have become one.
    pub(super) fn join(&mut self, Joined { kept, lost }: Joined) {
        let others = self.tightest.remove(&lost).unwrap_or_default();
        for (other, forth) in others {
            let back = self
                .tightest
                .get_mut(&other)
                .and_then(|there| there.remove(&lost));
            if other == kept {
                continue;
            }
            self.tighten(kept, other, forth);
            if let Some(back) = back {
                self.tighten(other, kept, back);
            }
        }
    }

    /// Returns the routes that bound the position of `to` relative to `from` on each of the four
    /// sides, without duplicates. Empty if the two are not connected, or if the constraints
    /// contradict each other. Bellman's and Ford's algorithm. O(places · pairs of neighbours).
    pub(super) fn routes(&mut self, from: usize, to: usize) -> Vec<Vec<JournalSpan>> {
        let mut routes = Vec::new();
        for axis in 0..2 {
            routes.extend(self.tightest_route(axis, from, to));
            let back = self.tightest_route(axis, to, from);
            if self.contradict {
                return Vec::new();
            }
            routes.extend(
                back.map(|back| back.into_iter().rev().map(JournalSpan::reversed).collect()),
            );
        }
        let mut seen: Vec<Vec<JournalSpan>> = Vec::new();
        for route in routes {
            if !seen.contains(&route) {
                seen.push(route);
            }
        }
        seen
    }

    fn tightest_route(&mut self, axis: usize, from: usize, to: usize) -> Option<Vec<JournalSpan>> {
        if self.contradict {
            return None;
        }
        let size = 1 + *self.tightest.keys().next_back()?;
        let mut least = vec![f64::INFINITY; size.max(from + 1)];
        let mut came: Vec<Option<(usize, JournalSpan)>> = vec![None; least.len()];
        let mut is_waiting = vec![false; least.len()];
        let mut rounds = vec![0_usize; least.len()];
        least[from] = 0.0;
        let mut waiting = VecDeque::from([from]);
        while let Some(here) = waiting.pop_front() {
            is_waiting[here] = false;
            rounds[here] += 1;
            if rounds[here] > self.tightest.len() {
                // A circle that is shorter than nothing: some bound does not hold.
                self.contradict = true;
                return None;
            }
            for (next, most) in self.tightest.get(&here).into_iter().flatten() {
                let Most { by, span } = most[axis];
                if least[here] + by < least[*next] {
                    least[*next] = least[here] + by;
                    came[*next] = Some((here, span));
                    if !core::mem::replace(&mut is_waiting[*next], true) {
                        waiting.push_back(*next);
                    }
                }
            }
        }
        let mut route = Vec::new();
        let mut here = to;
        while here != from {
            let (before, span) = (*came.get(here)?)?;
            route.push(span);
            here = before;
        }
        route.reverse();
        Some(route)
    }
}
