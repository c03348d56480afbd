//! Other programs read the graphs: `cargo test -p tolman-formats --test it -- --ignored graph`
//! fetches networkx and evo from PyPI.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use tolman_formats::geom::{Heading, Point, Pose};
use tolman_formats::robot::{MapLink, MapPlace, MapView, TimedPose, Trajectory};
use tolman_formats::{dot, graphml, node_link_json, route_geojson, tum};

/// Returns a map of three places in a row, and one without a position.
fn map() -> MapView {
    let place = |id, position| MapPlace {
        id,
        position,
        landmark: None,
    };
    let at = |id: u32| Some(Point::new(f64::from(id), 0.5));
    let link = |from, to| MapLink { from, to };
    MapView {
        places: vec![
            place(0, at(0)),
            place(1, at(1)),
            place(4, at(4)),
            place(7, None),
        ],
        links: vec![link(0, 1), link(1, 0), link(1, 4), link(4, 7)],
        ..MapView::default()
    }
}

#[test]
fn graphs_hold_every_place_and_link() {
    let text = dot(&map());
    assert!(
        text.contains("  4 [pos=\"288.00,36.00!\"];\n") && text.contains("  7;\n"),
        "{text}"
    );
    assert!(text.contains("  4 -> 7;\n"));
    let text = graphml(&map());
    assert_eq!(text.matches("<node").count(), 4);
    assert_eq!(text.matches("<edge").count(), 4);
    assert_eq!(node_link_json(&map()).matches("\"source\"").count(), 4);
    let text = route_geojson(&map());
    // The place that lies nowhere is left out, and its link with it.
    assert_eq!(text.matches("\"Point\"").count(), 3);
    assert_eq!(text.matches("\"MultiLineString\"").count(), 3);
    assert!(text.contains("\"id\":5,\"startid\":0"), "{text}");
}

const CHECK: &str = "\
import json, networkx as nx
g = nx.read_graphml('map.graphml')
h = nx.node_link_graph(json.load(open('map.json')), edges='links')
assert sorted(map(int, g.nodes)) == sorted(h.nodes) == [0, 1, 4, 7], (g.nodes, h.nodes)
assert sorted((int(a), int(b)) for a, b in g.edges) == sorted(h.edges) == [(0, 1), (1, 0), (1, 4), (4, 7)]
assert g.nodes['4']['x'] == 4.0 and h.nodes[4]['y'] == 0.5
features = json.load(open('map.geojson'))['features']
assert len({f['properties']['id'] for f in features}) == 6
";

const CHECK_EVO: &str = "\
from evo.tools import file_interface
t = file_interface.read_tum_trajectory_file('way.tum')
assert t.num_poses == 3 and abs(t.path_length - 2.0) < 1e-6, t
";

fn python(folder: &Path, arguments: &[&str]) -> bool {
    let python = folder.join("venv/bin/python");
    let done = Command::new(python)
        .args(arguments)
        .current_dir(folder)
        .status();
    done.is_ok_and(|status| status.success())
}

#[test]
#[ignore = "fetches networkx and evo from PyPI"]
fn others_read_what_is_written() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("graph");
    fs::create_dir_all(&folder).unwrap();
    let venv = ["-m", "venv", "venv"];
    let made = Command::new("python3")
        .args(venv)
        .current_dir(&folder)
        .status();
    if !made.is_ok_and(|status| status.success()) {
        eprintln!("Skipped: there is no python3 with venv.");
        return;
    }
    for (name, text) in [
        ("map.graphml", graphml(&map())),
        ("map.json", node_link_json(&map())),
        ("map.geojson", route_geojson(&map())),
    ] {
        fs::write(folder.join(name), text).unwrap();
    }
    let timed = (0..3).map(|time| TimedPose {
        time: f64::from(time),
        pose: Pose::new(Point::new(f64::from(time), 0.0), Heading::EAST),
    });
    fs::write(folder.join("way.tum"), tum(&Trajectory::new(timed))).unwrap();
    for (package, check) in [("networkx>=3.4", CHECK), ("evo", CHECK_EVO)] {
        if python(&folder, &["-m", "pip", "install", "--quiet", package]) {
            assert!(
                python(&folder, &["-c", check]),
                "{package} reads something else"
            );
        } else {
            eprintln!("Skipped: {package} cannot be fetched from PyPI.");
        }
    }
}
