//! Logs of robots.

use std::fs;
use std::path::PathBuf;

use crate::{folder, tolman_in};

fn office() -> PathBuf {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.join("logs/office.clf.gz").canonicalize().unwrap()
}

/// Returns the first lines of the small log, plain.
fn beginning() -> String {
    use std::io::Read;
    let packed = fs::File::open(office()).unwrap();
    let mut text = String::new();
    flate2::read::GzDecoder::new(packed)
        .read_to_string(&mut text)
        .unwrap();
    let lines = text.lines().take(60);
    lines.map(|line| format!("{line}\n")).collect()
}

#[test]
fn a_log_is_mapped_and_scored() {
    let folder = folder("log");
    let log = format!("{}TRUEPOS 1 2 3\nFLASER 180 1.0\n", beginning());
    fs::write(folder.join("log.clf"), log).unwrap();
    let told = tolman_in(&folder, &["map", "--log", "log.clf", "--out", "map"]).done();
    assert!(
        told.contains("TRUEPOS: 1 × not used, first in line 61"),
        "{told}"
    );
    assert!(told.contains("line 62 (it has 1 of 180 ranges)"), "{told}");
    for file in [
        "map.svg",
        "map.yaml",
        "map.pgm",
        "trajectory.tum",
        "odometry.tum",
        "noted.tum",
    ] {
        assert!(folder.join("map").join(file).is_file(), "{file}");
    }
    let score = |trajectory: &str| -> f64 {
        let trajectory = format!("map/{trajectory}");
        let score = [
            "score",
            "--trajectory",
            &trajectory,
            "--truth",
            "map/noted.tum",
            "--json",
        ];
        let told = tolman_in(&folder, &score).done();
        let json: serde_json::Value = serde_json::from_str(&told).unwrap();
        json["rms_m"].as_f64().unwrap()
    };
    let (found, wheels) = (score("trajectory.tum"), score("odometry.tum"));
    assert!(found < 0.05 && wheels > 2.0 * found, "{found} {wheels}");
    let relations = "0.1 20 0 0 0 0 0 0\n";
    fs::write(folder.join("relations"), relations).unwrap();
    let score = [
        "score",
        "--trajectory",
        "map/trajectory.tum",
        "--relations",
        "relations",
    ];
    let told = tolman_in(&folder, &score).done();
    assert!(told.starts_with("1 relation, mean error"), "{told}");
    // The map is one that a robot can be sent into.
    let run = [
        "run",
        "wall-follow",
        "--world",
        "map/map.yaml",
        "--goal",
        "8,0",
        "--start",
        "3,0",
    ];
    let ended = tolman_in(&folder, &run);
    ended.done();
}

#[test]
fn a_map_s_graph_is_audited_and_taken_back() {
    let folder = folder("log-graph");
    let office = office();
    let log = office.to_str().unwrap();
    let listed = tolman_in(&folder, &["map", "--list", log]).done();
    assert!(listed.contains("FLASER"), "{listed}");
    tolman_in(&folder, &["map", "--log", log, "--out", "map"]).done();
    let audit = ["audit", "map/graph.g2o", "--out", "audited"];
    let audited = tolman_in(&folder, &audit).done();
    assert!(audited.contains("supported"), "{audited}");
    let again = [
        "map",
        "--log",
        log,
        "--closures",
        "audited/cleaned.g2o",
        "--out",
        "again",
    ];
    tolman_in(&folder, &again).done();
    let score = [
        "score",
        "--trajectory",
        "again/trajectory.tum",
        "--truth",
        "map/noted.tum",
        "--json",
    ];
    let told = tolman_in(&folder, &score).done();
    let json: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert!(json["rms_m"].as_f64().unwrap() < 0.05, "{told}");
    let other = [
        "map",
        "--log",
        log,
        "--closures",
        "other.g2o",
        "--out",
        "again",
    ];
    let graph = "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n";
    fs::write(folder.join("other.g2o"), graph).unwrap();
    tolman_in(&folder, &other).failed(2, &["2 poses", "graph.g2o"]);
}

