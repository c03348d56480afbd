//! Searches beside those of petgraph, on the same graphs, in turn: `cargo bench -p tolman-planners
//! --bench against_petgraph`. Each answer is compared. The least of nine times is printed, ms, since
//! other work on the machine only adds.

#![expect(clippy::print_stdout, reason = "its table is its result")]

use core::hint::black_box;
use core::time::Duration;
use std::time::Instant;

use petgraph::algo::{astar, dijkstra};
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::{Bfs, EdgeRef};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use tolman_planners::{Arcs, a_star, costs_from, steps_from};

const SIDE: u32 = 1000;
const TIMES: usize = 9;

/// Arcs (tail, head, cost) of a graph, and where a path ends.
struct Drawn {
    name: &'static str,
    nodes: u32,
    arcs: Vec<(u32, u32, u32)>,
    target: u32,
    /// Whether nodes are cells of a grid, which lie as far apart as rows and columns differ.
    is_grid: bool,
}

fn main() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut below = |bound: u32| random.next_u32() % bound;
    let blocked: Vec<bool> = (0..SIDE * SIDE).map(|_| below(4) == 0).collect();
    let arcs = (0..500_000).map(|_| (below(100_000), below(100_000), 1 + below(100)));
    let arcs = arcs.collect();
    let open = vec![false; blocked.len()];
    let graphs = [
        grid("1000 × 1000 cells, a quarter blocked", &blocked),
        grid("1000 × 1000 cells, open", &open),
        Drawn {
            name: "100,000 nodes, 500,000 random arcs, costs 1 to 100",
            nodes: 100_000,
            arcs,
            target: 77_777,
            is_grid: false,
        },
    ];
    println!("| graph | search | ours, ms | petgraph, ms | times as fast |");
    println!("| --- | --- | ---: | ---: | ---: |");
    for graph in &graphs {
        compare(graph);
    }
}

/// Returns a grid whose cells lead to their neighbours for a cost of 1, unless either is blocked.
fn grid(name: &'static str, blocked: &[bool]) -> Drawn {
    let is_free = |cell: u32| !blocked[cell as usize] || cell == 0 || cell + 1 == SIDE * SIDE;
    let mut arcs = Vec::new();
    for cell in 0..SIDE * SIDE {
        let (x, y) = (cell % SIDE, cell / SIDE);
        let east = (x + 1 < SIDE).then_some(cell + 1);
        let north = (y + 1 < SIDE).then_some(cell + SIDE);
        for next in [east, north].into_iter().flatten() {
            if is_free(cell) && is_free(next) {
                arcs.extend([(cell, next, 1), (next, cell, 1)]);
            }
        }
    }
    Drawn {
        name,
        nodes: SIDE * SIDE,
        arcs,
        target: SIDE * SIDE - 1,
        is_grid: true,
    }
}

fn compare(drawn: &Drawn) {
    let ours = Arcs::new(drawn.nodes as usize, &drawn.arcs);
    let mut theirs = DiGraph::<(), u32>::with_capacity(drawn.nodes as usize, drawn.arcs.len());
    for _ in 0..drawn.nodes {
        theirs.add_node(());
    }
    for (tail, head, cost) in &drawn.arcs {
        theirs.add_edge(NodeIndex::from(*tail), NodeIndex::from(*head), *cost);
    }
    let (target, first) = (drawn.target, NodeIndex::from(0));
    let last = NodeIndex::from(target);
    let guess = |node: u32| match drawn.is_grid {
        true => (target % SIDE).abs_diff(node % SIDE) + (target / SIDE).abs_diff(node / SIDE),
        false => 0,
    };
    row(
        drawn,
        "breadth-first",
        || steps_from(&ours, [0]).iter().flatten().count(),
        || {
            let mut search = Bfs::new(&theirs, first);
            core::iter::from_fn(|| search.next(&theirs)).count()
        },
    );
    row(
        drawn,
        "Dijkstra",
        || {
            let costs = costs_from(&ours, [0]);
            costs.into_iter().flatten().map(u64::from).sum::<u64>()
        },
        || {
            let costs = dijkstra(&theirs, first, None, |arc| *arc.weight());
            costs.into_values().map(u64::from).sum::<u64>()
        },
    );
    row(
        drawn,
        if drawn.is_grid {
            "A*"
        } else {
            "A*, heuristic 0"
        },
        || a_star(&ours, 0, |node| node == target, guess).map(|found| found.cost),
        || {
            let cost = |arc: petgraph::graph::EdgeReference<'_, u32>| *arc.weight();
            let guess = |node: NodeIndex| guess(node.index() as u32);
            astar(&theirs, first, |node| node == last, cost, guess).map(|found| found.0)
        },
    );
}

/// Prints the least time of each search, and checks that both give the same.
fn row<T: PartialEq + core::fmt::Debug>(
    drawn: &Drawn,
    search: &str,
    ours: impl Fn() -> T,
    theirs: impl Fn() -> T,
) {
    let (mut least, mut least_theirs) = (Duration::MAX, Duration::MAX);
    for _ in 0..TIMES {
        let (mine, time) = timed(&ours);
        least = least.min(time);
        let (other, time) = timed(&theirs);
        least_theirs = least_theirs.min(time);
        assert_eq!(mine, other, "{}, {search}", drawn.name);
    }
    let (ours, theirs) = (1e3 * least.as_secs_f64(), 1e3 * least_theirs.as_secs_f64());
    let name = drawn.name;
    println!(
        "| {name} | {search} | {ours:.1} | {theirs:.1} | {:.1} |",
        theirs / ours
    );
}

fn timed<T>(search: impl Fn() -> T) -> (T, Duration) {
    let begun = Instant::now();
    let found = black_box(search());
    (found, begun.elapsed())
}
