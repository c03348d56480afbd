//! Replays of surveys: the robot's way, with the map beside it as it grows.

use alloc::collections::BTreeMap;
use alloc::sync::Arc;

use tolman_geom::{Point, PointBox};
use tolman_maps::diktiometry::{LinkId, LinkStatus, PlaceId};
use tolman_robot::Body;
use tolman_sim::robots::LaserPioneerConfig;

use tolman_arena::diktiometry::{Office, Survey, SurveyConfig, SurveyedMove};
use tolman_experiment::{BoxError, Job};
use tolman_replay::{
    Belief, BeliefAt, Fact, MapEdge, MapGrowth, MapNode, Notes, Replay, RobotTrack, Scenery, Shape,
    TimeSeries,
};
use tolman_systems::diktiometry::Reason;

/// Number of the simulator's time steps per step of the replay.
const COARSE: usize = 12;
/// Distance within which a node that moved is not redrawn, m: a quarter of a corridor's width. Most
/// moves shift most of the map a little. Viewers could not see that, but every replay would have to
/// store it.
const STILL: f64 = 0.3;

pub(super) fn of(
    office: &Arc<Office>,
    config: &SurveyConfig,
    job: &Job<'_>,
) -> Result<Replay, BoxError> {
    let mut survey = Survey::new(office, config.clone(), job.seed)?;
    let mut watch = Watch::new(&survey);
    for _ in 0..config.moves {
        let surveyed = survey.step()?;
        watch.see(&survey, &surveyed);
    }
    let robot = LaserPioneerConfig::noiseless();
    let body = Body::Circle {
        radius: robot.radius,
    };
    let path = survey.robot().path().iter();
    let poses = path.step_by(COARSE).copied().collect();
    let mut track = RobotTrack::new("robot", body, poses);
    track.maps = vec![watch.growth()];
    track.beliefs = vec![watch.belief];
    track.series = vec![watch.places, watch.error];
    track.notes = vec![watch.matcher, watch.reason];
    let scenery = Scenery::of_world(&office.course.world);
    let step_s = COARSE as f64 * robot.step_us as f64 * 1e-6;
    let score = survey.score();
    Ok(Replay::new(
        format!("{}, run {}", job.row, job.run),
        step_s,
        scenery,
        vec![track],
    )
    .fact("table", job.table)
    .fact("seed", job.seed.to_string())
    .fact("moves", config.moves.to_string())
    .fact(
        "places",
        format!("{} for {} true ones", score.places, score.visited),
    )
    .fact("purity", format!("{:.3}", score.purity)))
}

/// Records the map after each move.
#[derive(Debug)]
struct Watch {
    start: Point,
    home: PlaceId,
    nodes: BTreeMap<PlaceId, MapNode>,
    /// Edges by link and ends. Merging places gives a link other ends, and so another edge.
    edges: BTreeMap<(LinkId, PlaceId, PlaceId), MapEdge>,
    belief: Belief,
    places: TimeSeries,
    error: TimeSeries,
    matcher: Notes,
    reason: Notes,
}

impl Watch {
    fn new(survey: &Survey) -> Self {
        let mut watch = Self {
            start: survey.past().start,
            home: survey.observer().place(),
            nodes: BTreeMap::new(),
            edges: BTreeMap::new(),
            belief: Belief::new("where the robot may be"),
            places: TimeSeries::new("places", ""),
            error: TimeSeries::new("squared error", "m²"),
            matcher: Notes::new("match"),
            reason: Notes::new("why"),
        };
        watch.map(survey, 0);
        watch
    }

    fn see(&mut self, survey: &Survey, surveyed: &SurveyedMove) {
        let step = (survey.robot().path().len().saturating_sub(1) / COARSE) as u32;
        let best = surveyed.report.tracks.first();
        let before = best.and_then(|track| self.nodes.get(&track.from));
        let before = before.map(MapNode::latest);
        self.map(survey, step);
        let tracks = survey.observer().tracks().iter();
        let shapes = tracks.map(|track| Shape::Node {
            id: track.place.0,
            weight: track.confidence.clamp(0.0, 1.0),
        });
        let mut shapes: Vec<Shape> = shapes.collect();
        if let Some(before) = before {
            let PointBox { x, y } = surveyed.arrival.moved;
            shapes.push(Shape::Box {
                min: Point::new(before.x + x.low(), before.y + y.low()),
                max: Point::new(before.x + x.high(), before.y + y.high()),
                weight: 0.5,
            });
        }
        // Of several beliefs at one step the last counts.
        self.belief.entries.pop_if(|entry| entry.step >= step);
        self.belief.entries.push(BeliefAt { step, shapes });
        let places = survey.observer().map().paths.places().count();
        self.places.sample(step, places as f64);
        if let Some(error) = survey.errors().last() {
            self.error.sample(step, error.map);
        }
        let matcher = best.and_then(|track| track.matcher);
        let matcher = matcher.map_or("blocked".to_owned(), |matcher| format!("{matcher:?}"));
        self.matcher.say(step, matcher);
        let reason = match &surveyed.decision.reason {
            Reason::Walk => "random walk".to_owned(),
            Reason::Advice(advice) => format!("advice: {:?}", advice.kind),
            Reason::Script => "script".to_owned(),
        };
        self.reason.say(step, reason);
    }

    /// Records the changes of the map.
    fn map(&mut self, survey: &Survey, step: u32) {
        let map = survey.observer().map();
        for drawn in map.layout(self.home) {
            let position = self.start + drawn.bounds.middle().coords;
            let id = drawn.place;
            let node = self.nodes.entry(id);
            let node = node.or_insert_with(|| MapNode::new(id.0, position, step));
            node.move_to(step, position, STILL);
        }
        for (id, node) in &mut self.nodes {
            if node.died.is_none() && map.paths.resolve(*id) != Some(*id) {
                node.died = Some(step);
            }
        }
        if let Some(here) = self.nodes.get_mut(&survey.observer().place()) {
            here.visits.pop_if(|visit| *visit >= step);
            here.visits.push(step);
        }
        for (id, link) in map.paths.links() {
            let ends = [link.from, link.to];
            if ends.iter().all(|end| self.nodes.contains_key(end)) {
                let edge = || MapEdge::new(link.from.0, link.to.0, step);
                let key = (id, link.from, link.to);
                self.edges.entry(key).or_insert_with(edge);
            }
        }
        for ((id, from, to), edge) in &mut self.edges {
            let stands = map.paths.link(*id).is_some_and(|link| {
                link.standing == LinkStatus::Standing && link.from == *from && link.to == *to
            });
            if edge.died.is_none() && !stands {
                edge.died = Some(step);
            }
        }
    }

    fn growth(&self) -> MapGrowth {
        let mut nodes: Vec<MapNode> = self.nodes.values().cloned().collect();
        for node in &mut nodes {
            node.facts = vec![Fact::new("visits", node.visits.len().to_string())];
        }
        MapGrowth {
            name: "path graph".to_owned(),
            nodes,
            edges: self.edges.values().cloned().collect(),
        }
    }
}
