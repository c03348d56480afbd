//! The page of an audit.

use tolman_draw::{Figure, FloorPlan, Page, PageTable, Series};
use tolman_geom::Point;
use tolman_maps::audit::{AuditedClosure, ClosureVerdict};
use tolman_maps::pose_graph::PoseGraph;
use tolman_sim::Bounds;

use super::super::called;
use super::{Audited, told};

/// Width of the picture, user units.
const WIDTH: f64 = 900.0;

/// Maximum number of closures of each verdict that the page lists.
const LISTED: usize = 100;

const ODOMETRY: Series = Series(0);
const UNDECIDED: Series = Series(1);
const SUPPORTED: Series = Series(2);
const REFUTED: Series = Series(4);

pub(super) fn html(audited: &Audited<'_>, laid_out: &PoseGraph) -> String {
    let count = |is: fn(&ClosureVerdict) -> bool| audited.audit.count(is).to_string();
    let mut page = Page::new(format!("Audit of {}", audited.name))
        .fact("supported", count(ClosureVerdict::is_supported))
        .fact("refuted", count(ClosureVerdict::is_refuted))
        .fact("undecided", count(told::is_undecided))
        .fact("poses", laid_out.poses().len().to_string())
        .fact("runs of closures", audited.audit.runs.to_string())
        .fact(
            "standard deviations ×",
            told::rounded(audited.config.sigma_scale),
        )
        .text(audited.counted());
    if let Some(scale) = audited.told_of_scale() {
        page = page.text(scale);
    }
    page.figure(&picture(audited, laid_out))
        .table(&refuted(audited))
        .table(&listed(audited, "Undecided", told::is_undecided))
        .table(&listed(audited, "Supported", ClosureVerdict::is_supported))
        .text(
            "Support is evidence, never proof: the cycles agree with the closure, and share no run of closures. Refuted by odometry alone holds if the odometry's \
             standard deviations do; refuted by supported closures, if those are right besides. certificates.json has every cycle; tolman audit --verify \
             and docs/check_certificates.py measure them again.",
        )
        .text(format!("Made by {}", called::command()))
        .html()
}

/// Returns the picture: the poses as odometry and supported closures place them, under all
/// closures.
fn picture(audited: &Audited<'_>, laid_out: &PoseGraph) -> Figure {
    let places: Vec<Point> = laid_out.poses().iter().map(|pose| pose.position).collect();
    let mut plan = FloorPlan::of_bounds(&Bounds::of(places.iter().copied()), WIDTH);
    let lines = |is: &dyn Fn(&ClosureVerdict) -> bool| -> Vec<[Point; 2]> {
        let closures = audited.audit.closures.iter();
        let chosen = closures.filter(|closure| is(&closure.verdict));
        let ends = chosen.map(|closure| {
            let edge = &audited.file.graph.edges()[closure.edge as usize];
            [edge.from, edge.to].map(|pose| places[pose as usize])
        });
        ends.collect()
    };
    plan.segments(&lines(&ClosureVerdict::is_refuted), true, REFUTED);
    let way: Vec<[Point; 2]> = places.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    plan.segments(&way, false, ODOMETRY);
    plan.segments(&lines(&told::is_undecided), false, UNDECIDED);
    plan.segments(&lines(&ClosureVerdict::is_supported), false, SUPPORTED);
    Figure::new("graph", "The graph by what is supported.", plan.drawing(audited.counted())).caption(
        "Blue the way by odometry and supported closures, green supported closures (short where the poses meet), yellow undecided ones, orange dashes refuted ones.",
    )
}

fn refuted(audited: &Audited<'_>) -> PageTable {
    let heads = ["line", "closure", "refuted by", "off", "χ²", "cycle"];
    let mut table = PageTable::new("Refuted", heads);
    let all = audited.audit.closures.iter();
    let mut all: Vec<_> = all
        .filter_map(|closure| match &closure.verdict {
            ClosureVerdict::Refuted { by, cycle } => Some((closure, by, cycle)),
            _ => None,
        })
        .collect();
    all.sort_by(|a, b| b.2.chi2.total_cmp(&a.2.chi2));
    for (closure, by, cycle) in all.iter().take(LISTED) {
        let (metres, degrees) = told::residual(cycle);
        let steps = cycle.steps.iter().skip(1).map(|step| {
            let id = audited.file.file.poses[step.to as usize].id;
            let arrow = if step.over.is_some() { "⇒" } else { "→" };
            format!("{arrow} {id}")
        });
        let cycle_told = steps.collect::<Vec<_>>().join(" ");
        table = table.row([
            audited.edge(closure).line.to_string(),
            ends(audited, closure),
            told::evidence(**by).to_owned(),
            format!("{metres:.2} m, {degrees:.1}°"),
            format!("{:.0}", cycle.chi2),
            format!("{} {cycle_told}", ends(audited, closure)),
        ]);
    }
    table.note(format!(
        "{}A cycle leads over the closure and back, along odometry (→) and over other closures (⇒). It is beyond its bound if χ² is above 25.",
        of(all.len(), "with the greatest χ² ")
    ))
}

fn listed(audited: &Audited<'_>, title: &str, is: impl Fn(&ClosureVerdict) -> bool) -> PageTable {
    let mut table = PageTable::new(title, ["line", "closure", "run", "why"]);
    let all = audited.audit.closures.iter();
    let all: Vec<&AuditedClosure> = all.filter(|closure| is(&closure.verdict)).collect();
    for closure in all.iter().take(LISTED) {
        table = table.row([
            audited.edge(closure).line.to_string(),
            ends(audited, closure),
            closure.run.to_string(),
            told::verdict(&closure.verdict),
        ]);
    }
    table.note(of(all.len(), "first "))
}

/// Returns a sentence that says how many of `all` closures are listed; empty if all are.
fn of(all: usize, which: &str) -> String {
    match all {
        0 => "None. ".to_owned(),
        _ if all > LISTED => format!("The {LISTED} {which}of {all}; verdicts.csv has all. "),
        _ => String::new(),
    }
}

fn ends(audited: &Audited<'_>, closure: &AuditedClosure) -> String {
    let edge = audited.edge(closure);
    format!("{} ⇒ {}", edge.from, edge.to)
}
