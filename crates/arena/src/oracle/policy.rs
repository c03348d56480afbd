use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_control::{Stack, View};
use tolman_geom::{Heading, Point, Pose};
use tolman_maze::Direction;
use tolman_planners::{Arcs, costs_from};
use tolman_robot::{Robot, TurnTranslate};
use tolman_sim::Solo;
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};

use super::perfect_robot;
use crate::course::Course;
use crate::episode_error::{EpisodeError, step_failed};

/// What every action costs, in time steps to the destination, from every place of a course.
///
/// Places are a lattice of positions, each with the two axes a robot can face along. The arcs between them
/// are found by letting the robot itself carry out each action there, with its own layers and without
/// noise, and seeing where it ends and how long it took; Dijkstra's algorithm does the rest. Exact for a
/// noise-free robot but for the rounding of where actions end to the lattice.
#[derive(Clone, Debug)]
pub struct Policy {
    lattice: Lattice,
    /// For each node and action, the steps from there to the destination that begin with the action.
    costs: Vec<[Option<u32>; 4]>,
    /// For each node and action, the node it leads to without noise and in how many steps; none where it fails.
    ends: Vec<[Option<(u32, u32)>; 4]>,
}

/// Positions of the lattice per corridor width.
const POSITIONS: f64 = 8.0;

/// The furthest that positions may lie apart, m: half a robot's radius, so that every action leads to
/// another one.
const COARSEST: f64 = 0.125;

/// What fits a few hundred megabytes and a minute.
const MOST_NODES: usize = 2_000_000;

/// An action that has not ended by then swings to and fro for long; the policy leaves it out.
const LONGEST_ACTION: u32 = 40;

impl Policy {
    /// Works out the policy of a course, on eight positions per corridor width or more. Every node is
    /// simulated four times: about 10 µs per node and action, and a node per axis and position.
    ///
    /// # Errors
    /// When the course is a free world, the robot cannot be built for it, or the course needs more than two million nodes.
    pub fn new(course: &Course, robot: &LaserPioneerConfig) -> Result<Self, EpisodeError> {
        course.needs_maze("the oracle")?;
        let lattice = Lattice::new(course, (course.corridor_width / POSITIONS).min(COARSEST));
        if lattice.node_count() > MOST_NODES {
            return Err(EpisodeError::Policy {
                nodes: lattice.node_count(),
                most: MOST_NODES,
            });
        }
        let mut stack = Stack::paper(robot.ring, 2.0 * robot.radius, course.corridor_width)?;
        let mut solo = perfect_robot(course, robot)?;

        let mut arcs = Vec::new();
        let mut ends = vec![[None; 4]; lattice.node_count()];
        let mut goals = Vec::new();
        for node in 0..lattice.node_count() as u32 {
            let pose = lattice.pose(node);
            if course.is_destination(pose.position) {
                goals.push(node);
                continue;
            }
            if !course.leads_on(pose.position) {
                continue;
            }
            for action in Direction::ALL {
                // Walls stand in the way of some lattice points; nobody ever stands there.
                if solo.place(pose).is_err() {
                    break;
                }
                if let Some((end, steps)) = carry_out(action, &mut solo, &mut stack, course)? {
                    let head = lattice.nearest(end);
                    ends[node as usize][action.index()] = Some((head, steps));
                    arcs.push((node, head, steps));
                }
            }
        }
        let to_destination = costs_from(&Arcs::new(lattice.node_count(), &arcs).reversed(), goals);
        let costs = ends
            .iter()
            .map(|actions| {
                actions.map(|end| {
                    let (head, steps) = end?;
                    Some(to_destination[head as usize]? + steps)
                })
            })
            .collect();
        Ok(Self {
            lattice,
            costs,
            ends,
        })
    }

    /// The steps to the destination from about `pose`, by the action they begin with; none where it would
    /// not lead there.
    #[must_use]
    pub fn costs(&self, pose: Pose) -> [Option<u32>; 4] {
        self.costs[self.lattice.nearest(pose) as usize]
    }

