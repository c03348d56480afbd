use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_sim::{Bounds, Material, WallSegment, World, WorldError};

/// Builder of an arena: a floor with its outline, things that hang on it, furniture, and the room
/// round it.
#[derive(Clone, Debug)]
pub(super) struct Room {
    /// The floor's corners, counter-clockwise.
    outline: Vec<Point>,
    furniture: Vec<Bounds>,
    walls: Vec<WallSegment>,
}

/// Part of a wall, from `from` to `to` along it, both as shares of its length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) side: usize,
    pub(super) from: f64,
    pub(super) to: f64,
}

/// Distance of a hanging thing from its wall, m.
const PROUD: f64 = 0.002;

/// Distance of a goal from the wall, m. It hangs in front of everything else.
const GOAL_PROUD: f64 = 2.0 * PROUD;

impl Room {
    /// Returns a floor with these corners, counter-clockwise, and walls of one material round it.
    pub(super) fn new(corners: &[(f64, f64)], material: Material) -> Self {
        let outline: Vec<Point> = corners.iter().map(|(x, y)| Point::new(*x, *y)).collect();
        let mut room = Self {
            walls: Vec::new(),
            furniture: Vec::new(),
            outline,
        };
        let sides = (0..room.outline.len()).map(|side| room.side(side));
        let walls: Vec<WallSegment> = sides
            .map(|(start, end)| WallSegment {
                start,
                end,
                material,
            })
            .collect();
        room.walls = walls;
        room
    }

    /// Returns the two ends of a side; side 0 leads from corner 0 to corner 1.
    pub(super) fn side(&self, side: usize) -> (Point, Point) {
        let corners = &self.outline;
        (
            corners[side % corners.len()],
            corners[(side + 1) % corners.len()],
        )
    }

    /// Returns the length of a side, m.
    pub(super) fn length(&self, side: usize) -> f64 {
        let (start, end) = self.side(side);
        (end - start).norm()
    }

    /// Returns the middle of a part of a side, looking onto the floor.
    pub(super) fn before(&self, span: Span) -> Pose {
        let (start, end) = self.side(span.side);
        let along = end - start;
        let middle = start + along * (0.5 * (span.from + span.to));
        Pose::new(middle, Heading::of(Vector::new(-along.y, along.x)))
    }

    /// Puts a goal before part of a side.
    pub(super) fn put_goal(&mut self, span: Span, material: Material) {
        let (start, end) = self.side(span.side);
        self.stand((start, end), span, GOAL_PROUD, material);
    }

    /// Hangs a window, a door or a picture on part of a side.
    pub(super) fn hang(&mut self, span: Span, material: Material) {
        let (start, end) = self.side(span.side);
        self.stand((start, end), span, PROUD, material);
    }

    /// Hangs a window, a door or a picture on the wall behind a side, `behind` m outward.
    pub(super) fn hang_behind(&mut self, span: Span, behind: f64, material: Material) {
        let (start, end) = self.around(span.side, behind);
        self.stand((start, end), span, PROUD, material);
    }

    fn stand(&mut self, (start, end): (Point, Point), span: Span, inward: f64, material: Material) {
        let along = end - start;
        // The floor lies to the left.
        let inward = Vector::new(-along.y, along.x) * (inward / along.norm());
        self.walls.push(WallSegment {
            start: start + along * span.from + inward,
            end: start + along * span.to + inward,
            material,
        });
    }

    /// Builds the walls of the room round an open floor, `behind` m outward of it.
    pub(super) fn enclose(&mut self, behind: f64, material: Material) {
        for side in 0..self.outline.len() {
            let (start, end) = self.around(side, behind);
            self.walls.push(WallSegment {
                start,
                end,
                material,
            });
        }
    }

    /// Returns the wall of the room behind a side of an outline, which must be a rectangle along
    /// the axes.
    fn around(&self, side: usize, behind: f64) -> (Point, Point) {
        let bounds = self.bounds();
        let middle = bounds.min + (bounds.max - bounds.min) * 0.5;
        let out = |point: Point| {
            let from_middle = point - middle;
            let push = |along: f64| along + behind * along.signum();
            middle + Vector::new(push(from_middle.x), push(from_middle.y))
        };
        let (start, end) = self.side(side);
        (out(start), out(end))
    }

    /// Puts a box on the floor.
    pub(super) fn furnish(&mut self, place: Bounds, material: Material) {
        let (min, max) = (place.min, place.max);
        let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
        for (index, start) in corners.into_iter().enumerate() {
            self.walls.push(WallSegment {
                start,
                end: corners[(index + 1) % 4],
                material,
            });
        }
        self.furniture.push(place);
    }

    /// Returns the boxes on the floor.
    pub(super) fn furniture(&self) -> &[Bounds] {
        &self.furniture
    }

    /// Returns the smallest rectangle that holds the floor.
    pub(super) fn bounds(&self) -> Bounds {
        Bounds::of(self.outline.iter().copied())
    }

    /// Returns whether a point lies on the floor and in no furniture.
    pub(super) fn holds(&self, point: Point) -> bool {
        let mut furniture = self.furniture.iter();
        self.surrounds(point) && !furniture.any(|place| place.contains(point))
    }

    /// Returns whether the outline encloses a point: whether a ray to the east crosses it an odd
    /// number of times.
    fn surrounds(&self, point: Point) -> bool {
        let crossings = (0..self.outline.len()).filter(|side| {
            let (start, end) = self.side(*side);
            let spans = (start.y > point.y) != (end.y > point.y);
            spans && {
                let share = (point.y - start.y) / (end.y - start.y);
                point.x < start.x + share * (end.x - start.x)
            }
        });
        crossings.count() % 2 == 1
    }

    /// Returns the world of all its walls.
    pub(super) fn world(&self) -> Result<World, WorldError> {
        World::from_segments(self.walls.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_floor_with_a_corner_missing_holds_what_is_on_it() {
        let corners = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 2.0),
            (2.0, 2.0),
            (2.0, 4.0),
            (0.0, 4.0),
        ];
        let mut room = Room::new(&corners, Material::default());
        let place = Bounds {
            min: Point::new(0.5, 0.5),
            max: Point::new(1.0, 1.0),
        };
        room.furnish(place, Material::default());
        for (x, y, is_held) in [
            (3.0, 1.0, true),
            (1.0, 3.0, true),
            (3.0, 3.0, false),
            (0.7, 0.7, false),
            (-1.0, 1.0, false),
            (5.0, 1.0, false),
        ] {
            assert_eq!(room.holds(Point::new(x, y)), is_held, "({x}, {y})");
        }
        assert_eq!(room.world().unwrap().walls().len(), 10);
    }

    /// A thing on the south wall hangs north of it. A thing behind hangs on the wall behind.
    #[test]
    fn things_hang_inside() {
        let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)];
        let mut room = Room::new(&corners, Material::default());
        let span = Span {
            side: 0,
            from: 0.25,
            to: 0.75,
        };
        room.hang(span, Material::default());
        room.hang_behind(span, 1.0, Material::default());
        let walls = room.world().unwrap().walls().to_vec();
        assert!((walls[4].start - Point::new(1.0, PROUD)).norm() < 1e-12);
        assert!((walls[5].start - Point::new(0.5, PROUD - 1.0)).norm() < 1e-12);
        assert!((walls[5].end - Point::new(3.5, PROUD - 1.0)).norm() < 1e-12);
    }
}
