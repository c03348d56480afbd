use alloc::vec::Vec;

use tolman_geom::{Point, Vector};
use tolman_robot::{Snapshot, Sounding};

use super::foot_line;

/// What a snapshot shows of the things round the robot, in the robot's frame.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Outline {
    /// Points of their surfaces.
    pub points: Vec<OutlinePoint>,
    /// Readings of sensors that hear in a cone, as far as they met something.
    pub arcs: Vec<Sounding>,
}

/// A point where something stands.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OutlinePoint {
    /// Where, m.
    pub position: Point,
    /// The direction in which its surface looks, a unit vector towards the robot; `None` where its neighbours tell none.
    pub normal: Option<Vector>,
    /// Standard deviation of its distance from the robot, m.
    pub deviation: f64,
    /// Its shares of red and green; `None` where no camera saw it.
    pub colour: Option<[f64; 2]>,
}

/// More points of a laser than this are thinned out.
const MOST_BEAMS: usize = 90;

/// Standard deviation of a beam, m.
const BEAM_DEVIATION: f64 = 0.02;

impl Outline {
    /// Returns the outline that a snapshot shows. O(pixels + soundings).
    #[must_use]
    pub fn of(snapshot: &Snapshot) -> Self {
        let met = |sounding: &&Sounding| sounding.range < 0.999 * sounding.max_range;
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
        Self { points, arcs }
    }
}

fn point_of(beam: &Sounding) -> OutlinePoint {
    OutlinePoint {
        position: beam.mount.transform(Point::new(beam.range, 0.0)),
        normal: None,
        deviation: BEAM_DEVIATION,
        colour: None,
    }
}

/// Neighbours on either side that make a surface together with a point.
const BESIDE: usize = 3;

/// Neighbours farther apart than this, or than a fifth of their distance, belong to different things, m.
const GAP: f64 = 0.25;

/// Gives each point the normal of the line through it and its neighbours, if they are on one.
fn find_normals(points: &mut [OutlinePoint]) {
    let normals: Vec<Option<Vector>> = (0..points.len())
        .map(|index| normal(points, index))
        .collect();
    for (point, normal) in points.iter_mut().zip(normals) {
        point.normal = normal;
    }
}

fn normal(points: &[OutlinePoint], index: usize) -> Option<Vector> {
    let near = |a: &OutlinePoint, b: &OutlinePoint| {
        let gap = GAP.max(0.2 * a.position.coords.norm());
        (a.position - b.position).norm() < gap
    };
    let mut first = index;
    while first > 0 && index - first < BESIDE && near(&points[first], &points[first - 1]) {
        first -= 1;
    }
    let mut last = index;
    while last + 1 < points.len() && last - index < BESIDE && near(&points[last], &points[last + 1])
    {
        last += 1;
    }
    let around = points.get(first..=last)?;
    if around.len() < 4 {
        return None;
    }
    let count = around.len() as f64;
    let middle = around
        .iter()
        .fold(Vector::zeros(), |sum, point| sum + point.position.coords)
        / count;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for point in around {
        let off = point.position.coords - middle;
        xx += off.x * off.x;
        xy += off.x * off.y;
        yy += off.y * off.y;
    }
    // The direction in which they spread least.
    let along = 0.5 * libm::atan2(2.0 * xy, xx - yy);
    let (sin, cos) = libm::sincos(along);
    let normal = Vector::new(-sin, cos);
    let across = (xx * sin * sin - 2.0 * xy * sin * cos + yy * cos * cos) / count;
    let deviation = points[index].deviation;
    if libm::sqrt(across.max(0.0)) > 2.0 * deviation + 0.01 {
        return None;
    }
    let towards = if normal.dot(&points[index].position.coords) > 0.0 {
        -normal
    } else {
        normal
    };
    Some(towards)
}
