use core::hash::Hasher;

use fnv::FnvHasher;
use serde::Serialize;
use tolman_arena::Outing;
use tolman_arena::contest::{SteppedContest, TaskRecord};
use tolman_arena::registry::SystemEntry;
use tolman_film::Film;
use tolman_geom::Point;
use tolman_replay::json;

use crate::verdict::{TaskVerdict, explored, found, home};
use crate::{PlaygroundError, Tone};

/// A system that learns a maze on the page, a few time steps at a time.
#[derive(Debug)]
pub struct Session {
    contestant: &'static dyn SystemEntry,
    maze: String,
    seed: u64,
    contest: SteppedContest,
    film: Film,
    task: SessionTask,
    verdict: Option<TaskVerdict>,
}

/// Last task of a session, which may be over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SessionTask {
    /// The system learns the maze.
    Explore,
    /// The system localizes after it was put down.
    Localize,
    /// The system drives to the goal.
    Home,
}

/// Number of actions between two records of the map. Recording that of the better MSLST takes as
/// long as ten actions.
const EVERY: u32 = 4;

/// State of a session.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SessionState {
    /// Task in progress, or the last one.
    pub task: SessionTask,
    /// Whether the task is under way.
    pub is_busy: bool,
    /// Number of time steps made so far.
    pub steps: usize,
    /// Duration of a time step, s.
    pub step_s: f64,
    /// Number of places of the map when it was recorded last.
    pub places: usize,
    /// Number of places or poses that the system considers possible.
    pub guesses: usize,
    /// Description of the present activity, or of the task's result, in one or two sentences.
    pub told: String,
    /// Tone of the description.
    pub tone: Tone,
}

impl Session {
    pub(crate) fn new(
        contestant: &'static dyn SystemEntry,
        maze: &str,
        seed: u64,
        mut contest: SteppedContest,
    ) -> Self {
        contest.explore();
        let outing = contest.outing();
        Self {
            contestant,
            maze: maze.to_owned(),
            seed,
            film: Film::new(outing).recording_every(EVERY),
            contest,
            task: SessionTask::Explore,
            verdict: None,
        }
    }

    /// Lets the system act until its robot has made at least `steps` further time steps, or the
    /// task is over. Returns the state it has reached.
    pub fn advance(&mut self, steps: usize) -> SessionState {
        let until = self.steps().saturating_add(steps);
        while self.contest.is_busy() && self.steps() < until {
            let record = self.contest.act();
            self.film.see(self.contest.outing());
            self.verdict = record.map(|record| self.judge(&record));
        }
        self.state()
    }

    /// Lifts the robot and puts it down in the cell at a position in the world, m. The system knows
    /// that it was lifted, but not its new place, and begins to localize.
    ///
    /// # Errors
    /// [`PlaygroundError`] if the robot cannot stand there.
    pub fn put_down(&mut self, x: f64, y: f64) -> Result<SessionState, PlaygroundError> {
        let cell = self.contest.cell_at(Point::new(x, y));
        let cell = cell.ok_or(PlaygroundError::WalledIn)?;
        self.film.lifted(self.contest.outing());
        let found = self.contest.put_down(cell)?;
        self.task = SessionTask::Localize;
        self.verdict = found.map(|found| self.judge(&TaskRecord::Found(found)));
        Ok(self.state())
    }

    /// Sends the robot to the goal.
    pub fn go_home(&mut self) -> SessionState {
        self.contest.go_home();
        self.task = SessionTask::Home;
        self.verdict = None;
        self.state()
    }

    /// Returns the state of the session.
    #[must_use]
    pub fn state(&self) -> SessionState {
        let (places, guesses) = (self.film.place_count(), self.film.guess_count());
        let verdict = self.verdict.clone().unwrap_or_else(|| TaskVerdict {
            told: self.under_way(places, guesses),
            tone: Tone::Neutral,
        });
        SessionState {
            task: self.task,
            is_busy: self.contest.is_busy(),
            steps: self.steps(),
            step_s: self.contest.outing().robot().step_us as f64 * 1e-6,
            places,
            guesses,
            told: verdict.told,
            tone: verdict.tone,
        }
    }

    /// Returns the system with its robot.
    #[must_use]
    pub fn outing(&self) -> &dyn Outing {
        self.contest.outing()
    }

    /// Returns the run so far in the replay player's form. O(steps + map).
    ///
    /// # Errors
    /// [`PlaygroundError::Replay`] if it cannot be written.
    pub fn replay(&self) -> Result<String, PlaygroundError> {
        let title = format!("{} in the maze {}", self.contestant.title(), self.maze);
        let film = self.film.clone().replay(self.contest.outing(), title);
        Ok(json(&film.fact("seed", self.seed.to_string()))?)
    }

    /// Returns a fingerprint of the robot's way and of the map, to the bit: the same on every
    /// machine.
    #[must_use]
    pub fn fingerprint(&self) -> String {
        let outing = self.contest.outing();
        let mut hash = FnvHasher::default();
        for pose in outing.path() {
            for number in [pose.position.x, pose.position.y, pose.heading.radians()] {
                hash.write(&number.to_bits().to_le_bytes());
            }
        }
        hash.write(format!("{:?}", outing.map()).as_bytes());
        hash.write(format!("{:?}", outing.belief()).as_bytes());
        format!("{:016x}", hash.finish())
    }

    fn steps(&self) -> usize {
        self.contest.outing().path().len().saturating_sub(1)
    }

    fn judge(&self, record: &TaskRecord) -> TaskVerdict {
        let name = self.contestant.title();
        match record {
            TaskRecord::Learned(record) => explored(name, record),
            TaskRecord::Found(record) => found(record),
            TaskRecord::Home(record) => home(record),
        }
    }

    /// Returns the caption for the task under way.
    fn under_way(&self, places: usize, guesses: usize) -> String {
        let name = self.contestant.title();
        match self.task {
            SessionTask::Explore => {
                format!("{name} explores: {} on its map.", count(places, "place"))
            }
            SessionTask::Localize if guesses > 1 => {
                format!("It was put down and finds out where: it may be at {guesses} places.")
            }
            SessionTask::Localize => "It was put down and finds out where.".to_owned(),
            SessionTask::Home => "It drives to the goal by its map.".to_owned(),
        }
    }
}

/// Returns a number of things with the right ending.
pub(crate) fn count(number: usize, thing: &str) -> String {
    match number {
        1 => format!("1 {thing}"),
        _ => format!("{number} {thing}s"),
    }
}
