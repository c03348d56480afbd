//! Maps of actions and bumps alone, without odometry, each of another world.

use rand::RngExt;
use tolman_arena::bump_walk::{BumpSight, BumpWalk};
use tolman_arena::family::{Family, FamilySize};
use tolman_experiment::{BoxError, Fields, Options, Record, Row, Table, record};
use tolman_maps::bump_map::BumpMoves;
use tolman_maze::Direction;
use tolman_systems::stream;

use super::fresh::{QUICK, WORLD_STREAM, WORLDS};
use crate::arena::{drawn, drawn_sized};

/// Name of the table.
pub(super) const ODOMETRY_OFF: &str = "odometry off";

/// Stream of a run's seed from which a random walk is drawn.
const WALK_STREAM: u64 = 21;

/// Stream of a run's seed from which it is drawn which moves fail.
const FAILURE_STREAM: u64 = 22;

/// Number of moves along open ways of which one fails, where they fail.
const ONE_IN: u32 = 100;

/// How the robot chooses its moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Choice {
    /// As its map advises, until it counts as tested.
    Advice,
    /// Any, with equal probability.
    Random,
}

/// A row: a family of worlds, and how the robot moves in them.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlindRow {
    pub(super) row: &'static str,
    family: &'static str,
    size: Size,
    choice: Choice,
    fail: BumpMoves,
    limit: Limit,
}

/// Size of a row's worlds.
#[derive(Clone, Copy, Debug)]
enum Size {
    Of(FamilySize),
    /// Columns and rows.
    Cells(u16),
}

/// Largest number of moves.
#[derive(Clone, Copy, Debug)]
enum Limit {
    Moves(u32),
    /// For each cell.
    PerCell(u32),
}

impl BlindRow {
    const fn new(family: &'static str) -> Self {
        Self {
            row: family,
            family,
            size: Size::Of(FamilySize::Middle),
            choice: Choice::Advice,
            fail: BumpMoves::Certain,
            limit: Limit::Moves(20_000),
        }
    }

    /// Returns a row in which moves fail, of square worlds.
    const fn failing(
        (row, family, side): (&'static str, &'static str, u16),
        fail: BumpMoves,
        per_cell: u32,
    ) -> Self {
        Self {
            row,
            size: Size::Cells(side),
            fail,
            limit: Limit::PerCell(per_cell),
            ..Self::new(family)
        }
    }
}

/// Returns all rows.
pub(super) fn rows() -> Vec<BlindRow> {
    let families = Family::all()
        .into_iter()
        .map(|family| BlindRow::new(family.name));
    let large = ["perfect, large", "braided, large", "blocks, large"];
    let large = large.into_iter().zip(["perfect", "braided", "blocks"]);
    let large = large.map(|(row, family)| BlindRow {
        row,
        size: Size::Of(FamilySize::Large),
        ..BlindRow::new(family)
    });
    let walk = BlindRow {
        row: "braided, small, random walk",
        size: Size::Of(FamilySize::Small),
        choice: Choice::Random,
        limit: Limit::Moves(5000),
        ..BlindRow::new("braided")
    };
    let kind = BumpMoves::MayBump;
    let [harsh, told] = [false, true].map(|unit_steps| BumpMoves::MayStay {
        one_in: ONE_IN,
        unit_steps,
    });
    let failing = [
        (("8x8 kind perfect", "perfect", 8), kind, 50),
        (("8x8 kind braided", "braided", 8), kind, 50),
        (("17x17 kind perfect", "perfect", 17), kind, 60),
        (("17x17 kind braided", "braided", 17), kind, 60),
        (("8x8 harsh perfect", "perfect", 8), harsh, 30),
        (("8x8 harsh braided", "braided", 8), harsh, 100),
        (("8x8 harsh, unit steps", "braided", 8), told, 25),
        (("17x17 harsh, unit steps", "braided", 17), told, 25),
    ]
    .map(|(row, fail, moves)| BlindRow::failing(row, fail, moves));
    families.chain(large).chain([walk]).chain(failing).collect()
}

record! {
    /// A robot that felt its way through a world drawn for the run.
    struct BlindRun {
        /// Whether the map is complete and tells every walk as it would truly be.
        exact: bool => higher("exact"),
        /// Whether the robot says that its map is right: it is complete and was tested.
        said_right: bool => neither("said to be right"),
        /// Whether the robot says that a map is right that is not exact.
        false_right: bool => lower("wrongly said to be right"),
        /// Number of moves until the robot said that its map is right, or until its end.
        moves: u32 => lower("moves"),
        /// Number of places on the map.
        places: usize => neither("places on the map").decimals(1),
        /// Number of cells of the world that can be reached.
        cells: usize => neither("cells").decimals(1),
    }
}

/// Returns the table.
pub(super) fn table(rows: &[BlindRow], options: &Options) -> Table {
    let runs = options.runs_else(WORLDS, QUICK);
    Table::of::<BlindRun>(ODOMETRY_OFF, "Odometry off: actions and bumps alone, each run another world")
        .metrics_from(BlindRun::exact)
        .rows(rows.iter().map(|row| Row::new(row.row).runs(runs)))
        .note(
            "The robot goes from cell to cell to the north, east, south or west, or bumps and stays. \
             It sees nothing and measures nothing. It goes where its map advises until the map is \
             complete and has predicted eight moves for each place, or for 20,000 moves; the random \
             walk has 5000. Exact: the map is complete and equal to the world up to bisimulation. \
             Worlds are the families of the arena, of middle size where nothing is said. Where a row is kind, one in 100 moves along open ways fails and looks \
             like a bump; the map learns how often. Where it is harsh, one in 100 fails and the robot \
             believes that it has gone; the map is told how often. With unit steps it is also told that \
             the world is a grid and each move one step on it, here of braided mazes. Failing rows end \
             after 50 moves a cell, with 17 × 17 cells 60, harsh perfect ones after 30, harsh braided \
             ones after 100, and with unit steps after 25.",
        )
}

impl BlindRow {
    /// Lets the robot make a map of a new world, and returns the record.
    pub(super) fn run(&self, seed: u64) -> Result<Fields, BoxError> {
        let world = &mut stream(seed, WORLD_STREAM);
        let maze = match self.size {
            Size::Of(size) => drawn(self.family, size, world),
            Size::Cells(side) => drawn_sized(self.family, (side, side), world),
        }?;
        let start = maze.start().map_or_else(Default::default, |(cell, _)| cell);
        let mut walk = BumpWalk::new(&maze, start, BumpSight::None);
        if self.fail != BumpMoves::Certain {
            walk = walk.failing(
                self.fail,
                1.0 / f64::from(ONE_IN),
                stream(seed, FAILURE_STREAM),
            );
        }
        let cells = maze.steps_to(&[start]).iter().flatten().count();
        let limit = match self.limit {
            Limit::Moves(moves) => moves,
            Limit::PerCell(moves) => moves * cells as u32,
        };
        let mut rng = stream(seed, WALK_STREAM);
        let mut moves = 0;
        while moves < limit && !(self.choice == Choice::Advice && walk.map().is_tested()) {
            walk.step(match self.choice {
                Choice::Advice => walk.map().advice(),
                Choice::Random => Direction::ALL[rng.random_range(0..4)],
            })?;
            moves += 1;
        }
        let (exact, said_right) = (walk.is_exact(), walk.map().is_tested());
        let run = BlindRun {
            exact,
            said_right,
            false_right: said_right && !exact,
            moves,
            places: walk.map().place_count(),
            cells,
        };
        Ok(run.fields()?)
    }
}
