use tolman_geom::Point;

use super::Mind;

/// What a mind made of its situation when it chose an action, for whoever watches; nothing of a run depends
/// on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Thought {
    /// In a few words, such as `lost`; empty if there is nothing to say.
    pub words: String,
    /// Where it believes its robot to be, the likeliest first; empty if it does not ask.
    pub guesses: Vec<Guess>,
}

/// A place where a robot may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guess {
    /// Where.
    pub place: Place,
    /// How much it is believed, 0 … 1.
    pub weight: f64,
}

/// A place as its robot knows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A point of the world, m.
    At(Point),
    /// A node of the robot's map, which need not know where it lies.
    Node(u32),
}

impl Mind {
    /// What it made of its situation when it last chose.
    #[must_use]
    pub fn thought(&self) -> Thought {
        match self {
            Self::Brain(brain) => brain.thought(),
            // It knows.
            Self::Yardstick(_) => Thought::default(),
        }
    }
}
