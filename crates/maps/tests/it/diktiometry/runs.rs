//! Walks of which every figure is pinned.

use super::abstract_world::{AbstractWorld, MoveNoise};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Interval, Point, PointBox, PoseBox};
use tolman_maps::diktiometry::{
    Action, Apart, Config, Counts, Exits, FirstPlace, FrameId, GeometricMerge, Identity,
    MergeProof, MoveOutcome, ObservedMove, Observer, Opportunity, PlaceBelief, PlaceId,
    Restructured, Signature, Use, WorldKind,
};

use super::walk::{ROUGH, Scripted, Walk, alike, blocks, exits, open, painted, percept};
use super::{certificates, properties};
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
            frame.above.len() + frame.below.len(),
            frame.places
        ));
        let relations = map.reference.relations(FrameId(number as u32));
        let relations = relations.step_by(3).take(4);
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

/// Returns a move among places a metre apart, which may end at a wall or be a lie.
fn any_move(rng: &mut ChaCha8Rng) -> ObservedMove {
    let action = rng.random_range(0..4_u32);
    let (east, north) = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][action as usize];
    let [off, aside, lie] = [0.2, 0.2, 1.0].map(|most| rng.random_range(-most..most));
    let length = if lie > 0.9 { 2.0 } else { 1.0 };
    let at = Point::new(length * east + off, length * north + aside);
    let exits: Vec<Action> = (0..4)
        .filter(|_| rng.random_bool(0.8))
        .map(Action)
        .collect();
    let look = (0..4)
        .map(|_| f64::from(rng.random_range(0..3_u32)))
        .collect();
    ObservedMove {
        action: Action(action),
        odometry: PoseBox::new(PointBox::about(at, 0.25).unwrap(), Interval::ZERO),
        percept: Some(Signature::new(1, look).unwrap()),
        exits: if lie < -0.5 {
            Exits::Unknown
        } else {
            Exits::Seen(exits)
        },
        outcome: if rng.random_bool(0.15) {
            MoveOutcome::Blocked
        } else {
            MoveOutcome::Arrived
        },
    }
}

/// Returns counts and sums over a map: one figure of each kind of its numbers.
fn summed(observer: &Observer) -> String {
    let map = observer.map();
    let places = || map.paths.places().map(|(_, place)| place);
    let links = || {
        map.paths
            .links()
            .map(|(id, link)| (map.paths.chance(id), link))
    };
    let frames = || {
        map.reference
            .frames()
            .iter()
            .filter(|frame| !frame.places.is_empty())
    };
    let relations = || {
        let frames = (0..).map(FrameId).zip(map.reference.frames());
        let used = frames.filter(|(_, frame)| !frame.places.is_empty());
        used.flat_map(|(frame, _)| map.reference.relations(frame))
    };
    let sides =
        |one: PointBox| one.x.low() + 2.0 * one.x.high() + 3.0 * one.y.low() + 4.0 * one.y.high();
    let counts = [
        places().count(),
        links().count(),
        frames().count(),
        observer.tracks().len(),
        places()
            .map(|place| place.views.len() + 10 * place.notes.len() + 100 * place.blocked.len())
            .sum(),
        places()
            .flat_map(|place| &place.histories)
            .map(Vec::len)
            .sum(),
        links()
            .map(|(_, link)| link.traversed as usize + 10 * link.then.len())
            .sum(),
        relations().count(),
    ];
    let counted = |counts: Counts| counts.expected() + 2.0 * counts.met();
    let sums: [f64; 8] = [
        places().map(|place| sides(place.position)).sum(),
        places().map(|place| sides(place.envelope)).sum(),
        places()
            .flat_map(|place| &place.estims)
            .map(|estim| estim.weight * estim.position.x)
            .sum(),
        places().map(|place| counted(place.counts)).sum(),
        links().map(|(_, link)| counted(link.counts)).sum(),
        links().map(|(chance, _)| chance).sum(),
        relations()
            .map(|one| sides(one.position) + 0.1 * sides(one.envelope))
            .sum(),
        observer.tracks().iter().map(|track| track.confidence).sum(),
    ];
    let check = observer.self_check();
    let advice = observer.opportunities();
    let worth: f64 = advice.iter().map(Opportunity::worth).sum();
    format!(
        "{counts:?} {sums:?} {} {} {worth}",
        check.certainty(),
        advice.len()
    )
}

