//! Lets a system drive a body that is another process, by lines of JSON.

use alloc::collections::{BTreeSet, VecDeque};
use alloc::rc::Rc;
use core::cell::RefCell;
use std::io::{BufRead, Write};

use serde_json::{Map, Value, json};
use thiserror::Error;
use tolman_robot::{
    Landmark, LaserSensing, Robot, RobotMeasures, SensesLandmarks, Standing, TurnTranslate,
};
use tolman_systems::AnyOnRobot;

use super::told::{Told, words};
use super::wire::{Message, NamedTask, Question, Wire, WireError};
use crate::BoxError;
use crate::registry::{RobotFailure, SystemEntry, SystemFacts};

/// Version of the protocol that a [`Service`] speaks.
const PROTOCOL: u32 = 1;

/// A system that drives a body in another process.
///
/// The protocol is on the page `docs/brain.md`.
pub struct Service {
    facts: SystemFacts,
    pilot: Box<dyn AnyOnRobot>,
    line: Rc<RefCell<Line>>,
    /// Number of actions made.
    actions: u64,
}

/// Reason why a service ends before its tasks do.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ServiceError {
    /// The body failed.
    #[error(transparent)]
    Wire(#[from] WireError),
    /// The system does not suit the robot.
    #[error("{system} cannot drive this robot")]
    Unfit {
        /// Name of the system.
        system: &'static str,
        /// Its reason.
        source: BoxError,
    },
    /// The system cannot go on.
    #[error("{system} cannot go on")]
    System {
        /// Name of the system.
        system: &'static str,
        /// Its reason.
        source: BoxError,
    },
}

/// What service and robot share: the wire, and what came while the robot moved.
#[derive(Debug)]
struct Line {
    wire: Wire,
    measures: RobotMeasures,
    asked: BTreeSet<Question>,
    tasks: VecDeque<NamedTask>,
    was_put_down: bool,
    /// Whether the task is to end with its action.
    is_broken_off: bool,
    /// Reason why the body cannot be driven any more; `None` if it can.
    broken: Option<WireError>,
    /// Whether the body was told to stop for good.
    is_over: bool,
}

/// The robot at the other end.
struct ForeignBody {
    line: Rc<RefCell<Line>>,
    sensing: LaserSensing,
    landmark: Option<Landmark>,
}

impl core::fmt::Debug for Service {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Service")
            .field("system", &self.facts.name)
            .finish_non_exhaustive()
    }
}

impl Service {
    /// Puts `system` on a robot of these measures, whose messages come by `from` and whose commands
    /// go by `to`. All random numbers follow from `seed`.
    ///
    /// # Errors
    /// If the system does not suit the robot, or the first line cannot be written.
    pub fn new(
        system: &dyn SystemEntry,
        measures: RobotMeasures,
        seed: u64,
        from: Box<dyn BufRead>,
        to: Box<dyn Write>,
    ) -> Result<Self, ServiceError> {
        let ring = measures.laser.ring();
        let line = Rc::new(RefCell::new(Line {
            wire: Wire::new(from, to, ring),
            measures,
            asked: BTreeSet::new(),
            tasks: VecDeque::new(),
            was_put_down: false,
            is_broken_off: false,
            broken: None,
            is_over: false,
        }));
        let body = ForeignBody {
            line: Rc::clone(&line),
            sensing: LaserSensing::silent(ring),
            landmark: None,
        };
        let facts = system.facts();
        let unfit = |source| ServiceError::Unfit {
            system: facts.name,
            source,
        };
        let put = facts.for_robot.map_err(|why| unfit(why.into()))?;
        let pilot = put(&measures, Box::new(body), seed).map_err(|error| unfit(error.into()))?;
        let hello = json!({ "hello": { "protocol": PROTOCOL, "system": facts.name } });
        line.borrow_mut().wire.say(&hello)?;
        Ok(Self {
            facts,
            pilot,
            line,
            actions: 0,
        })
    }

    /// Carries out `tasks` in turn, and returns how the last one ended. Without tasks,
    /// carries out those that the body names until its lines end.
    ///
    /// # Errors
    /// [`ServiceError`], once the body was told to stop.
    pub fn run(&mut self, tasks: &[NamedTask]) -> Result<Standing, ServiceError> {
        let done = self.carry_out(tasks);
        if let Err(error) = &done {
            let mut line = self.line.borrow_mut();
            line.is_over = true;
            let why = chain(error);
            // A body that has gone needs no word.
            let _ = line.wire.say(&json!({ "stop": why }));
        }
        done
    }

