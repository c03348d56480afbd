//! Lets a foreign program drive a robot, by lines of JSON.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use core::convert::Infallible;
use core::time::Duration;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use thiserror::Error;
use tolman_robot::{Mapper, SensesLandmarks, Standing, System, Task};

use super::{Budget, ForeignProgram, Launch, LaunchError, Left, Overrun};
use crate::BoxError;

/// Version of the protocol that [`ForeignBrain`] speaks.
const PROTOCOL: u32 = 1;

/// Time within which a program that has closed its stdout must end.
const GRACE: Duration = Duration::from_secs(5);

/// Maximum length of a line quoted in an error, characters.
const QUOTED: usize = 80;

/// First message to a foreign brain.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hello {
    /// The robot's name.
    pub robot: String,
    /// Radius of the robot's body, m.
    pub radius: f64,
    /// Duration of a time step, µs.
    pub step_us: u64,
    /// Maximum number of time steps.
    pub step_limit: u32,
    /// The distance between the faces of a corridor's walls, m.
    pub corridor_width: f64,
}

/// A brain that is a program of its own, in any language.
///
/// It gets a line `{"hello": …}` with [`Hello`] and the version of the protocol. Then it gets one
/// line for each time step: `{"step": 0, "sensing": …, "landmark": null}`, with the robot's sensing
/// and the landmark that it senses. It answers each line but the first with one line. An answer is
/// a command of the robot, such as `{"turn": 0.1, "translate": 0.5}`; `{"done": true}` when the
/// task is done; or `{"give_up": "why"}`.
///
/// A program that ends, or uses up its [`Budget`], has given up.
#[derive(Debug)]
pub struct ForeignBrain {
    /// The running program; `None` once it has ended.
    program: Option<ForeignProgram>,
    hello: Hello,
    steps: u32,
}

/// Reason why a foreign brain cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BrainError {
    /// The program does not start.
    #[error(transparent)]
    Launch(#[from] LaunchError),
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

/// First line to a brain.
#[derive(Serialize)]
struct Greeting<'a> {
    #[serde(flatten)]
    hello: &'a Hello,
    protocol: u32,
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
    /// As [`ForeignProgram::start`].
    pub fn start(launch: &Launch<'_>, budget: Budget, hello: Hello) -> Result<Self, LaunchError> {
        Ok(Self {
            program: Some(ForeignProgram::start(launch, budget)?),
            hello,
            steps: 0,
        })
    }

    /// Sends the readings to the program, and returns its answer; `None` if it has closed its
    /// stdout.
    fn ask(&mut self, step: &Value) -> Result<Option<String>, Overrun> {
        let Some(program) = &mut self.program else {
            return Ok(None);
        };
        if self.steps == 0 {
            let greeting = Greeting {
                hello: &self.hello,
                protocol: PROTOCOL,
            };
            program.say(json!({ "hello": greeting }).to_string())?;
        }
        program.say(step.to_string())?;
        program.hear()
    }

    /// Returns the standing of a brain whose program says no more, after waiting for the program's
    /// end.
    fn left(&mut self) -> Result<Standing, LaunchError> {
        let Some(program) = self.program.take() else {
            return Ok(Standing::gave_up("the brain has ended"));
        };
        Ok(match program.left(GRACE)? {
            Left::ByItself(status) => Standing::gave_up(format!("the brain ended with {status}")),
            Left::Killed => Standing::gave_up("the brain closed its stdout and ran on"),
        })
    }
}

impl Mapper for ForeignBrain {
    type Observation = ();
    type Error = Infallible;

    fn observe(&mut self, (): &()) -> Result<(), Infallible> {
        Ok(())
    }
}

impl<R> System<R> for ForeignBrain
where
    R: SensesLandmarks<Sensing: Serialize, Command: DeserializeOwned, Error: Into<BoxError>>,
{
    type Failure = BrainError;

    fn act(&mut self, robot: &mut R, _: Task) -> Result<Standing, BrainError> {
        let step = self.steps;
        let sensing = serde_json::to_value(robot.sensing());
        let sensing = sensing.map_err(|source| BrainError::Sensing { step, source })?;
        let landmark = robot.landmark();
        let told = json!({ "step": step, "sensing": sensing, "landmark": landmark });
        let line = match self.ask(&told) {
            Ok(Some(line)) => line,
            Ok(None) => return Ok(self.left()?),
            // Who runs it sees that flag, too.
            Err(Overrun::Stop) => return Ok(Standing::UnderWay),
            Err(overrun) => return Ok(Standing::gave_up(overrun.to_string())),
        };
        let command: R::Command = match answer(step, &line)? {
            Answer::Command(command) => command,
            Answer::End(End::Done(true)) => return Ok(Standing::Done),
            Answer::End(End::Done(false)) => return Ok(Standing::gave_up("it is not done")),
            Answer::End(End::GiveUp(why)) => return Ok(Standing::GaveUp { why }),
        };
        robot.step(&command).map_err(|error| BrainError::Robot {
            step,
            source: error.into(),
        })?;
        self.steps += 1;
        Ok(Standing::UnderWay)
    }
}

fn answer<C: DeserializeOwned>(step: u32, line: &str) -> Result<Answer<C>, BrainError> {
    serde_json::from_str(line).map_err(|source| BrainError::Answer {
        step,
        line: line.trim_end().chars().take(QUOTED).collect(),
        source,
    })
}

#[cfg(test)]
mod tests {
    use tolman_robot::TurnTranslate;

    use super::*;

    fn read(line: &str) -> Result<Answer<TurnTranslate>, BrainError> {
        answer(3, line)
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
        for line in ["", "ahead", r#"{"turn": 0}"#, r#"{"left": 1, "right": 2}"#] {
            let error = read(line).err().map(|error| error.to_string());
            let error = error.unwrap_or_default();
            assert!(error.contains("to step 3 is"), "{line}: {error}");
            assert!(error.contains(line), "{line}: {error}");
        }
        let long = "x".repeat(10_000);
        assert!(read(&long).is_err_and(|error| error.to_string().len() < 300));
    }
}
