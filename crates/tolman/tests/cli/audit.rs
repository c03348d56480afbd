use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{folder, tolman_in};

fn rooms() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../mazes/graphs/rooms.g2o")
}

/// Returns a folder with the project's own graph, audited.
fn audited(name: &str) -> PathBuf {
    let folder = folder(name);
    fs::copy(rooms(), folder.join("rooms.g2o")).unwrap();
    let out = tolman_in(&folder, &["audit", "rooms.g2o", "--out", "found"]).failed(
        1,
        &["closures are refuted", "found/cleaned.g2o is without them"],
    );
    assert!(out.contains("supported; 10 refuted"), "{out}");
    folder
}

#[test]
fn the_false_closures_of_a_graph_are_refuted_and_the_rest_is_kept() {
    let folder = audited("audit");
    let found = folder.join("found");
    let page = fs::read_to_string(found.join("audit.html")).unwrap();
    for part in ["<svg", "refuted by", "Undecided", "supported by"] {
        assert!(page.contains(part), "no {part}");
    }
    let verdicts = fs::read_to_string(found.join("verdicts.csv")).unwrap();
    let count = |word: &str| {
        verdicts
            .lines()
            .filter(|line| line.split(',').nth(4) == Some(word))
            .count()
    };
    assert_eq!(count("refuted"), 10, "{verdicts}");
    let edges = |path: &Path| {
        fs::read_to_string(path)
            .unwrap()
            .matches("EDGE_SE2")
            .count()
    };
    let cleaned = found.join("cleaned.g2o");
    assert_eq!(edges(&cleaned) + 10, edges(&rooms()));
    assert!(fs::read_to_string(&cleaned).unwrap().ends_with("FIX 0\n"));
    // What is left has nothing to be refuted.
    let again = tolman_in(&folder, &["audit", "found/cleaned.g2o", "--out", "again"]).done();
    assert!(again.contains("; 0 refuted"), "{again}");
    tolman_in(
        &folder,
        &["audit", "rooms.g2o", "--out", "strict", "--strict"],
    )
    .failed(1, &["refuted"]);
    assert!(edges(&folder.join("strict/cleaned.g2o")) <= edges(&cleaned));
}

/// Collects the path of every number or word in a JSON value.
fn leaves(value: &serde_json::Value, at: &str, found: &mut Vec<String>) {
    match value {
        serde_json::Value::Object(fields) => {
            for (name, field) in fields {
                leaves(field, &format!("{at}/{name}"), found);
            }
        }
        serde_json::Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                leaves(item, &format!("{at}/{index}"), found);
            }
        }
        _ => found.push(at.to_owned()),
    }
}

#[test]
fn certificates_hold_until_a_field_is_changed() {
    let folder = audited("audit-verify");
    let verify = ["audit", "rooms.g2o", "--out", "found", "--verify"];
    let told = tolman_in(&folder, &verify).done();
    assert!(told.contains("all certificates hold: 10 refuted"), "{told}");
    let path = folder.join("found/certificates.json");
    let text = fs::read_to_string(&path).unwrap();
    let whole: serde_json::Value = serde_json::from_str(&text).unwrap();
    let mut places = Vec::new();
    for part in ["/refuted/0", "/supported/3"] {
        leaves(whole.pointer(part).unwrap(), part, &mut places);
    }
    places.extend(
        [
            "sigma_scale",
            "k",
            "poses",
            "closures",
            "runs",
            "format",
            "version",
        ]
        .map(|name| format!("/{name}")),
    );
    assert!(places.len() > 40, "{places:?}");
    for place in places {
        let mut forged = whole.clone();
        let field = forged.pointer_mut(&place).unwrap();
        *field = match (&*field, field.as_u64(), field.as_f64()) {
            (_, Some(count), _) => (count + 1).into(),
            (_, _, Some(number)) => (number * 1.001 + 1e-3).into(),
            (serde_json::Value::String(word), ..) if word == "odometry" => {
                "supported-closures".into()
            }
            (serde_json::Value::String(word), ..) if word == "supported-closures" => {
                "odometry".into()
            }
            _ => "another".into(),
        };
        fs::write(&path, forged.to_string()).unwrap();
        let ended = tolman_in(&folder, &verify);
        assert!(
            [Some(1), Some(2)].contains(&ended.code),
            "{place}: {}",
            ended.out
        );
        assert!(
            ended.err.contains("certificates.json"),
            "{place}: {}",
            ended.err
        );
    }
}

