//! The states of Phase I, the graph of Phase II over its maze, and the ways of Phase III.

use tolman_geom::Point;
use tolman_maps::mslst_graph::Node;

use super::Mslst;
use super::contest::Contest;
use crate::plan::model_scan;
use crate::venue::MazeRun;
use tolman_arena::drawing::mslst::{SHOWN_ACTIONS, graph_over_maze};
use tolman_arena::drawing::plan_of_course;
use tolman_draw::{Axis, Chart, Drawing, Figure, Line, LinePoint, Series, Tiles};
use tolman_experiment::{BoxError, Easel, Run};
use tolman_stats::wilson_interval;
use tolman_systems::mslst::Learned;

/// Maximum number of runs on one plan.
const SHOWN: usize = 25;

/// Width of a plan, user units.
pub(super) const WIDTH: f64 = 420.0;

pub(super) fn of(
    experiment: &Mslst,
    runs: &[Run],
    easel: &Easel<'_>,
) -> Result<Vec<Figure>, BoxError> {
    let mut figures = Vec::new();
    for (number, contest) in (1_u32..).zip(&experiment.contests) {
        let table = &contest.venue.table;
        for (place, competitor) in (1..).zip(contest.faithful()) {
            let at = format!("{number}-{place}");
            let of_row = |run: &&Run| run.is_of(table, &competitor.row);
            let shown: Vec<&Run> = runs.iter().filter(of_row).take(SHOWN).collect();
            let here = format!("{} in {}", competitor.row, contest.venue.course.name);
            figures.extend(easel.draw(&format!("map {at}"), table, || {
                let learned = competitor.first_map(&contest.venue)?;
                let learned = learned.ok_or("no map was learned")?;
                Ok([
                    states(learned, &at, &here),
                    graph(contest, learned, &at, &here),
                ])
            })?);
            figures.extend(easel.draw(&format!("ways {at}"), table, || {
                Ok([ways(contest, &shown, &at, &here)?])
            })?);
        }
        figures.extend(between_maps(contest, runs, number)?);
    }
    if let Some(hardest) = &experiment.hardest {
        figures.extend(hardest.figures(runs, easel)?);
    }
    Ok(figures)
}

/// Returns the paper's figure 3: every model scan, with north up, and its nodes.
fn states(learned: &Learned, at: &str, here: &str) -> Figure {
    let title = format!("{here}: states of map 0");
    Figure::new(format!("states-{at}"), title, model_scans(learned)).caption(
        "Model scans of the equilibrium GNG, north upwards, each with the nodes that bear it.",
    )
}

/// Returns the paper's figure 4, over the maze: each node at the robot's true position when it was
/// made.
fn graph(contest: &Contest, learned: &Learned, at: &str, here: &str) -> Figure {
    let nodes = learned.map.graph.nodes();
    let linear = nodes.iter().filter(|node| ways_from(node) <= 2).count();
    let percent = 100.0 * linear as f64 / nodes.len() as f64;
    Figure::new(
        format!("graph-{at}"),
        format!("{here}: graph of map 0"),
        graph_over_maze(&contest.venue.course, learned),
    )
    .caption(format!(
        "The nodes of the first {SHOWN_ACTIONS} actions at the robot's true positions when they were \
         made. Those in the destination are filled. Of all {} nodes {percent:.0} % have no more than \
         two ways on: the graph is highly linear, as the paper found.",
        nodes.len()
    ))
}

/// Returns the number of edges that lead to other nodes.
fn ways_from(node: &Node) -> usize {
    node.edges.iter().filter(|edge| edge.head.is_some()).count()
}

/// Minimum number of runs by a map for its success to be drawn.
const LEAST_RUNS: u64 = 5;

/// Returns the figure of success by map; `None` if the maps have too few runs.
fn between_maps(contest: &Contest, runs: &[Run], number: u32) -> Result<Option<Figure>, BoxError> {
    let ranks = Axis::linear("maps, from the worst to the best");
    let mut chart = Chart::new(
        ranks,
        Axis::linear("runs that arrive, %").between(0.0, 100.0),
    );
    let mut drawn = 0;
    for (index, competitor) in (0_u32..).zip(contest.learners()) {
        let mut maps = vec![(0_u64, 0_u64); contest.maps as usize];
        let of_row = |run: &&Run| run.is_of(&contest.venue.table, &competitor.row);
        for run in runs.iter().filter(of_row) {
            let (arrived, all) = &mut maps[(run.run % contest.maps) as usize];
            *arrived += u64::from(run.record::<MazeRun>()?.reached);
            *all += 1;
        }
        maps.retain(|(_, all)| *all >= LEAST_RUNS);
        maps.sort_by(|a, b| (a.0 * b.1).cmp(&(b.0 * a.1)));
        let mut points = Vec::new();
        for (rank, (arrived, all)) in (1_u32..).zip(maps) {
            let percent = 100.0 * arrived as f64 / all as f64;
            let spread = wilson_interval(arrived, all, 0.95)?.scaled(100.0);
            points.push(LinePoint::new(f64::from(rank), percent).spread(spread));
        }
        if points.len() > 1 {
            drawn += 1;
            chart.line(Line::new(&competitor.row, Series(index), points));
        }
    }
    let name = &contest.venue.course.name;
    let figure = || {
        Figure::new(
            format!("maps-{number}"),
            format!("MSLST in {name}: the spread between maps"),
            chart.drawing(format!("Success in {name} by map, from the worst map to the best.")),
        )
        .caption("Each map with the 95 % interval (Wilson) that its runs allow. Equal maps would make a line that stays inside.")
        .table(&contest.venue.table)
    };
    Ok((drawn > 0).then(figure))
}

/// Returns the ways of the first runs.
fn ways(contest: &Contest, runs: &[&Run], at: &str, here: &str) -> Result<Figure, BoxError> {
    let mut plan = plan_of_course(&contest.venue.course, WIDTH);
    for run in runs {
        let (episode, _) = contest.episode(&run.job())?;
        let positions: Vec<Point> = episode.path.iter().map(|pose| pose.position).collect();
        plan.faint_trajectory(&positions, Series(0));
    }
    let name = &contest.venue.course.name;
    let drawing = plan.drawing(format!("Plan of {name}: the ways of {} runs.", runs.len()));
    let caption = match contest.maps {
        1 => format!("The ways of {} runs by one map.", runs.len()),
        _ => format!("The ways of {} runs, each by another map.", runs.len()),
    };
    Ok(Figure::new(format!("ways-{at}"), here, drawing).caption(caption))
}

/// Returns the paper's figure 3: every model scan, with north up, and the number of its nodes.
fn model_scans(learned: &Learned) -> Drawing {
    let mut tiles = Tiles::new(6);
    for (state, model) in (0_u32..).zip(learned.map.states.models()) {
        let nodes = learned.map.graph.nodes().iter();
        let count = nodes.filter(|node| node.state == state).count();
        let drawing = model_scan(model.iter().copied(), 96.0, format!("Model scan {state}."));
        tiles.tile(format!("{state}: {count} nodes"), drawing);
    }
    let count = learned.map.states.models().len();
    tiles.drawing(format!("The {count} states of a map."))
}
