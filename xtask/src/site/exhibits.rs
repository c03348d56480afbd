//! The pages that the project's own commands write, in worlds and from logs of its own.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::workspace::root;

/// What the command writes: the page in the folder of the site, and the words of the command, in
/// which `OUT` stands for the page's file, or its folder if the command writes a folder.
pub(super) struct Exhibit {
    pub(super) page: &'static str,
    words: &'static str,
}

const fn exhibit(page: &'static str, words: &'static str) -> Exhibit {
    Exhibit { page, words }
}

pub(super) const EXHIBITS: &[Exhibit] = &[
    exhibit("replays/mslst.html", "demo --system mslst --out OUT"),
    exhibit(
        "replays/mslst-better.html",
        "demo --system mslst-better --out OUT",
    ),
    exhibit("replays/cpm.html", "demo --system cpm --out OUT"),
    exhibit(
        "replays/cpm-better.html",
        "demo --system cpm-better --out OUT",
    ),
    exhibit(
        "replays/diktiometry.html",
        "demo --system diktiometry --out OUT",
    ),
    exhibit(
        "replays/diktiometry-better.html",
        "demo --system diktiometry-better --out OUT",
    ),
    exhibit("replays/gng-slam.html", "demo --system gng-slam --out OUT"),
    exhibit(
        "replays/gng-slam-better.html",
        "demo --system gng-slam-better --out OUT",
    ),
    exhibit(
        "replays/micromouse.html",
        "demo --system micromouse --out OUT",
    ),
    exhibit(
        "replays/race.html",
        "race mazes/grid/braided-2.txt --replay OUT",
    ),
    exhibit(
        "replays/wall-follow.html",
        "run wall-follow --maze mazes/large.maze --seed 2 --replay OUT",
    ),
    exhibit(
        "replays/rooms.html",
        "learn --system mslst --world mazes/worlds/rooms.json --set scan_steps=3000 --set graph_actions=5000 --out replays/rooms.json --replay OUT",
    ),
    exhibit(
        "office/replay.html",
        "map --log logs/office.clf.gz --out OUT",
    ),
    exhibit("audit/audit.html", "audit mazes/graphs/rooms.g2o --out OUT"),
    exhibit(
        "report/report.html",
        "experiment baselines --quick --out OUT",
    ),
];

/// The page behind each picture of the gallery.
pub(super) const BEHIND: &[(&str, &str)] = &[
    ("demo.svg", "replays/mslst-better.html"),
    ("replay.png", "replays/wall-follow.html"),
    ("wall-follow-large.svg", "report/report.html"),
    ("rooms-graph.svg", "replays/rooms.html"),
    ("gngslam-map.png", "replays/gng-slam.html"),
    ("gngslam-driven.svg", "replays/gng-slam-better.html"),
    ("office-map.png", "office/replay.html"),
    ("audit.png", "audit/audit.html"),
    ("arena-heat-map.svg", "replays/cpm-better.html"),
];

/// Lets `tolman` write all pages into `out`. It works there, on copies of the mazes and logs that
/// it is given: the pages show the commands, which then hold in the folder.
///
/// # Errors
/// If a command writes none.
pub(super) fn make(tolman: &Path, out: &Path) -> Result<()> {
    for Exhibit { page, words } in EXHIBITS {
        let (folder, _) = page.split_once('/').context("a page is in a folder")?;
        let target = if folder == "replays" {
            fs::create_dir_all(out.join(folder))?;
            page
        } else {
            folder
        };
        let words = words.replace("OUT", target);
        let given = words.split(' ').filter(|word| root().join(word).is_file());
        for file in given {
            let copy = out.join(file);
            fs::create_dir_all(copy.parent().unwrap_or(out))?;
            fs::copy(root().join(file), copy)?;
        }
        eprintln!("tolman {words}");
        let mut command = Command::new(tolman);
        let done = command
            .current_dir(out)
            // No data of others.
            .env_remove("TOLMAN_DATA")
            .args(words.split(' '))
            .output()
            .with_context(|| format!("cannot start {}", tolman.display()))?;
        // Exit code 1 is a verdict, which the page shows too.
        ensure!(
            done.status.code().is_some_and(|code| code < 2) && out.join(page).is_file(),
            "`tolman {words}` wrote no {page}: {}",
            String::from_utf8_lossy(&done.stderr)
        );
    }
    Ok(())
}
