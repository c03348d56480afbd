//! One picture of each kind that `tolman_draw` knows, on one page:
//! `cargo run -p tolman-papers --example pictures -- pictures.html`.

use core::error::Error;
use std::{env, fs};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_arena::course::Course;
use tolman_arena::pioneer;
use tolman_draw::{
    Axis, BoxGroup, BoxPlot, Chart, Dot, EdgeLine, Figure, FloorPlan, GraphEdge, GraphNode,
    GraphPicture, HeatMap, Image, Line, LinePoint, NodeMark, PaperMark, Points, PolarPlot, Region,
    Series, Shade, Tiles, style,
};
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maze::Direction;
use tolman_robot::{Ring, Scan};
use tolman_sim::Bounds;
use tolman_stats::ConfidenceInterval;

type Anything = Box<dyn Error>;

fn main() -> Result<(), Anything> {
    let path = env::args().nth(1).ok_or("name the file to write")?;
    let text = include_str!("../mazes/large-hard.maze");
    let course = Course::for_body("Large", &tolman_maze::read(text)?, &pioneer::body())?;
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let figures = [
        learned_graph(&course),
        distances(&course),
        regions(),
        boxes(&mut rng),
        errors(),
        network(&mut rng),
        sweep(),
        states(&mut rng),
        faces()?,
    ];
    let mut page = format!(
        "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><title>Pictures</title><style>{}\
         body {{ background: var(--page); color: var(--ink); font: 15px system-ui; margin: 2rem; }} \
         figure {{ margin: 0 0 3rem; }}</style>",
        style()
    );
    for figure in &figures {
        let (title, picture) = (&figure.title, figure.inline().into_string());
        page += &format!(
            "<figure>{picture}<figcaption>{title}. {}</figcaption></figure>",
            figure.caption
        );
    }
    fs::write(path, page)?;
    Ok(())
}

/// Returns a graph with a node in every third cell, and edges to the neighbours that are open.
fn learned_graph(course: &Course) -> Figure {
    let grid = course.maze.grid();
    let mut graph = GraphPicture::new();
    let nodes: Vec<usize> = grid
        .cells()
        .map(|cell| {
            // Walled-off cells have no node: their index leads nowhere, and so no edge does.
            if !course.leads_on(course.world.cell_centre(cell)) {
                return usize::MAX;
            }
            let exits = Direction::ALL
                .iter()
                .filter(|to| course.maze.is_open(cell, **to))
                .count();
            let centre = course.world.cell_centre(cell);
            let node = GraphNode::at(centre).note(format!("{exits} ways on"));
            graph.node(match exits {
                0 | 1 => node.series(Series(4)).mark(NodeMark::Square),
                2 => node,
                _ => node.series(Series(2)).mark(NodeMark::Disc).label("J"),
            })
        })
        .collect();
    for cell in grid.cells() {
        for to in [Direction::North, Direction::East] {
            if let (true, Some(next)) = (course.maze.is_open(cell, to), grid.neighbour(cell, to)) {
                let edge = GraphEdge::between(nodes[grid.index(cell)], nodes[grid.index(next)]);
                let line = if to == Direction::East {
                    EdgeLine::Arrow
                } else {
                    EdgeLine::Plain
                };
                graph.edge(edge.line(line));
            }
        }
    }
    let mut plan = tolman_arena::drawing::plan_of_course(course, 560.0);
    plan.graph(&graph);
    let drawing =
        plan.drawing("A place for each cell of the Large maze, joined where no wall stands.");
    Figure::new("graph", "A learned graph over the maze", drawing)
        .caption("Squares: dead ends. Discs: junctions. Arrows: ways east.")
}

