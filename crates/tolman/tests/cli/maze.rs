use std::process::Stdio;

use crate::{CORRIDOR, command_in, folder, tolman, tolman_fed, tolman_in};

#[test]
fn show_draws_the_maze_and_its_figures() {
    let shown = tolman_fed(CORRIDOR, &["maze", "show", "-"]).done();
    let expected = "\
Corridor
o---o---o---o
| S       G |
o---o---o---o
standard input: 3 × 1 cells of 0.95 m, start (0, 0) north, 1 goal cell, 2 dead ends, 0 junctions, shortest way 2 cells
";
    assert_eq!(shown, expected);
}

#[test]
fn show_as_json_has_the_figures_and_the_drawing() {
    let shown = tolman_fed(CORRIDOR, &["maze", "show", "-", "--json"]).done();
    let shown: serde_json::Value = serde_json::from_str(&shown).unwrap();
    assert_eq!(shown["columns"], 3);
    assert_eq!(shown["shortest_way"], 2);
    assert_eq!(shown["drawing"].as_str().unwrap().lines().count(), 3);
}

#[test]
fn a_missing_file_is_named() {
    tolman(&["maze", "show", "nowhere.maze"])
        .refused(2, &["error:", "nowhere.maze", "give the path"]);
}

#[test]
fn a_malformed_maze_is_named_with_line_and_column() {
    let folder = folder("malformed");
    std::fs::write(folder.join("bad.maze"), CORRIDOR.replace("| S ", "| X ")).unwrap();
    for verb in ["show", "check", "convert"] {
        tolman_in(&folder, &["maze", verb, "bad.maze"])
            .refused(2, &["bad.maze", "line 5, column 3", "'X'"]);
    }
}

#[test]
fn what_is_no_text_is_refused() {
    let folder = folder("binary");
    std::fs::write(folder.join("bytes"), [b'o', 0xff, 0xfe]).unwrap();
    tolman_in(&folder, &["maze", "check", "bytes"])
        .refused(2, &["bytes", "byte 1 of the file is not UTF-8"]);
}

#[test]
fn an_unsolvable_maze_can_be_shown_but_does_not_pass_the_check() {
    let parted = CORRIDOR.replace("| S     ", "| S |   ");
    assert!(
        tolman_fed(&parted, &["maze", "show", "-"])
            .done()
            .contains("| S |")
    );
    tolman_fed(&parted, &["maze", "check", "-"]).refused(2, &["no way leads from the start"]);
}

#[test]
fn check_goes_on_after_an_unsound_maze() {
    let folder = folder("several");
    std::fs::write(folder.join("good.maze"), CORRIDOR).unwrap();
    std::fs::write(folder.join("bad.maze"), "<html>").unwrap();
    let ended = tolman_in(
        &folder,
        &["maze", "check", "bad.maze", "good.maze", "gone.maze"],
    );
    assert_eq!(ended.code, Some(2));
    assert!(
        ended.out.starts_with("good.maze: 3 × 1 cells"),
        "{}",
        ended.out
    );
    for part in ["bad.maze: line 1", "gone.maze", "2 of 3 mazes are invalid"] {
        assert!(ended.err.contains(part), "{}", ended.err);
    }
}

#[test]
fn a_maze_survives_every_format() {
    let generate = [
        "maze", "generate", "braided", "--size", "8x8", "--seed", "5",
    ];
    let maze = tolman(&generate).done();
    for format in ["numbers", "mazefiles", "num"] {
        let there = tolman_fed(&maze, &["maze", "convert", "-", "--to", format]).done();
        assert_ne!(there, maze);
        assert_eq!(
            tolman_fed(&there, &["maze", "convert", "-"]).done(),
            maze,
            "{format}"
        );
    }
}

#[test]
fn the_seed_and_the_kind_make_the_maze() {
    let generate = |kind, seed| tolman(&["maze", "generate", kind, "--seed", seed]).done();
    assert_eq!(generate("rooms", "5"), generate("rooms", "5"));
    assert_ne!(generate("rooms", "5"), generate("rooms", "6"));
    assert_ne!(generate("rooms", "5"), generate("perfect", "5"));
}

