//! MSLST from its first scan to the destination.

use alloc::sync::Arc;

use tolman_arena::Mind;
use tolman_arena::episode::{self, Episode};
use tolman_arena::mslst::learn;
use tolman_arena::pioneer::calibrated;
use tolman_film::Recorder;
use tolman_replay::Shape;
use tolman_robot::{Guess, Position};
use tolman_systems::Origin;
use tolman_systems::mslst::{Learned, MapFile, MslstConfig, Navigator};

use crate::support::{own_course, trial};

/// A short apprenticeship, so that the tests are quick.
fn config() -> MslstConfig {
    let mut config = MslstConfig::j();
    config.scan_steps = 2000;
    config.graph_actions = 600;
    config
}

fn learned() -> Learned {
    learn(&own_course("j.maze"), &calibrated(), &config(), 5).unwrap()
}

fn solve(learned: Learned, seed: u64) -> Episode {
    let course = own_course("j.maze");
    let mind = Navigator::new(Arc::new(learned.map), &config());
    let mut mind = Mind::Brain(Box::new(mind));
    episode::run(&trial(&course, seed), &mut mind, |_| {}).unwrap()
}

fn map_file() -> MapFile {
    MapFile {
        origin: Origin {
            world: "J".to_owned(),
            drawing: None,
            robot: "laser Pioneer".to_owned(),
            seed: 5,
        },
        config: config(),
        learned: learned(),
    }
}

#[test]
fn a_saved_map_is_the_same_map_and_makes_the_same_run() {
    let file = map_file();
    let text = file.to_json().unwrap();
    let read = MapFile::from_json(&text).unwrap();
    assert_eq!(read.to_json().unwrap(), text);
    assert_eq!(read.learned.map.graph, file.learned.map.graph);
    assert_eq!(read.learned.survey, file.learned.survey);
    // The very bits, which equal texts of rounded numbers would not prove.
    let bits = |learned: &Learned| -> Vec<u64> {
        let models = learned.map.states.models().iter().flatten();
        models.map(|range| range.to_bits()).collect()
    };
    assert_eq!(bits(&read.learned), bits(&file.learned));
    assert_eq!(solve(read.learned, 3), solve(file.learned, 3));
}

#[test]
fn the_same_seed_learns_the_same_and_another_one_does_not() {
    let (once, again) = (learned(), learned());
    assert_eq!(once.map.graph, again.map.graph);
    assert_eq!(once.map.states.models(), again.map.states.models());
    let other = learn(&own_course("j.maze"), &calibrated(), &config(), 6).unwrap();
    assert_ne!(once.map.graph, other.map.graph);
}

#[test]
fn the_survey_says_where_each_node_was_made() {
    let course = own_course("j.maze");
    let Learned { map, survey } = learned();
    assert_eq!(survey.positions.len(), map.graph.len());
    assert!(survey.made_by.is_sorted());
    let mut destinations = 0;
    for (id, node) in map.graph.ids().zip(map.graph.nodes()) {
        let here = survey.positions[id as usize];
        let inside = course.is_destination(here);
        assert_eq!(map.graph.is_destination(id), inside, "node {id}");
        destinations += u32::from(inside);
        for edge in &node.edges {
            let Some(head) = edge.head else { continue };
            // An action is two translations of half a unit on average, with 25 % of noise.
            let way = (survey.positions[head as usize] - here).norm();
            assert!(way < 3.0, "node {id}, {}: {way} m", edge.action);
        }
    }
    assert!(destinations > 0, "the wanderer has come to the destination");
}

#[test]
fn it_finds_out_of_the_j_maze() {
    let reached = (0..10)
        .filter(|seed| solve(learned(), *seed).reached)
        .count();
    assert!(reached >= 9, "{reached} of 10");
}

#[test]
fn files_that_hold_no_map_say_why() {
    let good = map_file().to_json().unwrap();
    let damaged = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        let error = MapFile::from_json(&good.replacen(from, to, 1)).unwrap_err();
        let mut told = error.to_string();
        let mut cause: Option<&dyn core::error::Error> = core::error::Error::source(&error);
        while let Some(error) = cause {
            told = format!("{told}: {error}");
            cause = error.source();
        }
        told
    };
    for (from, to, expected) in [
        ("{", "", "line 1 column"),
        ("tolman-map", "soup", "\"soup\""),
        ("\"version\":3", "\"version\":9", "version is 9"),
        (
            "\"nodes\":[{\"state\":",
            "\"nodes\":[{\"state\":99",
            "has state 99",
        ),
        ("\"states\":[[", "\"states\":[[1.0,", "unit 1"),
        ("[\"north\",", "[\"up\",", "unknown variant `up`"),
    ] {
        let told = damaged(from, to);
        assert!(told.contains(expected), "{from} → {to}: {told}");
    }
}

#[test]
fn a_replay_shows_where_the_robot_believed_to_be() {
    let course = own_course("j.maze");
    let learned = learned();
    let trial = trial(&course, 3);
    let mut recorder = Recorder::new(&trial).knowing(&learned.survey.positions);
    let mslst = Navigator::new(Arc::new(learned.map.clone()), &config());
    let mut mind = Mind::Brain(Box::new(mslst));
    let mut guessed = Vec::new();
    let episode = episode::run(&trial, &mut mind, |step| {
        recorder.see(step);
        if let Some(Guess {
            at: Position::Place(node),
            ..
        }) = step.belief().first()
        {
            guessed.push(*node);
        }
    })
    .unwrap();
    let replay = recorder.finish("MSLST", &episode);
    let [belief] = &replay.tracks[0].beliefs[..] else {
        panic!("{} beliefs", replay.tracks[0].beliefs.len());
    };
    // Every first shape is the node it guessed then, where that node truly lies.
    let mut shown = belief
        .entries
        .iter()
        .filter_map(|entry| entry.shapes.first());
    assert!(belief.entries.len() > 3);
    assert!(shown.all(|shape| {
        guessed.iter().any(|node| {
            let position = learned.survey.positions[*node as usize];
            *shape
                == Shape::Point {
                    position,
                    weight: 1.0,
                }
        })
    }));
    let notes = &replay.tracks[0].notes;
    assert!(notes.iter().any(|notes| notes.name == "thinks"));
}
