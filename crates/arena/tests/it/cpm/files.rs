//! Maps in files, whole and spoiled.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use tolman_maps::cpm::{CpMap, Dictionary, MapFile, MapFileError};
use tolman_systems::cpm::{Aim, CpmConfig, Explorer};

use super::explorations::pursue;
use super::world::{MazeConfig, PlaneMaze, PlaneWalker, Reckoning, WalkerNoise};

/// Returns the map of an explored world, with dead reckoning.
fn explored() -> (CpMap, Dictionary) {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let world = PlaneMaze::random(&MazeConfig::small(), &mut rng).unwrap();
    let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::Bounded);
    let mut explorer = Explorer::new(CpmConfig::robust(), rover.sighting()).unwrap();
    pursue(&mut explorer, &mut rover, Aim::Explore, &mut rng);
    (explorer.mapper.map().clone(), world.dictionary().clone())
}

#[test]
fn a_file_is_read_back_to_the_bit() {
    let (map, dictionary) = explored();
    assert!(map.fragments().len() > 3);
    let text = serde_json::to_string(&MapFile::of(&map, &dictionary).unwrap()).unwrap();
    let read: MapFile = serde_json::from_str(&text).unwrap();
    let again = read.dictionary().unwrap();
    assert_eq!(again, dictionary);
    assert_eq!(read.map(&again).unwrap(), map);
}

#[test]
fn a_dictionary_that_has_grown_reads_its_earlier_maps() {
    let (map, mut dictionary) = explored();
    let file = MapFile::of(&map, &dictionary).unwrap();
    let far = vec![1e6; dictionary.dimension()];
    dictionary.learn(&far, &far, 0.0).unwrap();
    assert_eq!(file.map(&dictionary).unwrap(), map);
    assert_ne!(MapFile::of(&map, &dictionary).unwrap(), file);
}

#[test]
fn the_dictionary_of_another_robot_is_refused() {
    let (map, dictionary) = explored();
    let file = MapFile::of(&map, &dictionary).unwrap();
    let other = Dictionary::new(dictionary.dimension());
    assert!(matches!(file.map(&other), Err(MapFileError::Dictionary(_))));
    assert!(matches!(
        MapFile::of(&map, &other),
        Err(MapFileError::Dictionary(_))
    ));
}

/// Damage that is done to a sound file.
type Spoil = fn(&mut Value);

fn cut(file: &mut Value, list: &str) {
    file["map"][list].as_array_mut().unwrap().pop();
}

/// Returns those of a junction with several ways.
fn bearings(file: &mut Value) -> &mut Vec<Value> {
    let junctions = file["map"]["junctions"].as_array_mut().unwrap();
    let mut lists = junctions
        .iter_mut()
        .filter_map(|junction| junction["bearings"].as_array_mut());
    lists.find(|bearings| bearings.len() > 2).unwrap()
}

#[test]
fn spoiled_files_say_what_is_wrong() {
    let (map, dictionary) = explored();
    let file = serde_json::to_value(MapFile::of(&map, &dictionary).unwrap()).unwrap();
    let spoiled = |spoil: Spoil| -> String {
        let mut value = file.clone();
        spoil(&mut value);
        let read: MapFile = serde_json::from_value(value).unwrap();
        read.map(&dictionary).unwrap_err().to_string()
    };
    let cases: [(Spoil, &str); 13] = [
        (|file| cut(file, "fragments"), "fragments; copy it again"),
        (|file| cut(file, "junctions"), "junctions; copy it again"),
        (
            |file| file["dictionary"]["patterns"][0]["prototype"][0] = json!(0.125),
            "they were changed",
        ),
        (
            |file| file["dictionary"]["patterns"][0]["half_turned"] = json!(77),
            "half turn of pattern 0",
        ),
        (
            |file| file["map"]["fragments"][0]["minus"][1] = json!(9),
            "do not belong to each other",
        ),
        (
            |file| file["map"]["fragments"][1]["id"] = file["map"]["fragments"][0]["id"].clone(),
            "appears twice",
        ),
        (
            |file| file["map"]["next_fragment"] = json!(0),
            "never assigned",
        ),
        (
            |file| file["map"]["next_junction"] = json!(u32::MAX),
            "never assigned",
        ),
        (
            |file| file["map"]["patterns"] = json!(1_000_000),
            "patterns; copy it again",
        ),
        (
            |file| file["map"]["patterns"] = json!(null),
            "not the number of patterns",
        ),
        (
            |file| {
                let open = vec![json!({ "open": 0 }); 1001];
                file["map"]["junctions"][0]["ports"] = json!(open);
            },
            "1001 ports",
        ),
        (|file| bearings(file)[0] = json!(2.0), "counter-clockwise"),
        (|file| bearings(file).push(json!(6.2)), "bearings for"),
    ];
    for (spoil, why) in cases {
        let found = spoiled(spoil);
        assert!(found.contains(why), "{found}");
    }
}
