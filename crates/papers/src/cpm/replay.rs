//! Replays of trials: both episodes, and the map as it grew.

use alloc::collections::BTreeMap;

use tolman_geom::Pose;
use tolman_maps::cpm::{CpMap, FragmentId, JunctionId, MapUpdate, Sign};
use tolman_robot::Body;
use tolman_robot::epuck::BODY_RADIUS;

use super::real::Real;
use tolman_arena::course::Course;
use tolman_arena::cpm::{CpmTrial, Layout, SimulatedEpuck, slow_epuck};
use tolman_arena::drawing::cpm::{fragment_name, junction_name, middle_of};
use tolman_experiment::{BoxError, Job};
use tolman_replay::{
    Fact, MapEdge, MapGrowth, MapNode, Mark, Marks, Notes, Replay, RobotTrack, Scenery, TimeSeries,
};
use tolman_systems::cpm::{FragmentStep, Layer3, Walker};

/// Plays a trial again and returns its replay.
pub(super) fn of(trial: &CpmTrial<'_>, job: &Job<'_>) -> Result<Replay, BoxError> {
    let mut watch = Watch::new(trial.course);
    let record = trial.watch(|layer, walker, step| watch.see(layer, walker, step))?;
    let mut track = track(&record.path);
    let begun = record.second_from as u32;
    if record.second.is_some() {
        track.lifts = vec![begun];
        watch.arrivals.say(begun, "drives by the map");
    }
    let second = track.lifts.clone();
    track.marks = vec![Marks::new(Mark::Arrival, "second episode", second)];
    let outcome = if record.is_solved() {
        "solved"
    } else {
        "not solved"
    };
    Ok(watch
        .replay(trial.robot.step_us, job, track)
        .fact("outcome", outcome)
        .fact("fragments walked", record.traversals.to_string()))
}

/// Plays a round trip again and returns its replay: to the goal, back, and to the goal again.
pub(super) fn of_round_trip(real: &Real, job: &Job<'_>) -> Result<Replay, BoxError> {
    let mut watch = Watch::new(&real.course);
    let trip = real.play(job, |layer, walker, step| watch.see(layer, walker, step))?;
    let mut track = track(&trip.path);
    let names = [None, Some("way back"), Some("to the goal again")];
    for ((name, begun), _) in names.into_iter().zip(&trip.begun).zip(&trip.ways) {
        let mark = name.map(|name| Marks::new(Mark::Arrival, name, [*begun as u32]));
        track.marks.extend(mark);
    }
    Ok(watch
        .replay(slow_epuck().step_us, job, track)
        .fact("tried on the way", trip.tried.to_string())
        .fact("given up", trip.given_up.to_string()))
}

/// Returns the track of an e-puck with these poses.
fn track(path: &[Pose]) -> RobotTrack {
    let body = Body::Circle {
        radius: BODY_RADIUS,
    };
    RobotTrack::new("e-puck", body, path.to_vec())
}

/// Distance within which a node that moved is not redrawn, m.
const STILL: f64 = 1e-6;

/// Records the map at the end of each fragment.
struct Watch<'a> {
    course: &'a Course,
    nodes: Vec<MapNode>,
    /// Nodes of the present parts of the map, by part.
    live: BTreeMap<Part, usize>,
    edges: Vec<MapEdge>,
    joints: BTreeMap<(FragmentId, Sign), usize>,
    arrivals: Notes,
    fragments: TimeSeries,
}

/// A part of the map that has a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    Junction(JunctionId),
    Fragment(FragmentId),
}

impl<'a> Watch<'a> {
    fn new(course: &'a Course) -> Self {
        Self {
            course,
            nodes: Vec::new(),
            live: BTreeMap::new(),
            edges: Vec::new(),
            joints: BTreeMap::new(),
            arrivals: Notes::new("last fragment"),
            fragments: TimeSeries::new("fragments on the map", ""),
        }
    }

    /// Returns the replay of a track, with everything recorded on it.
    fn replay(self, step_us: u64, job: &Job<'_>, mut track: RobotTrack) -> Replay {
        let scenery = Scenery::of_world(&self.course.world);
        track.maps = vec![MapGrowth {
            name: "common-pattern map".to_owned(),
            nodes: self.nodes,
            edges: self.edges,
        }];
        track.notes = vec![self.arrivals];
        track.series = vec![self.fragments];
        let step_s = step_us as f64 * 1e-6;
        let title = format!("{}, run {}", job.row, job.run);
        Replay::new(title, step_s, scenery, vec![track])
            .fact("maze", &self.course.name)
            .fact("seed", job.seed.to_string())
    }

