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
