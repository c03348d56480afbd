//! The plan of a world, seen from above.

use maud::{Markup, html};
use tolman_geom::{Point, Vector};
use tolman_sim::{Bounds, World};

use super::number::{line, short_line, tenths};
use super::plan_key::{KeyMark, PlanKey};
use super::simplify::simplified;
use super::words;
use super::{Drawing, GraphPicture, Image, Region, Series, Shade};

/// Free space around the outermost walls, in user units.
const MARGIN: f64 = 8.0;

/// Meaning of a zone of the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZoneStyle {
    /// Destination of the robot.
    Destination,
    /// A part of the floor that is marked.
    Region,
    /// Walled off: no floor.
    Solid,
}

/// A plan to which layers are added from the bottom up. World coordinates are metres, x to the
/// right and y upwards.
#[derive(Clone, Debug)]
pub struct FloorPlan {
    west: f64,
    north: f64,
    /// User units per metre.
    scale: f64,
    width: f64,
    height: f64,
    layers: Vec<Markup>,
    walls: Markup,
    /// Meaning of the colours of cells.
    legend: Option<Shade>,
    /// Meaning of the signs, and the length of a metre.
    key: PlanKey,
}

impl FloorPlan {
    /// Returns a plan of a part of the world, `width` user units wide, without walls. Bounds
    /// without extent show one square metre.
    pub fn of_bounds(bounds: &Bounds, width: f64) -> Self {
        let extent = |low: f64, high: f64| match high - low {
            extent if extent > 0.0 && extent.is_finite() => extent,
            _ => 1.0,
        };
        let (extent_x, extent_y) = (
            extent(bounds.min.x, bounds.max.x),
            extent(bounds.min.y, bounds.max.y),
        );
        let is_place = bounds.min.x.is_finite() && bounds.min.y.is_finite();
        let min = if is_place {
            bounds.min
        } else {
            Point::origin()
        };
        let scale = (width - 2.0 * MARGIN) / extent_x;
        Self {
            west: min.x,
            north: min.y + extent_y,
            scale,
            width,
            height: scale * extent_y + 2.0 * MARGIN,
            layers: Vec::new(),
            walls: html! {},
            legend: None,
            key: PlanKey::default(),
        }
    }

    /// Returns a plan that is `width` user units wide and holds all walls. Walls are drawn above
    /// every layer. If all walls are at one point, the plan shows one square metre around it.
    pub fn of_walls(walls: &[[Point; 2]], width: f64) -> Self {
        Self::of_walls_and(walls, &[], width)
    }

    /// Returns a plan with these walls that is also large enough for the points `held`.
    pub fn of_walls_and(walls: &[[Point; 2]], held: &[Point], width: f64) -> Self {
        let points = walls.iter().flatten().chain(held);
        let bounds = Bounds::of(points.copied());
        let mut plan = Self::of_bounds(&bounds, width);
        let lines = walls.iter().map(|wall| line(wall.map(|end| plan.at(end))));
        let path: String = lines.collect();
        plan.walls = html! { path class="wall" stroke-width="2.5" d=(path) {} };
        plan
    }

    /// Returns a plan of a world that is `width` user units wide, with its walls and a scale bar.
    pub fn of_world(world: &World, width: f64) -> Self {
        Self::of_world_holding(world, &[], width)
    }

    /// Returns a plan of a world that is also large enough for these points. What a robot believes
    /// may lie beyond the walls.
    pub fn of_world_holding(world: &World, held: &[Point], width: f64) -> Self {
        let walls = world.walls().iter();
        let walls: Vec<[Point; 2]> = walls.map(|wall| [wall.start, wall.end]).collect();
        let mut plan = Self::of_walls_and(&walls, held, width);
        plan.scale_bar();
        plan
    }

    /// Adds a scale bar below the plan, which requires that its units are metres. A plan of a world
    /// has one already.
    pub fn scale_bar(&mut self) {
        self.key.scale = Some(self.scale);
    }

