//! Readings that no robot should meet, and what becomes of them.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::Point;
use tolman_maps::cpm::{
    Bearings, CpmError, Dictionary, DictionaryError, Environments, PatternId, RecallError,
    Sighting, Traversal, Turn,
};
use tolman_robot::Landmark;
use tolman_systems::cpm::{Aim, CpmConfig, Done, Explorer};

use super::explorations::pursue;
use super::walks::dictionary;
use super::world::{
    MapCheck, MazeConfig, MazeConfigError, PlaneMaze, PlaneMazeError, PlaneWalker, Reckoning,
    WalkerNoise, WorldBuilder,
};

const CONFIGS: [fn() -> CpmConfig; 2] = [CpmConfig::online, CpmConfig::robust];

/// A search that has ended.
struct Explored<'a> {
    explorer: Explorer,
    rover: PlaneWalker<'a>,
    done: Done,
}

fn explored(config: CpmConfig, world: &PlaneMaze, reckoning: Reckoning, aim: Aim) -> Explored<'_> {
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    let mut rover = PlaneWalker::new(world, WalkerNoise::NONE, reckoning);
    let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
    let done = pursue(&mut explorer, &mut rover, aim, &mut rng);
    Explored {
        explorer,
        rover,
        done,
    }
}

fn at(angle: f64) -> Point {
    Point::new(angle.cos(), angle.sin())
}

#[test]
fn a_corridor_without_junctions() {
    let mut drawing = WorldBuilder::new(dictionary());
    let start = drawing.place(Point::new(0.0, 0.0), Some(Landmark::Start));
    let end = drawing.place(Point::new(1.0, 0.0), None);
    drawing
        .corridor(start, end, &[], &[PatternId(0), PatternId(4)])
        .unwrap();
    let world = drawing.finish(start).unwrap();
    for config in CONFIGS {
        let Explored { explorer, done, .. } = explored(
            config(),
            &world,
            Reckoning::Bounded,
            Aim::Find(Landmark::Goal),
        );
        assert_eq!((done, explorer.mapper.traversals()), (Done::NotThere, 1));
        assert!(explorer.mapper.plan(Landmark::Goal).is_none());
    }
}

#[test]
fn a_ring_with_nothing_but_the_start() {
    let mut drawing = WorldBuilder::new(dictionary());
    let start = drawing.place(at(0.0), Some(Landmark::Start));
    let patterns = [0, 4, 8, 12].map(PatternId);
    drawing
        .corridor(
            start,
            start,
            &[at(0.1), at(2.0), at(4.0), at(6.1)],
            &patterns,
        )
        .unwrap();
    let world = drawing.finish(start).unwrap();
    for config in CONFIGS {
        let Explored { explorer, done, .. } = explored(
            config(),
            &world,
            Reckoning::Bounded,
            Aim::Find(Landmark::Goal),
        );
        assert_eq!(done, Done::NotThere);
        assert!(explorer.mapper.traversals() <= 3);
    }
}

#[test]
fn a_junction_of_ten_branches() {
    let mut drawing = WorldBuilder::new(dictionary());
    let middle = drawing.place(Point::new(0.0, 0.0), None);
    let mut first = None;
    for branch in 0..10 {
        let landmark = match branch {
            0 => Some(Landmark::Start),
            9 => Some(Landmark::Goal),
            _ => None,
        };
        let end = drawing.place(at(f64::from(branch) * 0.6), landmark);
        let patterns = [
            PatternId(2 * branch),
            PatternId(2 * branch + 20),
            PatternId(3),
        ];
        drawing.corridor(middle, end, &[], &patterns).unwrap();
        first.get_or_insert(end);
    }
    let world = drawing.finish(first.unwrap()).unwrap();
    for config in CONFIGS {
        let Explored {
            explorer,
            rover,
            done,
        } = explored(config(), &world, Reckoning::Bounded, Aim::Explore);
        assert_eq!(done, Done::Reached);
        assert_eq!(
            world.check(explorer.mapper.map(), explorer.mapper.at(), rover.at()),
            MapCheck::Right
        );
        assert_eq!(explorer.mapper.map().fragments().len(), 10);
    }
}

