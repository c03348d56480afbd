use alloc::vec;
use alloc::vec::Vec;

use tolman_planners::{Graph, steps_from};

/// Returns the number of arcs of the shortest walk from `start` through all that can be reached,
/// ending anywhere. It is the baseline of an exploration, with perfect knowledge. `None` if more
/// than 16 places have an odd number of ports, as that would take too long.
///
/// The open Chinese postman's walk: odd places are joined in pairs by shortest ways, walked twice,
/// except for one, where the walk ends. O(2ⁿ · n) in the number n of odd places.
#[must_use]
pub fn covering_walk(graph: &impl Graph, start: u32) -> Option<u32> {
    let from_start = steps_from(graph, [start]);
    let reached = |place: u32| from_start[place as usize].is_some();
    let numbers = 0..graph.node_count() as u32;
    let mut odd: Vec<u32> = Vec::new();
    let mut ends = 0;
    for place in numbers.filter(|place| reached(*place)) {
        let mut degree = 0_u32;
        graph.for_each_arc(place, |_, _| degree += 1);
        ends += degree;
        if (degree % 2 == 1) != (place == start) {
            odd.push(place);
        }
    }
    if odd.len() > 16 {
        return None;
    }
    let steps: Vec<Vec<Option<u32>>> = odd
        .iter()
        .map(|place| steps_from(graph, [*place]))
        .collect();
    // The least sum of ways for each set of odd places that are done with.
    let mut least = vec![u32::MAX; 1 << odd.len()];
    least[0] = 0;
    let mut repeated = u32::MAX;
    for done in 0..least.len() {
        let sum = least[done];
        if sum == u32::MAX {
            continue;
        }
        let mut left = (0..odd.len()).filter(|place| done >> place & 1 == 0);
        let Some(first) = left.next() else {
            continue;
        };
        if done.count_ones() as usize + 1 == odd.len() {
            repeated = repeated.min(sum);
        }
        // All but one have to be paired. The first may be that one, which is tried by pairing it
        // last.
        for first in core::iter::once(first).chain(left.clone().take(1)) {
            for second in (0..odd.len()).filter(|place| *place != first && done >> place & 1 == 0) {
                if let Some(way) = steps[first][odd[second] as usize] {
                    let set = done | 1 << first | 1 << second;
                    least[set] = least[set].min(sum + way);
                }
            }
        }
    }
    (repeated < u32::MAX).then_some(ends / 2 + repeated)
}
