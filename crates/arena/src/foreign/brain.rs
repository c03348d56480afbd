//! Lets a foreign program drive a robot, by lines of JSON.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use alloc::fmt;
use core::cell::{RefCell, RefMut};
use core::convert::Infallible;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use thiserror::Error;
use tolman_robot::{Guess, MapView, Mapper, SensesLandmarks, Standing, System, Task, VisitNaming};

use super::talk::{Talk, quoted};
use super::{Budget, Launch, LaunchError, Overrun};
use crate::BoxError;
use crate::named_map::NamedError;

/// First message to a foreign brain.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hello {
    /// The robot's name.
    pub robot: String,
    /// Radius of the robot's body, m.
    pub radius: f64,
    /// Duration of a time step, µs.
    pub step_us: u64,
    /// Maximum number of time steps; `None` where each task has its own.
    pub step_limit: Option<u32>,
    /// The distance between the faces of a corridor's walls, m.
    pub corridor_width: f64,
}

/// A program of its own, in any language, that learns a map of a robot's world. `D` drives the
/// robot. A program that ends, or uses up its [`Budget`], has given up. After that, and after an
/// error, it is heard no more, and gives up every task.
pub struct Foreign<D> {
    pub(super) talk: RefCell<Talk>,
    pub(super) driver: D,
}

/// A program that drives its robot.
///
/// It gets a line `{"hello": …}` with [`Hello`] and the version of the protocol. Then it gets one
/// line for each time step: `{"step": 0, "sensing": …, "landmark": null}`, with the robot's sensing
/// and the landmark that it senses. It answers each line but the first with one line. An answer is
/// a command of the robot, such as `{"turn": 0.1, "translate": 0.5}`; `{"done": true}` when the
/// task is done; or `{"give_up": "why"}`.
///
/// One that [learns](Self::learning) is also told its task, and asked for its map and belief; the
/// page `docs/brain.md` has these lines.
pub type ForeignBrain = Foreign<Itself>;

/// The driver of a program that drives its robot.
#[derive(Clone, Copy, Debug)]
pub struct Itself;

/// Reason why a foreign brain cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BrainError {
    /// The program does not start.
    #[error(transparent)]
    Launch(#[from] LaunchError),
    /// The program used up its budget.
    #[error(transparent)]
    Overrun(Overrun),
    /// The program has ended.
    #[error("{0}")]
    Ended(String),
    /// The program's map or belief cannot be one.
    #[error(transparent)]
    Map(#[from] NamedError),
    /// A line from the program is no JSON.
    #[error("the program's answer to step {step} is `{line}`, which is no JSON: {source}")]
    Json {
        /// Number of the time step, from 0.
        step: u32,
        /// The line, or its beginning.
        line: String,
        /// Error of the JSON reader.
        source: serde_json::Error,
    },
    /// The program wrote a line to which there was no question.
    #[error("before step {step} the program answers twice, `{line}`; write one line per answer")]
    Twice {
        /// Number of the time step, from 0.
        step: u32,
        /// The line, or its beginning.
        line: String,
    },
    /// The program does not answer what it was asked.
    #[error("the program was asked at step {step}, and its line `{line}` has no `answer`")]
    NoAnswer {
        /// Number of the time step, from 0.
        step: u32,
        /// The line, or its beginning.
        line: String,
    },
    /// The program's answer is not in the form that was asked for.
    #[error("the program's answer at step {step} is `{line}`: {source}")]
    Asked {
        /// Number of the time step, from 0.
        step: u32,
        /// The answer, or its beginning.
        line: String,
        /// Error of the JSON reader.
        source: serde_json::Error,
    },
    /// The task has no name in the protocol.
    #[error("the protocol has no name for the task")]
    Task,
    /// A line from the brain is not an answer.
    #[error(
        "the brain's answer to step {step} is `{line}`: answer with a command as this robot has it, \
         {{\"done\": true}} or {{\"give_up\": \"why\"}}"
    )]
    Answer {
        /// Number of the time step, from 0.
        step: u32,
        /// The line, or its beginning.
        line: String,
        /// Error of the JSON reader.
        source: serde_json::Error,
    },
    /// The robot's readings have no JSON form.
    #[error("what the robot sensed at step {step} cannot be written")]
    Sensing {
        /// Number of the time step, from 0.
        step: u32,
        /// Error of the JSON writer.
        source: serde_json::Error,
    },
    /// The robot failed.
    #[error("the robot refuses the brain's answer to step {step}; correct the answer")]
    Robot {
        /// Number of the time step, from 0.
        step: u32,
        /// Reason why the robot refuses the answer.
        source: BoxError,
    },
}

