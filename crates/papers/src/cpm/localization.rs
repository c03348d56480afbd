//! A robot that knows several mazes is put down in mid-fragment of one of them: section 8, "the start point is changed", and layer 4.

use std::sync::OnceLock;

use super::{trials, venue};
use tolman_arena::cpm::{KnownMaze, PutDown, PutDownRecord, Record, Venue, epuck};
use tolman_experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table, run_seed};
use tolman_systems::cpm::{Approach, CommonPatterns};

/// The name of the table.
pub(super) const LOCALIZATION: &str = "localization";

/// After so many places the robot has to know where it is.
const MOST_PLACES: u32 = 6;

/// Trials that are made at most to have a map of a maze.
const ATTEMPTS: u32 = 20;

/// Runs of a row: a share of 90 % is known to within 6 % then.
const RUNS: u32 = 100;

/// So many maps of each maze are learned, which runs share in turn; aliased mazes have one each run.
const MAPS: usize = 20;

/// As many for a first look.
const QUICK_RUNS: u32 = 5;

/// The row of mazes with fragments that look alike, another one each run, of which the robot knows that one alone.
const ALIASED: &str = "Aliased";

/// What follows the name of a maze in a row of robots that turn round where they are not sure.
const TO_AND_FRO: &str = " to and fro";

/// What could be known before the first place: the name of the metric, and that on a page.
const KNOWABLE: [(&str, &str); 2] = [
    ("bends_percent", "could be known by bends"),
    ("places_percent", "and by the places at the ends"),
];

/// The yes or no of a run: the beginning of its metric's name, and that on a page.
const FLAGS: [(&str, &str); 6] = [
    ("turned_round", "turned round"),
    ("under_way", "right before it enters a place"),
    ("first_place", "in the middle of the first"),
    ("one_further", "within one further fragment"),
    ("last_place", "at the last"),
    ("recalled", "maze recalled by SOINN-AM"),
];

/// What the robot learned of each maze, several times, by whoever asks first.
#[derive(Debug, Default)]
pub(super) struct Known([OnceLock<Vec<Record>>; MAPS]);

/// The maze of a row, and the robot's approach.
fn cast(row: &str) -> (&str, Approach) {
    match row.strip_suffix(TO_AND_FRO) {
        Some(maze) => (maze, Approach::ToAndFro),
        None => (row, Approach::StraightOn),
    }
}

/// `quick`: for a first look.
pub(super) fn table(venues: &[Venue], quick: bool) -> Table {
    let mut table = Table::new(LOCALIZATION, "Put down in mid-fragment of one of the mazes")
        .field("places", Kind::Count)
        .field("seconds", Kind::Number)
        .field("bends_percent", Kind::Number)
        .field("places_percent", Kind::Number)
        .field("turned_round", Kind::Flag)
        .field("under_way", Kind::Flag)
        .field("first_place", Kind::Flag)
        .field("one_further", Kind::Flag)
        .field("last_place", Kind::Flag)
        .optional_field("recalled", Kind::Flag);
    for (name, title) in KNOWABLE {
        table = table.metric(Metric::mean(name).titled(title).unit("%").decimals(1));
    }
    for (name, title) in FLAGS {
        table = table.metric(Metric::percent(format!("{name}_percent"), name).titled(title));
    }
    table = table
        .metric(Metric::mean("places").titled("places come to"))
        .metric(Metric::mean("seconds").titled("time").unit("s"));
    let runs = if quick { QUICK_RUNS } else { RUNS };
    let mazes = venues.iter().map(|venue| venue.name.as_str());
    for maze in mazes.chain([ALIASED]) {
        for suffix in ["", TO_AND_FRO] {
            table = table.row(Row::new(format!("{maze}{suffix}")).runs(runs));
        }
    }
    table.note(format!(
        "The robot knows all these mazes by maps of one dictionary, each that of a solved trial, twenty in turn, and is put down in the \
         middle of a cell amid a fragment of the row's that its map has; of mazes with fragments that look alike, another one each run, it knows that one. It drives straight on to \
         the place ahead, or to and fro: if it is not sure when that place comes into sight, it turns round and goes to the other end. Right: maze, fragment and direction, when the place that it \
         is about to enter is in sight, and in the middle of it; within one further fragment: at that place if it was sure there, else before the next one. It goes on \
         until it is sure, up to {MOST_PLACES} places. What could be known is how often the best guess is right of an observer that knows the mazes and sees \
         without mistake how the corridor bends in every cell from the one behind on, and of one that sees the place ahead too, and the sides of the one behind if it stands beside it. SOINN-AM is asked with the first fragment walked whole."
    ))
}

impl Known {
    /// A solved trial of each maze, for one run of a row.
    fn records(
        &self,
        venues: &[Venue],
        patterns: &CommonPatterns,
        master_seed: u64,
        run: u32,
    ) -> Result<&[Record], BoxError> {
        let number = run as usize % MAPS;
        if let Some(records) = self.0[number].get() {
            return Ok(records);
        }
        let mut records = Vec::new();
        for venue in venues {
            let mut found = None;
            for attempt in 0..ATTEMPTS {
                // Not the chance of any run of the table.
                let attempt = number as u32 * ATTEMPTS + attempt;
                let seed = run_seed(master_seed, "localization maps", attempt);
                let record = trials::trial(venue, patterns, trials::better(), seed).play()?;
                if record.is_solved() {
                    found = Some(record);
                    break;
                }
            }
            let name = &venue.name;
            records.push(found.ok_or_else(|| format!("no trial of {name} was solved"))?);
        }
        // Two threads may learn them at once; they learn the same.
        Ok(self.0[number].get_or_init(|| records))
    }

