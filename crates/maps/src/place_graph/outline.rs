use alloc::vec::Vec;

use tolman_geom::{Point, Vector};
use tolman_robot::{Snapshot, Sounding};

use super::foot_line;

/// Shape of the surroundings in a snapshot, in the robot's frame.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Outline {
    /// Points on surfaces of things.
    pub points: Vec<OutlinePoint>,
    /// Readings of sensors with a cone, where they met something.
    pub arcs: Vec<Sounding>,
    /// Surfaces that face a range sensor, which heard them nearer than its neighbours did.
    pub faced: Vec<OutlinePoint>,
}

/// A point on the surface of a thing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OutlinePoint {
    /// Position in the robot's frame, m.
    pub position: Point,
    /// Normal of the surface, a unit vector towards the robot; `None` if the neighbouring points do
    /// not determine it.
    pub normal: Option<Vector>,
    /// Standard deviation of the point's distance from the robot, m.
    pub deviation: f64,
    /// Shares of red and green in the point's colour; `None` where no camera saw it.
    pub colour: Option<[f64; 2]>,
}

/// Maximum number of points of a laser; more are thinned out.
const MOST_BEAMS: usize = 90;

/// Range below which readings are left out, m.
const LEAST_RANGE: f64 = 0.01;

/// Standard deviation of a beam, m.
const BEAM_DEVIATION: f64 = 0.02;

impl Outline {
    /// Returns the outline that a snapshot shows. O(pixels + soundings).
    #[must_use]
    pub fn of(snapshot: &Snapshot) -> Self {
        // A reading of 0 has no direction, and NaN is not a reading.
        let met = |sounding: &&Sounding| {
            sounding.mount.is_finite()
                && sounding.range > LEAST_RANGE
                && sounding.range < 0.999 * sounding.max_range
        };
        let (beams, arcs): (Vec<Sounding>, Vec<Sounding>) = (snapshot.soundings.iter())
            .filter(met)
            .partition(|sounding| sounding.half_width <= 0.0);
        let every = beams.len().div_ceil(MOST_BEAMS).max(1);
        let mut points: Vec<OutlinePoint> = beams.iter().step_by(every).map(point_of).collect();
        find_normals(&mut points);
        if let Some(picture) = &snapshot.picture {
            let mut feet = foot_line(picture);
            find_normals(&mut feet);
            points.extend(feet);
        }
        let faced = faced(&snapshot.soundings);
        Self {
            points,
            arcs,
            faced,
        }
    }
}

/// Distance beyond which a surface may face another sensor too, m.
const FACED_WITHIN: f64 = 3.0;

/// Standard deviation of the distance of a faced surface: m, and per metre of range.
const FACED_DEVIATION: (f64, f64) = (0.02, 0.01);

/// Returns the surfaces that face a sonar: those that it hears nearer than both its neighbours do.
fn faced(soundings: &[Sounding]) -> Vec<OutlinePoint> {
    let mut sonars: Vec<&Sounding> = (soundings.iter())
        .filter(|sounding| sounding.half_width > 0.0)
        .collect();
    let bearing = |sonar: &Sounding| sonar.mount.heading.radians();
    sonars.sort_by(|a, b| bearing(a).total_cmp(&bearing(b)));
    let count = sonars.len();
    let range = |index: usize| sonars[index % count].range;
    let faces = |index: &usize| {
        let here = range(*index);
        here <= FACED_WITHIN.min(range(index + 1)) && here <= range(index + count - 1)
    };
    let point = |index: usize| {
        let Sounding { mount, range, .. } = *sonars[index];
        let (least, share) = FACED_DEVIATION;
        OutlinePoint {
            position: mount.transform(Point::new(range, 0.0)),
            normal: Some(-mount.heading.unit()),
            deviation: least + share * range,
            colour: None,
        }
    };
    (0..count).filter(faces).map(point).collect()
}