#[test]
fn every_family_that_is_listed_can_be_generated_and_is_sound() {
    let listed = tolman(&["maze", "generate", "--list"]).done();
    let names: Vec<&str> = listed.lines().map(|line| line[..14].trim()).collect();
    assert_eq!(names.len(), 15, "{listed}");
    for name in names {
        let name = name.replace(' ', "-");
        let maze = tolman(&["maze", "generate", &name, "--size", "small"]).done();
        tolman_fed(&maze, &["maze", "check", "-"]).done();
    }
    // What CPM and the diktiometry follow are corridors.
    let braided = tolman(&["maze", "generate", "braided", "--seed", "3"]).done();
    let maze = tolman_maze::read(&braided).unwrap().maze;
    assert!(!maze.grid().cells().any(|cell| maze.is_room(cell)));
}

#[test]
fn what_cannot_be_generated_is_refused() {
    let refused = |size: &str, parts: &[&str]| {
        tolman(&["maze", "generate", "perfect", "--size", size]).refused(2, parts);
    };
    refused("0x5", &["0 × 5"]);
    refused("5", &["--size", "16x16"]);
    refused("70000x3", &["--size", "16x16"]);
    tolman(&["maze", "generate", "braided", "--share", "NaN"]).refused(2, &["NaN", "0 to 1"]);
    tolman(&["maze", "generate", "comb", "--share", "1"]).refused(2, &["--share", "comb"]);
    tolman(&["maze", "generate", "comb", "--attempts", "1"]).refused(2, &["--attempts", "rooms"]);
    tolman(&["maze", "generate", "comb", "--size", "2x2"]).refused(2, &["comb", "at least 3 × 2"]);
    tolman(&["maze", "generate", "cmb"]).refused(2, &["cmb", "did you mean comb", "spiral"]);
}

#[test]
fn a_format_that_cannot_hold_the_maze_is_refused() {
    tolman_fed(CORRIDOR, &["maze", "convert", "-", "--to", "numbers"])
        .refused(2, &["`numbers`", "3 × 1", "write it as `tolman`"]);
}

#[test]
fn what_a_format_cannot_hold_is_named_on_stderr() {
    let converted = tolman_fed(CORRIDOR, &["maze", "convert", "-", "--to", "mazefiles"]);
    assert_eq!(converted.code, Some(0));
    assert!(converted.out.starts_with("o---o"), "{}", converted.out);
    for part in ["`mazefiles`", "name", "width"] {
        assert!(converted.err.contains(part), "{}", converted.err);
    }
    // A drawing alone loses nothing.
    tolman_fed(
        &converted.out,
        &["maze", "convert", "-", "--to", "mazefiles"],
    )
    .done();
}

#[test]
fn a_file_is_written_whole_or_not_at_all() {
    let folder = folder("written");
    std::fs::write(folder.join("in.maze"), CORRIDOR).unwrap();
    let convert = |to| tolman_in(&folder, &["maze", "convert", "in.maze", "--out", to]);
    convert("out.maze").done();
    assert!(
        std::fs::read_to_string(folder.join("out.maze"))
            .unwrap()
            .contains("Corridor")
    );
    convert("nowhere/out.maze").refused(2, &["nowhere/out.maze"]);
    assert_eq!(
        std::fs::read_dir(&folder).unwrap().count(),
        2,
        "nothing else is left behind"
    );
}

#[test]
fn a_closed_pipe_is_no_failure() {
    let mut child = command_in(&folder("pipe"), &["maze", "show", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The reader is gone before the maze arrives, so the very first write meets a closed pipe.
    drop(child.stdout.take());
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), CORRIDOR.as_bytes()).unwrap();
    let ended = child.wait_with_output().unwrap();
    assert_eq!((ended.status.code(), ended.stderr), (Some(0), Vec::new()));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    let full = std::fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let ended = command_in(&folder("full"), &["maze", "generate", "perfect"])
        .stdout(full)
        .stderr(Stdio::piped())
        .output()
        .unwrap();
    let told = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(1), "{told}");
    assert!(told.contains("cannot write to standard output"), "{told}");
}

#[test]
fn errors_are_plain_where_nobody_looks() {
    let ended = tolman(&["maze", "show", "nowhere.maze"]);
    assert!(!ended.err.contains('\u{1b}'), "{:?}", ended.err);
}
