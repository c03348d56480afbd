//! Programs of others as contestants: what they do wrong has a name, an end, and no reader to harm.

use core::time::Duration;
use std::io::Write;
use std::process::Command;
use std::time::Instant;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::contest::{Claim, Condition, Contest, ContestRecord, LocateOutcome};
use tolman_arena::family::Family;
use tolman_arena::foreign::{Budget, ForeignEntry, Log, Role};
use tolman_arena::registry::Schooling;
use tolman_maze::Maze;

/// A program that answers all that it is asked; a fault goes in the place of `pass`.
const PROGRAM: &str = r#"
import json, os, sys, time

sys.stdin.readline()
for line in sys.stdin:
    told, answer = json.loads(line), {}
    if "belief" in told["ask"]:
        answer["belief"] = [{"place": 0}]
    if "map" in told["ask"]:
        answer["map"] = {"places": [{"id": 0}, {"id": 1}], "links": [[0, 1]]}
    reply = {"answer": answer}
    if "sensing" in told:
        reply.update({"turn": 0.3, "translate": 0.1})
    pass
    print(json.dumps(reply), flush=True)
"#;

/// The mapper of the guide.
const MAPPER: &str = include_str!("mapper.py");

/// Time for which a program may keep its robot waiting, s.
const PATIENCE: u64 = 2;

fn has_python() -> bool {
    let is_there = Command::new("python3").arg("-V").output().is_ok();
    if !is_there {
        // Past the test harness, which would keep it to itself.
        let _ = std::io::stderr().write_all(b"SKIPPED: python3 is not there\n");
    }
    is_there
}

fn drawn(family: &str, seed: u64) -> Maze {
    let families = Family::all();
    let family = Family::named(&families, family).unwrap();
    (family.draw)(family.sizes[0], &mut ChaCha8Rng::seed_from_u64(seed)).unwrap()
}

fn played(role: Role, program: &str, maze: &Maze) -> ContestRecord {
    let words = ["python3", "-c", program].map(str::to_owned);
    let entry = ForeignEntry {
        name: "mine.py",
        words: words.to_vec(),
        role,
        keeper: Vec::new(),
        log: Log::Dropped,
        budget: Budget {
            time: Duration::from_secs(PATIENCE),
            line_bytes: 1 << 20,
            ..Budget::default()
        },
    };
    let contest = Contest {
        contestant: Box::leak(Box::new(entry)),
        robot: None,
        maze,
        name: "star",
        condition: Condition::AsMade,
        starts: 1,
        seed: 3,
        stopwatch: None,
    };
    contest.play(&Schooling::default(), |_, _| {}).unwrap()
}

/// Plays the program with a fault, and asks for a complaint with these words in bounded time.
fn fails(role: Role, fault: &str, words: &str) -> ContestRecord {
    let program = PROGRAM.replace("pass", fault);
    let began = Instant::now();
    let record = played(role, &program, &drawn("star", 1));
    let complaint = record.complaint().unwrap_or("none");
    assert!(complaint.contains(words), "{fault}: {complaint}");
    assert!(began.elapsed() < Duration::from_secs(30), "{fault}");
    record
}

#[test]
fn what_a_program_does_wrong_is_named() {
    if !has_python() {
        return;
    }
    for role in [Role::Mapper, Role::Brain] {
        for (fault, words) in [
            ("sys.exit(3)", "ended with exit status: 3"),
            ("time.sleep(60)", "out of time"),
            ("time.sleep(0.7)", "out of time"),
            ("print(json.dumps(reply), flush=True)", "answers twice"),
            ("print('left', flush=True); continue", "`left`"),
            ("print('[]', flush=True); continue", "`[]`"),
            ("del reply['answer']", "has no `answer`"),
            ("answer['believe'] = 1", "believe"),
            (
                "answer['belief'] = [{}]",
                "needs one of `place` and `point`",
            ),
            (
                "answer['belief'] = [{'place': 0, 'weight': 2}]",
                "weights are from 0 to 1",
            ),
            ("answer['belief'] = [{'point': [1e999, 0]}]", "Infinity"),
        ] {
            let record = fails(role, fault, words);
            let learned = record.learned.unwrap();
            assert_eq!(learned.claim, Claim::Wrong, "{fault}");
            assert!(
                !learned.judgement.is_right && learned.places == 0,
                "{fault}"
            );
            assert!(!record.found[0].is_right(), "{fault}");
        }
    }
}

