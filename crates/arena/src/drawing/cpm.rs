//! Pictures of a map, like the paper's figures 5 (b) and 8.

use core::fmt::Write;

use tolman_geom::{Point, Vector, nearest_on_segment};
use tolman_maps::cpm::{CpMap, End, Fragment, FragmentId, Junction, JunctionId, PortState, Sign};
use tolman_maze::Cell;
use tolman_robot::Landmark;
use tolman_sim::World;

use crate::course::Course;
use crate::cpm::{Layout, Lie};
use tolman_draw::{
    Drawing, EdgeLine, FloorPlan, GraphEdge, GraphNode, GraphPicture, NodeMark, Series, ZoneStyle,
};

/// Width of a plan, user units.
const WIDTH: f64 = 420.0;

/// Radius of a node, user units.
const RADIUS: f64 = 4.5;

/// Colour of junctions; the colours of fragments follow it.
const JUNCTION: Series = Series(0);

/// Returns the name of a fragment, the same in all pictures.
#[must_use]
pub fn fragment_name(id: FragmentId) -> String {
    format!("A{}", id.0)
}

/// Returns the landmark at a junction, or else its number.
#[must_use]
pub fn junction_name(map: &CpMap, id: JunctionId) -> String {
    match map.junction(id).and_then(|junction| junction.landmark) {
        Some(Landmark::Start) => "start".to_owned(),
        Some(Landmark::Goal) => "goal".to_owned(),
        _ => format!("J{}", id.0),
    }
}

/// Returns the colour of a fragment, by its number.
const fn series(id: FragmentId) -> Series {
    Series(1 + id.0 % (Series::COLOURS - 1))
}

/// Returns a map over the maze in which it was learned. Each fragment is drawn along its corridor,
/// in its own colour, with its name and signs. Junctions are squares, and unexplored ports are
/// dashed stubs.
#[must_use]
pub fn over_maze(map: &CpMap, course: &Course) -> Drawing {
    let world = &course.world;
    let layout = Layout::of(map, &course.maze);
    let mut plan = plan_of(course);
    let mut graph = GraphPicture::new().radius(RADIUS);
    let mut signs = Vec::new();
    let bounds = world.bounds();
    let unit = (bounds.max.x - bounds.min.x) / WIDTH;
    stubs(&mut graph, &layout, world);
    for (id, fragment, lie, centres) in laid(map, &layout, world) {
        match lie.is_right {
            true => plan.way(&centres, series(id)),
            false => plan.doubtful_way(&centres, series(id)),
        }
        let node = fragment_node(map, id, fragment, point_along(&centres, 0.5));
        add(&mut graph, node);
        if let ([at, towards, ..], [.., before, last]) = (&centres[..], &centres[..]) {
            signs.push((beside(*at, *towards, unit), Sign::Minus));
            signs.push((beside(*last, *before, unit), Sign::Plus));
        }
    }
    graph.signs = signs.iter().map(|(at, _)| *at).collect();
    for (id, junction) in map.junctions() {
        if let Some(cell) = layout.place(id) {
            add(
                &mut graph,
                junction_node(map, id, junction, world.cell_centre(cell)),
            );
        }
    }
    plan.graph(&graph);
    for (at, sign) in signs {
        plan.label(at, &sign.to_string());
    }
    plan.drawing(format!(
        "A common-pattern map of {} fragments over its maze.",
        map.fragments().len()
    ))
}

/// Returns the plan of a maze; cells that the robot cannot reach are solid.
#[must_use]
pub fn plan_of(course: &Course) -> FloorPlan {
    let world = &course.world;
    let mut plan = FloorPlan::of_world(world, WIDTH);
    // Cell (0, 0) begins at the origin.
    let side = 2.0 * world.cell_centre(Cell::new(0, 0)).x;
    for cell in course.maze.sealed() {
        plan.square(world.cell_centre(cell), side, ZoneStyle::Solid);
    }
    plan
}

