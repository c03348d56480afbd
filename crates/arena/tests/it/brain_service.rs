//! A system as a process of its own, with a body at the other end of a pipe.

use alloc::rc::Rc;
use core::cell::RefCell;
use std::io::{self, BufRead, BufReader, Cursor, PipeReader, PipeWriter, Write};
use std::thread;

use serde_json::{Value, json};
use tolman_arena::contest::WatchedRun;
use tolman_arena::course::Course;
use tolman_arena::foreign::{NamedTask, Service, ServiceError};
use tolman_arena::pioneer::{CORRIDOR_WIDTH, calibrated, with_sensor_noise};
use tolman_arena::registry::Registry;
use tolman_robot::{LaserMeasures, Robot, RobotMeasures, SensesLandmarks, Standing, TurnTranslate};
use tolman_sim::robots::LaserPioneer;

const FORKS: &str = include_str!("../../mazes/forks.maze");

/// Output of a brain, which the test reads afterwards.
#[derive(Clone, Default)]
struct Heard(Rc<RefCell<Vec<u8>>>);

impl Write for Heard {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Heard {
    fn lines(&self) -> Vec<Value> {
        let text = String::from_utf8(self.0.borrow().clone()).unwrap();
        text.lines()
            .map(|line| serde_json::from_str(line).unwrap())
            .collect()
    }
}

fn measures() -> RobotMeasures {
    RobotMeasures::new(0.25, 0.5, LaserMeasures::all_round(8, 0.1, 4.0))
}

fn reading(time_us: u64) -> String {
    format!(
        r#"{{"sensing":{{"time_us":{time_us},"ranges":[1,1,1,1,1,1,1,1],"compass":0,"odometry":{{"distance":0,"turn":0}}}}}}"#
    )
}

/// Lets a brain explore with a body that says these lines, and returns its error with all that it
/// said.
fn fails_after(lines: &[String]) -> (ServiceError, Vec<Value>) {
    let system = Registry::current().system("mslst-better").unwrap();
    let heard = Heard::default();
    let from = Cursor::new(lines.join("\n") + "\n");
    let service = Service::new(
        system,
        measures(),
        1,
        Box::new(from),
        Box::new(heard.clone()),
    );
    let mut service = service.unwrap();
    let error = service.run(&[NamedTask::Explore]).unwrap_err();
    drop(service);
    (error, heard.lines())
}

#[test]
fn bad_input_stops_the_robot_and_is_named_by_its_line() {
    let good = || vec![reading(5), reading(6)];
    let with = |line: &str| [good(), vec![line.to_owned()]].concat();
    let cases = [
        (
            with(r#"{"sensing":{"time_us":7,"ranges":[NaN]}}"#),
            "line 3 of the body is no message",
        ),
        (
            with(r#"{"sensing":{"time_us":7,"compass":1e999}}"#),
            "line 3 of the body is no message",
        ),
        (
            with(r#"{"sensing":{"time_us":7,"ranges":[1,1,1]}}"#),
            "line 3 of the body has 3 ranges",
        ),
        (
            with(r#"{"sensing":{"time_us":7,"ranges":[1,1,-1,1,1,1,1,1]}}"#),
            "range 2 is -1 m",
        ),
        (
            with(&reading(4)),
            "line 3 of the body is from 4 µs, and the one before from 6 µs",
        ),
        (with(r#"{"speed":1}"#), "line 3 of the body is no message"),
        (good(), "end after line 2, and it owes a reading"),
        (Vec::new(), "line 1 of the body is no message"),
    ];
    for (lines, expected) in cases {
        let (error, said) = fails_after(&lines);
        assert!(error.to_string().contains(expected), "{error}");
        let [.., before, last] = said.as_slice() else {
            panic!("{said:?}");
        };
        // Its last word is to stop, and it waits for nothing after the bad line.
        assert!(last["stop"].as_str().unwrap().contains(expected), "{last}");
        assert!(before.get("go").is_some(), "{before}");
        let motions = said.iter().filter(|said| said.get("go").is_some());
        // The bad line answers the last motion.
        let answered = if lines.is_empty() { 1 } else { 3 };
        assert_eq!(motions.count(), answered, "{expected}");
    }
}

#[test]
fn a_system_without_its_senses_refuses() {
    let system = Registry::current().system("mslst").unwrap();
    let mut blind = measures();
    blind.compass_error = None;
    let heard = Heard::default();
    let from = Cursor::new("");
    let refused = Service::new(system, blind, 1, Box::new(from), Box::new(heard.clone()));
    let Err(ServiceError::Unfit { source, .. }) = refused else {
        panic!("it has no compass");
    };
    assert!(source.to_string().contains("`compass_error`"), "{source}");
    assert_eq!(heard.lines(), Vec::<Value>::new());
}

/// A simulated robot at the other end, half as large as the laser Pioneer. It writes its true path
/// and what it was told of the map, as a run to be judged.
fn body(from: PipeReader, mut to: PipeWriter) -> Value {
    let maze = tolman_maze::read(FORKS).unwrap().maze;
    let course = Course::new("forks", maze, 0.5 * CORRIDOR_WIDTH).unwrap();
    let mut config = with_sensor_noise(&calibrated(), 0.03);
    config.radius *= 0.5;
    config.translate_per_step *= 0.5;
    let model = LaserPioneer::new(config.clone()).unwrap();
    let mut robot = course.robot_at(course.start().unwrap(), model, 7).unwrap();
    let mut say = |message: Value| writeln!(to, "{message}").unwrap();
    say(json!({"task": "explore"}));
    let (mut actions, mut run) = (Vec::new(), json!({ "pitch": course.pitch() }));
    let mut motions = 0;
    for line in BufReader::new(from).lines() {
        let said: Value = serde_json::from_str(&line.unwrap()).unwrap();
        if let Some(go) = said.get("go") {
            let command = TurnTranslate {
                turn: go["turn"].as_f64().unwrap() / config.turn_per_step,
                translate: go["distance"].as_f64().unwrap() / config.translate_per_step,
            };
            robot.step(&command).unwrap();
            motions += 1;
            let sensed = robot.sensing();
            let scan = sensed.scan.as_ref().unwrap();
            let sensing = json!({
                "time_us": sensed.time_us,
                "ranges": scan.ranges,
                "compass": sensed.compass,
                "odometry": sensed.odometry,
            });
            say(json!({ "sensing": sensing, "landmark": robot.landmark(), "ask": ["standing"] }));
        } else if said.get("ended").is_some() {
            assert_eq!(said["ended"]["standing"], "done", "{said}");
            assert_eq!(said["ended"]["verdict"]["map"], "right", "{said}");
            say(json!({ "ask": ["map", "visits"] }));
        } else if let Some(answer) = said.get("answer") {
            if answer.get("map").is_some() {
                run["map"] = answer["map"].clone();
                run["visits"] = answer["visits"].clone();
                break;
            }
            let visits = &answer["standing"]["visits"];
            actions.push(json!({ "motions": motions - 1, "visits": visits, "place": null }));
        }
    }
    let path = robot.path().iter().skip(1);
    run["path"] = path
        .map(|pose| json!([pose.position.x, pose.position.y]))
        .collect();
    run["actions"] = Value::Array(actions);
    run
}

#[test]
fn a_brain_learns_a_maze_with_a_body_at_the_other_end_of_a_pipe() {
    let (from_body, to_brain) = io::pipe().unwrap();
    let (from_brain, to_body) = io::pipe().unwrap();
    let body = thread::spawn(move || body(from_brain, to_brain));
    let system = Registry::current().system("mslst-better").unwrap();
    // Its laser reaches as far as that of a Pioneer.
    let laser = LaserMeasures::all_round(72, 0.0, 1.25);
    let measures = RobotMeasures::new(0.25, 0.5 * CORRIDOR_WIDTH, laser);
    let from = Box::new(BufReader::new(from_body));
    let mut service = Service::new(system, measures, 3, from, Box::new(to_body)).unwrap();
    assert_eq!(service.run(&[]).unwrap(), Standing::Done);
    let run: WatchedRun = serde_json::from_value(body.join().unwrap()).unwrap();
    let maze = tolman_maze::read(FORKS).unwrap().maze;
    let judged = run.judge(&maze, system.facts().places).unwrap();
    assert_eq!(judged.complaint(), None);
}
