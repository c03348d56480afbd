//! A contest that is played action by action.

use tolman_arena::contest::Condition;
use tolman_arena::contest::{Contest, SteppedContest, TaskRecord};
use tolman_arena::registry::Registry;
use tolman_arena::registry::Schooling;

const STAR: &str = include_str!("../../mazes/star.maze");

#[test]
fn step_by_step_it_is_the_same_show() {
    let maze = tolman_maze::read(STAR).unwrap().maze;
    let schooling = Schooling::default();
    for contestant in Registry::current().learners() {
        let contest = Contest {
            contestant,
            robot: None,
            maze: &maze,
            name: "star",
            condition: Condition::AsMade,
            starts: 1,
            seed: 3,
            stopwatch: None,
        };
        let mut path = Vec::new();
        let shown = contest.show(&schooling, |outing, _| path = outing.path().to_vec());
        let shown = shown.unwrap();
        let mut stepped = SteppedContest::new(&contest, &schooling).unwrap();
        let finish = |stepped: &mut SteppedContest| loop {
            if let Some(record) = stepped.act() {
                assert!(!stepped.is_busy() && stepped.act().is_none());
                break record;
            }
        };
        stepped.explore();
        let learned = finish(&mut stepped);
        let told = format!("{:?}", TaskRecord::Learned(Box::new(shown.learned)));
        assert_eq!(format!("{learned:?}"), told, "{contestant:?}");
        let [here, _] = contest.put_downs()[0];
        let found = match stepped.put_down(here).unwrap() {
            Some(found) => TaskRecord::Found(found),
            None => finish(&mut stepped),
        };
        let told = format!("{:?}", TaskRecord::Found(shown.found));
        assert_eq!(format!("{found:?}"), told, "{contestant:?}");
        stepped.go_home();
        let TaskRecord::Home(home) = finish(&mut stepped) else {
            unreachable!("it went home");
        };
        assert_eq!(home.metres, shown.home, "{contestant:?}");
        assert!(stepped.outing().path() == path, "{contestant:?}");
    }
}
