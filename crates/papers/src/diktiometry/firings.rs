//! How often each part of the mapper acts, in worlds that need it and in worlds that do not.

use tolman_arena::diktiometry::{Survey, blocks};
use tolman_experiment::{BoxError, Fields, Options, Record, Row, Table, record};
use tolman_maps::diktiometry::{
    GeometricMerge, Matcher, Restructured, Restructurer, StepReport, WorldKind,
};
use tolman_maze::drawings::{ladder_of, ring};

use super::fresh::{FreshRow, PAINTED, QUICK, WORLDS, five, painted};
use super::settings::{FURNISHED, HEED, WALLED_UP};

/// Name of the table.
pub(super) const PARTS: &str = "parts";

/// Number of moves in each world.
const MOVES: u32 = 1000;

/// A row: worlds, and how often a door moves in them.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartsRow {
    pub(super) fresh: FreshRow,
    /// Number of moves after which a door shuts or opens; 0: none does.
    door_period: u32,
}

impl From<FreshRow> for PartsRow {
    fn from(fresh: FreshRow) -> Self {
        Self {
            fresh,
            door_period: 0,
        }
    }
}

/// Returns all rows.
pub(super) fn rows() -> Vec<PartsRow> {
    let alike = FreshRow {
        row: "5x5 alike",
        moves: MOVES,
        ..five().heed(HEED)
    };
    let doorways = FreshRow {
        row: "5x5",
        ..alike.furnished(FURNISHED)
    };
    let seven = FreshRow {
        row: "7x7",
        draw: |rng| Ok(blocks(7, WALLED_UP, rng)),
        ..doorways
    };
    let outliers = FreshRow {
        row: "outliers 5 %",
        robot: |robot| robot.outliers = 0.05,
        ..doorways
    };
    let blind = FreshRow {
        row: "odometry ± 50 %",
        robot: |robot| robot.odometry_share = 0.5,
        ..alike.furnished(PAINTED)
    };
    let moving = FreshRow {
        row: "doors move",
        change: |config| config.world = WorldKind::Changing,
        ..doorways
    };
    vec![
        alike.into(),
        alike.papers_rule("5x5 alike (paper's rule)").into(),
        doorways.into(),
        doorways.papers_rule("5x5 (paper's rule)").into(),
        seven.into(),
        seven.papers_rule("7x7 (paper's rule)").into(),
        FreshRow {
            row: "odometry ± 50 %, paths may merge",
            change: |config| config.restructuring.geometric_merge = GeometricMerge::Off,
            ..blind
        }
        .into(),
        painted("ladders", |rng| ladder_of(11, rng)).into(),
        painted("rings", |rng| ring((8, 8), rng)).into(),
        outliers.into(),
        outliers.papers_rule("outliers 5 % (paper's rule)").into(),
        blind.into(),
        blind.papers_rule("odometry ± 50 % (paper's rule)").into(),
        PartsRow {
            fresh: moving,
            door_period: 25,
        },
        PartsRow {
            fresh: moving.papers_rule("doors move (paper's rule)"),
            door_period: 25,
        },
    ]
}

