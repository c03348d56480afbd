//! Our mouse: it explores, drives home and makes the run that scores least.

use std::io::{BufRead, Write};

use tolman_maps::wall_map::{CellRay, ClosedCells, WallMap};
use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};
use tolman_planners::lattice::{LatticeHeading, LatticePoint, LatticePose};
use tolman_planners::{Passages, StepMap, TooLarge, Unknown, costs_from};

use super::PlayError;
use super::link::{Driven, Link};
use super::plan::{Plan, ends_run, plan, score};
use super::roads::{Roads, TurnsAtStart};
use crate::micromouse::Until;

/// Result of a game.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Played {
    /// Score of the run that the mouse made, in half-steps, without the tenth of all movements.
    pub run: f32,
    /// Score of the best run that is possible with the known walls.
    pub possible: f32,
    /// Number of times that the reset button was pressed or a crash made it go back to the start.
    pub resets: u32,
}

/// Number of crashes and resets after which a mouse gives up.
const MOST_RESETS: u32 = 8;

/// Number of last observations that a crash makes doubtful.
const DOUBTFUL: usize = 2;

/// Plays one maze, from `mazeWidth` to the end of the best run, and returns the result. `output`
/// goes to the simulator, `input` comes from it, and `log` is for people.
///
/// The mouse starts in the south-west and looks north; its goal is the middle of the maze. In every
/// cell where it stops it asks for the distances to walls on all four sides. It plans in the
/// simulator's score, diagonals included. It explores like the mouse of the [speed
/// run](tolman_planners::speed_run). It looks at the unknown walls of the best possible run, the
/// nearest first. After a press of the reset button it continues from the start. After a crash,
/// too, it continues from the start, and forgets its last observations.
///
/// # Errors
/// If the simulator ends or gives an invalid reply, the maze has more than 32 columns or rows, or
/// no way leads to its goal.
pub fn play(
    input: impl BufRead,
    output: impl Write,
    log: impl Write,
    until: Until,
) -> Result<Played, PlayError> {
    let mut link = Link::new(input, output);
    let grid = Grid::new(link.number("mazeWidth")?, link.number("mazeHeight")?);
    if grid.width().max(grid.height()) <= 16 {
        Mouse::<16, _, _, _>::new(link, log, grid, until)?.play()
    } else {
        Mouse::<32, _, _, _>::new(link, log, grid, until)?.play()
    }
}

struct Mouse<const N: usize, R, W, L> {
    link: Link<R, W>,
    log: L,
    until: Until,
    walls: WallMap<N>,
    goals: Vec<Cell>,
    at: LatticePose,
    /// Best run that could be hoped for at the last planning.
    hoped: Option<Plan>,
    goal: Goal,
    resets: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Goal {
    Ahead,
    Visited,
}

/// Whether the mouse's position is the expected one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Course {
    Kept,
    /// The mouse is back at the start.
    Lost,
}

impl<const N: usize, R: BufRead, W: Write, L: Write> Mouse<N, R, W, L> {
    fn new(link: Link<R, W>, log: L, grid: Grid, until: Until) -> Result<Self, PlayError> {
        Ok(Self {
            link,
            log,
            until,
            walls: WallMap::new(grid, ClosedCells::Possible)?,
            goals: grid.middle().collect(),
            at: LatticePose::START,
            hoped: None,
            goal: Goal::Ahead,
            resets: 0,
        })
    }

    fn play(mut self) -> Result<Played, PlayError> {
        let grid = self.walls.grid();
        self.say(&format!("{} × {} cells", grid.width(), grid.height()))?;
        loop {
            self.show_stage("explore")?;
            if self.explore()? == Course::Lost {
                continue;
            }
            let (Some(run), Some(hoped)) = (self.best_run(Unknown::Closed)?, &self.hoped) else {
                return Err(PlayError::NoWay);
            };
            let possible = hoped.cost;
            self.say(&format!(
                "the best run known scores {}, the best possible {}",
                score(run.cost),
                score(possible)
            ))?;
            self.show_stage("home")?;
            let home = self.way_home()?.ok_or(PlayError::NoWay)?;
            if self.follow(&home.stands)? == Course::Lost {
                continue;
            }
            self.show_stage("run")?;
            self.show_run(&run)?;
            if self.follow(&run.stands)? == Course::Lost {
                continue;
            }
            self.say("at the goal")?;
            self.show_stage("done")?;
            self.link.close()?;
            return Ok(Played {
                run: score(run.cost),
                possible: score(possible),
                resets: self.resets,
            });
        }
    }

    /// Explores until the mouse has been at the goal and knows enough.
    fn explore(&mut self) -> Result<Course, PlayError> {
        loop {
            self.look()?;
            if self.is_goal(self.at) && self.goal == Goal::Ahead {
                self.goal = Goal::Visited;
                self.say("at the goal for the first time")?;
            }
            let Some(targets) = self.targets()? else {
                return Ok(Course::Kept);
            };
            let way = self.way_to(&targets)?.ok_or(PlayError::NoWay)?;
            if self.follow(&way.stands)? == Course::Lost {
                return Ok(Course::Lost);
            }
        }
    }

