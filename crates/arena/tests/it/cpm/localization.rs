//! Localization of a robot that was put down in one of several known mazes.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::cpm::{
    CpMap, Dictionary, DictionaryError, End, Environments, LocalizeError, Localizer,
    LocalizerConfig, Location, PatternId, Port, Sighting, Sign, Traversal, Turn,
};
use tolman_robot::Landmark;
use tolman_systems::cpm::{Aim, CpmConfig, Explorer};

use super::explorations::pursue;
use super::world::{
    CorridorEnd, Likeness, MazeConfig, PlaneMaze, PlaneWalker, Reckoning, WalkOutcome, WalkerNoise,
    WorldPort,
};

/// A maze, explored.
struct Known {
    world: PlaneMaze,
    map: CpMap,
    /// For the port of the map where the exploration ended, that of the world.
    at: (Port, WorldPort),
}

fn explored(maze: &MazeConfig, noise: WalkerNoise, rng: &mut ChaCha8Rng) -> Known {
    let world = PlaneMaze::random(maze, rng).unwrap();
    explored_of(world, noise, rng)
}

fn explored_of(world: PlaneMaze, noise: WalkerNoise, rng: &mut ChaCha8Rng) -> Known {
    let mut rover = PlaneWalker::new(&world, noise, Reckoning::Bounded);
    let mut explorer = Explorer::new(CpmConfig::robust(), rover.sighting()).unwrap();
    pursue(&mut explorer, &mut rover, Aim::Explore, rng);
    let at = (explorer.mapper.at(), rover.at());
    let map = explorer.mapper.map().clone();
    Known { world, map, at }
}

impl Known {
    /// Returns whether the robot, truly at this port, is where it believes to be.
    fn is_right(&self, found: Location, truth: WorldPort) -> bool {
        let (at, truly_at) = self.at;
        let Some(known) = self.world.correspondence(&self.map, at, truly_at) else {
            return false;
        };
        let degree = self.world.sighting(truth.place).degree;
        known.get(&found.ahead.junction).is_some_and(|first| {
            let number = (first.number + found.ahead.number) % degree;
            WorldPort { number, ..*first } == truth
        })
    }

    /// Returns a robot that knows this maze alone, and has observed this.
    fn localizer_after(&self, walk: &Traversal) -> Localizer {
        let maps = core::slice::from_ref(&self.map);
        let dictionary = self.world.dictionary();
        let mut localizer = Localizer::new(maps, dictionary, LocalizerConfig::usual()).unwrap();
        for pattern in &walk.patterns {
            localizer.observe(*pattern).unwrap();
        }
        localizer
    }
}

/// Returns a place in the midst of a corridor: at least half of it, and two observations, to come.
fn middle(world: &PlaneMaze, rng: &mut ChaCha8Rng) -> (CorridorEnd, u32) {
    loop {
        let corridor = rng.random_range(0..world.corridors().len() as u32);
        let count = world.corridors()[corridor as usize].patterns.len() as u32;
        let sign = if rng.random_range(0_u32..2) == 0 {
            Sign::Minus
        } else {
            Sign::Plus
        };
        if count >= 4 {
            return (
                CorridorEnd { corridor, sign },
                rng.random_range(0..=count / 2),
            );
        }
    }
}

#[test]
fn from_mid_fragment_before_the_next_junction() {
    let noise = WalkerNoise {
        substitution: 0.05,
        slip: 0.1,
        ..WalkerNoise::NONE
    };
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut before, mut at, mut sure, mut rightly_sure, mut starts) = (0, 0, 0, 0, 0);
    for _ in 0..20 {
        let known = explored(&MazeConfig::small(), WalkerNoise::NONE, &mut rng);
        let mut rover = PlaneWalker::new(&known.world, noise, Reckoning::None);
        for _ in 0..20 {
            let (enter, passed) = middle(&known.world, &mut rng);
            let walk = rover.walk_on(enter, passed, &mut rng).unwrap();
            let mut localizer = known.localizer_after(&walk);
            starts += 1;
            let is_right = known.is_right(localizer.location(), rover.at());
            let is_sure = localizer.location().probability > 0.9;
            before += u32::from(is_right);
            sure += u32::from(is_sure);
            rightly_sure += u32::from(is_sure && is_right);
            localizer.arrive(walk.sighting, None);
            at += u32::from(known.is_right(localizer.location(), rover.at()));
        }
    }
    println!(
        "{before} right before the junction, {rightly_sure} of {sure} that are sure, {at} right at it, of {starts}"
    );
    assert!(10 * before >= 9 * starts, "{before} of {starts}");
    assert!(2 * sure > starts, "{sure} sure of {starts}");
    assert!(
        100 * rightly_sure >= 99 * sure,
        "{rightly_sure} of {sure} that are sure"
    );
    assert!(at >= before);
}

