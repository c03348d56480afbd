//! The tables whose runs are trials: both episodes in one maze.

use tolman_systems::cpm::CpmConfig;

use super::venue;
use tolman_arena::cpm::{Likeness, Record, Trial, Venue, epuck};
use tolman_experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table};
use tolman_systems::cpm::{CommonPatterns, Mode};

/// The table of figure 9.
pub(super) const FIGURE_9: &str = "9";

/// Runs of the table of aliased mazes: one maze each.
const ALIASED_MAZES: u32 = 200;

/// As many for a first look.
const ALIASED_QUICK: u32 = 20;

/// Fragments after which the paper's system gives up in an aliased maze, which has some seven. On a map that is wrong it may go round for ever.
const ALIASED_PATIENCE: u32 = 500;

/// What follows the name of a maze in a row of our own reading.
pub(super) const BETTER: &str = " better";

/// An episode is long that leads over so many times the shortest path.
const LONG: f64 = 10.0;

/// A table of trials, and what is tried in each of its rows.
#[derive(Debug)]
pub(super) struct Trials {
    pub(super) table: Table,
    settings: Vec<Setting>,
    solution: Solution,
    /// Adds what this table measures beside what every trial does.
    own: fn(Fields, &Venue, &Record) -> Fields,
}

/// What makes a trial solved.
#[derive(Clone, Copy, Debug)]
enum Solution {
    /// The goal was found, and found again by a way as short as any that could be known.
    Way,
    /// That, and the map is right.
    WayAndMap,
}

impl Solution {
    fn is_of(self, record: &Record) -> bool {
        match self {
            Self::Way => record.is_solved(),
            Self::WayAndMap => record.is_solved() && record.is_map_right,
        }
    }
}

/// What a row tries.
#[derive(Debug)]
pub(super) struct Setting {
    pub(super) row: String,
    pub(super) place: Place,
    pub(super) mode: Mode,
}

/// Where a row's robot runs.
#[derive(Debug)]
pub(super) enum Place {
    /// In one maze.
    Maze(Venue),
    /// In another maze each run.
    Aliased,
}

/// Online, as in section 6 of the paper.
pub(super) fn faithful() -> Mode {
    Mode::Paper(CpmConfig::online())
}

/// Our own reading: dead reckoning beside the patterns.
pub(super) fn better() -> Mode {
    Mode::Reckoned(CpmConfig::robust())
}

/// Figure 9; `papers`: the mazes are the paper's.
pub(super) fn figure_9(venues: &[Venue], papers: bool) -> Trials {
    let settings = in_both_modes(venues);
    let table = fields(Table::new(
        FIGURE_9,
        "Time from the first to the second episode",
    ))
    .metric(Metric::percent("solved_percent", "solved"))
    .metric(as_it_lies())
    .metric(map_right())
    .metric(
        Metric::least("reduction_min_percent", "reduction")
            .titled("least reduction")
            .unit("%"),
    )
    .metric(named("reduction_percent", "reduction").titled("reduction").unit("%"))
    .metric(Metric::percent("long_percent", "long").titled("long ones"))
    .metric(
        named("reduction_long_percent", "reduction_long")
            .titled("reduction of long ones")
            .unit("%"),
    )
    .metric(Metric::mean("closure_precision").titled("loops closed: precision"))
    .metric(Metric::mean("closure_recall").titled("recall"))
    .metric(Metric::mean("seconds_1").titled("episode 1").unit("s"))
    .metric(Metric::mean("seconds_2").titled("episode 2").unit("s"))
    .metric(bumps())
    .paper_runs(10)
    .note(format!(
        "Solved: the goal was found, and found again by a way as short as any that could be known, where two visits are known to be of one \
         junction if a fragment was walked twice that ends there. As it lies: as short as any over the same fragments as they truly lie. \
         Map right: each junction and fragment where the robot has been is on the map once, and all are joined as they truly are. \
         Reductions are of solved runs; long ones drove {LONG} times the shortest path or more in the first episode. A run without a loop has \
         precision and recall 1. In the paper the reduction is over 50 % in every trial, and up to 95 %. \
         Its robot needs no more than two episodes either."
    ));
    let row = |setting: &Setting| {
        let row = Row::new(&setting.row);
        // The paper has no better system than its own.
        if papers && setting.mode == faithful() {
            row.paper("solved_percent", 100.0)
                .paper("reduction_min_percent", 50.0)
        } else {
            row
        }
    };
    Trials {
        table: with_rows(table, &settings, row),
        settings,
        solution: Solution::Way,
        own: |fields, _, _| fields,
    }
}