#[test]
fn a_map_that_is_none_is_named() {
    if !has_python() {
        return;
    }
    let of_map = |fault: &str| format!("if 'map' in answer: {fault}");
    for (fault, words) in [
        ("sys.exit(4)", "ended with exit status: 4"),
        (
            "sys.stdout.write('{\"answer\": {\"map\": {\"links\": [], \"places\": ['); [sys.stdout.write('{\"id\": %d}, ' % i) for i in range(10**9)]",
            "a line that is too long",
        ),
        (
            "answer['map']['links'].append([1, 7])",
            "link 1 of its map is with place 7",
        ),
        ("answer['map']['places'].append({'id': 1})", "place 1 twice"),
        ("answer['map']['places'].append({'id': -1})", "-1"),
        ("answer['map'] = {'places': []}", "links"),
        ("answer['verdict'] = {'certainty': 7}", "certainty 7"),
    ] {
        let record = fails(Role::Mapper, &of_map(fault), words);
        let learned = record.learned.unwrap();
        assert!(
            learned.places == 0 && learned.claim == Claim::Wrong,
            "{fault}"
        );
    }
}

#[test]
fn a_program_that_is_put_down_must_know_its_own_map() {
    if !has_python() {
        return;
    }
    let elsewhere = "answer.update({'belief': [{'place': 9}]} if told.get('put_down') else {})";
    let record = fails(Role::Mapper, elsewhere, "believes to be at place 9");
    // What it learned before stands.
    assert_eq!(record.learned.unwrap().places, 2);
    let unsure = "answer.update({'belief': []} if told.get('task') == 'localize' else {})";
    fails(Role::Mapper, unsure, "does not say where it is");
}

#[test]
fn a_verdict_is_optional() {
    if !has_python() {
        return;
    }
    let maze = drawn("star", 1);
    for (verdict, claim, certainty) in [
        ("pass", Claim::Right, None),
        (
            "answer['verdict'] = {'certainty': 0.9}",
            Claim::Right,
            Some(0.9),
        ),
        (
            "answer['verdict'] = {'certainty': 0.2}",
            Claim::Wrong,
            Some(0.2),
        ),
        (
            "answer['verdict'] = {'doubt': 'it is dark'}",
            Claim::Wrong,
            None,
        ),
    ] {
        let verdict = format!("if 'map' in answer: {verdict}");
        let record = played(Role::Mapper, &PROGRAM.replace("pass", &verdict), &maze);
        let learned = record.learned.unwrap();
        assert_eq!(
            (learned.claim, learned.certainty),
            (claim, certainty),
            "{verdict}"
        );
    }
}

#[test]
fn the_mapper_of_the_guide_learns() {
    if !has_python() {
        return;
    }
    for (family, seed) in [("star", 11), ("ladder", 12), ("braided rooms", 13)] {
        let record = played(Role::Mapper, MAPPER, &drawn(family, seed));
        let learned = record.learned.as_ref().unwrap();
        assert!(
            learned.judgement.is_right,
            "{family}: {:?}",
            record.complaint()
        );
        assert_eq!(learned.claim, Claim::Right);
        // It watches: the way to the goal would be the driver's.
        assert!(record.homes.is_empty());
        let found = &record.found[0].outcome;
        assert!(
            matches!(found, LocateOutcome::Abstained { .. }),
            "{found:?}"
        );
    }
}
