//! Tests that the systems can be sent into every family's drawings.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use tolman_arena::contest::{Condition, Contest, Moment, SteppedContest};
use tolman_arena::family::Family;
use tolman_arena::registry::{Registry, RobotEntry, Schooling};

const SEEDS: u64 = 5;

#[test]
fn every_system_can_be_sent_into_every_family_or_says_in_a_sentence_why_not() {
    let schooling = Schooling::default();
    let (mut sent, mut abstained) = (0, 0);
    for family in Family::all() {
        for size in family.sizes {
            for seed in 0..SEEDS {
                let maze = (family.draw)(size, &mut ChaCha8Rng::seed_from_u64(seed)).unwrap();
                for contestant in Registry::current().learners() {
                    let what = format!("{contestant:?} in {} {size:?} {seed}", family.name);
                    let robot = match seed % 2 {
                        0 => None,
                        _ => Some(RobotEntry::LASER_PIONEER),
                    };
                    let contest = Contest {
                        contestant,
                        robot,
                        maze: &maze,
                        name: family.name,
                        condition: Condition::AsMade,
                        starts: 1,
                        seed,
                        stopwatch: None,
                    };
                    if let Some(why) = contest.abstains() {
                        let words = why.split_whitespace().count();
                        assert!((5..25).contains(&words), "{what}: {why}");
                        assert!(!why.ends_with('.') && !why.contains(". "), "{what}: {why}");
                        abstained += 1;
                        continue;
                    }
                    let entered = SteppedContest::new(&contest, &schooling);
                    assert!(entered.is_ok(), "{what}: {:?}", entered.err());
                    sent += 1;
                }
            }
        }
    }
    assert!(sent > 1000 && abstained > 50, "{sent} {abstained}");
}

/// The arena relies on it to know where the robot truly was.
#[test]
fn better_mslst_names_a_place_for_each_time_step() {
    for condition in [
        Condition::AsMade,
        Condition::Kidnapping,
        Condition::DropOuts,
    ] {
        let family = Family::ARENA[0];
        let maze = (family.draw)(family.sizes[0], &mut ChaCha8Rng::seed_from_u64(1)).unwrap();
        let contest = Contest {
            contestant: Registry::current().system("mslst-better").unwrap(),
            robot: None,
            maze: &maze,
            name: family.name,
            condition,
            starts: 0,
            seed: 1,
            stopwatch: None,
        };
        let mut actions = 0;
        let played = contest.play(&Schooling::default(), |outing, moment| {
            if moment == Moment::Acted {
                assert_eq!(outing.visit_count(), outing.path().len());
                assert_eq!(outing.visits().len(), outing.path().len());
                actions += 1;
            }
        });
        assert!(played.is_ok() && actions > 30, "{condition:?} {actions}");
    }
}
