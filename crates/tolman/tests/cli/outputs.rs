//! What a run writes never takes the place of what it reads.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::{CORRIDOR, command_in, folder, tolman, tolman_in};

/// Each verb with options that it needs, then the options that name files to read, then those that
/// name files to write, then those that name folders to write into. `@` marks an argument without
/// a name.
const VERBS: &[[&str; 4]] = &[
    ["arena @MAZE --system cpm", "@MAZE", "", ""],
    ["audit @GRAPH --out new", "@GRAPH", "", "--out"],
    ["completions bash", "", "", ""],
    ["demo --maze other", "--maze", "--out --svg", ""],
    [
        "drive --map map --maze other",
        "--map --maze --from",
        "--svg --trace --replay --unfinished",
        "",
    ],
    ["drive --map map --world other", "--world", "--svg", ""],
    [
        "experiment baselines --maze other --out new",
        "--maze --compare --verify",
        "",
        "--out",
    ],
    [
        "host --maze other -- true",
        "--maze",
        "--svg --trace --replay",
        "",
    ],
    ["host --world other -- true", "--world", "--svg", ""],
    [
        "learn --system cpm --maze other --out new",
        "--maze --from",
        "--out --svg --trace --replay --unfinished",
        "",
    ],
    [
        "learn --system cpm --world other --out new",
        "--world",
        "--out",
        "",
    ],
    ["man", "", "", "--out"],
    ["map --log log --out new", "--log", "", "--out"],
    ["map check @FILE --maze other", "@FILE --maze", "", ""],
    ["map check @FILE --world other", "--world", "", ""],
    ["map plan @FILE", "@FILE", "", ""],
    ["map show @FILE --maze other", "@FILE --maze", "--svg", ""],
    ["map show @FILE --world other", "--world", "--svg", ""],
    ["maze check @FILES", "@FILES", "", ""],
    ["maze convert @FILE", "@FILE", "--out", ""],
    ["maze distinct @MAZES", "@MAZES", "", ""],
    ["maze generate perfect", "", "--out", ""],
    ["maze show @FILE", "@FILE", "", ""],
    ["merge @DIR", "@DIR", "", ""],
    [
        "mms-host --mouse true --maze other",
        "--maze",
        "--svg --trace --replay",
        "",
    ],
    ["mouse @FILE|DIR", "@FILE|DIR", "--svg --trace --replay", ""],
    ["pitch gather pitch --out new", "", "--out", ""],
    ["pitch score @FILE", "@FILE", "", ""],
    ["pitch show @FILE", "@FILE", "--svg", ""],
    ["pitch world pitch", "", "--out", ""],
    [
        "race @MAZE|DIR",
        "@MAZE|DIR --mouse",
        "--svg --trace --replay",
        "",
    ],
    ["replay @TRACE", "@TRACE", "--out", ""],
    [
        "run avoid --maze other",
        "--maze --from",
        "--svg --trace --replay --unfinished",
        "",
    ],
    ["run avoid --world other", "--world", "--svg", ""],
    [
        "score --trajectory other --truth other",
        "--trajectory --truth --relations",
        "",
        "",
    ],
    ["systems", "", "", ""],
    [
        "trial --experiment baselines --chunk 1/1",
        "--maze",
        "",
        "--out",
    ],
];

/// Values of options that are names of files or folders.
const NAMES: [&str; 4] = ["<FILE>", "<DIR>", "<FILE|DIR>", "<PARAMS.toml>"];

/// Returns `words` with this value of an option, or of the argument in its place.
fn with(words: &[String], option: &str, value: &str) -> Vec<String> {
    let mut words = words.to_vec();
    let place = words.iter().position(|word| word == option);
    let end = words.iter().position(|word| word == "--");
    match (place, option.starts_with('@')) {
        (Some(place), true) => words[place] = value.to_owned(),
        (Some(place), false) => words[place + 1] = value.to_owned(),
        (None, _) => {
            let end = end.unwrap_or(words.len());
            words.splice(end..end, [option.to_owned(), value.to_owned()]);
        }
    }
    words
}

fn run(folder: &Path, words: &[String]) -> crate::Ended {
    let words: Vec<&str> = words
        .iter()
        .map(|word| word.strip_prefix('@').unwrap_or(word))
        .collect();
    tolman_in(folder, &words)
}