    /// Where an action leads from about `pose` without noise; none where it fails.
    pub(super) fn end(&self, pose: Pose, action: Direction) -> Option<Point> {
        let (head, _) = self.ends[self.lattice.nearest(pose) as usize][action.index()]?;
        Some(self.lattice.pose(head).position)
    }

    /// The positions it knows, by [`Self::position_index`].
    pub(super) fn positions(&self) -> impl Iterator<Item = Point> + '_ {
        let axes = AXES.len() as u32;
        let count = self.lattice.node_count() as u32 / axes;
        (0..count).map(move |index| self.lattice.pose(index * axes).position)
    }

    /// The index of the position nearest to `position`.
    pub(super) fn position_index(&self, position: Point) -> usize {
        let node = self.lattice.nearest(Pose::new(position, AXES[0]));
        node as usize / AXES.len()
    }
}

/// Carries out one action; where it ends and after how many steps, or none if it fails or never ends.
fn carry_out(
    action: Direction,
    solo: &mut Solo<LaserPioneer>,
    stack: &mut Stack,
    course: &Course,
) -> Result<Option<(Pose, u32)>, EpisodeError> {
    // The layers draw only to get out of corners; a fixed seed makes the policy repeatable.
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    stack.begin(action);
    // It was lifted here: one step at rest and it sees where it is.
    let rest = solo.step(&TurnTranslate::STOP);
    rest.map_err(|source| step_failed(0, source))?;
    for step in 1..=LONGEST_ACTION {
        let sensing = solo.sensing();
        let (Some(scan), Some(heading)) = (&sensing.scan, sensing.compass) else {
            return Ok(None);
        };
        let proposal = stack.correct(View { scan, heading }, &mut rng);
        solo.step(&proposal.command)
            .map_err(|source| step_failed(step, source))?;
        let pose = solo.truth().pose;
        if course.is_destination(pose.position) {
            return Ok(Some((pose, step)));
        }
        match proposal.ends {
            Some(outcome) if outcome.moved() => return Ok(Some((pose, step))),
            Some(_) => return Ok(None),
            None => {}
        }
    }
    Ok(None)
}

/// Positions on a square lattice over a course, each with two axes.
#[derive(Clone, Debug)]
struct Lattice {
    origin: Point,
    spacing: f64,
    columns: u32,
    rows: u32,
}

/// The headings a node stands for: east–west and north–south.
const AXES: [Heading; 2] = [Heading::EAST, Heading::NORTH];

impl Lattice {
    fn new(course: &Course, spacing: f64) -> Self {
        let bounds = course.world.bounds();
        let size = bounds.max - bounds.min;
        Self {
            origin: bounds.min,
            spacing,
            columns: (size.x / spacing) as u32 + 1,
            rows: (size.y / spacing) as u32 + 1,
        }
    }

    const fn node_count(&self) -> usize {
        (self.columns as usize)
            .saturating_mul(self.rows as usize)
            .saturating_mul(AXES.len())
    }

    fn pose(&self, node: u32) -> Pose {
        let axes = AXES.len() as u32;
        let (place, axis) = (node / axes, node % axes);
        let (column, row) = (place % self.columns, place / self.columns);
        let offset = tolman_geom::Vector::new(f64::from(column), f64::from(row)) * self.spacing;
        Pose::new(self.origin + offset, AXES[axis as usize])
    }

    fn nearest(&self, pose: Pose) -> u32 {
        let offset = (pose.position - self.origin) / self.spacing;
        let index = |value: f64, count: u32| (libm::round(value).max(0.0) as u32).min(count - 1);
        let column = index(offset.x, self.columns);
        let row = index(offset.y, self.rows);
        let north_south = libm::fabs(libm::sin(pose.heading.radians())) > 0.5_f64.sqrt();
        (row * self.columns + column) * AXES.len() as u32 + u32::from(north_south)
    }
}
