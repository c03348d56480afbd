//! The figures of "Maps Considered as Adaptive Planning Resources" as tables: how well a robot that
//! walks through an office learns its map.

mod ablations;
mod figures;
mod firings;
mod fresh;
mod objection;
mod odometry_off;
mod replay;
mod settings;
mod standstill;

use alloc::collections::BTreeMap;

use crate::rows::row_of;
use tolman_arena::diktiometry::{ErrorSummary, NEAR, PlanTrial, Survey, TAIL, WINDOW};
use tolman_draw::Figure;
use tolman_experiment::{
    Beside, BoxError, Correction, Easel, Entry, Experiment, Fields, Headline, Job, Metric, Options,
    Procedure, Record, Row, Run, Settling, Table, record,
};
use tolman_replay::Replay;
use tolman_systems::stream;

pub use ablations::{ABLATIONS, Change};
use firings::{PARTS, PartsRow};
use fresh::{FRESH, FreshRow};
use odometry_off::{BlindRow, ODOMETRY_OFF};
use settings::{Rows, Setting, Subject, Trial};

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "diktiometry",
    title: "Diktiometry: maps considered as adaptive planning resources",
    source: "S. Engelson, D. McDermott: Maps Considered as Adaptive Planning Resources, figures 3 and 4",
    runs: 10,
    quick_runs: 2,
    main: &["3b"],
    tour: &[
        Headline {
            system: "Diktiometry",
            measures: "maps of offices right, %",
            table: "fresh worlds",
            row: "5x5 with scripts",
            metric: "right_percent",
            beside: Beside::Rival {
                row: "5x5 with scripts (paper's rule)",
                called: "paper's rule",
            },
            runs: Some(5),
        },
        Headline {
            system: "Odometry off",
            measures: "maps of offices exact, %",
            table: "odometry off",
            row: "office",
            metric: "exact_percent",
            beside: Beside::Nothing,
            runs: Some(20),
        },
    ],
    open,
};

/// Stream of a run's seed from which plans are drawn.
const PLAN_STREAM: u64 = 3;

/// The prepared experiment.
#[derive(Debug)]
struct Diktiometry {
    trials: Vec<Trial>,
    fresh: Vec<FreshRow>,
    blind: Vec<BlindRow>,
    parts: Vec<PartsRow>,
}

/// Returns the experiment with its offices.
///
/// # Errors
/// If the caller names mazes, which this experiment does not use, or an office cannot be built.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    if !options.mazes.is_empty() {
        return Err("the tables are of offices: leave --maze out".into());
    }
    let trials = settings::all()?;
    let fresh = fresh::rows();
    let mut tables: Vec<Table> = trials.iter().map(table).collect();
    tables.push(fresh::table(&fresh, options));
    let blind = odometry_off::rows();
    tables.push(odometry_off::table(&blind, options));
    let parts = firings::rows();
    tables.push(firings::table(&parts, options));
    let mut config = BTreeMap::<_, BTreeMap<_, _>>::new();
    for trial in &trials {
        let rows = trial.settings.iter();
        let rows = rows.map(|setting| (setting.row, setting.config()));
        config.insert(trial.name, rows.collect());
    }
    let mut config = toml::Table::try_from(config)?;
    let kinds: BTreeMap<_, _> = fresh.iter().map(|row| (row.row, row.config())).collect();
    config.insert(FRESH.to_owned(), toml::Value::try_from(kinds)?);
    let procedure = Diktiometry {
        trials,
        fresh,
        blind,
        parts,
    };
    Ok(Experiment::new(ENTRY, tables, config, procedure))
}

record! {
    /// A walk through an office. The row of odometry has only its error.
    pub(super) struct SurveyRun {
        /// Mean squared error per move over the last moves.
        ssd_asymptote: f64 =>
            lower("final squared error per move").unit("m²").at_least(0).decimals(4),
        /// Error of the odometry alone, m².
        odometry: Option<f64> => lower("odometry's error").unit("m²").at_least(0),
        /// Number of moves until the run is near its own asymptote.
        moves_to_own_asymptote: Option<usize> => lower("moves to its own asymptote"),
        /// Squared error per move, each number the mean of a window of moves.
        curve: Vec<f64> => lower("squared error per move").unit("m²").at_least(0),
        /// Share of the visits that were to the true place that their place on the map stands for.
        purity: Option<f64> => higher("purity").share().decimals(4),
        /// Share of the map's links that lead where their action truly leads.
        link_precision: Option<f64> => higher("link precision").share().decimals(4),
        /// Share of the believed present links that lead to their place.
        believed_precision: Option<f64> =>
            higher("precision of links believed now").share().decimals(4),
        /// Share of the ways, as they were last seen, that still lead there.
        remembered_precision: Option<f64> =>
            higher("precision of ways as last seen").share().decimals(4),
        /// Share of the true ways of the whole world that are on the map.
        link_recall: Option<f64> => higher("link recall").share().decimals(4),
        /// Share of the visited true places that have exactly one place on the map.
        share_once: Option<f64> => higher("true places with one node").share().decimals(4),
        /// Share of the last moves that the map expected.
        coverage: Option<f64> => higher("expected moves").share().decimals(4),
        /// Share of the plans to existing places that work.
        plans: Option<f64> =>
            higher("working plans, to existing places").share().decimals(4),
        /// Share of those plans that work with the ways as they were last seen.
        remembered_plans: Option<f64> =>
            higher("working plans, by ways as last seen").share().decimals(4),
        /// Share of all plans that lead to places that no longer exist.
        plans_to_gone: Option<f64> => lower("plans to vanished places").share().decimals(4),
        /// Number of places on the map.
        places: Option<usize> => neither("places on the map").decimals(1),
        /// Number of true places where the robot was.
        visited: Option<usize> => neither("true places visited").decimals(1),
        /// Whether the map has exactly the visited true places and the ways between them.
        isomorphic: Option<bool> => higher("map matches the world"),
    }
}