#[cfg(unix)]
#[test]
fn no_output_takes_the_place_of_an_input() {
    use std::os::unix::fs::symlink;

    let folder = folder("outputs");
    fs::write(folder.join("other"), "other").unwrap();
    fs::write(folder.join("map"), "map").unwrap();
    let input = folder.join("input");
    fs::write(&input, "precious").unwrap();
    fs::hard_link(&input, folder.join("hard")).unwrap();
    symlink("input", folder.join("soft")).unwrap();
    let tried = VERBS.iter().flat_map(|[words, inputs, outputs, _]| {
        let words: Vec<String> = words.split(' ').map(str::to_owned).collect();
        let outputs: Vec<&str> = outputs.split_whitespace().collect();
        let inputs = inputs.split_whitespace();
        inputs.flat_map(move |input| {
            let of_input = with(&words, input, "input");
            let tried = outputs
                .clone()
                .into_iter()
                .flat_map(|output| ["./input", "hard", "soft"].map(|name| (output, name)));
            let tried: Vec<_> = tried
                .map(|(output, name)| (input, output, with(&of_input, output, name)))
                .collect();
            tried
        })
    });
    let tried: Vec<_> = tried.collect();
    assert!(tried.len() > 100);
    std::thread::scope(|scope| {
        for part in tried.chunks(tried.len().div_ceil(4)) {
            let (folder, input) = (&folder, &input);
            scope.spawn(move || {
                for (from, to, words) in part {
                    let told = run(folder, words);
                    // Learning may put the map that it continues in its own place: it is no map.
                    let goes_on = (*from, *to) == ("--from", "--out");
                    let why = if goes_on {
                        "input"
                    } else {
                        "this run reads that file"
                    };
                    told.refused(2, &[why]);
                    assert_eq!(fs::read_to_string(input).unwrap(), "precious", "{words:?}");
                }
            });
        }
    });
}

/// Every option of every verb that takes the name of a file is in the list above, so that a new one
/// is tried as well.
#[test]
fn every_option_that_names_a_file_is_tried() {
    let mut known = BTreeSet::new();
    for [words, lists @ ..] in VERBS {
        let verb: Vec<&str> = words
            .split(' ')
            .take_while(|word| !word.starts_with(['-', '@']))
            .collect();
        let options = lists.iter().flat_map(|list| list.split_whitespace());
        known.extend(
            options
                .filter(|option| option.starts_with('-'))
                .map(|option| (verb[0], option)),
        );
    }
    let help = tolman(&["--help"]).done();
    let verbs = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let verbs: Vec<&str> = verbs
        .map_while(|line| line.split_whitespace().next())
        .collect();
    assert!(verbs.len() > 15, "{help}");
    let mut found = BTreeSet::new();
    for verb in verbs.into_iter().filter(|verb| *verb != "help") {
        let known = known.iter().any(|(of, _)| *of == verb)
            || VERBS.iter().any(|[words, ..]| words.starts_with(verb));
        assert!(known, "{verb} is not in the list");
        let parts: &[&str] = match verb {
            "map" => &["", "show", "check", "plan"],
            "maze" => &["show", "check", "convert", "generate", "distinct"],
            "pitch" => &["world", "gather", "show", "score"],
            _ => &[""],
        };
        for part in parts {
            let words: Vec<&str> = [verb, part, "-h"]
                .into_iter()
                .filter(|word| !word.is_empty())
                .collect();
            for line in tolman(&words).done().lines() {
                let mut words = line
                    .split_whitespace()
                    .skip_while(|word| !word.starts_with("--"));
                if let (Some(option), Some(value)) = (words.next(), words.next())
                    && line.trim_start().starts_with('-')
                    && NAMES.contains(&value.trim_end_matches("..."))
                {
                    found.insert((verb.to_owned(), option.to_owned()));
                }
            }
        }
    }
    let known: BTreeSet<_> = known
        .into_iter()
        .map(|(verb, option)| (verb.to_owned(), option.to_owned()))
        .collect();
    assert_eq!(found, known);
}

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
            "learn --system cpm --maze a.maze --out m.json --svg m.json.unfinished".into(),
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
    assert_eq!(
        fs::read_to_string(folder.join("one"))
            .unwrap()
            .lines()
            .count(),
        401
    );
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
