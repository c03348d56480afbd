use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

use rand::Rng;
use tolman_maze::Direction;
use tolman_robot::Ring;

use crate::{
    Avoid, Center, CorridorDetector, Layer, Move, Orient, Outcome, Proposal, RingError, Settle,
    Situation, StuckBeams, View, straightened,
};

/// The layers in their order, the highest first.
///
/// ```
/// use rand_chacha::ChaCha8Rng;
/// use rand_chacha::rand_core::SeedableRng;
/// use tolman_control::{Stack, View};
/// use tolman_geom::Heading;
/// use tolman_maze::Direction;
/// use tolman_robot::{Ring, Scan};
///
/// let ring = Ring::full(72, 0.75);
/// let mut stack = Stack::paper(ring, 0.3, 0.57)?;
/// stack.begin(Direction::North);
/// // It looks east: the layers turn it to the left first.
/// let view = View { scan: &Scan::clear(ring), heading: Heading::EAST };
/// let proposal = stack.correct(view, &mut ChaCha8Rng::seed_from_u64(1));
/// assert!(proposal.command.turn > 0.0);
/// # Ok::<(), tolman_control::RingError>(())
/// ```
#[derive(Debug)]
pub struct Stack {
    detector: CorridorDetector,
    layers: Vec<Box<dyn Layer + Send>>,
    /// Repair of the scans of a laser with stuck beams.
    mending: Option<StuckBeams>,
}

impl Stack {
    /// Returns a stack of any layers, the highest first, with a shared detector.
    ///
    /// Whether every action ends is up to the layers. [`Stack::paper`] ends them all. A stack
    /// without [`Settle`] can turn to and fro forever, and one without [`Move`] has no end of its
    /// own. A [`Drive`](crate::Drive) breaks such an action off as [`Outcome::TimedOut`]. If you
    /// call [`correct`](Self::correct) yourself, count the time steps.
    #[must_use]
    pub fn new(detector: CorridorDetector, layers: Vec<Box<dyn Layer + Send>>) -> Self {
        Self {
            detector,
            layers,
            mending: None,
        }
    }

    /// Returns the paper's four layers with the paper's gains, and [`Settle`] below them, which
    /// ends oscillations. The robot is `robot_unit` metres in diameter and sees through `ring`, in
    /// corridors `width` metres wide.
    ///
    /// # Errors
    /// [`RingError`] if the ring is not a full circle of quarters or a length is invalid.
    pub fn paper(ring: Ring, robot_unit: f64, width: f64) -> Result<Self, RingError> {
        if !(robot_unit.is_finite() && robot_unit > 0.0) {
            return Err(RingError::RobotUnit { robot_unit });
        }
        Ok(Self::new(
            CorridorDetector::new(ring, width)?,
            vec![
                Box::new(Move::paper()),
                Box::new(Orient::paper(ring.beams, width)),
                Box::new(Center::paper()),
                Box::new(Avoid::paper(ring.beams, robot_unit)),
                Box::new(Settle::ours()),
            ],
        ))
    }

    /// Returns this stack, which sees scans without [stuck beams](StuckBeams) and [straightened].
    /// It is for lasers with errors, which would make Orient turn to and fro.
    #[must_use]
    pub fn straightening(self) -> Self {
        Self {
            mending: Some(StuckBeams::default()),
            ..self
        }
    }

    /// Returns the ring whose scans the layers read.
    #[must_use]
    pub const fn ring(&self) -> Ring {
        self.detector.ring()
    }

    /// Starts a high-level action. Without it the stack goes north; an action that has ended and is
    /// not followed by another starts again.
    pub fn begin(&mut self, action: Direction) {
        for layer in &mut self.layers {
            layer.begin(action);
        }
    }

    /// Returns the command for this time step, and the outcome of the action if it ends with it. If
    /// the view cannot be [read](CorridorDetector::reads), the action fails with the robot at rest.
    /// Such views are a scan of another ring or a compass that reads NaN. O(beams).
    pub fn correct(&mut self, view: View<'_>, rng: &mut dyn Rng) -> Proposal {
        if !self.detector.reads(view) {
            return Proposal {
                ends: Some(Outcome::Failed),
                ..Proposal::default()
            };
        }
        let mending = self.mending.as_mut();
        let straight = mending.map(|beams| straightened(&beams.mended(view.scan)));
        let view = View {
            scan: straight.as_ref().unwrap_or(view.scan),
            ..view
        };
        let situation = Situation {
            view,
            corridor: self.detector.detect(view),
        };
        self.layers
            .iter_mut()
            .fold(Proposal::default(), |proposal, layer| {
                layer.correct(proposal, &situation, rng)
            })
    }
}
