//! Errands: deliveries from the first minute, with and without doors that move.

use tolman_arena::contest::{Condition, Contest, Errands, ErrandsRecord};
use tolman_arena::registry::{Registry, Schooling};
use tolman_maze::Maze;

/// Two loops, with a landmark in each corner of the whole.
const LOOPS: &str = "\
o---o---o---o---o---o
| 1               2 |
o   o---o   o---o   o
|   |   |   |   |   |
o   o---o   o---o   o
| 3       S       4 |
o   o---o---o---o---o
| G |   |   |   |   |
o---o---o---o---o---o
";

/// No loop.
const FORK: &str = "\
o---o---o---o---o
| 1   S       2 |
o---o   o---o---o
|   |         G |
o---o---o---o---o
";

fn maze(text: &str) -> Maze {
    tolman_maze::read(text).unwrap().maze
}

fn sent(system: &str, text: &str, condition: Condition, learns_first: bool) -> ErrandsRecord {
    let contestant = Registry::current().system(system).unwrap();
    let maze = maze(text);
    let contest = Contest {
        contestant,
        robot: None,
        maze: &maze,
        name: "loops",
        condition,
        starts: 0,
        seed: 3,
        stopwatch: None,
    };
    let errands = Errands {
        contest,
        learns_first,
    };
    errands.play(&Schooling::default(), |_, _| {}).unwrap()
}

#[test]
fn a_mapper_delivers_more_and_more_of_what_the_oracle_delivers() {
    for system in ["mslst-better", "diktiometry-better", "cpm-better"] {
        let record = sent(system, LOOPS, Condition::AsMade, false);
        assert_eq!(record.oracle.len(), 60);
        assert!((record.metres - record.oracle[59]).abs() < 1e-9);
        assert!(record.deliveries.is_sorted() && record.deliveries.last() <= Some(&record.metres));
        let rate = record.oracle_rate();
        assert!(
            (0.5..1.2).contains(&rate),
            "{system}: {rate} {:?}",
            record.given_up
        );
        assert_eq!(record, sent(system, LOOPS, Condition::AsMade, false));
    }
}

#[test]
fn chance_delivers_less() {
    let random = sent("random", LOOPS, Condition::AsMade, false);
    let better = sent("mslst-better", LOOPS, Condition::AsMade, false);
    assert!(2.0 * random.oracle_rate() < better.oracle_rate());
}

#[test]
fn doors_that_move_are_noticed() {
    let record = sent("mslst-better", LOOPS, Condition::MovingDoors, false);
    let rate = record.oracle_rate_last_third();
    assert!(rate > 0.5, "{rate} {:?}", record.given_up);
}

#[test]
fn who_learns_first_delivers_later() {
    let [at_once, later] = [false, true].map(|first| {
        let record = sent("mslst-better", LOOPS, Condition::AsMade, first);
        record.metres_until(1).unwrap()
    });
    assert!(at_once < later, "{at_once} {later}");
    let record = sent("mslst-better", LOOPS, Condition::AsMade, true);
    assert!(record.deliveries.len() > 10, "{record:?}");
}

#[test]
fn a_drawing_without_loops_has_no_doors() {
    let record = sent("mslst-better", FORK, Condition::MovingDoors, false);
    assert!(
        record
            .abstained
            .is_some_and(|why| why.contains("can be shut"))
    );
    assert!(record.deliveries.is_empty());
}

#[test]
fn a_landmark_that_no_way_leads_to_is_refused() {
    let cut_off = FORK.replacen("|   |", "| 3 |", 1);
    let maze = maze(&cut_off);
    let error = Errands::placed(&maze, 1).unwrap_err().to_string();
    assert!(error.contains("landmark 3"), "{error}");
}
