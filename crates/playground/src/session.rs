use serde::Serialize;
use tolman_arena::contest::{Contestant, SteppedContest, TaskRecord};
use tolman_film::Film;
use tolman_geom::Point;
use tolman_replay::json;

use crate::verdict::{TaskVerdict, explored, found, home};
use crate::{PlaygroundError, Tone};

/// A system that learns a maze while somebody looks on.
#[derive(Debug)]
pub struct Session {
    contestant: Contestant,
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
    /// It learns the maze.
    Explore,
    /// It finds out where it was put down.
    Localize,
    /// It drives to the goal.
    Home,
}

/// A session at a moment.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SessionState {
    /// The task.
    pub task: SessionTask,
    /// Whether the task is under way.
    pub is_busy: bool,
    /// Time steps made so far.
    pub steps: usize,
    /// Duration of a time step, s.
    pub step_s: f64,
    /// Places of the map.
    pub places: usize,
    /// Number of places or poses that the system takes for possible.
    pub guesses: usize,
    /// What is happening, or what came of the task; one or two sentences.
    pub told: String,
    /// How that sounds.
    pub tone: Tone,
}

impl Session {
    pub(crate) fn new(
        contestant: Contestant,
        maze: &str,
        seed: u64,
        mut contest: SteppedContest,
    ) -> Self {
        contest.explore();
        let outing = contest.outing();
        let start = outing.path().first().copied().unwrap_or_default();
        Self {
            contestant,
            maze: maze.to_owned(),
            seed,
            film: Film::laid_at(outing, contestant.world_from_map(start)),
            contest,
            task: SessionTask::Explore,
            verdict: None,
        }
    }

    /// Lets the system act until its robot has made at least `steps` further time steps, or the
    /// task is over, and returns what it has come to.
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
    /// that it was lifted, not where it is, and begins to find out.
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

    /// Returns what it has come to.
    #[must_use]
    pub fn state(&self) -> SessionState {
        let outing = self.contest.outing();
        let (places, guesses) = (outing.map().places.len(), outing.belief().len());
        let verdict = self.verdict.clone().unwrap_or_else(|| TaskVerdict {
            told: self.under_way(places, guesses),
            tone: Tone::Neutral,
        });
        SessionState {
            task: self.task,
            is_busy: self.contest.is_busy(),
            steps: self.steps(),
            step_s: outing.robot().step_us as f64 * 1e-6,
            places,
            guesses,
            told: verdict.told,
            tone: verdict.tone,
        }
    }

    /// Returns the run so far as the replay player takes it. O(steps + map).
    ///
    /// # Errors
    /// [`PlaygroundError::Replay`] if it cannot be written.
    pub fn replay(&self) -> Result<String, PlaygroundError> {
        let title = format!("{} in the maze {}", self.contestant.name(), self.maze);
        let film = self.film.clone().replay(self.contest.outing(), title);
        Ok(json(&film.fact("seed", self.seed.to_string()))?)
    }

    /// Returns a fingerprint of the robot's way and of the map, to the bit: the same on every
    /// machine.
    #[must_use]
    pub fn fingerprint(&self) -> String {
        let outing = self.contest.outing();
        let mut hash = Fnv::default();
        for pose in outing.path() {
            for number in [pose.position.x, pose.position.y, pose.heading.radians()] {
                hash.take(&number.to_bits().to_le_bytes());
            }
        }
        hash.take(format!("{:?}", outing.map()).as_bytes());
        hash.take(format!("{:?}", outing.belief()).as_bytes());
        format!("{:016x}", hash.0)
    }

    fn steps(&self) -> usize {
        self.contest.outing().path().len().saturating_sub(1)
    }

    fn judge(&self, record: &TaskRecord) -> TaskVerdict {
        let name = self.contestant.name();
        match record {
            TaskRecord::Learned(record) => explored(name, record),
            TaskRecord::Found(record) => found(record),
            TaskRecord::Home(record) => home(record),
        }
    }

