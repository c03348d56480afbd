use alloc::vec::Vec;

use super::graph::{BumpWay, Graph};

/// By how many bits it is surprising that two places agree, if they were not the same: −log₂ of how
/// often a way is closed, or open, or a place has a look.
#[derive(Clone, Debug)]
pub(super) struct Evidence {
    closed: [f64; 4],
    open: [f64; 4],
    /// By look, sorted.
    looks: Vec<(u32, f64)>,
}

impl Evidence {
    /// Counts nothing.
    pub(super) const NONE: Self = Self {
        closed: [0.0; 4],
        open: [0.0; 4],
        looks: Vec::new(),
    };

    /// Counts the ways and looks of all places. O(places · log looks).
    pub(super) fn of(graph: &Graph) -> Self {
        // One of each beforehand: what was never seen is not impossible.
        let mut counts = [[1_u32; 2]; 4];
        let mut looks: Vec<u32> = Vec::new();
        for place in graph.places() {
            looks.push(graph.look(place));
            for (count, way) in counts.iter_mut().zip(graph.ways(place)) {
                match way {
                    BumpWay::Untried => {}
                    BumpWay::Closed => count[0] += 1,
                    BumpWay::To(_) => count[1] += 1,
                }
            }
        }
        looks.sort_unstable();
        let all = looks.len();
        let shares = looks.chunk_by(|one, other| one == other);
        let looks = shares.filter_map(|alike| Some((*alike.first()?, bits(alike.len(), all))));
        let bits_of = |which: usize| {
            counts.map(|count| bits(count[which] as usize, (count[0] + count[1]) as usize))
        };
        Self {
            closed: bits_of(0),
            open: bits_of(1),
            looks: looks.collect(),
        }
    }

    pub(super) fn of_closed(&self, action: usize) -> f64 {
        self.closed.get(action).copied().unwrap_or(0.0)
    }

    pub(super) fn of_open(&self, action: usize) -> f64 {
        self.open.get(action).copied().unwrap_or(0.0)
    }

    pub(super) fn of_look(&self, look: u32) -> f64 {
        let found = self.looks.binary_search_by_key(&look, |(look, _)| *look);
        found
            .ok()
            .and_then(|at| self.looks.get(at))
            .map_or(0.0, |(_, bits)| *bits)
    }
}

/// Returns −log₂ of a share.
fn bits(part: usize, whole: usize) -> f64 {
    libm::log2(whole as f64 / part as f64)
}
