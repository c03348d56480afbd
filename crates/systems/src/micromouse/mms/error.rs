use thiserror::Error;
use tolman_maps::wall_map::{ObserveError, TooLarge};

/// Reason why a mouse cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlayError {
    /// The simulator has closed its end.
    #[error("the simulator went away and left `{command}` without a reply")]
    HostGone {
        /// The last command.
        command: String,
        /// Reason, if the pipe gives one.
        source: Option<std::io::Error>,
    },
    /// The simulator's reply is not one that it can give.
    #[error("the simulator replied {reply:?} to `{command}`: {expected} was expected")]
    Reply {
        /// Command that was sent.
        command: String,
        /// Reply of the simulator.
        reply: String,
        /// Possible answers.
        expected: &'static str,
    },
    /// The maze is larger than the mouse's map.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The readings contradict known walls.
    #[error("the reading contradicts the mouse's map")]
    Observe(#[from] ObserveError),
    /// No way leads to the goal.
    #[error("the mouse has found that no way leads to the goal: open a wall")]
    NoWay,
    /// The mouse runs into walls that it does not see, or its reset button is pressed forever.
    #[error(
        "the mouse crashed or was reset {times} times: make walls stand where the simulator says they do, and press \
         reset less often"
    )]
    SentBack {
        /// Number of crashes and resets.
        times: u32,
    },
    /// The log cannot be written.
    #[error("the mouse's log cannot be written")]
    Log(#[source] std::io::Error),
}