/// Adds a node. If there is one at the same position, because the map has a place twice, its name
/// is added to that one.
fn add(graph: &mut GraphPicture, node: GraphNode) {
    let same = |other: &&mut GraphNode| {
        other.mark == node.mark
            && !other.label.is_empty()
            && (other.position - node.position).norm() < 1e-6
    };
    match graph.nodes.iter_mut().find(same) {
        Some(other) => {
            other.label = format!("{}, {}", other.label, node.label);
            other.note = format!("{}; {}", other.note, node.note);
        }
        None => {
            graph.node(node);
        }
    }
}

/// Returns the map by itself, like the paper's figure 8. Fragment nodes are discs, junction nodes
/// squares. Each edge has the sign of the fragment's end and the port of the junction. Nodes are
/// drawn at their positions in the maze.
#[must_use]
pub fn graph(map: &CpMap, course: &Course) -> Drawing {
    let world = &course.world;
    let layout = Layout::of(map, &course.maze);
    let mut graph = GraphPicture::new().radius(RADIUS + 1.0);
    stubs(&mut graph, &layout, world);
    let mut junctions = Vec::new();
    for (id, junction) in map.junctions() {
        if let Some(cell) = layout.place(id) {
            let node = junction_node(map, id, junction, world.cell_centre(cell));
            junctions.push((id, graph.node(node)));
        }
    }
    for (id, fragment, lie, centres) in laid(map, &layout, world) {
        let name = format!("{} · {}", fragment_name(id), fragment.length());
        let node = fragment_node(map, id, fragment, free(&centres, &graph)).label(name);
        let node = graph.node(node);
        for sign in Sign::BOTH {
            let port = fragment.port(sign);
            let place = junctions.iter().find(|(other, _)| *other == port.junction);
            if let Some((_, place)) = place {
                let line = match lie.is_right {
                    true => EdgeLine::Plain,
                    false => EdgeLine::Dashed,
                };
                graph.edge(
                    GraphEdge::between(node, *place)
                        .series(series(id))
                        .line(line)
                        .label(format!("{sign}{}", port.number)),
                );
            }
        }
    }
    // Names are on the right of their nodes.
    let mut bounds = world.bounds();
    bounds.max.x += 0.1 * (bounds.max.x - bounds.min.x);
    let mut plan = FloorPlan::of_bounds(&bounds, WIDTH);
    plan.graph(&graph);
    plan.drawing(format!(
        "A common-pattern map: {} fragment nodes and {} junction nodes.",
        map.fragments().len(),
        map.junctions().len()
    ))
}

fn fragment_node(map: &CpMap, id: FragmentId, fragment: &Fragment, at: Point) -> GraphNode {
    GraphNode::at(at)
        .mark(NodeMark::Disc)
        .series(series(id))
        .label(fragment_name(id))
        .note(fragment_note(map, id, fragment))
}

fn junction_node(map: &CpMap, id: JunctionId, junction: &Junction, at: Point) -> GraphNode {
    let mut note = format!("{}: ", junction_name(map, id));
    for (number, port) in (0_u32..).zip(&junction.ports) {
        let what = match port {
            PortState::Open { .. } => "unexplored".to_owned(),
            PortState::Filled(end) => end_name(*end),
        };
        // Writing to a string cannot fail.
        let _ = write!(note, "port {number} {what}; ");
    }
    GraphNode::at(at)
        .mark(NodeMark::Square)
        .series(JUNCTION)
        .label(junction_name(map, id))
        .note(note.trim_end_matches("; "))
}

/// Returns an end in the paper's notation: A3⁺.
fn end_name(end: End) -> String {
    let sign = match end.sign {
        Sign::Minus => "⁻",
        Sign::Plus => "⁺",
    };
    format!("{}{sign}", fragment_name(end.fragment))
}

