//! Ways of one who knows the maze: what scores are compared with.

use alloc::collections::VecDeque;

use super::episode::Unseen;
use super::floor::{Floor, Stand};

/// Returns the least number of steps from `start` to one cell after another.
pub(super) fn errands(floor: &Floor, start: Stand, cells: impl Iterator<Item = u32>) -> u32 {
    // In each of the robot's last stands, the least number of steps so far.
    let mut best = vec![(start, 0)];
    for cell in cells {
        let mut arrived: [Option<u32>; 4] = [None; 4];
        for (from, steps) in best {
            walk(floor, from, |stand, more| {
                let least = &mut arrived[stand.heading.index()];
                if stand.cell == cell && least.is_none_or(|least| steps + more < least) {
                    *least = Some(steps + more);
                }
                false
            });
        }
        let stands = arrived.into_iter().enumerate();
        best = stands
            .filter_map(|(heading, steps)| {
                Some((Stand::of_number(4 * cell + heading as u32), steps?))
            })
            .collect();
    }
    best.into_iter().map(|(_, steps)| steps).min().unwrap_or(0)
}

/// Returns the number of steps of one who sees the rest by going to the nearest cell first from
/// which something new is seen. A cleverer order may be shorter.
pub(super) fn nearest_first(
    floor: &Floor,
    start: Stand,
    mut unseen: Unseen,
    sees_far: bool,
) -> u32 {
    let mut at = Some((start, 0));
    let mut steps = 0;
    while unseen.left > 0 {
        let Some((stand, _)) = at else { break };
        at = walk(floor, stand, |stand, _| {
            unseen.is_worth_a_look(floor, stand.cell, sees_far)
        });
        if let Some((stand, more)) = at {
            unseen.look(floor, stand.cell, sees_far);
            steps += more;
        }
    }
    steps
}

/// Visits all stands in the order of the steps to them, until `is_end`. Returns the last one then,
/// and the number of steps to it.
fn walk(
    floor: &Floor,
    start: Stand,
    mut is_end: impl FnMut(Stand, u32) -> bool,
) -> Option<(Stand, u32)> {
    let mut is_met = vec![false; 4 * floor.cell_count()];
    is_met[start.number() as usize] = true;
    let mut open = VecDeque::from([(start, 0)]);
    while let Some((stand, steps)) = open.pop_front() {
        if is_end(stand, steps) {
            return Some((stand, steps));
        }
        for next in stand.moved(floor) {
            if !is_met[next.number() as usize] {
                is_met[next.number() as usize] = true;
                open.push_back((next, steps + 1));
            }
        }
    }
    None
}
