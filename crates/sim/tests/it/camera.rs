//! Tests the images of a column camera.

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{Robot, TurnTranslate};
use tolman_sim::noise::Fault;
use tolman_sim::robots::{
    CameraPioneer, CameraPioneerConfig, CameraPioneerError, LaserPioneerConfig,
};
use tolman_sim::{Material, Solo, WallSegment, World};

const RED: [u8; 3] = [255, 0, 0];
const BLUE: [u8; 3] = [0, 0, 255];

fn config() -> CameraPioneerConfig {
    CameraPioneerConfig::new(LaserPioneerConfig::noiseless(), 12, 10.0)
}

/// Returns a red wall in the east, a blue one in the north.
fn corner() -> World {
    let wall = |start: (f64, f64), end: (f64, f64), colour| WallSegment {
        start: Point::new(start.0, start.1),
        end: Point::new(end.0, end.1),
        material: Material {
            colour,
            ..Material::default()
        },
    };
    World::from_segments(vec![
        wall((2.0, -2.0), (2.0, 2.0), RED),
        wall((2.0, 2.0), (-2.0, 2.0), BLUE),
    ])
    .unwrap()
}

fn robot(config: CameraPioneerConfig, heading: Heading) -> Solo<CameraPioneer> {
    let robot = CameraPioneer::new(config).unwrap();
    Solo::new(corner(), robot, Pose::new(Point::origin(), heading), 1).unwrap()
}

/// Returns the columns in hundredths of full light.
fn percent(solo: &Solo<CameraPioneer>) -> Vec<[u8; 3]> {
    let columns = &solo.sensing().image.as_ref().unwrap().columns;
    columns
        .iter()
        .map(|column| column.map(|value| (100.0 * value).round() as u8))
        .collect()
}

#[test]
fn columns_show_the_colours_of_walls_counter_clockwise_from_ahead() {
    let solo = robot(config(), Heading::EAST);
    let columns = percent(&solo);
    assert_eq!(columns[0], [100, 0, 0], "ahead is east");
    assert_eq!(columns[3], [0, 0, 100], "to the left is north");
    assert_eq!(columns[6], [0; 3], "behind is nothing");
}

#[test]
fn a_turn_moves_the_columns_round() {
    let (east, north) = (
        robot(config(), Heading::EAST),
        robot(config(), Heading::NORTH),
    );
    let mut turned = percent(&east);
    turned.rotate_left(3);
    assert_eq!(percent(&north), turned);
}

#[test]
fn pictures_are_taken_standing_still() {
    let mut solo = robot(config(), Heading::EAST);
    solo.step(&TurnTranslate {
        turn: 0.0,
        translate: 0.1,
    })
    .unwrap();
    assert!(solo.sensing().image.is_none());
    solo.step(&TurnTranslate::STOP).unwrap();
    assert!(solo.sensing().image.is_some());
}

#[test]
fn measurements_are_disturbed_and_stay_between_dark_and_light() {
    let mut config = config();
    config.image.push(Fault::Bounded {
        share: 0.0,
        offset: 0.2,
        steps: 1,
    });
    let mut solo = robot(config, Heading::EAST);
    let mut seen = Vec::new();
    for _ in 0..200 {
        solo.step(&TurnTranslate::STOP).unwrap();
        seen.push(solo.sensing().image.as_ref().unwrap().columns[0][1]);
    }
    assert!(seen.iter().all(|value| (0.0..=0.2).contains(value)));
    assert!(seen.iter().any(|value| *value > 0.1));
}

#[test]
fn a_camera_without_columns_or_reach_is_refused() {
    let refuse = |change: fn(&mut CameraPioneerConfig)| {
        let mut config = config();
        change(&mut config);
        CameraPioneer::new(config).unwrap_err()
    };
    assert!(matches!(
        refuse(|config| config.columns = 0),
        CameraPioneerError::Camera(_)
    ));
    assert!(matches!(
        refuse(|config| config.reach = f64::NAN),
        CameraPioneerError::Camera(_)
    ));
    let fault = Fault::Bounded {
        share: 0.0,
        offset: 0.1,
        steps: 0,
    };
    let mut noisy = config();
    noisy.image.push(fault);
    assert!(matches!(
        CameraPioneer::new(noisy),
        Err(CameraPioneerError::Fault(error)) if error.index == 0
    ));
}
