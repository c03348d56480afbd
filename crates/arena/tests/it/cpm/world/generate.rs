use alloc::vec;
use alloc::vec::Vec;

use rand::{Rng, RngExt};
use thiserror::Error;
use tolman_geom::Point;

use super::rover::uniform;
use super::{PlaneMaze, PlaneMazeError, WorldBuilder};
use tolman_maps::cpm::{Dictionary, DictionaryError, FragmentMatching, PatternId, Similarity};
use tolman_robot::Landmark;

/// Parameters of a random world.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub(crate) struct MazeConfig {
    /// Number of cells from west to east, at least 2.
    pub(crate) columns: u32,
    /// Number of cells from south to north, at least 2.
    pub(crate) rows: u32,
    /// Share of the openings beyond a tree of corridors that exist, 0 to 1.
    pub(crate) loops: f64,
    /// Share of cells with a usable opening across their corner, 0 to 1. With 0, ports have only
    /// four directions; with 1, junctions have up to eight ports.
    pub(crate) diagonals: f64,
    /// Common patterns of the dictionary, at least 2; the paper has 31.
    pub(crate) patterns: u32,
    /// Number of observations along a cell's length, at least 1.
    pub(crate) observations_per_cell: f64,
    /// Probability that an observation equals the one before it, 0 to 1. It models walls that go
    /// on.
    pub(crate) persistence: f64,
    /// Differences between corridors.
    pub(crate) likeness: Likeness,
    /// Share of corridors that look the same from both ends, 0 to 1.
    pub(crate) symmetrical: f64,
}

/// Differences between the corridors of a random world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Likeness {
    /// "Every path-fragment in the environment is distinctive": f_S < 0.8 for all pairs in both
    /// directions, and, unless they are symmetrical, for each and its inverse.
    Distinctive,
    /// This number of kinds of corridors, at least 1. Those of one kind and length look the same.
    Kinds(u32),
}

