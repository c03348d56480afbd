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

#[cfg(test)]
mod tests {
    use alloc::collections::BTreeSet;
    use alloc::vec::Vec;
    use core::f64::consts::PI;

    use tolman_geom::Heading;

    use super::*;

    #[test]
    fn a_surface_is_told_by_its_cell_its_direction_and_its_colour() {
        let key = |x: f64, y: f64, angle: f64, colour| {
            super::key(
                Vector::new(x, y),
                Heading::from_radians(angle).unit(),
                colour,
            )
        };
        assert_eq!(key(0.55, -0.25, 0.1, None), (5, -3, 4, 0));
        let eighths: Vec<u8> = (0..8)
            .map(|eighth| key(0.0, 0.0, -PI + (f64::from(eighth) + 0.5) * PI / 4.0, None).2)
            .collect();
        assert_eq!(eighths, [0, 1, 2, 3, 4, 5, 6, 7]);
        // No colour, a grey, and each of the channels that may be more than 0.45 of it.
        let colours = [
            None,
            Some([0.33, 0.33]),
            Some([0.5, 0.2]),
            Some([0.2, 0.5]),
            Some([0.2, 0.2]),
            Some([0.46, 0.46]),
            Some([0.46, 0.08]),
            Some([0.08, 0.46]),
        ];
        let hues = colours.map(|colour| key(0.0, 0.0, 0.0, colour).3);
        assert_eq!(hues, [0, 1, 2, 3, 5, 4, 6, 7]);
        assert_eq!(BTreeSet::from(hues).len(), 8);
    }

    #[test]
    fn a_piece_is_the_weighted_mean_of_what_was_seen_of_it() {
        let point = |x: f64, deviation: f64, red: f64| OutlinePoint {
            position: Point::new(x, 0.52),
            normal: Some(Heading::from_radians(0.1 + x).unit()),
            deviation,
            colour: Some([red, 0.3]),
        };
        let seen = [point(0.51, 0.1, 0.3), point(0.57, 0.05, 0.36)];
        let mut surfaces = Surfaces::default();
        for (place, point) in (3..).zip(seen) {
            let outline = Outline {
                points: [point].to_vec(),
                ..Outline::default()
            };
            surfaces.add(place, Pose::IDENTITY, &outline);
        }
        let all: Vec<&Surface> = surfaces.all().collect();
        assert_eq!(all.len(), 1);
        let piece = all[0];
        // Weights of 100 and 400.
        assert!((piece.position() - Point::new(0.2 * 0.51 + 0.8 * 0.57, 0.52)).norm() < 1e-12);
        let normals = seen.map(|point| point.normal.unwrap());
        let normal = (normals[0] * 0.2 + normals[1] * 0.8).normalize();
        assert!((piece.normal() - normal).norm() < 1e-12);
        let [red, green] = piece.colour().unwrap();
        assert!((red - 0.348).abs() < 1e-12 && (green - 0.3).abs() < 1e-12);
        assert!((piece.variance() - (1.0 / 500.0 + 1e-4)).abs() < 1e-12);
        assert_eq!(piece.place, 3);
        assert_eq!(surfaces.bytes(), size_of::<(Key, Surface)>());
    }

    #[test]
    fn what_has_no_normal_is_no_surface() {
        let point = OutlinePoint {
            position: Point::new(1.0, 0.0),
            normal: None,
            deviation: 0.1,
            colour: None,
        };
        let faced = OutlinePoint {
            normal: Some(-Vector::x()),
            ..point
        };
        let mut surfaces = Surfaces::default();
        let pose = Pose::new(Point::new(0.0, 2.0), Heading::NORTH);
        surfaces.add(
            0,
            pose,
            &Outline {
                points: [point].to_vec(),
                faced: [faced].to_vec(),
                ..Outline::default()
            },
        );
        let all: Vec<&Surface> = surfaces.all().collect();
        assert_eq!(all.len(), 1);
        assert!((all[0].position() - Point::new(0.0, 3.0)).norm() < 1e-12);
        assert!((all[0].normal() + Vector::y()).norm() < 1e-12);
        assert_eq!(all[0].colour(), None);
    }
}
