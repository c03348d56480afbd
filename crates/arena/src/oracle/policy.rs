use tolman_geom::{Heading, Point, Pose};
use tolman_maze::Direction;
use tolman_sim::robots::LaserPioneerConfig;

use super::chances::{Chances, Costs};
use super::trier::Trier;
use super::{noisy_robot, perfect_robot};
use crate::course::Course;
use crate::episode_error::EpisodeError;

/// Expected cost of every action, in time steps to the destination, from every place of a course.
///
/// Places are a lattice of positions, each with the two axes a robot can face along. The robot
/// itself carries out every action there eight times, with its own layers and noise. It starts near
/// the position and near the axis. The plan uses where it ended, how long it took and how often it
/// failed.
///
/// Value iteration then gives the costs of the best plan for a robot that errs (Bellman 1957). An
/// action that has just failed is not tried again at once. The result is exact up to the number of
/// samples, and the rounding of positions to the lattice.
#[derive(Clone, Debug)]
pub struct Policy {
    lattice: Lattice,
    /// Expected steps to the destination for each node and action, beginning with the action.
    costs: Vec<Costs>,
    /// Node that each action of each node leads to without noise; `None` where the action fails.
    ends: Vec<[Option<u32>; 4]>,
}

/// Positions of the lattice per corridor width.
const POSITIONS: f64 = 8.0;

/// The furthest that positions may lie apart, m: half a robot's radius, so that every action leads
/// to another one.
const COARSEST: f64 = 0.125;

/// Maximum number of nodes: what fits a few hundred megabytes and a few minutes.
const MOST_NODES: usize = 2_000_000;

impl Policy {
    /// Works out the policy of a course, on eight positions per corridor width or more. Every node
    /// is simulated 36 times: about 10 µs each, and a node per axis and position.
    ///
    /// # Errors
    /// When the course is a free world, the robot cannot be built for it, or the course needs more
    /// than two million nodes.
    pub fn new(course: &Course, robot: &LaserPioneerConfig) -> Result<Self, EpisodeError> {
        course.needs_maze("the oracle")?;
        let lattice = Lattice::new(course, (course.corridor_width / POSITIONS).min(COARSEST));
        let count = lattice.node_count();
        if count > MOST_NODES {
            return Err(EpisodeError::Policy {
                nodes: count,
                most: MOST_NODES,
            });
        }
        let mut perfect = Trier::new(course, perfect_robot(course, robot)?, robot)?;
        let mut real = Trier::new(course, noisy_robot(course, robot)?, robot)?;
        let mut ends = vec![[None; 4]; count];
        let mut chances = Chances::default();
        for node in 0..count as u32 {
            let pose = lattice.pose(node);
            if course.is_destination(pose.position) || !course.leads_on(pose.position) {
                continue;
            }
            for action in Direction::ALL {
                if let Some(end) = perfect.carry_out(action, pose)?
                    && end.moved
                {
                    ends[node as usize][action.index()] = Some(lattice.nearest(end.pose));
                }
            }
            chances.try_all(node, &lattice, &mut real)?;
        }
        let costs = chances.costs(&lattice);
        Ok(Self {
            lattice,
            costs,
            ends,
        })
    }

    /// Returns the expected steps to the destination from about `pose`, by the action they begin
    /// with; infinite where it would not lead there.
    #[must_use]
    pub fn costs(&self, pose: Pose) -> [f64; 4] {
        self.costs[self.lattice.nearest(pose) as usize]
    }

    /// Returns the position where an action ends from about `pose` without noise, or `None` where
    /// it fails.
    pub(super) fn end(&self, pose: Pose, action: Direction) -> Option<Point> {
        let head = self.ends[self.lattice.nearest(pose) as usize][action.index()]?;
        Some(self.lattice.pose(head).position)
    }

    /// Returns the positions that the policy knows, by [`Self::position_index`].
    pub(super) fn positions(&self) -> impl Iterator<Item = Point> + '_ {
        let axes = AXES.len() as u32;
        let count = self.lattice.node_count() as u32 / axes;
        (0..count).map(move |index| self.lattice.pose(index * axes).position)
    }

    /// Returns the index of the position nearest to `position`.
    pub(super) fn position_index(&self, position: Point) -> usize {
        let node = self.lattice.nearest(Pose::new(position, AXES[0]));
        node as usize / AXES.len()
    }
}

/// Positions on a square lattice over a course, each with two axes.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    origin: Point,
    pub(super) spacing: f64,
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

    pub(super) const fn node_count(&self) -> usize {
        (self.columns as usize)
            .saturating_mul(self.rows as usize)
            .saturating_mul(AXES.len())
    }

    pub(super) fn pose(&self, node: u32) -> Pose {
        let axes = AXES.len() as u32;
        let (place, axis) = (node / axes, node % axes);
        let (column, row) = (place % self.columns, place / self.columns);
        let offset = tolman_geom::Vector::new(f64::from(column), f64::from(row)) * self.spacing;
        Pose::new(self.origin + offset, AXES[axis as usize])
    }

    pub(super) fn nearest(&self, pose: Pose) -> u32 {
        let offset = (pose.position - self.origin) / self.spacing;
        let index = |value: f64, count: u32| (libm::round(value).max(0.0) as u32).min(count - 1);
        let column = index(offset.x, self.columns);
        let row = index(offset.y, self.rows);
        let north_south = libm::fabs(libm::sin(pose.heading.radians())) > 0.5_f64.sqrt();
        (row * self.columns + column) * AXES.len() as u32 + u32::from(north_south)
    }
}