/// Reason why a world cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub(crate) enum MazeConfigError {
    /// A field of the configuration is outside its range.
    #[error("{field} is {value} but has to be {range}")]
    OutOfRange {
        /// Name of the field.
        field: &'static str,
        /// The value given.
        value: f64,
        /// Allowed values, in words.
        range: &'static str,
    },
    /// Too many corridors: a thousand draws gave no corridors that all differ.
    #[error(
        "all of a thousand draws of corridor {corridor} look like another one: use more patterns or observations"
    )]
    NotDistinctive {
        /// Number of the corridor.
        corridor: u32,
    },
    /// The drawing is not a world.
    #[error(transparent)]
    World(#[from] PlaneMazeError),
    /// The dictionary refuses a pattern.
    #[error(transparent)]
    Dictionary(#[from] DictionaryError),
}

impl MazeConfig {
    /// Returns a maze like the paper's Maze-3: 4 × 4 cells, junctions of three and four ports, 31
    /// patterns, distinctive.
    #[must_use]
    pub(crate) const fn small() -> Self {
        Self {
            columns: 4,
            rows: 4,
            loops: 0.25,
            diagonals: 0.0,
            patterns: 31,
            observations_per_cell: 4.0,
            persistence: 0.5,
            likeness: Likeness::Distinctive,
            symmetrical: 0.0,
        }
    }

    /// Returns one of the mazes of all sorts: from trees to all possible loops, ports in four
    /// directions or in eight.
    #[must_use]
    pub(crate) fn any(number: u32) -> Self {
        Self {
            columns: 3 + number % 2,
            rows: 3 + number / 2 % 2,
            loops: f64::from(number % 5) / 4.0,
            diagonals: f64::from(number % 3) / 2.0,
            ..Self::small()
        }
    }

    /// Returns [one of all sorts](Self::any) whose corridors look alike and whose loops may be
    /// symmetrical.
    #[must_use]
    pub(crate) fn any_alike(number: u32) -> Self {
        Self {
            likeness: Likeness::Kinds(1 + number % 3),
            symmetrical: f64::from(number % 4) / 3.0,
            ..Self::any(number)
        }
    }

    fn check(&self) -> Result<(), MazeConfigError> {
        let kinds = match self.likeness {
            Likeness::Kinds(kinds) => kinds,
            Likeness::Distinctive => 1,
        };
        let density = self.observations_per_cell;
        let fields = [
            ("columns", self.columns.into(), 2.0..=1000.0, "2 to 1000"),
            ("rows", self.rows.into(), 2.0..=1000.0, "2 to 1000"),
            ("loops", self.loops, 0.0..=1.0, "0 to 1"),
            ("diagonals", self.diagonals, 0.0..=1.0, "0 to 1"),
            (
                "patterns",
                self.patterns.into(),
                2.0..=1e6,
                "2 to 1 000 000",
            ),
            ("observations_per_cell", density, 1.0..=1000.0, "1 to 1000"),
            ("persistence", self.persistence, 0.0..=1.0, "0 to 1"),
            ("symmetrical", self.symmetrical, 0.0..=1.0, "0 to 1"),
            ("likeness", kinds.into(), 1.0..=1e6, "1 to 1 000 000 kinds"),
        ];
        for (field, value, allowed, range) in fields {
            if !allowed.contains(&value) {
                return Err(MazeConfigError::OutOfRange {
                    field,
                    value,
                    range,
                });
            }
        }
        Ok(())
    }
}

impl PlaneMaze {
    /// Returns a random maze on a grid of cells. It has a random tree of corridors, some loops, and
    /// a start and a goal, in dead ends if there are any. Cells with two ways out are not places
    /// but bends of a corridor.
    ///
    /// # Errors
    /// [`MazeConfigError`] if a field is outside its range or the corridors cannot all be
    /// distinctive.
    pub(crate) fn random(config: &MazeConfig, rng: &mut impl Rng) -> Result<Self, MazeConfigError> {
        config.check()?;
        let dictionary = random_dictionary(config.patterns, rng)?;
        Self::random_of(dictionary, config, rng)
    }

    /// Returns a maze like [`random`](Self::random), with the patterns of a dictionary instead of
    /// its own. It makes another maze for one robot.
    ///
    /// # Errors
    /// [`MazeConfigError`] as [`random`](Self::random), or if there are less than two patterns.
    pub(crate) fn random_of(
        dictionary: Dictionary,
        config: &MazeConfig,
        rng: &mut impl Rng,
    ) -> Result<Self, MazeConfigError> {
        let config = &MazeConfig {
            patterns: dictionary.len() as u32,
            ..*config
        };
        config.check()?;
        let openings = openings(config, rng);
        let cells = config.columns * config.rows;
        let mut ways: Vec<Vec<u32>> = vec![Vec::new(); cells as usize];
        for (a, b) in &openings {
            ways[*a as usize].push(*b);
            ways[*b as usize].push(*a);
        }
        let dead_ends = |ways: &[Vec<u32>], but: Option<u32>| -> Vec<u32> {
            let ends = (0..cells).filter(|cell| ways[*cell as usize].len() == 1);
            let ends: Vec<u32> = ends.filter(|cell| Some(*cell) != but).collect();
            if ends.is_empty() {
                return (0..cells).filter(|cell| Some(*cell) != but).collect();
            }
            ends
        };
        let start = pick(&dead_ends(&ways, None), rng);
        let goal = pick(&dead_ends(&ways, Some(start)), rng);
        let position = |cell: u32| {
            Point::new(
                f64::from(cell % config.columns),
                f64::from(cell / config.columns),
            )
        };
        let mut drawing = WorldBuilder::new(dictionary);
        let mut numbers = vec![None; cells as usize];
        for cell in 0..cells {
            let landmark = match cell {
                cell if cell == start => Some(Landmark::Start),
                cell if cell == goal => Some(Landmark::Goal),
                _ => None,
            };
            if landmark.is_some() || ways[cell as usize].len() != 2 {
                numbers[cell as usize] = Some(drawing.place(position(cell), landmark));
            }
        }
        let mut looks = Looks::new(config, rng);
        for cell in 0..cells {
            for first in &ways[cell as usize] {
                let Some(minus) = numbers[cell as usize] else {
                    continue;
                };
                let mut line = vec![cell, *first];
                let plus = loop {
                    let [.., before, here] = line[..] else {
                        break None;
                    };
                    if let Some(place) = numbers[here as usize] {
                        break Some(place);
                    }
                    let onward = ways[here as usize].iter().find(|next| **next != before);
                    match onward {
                        Some(next) => line.push(*next),
                        None => break None,
                    }
                };
                let reversed = line.iter().rev();
                // Drawn from one of its ends only.
                if line.iter().gt(reversed) {
                    continue;
                }
                let via: Vec<Point> = line[1..line.len() - 1]
                    .iter()
                    .map(|cell| position(*cell))
                    .collect();
                let length: f64 = line
                    .windows(2)
                    .map(|step| (position(step[1]) - position(step[0])).norm())
                    .sum();
                if let Some(plus) = plus {
                    let patterns = looks.next(length, &drawing.dictionary, rng)?;
                    drawing.corridor(minus, plus, &via, &patterns)?;
                }
            }
        }
        let start = numbers[start as usize].unwrap_or(0);
        Ok(drawing.finish(start)?)
    }
}

/// Returns a random spanning tree of the cells and some more.
fn openings(config: &MazeConfig, rng: &mut impl Rng) -> Vec<(u32, u32)> {
    let (columns, rows) = (config.columns, config.rows);
    let mut candidates = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let cell = row * columns + column;
            let (east, north) = (column + 1 < columns, row + 1 < rows);
            if east {
                candidates.push((cell, cell + 1));
            }
            if north {
                candidates.push((cell, cell + columns));
            }
            if east && north && uniform(rng) < config.diagonals {
                // One of the two diagonals of a square: they would cross.
                candidates.push(if uniform(rng) < 0.5 {
                    (cell, cell + columns + 1)
                } else {
                    (cell + 1, cell + columns)
                });
            }
        }
    }
    for last in (1..candidates.len()).rev() {
        candidates.swap(last, rng.random_range(0..=last as u32) as usize);
    }
    // Kruskal: an opening between two trees joins them.
    let mut tree: Vec<u32> = (0..columns * rows).collect();
    fn root(tree: &[u32], cell: u32) -> u32 {
        let mut cell = cell;
        while tree[cell as usize] != cell {
            cell = tree[cell as usize];
        }
        cell
    }
    candidates.retain(|(a, b)| {
        let (a, b) = (root(&tree, *a), root(&tree, *b));
        tree[a as usize] = b;
        a != b || uniform(rng) < config.loops
    });
    candidates.sort_unstable();
    candidates
}

