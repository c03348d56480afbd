//! Recognizes a file that was given where another kind was expected.

use anyhow::Error;
use serde_json::Value;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Maze,
    /// A map that a system has learned.
    Map,
    Trace,
    /// A world with free walls.
    World,
    /// The state of an interrupted run.
    Unfinished,
    /// A robot's log in lines of CARMEN.
    Log,
}

impl Kind {
    /// Returns the kind of a text, or `None` if it is unknown.
    fn of(text: &str) -> Option<Self> {
        // A trace has many lines; the first names its kind.
        let whole = serde_json::from_str(text).ok();
        let value: Option<Value> =
            whole.or_else(|| serde_json::from_str(text.lines().next()?).ok());
        match value {
            Some(value) => match value["format"].as_str()? {
                "tolman-map" => Some(Self::Map),
                "tolman-trace" => Some(Self::Trace),
                "tolman-world" => Some(Self::World),
                "tolman-unfinished" => Some(Self::Unfinished),
                _ => None,
            },
            None if is_log(text) => Some(Self::Log),
            None => tolman_maze::parse(text).is_ok().then_some(Self::Maze),
        }
    }

    /// Returns whether a text is of this kind, judged by its head.
    pub(super) fn is_of(self, text: &str) -> bool {
        Self::of(text) == Some(self)
    }

    /// Returns whether a text is of a known kind, and not of this one.
    pub(super) fn is_not_of(self, text: &str) -> bool {
        Self::of(text).is_some_and(|kind| kind != self)
    }

    /// Returns the kind's name and the verb that takes it.
    const fn told(self) -> &'static str {
        match self {
            Self::Maze => "a maze: give it to `tolman maze show` or to --maze",
            Self::Map => "a learned map: give it to `tolman map show` or to `tolman drive --map`",
            Self::Trace => "a trace: give it to `tolman replay`",
            Self::World => {
                "a world with free walls: give it to --world of `tolman run`, `learn` or `drive`"
            }
            Self::Unfinished => "an interrupted run: give it to --from of the verb that wrote it",
            Self::Log => "a robot's log: give it to `tolman map --log`",
        }
    }

    /// Returns the hint on how to make a file of this kind.
    const fn made(self) -> &'static str {
        match self {
            Self::Maze => "`tolman maze generate` writes a maze",
            Self::Map => "`tolman learn` writes a map",
            Self::Trace => "--trace of a verb that drives writes a trace",
            Self::World => "docs/worlds.md says how to write a world with free walls",
            Self::Unfinished => "a verb that Ctrl-C interrupts writes its run to a file",
            Self::Log => "docs/logs.md says which logs are read",
        }
    }

    /// Returns the message for a `text` that could not be read as this kind.
    ///
    /// If the text is of another known kind, the message names that kind and the verb that takes
    /// it. It also says how to make a file of the expected kind. For a text of no known kind, the
    /// message is `error` with the file's `name`.
    pub(super) fn explain(self, text: &str, name: &str, error: impl Into<Error>) -> Error {
        match Self::of(text) {
            Some(found) if found != self => {
                Error::msg(format!("{name} is {}; {}", found.told(), self.made()))
            }
            _ => error.into().context(name.to_owned()),
        }
    }
}

/// Returns whether `text` begins as a log of CARMEN does.
fn is_log(text: &str) -> bool {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let mut words = lines.take(3).filter_map(|line| line.split(' ').next());
    words.any(|word| matches!(word, "FLASER" | "ROBOTLASER1" | "ODOM" | "PARAM"))
}
