//! The report of an experiment.

use std::path::PathBuf;

use crate::tab::Scheme;
use crate::{folder, tab, tolman};

/// The report of a short experiment.
fn report(name: &str) -> (PathBuf, PathBuf) {
    let folder = folder(name);
    let out = folder.join("baselines");
    let path = out.to_str().unwrap();
    tolman(&["experiment", "baselines", "--runs", "3", "--out", path]);
    (folder, out.join("report.html"))
}

#[test]
#[ignore = "needs a browser"]
fn a_report_is_seen_in_every_light_and_on_every_width() {
    let Some(mut tab) = tab() else { return };
    let (folder, report) = report("report-look");
    tab.load(&report, "");
    for (width, height) in [(1200, 800), (375, 667)] {
        tab.resize(width, height);
        for scheme in [Scheme::Light, Scheme::Dark] {
            tab.prefer(scheme);
            tab.assert_seen(&folder, scheme, width);
        }
    }
    tab.assert_content();
}
