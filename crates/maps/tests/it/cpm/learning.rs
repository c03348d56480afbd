//! Tests the maps that CPM learns of mazes whose corridors all look different, and its localization
//! there.

use alloc::collections::{BTreeMap, BTreeSet, VecDeque};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::cpm::{
    CpMap, CpMapper, CpMapperConfig, Localizer, LocalizerConfig, MapUpdate, PatternId, Port,
    PortState, Sighting, Sign, Turn,
};
use tolman_maze::{Cell, Direction};
use tolman_robot::Landmark;

use super::world::{Stand, World};
use crate::pinned::pinned;

type Corridors = BTreeSet<(Cell, Direction)>;

pub(crate) struct Learned {
    pub(crate) world: World,
    pub(crate) mapper: CpMapper,
    stand: Stand,
    walked: Corridors,
    updates: Vec<MapUpdate>,
}

/// Wanders through a maze and maps it.
pub(crate) fn learned(world: World, config: CpMapperConfig, walks: usize, seed: u64) -> Learned {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut stand = world.start();
    let mut mapper = CpMapper::new(config, world.sighting(stand.at)).unwrap();
    let (mut walked, mut updates) = (Corridors::new(), Vec::new());
    for _ in 0..walks {
        let degree = world.ways(stand.at).len() as u32;
        let turn = Turn(rng.random_range(u32::from(degree > 1)..degree));
        let way = world.ports(stand)[turn.0 as usize];
        let (next, walk) = world.walk(stand, turn);
        walked.extend([(stand.at, way), (next.at, next.behind)]);
        updates.push(mapper.arrive(turn, &walk, &world.dictionary).unwrap());
        stand = next;
    }
    Learned {
        world,
        mapper,
        stand,
        walked,
        updates,
    }
}

/// Walks through map and maze side by side and compares all that the map says. Returns which port
/// each place's first way is.
fn compare(world: &World, map: &CpMap, from: (Port, Stand), walked: &Corridors) {
    let mut known: BTreeMap<Cell, Port> = BTreeMap::new();
    let mut queue = VecDeque::from([from]);
    let mut junctions = BTreeSet::new();
    while let Some((port, stand)) = queue.pop_front() {
        let ports = world.ports(stand);
        let place = map.junction(port.junction).unwrap();
        assert_eq!(place.sighting(), world.sighting(stand.at));
        // Counted from the first of all ways, each place has one numbering.
        let north = world.ways(stand.at)[0];
        let offset = ports.iter().position(|way| *way == north).unwrap() as u32;
        let first = port
            .junction
            .port((port.number + offset) % ports.len() as u32);
        if let Some(before) = known.insert(stand.at, first) {
            assert_eq!(before, first, "one place, one numbering: {stand:?}");
            continue;
        }
        assert!(junctions.insert(port.junction), "two places are one");
        if let Some(bearings) = place.bearings_from(port.number) {
            let quarter = |way: &Direction| {
                (0..4)
                    .scan(stand.behind, |at, count| {
                        Some((core::mem::replace(at, at.left()), count))
                    })
                    .find_map(|(at, count)| (at == *way).then_some(f64::from(count)))
                    .unwrap()
            };
            for (way, seen) in ports.iter().zip(bearings.radians()) {
                let expected = quarter(way) * core::f64::consts::FRAC_PI_2;
                assert!((seen - expected).abs() < 1e-9, "{seen} for {expected}");
            }
        }
        for (turn, way) in (0..).zip(&ports) {
            let number = Turn(turn).exit(port.number, ports.len() as u32).unwrap();
            let exit = port.junction.port(number);
            let is_walked = walked.contains(&(stand.at, *way));
            let (next, walk) = world.walk(stand, Turn(turn));
            match map.port(exit).unwrap() {
                PortState::Open { .. } => assert!(!is_walked, "{stand:?} to {way:?} is lost"),
                PortState::Filled(end) => {
                    assert!(is_walked);
                    let fragment = map.fragment(end.fragment).unwrap();
                    let seen = match end.sign {
                        Sign::Minus => fragment.patterns.clone(),
                        Sign::Plus => world.dictionary.inverse(&fragment.patterns).unwrap(),
                    };
                    assert_eq!(seen, walk.patterns);
                    let there = map.beyond(exit).unwrap();
                    assert_eq!(map.transition(end, end), Some(Turn::BACK));
                    queue.push_back((there, next));
                }
            }
        }
    }
    let visited: BTreeSet<Cell> = walked.iter().map(|(at, _)| *at).collect();
    assert_eq!(known.keys().copied().collect::<BTreeSet<_>>(), visited);
    assert_eq!(map.junctions().len(), visited.len());
    assert_eq!(2 * map.fragments().len(), walked.len());
    let open: usize = known
        .keys()
        .map(|at| {
            let ways = world.ways(*at);
            let unknown = ways.iter().filter(|way| !walked.contains(&(*at, **way)));
            unknown.count()
        })
        .sum();
    assert_eq!(map.open_ports().count(), open);
    assert_eq!(map.is_explored(), open == 0);
}

