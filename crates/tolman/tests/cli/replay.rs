use std::fs;
use std::path::Path;

use crate::{CORRIDOR, folder, tolman_fed, tolman_in};

/// Returns the data that a replay's page gives the player.
fn data(file: &Path) -> serde_json::Value {
    let page = fs::read_to_string(file).unwrap();
    let begin = "type=\"application/json\">";
    let data = &page[page.find(begin).unwrap() + begin.len()..];
    serde_json::from_str(&data[..data.find("</script>").unwrap()]).unwrap()
}

/// Returns a folder with a maze and the traces of a run that stopped early, of the whole run and of
/// another one.
fn traces(name: &str) -> std::path::PathBuf {
    let folder = folder(&format!("replay-{name}"));
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    for (brain, steps, trace, code) in [
        ("avoid", "3", "short.jsonl", 1),
        ("avoid", "60", "avoid.jsonl", 0),
        ("random", "60", "random.jsonl", 0),
    ] {
        let run = ["run", brain, "--maze", "corridor.maze", "--seed", "6"];
        let options = ["--steps", steps, "--trace", trace];
        tolman_in(&folder, &[&run[..], &options].concat()).failed(code, &[]);
    }
    folder
}

#[test]
fn the_demo_needs_nothing_and_overwrites_nothing() {
    let folder = folder("replay-demo");
    let first = tolman_in(&folder, &["demo"]).done();
    assert!(
        first.contains("drove to the goal") && first.contains("tolman-demo.html"),
        "{first}"
    );
    let second = tolman_in(&folder, &["demo"]).done();
    assert!(second.contains("tolman-demo-2.html"), "{second}");
    let replay = data(&folder.join("tolman-demo.html"));
    assert_eq!(replay["format"], "tolman-replay");

    fs::write(folder.join("letter.html"), "my letter").unwrap();
    tolman_in(&folder, &["demo", "--out", "letter.html"])
        .refused(2, &["letter.html", "not a replay", "--force"]);
    let letter = fs::read_to_string(folder.join("letter.html")).unwrap();
    assert_eq!(letter, "my letter");
}

#[test]
fn a_run_leaves_a_replay_that_tells_how_to_make_it_again() {
    let folder = folder("replay-run");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let run = [
        "run",
        "avoid",
        "--maze",
        "corridor.maze",
        "--replay",
        "my run.html",
    ];
    let told = tolman_in(&folder, &run).done();
    assert!(
        told.contains("file://") && told.contains("my%20run.html"),
        "{told}"
    );
    let replay = data(&folder.join("my run.html"));
    let facts = replay["facts"].as_array().unwrap();
    let made_by = facts.iter().find(|fact| fact[0] == "made by").unwrap();
    let again = "tolman run avoid --maze corridor.maze --replay 'my run.html'";
    assert_eq!(made_by[1], again);
    assert_eq!(replay["tracks"][0]["notes"][0]["name"], "action");
}

#[test]
fn a_replay_lies_beside_its_trace() {
    let folder = traces("beside");
    let told = tolman_in(&folder, &["replay", "avoid.jsonl"]).done();
    assert!(told.contains("/replay-beside/avoid.html"), "{told}");
    assert_eq!(data(&folder.join("avoid.html"))["title"], "avoid.jsonl");

    fs::write(folder.join("random.html"), "my letter").unwrap();
    tolman_in(&folder, &["replay", "random.jsonl"]).refused(2, &["random.html", "--force"]);
    tolman_in(&folder, &["replay", "random.jsonl", "--force"]).done();

    tolman_in(&folder, &["replay", "avoid.jsonl", "--out", "avoid.jsonl"])
        .refused(2, &["writes no .jsonl file"]);
}

#[test]
fn two_traces_are_held_against_each_other() {
    let folder = traces("compare");
    let compare = |first, second| {
        let command = ["replay", first, second, "--out", "compared.html"];
        let told = tolman_in(&folder, &command).done();
        (told, data(&folder.join("compared.html")))
    };
    let (told, _) = compare("avoid.jsonl", "avoid.jsonl");
    assert!(told.contains("the same to the bit\n"), "{told}");
    let (told, _) = compare("avoid.jsonl", "short.jsonl");
    assert!(
        told.contains("up to step 3, where the second ends"),
        "{told}"
    );
    let (told, replay) = compare("avoid.jsonl", "random.jsonl");
    assert!(told.contains("first differ at step"), "{told}");
    assert_eq!(replay["tracks"].as_array().unwrap().len(), 2);
    assert_eq!(replay["marks"][0]["kind"], "difference");
    assert_ne!(replay["marks"][0]["steps"], "");
}

