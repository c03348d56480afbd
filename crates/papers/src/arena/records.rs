use tolman_arena::contest::{Claim, ContestRecord, LocateOutcome, Located};
use tolman_arena::registry::RobotEntry;
use tolman_arena::run::TaskEnd;
use tolman_experiment::{BoxError, Metric, Run, Table, record};
use tolman_maze::Maze;

use super::rows::{ALL, contestants, row_name};
use super::{ArenaTask, TABLES};
use crate::metrics::UsualMetrics as _;

record! {
    /// A system's map of a world.
    pub(crate) struct LearnRun {
        /// Whether it declared, before it drove, that it cannot work there.
        abstained: bool => neither("abstained"),
        /// Whether its map is right: it matches the graph of the true places and ways one to one,
        /// and has at least 95 % of them. A system that abstained has no right map.
        right: bool => higher("right"),
        /// Whether its map matches, one to one, the true ways that the robot drove and saw.
        right_of_visited: bool => higher("right as far as visited"),
        /// Share of the visits to its places in which the robot was in the cell that this place
        /// most often was.
        purity: Option<f64> => higher("purity").share().decimals(3),
        /// Number of places on its map over that of true places. A place with two ways counts as
        /// part of a way.
        places: Option<f64> => neither("places / true"),
        /// Share of the links on its map that are true ways, each counted once.
        link_precision: Option<f64> => higher("link precision").share().decimals(3),
        /// Share of the true ways that are on its map; 0 for a system that abstained.
        link_recall: f64 => higher("link recall").share().decimals(3),
        /// For a wrong map: whether the system called it right.
        false_right: Option<bool> => lower("wrong maps called right"),
        /// For a right map: whether the system called it wrong.
        false_alarm: Option<bool> => lower("right maps called wrong"),
        /// Whether the system gave no verdict on its map.
        undecided: Option<bool> => lower("undecided"),
        /// Whether the map is right; no value without a map.
        map_right: Option<bool> => higher("right maps"),
        /// Squared error of the system's probability that its map is right. That is its own
        /// estimate if it has one. Otherwise it is 1 if it was done, 0 if it gave up, and ½ if it
        /// gave no verdict.
        brier: Option<f64> => lower("Brier"),
        /// Driven distance over the length of all corridors.
        driven: Option<f64> => lower("metres / corridors"),
        /// Number of time steps in which it touched something.
        bumps: Option<u32> => lower("bumps"),
        /// Bytes of its map per place, without the data it was learned from.
        bytes_per_place: Option<f64> => lower("bytes / place").decimals(0),
        /// End of the run, with the reason.
        why: String => neither("end"),
    }
}

record! {
    /// A robot's drive to the goal.
    pub(super) struct HomeRun {
        /// Whether it reached the goal within ten times the shortest way and once all corridors.
        success: bool => higher("success"),
        /// For runs that arrived: driven distance over that of the shortest way from cell to cell.
        metres_over_shortest: Option<f64> => lower("metres / shortest"),
        /// Whether it declared, before it drove, that it cannot work there.
        abstained: bool => neither("abstained"),
        /// Number of time steps in which it touched something.
        bumps: Option<u32> => lower("bumps"),
        /// Reason why it gave up.
        why: String => neither("reason"),
    }
}