    /// Takes in the distances to walls on all four sides, and draws the walls that are new.
    fn look(&mut self) -> Result<(), PlayError> {
        let cell = self.at.place.cell();
        let mut rays = Vec::with_capacity(4);
        for (command, eighths) in [
            ("wallFront", 0),
            ("wallRight", 2),
            ("wallBack", 4),
            ("wallLeft", 6),
        ] {
            if let Some(side) = self.at.heading.turned(eighths).side() {
                rays.push(self.ray(command, cell, side)?);
            }
        }
        for ray in &rays {
            let mut end = cell;
            for _ in 0..ray.open {
                end = self.neighbour(end, ray.direction);
            }
            if self.walls.knowledge(end, ray.direction) == Knowledge::Unknown {
                self.link.show_wall(end, ray.direction)?;
            }
        }
        self.walls.observe(cell, &rays)?;
        Ok(())
    }

    /// Returns the view to one side. Known walls are not asked for again.
    fn ray(&mut self, command: &str, cell: Cell, side: Direction) -> Result<CellRay, PlayError> {
        let (mut open, mut end) = (0, cell);
        loop {
            let is_wall = match self.walls.knowledge(end, side) {
                Knowledge::Wall => true,
                Knowledge::Open => false,
                // Older simulators know no distance: what stands right beside the mouse is asked
                // for without.
                Knowledge::Unknown if open == 0 => self.link.truth(command)?,
                Knowledge::Unknown => self.link.truth(&format!("{command} {}", 2 * open + 1))?,
            };
            if is_wall {
                return Ok(CellRay::to_wall(side, open));
            }
            end = self.neighbour(end, side);
            open += 1;
        }
    }

    /// Returns the cells in which to stop next, or `None` if the mouse has been at the goal and
    /// knows enough.
    fn targets(&mut self) -> Result<Option<Vec<Cell>>, PlayError> {
        // In this score no look beyond the goal was found to pay.
        let is_enough = match self.until {
            Until::Goal | Until::Worth => self.goal == Goal::Visited,
            Until::Proof => false,
        };
        if is_enough {
            self.replan()?;
            return Ok(None);
        }
        let run = self.replan()?.ok_or(PlayError::NoWay)?;
        let mut targets = Vec::new();
        for (cell, side) in run.edges(self.walls.grid()) {
            if self.walls.knowledge(cell, side) == Knowledge::Unknown {
                targets.push(cell);
                targets.extend(self.walls.grid().neighbour(cell, side));
            }
        }
        if self.goal == Goal::Ahead {
            targets.extend(&self.goals);
        }
        Ok((!targets.is_empty()).then_some(targets))
    }

    /// Returns the best run that can be hoped for. Walls make no run better, so one that is not
    /// blocked stays the best.
    fn replan(&mut self) -> Result<Option<Plan>, TooLarge> {
        let walls = &self.walls;
        let is_wall = |(cell, side): (Cell, _)| walls.knowledge(cell, side) == Knowledge::Wall;
        let hoped = self.hoped.take();
        let still = hoped.filter(|plan| !plan.edges(walls.grid()).any(is_wall));
        self.hoped = match still {
            Some(plan) => Some(plan),
            None => self.best_run(Unknown::Open)?,
        };
        Ok(self.hoped.clone())
    }

    fn best_run(&self, unknown: Unknown) -> Result<Option<Plan>, TooLarge> {
        let passages = Passages::<N>::new(&self.walls, unknown)?;
        let roads = Roads::new(self.walls.grid(), &passages, TurnsAtStart::Free);
        Ok(plan(&roads, LatticePose::START, |stand| {
            self.is_goal(stand)
        }))
    }

    fn is_goal(&self, stand: LatticePose) -> bool {
        ends_run(stand, &self.goals)
    }

    /// Returns the way on known ground to the position from which a target is nearest.
    fn way_to(&self, targets: &[Cell]) -> Result<Option<Plan>, TooLarge> {
        let grid = self.walls.grid();
        let hoped = Passages::<N>::new(&self.walls, Unknown::Open)?;
        let beyond = StepMap::new(&hoped, targets.iter().copied());
        let known = Passages::<N>::new(&self.walls, Unknown::Closed)?;
        let roads = Roads::new(grid, &known, TurnsAtStart::Count);
        let costs = costs_from(&roads, [roads.node(self.at)]);
        let cost_to = |cell: Cell| {
            let headings = (0..8).map(LatticeHeading::from_index);
            let nodes = headings.map(|heading| {
                let place = LatticePoint::middle_of(cell);
                roads.node(LatticePose { place, heading })
            });
            nodes
                .filter_map(|node| costs.get(node as usize).copied().flatten())
                .min()
        };
        let here = self.at.place.cell();
        let worth_it = |cell: &Cell| {
            *cell != here && (targets.contains(cell) || self.walls.uncertainty(*cell) > 0)
        };
        let stop = grid
            .cells()
            .filter(worth_it)
            .filter_map(|cell| {
                let on = u32::from(beyond.steps(cell)?);
                Some((cost_to(cell)? + ONE_CELL * on, cell))
            })
            .min_by_key(|(cost, _)| *cost);
        Ok(stop.and_then(|(_, cell)| {
            let place = LatticePoint::middle_of(cell);
            plan(&roads, self.at, |stand| stand.place == place)
        }))
    }

