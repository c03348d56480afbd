//! One episode of CPM against many of Q-learning and of a random walk: what the paper claims over reinforcement learning, without a
//! figure (sections 1 and 2).

use alloc::collections::BTreeMap;

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maze::{Cell, Maze};

use super::trials;
use tolman_arena::cpm::{CommonPatterns, TrueFragments, Venue, Way};
use tolman_experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table};
use tolman_systems::baselines::q_learning::{Outcome, QLearner, QLearningConfig, Task};

/// The name of the table.
pub(super) const EPISODES: &str = "episodes";

/// The end of all patience, episodes.
const MOST_EPISODES: u32 = 10_000;

/// And fragments of one episode.
const MOST_FRAGMENTS: u32 = 100_000;

/// The three that are compared: the beginning of their fields' names, and that on a page.
const LEARNERS: [(&str, &str); 3] = [
    ("cpm", "CPM"),
    ("q_learning", "Q-learning"),
    ("random_walk", "random walk"),
];

/// `venues` one row each.
pub(super) fn table(venues: &[Venue]) -> Table {
    let mut table = Table::new(EPISODES, "Episodes until the way is known")
        .optional_field("cells", Kind::Count)
        .field("shortest_cells", Kind::Count)
        .metric(
            Metric::mean("cells")
                .titled("CPM's second way")
                .unit("cells"),
        )
        .metric(
            Metric::mean("shortest_cells")
                .titled("the shortest")
                .unit("cells"),
        );
    for (name, title) in LEARNERS {
        let [episodes, metres] = [format!("{name}_episodes"), format!("{name}_metres")];
        table = table
            .optional_field(&episodes, Kind::Count)
            .optional_field(&metres, Kind::Number)
            .metric(Metric::mean(episodes).titled(format!("{title}: episodes")))
            .metric(Metric::mean(metres).titled("driven").unit("m"));
    }
    for venue in venues {
        table = table.row(Row::new(&venue.name));
    }
    let QLearningConfig {
        learning_rate,
        discount,
        exploration,
    } = QLearningConfig::usual();
    table.note(format!(
        "How many episodes it takes until the next leads over a way as short as that which CPM (faithful, online) drives in its second, in \
         the runs that CPM solves. Q-learning (α {learning_rate}, γ {discount}, ε {exploration}) and the random walk, which does not turn \
         round but in dead ends, have no robot: they are told at which junction they stand and move over the maze's graph without noise, \
         at the length of each fragment. Q-learning is done when its greedy way is as short; the random walk learns nothing and is done \
         when one of its ways happens to be. They give up after {MOST_EPISODES} episodes.",
    ))
}

/// One trial of CPM, and what its rivals need to do as well.
pub(super) fn run(
    venue: &Venue,
    patterns: &CommonPatterns,
    job: &Job<'_>,
) -> Result<Fields, BoxError> {
    let graph = JunctionTask::of(&venue.maze)?;
    let shortest = graph.shortest().ok_or("no way leads to the goal")?;
    let mut fields = Fields::new().count("shortest_cells", shortest.into());
    let record = trials::trial(venue, patterns, trials::faithful(), job.seed).play()?;
    if !record.is_solved() {
        return Ok(fields);
    }
    let world = venue.world()?;
    let second = record.path.get(record.second_from..).unwrap_or_default();
    let cells = second
        .iter()
        .filter_map(|pose| world.cell_at(pose.position));
    let wanted = length_of(cells);
    fields = fields.count("cells", wanted.into());
    let results = [
        Some(Learned {
            episodes: 1,
            metres: trials::metres(&record),
        }),
        q_learning(&graph, wanted, job.seed).map(|it| it.in_metres(venue)),
        random_walk(&graph, wanted, job.seed).map(|it| it.in_metres(venue)),
    ];
    for ((name, _), result) in LEARNERS.iter().zip(results) {
        if let Some(Learned { episodes, metres }) = result {
            fields = fields
                .count(format!("{name}_episodes"), episodes.into())
                .number(format!("{name}_metres"), metres);
        }
    }
    Ok(fields)
}

