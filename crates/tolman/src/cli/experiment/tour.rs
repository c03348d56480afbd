//! `tolman experiment` without a name: the main tables of all experiments, in about a minute.

use alloc::sync::Arc;
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use core::time::Duration;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use indicatif::ProgressBar;
use tolman_experiment::{
    Entry, Options, Progress, ProgressEvent, Tour, execute, tables_as_text, tour_html, wrapped,
};

use super::{classify, heading};
use crate::cli::stdout::write_coloured;
use crate::cli::{App, Result, bar, file, ink, interrupt};

/// Maximum width of the tour's lines, columns.
const WIDTH: usize = 80;

/// Number of steps that the bar has for each experiment.
const STEPS: u32 = 1000;

pub(super) fn carry_out(app: &App, options: &Options, out: &mut dyn Write) -> Result {
    let stop = interrupt::flag()?;
    let entries = &app.catalogue.experiments;
    let stops: Vec<(&Entry, Tour)> = entries
        .iter()
        .filter_map(|entry| Some((entry, entry.tour?)))
        .collect();
    let folder = options.out.clone();
    let folder = folder.unwrap_or_else(|| PathBuf::from("results").join("tour"));
    let shown = Shown::new(stop, stops.len());
    let mut outcomes = Vec::new();
    let (started, mut whole) = (Instant::now(), Duration::ZERO);
    for (number, (entry, tour)) in (1..).zip(&stops) {
        let options = options.on_tour(tour, &folder.join(entry.name));
        let experiment = app.experiment(entry.name, &options)?;
        shown.begin(number - 1, entry.name);
        let began = Instant::now();
        let outcome = execute(&experiment, &options, &app.build, &shown).map_err(classify)?;
        let head = heading(number, stops.len(), entry.title);
        let tables = tables_as_text(&outcome.analysis, ink());
        shown.bar.suspend(|| -> Result {
            for line in wrapped(&head, WIDTH) {
                writeln!(out, "{line}")?;
            }
            writeln!(out)?;
            write_coloured(&format!("{tables}\n"), out)?;
            Ok(out.flush()?)
        })?;
        whole += whole_of(entry, app, outcome.runs.len(), began.elapsed())?;
        outcomes.push(outcome);
    }
    shown.bar.finish_and_clear();
    let left_out = entries.iter().filter(|entry| entry.tour.is_none());
    let left_out: Vec<&str> = left_out.map(|entry| entry.name).collect();
    let program = options.program.command();
    let mut last = String::new();
    if !left_out.is_empty() {
        last = format!(
            "Left out, since they take longer: {}; `{program} experiment NAME` plays one. ",
            left_out.join(", ")
        );
    }
    last += &format!(
        "`{program} experiment --all` plays every table with the papers' own counts, in about {} \
         or more.",
        rounded(whole)
    );
    let report = folder.join("report.html");
    file::write(&report, tour_html(&outcomes, &last))?;
    let took = started.elapsed().as_secs_f64();
    writeln!(out, "The report, {took:.0} s: {}", report.display())?;
    for line in wrapped(&last, WIDTH) {
        writeln!(out, "{line}")?;
    }
    Ok(())
}

/// Returns an estimate of how long all tables of an experiment take, from the time that the shown
/// runs took.
///
/// # Errors
/// If the experiment cannot be prepared.
fn whole_of(entry: &Entry, app: &App, runs: usize, took: Duration) -> Result<Duration> {
    let options = Options::default();
    let whole = app.experiment(entry.name, &options)?;
    let rows = whole.tables.iter().flat_map(|table| &table.rows);
    let all: u64 = rows.map(|row| u64::from(row.runs_of(entry.runs))).sum();
    Ok(took.mul_f64(all as f64 / runs.max(1) as f64))
}

/// Returns a rough duration in words, in whole minutes.
fn rounded(duration: Duration) -> String {
    match duration.as_secs().div_ceil(60) {
        0 | 1 => "a minute".to_owned(),
        minutes => format!("{minutes} minutes"),
    }
}

/// Progress bar of the whole tour, with equal parts for its experiments.
struct Shown {
    stop: Arc<AtomicBool>,
    bar: ProgressBar,
    stops: usize,
    /// Step of the bar at which the current experiment's part begins.
    begin: AtomicU64,
    total: AtomicU64,
    done: AtomicU64,
}

impl Shown {
    fn new(stop: Arc<AtomicBool>, stops: usize) -> Self {
        let length = u32::try_from(stops).unwrap_or(1) * STEPS;
        Self {
            stop,
            bar: bar::bar(length, "{bar:30} {msg}  {elapsed}"),
            stops,
            begin: AtomicU64::new(0),
            total: AtomicU64::new(1),
            done: AtomicU64::new(0),
        }
    }

    /// Moves the bar to the beginning of the experiment number `place`, counted from 0.
    fn begin(&self, place: usize, name: &str) {
        let begin = place as u64 * u64::from(STEPS);
        self.begin.store(begin, Ordering::Relaxed);
        self.bar.set_position(begin);
        let told = format!("{} of {} · {name}", place + 1, self.stops);
        self.bar.set_message(told);
    }

    fn show(&self, done: u64) {
        let total = self.total.load(Ordering::Relaxed).max(1);
        let part = u64::from(STEPS) * done / total;
        self.bar
            .set_position(self.begin.load(Ordering::Relaxed) + part);
    }
}

impl Progress for Shown {
    fn event(&self, event: &ProgressEvent<'_>) {
        match event {
            ProgressEvent::Started { total, reused } => {
                self.total.store(*total, Ordering::Relaxed);
                self.done.store(*reused, Ordering::Relaxed);
                self.show(*reused);
            }
            ProgressEvent::RunFinished => self.show(1 + self.done.fetch_add(1, Ordering::Relaxed)),
            _ => {}
        }
    }

    fn stop_requested(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}
