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