/// A place entered by another way has other ways ahead. Bearings tell fragments apart that no
/// sequence does.
#[test]
fn where_ways_lead_tells_fragments_apart_that_look_alike() {
    let noise = WalkerNoise {
        heading: 0.1,
        ..WalkerNoise::NONE
    };
    let mut maze = MazeConfig::small();
    maze.likeness = Likeness::Kinds(2);
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    // Without bearings, by a glimpse of them, by a look, and the number of starts.
    let (mut blind, mut glimpsed, mut seen, mut starts) = (0, 0, 0, 0);
    for _ in 0..20 {
        let known = explored(&maze, WalkerNoise::NONE, &mut rng);
        let mut rover = PlaneWalker::new(&known.world, noise, Reckoning::Bounded);
        for _ in 0..20 {
            let (enter, passed) = middle(&known.world, &mut rng);
            let walk = rover.walk_on(enter, passed, &mut rng).unwrap();
            let mut localizer = known.localizer_after(&walk);
            let is_right =
                |localizer: &Localizer| u32::from(known.is_right(localizer.location(), rover.at()));
            let mut without = localizer.clone();
            without.arrive(walk.sighting, None);
            blind += is_right(&without);
            let bearings = walk.bearings.as_ref();
            localizer.end_in_sight(walk.sighting.landmark, bearings);
            glimpsed += is_right(&localizer);
            localizer.arrive(walk.sighting, bearings);
            seen += is_right(&localizer);
            starts += 1;
        }
    }
    println!("{blind} without, {glimpsed} glimpsed, {seen} seen, of {starts}");
    assert!(
        seen >= glimpsed && glimpsed > blind,
        "{blind} {glimpsed} {seen}"
    );
    assert!(
        10 * (starts - seen) <= 7 * (starts - blind),
        "{blind} {seen}"
    );
}

#[test]
fn before_the_first_observation_each_map_is_as_likely_however_large() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let small = explored(&MazeConfig::small(), WalkerNoise::NONE, &mut rng);
    let dictionary = small.world.dictionary().clone();
    let mut maze = MazeConfig::small();
    maze.columns = 6;
    maze.rows = 6;
    let world = PlaneMaze::random_of(dictionary.clone(), &maze, &mut rng).unwrap();
    let large = explored_of(world, WalkerNoise::NONE, &mut rng);
    let nothing = CpMap::default();
    let maps = [small.map, nothing, large.map];
    let localizer = Localizer::new(&maps, &dictionary, LocalizerConfig::usual()).unwrap();
    let found = localizer.maps();
    for (found, expected) in found.iter().zip([0.5, 0.0, 0.5]) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}

#[test]
fn turns_that_lead_where_no_map_has_been_are_not_known() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let known = explored(&MazeConfig::small(), WalkerNoise::NONE, &mut rng);
    let dictionary = known.world.dictionary();
    let mut explorer = Explorer::new(CpmConfig::online(), Sighting::plain(1)).unwrap();
    let walk = Traversal {
        patterns: vec![PatternId(0), PatternId(1), PatternId(2)],
        motion: None,
        sighting: Sighting::plain(3),
        bearings: None,
    };
    explorer
        .mapper
        .arrive(Turn::BACK, &walk, dictionary)
        .unwrap();
    let maps = [explorer.mapper.map().clone()];
    let mut localizer = Localizer::new(&maps, dictionary, LocalizerConfig::usual()).unwrap();
    for pattern in walk.patterns {
        localizer.observe(pattern).unwrap();
    }
    localizer.arrive(walk.sighting, None);
    let likely = |turn| localizer.knows(turn);
    assert!(likely(Turn::BACK) > 0.9, "{}", likely(Turn::BACK));
    assert!(likely(Turn(1)) < 0.1 && likely(Turn(2)) < 0.1);
    assert!(likely(Turn(3)).abs() < 1e-12, "no junction has it");
}

