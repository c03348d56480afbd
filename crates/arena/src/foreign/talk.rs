//! The lines between the arena and a program that drives or watches a robot.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use core::mem;
use core::time::Duration;

use alloc::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use serde_json::Value;
use tolman_geom::Point;
use tolman_robot::{Guess, Landmark, MapView, Position, Task};

use super::brain::{BrainError, Hello};
use super::{Budget, ForeignProgram, Launch, LaunchError, Left, NamedTask, Overrun};
use crate::named_map::{NamedError, NamedGuess, NamedMap};

/// Version of the protocol.
const PROTOCOL: u32 = 1;

/// Time within which a program that has closed its stdout must end.
const GRACE: Duration = Duration::from_secs(5);

/// Weight above which a guess is likelier than all others together.
const EVEN: f64 = 0.5;

/// Maximum length of a line quoted in an error, characters.
const QUOTED: usize = 80;

/// A dialogue with a program, and what the program has said of its map.
#[derive(Debug)]
pub(super) struct Talk {
    /// The running program; `None` once it has ended.
    program: Option<ForeignProgram>,
    hello: Hello,
    has_begun: bool,
    /// Number of time steps so far.
    pub(super) steps: u32,
    /// Whether the program is asked for its map and its belief.
    is_asked: bool,
    /// Task of the last line.
    task: Option<Task>,
    /// Whether the robot was put down since the last line.
    is_put_down: bool,
    /// Reason why the program is heard no more; `None` while it is.
    pub(super) failed: Option<String>,
    /// Position by the program before the first time step of learning and after each.
    trail: Vec<Option<Position>>,
    /// Whether the program has learned since it gave its map.
    is_stale: bool,
    pub(super) map: MapView,
    /// Ids of the map's places.
    ids: BTreeSet<u32>,
    pub(super) belief: Vec<Guess>,
    pub(super) verdict: NamedVerdict,
}

/// A program's verdict on its map.
#[derive(Clone, Debug, Default, Deserialize)]
pub(super) struct NamedVerdict {
    /// Probability that the map is right.
    pub(super) certainty: Option<f64>,
    /// Reason to doubt it.
    pub(super) doubt: Option<String>,
}

/// What a program may be asked for.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Answers {
    #[serde(default)]
    belief: Vec<NamedGuess>,
    #[serde(default)]
    map: Option<NamedMap>,
    #[serde(default)]
    verdict: NamedVerdict,
}

/// Line after a time step.
#[derive(Serialize)]
struct StepLine<'a, S> {
    step: u32,
    sensing: &'a S,
    landmark: Option<Landmark>,
    #[serde(flatten)]
    asked: Option<Asked>,
}

/// What a program is told and asked at a time step, if it learns.
#[derive(Serialize)]
struct Asked {
    task: &'static str,
    put_down: bool,
    ask: [&'static str; 1],
}

/// First line to a program.
#[derive(Serialize)]
struct Greeting<'a> {
    #[serde(flatten)]
    hello: &'a Hello,
    protocol: u32,
}

impl Talk {
    /// Starts a program for the robot of `hello`. If `is_asked`, it is asked for its map.
    pub(super) fn start(
        launch: &Launch<'_>,
        budget: Budget,
        hello: Hello,
        is_asked: bool,
    ) -> Result<Self, LaunchError> {
        Ok(Self {
            program: Some(ForeignProgram::start(launch, budget)?),
            hello,
            has_begun: false,
            steps: 0,
            is_asked,
            task: None,
            is_put_down: false,
            failed: None,
            trail: Vec::new(),
            is_stale: true,
            map: MapView::default(),
            ids: BTreeSet::new(),
            belief: Vec::new(),
            verdict: NamedVerdict::default(),
        })
    }

    /// Returns whether the robot is learning, so that the map still changes.
    fn is_learning(&self) -> bool {
        matches!(self.task, None | Some(Task::Explore))
    }

    /// Notes that the robot was lifted and put down elsewhere. The map is what it is now.
    pub(super) fn put_down(&mut self) {
        self.is_put_down = true;
        self.task = None;
        self.is_stale = false;
        self.belief.clear();
    }

    /// Tells the program what its robot senses in this time step, and returns the line by which it
    /// answers. The belief in it is noted.
    pub(super) fn tell(
        &mut self,
        sensing: &impl Serialize,
        landmark: Option<Landmark>,
        task: Task,
    ) -> Result<Value, BrainError> {
        let step = self.steps;
        let asked = match self.is_asked {
            true => Some(self.asked(task)?),
            false => None,
        };
        let line = StepLine {
            step,
            sensing,
            landmark,
            asked,
        };
        let line = serde_json::to_string(&line);
        let line = line.map_err(|source| BrainError::Sensing { step, source })?;
        self.task = Some(task);
        self.is_stale |= self.is_learning();
        let mut told = self.exchange(line)?;
        if self.is_asked {
            let belief = self.answers(&mut told)?.belief;
            self.belief = NamedGuess::all(&belief)?;
            match self.is_learning() {
                true => self.trail.push(self.belief.first().map(|guess| guess.at)),
                false => self.check_belief()?,
            }
        }
        Ok(told)
    }

    /// Returns what a step asks for in this task.
    fn asked(&mut self, task: Task) -> Result<Asked, BrainError> {
        let mut named = NamedTask::ALL.into_iter();
        let named = named.find(|named| named.task() == task);
        Ok(Asked {
            task: named.ok_or(BrainError::Task)?.name(),
            put_down: mem::take(&mut self.is_put_down),
            ask: ["belief"],
        })
    }

    /// Returns whether the program has not been told yet what the robot senses where it stands.
    pub(super) fn is_news(&self, task: Task) -> bool {
        self.task != Some(task)
    }

