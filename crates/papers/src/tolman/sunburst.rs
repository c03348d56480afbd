//! The sunburst: which of the ways that are new is tried first when the learned one is blocked.

use tolman_arena::apparatus::Apparatus;
use tolman_arena::contest::{RatRecord, RatStep};
use tolman_experiment::{Row, Table, record};

use super::detour::why;
use super::{NO_VERDICT, sent};

/// Name of the table.
pub(super) const TABLE: &str = "shortcut";

/// Percent of the rats that chose the path to near the food, of 18 paths, as it is usually quoted
/// from Tolman: Cognitive maps in rats and men, 1948. The paper itself was not seen.
const CHOSE_SHORTCUT: f64 = 36.0;

pub(super) const STEPS: [RatStep; 10] = [
    RatStep::Shut(Apparatus::TO_ARMS[0]),
    RatStep::Shut(Apparatus::TO_ARMS[1]),
    RatStep::Explore,
    RatStep::Back,
    RatStep::ToFood,
    RatStep::Back,
    RatStep::Open(Apparatus::TO_ARMS[0]),
    RatStep::Open(Apparatus::TO_ARMS[1]),
    RatStep::Shut(Apparatus::BLOCK),
    RatStep::Choose,
];

record! {
    /// A run of the sunburst.
    pub(super) struct SunburstRun {
        /// Whether it declared, before it drove, that it cannot work there.
        abstained: bool => neither("abstained"),
        /// Whether the first new arm that it entered is the one that leads towards the food.
        as_rats: bool => neither("the arm to the food first"),
        /// Whether it is the other one on the side of the food.
        beside: bool => neither("the other arm there"),
        /// Whether it is on the other side.
        away: bool => neither("an arm away from it"),
        /// Whether it entered none.
        none: bool => neither("no arm"),
        /// Number of times that it was carried to the start box, since it did not come there.
        carried: Option<u32> => neither("carried"),
        /// Reason why it gave up at last.
        why: String => neither("reason"),
    }
}

impl SunburstRun {
    pub(super) fn of(record: &RatRecord, apparatus: &Apparatus) -> Self {
        let (None, Some(trip)) = (&record.abstained, record.trips.last()) else {
            return Self {
                abstained: true,
                why: record.abstained.clone().unwrap_or_default(),
                ..Self::default()
            };
        };
        let ways = &apparatus.ways;
        let entered = trip.first_of(ways);
        let half = ways.len() / 2;
        let is_there = |way: usize| {
            apparatus
                .chosen
                .is_some_and(|to| (to < half) == (way < half))
        };
        let as_rats = entered.is_some() && entered == apparatus.chosen;
        Self {
            abstained: false,
            as_rats,
            beside: !as_rats && entered.is_some_and(is_there),
            away: entered.is_some_and(|way| !is_there(way)),
            none: entered.is_none(),
            carried: Some(record.carried),
            why: why(trip),
        }
    }
}

/// Returns the table.
pub(super) fn table() -> Table {
    let row = |system| Row::new(system).paper_aside("as_rats_percent", CHOSE_SHORTCUT, NO_VERDICT);
    Table::of::<SunburstRun>(
        TABLE,
        "A shortcut: which new arm is tried first when the learned way is blocked",
    )
    .metrics_from(SunburstRun::abstained)
    .rows(sent().map(row))
    .note(
        "Four blind arms beside the learned way, shut while it is learned; the food lies beyond one \
         of them. A guess is right in 25 %.",
    )
}