#[test]
fn which_environment_and_within_one_further_fragment() {
    let noise = WalkerNoise {
        substitution: 0.05,
        slip: 0.1,
        ..WalkerNoise::NONE
    };
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let (mut maps_right, mut places_right, mut starts) = (0, 0, 0);
    for _ in 0..10 {
        let first = explored(&MazeConfig::small(), WalkerNoise::NONE, &mut rng);
        let dictionary = first.world.dictionary().clone();
        let mut known = vec![first];
        for loops in [0.0, 0.5, 1.0] {
            let mut maze = MazeConfig::small();
            maze.loops = loops;
            let world = PlaneMaze::random_of(dictionary.clone(), &maze, &mut rng).unwrap();
            known.push(explored_of(world, WalkerNoise::NONE, &mut rng));
        }
        let maps: Vec<CpMap> = known.iter().map(|known| known.map.clone()).collect();
        for (number, here) in known.iter().enumerate() {
            let mut localizer =
                Localizer::new(&maps, &dictionary, LocalizerConfig::usual()).unwrap();
            let mut rover = PlaneWalker::new(&here.world, noise, Reckoning::None);
            let (enter, passed) = middle(&here.world, &mut rng);
            let walk = rover.walk_on(enter, passed, &mut rng).unwrap();
            for pattern in walk.patterns {
                localizer.observe(pattern).unwrap();
            }
            localizer.arrive(walk.sighting, None);
            let turn = Turn(u32::from(walk.sighting.degree > 1));
            localizer.turn(turn).unwrap();
            let WalkOutcome::Arrived(walk) = rover.go(turn, None, &mut rng).unwrap() else {
                unreachable!("it was not told to give up");
            };
            for pattern in walk.patterns {
                localizer.observe(pattern).unwrap();
            }
            localizer.arrive(walk.sighting, None);
            starts += 1;
            let found = localizer.location();
            places_right += u32::from(found.map == number && here.is_right(found, rover.at()));
            maps_right += u32::from(localizer.maps()[number] > 0.9);
        }
    }
    println!("{places_right} places, {maps_right} maps right of {starts}");
    assert!(100 * maps_right >= 95 * starts, "{maps_right} of {starts}");
    assert!(
        100 * places_right >= 95 * starts,
        "{places_right} of {starts}"
    );
}

#[test]
fn maps_of_another_robot_are_refused() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let [one, other] = [0, 1].map(|_| explored(&MazeConfig::small(), WalkerNoise::NONE, &mut rng));
    let maps = [one.map, other.map];
    let refused = Localizer::new(&maps, one.world.dictionary(), LocalizerConfig::usual());
    assert!(matches!(
        refused.err(),
        Some(LocalizeError::Dictionary(
            DictionaryError::OtherDictionary { .. }
        ))
    ));
}

#[test]
fn bad_input_is_refused() {
    let dictionary = Dictionary::new(1);
    let refused = Localizer::new(&[], &dictionary, LocalizerConfig::usual());
    assert_eq!(refused.err(), Some(LocalizeError::Empty));
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let known = explored(&MazeConfig::small(), WalkerNoise::NONE, &mut rng);
    let maps = core::slice::from_ref(&known.map);
    let mut config = LocalizerConfig::usual();
    config.slip = f64::NAN;
    assert!(Localizer::new(maps, known.world.dictionary(), config).is_err());
    let mut localizer =
        Localizer::new(maps, known.world.dictionary(), LocalizerConfig::usual()).unwrap();
    assert!(localizer.observe(PatternId(31)).is_err());
    localizer.observe(PatternId(0)).unwrap();
    // What no map has leaves it unsure, not broken.
    localizer.arrive(Sighting::plain(7), None);
    assert!(localizer.location().probability.is_finite());
    assert!(localizer.turn(Turn(6)).is_err());
    assert!((localizer.maps().iter().sum::<f64>() - 1.0).abs() < 1e-9);
}

