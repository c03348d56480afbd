//! Experiments with doors: which way is taken, and where a robot is carried.

use tolman_arena::apparatus::{Apparatus, ApparatusKind};
use tolman_arena::contest::{Condition, Contest, ContestError, RatExperiment, RatRecord, RatStep};
use tolman_arena::registry::{Registry, Schooling};

fn try_out(
    system: &str,
    apparatus: &Apparatus,
    steps: &[RatStep],
) -> Result<RatRecord, ContestError> {
    let contest = Contest {
        contestant: Registry::current().system(system).unwrap(),
        robot: None,
        maze: &apparatus.maze,
        name: "rats",
        condition: Condition::AsMade,
        starts: 0,
        seed: 5,
        stopwatch: None,
    };
    let experiment = RatExperiment {
        contest,
        apparatus,
        steps,
    };
    experiment.play(&Schooling::default(), |_, _| {})
}

fn tried(system: &str, apparatus: &Apparatus, steps: &[RatStep]) -> RatRecord {
    try_out(system, apparatus, steps).unwrap()
}

#[test]
fn a_mapper_takes_the_shortest_path_and_comes_past_a_block() {
    let detour = Apparatus::usual(ApparatusKind::Detour);
    let steps = [
        RatStep::Explore,
        RatStep::Back,
        RatStep::ToFood,
        RatStep::Back,
        RatStep::Shut(Apparatus::BLOCK_B),
        RatStep::ToFood,
    ];
    let record = tried("mslst-better", &detour, &steps);
    let [_, before, blocked] = record.trips.as_slice() else {
        panic!("three drives, not {}", record.trips.len());
    };
    assert_eq!(record.carried, 0);
    assert_eq!(before.first_of(&detour.ways), Some(0));
    assert_eq!(before.count_of(&[detour.doors[Apparatus::BLOCK_B]]), 1);
    assert_eq!(blocked.count_of(&[detour.doors[Apparatus::BLOCK_B]]), 0);
    assert!(blocked.arrived.is_some(), "{:?}", blocked.end);
    assert!(blocked.count_of(&[detour.ways[2]]) > 0);
    assert_eq!(record, tried("mslst-better", &detour, &steps));
}

#[test]
fn one_that_learns_nothing_is_carried() {
    let detour = Apparatus::usual(ApparatusKind::Detour);
    let steps = [RatStep::Explore, RatStep::Back, RatStep::Choose];
    let record = tried("random", &detour, &steps);
    assert_eq!((record.carried, record.trips.len()), (1, 1));
    let [.., last] = record.trips[0].crossed.as_slice() else {
        panic!("it went nowhere");
    };
    assert!(detour.ways.contains(last));
}

#[test]
fn a_door_that_is_not_there_is_an_error() {
    let forks = Apparatus::usual(ApparatusKind::Forks);
    assert!(try_out("random", &forks, &[RatStep::Shut(0)]).is_err());
}