record! {
    /// A system's answer to the question where it was put down.
    pub(super) struct LocateRun {
        /// Whether it named its place, and was right.
        right: bool => higher("right"),
        /// Whether it named its place, and was wrong.
        wrong: bool => lower("wrong"),
        /// Whether it gave no answer.
        abstained: bool => neither("abstained"),
        /// With a right map, or the true one: whether it named its place, and was right.
        right_on_right_map: Option<bool> => higher("right on right maps"),
        /// Probability that an observer with the true map and without recognition errors would name
        /// the right cell after the same drive.
        ceiling: Option<f64> => neither("passive ceiling").percent().decimals(1),
        /// The same probability, for runs with a right map.
        ceiling_on_right_map: Option<f64> => neither("passive ceiling, on right maps").percent().decimals(1),
        /// For right maps: whether the same system localizes there with the true map, which it
        /// learned without errors. No value if it learned a wrong map even so.
        with_true_map: Option<bool> => neither("active ceiling, on right maps"),
        /// Percent that the system gives to its true place after an action. This and all below: for
        /// right maps, where the same system has the true map beside.
        after_1: Option<f64> => higher("true place after 1 move").percent().decimals(1),
        /// The same with the true map.
        after_1_informed: Option<f64> => neither("with the true map").percent().decimals(1),
        /// The same after 5 actions.
        after_5: Option<f64> => higher("after 5 moves").percent().decimals(1),
        /// The same with the true map.
        after_5_informed: Option<f64> => neither("with the true map").percent().decimals(1),
        /// The same after 10 actions.
        after_10: Option<f64> => higher("after 10 moves").percent().decimals(1),
        /// The same with the true map.
        after_10_informed: Option<f64> => neither("with the true map").percent().decimals(1),
        /// The same after 20 actions.
        after_20: Option<f64> => higher("after 20 moves").percent().decimals(1),
        /// The same with the true map.
        after_20_informed: Option<f64> => neither("with the true map").percent().decimals(1),
        /// Reason why it gave no answer.
        why: String => neither("reason"),
    }
}

record! {
    /// Cost of learning a world.
    pub(super) struct SizeRun {
        /// Whether the map is right and complete.
        right: bool => higher("right"),
        /// Share of the true ways that are on the map.
        link_recall: f64 => higher("link recall").share().decimals(3),
        /// Driven distance over the length of all corridors.
        driven: Option<f64> => lower("metres / corridors"),
        /// Time steps per cell that can be reached.
        steps_per_cell: Option<f64> => lower("time steps / cell").decimals(1),
        /// Places of the map per cell that can be reached.
        places_per_cell: Option<f64> => lower("places / cell"),
    }
}

record! {
    /// Results of a system under a condition.
    pub(super) struct ConditionRun {
        /// Whether it declared, before it drove, that it cannot work there.
        abstained: bool => neither("abstained"),
        /// Whether its map is right.
        right: bool => higher("right"),
        /// Share of the visits to its places in which the robot was in the cell that this place
        /// most often was.
        purity: Option<f64> => higher("purity").share().decimals(3),
        /// Share of the true ways that are on its map; 0 for a system that abstained.
        link_recall: f64 => higher("link recall").share().decimals(3),
        /// For a wrong map: whether the system called it right.
        false_right: Option<bool> => lower("wrong maps called right"),
        /// Whether it localized after it was put down.
        located: bool => higher("located"),
        /// Whether it believed that it was at another place.
        located_wrong: bool => lower("located wrongly"),
        /// Whether it reached the goal.
        success: bool => higher("success"),
    }
}

impl ConditionRun {
    pub(super) fn of(record: &ContestRecord) -> Self {
        let learned = LearnRun::of(record);
        let located = LocateRun::of(record);
        Self {
            abstained: learned.abstained,
            right: learned.right,
            purity: learned.purity,
            link_recall: learned.link_recall,
            false_right: learned.false_right,
            located: located.right,
            located_wrong: located.wrong,
            success: HomeRun::of(record).success,
        }
    }
}

pub(super) fn conditions(name: &str) -> Table {
    Table::of::<ConditionRun>(name, "The same where robots and worlds are not as they were made")
        .metrics_from(ConditionRun::abstained)
        .note("Each system on its paper's robot, in small worlds of all families in turn. Wheels: each \
         encoder counts wrongly, or each wheel of the e-puck rolls wrongly, by a constant of up to \
         1, 2 or 5 %. Compass: off by up to 5°; no e-puck and no Pioneer 2-DX has one. Odometry: off \
         by up to 10 %, constant or drawn again in each time step. Doors: an opening that no place \
         depends on is shut after the robot has learned. Kidnapping: put elsewhere after half the \
         length of the corridors, without being told. Drop-outs: 2 % of all readings are missing. \
         GNG-SLAM Better has rows only if `--runs` asks for them.")
}

