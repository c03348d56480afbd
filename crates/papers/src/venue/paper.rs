//! The paper's values for its two mazes.

/// A row of the paper's tables 2 and 3, with means and their standard deviations.
#[derive(Debug)]
pub(crate) struct PaperRow {
    pub(crate) row: &'static str,
    pub(crate) success_percent: f64,
    pub(crate) actions: (f64, f64),
    pub(crate) steps: (f64, f64),
}

const fn row(
    row: &'static str,
    success_percent: f64,
    actions: (f64, f64),
    steps: (f64, f64),
) -> PaperRow {
    PaperRow {
        row,
        success_percent,
        actions,
        steps,
    }
}

pub(crate) const TABLE_2: &[PaperRow] = &[
    row("Avoid", 68.0, (73.16, 70.231), (109.48, 78.521)),
    row("Wall-follow", 92.0, (43.68, 26.24), (91.76, 56.421)),
    row("MSLST 100", 100.0, (17.08, 16.088), (38.12, 34.003)),
];

pub(crate) const TABLE_3: &[PaperRow] = &[
    row("Avoid", 40.0, (247.32, 166.916), (383.72, 173.098)),
    row("Wall-follow", 72.0, (130.04, 83.414), (278.52, 162.169)),
    row("MSLST 20", 92.0, (69.72, 130.205), (117.08, 130.452)),
    row("MSLST 50", 100.0, (42.72, 41.733), (103.2, 99.839)),
];

/// A row of the paper's table 1: the number of states that Phase I learns of a maze.
#[derive(Debug)]
pub(crate) struct StatesRow {
    pub(crate) row: &'static str,
    pub(crate) maze: &'static str,
    pub(crate) threshold: f64,
    pub(crate) states: f64,
}

const fn states(row: &'static str, maze: &'static str, threshold: f64, states: f64) -> StatesRow {
    StatesRow {
        row,
        maze,
        threshold,
        states,
    }
}

pub(crate) const TABLE_1: [StatesRow; 3] = [
    states("J 100", "J", 100.0, 16.0),
    states("Large 20", "Large", 20.0, 43.0),
    states("Large 50", "Large", 50.0, 26.0),
];

/// Number of runs of each row of tables 2 and 3.
pub(crate) const PAPER_RUNS: u32 = 25;

/// The paper's limits, time steps.
pub(crate) const J_STEPS: u32 = 200;
pub(crate) const LARGE_STEPS: u32 = 500;