    fn carry_out(&mut self, tasks: &[NamedTask]) -> Result<Standing, ServiceError> {
        let mut last = Standing::Done;
        for task in tasks {
            last = self.task(*task)?;
        }
        if !tasks.is_empty() {
            return Ok(last);
        }
        loop {
            let next = self.line.borrow_mut().tasks.pop_front();
            if let Some(task) = next {
                last = self.task(task)?;
                continue;
            }
            let heard = self.line.borrow_mut().wire.hear()?;
            let Some(message) = heard else {
                return Ok(last);
            };
            if message.sensing.is_some() {
                let why = "a reading answers a motion, and none is due: give a task first";
                return Err(self.line.borrow().wire.out_of_turn(why).into());
            }
            self.line.borrow_mut().note(&message);
            self.between_actions(&last)?;
        }
    }

    /// Carries out one task, until it ends or the body breaks it off.
    fn task(&mut self, task: NamedTask) -> Result<Standing, ServiceError> {
        let standing = loop {
            let acted = self.pilot.act(task.task());
            self.actions += 1;
            let standing = acted.map_err(|source| self.failed(source))?;
            self.between_actions(&standing)?;
            let is_broken_off = core::mem::take(&mut self.line.borrow_mut().is_broken_off);
            if standing != Standing::UnderWay || is_broken_off {
                break standing;
            }
        };
        let (word, why) = words(&standing);
        let verdict = self.told().verdict(&standing);
        let told = json!({ "ended": { "task": task.name(), "standing": word, "why": why, "verdict": verdict } });
        self.line.borrow_mut().wire.say(&told)?;
        Ok(standing)
    }

    /// Answers what was asked, and takes in that the robot was lifted.
    fn between_actions(&mut self, standing: &Standing) -> Result<(), ServiceError> {
        let (asked, was_put_down) = {
            let mut line = self.line.borrow_mut();
            let asked = core::mem::take(&mut line.asked);
            (asked, core::mem::take(&mut line.was_put_down))
        };
        if !asked.is_empty() {
            let answers = asked.into_iter().map(|asked| self.answer(asked, standing));
            let answers: Map<String, Value> = answers.collect();
            let mut line = self.line.borrow_mut();
            line.wire.say(&json!({ "answer": answers }))?;
        }
        if was_put_down {
            self.pilot.put_down();
        }
        Ok(())
    }

    /// Returns the wire's error if it was the reason, or else the system's.
    fn failed(&self, source: BoxError) -> ServiceError {
        match self.line.borrow_mut().broken.take() {
            Some(wire) => wire.into(),
            None => ServiceError::System {
                system: self.facts.name,
                source,
            },
        }
    }

    fn answer(&self, asked: Question, standing: &Standing) -> (String, Value) {
        let told = self.told();
        let (name, answer) = match asked {
            Question::Standing => {
                let mut answer = told.standing(standing);
                answer["actions"] = self.actions.into();
                ("standing", answer)
            }
            Question::Belief => ("belief", told.belief()),
            Question::Map => ("map", told.map()),
            Question::Visits => ("visits", told.visits()),
            Question::Verdict => ("verdict", told.verdict(standing)),
        };
        (name.to_owned(), answer)
    }

    fn told(&self) -> Told<'_> {
        Told {
            facts: &self.facts,
            pilot: &*self.pilot,
        }
    }
}

/// Returns an error with its reasons in one line.
fn chain(error: &dyn core::error::Error) -> String {
    let mut told = error.to_string();
    let mut next = error.source();
    while let Some(source) = next {
        told = format!("{told}: {source}");
        next = source.source();
    }
    told
}

impl Line {
    /// Takes in all of a message but its reading.
    fn note(&mut self, message: &Message) {
        self.asked.extend(&message.ask);
        self.tasks.extend(message.task);
        self.was_put_down |= message.put_down;
        self.is_broken_off |= message.break_off;
    }

    /// Tells the body to move, and waits for its reading.
    fn moved(
        &mut self,
        command: &TurnTranslate,
    ) -> Result<(LaserSensing, Option<Landmark>), WireError> {
        if self.is_over {
            return Err(self.wire.ended());
        }
        let step = self.measures.step();
        let (turn, distance) = (command.turn * step.turn, command.translate * step.distance);
        self.wire
            .say(&json!({ "go": { "turn": turn, "distance": distance } }))?;
        loop {
            let message = self.wire.hear()?;
            let message = message.ok_or_else(|| self.wire.ended())?;
            self.note(&message);
            if let Some(reading) = message.sensing {
                return Ok((self.wire.sensed(reading), message.landmark));
            }
        }
    }
}

impl Robot for ForeignBody {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = RobotFailure;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), RobotFailure> {
        let moved = self.line.borrow_mut().moved(command);
        let (sensing, landmark) = moved.map_err(|error| {
            let told = RobotFailure(error.to_string().into());
            let mut line = self.line.borrow_mut();
            line.is_over = true;
            line.broken = Some(error);
            told
        })?;
        self.sensing = sensing;
        self.landmark = landmark;
        Ok(())
    }
}

impl SensesLandmarks for ForeignBody {
    fn landmark(&self) -> Option<Landmark> {
        self.landmark
    }
}
