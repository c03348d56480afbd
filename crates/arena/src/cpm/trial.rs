use alloc::collections::BTreeMap;

use tolman_geom::Pose;
use tolman_maps::cpm::{CpMap, FragmentId};
use tolman_robot::Landmark;
use tolman_sim::robots::{Epuck, EpuckConfig};
use tolman_systems::cpm::{
    Aim, CommonPatterns, CpmResult, Done, EpisodeSummary, FragmentStep, Layer3, Mode, Walker,
};

use super::fragments::WayOut;
use super::robots::{SimulatedEpuck, walker_config};
use super::run::CpmRun;
use super::score::{Closures, Score};
use crate::BoxError;
use crate::course::Course;

/// Both episodes of the paper in one maze. The first leads from the start to the goal; the second
/// leads from the start again, along the shortest known way.
#[derive(Clone, Debug)]
pub struct CpmTrial<'a> {
    /// The maze, with a start and a goal.
    pub course: &'a Course,
    /// Patterns that the robot learned before, if its mode uses them.
    pub patterns: &'a CommonPatterns,
    /// Configuration of the robot.
    pub robot: EpuckConfig,
    /// Mode of mapping.
    pub mode: Mode,
    /// The seed of all random numbers.
    pub seed: u64,
}

/// Result of a trial.
#[derive(Clone, Debug, Default)]
pub struct TrialRecord {
    /// The first episode, if it came to an end.
    pub first: Option<EpisodeSummary>,
    /// The second episode, if it came to an end.
    pub second: Option<EpisodeSummary>,
    /// Whether the second episode's way was the shortest that could be known. A fragment walked
    /// twice is known to have the same ends, and start and goal are known.
    pub is_shortest_known: bool,
    /// Whether the second episode's way was as short as any way over the walked fragments, with all
    /// places known. The robot cannot always know that.
    pub is_shortest_as_it_lies: bool,
    /// Whether the map from which the second episode is planned is right. Then it has each visited
    /// place and fragment once, truly joined.
    pub is_map_right: bool,
    /// Counts of loops closed correctly and wrongly.
    pub closures: Closures,
    /// Number of walks along fragments in the first episode.
    pub traversals: u32,
    /// Number of common patterns that the robot knows at the end.
    pub patterns: u32,
    /// Number of fragments that were truly walked.
    pub true_fragments: u32,
    /// Number of times that the map differed from what the robot found.
    pub contradictions: u32,
    /// Number of time steps in which the body touched a wall.
    pub bumps: u32,
    /// Path of the robot, step by step.
    pub path: Vec<Pose>,
    /// Step at which the second episode began.
    pub second_from: usize,
    /// Map at the end of the first episode.
    pub map: CpMap,
    /// The true fragment of each fragment of the map.
    pub truth: BTreeMap<FragmentId, WayOut>,
    /// Reason why the trial broke off.
    pub trouble: Option<String>,
}

impl TrialRecord {
    /// Returns whether the goal was found, the shortest known way was planned and led to the goal.
    #[must_use]
    pub fn is_solved(&self) -> bool {
        let reached = |episode: Option<EpisodeSummary>| {
            episode.is_some_and(|episode| episode.done == Done::Reached)
        };
        reached(self.first) && reached(self.second) && self.is_shortest_known
    }

    /// Returns the reduction of time from the first to the second episode, in percent of the first.
    #[must_use]
    pub fn reduction_percent(&self) -> Option<f64> {
        let (first, second) = (self.first?, self.second?);
        (first.seconds > 0.0 && self.is_solved())
            .then(|| 100.0 * (1.0 - second.seconds / first.seconds))
    }
}

