//! `tolman demo`: every system shows what it can, and README's picture is its run.

use std::fs;
use std::path::Path;

use super::{folder, tolman_in};

#[test]
fn every_system_learns_a_maze_and_comes_home() {
    let folder = folder("demo-systems");
    for system in [
        "mslst",
        "mslst-better",
        "cpm-better",
        "diktiometry",
        "gng-slam-better",
        "micromouse",
    ] {
        let told = tolman_in(&folder, &["demo", "--system", system]).done();
        let found = told.contains("Put down elsewhere, it found out where it is");
        assert!(found, "{system}: {told}");
        assert!(told.contains("It drove to the goal in"), "{system}: {told}");
        let lines = told.lines().filter(|line| !line.starts_with("replay:"));
        for line in lines {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}

#[test]
fn what_a_system_cannot_do_is_told() {
    let folder = folder("demo-fails");
    let told = tolman_in(&folder, &["demo", "--system", "gng-slam"]).done();
    assert!(told.contains("It does not drive by its map"), "{told}");
    assert!(folder.join("tolman-demo.html").exists());

    tolman_in(&folder, &["demo", "--system", "nobody"]).refused(2, &["nobody", "mslst-better"]);
    let rooms = "o---o---o\n| S     |\no   o   o\n|     G |\no---o---o\n";
    fs::write(folder.join("room.maze"), rooms).unwrap();
    let room = ["demo", "--system", "cpm", "--maze", "room.maze"];
    tolman_in(&folder, &room).refused(2, &["CPM", "open square"]);
}

#[test]
fn the_moving_picture_of_readme_is_that_of_the_demo() {
    let folder = folder("demo-picture");
    tolman_in(&folder, &["demo", "--svg", "demo.svg"]).done();
    let made = fs::read_to_string(folder.join("demo.svg")).unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let shown = fs::read_to_string(root.join("docs/images/demo.svg")).unwrap();
    assert!(made.len() < 400_000 && !made.contains("<script"));
    assert!(
        made == shown,
        "docs/images/demo.svg is out of date: cargo xtask docs"
    );
}
