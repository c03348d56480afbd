/// A directed graph whose nodes are numbered 0 … `node_count()` − 1.
///
/// ```
/// use tolman_planners::Graph;
///
/// /// A circle of places: one step clockwise from each.
/// struct Circle(u32);
///
/// impl Graph for Circle {
///     fn node_count(&self) -> usize {
///         self.0 as usize
///     }
///
///     fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
///         visit((node + 1) % self.0, 1);
///     }
/// }
///
/// # #[cfg(feature = "alloc")]
/// assert_eq!(tolman_planners::steps_from(&Circle(3), [1]), [Some(2), Some(0), Some(1)]);
/// ```
pub trait Graph {
    /// Returns the number of nodes.
    fn node_count(&self) -> usize;

    /// Calls `visit(head, cost)` for every arc that leaves `node`. Always in the same order:
    /// searches break ties by it.
    fn for_each_arc(&self, node: u32, visit: impl FnMut(u32, u32));
}
