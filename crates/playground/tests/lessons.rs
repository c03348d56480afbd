//! The lessons mark right answers as right and wrong ones as wrong.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

extern crate alloc;

use alloc::collections::BTreeSet;

use tolman_maze::{Cell, Direction};
use tolman_playground::lessons::{Answer, LessonMark, mark, task_counts, view};
use tolman_playground::{PlaygroundError, SketchPlan};

use Direction::{East, North, South, West};

const RIGHT_HAND: [Direction; 4] = [East, North, West, South];

fn cells(places: &[(u16, u16)]) -> Vec<Cell> {
    places.iter().map(|(x, y)| Cell::new(*x, *y)).collect()
}

fn marked(lesson: usize, task: usize, answer: &Answer) -> LessonMark {
    mark(lesson, task, answer).unwrap()
}

fn ruled(rule: &[Direction], seed: u32) -> LessonMark {
    let rule = rule.to_vec();
    let answer = Answer {
        rule,
        seed,
        ..Answer::default()
    };
    marked(1, 1, &answer)
}

/// Returns whether the robot of a plan comes to the goal, from cell to cell, with its hand on the
/// wall: the same rule without a simulator.
fn follows(plan: &SketchPlan, rule: &[Direction]) -> bool {
    let stands = |cell: Cell, side: Direction| {
        let (cell, side) = match (side, cell.beyond(side)) {
            (South, Some(beside)) => (beside, North),
            (West, Some(beside)) => (beside, East),
            _ => (cell, side),
        };
        let mut walls = plan.walls.iter();
        let wall = walls.find(|wall| wall.cell == [cell.x, cell.y] && wall.side == side);
        wall.is_none_or(|wall| wall.stands)
    };
    let [x, y] = plan.start.unwrap();
    let (mut at, mut heading) = (Cell::new(x, y), North);
    let mut seen = BTreeSet::new();
    while !plan.goals.contains(&[at.x, at.y]) {
        let sides = rule.iter().map(|side| heading.turned(*side));
        let open = sides.into_iter().find(|side| !stands(at, *side));
        match open.and_then(|side| Some((side, at.beyond(side)?))) {
            Some(next) if seen.insert((at, heading)) => (heading, at) = next,
            _ => return false,
        }
    }
    true
}

#[test]
fn every_task_is_seen_and_an_empty_answer_never_passes() {
    assert_eq!(task_counts(), [1, 2, 2, 2, 2]);
    for (lesson, tasks) in (1..).zip(task_counts()) {
        for task in 1..=tasks {
            let empty = Answer::default();
            let seen = view(lesson, task, &empty).unwrap();
            assert!(seen.plan.width >= 5, "{lesson}.{task}");
            let mark = marked(lesson, task, &empty);
            assert!(!mark.passed && mark.told.ends_with('.'), "{lesson}.{task}");
        }
        let beyond = mark(lesson, tasks + 1, &Answer::default());
        assert!(matches!(beyond, Err(PlaygroundError::Task { .. })));
    }
    assert!(view(0, 1, &Answer::default()).is_err());
}

#[test]
fn of_all_orders_of_the_sides_only_the_wall_followers_arrive() {
    let plan = view(1, 1, &Answer::default()).unwrap().plan;
    let mut arrived = Vec::new();
    for number in 0..256 {
        let rule: Vec<Direction> = (0..4)
            .map(|line| Direction::ALL[number >> (2 * line) & 3])
            .collect();
        let is_order = rule.iter().collect::<BTreeSet<_>>().len() == 4;
        // Of the other rules a few are enough: each takes a run.
        if is_order || number % 16 == 0 {
            let mark = ruled(&rule, 1);
            assert_eq!(
                mark.passed,
                follows(&plan, &rule),
                "{rule:?}: {}",
                mark.told
            );
            assert!(mark.replay.is_some());
            if mark.passed {
                arrived.push(rule);
            }
        }
    }
    let left_hand = vec![West, North, East, South];
    assert_eq!(arrived.len(), 2, "{arrived:?}");
    assert!(arrived.contains(&RIGHT_HAND.to_vec()) && arrived.contains(&left_hand));
}

#[test]
fn a_wall_follower_passes_whatever_mazes_are_drawn() {
    for seed in 0..20 {
        let mark = ruled(&RIGHT_HAND, seed);
        assert!(mark.passed, "{seed}: {}", mark.told);
    }
}

#[test]
fn islands_are_marked_as_the_same_rule_ends_from_cell_to_cell() {
    for (task, arrival_passes) in [(1, false), (2, true)] {
        let mut passed = 0;
        let plan = view(2, task, &Answer::default()).unwrap().plan;
        assert_ne!(follows(&plan, &RIGHT_HAND), arrival_passes);
        for wall in plan.walls.iter().filter(|wall| !wall.is_border) {
            let [x, y] = wall.cell;
            let walls = vec![(Cell::new(x, y), wall.side)];
            let answer = Answer {
                walls,
                ..Answer::default()
            };
            let mark = marked(2, task, &answer);
            let changed = view(2, task, &answer).unwrap().plan;
            let is_asked_for = wall.stands != arrival_passes && changed.fault.is_none();
            let ends_so = follows(&changed, &RIGHT_HAND) == arrival_passes;
            assert_eq!(
                mark.passed,
                is_asked_for && ends_so,
                "{wall:?}: {}",
                mark.told
            );
            passed += usize::from(mark.passed);
        }
        assert!((3..10).contains(&passed), "task {task}: {passed} answers");
    }
}

