//! Compares one episode of CPM with many episodes of Q-learning and of a random walk. The paper
//! claims an advantage over reinforcement learning, without figures (sections 1 and 2).

use alloc::collections::BTreeMap;

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maze::{Cell, Maze};

use super::trials;
use tolman_arena::course::Course;
use tolman_arena::cpm::{TrueFragments, WayOut};
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record, require};
use tolman_systems::baselines::q_learning::{LearningTask, QLearner, QLearningConfig, Transition};
use tolman_systems::cpm::CommonPatterns;

/// Name of the table.
pub(super) const EPISODES: &str = "episodes";

/// Maximum number of episodes.
const MOST_EPISODES: u32 = 10_000;

/// Maximum number of fragments in an episode.
const MOST_FRAGMENTS: u32 = 100_000;

record! {
    /// A trial of CPM, and the requirements for its rivals to be as good, if CPM solves the maze.
    #[check(EpisodesRun::relations)]
    struct EpisodesRun {
        /// Length of CPM's way in its second episode.
        cells: Option<u32> => lower("CPM's second way").unit("cells"),
        /// Length of the shortest way.
        shortest_cells: u32 => neither("shortest way").unit("cells"),
        /// Number of episodes before CPM drives that way.
        cpm_episodes: Option<u32> => lower("CPM: episodes").at_most(MOST_EPISODES),
        /// Distance that CPM drives in them.
        cpm_metres: Option<f64> => lower("CPM: driven").unit("m").at_least(0),
        /// Number of episodes before Q-learning's greedy way is as short.
        q_learning_episodes: Option<u32> => lower("Q-learning: episodes").at_most(MOST_EPISODES),
        /// Distance that Q-learning drives in them.
        q_learning_metres: Option<f64> => lower("Q-learning: driven").unit("m").at_least(0),
        /// Number of episodes before the random walk happens to be as short.
        random_walk_episodes: Option<u32> => lower("random walk: episodes").at_most(MOST_EPISODES),
        /// Length of the random walk in them.
        random_walk_metres: Option<f64> => lower("random walk: driven").unit("m").at_least(0),
    }
}

impl EpisodesRun {
    fn relations(&self) -> Result<(), String> {
        let possible = self.cells.is_none_or(|cells| cells >= self.shortest_cells);
        require(possible, "a way is shorter than the shortest")?;
        for (episodes, metres) in [
            (self.cpm_episodes, self.cpm_metres),
            (self.q_learning_episodes, self.q_learning_metres),
            (self.random_walk_episodes, self.random_walk_metres),
        ] {
            let together = episodes.is_some() == metres.is_some();
            require(together, "episodes and metres come together")?;
            let solved = episodes.is_none() || self.cells.is_some();
            require(solved, "episodes are counted where CPM solves the run")?;
        }
        Ok(())
    }
}

/// Returns the table, with one row for each course.
pub(super) fn table(courses: &[Course]) -> Table {
    let table = Table::of::<EpisodesRun>(EPISODES, "Episodes until the way is known")
        .metrics_from(EpisodesRun::cells)
        .rows(courses.iter().map(|course| Row::new(&course.name)));
    let QLearningConfig {
        learning_rate,
        discount,
        exploration,
        ..
    } = QLearningConfig::usual();
    table.note(format!(
        "Number of episodes before a way is as short as the one that CPM (faithful, online) drives \
         in its second episode, in the runs that CPM solves. Q-learning (α {learning_rate}, γ \
         {discount}, ε {exploration}) and the random walk have no robot. They are told their \
         junction and move over the maze's graph without noise, at the length of each fragment. The \
         random walk turns round only in dead ends. Q-learning is done when its greedy way is as \
         short. The random walk learns nothing, and is done when one of its ways happens to be as \
         short. They give up after {MOST_EPISODES} episodes.",
    ))
}

/// Plays a run: a trial of CPM, and then its rivals until they are as good.
pub(super) fn run(
    course: &Course,
    patterns: &CommonPatterns,
    job: &Job<'_>,
) -> Result<Fields, BoxError> {
    let graph = JunctionTask::of(&course.maze)?;
    let shortest = TrueFragments::of(&course.maze).shortest(&course.maze, |way| Some(way.cells));
    let run = EpisodesRun {
        shortest_cells: shortest.ok_or("no way leads to the goal")?,
        ..EpisodesRun::default()
    };
    let record = trials::trial(course, patterns, trials::faithful(), job.seed).play()?;
    if !record.is_solved() {
        return Ok(run.fields()?);
    }
    let second = record.path.get(record.second_from..).unwrap_or_default();
    let cells = second
        .iter()
        .filter_map(|pose| course.world.cell_at(pose.position));
    let wanted = length_of(cells);
    let q_learning = q_learning(&graph, wanted, job.seed);
    let random_walk = random_walk(&graph, wanted, job.seed);
    let run = EpisodesRun {
        cells: Some(wanted),
        cpm_episodes: Some(1),
        cpm_metres: Some(trials::metres(&record)),
        q_learning_episodes: q_learning.as_ref().map(|it| it.episodes),
        q_learning_metres: q_learning.map(|it| it.metres(course)),
        random_walk_episodes: random_walk.as_ref().map(|it| it.episodes),
        random_walk_metres: random_walk.map(|it| it.metres(course)),
        ..run
    };
    Ok(run.fields()?)
}

