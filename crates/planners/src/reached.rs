use alloc::vec;
use alloc::vec::Vec;

/// What a search knows of each node: the least cost so far, and the node before it on that way. A
/// source comes from itself.
///
/// A slot of zeros is a node that was not reached, so that the memory is taken as the system hands
/// it out, and only what a search touches is ever written.
pub(crate) struct Reached(Vec<u64>);

impl Reached {
    pub(crate) fn new(node_count: usize) -> Self {
        // The complement of the last number would be zero; no graph of this machine is so large.
        Self(vec![0; node_count.min(u32::MAX as usize)])
    }

    /// Returns the cost and the node before, or `None` if the node was not reached.
    #[inline(always)]
    pub(crate) fn get(&self, node: u32) -> Option<(u32, u32)> {
        let slot = *self.0.get(node as usize)?;
        (slot != 0).then_some(((slot >> 32) as u32, !(slot as u32)))
    }

    /// Keeps a way to `node` if the graph has the node and the way is cheaper than the best so far.
    #[inline(always)]
    pub(crate) fn improve(&mut self, node: u32, cost: u32, before: u32) -> bool {
        let Some(slot) = self.0.get_mut(node as usize) else {
            return false;
        };
        let is_better = *slot == 0 || cost < (*slot >> 32) as u32;
        if is_better {
            *slot = u64::from(cost) << 32 | u64::from(!before);
        }
        is_better
    }

    /// Returns the cost of each node.
    pub(crate) fn costs(&self) -> Vec<Option<u32>> {
        let slots = self.0.iter();
        slots
            .map(|slot| (*slot != 0).then_some((slot >> 32) as u32))
            .collect()
    }

    /// Returns the nodes from `source` to `goal`, by the node that each was reached from.
    pub(crate) fn trace_back(&self, source: u32, goal: u32) -> Vec<u32> {
        let came_from = |node: &u32| Some(self.get(*node)?.1);
        let back = |node: &u32| came_from(node).filter(|_| *node != source);
        let mut path: Vec<u32> = core::iter::successors(Some(goal), back).collect();
        path.reverse();
        path
    }
}