/// Each maze with the paper's system and with ours.
pub(super) fn in_both_modes(venues: &[Venue]) -> Vec<Setting> {
    let modes = [("", faithful()), (BETTER, better())];
    let each = |venue| modes.map(|(suffix, mode)| setting_in(venue, suffix, mode));
    venues.iter().flat_map(each).collect()
}

fn setting_in(venue: &Venue, suffix: &str, mode: Mode) -> Setting {
    Setting {
        row: format!("{}{suffix}", venue.name),
        place: Place::Maze(venue.clone()),
        mode,
    }
}

/// The paper's two systems side by side.
pub(super) fn offline(venues: &[Venue]) -> Trials {
    let mut settings = Vec::new();
    for venue in venues {
        let modes = [
            ("offline", Mode::Paper(CpmConfig::offline())),
            ("online", faithful()),
        ];
        for (word, mode) in modes {
            settings.push(Setting {
                row: format!("{} {word}", venue.name),
                place: Place::Maze(venue.clone()),
                mode,
            });
        }
    }
    let table = fields(Table::new("offline", "Offline against online CPM"))
        .metric(Metric::percent("solved_percent", "solved"))
        .metric(Metric::mean("traversals").titled("fragments walked"))
        .metric(Metric::mean("true_fragments").titled("different ones"))
        .metric(Metric::mean("seconds_1").titled("episode 1").unit("s"))
        .metric(Metric::mean("seconds_2").titled("episode 2").unit("s"))
        .note(
            "Offline the robot takes ports at random and looks at its map when the goal is found (section 4); online before each decision \
             (section 6). Rows of one maze meet the same chance.",
        );
    Trials {
        table: with_rows(table, &settings, |setting| Row::new(&setting.row)),
        settings,
        solution: Solution::Way,
        own: |fields, _, _| fields,
    }
}

/// "The CPs must be learned incrementally" (section 8).
pub(super) fn unlearned(venues: &[Venue]) -> Trials {
    let places = venues
        .iter()
        .map(|venue| (venue.name.as_str(), Place::Maze(venue.clone())));
    let rows = places.chain([("Aliased", Place::Aliased)]);
    let settings: Vec<Setting> = rows
        .map(|(row, place)| Setting {
            row: row.into(),
            place,
            mode: Mode::Unlearned(CpmConfig::robust()),
        })
        .collect();
    let table = fields(Table::new("unlearned", "Patterns learned on the way"))
        .field("patterns", Kind::Count)
        .metric(Metric::percent("solved_percent", "solved"))
        .metric(map_right())
        .metric(Metric::mean("closure_precision").titled("loops closed: precision"))
        .metric(Metric::mean("closure_recall").titled("recall"))
        .metric(named("reduction_percent", "reduction").titled("reduction").unit("%"))
        .metric(Metric::mean("patterns"))
        .note(
            "The better robot, which has been in no learning maze: what it observes that is like no pattern it has becomes one, and what was \
             written before stays readable. Aliased: one random maze a run.",
        );
    Trials {
        table: with_rows(table, &settings, |setting| Row::new(&setting.row)),
        settings,
        solution: Solution::Way,
        own: |fields, _, record| fields.count("patterns", record.patterns.into()),
    }
}