    /// Adds the meaning of a sign to the key below the plan.
    pub fn key(&mut self, mark: KeyMark, series: Series, meaning: impl Into<String>) {
        self.key.entries.push((mark, series, meaning.into()));
    }

    /// Adds a zone given by its corners in order.
    pub fn zone(&mut self, corners: &[Point], zone: ZoneStyle) {
        let class = match zone {
            ZoneStyle::Destination => "destination",
            ZoneStyle::Region => "region",
            ZoneStyle::Solid => "solid",
        };
        let path = self.path(corners);
        self.layers
            .push(html! { path class=(class) d={ (path) "Z" } {} });
    }

    /// Adds a trajectory with a ring at its start and a dot at its end.
    pub fn trajectory(&mut self, positions: &[Point], series: Series) {
        let (Some(start), Some(end)) = (positions.first(), positions.last()) else {
            return;
        };
        let path = self.path(positions);
        let ((start_x, start_y), (end_x, end_y)) = (self.at(*start), self.at(*end));
        self.layers.push(html! {
            g class=(series.class()) {
                path class="trajectory" d=(path) {}
                circle class="start" cx=(tenths(start_x)) cy=(tenths(start_y)) r="4" {}
                circle class="end" cx=(tenths(end_x)) cy=(tenths(end_y)) r="4.5" {}
            }
        });
    }

    /// Adds a thin trajectory without ends, for many in one plan.
    pub fn faint_trajectory(&mut self, positions: &[Point], series: Series) {
        self.stroke("trajectory faint", None, positions, series);
    }

    /// Adds a broad band along positions, without ends: a way on a map that leaves other marks
    /// visible.
    pub fn way(&mut self, positions: &[Point], series: Series) {
        self.stroke("way", None, positions, series);
    }

    /// Adds a dashed line, for a way that is doubtful.
    pub fn doubtful_way(&mut self, positions: &[Point], series: Series) {
        self.stroke("trajectory", Some("4 3"), positions, series);
    }

    /// Adds many straight lines as one element; dashed for doubtful ones.
    pub fn segments(&mut self, segments: &[[Point; 2]], dashed: bool, series: Series) {
        let lines = segments
            .iter()
            .map(|ends| line(ends.map(|end| self.at(end))));
        let path: String = lines.collect();
        let dashes = dashed.then_some("4 3");
        self.layers.push(html! {
            path class={ "edge " (series.class()) } stroke-dasharray=[dashes] d=(path) {}
        });
    }

    fn stroke(&mut self, class: &str, dashes: Option<&str>, positions: &[Point], series: Series) {
        let path = self.path(positions);
        self.layers.push(html! {
            path class={ (class) " " (series.class()) } stroke-dasharray=[dashes] d=(path) {}
        });
    }

    /// Adds a square zone around its middle, `side` metres wide.
    pub fn square(&mut self, middle: Point, side: f64, zone: ZoneStyle) {
        let half = 0.5 * side;
        let corners = [(-half, -half), (half, -half), (half, half), (-half, half)];
        self.zone(&corners.map(|(x, y)| middle + Vector::new(x, y)), zone);
    }

    /// Adds a graph, each node at its coordinates.
    pub fn graph(&mut self, graph: &GraphPicture) {
        let frame = (self.width, self.height);
        let markup = graph.markup(&|position| self.at(position), frame);
        self.layers.push(markup);
    }

    /// Adds a region where something may be.
    pub fn region(&mut self, region: &Region, series: Series) {
        let class = format!("uncertain {}", series.class());
        let markup = match *region {
            Region::Box {
                pose,
                length,
                width,
            } => {
                let corner = |along: f64, across: f64| {
                    pose.transform(Point::new(0.5 * along * length, 0.5 * across * width))
                };
                let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
                let path = self.path(&corners.map(|(along, across)| corner(along, across)));
                html! { path class=(class) d={ (path) "Z" } {} }
            }
            Region::Ellipse {
                pose,
                along,
                across,
            } => {
                let (x, y) = self.at(pose.position);
                // Counter-clockwise in the world is clockwise where y grows downwards.
                let turn = -pose.heading.degrees();
                html! {
                    ellipse class=(class)
                        rx=(tenths(along * self.scale)) ry=(tenths(across * self.scale))
                        transform={
                            "translate(" (tenths(x)) " " (tenths(y)) ") rotate(" (tenths(turn)) ")"
                        } {}
                }
            }
        };
        self.layers.push(markup);
    }