fn distances(course: &Course) -> Figure {
    let grid = course.maze.grid();
    let steps = course.maze.steps_to_goal();
    let value = |index: usize| steps[index].map_or(f64::NAN, f64::from);
    let cells: Vec<(Point, f64)> = grid
        .cells()
        .map(|cell| (course.world.cell_centre(cell), value(grid.index(cell))))
        .collect();
    let shade = Shade::of("steps to the goal", cells.iter().map(|cell| cell.1)).series(Series(2));
    let mut plan = tolman_arena::drawing::plan_of_course(course, 560.0);
    plan.cells(&cells, course.corridor_width, &shade);
    Figure::new(
        "cells",
        "Values of cells",
        plan.drawing("How far each cell is from the goal."),
    )
}

fn regions() -> Figure {
    let bounds = |x0, y0, x1, y1| Bounds {
        min: Point::new(x0, y0),
        max: Point::new(x1, y1),
    };
    let mut plan = FloorPlan::of_bounds(&bounds(0.0, 0.0, 6.0, 2.4), 560.0);
    let mut way = Vec::new();
    for i in 0..6 {
        let at = Point::new(0.5 + f64::from(i), 0.6 + 0.2 * f64::from(i));
        let grown = 0.05 + 0.05 * f64::from(i);
        way.push(at);
        let half = Vector::new(grown, 0.6 * grown);
        plan.region(
            &Region::within(&Bounds {
                min: at - half,
                max: at + half,
            }),
            Series(0),
        );
        let covariance = [
            [grown * grown, 0.4 * grown * grown],
            [0.4 * grown * grown, grown * grown],
        ];
        plan.region(&Region::of_covariance(at, covariance, 2.0), Series(1));
        let pose = Pose::new(
            at + Vector::new(0.0, 0.7),
            Heading::from_degrees(12.0 * f64::from(i)),
        );
        plan.region(
            &Region::Box {
                pose,
                length: 2.0 * grown,
                width: grown,
            },
            Series(2),
        );
    }
    plan.trajectory(&way, Series(0));
    Figure::new(
        "regions",
        "Where the robot may be",
        plan.drawing("Uncertainty grows on the way."),
    )
    .caption("Boxes along the axes, boxes along the heading, two standard deviations.")
}

fn boxes(rng: &mut ChaCha8Rng) -> Figure {
    let names = [
        "Avoid",
        "Wall-follow",
        "Random",
        "Oracle with a very long name that wraps",
    ];
    let groups = (0..).zip(names).map(|(i, name)| {
        let middle = 190.0 - 45.0 * f64::from(i);
        let dots = (0..25).map(|run| Dot {
            value: middle * (0.7 + rng.random_range(0.0..0.6) * rng.random_range(0.0..1.4)),
            run,
            seed: u64::from(run),
        });
        BoxGroup {
            row: name.into(),
            series: Series(i),
            dots: dots.collect(),
            paper: (i < 2).then_some(PaperMark {
                mean: middle,
                sd: Some(25.0),
            }),
        }
    });
    let plot = BoxPlot {
        table: "1".into(),
        axis: "steps".into(),
        groups: groups.collect(),
    };
    Figure::new("boxes", "Runs of four rows", plot.drawing())
}

fn errors() -> Figure {
    let mut chart = Chart::new(Axis::log("inputs"), Axis::log("quantization error"));
    for (i, name) in (0..).zip(["GNG", "equilibrium GNG", "SOINN"]) {
        let points = (0..=12).map(|k| {
            let inputs = libm::pow(10.0, 1.0 + 0.25 * f64::from(k));
            let error = (0.9 - 0.2 * f64::from(i)) / libm::pow(inputs, 0.4);
            let spread = ConfidenceInterval {
                low: error * 0.75,
                high: error * 1.35,
            };
            LinePoint::new(inputs, error).spread(spread)
        });
        chart.line(Line::new(name, Series(i), points.collect()));
    }
    let drawing = chart.drawing("The error of three quantizers falls with the number of inputs.");
    Figure::new("errors", "Error against inputs", drawing).caption("Line: median. Band: quartiles.")
}