/// What the paper excludes. `quick`: for a first look.
pub(super) fn aliased(quick: bool) -> Trials {
    let patient = CpmConfig {
        most_traversals: ALIASED_PATIENCE,
        ..CpmConfig::online()
    };
    let rows = [("Better", better()), ("Faithful", Mode::Paper(patient))];
    let settings = rows.map(|(row, mode)| Setting {
        row: row.into(),
        place: Place::Aliased,
        mode,
    });
    let settings = Vec::from(settings);
    let table = fields(Table::new("aliased", "Mazes with fragments that look alike"))
        .field("shortest_known", Kind::Flag)
        .field("alike_pairs", Kind::Count)
        .field("symmetrical", Kind::Count)
        .metric(Metric::percent("solved_percent", "solved"))
        .metric(map_right())
        .metric(Metric::percent("shortest_known_percent", "shortest_known").titled("as known"))
        .metric(as_it_lies())
        .metric(Metric::mean("closure_precision").titled("loops closed: precision"))
        .metric(Metric::mean("closure_recall").titled("recall"))
        .metric(bumps())
        .metric(Metric::mean("alike_pairs").titled("pairs alike"))
        .metric(Metric::mean("symmetrical"))
        .note(format!(
            "One random maze a run, the same for both rows, in which two fragments or more bend alike, cell by cell, from one end or the other; \
             symmetrical ones bend the same from both. Faithful is the paper's system, whose constraints they break, and gives up after {ALIASED_PATIENCE} fragments. Solved: the goal was \
             found, and found again by a way as short as any that could be known (as known), and the map is right: each junction and fragment \
             where the robot has been is on it once, and all are joined as they truly are. As it lies: the goal was found again by a way as short as any over the \
             same fragments as they truly lie.",
        ));
    let mazes = if quick { ALIASED_QUICK } else { ALIASED_MAZES };
    Trials {
        table: with_rows(table, &settings, |setting| {
            Row::new(&setting.row).runs(mazes)
        }),
        settings,
        solution: Solution::WayAndMap,
        own: |fields, venue, record| {
            let likeness = Likeness::of(&venue.maze);
            fields
                .flag("shortest_known", record.is_solved())
                .count("alike_pairs", likeness.alike_pairs.into())
                .count("symmetrical", likeness.symmetrical.into())
        },
    }
}

fn with_rows(mut table: Table, settings: &[Setting], row: impl Fn(&Setting) -> Row) -> Table {
    for setting in settings {
        table = table.row(row(setting));
    }
    table
}

/// Whether a thing is on the map once, and where it is.
fn map_right() -> Metric {
    Metric::percent("map_right_percent", "map_right").titled("map right")
}

/// Time steps in which the robot touched a wall.
fn bumps() -> Metric {
    Metric::mean("bumps").titled("steps at a wall")
}

/// The stricter yardstick.
fn as_it_lies() -> Metric {
    Metric::percent("shortest_as_it_lies_percent", "shortest_as_it_lies").titled("as it lies")
}

/// The mean of a field under another name.
fn named(name: &str, field: &str) -> Metric {
    Metric {
        name: name.into(),
        ..Metric::mean(field)
    }
}

/// What every trial measures.
fn fields(table: Table) -> Table {
    table
        .field("solved", Kind::Flag)
        .field("shortest_as_it_lies", Kind::Flag)
        .field("map_right", Kind::Flag)
        .optional_field("reduction", Kind::Number)
        .field("long", Kind::Flag)
        .optional_field("reduction_long", Kind::Number)
        .field("closure_precision", Kind::Number)
        .field("closure_recall", Kind::Number)
        .optional_field("seconds_1", Kind::Number)
        .optional_field("seconds_2", Kind::Number)
        .optional_field("observations_1", Kind::Count)
        .optional_field("observations_2", Kind::Count)
        .field("traversals", Kind::Count)
        .field("fragments", Kind::Count)
        .field("true_fragments", Kind::Count)
        .field("contradictions", Kind::Count)
        .field("bumps", Kind::Count)
        .optional_field("trouble", Kind::Text)
}

impl Trials {
    /// Every row with the way it maps, for the configuration.
    pub(super) fn modes(&self) -> toml::Table {
        modes(&self.settings)
    }

