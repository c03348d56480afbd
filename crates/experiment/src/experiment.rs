//! One paper's tables and how to fill them.

use super::{BoxError, Easel, Entry, Error, Fields, Job, Options, Run, Table};
use tolman_draw::Figure;
use tolman_replay::Replay;

/// One paper's tables and how to fill them.
///
/// ```
/// use tolman_experiment::{
///     BoxError, Entry, Experiment, Fields, Job, Metric, Options, Procedure, Record, Row, Table, open, record,
/// };
///
/// record! {
///     /// One game.
///     struct Game {
///         /// Tosses until the coin showed heads.
///         tosses: u32 => neither("tosses").at_least(1),
///     }
/// }
///
/// /// Tosses a coin until it shows heads.
/// #[derive(Debug)]
/// struct Coin;
///
/// impl Procedure for Coin {
///     fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
///         Ok(Game { tosses: job.seed.trailing_zeros() + 1 }.fields()?)
///     }
/// }
///
/// const COIN: Entry = Entry {
///     name: "coin",
///     title: "Tosses until heads",
///     source: "",
///     runs: 1000,
///     quick_runs: 10,
///     main: &[],
///     tour: &[],
///     open: |_: &Options| {
///         let table = Table::of::<Game>("1", "A fair coin")
///             .metric(Metric::mean(Game::tosses))
///             .row(Row::new("fair"));
///         Ok(Experiment::new(COIN, vec![table], toml::Table::new(), Coin))
///     },
/// };
///
/// let coin = open(&[COIN], "coin", &Options::default())?;
/// let job = Job { table: "1", row: "fair", run: 0, seed: 8 };
/// assert_eq!(coin.procedure.run(&job)?.record::<Game>()?.tosses, 4);
/// # Ok::<(), BoxError>(())
/// ```
#[derive(Debug)]
pub struct Experiment {
    /// Entry in the catalogue.
    pub entry: Entry,
    /// Tables, in the order in which they are shown.
    pub tables: Vec<Table>,
    /// Everything the results depend on except the seed and the number of runs: mazes with their
    /// contents, gains, noise. Finished runs are reused only if the configuration is equal.
    pub config: toml::Table,
    /// Parts left out because data is missing, and how to get it; `None` if everything is here.
    pub skipped: Option<String>,
    /// Procedure that plays the experiment's runs.
    pub procedure: Box<dyn Procedure>,
    /// Whether only some tables are filled.
    in_part: bool,
}

/// Procedure that plays and draws the runs of an experiment.
pub trait Procedure: Sync + core::fmt::Debug {
    /// Plays one run and returns its fields. It is a pure function of the job and the
    /// configuration: the same job gives the same fields on every thread, in any order.
    ///
    /// # Errors
    /// If the run cannot be played at all. A robot that does not arrive is a result, not an error.
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError>;

    /// Returns the name of work that this run shares with others and that is done once for all of
    /// them, such as learning a map. `None`, the default, if there is no such work. Runs with one
    /// name are in one [`Chunk`](super::Chunk), so that no two machines repeat it.
    fn shares(&self, job: &Job<'_>) -> Option<String> {
        let _ = job;
        None
    }

    /// Returns pictures in addition to the box plots that every experiment gets. `runs` is complete
    /// and sorted by table, row and index. [`Run::job`] says how to play a run again. What takes
    /// time is drawn on the easel, which keeps it.
    ///
    /// # Errors
    /// If a run cannot be played again for its picture, and errors of the easel.
    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        let _ = (runs, easel);
        Ok(Vec::new())
    }

    /// Returns the runs whose replays the report carries, as many as fit, the most important first.
    /// `None`, the default, takes the first runs of each row. `runs` is complete and sorted by
    /// table, row and index.
    ///
    /// # Errors
    /// If a run cannot be read.
    fn shown(&self, runs: &[Run]) -> Result<Option<Vec<Run>>, BoxError> {
        let _ = runs;
        Ok(None)
    }

    /// Plays a run again and returns its replay, which opens from its dots in the report. The
    /// report carries the first runs of each row, as many as fit;
    /// [`write_replay`](super::write_replay) writes any.
    ///
    /// `None`, the default, if the run has nothing to show.
    ///
    /// # Errors
    /// If the run cannot be played again.
    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let _ = job;
        Ok(None)
    }
}

