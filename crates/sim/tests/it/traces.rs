//! Traces: replayed to the bit, and refused where they are broken.

use proptest::prelude::*;
use tolman_geom::{Heading, Pose};
use tolman_maze::{Cell, Grid, Maze};
use tolman_robot::TurnTranslate;
use tolman_sim::noise::{Fault, Gaussian};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::trace::{Detail, Recording, ReplayError, replay};
use tolman_sim::{CorridorSize, Door, DoorState, Material, RobotId, World};

use crate::worlds;

fn robot() -> LaserPioneer {
    let noise = Gaussian {
        relative_sd: 0.1,
        absolute_sd: 0.02,
    };
    let mut config = LaserPioneerConfig::noiseless();
    config.motor_noise.turn = noise;
    config.motor_noise.translate = noise;
    config.motor_noise.drift_sd = 0.2;
    config.scan_noise = noise;
    config.compass_noise = noise;
    config.faults.compass = vec![Fault::Delay { steps: 2 }];
    config.faults.scan = vec![Fault::Stuck {
        probability: 0.1,
        steps: 3,
    }];
    LaserPioneer::new(config).unwrap()
}

/// Returns two robots that drive about a room with a door, one of which is lifted.
fn record(detail: Detail) -> String {
    let maze = Maze::open(Grid::new(4, 3));
    let world = World::from_maze(&maze, &CorridorSize::thin(0.95)).unwrap();
    let (north, south) = (
        world.cell_centre(Cell::new(2, 2)),
        world.cell_centre(Cell::new(2, 0)),
    );
    let door = Door {
        name: "middle".to_owned(),
        start: north,
        end: south,
        material: Material::default(),
        state: DoorState::Shut,
        schedule: Vec::new(),
    };
    let world = world.with_door(door).unwrap();
    let at = |x, y| Pose::new(world.cell_centre(Cell::new(x, y)), Heading::EAST);
    let (first, second, kidnapped) = (at(0, 0), at(1, 1), at(3, 2));
    let mut file = Vec::new();
    let robots = vec![(robot(), first), (robot(), second)];
    let mut recording = Recording::start(world, 11, robots, &mut file, detail).unwrap();
    for step in 0..40 {
        let translate = 0.1 * f64::from(step % 5);
        let commands = [0.3, -0.2].map(|turn| TurnTranslate { turn, translate });
        recording.step(&commands).unwrap();
        match step {
            10 => recording.place(RobotId(0), kidnapped).unwrap(),
            20 => recording.set_door("middle", DoorState::Open).unwrap(),
            _ => {}
        }
    }
    recording.finish().unwrap();
    String::from_utf8(file).unwrap()
}

fn error(trace: &str) -> ReplayError {
    replay::<LaserPioneer>(trace.as_bytes()).unwrap_err()
}

#[test]
fn a_trace_replays_to_the_bit() {
    for detail in [Detail::Poses, Detail::Sensing] {
        let trace = record(detail);
        assert_eq!(trace, record(detail), "the same run writes the same trace");
        assert_eq!(trace.contains("sensing"), detail == Detail::Sensing);
        let end = replay::<LaserPioneer>(trace.as_bytes()).unwrap();
        assert_eq!((end.tick(), end.robots().len()), (40, 2));
    }
}

#[test]
fn the_first_tick_that_differs_is_named() {
    let trace = record(Detail::Poses);
    let (number, line) = trace
        .lines()
        .enumerate()
        .find(|(_, line)| line.contains("\"tick\":7,") && line.contains("\"robot\":1"))
        .unwrap();
    // The last bit of one coordinate.
    let step: serde_json::Value = serde_json::from_str(line).unwrap();
    let x = step["step"]["pose"]["position"][0].as_f64().unwrap();
    let changed = line.replace(&x.to_string(), &x.next_up().to_string());
    assert_ne!(changed, line);
    match error(&trace.replace(line, &changed)) {
        ReplayError::Differs {
            line, tick, robot, ..
        } => {
            assert_eq!((line, tick, robot), (number + 1, 7, 1));
        }
        other => panic!("{other}"),
    }
}

#[test]
fn broken_traces_are_refused_with_their_place() {
    let trace = record(Detail::Poses);
    assert!(matches!(error(""), ReplayError::Empty));
    let other = trace.replacen("tolman-trace", "tolman-map", 1);
    assert!(matches!(error(&other), ReplayError::Format { found } if found == "tolman-map"));
    let newer = trace.replacen("\"version\":1", "\"version\":9", 1);
    assert!(matches!(error(&newer), ReplayError::Version { found: 9 }));
    // Cut short in the middle of the last line.
    let cut = &trace[..trace.len() - 10];
    let lines = trace.lines().count();
    assert!(
        matches!(error(cut), ReplayError::Line { line, column, .. } if line == lines && column > 1)
    );
    // A whole line is missing.
    let missing: Vec<&str> = trace.lines().take(lines - 1).collect();
    assert!(matches!(
        error(&missing.join("\n")),
        ReplayError::Order {
            robot: 1,
            tick: 40,
            ..
        }
    ));
    let nowhere = trace.replacen("\"seed\":11", "\"seed\":-1", 1);
    assert!(matches!(error(&nowhere), ReplayError::Line { line: 1, .. }));
    let radius = trace.replacen("\"radius\":0.25", "\"radius\":-0.25", 1);
    assert!(matches!(
        error(&radius),
        ReplayError::Refused { line: 1, .. }
    ));
}

proptest! {
    #[test]
    fn a_world_reads_back_as_it_was((world, point) in worlds::world_and_point(), ) {
        let text = world.to_json().unwrap();
        let again = World::from_json(&text).unwrap();
        prop_assert_eq!(again.walls(), world.walls());
        prop_assert_eq!(again.zones(), world.zones());
        prop_assert_eq!(again.cell_at(point), world.cell_at(point));
        for degrees in 0..36 {
            let direction = Heading::from_degrees(10.0 * f64::from(degrees)).unit();
            let cast = |world: &World| world.caster().cast(point, direction, 9.0).to_bits();
            prop_assert_eq!(cast(&again), cast(&world));
        }
        prop_assert_eq!(again.to_json().unwrap(), text);
    }

    /// Reading never panics, whatever is done to the text.
    #[test]
    fn a_garbled_world_is_refused(
        world in worlds::world(),
        at in 0_usize..100_000,
        with in "[0-9.,\\]}\"-]{0,3}",
    ) {
        let mut text = world.to_json().unwrap();
        let at = at % text.len();
        text.replace_range(at..=at, &with);
        if let Ok(world) = World::from_json(&text) {
            prop_assert!(!world.walls().is_empty());
        }
    }
}
