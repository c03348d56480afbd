//! Tolerances: the maximum difference at which a value matches the paper's. Each kind of quantity
//! has one tolerance in all tables, with its reason.

use tolman_experiment::Tolerance;

/// Tolerance of the share of runs that arrive, or are solved.
pub(crate) const SUCCESS: Tolerance = Tolerance::absolute(
    15.0,
    "from drawing to drawing of one maze it moves by as much, and the papers' mazes are drawn again",
);

/// Tolerance of the number of time steps, and of actions, to the goal.
pub(crate) const TIME: Tolerance = Tolerance::relative(
    0.35,
    "mazes and motors are made again from pictures, and lengths known to a third",
);

/// Tolerance of the number of time steps per action.
pub(crate) const STEPS_PER_ACTION: Tolerance = Tolerance::relative(
    0.2,
    "it is the pace of the motors, to which the robot is calibrated",
);

/// Tolerance of the share that the second episode saves.
pub(crate) const SAVED: Tolerance = Tolerance::absolute(
    15.0,
    "the ways of a maze that is drawn again have other lengths",
);

/// Tolerance of the number of states, units and clusters of a quantizer.
pub(crate) const PROTOTYPES: Tolerance = Tolerance::factor(
    1.5,
    "they vary by a quarter from walk to walk, and follow parameters that no source gives",
);

/// Tolerance of counts for which one more is a different result.
pub(crate) const COUNTED: Tolerance =
    Tolerance::absolute(0.5, "the next number is another outcome");

/// Tolerance of the number of steps of a micromouse's second run.
pub(crate) const MOVES: Tolerance = Tolerance::relative(
    0.15,
    "the paper does not say how ties between ways are broken",
);

/// Tolerance of the score of a micromouse.
pub(crate) const MOUSE_SCORE: Tolerance = Tolerance::relative(
    0.2,
    "the paper does not say how ties between ways are broken, and the first run counts too",
);

/// Tolerance of the score of a place map, and of the score's spread.
pub(crate) const MAP_SCORE: Tolerance =
    Tolerance::relative(0.2, "searches of one set differ by a fifth and more");

/// Tolerance of the share of a pitch that a cell covers.
pub(crate) const AREA: Tolerance = Tolerance::absolute(
    0.01,
    "it follows from the drawing but for the paper's rounding",
);
