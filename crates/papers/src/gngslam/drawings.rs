//! Maps with each node's image at its place, like figures 4.3, A.1 and A.2.

use tolman_arena::gngslam::{CellGrid, FieldFromMap, Goals};
use tolman_draw::{
    Axis, Chart, Drawing, Figure, GraphNode, GraphPicture, Image, NodeMark, Series, Tiles,
};
use tolman_experiment::{BoxError, Run};
use tolman_geom::Point;
use tolman_maps::place_map::PlaceMap;
use tolman_quantizers::UnitId;
use tolman_robot::Picture;

use super::MapRun;
use super::search_space::{COUNT, LAMBDA, Parameters, WINNER_RATE};
use super::searches::Searches;
use super::sets::{Setting, TABLE, settings};
use crate::plan::network_graph;

/// Values of the appendix that differ from the best parameters: the middle of "200 and 250", and
/// 0.052.
const MORE_NODES: f64 = 225.0;
const SLOW: f64 = 0.052;

/// Rows of figure 4.3, from 0. The text calls the second one set 5, the caption set 6.
const SHOWN: [usize; 2] = [0, 5];

/// Maximum number of maps tried for a figure until one can be turned.
const TRIED: usize = 40;

/// Maximum number of nodes of a map that is shown. With more, no image can be made out.
const MOST_NODES: usize = 40;

/// Width of a map and of a node's image, user units.
const WIDTH: f64 = 460.0;
const IMAGE: f64 = 76.0;

/// The settings of the best map of a row with at most [`MOST_NODES`] nodes, from which it can be
/// learned again.
struct Best {
    setting: Setting,
    parameters: Parameters,
    seed: u64,
    /// Description of the map for its caption.
    said: String,
}

impl Searches {
    /// Returns the maps of the best runs. A row in which no map has a score is left out.
    pub(super) fn drawings(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        let mut figures = vec![self.best_maps(runs)?];
        let setting = settings()[SHOWN[1]];
        let seeds: Vec<u64> = of_row(runs, &setting)
            .map(|run| run.seed)
            .take(TRIED)
            .collect();
        if let Some(best) = Best::of(runs, setting)? {
            for (name, title, which, value) in [
                (
                    "figure-a-1",
                    "Set 6 with more nodes: λ = 225",
                    LAMBDA,
                    MORE_NODES,
                ),
                (
                    "figure-a-2",
                    "Set 6 learned slowly: ε_b = 0.052",
                    WINNER_RATE,
                    SLOW,
                ),
            ] {
                let parameters = best.parameters.with(which, value);
                let drawn = seeds
                    .iter()
                    .map(|seed| self.drawing(&setting, &parameters, *seed));
                if let Some(drawing) = drawn.filter_map(Result::transpose).next().transpose()? {
                    let caption = format!("{READ} Otherwise it has the parameters of that map.");
                    let figure = Figure::new(name, title, drawing);
                    figures.push(figure.caption(caption).table(TABLE));
                }
            }
        }
        Ok(figures)
    }

    /// Returns figure 4.3.
    fn best_maps(&self, runs: &[Run]) -> Result<Figure, BoxError> {
        let mut tiles = Tiles::new(2);
        let mut caption = READ.to_owned();
        for place in SHOWN {
            let Some(best) = Best::of(runs, settings()[place])? else {
                continue;
            };
            let name = format!("set {}: {}", place + 1, best.setting.row);
            caption += &format!(" {name}: {}.", best.said);
            if let Some(drawing) = self.drawing(&best.setting, &best.parameters, best.seed)? {
                tiles.tile(name, drawing);
            }
        }
        let drawing =
            tiles.drawing("The best maps of sets 1 and 6, each node's image at its place.");
        let figure = Figure::new("figure-4-3", "The best maps of sets 1 and 6", drawing);
        Ok(figure.caption(caption).table(TABLE))
    }