#[test]
fn another_program_checks_the_certificates() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/check_certificates.py");
    let folder = audited("audit-python");
    let check = || {
        let mut command = Command::new("python3");
        command
            .arg(&script)
            .args(["rooms.g2o", "found/certificates.json"]);
        command.current_dir(&folder).output()
    };
    let Ok(output) = check() else {
        // Past the test harness, which would keep it to itself.
        let _ =
            std::io::Write::write_all(&mut std::io::stderr(), b"SKIPPED: python3 is not there\n");
        return;
    };
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(
        told,
        "10 refutations hold\n",
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let path = folder.join("found/certificates.json");
    let text = fs::read_to_string(&path).unwrap();
    let mut forged: serde_json::Value = serde_json::from_str(&text).unwrap();
    forged["refuted"][2]["cycle"]["chi2"] = 26.0.into();
    fs::write(&path, forged.to_string()).unwrap();
    assert!(!check().unwrap().status.success());
}

#[test]
fn what_of_a_file_is_of_no_use_is_told_and_the_rest_is_used() {
    let folder = folder("audit-hostile");
    let text = fs::read_to_string(rooms()).unwrap();
    let lines = text.lines().count();
    let bad = "EDGE_SE2 0 9999 0 0 0 1 0 0 1 0 1\nEDGE_SE2 0 9 NaN 0 0 1 0 0 1 0 1\nEDGE_SE2 0 9 0 0 0 -1 0 0 1 0 1\nEDGE_SE2 0 9 0 0";
    fs::write(folder.join("bad.g2o"), format!("{text}{bad}")).unwrap();
    let ended = tolman_in(&folder, &["audit", "bad.g2o", "--out", "found"]);
    for (after, why) in [
        (1, "needs pose 9999"),
        (2, "`NaN`"),
        (3, "not positive definite"),
        (4, "has 4 numbers"),
    ] {
        let told = format!("bad.g2o: line {}: ", lines + after);
        assert!(
            ended.err.contains(&told) && ended.err.contains(why),
            "{}",
            ended.err
        );
    }
    let out = ended.failed(1, &["4 lines are left out, the rest is used"]);
    assert!(out.contains("10 refuted"), "{out}");
}

#[test]
fn what_is_no_graph_is_refused() {
    let folder = folder("audit-refused");
    fs::write(folder.join("empty.g2o"), "").unwrap();
    let audit = |arguments: &[&str]| tolman_in(&folder, &[&["audit"], arguments].concat());
    audit(&["empty.g2o"]).refused(2, &["empty.g2o", "no EDGE_SE2"]);
    audit(&["nowhere.g2o"]).refused(2, &["cannot read nowhere.g2o", "give a pose graph"]);
    audit(&["empty.g2o", "--sigma-scale=-1"]).refused(2, &["positive number, or auto"]);
    fs::copy(rooms(), folder.join("rooms.g2o")).unwrap();
    audit(&["rooms.g2o", "--verify"]).refused(2, &["certificates.json", "without --verify first"]);
    let auto = audit(&["rooms.g2o", "--sigma-scale", "auto"]);
    let out = auto.failed(1, &["are refuted"]);
    assert!(
        out.contains("standard deviations ×") && out.contains("results/audit/rooms"),
        "{out}"
    );
}

#[test]
fn gtsam_reads_the_cleaned_graph() {
    let python = std::env::var("TOLMAN_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let has = Command::new(&python).args(["-c", "import gtsam"]).output();
    if !has.is_ok_and(|output| output.status.success()) {
        // Past the test harness, which would keep it to itself.
        let told = b"SKIPPED: gtsam is not there; pip install gtsam, or name a Python that has it in TOLMAN_PYTHON\n";
        let _ = std::io::Write::write_all(&mut std::io::stderr(), told);
        return;
    }
    let folder = audited("audit-gtsam");
    let count =
        "import gtsam; g, v = gtsam.readG2o('found/cleaned.g2o', False); print(g.size(), v.size())";
    let output = Command::new(&python)
        .args(["-c", count])
        .current_dir(&folder)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    let text = fs::read_to_string(folder.join("found/cleaned.g2o")).unwrap();
    let expected = format!(
        "{} {}\n",
        text.matches("EDGE_SE2").count(),
        text.matches("VERTEX_SE2").count()
    );
    assert_eq!(
        told,
        expected,
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