/// Returns random prototypes of 11 features from 0 to 1, like the paper's. They come in pairs that
/// are each other half turned; with an odd number the last one is its own. Turning half round
/// exchanges the first five features with the next five, which keeps distances.
fn random_dictionary(patterns: u32, rng: &mut impl Rng) -> Result<Dictionary, DictionaryError> {
    let mut prototypes: Vec<(Vec<f64>, PatternId)> = Vec::with_capacity(patterns as usize);
    for id in 0..patterns {
        let half_turned = PatternId((id ^ 1).min(patterns - 1));
        let prototype = match prototypes.last() {
            Some((partner, _)) if id % 2 == 1 => half_turned_features(partner),
            _ => (0..11).map(|_| uniform(rng)).collect(),
        };
        prototypes.push((prototype, half_turned));
    }
    if patterns % 2 == 1
        && let Some((last, _)) = prototypes.last_mut()
    {
        let (first, second) = last.split_at_mut(5);
        second[..5].copy_from_slice(first);
    }
    Dictionary::from_prototypes(11, &prototypes)
}

fn half_turned_features(features: &[f64]) -> Vec<f64> {
    let mut turned = features.to_vec();
    let (first, rest) = turned.split_at_mut(5);
    first.swap_with_slice(&mut rest[..5]);
    turned
}

/// Generator of the corridors' looks, one by one.
struct Looks<'a> {
    config: &'a MazeConfig,
    kinds: Vec<Vec<PatternId>>,
    drawn: Vec<Vec<PatternId>>,
}

impl<'a> Looks<'a> {
    fn new(config: &'a MazeConfig, rng: &mut impl Rng) -> Self {
        let kinds = match config.likeness {
            Likeness::Distinctive => Vec::new(),
            Likeness::Kinds(kinds) => {
                let longest =
                    f64::from(config.columns * config.rows) * 1.5 * config.observations_per_cell;
                (0..kinds)
                    .map(|_| random_sequence(config, longest as usize + 1, rng))
                    .collect()
            }
        };
        Self {
            config,
            kinds,
            drawn: Vec::new(),
        }
    }

    fn next(
        &mut self,
        length: f64,
        dictionary: &Dictionary,
        rng: &mut impl Rng,
    ) -> Result<Vec<PatternId>, MazeConfigError> {
        let config = self.config;
        let count = libm::round(length * config.observations_per_cell).max(1.0) as usize;
        let symmetrical = uniform(rng) < config.symmetrical;
        let mut similarity = Similarity::paper();
        similarity.mu = 0.8;
        let matching = FragmentMatching::Positions(similarity);
        for _ in 0..1000 {
            let mut patterns = match config.likeness {
                Likeness::Distinctive => random_sequence(config, count, rng),
                Likeness::Kinds(_) => {
                    let kind = rng.random_range(0..self.kinds.len() as u32);
                    self.kinds[kind as usize]
                        .iter()
                        .copied()
                        .take(count)
                        .collect()
                }
            };
            if symmetrical {
                mirror(&mut patterns, dictionary);
            }
            let inverse = dictionary.inverse(&patterns)?;
            let is_new = || {
                let like = |known: &Vec<PatternId>| matching.matches(dictionary, known, &patterns);
                let alone = symmetrical || matching.score(dictionary, &patterns, &inverse) < 0.8;
                alone && self.drawn.iter().all(|known| like(known).is_none())
            };
            if config.likeness != Likeness::Distinctive || is_new() {
                self.drawn.push(patterns.clone());
                return Ok(patterns);
            }
        }
        let corridor = self.drawn.len() as u32;
        Err(MazeConfigError::NotDistinctive { corridor })
    }
}

/// Makes the second half the first one seen from the other end.
fn mirror(patterns: &mut [PatternId], dictionary: &Dictionary) {
    let count = patterns.len();
    for place in 0..count / 2 {
        patterns[count - 1 - place] = dictionary.half_turned(patterns[place]);
    }
}

fn random_sequence(config: &MazeConfig, count: usize, rng: &mut impl Rng) -> Vec<PatternId> {
    let mut sequence: Vec<PatternId> = Vec::with_capacity(count);
    while sequence.len() < count {
        let goes_on = uniform(rng) < config.persistence;
        let before = sequence.last().copied().filter(|_| goes_on);
        let any = PatternId(rng.random_range(0..config.patterns));
        sequence.push(before.unwrap_or(any));
    }
    sequence
}

fn pick(cells: &[u32], rng: &mut impl Rng) -> u32 {
    cells[rng.random_range(0..cells.len() as u32) as usize]
}