    /// Learns a map and draws it; `None` for a useless map.
    fn drawing(
        &self,
        setting: &Setting,
        parameters: &Parameters,
        seed: u64,
    ) -> Result<Option<Drawing>, BoxError> {
        let map = self.learn(setting, parameters, seed)?;
        let places = self.places(setting);
        let table = places.table(setting.set.image())?;
        let scorer = places.scorer(setting.stretch)?;
        let Some(field_from_map) = scorer.field_from_map(&map, &table)? else {
            return Ok(None);
        };
        let goals = scorer.goals(&map, &table)?;
        drawn(&map, &field_from_map, goals).map(Some)
    }
}

/// Returns the runs of a row.
fn of_row<'a>(runs: &'a [Run], setting: &Setting) -> impl Iterator<Item = &'a Run> {
    let (table, row) = (setting.table, setting.row);
    runs.iter().filter(move |run| run.is_of(table, row))
}

impl Best {
    fn of(runs: &[Run], setting: Setting) -> Result<Option<Self>, BoxError> {
        let mut best: Option<(f64, Self)> = None;
        for run in of_row(runs, &setting) {
            let map: MapRun = run.record()?;
            let parameters: Result<[f64; COUNT], _> = map.parameters.try_into();
            let is_small = map.nodes.is_some_and(|nodes| nodes <= MOST_NODES);
            if let (true, Some(score), Ok(parameters)) = (is_small, map.score, parameters)
                && best.as_ref().is_none_or(|(most, _)| score > *most)
            {
                let mirrored = match map.mirrored {
                    Some(true) => "a mirror image of the pitch",
                    _ => "not mirrored",
                };
                let found = Self {
                    setting,
                    parameters: Parameters(parameters),
                    seed: run.seed,
                    said: format!("score {score:.3}, {mirrored}"),
                };
                best = Some((score, found));
            }
        }
        Ok(best.map(|(_, best)| best))
    }
}

/// Caption that explains the maps.
const READ: &str = "Each node's image has its middle at the node, in cells, turned so that the yellow goal is straight \
 above the blue one. Lines are links. On the pitch the windows are on the right. Images were \
 converted to red, green and blue. Shown is each set's best map of at most 40 nodes, so that the \
 images can be made out.";

/// Returns an axis over the field, with room for the images and the names of the goals.
fn axis(title: &str) -> Axis {
    Axis::linear(title).between(-0.5, 9.5)
}

/// Turns the pitch as the paper draws it: the yellow goal, in the west, is up, and the windows are
/// on the right.
fn upright(at: Point) -> Point {
    Point::new(at.y, f64::from(CellGrid::SIDE) - at.x)
}

/// Returns the picture of a map, with its blue and its yellow goal.
fn drawn(
    map: &PlaceMap,
    field_from_map: &FieldFromMap,
    goals: Goals<UnitId>,
) -> Result<Drawing, BoxError> {
    let mut chart = Chart::new(axis("x, cells"), axis("y, cells"))
        .sized(WIDTH, WIDTH)
        .equal();
    let place = |node| Some(upright(field_from_map.transform(map.position(node)?)));
    let nodes: Vec<(UnitId, Point)> = map
        .network()
        .ids()
        .filter_map(|node| Some((node, place(node)?)))
        .collect();
    chart.graph(network_graph(map.network(), |node| {
        Some(GraphNode::at(place(node)?).series(Series(2)))
    }));
    // With many nodes the images are smaller.
    let width = IMAGE.min(IMAGE * libm::sqrt(10.0 / nodes.len().max(1) as f64));
    for (node, at) in &nodes {
        if let Some(picture) = map.picture(*node) {
            chart.image(*at, image(&picture)?, width, format!("node {node}"));
        }
    }
    let mut marks = GraphPicture::new().radius(5.0);
    for (label, series, goal) in [
        ("blue goal", 0, goals.blue),
        ("yellow goal", 1, goals.yellow),
    ] {
        if let Some(at) = place(goal) {
            let node = GraphNode::at(at).series(Series(series)).label(label);
            marks.node(node.mark(NodeMark::Square));
        }
    }
    chart.graph(marks);
    Ok(chart.drawing(format!("{} nodes with their images.", nodes.len())))
}

fn image(picture: &Picture) -> Result<Image, BoxError> {
    let pixels: Vec<u8> = picture.pixels.iter().flatten().copied().collect();
    Ok(Image::rgb(picture.width, picture.height, &pixels)?)
}