/// Numbers of episodes and metres on a graph.
struct Walked {
    episodes: u32,
    cells: u64,
}

impl Walked {
    fn metres(&self, course: &Course) -> f64 {
        self.cells as f64 * course.corridor_width
    }
}

/// The ways out of each place of a maze, with costs in cells.
struct JunctionTask {
    places: Vec<Cell>,
    ways: Vec<Vec<(usize, WayOut)>>,
    start: usize,
    goals: Vec<usize>,
}

impl JunctionTask {
    fn of(maze: &Maze) -> Result<Self, BoxError> {
        let fragments = TrueFragments::of(maze);
        let mut out: BTreeMap<Cell, Vec<WayOut>> = BTreeMap::new();
        for (from, _, way) in fragments.ways() {
            out.entry(from).or_default().push(way);
        }
        let places: Vec<Cell> = out.keys().copied().collect();
        let index = |cell: Cell| places.binary_search(&cell).ok();
        let (start, _) = maze.start().ok_or("the maze marks no start")?;
        let start = index(start).ok_or("no way leads out of the start")?;
        let goals = maze
            .goals()
            .iter()
            .filter_map(|goal| index(*goal))
            .collect();
        let numbered = |ways: &Vec<WayOut>| {
            let ways = ways.iter();
            ways.filter_map(|way| Some((index(way.to)?, *way)))
                .collect()
        };
        let ways = out.values().map(numbered).collect();
        Ok(Self {
            places,
            ways,
            start,
            goals,
        })
    }
}

/// Returns the number of steps from cell to cell in a drive.
fn length_of(cells: impl Iterator<Item = Cell>) -> u32 {
    let mut cells = cells.peekable();
    let mut length = 0;
    while let Some(cell) = cells.next() {
        length += u32::from(cells.peek().is_some_and(|next| *next != cell));
    }
    length
}

impl LearningTask for &JunctionTask {
    fn start(&self) -> usize {
        self.start
    }

    fn states(&self) -> usize {
        self.places.len()
    }

    fn actions(&self, state: usize) -> u32 {
        self.ways[state].len() as u32
    }

    fn act(&self, state: usize, action: u32) -> Transition {
        let (next, way) = self.ways[state][action as usize % self.ways[state].len()];
        Transition {
            next,
            cost: way.cells,
        }
    }

    fn is_goal(&self, state: usize) -> bool {
        self.goals.contains(&state)
    }
}

/// Learns until the greedy way is at most `wanted` cells long. Returns `None` if that takes too
/// many episodes.
fn q_learning(graph: &JunctionTask, wanted: u32, seed: u64) -> Option<Walked> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut learner = QLearner::new(QLearningConfig::usual(), graph);
    let mut cells = 0;
    for episodes in 1..=MOST_EPISODES {
        for _ in 0..MOST_FRAGMENTS {
            let outcome = learner.step(&mut rng);
            cells += u64::from(outcome.cost);
            if graph.is_goal(outcome.next) {
                break;
            }
        }
        if learner.greedy_cost().is_some_and(|cost| cost <= wanted) {
            return Some(Walked { episodes, cells });
        }
    }
    None
}

/// Walks until a way happens to be at most `wanted` cells long. Returns `None` if that takes too
/// many episodes.
fn random_walk(graph: &JunctionTask, wanted: u32, seed: u64) -> Option<Walked> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut before = 0;
    for episodes in 0..MOST_EPISODES {
        let cells = wander(graph, &mut rng);
        if cells <= u64::from(wanted) {
            // As with the others, the short way itself does not count.
            return Some(Walked {
                episodes,
                cells: before,
            });
        }
        before += cells;
    }
    None
}

/// Walks one episode and returns its length. At each junction it takes a random branch other than
/// the one behind.
fn wander(graph: &JunctionTask, rng: &mut impl Rng) -> u64 {
    let (mut at, mut cells) = (graph.start, 0);
    let mut came: Option<u32> = None;
    for _ in 0..MOST_FRAGMENTS {
        let ways = &graph.ways[at];
        let on: Vec<&(usize, WayOut)> = ways
            .iter()
            .filter(|(_, way)| ways.len() == 1 || Some(way.fragment) != came)
            .collect();
        // A loop may lead back by its other end.
        let Some((next, way)) = (match on.len() {
            0 => ways.first(),
            count => on.get(rng.random_range(0..count as u32) as usize).copied(),
        }) else {
            break;
        };
        cells += u64::from(way.cells);
        (at, came) = (*next, Some(way.fragment));
        if graph.is_goal(at) {
            break;
        }
    }
    cells
}