    /// The maze and the way of mapping of a run.
    pub(super) fn cast(&self, job: &Job<'_>) -> Result<(Venue, Mode), BoxError> {
        cast(&self.settings, job)
    }

    /// Plays a run.
    pub(super) fn run(&self, patterns: &CommonPatterns, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (venue, mode) = self.cast(job)?;
        let record = trial(&venue, patterns, mode, job.seed).play()?;
        let fields = measured(&venue, &record, self.solution)?;
        Ok((self.own)(fields, &venue, &record))
    }
}

/// Every row with the way it maps, for the configuration.
pub(super) fn modes(settings: &[Setting]) -> toml::Table {
    let settings = settings.iter();
    let modes = settings.map(|Setting { row, mode, .. }| (row.clone(), format!("{mode:?}").into()));
    modes.collect()
}

/// The maze and the way of mapping of a run in one of these rows.
pub(super) fn cast(settings: &[Setting], job: &Job<'_>) -> Result<(Venue, Mode), BoxError> {
    let mut settings = settings.iter();
    let setting = settings.find(|setting| setting.row == job.row);
    let setting = setting.ok_or_else(|| format!("there is no row {:?}", job.row))?;
    let venue = match &setting.place {
        Place::Maze(venue) => venue.clone(),
        Place::Aliased => venue::aliased(job.seed)?,
    };
    Ok((venue, setting.mode))
}

/// A trial of the paper's robot.
pub(super) fn trial<'a>(
    venue: &'a Venue,
    patterns: &'a CommonPatterns,
    mode: Mode,
    seed: u64,
) -> Trial<'a> {
    Trial {
        maze: &venue.maze,
        corridor_width: venue.corridor_width,
        patterns,
        robot: epuck(),
        mode,
        seed,
    }
}

fn measured(venue: &Venue, record: &Record, solution: Solution) -> Result<Fields, BoxError> {
    let closures = record.closures;
    let is_solved = solution.is_of(record);
    let mut fields = Fields::new()
        .flag("solved", is_solved)
        .flag(
            "shortest_as_it_lies",
            record.is_solved() && record.is_shortest_as_it_lies,
        )
        .flag("map_right", record.is_map_right)
        .number("closure_precision", share(closures.right, closures.wrong))
        .number("closure_recall", share(closures.right, closures.missed))
        .count("traversals", record.traversals.into())
        .count("fragments", record.fragments.into())
        .count("true_fragments", record.true_fragments.into())
        .count("contradictions", record.contradictions.into())
        .count("bumps", record.bumps.into());
    let shortest = venue.shortest_metres();
    let is_long = is_solved && shortest.is_some_and(|shortest| metres(record) >= LONG * shortest);
    fields = fields.flag("long", is_long);
    if let Some(reduction) = record.reduction_percent().filter(|_| is_solved) {
        fields = fields.number("reduction", reduction);
        if is_long {
            fields = fields.number("reduction_long", reduction);
        }
    }
    if let Some(first) = record.first {
        fields = fields
            .number("seconds_1", first.seconds)
            .count("observations_1", first.observations.into());
    }
    if let Some(second) = record.second {
        fields = fields
            .number("seconds_2", second.seconds)
            .count("observations_2", second.observations.into());
    }
    if let Some(trouble) = &record.trouble {
        fields = fields.text("trouble", trouble);
    }
    Ok(fields)
}

/// How far the robot drove in the first episode, m.
pub(super) fn metres(record: &Record) -> f64 {
    let first = record
        .path
        .get(..record.second_from)
        .unwrap_or(&record.path);
    let steps = first.windows(2);
    steps
        .map(|pair| (pair[1].position - pair[0].position).norm())
        .sum()
}

/// Part of a whole; all of nothing.
fn share(part: u32, rest: u32) -> f64 {
    if part + rest == 0 {
        1.0
    } else {
        f64::from(part) / f64::from(part + rest)
    }
}

