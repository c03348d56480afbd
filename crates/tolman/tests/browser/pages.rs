//! Checks every kind of page that the command writes, in dark and light, at desktop and phone size.
//! There is no error on the console, no label over another and nothing cut off, and everything is
//! legible.
//!
//! `TOLMAN_PAGES=FOLDER cargo test -p tolman --test browser -- --ignored pages_of_folders` looks at
//! all pages below a folder, such as those of `experiment --all`. It may name several folders, as
//! `PATH` does. `cargo xtask ci --thorough` names those of the golden runs and of the commands that
//! are shown.

use std::env;
use std::path::{Path, PathBuf};

use crate::tab::{Scheme, Tab};
use crate::{tab, tell};

/// At a desk and on a phone.
const WINDOWS: [(u32, u32); 2] = [(1280, 800), (390, 844)];

/// A report's story takes at most this many windows of a desk; the rest is folded.
const SCREENS: f64 = 6.0;

/// Returns all that is wrong with a page in every light and on every width.
fn faults(tab: &mut Tab, page: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    let (width, height) = WINDOWS[0];
    tab.resize(width, height);
    tab.load(page, "");
    let is_report =
        tab.eval("document.querySelector('meta[name=generator]')?.content === 'tolman report'");
    if is_report == true {
        let screens = tab.number("document.documentElement.scrollHeight / innerHeight");
        if screens > SCREENS {
            faults.push(format!("{screens:.1} screens before the folds"));
        }
    }
    tab.eval("document.querySelectorAll('details').forEach(fold => { fold.open = true; })");
    for (width, height) in WINDOWS {
        tab.resize(width, height);
        for scheme in [Scheme::Light, Scheme::Dark] {
            tab.prefer(scheme);
            // Layout follows with the next frame, and the player with one more.
            tab.eval(
                "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))",
            );
            let found = tab.eval(include_str!("inspect.js"));
            for fault in found.as_array().unwrap() {
                let fault = fault.as_str().unwrap();
                faults.push(format!("{width} px, {scheme:?}: {fault}"));
            }
        }
    }
    faults.extend(tab.complaints());
    faults
}

/// Asks that nothing is wrong with the pages.
#[track_caller]
pub(crate) fn assert_faultless(pages: &[PathBuf]) {
    let mut wrong = Vec::new();
    for page in pages {
        // A tab for each: what one page complains of is not the next one's.
        let Some(mut tab) = tab() else { return };
        let faults = faults(&mut tab, page);
        let told = faults.into_iter();
        wrong.extend(told.map(|fault| format!("{}: {fault}", page.display())));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Returns all pages below a folder.
pub(crate) fn below(folder: &Path) -> Vec<PathBuf> {
    let mut pages = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            pages.extend(below(&path));
        } else if path
            .extension()
            .is_some_and(|extension| extension == "html")
        {
            pages.push(path);
        }
    }
    pages.sort();
    pages
}

#[test]
#[ignore = "needs a browser, and TOLMAN_PAGES"]
fn pages_of_folders() {
    let Some(named) = env::var_os("TOLMAN_PAGES") else {
        tell("left out: TOLMAN_PAGES names no folder");
        return;
    };
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let mut pages = Vec::new();
    for folder in env::split_paths(&named) {
        let found = below(&root.join(&folder));
        assert!(!found.is_empty(), "no page below {}", folder.display());
        pages.extend(found);
    }
    assert_faultless(&pages);
}