#[test]
fn a_score_is_of_what_two_trajectories_have_in_common() {
    let folder = folder("score");
    let line = |time: f64| format!("{time} {} {} 0 0 0 0 1\n", time.sin(), 0.1 * time * time);
    let way = |times: &[f64]| -> String { times.iter().copied().map(line).collect() };
    let all: Vec<f64> = (0..100).map(f64::from).collect();
    fs::write(folder.join("truth.tum"), way(&all)).unwrap();
    let score = |name: &str, text: &str| {
        fs::write(folder.join(name), text).unwrap();
        tolman_in(
            &folder,
            &["score", "--trajectory", name, "--truth", "truth.tum"],
        )
    };
    let gap = [&all[..20], &all[80..]].concat();
    let told = score("gap.tum", &way(&gap)).done();
    assert!(
        told.contains("40 of 40 of the trajectory, of 100 of the truth"),
        "{told}"
    );
    assert!(
        told.contains("error 0.000 m") && told.contains("gap without a pose is 61.0 s"),
        "{told}"
    );
    let marked = format!("\u{feff}{}", way(&all));
    assert!(score("mark.tum", &marked).done().contains("100 of 100"));
    score("one.tum", &way(&[1.0, 200.0, 300.0])).refused(2, &["1 pose in common", "--max-diff"]);
    score("twice.tum", &way(&[1.0, 2.0, 3.0, 3.0])).refused(2, &["time 3", "second time"]);
    score("commas.tum", &way(&all).replace('.', ",")).refused(2, &["decimal points"]);
    let nine = way(&all).replace(" 0 0 0 1", " 0 0 0 1 7");
    score("nine.tum", &nine).refused(2, &["line 1: 9 columns"]);
    // KITTI: by number.
    let kitti: String = all
        .iter()
        .map(|x| format!("1 0 0 {x} 0 1 0 0 0 0 1 {}\n", x * x))
        .collect();
    fs::write(folder.join("truth.kitti"), &kitti).unwrap();
    let scaled: String = all
        .iter()
        .map(|x| format!("1 0 0 {} 0 1 0 0 0 0 1 {}\n", 3.0 * x, 3.0 * x * x))
        .collect();
    fs::write(folder.join("scaled.kitti"), &scaled).unwrap();
    let judge = ["--trajectory", "scaled.kitti", "--truth", "truth.kitti"];
    let told = tolman_in(&folder, &[&["score"][..], &judge].concat()).done();
    assert!(
        !told.contains("error 0.000 m") && told.contains("in space"),
        "{told}"
    );
    let told = tolman_in(
        &folder,
        &[&["score", "--align", "scale"][..], &judge].concat(),
    )
    .done();
    assert!(
        told.contains("error 0.000 m") && told.contains("scaled by 0.3333"),
        "{told}"
    );
    score("mixed.kitti", &kitti).refused(2, &["has times"]);
    let table = [
        "score",
        "--trajectory",
        "gap.tum",
        "--trajectory",
        "mark.tum",
        "--truth",
        "truth.tum",
    ];
    let told = tolman_in(&folder, &table).done();
    assert!(
        told.contains("40 of 40") && told.contains("100 of 100"),
        "{told}"
    );
}

const EVO: &str = "\
import sys, json
from evo.core import metrics, sync
from evo.tools import file_interface
truth, found = (file_interface.read_tum_trajectory_file(name) for name in ('truth.tum', 'found.tum'))
truth, found = sync.associate_trajectories(truth, found)
if sys.argv[1] != 'none':
    found.align(truth, correct_scale=sys.argv[1] == 'scale')
step = int(sys.argv[2])
ape = metrics.APE(metrics.PoseRelation.translation_part)
rpe = metrics.RPE(metrics.PoseRelation.translation_part, delta=step)
turn = metrics.RPE(metrics.PoseRelation.rotation_angle_rad, delta=step)
for metric in (ape, rpe, turn):
    metric.process_data((truth, found))
told = ape.get_all_statistics()
told['relative'] = rpe.get_statistic(metrics.StatisticsType.rmse)
told['turn'] = turn.get_statistic(metrics.StatisticsType.rmse)
print(json.dumps(told))
";