    /// Returns what is happening.
    fn under_way(&self, places: usize, guesses: usize) -> String {
        let name = self.contestant.name();
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

/// FNV-1a, 64 bits.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn take(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

#[cfg(test)]
mod tests {
    use tolman_arena::contest::{Condition, Contest, ContestRobot, Moment, Schooling};

    use super::*;
    use crate::{Playground, Sketch};

    const STAR: &str = include_str!("../mazes/star.maze");

    fn star() -> Sketch {
        Sketch::read(STAR).unwrap()
    }

    fn finish(session: &mut Session) -> SessionState {
        loop {
            let state = session.advance(1000);
            if !state.is_busy {
                return state;
            }
        }
    }

    #[test]
    fn however_many_steps_a_call_it_is_the_same_run() {
        let playground = Playground::default();
        let played = |steps: usize, seed: u64| {
            let mut session = playground.begin(&star(), "MSLST Better", seed).unwrap();
            let mut states = vec![session.state()];
            while states.last().is_some_and(|state| state.is_busy) {
                states.push(session.advance(steps));
            }
            (
                session.replay().unwrap(),
                session.fingerprint(),
                states.len(),
            )
        };
        let (one, many) = (played(1, 3), played(50, 3));
        assert_eq!((&one.0, &one.1), (&many.0, &many.1));
        assert!(one.2 > many.2);
        assert_ne!(one.1, played(50, 4).1);
    }

    #[test]
    fn it_learns_what_the_arena_s_contestant_learns() {
        let sketch = star();
        let playground = Playground::default();
        for system in Playground::systems() {
            let contestant = Contestant::named(system.name).unwrap();
            let contest = Contest {
                contestant,
                robot: ContestRobot::Own,
                maze: &sketch.maze,
                name: &sketch.name,
                condition: Condition::AsMade,
                starts: 1,
                seed: 3,
                stopwatch: None,
            };
            // As it was when it had learned.
            let (mut path, mut map, mut is_learned) = (Vec::new(), None, false);
            let shown = contest.show(&Schooling::default(), |outing, moment| {
                is_learned |= matches!(moment, Moment::PutDown | Moment::Over);
                if !is_learned {
                    path = outing.path().to_vec();
                    map = Some(outing.map());
                }
            });
            let learned = shown.unwrap().learned;
            let mut session = playground.begin(&sketch, system.name, 3).unwrap();
            let state = finish(&mut session);
            let outing = session.contest.outing();
            let steps = learned.steps as usize;
            assert_eq!(outing.path().len(), steps + 1, "{}", system.name);
            assert!(outing.path() == &path[..=steps], "{}", system.name);
            assert_eq!(state.places, learned.places, "{}", system.name);
            let is_good = state.tone == Tone::Good;
            assert_eq!(is_good, learned.judgement.is_right, "{}", state.told);
            // Who is not put down elsewhere has gone home since.
            if contestant != Contestant::GngSlam {
                assert_eq!(Some(outing.map()), map, "{}", system.name);
            }
        }
    }

    #[test]
    fn put_down_at_any_time_it_goes_on() {
        let playground = Playground::default();
        for system in Playground::systems() {
            for steps in [0, 30, usize::MAX] {
                let mut session = playground.begin(&star(), system.name, 1).unwrap();
                session.advance(steps);
                let start = session.contest.outing().path()[0].position;
                let lifted = session.put_down(start.x, start.y).unwrap();
                assert_eq!(lifted.task, SessionTask::Localize);
                let found = finish(&mut session);
                assert!(found.told.starts_with("It "), "{}", found.told);
                session.go_home();
                let home = finish(&mut session);
                assert_eq!(home.task, SessionTask::Home, "{}", home.told);
                assert!(session.replay().unwrap().contains("tolman-replay"));
            }
        }
    }

    #[test]
    fn the_better_mslst_maps_the_demo_finds_itself_and_comes_home() {
        let demo = Sketch::read(include_str!("../mazes/demo.maze")).unwrap();
        let playground = Playground::default();
        let mut session = playground.begin(&demo, "mslst-better", 8).unwrap();
        assert!(session.state().told.contains("explores"));
        for (go_on, told) in [
            (None, "The map is right"),
            (Some(true), "It found out where it is"),
            (Some(false), "It is at the goal"),
        ] {
            match go_on {
                Some(true) => assert!(session.put_down(2.5, 2.5).unwrap().is_busy),
                Some(false) => assert!(session.go_home().is_busy),
                None => {}
            }
            let state = finish(&mut session);
            assert_eq!(state.tone, Tone::Good, "{}", state.told);
            assert!(state.told.contains(told), "{}", state.told);
        }
    }

    #[test]
    fn who_cannot_work_there_says_why() {
        let playground = Playground::default();
        let told = |sketch: &Sketch, system| {
            let refused = playground.begin(sketch, system, 1).map(|_| ());
            refused.unwrap_err().to_string()
        };
        let empty = Sketch::empty(5);
        assert!(told(&empty, "CPM").contains("open square"));
        assert!(told(&empty, "Random").contains("no system"));
        let mut walled = Sketch::empty(5);
        walled.maze.set_goals(Vec::new());
        assert!(told(&walled, "MSLST Better").contains("no robot"));
    }
}
