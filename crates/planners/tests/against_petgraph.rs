//! Both searches against petgraph's on random graphs.

use petgraph::algo::dijkstra;
use petgraph::graph::{DiGraph, NodeIndex};
use proptest::prelude::*;
use tolman_planners::{Arcs, costs_from, steps_from};

const NODES: u32 = 24;

fn arcs() -> impl Strategy<Value = Vec<(u32, u32, u32)>> {
    prop::collection::vec((0..NODES, 0..NODES, 0..50_u32), 0..80)
}

fn theirs(list: &[(u32, u32, u32)], source: u32, cost: impl Fn(u32) -> u32) -> Vec<Option<u32>> {
    let mut graph = DiGraph::<(), u32>::new();
    for _ in 0..NODES {
        graph.add_node(());
    }
    for &(tail, head, weight) in list {
        graph.add_edge(
            NodeIndex::new(tail as usize),
            NodeIndex::new(head as usize),
            cost(weight),
        );
    }
    let found = dijkstra(&graph, NodeIndex::new(source as usize), None, |edge| {
        *edge.weight()
    });
    (0..NODES as usize)
        .map(|node| found.get(&NodeIndex::new(node)).copied())
        .collect()
}

proptest! {
    #[test]
    fn costs_agree(list in arcs(), source in 0..NODES) {
        let ours = costs_from(&Arcs::new(NODES as usize, &list), [source]);
        prop_assert_eq!(ours, theirs(&list, source, |weight| weight));
    }

    #[test]
    fn steps_agree(list in arcs(), source in 0..NODES) {
        let ours = steps_from(&Arcs::new(NODES as usize, &list), [source]);
        prop_assert_eq!(ours, theirs(&list, source, |_| 1));
    }

    #[test]
    fn turning_a_graph_round_twice_changes_no_cost(list in arcs(), source in 0..NODES) {
        let graph = Arcs::new(NODES as usize, &list);
        prop_assert_eq!(costs_from(&graph.reversed().reversed(), [source]), costs_from(&graph, [source]));
    }

    #[test]
    fn the_cost_there_is_the_cost_of_the_way_back_turned_round(list in arcs(), from in 0..NODES, to in 0..NODES) {
        let graph = Arcs::new(NODES as usize, &list);
        prop_assert_eq!(
            costs_from(&graph, [from])[to as usize],
            costs_from(&graph.reversed(), [to])[from as usize]
        );
    }
}
