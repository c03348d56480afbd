//! Walks of which every figure is pinned.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::PointBox;
use tolman_maps::diktiometry::{
    Config, FirstPlace, GeometricMerge, Identity, PlaceBelief, PlaceId, Use,
};
use tolman_sim::abstract_world::{AbstractWorld, MoveNoise};

use super::walk::{ROUGH, Scripted, Walk, alike, blocks, exits, open, painted, percept};
use crate::pinned::pinned;

fn bounds(bounds: PointBox) -> String {
    let sides = [
        bounds.x.low(),
        bounds.x.high(),
        bounds.y.low(),
        bounds.y.high(),
    ];
    format!("{sides:?}")
}

/// Returns a walk's map in text: all places, links, frames and looks, and the advice that follows.
fn learned(walk: &Walk) -> Vec<String> {
    let map = walk.observer.map();
    let mut figures = Vec::new();
    for (id, place) in map.paths.places().step_by(3) {
        let estims = place
            .estims
            .iter()
            .map(|estim| (estim.position.x, estim.weight));
        let estims: Vec<(f64, f64)> = estims.take(3).collect();
        let counts = (place.visits, place.counts, place.constancy);
        figures.push(format!(
            "{id:?} {:?} {}",
            place.frame,
            bounds(place.position)
        ));
        figures.push(format!("{} {estims:?} {counts:?}", bounds(place.envelope)));
        let histories: usize = place.histories.iter().map(Vec::len).sum();
        let sizes = (
            place.views.len(),
            &place.blocked,
            histories,
            place.notes.len(),
        );
        figures.push(format!(
            "{sizes:?} {:?} {:?}",
            place.outgoing, place.incoming
        ));
    }
    for (id, link) in map.paths.links().step_by(7) {
        figures.push(format!("{id:?} {} {link:?}", map.paths.chance(id)));
    }
    for (number, frame) in map.reference.frames().iter().enumerate().step_by(4) {
        figures.push(format!(
            "{number} {} {:?}",
            frame.relations.len(),
            frame.places
        ));
        let relations = frame.relations.iter().step_by(3).take(4);
        figures.extend(relations.map(|one| format!("{:?} {}", one.to, bounds(one.position))));
    }
    figures.push(format!("{:?}", map.looks));
    let drawn = map.layout(walk.observer.place());
    let drawn = drawn.iter().step_by(5);
    figures.extend(drawn.map(|drawn| format!("{:?} {}", drawn.place, bounds(drawn.bounds))));
    let check = walk.observer.self_check();
    figures.push(format!(
        "{check:?} {} {:?}",
        check.certainty(),
        check.complaint()
    ));
    for advice in walk.observer.opportunities().into_iter().take(5) {
        figures.push(format!("{} {advice:?}", advice.worth()));
    }
    let here = walk.observer.place();
    for (id, _) in map.paths.places().step_by(6) {
        let plan = walk.observer.plan(here, id);
        figures.push(format!("{id:?} {:?}", plan.map(|plan| plan.len())));
    }
    figures
}

fn walked(
    world: AbstractWorld,
    errors: MoveNoise,
    config: Config,
    seed: u64,
) -> (Walk, Vec<String>) {
    let mut walk = Walk::new(world, errors, config, seed);
    let mut planner = Scripted::new(0.4, seed);
    let mut figures = Vec::new();
    for move_number in 0..260 {
        let (_, report) = planner.go(&mut walk);
        for contradiction in &report.contradictions {
            figures.push(format!(
                "{:?} {:?}",
                contradiction.track, contradiction.culprit
            ));
        }
        figures.extend(report.restructured.iter().map(|one| format!("{one:?}")));
        if move_number % 12 == 0 {
            let tracks = report.tracks.iter().take(3);
            figures.extend(tracks.map(|track| {
                let predicted = track.predicted.map(|one| (one.place, one.probability));
                let matched = (track.matcher, track.place, track.confidence);
                format!(
                    "{:?} {:?} {matched:?} {predicted:?}",
                    track.track, track.from
                )
            }));
        }
    }
    figures.extend(learned(&walk));
    (walk, figures)
}

#[test]
fn a_walk_among_places_that_look_alike_is_what_it_was() {
    let mut errors = ROUGH;
    errors.outliers = 0.03;
    errors.outlier_factor = 3.0;
    let (_, figures) = walked(open(6), errors, alike(), 5);
    pinned("diktiometry_alike", &figures);
}

#[test]
fn a_walk_through_painted_corridors_is_what_it_was() {
    let maze = blocks(6, 0.25, &mut ChaCha8Rng::seed_from_u64(2));
    let mut errors = ROUGH;
    errors.distance = 0.2;
    errors.look = 0.2;
    let mut config = painted();
    config.restructuring.look_merge = Use::On;
    let world = AbstractWorld::from_corridors(&maze, 1.0).painted(5, 2);
    let (mut walk, mut figures) = walked(world, errors, config, 2);
    // It is put down elsewhere, and finds itself.
    walk.robot.kidnap(4);
    let seen = FirstPlace {
        percept: Some(percept(walk.robot.look())),
        exits: exits(&walk.robot),
    };
    let mut belief = PlaceBelief::put_down(&walk.observer, &seen);
    for _ in 0..8 {
        let places = belief.places();
        let first: Vec<(PlaceId, f64)> = places.iter().copied().take(4).collect();
        figures.push(format!("{} {first:?}", places.len()));
        figures.push(format!("{:?}", belief.telling_action(&walk.observer)));
        let direction = walk.robot.wander().unwrap();
        let moved = walk.robot.go(direction).unwrap();
        let step = walk.told(&moved);
        figures.push(format!("{:?}", belief.follow(&walk.observer, &step)));
    }
    belief.weigh(|place| 1.0 + f64::from(place.0 % 3));
    figures.push(format!("{:?}", belief.places().first()));
    pinned("diktiometry_painted", &figures);
}

#[test]
fn a_walk_that_confuses_places_is_what_it_was() {
    let mut config = alike();
    config.matching.identity = Identity::Meets;
    config.restructuring.geometric_merge = GeometricMerge::Estims;
    let mut errors = ROUGH;
    errors.distance = 0.25;
    let (_, figures) = walked(open(7), errors, config, 1);
    pinned("diktiometry_confused", &figures);
}
