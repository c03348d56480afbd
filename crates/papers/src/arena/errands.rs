//! Table `errands`: deliveries from landmark to landmark, from the first minute.

use tolman_arena::contest::{Condition, Contest, Errands, ErrandsRecord};
use tolman_arena::registry::{Registry, SystemEntry};
use tolman_draw::{Axis, Chart, Figure, Line, LinePoint, Series};
use tolman_experiment::{BoxError, Fields, Options, Record, Row, Run, Table, record};

use super::rows::{ALL, BETWEEN, RowName};
use super::worlds::ArenaWorld;
use super::{Arena, ENTRY};
use crate::metrics::UsualMetrics as _;

/// Name of the table.
pub(super) const TABLE: &str = "errands";

/// Conditions of the table.
const CONDITIONS: [Condition; 3] = [
    Condition::AsMade,
    Condition::MovingDoors,
    Condition::ConstantOdometry,
];

/// What is added to the name of a system that learns the whole world before its first errand.
const LEARNS_FIRST: &str = ", learns first";

/// Number of marks, in equal shares of a run's metres, at which deliveries are counted.
const MARKS: u32 = 20;

record! {
    /// A run of errands.
    pub(super) struct ErrandsRun {
        /// Whether it declared, before it drove, that it cannot work there, or no opening of the
        /// drawing can be shut.
        abstained: bool => neither("abstained"),
        /// Percent of the oracle's deliveries in the same metres; above 100 if it cuts corners.
        oracle_rate_percent: Option<f64> => higher("of the oracle").unit("%").at_least(0).decimals(1),
        /// The same in the last third of the metres.
        oracle_rate_last_third_percent: Option<f64> => higher("in the last third").unit("%").at_least(0).decimals(1),
        /// Metres until the first delivery.
        metres_until_first: Option<f64> => lower("until the first").unit("m"),
        /// Metres until the third delivery.
        metres_until_third: Option<f64> => lower("until the third").unit("m"),
        /// Metres until the tenth delivery.
        metres_until_tenth: Option<f64> => lower("until the tenth").unit("m"),
        /// Number of errands that were given up.
        given_up: Option<u32> => lower("given up"),
        /// Number of errands that the system called done elsewhere.
        wrong_arrivals: Option<u32> => lower("wrong arrivals"),
        /// Deliveries after each twentieth of the metres.
        delivered: Option<Vec<f64>> => neither("delivered"),
        /// Most frequent reason for which errands were given up.
        why: String => neither("reason"),
    }
}

impl ErrandsRun {
    fn of(record: &ErrandsRecord) -> Self {
        if let Some(why) = &record.abstained {
            return Self {
                abstained: true,
                why: why.clone(),
                ..Self::default()
            };
        }
        let mark = |mark: u32| f64::from(mark) / f64::from(MARKS) * record.metres;
        let by = |metres: f64| record.deliveries.iter().filter(|at| **at <= metres).count() as f64;
        let most = record.given_up.iter().max_by_key(|(_, times)| **times);
        Self {
            abstained: false,
            oracle_rate_percent: Some(100.0 * record.oracle_rate()),
            oracle_rate_last_third_percent: Some(100.0 * record.oracle_rate_last_third()),
            metres_until_first: record.metres_until(1),
            metres_until_third: record.metres_until(3),
            metres_until_tenth: record.metres_until(10),
            given_up: Some(record.given_up.values().sum()),
            wrong_arrivals: Some(record.wrong_arrivals),
            delivered: Some((1..=MARKS).map(|each| by(mark(each))).collect()),
            why: most.map_or_else(String::new, |(why, _)| why.clone()),
        }
    }
}

/// The parts of a row's name.
struct ErrandsRow<'a> {
    contestant: &'static dyn SystemEntry,
    learns_first: bool,
    condition: Condition,
    world: &'a str,
}

impl<'a> ErrandsRow<'a> {
    fn read(row: &'a str) -> Option<Self> {
        let (entrant, rest) = row.split_once(BETWEEN)?;
        let (condition, world) = rest.split_once(BETWEEN)?;
        let system = entrant.strip_suffix(LEARNS_FIRST);
        Some(Self {
            contestant: Registry::current().system(system.unwrap_or(entrant))?,
            learns_first: system.is_some(),
            condition: Condition::named(condition)?,
            world,
        })
    }
}