fn counts(updates: &[MapUpdate]) -> [usize; 6] {
    [
        MapUpdate::New,
        MapUpdate::Known,
        MapUpdate::Duplicate,
        MapUpdate::Loop,
        MapUpdate::Revised,
        MapUpdate::Contradiction,
    ]
    .map(|kind| updates.iter().filter(|update| **update == kind).count())
}

#[test]
fn hypotheses_learn_mazes_as_they_are_and_close_loops_on_arrival() {
    for seed in 0..6 {
        let side = 4 + (seed % 3) as u16;
        let share = [0.0, 0.5, 1.0][seed as usize % 3];
        let world = World::new(side, share, seed);
        let learned = learned(world, CpMapperConfig::robust(), 120, seed);
        let Learned {
            world,
            mapper,
            stand,
            walked,
            updates,
        } = &learned;
        compare(world, mapper.map(), (mapper.at(), *stand), walked);
        let [new, known, duplicate, closed, revised, contradicted] = counts(updates);
        // A way to a place not seen before, or to one that was.
        let places: BTreeSet<Cell> = walked.iter().map(|(at, _)| *at).collect();
        assert_eq!(new, places.len() - 1);
        assert_eq!(closed, walked.len() / 2 - new);
        assert_eq!(known, updates.len() - walked.len() / 2);
        assert_eq!((duplicate, revised, contradicted), (0, 0, 0));
        assert_eq!(mapper.traversals(), 120);
        let certainty = mapper.certainty(0.5).unwrap();
        assert!(certainty > 0.99, "{certainty}");
        assert_eq!(mapper.doubt(0.5), None);
    }
}

#[test]
fn online_maps_become_the_maze_once_all_came_again() {
    for seed in 0..6 {
        let world = World::new(4, [0.0, 0.5, 1.0][seed as usize % 3], seed);
        let learned = learned(world, CpMapperConfig::online(), 250, seed);
        let Learned {
            world,
            mapper,
            stand,
            walked,
            updates,
        } = &learned;
        compare(world, mapper.map(), (mapper.at(), *stand), walked);
        assert!(
            mapper
                .map()
                .is_optimized(&CpMapperConfig::online().matching, &world.dictionary)
        );
        let [new, known, duplicate, closed, revised, contradicted] = counts(updates);
        assert_eq!(new, walked.len() / 2, "each corridor is new once");
        assert_eq!(known + duplicate, updates.len() - new);
        assert_eq!((closed, revised, contradicted), (0, 0, 0));
        let first = updates
            .iter()
            .position(|update| matches!(update, MapUpdate::Known | MapUpdate::Duplicate));
        assert_eq!(mapper.before_duplicate().map(|count| count as usize), first);
    }
}

#[test]
fn offline_maps_become_the_maze_when_they_are_optimized() {
    for seed in 0..4 {
        let world = World::new(4, [0.0, 1.0][seed as usize % 2], seed);
        let mut learned = learned(world, CpMapperConfig::offline(), 200, seed);
        let before = learned.mapper.map().fragments().len();
        let count = counts(&learned.updates);
        assert_eq!(count[0], before);
        assert_eq!(count[0] + count[1], 200);
        let duplicates = learned.mapper.optimize(&learned.world.dictionary).unwrap();
        let Learned {
            world,
            mapper,
            stand,
            walked,
            ..
        } = &learned;
        assert_eq!(before - duplicates, mapper.map().fragments().len());
        compare(world, mapper.map(), (mapper.at(), *stand), walked);
        assert_eq!(mapper.clone().optimize(&world.dictionary), Ok(0));
    }
}

#[test]
fn plans_lead_to_the_landmark_on_the_shortest_way() {
    for seed in 0..4 {
        let world = World::new(5, 0.8, seed);
        let mut learned = learned(world, CpMapperConfig::robust(), 400, seed);
        assert_eq!(learned.mapper.map().open_ports().count(), 0);
        assert!(learned.mapper.map().is_complete());
        for _ in 0..10 {
            let Learned {
                world,
                mapper,
                stand,
                ..
            } = &mut learned;
            for landmark in [Landmark::Goal, Landmark::Start] {
                let plan = mapper.plan(landmark).unwrap();
                let distances = world.distances(stand.at);
                let marked = distances
                    .iter()
                    .filter(|(at, _)| world.landmark(**at) == Some(landmark));
                let shortest = marked.map(|(_, far)| *far).min().unwrap();
                assert_eq!(plan.length as usize, shortest);
                let (mut at, mut length) = (*stand, 0);
                for leg in &plan.legs {
                    let (next, walk) = world.walk(at, leg.turn);
                    assert_eq!(leg.observations as usize, walk.patterns.len());
                    length += walk.patterns.len();
                    at = next;
                }
                assert_eq!(world.landmark(at.at), Some(landmark));
                assert_eq!(length, shortest);
            }
            let (next, walk) = world.walk(*stand, Turn(u32::from(world.ways(stand.at).len() > 1)));
            mapper
                .arrive(
                    Turn(u32::from(world.ways(stand.at).len() > 1)),
                    &walk,
                    &world.dictionary,
                )
                .unwrap();
            *stand = next;
        }
    }
}

