//! The paper's tables: their mazes, searches and values.

use std::path::Path;

use tolman_maze::Maze;

use super::{Metric, MouseRun, PaperRun, Row, Table};
use crate::metrics::UsualMetrics as _;
use crate::{data, maze_file};
use tolman_experiment::BoxError;
use tolman_systems::micromouse::Searcher;

/// A table of the paper.
#[derive(Debug)]
pub(super) struct PaperTable {
    /// Number of the table in the paper.
    pub(super) name: &'static str,
    title: &'static str,
    note: &'static str,
    rows: Vec<PaperRow>,
}

#[derive(Debug)]
struct PaperRow {
    line: Line,
    maze: Option<Maze>,
}

impl PaperRow {
    fn row(&self) -> Row {
        let (name, searcher, file, paper) = self.line;
        let mut row = Row::new(name);
        row.own = name == OURS;
        if let Some((moves, score)) = paper {
            row = row
                .paper(MouseRun::move_length, moves)
                .paper("average_score", score);
        }
        if self.maze.is_none() {
            return row.missing(format!("{file} is not here: {}", data::MAZES));
        }
        if searcher.is_deterministic() {
            return row.run_each(1);
        }
        row
    }
}

/// A row: its name, the search, the path of its maze below the folder of external data, and move
/// length and average score in the paper.
type Line = (&'static str, Searcher, &'static str, Option<(f64, f64)>);

const COUNTER_50: &str = "counter_search (at least 50%)";
const COUNTER_75: &str = "counter_search (at least 75%)";
const TARGET: &str = "target_search";
const OURS: &str = "certifying search";
/// Row that is not in the paper's tables; section 3.2 says that it "does not work well".
const RANDOM: &str = "random exploration";

const MAZE_1: &str = "udacity/test_maze_01.txt";
const MAZE_2: &str = "udacity/test_maze_02.txt";
const MAZE_3: &str = "udacity/test_maze_03.txt";
/// Candidates for the maze of table 4, which the paper calls that of the "2016 micromouse
/// worldchampionship".
const TAIWAN: &str = "classic/taiwan2016f.txt";
const APEC: &str = "classic/apec2016.txt";

const NOTE: &str = "Of searches that leave nothing to chance there is one run; those with chance that do not finish \
                    within 1000 steps have no score. The benchmark is the paper's (section 2.2): cells / 30 + \
                    the best second run; it gives 21.8, 28.53 and 33.53.";

const TABLES: [(&str, &str, &str, &[Line]); 4] = [
    (
        "1",
        "Maze 1",
        NOTE,
        &lines(MAZE_1, [(19.4, 22.11), (17.0, 24.3198), (17.0, 20.833)]),
    ),
    (
        "2",
        "Maze 2",
        NOTE,
        &lines(MAZE_2, [(22.4, 31.8534), (23.8, 38.567), (23.0, 27.967)]),
    ),
    (
        "3",
        "Maze 3",
        NOTE,
        &lines(MAZE_3, [(25.2, 39.566), (25.4, 37.84), (25.0, 32.633)]),
    ),
    (
        "4",
        "The maze of the 2016 championship",
        "The paper does not say which maze that is. The first row is on taiwan2016f, the others on the maze they name.",
        &[
            (TARGET, Searcher::Target, TAIWAN, Some((70.0, 83.967))),
            ("target_search on apec2016", Searcher::Target, APEC, None),
            (OURS, Searcher::Certify, TAIWAN, Some((70.0, 83.967))),
            (
                "certifying search on apec2016",
                Searcher::Certify,
                APEC,
                None,
            ),
        ],
    ),
];

const fn lines(maze: &'static str, [low, high, target]: [(f64, f64); 3]) -> [Line; 5] {
    [
        (COUNTER_50, Searcher::Counter50, maze, Some(low)),
        (COUNTER_75, Searcher::Counter75, maze, Some(high)),
        (TARGET, Searcher::Target, maze, Some(target)),
        (RANDOM, Searcher::Random, maze, None),
        // Ours is compared with the best of the paper's.
        (OURS, Searcher::Certify, maze, Some(target)),
    ]
}

/// Returns the tables, with the mazes that are below the folder of data.
pub(super) fn tables(folder: Option<&Path>) -> Result<Vec<PaperTable>, BoxError> {
    let mut tables = Vec::new();
    for (name, title, note, lines) in TABLES {
        let mut rows = Vec::new();
        for line in lines.iter().copied() {
            let (_, _, file, _) = line;
            let path = folder.map(|folder| folder.join("mazes").join(file));
            let path = path.filter(|path| path.exists());
            let read = |path| maze_file::read(path).map(|file| file.maze);
            let maze = path.as_deref().map(read).transpose()?;
            rows.push(PaperRow { line, maze });
        }
        tables.push(PaperTable {
            name,
            title,
            note,
            rows,
        });
    }
    Ok(tables)
}

impl PaperTable {
    pub(super) fn table(&self) -> Table {
        let average_score = Metric::mean(PaperRun::score).named("average_score");
        Table::of::<PaperRun>(self.name, self.title)
            .metric(Metric::mean(MouseRun::move_length))
            .metric(average_score.titled("average score"))
            .metric(Metric::mean(PaperRun::benchmark))
            .metrics([MouseRun::finished, MouseRun::certified])
            .rows(self.rows.iter().map(PaperRow::row))
            .paper_runs(5)
            .note(self.note)
    }

    pub(super) fn row(&self, name: &str) -> Option<(Searcher, &Maze)> {
        let row = self.rows.iter().find(|row| row.line.0 == name)?;
        Some((row.line.1, row.maze.as_ref()?))
    }

    pub(super) fn mazes(&self) -> impl Iterator<Item = (&str, &Maze)> {
        self.rows
            .iter()
            .filter_map(|row| Some((row.line.0, row.maze.as_ref()?)))
    }
}
