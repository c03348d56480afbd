//! Latent learning: errors of the first runs to the food, with and without exploring before.

use tolman_arena::apparatus::Apparatus;
use tolman_arena::contest::{RatRecord, RatStep, RatTrip};
use tolman_experiment::{Row, Table, record};

use super::{BETWEEN, sent};

/// Name of the table.
const TABLE: &str = "latent learning";

/// When there is food.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fed {
    /// From the first run on, with an empty map.
    FromTheFirst,
    /// After it explored the maze without being sent anywhere.
    AfterExploring,
}

impl Fed {
    const ALL: [Self; 2] = [Self::FromTheFirst, Self::AfterExploring];

    const fn name(self) -> &'static str {
        match self {
            Self::FromTheFirst => "food from the first run",
            Self::AfterExploring => "explored before",
        }
    }

    /// Returns the system of a row, and when it is fed.
    pub(super) fn of_row(row: &str) -> Option<(&str, Self)> {
        let (system, fed) = row.split_once(BETWEEN)?;
        let mut all = Self::ALL.into_iter();
        Some((system, all.find(|one| one.name() == fed)?))
    }

    pub(super) const fn steps(self) -> &'static [RatStep] {
        const STEPS: [RatStep; 7] = [
            RatStep::Explore,
            RatStep::Back,
            RatStep::ToFood,
            RatStep::Back,
            RatStep::ToFood,
            RatStep::Back,
            RatStep::ToFood,
        ];
        match self {
            Self::FromTheFirst => STEPS.split_at(2).1,
            Self::AfterExploring => &STEPS,
        }
    }
}

record! {
    /// Three runs to the food.
    pub(super) struct ForksRun {
        /// Whether it declared, before it drove, that it cannot work there.
        abstained: bool => neither("abstained"),
        /// Number of entries into blind alleys in the first run to the food; no value here and
        /// below if it did not come to the food.
        errors_1: Option<u32> => lower("errors in run 1"),
        /// The same in the second run.
        errors_2: Option<u32> => lower("in run 2"),
        /// The same in the third run.
        errors_3: Option<u32> => lower("in run 3"),
        /// Number of entries into blind alleys while it explored.
        errors_before: Option<u32> => neither("while exploring"),
        /// Whether it came to the food in all three runs.
        arrived: bool => higher("came to the food"),
        /// Number of times that it was carried to the start box, since it did not come there.
        carried: Option<u32> => neither("carried"),
        /// Reason why it gave up at last.
        why: String => neither("reason"),
    }
}

impl ForksRun {
    pub(super) fn of(record: &RatRecord, apparatus: &Apparatus) -> Self {
        if let Some(why) = &record.abstained {
            return Self {
                abstained: true,
                why: why.clone(),
                ..Self::default()
            };
        }
        let [before @ .., first, second, third] = record.trips.as_slice() else {
            return Self::default();
        };
        let all = |trip: &RatTrip| trip.count_of(&apparatus.ways);
        let errors = |trip: &RatTrip| trip.arrived.map(|_| all(trip));
        let trips = [first, second, third];
        let mut gave_up = trips.iter().map(|trip| trip.end.why());
        let why = gave_up.rfind(|why| !why.is_empty());
        Self {
            abstained: false,
            errors_1: errors(first),
            errors_2: errors(second),
            errors_3: errors(third),
            errors_before: before.first().map(all),
            arrived: trips.iter().all(|trip| trip.arrived.is_some()),
            carried: Some(record.carried),
            why: why.unwrap_or_default().to_owned(),
        }
    }
}

/// Returns the table.
pub(super) fn table() -> Table {
    let row = |system, fed: Fed| Row::new(format!("{system}{BETWEEN}{}", fed.name()));
    let rows = sent().flat_map(|system| Fed::ALL.map(|fed| row(system, fed)));
    Table::of::<ForksRun>(
        TABLE,
        "Latent learning: blind alleys entered on the first runs to the food",
    )
    .metrics_from(ForksRun::abstained)
    .rows(rows)
    .note(
        "Fourteen forks in a row, each with a blind alley that looks as the way on does, on the left \
         or on the right by chance. A system is sent to the food with an empty map, or explores \
         first. Rats that were fed only from the 11th day on made as few errors on the 12th as those \
         that were fed from the first.",
    )
}