/// A robot is put down in the middle of a corridor of a maze that it knows.
#[test]
fn a_robot_finds_its_place() {
    let learned = learned(World::new(4, 0.6, 7), CpMapperConfig::robust(), 150, 0);
    let world = &learned.world;
    let maps = [learned.mapper.map().clone()];
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut turn_at = |stand: Stand| {
        let degree = world.ways(stand.at).len() as u32;
        Turn(rng.random_range(u32::from(degree > 1)..degree))
    };
    let mut stand = learned.stand;
    for trial in 0..30 {
        let usual = LocalizerConfig::usual();
        let mut localizer = Localizer::new(&maps, &world.dictionary, usual).unwrap();
        let (next, walk) = world.walk(stand, turn_at(stand));
        for pattern in &walk.patterns[walk.patterns.len() / 2..] {
            localizer.observe(*pattern).unwrap();
        }
        localizer.end_in_sight(world.landmark(next.at), walk.bearings.as_ref());
        localizer.arrive(walk.sighting, walk.bearings.as_ref());
        stand = next;
        for step in 0..3 {
            let turn = turn_at(stand);
            assert!(
                localizer.knows(turn) > 0.9,
                "{trial}: {}",
                localizer.knows(turn)
            );
            localizer.turn(turn).unwrap();
            let (next, walk) = world.walk(stand, turn);
            for (place, pattern) in walk.patterns.iter().enumerate() {
                // One is seen twice, one is missed and one mistaken for another.
                match (step, place) {
                    (0, 1) => continue,
                    (1, 1) => localizer.observe(*pattern).unwrap(),
                    (2, 1) => {
                        localizer.observe(PatternId(0)).unwrap();
                        continue;
                    }
                    _ => {}
                }
                localizer.observe(*pattern).unwrap();
            }
            localizer.arrive(walk.sighting, walk.bearings.as_ref());
            stand = next;
        }
        let found = localizer.location();
        let sum: f64 = localizer.maps().iter().sum();
        assert!((sum - 1.0).abs() < 1e-9, "{sum}");
        assert!(found.probability > 0.95, "trial {trial}: {found:?}");
        compare(world, &maps[0], (found.ahead, stand), &learned.walked);
    }
}

/// Mazes whose corridors look alike, by dead reckoning that errs: every figure is pinned.
#[test]
fn a_run_among_corridors_that_look_alike_is_what_it_was() {
    let mut figures = Vec::new();
    for (seed, bounds) in [(3, 0.2), (4, 0.6), (5, 1.1)] {
        let mut world = World::painted(5, 0.7, 1, seed);
        world.bounds = bounds;
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut stand = world.start();
        let sighting = world.sighting(stand.at);
        let mut mapper = CpMapper::new(CpMapperConfig::robust(), sighting).unwrap();
        for step in 0..60 {
            let degree = world.ways(stand.at).len() as u32;
            let turn = Turn(rng.random_range(u32::from(degree > 1)..degree));
            let (next, mut walk) = world.walk(stand, turn);
            if step % 3 == 0 {
                walk.patterns.pop();
                walk.bearings = None;
            }
            if step % 7 == 6 {
                walk.motion = None;
            }
            if step % 10 == 9 {
                mapper.turned_back(turn, step).unwrap();
                continue;
            }
            let update = mapper.arrive(turn, &walk, &world.dictionary).unwrap();
            stand = next;
            let certainty = mapper.certainty(0.5).unwrap();
            let count = mapper.map().fragments().len();
            figures.push(format!("{update:?} {:?} {certainty} {count}", mapper.at()));
        }
        figures.push(format!("{:?} {}", mapper.doubt(0.5), mapper.map().bytes()));
        for (id, fragment) in mapper.map().fragments().step_by(4) {
            figures.push(format!("{id:?} {fragment:?}"));
        }
        let maps = [mapper.map().clone()];
        let usual = LocalizerConfig::usual();
        let mut localizer = Localizer::new(&maps, &world.dictionary, usual).unwrap();
        for step in 0..8 {
            let degree = world.ways(stand.at).len() as u32;
            let turn = Turn(u32::from(degree > 1));
            let (next, walk) = world.walk(stand, turn);
            if step > 0 {
                figures.push(format!(
                    "{} {:?}",
                    localizer.knows(turn),
                    localizer.turn(turn)
                ));
            }
            for pattern in &walk.patterns {
                localizer.observe(*pattern).unwrap();
            }
            if step == 3 {
                localizer.turn_round();
                localizer.turn_round();
            }
            if step % 2 == 0 {
                localizer.end_in_sight(world.landmark(next.at), walk.bearings.as_ref());
            }
            localizer.arrive(walk.sighting, walk.bearings.as_ref());
            stand = next;
            figures.push(format!("{:?}", localizer.location()));
        }
    }
    pinned("cpm", &figures);
}