/// The fourth layer: paths of several environments in one memory, each recalled as a whole from one
/// of its fragments.
#[test]
fn one_sequence_recalls_its_path_and_environment() {
    let noise = WalkerNoise {
        substitution: 0.05,
        slip: 0.1,
        ..WalkerNoise::NONE
    };
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let dictionary = explored(&MazeConfig::small(), WalkerNoise::NONE, &mut rng)
        .world
        .dictionary()
        .clone();
    let mut environments = Environments::new(&dictionary).unwrap();
    let mut paths: Vec<(u32, PlaneMaze, Vec<End>, Vec<CorridorEnd>)> = Vec::new();
    for number in 0..4 {
        let mut maze = MazeConfig::small();
        maze.columns = 6;
        maze.rows = 6;
        maze.loops = 0.0;
        let world = PlaneMaze::random_of(dictionary.clone(), &maze, &mut rng).unwrap();
        let known = explored_of(world, WalkerNoise::NONE, &mut rng);
        let goal = known.map.landmarks(Landmark::Goal).next().unwrap();
        let start = known.map.landmarks(Landmark::Start).next().unwrap();
        let from = Port {
            junction: start,
            number: 0,
        };
        let plan = known.map.plan(from, |id| id == goal).unwrap();
        let path: Vec<End> = plan.legs.iter().map(|leg| leg.enter).collect();
        if path.len() < 2 {
            continue;
        }
        environments
            .learn(number, &known.map, &path, &dictionary)
            .unwrap();
        // The same path in the world.
        let mut rover = PlaneWalker::new(&known.world, WalkerNoise::NONE, Reckoning::None);
        let corridors = plan.legs.iter().map(|leg| {
            rover.go(leg.turn, None, &mut rng).unwrap();
            let end = known.world.end_at(rover.at()).unwrap();
            CorridorEnd {
                sign: end.sign.opposite(),
                ..end
            }
        });
        let corridors = corridors.collect();
        paths.push((number, known.world, path, corridors));
    }
    assert!(paths.len() >= 3);
    let (mut right, mut all) = (0, 0);
    for (number, world, path, corridors) in &paths {
        let mut rover = PlaneWalker::new(world, noise, Reckoning::None);
        for (place, enter) in corridors.iter().enumerate() {
            let walk = rover.walk_on(*enter, 0, &mut rng).unwrap();
            let recalled = environments.recall(&walk.patterns, &dictionary).unwrap();
            all += 1;
            right += u32::from(recalled.environment == *number && recalled.chain == path[place..]);
        }
    }
    assert!(100 * right >= 95 * all, "{right} of {all}");
}

/// Two corridors end alike and begin differently. The end behind the robot tells which of them it
/// is in, and which way it goes.
#[test]
fn who_turns_round_knows_by_the_other_end() {
    let mut dictionary = Dictionary::new(1);
    for pattern in 0..8 {
        let prototype = [f64::from(pattern)];
        dictionary.learn(&prototype, &prototype, 0.1).unwrap();
    }
    let corridor = |patterns: [u32; 4]| {
        let mut explorer = Explorer::new(CpmConfig::online(), Sighting::plain(1)).unwrap();
        let walk = Traversal {
            patterns: patterns.map(PatternId).to_vec(),
            motion: None,
            sighting: Sighting::plain(1),
            bearings: None,
        };
        explorer
            .mapper
            .arrive(Turn::BACK, &walk, &dictionary)
            .unwrap();
        explorer.mapper.map().clone()
    };
    let maps = [corridor([0, 3, 5, 4]), corridor([7, 3, 5, 4])];
    let mut localizer = Localizer::new(&maps, &dictionary, LocalizerConfig::usual()).unwrap();
    for pattern in [5, 4] {
        localizer.observe(PatternId(pattern)).unwrap();
    }
    localizer.end_in_sight(None, None);
    let ahead = localizer.location();
    assert!(ahead.probability < 0.51, "{ahead:?}");

    let before = localizer.clone();
    localizer.turn_round();
    let back = localizer.location();
    assert_eq!(back.enter.fragment, ahead.enter.fragment);
    assert_eq!(back.enter.sign, ahead.enter.sign.opposite());
    let mut again = localizer.clone();
    again.turn_round();
    assert_eq!(again.location(), before.location());

    for pattern in [4, 5, 3, 7] {
        localizer.observe(PatternId(pattern)).unwrap();
    }
    localizer.end_in_sight(None, None);
    let found = localizer.location();
    assert_eq!((found.map, found.enter.sign), (1, Sign::Plus));
    assert!(found.probability > 0.95, "{found:?}");
}