/// Answer of a brain.
#[derive(Deserialize)]
#[serde(untagged)]
enum Answer<C> {
    End(End),
    Command(C),
}

/// Reason for which a brain ends its task.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum End {
    Done(bool),
    GiveUp(String),
}

impl ForeignBrain {
    /// Starts a program to drive the robot of `hello`.
    ///
    /// # Errors
    /// As [`ForeignProgram::start`](super::ForeignProgram::start).
    pub fn start(launch: &Launch<'_>, budget: Budget, hello: Hello) -> Result<Self, LaunchError> {
        Self::driven(launch, budget, hello, false, Itself)
    }

    /// Starts a program to drive the robot of `hello`, and to learn a map, for which it is asked.
    ///
    /// # Errors
    /// As [`start`](Self::start).
    pub fn learning(
        launch: &Launch<'_>,
        budget: Budget,
        hello: Hello,
    ) -> Result<Self, LaunchError> {
        Self::driven(launch, budget, hello, true, Itself)
    }
}

impl<D> Foreign<D> {
    pub(super) fn driven(
        launch: &Launch<'_>,
        budget: Budget,
        hello: Hello,
        learns: bool,
        driver: D,
    ) -> Result<Self, LaunchError> {
        let talk = RefCell::new(Talk::start(launch, budget, hello, learns)?);
        Ok(Self { talk, driver })
    }

    /// Returns whether a program that was put down can go on.
    pub(super) fn goes_on(&mut self) -> Standing {
        let talk = self.talk.get_mut();
        talk.put_down();
        match &talk.failed {
            Some(why) => Standing::gave_up(why),
            None => Standing::UnderWay,
        }
    }

    /// Returns how a program's task stands after an action. When it has ended, the program gives
    /// its map.
    pub(super) fn ended(&mut self, standing: Standing) -> Standing {
        if standing == Standing::UnderWay {
            return standing;
        }
        let talk = self.talk.get_mut();
        talk.refresh();
        match &talk.failed {
            Some(why) => Standing::gave_up(why),
            None => standing,
        }
    }

    /// Returns how a program's task stands after an error. It is heard no more.
    pub(super) fn failed(&mut self, error: BrainError) -> Result<Standing, BrainError> {
        match &error {
            // Who runs it sees that flag, too.
            BrainError::Overrun(Overrun::Stop) => return Ok(Standing::UnderWay),
            // The robot may be out of time.
            BrainError::Robot { .. } => {}
            _ => self.talk.get_mut().fail(&error),
        }
        match error {
            BrainError::Overrun(_) | BrainError::Ended(_) => {
                Ok(Standing::gave_up(error.to_string()))
            }
            error => Err(error),
        }
    }

    /// Returns what the program was last asked for, and is asked for again if it has learned since.
    fn asked(&self) -> RefMut<'_, Talk> {
        let mut talk = self.talk.borrow_mut();
        talk.refresh();
        talk
    }
}

impl<D> fmt::Debug for Foreign<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Foreign")
            .field("talk", &self.talk)
            .finish_non_exhaustive()
    }
}

impl<D> Mapper for Foreign<D> {
    type Observation = ();
    type Error = Infallible;

    fn observe(&mut self, (): &()) -> Result<(), Infallible> {
        Ok(())
    }

    fn map(&self) -> MapView {
        self.asked().map.clone()
    }

    fn belief(&self) -> Vec<Guess> {
        self.talk.borrow().belief.clone()
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachStep
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.talk.borrow().visits()
    }

