//! Every action ends, whatever the ring, the drive and the corridor.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_control::{
    Avoid, Center, CorridorDetector, Layer, Move, Orient, Proposal, Settle, Situation, Stack, View,
};
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maze::Direction;
use tolman_robot::{Ring, Scan};

/// Diameter of the robot, m.
const UNIT: f64 = 0.5;

/// More time steps than any action takes that ends.
const LONG: u32 = 90;

/// A corridor that runs east for ten widths and is closed at both ends, or a free plain.
#[derive(Clone, Copy, Debug)]
enum Place {
    Corridor { width: f64 },
    Plain,
}

impl Place {
    /// Returns the width that the layers are made for, m.
    const fn width(self) -> f64 {
        match self {
            Self::Corridor { width } => width,
            Self::Plain => 1.9 * UNIT,
        }
    }

    fn range(self, from: Point, along: Vector) -> f64 {
        let Self::Corridor { width } = self else {
            return f64::INFINITY;
        };
        let half = [5.0 * width, 0.5 * width];
        let reach = |axis: usize| {
            let wall = half[axis].copysign(along[axis]);
            (wall - from[axis]) / along[axis]
        };
        reach(0).min(reach(1))
    }

    fn scan(self, ring: Ring, pose: Pose) -> Scan {
        let range = |beam| {
            let along = pose.heading.turned(ring.bearing(beam)).unit();
            self.range(pose.position, along).min(ring.max_range)
        };
        Scan {
            ring,
            ranges: (0..ring.beams).map(range).collect(),
        }
    }

    /// Returns the position nearest to `position` that a body held by the walls can take.
    fn held(self, position: Point) -> Point {
        let Self::Corridor { width } = self else {
            return position;
        };
        let [x, y] = [5.0 * width, 0.5 * width].map(|half| half - 0.5 * UNIT);
        Point::new(position.x.clamp(-x, x), position.y.clamp(-y, y))
    }
}

/// One action of one robot.
#[derive(Clone, Copy, Debug)]
struct Trial {
    place: Place,
    ring: Ring,
    /// Turn in a time step at full command, degrees.
    turn_deg: f64,
    start: Pose,
    action: Direction,
}

impl Trial {
    /// Returns the paper's layers without [`Settle`].
    fn unsettled(&self) -> Stack {
        let width = self.place.width();
        let beams = self.ring.beams;
        let layers: Vec<Box<dyn Layer + Send>> = vec![
            Box::new(Move::paper()),
            Box::new(Orient::paper(beams, width)),
            Box::new(Center::paper()),
            Box::new(Avoid::paper(beams, UNIT)),
        ];
        Stack::new(CorridorDetector::new(self.ring, width).unwrap(), layers)
    }

    fn settled(&self) -> Stack {
        Stack::paper(self.ring, UNIT, self.place.width()).unwrap()
    }

    /// Returns the turn commands of the action, at most [`LONG`].
    fn turns(&self, mut stack: Stack) -> Vec<f64> {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        let mut turns = Vec::new();
        let mut pose = self.start;
        stack.begin(self.action);
        while turns.len() < LONG as usize {
            let scan = self.place.scan(self.ring, pose);
            let view = View {
                scan: &scan,
                heading: pose.heading,
            };
            let proposal = stack.correct(view, &mut rng);
            let turn = proposal.command.turn.clamp(-1.0, 1.0);
            turns.push(turn);
            pose.heading = pose.heading.turned(turn * self.turn_deg.to_radians());
            let way = pose.heading.unit() * (2.0 * UNIT * proposal.command.translate);
            pose.position = self.place.held(pose.position + way);
            if proposal.ends.is_some() {
                break;
            }
        }
        turns
    }

    fn ends(&self, stack: Stack) -> bool {
        self.turns(stack).len() < LONG as usize
    }
}

/// Draws a pose in the middle of a corridor `width` metres wide, away from its ends.
fn anywhere(width: f64, rng: &mut ChaCha8Rng) -> Pose {
    let play = 0.5 * (width - UNIT);
    let heading = Heading::from_degrees(rng.random_range(-180.0..180.0));
    let position = Point::new(
        rng.random_range(-2.0 * width..2.0 * width),
        rng.random_range(-play..play),
    );
    Pose::new(position, heading)
}

/// Returns rings of 8 to 360 beams × turns a time step × widths of corridors, and the plain, ×
/// actions.
fn trials() -> impl Iterator<Item = Trial> {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut trials = Vec::new();
    for beams in (8..=360).step_by(4) {
        for turn_deg in [30.0, 60.0, 91.0, 107.0, 160.0] {
            for width in [1.2, 1.9, 3.0, 5.0].map(|units| units * UNIT) {
                let ring = Ring::full(beams, UNIT * rng.random_range(1.0..8.0));
                let start = anywhere(width, &mut rng);
                for place in [Place::Corridor { width }, Place::Plain] {
                    trials.extend(Direction::ALL.map(|action| Trial {
                        place,
                        ring,
                        turn_deg,
                        start,
                        action,
                    }));
                }
            }
        }
    }
    trials.into_iter()
}

#[test]
fn every_action_ends() {
    let endless: Vec<Trial> = trials()
        .filter(|trial| !trial.ends(trial.settled()))
        .collect();
    let first = endless.first();
    assert!(
        endless.is_empty(),
        "{} actions do not end, such as {first:?}",
        endless.len(),
    );
}

/// Shows that the test above depends on the layer.
#[test]
fn without_the_layer_hundreds_of_actions_do_not_end() {
    let endless = trials()
        .filter(|trial| !trial.ends(trial.unsettled()))
        .count();
    assert!(endless > 1000, "{endless}");
}

/// The paper's robot changes sides at most seven times in an action if its motors make no noise.
#[test]
fn the_layer_leaves_the_papers_robot_alone() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..5000 {
        let width = 1.9 * UNIT;
        let trial = Trial {
            place: Place::Corridor { width },
            ring: Ring::full(72, 2.5 * UNIT),
            turn_deg: 91.0,
            start: anywhere(width, &mut rng),
            action: Direction::ALL[rng.random_range(0..4)],
        };
        assert_eq!(
            trial.turns(trial.settled()),
            trial.turns(trial.unsettled()),
            "{trial:?}"
        );
    }
}

/// Hands the layer turns of 0.5 that change their side so often, and returns the size of the last
/// one.
fn halved(layer: &mut Settle, changes: u32) -> f64 {
    let scan = Scan::clear(Ring::full(72, 1.25));
    let situation = Situation {
        view: View {
            scan: &scan,
            heading: Heading::NORTH,
        },
        corridor: None,
    };
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut last = 0.0;
    for change in 0..=changes {
        let turn = if change % 2 == 0 { 0.5 } else { -0.5 };
        for turn in [turn, 0.0, turn] {
            let mut proposal = Proposal::default();
            proposal.command.turn = turn;
            last = layer.correct(proposal, &situation, &mut rng).command.turn;
        }
    }
    last.abs()
}

#[test]
fn each_change_beyond_patience_halves_the_turn_until_the_next_action() {
    let mut layer = Settle::ours();
    for (changes, expected) in [(0, 0.5), (20, 0.5), (21, 0.25), (23, 0.0625)] {
        layer.begin(Direction::North);
        assert!(
            (halved(&mut layer, changes) - expected).abs() < 1e-12,
            "{changes}"
        );
    }
    layer.patience = 2;
    layer.begin(Direction::North);
    assert!((halved(&mut layer, 3) - 0.25).abs() < 1e-12);
}