/// What it took.
struct Learned {
    episodes: u32,
    metres: f64,
}

/// The same, as counted on a graph.
struct Walked {
    episodes: u32,
    cells: u64,
}

impl Walked {
    fn in_metres(&self, venue: &Venue) -> Learned {
        Learned {
            episodes: self.episodes,
            metres: self.cells as f64 * venue.corridor_width,
        }
    }
}

/// The ways out of each place of a maze; costs are cells.
struct JunctionTask {
    places: Vec<Cell>,
    ways: Vec<Vec<(usize, Way)>>,
    start: usize,
    goals: Vec<usize>,
}

impl JunctionTask {
    fn of(maze: &Maze) -> Result<Self, BoxError> {
        let fragments = TrueFragments::of(maze);
        let mut out: BTreeMap<Cell, Vec<Way>> = BTreeMap::new();
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
        let numbered = |ways: &Vec<Way>| {
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

    /// Cells of the shortest way from start to goal.
    fn shortest(&self) -> Option<u32> {
        let arcs: Vec<_> = (0..)
            .zip(&self.ways)
            .flat_map(|(from, ways)| {
                ways.iter()
                    .map(move |(to, way)| (from, *to as u32, way.cells))
            })
            .collect();
        let graph = tolman_planners::Arcs::new(self.places.len(), &arcs);
        let costs = tolman_planners::costs_from(&graph, [self.start as u32]);
        self.goals.iter().filter_map(|goal| costs[*goal]).min()
    }
}

/// How many steps from cell to cell a drive had.
fn length_of(cells: impl Iterator<Item = Cell>) -> u32 {
    let mut cells = cells.peekable();
    let mut length = 0;
    while let Some(cell) = cells.next() {
        length += u32::from(cells.peek().is_some_and(|next| *next != cell));
    }
    length
}

impl Task for &JunctionTask {
    fn start(&self) -> usize {
        self.start
    }

    fn states(&self) -> usize {
        self.places.len()
    }

    fn actions(&self, state: usize) -> u32 {
        self.ways[state].len() as u32
    }

    fn act(&self, state: usize, action: u32) -> Outcome {
        let (next, way) = self.ways[state][action as usize % self.ways[state].len()];
        Outcome {
            next,
            cost: way.cells,
        }
    }

    fn is_goal(&self, state: usize) -> bool {
        self.goals.contains(&state)
    }
}

/// Learns until the greedy way is as short as wanted.
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

/// Walks until a way happens to be as short as wanted.
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

/// One episode: at each junction a branch at random, but not the one it came by.
fn wander(graph: &JunctionTask, rng: &mut impl Rng) -> u64 {
    let (mut at, mut cells) = (graph.start, 0);
    let mut came: Option<u32> = None;
    for _ in 0..MOST_FRAGMENTS {
        let ways = &graph.ways[at];
        let on: Vec<&(usize, Way)> = ways
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

/// What no run of this table can be.
pub(super) fn check(run: &Run) -> Result<(), BoxError> {
    let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
    let solved = number("cells").is_some();
    if solved && number("cells") < number("shortest_cells") {
        return Err("a way is shorter than the shortest".into());
    }
    for (name, _) in LEARNERS {
        let episodes = number(&format!("{name}_episodes"));
        let metres = number(&format!("{name}_metres"));
        if episodes.is_some() != metres.is_some() || episodes.is_some() && !solved {
            return Err(format!("{name} has episodes and metres, where CPM solves the run").into());
        }
        if episodes > Some(f64::from(MOST_EPISODES)) || metres < Some(0.0) && metres.is_some() {
            return Err(format!("{name} took {episodes:?} episodes of {metres:?} m").into());
        }
    }
    Ok(())
}