fn point_of(beam: &Sounding) -> OutlinePoint {
    OutlinePoint {
        position: beam.mount.transform(Point::new(beam.range, 0.0)),
        normal: None,
        deviation: BEAM_DEVIATION,
        colour: None,
    }
}

/// Numbers of neighbours on either side from which a point's surface is fitted: the greatest that
/// lies on a line is used.
const BESIDE: [usize; 4] = [16, 10, 6, 3];

/// Distance above which neighbours belong to different things, m. A fifth of their range is another
/// such limit.
const GAP: f64 = 0.25;

/// Gives each point the normal of the line through its neighbours, if they lie on a line.
fn find_normals(points: &mut [OutlinePoint]) {
    let normal = |index| {
        BESIDE
            .iter()
            .find_map(|beside| normal(points, index, *beside))
    };
    let normals: Vec<Option<Vector>> = (0..points.len()).map(normal).collect();
    for (point, normal) in points.iter_mut().zip(normals) {
        point.normal = normal;
    }
}

/// Returns the normal of the line through a point and up to `beside` neighbours on either side.
/// Returns `None` if these points do not lie on a line.
fn normal(points: &[OutlinePoint], index: usize, beside: usize) -> Option<Vector> {
    let around = neighbours(points, index, beside)?;
    let line = Line::through(around)?;
    let towards_robot = |normal: Vector| match normal.dot(&points[index].position.coords) > 0.0 {
        true => -normal,
        false => normal,
    };
    line.is_straight(around).then(|| towards_robot(line.normal))
}

/// Returns the points around one of them, without a gap between neighbours.
fn neighbours(points: &[OutlinePoint], index: usize, beside: usize) -> Option<&[OutlinePoint]> {
    let joined = |a: &OutlinePoint, b: &OutlinePoint| {
        (a.position - b.position).norm() < GAP.max(0.2 * a.position.coords.norm())
    };
    let first = (index.saturating_sub(beside)..index)
        .rev()
        .take_while(|before| joined(&points[*before], &points[before + 1]));
    let last = (index + 1..points.len().min(index + beside + 1))
        .take_while(|after| joined(&points[after - 1], &points[*after]));
    points.get(first.last().unwrap_or(index)..=last.last().unwrap_or(index))
}

/// A line through points.
struct Line {
    middle: Vector,
    normal: Vector,
}

impl Line {
    /// Returns the line with the least squares distance to the points, each weighted by its
    /// certainty; `None` for fewer than four.
    fn through(points: &[OutlinePoint]) -> Option<Self> {
        if points.len() < 4 {
            return None;
        }
        let weight = |point: &OutlinePoint| 1.0 / (point.deviation * point.deviation);
        let total: f64 = points.iter().map(weight).sum();
        let sum = |sum: Vector, point: &OutlinePoint| sum + point.position.coords * weight(point);
        let middle = points.iter().fold(Vector::zeros(), sum) / total;
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for point in points {
            let off = point.position.coords - middle;
            xx += weight(point) * off.x * off.x;
            xy += weight(point) * off.x * off.y;
            yy += weight(point) * off.y * off.y;
        }
        // The line runs in the direction in which the points spread most.
        let (sin, cos) = libm::sincos(0.5 * libm::atan2(2.0 * xy, xx - yy));
        let normal = Vector::new(-sin, cos);
        Some(Self { middle, normal })
    }

    /// Returns whether the points lie on the line within their errors, which are along the line of
    /// sight.
    fn is_straight(&self, points: &[OutlinePoint]) -> bool {
        let off = |point: &OutlinePoint| {
            let sight = point.position.coords.normalize();
            let across = point.deviation * self.normal.dot(&sight).abs() + 0.005;
            let off = self.normal.dot(&(point.position.coords - self.middle)) / across;
            off * off
        };
        points.iter().map(off).sum::<f64>() <= MOST_BENT * points.len() as f64
    }
}

/// Maximum mean squared distance of points from their line, in variances of the points.
const MOST_BENT: f64 = 1.5;
