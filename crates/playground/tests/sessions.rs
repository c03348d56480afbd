//! Sessions as the page leads them.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use tolman_arena::contest::{Condition, Contest, Moment};
use tolman_arena::registry::{Registry, Schooling};
use tolman_maze::{Cell, Direction};
use tolman_playground::{Playground, Session, SessionState, SessionTask, Sketch, Tone};

const STAR: &str = include_str!("../mazes/star.maze");

fn star() -> Sketch {
    Sketch::read(STAR).unwrap()
}

fn finish(session: &mut Session) -> SessionState {
    loop {
        let state = session.advance(1000);
        if !state.is_busy {
            return state;
        }
    }
}

#[test]
fn however_many_steps_a_call_it_is_the_same_run() {
    let playground = Playground::default();
    let played = |steps: usize, seed: u64| {
        let mut session = playground.begin(&star(), "MSLST Better", seed).unwrap();
        let mut states = vec![session.state()];
        while states.last().is_some_and(|state| state.is_busy) {
            states.push(session.advance(steps));
        }
        (
            session.replay().unwrap(),
            session.fingerprint(),
            states.len(),
        )
    };
    let (one, many) = (played(1, 3), played(50, 3));
    assert_eq!((&one.0, &one.1), (&many.0, &many.1));
    assert!(one.2 > many.2);
    assert_ne!(one.1, played(50, 4).1);
}

#[test]
fn it_learns_what_the_arena_s_contestant_learns() {
    let sketch = star();
    let (playground, schooling) = (Playground::default(), Schooling::default());
    for system in Playground::systems() {
        let contestant = Registry::current().system(system.name).unwrap();
        let contest = Contest {
            contestant,
            robot: None,
            maze: sketch.maze(),
            name: sketch.name(),
            condition: Condition::AsMade,
            starts: 1,
            seed: 3,
            stopwatch: None,
        };
        let mut path = Vec::new();
        let shown = contest.show(&schooling, |outing, moment| {
            if moment == Moment::Over {
                path = outing.path().to_vec();
            }
        });
        let learned = shown.unwrap().learned;
        let mut session = playground.begin(&sketch, system.name, 3).unwrap();
        let state = finish(&mut session);
        let outing = session.outing();
        let steps = learned.steps as usize;
        assert_eq!(outing.path().len(), steps + 1, "{}", system.name);
        assert!(outing.path() == &path[..=steps], "{}", system.name);
        assert_eq!(outing.map().places.len(), learned.places, "{}", system.name);
        let is_good = state.tone == Tone::Good;
        assert_eq!(is_good, learned.judgement.is_right, "{}", state.told);
    }
}

#[test]
fn put_down_at_any_time_it_goes_on() {
    let playground = Playground::default();
    for system in Playground::systems() {
        for steps in [0, 30, usize::MAX] {
            let mut session = playground.begin(&star(), system.name, 1).unwrap();
            session.advance(steps);
            let start = session.outing().path()[0].position;
            let lifted = session.put_down(start.x, start.y).unwrap();
            assert_eq!(lifted.task, SessionTask::Localize);
            let found = finish(&mut session);
            assert!(found.told.starts_with("It "), "{}", found.told);
            session.go_home();
            let home = finish(&mut session);
            assert_eq!(home.task, SessionTask::Home, "{}", home.told);
            assert!(session.replay().unwrap().contains("tolman-replay"));
        }
    }
}

#[test]
fn the_better_mslst_maps_the_demo_finds_itself_and_comes_home() {
    let demo = Sketch::read(include_str!("../mazes/demo.maze")).unwrap();
    let playground = Playground::default();
    let mut session = playground.begin(&demo, "mslst-better", 8).unwrap();
    assert!(session.state().told.contains("explores"));
    for (go_on, told) in [
        (None, "The map is right"),
        (Some(true), "It found out where it is"),
        (Some(false), "It is at the goal"),
    ] {
        match go_on {
            Some(true) => assert!(session.put_down(2.5, 2.5).unwrap().is_busy),
            Some(false) => assert!(session.go_home().is_busy),
            None => {}
        }
        let state = finish(&mut session);
        assert_eq!(state.tone, Tone::Good, "{}", state.told);
        assert!(state.told.contains(told), "{}", state.told);
    }
}

#[test]
fn who_cannot_work_there_says_why() {
    let playground = Playground::default();
    let told = |sketch: &Sketch, system| {
        let refused = playground.begin(sketch, system, 1).map(|_| ());
        refused.unwrap_err().to_string()
    };
    let empty = Sketch::empty(5);
    assert!(told(&empty, "CPM").contains("open square"));
    assert!(told(&empty, "Random").contains("no system"));
    let mut walled = Sketch::empty(5);
    let goal = Cell::new(4, 4);
    for side in [Direction::South, Direction::West] {
        walled.set_wall(goal, side, true);
    }
    assert!(told(&walled, "MSLST Better").contains("no robot"));
}
