//! `tolman experiment` without a name: a demo to look at, and one table with a line for each
//! system, in about a minute.

use alloc::sync::Arc;
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context;
use indicatif::ProgressBar;
use tolman_experiment::{
    Entry, Headline, Options, Progress, ProgressEvent, TourLine, execute, tour_html, wrapped,
};

use super::classify;
use crate::cli::{App, Result, bar, demo, file, interrupt};

/// Maximum width of the tour's lines, columns.
const WIDTH: usize = 80;

/// Number of steps that the bar has for each line.
const STEPS: u32 = 1000;

pub(super) fn carry_out(app: &App, options: &Options, out: &mut dyn Write) -> Result {
    let stop = interrupt::flag()?;
    let entries = app.catalogue.experiments.iter();
    let lines: Vec<(&Entry, &Headline)> = entries
        .flat_map(|entry| entry.tour.iter().map(move |line| (entry, line)))
        .collect();
    let started = Instant::now();
    let folder = options.out.clone();
    let folder = folder.unwrap_or_else(|| PathBuf::from("results").join("tour"));
    fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    let picture = demo::in_folder(app, &folder, out)?;
    writeln!(out, "\n{}", Told::HEADING)?;
    let shown = Shown::new(stop, lines.len());
    let mut measured = Vec::new();
    let mut left_out = Vec::new();
    for (place, (entry, line)) in lines.iter().enumerate() {
        shown.begin(place, line.system);
        let options = options.on_tour(line, &folder.join(TourLine::folder_of(entry.name, line)));
        let experiment = app.experiment(entry.name, &options)?;
        let outcome = execute(&experiment, &options, &app.build, &shown).map_err(classify)?;
        match TourLine::of(**line, &outcome) {
            Ok(line) => {
                shown.bar.suspend(|| writeln!(out, "{}", Told(&line)))?;
                out.flush()?;
                measured.push(line);
            }
            Err(why) => left_out.push(format!("{}, {}: {why}. ", line.system, line.measures)),
        }
    }
    shown.bar.finish_and_clear();
    let program = options.program.command();
    let mut last = left_out.concat();
    if !last.is_empty() {
        last = format!("Left out: {last}");
    }
    last += &format!(
        "`{program} experiment NAME` plays one of the papers' experiments, and `{program} \
         experiment --all` every table with the papers' own numbers of runs, in much more time."
    );
    let report = folder.join("report.html");
    file::write(&report, tour_html(&measured, &picture, &last))?;
    let took = started.elapsed().as_secs_f64();
    writeln!(out, "\nThe report, {took:.0} s: {}", report.display())?;
    for line in wrapped(&last, WIDTH) {
        writeln!(out, "{line}")?;
    }
    Ok(())
}

/// A line of the tour as text of at most 80 columns.
struct Told<'a>(&'a TourLine);

impl Told<'_> {
    const HEADING: &'static str =
        "system          what is measured              beside               ours  verdict";
}

impl core::fmt::Display for Told<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let TourLine {
            headline,
            beside,
            ours,
            verdict,
            ..
        } = self.0;
        let line = format!(
            "{:<15} {:<29} {beside:<18} {ours:>6}  {verdict}",
            headline.system, headline.measures
        );
        f.write_str(line.trim_end())
    }
}

/// Progress bar of the whole tour, with equal parts for its lines.
struct Shown {
    stop: Arc<AtomicBool>,
    bar: ProgressBar,
    stops: usize,
    /// Step of the bar at which the current line's part begins.
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

    /// Moves the bar to the beginning of the line number `place`, counted from 0.
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
