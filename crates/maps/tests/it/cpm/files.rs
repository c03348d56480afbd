//! Maps of CPM in files, whole and spoiled.

use serde_json::{Value, json};
use tolman_maps::cpm::{CpMapper, CpMapperConfig, Dictionary, MapFile, MapFileError, Sighting};

use super::learning::learned;
use super::world::World;

fn walked(seed: u64) -> (World, CpMapper) {
    let learned = learned(World::new(4, 0.5, seed), CpMapperConfig::robust(), 12, seed);
    (learned.world, learned.mapper)
}

#[test]
fn a_file_is_read_back_as_it_was() {
    for seed in 0..4 {
        let (mut world, mapper) = walked(seed);
        let map = mapper.map();
        let text = serde_json::to_string(&MapFile::of(map, &world.dictionary).unwrap()).unwrap();
        let read: MapFile = serde_json::from_str(&text).unwrap();
        assert_eq!(read.dictionary().unwrap(), world.dictionary);
        let again = read.map(&world.dictionary).unwrap();
        assert_eq!(&again, map);
        assert_eq!(again.version(), Some(world.dictionary.version()));
        assert!(
            again
                .junctions()
                .any(|(_, place)| place.bearings_from(0).is_some())
        );
        // What the robot learns later makes it no other dictionary.
        let before = world.dictionary.version();
        world
            .dictionary
            .learn(&[5.0, 5.0], &[5.0, 5.0], 0.1)
            .unwrap();
        let later = MapFile::of(map, &world.dictionary).unwrap();
        let again = later.map(&world.dictionary).unwrap();
        assert_eq!(&again, map);
        assert_eq!(again.version(), Some(before));
        assert_eq!(&read.map(&world.dictionary).unwrap(), map);
        assert!(read.map(&Dictionary::new(2)).is_err());
    }
}

#[test]
fn a_map_without_fragments_is_a_file_too() {
    let mapper = CpMapper::new(CpMapperConfig::robust(), Sighting::plain(3)).unwrap();
    let dictionary = Dictionary::new(1);
    let file = MapFile::of(mapper.map(), &dictionary).unwrap();
    assert_eq!(&file.map(&dictionary).unwrap(), mapper.map());
}

/// Returns why a saved map is refused after a change.
fn refused(change: impl FnOnce(&mut Value)) -> String {
    let (world, mapper) = walked(1);
    let mut value =
        serde_json::to_value(MapFile::of(mapper.map(), &world.dictionary).unwrap()).unwrap();
    change(&mut value);
    let file: MapFile = serde_json::from_value(value).unwrap();
    let found: Result<_, MapFileError> = file.map(&world.dictionary);
    found.unwrap_err().to_string()
}

/// Returns the number of the first junction that has bearings.
fn seen(file: &Value) -> usize {
    let junctions = file["map"]["junctions"].as_array().unwrap();
    let has_bearings = |junction: &Value| junction.get("bearings").is_some();
    junctions.iter().position(has_bearings).unwrap()
}

#[test]
fn spoiled_files_say_what_is_wrong() {
    for (kind, list) in [
        ("patterns", "dictionary"),
        ("fragments", "map"),
        ("junctions", "map"),
    ] {
        let why = refused(|file| {
            file[list][kind].as_array_mut().unwrap().pop();
        });
        assert!(why.contains("cut off") && why.contains(kind), "{why}");
    }
    let why = refused(|file| file["dictionary"]["fingerprint"] = json!("0123456789abcdef"));
    assert!(why.contains("not 0123456789abcdef"), "{why}");
    let why = refused(|file| file["map"]["patterns"] = json!(1000));
    assert!(why.contains("of 1000 patterns"), "{why}");
    let why = refused(|file| file["map"]["patterns"] = Value::Null);
    assert!(why.contains("not the number of patterns"), "{why}");
    for (what, next) in [("fragment", "next_fragment"), ("junction", "next_junction")] {
        let why = refused(|file| file["map"][next] = json!(u32::MAX));
        assert!(why.contains(what) && why.contains("twice"), "{why}");
        // The last of them was never given out, or one comes twice.
        let list = format!("{what}s");
        let why = refused(|file| {
            let last = file["map"][&list].as_array().unwrap().last().unwrap()["id"].clone();
            file["map"][next] = last;
        });
        assert!(why.contains(what) && why.contains("twice"), "{why}");
        let why = refused(|file| {
            let first = file["map"][&list][0]["id"].clone();
            file["map"][&list][1]["id"] = first;
        });
        assert!(why.contains(what) && why.contains("twice"), "{why}");
    }
}

#[test]
fn ports_and_fragments_that_do_not_fit_are_refused() {
    let why = refused(|file| {
        let at = seen(file);
        file["map"]["junctions"][at]["bearings"]
            .as_array_mut()
            .unwrap()
            .pop();
    });
    assert!(why.contains("bearings"), "{why}");
    let filled = |port: &Value| port.get("minus").is_some() || port.get("plus").is_some();
    let open = json!({"open": 0});
    // A port forgets its fragment, or takes one that is elsewhere.
    let why = refused(|file| {
        let ports = file["map"]["junctions"][0]["ports"].as_array_mut().unwrap();
        *ports.iter_mut().find(|port| filled(port)).unwrap() = open.clone();
    });
    assert!(why.contains("do not belong to each other"), "{why}");
    let why = refused(|file| {
        let id = file["map"]["fragments"][0]["id"].clone();
        let junctions = file["map"]["junctions"].as_array_mut().unwrap();
        let mut ports = junctions
            .iter_mut()
            .flat_map(|one| one["ports"].as_array_mut().unwrap());
        *ports.find(|port| !filled(port)).unwrap() = json!({"minus": id});
    });
    assert!(why.contains("do not belong to each other"), "{why}");
    let why = refused(|file| {
        let ports = file["map"]["junctions"][0]["ports"].as_array_mut().unwrap();
        ports.resize(2000, open.clone());
    });
    assert!(why.contains("2000 ports"), "{why}");
    // As many as are allowed are too many for the bearings only.
    let why = refused(|file| {
        let at = seen(file);
        let junction = &mut file["map"]["junctions"][at];
        junction["ports"].as_array_mut().unwrap().push(open.clone());
    });
    assert!(why.contains("bearings"), "{why}");
}