impl LearnRun {
    pub(crate) fn of(record: &ContestRecord) -> Self {
        let Some(learned) = &record.learned else {
            return Self {
                abstained: true,
                why: record.abstained.clone().unwrap_or_default(),
                ..Self::default()
            };
        };
        let (judged, claim) = (&learned.judgement, learned.claim);
        let is_right = judged.is_right;
        let outcome = f64::from(u8::from(is_right));
        let error = learned.likelihood() - outcome;
        Self {
            abstained: false,
            right: is_right,
            right_of_visited: judged.is_right_of_visited,
            purity: judged.purity,
            places: Some(judged.places),
            link_precision: judged.link_precision,
            link_recall: judged.link_recall,
            false_right: (!is_right).then_some(claim == Claim::Right),
            false_alarm: is_right.then_some(claim == Claim::Wrong),
            undecided: Some(claim == Claim::Undecided),
            map_right: Some(is_right),
            brier: Some(error * error),
            driven: Some(learned.driven),
            bumps: Some(learned.bumps),
            bytes_per_place: learned.bytes_per_place(),
            why: match &learned.end {
                TaskEnd::Done => "done".to_owned(),
                TaskEnd::GaveUp { why } => why.clone(),
                TaskEnd::OutOfTime => "it had driven ten times the corridors".to_owned(),
            },
        }
    }
}

impl HomeRun {
    pub(super) fn of(record: &ContestRecord) -> Self {
        let Some(home) = record.homes.first() else {
            return Self {
                abstained: true,
                why: record.abstained.clone().unwrap_or_default(),
                ..Self::default()
            };
        };
        Self {
            abstained: false,
            success: home.over_shortest.is_some(),
            metres_over_shortest: home.over_shortest,
            bumps: Some(home.bumps),
            why: home.gave_up.clone(),
        }
    }
}

impl LocateRun {
    pub(super) fn of(record: &ContestRecord) -> Self {
        let learned = record.learned.as_ref();
        let has_abstained = record.abstained.is_some();
        // Only a baseline that is given the true map answers without learning one.
        let is_known = learned.map_or(!has_abstained, |learned| learned.judgement.is_right);
        let found = record.found.first();
        let ceiling = found.and_then(|found| found.ceiling);
        let outcome = found.map_or_else(
            || LocateOutcome::Abstained {
                why: record.abstained.clone().unwrap_or_default(),
            },
            |found| found.outcome.clone(),
        );
        let informed = found.and_then(|found| found.with_true_map.as_deref());
        let own = found.filter(|_| informed.is_some());
        let after = |found: Option<&Located>, actions| Some(100.0 * found?.chance_after(actions)?);
        let ceiling = ceiling.map(|chance| 100.0 * chance);
        let is_right = outcome == LocateOutcome::Right;
        Self {
            right: is_right,
            wrong: outcome == LocateOutcome::Wrong,
            right_on_right_map: is_known.then_some(is_right),
            ceiling,
            ceiling_on_right_map: ceiling.filter(|_| is_known),
            with_true_map: informed.map(Located::is_right),
            after_1: after(own, 1),
            after_1_informed: after(informed, 1),
            after_5: after(own, 5),
            after_5_informed: after(informed, 5),
            after_10: after(own, 10),
            after_10_informed: after(informed, 10),
            after_20: after(own, 20),
            after_20_informed: after(informed, 20),
            abstained: matches!(outcome, LocateOutcome::Abstained { .. }),
            why: match outcome {
                LocateOutcome::Abstained { why } => why,
                LocateOutcome::Right | LocateOutcome::Wrong => String::new(),
            },
        }
    }
}

impl SizeRun {
    pub(super) fn of(record: &ContestRecord, maze: &Maze) -> Self {
        let Some(learned) = &record.learned else {
            return Self::default();
        };
        let cells = maze.reachable().count().max(1) as f64;
        Self {
            right: learned.judgement.is_right,
            link_recall: learned.judgement.link_recall,
            driven: Some(learned.driven),
            steps_per_cell: Some(f64::from(learned.steps) / cells),
            places_per_cell: Some(learned.places as f64 / cells),
        }
    }
}

