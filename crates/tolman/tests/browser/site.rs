//! The site: `TOLMAN_SITE=FOLDER cargo test -p tolman --test browser -- --ignored site::` tries the
//! folder that `cargo xtask site` wrote. `cargo xtask ci --thorough` does both.

use core::time::Duration;
use std::env;
use std::path::{Path, PathBuf};

use crate::pages::{assert_faultless, below};
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
    assert_eq!(doors.len(), 7, "{doors:?}");
    // The keyboard comes to all of them, behind the picture.
    tab.strike("Tab", 9);
    for door in &doors {
        tab.strike("Tab", 9);
        tab.until(&format!(
            "document.activeElement.getAttribute('href') === '{door}'"
        ));
    }
    tab.strike("Enter", 13);
    let last = doors.last().unwrap();
    tab.until(&format!("location.pathname.endsWith('{last}')"));
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
    for folder in ["replays", "office", "audit"] {
        pages.extend(below(&site.join(folder)));
    }
    assert_faultless(&pages);
}

#[test]
#[ignore = "needs a browser, and TOLMAN_SITE"]
fn no_page_asks_another_host() {
    let Some((mut tab, site)) = opened() else {
        return;
    };
    let mut pages = below(&site.join("docs"));
    assert!(pages.len() > 40, "{pages:?}");
    pages.push(site.join("api/tolman_systems/index.html"));
    for page in pages {
        tab.load(&page, "");
        let complaints = tab.complaints();
        assert!(complaints.is_empty(), "{}: {complaints:?}", page.display());
    }
}
