//! What the paper says of its two mazes.

/// A row of the paper's tables 2 and 3; means with their standard deviations.
#[derive(Debug)]
pub(crate) struct PaperRow {
    pub(crate) row: &'static str,
    pub(crate) success_percent: f64,
    pub(crate) actions: (f64, f64),
    pub(crate) steps: (f64, f64),
}

pub(crate) const TABLE_2: &[PaperRow] = &[
    PaperRow {
        row: "Avoid",
        success_percent: 68.0,
        actions: (73.16, 70.231),
        steps: (109.48, 78.521),
    },
    PaperRow {
        row: "Wall-follow",
        success_percent: 92.0,
        actions: (43.68, 26.24),
        steps: (91.76, 56.421),
    },
    PaperRow {
        row: "MSLST 100",
        success_percent: 100.0,
        actions: (17.08, 16.088),
        steps: (38.12, 34.003),
    },
];

pub(crate) const TABLE_3: &[PaperRow] = &[
    PaperRow {
        row: "Avoid",
        success_percent: 40.0,
        actions: (247.32, 166.916),
        steps: (383.72, 173.098),
    },
    PaperRow {
        row: "Wall-follow",
        success_percent: 72.0,
        actions: (130.04, 83.414),
        steps: (278.52, 162.169),
    },
    PaperRow {
        row: "MSLST 20",
        success_percent: 92.0,
        actions: (69.72, 130.205),
        steps: (117.08, 130.452),
    },
    PaperRow {
        row: "MSLST 50",
        success_percent: 100.0,
        actions: (42.72, 41.733),
        steps: (103.2, 99.839),
    },
];

/// The paper's limits, time steps.
pub(crate) const J_STEPS: u32 = 200;
pub(crate) const LARGE_STEPS: u32 = 500;
