//! Draws the results from a log.

use tolman_draw::{Drawing, FloorPlan, Image, ImageError, Series};
use tolman_formats::MapCell;
use tolman_formats::RosMap;
use tolman_geom::{Point, Pose};
use tolman_maps::scan_matching::OccupancyGrid;
use tolman_sim::Bounds;

use super::RobotLog;

/// Contents of a log's picture: the occupancy, the estimated trajectory, and the odometry.
#[derive(Clone, Debug)]
pub struct MapPicture {
    /// Counts of beams that ended and passed.
    pub occupancy: OccupancyGrid,
    /// Positions of the estimated trajectory, m.
    pub corrected: Vec<Point>,
    /// Positions by odometry, aligned with the start of the estimated trajectory, m.
    pub raw: Vec<Point>,
    /// Share of the beams that end where the map has floor, 0 … 1.
    pub contradicted: f64,
}

/// Side of a cell of the occupancy, m.
const CELL: f64 = 0.05;
/// Maximum length of a beam that is drawn, m.
const FARTHEST: f64 = 20.0;
/// Occupancy above which a cell is a wall, 0 … 1; below it, the cell is floor.
const WALL: f64 = 0.25;
/// Share of beams ending on floor above which a map is doubtful.
const DOUBT: f64 = 0.12;
/// Minimum distance between two scans that are drawn, m and rad.
const APART: (f64, f64) = (0.1, 0.1);

impl MapPicture {
    /// Draws the scans of a log at the poses found for them. O(scans · beams · range).
    #[must_use]
    pub fn of(log: &RobotLog, poses: &[Pose]) -> Self {
        let drawn = apart(poses);
        let ends = drawn.iter().flat_map(|index| {
            let scan = &log.scans[*index];
            let laser = poses[*index].compose(scan.robot_from_laser);
            let beams = (0..).zip(&scan.scan.ranges);
            beams.filter_map(move |(beam, range)| {
                let bearing = tolman_geom::Heading::from_radians(scan.scan.ring.bearing(beam));
                let met = *range < scan.scan.ring.max_range.min(FARTHEST);
                met.then(|| laser.transform(Point::from(bearing.unit() * *range)))
            })
        });
        let standing = poses.iter().map(|pose| pose.position);
        let mut occupancy = OccupancyGrid::around(ends.chain(standing), CELL);
        let seen = |index: &usize| {
            let scan = &log.scans[*index];
            (&scan.scan, poses[*index].compose(scan.robot_from_laser))
        };
        for (scan, laser) in drawn.iter().map(seen) {
            occupancy.add(scan, laser, FARTHEST);
        }
        let counted = drawn
            .iter()
            .map(seen)
            .fold([0, 0], |sum: [usize; 2], (scan, laser)| {
                let [all, on_floor] = occupancy.contradicted(scan, laser, FARTHEST, WALL);
                [sum[0] + all, sum[1] + on_floor]
            });
        Self {
            occupancy,
            contradicted: counted[1] as f64 / counted[0].max(1) as f64,
            corrected: poses.iter().map(|pose| pose.position).collect(),
            raw: (log.odometry_over(poses).iter())
                .map(|pose| pose.position)
                .collect(),
        }
    }

    /// Returns the reason to doubt the map, as a sentence without a full stop; `None` if there is
    /// none.
    #[must_use]
    pub fn doubt(&self) -> Option<String> {
        let percent = 100.0 * self.contradicted;
        (self.contradicted > DOUBT).then(|| {
            format!(
                "{percent:.1} % of all beams end where the map has floor: walls stand where they do not, or twice"
            )
        })
    }

    /// Returns the picture, `width` user units wide: the occupancy, over it the odometry as a
    /// dashed line, and on top the estimated trajectory.
    ///
    /// # Errors
    /// If the occupancy is larger than a picture can be.
    pub fn drawing(&self, width: f64) -> Result<Drawing, ImageError> {
        let all = self.raw.iter().chain(&self.corrected).copied();
        let Bounds { min, max } = self.bounds();
        let bounds = Bounds::of(all.chain([min, max]));
        let mut plan = FloorPlan::of_bounds(&bounds, width);
        plan.image(&self.image()?, &self.bounds());
        plan.doubtful_way(&self.raw, Series(1));
        plan.trajectory(&self.corrected, Series(0));
        Ok(plan.drawing(
            "Occupancy of the floor in grey; dashed what the wheels say, solid the way found.",
        ))
    }

    fn bounds(&self) -> Bounds {
        let grid = &self.occupancy;
        let size = tolman_geom::Vector::new(grid.columns as f64, grid.rows as f64) * grid.cell;
        Bounds {
            min: grid.origin,
            max: grid.origin + size,
        }
    }

    fn image(&self) -> Result<Image, ImageError> {
        let grid = &self.occupancy;
        let shades: Vec<u8> = grid.occupancy().map(shade).collect();
        let rows = shades.chunks(grid.columns.max(1)).rev();
        let pixels: Vec<u8> = rows.flatten().copied().collect();
        Image::grey(grid.columns as u32, grid.rows as u32, &pixels)
    }
}

/// Returns whether a cell is a wall.
pub(super) fn is_wall(occupied: Option<f64>) -> bool {
    occupied.is_some_and(|occupied| occupied >= WALL)
}

/// Returns black for walls, white for floor and grey for unknown ground.
fn shade(occupied: Option<f64>) -> u8 {
    occupied.map_or(205, |occupied| {
        let dark = (occupied / WALL).min(1.0);
        (254.0 * (1.0 - dark)) as u8
    })
}

/// Returns an occupancy grid in the form of ROS's `map_server`.
#[must_use]
pub fn ros_map(grid: &OccupancyGrid) -> RosMap {
    let cell = |occupied: Option<f64>| match occupied {
        None => MapCell::Unknown,
        Some(occupied) if occupied >= WALL => MapCell::Occupied,
        Some(_) => MapCell::Free,
    };
    RosMap {
        width: grid.columns,
        height: grid.rows,
        resolution: grid.cell,
        origin: grid.origin,
        cells: grid.occupancy().map(cell).collect(),
    }
}

/// Returns the indices of the scans that show something new.
fn apart(poses: &[Pose]) -> Vec<usize> {
    let mut drawn: Vec<usize> = Vec::new();
    for (index, pose) in poses.iter().enumerate() {
        let is_new = drawn.last().is_none_or(|last| {
            let step = poses[*last].between(*pose);
            step.position.coords.norm() >= APART.0 || step.heading.radians().abs() >= APART.1
        });
        if is_new {
            drawn.push(index);
        }
    }
    drawn
}
