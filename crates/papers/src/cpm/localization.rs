//! A robot that knows several mazes is put down in mid-fragment of one of them (section 8, "the
//! start point is changed", and layer 4).

use alloc::sync::Arc;

use super::{mazes, trials};
use crate::kept::Kept;
use crate::rows::row_of;
use tolman_arena::course::Course;
use tolman_arena::cpm::{KnownMaze, PutDown, PutDownRecord, TrialRecord, epuck};
use tolman_experiment::Record as _;
use tolman_experiment::{BoxError, Fields, Job, Options, Row, Table, record, require, run_seed};
use tolman_systems::cpm::{Approach, CommonPatterns};

/// Name of the table.
pub(super) const LOCALIZATION: &str = "localization";

/// Number of places after which the robot must know where it is.
const MOST_PLACES: u32 = 6;

/// Maximum number of trials to get a map of a maze.
const ATTEMPTS: u32 = 20;

/// Number of runs of a row. With 100, a share of 90 % is known to within 6 %.
const RUNS: u32 = 100;

/// Number of maps learned of each maze, which runs use in turn. Aliased mazes have a new map in
/// each run.
const MAPS: u32 = 20;

/// Number of runs of a row for a first look.
const QUICK_RUNS: u32 = 5;

/// Row of mazes with fragments that look alike. Each run has another maze, the only one that the
/// robot knows.
const ALIASED: &str = "Aliased";

/// Suffix of rows in which robots turn round when they are not sure.
const TO_AND_FRO: &str = " to and fro";

record! {
    /// A robot that is put down in mid-fragment.
    #[check(LocalizationRun::relations)]
    struct LocalizationRun {
        /// Probability that an observer who sees every bend of the corridor guesses correctly.
        bends_percent: f64 => neither("could be known by bends").percent().decimals(1),
        /// Probability that an observer who also sees the places at the ends guesses correctly.
        places_percent: f64 => neither("could be known by bends and places").percent().decimals(1),
        /// Whether the robot turned round.
        turned_round: bool => neither("turned round"),
        /// Whether it was right when the first place came into sight.
        under_way: bool => higher("right before the first place"),
        /// Whether it was right in the middle of the first place.
        first_place: bool => higher("right in the first place"),
        /// Whether it was right within one further fragment.
        one_further: bool => higher("right within one further fragment"),
        /// Whether it was right at the last place.
        last_place: bool => higher("right in the last place"),
        /// Whether SOINN-AM recalled the maze from the first fragment walked whole.
        recalled: Option<bool> => higher("maze recalled by SOINN-AM"),
        /// Number of places visited until the robot was sure.
        places: usize => lower("places visited").at_least(1).at_most(MOST_PLACES),
        /// Duration of the search.
        seconds: f64 => lower("time").unit("s").at_least(0),
    }
}

impl LocalizationRun {
    fn of(record: &PutDownRecord) -> Self {
        Self {
            places: record.whereabouts.at_places.len(),
            seconds: record.seconds,
            bends_percent: 100.0 * record.knowable_by_bends,
            places_percent: 100.0 * record.knowable_by_places,
            turned_round: record.whereabouts.has_turned_round,
            under_way: record.is_right_under_way,
            first_place: record.is_right_at_first_place,
            one_further: record.is_right_within_one_further,
            last_place: record.is_right_at_last,
            recalled: record.is_recalled,
        }
    }

    fn relations(&self) -> Result<(), String> {
        for knowable in [self.bends_percent, self.places_percent] {
            // The best guess is wrong, or one of several equally good ones.
            let guesses = 100.0 / knowable;
            let possible = knowable <= 0.0 || (guesses - guesses.round()).abs() <= 1e-6;
            let told = format!("a chance is {knowable} %, expected 0 or 100 over a whole number");
            require(possible, &told)?;
        }
        let has_walked = self.places > 1 || self.turned_round;
        let recalled = self.recalled.is_none() || has_walked;
        require(
            recalled,
            "a maze is recalled, and no fragment was walked whole",
        )?;
        let alike = [self.last_place, self.one_further] == [self.first_place; 2];
        require(self.places > 1 || alike, "the first place is the last one")
    }
}

/// Several maps of each maze, by their number.
#[derive(Debug, Default)]
pub(super) struct Known(Kept<u32, Vec<TrialRecord>>);

/// Returns the maze of a row, and the robot's approach.
fn cast(row: &str) -> (&str, Approach) {
    match row.strip_suffix(TO_AND_FRO) {
        Some(maze) => (maze, Approach::ToAndFro),
        None => (row, Approach::StraightOn),
    }
}

/// Returns the name of the maps that a run uses; `None` for a run in a maze of its own.
pub(super) fn maps_of(job: &Job<'_>) -> Option<String> {
    let (maze, _) = cast(job.row);
    (maze != ALIASED).then(|| format!("maps {}", job.run % MAPS))
}