fn table(trial: &Trial) -> Table {
    let reference = trial.settings.first().map_or("", |setting| setting.row);
    let mut table = Table::of::<SurveyRun>(trial.name, trial.title)
        .metric(Metric::mean(SurveyRun::ssd_asymptote));
    if trial.rows == Rows::OneWorld {
        let settling = Settling {
            curve: SurveyRun::curve.to_owned(),
            step: WINDOW as f64,
            level: SurveyRun::ssd_asymptote.to_owned(),
            margin: NEAR,
            scale: SurveyRun::odometry.to_owned(),
            of: reference.to_owned(),
        };
        table = table
            .metric(Metric::settling("moves_to_asymptote", settling).titled("moves to asymptote"))
            .metric(Metric::mean(SurveyRun::moves_to_own_asymptote))
            .compared_with(reference, Correction::Holm);
    }
    let tail = format!(
        "A row's error at last is the mean over the last {:.0} % of the moves.",
        100.0 * TAIL
    );
    let near = 100.0 * NEAR;
    let note = match trial.rows {
        Rows::OneWorld => format!(
            "{} {tail} The asymptote is the lowest of the table. A row reaches it when the mean over \
             all its runs and {WINDOW} moves stays less than {near:.0} % of odometry's error above \
             it. To its own asymptote: the same for each run alone, an earlier definition.",
            trial.note,
        ),
        Rows::OwnWorlds => format!("{} {tail}", trial.note),
    };
    let rows = trial.settings.iter();
    table
        .metrics_from(SurveyRun::purity)
        .rows(rows.map(|setting| Row::new(setting.row)))
        .note(note)
}

/// Returns the share of a part in the whole; `None` if the whole is 0.
fn share(part: usize, whole: usize) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

impl Diktiometry {
    fn setting(&self, job: &Job<'_>) -> Result<&Setting, BoxError> {
        let trials = self.trials.iter().filter(|trial| trial.name == job.table);
        let settings = trials.flat_map(|trial| &trial.settings);
        row_of(job, settings, |setting| setting.row == job.row)
    }

    fn fresh(&self, job: &Job<'_>) -> Result<&FreshRow, BoxError> {
        row_of(job, &self.fresh, |row| row.row == job.row)
    }
}

impl Procedure for Diktiometry {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        if job.table == FRESH {
            return self.fresh(job)?.run(job.seed);
        }
        if job.table == ODOMETRY_OFF {
            return row_of(job, &self.blind, |row| row.row == job.row)?.run(job.seed);
        }
        if job.table == PARTS {
            return row_of(job, &self.parts, |row| row.fresh.row == job.row)?.run(job.seed);
        }
        let setting = self.setting(job)?;
        let mut plans = Vec::new();
        let mut rng = stream(job.seed, PLAN_STREAM);
        let config = &setting.config;
        let survey = Survey::run(&setting.office, config.clone(), job.seed, |survey, _| {
            // Plans are tried in the part of the walk where the asymptote is measured.
            let late = f64::from(survey.moves()) > (1.0 - TAIL) * f64::from(config.moves);
            if late && setting.subject == Subject::Map && survey.moves().is_multiple_of(5) {
                plans.extend(survey.try_plan(&mut rng));
            }
            Ok(())
        })?;
        let summary = ErrorSummary::of(survey.errors()).ok_or("no move was made")?;
        if setting.subject == Subject::Odometry {
            let run = SurveyRun {
                ssd_asymptote: summary.odometry,
                curve: summary.odometry_curve,
                ..SurveyRun::default()
            };
            return Ok(run.fields()?);
        }
        let score = survey.score();
        let count = |is: fn(&&PlanTrial) -> bool| plans.iter().filter(is).count();
        let gone = count(|plan| **plan == PlanTrial::Gone);
        let there = plans.len() - gone;
        let work = count(|plan| matches!(plan, PlanTrial::There { works: true, .. }));
        let remembered = |plan: &&PlanTrial| matches!(plan, PlanTrial::There { remembered_works, .. } if *remembered_works);
        let run = SurveyRun {
            ssd_asymptote: summary.asymptote,
            odometry: Some(summary.odometry),
            moves_to_own_asymptote: Some(summary.moves_to_own),
            curve: summary.curve,
            purity: Some(score.purity),
            link_precision: Some(score.link_precision),
            believed_precision: Some(score.believed_precision),
            remembered_precision: Some(survey.remembered_precision()),
            link_recall: Some(score.link_recall),
            share_once: Some(score.share_once),
            coverage: Some(summary.coverage),
            plans: share(work, there),
            remembered_plans: share(count(remembered), there),
            plans_to_gone: share(gone, plans.len()),
            places: Some(score.places),
            visited: Some(score.visited),
            isomorphic: Some(score.is_isomorphic),
        };
        Ok(run.fields()?)
    }

    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        figures::of(&self.trials, runs, easel)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        if job.table == FRESH {
            let (office, config) = self.fresh(job)?.draw(job.seed)?;
            return replay::of(&office, &config, job).map(Some);
        }
        if [ODOMETRY_OFF, PARTS].contains(&job.table) {
            return Ok(None);
        }
        let setting = self.setting(job)?;
        match setting.subject {
            // The many rows of the ablation would fill the report, and take as long as all others
            // together.
            Subject::Map if job.table == settings::ABLATION => Ok(None),
            Subject::Map => replay::of(&setting.office, &setting.config, job).map(Some),
            Subject::Odometry => Ok(None),
        }
    }
}
