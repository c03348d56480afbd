//! Replays of any outing.

use alloc::collections::BTreeMap;

use tolman_arena::Outing;
use tolman_geom::Point;
use tolman_replay::{
    Belief, MapGrowth, MapNode, Mark, Marks, Notes, Replay, RobotTrack, Shape, TimeSeries,
};
use tolman_robot::{Position, VisitNaming};

use crate::growth::Growth;
use crate::scenery::scenery_of;

/// Number of actions after each of which the map is recorded. Later it is recorded less often.
const DENSE: u32 = 200;

/// Records an outing: the system's notes, its belief and its map after every action.
#[derive(Clone, Debug)]
pub struct Film {
    actions: u32,
    /// Number of actions between two records of the map.
    every: u32,
    thoughts: Notes,
    belief: Belief,
    growth: Growth,
    /// Number of poses of the path that were seen.
    seen: usize,
    places: TimeSeries,
    /// True position of the robot when the system first believed it was at a place, m.
    met: BTreeMap<u32, Point>,
    /// Where the system came to a place before it had a map.
    gathered: Vec<MapNode>,
    /// Steps before which the robot was lifted and put down elsewhere.
    lifts: Vec<u32>,
}

/// Knowledge of a system at one moment, in the world's frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Glimpse {
    /// Positions of the places of the system's map, m.
    pub places: Vec<Point>,
    /// Straight pieces of the ways between the places, m; each way is listed once.
    pub ways: Vec<[Point; 2]>,
    /// Believed positions, m, the most likely first.
    pub belief: Vec<Point>,
}

impl Film {
    /// Returns a film that begins before the first action.
    #[must_use]
    pub fn new(outing: &dyn Outing) -> Self {
        let mut film = Self {
            actions: 0,
            every: 1,
            thoughts: Notes::new("thinks"),
            belief: Belief::new("belief"),
            growth: Growth::new(outing),
            seen: 0,
            places: TimeSeries::new("places on the map", ""),
            met: BTreeMap::new(),
            gathered: Vec::new(),
            lifts: Vec::new(),
        };
        film.map(outing, 0);
        film
    }

    /// Records the map only after every `every`-th action, because some maps take long to draw.
    #[must_use]
    pub fn recording_every(mut self, every: u32) -> Self {
        self.every = every;
        self
    }

    /// Returns the number of places of the map when it was recorded last.
    #[must_use]
    pub fn place_count(&self) -> usize {
        let last = self.places.samples.last();
        last.map_or(0, |sample| sample.value as usize)
    }

    /// Returns the number of places or poses that the system considered possible after its last
    /// action.
    #[must_use]
    pub fn guess_count(&self) -> usize {
        let last = self.belief.entries.last();
        last.map_or(0, |entry| entry.shapes.len())
    }

    /// Records that the robot was lifted and put down elsewhere. Its next step is the first there.
    pub fn lifted(&mut self, outing: &dyn Outing) {
        self.lifts.push(outing.path().len() as u32);
        self.growth.lift();
    }

    /// Records the result of an action.
    pub fn see(&mut self, outing: &dyn Outing) {
        let step = outing.path().len().saturating_sub(1) as u32;
        self.actions += 1;
        let path = outing.path();
        for pose in path.get(self.seen..).into_iter().flatten() {
            self.growth.sweep(pose.position);
        }
        self.seen = path.len();
        self.meet(outing);
        let every = self.every.max(self.actions / DENSE).max(1);
        if self.actions.is_multiple_of(every) {
            self.map(outing, step);
        }
        let words = outing.words();
        // What it thought before does not stay when it thinks nothing any more.
        match words.is_empty() {
            false => self.thoughts.say(step, words),
            true if self.thoughts.notes.is_empty() => {}
            true => self.thoughts.say(step, "–"),
        }
        let belief = outing.belief();
        if belief.is_empty() && self.belief.entries.is_empty() {
            return;
        }
        let sites = outing.sites();
        let growth = &self.growth;
        let site = |id: u32| growth.site(id).or_else(|| sites.get(&id).copied());
        self.belief.note(step, &belief, site);
    }