    /// Adds square cells, `side` metres wide, each with its middle and its value. `shade` colours
    /// them; non-finite values are left out. The key below the plan appears once, so give every
    /// call the same shade.
    ///
    /// ```
    /// use tolman_draw::{FloorPlan, Shade};
    /// use tolman_geom::Point;
    ///
    /// let steps = [(0.5, 2.0), (1.5, 1.0), (2.5, 0.0)];
    /// let cells: Vec<_> = steps.iter().map(|&(x, steps)| (Point::new(x, 0.5), steps)).collect();
    /// let shade = Shade::of("steps to the goal", cells.iter().map(|cell| cell.1));
    /// let mut plan = FloorPlan::of_walls(&[[Point::new(0.0, 0.0), Point::new(3.0, 1.0)]], 400.0);
    /// plan.cells(&cells, 1.0, &shade);
    /// let drawing = plan.drawing("How far each cell is from the goal.");
    /// # assert!(drawing.body.into_string().contains("steps to the goal"));
    /// ```
    pub fn cells(&mut self, cells: &[(Point, f64)], side: f64, shade: &Shade) {
        let size = side * self.scale;
        // Values are written only if there is room for them.
        let longest = cells.iter().map(|cell| shade.text(cell.1).len()).max();
        let written = words::width("0") * longest.unwrap_or(0) as f64 + 4.0 < size && size > 16.0;
        let placed = cells.iter().filter(|(_, value)| value.is_finite());
        let markup = html! {
            g class=(shade.series.class()) {
                @for (middle, value) in placed {
                    @let (x, y) = self.at(*middle);
                    rect class="heat" fill-opacity=(shade.opacity(*value))
                        x=(tenths(x - 0.5 * size)) y=(tenths(y - 0.5 * size))
                        width=(tenths(size)) height=(tenths(size)) {}
                    @if written {
                        text class={ "small " (shade.text_class(*value)) } x=(tenths(x)) y=(tenths(y))
                            text-anchor="middle" dominant-baseline="central" { (shade.text(*value)) }
                    }
                }
            }
        };
        self.layers.push(markup);
        self.legend = Some(shade.clone());
    }

    /// Adds a picture made of pixels that covers a part of the world.
    pub fn image(&mut self, image: &Image, bounds: &Bounds) {
        let ((west, south), (east, north)) = (self.at(bounds.min), self.at(bounds.max));
        self.layers
            .push(image.element(Some((west, north)), (east - west, south - north)));
    }

    /// Adds a word centred at a position.
    pub fn label(&mut self, position: Point, text: &str) {
        let (x, y) = self.at(position);
        self.layers.push(html! {
            text class="halo" x=(tenths(x)) y=(tenths(y)) text-anchor="middle"
                dominant-baseline="central" { (text) }
        });
    }

    /// Adds the caller's own SVG elements; [`Self::at`] gives their coordinates.
    pub fn layer(&mut self, elements: Markup) {
        self.layers.push(elements);
    }

    /// Returns the position on the plan of a position in the world, user units.
    pub fn at(&self, position: Point) -> (f64, f64) {
        (
            MARGIN + (position.x - self.west) * self.scale,
            MARGIN + (self.north - position.y) * self.scale,
        )
    }