pub(super) fn learn(name: &str) -> Table {
    Table::of::<LearnRun>(name, "What each system learns, and whether it knows that")
        .metrics([
            LearnRun::right,
            LearnRun::right_of_visited,
            LearnRun::purity,
            LearnRun::places,
            LearnRun::link_precision,
            LearnRun::link_recall,
            LearnRun::abstained,
            LearnRun::false_right,
            LearnRun::false_alarm,
            LearnRun::undecided,
        ])
        .metric(
            Metric::skill("brier_skill", LearnRun::brier, LearnRun::map_right)
                .titled("Brier skill")
                .defined("How much better the system tells whether its map is right than the share of right maps does: 1 is always right, 0 no better, below it worse."),
        )
        .metrics_from(LearnRun::driven)
}

pub(super) fn home(name: &str) -> Table {
    Table::of::<HomeRun>(name, "Put down somewhere, and sent to the goal")
        .metrics_from(HomeRun::success)
}

pub(super) fn locate(name: &str) -> Table {
    Table::of::<LocateRun>(name, "Put down somewhere, and asked where that is")
        .metrics([
            LocateRun::right,
            LocateRun::wrong,
            LocateRun::abstained,
            LocateRun::right_on_right_map,
        ])
        .metric(Metric::mean(LocateRun::ceiling).named("ceiling_percent"))
        .metric(Metric::mean(LocateRun::ceiling_on_right_map).named("ceiling_on_right_map_percent"))
        .metric(Metric::percent(
            "active_ceiling_on_right_map_percent",
            LocateRun::with_true_map,
        ))
        .metrics_from(LocateRun::after_1)
}

pub(super) fn sizes(name: &str) -> Table {
    Table::of::<SizeRun>(name, "What braided worlds cost by their size")
        .metrics_from(SizeRun::right)
        .note("Rows above 16 × 16 are filled where this table is asked for by name (`--table size`): a system takes minutes there.")
}

/// Returns the note that explains a table.
pub(super) fn note(task: ArenaTask, robot: Option<RobotEntry>) -> String {
    let worlds = "Small and middle worlds in turn, the same for all rows. GNG-SLAM Better takes seconds in each, \
     so it has one of each kind and none on the laser Pioneer, unless `--runs` asks for more. Worlds \
     in which a system abstained stay in the denominator.";
    let places = "Places are junctions, dead ends, start and goal. For the diktiometry, corners take the place of \
     start and goal. MSLST does not claim that a map is whole, and counts as undecided. A micromouse \
     is told the grid, its start and the goal.";
    let robots = match robot {
        None => {
            "Each on its paper's robot: CPM on the e-puck, the diktiometry on the Pioneer with a camera among walls of eight colours, all others on the laser Pioneer."
        }
        Some(_) => {
            "All on the laser Pioneer with compass and encoders. For the diktiometry, which tells openings apart by the walls between them, walls are thick."
        }
    };
    match task {
        ArenaTask::Learn => format!("{worlds} {places} {robots}"),
        ArenaTask::Home => format!(
            "{worlds} By the map that was learned before, right or wrong; no more than ten times the shortest way and once all corridors. {robots}"
        ),
        ArenaTask::Locate => format!("{worlds} By the map that was learned before. {robots}"),
    }
}

/// Returns, for each system, the runs with the worst map on each robot, the worst first.
pub(super) fn worst(runs: &[Run]) -> Result<Vec<Run>, BoxError> {
    let mut worst = Vec::new();
    for (table, task, _) in TABLES {
        if task != ArenaTask::Learn {
            continue;
        }
        for contestant in contestants(task) {
            let row = row_name(contestant, ALL);
            let mut wrong: Vec<(f64, &Run)> = Vec::new();
            for run in runs.iter().filter(|run| run.is_of(table, &row)) {
                let learned: LearnRun = run.record()?;
                if !learned.abstained && !learned.right {
                    let badness = learned.link_recall * learned.link_precision.unwrap_or(0.0);
                    wrong.push((badness, run));
                }
            }
            wrong.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.run.cmp(&b.1.run)));
            worst.extend(wrong.first().map(|(_, run)| (*run).clone()));
        }
    }
    Ok(worst)
}
