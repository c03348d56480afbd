use tolman_geom::{Heading, Point, Vector};
use tolman_sim::Bounds;

use super::CellGrid;

/// Returns the extent of the whole field, in cells.
#[must_use]
pub fn whole_field() -> Bounds {
    let side = f64::from(CellGrid::SIDE);
    Bounds {
        min: Point::origin(),
        max: Point::new(side, side),
    }
}

/// The field that maps are compared with, in the world's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldFrame {
    /// Direction from the blue goal to the yellow one; the paper draws it straight up.
    pub yellow_from_blue: Heading,
    /// The rectangle over which the nodes of a map are stretched, in cells.
    pub extent: Bounds,
}

/// Transform from positions in a map's frame to cells of the field: steps 2 and 3 of the paper's
/// score.
///
/// A rotation, then one factor for x and one for y, both positive. So nothing is ever mirrored: a
/// map that is a mirror image of the field stays one, and scores accordingly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldFromMap {
    /// First row of the rotation, (cos, −sin).
    turn: Vector,
    turned: Bounds,
    field: Bounds,
}

impl FieldFromMap {
    /// Returns the transform from a map to the field. It turns the map such that the yellow goal
    /// lies in the true direction from the blue one. Then it stretches the nodes' least and
    /// greatest x and y to those of the field. `None` if both goals lie at one place or there are
    /// no nodes.
    #[must_use]
    pub fn of(
        nodes: impl Iterator<Item = Point>,
        blue: Point,
        yellow: Point,
        field: &FieldFrame,
    ) -> Option<Self> {
        let from = (yellow - blue).try_normalize(1e-9)?;
        let to = field.yellow_from_blue.unit();
        let turn = Vector::new(from.dot(&to), -from.perp(&to));
        let mut nodes = nodes.map(|node| turned(turn, node)).peekable();
        nodes.peek()?;
        let turned = Bounds::of(nodes);
        Some(Self {
            turn,
            turned,
            field: field.extent,
        })
    }

    /// Returns the position on the field, in cells, of a position of the map.
    #[must_use]
    pub fn transform(&self, in_map: Point) -> Point {
        let at = turned(self.turn, in_map);
        let (from, to) = (self.turned, self.field);
        Point::new(
            stretched(at.x, (from.min.x, from.max.x), (to.min.x, to.max.x)),
            stretched(at.y, (from.min.y, from.max.y), (to.min.y, to.max.y)),
        )
    }
}

/// Turns a point about the origin.
fn turned(turn: Vector, point: Point) -> Point {
    let second_row = Vector::new(-turn.y, turn.x);
    Point::new(turn.dot(&point.coords), second_row.dot(&point.coords))
}

/// Maps one interval to another. An interval without length goes to the middle.
fn stretched(value: f64, from: (f64, f64), to: (f64, f64)) -> f64 {
    let length = from.1 - from.0;
    let share = if length > 1e-9 {
        (value - from.0) / length
    } else {
        0.5
    };
    to.0 + share * (to.1 - to.0)
}

#[cfg(test)]
mod tests {
    use tolman_geom::Pose;

    use super::*;

    const FIELD: FieldFrame = FieldFrame {
        yellow_from_blue: Heading::NORTH,
        extent: Bounds {
            min: Point::new(0.0, 0.0),
            max: Point::new(8.0, 8.0),
        },
    };

    /// Returns the corners of a pitch of 4 × 4.6 m and its goals, in the frame of a robot that was
    /// put down somewhere.
    fn pitch(frame: Pose) -> ([Point; 4], [Point; 2]) {
        let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.6), (0.0, 4.6)];
        let goals = [(2.0, 0.0), (2.0, 4.6)];
        let seen = |(x, y)| frame.inverse().transform(Point::new(x, y));
        (corners.map(seen), goals.map(seen))
    }

    #[test]
    fn the_field_is_found_from_wherever_the_robot_was_put_down() {
        for (x, y, degrees) in [(0.0, 0.0, 0.0), (1.0, 3.0, 37.0), (2.0, 2.0, -160.0)] {
            let frame = Pose::new(Point::new(x, y), Heading::from_degrees(degrees));
            let (corners, [blue, yellow]) = pitch(frame);
            let nodes = corners.into_iter();
            let found = FieldFromMap::of(nodes, blue, yellow, &FIELD).unwrap();
            for (corner, expect) in
                corners
                    .iter()
                    .zip([(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)])
            {
                let at = found.transform(*corner);
                assert!((at - Point::new(expect.0, expect.1)).norm() < 1e-9, "{at}");
            }
        }
    }

    /// A mirror image stays one. The paper's maps had the windows on the left, for unknown reasons.
    #[test]
    fn a_mirror_image_stays_one() {
        let (corners, [blue, yellow]) = pitch(Pose::IDENTITY);
        let mirror = |at: Point| Point::new(-at.x, at.y);
        let mirrored = corners.map(mirror);
        let found = FieldFromMap::of(mirrored.into_iter(), mirror(blue), mirror(yellow), &FIELD);
        let east = found.unwrap().transform(mirrored[1]);
        assert!(
            (east - Point::new(0.0, 0.0)).norm() < 1e-9,
            "the east is on the left: {east}"
        );
    }

    #[test]
    fn what_has_no_extent_lies_in_the_middle() {
        let extent = Bounds::of([Point::new(1.5, 2.5), Point::new(5.5, 6.5)]);
        let field = FieldFrame { extent, ..FIELD };
        assert_eq!(
            (extent.min, extent.max),
            (Point::new(1.5, 2.5), Point::new(5.5, 6.5))
        );
        let line = [Point::new(3.0, 0.0), Point::new(3.0, 1.0)];
        let found = FieldFromMap::of(line.into_iter(), line[0], line[1], &field).unwrap();
        assert_eq!(found.transform(line[1]), Point::new(3.5, 6.5));
        assert_eq!(
            FieldFromMap::of(line.into_iter(), line[0], line[0], &field),
            None
        );
    }
}