    fn see(&mut self, layer: &Layer3, walker: &Walker<SimulatedEpuck>, step: &FragmentStep) {
        let now = walker.body().path().len().saturating_sub(1) as u32;
        let word = match step.arrival {
            Some(arrival) => word_for(arrival),
            None => "turned back",
        };
        self.arrivals.say(now, word);
        let map = layer.map();
        let fragments = map.fragments().len() as f64;
        self.fragments.sample(now, fragments);
        self.update(map, now);
        let here = Part::Junction(layer.explorer.mapper.at().junction);
        if let Some(index) = self.live.get(&here) {
            self.nodes[*index].visits.push(now);
        }
    }

    /// Records the changes of the map.
    fn update(&mut self, map: &CpMap, now: u32) {
        let layout = Layout::of(map, &self.course.maze);
        let mut parts = Vec::new();
        for (id, junction) in map.junctions() {
            let cell = layout.place(id);
            parts.extend(cell.map(|cell| {
                let facts = vec![Fact::new("branches", junction.degree().to_string())];
                let at = self.course.world.cell_centre(cell);
                (Part::Junction(id), at, junction_name(map, id), facts)
            }));
        }
        for (id, fragment) in map.fragments() {
            let course = layout.fragments.get(&id);
            parts.extend(course.map(|course| {
                let facts = vec![
                    Fact::new("observations", fragment.patterns.len().to_string()),
                    Fact::new("walked", fragment.traversals.to_string()),
                ];
                let at = middle_of(&course.cells, &self.course.world);
                (Part::Fragment(id), at, fragment_name(id), facts)
            }));
        }
        let nodes = &mut self.nodes;
        self.live.retain(|part, index| {
            let stays = parts.iter().any(|(other, ..)| other == part);
            if !stays {
                nodes[*index].died = Some(now);
            }
            stays
        });
        for (part, at, label, facts) in parts {
            match self.live.get(&part) {
                Some(index) => self.nodes[*index].move_to(now, at, STILL),
                None => {
                    let id = self.nodes.len() as u32;
                    self.live.insert(part, self.nodes.len());
                    let mut node = MapNode::new(id, at, now);
                    node.label_from(now, &label);
                    self.nodes.push(node);
                }
            }
            if let Some(index) = self.live.get(&part) {
                self.nodes[*index].facts = facts;
            }
        }
        self.join(map, now);
    }

    /// Draws edges from each fragment to the junctions at its ends.
    fn join(&mut self, map: &CpMap, now: u32) {
        let mut wanted = BTreeMap::new();
        for (id, fragment) in map.fragments() {
            for sign in Sign::BOTH {
                let ends = [
                    Part::Fragment(id),
                    Part::Junction(fragment.port(sign).junction),
                ];
                if let [Some(a), Some(b)] = ends.map(|part| self.live.get(&part)) {
                    wanted.insert((id, sign), (*a as u32, *b as u32));
                }
            }
        }
        let edges = &mut self.edges;
        self.joints.retain(|joint, index| {
            let edge = &mut edges[*index];
            let stays = wanted.get(joint) == Some(&(edge.a, edge.b));
            if !stays {
                edge.died = Some(now);
            }
            stays
        });
        for ((fragment, sign), (a, b)) in wanted {
            if !self.joints.contains_key(&(fragment, sign)) {
                let mut edge = MapEdge::new(a, b, now);
                edge.label = sign.to_string();
                self.joints.insert((fragment, sign), self.edges.len());
                self.edges.push(edge);
            }
        }
    }
}

const fn word_for(arrival: MapUpdate) -> &'static str {
    match arrival {
        MapUpdate::New => "new",
        MapUpdate::Known => "known",
        MapUpdate::Duplicate => "a duplicate: a loop is closed",
        MapUpdate::Loop => "new, to a known place: a loop is closed",
        MapUpdate::Revised => "the map is revised",
        MapUpdate::Contradiction => "not what the map says",
    }
}
