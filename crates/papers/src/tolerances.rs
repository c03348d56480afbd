//! Tolerances: the maximum difference at which a value matches the paper's. Each kind of quantity
//! has one tolerance in all tables, with its reason.

use tolman_experiment::Tolerance;

/// Share of runs that arrive, or are solved.
pub(crate) const SUCCESS: Tolerance = Tolerance::absolute(
    15.0,
    "from drawing to drawing of one maze it moves by as much, and the papers' mazes are drawn again",
);

/// Number of time steps and of actions to the goal.
pub(crate) const TIME: Tolerance = Tolerance::relative(
    0.35,
    "mazes and motors are made again from pictures, and lengths known to a third",
);

/// Number of time steps per action.
pub(crate) const STEPS_PER_ACTION: Tolerance = Tolerance::relative(
    0.2,
    "it is the pace of the motors, to which the robot is calibrated",
);

/// Share that the second episode saves.
pub(crate) const SAVED: Tolerance = Tolerance::absolute(
    15.0,
    "the ways of a maze that is drawn again have other lengths",
);

/// Number of states, units and clusters of a quantizer.
pub(crate) const PROTOTYPES: Tolerance = Tolerance::factor(
    1.5,
    "they vary by a quarter from walk to walk, and follow parameters that no source gives",
);

/// Tolerance of counts for which one more is a different result.
pub(crate) const COUNTED: Tolerance =
    Tolerance::absolute(0.5, "the next number is another outcome");

/// Number of steps of a micromouse's second run.
pub(crate) const MOVES: Tolerance = Tolerance::relative(
    0.15,
    "the paper does not say how ties between ways are broken",
);

/// Score of a micromouse.
pub(crate) const MOUSE_SCORE: Tolerance = Tolerance::relative(
    0.2,
    "the paper does not say how ties between ways are broken, and the first run counts too",
);

/// Score of a place map, and its spread.
pub(crate) const MAP_SCORE: Tolerance =
    Tolerance::relative(0.2, "searches of one set differ by a fifth and more");

/// Share of a pitch that a cell covers.
pub(crate) const AREA: Tolerance = Tolerance::absolute(
    0.01,
    "it follows from the drawing but for the paper's rounding",
);
