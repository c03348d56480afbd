//! What a run writes never takes the place of what it reads.

use std::fs;
use std::process::{Command, Stdio};

use crate::{CORRIDOR, command_in, folder, tolman, tolman_in};

#[test]
fn what_cannot_be_written_is_refused_before_the_work() {
    let folder = folder("outputs-refused");
    fs::write(folder.join("a.maze"), CORRIDOR).unwrap();
    fs::write(folder.join("hall.yaml"), "image: hall.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.6\nfree_thresh: 0.2\n").unwrap();
    fs::write(folder.join("hall.pgm"), "P2 1 1 9 9").unwrap();
    fs::create_dir_all(folder.join("one")).unwrap();
    fs::write(folder.join("one/only.maze"), CORRIDOR).unwrap();
    let of_run = "run avoid --maze a.maze --steps 900000000";
    for (words, parts) in [
        (
            format!("{of_run} --svg none/a.svg"),
            ["cannot write none/a.svg", "can be written to"],
        ),
        (
            format!("{of_run} --svg one"),
            ["cannot write one", "can be written to"],
        ),
        (format!("{of_run} --svg a.html"), ["no .html file", ".svg"]),
        (
            format!("{of_run} --replay a.GIF"),
            ["no .gif file", ".html"],
        ),
        (
            format!("{of_run} --trace a.maze"),
            ["no .maze file", ".jsonl"],
        ),
        (
            format!("{of_run} --trace a --svg ./a"),
            ["both write", "name two files"],
        ),
        (
            format!("{of_run} --trace run.unfinished"),
            ["both write", "name two files"],
        ),
        (
            "learn --system mslst-better --maze a.maze --out m.json --svg m.json.unfinished".into(),
            ["both write", "name two files"],
        ),
        (
            "run avoid --world hall.yaml --trace ./hall.pgm".into(),
            ["no .pgm", "jsonl"],
        ),
        (
            "mouse one --svg one/only.maze".into(),
            ["no .maze file", ".svg"],
        ),
        (
            "experiment baselines --quick --out a.maze/b".into(),
            ["cannot write into a.maze/b", "can be written to"],
        ),
        (
            "map --log a.maze --out a.maze/b".into(),
            ["cannot write into a.maze/b", "can be written to"],
        ),
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        tolman_in(&folder, &words).refused(2, &parts);
    }
    let mut names: Vec<_> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    names.sort();
    assert_eq!(names, ["a.maze", "hall.pgm", "hall.yaml", "one"]);
}

#[cfg(unix)]
#[test]
fn an_input_that_is_not_named_is_one_all_the_same() {
    use std::os::unix::fs::symlink;

    let folder = folder("outputs-unnamed");
    fs::write(folder.join("a.maze"), CORRIDOR).unwrap();
    fs::write(folder.join("hall.yaml"), "image: hall\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.6\nfree_thresh: 0.2\n").unwrap();
    fs::write(folder.join("hall"), "P2 1 1 9 9").unwrap();
    fs::create_dir_all(folder.join("one")).unwrap();
    fs::write(folder.join("one/only"), CORRIDOR).unwrap();
    fs::create_dir_all(folder.join("results/audit/cleaned")).unwrap();
    fs::write(
        folder.join("results/audit/cleaned/cleaned.g2o"),
        "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n",
    )
    .unwrap();
    symlink("a.maze", folder.join("a.html")).unwrap();
    for words in [
        "run avoid --world hall.yaml --svg hall",
        "mouse one --svg one/only",
        "audit results/audit/cleaned/cleaned.g2o",
        "replay a.maze --force",
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        tolman_in(&folder, &words).refused(2, &["this run reads that file"]);
    }
    let mut fed = command_in(&folder, &["maze", "convert", "-", "--out", "a.maze"]);
    let fed = fed.stdin(fs::File::open(folder.join("a.maze")).unwrap());
    let fed: crate::Ended = fed.output().unwrap().into();
    fed.refused(2, &["this run reads that file"]);
    assert_eq!(fs::read_to_string(folder.join("a.maze")).unwrap(), CORRIDOR);
}

#[cfg(unix)]
#[test]
fn a_run_writes_through_links_and_devices_and_beside_others() {
    use std::os::unix::fs::{PermissionsExt, symlink};

    let folder = folder("outputs-written");
    let out = |name: &str| {
        tolman_in(
            &folder,
            &[
                "maze", "generate", "perfect", "--size", "4x4", "--out", name,
            ],
        )
    };
    assert!(
        tolman(&["maze", "generate", "perfect", "--out", "/dev/stdout"])
            .done()
            .contains("o---o")
    );
    out("/dev/null").done();
    fs::write(folder.join("victim"), "precious").unwrap();
    symlink("victim", folder.join(".a.maze.tmp")).unwrap();
    out("a.maze").done();
    assert_eq!(
        fs::read_to_string(folder.join("victim")).unwrap(),
        "precious"
    );
    fs::set_permissions(folder.join("a.maze"), fs::Permissions::from_mode(0o640)).unwrap();
    symlink("a.maze", folder.join("link")).unwrap();
    out("link").done();
    assert!(folder.join("link").is_symlink());
    let mode = fs::metadata(folder.join("a.maze"))
        .unwrap()
        .permissions()
        .mode();
    assert_eq!(mode & 0o777, 0o640);
    let start = |seed: &str| {
        let words = [
            "maze", "generate", "perfect", "--size", "200x200", "--out", "one", "--seed", seed,
        ];
        command_in(&folder, &words)
            .stderr(Stdio::null())
            .spawn()
            .unwrap()
    };
    let mut all: Vec<_> = ["1", "2", "3", "4"].map(start).into();
    assert!(all.iter_mut().all(|child| child.wait().unwrap().success()));
    tolman_in(&folder, &["maze", "check", "one"]).done();
    let names = Command::new("ls")
        .arg("-A")
        .current_dir(&folder)
        .output()
        .unwrap();
    assert_eq!(
        String::from_utf8(names.stdout)
            .unwrap()
            .matches(".tmp")
            .count(),
        1
    );
}