/// Mazes of few colours and vague dead reckoning: what each walk does to the map, and what is
/// doubted of it.
#[test]
fn doubts_of_maps_of_mazes_that_look_alike_are_what_they_were() {
    let mut figures = Vec::new();
    for seed in 0..10 {
        let colours = 1 + seed as u32 % 2;
        let mut world = World::painted(4 + seed as u16 % 3, 0.6, colours, 20 + seed);
        world.bounds = [1.2, 2.0, 0.6][seed as usize % 3];
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut stand = world.start();
        let sighting = world.sighting(stand.at);
        let mut mapper = CpMapper::new(CpMapperConfig::robust(), sighting).unwrap();
        for step in 0..70 {
            let degree = world.ways(stand.at).len() as u32;
            let turn = Turn(rng.random_range(u32::from(degree > 1)..degree));
            let (next, mut walk) = world.walk(stand, turn);
            // Of some, a walk is a lie now and then.
            if seed % 3 == 2 && rng.random_range(0..16) == 0 {
                walk.patterns.reverse();
                walk.sighting = Sighting::plain(walk.sighting.degree);
            }
            let update = mapper.arrive(turn, &walk, &world.dictionary).unwrap();
            stand = next;
            if step % 5 == 4 {
                let [near, far] = [0.3, 0.9].map(|apart| {
                    let certainty = mapper.certainty(apart).unwrap();
                    format!("{certainty:.6} {:?}", mapper.doubt(apart))
                });
                let map = mapper.map();
                let open = map.open_ports().count();
                let count = (map.fragments().len(), map.junctions().len(), open);
                figures.push(format!("{seed} {update:?} {:?} {count:?}", mapper.at()));
                figures.push(format!("{near} {far}"));
            }
        }
    }
    pinned("cpm_doubt", &figures);
}

/// Of two equal maps each is as probable as the other.
#[test]
fn each_map_has_its_share_of_the_probability() {
    let learned = learned(World::new(4, 0.6, 7), CpMapperConfig::robust(), 150, 0);
    let world = &learned.world;
    let maps = [(); 2].map(|()| learned.mapper.map().clone());
    let usual = LocalizerConfig::usual();
    let mut localizer = Localizer::new(&maps, &world.dictionary, usual).unwrap();
    let turn = Turn(u32::from(world.ways(learned.stand.at).len() > 1));
    let (next, walk) = world.walk(learned.stand, turn);
    for pattern in &walk.patterns {
        localizer.observe(*pattern).unwrap();
    }
    localizer.end_in_sight(world.landmark(next.at), walk.bearings.as_ref());
    localizer.arrive(walk.sighting, walk.bearings.as_ref());
    let found = localizer.maps();
    assert_eq!(found.len(), 2);
    assert!(
        found.iter().all(|share| (share - 0.5).abs() < 1e-9),
        "{found:?}"
    );
}

#[test]
fn a_detour_leads_to_an_unknown_port_and_may_be_shorter_than_the_known_way() {
    let mut detours = 0;
    for (seed, walks) in (0..12).flat_map(|seed| [(seed, 20), (seed, 60), (seed, 400)]) {
        let world = World::new(5, 0.8, seed);
        let Learned { mapper, .. } = learned(world, CpMapperConfig::robust(), walks, seed);
        let map = mapper.map();
        for landmark in [Landmark::Goal, Landmark::Start] {
            let Some(detour) = map.detour(mapper.at(), |id| map.has(id, landmark)) else {
                continue;
            };
            assert!(map.junction(detour).unwrap().open_ports().next().is_some());
            let to_it = map.plan(mapper.at(), |id| id == detour).unwrap();
            let known = mapper.plan(landmark).map(|plan| plan.length);
            assert!(
                known.is_none_or(|known| to_it.length < known),
                "seed {seed}"
            );
            detours += 1;
        }
    }
    assert!(detours > 0);
}
