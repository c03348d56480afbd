//! A plan of a maze with the way of a robot and the map that it learned, as SVG:
//! `cargo run -p tolman-draw --example floor_plan > plan.svg`
#![expect(clippy::print_stdout, reason = "the picture is its result")]

use core::error::Error;

use tolman_draw::{Figure, FloorPlan, GraphEdge, GraphNode, GraphPicture};
use tolman_draw::{NodeMark, Series};
use tolman_geom::Point;
use tolman_sim::maze::{Cell, Direction, Grid, Maze};
use tolman_sim::{CorridorSize, World};

fn main() -> Result<(), Box<dyn Error>> {
    // Two rows of three cells; the first two cells of the upper row are a dead end.
    let mut maze = Maze::open(Grid::new(3, 2));
    for x in 0..2 {
        maze.set_wall(Cell::new(x, 0), Direction::North, true);
    }
    let world = World::from_maze(&maze, &CorridorSize::thin(0.9))?;
    let at = |x, y| world.cell_centre(Cell::new(x, y));

    let mut plan = FloorPlan::of_world(&world, 640.0);
    plan.scale_bar();
    // It cut the corner, and turned round in the dead end.
    let corner = Point::new(2.2, 0.8);
    plan.trajectory(&[at(0, 0), at(1, 0), corner, at(2, 1), at(0, 1)], Series(0));

    let mut map = GraphPicture::new();
    let places = [(0, 0, "start"), (2, 0, ""), (2, 1, ""), (0, 1, "dead end")];
    let nodes = places.map(|(x, y, label)| {
        let node = GraphNode::at(at(x, y)).label(label);
        map.node(node.mark(NodeMark::Disc).series(Series(1)))
    });
    for pair in nodes.windows(2) {
        map.edge(GraphEdge::between(pair[0], pair[1]));
    }
    plan.graph(&map);

    let drawing = plan.drawing("A way from the start round a corner to a dead end.");
    let figure = Figure::new("dead-end", "Into a dead end", drawing);
    let svg = figure.standalone();
    assert!(svg.contains("dead end"));
    println!("{svg}");
    Ok(())
}
