//! Properties of every graph of MSLST, however the robot wanders.

use proptest::prelude::*;
use tolman_maps::mslst_graph::{
    ActionEdge, GraphError, GraphMapper, Memory, MslstGraph, Node, NodeZone, localize, overlay,
};
use tolman_maze::Direction;

const STATES: u32 = 4;

/// One action of a wandering robot: what it did and what it met; no state where the action failed.
type Event = (Direction, Option<u32>, NodeZone);

fn direction() -> impl Strategy<Value = Direction> {
    (0..4_usize).prop_map(|index| Direction::ALL[index])
}

fn zone() -> impl Strategy<Value = NodeZone> {
    prop_oneof![9 => Just(NodeZone::Elsewhere), 1 => Just(NodeZone::Destination)]
}

fn wandering() -> impl Strategy<Value = Vec<Event>> {
    prop::collection::vec(
        (direction(), prop::option::weighted(0.8, 0..STATES), zone()),
        0..120,
    )
}

fn mapped(events: &[Event]) -> GraphMapper {
    let mut mapper = GraphMapper::new(0, NodeZone::Elsewhere);
    for &(action, state, zone) in events {
        match state {
            Some(state) => {
                mapper.succeeded(action, state, zone);
            }
            None => mapper.failed(action),
        }
    }
    mapper
}

fn remembered(events: &[Event], length: usize) -> Memory {
    let mut memory = Memory::new(length);
    memory.start(0);
    for &(action, state, _) in events {
        if let Some(state) = state {
            memory.moved(action, state);
        }
    }
    memory
}

/// Returns the shortest distances to a destination, by relaxation until nothing changes.
fn distances(graph: &MslstGraph) -> Vec<Option<u32>> {
    let mut distances: Vec<Option<u32>> = graph
        .ids()
        .map(|id| graph.is_destination(id).then_some(0))
        .collect();
    loop {
        let before = distances.clone();
        for (id, node) in graph.nodes().iter().enumerate() {
            for head in node.edges.iter().filter_map(|edge| edge.head) {
                if let Some(there) = before[head as usize] {
                    distances[id] =
                        Some(distances[id].map_or(there + 1, |here| here.min(there + 1)));
                }
            }
        }
        if distances == before {
            return distances;
        }
    }
}

proptest! {
    #[test]
    fn a_walk_laid_over_its_own_graph_matches_whole(events in wandering()) {
        let walked = mapped(&events);
        let graph = walked.clone().finish();
        let failed = |node: &Node| node.edges.iter().filter(|edge| edge.head.is_none()).count();
        let all = graph.len() + graph.nodes().iter().map(failed).sum::<usize>();
        let found = overlay(&graph, &walked);
        prop_assert!(found.candidates.contains(&walked.at()));
        prop_assert_eq!(found.matched, all);
    }

    #[test]
    fn every_edge_is_entered_both_ways(events in wandering()) {
        let graph = mapped(&events).finish();
        for (id, node) in graph.ids().zip(graph.nodes()) {
            for edge in &node.edges {
                let Some(head) = edge.head else { continue };
                let back = ActionEdge { action: edge.action.opposite(), head: Some(id) };
                prop_assert!(graph.node(head).unwrap().edges.contains(&back));
            }
        }
        // What is checked on loading holds of everything that is learned.
        prop_assert_eq!(MslstGraph::from_nodes(graph.nodes().to_vec()), Ok(graph));
    }

    #[test]
    fn the_dummy_node_is_where_failures_end_and_nowhere_else(events in wandering()) {
        let mut mapper = GraphMapper::new(0, NodeZone::Elsewhere);
        for (action, state, zone) in events {
            let (at, count) = (mapper.at(), mapper.nodes().len());
            match state {
                Some(state) => {
                    mapper.succeeded(action, state, zone);
                }
                None => {
                    mapper.failed(action);
                    let failure = ActionEdge { action, head: None };
                    let edges = &mapper.nodes()[at as usize].edges;
                    prop_assert_eq!(edges.iter().filter(|edge| **edge == failure).count(), 1);
                    prop_assert_eq!((mapper.at(), mapper.nodes().len()), (at, count));
                }
            }
        }
        let graph = mapper.finish();
        for id in graph.ids() {
            prop_assert!(graph.follow(id, Direction::North, STATES).is_none());
        }
    }

    #[test]
    fn the_way_back_leads_back(events in wandering(), there in wandering()) {
        let mut mapper = mapped(&events);
        let (from, state) = (mapper.at(), mapper.nodes()[mapper.at() as usize].state);
        // The states met on the way, each with the action that undoes the one that led from it.
        let mut back = vec![];
        let mut here = state;
        for (action, next, zone) in there {
            if let Some(next) = next {
                back.push((action.opposite(), here));
                mapper.succeeded(action, next, zone);
                here = next;
            }
        }
        let count = mapper.nodes().len();
        for (action, state) in back.into_iter().rev() {
            mapper.succeeded(action, state, NodeZone::Elsewhere);
        }
        prop_assert_eq!(mapper.at(), from);
        prop_assert_eq!(mapper.nodes().len(), count, "a way back adds no node");
    }

    #[test]
    fn distances_are_the_shortest(events in wandering()) {
        let graph = mapped(&events).finish();
        let expected = distances(&graph);
        for id in graph.ids() {
            prop_assert_eq!(graph.distance(id), expected[id as usize]);
            let path = graph.path_to_destination(id, &[]);
            prop_assert_eq!(path.map(|path| path.len() as u32), expected[id as usize]);
        }
    }

    #[test]
    fn paths_lead_to_a_destination_and_begin_otherwise_than_failed(
        events in wandering(),
        failed in prop::collection::vec(direction(), 0..3),
    ) {
        let graph = mapped(&events).finish();
        for id in graph.ids() {
            let Some(path) = graph.path_to_destination(id, &failed) else { continue };
            prop_assert!(path.first().is_none_or(|first| !failed.contains(first)));
            // An action may lead to nodes of several states: all that can be reached.
            let mut reached = vec![id];
            for action in path {
                let step = |id: &u32| graph.node(*id).unwrap().edges.clone();
                reached = reached.iter().flat_map(step)
                    .filter(|edge| edge.action == action)
                    .filter_map(|edge| edge.head)
                    .collect();
            }
            prop_assert!(reached.iter().any(|id| graph.is_destination(*id)));
        }
    }

    #[test]
    fn localization_returns_only_nodes_of_the_robots_state(
        events in wandering(),
        met in wandering(),
        length in 1..10_usize,
    ) {
        let graph = mapped(&events).finish();
        let memory = remembered(&met, length);
        let state = memory.newest_first().next().unwrap().state;
        let found = localize(&graph, &memory);
        prop_assert!(found.candidates.iter().all(|id| graph.node(*id).unwrap().state == state));
        prop_assert!(found.candidates.is_sorted());
        prop_assert!(found.matched <= length);
        match found.node {
            Some(node) => {
                prop_assert!(found.candidates.contains(&node));
                let least = found.candidates.iter().map(|id| graph.distance(*id).unwrap_or(u32::MAX)).min();
                prop_assert_eq!(least, Some(graph.distance(node).unwrap_or(u32::MAX)));
            }
            None => prop_assert!(graph.nodes().iter().all(|node| node.state != state)),
        }
    }

    /// A robot that walks along the graph is found on it: its node fits everything that is
    /// remembered.
    #[test]
    fn the_true_node_of_a_walk_along_the_graph_is_a_candidate(events in wandering(), length in 1..10_usize) {
        let mapper = mapped(&events);
        let at = mapper.at();
        let found = localize(&mapper.finish(), &remembered(&events, length));
        prop_assert!(found.candidates.contains(&at));
    }
}

