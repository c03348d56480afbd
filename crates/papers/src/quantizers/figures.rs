//! Networks over their data, model scans, and errors over time.

use alloc::collections::BTreeMap;

use tolman_geom::Point;
use tolman_quantizers::{Network, Quantizer, UnitId};

use super::any::ROWS;
use super::shapes::ShapesRun;
use super::states::Mazes;
use super::{five, shapes, states};
use crate::plan::{model_scan, network_graph};
use tolman_draw::{
    Axis, Chart, Drawing, Figure, GraphNode, Line, LinePoint, NodeMark, Points, Series, Tiles,
};
use tolman_experiment::{BoxError, Easel, Record, Run};
use tolman_stats::{ConfidenceInterval, quantile};

/// Maximum number of data points in a picture.
const SHOWN: usize = 700;

/// Colour of data: the last one, which no cluster has.
const DOTS: u32 = Series::COLOURS - 1;

pub(super) fn of(mazes: &Mazes, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
    let first = |table: &str, row: &str| {
        let mut runs = runs.iter();
        runs.find(|run| run.is_of(table, row) && run.run == 0)
    };
    let mut figures = Vec::new();
    for (name, row) in [("states-j", "J 100"), ("states-large", "Large 20")] {
        if let Some(run) = first(states::NAME, row) {
            figures
                .extend(easel.draw(name, states::NAME, || Ok([model_scans(mazes, run, name)?]))?);
        }
    }
    for (name, table) in [
        ("five-clusters", five::NAME),
        ("five-clusters-in-turn", five::ONE_AFTER_ANOTHER),
    ] {
        for (suffix, row) in [("literal", five::LITERAL), ("chosen", five::CHOSEN)] {
            if let Some(run) = first(table, row) {
                let name = format!("{name}-{suffix}");
                figures.extend(easel.draw(&name, table, || Ok([layers(run, &name)?]))?);
            }
        }
    }
    figures.extend(easel.draw("networks", shapes::NAME, || {
        let firsts = ROWS.into_iter();
        networks(firsts.filter_map(|row| Some((row, first(shapes::NAME, row)?))))
    })?);
    figures.push(errors(runs)?);
    Ok(figures)
}

/// Returns the networks of runs, each with the name of its row.
fn networks<'a>(
    runs: impl Iterator<Item = (&'static str, &'a Run)>,
) -> Result<[Figure; 1], BoxError> {
    let mut networks = Tiles::new(2);
    for (row, run) in runs {
        let learned = shapes::learn(&run.job())?;
        let network = learned.quantizer.network();
        let caption = format!("{row}: {} units", network.len());
        networks.tile(caption, over_data(&learned.data, network));
    }
    let drawing = networks.drawing(
        "Networks of GNG, GNG-U, equilibrium GNG and SOINN over two rings and two squares.",
    );
    Ok([Figure::new("rings-and-squares", "Four networks of the same points", drawing)
        .caption("Run 0. Each cluster has a colour of its own until colours begin again; dots: some of the points.")
        .table(shapes::NAME)])
}

/// Returns every state of a run as a scan, with north up.
fn model_scans(mazes: &Mazes, run: &Run, name: &str) -> Result<Figure, BoxError> {
    let (gng, scans) = mazes.learn(&run.job())?;
    let network = gng.network();
    let mut won = BTreeMap::<UnitId, u32>::new();
    for scan in &scans {
        *won.entry(network.nearest(scan)?.id).or_default() += 1;
    }
    let mut tiles = Tiles::new(8);
    for (state, id) in (0_u32..).zip(network.ids()) {
        let scan = model_scan(network.prototype(id)?, 92.0, format!("State {state}."));
        let share = 100.0 * f64::from(won.get(&id).copied().unwrap_or(0)) / scans.len() as f64;
        tiles.tile(format!("{state}: {share:.1} %"), scan);
    }
    let row = &run.row;
    let title = format!("The states of {row}");
    let description = format!(
        "{} model scans of {row}, each as seen from the robot.",
        network.len()
    );
    Ok(Figure::new(name, title, tiles.drawing(description))
        .caption("Run 0, beam 0 (north) up; below, its number and the share of scans that are nearest to it.")
        .table(states::NAME))
}

/// Returns a figure of both layers of a SOINN over their data.
fn layers(run: &Run, name: &str) -> Result<Figure, BoxError> {
    let learned = five::learn(&run.job())?;
    let mut tiles = Tiles::new(2);
    for (layer, soinn) in [("first", &learned.first), ("second", &learned.second)] {
        let network = soinn.network();
        let clusters = network.clusters().count();
        let caption = format!(
            "{layer} layer: {} units, clusters: {clusters}",
            network.len()
        );
        tiles.tile(caption, over_data(&learned.data, network));
    }
    let row = &run.row;
    let title = format!("{row}, {}", run.table);
    let description = format!("The two layers of {row} over their data.");
    Ok(Figure::new(name, title, tiles.drawing(description))
        .caption(
            "Run 0. Each cluster has a colour of its own until colours begin again; dots: some of the points.",
        )
        .table(&run.table))
}

/// Returns a network in the plane over its data, each cluster in its own colour.
fn over_data(data: &[[f64; 2]], network: &Network<f64>) -> Drawing {
    let mut chart = Chart::new(
        Axis::linear("").between(0.0, 10.0),
        Axis::linear("").between(0.0, 10.0),
    )
    .sized(360.0, 360.0)
    .equal();
    let every = data.len().div_ceil(SHOWN).max(1);
    let points = data.iter().step_by(every);
    let points = points.map(|point| Point::new(point[0], point[1]));
    chart.points(Points::new("", Series(DOTS), points.collect()));
    let clusters = network.clusters();
    let node = |id| {
        let mut at = network.prototype(id).ok()?;
        let node = GraphNode::at(Point::new(at.next()?, at.next()?)).mark(NodeMark::Disc);
        Some(node.series(Series(clusters.label(id).ok()? % DOTS)))
    };
    chart.graph(network_graph(network, node).radius(2.6));
    chart.drawing(format!("{} units over their data.", network.len()))
}

/// Returns the error of each quantizer by the number of inputs.
fn errors(runs: &[Run]) -> Result<Figure, BoxError> {
    let mut chart = Chart::new(Axis::log("inputs"), Axis::log("RMS error"));
    for (series, row) in (0_u32..).zip(ROWS) {
        let of_row = ShapesRun::of_row(runs, shapes::NAME, row)?;
        let points = shapes::MARKS
            .into_iter()
            .enumerate()
            .filter_map(|(mark, inputs)| {
                let values: Vec<f64> = of_row.iter().map(|run| run.errors()[mark]).collect();
                let at = |share| quantile(&values, share).ok();
                let spread = ConfidenceInterval::new(at(0.0)?, at(1.0)?);
                Some(LinePoint::new(f64::from(inputs), at(0.5)?).spread(spread))
            });
        chart.line(Line::new(row, Series(series), points.collect()));
    }
    let drawing = chart.drawing("The error falls with the inputs, for each quantizer.");
    let figure = Figure::new("errors", "Error against inputs", drawing);
    let caption = "Median over runs; bands from the least to the largest.";
    Ok(figure.caption(caption).table(shapes::NAME))
}