/// Returns the table of robots put down in mid-fragment.
pub(super) fn table(courses: &[Course], options: &Options) -> Table {
    let title = "Put down in mid-fragment of one of the mazes";
    let runs = options.runs_else(RUNS, QUICK_RUNS);
    let mazes = courses.iter().map(|course| course.name.as_str());
    let rows = mazes.chain([ALIASED]).flat_map(|maze| {
        ["", TO_AND_FRO].map(|suffix| Row::new(format!("{maze}{suffix}")).runs(runs))
    });
    Table::of::<LocalizationRun>(LOCALIZATION, title)
        .metrics_from(LocalizationRun::bends_percent)
        .rows(rows)
        .note(format!(
        "The robot knows all these mazes by maps of one dictionary, each from a solved trial, twenty \
         in turn. It is put down in the middle of a cell, inside a fragment that its map has. Mazes \
         with fragments that look alike are another one in each run, and the robot knows only that \
         one. It drives straight on to the place ahead, or to and fro: if it is not sure when that \
         place comes into sight, it turns round and goes to the other end. Right: it names maze, \
         fragment and direction, when the first place is in sight, and in the middle of that place. \
         Within one further fragment: right at the first place if it was sure there, or else before \
         the next one. It goes on until it is sure, up to {MOST_PLACES} places. What could be known \
         is how often an ideal observer's best guess is right. One observer knows the mazes and sees \
         without error how the corridor bends in every cell from the one behind on. The other also \
         sees the place ahead, and the sides of the one behind if it is beside it. SOINN-AM is asked \
         with the first fragment walked whole."
    ))
}

impl Known {
    /// Returns a solved trial of each maze.
    fn records(
        &self,
        courses: &[Course],
        patterns: &CommonPatterns,
        master_seed: u64,
        run: u32,
    ) -> Result<Arc<Vec<TrialRecord>>, BoxError> {
        let number = run % MAPS;
        let solved = |course: &Course| {
            for attempt in 0..ATTEMPTS {
                // These seeds differ from those of the table's runs.
                let attempt = number * ATTEMPTS + attempt;
                let seed = run_seed(master_seed, "localization maps", attempt);
                let record = trials::trial(course, patterns, trials::better(), seed).play()?;
                if record.is_solved() {
                    return Ok(record);
                }
            }
            Err(format!("no trial of {} was solved", course.name).into())
        };
        self.0.get(number, || courses.iter().map(solved).collect())
    }

    /// Plays a run: one robot that is put down.
    pub(super) fn run(
        &self,
        courses: &[Course],
        patterns: &CommonPatterns,
        master_seed: u64,
        job: &Job<'_>,
    ) -> Result<Fields, BoxError> {
        let (maze, approach) = cast(job.row);
        if maze == ALIASED {
            return aliased(patterns, approach, job.seed);
        }
        let records = self.records(courses, patterns, master_seed, job.run)?;
        let known: Vec<KnownMaze<'_>> = courses
            .iter()
            .zip(&*records)
            .map(|(course, learned)| KnownMaze { course, learned })
            .collect();
        let (here, _) = row_of(job, courses.iter().enumerate(), |(_, course)| {
            course.name == maze
        })?;
        let record = put_down(&known, here, patterns, approach, job.seed).play()?;
        let record = record.ok_or("no fragment is long enough to stand amid")?;
        Ok(LocalizationRun::of(&record).fields()?)
    }
}

/// Returns the record of the paper's robot, put down in the maze with index `here` among those that
/// it knows.
fn put_down<'a>(
    known: &'a [KnownMaze<'a>],
    here: usize,
    patterns: &'a CommonPatterns,
    approach: Approach,
    seed: u64,
) -> PutDown<'a> {
    PutDown {
        known,
        here,
        patterns,
        robot: epuck(),
        approach,
        most_places: MOST_PLACES,
        seed,
    }
}

/// Returns the record of a robot put down in a maze with fragments that look alike.
fn aliased(patterns: &CommonPatterns, approach: Approach, seed: u64) -> Result<Fields, BoxError> {
    for attempt in 0..ATTEMPTS {
        let seed = |of| run_seed(seed, of, attempt);
        let course = mazes::aliased(seed("localization mazes"))?;
        let learning = seed("localization maps");
        let learned = trials::trial(&course, patterns, trials::better(), learning).play()?;
        if !learned.is_solved() {
            continue;
        }
        let known = [KnownMaze {
            course: &course,
            learned: &learned,
        }];
        let put_down = put_down(&known, 0, patterns, approach, seed("localization"));
        if let Some(record) = put_down.play()? {
            return Ok(LocalizationRun::of(&record).fields()?);
        }
    }
    Err("no maze was solved that has a fragment to stand amid".into())
}

#[cfg(test)]
mod tests {
    use super::super::mazes;
    use super::*;
    use tolman_arena::cpm::learn;

    #[test]
    fn a_robot_put_down_finds_out_where_it_is() {
        let (courses, learning) = (mazes::papers().unwrap(), mazes::learning().unwrap());
        let patterns = learn(&learning, 1).unwrap();
        let known = Known::default();
        let mut right = 0;
        for (run, course) in (0..).zip(&courses) {
            let job = Job {
                table: LOCALIZATION,
                row: &course.name,
                run,
                seed: 7,
            };
            let fields = known.run(&courses, &patterns, 1, &job).unwrap();
            let run: LocalizationRun = fields.record().unwrap();
            right += u32::from(run.last_place);
            run.relations().unwrap();
        }
        assert!(right >= 2, "{right} of 3");
    }
}
