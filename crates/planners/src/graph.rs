/// A directed graph whose nodes are numbered 0 … `node_count()` − 1.
pub trait Graph {
    /// Returns the number of nodes.
    fn node_count(&self) -> usize;

    /// Calls `visit(head, cost)` for every arc that leaves `node`. Always in the same order:
    /// searches break ties by it.
    fn for_each_arc(&self, node: u32, visit: impl FnMut(u32, u32));
}