#[test]
fn a_goal_walled_off() {
    let mut drawing = WorldBuilder::new(dictionary());
    let places = [
        Some(Landmark::Start),
        None,
        None,
        None,
        Some(Landmark::Goal),
        None,
    ];
    let places: Vec<u32> = (0..)
        .zip(places)
        .map(|(number, landmark)| drawing.place(at(f64::from(number)), landmark))
        .collect();
    for (from, to, pattern) in [(0, 1, 0), (1, 2, 6), (1, 3, 12), (4, 5, 18)] {
        let patterns = [PatternId(pattern), PatternId(pattern + 2)];
        drawing
            .corridor(places[from], places[to], &[], &patterns)
            .unwrap();
    }
    let world = drawing.finish(places[0]).unwrap();
    for config in CONFIGS {
        let Explored { explorer, done, .. } =
            explored(config(), &world, Reckoning::None, Aim::Find(Landmark::Goal));
        assert_eq!(done, Done::NotThere);
        assert!(explorer.mapper.map().is_explored() && !explorer.mapper.map().is_complete());
    }
}

#[test]
fn walks_that_cannot_have_been() {
    let dictionary = dictionary();
    assert_eq!(
        Explorer::new(CpmConfig::online(), Sighting::plain(0)).err(),
        Some(CpmError::NoPorts)
    );
    assert!(Explorer::new(CpmConfig::online(), Sighting::plain(u32::MAX)).is_err());
    for config in CONFIGS {
        let mut explorer = Explorer::new(config(), Sighting::plain(3)).unwrap();
        let walk = |patterns: &[u32], degree| Traversal {
            patterns: patterns.iter().copied().map(PatternId).collect(),
            motion: None,
            sighting: Sighting::plain(degree),
            bearings: None,
        };
        let refused = explorer
            .mapper
            .arrive(Turn(3), &walk(&[1, 2], 3), &dictionary);
        assert!(matches!(refused, Err(CpmError::Turn(_))));
        let refused = explorer
            .mapper
            .arrive(Turn(1), &walk(&[1, 40], 3), &dictionary);
        let unknown = DictionaryError::UnknownPattern {
            pattern: PatternId(40),
            patterns: 40,
        };
        assert_eq!(refused, Err(CpmError::Dictionary(unknown)));
        assert_eq!(
            explorer
                .mapper
                .arrive(Turn(1), &walk(&[1, 2], 0), &dictionary),
            Err(CpmError::NoPorts)
        );
        assert!(explorer.mapper.turned_back(Turn(3), 1).is_err());
        assert_eq!(explorer.mapper.map().fragments().len(), 0);
        explorer
            .mapper
            .arrive(Turn(1), &walk(&[1, 2], 3), &dictionary)
            .unwrap();
        // A fragment too short to observe anything is a fragment.
        explorer
            .mapper
            .arrive(Turn(1), &walk(&[], 3), &dictionary)
            .unwrap();
        assert_eq!(explorer.mapper.map().fragments().len(), 2);
    }
}

#[test]
fn more_bearings_than_ports() {
    let mut dictionary = Dictionary::new(1);
    let wall = dictionary.learn(&[1.0], &[1.0], 0.1).unwrap();
    let mut explorer = Explorer::new(CpmConfig::robust(), Sighting::plain(1)).unwrap();
    let walk = Traversal {
        patterns: vec![wall],
        motion: None,
        sighting: Sighting::plain(3),
        bearings: Some(Bearings::of_directions(&[0.0, 1.0]).unwrap()),
    };
    let refused = explorer.arrive(Turn::BACK, &walk, &dictionary);
    let expected = CpmError::Bearings {
        bearings: 2,
        degree: 3,
    };
    assert_eq!(refused, Err(expected));
    assert_eq!(explorer.mapper.map().fragments().len(), 0);
}

