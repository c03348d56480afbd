use alloc::vec::Vec;

use super::graph::MslstGraph;
use super::memory::Memory;

/// Nodes of the graph at which the robot may be.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Localization {
    /// The best match, or `None` if no node has the robot's state.
    pub node: Option<u32>,
    /// All remaining nodes when the search ended, by id.
    pub candidates: Vec<u32>,
    /// Number of experiences that the remaining nodes match, from the newest on; of an overlay, the
    /// number of nodes and failed actions.
    pub matched: usize,
}

/// Finds the node that fits what the robot remembers (Phase III, *Localization*).
///
/// "The localization algorithm first makes a list of all nodes within the graph that match the
/// current state of the robot. It then recursively compares the previous action and state in the
/// robot's memory with the neighbors of each of the nodes in the list … It stops when it reduces
/// its list of nodes to one, in which case that node is the best match, or when it runs out of
/// states or actions to match to, in which case it chooses the node from the list with the shortest
/// path to a destination node."
///
/// The search also ends where the graph matches no further. A comparison that would discard every
/// remaining node ends it and discards none. Ties go to the node that was made earlier. O(nodes +
/// candidates · memory · degree).
#[must_use]
pub fn localize(graph: &MslstGraph, memory: &Memory) -> Localization {
    let mut newest_first = memory.newest_first();
    let Some(mut newer) = newest_first.next() else {
        return Localization::default();
    };
    // Each candidate with the node that the comparison has reached, going back from it.
    let mut list: Vec<Trail> = graph
        .ids()
        .zip(graph.nodes())
        .filter(|(_, node)| node.state == newer.state)
        .map(|(id, _)| Trail {
            candidate: id,
            reached: id,
        })
        .collect();
    let mut matched = usize::from(!list.is_empty());
    for older in newest_first {
        let Some(action) = newer.action.filter(|_| list.len() > 1) else {
            break;
        };
        // An action and the state it leads to name at most one edge, so a trail never forks.
        let kept: Vec<Trail> = list
            .iter()
            .filter_map(|trail| {
                let reached = graph.follow(trail.reached, action.opposite(), older.state)?;
                Some(Trail { reached, ..*trail })
            })
            .collect();
        if kept.is_empty() {
            break;
        }
        list = kept;
        matched += 1;
        newer = older;
    }
    let candidates: Vec<u32> = list.into_iter().map(|trail| trail.candidate).collect();
    Localization::of(graph, candidates, matched)
}

impl Localization {
    /// Returns the localization of these candidates: the best is the one "with the shortest path to
    /// a destination node".
    pub(super) fn of(graph: &MslstGraph, candidates: Vec<u32>, matched: usize) -> Self {
        let nearest = |id: &u32| (graph.distance(*id).unwrap_or(u32::MAX), *id);
        Self {
            node: candidates.iter().copied().min_by_key(nearest),
            candidates,
            matched,
        }
    }
}

#[derive(Clone, Copy)]
struct Trail {
    candidate: u32,
    reached: u32,
}
