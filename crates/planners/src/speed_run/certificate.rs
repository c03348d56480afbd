//! The independent checker. It shares no code with the search. It has its own geometry on a lattice
//! of half cells, its own times, and an explicit graph. It searches that graph by the general
//! Dijkstra of this crate.

use alloc::vec::Vec;

use thiserror::Error;
use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};

use super::{RunMove, Side, Slalom, SpeedProfile, SpeedRunConfig};
use crate::{Arcs, costs_from};

/// A speed run, with the claim that none is faster.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpeedRunCertificate {
    /// Cell in whose middle the run begins.
    pub start: Cell,
    /// Heading of the mouse at the beginning.
    pub heading: Direction,
    /// Moves of the run.
    pub moves: Vec<RunMove>,
    /// Duration, in milliseconds.
    pub time_ms: u32,
}

/// Reason why a [`SpeedRunCertificate`] is invalid.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SpeedRunCertificateError {
    /// A straight or turn is impossible at the mouse's position, such as a diagonal in the middle
    /// of a cell.
    #[error(
        "move {number} ({run_move:?}) cannot be made from the mouse's position then: search the run again"
    )]
    Impossible {
        /// Number of the move, from 0.
        number: usize,
        /// Move that fails.
        run_move: RunMove,
    },
    /// A move through a wall, or through an unknown one.
    #[error(
        "move {number} ({run_move:?}) crosses an edge that is not known to be open: look at it first"
    )]
    NotOpen {
        /// Number of the move, from 0.
        number: usize,
        /// Move that fails.
        run_move: RunMove,
    },
    /// The run does not end in the middle of a goal cell.
    #[error("the run does not end in the middle of a goal: search the run again")]
    NotAtGoal,
    /// The run does not take the stated time.
    #[error("the run takes {actual_ms} ms, not the {time_ms} ms that the certificate says")]
    WrongTime {
        /// Duration that the certificate states, ms.
        time_ms: u32,
        /// Actual duration of the run, ms.
        actual_ms: u32,
    },
    /// If unknown walls were open, a faster run would be possible.
    #[error(
        "the known walls allow a run of {possible_ms} ms, faster than the {time_ms} ms: look at more walls"
    )]
    NotTheBest {
        /// Duration that the certificate states, ms.
        time_ms: u32,
        /// Duration of the possible run, ms.
        possible_ms: u32,
    },
}

impl SpeedRunCertificate {
    /// Verifies the run. It can be driven on walls known to be open, ends at one of `goals`, and
    /// takes as long as it states. No run is faster even if all unknown walls are open. O(n log n)
    /// for n cells, in a graph that is built for it.
    ///
    /// # Errors
    /// The first of these that does not hold.
    pub fn check(
        &self,
        walls: &impl Walls,
        config: &SpeedRunConfig,
        goals: &[Cell],
    ) -> Result<(), SpeedRunCertificateError> {
        let mut at = Spot::middle(self.start, self.heading);
        let mut actual_ms = 0;
        for (number, run_move) in self.moves.iter().copied().enumerate() {
            let made = at
                .moves(&|_| true, walls.grid())
                .into_iter()
                .find(|made| made.run_move == run_move)
                .ok_or(SpeedRunCertificateError::Impossible { number, run_move })?;
            if made
                .passed
                .iter()
                .any(|point| knowledge(walls, *point) != Knowledge::Open)
            {
                return Err(SpeedRunCertificateError::NotOpen { number, run_move });
            }
            actual_ms += time_ms(run_move, config);
            at = made.to;
        }
        if !is_goal(at, goals) {
            return Err(SpeedRunCertificateError::NotAtGoal);
        }
        let time_ms = self.time_ms;
        if actual_ms != time_ms {
            return Err(SpeedRunCertificateError::WrongTime { time_ms, actual_ms });
        }
        match best_possible_ms(walls, config, (self.start, self.heading), goals) {
            Some(possible_ms) if possible_ms < time_ms => {
                Err(SpeedRunCertificateError::NotTheBest {
                    time_ms,
                    possible_ms,
                })
            }
            _ => Ok(()),
        }
    }
}