#[test]
fn the_last_bit_of_a_pose_and_a_bump_are_differences() {
    let folder = traces("bits");
    let trace = fs::read_to_string(folder.join("avoid.jsonl")).unwrap();
    let line = trace
        .lines()
        .find(|line| line.contains("\"tick\":4,"))
        .unwrap();
    let step: serde_json::Value = serde_json::from_str(line).unwrap();
    let x = step["step"]["pose"]["position"][0].as_f64().unwrap();
    let bump = step["step"]["bump"].as_bool().unwrap();
    for (from, to, what) in [
        (x.to_string(), x.next_up().to_string(), "in the pose"),
        (
            format!("\"bump\":{bump},\"sensing\""),
            format!("\"bump\":{},\"sensing\"", !bump),
            "in the bump",
        ),
    ] {
        let changed = line.replacen(&from, &to, 1);
        assert_ne!(changed, line);
        fs::write(folder.join("changed.jsonl"), trace.replace(line, &changed)).unwrap();
        let command = ["replay", "avoid.jsonl", "changed.jsonl", "--force"];
        let told = tolman_in(&folder, &command).done();
        assert!(
            told.contains("first differ at step 4") && told.contains(what),
            "{told}"
        );
    }
}

#[test]
fn traces_of_two_worlds_share_no_slider() {
    let folder = traces("worlds");
    let wider = CORRIDOR.replace("0.95", "0.96");
    fs::write(folder.join("wider.maze"), wider).unwrap();
    let run = ["run", "avoid", "--maze", "wider.maze"];
    tolman_in(&folder, &[&run[..], &["--trace", "wider.jsonl"]].concat()).done();
    tolman_in(&folder, &["replay", "avoid.jsonl", "wider.jsonl"])
        .refused(2, &["wider.jsonl", "another world", "avoid.jsonl"]);
}

#[test]
fn a_broken_trace_is_refused_with_its_line() {
    let folder = traces("broken");
    let trace = fs::read_to_string(folder.join("avoid.jsonl")).unwrap();
    let cut = trace.lines().take(2).collect::<Vec<_>>().join("\n");
    fs::write(folder.join("cut.jsonl"), &cut[..cut.len() - 9]).unwrap();
    let refused = tolman_in(&folder, &["replay", "cut.jsonl"]);
    // Once, and no line but that of the trace.
    assert_eq!(refused.err.matches("EOF").count(), 1, "{}", refused.err);
    assert!(!refused.err.contains("line 1"), "{}", refused.err);
    refused.refused(2, &["cut.jsonl", "line 2", "column"]);
    assert!(!folder.join("cut.html").exists());
    tolman_in(&folder, &["replay", "none.jsonl"]).refused(2, &["none.jsonl"]);
    tolman_in(&folder, &["replay", "-"]).refused(2, &["--out"]);
}

#[test]
fn a_trace_comes_from_standard_input_too() {
    let folder = traces("stdin");
    let trace = fs::read_to_string(folder.join("avoid.jsonl")).unwrap();
    let out = folder.join("fed.html");
    tolman_fed(&trace, &["replay", "-", "--out", out.to_str().unwrap()]).done();
    assert_eq!(data(&out)["title"], "standard input");
}

#[test]
fn a_replay_for_foxglove_needs_the_feature() {
    let folder = folder("replay-mcap");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let run = [
        "run",
        "avoid",
        "--maze",
        "corridor.maze",
        "--replay",
        "run.mcap",
    ];
    if cfg!(not(feature = "mcap")) {
        tolman_in(&folder, &run).refused(2, &["run.mcap", "--features mcap"]);
        return;
    }
    for _ in 0..2 {
        let told = tolman_in(&folder, &run).done();
        assert!(told.contains("run.mcap"), "{told}");
    }
    let written = fs::read(folder.join("run.mcap")).unwrap();
    assert!(written.starts_with(b"\x89MCAP0\r\n") && written.ends_with(b"\x89MCAP0\r\n"));
}

#[test]
fn a_replay_for_rerun_needs_another_command() {
    let folder = folder("replay-rrd");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let run = [
        "run",
        "avoid",
        "--maze",
        "corridor.maze",
        "--replay",
        "run.rrd",
    ];
    tolman_in(&folder, &run).refused(2, &["run.rrd", "tolman-rerun"]);
    assert!(!folder.join("run.rrd").exists());
}