#[test]
#[ignore = "fetches evo from PyPI: cargo test -p tolman --test cli -- --ignored evo"]
fn evo_finds_the_same_errors() {
    let folder = folder("evo");
    let run = |program: &str, arguments: &[&str]| {
        let mut command = std::process::Command::new(program);
        command
            .current_dir(&folder)
            .args(arguments)
            .output()
            .unwrap()
    };
    let python = folder.join("venv/bin/python");
    let python = python.to_str().unwrap();
    let is_there = run("python3", &["-m", "venv", "venv"]).status.success()
        && run(python, &["-m", "pip", "install", "-q", "evo"])
            .status
            .success();
    if !is_there {
        eprintln!("skipped: evo cannot be installed here");
        return;
    }
    let line = |index: u32, off: f64| {
        let time = f64::from(index);
        let [x, y, z] = [7.0 * (0.1 * time).sin(), 0.2 * time, (0.3 * time).cos()];
        let [a, b, c] = [
            off * (1.7 * time).sin(),
            off * (2.3 * time).cos(),
            off * (0.9 * time).sin(),
        ];
        let half = 0.05 * time + a;
        // Seen from elsewhere, and half as large.
        let (x, y, z) = (x + a, y + b, z + c);
        let seen = match off > 0.0 {
            true => format!("{} {} {}", 0.5 * y + 3.0, 0.5 * z - 1.0, 0.5 * x),
            false => format!("{x} {y} {z}"),
        };
        format!(
            "{} {seen} {} 0 {} {}\n",
            time + 0.1 * off * 0.01,
            0.1 * c,
            half.sin(),
            half.cos()
        )
    };
    let truth: String = (0..200).map(|index| line(index, 0.0)).collect();
    let found: String = (0..150)
        .filter(|index| index % 7 > 0)
        .map(|index| line(index, 0.3))
        .collect();
    fs::write(folder.join("truth.tum"), truth).unwrap();
    fs::write(folder.join("found.tum"), found).unwrap();
    for (align, step) in [
        ("space", "1"),
        ("scale", "1"),
        ("none", "5"),
        ("scale", "9"),
    ] {
        let evo = run(python, &["-c", EVO, align, step]);
        let told: serde_json::Value = serde_json::from_slice(&evo.stdout).unwrap();
        let score = [
            "score",
            "--trajectory",
            "found.tum",
            "--truth",
            "truth.tum",
            "--json",
        ];
        let more = ["--align", align, "--step", step];
        let ours = tolman_in(&folder, &[&score[..], &more].concat()).done();
        let ours: serde_json::Value = serde_json::from_str(&ours).unwrap();
        let pairs = [
            (&told["rmse"], &ours["absolute"]["rms_m"]),
            (&told["mean"], &ours["absolute"]["mean_m"]),
            (&told["median"], &ours["absolute"]["median_m"]),
            (&told["std"], &ours["absolute"]["sd_m"]),
            (&told["max"], &ours["absolute"]["largest_m"]),
            (&told["relative"], &ours["relative"]["rms_m"]),
            (&told["turn"], &ours["relative_turn_rms_rad"]),
        ];
        for (evo, ours) in pairs {
            let off = evo.as_f64().unwrap() - ours.as_f64().unwrap();
            assert!(off.abs() < 1e-6, "{align} {step}: {told} {ours}");
        }
    }
}

#[test]
fn what_is_no_log_is_refused_by_name() {
    let folder = folder("log-none");
    fs::write(folder.join("poem.txt"), "Roses are red\n").unwrap();
    let map = ["map", "--log", "poem.txt", "--out", "map"];
    tolman_in(&folder, &map).refused(2, &["poem.txt", "FLASER", "Roses: 1 × not used"]);
    let map = ["map", "--log", "nowhere", "--out", "map"];
    tolman_in(&folder, &map).refused(2, &["nowhere"]);
    assert!(!folder.join("map").exists());
    tolman_in(&folder, &["map", "--log", "poem.txt"]).refused(2, &["--out"]);
    let score = ["score", "--trajectory", "poem.txt", "--truth", "poem.txt"];
    tolman_in(&folder, &score).refused(2, &["poem.txt", "qx"]);
}