    /// Returns the way home on known ground.
    fn way_home(&self) -> Result<Option<Plan>, TooLarge> {
        let known = Passages::<N>::new(&self.walls, Unknown::Closed)?;
        let roads = Roads::new(self.walls.grid(), &known, TurnsAtStart::Count);
        Ok(plan(&roads, self.at, |stand| {
            stand.place == LatticePoint::START
        }))
    }

    /// Drives from stand to stand. The first one is at most a turn away.
    fn follow(&mut self, stands: &[LatticePose]) -> Result<Course, PlayError> {
        for stand in stands {
            if self.link.truth("wasReset")? {
                self.say("reset")?;
                return self.go_back();
            }
            if self.go(*stand)? == Driven::Crashed {
                self.say("crashed: back to the start")?;
                // One of the walls seen last is not as it seemed, and with it what was planned on
                // it.
                self.walls.undo(DOUBTFUL);
                self.hoped = None;
                return self.go_back();
            }
        }
        Ok(Course::Kept)
    }

    fn go_back(&mut self) -> Result<Course, PlayError> {
        self.link.acknowledged("ackReset")?;
        self.at = LatticePose::START;
        self.resets += 1;
        match self.resets > MOST_RESETS {
            true => Err(PlayError::SentBack { times: self.resets }),
            false => Ok(Course::Lost),
        }
    }

    /// Makes one movement: a turn, or a straight.
    fn go(&mut self, to: LatticePose) -> Result<Driven, PlayError> {
        while self.at.heading != to.heading {
            let left = (to.heading.index() + 8 - self.at.heading.index()) % 8;
            let (command, eighths) = match left {
                1 => ("turnRight45", 1),
                2..=4 => ("turnRight", 2),
                7 => ("turnLeft45", -1),
                _ => ("turnLeft", -2),
            };
            self.link.acknowledged(command)?;
            self.at.heading = self.at.heading.turned(eighths);
        }
        let (dx, dy) = (
            to.place.x.abs_diff(self.at.place.x),
            to.place.y.abs_diff(self.at.place.y),
        );
        let half_steps = dx.max(dy);
        if half_steps == 0 {
            return Ok(Driven::Arrived);
        }
        self.at.place = to.place;
        if half_steps % 2 == 0 && self.at.heading.side().is_some() {
            self.link.drive(&format!("moveForward {}", half_steps / 2))
        } else {
            self.link.drive(&format!("moveForwardHalf {half_steps}"))
        }
    }

    fn neighbour(&self, cell: Cell, side: Direction) -> Cell {
        self.walls.grid().neighbour(cell, side).unwrap_or(cell)
    }

    fn show_stage(&mut self, stage: &str) -> Result<(), PlayError> {
        self.link.tell(&format!("setText 0 0 {stage}"))
    }

    /// Colours the cells of a run.
    fn show_run(&mut self, run: &Plan) -> Result<(), PlayError> {
        for (cell, side) in run.edges(self.walls.grid()) {
            let beyond = self.neighbour(cell, side);
            for cell in [cell, beyond] {
                self.link
                    .tell(&format!("setColor {} {} g", cell.x, cell.y))?;
            }
        }
        Ok(())
    }

    fn say(&mut self, what: &str) -> Result<(), PlayError> {
        writeln!(self.log, "tolman mouse: {what}").map_err(PlayError::Log)
    }
}

/// Cost of a cell on an unknown way, in halves: the minimum, on a long straight. A higher cost
/// sends the mouse far for what lies near a target (`docs/notebook/micromouse.md`).
const ONE_CELL: u32 = 2;

#[cfg(test)]
mod tests {
    use std::io;

    use super::*;

    #[test]
    fn nonsense_is_refused() {
        let heard = |replies: &str| {
            play(replies.as_bytes(), io::sink(), io::sink(), Until::Proof)
                .map_err(|error| error.to_string())
        };
        for (replies, part) in [
            ("x\n", "`mazeWidth`"),
            ("16\n-3\n", "`mazeHeight`"),
            ("0\n16\n", "\"0\""),
            ("33\n16\n", "33 × 16"),
            ("16\n16\nyes\n", "true or false"),
            ("3\n3\ntrue\ntrue\n", "no way"),
        ] {
            let error = heard(replies).unwrap_err();
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn a_reply_that_is_no_text_or_never_ends_is_refused() {
        let heard = |replies: &mut dyn BufRead| {
            let error = play(replies, io::sink(), io::sink(), Until::Proof).unwrap_err();
            assert!(matches!(error, PlayError::Reply { .. }), "{error}");
            error.to_string()
        };
        assert!(heard(&mut &b"\xff\xfe\n"[..]).contains('\u{fffd}'));
        let mut endless = io::BufReader::new(io::repeat(b'1'));
        assert!(
            heard(&mut endless).len() < 1000,
            "its beginning says enough"
        );
    }
}
