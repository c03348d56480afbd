use alloc::sync::Arc;
use alloc::vec::Vec;

/// Nodes of a map, by id, shared between copies of the map. A copy costs O(1). The first change
/// after a copy costs one reference count per node, whatever the nodes' size.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Nodes<I, T>(Arc<Vec<(I, Arc<T>)>>);

impl<I, T> Default for Nodes<I, T> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<I: Copy + Ord, T: Clone> Nodes<I, T> {
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns the nodes in order of id.
    pub(super) fn iter(&self) -> impl ExactSizeIterator<Item = (I, &T)> {
        self.0.iter().map(|(id, node)| (*id, &**node))
    }

    /// Returns the nodes in order of id, to be changed with [`Arc::make_mut`] where necessary.
    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Arc<T>> {
        Arc::make_mut(&mut self.0).iter_mut().map(|(_, node)| node)
    }

    /// Returns the number of nodes with lower ids, or `None` if `id` does not exist. O(log nodes).
    pub(super) fn rank(&self, id: I) -> Option<usize> {
        self.search(id).ok()
    }

    /// Returns the node at position `rank`, from 0.
    pub(super) fn at(&self, rank: usize) -> Option<&T> {
        let (_, node) = self.0.get(rank)?;
        Some(node)
    }

    /// Returns the id of the node at position `rank`, from 0.
    pub(super) fn id(&self, rank: usize) -> Option<I> {
        self.0.get(rank).map(|(id, _)| *id)
    }

    pub(super) fn get(&self, id: I) -> Option<&T> {
        self.at(self.rank(id)?)
    }

    pub(super) fn get_mut(&mut self, id: I) -> Option<&mut T> {
        let rank = self.rank(id)?;
        let (_, node) = Arc::make_mut(&mut self.0).get_mut(rank)?;
        Some(Arc::make_mut(node))
    }

    /// Inserts a node, or replaces the one with this id. Returns whether the id is new. The last id
    /// is the cheapest.
    pub(super) fn insert(&mut self, id: I, node: T) -> bool {
        let place = self.search(id);
        let nodes = Arc::make_mut(&mut self.0);
        let node = (id, Arc::new(node));
        match place {
            Ok(rank) => nodes[rank] = node,
            Err(rank) => nodes.insert(rank, node),
        }
        place.is_err()
    }

    pub(super) fn remove(&mut self, id: I) -> Option<T> {
        let rank = self.rank(id)?;
        let (_, node) = Arc::make_mut(&mut self.0).remove(rank);
        Some(Arc::unwrap_or_clone(node))
    }

    fn search(&self, id: I) -> Result<usize, usize> {
        self.0.binary_search_by_key(&id, |(id, _)| *id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_keeps_what_it_was_and_shares_what_is_not_changed() {
        let mut nodes = Nodes::default();
        for id in [3, 9, 4] {
            assert!(nodes.insert(id, id * 10));
        }
        assert!(!nodes.insert(9, 91));
        let copy = nodes.clone();
        *nodes.get_mut(3).unwrap() = 31;
        assert_eq!(nodes.remove(4), Some(40));
        assert_eq!(nodes.remove(4), None);
        let of = |nodes: &Nodes<i32, i32>| -> Vec<(i32, i32)> {
            nodes.iter().map(|(id, node)| (id, *node)).collect()
        };
        assert_eq!(of(&nodes), [(3, 31), (9, 91)]);
        assert_eq!(of(&copy), [(3, 30), (4, 40), (9, 91)]);
        assert_eq!((nodes.rank(9), copy.rank(9)), (Some(1), Some(2)));
        assert_eq!(
            (nodes.rank(4), nodes.get(4), nodes.at(2)),
            (None, None, None)
        );
        assert!(core::ptr::eq(nodes.get(9).unwrap(), copy.get(9).unwrap()));
        assert!(!core::ptr::eq(nodes.get(3).unwrap(), copy.get(3).unwrap()));
    }
}
