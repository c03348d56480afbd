//! The independent checker. It shares no code with the search. Its geometry is the
//! [lattice](crate::lattice) of half cells. It has its own times, and an explicit graph, which it
//! searches by the general Dijkstra of this crate.

use alloc::vec::Vec;

use thiserror::Error;
use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};

use super::{RunMove, Side, Slalom, SpeedProfile, SpeedRunConfig};
use crate::lattice::{Gate, LatticeHeading, LatticePoint, LatticePose};
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
    /// of a cell, or the mouse does not make this turn.
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
        let actual_ms = self.driven_ms(walls, config, goals)?;
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

    /// Drives the moves on walls known to be open, whatever the stated time, and returns how long
    /// they take, ms.
    ///
    /// # Errors
    /// If a move is impossible or not known to be open, or the run does not end at one of `goals`.
    pub fn driven_ms(
        &self,
        walls: &impl Walls,
        config: &SpeedRunConfig,
        goals: &[Cell],
    ) -> Result<u32, SpeedRunCertificateError> {
        let mut at = in_middle(self.start, self.heading);
        let mut actual_ms = 0;
        for (number, run_move) in self.moves.iter().copied().enumerate() {
            let made = moves(at, &|_| true, walls.grid())
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
            actual_ms += time_ms(run_move, config)
                .ok_or(SpeedRunCertificateError::Impossible { number, run_move })?;
            at = made.to;
        }
        if !is_goal(at, goals) {
            return Err(SpeedRunCertificateError::NotAtGoal);
        }
        Ok(actual_ms)
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
    let mut arcs = Vec::new();
    let mut ends = Vec::new();
    for number in 0..LatticePose::count(grid) {
        let pose = LatticePose::from_index(number, grid);
        if is_goal(pose, goals) {
            ends.push(number);
        }
        for made in moves(pose, &open, grid) {
            if let Some(time_ms) = time_ms(made.run_move, config) {
                arcs.push((number, made.to.index(grid), time_ms));
            }
        }
    }
    let graph = Arcs::new(LatticePose::count(grid) as usize, &arcs);
    let costs = costs_from(&graph, [in_middle(start, heading).index(grid)]);
    ends.into_iter()
        .filter_map(|end| costs.get(end as usize).copied().flatten())
        .min()
}

struct Made {
    run_move: RunMove,
    /// Middles of the edges that the move crosses, including the edge at its end.
    passed: Vec<LatticePoint>,
    to: LatticePose,
}

/// Half-steps to the right and ahead of a mouse that looks north.
type Offset = (i32, i32);

/// A turn to the right.
struct Template {
    slalom: Slalom,
    passed: &'static [Offset],
    end: Offset,
    /// Turn in eighths of a circle.
    turned: i8,
}

