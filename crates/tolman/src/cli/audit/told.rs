//! Texts in which an audit is reported.

use core::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use tolman_draw::visible;
use tolman_formats::G2o;
use tolman_maps::audit::{
    AuditCertificateError, AuditCycle, AuditedClosure, ClosureVerdict, RefutedBy, UndecidedBecause,
};
use tolman_maps::pose_graph::PoseEdgeKind;
use tolman_papers::real::GraphFile;

use super::Audited;

/// Maximum number of closures and faults that are listed one by one.
const TOLD: usize = 10;

/// Prints on stderr which parts of a file are not used.
pub(super) fn left_out(path: &Path, file: &G2o) {
    let (path, count) = (path.display(), file.left_out.len());
    // If stderr cannot be written, there is no other place to report it.
    let mut err = anstream::stderr();
    for fault in file.left_out.iter().take(TOLD) {
        let _ = writeln!(err, "{}", visible(&format!("{path}: {fault}")));
    }
    if count > 0 {
        let lines = if count == 1 { "line is" } else { "lines are" };
        let _ = writeln!(
            err,
            "{}: {count} {lines} left out, the rest is used",
            visible(&path.to_string())
        );
    }
}

impl Audited<'_> {
    pub(super) fn tell(&self, out: &mut dyn Write) -> io::Result<()> {
        let (closures, runs) = (self.audit.closures.len(), self.audit.runs);
        writeln!(
            out,
            "{}: {} poses, {closures} closures in {runs} runs, standard deviations × {}",
            self.name,
            self.file.file.poses.len(),
            rounded(self.config.sigma_scale),
        )?;
        let edges = self.file.graph.edges().iter();
        let steps = edges
            .filter(|edge| edge.kind == PoseEdgeKind::Odometry)
            .count();
        let neighbours = self.file.file.poses.len().saturating_sub(1);
        if 10 * steps < 9 * neighbours {
            writeln!(
                out,
                "only {steps} of {neighbours} poses are joined to the one before, by id, and count as odometry; number the poses in the order they were driven"
            )?;
        }
        if let Some(told) = self.told_of_scale() {
            writeln!(out, "{told}")?;
        }
        writeln!(out, "{}", self.counted())?;
        let refuted = self.audit.closures.iter();
        let refuted = refuted.filter(|closure| closure.verdict.is_refuted());
        for closure in refuted.clone().take(TOLD) {
            writeln!(out, "  {}", self.told(closure))?;
        }
        let more = refuted.count().saturating_sub(TOLD);
        if more > 0 {
            writeln!(out, "  … and {more} more")?;
        }
        Ok(())
    }

    /// Returns a sentence with the number of closures of each verdict.
    pub(super) fn counted(&self) -> String {
        let count = |is: fn(&ClosureVerdict) -> bool| self.audit.count(is);
        let alone = count(|verdict| {
            matches!(
                verdict,
                ClosureVerdict::Refuted {
                    by: RefutedBy::Odometry,
                    ..
                }
            )
        });
        let reason = |is: fn(&UndecidedBecause) -> bool| {
            self.audit.count(
                |verdict| matches!(verdict, ClosureVerdict::Undecided(because) if is(because)),
            )
        };
        format!(
            "{} supported; {} refuted ({alone} by odometry alone); {} undecided ({} too wide, {} of a single run, {} contradictory)",
            count(ClosureVerdict::is_supported),
            count(ClosureVerdict::is_refuted),
            count(is_undecided),
            reason(|because| matches!(because, UndecidedBecause::Wide { .. })),
            reason(|because| matches!(because, UndecidedBecause::SingleRun { .. })),
            reason(|because| matches!(because, UndecidedBecause::Contradictory { .. })),
        )
    }

    /// Returns the hint that the graph's short cycles give about its standard deviations. `None` if
    /// the factor in use is near enough.
    pub(super) fn told_of_scale(&self) -> Option<String> {
        let estimate = self.estimate?;
        let by = rounded(estimate.scale());
        let cycles = estimate.cycles;
        let off = estimate.scale() / self.config.sigma_scale;
        let tail = match estimate.is_heavy() {
            true => format!(
                ", which bears their heavy tail (99th percentile {:.0} times the median; a Gaussian's is 4.8)",
                estimate.tail
            ),
            false => String::new(),
        };
        (!(0.5..=2.0).contains(&off)).then(|| {
            format!("{cycles} short cycles suggest standard deviations × {by}{tail}: try --sigma-scale auto")
        })
    }

    /// Returns a line with a closure and its verdict.
    pub(super) fn told(&self, closure: &AuditedClosure) -> String {
        let edge = self.edge(closure);
        let verdict = verdict(&closure.verdict);
        format!("line {}: {} → {} {verdict}", edge.line, edge.from, edge.to)
    }
}

