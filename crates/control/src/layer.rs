use rand::Rng;
use tolman_geom::Heading;
use tolman_maze::Direction;
use tolman_robot::{Scan, TurnTranslate};

use crate::{Corridor, Outcome};

/// Perception of the robot in this time step.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// Ranges in the robot's frame, m. Infinity where nothing was met has the same effect as the
    /// largest range.
    pub scan: &'a Scan,
    /// The compass heading; 0 is east.
    pub heading: Heading,
}

/// A view, with the results that the stack computes once for all layers.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a> {
    /// Perception of the robot in this time step.
    pub view: View<'a>,
    /// Corridor that the robot is in, or `None` if the view does not look like one.
    pub corridor: Option<Corridor>,
}

/// Proposal of the layers so far for this time step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Proposal {
    /// Motor command for this time step.
    pub command: TurnTranslate,
    /// Outcome of the action if it ends with this step, or `None` while it goes on.
    pub ends: Option<Outcome>,
}

/// One layer of the stack.
///
/// A layer changes the proposal of the layer above and hands it on. It may keep state between the
/// steps of one action; [`Layer::begin`] says when a new one starts.
pub trait Layer: core::fmt::Debug {
    /// Starts a new high-level action.
    fn begin(&mut self, action: Direction) {
        let _ = action;
    }

    /// Corrects the proposal of the layer above for this time step.
    fn correct(
        &mut self,
        proposal: Proposal,
        situation: &Situation<'_>,
        rng: &mut dyn Rng,
    ) -> Proposal;
}
