//! The report of an experiment.

use std::path::PathBuf;

use serde_json::Value;

use crate::tab::{Scheme, Tab};
use crate::{folder, tab, tolman};

/// Returns the folder of this name and in it the report of a short experiment, in mazes of its own
/// or in this one.
fn report(name: &str, maze: Option<&str>) -> (PathBuf, PathBuf) {
    let folder = folder(name);
    let out = folder.join("baselines");
    let mut words = vec!["experiment", "baselines", "--runs", "3"];
    words.extend(["--out", out.to_str().unwrap()]);
    words.extend(maze.into_iter().flat_map(|maze| ["--maze", maze]));
    tolman(&words);
    (folder, out.join("report.html"))
}

#[test]
#[ignore = "needs a browser"]
fn a_report_is_seen_in_every_light_and_on_every_width() {
    let Some(mut tab) = tab() else { return };
    let (folder, report) = report("report-look", None);
    tab.load(&report, "");
    for (width, height) in [(1200, 800), (800, 600), (375, 667)] {
        tab.resize(width, height);
        for scheme in [Scheme::Light, Scheme::Dark] {
            tab.prefer(scheme);
            tab.assert_seen(&folder, scheme, width);
        }
    }
    tab.assert_content();
}

/// Returns the values of the first metric's rows in a column of the first table, from the top down.
fn column(tab: &mut Tab, column: &str) -> Vec<f64> {
    let values = tab.eval(&format!(
        "[...document.querySelector('table').tBodies[0].querySelectorAll('[data-column={column}]')]
           .map(cell => Number(cell.dataset.value))"
    ));
    let values = values.as_array().unwrap();
    values.iter().map(|value| value.as_f64().unwrap()).collect()
}

#[test]
#[ignore = "needs a browser"]
fn a_table_sorts_and_finds_its_order_again() {
    let Some(mut tab) = tab() else { return };
    let (_, report) = report("report-sorts", Some("mazes/j.maze"));
    tab.load(&report, "");
    let first = column(&mut tab, "ours");
    let mut sorted = first.clone();
    sorted.sort_by(f64::total_cmp);
    assert!(first != sorted && sorted.len() > 2, "{first:?}");
    tab.click("th[data-sort=ours] button");
    assert_eq!(column(&mut tab, "ours"), sorted);
    assert_eq!(tab.eval(SORTED), "ascending");
    sorted.reverse();
    tab.click("th[data-sort=ours] button");
    assert_eq!(column(&mut tab, "ours"), sorted);
    // With the keys alone, too.
    tab.eval("document.querySelector('th[data-sort=ours] button').focus()");
    tab.strike("Enter", 13);
    assert_eq!(column(&mut tab, "ours"), first);
    assert_eq!(tab.eval(SORTED), "none");
    tab.assert_content();
}

const SORTED: &str = "document.querySelector('th[data-sort=ours]').getAttribute('aria-sort')";

#[test]
#[ignore = "needs a browser"]
fn a_dot_opens_the_replay_of_its_run() {
    let Some(mut tab) = tab() else { return };
    let (folder, report) = report("report-dots", Some("mazes/j.maze"));
    tab.load(&report, "");
    tab.click("svg.drawing [data-table] [data-run='1']");
    tab.until("document.querySelector('#replay-dialog').open && !!window.tolmanReplay");
    let opened = tab.eval(OPENED);
    assert_eq!(opened[2], "1", "{opened}");
    let runs = std::fs::read_to_string(report.with_file_name("runs.jsonl")).unwrap();
    let mut runs = runs
        .lines()
        .map(|run| -> Value { serde_json::from_str(run).unwrap() });
    let run =
        runs.find(|run| run["table"] == opened[0] && run["row"] == opened[1] && run["run"] == 1);
    assert_eq!(tab.eval("tolmanReplay.run.last"), run.unwrap()["steps"]);
    tab.click("[data-part=play]");
    tab.until("tolmanReplay.step > 2");
    tab.prefer(Scheme::Dark);
    tab.look(&folder.join("dialog.png"));
    tab.eval("tolmanReplay.pauseAt(5)");
    tab.until("location.hash.endsWith('t=5')");
    let address = tab.eval("location.hash");

    tab.click("#replay-after");
    tab.until("document.querySelector('#replay-dialog').dataset.run === '2'");
    tab.strike("Escape", 27);
    tab.until("!document.querySelector('#replay-dialog').open && !window.tolmanReplay");

    // The address of a run leads to it.
    tab.load(&report, address.as_str().unwrap());
    tab.until("!!window.tolmanReplay && tolmanReplay.step === 5");
    assert_eq!(tab.eval(OPENED), opened);
    tab.assert_content();
}

/// The address's table, row and run.
const OPENED: &str =
    "['table', 'row', 'run'].map(name => new URLSearchParams(location.hash.slice(1)).get(name))";

#[test]
#[ignore = "needs a browser"]
fn a_replay_is_reached_with_the_keys_alone() {
    let Some(mut tab) = tab() else { return };
    let (_, report) = report("report-keys", Some("mazes/j.maze"));
    tab.load(&report, "");
    for _ in 0..60 {
        tab.strike("Tab", 9);
        if tab.eval("document.activeElement.dataset.run !== undefined") == true {
            break;
        }
    }
    tab.strike("ArrowRight", 39);
    tab.strike("ArrowUp", 38);
    let dot = tab.eval("document.activeElement.dataset.run");
    assert!(dot.is_string(), "no dot is reached");
    tab.strike("Enter", 13);
    tab.until("document.querySelector('#replay-dialog').open && !!window.tolmanReplay");
    assert_eq!(tab.eval(OPENED)[2], dot);
    tab.strike(" ", 32);
    tab.until("tolmanReplay.playing || tolmanReplay.step > 0");
    tab.strike("Escape", 27);
    tab.until("!document.querySelector('#replay-dialog').open");
    assert_eq!(
        tab.eval("document.activeElement.dataset.run"),
        dot,
        "back where one was"
    );
    tab.assert_content();
}
