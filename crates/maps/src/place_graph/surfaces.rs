use alloc::collections::BTreeMap;

use tolman_geom::{Point, Pose, Vector, floor_index};

use super::{Outline, OutlinePoint};

/// Surfaces of things as seen from all places, in the map's frame. Each is a small piece for one
/// cell of a grid, one direction and one colour.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Surfaces {
    pieces: BTreeMap<Key, Surface>,
}

/// Key of a surface: column and row of the grid, eighth of the circle, colour.
type Key = (i32, i32, u8, u8);

/// A piece of a surface: the mean of all points that were seen of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Surface {
    position: Vector,
    normal: Vector,
    colour: [f64; 2],
    has_colour: bool,
    /// Sum of the weights of the points seen on the surface.
    weight: f64,
    /// Id of the place from which the surface was first seen.
    pub(super) place: u32,
}

impl Surfaces {
    pub(super) fn bytes(&self) -> usize {
        self.pieces.len() * size_of::<(Key, Surface)>()
    }
}

impl Surface {
    pub(super) fn position(&self) -> Point {
        Point::from(self.position)
    }

    pub(super) fn normal(&self) -> Vector {
        self.normal
    }

    pub(super) fn colour(&self) -> Option<[f64; 2]> {
        self.has_colour.then_some(self.colour)
    }

    /// Returns the variance of the surface's position along its normal, m².
    pub(super) fn variance(&self) -> f64 {
        1.0 / self.weight + LEAST_DEVIATION * LEAST_DEVIATION
    }
}

/// Width of a cell, m.
pub(super) const CELL: f64 = 0.1;

/// Minimum standard deviation of a surface, m.
const LEAST_DEVIATION: f64 = 0.01;

impl Surfaces {
    /// Adds the outline seen from a place.
    pub(super) fn add(&mut self, place: u32, pose: Pose, outline: &Outline) {
        for point in outline.points.iter().chain(&outline.faced) {
            if let Some(normal) = point.normal {
                self.add_point(place, pose, point, normal);
            }
        }
    }

    fn add_point(&mut self, place: u32, pose: Pose, point: &OutlinePoint, normal: Vector) {
        let position = pose.transform(point.position).coords;
        let normal = pose.heading.rotate(normal);
        let weight = 1.0 / (point.deviation * point.deviation);
        let piece = self.pieces.entry(key(position, normal, point.colour));
        let piece = piece.or_insert(Surface {
            position,
            normal,
            colour: point.colour.unwrap_or_default(),
            has_colour: point.colour.is_some(),
            weight: 0.0,
            place,
        });
        piece.weight += weight;
        let share = weight / piece.weight;
        piece.position += (position - piece.position) * share;
        let mean = piece.normal + (normal - piece.normal) * share;
        piece.normal = mean.try_normalize(1e-9).unwrap_or(normal);
        if let Some(colour) = point.colour {
            for (mean, part) in piece.colour.iter_mut().zip(colour) {
                *mean += (part - *mean) * share;
            }
        }
    }

    /// Returns all surfaces, by column of the grid.
    pub(super) fn all(&self) -> impl Iterator<Item = &Surface> {
        self.pieces.values()
    }
}

fn key(position: Vector, normal: Vector, colour: Option<[f64; 2]>) -> Key {
    let cell = |along: f64| floor_index(along / CELL);
    let eighth = libm::floor(libm::atan2(normal.y, normal.x) / core::f64::consts::FRAC_PI_4);
    // Each comparison of two colour channels, such as more red than blue, survives a change of
    // light.
    let hue = colour.map_or(0, |[red, green]| {
        let blue = 1.0 - red - green;
        1 + u8::from(red > 0.45) + 2 * u8::from(green > 0.45) + 4 * u8::from(blue > 0.45)
    });
    (
        cell(position.x),
        cell(position.y),
        (eighth + 4.0) as u8,
        hue,
    )
}