#[test]
fn an_action_may_lead_to_several_states() {
    let mut mapper = GraphMapper::new(0, NodeZone::Elsewhere);
    mapper.succeeded(Direction::East, 1, NodeZone::Elsewhere);
    mapper.succeeded(Direction::West, 0, NodeZone::Elsewhere);
    mapper.failed(Direction::East);
    mapper.succeeded(Direction::East, 2, NodeZone::Destination);
    let graph = mapper.finish();
    let east: Vec<Option<u32>> = graph
        .node(0)
        .unwrap()
        .edges
        .iter()
        .map(|edge| edge.head)
        .collect();
    assert_eq!(east, [Some(1), None, Some(2)]);
    assert_eq!(graph.follow(0, Direction::East, 2), Some(2));
    assert_eq!(
        graph.path_to_destination(0, &[]),
        Some(vec![Direction::East])
    );
    assert_eq!(graph.path_to_destination(0, &[Direction::East]), None);
}

/// "If the robot sees sequentially states A, B, C, and D, all while traveling east …"
#[test]
fn the_papers_example() {
    let (a, b, c, d) = (0, 1, 2, 3);
    let mut mapper = GraphMapper::new(c, NodeZone::Destination);
    // A first D whose west is C, whose west is no B, next to the destination; then A, B, C, D.
    let first = mapper.succeeded(Direction::East, d, NodeZone::Elsewhere);
    for state in [a, b, c, d] {
        mapper.succeeded(Direction::East, state, NodeZone::Elsewhere);
    }
    let second = mapper.at();
    let graph = mapper.finish();

    let mut memory = Memory::new(8);
    memory.start(d);
    let found = localize(&graph, &memory);
    assert_eq!(
        (found.node, found.matched),
        (Some(first), 1),
        "the nearer one"
    );
    memory.start(a);
    for state in [b, c, d] {
        memory.moved(Direction::East, state);
    }
    let found = localize(&graph, &memory);
    assert_eq!((found.candidates, found.matched), (vec![second], 3));
    // Nothing fits three actions back, so what fits two decides.
    memory.start(d);
    memory.moved(Direction::North, c);
    memory.moved(Direction::East, d);
    let found = localize(&graph, &memory);
    assert_eq!((found.candidates, found.matched), (vec![first, second], 2));
}

#[test]
fn what_is_no_graph_is_refused() {
    let node = |edges: &[(Direction, Option<u32>)]| Node {
        state: 0,
        zone: NodeZone::Elsewhere,
        edges: edges
            .iter()
            .map(|&(action, head)| ActionEdge { action, head })
            .collect(),
    };
    use Direction::{East, North, West};
    for (nodes, expected) in [
        (vec![], GraphError::Empty),
        (
            vec![node(&[(East, Some(1))])],
            GraphError::NoSuchNode {
                node: 0,
                action: East,
                head: 1,
                count: 1,
            },
        ),
        (
            vec![node(&[(East, Some(1))]), node(&[(North, Some(0))])],
            GraphError::OneWay {
                node: 0,
                action: East,
                head: 1,
            },
        ),
        (
            vec![
                node(&[(East, Some(1)), (East, Some(2))]),
                node(&[(West, Some(0))]),
                node(&[(West, Some(0))]),
            ],
            GraphError::Ambiguous {
                node: 0,
                action: East,
            },
        ),
        (
            vec![node(&[(North, None), (North, None)])],
            GraphError::Ambiguous {
                node: 0,
                action: North,
            },
        ),
    ] {
        assert_eq!(MslstGraph::from_nodes(nodes), Err(expected));
    }
}
