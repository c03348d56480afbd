//! Diktiometries in files, whole and spoiled.

use serde_json::{Value, json};
use tolman_maps::diktiometry::{JournalLength, MapFile, MapFileError};

use super::walk::{ODOMETRY, Walk, open, painted};

/// Returns a walk among walls of random colours, so that views are indexed.
fn walked() -> Walk {
    let mut config = painted();
    config.journal = JournalLength::All;
    let world = open(4).painted(5, 1);
    let mut walk = Walk::new(world, ODOMETRY, config, 1);
    walk.wander(100);
    walk
}

#[test]
fn a_file_is_read_back_to_the_bit() {
    let walk = walked();
    let file = MapFile::of(&walk.observer).unwrap();
    let text = serde_json::to_string(&file).unwrap();
    let read: MapFile = serde_json::from_str(&text).unwrap();
    let again = read.observer().unwrap();
    assert_eq!(
        format!("{:?}", again.map()),
        format!("{:?}", walk.observer.map())
    );
    assert_eq!(again, walk.observer);
}

#[test]
fn spoiled_files_say_what_is_wrong() {
    let spoiled = |spoil: fn(&mut Value)| -> MapFileError {
        let mut value = serde_json::to_value(MapFile::of(&walked().observer).unwrap()).unwrap();
        spoil(&mut value);
        let file: MapFile = serde_json::from_value(value).unwrap();
        file.observer().unwrap_err()
    };
    let cut = spoiled(|file| {
        file["journal"]["moves"]
            .as_array_mut()
            .unwrap()
            .truncate(90);
    });
    assert_eq!(
        cut,
        MapFileError::Truncated {
            expected: 100,
            found: 90
        }
    );
    let action = spoiled(|file| file["journal"]["moves"][3]["action"] = json!(4));
    assert!(matches!(action, MapFileError::Replay(_)), "{action:?}");
}

#[test]
fn files_with_impossible_numbers_are_not_read() {
    let file = MapFile::of(&walked().observer).unwrap();
    let mut value = serde_json::to_value(&file).unwrap();
    value["journal"]["moves"][0]["odometry"]["position"]["x"] = json!([1.0, 0.0]);
    assert!(serde_json::from_value::<MapFile>(value).is_err());
}
