use tolman_geom::{Point, Vector};

use super::Backdrop;
use super::light::Shine;
use super::texture::stain;
use crate::WallSegment;

/// View along one column of a picture: a vertical plane through the camera.
#[derive(Clone, Debug)]
pub(super) struct Column<'a> {
    eye: Point,
    /// Height of the eye, m.
    eye_height: f64,
    /// Direction of view, of length 1 along the camera's axis, so that depths are distances from
    /// the picture's plane.
    direction: Vector,
    /// The walls that the column meets, the nearest first.
    met: Vec<Met<'a>>,
}

/// A wall in a column.
#[derive(Clone, Copy, Debug)]
struct Met<'a> {
    /// Distance along the camera's axis, m.
    depth: f64,
    wall: &'a WallSegment,
    /// Unit normal that points at the camera.
    normal: Vector,
}

/// Parts of a pixel's colour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel {
    /// Red, green and blue, 255 at full light, or more.
    pub(super) colour: [f64; 3],
    /// Share of the colour that glows by itself, 0 to 1.
    pub(super) glow: f64,
}

impl<'a> Column<'a> {
    /// Returns the column that looks along `direction`, of length 1 along the camera's axis, at
    /// `walls`. O(walls).
    pub(super) fn new(
        eye: Point,
        eye_height: f64,
        direction: Vector,
        walls: &'a [WallSegment],
        reach: f64,
    ) -> Self {
        let length = direction.norm();
        let unit = direction / length;
        let meet = |wall: &'a WallSegment| {
            let range = wall.ray(eye, unit);
            (range < reach).then(|| Met {
                depth: range / length,
                wall,
                normal: normal_towards(wall, unit),
            })
        };
        let mut met: Vec<Met<'a>> = walls.iter().filter_map(meet).collect();
        met.sort_by(|a, b| a.depth.total_cmp(&b.depth));
        Self {
            eye,
            eye_height,
            direction,
            met,
        }
    }

    /// Returns the pixel at `upward`, the tangent of its angle above the axis. It shows the first
    /// wall that covers this height, or the floor before it.
    pub(super) fn pixel(&self, upward: f64, backdrop: &Backdrop, shine: &Shine) -> Pixel {
        let floor = if upward < 0.0 {
            -self.eye_height / upward
        } else {
            f64::INFINITY
        };
        let first = self.met.iter().find(|met| {
            let height = self.eye_height + upward * met.depth;
            met.depth < floor
                && (met.wall.material.base..=met.wall.material.height).contains(&height)
        });
        match first {
            Some(met) => self.of_wall(met, upward, backdrop, shine),
            None if floor < f64::INFINITY => Pixel {
                colour: shine.on_floor(self.stained(backdrop.floor, floor, 0.0, backdrop)),
                glow: 0.0,
            },
            None => Pixel {
                colour: shine.on_floor(backdrop.ceiling.map(f64::from)),
                glow: 0.0,
            },
        }
    }

    fn of_wall(&self, met: &Met<'_>, upward: f64, backdrop: &Backdrop, shine: &Shine) -> Pixel {
        let material = &met.wall.material;
        let height = self.eye_height + upward * met.depth;
        let colour = self.stained(material.colour, met.depth, height, backdrop);
        Pixel {
            colour: shine.on_wall(colour, material.glow, met.normal),
            glow: material.glow,
        }
    }

    /// Returns a colour with the stains at its point.
    fn stained(&self, colour: [u8; 3], depth: f64, height: f64, backdrop: &Backdrop) -> [f64; 3] {
        let gain = if backdrop.stains > 0.0 {
            let at = self.eye + self.direction * depth;
            1.0 + backdrop.stains * stain(at.x, at.y, height)
        } else {
            1.0
        };
        colour.map(|part| f64::from(part) * gain)
    }
}

/// Returns the unit normal of a wall on the side from which a ray comes.
fn normal_towards(wall: &WallSegment, ray: Vector) -> Vector {
    let along = wall.end - wall.start;
    let normal = Vector::new(-along.y, along.x) / along.norm();
    if normal.dot(&ray) > 0.0 {
        -normal
    } else {
        normal
    }
}
