//! Surveys of offices by the diktiometry.

use alloc::sync::Arc;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::diktiometry::{
    EpuckSurveyConfig, Office, OfficeConfig, Survey, SurveyConfig, blocks, survey_maze,
};
use tolman_maps::diktiometry::{Apart, Config, WorldKind};
use tolman_systems::stream;

fn office(side: u16, doorway_share: f64, colours: u32) -> Arc<Office> {
    let maze = blocks(side, 0.3, &mut ChaCha8Rng::seed_from_u64(1));
    let mut config = OfficeConfig::bare();
    config.doorway_share = doorway_share;
    config.colours = colours;
    Arc::new(Office::new(&maze, &config).unwrap())
}

fn run(office: &Arc<Office>, config: &SurveyConfig, seed: u64) -> Survey {
    Survey::run(office, config.clone(), seed, |_, _| Ok(())).unwrap()
}

#[test]
fn what_is_certain_is_never_confused_where_all_places_look_alike() {
    let office = office(4, 0.0, 1);
    let mut config = SurveyConfig::paper(&office, 150);
    config.heed = 0.3;
    for seed in 0..3 {
        let run = run(&office, &config, seed);
        let score = run.score();
        assert!((score.purity - 1.0).abs() < 1e-12, "{score:?}");
        assert!((score.link_precision - 1.0).abs() < 1e-12, "{score:?}");
        assert!((score.gone_recall - 1.0).abs() < 1e-12, "{score:?}");
        assert!(2 * score.places < run.sites().len(), "{score:?}");
    }
}

/// Without this knowledge the walk ends with many places for each true one.
#[test]
fn a_map_in_which_all_places_look_alike_is_folded_even_where_walls_may_move() {
    let maze = blocks(5, 0.25, &mut stream(1002, 20));
    let office = Arc::new(Office::new(&maze, &OfficeConfig::bare()).unwrap());
    let mut config = SurveyConfig::paper(&office, 700);
    config.heed = 0.3;
    let score = run(&office, &config, 1002).score();
    assert!(score.is_isomorphic, "{score:?}");
    config.mapper.actions = Config::compass_actions();
    config.mapper.apart = Apart::Distance;
    config.mapper.world = WorldKind::Changing;
    let score = run(&office, &config, 1002).score();
    assert!(score.is_isomorphic, "{score:?}");
}

#[test]
fn places_may_be_far_apart_and_walls_painted() {
    let file = tolman_maze::read(include_str!("../../mazes/j-long.maze")).unwrap();
    let mut furniture = OfficeConfig::bare();
    furniture.colours = 6;
    let office = Arc::new(Office::new(&file.maze, &furniture).unwrap());
    let config = SurveyConfig::paper(&office, 30);
    let score = run(&office, &config, 1).score();
    assert_eq!((score.places, score.visited), (5, 5), "{score:?}");
}

#[test]
fn the_same_seed_makes_the_same_run_and_the_moves_of_doors_are_part_of_it() {
    let office = office(4, 0.5, 6);
    let mut config = SurveyConfig::paper(&office, 120);
    config.door_period = 10;
    let [one, again, other] = [1, 1, 2].map(|seed| run(&office, &config, seed));
    assert_eq!(one.sites(), again.sites());
    assert_eq!(one.observer(), again.observer());
    assert_ne!(one.sites(), other.sites());
    config.door_period = 0;
    let still = run(&office, &config, 1);
    assert_ne!(one.observer(), still.observer(), "no doorway was shut");
}

#[test]
fn the_first_maze_is_mapped_place_by_place() {
    let text = include_str!("../../mazes/cpm-1.maze");
    let maze = tolman_maze::read(text).unwrap().maze;
    let config = EpuckSurveyConfig::usual(30);
    let survey = survey_maze(&maze, 0.25, &config, 1).unwrap();
    assert_eq!((survey.moves, survey.trouble), (30, None));
    assert_eq!(survey.bounded, 30, "odometry's bounds hold");
    assert!(survey.score.is_isomorphic, "{:?}", survey.score);
}