    /// Returns whether the program believes to be in one place more than in all others.
    pub(super) fn is_sure(&self) -> bool {
        let first = self.belief.first();
        first.is_some_and(|guess| guess.weight > EVEN)
    }

    /// Checks that the belief names places of the map alone.
    fn check_belief(&self) -> Result<(), NamedError> {
        for guess in &self.belief {
            if let Position::Place(id) = guess.at
                && !self.ids.contains(&id)
            {
                return Err(NamedError::NoPlace { id });
            }
        }
        Ok(())
    }

    /// Asks the program for its map and its verdict, if it has learned since.
    pub(super) fn refresh(&mut self) {
        if !self.is_asked || !self.is_stale || self.failed.is_some() || !self.has_begun {
            return;
        }
        self.is_stale = false;
        if let Err(error) = self.ask_for_map() {
            self.fail(&error);
        }
    }

    fn ask_for_map(&mut self) -> Result<(), BrainError> {
        let ask = serde_json::json!({ "ask": ["map", "verdict"] });
        let mut told = self.exchange(ask.to_string())?;
        let answers = self.answers(&mut told)?;
        self.map = answers.map.unwrap_or_default().checked()?;
        self.ids = self.map.places.iter().map(|place| place.id).collect();
        self.verdict = answers.verdict;
        match self.verdict.certainty {
            Some(certainty) if !(0.0..=1.0).contains(&certainty) => {
                Err(NamedError::Certainty { certainty }.into())
            }
            _ => Ok(()),
        }
    }

    /// Takes the program's answers out of its line.
    fn answers(&self, told: &mut Value) -> Result<Answers, BrainError> {
        let answers = told.as_object_mut().and_then(|told| told.remove("answer"));
        let Some(answers) = answers else {
            return Err(BrainError::NoAnswer {
                step: self.steps,
                line: quoted(&told.to_string()),
            });
        };
        let line = quoted(&answers.to_string());
        serde_json::from_value(answers).map_err(|source| BrainError::Asked {
            step: self.steps,
            line,
            source,
        })
    }

    /// Says one line and hears one.
    fn exchange(&mut self, line: String) -> Result<Value, BrainError> {
        let Some(program) = &mut self.program else {
            return Err(BrainError::Ended("the program has ended".to_owned()));
        };
        if let Some(line) = program.heard_ahead() {
            return Err(BrainError::Twice {
                step: self.steps,
                line: quoted(&line),
            });
        }
        if !mem::replace(&mut self.has_begun, true) {
            let hello = Greeting {
                hello: &self.hello,
                protocol: PROTOCOL,
            };
            program.say(serde_json::json!({ "hello": hello }).to_string())?;
        }
        program.say(line)?;
        match program.hear()? {
            Some(line) => json(self.steps, &line),
            None => Err(self.left()?),
        }
    }

    /// Returns the error of a program that says no more, after waiting for its end.
    fn left(&mut self) -> Result<BrainError, LaunchError> {
        let left = self.program.take().map(|program| program.left(GRACE));
        let why = match left.transpose()? {
            None => "the program has ended".to_owned(),
            Some(Left::ByItself(status)) => format!("the program ended with {status}"),
            Some(Left::Killed) => "the program closed its stdout and ran on".to_owned(),
        };
        Ok(BrainError::Ended(why))
    }

    /// Ends the program, which has failed, and drops what it said of its map.
    pub(super) fn fail(&mut self, error: &BrainError) {
        self.program = None;
        self.failed = Some(error.to_string());
        self.map = MapView::default();
        self.belief.clear();
    }

    /// Returns the place of the map of each moment of learning: the one that the program named, or
    /// the nearest to its position if the two are in one corridor. O((trail + places) log places).
    pub(super) fn visits(&self) -> Vec<Option<u32>> {
        let near = 0.5 * self.hello.corridor_width;
        let square = |at: Point| {
            let along = |metres: f64| libm::floor(metres / near) as i64;
            (along(at.x), along(at.y))
        };
        let mut squares: BTreeMap<(i64, i64), Vec<(u32, Point)>> = BTreeMap::new();
        for place in &self.map.places {
            if let Some(at) = place.position {
                squares.entry(square(at)).or_default().push((place.id, at));
            }
        }
        let nearest = |point: Point| {
            let (x, y) = square(point);
            let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy)));
            let around = around.map(|(dx, dy)| (x.saturating_add(dx), y.saturating_add(dy)));
            let places = around.filter_map(|square| squares.get(&square)).flatten();
            let far = places.map(|(id, at)| (*id, (at - point).norm()));
            let nearest = far.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
            nearest.filter(|(_, far)| *far < near).map(|(id, _)| id)
        };
        let named = |at: &Option<Position>| match (*at)? {
            Position::Place(id) => Some(id),
            Position::Point(point) => nearest(point),
        };
        self.trail.iter().map(named).collect()
    }

    /// Returns how many moments of learning there were.
    pub(super) fn visit_count(&self) -> usize {
        self.trail.len()
    }

    /// Returns how long the program kept us waiting.
    pub(super) fn waited(&self) -> Duration {
        let program = self.program.as_ref();
        program.map_or(Duration::ZERO, ForeignProgram::waited)
    }
}

/// Returns the JSON of a line.
pub(super) fn json(step: u32, line: &str) -> Result<Value, BrainError> {
    serde_json::from_str(line).map_err(|source| BrainError::Json {
        step,
        line: quoted(line),
        source,
    })
}

/// Returns a line, or its beginning, to quote it.
pub(super) fn quoted(line: &str) -> String {
    line.trim_end().chars().take(QUOTED).collect()
}

impl From<Overrun> for BrainError {
    fn from(overrun: Overrun) -> Self {
        Self::Overrun(overrun)
    }
}