/// Returns the three properties of a fragment node: its sequence, its length, its transitions.
fn fragment_note(map: &CpMap, id: FragmentId, fragment: &Fragment) -> String {
    let sequence: Vec<String> = fragment
        .patterns
        .iter()
        .map(|pattern| pattern.0.to_string())
        .collect();
    let mut note = format!(
        "{}: {} patterns, {}; ",
        fragment_name(id),
        fragment.patterns.len(),
        sequence.join("-")
    );
    for sign in Sign::BOTH {
        let from = id.end(sign);
        let place = map.junction(fragment.port(sign).junction);
        let ends = place.into_iter().flat_map(|place| &place.ports);
        for port in ends {
            if let PortState::Filled(to) = port
                && *to != from
                && let Some(turn) = map.transition(from, *to)
            {
                // Writing to a string cannot fail.
                let _ = write!(
                    note,
                    "Δ({} → {}) = {}; ",
                    end_name(from),
                    end_name(*to),
                    turn.0
                );
            }
        }
    }
    note.trim_end_matches("; ").to_owned()
}

/// Draws dashed stubs at unexplored ports.
fn stubs(graph: &mut GraphPicture, layout: &Layout, world: &World) {
    for open in &layout.open {
        let at = world.cell_centre(open.cell);
        let on = world.cell_centre(open.next) - at;
        // It is hidden below its junction.
        let from = graph.node(GraphNode::at(at).mark(NodeMark::Square).series(JUNCTION));
        let to = graph.node(
            GraphNode::at(at + 0.5 * on)
                .series(JUNCTION)
                .note("unexplored"),
        );
        graph.edge(
            GraphEdge::between(from, to)
                .series(JUNCTION)
                .line(EdgeLine::Dashed),
        );
    }
}

/// Returns the fragments that are laid out, each with the centres of its cells.
fn laid<'a>(
    map: &'a CpMap,
    layout: &'a Layout,
    world: &'a World,
) -> impl Iterator<Item = (FragmentId, &'a Fragment, &'a Lie, Vec<Point>)> {
    map.fragments().filter_map(move |(id, fragment)| {
        let lie = layout.fragments.get(&id)?;
        Some((id, fragment, lie, centres(&lie.cells, world)))
    })
}

/// Returns the middles of cells.
fn centres(cells: &[Cell], world: &World) -> Vec<Point> {
    cells.iter().map(|cell| world.cell_centre(*cell)).collect()
}

/// Returns the middle of the way along cells, for a fragment's name.
#[must_use]
pub fn middle_of(cells: &[Cell], world: &World) -> Point {
    point_along(&centres(cells, world), 0.5)
}

/// Returns a point on a way from which straight lines to both ends touch no node: the middle, or
/// the nearest such point.
fn free(points: &[Point], graph: &GraphPicture) -> Point {
    let (Some(start), Some(end)) = (points.first(), points.last()) else {
        return Point::origin();
    };
    let room = |at: &Point| {
        let others = graph.nodes.iter().map(|node| node.position);
        let others = others.filter(|node| node != start && node != end);
        let distances = others.map(|node| {
            let to = |end: &Point| (node - nearest_on_segment(node, *at, *end)).norm();
            to(start).min(to(end))
        });
        distances.fold(f64::INFINITY, f64::min)
    };
    // Half a cell is the minimum distance from a node.
    let cell = points.get(1).map_or(0.0, |next| (next - start).norm());
    let mut candidates =
        [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8].map(|share| point_along(points, share));
    let free = candidates.iter().find(|at| room(at) > 0.5 * cell);
    if let Some(free) = free {
        return *free;
    }
    candidates.sort_by(|a, b| room(b).total_cmp(&room(a)));
    candidates[0]
}

/// Returns the point at this share of the way's length, 0 … 1.
fn point_along(points: &[Point], share: f64) -> Point {
    let length = |pair: &[Point]| (pair[1] - pair[0]).norm();
    let mut left = points.windows(2).map(length).sum::<f64>() * share;
    for pair in points.windows(2) {
        if left <= length(pair) {
            return pair[0] + (left / length(pair).max(f64::MIN_POSITIVE)) * (pair[1] - pair[0]);
        }
        left -= length(pair);
    }
    points.first().copied().unwrap_or_else(Point::origin)
}

/// Returns the position of a sign: a little way along, to the left. `unit` is the length of a user
/// unit, m.
fn beside(at: Point, towards: Point, unit: f64) -> Point {
    let along = (towards - at).normalize();
    at + unit * (17.0 * along + 9.0 * Vector::new(-along.y, along.x))
}
