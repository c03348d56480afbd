//! The states of Phase I, the graph of Phase II over its maze, and where the runs of Phase III went.

use tolman_geom::Point;
use tolman_maps::mslst_graph::{DUMMY, Node};

use super::Mslst;
use super::contest::{Apprentice, Contest};
use crate::agents::mslst::Learned;
use crate::agents::mslst::drawing::{self, SHOWN_ACTIONS};
use crate::draw::{Figure, Plan, Series};
use crate::experiment::{BoxError, Run};

/// How many runs one plan shows at most.
const SHOWN: usize = 25;

/// Width of a plan, user units.
const WIDTH: f64 = 420.0;

pub(super) fn of(experiment: &Mslst, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
    let mut figures = Vec::new();
    for (number, contest) in (1_u32..).zip(&experiment.contests) {
        for (place, apprentice) in (1_u32..).zip(&contest.apprentices) {
            let learned = apprentice.learned(contest, &experiment.robot, 0)?;
            let at = format!("{number}-{place}");
            figures.push(states(contest, apprentice, &learned, &at));
            figures.push(graph(contest, apprentice, &learned, &at));
            let of_row = |run: &&Run| run.table == contest.venue.table && run.row == apprentice.row;
            let runs: Vec<&Run> = runs.iter().filter(of_row).take(SHOWN).collect();
            figures.push(ways(experiment, contest, apprentice, &runs, &at)?);
        }
    }
    Ok(figures)
}

/// The paper's figure 3: every model scan, north upwards, with the nodes that have it.
fn states(contest: &Contest, apprentice: &Apprentice, learned: &Learned, at: &str) -> Figure {
    let name = &contest.venue.course.name;
    Figure::new(
        format!("states-{at}"),
        format!("{} in {name}: states of map 0", apprentice.row),
        drawing::states(learned),
    )
    .caption("Model scans of the equilibrium GNG, north upwards, each with the nodes that bear it.")
    .table(&contest.venue.table)
}

/// The paper's figure 4, over the maze: each node where the robot truly was when it was made.
fn graph(contest: &Contest, apprentice: &Apprentice, learned: &Learned, at: &str) -> Figure {
    let name = &contest.venue.course.name;
    let nodes = learned.map.graph.nodes();
    let linear = nodes.iter().filter(|node| ways_from(node) <= 2).count();
    let percent = 100.0 * linear as f64 / nodes.len() as f64;
    Figure::new(
        format!("graph-{at}"),
        format!("{} in {name}: graph of map 0", apprentice.row),
        drawing::graph_over_maze(&contest.venue.course, learned),
    )
    .caption(format!(
        "The nodes of the first {SHOWN_ACTIONS} actions where the robot truly was when it made them; those in the \
         destination are filled. Of all {} nodes {percent:.0} % have no more than two ways on: the graph is highly \
         linear, as the paper found.",
        nodes.len()
    ))
    .table(&contest.venue.table)
}

/// How many edges lead to other nodes.
fn ways_from(node: &Node) -> usize {
    node.edges.iter().filter(|edge| edge.head != DUMMY).count()
}

/// Where the first runs went.
fn ways(
    experiment: &Mslst,
    contest: &Contest,
    apprentice: &Apprentice,
    runs: &[&Run],
    at: &str,
) -> Result<Figure, BoxError> {
    let mut plan = Plan::of_course(&contest.venue.course, WIDTH);
    for run in runs {
        let (episode, _) = contest.episode(&run.job(), &experiment.robot)?;
        let positions: Vec<Point> = episode.path.iter().map(|pose| pose.position).collect();
        plan.faint_trajectory(&positions, Series(0));
    }
    let name = &contest.venue.course.name;
    let drawing = plan.drawing(format!("Plan of {name}: the ways of {} runs.", runs.len()));
    Ok(Figure::new(
        format!("ways-{at}"),
        format!("{} in {name}", apprentice.row),
        drawing,
    )
    .caption(format!(
        "The ways of {} runs, each by another map.",
        runs.len()
    ))
    .table(&contest.venue.table))
}