/// Robots of all configurations that say what they like.
#[test]
fn walks_by_every_rule_are_what_they_were() {
    let mut figures = Vec::new();
    for seed in 0..48_u32 {
        let mut rng = ChaCha8Rng::seed_from_u64(u64::from(seed));
        let mut config = properties::config(rng.random());
        if seed % 3 > 0 {
            // Views count, as they are worth nothing to most.
            config = properties::config(rng.random::<u32>() | 1 << 7);
        }
        let moves: Vec<ObservedMove> = (0..100).map(|_| any_move(&mut rng)).collect();
        let (mut observer, moves) = properties::observer_and_moves(&config, moves);
        let mut changes = [0; 4];
        for (number, step) in (1..).zip(&moves) {
            let report = observer.step(step).unwrap();
            for change in &report.restructured {
                changes[match change {
                    Restructured::Merged { .. } => 0,
                    Restructured::Split { .. } => 1,
                    Restructured::PlaceElided(_) => 2,
                    _ => 3,
                }] += 1;
            }
            if number % 25 == 0 {
                let culprits = report.contradictions.iter().map(|one| one.culprit);
                let culprits: Vec<_> = culprits.take(3).collect();
                let tracks = report
                    .tracks
                    .iter()
                    .take(3)
                    .map(|one| (one.track, one.matcher, one.place));
                let tracks: Vec<_> = tracks.collect();
                figures.push(format!("{seed} {changes:?} {culprits:?} {tracks:?}"));
                figures.push(summed(&observer));
            }
        }
    }
    pinned("diktiometry_rules", &figures);
}

/// Returns what a robot believes that is put down on a map, and then makes a move.
fn believed(observer: &Observer, step: &ObservedMove) -> String {
    let first = FirstPlace {
        percept: step.percept.clone(),
        exits: step.exits.clone(),
    };
    let mut belief = PlaceBelief::put_down(observer, &first);
    let mut text = String::new();
    for action in [0, 1, 3] {
        let mut step = step.clone();
        step.action = Action(action);
        let explained = belief.follow(observer, &step);
        let places = belief.places();
        let first = places.iter().take(3);
        let first: Vec<String> = first
            .map(|(place, chance)| format!("{} {chance:.6}", place.0))
            .collect();
        let telling = belief.telling_action(observer);
        let count = places.len();
        text += &format!("{explained:?} {count} {} {telling:?} ", first.join(" "));
    }
    text
}

/// Robots that stop only roughly, whose places look alike nearer than they lie, whose corridors are
/// straight, and whose wheels share an error.
#[test]
fn walks_by_rough_rules_are_what_they_were() {
    let mut figures = Vec::new();
    for seed in 0..32_u32 {
        let mut rng = ChaCha8Rng::seed_from_u64(u64::from(1000 + seed));
        let mut config = properties::config(rng.random::<u32>() & !3);
        let bit = |number: u32| seed >> number & 1 == 1;
        config.place_radius = if bit(0) { 0.12 } else { 0.0 };
        config.shared_scale = if bit(1) { 0.08 } else { 0.0 };
        if bit(2) {
            config.actions = Config::corridor_actions();
            config.across = 0.1;
        }
        config.separation = [1.0, 0.8, 0.7][seed as usize % 3];
        config.alike_separation = config.separation;
        if bit(3) {
            config.alike_separation = 1.6;
            config.restructuring.winding_merge = Use::On;
        }
        if bit(4) {
            config.apart = Apart::Side;
            config.world = WorldKind::Static;
        }
        config.transients.rate = 0.4;
        let moves: Vec<ObservedMove> = (0..120)
            .map(|_| {
                let mut step = any_move(&mut rng);
                // Most go a metre, and say so within bounds.
                if rng.random_range(0..8) > 0 {
                    let way = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
                    let (x, y) = way[step.action.0 as usize];
                    let off = rng.random_range(-0.04..0.04);
                    let at = PointBox::about(Point::new(x + off, y - off), 0.06).unwrap();
                    step.odometry.position = at;
                    step.outcome = MoveOutcome::Arrived;
                }
                step
            })
            .collect();
        let (mut observer, moves) = properties::observer_and_moves(&config, moves);
        for (number, step) in (1..).zip(&moves) {
            let report = observer.step(step).unwrap();
            if number % 20 == 0 {
                let count = report.restructured.len();
                figures.push(format!("{seed} {count} {}", summed(&observer)));
                figures.push(believed(&observer, step));
            }
        }
    }
    pinned("diktiometry_rough", &figures);
}

/// The certificates of all merges of some walks.
#[test]
fn the_proofs_of_merges_are_what_they_were() {
    let mut figures = Vec::new();
    for seed in 0..6 {
        let mut config = if seed % 2 == 0 { alike() } else { painted() };
        config.actions = Config::corridor_actions();
        if seed > 3 {
            config.restructuring.look_merge = Use::On;
        }
        let (_, told) = certificates::walked(config, seed);
        figures.push(format!("{seed} {:?}", told.unproven));
        figures.extend(told.certificates.iter().map(|one| {
            let proof = match &one.proof {
                MergeProof::Bounds(routes) => format!("{routes:?}"),
                proof => format!("{proof:?}"),
            };
            format!("{:?} {} {proof}", one.visits, one.rests_on_looks)
        }));
    }
    pinned("diktiometry_proofs", &figures);
}