impl Template {
    const fn new(slalom: Slalom, passed: &'static [Offset], end: Offset, turned: i8) -> Self {
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

/// Turn from a southern edge, looking north.
const FROM_EDGE: Template = Template::new(Slalom::Fs90, &[(1, 1)], (1, 1), 2);

/// Returns the pose in the middle of a cell.
const fn in_middle(cell: Cell, heading: Direction) -> LatticePose {
    LatticePose {
        place: LatticePoint::middle_of(cell),
        heading: LatticeHeading::towards(heading),
    }
}

/// Returns the moves that can be made from a pose on edges whose middles are `open`.
fn moves(from: LatticePose, open: &impl Fn(LatticePoint) -> bool, grid: Grid) -> Vec<Made> {
    let LatticePose { place, heading } = from;
    let mut made = Vec::new();
    match (place.x % 2 + place.y % 2, heading.index() % 2) {
        (2, 0) => {
            straights(from, open, grid, &mut made);
            for template in &FROM_STRAIGHT {
                made.extend(turn(from, template, Side::Right, open));
                made.extend(turn(from, template, Side::Left, open));
            }
        }
        // On an edge, looking across it.
        (1, 0) if u32::from(heading.index() % 4 == 0) == place.x % 2 => {
            straights(from, open, grid, &mut made);
            made.extend(turn(from, &FROM_EDGE, Side::Right, open));
            made.extend(turn(from, &FROM_EDGE, Side::Left, open));
        }
        (1, 1) => {
            straights(from, open, grid, &mut made);
            // On a southern edge and looking north-east, a mouse turns right; every eighth of a
            // turn more, and the other kind of edge, change that.
            let side = if (heading.index() / 2 + place.x) % 2 == 1 {
                Side::Right
            } else {
                Side::Left
            };
            for template in &FROM_DIAGONAL {
                made.extend(turn(from, template, side, open));
            }
        }
        _ => {}
    }
    made
}

/// Adds to `made` the straights of 1, 2, … half cells, or half cell diagonals.
fn straights(
    from: LatticePose,
    open: &impl Fn(LatticePoint) -> bool,
    grid: Grid,
    made: &mut Vec<Made>,
) {
    let heading = from.heading;
    let mut place = from.place;
    let mut passed = Vec::new();
    for length in 1..=4 * grid.width().max(grid.height()) {
        place = place.ahead(heading);
        if !open(place) {
            return;
        }
        // Middles of cells, which have two odd coordinates, are no edges.
        if (place.x % 2, place.y % 2) != (1, 1) {
            passed.push(place);
        }
        let run_move = if heading.side().is_some() {
            RunMove::Straight { half_cells: length }
        } else {
            RunMove::Diagonal { cells: length }
        };
        let to = LatticePose { place, heading };
        if leads_on(to, open) {
            made.push(Made {
                run_move,
                passed: passed.clone(),
                to,
            });
        }
    }
}

/// Returns the turn that a template describes, if it can be made.
fn turn(
    from: LatticePose,
    template: &Template,
    side: Side,
    open: &impl Fn(LatticePoint) -> bool,
) -> Option<Made> {
    let place = |(right, ahead): Offset| {
        // The templates of diagonals look north-east: mirrored on that line, not on north.
        let (x, y) = match (side, from.heading.side()) {
            (Side::Right, _) => (right, ahead),
            (Side::Left, Some(_)) => (-right, ahead),
            (Side::Left, None) => (ahead, right),
        };
        from.place.moved(match from.heading.index() / 2 {
            0 => (x, y),
            1 => (y, -x),
            2 => (-x, -y),
            _ => (-y, x),
        })
    };
    let turned = match side {
        Side::Right => template.turned,
        Side::Left => -template.turned,
    };
    let to = LatticePose {
        place: place(template.end),
        heading: from.heading.turned(turned),
    };
    let passed: Vec<LatticePoint> = template.passed.iter().map(|point| place(*point)).collect();
    let is_possible = passed.iter().all(|point| open(*point)) && leads_on(to, open);
    is_possible.then_some(Made {
        run_move: RunMove::Turn {
            slalom: template.slalom,
            side,
        },
        passed,
        to,
    })
}

/// Returns whether a state leads on: on a diagonal the next edge has to be open, as there is no
/// stopping on an edge.
fn leads_on(pose: LatticePose, open: &impl Fn(LatticePoint) -> bool) -> bool {
    pose.heading.side().is_some() || open(pose.place.ahead(pose.heading))
}

/// Returns whether the pose is in the middle of a goal, where a run ends along a straight.
fn is_goal(pose: LatticePose, goals: &[Cell]) -> bool {
    let is_there = |goal: &Cell| LatticePoint::middle_of(*goal) == pose.place;
    pose.heading.side().is_some() && goals.iter().any(is_there)
}

/// Returns the knowledge of the wall whose middle is `point`.
fn knowledge(walls: &impl Walls, point: LatticePoint) -> Knowledge {
    match point.obstacle(walls.grid()) {
        Gate::Edge(cell, side) => walls.knowledge(cell, side),
        Gate::None => Knowledge::Open,
        Gate::Solid => Knowledge::Wall,
    }
}

/// Returns the duration of a move, ms, or `None` if the mouse does not make it.
fn time_ms(run_move: RunMove, config: &SpeedRunConfig) -> Option<u32> {
    let seconds = |drive: SpeedProfile, length: f64| {
        let (slow, fast) = (config.turn_speed_mm_s, drive.top_speed_mm_s);
        let (up, down) = (drive.acceleration_mm_s2, drive.braking());
        // Speed reached where the mouse has to brake, if the top speed allows it.
        let share = up * down / (up + down);
        let peak = libm::sqrt(slow * slow + 2.0 * share * length).min(fast);
        let ramps = (peak * peak - slow * slow) / (2.0 * share);
        (peak - slow) / up + (peak - slow) / down + (length - ramps) / peak
    };
    let half_cells = |halves: u16| f64::from(halves) * config.cell_mm / 2.0;
    let whole = |seconds: f64| libm::ceil(seconds * 1000.0 - 1e-6) as u32;
    match run_move {
        RunMove::Straight { half_cells: n } => Some(whole(seconds(config.straight, half_cells(n)))),
        RunMove::Diagonal { cells: n } => Some(whole(seconds(
            config.diagonal,
            half_cells(n) * core::f64::consts::SQRT_2,
        ))),
        RunMove::Turn { slalom, side } => config.turn_ms(slalom, side).ok().flatten(),
    }
}