impl Experiment {
    /// Returns an experiment without missing data.
    pub fn new(
        entry: Entry,
        tables: Vec<Table>,
        config: toml::Table,
        procedure: impl Procedure + 'static,
    ) -> Self {
        Self {
            entry,
            tables,
            config,
            skipped: None,
            procedure: Box::new(procedure),
            in_part: false,
        }
    }

    /// Sets which parts are left out because data is missing.
    #[must_use]
    pub fn skipped(mut self, skipped: Option<String>) -> Self {
        self.skipped = skipped;
        self
    }

    /// Removes the runs of tables and rows that the options do not name, if they name any. The
    /// configuration does not change, so other runs stay in the folder of results.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is no table or row of that name; [`Error::EmptyTable`].
    pub(super) fn choose(mut self, options: &Options) -> Result<Self, Error> {
        let Options { tables, rows, .. } = options;
        for name in tables {
            if !self.table(name)?.1.is_shown() {
                return Err(Error::EmptyTable {
                    table: name.clone(),
                });
            }
        }
        if !tables.is_empty() {
            self.leave_out(|table, _| !tables.contains(table));
        }
        let shown = self.tables.iter().filter(|table| table.is_shown());
        let known: Vec<&str> = shown
            .flat_map(|table| &table.rows)
            .map(|row| row.name.as_str())
            .collect();
        for name in rows {
            Error::place_of("row", name, known.iter().copied())?;
        }
        if !rows.is_empty() {
            self.leave_out(|_, row| !rows.contains(row));
        }
        Ok(self)
    }

    /// Removes the runs of rows for which `is_left_out` is true, given the names of table and row.
    fn leave_out(&mut self, is_left_out: impl Fn(&String, &String) -> bool) {
        self.in_part = true;
        for table in &mut self.tables {
            for row in &mut table.rows {
                if is_left_out(&table.name, &row.name) {
                    row.leave_out();
                }
            }
        }
    }

    /// Compares the number of runs in the options with tables of a fixed number. It refuses them
    /// for tables that the options name, and adds a note to the others.
    ///
    /// # Errors
    /// [`Error::FixedRuns`].
    pub(super) fn with_runs(mut self, options: &Options) -> Result<Self, Error> {
        if options.runs.is_none() {
            return Ok(self);
        }
        let fixed: Vec<&Table> = self
            .tables
            .iter()
            .filter(|table| table.is_fixed())
            .collect();
        if let (true, Some(table)) = (self.in_part, fixed.first()) {
            let own = table.rows.iter().filter_map(|row| row.runs).max();
            return Err(Error::FixedRuns {
                table: table.name.clone(),
                own: own.unwrap_or(0),
            });
        }
        if !fixed.is_empty() {
            let names: Vec<&str> = fixed.iter().map(|table| table.name.as_str()).collect();
            let told = format!(
                "--runs is not for {}, which has a number of runs of its own.",
                names.join(", ")
            );
            self.skipped = Some(match self.skipped {
                Some(skipped) => format!("{skipped} {told}"),
                None => told,
            });
        }
        Ok(self)
    }

    /// Returns the table of this name and its index.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is none.
    pub(super) fn table(&self, name: &str) -> Result<(usize, &Table), Error> {
        let names = self.tables.iter().map(|table| table.name.as_str());
        let place = Error::place_of("table", name, names)?;
        Ok((place, &self.tables[place]))
    }

    /// Plays a run again and returns its replay; `None` if it has nothing to show.
    pub(super) fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, Error> {
        let replay = self.procedure.replay(job);
        replay.map_err(|source| Error::run(job, source))
    }

    /// Returns the pictures of the procedure. If only some tables are filled, figures of several
    /// tables are left out.
    pub(super) fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        let mut figures = self.procedure.figures(runs, easel)?;
        let is_filled =
            |figure: &Figure| figure.table.as_ref().is_some_and(|name| self.fills(name));
        figures.retain(|figure| !self.in_part || is_filled(figure));
        Ok(figures)
    }

    /// Returns whether runs of the table of this name are made.
    pub(super) fn fills(&self, name: &str) -> bool {
        let mut filled = self.tables.iter().filter(|table| table.is_filled());
        filled.any(|table| table.name == name)
    }
}