#[test]
fn dictionaries_of_another_robot_or_version() {
    let walk = |pattern: u32| Traversal {
        patterns: [pattern, pattern].map(PatternId).to_vec(),
        motion: None,
        sighting: Sighting::plain(3),
        bearings: None,
    };
    let mut dictionary = Dictionary::new(2);
    let one = dictionary.learn(&[1.0, 0.0], &[0.0, 1.0], 0.1).unwrap();
    let early = dictionary.clone();
    let mut explorer = Explorer::new(CpmConfig::online(), Sighting::plain(3)).unwrap();
    explorer
        .mapper
        .arrive(Turn(1), &walk(one.0), &dictionary)
        .unwrap();
    // It learns on, and what it has written stays readable.
    let more = dictionary.learn(&[5.0, 5.0], &[5.0, 5.0], 0.1).unwrap();
    explorer
        .mapper
        .arrive(Turn(1), &walk(more.0), &dictionary)
        .unwrap();
    assert_eq!(dictionary.check_version(early.version()), Ok(()));
    // The early one does not know enough, another robot's says other things.
    assert!(explorer.arrive(Turn(1), &walk(0), &early).is_err());
    let mut foreign = Dictionary::new(2);
    for feature in 0..3 {
        foreign
            .learn(&[f64::from(feature), 7.0], &[f64::from(feature), 7.0], 0.1)
            .unwrap();
    }
    let refused = explorer.arrive(Turn(1), &walk(0), &foreign);
    assert!(matches!(
        refused,
        Err(CpmError::Dictionary(
            DictionaryError::OtherDictionary { .. }
        ))
    ));
    assert!(explorer.mapper.optimize(&foreign).is_err());
    assert!(
        dictionary
            .learn(&[f64::NAN, 0.0], &[0.0, 0.0], 0.1)
            .is_err()
    );
    assert!(dictionary.learn(&[0.0], &[0.0], 0.1).is_err());
    assert!(
        dictionary
            .learn(&[0.0, 0.0], &[0.0, 0.0], f64::NAN)
            .is_err()
    );
    assert!(
        Dictionary::from_prototypes(1, &[(vec![0.0], PatternId(1)), (vec![1.0], PatternId(1))])
            .is_err()
    );
    assert_eq!(dictionary.len(), 3);
}

#[test]
fn drawings_and_mazes_that_are_none() {
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    let wrong: [fn(&mut MazeConfig); 4] = [
        |maze| maze.columns = 1,
        |maze| maze.loops = f64::NAN,
        |maze| maze.patterns = 0,
        |maze| maze.observations_per_cell = f64::INFINITY,
    ];
    for spoil in wrong {
        let mut maze = MazeConfig::small();
        spoil(&mut maze);
        assert!(matches!(
            PlaneMaze::random(&maze, &mut rng),
            Err(MazeConfigError::OutOfRange { .. })
        ));
    }
    let mut alike = MazeConfig::small();
    alike.patterns = 2;
    alike.observations_per_cell = 1.0;
    assert!(matches!(
        PlaneMaze::random(&alike, &mut rng),
        Err(MazeConfigError::NotDistinctive { .. })
    ));
    let mut drawing = WorldBuilder::new(dictionary());
    let place = drawing.place(at(0.0), None);
    assert!(drawing.corridor(place, 7, &[], &[]).is_err());
    assert!(
        drawing
            .corridor(place, place, &[Point::new(f64::NAN, 0.0)], &[])
            .is_err()
    );
    assert_eq!(
        drawing.clone().finish(3).err(),
        Some(PlaneMazeError::NoSuchPlace { place: 3, count: 1 })
    );
    assert_eq!(
        drawing.finish(place).err(),
        Some(PlaneMazeError::Isolated { place })
    );
}

#[test]
fn memories_of_nothing() {
    let dictionary = dictionary();
    let mut environments = Environments::new(&dictionary).unwrap();
    assert_eq!(
        environments.recall(&[PatternId(0)], &dictionary),
        Err(RecallError::NothingLearned)
    );
    let explorer = Explorer::new(CpmConfig::online(), Sighting::plain(1)).unwrap();
    assert_eq!(
        environments.learn(0, explorer.mapper.map(), &[], &dictionary),
        Err(RecallError::TooShort)
    );
    assert!(environments.recall(&[], &dictionary).is_err());
    assert!(environments.recall(&[PatternId(99)], &dictionary).is_err());
    assert!(Environments::new(&Dictionary::new(0)).is_err());
}
