//! An observer as a mapper of any kind: its map, its belief and its certainty.

use tolman_geom::Interval;
use tolman_maps::diktiometry::{Identity, Observer, PlaceId};
use tolman_robot::{Mapper, Position};

use super::walk::{ODOMETRY, Walk, alike, open};

fn walked(identity: Identity) -> Walk {
    let mut config = alike();
    config.matching.identity = identity;
    let mut walk = Walk::new(open(5), ODOMETRY, config, 4);
    walk.wander(80);
    walk
}

#[test]
fn the_view_of_a_map_has_its_places_and_links() {
    let walk = walked(Identity::Certain);
    let map = walk.observer.map();
    let view = Mapper::map(&walk.observer);
    let ids: Vec<u32> = map.paths.places().map(|(id, _)| id.0).collect();
    assert_eq!(
        view.places.iter().map(|place| place.id).collect::<Vec<_>>(),
        ids
    );
    assert!(view.places.iter().all(|place| place.landmark.is_none()));
    let mut ways: Vec<(u32, u32)> = map
        .paths
        .links()
        .map(|(_, link)| (link.from.0, link.to.0))
        .collect();
    ways.sort_unstable();
    ways.dedup();
    assert_eq!(
        view.links
            .iter()
            .map(|link| (link.from, link.to))
            .collect::<Vec<_>>(),
        ways
    );
    // The places lie where they are, seen from the oldest.
    let truths = walk.truths();
    let side = |place: u32| (f64::from(place % 5), f64::from(place / 5));
    let (x, y) = side(truths[&PlaceId(ids[0])]);
    for place in &view.places {
        let at = place.position.unwrap();
        let (east, north) = side(truths[&PlaceId(place.id)]);
        let off = (at.x - (east - x)).hypot(at.y - (north - y));
        assert!(off < 0.6, "{place:?} is at ({east}, {north})");
    }
}

#[test]
fn a_mapper_believes_what_its_tracks_say() {
    let walk = walked(Identity::Certain);
    let believed = Mapper::belief(&walk.observer);
    let tracks = walk.observer.tracks();
    assert_eq!(believed.len(), tracks.len());
    for (guess, track) in believed.iter().zip(tracks) {
        assert_eq!(guess.at, Position::Place(track.place.0));
        assert_eq!(guess.weight.to_bits(), track.confidence.to_bits());
    }
    assert_eq!(walk.observer.map_bytes(), Some(walk.observer.map().bytes()));
}

#[test]
fn only_the_rule_that_estimates_certainty_is_certain() {
    let certain = |walk: &Walk| Mapper::certainty(&walk.observer);
    let walk = walked(Identity::Certain);
    let expected = walk.observer.self_check().certainty();
    assert_eq!(certain(&walk), Some(expected));
    assert!(0.0 < expected && expected <= 1.0);
    assert_eq!(certain(&walked(Identity::Meets)), None);
}

#[test]
fn a_mapper_refuses_what_an_observer_refuses() {
    let mut walk = walked(Identity::Certain);
    let direction = walk.robot.wander().unwrap();
    let moved = walk.robot.go(direction).unwrap();
    let step = walk.told(&moved);
    let mut wrong = step.clone();
    wrong.odometry.position.x = Interval::UNBOUNDED;
    let before: Observer = walk.observer.clone();
    assert!(walk.observer.observe(&wrong).is_err());
    assert_eq!(walk.observer, before);
    assert_eq!(walk.observer.observe(&step), Ok(()));
    assert_ne!(walk.observer, before);
}
