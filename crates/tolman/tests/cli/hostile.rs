//! Files and names that do harm to a program that trusts them.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::fs::symlink;
use std::process::{Command, Stdio};

use flate2::Compression;
use flate2::write::GzEncoder;

use crate::{CORRIDOR, Ended, command_in, folder, tolman_in};

/// A maze for mice: two columns, with the goal in the north.
const GRID: &str = "\
o---o---o
|     G |
o   o   o
| S     |
o---o---o
";

/// Characters that turn words around or command a terminal.
const HOSTILE: &str = "a\u{1b}]0;b\u{7}\u{202e}c";

/// Returns the words that learn a little of a corridor.
fn learn(out: &str) -> Vec<&str> {
    let words = "learn --system mslst --maze corridor.maze --set scan_steps=300 --set graph_actions=60 --unfinished u --out";
    words.split(' ').chain([out]).collect()
}

#[test]
fn no_hidden_character_reaches_the_terminal_or_a_page() {
    let folder = folder("hidden");
    let name = format!("{HOSTILE}.maze");
    fs::write(folder.join(&name), GRID).unwrap();
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    tolman_in(&folder, &learn("map.json"));
    let map = fs::read_to_string(folder.join("map.json")).unwrap();
    let map = map.replace("Corridor", r"a\u001b]0;b\u0007\u202ec");
    fs::write(folder.join("map.json"), map).unwrap();
    let shown = |words: &[&str]| {
        let told = tolman_in(&folder, words);
        let all = format!("{}{}", told.out, told.err);
        assert!(
            all.contains(r"a\u001b]0;b\u0007\u202ec") || all.contains(r"\u202e"),
            "{words:?}: {all}"
        );
        assert!(
            !all.contains(['\u{1b}', '\u{7}', '\u{202e}']),
            "{words:?}: {all}"
        );
    };
    shown(&["maze", "check", &name]);
    shown(&["maze", "check", &name, "--json"]);
    shown(&["mouse", &name]);
    shown(&["race", &name, "--svg", "race.svg", "--replay", "race.html"]);
    shown(&["mms-host", "--maze", &name, "--mouse", "true"]);
    shown(&["map", "show", "map.json"]);
    for page in ["race.svg", "race.html"] {
        let page = fs::read_to_string(folder.join(page)).unwrap();
        assert!(page.contains("\\u202e"), "{page}");
        assert!(!page.contains(['\u{1b}', '\u{7}', '\u{202e}']));
    }
}

#[test]
fn what_never_ends_or_leads_nowhere_is_refused() {
    let folder = folder("endless");
    let fifo = Command::new("mkfifo")
        .arg(folder.join("fifo"))
        .status()
        .unwrap();
    assert!(fifo.success());
    symlink("nowhere", folder.join("link")).unwrap();
    fs::write(folder.join("a.txt"), GRID).unwrap();
    let line = format!(
        "FLASER 2 1.0 1.0 0 0 0 0 0 0 1 pippo 1 {}\n",
        " ".repeat(4000)
    );
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    for _ in 0..600 {
        packed.write_all(line.as_bytes()).unwrap();
    }
    fs::write(folder.join("bomb.gz"), packed.finish().unwrap()).unwrap();
    let run = |words: &str| tolman_in(&folder, &words.split(' ').collect::<Vec<_>>());
    run("maze check fifo").refused(2, &["fifo", "pipe or a device", "/dev/stdin"]);
    run("maze check /dev/zero").refused(2, &["pipe or a device"]);
    run("map show fifo").refused(2, &["pipe or a device"]);
    run("map --log fifo --out o").refused(2, &["pipe or a device"]);
    run("score --trajectory fifo --truth fifo").refused(2, &["pipe or a device"]);
    run("map --log bomb.gz --out o --most-mib 1").refused(2, &["more than 1 MiB", "--most-mib"]);
    assert!(
        run("mouse .")
            .failed(2, &["link", "3 of 4 mazes are invalid"])
            .contains("a.txt: ")
    );
}

#[test]
fn a_byte_order_mark_and_other_small_faults() {
    let folder = folder("small-faults");
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    let run = |words: &str| tolman_in(&folder, &words.split(' ').collect::<Vec<_>>());
    write("a.txt", &format!("\u{feff}{GRID}"));
    run("race a.txt").done();
    run("race --template").done();
    write(
        "mine.toml",
        &format!("\u{feff}{}", run("race --template").done()),
    );
    run("race a.txt --mouse mine.toml").done();
    write("mine.toml", "cell_mm = 0.1\n");
    let told = run("race a.txt --mouse mine.toml").failed(2, &["--template"]);
    assert_eq!(told, "");
    let err = run("race a.txt --mouse mine.toml").err;
    assert!(err.find("missing field") < err.find("--template"), "{err}");
    for (origin, free, part) in [
        ("[0, 0]", 0.1, "origin"),
        ("[0, 0, 0]", 0.7, "below `occupied_thresh`"),
        ("[0, 0, 0]", 0.6, "below `occupied_thresh`"),
    ] {
        write(
            "a.yaml",
            &format!(
                "image: a.pgm\nresolution: 1\norigin: {origin}\nnegate: 0\noccupied_thresh: 0.6\nfree_thresh: {free}\n"
            ),
        );
        run("run avoid --world a.yaml").refused(2, &["a.yaml", part]);
    }
    write("corridor.maze", CORRIDOR);
    run("run avoid --maze corridor.maze --steps 3 --trace t.jsonl").failed(1, &[]);
    let trace = fs::read_to_string(folder.join("t.jsonl")).unwrap();
    let (before, rest) = trace.split_once("\"step_us\":").unwrap();
    let (_, after) = rest.split_once(',').unwrap();
    write("zero.jsonl", &format!("{before}\"step_us\":0,{after}"));
    run("replay zero.jsonl").refused(2, &["line 1", "step_us"]);
    for words in [
        "run avoid --maze corridor.maze --start 1e308,1e308",
        "mms-host --mouse true --maze a.txt --time-limit 1e308",
    ] {
        let told = run(words);
        assert_eq!(told.code, Some(2));
        assert!(told.err.len() < 400, "{}", told.err);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_map_that_cannot_be_written_is_told_to_be_lost() {
    let folder = folder("full");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let told = tolman_in(&folder, &learn("/dev/full"));
    assert!(
        told.err.contains("is lost") || told.err.contains("go on with"),
        "{}",
        told.err
    );
    let told = told.failed(1, &["cannot write /dev/full", "No space left"]);
    assert_eq!(told, "");
}

#[test]
fn what_is_done_is_told_before_an_interruption() {
    let folder = folder("told-early");
    for number in 1..9 {
        fs::write(folder.join(format!("{number}.txt")), GRID).unwrap();
    }
    fs::write(folder.join("9.txt"), "bad").unwrap();
    // The first mouse ends at once, the others never.
    let mouse = "sh -c 'mkdir once 2>/dev/null || sleep 60'";
    let words = ["mms-host", "--maze", ".", "--jobs", "1", "--mouse", mouse];
    let mut child = command_in(&folder, &words)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let mut first = String::new();
    out.read_line(&mut first).unwrap();
    assert!(first.contains("1.txt: not solved"), "{first}");
    Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    let rest: Vec<String> = out.lines().map(Result::unwrap).collect();
    let told: Ended = child.wait_with_output().unwrap().into();
    told.failed(130, &["interrupted after 1 of 8 mazes"]);
    assert_eq!(
        rest.last().unwrap(),
        "0 of 1 solved, mean score 2000.0 (2000.0 in cells)"
    );
}
