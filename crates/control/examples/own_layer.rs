//! A layer of your own: it halves the speed where something is near.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_control::rand::Rng;
use tolman_control::{CorridorDetector, Layer, Move, RingError, Settle};
use tolman_control::{Proposal, Situation, Stack, View};
use tolman_geom::Heading;
use tolman_maze::Direction;
use tolman_robot::{Ring, Scan};

#[derive(Debug)]
struct Caution {
    /// Distance below which a thing is near, m.
    near: f64,
}

impl Layer for Caution {
    fn correct(&mut self, above: Proposal, now: &Situation<'_>, _: &mut dyn Rng) -> Proposal {
        let mut proposal = above;
        if now.view.scan.ranges.iter().any(|range| *range < self.near) {
            proposal.command.translate *= 0.5;
        }
        proposal
    }
}

fn main() -> Result<(), RingError> {
    let ring = Ring::full(72, 1.25);
    let mut stack = Stack::new(
        CorridorDetector::new(ring, 0.95)?,
        vec![
            Box::new(Move::paper()),
            Box::new(Caution { near: 0.4 }),
            Box::new(Settle::ours()),
        ],
    );
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut speed = |scan: &Scan| {
        let heading = Heading::EAST;
        stack.begin(Direction::East);
        let step = stack.correct(View { scan, heading }, &mut rng);
        step.command.translate
    };
    let in_the_open = speed(&Scan::clear(ring));
    let mut scan = Scan::clear(ring);
    scan.ranges[18] = 0.3; // on the left
    assert!(in_the_open > 0.0);
    assert_eq!(speed(&scan).to_bits(), (0.5 * in_the_open).to_bits());
    Ok(())
}