/// Returns the names of all that run errands: systems, each again as one that learns first, and
/// baselines.
fn entrants() -> Vec<String> {
    let contestants = Registry::current().contestants();
    let contestants = contestants.filter(|one| one.facts().delivers);
    let names = contestants.flat_map(|one| {
        let first = one
            .learns()
            .then(|| format!("{}{LEARNS_FIRST}", one.title()));
        [Some(one.title().to_owned()), first]
    });
    names.flatten().collect()
}

fn row_name(entrant: &str, condition: Condition, world: &str) -> String {
    format!("{entrant}{BETWEEN}{}{BETWEEN}{world}", condition.name())
}

/// Returns the table. It is filled where it or its runs are asked for: a run takes seconds.
pub(super) fn table(worlds: &[ArenaWorld], options: &Options) -> Table {
    let is_named = options.tables.iter().any(|name| name == TABLE);
    let runs = match is_named {
        true => options.runs_of(&ENTRY),
        false => options.runs_else(0, 0),
    };
    let mut rows = Vec::new();
    for entrant in entrants() {
        for condition in CONDITIONS {
            let row = |world: &str| Row::new(row_name(&entrant, condition, world));
            rows.extend(worlds.iter().map(|world| row(world.name()).runs(runs)));
            let all = runs.saturating_mul(worlds.len() as u32);
            rows.push(row(ALL).runs(all));
        }
    }
    Table::of::<ErrandsRun>(TABLE, "Errands from landmark to landmark, with an empty map")
        .metrics([
            ErrandsRun::oracle_rate_percent,
            ErrandsRun::oracle_rate_last_third_percent,
            ErrandsRun::metres_until_first,
            ErrandsRun::metres_until_third,
            ErrandsRun::metres_until_tenth,
            ErrandsRun::given_up,
            ErrandsRun::wrong_arrivals,
            ErrandsRun::abstained,
        ])
        .rows(rows)
        .note(
            "Four to eight landmarks, named one after another by seed; the robot begins with an empty \
             map and looks for what is not on it. A run lasts as many metres as an oracle needs for \
             60 errands, which knows the world, doors included, and takes each errand's shortest way. \
             Giving up costs the oracle's way. Moving doors: every fifth errand one of up to six \
             openings shuts or opens; drawings without loops have none. Constant odometry: off by up \
             to 10 %. `learns first` explores the whole world before its first errand.",
        )
}

impl Arena {
    /// Plays a run of the table of errands.
    pub(super) fn errands(&self, row: &str, run: u32) -> Result<Fields, BoxError> {
        let row = ErrandsRow::read(row).ok_or("there is no such row of errands")?;
        let name = RowName {
            contestant: row.contestant,
            world: row.world,
        };
        let drawn = self.world(&name, run)?;
        let errands = Errands {
            contest: Contest {
                condition: row.condition,
                ..drawn.contest(row.contestant, None)
            },
            learns_first: row.learns_first,
        };
        let record = errands.play(&self.schooling, |_, _| {})?;
        Ok(ErrandsRun::of(&record).fields()?)
    }
}

/// Returns a chart for each condition: deliveries against metres, for all in one.
pub(super) fn figures(runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
    let mut figures = Vec::new();
    for condition in CONDITIONS {
        let metres = Axis::linear("metres, % of the run").from_zero();
        let mut chart = Chart::new(metres, Axis::linear("deliveries").from_zero());
        let mut has_lines = false;
        for (series, entrant) in (0..).zip(entrants()) {
            let of_row = ErrandsRun::of_row(runs, TABLE, &row_name(&entrant, condition, ALL))?;
            let curves: Vec<Vec<f64>> =
                of_row.into_iter().filter_map(|run| run.delivered).collect();
            let mut points = vec![LinePoint::new(0.0, 0.0)];
            for mark in 0..MARKS as usize {
                let at: Vec<f64> = curves
                    .iter()
                    .filter_map(|curve| curve.get(mark))
                    .copied()
                    .collect();
                if let Ok(mean) = tolman_stats::mean(&at) {
                    let share = 100.0 * (mark + 1) as f64 / f64::from(MARKS);
                    points.push(LinePoint::new(share, mean));
                }
            }
            if points.len() > 1 {
                has_lines = true;
                chart.line(Line::new(entrant, Series(series), points));
            }
        }
        if has_lines {
            let name = condition.name();
            let title = format!("Deliveries against metres, {name}");
            let drawing = chart.drawing("Deliveries of all systems against the metres driven.");
            let name = format!("errands-{}", name.replace(' ', "-"));
            figures.push(Figure::new(name, title, drawing).table(TABLE));
        }
    }
    Ok(figures)
}
