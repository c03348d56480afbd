//! The site: `TOLMAN_SITE=FOLDER cargo test -p tolman --test browser -- --ignored site::` tries the
//! folder that `cargo xtask site` wrote. `cargo xtask ci --thorough` does both.

use core::time::Duration;
use std::env;
use std::path::{Path, PathBuf};

use crate::pages::assert_faultless;
use crate::tab::Tab;
use crate::{tab, tell};

/// Time within which the front page shows something.
const MOST_MS: f64 = 2000.0;

/// A book's search reads its index first, on a machine that does other things besides.
const PATIENCE: Duration = Duration::from_secs(30);

/// Returns the folder and a tab; none, said on stderr, where there is none.
fn opened() -> Option<(Tab, PathBuf)> {
    let Some(site) = env::var_os("TOLMAN_SITE") else {
        tell("left out: TOLMAN_SITE names no folder");
        return None;
    };
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    Some((tab()?, root.join(site)))
}

#[test]
#[ignore = "needs a browser, and TOLMAN_SITE"]
fn the_front_page_paints_soon_and_its_doors_open() {
    let Some((mut tab, site)) = opened() else {
        return;
    };
    let front = site.join("index.html");
    tab.load(&front, "");
    let painted = tab.number(
        "new Promise(done => new PerformanceObserver(list => done(list.getEntries()[0].startTime))
           .observe({ type: 'paint', buffered: true }))",
    );
    assert!(painted < MOST_MS, "painted after {painted} ms");
    let doors = tab
        .eval("[...document.querySelectorAll('.doors a')].map(door => door.getAttribute('href'))");
    let doors: Vec<String> = serde_json::from_value(doors).unwrap();
    assert_eq!(doors.len(), 6, "{doors:?}");
    // All can be reached by the keyboard: they are links, and no tabindex takes one out.
    let hidden = tab.number("document.querySelectorAll('a[tabindex=\"-1\"]').length");
    assert!(
        hidden < 0.5,
        "{hidden} links cannot be reached by the keyboard"
    );
    for door in doors.iter().filter(|door| !door.starts_with('#')) {
        tab.load(&site.join(door), "");
        let complaints = tab.complaints();
        assert!(complaints.is_empty(), "{door}: {complaints:?}");
    }
}

#[test]
#[ignore = "needs a browser, and TOLMAN_SITE"]
fn the_pages_are_searched_from_disk() {
    let Some((mut tab, site)) = opened() else {
        return;
    };
    tab.load(&site.join("docs/index.html"), "?search=diktiometry");
    let found =
        "document.querySelectorAll('#mdbook-searchresults li, #searchresults li').length > 3";
    tab.until_within(found, PATIENCE);
}

#[test]
#[ignore = "needs a browser, and TOLMAN_SITE"]
fn its_own_pages_are_legible_on_a_phone_and_in_the_dark() {
    let Some((_, site)) = opened() else {
        return;
    };
    let mut pages = vec![site.join("index.html")];
    let replays = std::fs::read_dir(site.join("replays")).unwrap();
    pages.extend(replays.map(|replay| replay.unwrap().path()));
    pages.sort();
    assert_faultless(&pages);
}
