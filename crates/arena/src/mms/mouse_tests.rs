//! The mouse of our own in the simulator.

use alloc::collections::VecDeque;
use alloc::rc::Rc;
use core::cell::RefCell;
use std::io::{self, BufReader, Read, Write};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::{Braided, Maze};
use tolman_systems::micromouse::Until;
use tolman_systems::micromouse::mms::{PlayError, Played, best_score, play};

use super::Simulator;

/// A simulator at the other end of both pipes.
struct Host<'a> {
    simulator: Simulator<'a>,
    asked: Vec<u8>,
    replies: VecDeque<u8>,
    /// Number of replies before the host goes away.
    left: usize,
    /// Change to the reply of a movement, by its number.
    meddle: fn(u64, String) -> String,
}

#[derive(Clone)]
struct Wire<'a>(Rc<RefCell<Host<'a>>>);

impl Write for Wire<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut host = self.0.borrow_mut();
        for byte in bytes {
            if *byte != b'\n' {
                host.asked.push(*byte);
                continue;
            }
            let line = String::from_utf8(core::mem::take(&mut host.asked)).unwrap();
            let reply = host.simulator.answer(&line);
            if let Some(mut reply) = reply
                && host.left > 0
            {
                host.left -= 1;
                if line.starts_with("move") {
                    reply = (host.meddle)(host.simulator.movements(), reply);
                }
                host.replies.extend(reply.bytes().chain([b'\n']));
            }
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Read for Wire<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let mut host = self.0.borrow_mut();
        let count = into.len().min(host.replies.len());
        into.iter_mut()
            .zip(host.replies.drain(..count))
            .for_each(|(into, byte)| *into = byte);
        Ok(count)
    }
}

fn maze(width: u16, height: u16, seed: u64) -> Maze {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let braided = Braided {
        width,
        height,
        share: 0.4,
    };
    braided.generate(&mut rng).unwrap()
}

fn host(maze: &Maze) -> Host<'_> {
    Host {
        simulator: Simulator::new(maze),
        asked: Vec::new(),
        replies: VecDeque::new(),
        left: usize::MAX,
        meddle: |_, reply| reply,
    }
}

fn play_with<'a>(host: Host<'a>, until: Until) -> (Result<Played, PlayError>, Simulator<'a>) {
    let wire = Wire(Rc::new(RefCell::new(host)));
    let played = play(
        BufReader::new(wire.clone()),
        wire.clone(),
        io::sink(),
        until,
    );
    let simulator = wire.0.borrow().simulator.clone();
    (played, simulator)
}

#[test]
fn the_run_is_the_best_of_all_and_scores_what_it_says() {
    for (width, height, seed) in [(16, 16, 1), (5, 8, 2), (21, 6, 3), (2, 3, 4), (1, 7, 5)] {
        let maze = maze(width, height, seed);
        let (played, simulator) = play_with(host(&maze), Until::Proof);
        let played = played.unwrap();
        assert_eq!((simulator.crashes(), simulator.invalid()), (0, 0));
        let best = simulator.score_in_half_steps().best.unwrap();
        assert!((best.turns + best.effective_distance - played.run).abs() < 1e-3);
        // As good as with all walls known.
        let optimum = best_score(&maze).unwrap().unwrap();
        assert!((optimum - played.run).abs() < 1e-3);
        assert!((played.possible - played.run).abs() < 1e-3);
    }
}

#[test]
fn less_exploration_is_cheaper_and_its_run_no_better() {
    let maze = maze(16, 16, 7);
    let [goal, proof] = [Until::Goal, Until::Proof].map(|until| {
        let (played, simulator) = play_with(host(&maze), until);
        let distance = simulator.score_in_half_steps().total.distance;
        (played.unwrap(), distance)
    });
    assert!(goal.0.run >= proof.0.run && goal.0.possible <= proof.0.possible);
    assert!(goal.1 < proof.1, "or this maze shows nothing");
}

#[test]
fn the_reset_button_is_obeyed_at_any_time() {
    let maze = maze(8, 8, 3);
    let (_, whole) = play_with(host(&maze), Until::Proof);
    for movements in (1..whole.movements()).step_by(3) {
        let mut host = host(&maze);
        host.simulator.reset_after(movements);
        let (played, simulator) = play_with(host, Until::Proof);
        assert!(simulator.score_in_half_steps().solved);
        assert_eq!((played.unwrap().resets, simulator.crashes()), (1, 0));
    }
}

#[test]
fn after_a_crash_it_goes_on_from_the_start() {
    let maze = maze(8, 8, 4);
    let mut once = host(&maze);
    once.meddle = |movement, reply| {
        if movement == 9 {
            "crash".to_owned()
        } else {
            reply
        }
    };
    let (played, simulator) = play_with(once, Until::Proof);
    let played = played.unwrap();
    assert!((played.possible - played.run).abs() < 1e-3);
    assert_eq!((played.resets, simulator.crashes()), (1, 0));
    let mut always = host(&maze);
    always.meddle = |_, _| "crash".to_owned();
    let (played, _) = play_with(always, Until::Proof);
    assert!(matches!(played, Err(PlayError::SentBack { times: 9 })));
}

#[test]
fn a_simulator_that_goes_away_is_told_of() {
    let maze = maze(4, 4, 5);
    let mut replies = 0;
    loop {
        let mut host = host(&maze);
        host.left = replies;
        match play_with(host, Until::Proof).0 {
            Ok(_) => break,
            Err(error) => assert!(matches!(error, PlayError::HostGone { .. }), "{error}"),
        }
        replies += 1;
    }
    assert!(replies > 30, "it went away {replies} times");
}