fn network(rng: &mut ChaCha8Rng) -> Figure {
    let on_ring = |radius: f64, turn: f64| {
        let (sin, cos) = libm::sincos(turn * core::f64::consts::TAU);
        Point::new(radius * cos, radius * sin)
    };
    let mut data = Vec::new();
    for _ in 0..600 {
        let (radius, turn) = (rng.random_range(0.85..1.15), rng.random_range(0.0..1.0));
        data.push(on_ring(
            if data.len() % 2 == 0 {
                2.0 * radius
            } else {
                radius
            },
            turn,
        ));
    }
    let mut graph = GraphPicture::new();
    for (radius, count) in [(1.0, 14_u32), (2.0, 26)] {
        let nodes: Vec<usize> = (0..count)
            .map(|i| {
                let at = on_ring(radius, f64::from(i) / f64::from(count));
                graph.node(GraphNode::at(at).series(Series(4)))
            })
            .collect();
        for i in 0..nodes.len() {
            let edge = GraphEdge::between(nodes[i], nodes[(i + 1) % nodes.len()]);
            graph.edge(edge.series(Series(4)));
        }
    }
    let mut chart = Chart::new(Axis::linear("x"), Axis::linear("y"))
        .equal()
        .sized(420.0, 420.0);
    chart.points(Points::new("inputs", Series(0), data));
    chart.graph(graph);
    let drawing = chart.drawing("Two rings of inputs, each covered by a ring of nodes.");
    Figure::new("network", "A network over its data", drawing)
}

fn sweep() -> Figure {
    let values: Vec<Vec<f64>> = (0..5)
        .map(|row| {
            (0..7)
                .map(|column| f64::from(30 + 9 * column + 4 * row - row * column))
                .collect()
        })
        .collect();
    let map = HeatMap {
        across: "insertion interval λ".into(),
        columns: (1..8).map(|i| (50 * i).to_string()).collect(),
        down: "age".into(),
        rows: (1..6).map(|i| (25 * i).to_string()).collect(),
        shade: Shade::of("success %", values.concat()),
        values,
        hatching: None,
    };
    Figure::new(
        "sweep",
        "A sweep over two parameters",
        map.drawing("Success grows to the lower right."),
    )
}

fn states(rng: &mut ChaCha8Rng) -> Figure {
    let mut tiles = Tiles::new(5);
    for state in 0..10_u32 {
        let mut scan = Scan::clear(Ring::full(72, 1.25));
        let open = [0.2, 0.45, 0.7].map(|at| (at * 72.0) as u32 + 3 * state);
        for (beam, range) in (0..).zip(&mut scan.ranges) {
            let near = open.iter().any(|&way| (beam + 72 - way % 72) % 72 < 10);
            *range = if near {
                1.25
            } else {
                rng.random_range(0.38..0.46)
            };
        }
        let mut plot = PolarPlot::new(1.25, 120.0);
        plot.scan(&scan, Series(state));
        tiles.tile(
            format!("state {state}"),
            plot.drawing("A scan that a state stands for."),
        );
    }
    Figure::new(
        "states",
        "Scans of ten states",
        tiles.drawing("Ten scans, each with three openings."),
    )
    .caption("The robot looks up; the ring is the laser's reach.")
}

fn faces() -> Result<Figure, Anything> {
    let mut tiles = Tiles::new(8);
    for i in 0..16_u32 {
        let pixels: Vec<u8> = (0..24 * 24_u32)
            .flat_map(|p| {
                let (x, y) = (p % 24, p / 24);
                [(x * 10) as u8, (y * 10) as u8, (i * 16 + (x ^ y)) as u8]
            })
            .collect();
        tiles.image(&format!("{i}"), &Image::rgb(24, 24, &pixels)?, 60.0);
    }
    let drawing = tiles.drawing("Sixteen images of 24 by 24 pixels.");
    Ok(Figure::new("images", "Images as tiles", drawing))
}