    /// One robot put down.
    pub(super) fn run(
        &self,
        venues: &[Venue],
        patterns: &CommonPatterns,
        master_seed: u64,
        job: &Job<'_>,
    ) -> Result<Fields, BoxError> {
        let (maze, approach) = cast(job.row);
        if maze == ALIASED {
            return aliased(patterns, approach, job.seed);
        }
        let records = self.records(venues, patterns, master_seed, job.run)?;
        let known: Vec<KnownMaze<'_>> = venues
            .iter()
            .zip(records)
            .map(|(venue, record)| known(venue, record))
            .collect();
        let here = venues.iter().position(|venue| venue.name == maze);
        let here = here.ok_or("there is no such row")?;
        let put_down = PutDown {
            known: &known,
            here,
            corridor_width: venues[here].corridor_width,
            patterns,
            robot: epuck(),
            approach,
            most_places: MOST_PLACES,
            seed: job.seed,
        };
        let record = put_down
            .play()?
            .ok_or("no fragment is long enough to stand amid")?;
        Ok(measured(&record))
    }
}

/// A robot put down in a maze with fragments that look alike.
fn aliased(patterns: &CommonPatterns, approach: Approach, seed: u64) -> Result<Fields, BoxError> {
    for attempt in 0..ATTEMPTS {
        let seed = |of| run_seed(seed, of, attempt);
        let venue = venue::aliased(seed("localization mazes"))?;
        let learning = seed("localization maps");
        let learned = trials::trial(&venue, patterns, trials::better(), learning).play()?;
        if !learned.is_solved() {
            continue;
        }
        let put_down = PutDown {
            known: &[known(&venue, &learned)],
            here: 0,
            corridor_width: venue.corridor_width,
            patterns,
            robot: epuck(),
            approach,
            most_places: MOST_PLACES,
            seed: seed("localization"),
        };
        if let Some(record) = put_down.play()? {
            return Ok(measured(&record));
        }
    }
    Err("no maze was solved that has a fragment to stand amid".into())
}

fn known<'a>(venue: &'a Venue, record: &'a Record) -> KnownMaze<'a> {
    KnownMaze {
        maze: &venue.maze,
        map: &record.map,
        truth: &record.truth,
    }
}

fn measured(record: &PutDownRecord) -> Fields {
    let places = record.whereabouts.at_places.len();
    let mut fields = Fields::new()
        .count("places", places as u64)
        .number("seconds", record.seconds)
        .number("bends_percent", 100.0 * record.knowable_by_bends)
        .number("places_percent", 100.0 * record.knowable_by_places)
        .flag("turned_round", record.whereabouts.has_turned_round)
        .flag("under_way", record.is_right_under_way)
        .flag("first_place", record.is_right_at_first_place)
        .flag("one_further", record.is_right_within_one_further)
        .flag("last_place", record.is_right_at_last);
    if let Some(recalled) = record.is_recalled {
        fields = fields.flag("recalled", recalled);
    }
    fields
}

/// What no run of this table can be.
pub(super) fn check(run: &Run) -> Result<(), BoxError> {
    let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
    let flag = |name: &str| run.fields.get(name).and_then(Field::as_flag);
    let places = number("places").unwrap_or_default();
    if !(1.0..=f64::from(MOST_PLACES)).contains(&places) {
        return Err(format!("{places} places, expected 1 to {MOST_PLACES}").into());
    }
    for (name, _) in KNOWABLE {
        let knowable = number(name).unwrap_or_default();
        // The best guess is wrong, or one of so many that are as good.
        let guesses = 100.0 / knowable;
        if knowable > 0.0 && (guesses - guesses.round()).abs() > 1e-6 {
            return Err(
                format!("{name} is {knowable}, expected 0 or 100 over a whole number").into(),
            );
        }
    }
    let (_, approach) = cast(&run.row);
    let has_turned = flag("turned_round") == Some(true);
    if has_turned && approach == Approach::StraightOn {
        return Err("a robot that goes straight on has turned round".into());
    }
    let has_walked = places > 1.5 || has_turned;
    if flag("recalled").is_some() && !has_walked {
        return Err("a maze is recalled, and no fragment was walked whole".into());
    }
    let is_as_at_first = |name| flag(name) == flag("first_place");
    if places < 1.5 && !(is_as_at_first("last_place") && is_as_at_first("one_further")) {
        return Err("the first place is the last one".into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::venue;
    use super::*;
    use tolman_arena::cpm::learn;

    #[test]
    fn a_robot_put_down_finds_out_where_it_is() {
        let (venues, learning) = (venue::papers().unwrap(), venue::learning().unwrap());
        let patterns = learn(&learning.maze, learning.corridor_width, 1).unwrap();
        let known = Known::default();
        let mut right = 0;
        for (run, venue) in (0..).zip(&venues) {
            let job = Job {
                table: LOCALIZATION,
                row: &venue.name,
                run,
                seed: 7,
            };
            let fields = known.run(&venues, &patterns, 1, &job).unwrap();
            right += u32::from(fields.get("last_place") == Some(&Field::Flag(true)));
            let run = Run {
                table: job.table.into(),
                row: job.row.into(),
                run,
                seed: 7,
                fields,
            };
            check(&run).unwrap();
        }
        assert!(right >= 2, "{right} of 3");
    }
}
