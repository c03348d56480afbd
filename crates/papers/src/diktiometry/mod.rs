//! The figures of "Maps Considered as Adaptive Planning Resources" as tables: how a robot that walks an office learns its map.

pub mod drawing;
mod figures;
mod replay;
mod settings;

use tolman_arena::diktiometry::{ErrorSummary, Isomorphism, NEAR, PlanTrial, Survey, TAIL, WINDOW};
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Correction, Experiment, Field, Fields, Job, Kind, Metric, Options, Row, Run,
    Settling, Table,
};
use tolman_replay::Replay;

use settings::{Rows, Setting, Subject, Trial};

/// The experiment, ready to run.
#[derive(Debug)]
struct Diktiometry {
    trials: Vec<Trial>,
    tables: Vec<Table>,
}

/// Builds the offices. Maze files have no part in it.
///
/// # Errors
/// If an office cannot be built.
pub(super) fn open(_options: &Options) -> Result<Box<dyn Experiment>, BoxError> {
    let trials = settings::all()?;
    let tables = trials.iter().map(table).collect();
    Ok(Box::new(Diktiometry { trials, tables }))
}

/// The shares that a map is scored by: the name of the field and metric, and the name on the page.
const SHARES: [(&str, &str); 10] = [
    ("purity", "purity"),
    ("link_precision", "link precision"),
    (
        "believed_precision",
        "precision of links that are believed now",
    ),
    ("remembered_precision", "of ways as they were last seen"),
    ("link_recall", "link recall"),
    ("share_once", "true places with one node"),
    ("coverage", "moves that were expected"),
    ("plans", "plans that work, to places that are there"),
    (
        "remembered_plans",
        "plans by ways as they were last seen that work",
    ),
    ("plans_to_gone", "plans to places that are gone"),
];

/// What became of the plans of a run.
#[derive(Debug, Default)]
struct Plans {
    /// Those to places that were there.
    there: u32,
    /// Of these, those that work.
    work: u32,
    /// Of these, those by ways as they were last seen that work.
    remembered_work: u32,
    /// Those to places that were gone.
    gone: u32,
}

impl Plans {
    fn count(&mut self, trial: PlanTrial) {
        match trial {
            PlanTrial::Gone => self.gone += 1,
            PlanTrial::There {
                works,
                remembered_works,
            } => {
                self.there += 1;
                self.work += u32::from(works);
                self.remembered_work += u32::from(remembered_works);
            }
        }
    }
}

fn table(trial: &Trial) -> Table {
    let reference = trial.settings.first().map_or("", |setting| setting.row);
    let mut table = Table::new(trial.name, trial.title)
        .field("ssd_asymptote", Kind::Number)
        .field("curve", Kind::Curve)
        .optional_field("odometry", Kind::Number)
        .optional_field("places", Kind::Count)
        .optional_field("visited", Kind::Count)
        .optional_field("isomorphic", Kind::Flag)
        .metric(
            Metric::mean("ssd_asymptote")
                .titled("squared error a move, at last")
                .unit("m²")
                .decimals(4),
        );
    if trial.rows == Rows::OneWorld {
        let settling = Settling {
            curve: "curve".to_owned(),
            step: WINDOW as f64,
            level: "ssd_asymptote".to_owned(),
            margin: NEAR,
            scale: "odometry".to_owned(),
            of: reference.to_owned(),
        };
        table = table
            .metric(Metric::settling("moves_to_asymptote", settling).titled("moves to asymptote"))
            .compared_with(reference, Correction::Holm);
    }
    for (name, title) in SHARES {
        table = table
            .optional_field(name, Kind::Number)
            .metric(Metric::mean(name).titled(title).decimals(4));
    }
    table = table
        .metric(
            Metric::mean("places")
                .titled("places on the map")
                .decimals(1),
        )
        .metric(
            Metric::mean("visited")
                .titled("true places visited")
                .decimals(1),
        )
        .metric(Metric::percent("isomorphic_percent", "isomorphic").titled("map is the world"));
    for setting in &trial.settings {
        table = table.row(Row::new(setting.row));
    }
    let tail = format!(
        "A row's error at last is the mean over the last {:.0} % of the moves.",
        100.0 * TAIL
    );
    let note = match trial.rows {
        Rows::OneWorld => format!(
            "{} {tail} The asymptote is the lowest of the table; a row is there when the mean over all its runs and {WINDOW} moves stays less than \
             {:.0} % of odometry's error above it.",
            trial.note,
            100.0 * NEAR,
        ),
        Rows::OwnWorlds => format!("{} {tail}", trial.note),
    };
    table.note(note)
}