/// Returns whether a closure is neither supported nor refuted.
pub(super) const fn is_undecided(verdict: &ClosureVerdict) -> bool {
    matches!(verdict, ClosureVerdict::Undecided(_))
}

/// Returns a verdict with its reason.
pub(super) fn verdict(verdict: &ClosureVerdict) -> String {
    match verdict {
        ClosureVerdict::Supported { witnesses } => match witnesses.len() {
            1 => "supported by 1 cycle".to_owned(),
            count => format!("supported by {count} cycles"),
        },
        ClosureVerdict::Refuted { by, cycle } => {
            format!("refuted by {}: {}", evidence(*by), off(cycle))
        }
        ClosureVerdict::Undecided(because) => format!("undecided: {}", reason(because)),
    }
}

/// Returns in words what refutes a closure.
pub(super) const fn evidence(by: RefutedBy) -> &'static str {
    match by {
        RefutedBy::Odometry => "odometry alone",
        RefutedBy::SupportedClosures => "supported closures",
    }
}

/// Returns by how much a cycle is off: m and degrees.
pub(super) fn residual(cycle: &AuditCycle) -> (f64, f64) {
    let [x, y, turn] = cycle.residual;
    ((x * x + y * y).sqrt(), turn.to_degrees().abs())
}

fn reason(because: &UndecidedBecause) -> String {
    match because {
        UndecidedBecause::Wide { position, heading } if position.is_finite() => {
            format!(
                "too wide, it may lie within {position:.1} m and {:.0}°",
                heading.to_degrees()
            )
        }
        UndecidedBecause::Wide { .. } => "nothing else joins its poses".to_owned(),
        UndecidedBecause::SingleRun { closures } => {
            format!("only the {closures} closures of its own run agree")
        }
        UndecidedBecause::Contradictory { against, agreeing } => {
            format!(
                "one cycle speaks against it (χ² {:.0}), another agrees (χ² {:.1})",
                against.chi2, agreeing.chi2
            )
        }
    }
}

/// Returns the residual of a cycle in words.
fn off(cycle: &AuditCycle) -> String {
    let (metres, degrees) = residual(cycle);
    format!(
        "its cycle is off by {metres:.2} m and {degrees:.1}°, χ² {:.0} of at most 25",
        cycle.chi2
    )
}

/// Returns a number with at most three decimals and no trailing zeros.
pub(super) fn rounded(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Returns a CSV text with the verdict of every closure, one line each.
pub(super) fn csv(audited: &Audited<'_>) -> String {
    let mut text = "line,from,to,run,verdict,witnesses,reason\n".to_owned();
    for closure in &audited.audit.closures {
        let edge = audited.edge(closure);
        let (word, witnesses, why) = match &closure.verdict {
            ClosureVerdict::Supported { witnesses } => {
                ("supported", witnesses.len(), String::new())
            }
            ClosureVerdict::Refuted {
                by: RefutedBy::Odometry,
                ..
            } => ("refuted", 0, "odometry".to_owned()),
            ClosureVerdict::Refuted { by, .. } => ("refuted", 0, evidence(*by).to_owned()),
            ClosureVerdict::Undecided(because) => ("undecided", 0, reason(because)),
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{},{},{},{},{word},{witnesses},\"{why}\"",
            edge.line, edge.from, edge.to, closure.run
        );
    }
    text
}

/// Returns a fault of a certificate in words. Where it names an edge, the line of the graph's file
/// is added.
pub(super) fn by_line(error: &AuditCertificateError, file: &GraphFile) -> String {
    let told = error.to_string();
    let line = error
        .edge()
        .and_then(|edge| file.file.edges.get(edge as usize));
    match line {
        Some(edge) => format!(
            "{told} (edge {} → {}, line {})",
            edge.from, edge.to, edge.line
        ),
        None => told,
    }
}