impl CpmTrial<'_> {
    /// Puts the robot down at the start and sends it out. The inner error is that of a robot that
    /// fails as it looks round.
    ///
    /// # Errors
    /// If it cannot be put there.
    pub fn begin(&self) -> Result<CpmResult<CpmRun, SimulatedEpuck>, BoxError> {
        let course = self.course;
        let config = walker_config(&self.robot, course.corridor_width)?;
        let robot = Epuck::new(self.robot.clone())?;
        let body = course.robot_at(course.start()?, robot, self.seed)?;
        let (patterns, mode) = (self.patterns, self.mode);
        Ok(CpmRun::begin(body, config, patterns, mode, self.seed))
    }

    /// Plays both episodes and returns the result. Failures on the way are part of it.
    ///
    /// # Errors
    /// If it cannot be begun.
    pub fn play(&self) -> Result<TrialRecord, BoxError> {
        self.watch(|_, _, _| {})
    }

    /// Plays both episodes like [`play`](Self::play). Calls `see` with every fragment of the first.
    ///
    /// # Errors
    /// If it cannot be begun.
    pub fn watch(
        &self,
        see: impl FnMut(&Layer3, &Walker<SimulatedEpuck>, &FragmentStep),
    ) -> Result<TrialRecord, BoxError> {
        let mut record = TrialRecord::default();
        match self.begin()? {
            Ok(mut run) => {
                let played = self.episodes(&mut run, &mut record, see);
                record.trouble = played.err().map(|error| error.to_string());
                record.patterns = run.layer.patterns.dictionary().len() as u32;
                record.bumps = run.walker.body().bumps();
                record.path = run.walker.body().path().to_vec();
            }
            Err(error) => record.trouble = Some(error.to_string()),
        }
        Ok(record)
    }

    fn episodes(
        &self,
        run: &mut CpmRun,
        record: &mut TrialRecord,
        mut see: impl FnMut(&Layer3, &Walker<SimulatedEpuck>, &FragmentStep),
    ) -> Result<(), BoxError> {
        let maze = &self.course.maze;
        let mut score = Score::of(maze, run);
        let first = run.pursue(Aim::Find(Landmark::Goal), |layer, walker, step| {
            score.see(layer, walker, step);
            see(layer, walker, step);
        });
        let CpmRun { walker, layer, .. } = &mut *run;
        let mapper = &layer.explorer.mapper;
        record.closures = score.closures_at_the_end(layer.map());
        record.contradictions = mapper.contradictions();
        record.traversals = mapper.traversals();
        record.true_fragments = score.lengths.len() as u32;
        record.map = layer.map().clone();
        record.truth = score.truth.clone();
        record.first = Some(first?);
        layer.optimize()?;
        record.is_map_right = score.is_map_right(layer.map(), maze);
        record.second_from = walker.body().path().len();
        walker.body_mut().place(self.course.start()?)?;
        layer.placed_at_start(walker)?;
        record.second = run.drive_to_goal()?;
        let path = run.walker.body().path();
        let path = path.get(record.second_from..).unwrap_or_default();
        if record.second.is_some()
            && let Some(driven) = score.length_of(&self.course.world, path)
        {
            let is_as_short = |shortest: Option<u32>| is_as_short(driven, shortest);
            record.is_shortest_known = is_as_short(score.known.shortest());
            record.is_shortest_as_it_lies = is_as_short(score.shortest_as_it_lies(maze));
        }
        Ok(())
    }
}

/// Returns whether a drive was as short as the shortest way, in observations. Walks vary by 5 % and
/// 8 observations, which are tolerated.
fn is_as_short(driven: u32, shortest: Option<u32>) -> bool {
    shortest.is_some_and(|shortest| f64::from(driven) <= 1.05 * f64::from(shortest) + 8.0)
}

#[cfg(test)]
pub(super) mod tests {
    use std::sync::LazyLock;

    use tolman_maps::cpm::{FragmentMatching, Similarity};
    use tolman_maze::{Cell, Direction, Grid, Maze};
    use tolman_sim::noise::Fault;
    use tolman_systems::cpm::{Approach, CpmConfig};

    use super::*;
    use crate::cpm::{KnownMaze, PutDown, epuck, learn};

    const WIDTH: f64 = 0.25;

    fn read(text: &str) -> Course {
        Course::new("", tolman_maze::read(text).unwrap().maze, WIDTH).unwrap()
    }

    /// Returns Maze 1 of the paper, for all tests of CPM.
    pub(crate) fn maze_1() -> Course {
        read(include_str!("../../mazes/cpm-1.maze"))
    }