impl Diktiometry {
    fn setting(&self, job: &Job<'_>) -> Result<&Setting, BoxError> {
        let trial = self.trials.iter().find(|trial| trial.name == job.table);
        let mut settings = trial.into_iter().flat_map(|trial| &trial.settings);
        let setting = settings.find(|setting| setting.row == job.row);
        setting.ok_or_else(|| format!("there is no row {:?}", job.row).into())
    }
}

impl Experiment for Diktiometry {
    fn name(&self) -> &str {
        "diktiometry"
    }

    fn title(&self) -> &str {
        "Diktiometry: maps considered as adaptive planning resources"
    }

    fn source(&self) -> &str {
        "S. Engelson, D. McDermott: Maps Considered as Adaptive Planning Resources, figures 3 and 4"
    }

    fn default_runs(&self) -> u32 {
        10
    }

    fn quick_runs(&self) -> u32 {
        2
    }

    fn tables(&self) -> &[Table] {
        &self.tables
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        let mut config = toml::Table::new();
        for trial in &self.trials {
            let mut rows = toml::Table::new();
            for setting in &trial.settings {
                let mut row = toml::Table::new();
                let run = &setting.config;
                row.insert("robot".into(), toml::Value::try_from(&run.robot)?);
                row.insert("mapper".into(), toml::Value::try_from(&run.mapper)?);
                row.insert("heed".into(), run.heed.into());
                row.insert("moves".into(), run.moves.into());
                row.insert("door_period".into(), run.door_period.into());
                let (maze, furniture) = (setting.office.maze(), setting.office.config());
                row.insert("maze".into(), maze.to_string().into());
                row.insert("furniture".into(), toml::Value::try_from(furniture)?);
                rows.insert(setting.row.into(), row.into());
            }
            config.insert(trial.name.into(), rows.into());
        }
        Ok(config)
    }

    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let setting = self.setting(job)?;
        let mut survey = Survey::new(&setting.office, setting.config.clone(), job.seed)?;
        let mut plans = Plans::default();
        for number in 1..=setting.config.moves {
            survey.step()?;
            // Plans are tried where the asymptote is measured.
            let late = f64::from(number) > (1.0 - TAIL) * f64::from(setting.config.moves);
            if late
                && setting.subject == Subject::Map
                && number.is_multiple_of(5)
                && let Some(trial) = survey.try_plan()
            {
                plans.count(trial);
            }
        }
        let summary = ErrorSummary::of(survey.errors()).ok_or("no move was made")?;
        if setting.subject == Subject::Odometry {
            return Ok(Fields::new()
                .number("ssd_asymptote", summary.odometry)
                .curve("curve", summary.odometry_curve));
        }
        let score = survey.score();
        let mut fields = Fields::new()
            .number("ssd_asymptote", summary.asymptote)
            .number("odometry", summary.odometry)
            .curve("curve", summary.curve)
            .number("coverage", summary.coverage)
            .count("places", score.places as u64)
            .count("visited", score.visited as u64)
            .number("purity", score.purity)
            .number("share_once", score.share_once)
            .number("link_precision", score.link_precision)
            .number("believed_precision", score.believed_precision)
            .number("remembered_precision", survey.remembered_precision())
            .number("link_recall", score.link_recall)
            .flag("isomorphic", score.isomorphism == Isomorphism::Yes);
        let share = |part: u32, whole: u32| f64::from(part) / f64::from(whole);
        if plans.there > 0 {
            fields = fields
                .number("plans", share(plans.work, plans.there))
                .number(
                    "remembered_plans",
                    share(plans.remembered_work, plans.there),
                );
        }
        let all = plans.there + plans.gone;
        if all > 0 {
            fields = fields.number("plans_to_gone", share(plans.gone, all));
        }
        Ok(fields)
    }

    fn check(&self, run: &Run) -> Result<(), BoxError> {
        for (name, _) in SHARES {
            let share = run.fields.get(name).and_then(Field::as_number);
            if share.is_some_and(|share| !(0.0..=1.0).contains(&share)) {
                return Err(format!("{name} is {share:?}").into());
            }
        }
        Ok(())
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        figures::of(&self.trials, runs)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let setting = self.setting(job)?;
        match setting.subject {
            // The many rows of the ablation would fill the report and take as long as all else.
            Subject::Map if job.table == settings::ABLATION => Ok(None),
            Subject::Map => replay::of(setting, job).map(Some),
            Subject::Odometry => Ok(None),
        }
    }
}