record! {
    /// How often each part acted in a world drawn for the run.
    struct PartsRun {
        /// Number of moves by which the best track came to its place by CONTINUE.
        continues: u32 => neither("CONTINUE").decimals(1),
        /// Number by LINK.
        links: u32 => neither("LINK").decimals(1),
        /// Number by α-MATCH.
        alphas: u32 => neither("α-MATCH"),
        /// Number by β-MATCH.
        betas: u32 => neither("β-MATCH"),
        /// Number of new places.
        new_places: u32 => neither("new places").decimals(1),
        /// Number of moves at which the dynamic order preferred another match than the static one.
        reordered: u32 => neither("dynamic order"),
        /// Number of merges first proposed by geometric constraints.
        merged_by_geometry: u32 => neither("merges: geometry"),
        /// Number by the ways of a static world.
        merged_by_one_way: u32 => neither("ways"),
        /// Number by turns.
        merged_by_winding: u32 => neither("turns"),
        /// Number by local path constraints.
        merged_by_local_path: u32 => neither("local path"),
        /// Number by non-local path constraints.
        merged_by_non_local_path: u32 => neither("non-local path"),
        /// Number by looks.
        merged_by_looks: u32 => neither("looks"),
        /// Number of splits by geometric constraints.
        split_by_geometry: u32 => neither("splits: geometry"),
        /// Number of splits by local path constraints.
        split_by_local_path: u32 => neither("splits: local path"),
        /// Number of links removed as transient.
        elided_links: u32 => neither("links elided"),
        /// Number of places removed as transient.
        elided_places: u32 => neither("places elided"),
        /// Number of contradictions that were noticed.
        contradictions: usize => neither("contradictions").decimals(1),
    }
}

/// Returns the table.
pub(super) fn table(rows: &[PartsRow], options: &Options) -> Table {
    let runs = options.runs_else(WORLDS, QUICK);
    Table::of::<PartsRun>(PARTS, "Parts: how often each acts in 1000 moves, each run another world")
        .metrics_from(PartsRun::continues)
        .rows(rows.iter().map(|row| Row::new(row.fresh.row).runs(runs)))
        .note(
            "Means of the numbers of times. Blocks of 5 × 5 or 7 × 7 cells with a quarter of the ways walled up, walls of eight \
             colours and doorways; alike: one colour and no doorways. Ladders with corridors of eleven \
             cells and rings of up to 8 × 8 cells, with looks and turns as evidence. Scripts are begun with a probability of 30 %. A merge counts for the \
             first part that proposes it, in the order of the columns. Dynamic order: moves at which the \
             static order would have chosen another of the matches that were found. Outliers: moves \
             that err by four times the bound.",
        )
}

impl PartsRow {
    /// Surveys a new world and returns the record.
    pub(super) fn run(&self, seed: u64) -> Result<Fields, BoxError> {
        let (office, mut config) = self.fresh.draw(seed)?;
        config.door_period = self.door_period;
        let mut run = PartsRun::default();
        Survey::run(&office, config, seed, |_, moved| {
            run.count(&moved.report);
            Ok(())
        })?;
        Ok(run.fields()?)
    }
}

impl PartsRun {
    fn count(&mut self, report: &StepReport) {
        let matcher = report.tracks.first().and_then(|track| track.matcher);
        let matched = matcher.map(|matcher| match matcher {
            Matcher::Continue => &mut self.continues,
            Matcher::Link => &mut self.links,
            Matcher::Alpha => &mut self.alphas,
            Matcher::Beta => &mut self.betas,
            Matcher::NewPlace => &mut self.new_places,
        });
        matched.into_iter().for_each(|count| *count += 1);
        self.reordered += u32::from(report.reordered);
        self.contradictions += report.contradictions.len();
        for change in &report.restructured {
            *self.of(change) += 1;
        }
    }

    const fn of(&mut self, change: &Restructured) -> &mut u32 {
        match change {
            Restructured::Merged { by, .. } => match by {
                Restructurer::Geometry => &mut self.merged_by_geometry,
                Restructurer::OneWay => &mut self.merged_by_one_way,
                Restructurer::Winding => &mut self.merged_by_winding,
                Restructurer::LocalPath => &mut self.merged_by_local_path,
                Restructurer::NonLocalPath => &mut self.merged_by_non_local_path,
                Restructurer::Looks => &mut self.merged_by_looks,
            },
            Restructured::Split { by, .. } => match by {
                Restructurer::LocalPath => &mut self.split_by_local_path,
                _ => &mut self.split_by_geometry,
            },
            Restructured::LinkElided(_) => &mut self.elided_links,
            Restructured::PlaceElided(_) => &mut self.elided_places,
        }
    }
}
