//! The common part of all our mice: map, place and both runs.

use tolman_maps::wall_map::{CellRay, ClosedCells, WallMap};
use tolman_maze::{Cell, Direction, Walls};
use tolman_planners::moves::{Leap, MouseStep};
use tolman_planners::{Passages, TooLarge, Unknown};

use super::{Brief, Certificate, MouseError, Order, RunTwo, SIDE, Sight};

/// A strategy of exploration.
pub trait Search {
    /// Returns the next action in the first run.
    ///
    /// # Errors
    /// If the maze is larger than the search can hold.
    fn next(&mut self, view: &SearchView<'_>) -> Result<Next, TooLarge>;
}

impl<S: Search + ?Sized> Search for Box<S> {
    fn next(&mut self, view: &SearchView<'_>) -> Result<Next, TooLarge> {
        (**self).next(view)
    }
}

/// Input of a search.
#[derive(Debug)]
pub struct SearchView<'a> {
    /// Known walls, and the number of visits to each cell.
    pub map: &'a WallMap<SIDE>,
    /// Cell of the mouse.
    pub at: Cell,
    /// Cell where runs begin.
    pub start: Cell,
    /// Cells where runs end.
    pub goals: &'a [Cell],
}

/// Decision of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// Drive there.
    Drive(Leap),
    /// Turn in place.
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
    brief: Brief,
    at: Cell,
    heading: Direction,
    /// Rest of the second run, its last leap first; `None` in the first run.
    plan: Option<Vec<Leap>>,
    certificate: Option<Certificate>,
}

impl<S: Search> Driver<S> {
    /// Returns a mouse at the start of the maze that `brief` describes.
    ///
    /// # Errors
    /// If the maze is larger than [`SIDE`].
    pub fn new(brief: Brief, search: S, run_two: RunTwo) -> Result<Self, MouseError> {
        let mut map = WallMap::new(brief.grid, ClosedCells::Possible)?;
        map.visit(brief.start);
        Ok(Self {
            search,
            run_two,
            map,
            at: brief.start,
            heading: brief.heading,
            brief,
            plan: None,
            certificate: None,
        })
    }

    /// Returns the mouse's map.
    pub const fn map(&self) -> &WallMap<SIDE> {
        &self.map
    }

    fn look(&mut self, sight: Sight) -> Result<(), MouseError> {
        let rays = [
            CellRay::to_wall(self.heading.left(), sight.left),
            CellRay::to_wall(self.heading, sight.front),
            CellRay::to_wall(self.heading.right(), sight.right),
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

    /// Ends the first run: plans the second one, and returns the reset.
    fn reset(&mut self) -> Result<Order, MouseError> {
        let known = Passages::new(&self.map, Unknown::Closed)?;
        let plan = self
            .run_two
            .plan(&known, self.brief.start, &self.brief.goals);
        let mut plan = plan.ok_or(MouseError::Stuck)?;
        self.certificate = Certificate::of(&self.map, self.brief.start, &self.brief.goals, &plan)?;
        plan.reverse();
        self.plan = Some(plan);
        (self.at, self.heading) = (self.brief.start, self.brief.heading);
        Ok(Order::RESET)
    }

    /// Returns the next order, given the present reading of the sensors. Called once per step.
    ///
    /// # Errors
    /// If the mouse cannot decide.
    pub fn next(&mut self, sight: Sight) -> Result<Order, MouseError> {
        if let Some(plan) = &mut self.plan {
            let leap = plan.pop().ok_or(MouseError::Stuck)?;
            return Ok(self.drive(leap));
        }
        self.look(sight)?;
        let view = SearchView {
            map: &self.map,
            at: self.at,
            start: self.brief.start,
            goals: &self.brief.goals,
        };
        match self.search.next(&view)? {
            Next::Drive(leap) => Ok(self.drive(leap)),
            Next::Turn => {
                self.heading = self.heading.right();
                Ok(Order::new(90, 0))
            }
            Next::Reset => self.reset(),
            Next::Stuck => Err(MouseError::Stuck),
        }
    }

    /// Returns the proof that no second run is shorter, once the mouse has one.
    pub const fn certificate(&self) -> Option<&Certificate> {
        self.certificate.as_ref()
    }
}