/// What no trial can have measured.
pub(super) fn check(run: &Run) -> Result<(), BoxError> {
    let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
    let solved = run.fields.get("solved").and_then(Field::as_flag) == Some(true);
    let is_long = run.fields.get("long").and_then(Field::as_flag) == Some(true);
    if is_long && !solved {
        return Err("a long run is one that is solved".into());
    }
    for name in ["closure_precision", "closure_recall"] {
        let share = number(name);
        if share.is_none_or(|share| !(0.0..=1.0).contains(&share)) {
            return Err(format!("{name} is {share:?}, which is no share of 1").into());
        }
    }
    for (seconds, observations) in [
        ("seconds_1", "observations_1"),
        ("seconds_2", "observations_2"),
    ] {
        if number(seconds).is_some() != number(observations).is_some() {
            return Err(format!("{seconds} and {observations} come together").into());
        }
        if number(seconds).is_some_and(|seconds| seconds < 0.0) {
            return Err(format!("{seconds} is less than 0").into());
        }
    }
    let (first, second) = (number("seconds_1"), number("seconds_2"));
    if second.is_some() && first.is_none() {
        return Err("there is no second episode without a first".into());
    }
    let reduction = match (first, second) {
        (Some(first), Some(second)) if solved => Some(100.0 * (1.0 - second / first)),
        _ if solved => return Err("a run that is solved has two episodes".into()),
        _ => None,
    };
    let is_that = |found: f64| reduction.is_some_and(|reduction| (found - reduction).abs() < 1e-9);
    match number("reduction") {
        Some(found) if !is_that(found) => {
            return Err(format!("reduction is {found}, expected {reduction:?}").into());
        }
        None if solved => return Err("a run that is solved has a reduction".into()),
        _ => {}
    }
    let of_long = number("reduction_long");
    if of_long.is_some() != is_long || of_long.is_some_and(|found| !is_that(found)) {
        return Err("the reduction of a long run, and of no other, is its reduction".into());
    }
    if number("alike_pairs").is_some_and(|pairs| pairs < 1.0) {
        return Err("no two fragments of this maze are alike".into());
    }
    if solved && run.fields.get("trouble").is_some() {
        return Err("a run in trouble is not solved".into());
    }
    for name in ["fragments", "true_fragments", "contradictions"] {
        if number(name) > number("traversals") {
            return Err(format!("more {name} than traversals").into());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(fields: Fields) -> Run {
        Run {
            table: FIGURE_9.into(),
            row: "Maze-1".into(),
            run: 0,
            seed: 1,
            fields,
        }
    }

    fn solved() -> Fields {
        Fields::new()
            .flag("solved", true)
            .flag("shortest_as_it_lies", true)
            .flag("map_right", true)
            .number("closure_precision", 1.0)
            .number("closure_recall", 0.5)
            .number("seconds_1", 200.0)
            .number("seconds_2", 50.0)
            .count("observations_1", 100)
            .count("observations_2", 5)
            .number("reduction", 75.0)
            .flag("long", false)
            .count("traversals", 9)
            .count("fragments", 4)
            .count("true_fragments", 5)
            .count("contradictions", 0)
            .count("bumps", 0)
    }

    #[test]
    fn what_no_trial_measures_is_refused() {
        let refused = |fields: Fields| check(&run(fields)).unwrap_err().to_string();
        assert!(check(&run(solved())).is_ok());
        let long = || solved().flag("long", true);
        assert!(check(&run(long().number("reduction_long", 75.0))).is_ok());
        for (fields, why) in [
            (solved().number("closure_recall", 1.5), "no share"),
            (solved().number("reduction", 70.0), "expected Some(75"),
            (long().number("reduction_long", 70.0), "is its reduction"),
            (long(), "is its reduction"),
            (
                solved().flag("solved", false).flag("long", true),
                "long run",
            ),
            (solved().flag("solved", false), "expected None"),
            (solved().text("trouble", "lost"), "trouble"),
            (solved().count("fragments", 10), "more fragments"),
        ] {
            let found = refused(fields);
            assert!(found.contains(why), "{found}");
        }
    }
}
