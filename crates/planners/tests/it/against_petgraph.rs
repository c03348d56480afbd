//! Both searches against petgraph's on random graphs.

use petgraph::algo::dijkstra;
use petgraph::graph::{DiGraph, NodeIndex};
use proptest::prelude::*;
use tolman_planners::{
    Arcs, Graph, a_star, best_first, costs_from, depth_first, path_between, path_to, steps_from,
};

const NODES: u32 = 24;

fn arcs() -> impl Strategy<Value = Vec<(u32, u32, u32)>> {
    // Cheap arcs, and some so dear that they lie beyond a round of buckets.
    let cost = prop_oneof![0..50_u32, 0..1500_u32, 1000..1_000_000_u32];
    prop::collection::vec((0..NODES, 0..NODES, cost), 0..80)
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
    fn a_star_finds_a_cheapest_path(list in arcs(), source in 0..NODES, goal in 0..NODES, share in 0..=4_u32) {
        let graph = Arcs::new(NODES as usize, &list);
        let costs = costs_from(&graph.reversed(), [goal]);
        // A share of the true cost never guesses too high.
        let guess = |node: u32| costs[node as usize].map_or(0, |cost| cost / 4 * share);
        let found = a_star(&graph, source, |node| node == goal, guess);
        prop_assert_eq!(found.as_ref().map(|found| found.cost), costs[source as usize]);
        let blind = a_star(&graph, source, |node| node == goal, |_| 0);
        prop_assert_eq!(blind.map(|found| found.cost), costs[source as usize]);
        let between = path_between(&graph, &graph.reversed(), source, goal);
        let between = between.map(|(path, cost)| tolman_planners::Found { path, cost, expanded: 0 });
        prop_assert_eq!(between.as_ref().map(|found| found.cost), costs[source as usize]);
        let greedy = best_first(&graph, source, |node| node == goal, guess);
        prop_assert_eq!(greedy.is_some(), found.is_some());
        for found in found.into_iter().chain(greedy).chain(between) {
            prop_assert_eq!((found.path[0], found.path[found.path.len() - 1]), (source, goal));
            prop_assert!(found.cost >= costs[source as usize].unwrap());
            let mut cost = 0;
            for pair in found.path.windows(2) {
                let mut least = None;
                graph.for_each_arc(pair[0], |head, step| {
                    if head == pair[1] {
                        least = Some(least.map_or(step, |least: u32| least.min(step)));
                    }
                });
                cost += least.unwrap();
            }
            prop_assert_eq!(cost, found.cost);
        }
    }

    #[test]
    fn a_depth_first_search_finds_some_way_where_there_is_one(list in arcs(), source in 0..NODES, goal in 0..NODES) {
        let graph = Arcs::new(NODES as usize, &list);
        let least = costs_from(&graph, [source])[goal as usize];
        let found = depth_first(&graph, source, |node| node == goal);
        prop_assert_eq!(found.is_some(), least.is_some());
        if let Some(found) = found {
            prop_assert_eq!((found.path[0], found.path[found.path.len() - 1]), (source, goal));
            prop_assert!(found.cost >= least.unwrap() && found.expanded <= NODES);
            for pair in found.path.windows(2) {
                prop_assert!(list.iter().any(|(tail, head, _)| [*tail, *head] == pair));
            }
        }
    }

    #[test]
    fn steps_agree(list in arcs(), source in 0..NODES) {
        let ours = steps_from(&Arcs::new(NODES as usize, &list), [source]);
        prop_assert_eq!(ours, theirs(&list, source, |_| 1));
    }

    #[test]
    fn a_path_is_a_walk_of_as_many_arcs_as_there_must_be(list in arcs(), from in 0..NODES, to in 0..NODES) {
        let graph = Arcs::new(NODES as usize, &list);
        let path = path_to(&graph, from, |node| node == to);
        let arcs = path.as_ref().map(|path| path.len() as u32 - 1);
        prop_assert_eq!(arcs, theirs(&list, from, |_| 1)[to as usize]);
        if let Some(path) = path {
            prop_assert_eq!((path.first(), path.last()), (Some(&from), Some(&to)));
            for hop in path.windows(2) {
                prop_assert!(list.iter().any(|arc| [arc.0, arc.1] == hop));
            }
        }
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

/// Someone's own graph, which need not keep its word.
struct Wild;

impl Graph for Wild {
    fn node_count(&self) -> usize {
        2
    }

    fn for_each_arc(&self, _node: u32, mut visit: impl FnMut(u32, u32)) {
        visit(1, u32::MAX);
        visit(7, 1);
    }
}

#[test]
fn what_a_graph_does_not_have_is_passed_over() {
    assert_eq!(steps_from(&Wild, [0, 9]), [Some(0), Some(1)]);
    assert_eq!(costs_from(&Wild, [0, 9]), [Some(0), Some(u32::MAX)]);
    assert_eq!(path_to(&Wild, 0, |node| node == 1), Some(vec![0, 1]));
    assert_eq!(path_to(&Wild, 9, |_| true), None);
    let arcs = Arcs::new(2, &[(0, 1, 3), (0, 2, 1), (5, 0, 1)]);
    assert_eq!(costs_from(&arcs, [0]), [Some(0), Some(3)]);
    arcs.for_each_arc(9, |_, _| panic!("node 9 has no arcs"));
    assert!(steps_from(&Arcs::new(0, &[]), [0]).is_empty());
}

#[test]
fn a_sum_beyond_all_numbers_is_no_way() {
    let arcs = Arcs::new(3, &[(0, 1, u32::MAX), (1, 2, 1)]);
    assert_eq!(costs_from(&arcs, [0]), [Some(0), Some(u32::MAX), None]);
}

#[test]
fn every_source_counts() {
    let arcs = Arcs::new(4, &[(0, 1, 5), (1, 2, 5), (3, 2, 1)]);
    assert_eq!(
        costs_from(&arcs, [0, 3]),
        [Some(0), Some(5), Some(1), Some(0)]
    );
}
