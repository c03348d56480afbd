//! The command writes a run both as a trace and as `.rrd`; both hold the same poses.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![expect(clippy::panic, reason = "the same")]

use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

use re_chunk::Chunk;
use re_log_encoding::DecoderApp;
use re_log_types::LogMsg;
use re_sdk_types::archetypes::Transform3D;
use re_sdk_types::components::Translation3D;
use serde_json::Value;

const CORRIDOR: &str = "\
name = Corridor
corridor_width = 0.95

o---o---o---o
| S       G |
o---o---o---o
";

/// Returns a new folder with the maze.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    folder
}

/// Runs a command line in `folder`. It has to succeed.
fn tolman_rerun(folder: &Path, line: &str) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tolman-rerun"));
    let output = command
        .args(line.split(' '))
        .current_dir(folder)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{line}: {told}");
}

/// Returns the positions of the robot after each step of a trace, m.
fn traced(file: &Path) -> Vec<[f64; 2]> {
    let text = fs::read_to_string(file).unwrap();
    let position = |line: &str| {
        let step: Value = serde_json::from_str(line).unwrap();
        let position = &step["step"]["pose"]["position"];
        [0, 1].map(|axis| position[axis].as_f64().unwrap())
    };
    text.lines().skip(1).map(position).collect()
}

/// Returns the positions of the only robot of a recording, with their steps.
fn recorded(file: &Path) -> Vec<(i64, [f64; 2])> {
    let messages = DecoderApp::decode_lazy(BufReader::new(File::open(file).unwrap()));
    let chunks = messages.filter_map(|message| match message.unwrap() {
        LogMsg::ArrowMsg(_, message) => Some(Chunk::from_arrow_msg(&message).unwrap()),
        _ => None,
    });
    let component = Transform3D::descriptor_translation().component;
    let mut moving = chunks.filter(|chunk| chunk.components().contains_component(component));
    let (Some(robot), None) = (moving.next(), moving.next()) else {
        panic!("there is one robot");
    };
    let steps = robot.iter_component_indices("step".into(), component);
    let at = robot.iter_component::<Translation3D>(component);
    let at = at.map(|at| [at[0].x().into(), at[0].y().into()]);
    steps.map(|(step, _)| step.as_i64()).zip(at).collect()
}

#[test]
fn a_run_and_its_trace_have_the_same_poses() {
    let folder = folder("poses");
    let run = "run avoid --maze corridor.maze --seed 6 --trace run.jsonl --replay run.rrd";
    tolman_rerun(&folder, run);
    let traced = traced(&folder.join("run.jsonl"));
    let recorded = recorded(&folder.join("run.rrd"));
    // Step 0 is the start, of which the trace has no line.
    assert_eq!(recorded.len(), traced.len() + 1);
    assert!(traced.len() > 3, "the robot drives");
    for ((step, [x, y]), (number, [to_x, to_y])) in recorded[1..].iter().zip((1..).zip(traced)) {
        assert_eq!(*step, number);
        assert!((x - to_x).abs() < 1e-6 && (y - to_y).abs() < 1e-6, "{step}");
    }
}

#[test]
fn a_recording_may_be_overwritten_and_another_file_may_not() {
    let folder = folder("overwritten");
    let run = "run avoid --maze corridor.maze --replay run.rrd";
    for _ in 0..2 {
        tolman_rerun(&folder, run);
    }
    fs::write(folder.join("run.rrd"), "my letter").unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_tolman-rerun"));
    command.args(run.split(' ')).current_dir(&folder);
    assert_eq!(command.output().unwrap().status.code(), Some(2));
    let letter = fs::read_to_string(folder.join("run.rrd")).unwrap();
    assert_eq!(letter, "my letter");
}
