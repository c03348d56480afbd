use tolman_geom::Pose;
use tolman_robot::{Body, Ring};

use super::{Belief, Field, MapGrowth, Marks, Notes, Scenery, TimeSeries};

/// A run, or several in the same world side by side, ready to be played.
///
/// Time is counted in steps: step 0 is before the first time step, step *k* after the *k*-th.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Title, in a few words.
    pub title: String,
    /// Facts about the whole run: maze, brain, seed, outcome, the command that makes it again.
    pub facts: Vec<Fact>,
    /// The length of a time step, s; the speed 1× plays as many steps a second as there are in one.
    pub step_s: f64,
    /// The things that stand still.
    pub scenery: Scenery,
    /// The robots, one track each; they begin together.
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
            scenery,
            tracks,
            marks: Vec::new(),
        }
    }

    /// Returns this replay with a further fact.
    #[must_use]
    pub fn fact(mut self, name: impl Into<String>, value: impl Into<String>) -> Self {
        self.facts.push(Fact::new(name, value));
        self
    }

    /// Returns the last step: that of the longest track.
    #[must_use]
    pub fn steps(&self) -> usize {
        let steps = |track: &RobotTrack| track.poses.len().saturating_sub(1);
        self.tracks.iter().map(steps).max().unwrap_or(0)
    }
}

/// One thing to be known, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// Name: `seed`.
    pub name: String,
    /// Value: `7`.
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

/// One robot: where it was at every step, and what it knew.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotTrack {
    /// Name, if there are several: `Avoid`, `first.jsonl`.
    pub name: String,
    /// Its outline.
    pub body: Body,
    /// Its range sensor, whose beams the player casts on the walls, or `None` for a robot without.
    pub ring: Option<Ring>,
    /// Readings of the range sensor, for runs with unknown walls; then no beams are cast.
    pub scans: Option<Scans>,
    /// Poses from step 0 on.
    pub poses: Vec<Pose>,
    /// Steps that did not lead on from the step before: the robot was lifted. Ascending.
    pub lifts: Vec<u32>,
    /// Maps that it learned.
    pub maps: Vec<MapGrowth>,
    /// Believed positions.
    pub beliefs: Vec<Belief>,
    /// Numbers over the cells of a grid: distances to the goal, chances of a wall.
    pub fields: Vec<Field>,
    /// Numbers over time.
    pub series: Vec<TimeSeries>,
    /// Words over time.
    pub notes: Vec<Notes>,
    /// Events by step.
    pub marks: Vec<Marks>,
}

impl RobotTrack {
    /// Returns a track of poses alone.
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
}

/// Recorded readings of a range sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Scans {
    /// Geometry of the beams.
    pub ring: Ring,
    /// The step of each reading, ascending. A reading holds until the next one.
    pub steps: Vec<u32>,
    /// The ranges of each reading, m; `ring.beams` of them.
    pub ranges: Vec<Vec<f64>>,
}