/// Returns the duration of the best run if all unknown walls are open, or `None` if no way leads to
/// a goal. Plain Dijkstra on an explicit graph: O(n log n) for n cells, some hundred times slower
/// than a [`SpeedRunMap`](super::SpeedRunMap).
#[must_use]
pub fn best_possible_ms(
    walls: &impl Walls,
    config: &SpeedRunConfig,
    (start, heading): (Cell, Direction),
    goals: &[Cell],
) -> Option<u32> {
    let grid = walls.grid();
    let open = |point| knowledge(walls, point) != Knowledge::Wall;
    let (columns, rows) = (
        2 * i32::from(grid.width()) + 1,
        2 * i32::from(grid.height()) + 1,
    );
    let id = |spot: Spot| (((spot.at.1 * columns + spot.at.0) * 8) + spot.eighth) as u32;
    let mut arcs = Vec::new();
    let mut ends = Vec::new();
    for y in 0..rows {
        for x in 0..columns {
            for eighth in 0..8 {
                let spot = Spot { at: (x, y), eighth };
                if is_goal(spot, goals) {
                    ends.push(id(spot));
                }
                for made in spot.moves(&open, grid) {
                    arcs.push((id(spot), id(made.to), time_ms(made.run_move, config)));
                }
            }
        }
    }
    let graph = Arcs::new((columns * rows * 8) as usize, &arcs);
    let costs = costs_from(&graph, [id(Spot::middle(start, heading))]);
    ends.into_iter()
        .filter_map(|end| costs.get(end as usize).copied().flatten())
        .min()
}

/// A point of the lattice, whose unit is half a cell. Middles of cells are odd in both coordinates,
/// middles of edges in one, posts in none.
type Point = (i32, i32);

/// Position and heading of the mouse on the lattice. Headings are numbered clockwise: 0 north, 1
/// north-east, and so on.
#[derive(Clone, Copy)]
struct Spot {
    at: Point,
    eighth: i32,
}

struct Made {
    run_move: RunMove,
    /// Middles of the edges that the move crosses, including the edge at its end.
    passed: Vec<Point>,
    to: Spot,
}

/// A turn to the right. Points are (right, ahead) of a mouse that looks north.
struct Template {
    slalom: Slalom,
    passed: &'static [Point],
    end: Point,
    /// Turn in eighths of a circle.
    turned: i32,
}

impl Template {
    const fn new(slalom: Slalom, passed: &'static [Point], end: Point, turned: i32) -> Self {
        Self {
            slalom,
            passed,
            end,
            turned,
        }
    }
}

/// Turns from the middle of a cell, looking north.
const FROM_STRAIGHT: [Template; 4] = [
    Template::new(Slalom::F45, &[(0, 1), (1, 2)], (1, 2), 1),
    Template::new(Slalom::F90, &[(0, 1), (1, 2)], (2, 2), 2),
    Template::new(Slalom::F135, &[(0, 1), (1, 2), (2, 1)], (2, 1), 3),
    Template::new(Slalom::F180, &[(0, 1), (1, 2), (2, 1)], (2, 0), 4),
];

/// Turns from a southern edge, looking north-east, so that the mouse leaves the cell through its
/// eastern edge.
const FROM_DIAGONAL: [Template; 3] = [
    Template::new(Slalom::F45, &[(1, 1)], (2, 1), 1),
    Template::new(Slalom::Fv90, &[(1, 1), (2, 0)], (2, 0), 2),
    Template::new(Slalom::F135, &[(1, 1), (2, 0)], (2, -1), 3),
];

impl Spot {
    const fn middle(cell: Cell, heading: Direction) -> Self {
        Self {
            at: (2 * cell.x as i32 + 1, 2 * cell.y as i32 + 1),
            eighth: 2 * heading.index() as i32,
        }
    }

    fn moves(self, open: &impl Fn(Point) -> bool, grid: Grid) -> Vec<Made> {
        let odd = (self.at.0 & 1) + (self.at.1 & 1);
        let mut made = Vec::new();
        match (odd, self.eighth % 2) {
            (2, 0) => {
                self.straights(open, grid, 2, &mut made);
                for template in &FROM_STRAIGHT {
                    self.turn(template, Side::Right, open, &mut made);
                    self.turn(template, Side::Left, open, &mut made);
                }
            }
            (1, 1) => {
                self.straights(open, grid, 1, &mut made);
                // On a southern edge and looking north-east, a mouse turns right; every eighth of a
                // turn more, and the other kind of edge, change that.
                let on_horizontal = self.at.0 & 1;
                let side = if (self.eighth / 2 + on_horizontal) % 2 == 1 {
                    Side::Right
                } else {
                    Side::Left
                };
                for template in &FROM_DIAGONAL {
                    self.turn(template, side, open, &mut made);
                }
            }
            _ => {}
        }
        made
    }