    /// Patterns learned in the learning maze, for all tests of CPM.
    pub(in crate::cpm) static PATTERNS: LazyLock<CommonPatterns> =
        LazyLock::new(|| learn(&read(include_str!("../../mazes/cpm-learning.maze")), 1).unwrap());

    fn trial(course: &Course, robot: EpuckConfig) -> CpmTrial<'_> {
        CpmTrial {
            course,
            patterns: &PATTERNS,
            robot,
            mode: Mode::Paper(CpmConfig::online()),
            seed: 3,
        }
    }

    fn play(course: &Course, robot: EpuckConfig) -> TrialRecord {
        trial(course, robot).play().unwrap()
    }

    #[test]
    fn the_second_episode_is_the_shorter_one_bit_for_bit() {
        let maze = maze_1();
        let record = play(&maze, epuck());
        assert!(record.is_solved(), "{:?}", record.trouble);
        assert!(record.is_map_right);
        assert!(record.reduction_percent().unwrap() > 50.0);
        assert_eq!(record.bumps, 0);
        assert_eq!(record.path, play(&maze, epuck()).path);
    }

    #[test]
    fn patterns_learned_on_the_way_do() {
        let maze = read(include_str!("../../mazes/cpm-2.maze"));
        let unlearned = CpmTrial {
            mode: Mode::Unlearned(CpmConfig::robust()),
            ..trial(&maze, epuck())
        };
        let mut versions = Vec::new();
        let record = unlearned.watch(|layer, _, _| {
            versions.push(layer.patterns.dictionary().version());
        });
        let record = record.unwrap();
        assert!(
            record.is_solved() && record.is_map_right,
            "{:?}",
            record.trouble
        );
        // It has learned something on the first fragment already, and more on others.
        assert!((5..PATTERNS.dictionary().len() as u32).contains(&record.patterns));
        assert!(versions.windows(2).any(|pair| pair[0] != pair[1]));
    }

    #[test]
    fn a_goal_that_is_walled_off_is_not_there() {
        let mut maze = maze_1().maze;
        let goal = maze.goals()[0];
        for direction in Direction::ALL {
            maze.set_wall(goal, direction, true);
        }
        let record = play(&Course::new("", maze, WIDTH).unwrap(), epuck());
        assert!(!record.is_solved() && record.trouble.is_none());
        assert_eq!(record.first.unwrap().done, Done::NotThere);
        assert!(record.second.is_none());
    }

    #[test]
    fn a_maze_without_junctions_is_walked_to_its_end() {
        let mut maze = Maze::solid(Grid::new(4, 1));
        for x in 0..3 {
            maze.set_wall(Cell::new(x, 0), Direction::East, false);
        }
        maze.set_start(Some((Cell::new(0, 0), Direction::East)));
        maze.set_goals(vec![Cell::new(3, 0)]);
        let record = play(&Course::new("", maze, WIDTH).unwrap(), epuck());
        assert!(record.is_solved(), "{:?}", record.trouble);
    }

    #[test]
    fn loops_that_stay_open_on_the_map_are_missed() {
        let maze = maze_1();
        // A robot to which nothing is similar closes none.
        let mut similarity = Similarity::paper();
        similarity.mu = 2.0;
        let matching = FragmentMatching::Positions(similarity);
        let mut config = CpmConfig::online();
        config.matching = matching;
        config.most_traversals = 20;
        let mut missed = 0;
        for seed in 0..4 {
            let blind = CpmTrial {
                mode: Mode::Paper(config),
                seed,
                ..trial(&maze, epuck())
            };
            let record = blind.play().unwrap();
            let closures = record.closures;
            assert_eq!((closures.right, closures.wrong), (0, 0));
            let fragments = record.map.fragments().len() as u32;
            assert_eq!(closures.missed, fragments - record.true_fragments);
            assert!(closures.missed == 0 || !record.is_map_right);
            missed += closures.missed;
        }
        assert!(missed > 0);
    }

    #[test]
    fn sensors_that_fail_are_told() {
        let maze = maze_1();
        let faulty = |fault| {
            let mut config = epuck();
            config.proximity = vec![fault];
            config
        };
        let silent = faulty(Fault::DropOut { probability: 1.0 });
        let trouble = play(&maze, silent).trouble.unwrap();
        assert!(trouble.contains("check the proximity sensors"), "{trouble}");
        // A sensor that always says the same shows no way on, or one everywhere: an end without the
        // goal, whichever.
        let stuck = faulty(Fault::Stuck {
            probability: 1.0,
            steps: u32::MAX,
        });
        assert!(!play(&maze, stuck).is_solved());
    }

    #[test]
    fn wheels_that_slip_by_half_end_where_the_record_says() {
        let maze = maze_1();
        let mut robot = epuck();
        robot.wheels = vec![Fault::Slip { share: 0.5 }];
        for seed in 0..3 {
            let slipping = CpmTrial {
                seed,
                ..trial(&maze, robot.clone())
            };
            let record = slipping.play().unwrap();
            let end = record
                .path
                .last()
                .and_then(|pose| maze.world.cell_at(pose.position));
            let is_there = end.is_some_and(|cell| maze.maze.goals().contains(&cell));
            let second = record.second.map(|episode| episode.done);
            assert_eq!(second == Some(Done::Reached), second.is_some() && is_there);
            assert!(record.first.is_some() || record.trouble.is_some());
        }
    }

    #[test]
    fn a_robot_put_down_amid_a_fragment_finds_out_where_it_is() {
        let maze = maze_1();
        let record = play(&maze, epuck());
        let known = [KnownMaze {
            course: &maze,
            learned: &record,
        }];
        let straight_on = (0..4).map(|seed| (Approach::StraightOn, seed));
        let to_and_fro = (0..8).map(|seed| (Approach::ToAndFro, seed));
        let (mut under_way, mut turned) = (0, 0);
        for (approach, seed) in straight_on.chain(to_and_fro) {
            let put_down = PutDown {
                known: &known,
                here: 0,
                patterns: &PATTERNS,
                robot: epuck(),
                approach,
                most_places: 6,
                seed,
            };
            let found = put_down.play().unwrap().unwrap();
            assert!(found.is_right_at_last, "{:?}", found.whereabouts);
            // It was sure at the last place and at none before.
            let beliefs = &found.whereabouts.at_places;
            let places_unsure = beliefs
                .iter()
                .take_while(|belief| belief.probability <= 0.95);
            assert_eq!(places_unsure.count(), beliefs.len() - 1);
            if approach == Approach::ToAndFro {
                // No two fragments of this maze bend alike.
                assert!(found.knowable_by_bends > 0.99);
                under_way += u32::from(found.is_right_under_way);
                turned += u32::from(found.whereabouts.has_turned_round);
            } else {
                assert!(!found.whereabouts.has_turned_round);
            }
        }
        assert!(under_way >= 7, "{under_way} of 8");
        assert!((1..8).contains(&turned), "{turned} of 8");
    }

    #[test]
    fn on_the_way_back_a_shorter_way_is_found() {
        let maze = read(include_str!("../../mazes/cpm-real.maze"));
        // With this seed the first way is the longer one of two.
        let trial = CpmTrial {
            seed: 900,
            ..trial(&maze, epuck())
        };
        let mut run = trial.begin().unwrap().unwrap();
        let there = run.pursue(Aim::Find(Landmark::Goal), |_, _, _| {}).unwrap();
        run.layer.optimize().unwrap();
        let before = run.layer.explorer.mapper.plan(Landmark::Start).unwrap();
        let mut tried = 0;
        let back = run.pursue(Aim::WayBack, |_, _, step| {
            tried += u32::from(step.leg.known.is_none());
        });
        assert_eq!(back.unwrap().done, Done::Reached);
        let after = run.layer.explorer.mapper.plan(Landmark::Goal).unwrap();
        assert!(tried > 0 && after.length < before.length);
        let again = run.drive_to_goal().unwrap().unwrap();
        assert_eq!(again.done, Done::Reached);
        assert!(again.observations < there.observations / 10);
    }
}
