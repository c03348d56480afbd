use tolman_geom::Pose;
use tolman_robot::{Body, Ring};

use super::{Belief, Field, MapGrowth, MapNode, Marks, Notes, Scenery, TimeSeries};

/// One or several runs in the same world, ready to be played side by side.
///
/// Time is counted in steps: step 0 is before the first time step, step *k* after the *k*-th.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Title, in a few words.
    pub title: String,
    /// Facts about the whole run: maze, brain, seed, outcome, and the command that repeats it.
    pub facts: Vec<Fact>,
    /// Length of a time step, s. At speed 1×, a second of the run takes a second.
    pub step_s: f64,
    /// Stretches with captions, ascending by their first steps; empty for a run without a story.
    pub chapters: Vec<Chapter>,
    /// Walls, zones and doors of the world.
    pub scenery: Scenery,
    /// Robots, one track each. All tracks begin at step 0.
    pub tracks: Vec<RobotTrack>,
    /// Steps that concern all tracks, such as the first at which they differ.
    pub marks: Vec<Marks>,
}

impl Replay {
    /// Returns a replay without facts and marks.
    #[must_use]
    pub fn new(
        title: impl Into<String>,
        step_s: f64,
        scenery: Scenery,
        tracks: Vec<RobotTrack>,
    ) -> Self {
        Self {
            title: title.into(),
            facts: Vec::new(),
            step_s,
            chapters: Vec::new(),
            scenery,
            tracks,
            marks: Vec::new(),
        }
    }

    /// Adds a fact and returns the replay.
    #[must_use]
    pub fn fact(mut self, name: impl Into<String>, value: impl Into<String>) -> Self {
        self.facts.push(Fact::new(name, value));
        self
    }

    /// Returns the last step of the longest track.
    #[must_use]
    pub fn steps(&self) -> usize {
        let steps = |track: &RobotTrack| track.poses.len().saturating_sub(1);
        self.tracks.iter().map(steps).max().unwrap_or(0)
    }

    /// Returns the time of a step since step 0, ns.
    #[must_use]
    pub fn nanos(&self, step: u32) -> u64 {
        (f64::from(step) * self.step_s * 1e9).round() as u64
    }
}

/// A stretch of a replay with a caption.
#[derive(Clone, Debug, PartialEq)]
pub struct Chapter {
    /// First step of the chapter.
    pub from: u32,
    /// Caption of the chapter.
    pub caption: String,
    /// Duration of the chapter in an animation, s.
    pub seconds: f64,
}

/// A fact about a run, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// Name of the fact, such as `seed`.
    pub name: String,
    /// Value of the fact, such as `7`.
    pub value: String,
}

impl Fact {
    /// Returns a fact.
    pub fn new(name: impl Into<String>, value: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            value: value.into(),
        }
    }
}

/// A robot: its pose at every step, and its knowledge.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotTrack {
    /// Name of the robot, such as `Avoid` or `first.jsonl`, if there are several.
    pub name: String,
    /// Outline of the robot.
    pub body: Body,
    /// Range sensor, whose beams the player casts on the walls; `None` for a robot without one.
    pub ring: Option<Ring>,
    /// Readings of the range sensor, for runs with unknown walls. If given, no beams are cast.
    pub scans: Option<Scans>,
    /// Poses of the robot, from step 0 on.
    pub poses: Vec<Pose>,
    /// Steps whose pose does not follow from the step before, because the robot was lifted;
    /// ascending.
    pub lifts: Vec<u32>,
    /// Maps that the robot learned.
    pub maps: Vec<MapGrowth>,
    /// Believed positions of the robot, by layer.
    pub beliefs: Vec<Belief>,
    /// Numbers over the cells of a grid, such as distances to the goal or probabilities of a wall.
    pub fields: Vec<Field>,
    /// Numbers over time, such as the coverage.
    pub series: Vec<TimeSeries>,
    /// Words over time, such as the present action.
    pub notes: Vec<Notes>,
    /// Events, such as bumps, marked on the slider.
    pub marks: Vec<Marks>,
}

impl RobotTrack {
    /// Returns a track that has only poses.
    #[must_use]
    pub fn new(name: impl Into<String>, body: Body, poses: Vec<Pose>) -> Self {
        Self {
            name: name.into(),
            body,
            ring: None,
            scans: None,
            poses,
            lifts: Vec::new(),
            maps: Vec::new(),
            beliefs: Vec::new(),
            fields: Vec::new(),
            series: Vec::new(),
            notes: Vec::new(),
            marks: Vec::new(),
        }
    }

    /// Returns the node of this id, of any map.
    pub(super) fn node(&self, id: u32) -> Option<&MapNode> {
        let mut nodes = self.maps.iter().flat_map(|map| &map.nodes);
        nodes.find(|node| node.id == id)
    }
}

/// Recorded readings of a range sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Scans {
    /// Geometry of the beams.
    pub ring: Ring,
    /// Step of each reading, ascending. A reading holds until the next one.
    pub steps: Vec<u32>,
    /// Ranges of each reading, m; `ring.beams` of them.
    pub ranges: Vec<Vec<f64>>,
}