    /// Adds to `made` the straights of 1, 2, … cells. Each cell of a straight takes `steps` steps
    /// along the heading.
    fn straights(
        self,
        open: &impl Fn(Point) -> bool,
        grid: Grid,
        steps: i32,
        made: &mut Vec<Made>,
    ) {
        let (east, north) = step(self.eighth);
        let mut passed = Vec::new();
        for cells in 1..=2 * grid.width().max(grid.height()) {
            let far = |steps: i32| (self.at.0 + east * steps, self.at.1 + north * steps);
            // From the middle of a cell one crosses an edge on the way, from an edge at the end.
            let edge = far(steps * (i32::from(cells) - 1) + 1);
            if !open(edge) {
                return;
            }
            passed.push(edge);
            let to = Self {
                at: far(steps * i32::from(cells)),
                eighth: self.eighth,
            };
            let run_move = if steps == 2 {
                RunMove::Straight { cells }
            } else {
                RunMove::Diagonal { cells }
            };
            if to.leads_on(open) {
                made.push(Made {
                    run_move,
                    passed: passed.clone(),
                    to,
                });
            }
        }
    }

    fn turn(
        self,
        template: &Template,
        side: Side,
        open: &impl Fn(Point) -> bool,
        made: &mut Vec<Made>,
    ) {
        let place = |(right, ahead): Point| {
            // The templates of diagonals look north-east: mirrored on that line, not on north.
            let (x, y) = match (side, self.eighth % 2) {
                (Side::Right, _) => (right, ahead),
                (Side::Left, 0) => (-right, ahead),
                (Side::Left, _) => (ahead, right),
            };
            let (x, y) = match self.eighth / 2 {
                0 => (x, y),
                1 => (y, -x),
                2 => (-x, -y),
                _ => (-y, x),
            };
            (self.at.0 + x, self.at.1 + y)
        };
        let turned = match side {
            Side::Right => template.turned,
            Side::Left => -template.turned,
        };
        let to = Self {
            at: place(template.end),
            eighth: (self.eighth + turned).rem_euclid(8),
        };
        let passed: Vec<Point> = template.passed.iter().map(|point| place(*point)).collect();
        if passed.iter().all(|point| open(*point)) && to.leads_on(open) {
            made.push(Made {
                run_move: RunMove::Turn {
                    slalom: template.slalom,
                    side,
                },
                passed,
                to,
            });
        }
    }

    /// Returns whether a state leads on: on a diagonal the next edge has to be open, as there is no
    /// stopping on an edge.
    fn leads_on(self, open: &impl Fn(Point) -> bool) -> bool {
        let (east, north) = step(self.eighth);
        self.eighth % 2 == 0 || open((self.at.0 + east, self.at.1 + north))
    }
}

const fn step(eighth: i32) -> Point {
    match eighth {
        0 => (0, 1),
        1 => (1, 1),
        2 => (1, 0),
        3 => (1, -1),
        4 => (0, -1),
        5 => (-1, -1),
        6 => (-1, 0),
        _ => (-1, 1),
    }
}

fn is_goal(spot: Spot, goals: &[Cell]) -> bool {
    let middle = |goal: &Cell| (2 * i32::from(goal.x) + 1, 2 * i32::from(goal.y) + 1);
    spot.eighth % 2 == 0 && goals.iter().any(|goal| middle(goal) == spot.at)
}

/// Returns the knowledge of the wall whose middle is `point`.
fn knowledge(walls: &impl Walls, (x, y): Point) -> Knowledge {
    // The cell south-west of the middle of an edge, which is its western or southern side.
    let (Ok(column), Ok(row)) = (u16::try_from((x - 1) / 2), u16::try_from((y - 1) / 2)) else {
        return Knowledge::Wall;
    };
    let cell = Cell::new(column, row);
    if x <= 0 || y <= 0 || !walls.grid().contains(cell) {
        return Knowledge::Wall;
    }
    let direction = if x & 1 == 0 {
        Direction::East
    } else {
        Direction::North
    };
    walls.knowledge(cell, direction)
}

fn time_ms(run_move: RunMove, config: &SpeedRunConfig) -> u32 {
    let seconds = |drive: SpeedProfile, length: f64| {
        let (slow, fast, gain) = (
            config.turn_speed_mm_s,
            drive.top_speed_mm_s,
            drive.acceleration_mm_s2,
        );
        // Speed reached half-way, if the top speed allows it.
        let peak = libm::sqrt(slow * slow + gain * length).min(fast);
        let ramps = (peak * peak - slow * slow) / gain;
        2.0 * (peak - slow) / gain + (length - ramps) / peak
    };
    let cells = |cells: u16| f64::from(cells) * config.cell_mm;
    let whole = |seconds: f64| libm::ceil(seconds * 1000.0 - 1e-6) as u32;
    match run_move {
        RunMove::Straight { cells: n } => whole(seconds(config.straight, cells(n))),
        RunMove::Diagonal { cells: n } => whole(seconds(
            config.diagonal,
            cells(n) / core::f64::consts::SQRT_2,
        )),
        RunMove::Turn { slalom, .. } => u32::from(config.slalom.time_ms(slalom)),
    }
}