    fn visit_count(&self) -> usize {
        self.talk.borrow().visit_count()
    }

    /// Returns why the map may be wrong: by the program's own account, or as it has failed.
    fn doubt(&self) -> Option<String> {
        let talk = self.asked();
        talk.failed.clone().or_else(|| talk.verdict.doubt.clone())
    }

    fn certainty(&self) -> Option<f64> {
        let talk = self.asked();
        talk.verdict.certainty.filter(|_| talk.failed.is_none())
    }
}

impl<R> System<R> for ForeignBrain
where
    R: SensesLandmarks<Sensing: Serialize, Command: DeserializeOwned, Error: Into<BoxError>>,
{
    type Failure = BrainError;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, BrainError> {
        if let Some(why) = &self.talk.get_mut().failed {
            return Ok(Standing::gave_up(why));
        }
        let acted = self.step(robot, task);
        let acted = acted.or_else(|error| self.failed(error))?;
        Ok(self.ended(acted))
    }

    fn put_down(&mut self) -> Standing {
        self.goes_on()
    }
}

impl ForeignBrain {
    /// Lets the program make one time step.
    fn step<R>(&mut self, robot: &mut R, task: Task) -> Result<Standing, BrainError>
    where
        R: SensesLandmarks<Sensing: Serialize, Command: DeserializeOwned, Error: Into<BoxError>>,
    {
        let talk = self.talk.get_mut();
        let told = talk.tell(robot.sensing(), robot.landmark(), task);
        let told = told.map_err(no_command)?;
        let step = talk.steps;
        let command: R::Command = match answer(step, told)? {
            Answer::Command(command) => command,
            Answer::End(End::Done(true)) => return Ok(Standing::Done),
            Answer::End(End::Done(false)) => return Ok(Standing::gave_up("it is not done")),
            Answer::End(End::GiveUp(why)) => return Ok(Standing::GaveUp { why }),
        };
        robot.step(&command).map_err(|error| BrainError::Robot {
            step,
            source: error.into(),
        })?;
        talk.steps += 1;
        Ok(Standing::UnderWay)
    }
}

/// Returns the error of a line that should have been a command.
fn no_command(error: BrainError) -> BrainError {
    match error {
        BrainError::Json { step, line, source } => BrainError::Answer { step, line, source },
        other => other,
    }
}

fn answer<C: DeserializeOwned>(step: u32, told: Value) -> Result<Answer<C>, BrainError> {
    let line = quoted(&told.to_string());
    serde_json::from_value(told).map_err(|source| BrainError::Answer { step, line, source })
}

#[cfg(test)]
mod tests {
    use tolman_robot::TurnTranslate;

    use super::super::talk::json;
    use super::*;

    fn read(line: &str) -> Result<Answer<TurnTranslate>, BrainError> {
        answer(3, json(3, line).map_err(no_command)?)
    }

    #[test]
    fn a_brain_answers_with_a_command_or_the_end_of_its_task() {
        let ahead = "{\"turn\": 0, \"translate\": 0.5}\n";
        assert!(matches!(read(ahead), Ok(Answer::Command(command)) if command.translate > 0.4));
        assert!(matches!(
            read(r#"{"done": true}"#),
            Ok(Answer::End(End::Done(true)))
        ));
        let why = r#"{"give_up": "it is dark"}"#;
        assert!(matches!(read(why), Ok(Answer::End(End::GiveUp(why))) if why == "it is dark"));
    }

    #[test]
    fn what_is_no_answer_is_quoted() {
        for line in ["", "ahead", r#"{"turn":0}"#, r#"{"left":1,"right":2}"#] {
            let error = read(line).err().map(|error| error.to_string());
            let error = error.unwrap_or_default();
            assert!(error.contains("to step 3 is"), "{line}: {error}");
            assert!(error.contains(line), "{line}: {error}");
        }
        let long = "x".repeat(10_000);
        assert!(read(&long).is_err_and(|error| error.to_string().len() < 300));
    }
}