#[test]
fn aliases_and_the_shortest_walk_between_them() {
    let alike = |places| Answer {
        cells: cells(places),
        ..Answer::default()
    };
    let all = [(2, 0), (3, 1), (0, 2)];
    let mark = marked(3, 1, &alike(&all));
    assert!(mark.passed, "{}", mark.told);
    for wrong in [&all[..2], &[(2, 0), (3, 1), (0, 2), (1, 1)]] {
        assert!(!marked(3, 1, &alike(wrong)).passed, "{wrong:?}");
    }
    let walked = |moves: &[Direction]| {
        let moves = moves.to_vec();
        let answer = Answer {
            moves,
            ..Answer::default()
        };
        marked(3, 2, &answer)
    };
    for shortest in [[North, East, East], [East, North, East]] {
        let mark = walked(&shortest);
        assert!(
            mark.passed && mark.told.contains("20 places"),
            "{}",
            mark.told
        );
        assert!(mark.told.contains("every one is right"), "{}", mark.told);
    }
    for wrong in [&[East, East][..], &[South, North, East, East]] {
        assert!(!walked(wrong).passed, "{wrong:?}");
    }
}

#[test]
fn a_lost_robot_is_found_where_it_is_and_not_before() {
    for seed in 0..10 {
        let mut answer = Answer {
            seed,
            ..Answer::default()
        };
        let all: Vec<Cell> = (0..5)
            .flat_map(|x| (0..5).map(move |y| Cell::new(x, y)))
            .collect();
        let passes = |answer: &Answer| {
            let chosen = all.iter().filter(|cell| {
                let chosen = Answer {
                    cells: vec![**cell],
                    ..answer.clone()
                };
                marked(4, 1, &chosen).passed
            });
            chosen.count()
        };
        assert_eq!(passes(&answer), 0, "nobody can know yet");
        let mut found = 0;
        for _ in 0..40 {
            let [left, ahead, right] = view(4, 1, &answer).unwrap().sight.unwrap();
            answer.moves.push(match (right, ahead, left) {
                (true, ..) => East,
                (_, true, _) => North,
                (_, _, true) => West,
                _ => South,
            });
            found = passes(&answer);
            if found > 0 {
                break;
            }
        }
        assert_eq!(found, 1, "seed {seed}: {:?}", answer.moves);
    }
}

#[test]
fn a_plan_passes_if_it_tells_all_dead_ends_apart() {
    let planned = |moves: &[Direction]| {
        let moves = moves.to_vec();
        let answer = Answer {
            moves,
            ..Answer::default()
        };
        marked(4, 2, &answer)
    };
    let mark = planned(&[South, West, North, North]);
    assert!(
        mark.passed && mark.told.contains("shortest plan has 4"),
        "{}",
        mark.told
    );
    assert!(mark.replay.is_some());
    for wrong in [&[South][..], &[North, North, North]] {
        let mark = planned(wrong);
        assert!(!mark.passed && mark.told.contains(" and "), "{}", mark.told);
    }
}

/// Cells that a mouse by flood fill enters in the fifth lesson's maze, and one that is too many.
const EXPLORED: [(u16, u16); 17] = [
    (0, 1),
    (0, 2),
    (0, 3),
    (0, 2),
    (1, 2),
    (1, 3),
    (1, 4),
    (1, 5),
    (2, 5),
    (3, 5),
    (3, 4),
    (3, 3),
    (2, 3),
    (2, 2),
    (2, 1),
    (2, 0),
    (3, 0),
];

#[test]
fn a_run_is_proven_at_one_moment() {
    for entered in 0..=EXPLORED.len() {
        let answer = Answer {
            cells: cells(&EXPLORED[..entered]),
            ..Answer::default()
        };
        let mark = marked(5, 1, &answer);
        assert_eq!(mark.passed, entered == 16, "{entered}: {}", mark.told);
        // An answer that comes too soon is shown the run that may still exist.
        assert_eq!(mark.way.len() > 1, entered < 16, "{entered}");
        let seen = view(5, 1, &answer).unwrap();
        assert!(!seen.unknown.is_empty());
        let robot = seen.robots[0].1;
        let last = EXPLORED[..entered].last().copied().unwrap_or((0, 0));
        assert_eq!((robot.x, robot.y), last, "{entered}");
    }
    // A mouse does not drive through walls.
    let answer = Answer {
        cells: cells(&[(5, 5)]),
        ..Answer::default()
    };
    assert_eq!(view(5, 1, &answer).unwrap().robots[0].1, Cell::new(0, 0));
}

#[test]
fn a_proof_passes_if_nothing_of_it_is_needless() {
    let chosen = |cells: &[Cell]| {
        let cells = cells.to_vec();
        let answer = Answer {
            cells,
            ..Answer::default()
        };
        marked(5, 2, &answer)
    };
    let mut proof: Vec<Cell> = (0..6)
        .flat_map(|x| (0..6).map(move |y| Cell::new(x, y)))
        .collect();
    let mut mark = chosen(&proof);
    assert!(
        !mark.passed && mark.told.starts_with("Proven, but"),
        "{}",
        mark.told
    );
    // The cell that is marked as needless is taken out until none is.
    while !mark.passed {
        assert_eq!(mark.way.len(), 1, "{}", mark.told);
        proof.retain(|cell| !mark.way.contains(cell));
        mark = chosen(&proof);
    }
    assert!(proof.len() < 16, "{proof:?}");
    for cell in &proof {
        let without: Vec<Cell> = proof.iter().copied().filter(|one| one != cell).collect();
        let mark = chosen(&without);
        assert!(!mark.passed && mark.way.len() > 1, "{}", mark.told);
    }
}