    /// Records the robot's true position, if the system believes that it is at a place.
    fn meet(&mut self, outing: &dyn Outing) {
        let likeliest = outing.belief().into_iter().next();
        if let (Some(guess), Some(pose)) = (likeliest, outing.path().last())
            && let Position::Place(id) = guess.at
            && guess.weight > 0.5
        {
            self.met.entry(id).or_insert(pose.position);
        }
    }

    /// Records the changes of the map.
    fn map(&mut self, outing: &dyn Outing, step: u32) {
        let map = outing.map();
        self.places.sample(step, map.places.len() as f64);
        let (sites, met) = (outing.sites(), &self.met);
        // If the map has no positions, a place is shown where the robot was when the system first
        // believed that it was there.
        self.growth.see(step, &map, |place| {
            let site = sites.get(&place.id).copied();
            site.or(place.position)
                .or_else(|| met.get(&place.id).copied())
        });
        if map.places.is_empty() {
            self.gather(outing, step);
        } else {
            for node in &mut self.gathered {
                node.died.get_or_insert(step);
            }
        }
    }

    /// Records where the system came to a place for its map to be.
    fn gather(&mut self, outing: &dyn Outing, step: u32) {
        let is_named = outing.visit_naming() == VisitNaming::EachArrival;
        if let (true, Some(pose)) = (is_named, outing.path().last())
            && outing.visit_count() > self.gathered.len()
        {
            let number = self.gathered.len() as u32;
            self.gathered
                .push(MapNode::new(number, pose.position, step));
        }
    }

    /// Returns the knowledge of the system after its last action. O(map).
    #[must_use]
    pub fn glimpse(&self) -> Glimpse {
        let believed = self.belief.entries.last().map(|entry| &entry.shapes);
        let belief = believed
            .into_iter()
            .flatten()
            .filter_map(|shape| match shape {
                Shape::Point { position, .. } => Some(*position),
                _ => None,
            });
        Glimpse {
            ways: self.growth.ways(),
            belief: belief.collect(),
            places: self.growth.places(),
        }
    }

    /// Returns the replay of the recorded outing.
    #[must_use]
    pub fn replay(mut self, outing: &dyn Outing, title: String) -> Replay {
        let path = outing.path();
        let step = path.len().saturating_sub(1) as u32;
        self.map(outing, step);
        let robot = outing.robot();
        let mut track = RobotTrack::new(robot.name, robot.body, path.to_vec());
        track.ring = robot.ring;
        let scenery = scenery_of(outing.course(), &mut track);
        track.maps = vec![self.growth.recorded()];
        if !self.gathered.is_empty() {
            track.maps.push(MapGrowth {
                name: "records for the map".to_owned(),
                nodes: self.gathered,
                edges: Vec::new(),
            });
        }
        track.series.push(self.places);
        if !self.thoughts.notes.is_empty() {
            track.notes = vec![self.thoughts];
        }
        if !self.belief.entries.is_empty() {
            track.beliefs = vec![self.belief];
        }
        let bumped = outing.bumped().iter().copied();
        track.marks = vec![Marks::new(Mark::Bump, "bump", bumped)];
        // A system that localizes without a step is lifted only once.
        self.lifts.dedup();
        self.lifts
            .retain(|lift| (*lift as usize) < track.poses.len());
        if !self.lifts.is_empty() {
            let lifts = self.lifts.iter().copied();
            track
                .marks
                .push(Marks::new(Mark::Kidnapping, "put down", lifts));
        }
        track.lifts = self.lifts;
        let step_s = robot.step_us as f64 * 1e-6;
        Replay::new(title, step_s, scenery, vec![track]).fact("maze", &outing.course().name)
    }
}
