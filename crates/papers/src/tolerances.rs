//! Maximum difference between a quantity and the paper's at which they match. Each kind of quantity
//! has one tolerance in all tables, with its reason.

use tolman_experiment::Tolerance;

/// Runs that arrive, or are solved.
pub(crate) const SUCCESS: Tolerance = Tolerance::absolute(
    15.0,
    "from drawing to drawing of one maze it moves by as much, and the papers' mazes are drawn again",
);

/// Time steps and actions to the goal.
pub(crate) const TIME: Tolerance = Tolerance::relative(
    0.35,
    "mazes and motors are made again from pictures, and lengths known to a third",
);

/// Time steps of an action.
pub(crate) const STEPS_PER_ACTION: Tolerance = Tolerance::relative(
    0.2,
    "it is the pace of the motors, to which the robot is calibrated",
);

/// Savings of the second episode.
pub(crate) const SAVED: Tolerance = Tolerance::absolute(
    15.0,
    "the ways of a maze that is drawn again have other lengths",
);

/// States, units and clusters that a quantizer makes.
pub(crate) const PROTOTYPES: Tolerance = Tolerance::factor(
    1.5,
    "they vary by a quarter from walk to walk, and follow parameters that no source gives",
);

/// A count of which one more is another outcome.
pub(crate) const COUNTED: Tolerance =
    Tolerance::absolute(0.5, "the next number is another outcome");

/// Steps of a micromouse's second run.
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
