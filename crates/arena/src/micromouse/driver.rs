//! What all our mice have in common: the map, the place, the two runs.

use tolman_maps::wall_map::{ClosedCells, Ray, WallMap};
use tolman_maze::{Cell, Direction, Maze, Walls};
use tolman_planners::moves::{Leap, MouseStep};
use tolman_planners::{Passages, Unknown};

use super::{Certificate, Mouse, MouseError, Order, RunTwo, SIDE, Sight};

/// How to explore.
pub trait Search {
    /// What to do next in the first run.
    fn next(&mut self, view: &View<'_>) -> Next;
}

/// What a search decides on.
#[derive(Debug)]
pub struct View<'a> {
    /// What is known, and how often the mouse has stood where.
    pub map: &'a WallMap<SIDE>,
    /// Where the mouse stands.
    pub at: Cell,
    /// Where runs begin.
    pub start: Cell,
    /// Where they end.
    pub goals: &'a [Cell],
}

/// What a search wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// Drive there.
    Drive(Leap),
    /// Turn on the spot.
    Turn,
    /// End the first run.
    Reset,
    /// No way leads to a goal.
    Stuck,
}

/// A mouse with a search for its first run and a plan for its second.
#[derive(Clone, Debug)]
pub struct Driver<S> {
    search: S,
    run_two: RunTwo,
    map: WallMap<SIDE>,
    start: (Cell, Direction),
    goals: Vec<Cell>,
    at: Cell,
    heading: Direction,
    /// The second run, what is left of it last first; none in the first.
    plan: Option<Vec<Leap>>,
    certificate: Option<Certificate>,
}

impl<S: Search> Driver<S> {
    /// A mouse at the start of a maze of which it knows the size, the start and the goals.
    ///
    /// # Errors
    /// If the maze is larger than [`SIDE`] or has no start.
    pub fn new(maze: &Maze, search: S, run_two: RunTwo) -> Result<Self, MouseError> {
        let start = maze.start().ok_or(MouseError::NoStart)?;
        let mut map = WallMap::new(maze.grid(), ClosedCells::Possible)?;
        map.visit(start.0);
        Ok(Self {
            search,
            run_two,
            map,
            start,
            goals: maze.goals().to_vec(),
            at: start.0,
            heading: start.1,
            plan: None,
            certificate: None,
        })
    }

    /// What the mouse knows.
    pub const fn map(&self) -> &WallMap<SIDE> {
        &self.map
    }

    fn look(&mut self, sight: Sight) -> Result<(), MouseError> {
        let rays = [
            Ray::to_wall(self.heading.left(), sight.left),
            Ray::to_wall(self.heading, sight.front),
            Ray::to_wall(self.heading.right(), sight.right),
        ];
        self.map.observe(self.at, &rays)?;
        Ok(())
    }

    fn drive(&mut self, leap: Leap) -> Order {
        let mut cell = self.at;
        for _ in 0..leap.cells {
            let next = self.map.grid().neighbour(cell, leap.direction);
            cell = next.unwrap_or(cell);
            self.map.visit(cell);
        }
        self.at = leap.end;
        MouseStep::of_leap(&mut self.heading, leap).into()
    }

    /// The first run is over.
    fn reset(&mut self) -> Result<Order, MouseError> {
        let known = Passages::new(&self.map, Unknown::Closed);
        let plan = self.run_two.plan(&known, self.start.0, &self.goals);
        let mut plan = plan.ok_or(MouseError::Stuck)?;
        self.certificate = Certificate::of(&self.map, self.start.0, &self.goals, &plan);
        plan.reverse();
        self.plan = Some(plan);
        (self.at, self.heading) = self.start;
        Ok(Order::RESET)
    }
}

impl<S: Search> Mouse for Driver<S> {
    fn next(&mut self, sight: Sight) -> Result<Order, MouseError> {
        if let Some(plan) = &mut self.plan {
            let leap = plan.pop().ok_or(MouseError::Stuck)?;
            return Ok(self.drive(leap));
        }
        self.look(sight)?;
        let view = View {
            map: &self.map,
            at: self.at,
            start: self.start.0,
            goals: &self.goals,
        };
        match self.search.next(&view) {
            Next::Drive(leap) => Ok(self.drive(leap)),
            Next::Turn => {
                self.heading = self.heading.right();
                Ok(Order::new(90, 0))
            }
            Next::Reset => self.reset(),
            Next::Stuck => Err(MouseError::Stuck),
        }
    }

    fn certificate(&self) -> Option<Certificate> {
        self.certificate.clone()
    }
}
