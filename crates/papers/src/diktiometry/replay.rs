//! Replays of surveys: the robot's way, with the map beside it as it grows.

use alloc::collections::BTreeMap;
use alloc::sync::Arc;

use tolman_geom::{Point, PointBox};
use tolman_maps::diktiometry::{LinkId, LinkStatus, Observer, PlaceId};
use tolman_robot::Body;
use tolman_sim::robots::LaserPioneerConfig;

use tolman_arena::diktiometry::{Office, Survey, SurveyConfig};
use tolman_experiment::{BoxError, Job};
use tolman_replay::{
    Belief, BeliefAt, Fact, MapEdge, MapGrowth, MapNode, Notes, Replay, RobotTrack, Scenery, Shape,
    TimeSeries,
};
use tolman_systems::diktiometry::{MappedMove, Reason};

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
    let mut watch = Watch::new();
    let survey = Survey::run(office, config.clone(), job.seed, |survey, moved| {
        if let Some(observer) = survey.observer() {
            watch.see(survey, observer, moved);
        }
        Ok(())
    })?;
    let robot = LaserPioneerConfig::noiseless();
    let body = Body::Circle {
        radius: robot.radius,
    };
    let path = survey.path().iter();
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
    fn new() -> Self {
        Self {
            nodes: BTreeMap::new(),
            edges: BTreeMap::new(),
            belief: Belief::new("where the robot may be"),
            places: TimeSeries::new("places", ""),
            error: TimeSeries::new("squared error", "m²"),
            matcher: Notes::new("match"),
            reason: Notes::new("why"),
        }
    }

    fn see(&mut self, survey: &Survey, observer: &Observer, moved: &MappedMove) {
        let step = (survey.path().len().saturating_sub(1) / COARSE) as u32;
        let best = moved.report.tracks.first();
        let before = best.and_then(|track| self.nodes.get(&track.from));
        let before = before.map(MapNode::latest);
        self.map(observer, survey.path()[0].position, step);
        let tracks = observer.tracks().iter();
        let shapes = tracks.map(|track| Shape::Node {
            id: track.place.0,
            weight: track.confidence.clamp(0.0, 1.0),
        });
        let mut shapes: Vec<Shape> = shapes.collect();
        if let Some(before) = before {
            let PointBox { x, y } = moved.arrival.moved;
            shapes.push(Shape::Box {
                min: Point::new(before.x + x.low(), before.y + y.low()),
                max: Point::new(before.x + x.high(), before.y + y.high()),
                weight: 0.5,
            });
        }
        // Of several beliefs at one step the last counts.
        self.belief.entries.pop_if(|entry| entry.step >= step);
        self.belief.entries.push(BeliefAt { step, shapes });
        let places = observer.map().paths.places().count();
        self.places.sample(step, places as f64);
        if let Some(error) = survey.errors().last() {
            self.error.sample(step, error.map);
        }
        let matcher = best.and_then(|track| track.matcher);
        let matcher = matcher.map_or("blocked".to_owned(), |matcher| format!("{matcher:?}"));
        self.matcher.say(step, matcher);
        if let Some(reason) = &moved.reason {
            let reason = match reason {
                Reason::Walk => "random walk".to_owned(),
                Reason::Advice(advice) => format!("advice: {:?}", advice.kind),
                Reason::Script => "script".to_owned(),
            };
            self.reason.say(step, reason);
        }
    }

    /// Records the changes of the map, whose first place lies at `start`.
    fn map(&mut self, observer: &Observer, start: Point, step: u32) {
        let map = observer.map();
        for drawn in map.layout(PlaceId(0)) {
            let position = start + drawn.bounds.middle().coords;
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
        if let Some(here) = self.nodes.get_mut(&observer.place()) {
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