    /// Returns the finished picture. `description` describes it in words.
    pub fn drawing(self, description: impl Into<String>) -> Drawing {
        let legend = self.legend.as_ref().map_or(0.0, |_| Shade::LEGEND + 8.0);
        let (key, key_height) = self.key.markup(MARGIN, self.height + legend, self.width);
        let body = html! {
            rect class="floor" width=(tenths(self.width)) height=(tenths(self.height)) {}
            @for layer in &self.layers { (layer) }
            (self.walls)
            @if let Some(shade) = &self.legend { (shade.legend(MARGIN, self.height + 8.0)) }
            (key)
        };
        Drawing {
            width: self.width,
            height: self.height + legend + key_height,
            description: description.into(),
            body,
        }
    }

    /// Returns SVG path data through positions. It leaves out corners too small to see, and
    /// positions that round to the same point as the one before.
    fn path(&self, positions: &[Point]) -> String {
        let places = positions.iter().map(|position| self.at(*position));
        short_line(simplified(&places.collect::<Vec<_>>()))
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Heading, Pose};

    use super::*;

    fn square() -> FloorPlan {
        let corners =
            [(1.0, 1.0), (5.0, 1.0), (5.0, 3.0), (1.0, 3.0)].map(|(x, y)| Point::new(x, y));
        let walls: Vec<_> = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
        FloorPlan::of_walls(&walls, 2.0 * MARGIN + 400.0)
    }

    #[test]
    fn y_grows_upwards_and_the_scale_is_the_same_in_both_directions() {
        let plan = square();
        assert_eq!(plan.at(Point::new(1.0, 3.0)), (MARGIN, MARGIN));
        assert_eq!(
            plan.at(Point::new(5.0, 1.0)),
            (MARGIN + 400.0, MARGIN + 200.0)
        );
    }

    #[test]
    fn positions_that_round_alike_are_drawn_once() {
        let plan = square();
        let path =
            plan.path(&[(1.0, 3.0), (1.0001, 3.0), (2.0, 3.0)].map(|(x, y)| Point::new(x, y)));
        assert_eq!(path, "M8 8L108 8");
    }

    #[test]
    fn regions_turn_counter_clockwise_in_the_world() {
        let mut plan = square();
        let pose = Pose::new(Point::new(3.0, 2.0), Heading::from_degrees(90.0));
        let (length, width) = (1.0, 0.5);
        plan.region(
            &Region::Box {
                pose,
                length,
                width,
            },
            Series(0),
        );
        let pose = Pose::new(pose.position, Heading::from_degrees(30.0));
        let (along, across) = (0.5, 0.1);
        plan.region(
            &Region::Ellipse {
                pose,
                along,
                across,
            },
            Series(1),
        );
        let svg = plan.drawing("regions").body.into_string();
        // 100 units per metre: north-west, south-west, south-east, north-east of 208, 108.
        assert!(svg.contains("M183 58L183 158L233 158L233 58Z"), "{svg}");
        assert!(svg.contains("rx=\"50\" ry=\"10\" transform=\"translate(208 108) rotate(-30)\""));
    }

    #[test]
    fn cells_lie_around_their_middle_and_have_a_legend() {
        let mut plan = square();
        let cells = [
            (Point::new(1.5, 2.5), 3.0),
            (Point::new(2.5, 2.5), f64::NAN),
        ];
        plan.cells(&cells, 1.0, &Shade::new("steps", 0.0, 3.0));
        let drawing = plan.drawing("cells");
        assert!((drawing.height - (200.0 + 2.0 * MARGIN + 8.0 + Shade::LEGEND)).abs() < 1e-9);
        let svg = drawing.body.into_string();
        assert!(
            svg.contains("x=\"8\" y=\"8\" width=\"100\" height=\"100\""),
            "{svg}"
        );
        assert_eq!(svg.matches("width=\"100\"").count(), 1);
        assert!(svg.contains(">3</text>") && svg.contains("steps"));
    }

    #[test]
    fn no_walls_and_no_positions_give_an_empty_plan() {
        let mut plan = FloorPlan::of_walls(&[], 100.0);
        plan.trajectory(&[], Series(0));
        let drawing = plan.drawing("nothing");
        assert!(drawing.height.is_finite());
        assert!(!drawing.body.into_string().contains("trajectory"));
    }
}
