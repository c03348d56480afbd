//! The maze, the robot and its way, in braille dots.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::symbols::Marker;
use ratatui::text::Line as Text;
use ratatui::widgets::canvas::{Canvas, Circle, Context, Line, Points};
use tolman_geom::{Point, Pose, Vector};
use tolman_sim::{Area, Bounds, Zone};

use super::palette;
use super::view::{Beams, View};
use super::window::Window;

/// Width and height of a braille character, in dots.
const DOTS: (u32, u32) = (2, 4);

/// Distance between two dots of the trail, in dots of the grid. The gap tells a trail from a wall
/// without colours.
const TRAIL_SPACING: f64 = 2.0;

/// Distance between two dots of the destination's floor, in dots of the grid.
const FLOOR_SPACING: f64 = 3.0;

/// Maximum number of laser beams drawn.
const BEAMS: usize = 24;

pub(super) fn draw(view: &View, frame: &mut Frame<'_>, area: Rect) {
    let course = &view.scene.course;
    let window = Window::on(
        course.world.bounds(),
        course.corridor_width,
        view.pose.position,
        DOTS.0 * u32::from(area.width),
        DOTS.1 * u32::from(area.height),
    );
    let canvas = Canvas::default()
        .marker(Marker::Braille)
        .x_bounds(window.x)
        .y_bounds(window.y)
        .paint(|context| paint(view, window, context));
    frame.render_widget(canvas, area);
}

/// Paints from the bottom layer up. Where layers share a character, the last one gives the colour.
fn paint(view: &View, window: Window, context: &mut Context<'_>) {
    let course = &view.scene.course;
    let inked = |color| palette::inked(color, view.ink);
    if let Some(destination) = course.destination() {
        floor(context, destination, window, inked(palette::DESTINATION));
    }
    let trail: Vec<Point> = view.trail.iter().copied().collect();
    dotted(
        context,
        &trail,
        window.metres_per_dot,
        inked(palette::TRAIL),
    );
    if let (Beams::Shown, Some(scan)) = (view.beams, &view.scan) {
        let stride = scan.ranges.len().div_ceil(BEAMS).max(1);
        for (beam, range) in (0..).zip(&scan.ranges).step_by(stride) {
            let heading = view.pose.heading.turned(scan.ring.bearing(beam));
            let end = view.pose.position + heading.unit() * *range;
            line(context, view.pose.position, end, inked(palette::BEAMS));
        }
    }
    for wall in course.world.walls() {
        line(context, wall.start, wall.end, inked(palette::WALLS));
    }
    for [from, to] in &view.known.ways {
        line(context, *from, *to, inked(palette::MAP));
    }
    let coordinates = |points: &[Point]| points.iter().map(|at| (at.x, at.y)).collect::<Vec<_>>();
    let places = coordinates(&view.known.places);
    context.draw(&Points::new(&places, inked(palette::MAP)));
    for at in &view.known.belief {
        let radius = 0.6 * view.scene.radius;
        context.draw(&Circle::new(at.x, at.y, radius, inked(palette::BELIEF)));
    }
    let Pose { position, heading } = view.pose;
    context.draw(&Circle::new(
        position.x,
        position.y,
        view.scene.radius,
        inked(palette::ROBOT),
    ));
    let arrow = arrow(heading.radians());
    let style = Style::new().fg(inked(palette::ROBOT)).bold();
    context.print(position.x, position.y, Text::styled(arrow, style));
}

fn line(context: &mut Context<'_>, from: Point, to: Point, color: Color) {
    context.draw(&Line::new(from.x, from.y, to.x, to.y, color));
}

/// Draws evenly spaced dots along a path.
fn dotted(context: &mut Context<'_>, way: &[Point], metres_per_dot: f64, color: Color) {
    let spacing = TRAIL_SPACING * metres_per_dot;
    let mut dots = Vec::new();
    let mut left = 0.0;
    for pair in way.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let length = (to - from).norm();
        while left < length {
            let dot = from + (to - from) * (left / length);
            dots.push((dot.x, dot.y));
            left += spacing;
        }
        left -= length;
    }
    context.draw(&Points::new(&dots, color));
}

fn floor(context: &mut Context<'_>, zone: &Zone, window: Window, color: Color) {
    let spacing = FLOOR_SPACING * window.metres_per_dot;
    let mut dots = Vec::new();
    for area in zone.areas() {
        let bounds = bounds(area);
        let count = |extent: f64| (extent / spacing) as u32;
        for column in 0..=count(bounds.width()) {
            for row in 0..=count(bounds.height()) {
                dots.push((
                    bounds.min.x + (f64::from(column) + 0.5) * spacing,
                    bounds.min.y + (f64::from(row) + 0.5) * spacing,
                ));
            }
        }
    }
    dots.retain(|(x, y)| zone.contains(Point::new(*x, *y)));
    context.draw(&Points::new(&dots, color));
}

/// Returns the smallest rectangle that holds a part of the floor.
fn bounds(area: &Area) -> Bounds {
    match *area {
        Area::Rectangle(bounds) => bounds,
        Area::Disc { centre, radius } => {
            let corner = Vector::new(radius, radius);
            Bounds {
                min: centre - corner,
                max: centre + corner,
            }
        }
    }
}

/// Returns the arrow nearest to a heading of `radians`, counter-clockwise from east.
fn arrow(radians: f64) -> &'static str {
    const ARROWS: [&str; 8] = ["→", "↗", "↑", "↖", "←", "↙", "↓", "↘"];
    let eighths = (radians / core::f64::consts::FRAC_PI_4).round() as i32;
    ARROWS[eighths.rem_euclid(8) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arrow_looks_where_the_robot_does() {
        for (degrees, expect) in [
            (0.0, "→"),
            (22.0, "→"),
            (23.0, "↗"),
            (90.0, "↑"),
            (180.0, "←"),
            (-180.0, "←"),
            (-90.0, "↓"),
            (-44.0, "↘"),
        ] {
            assert_eq!(arrow(f64::to_radians(degrees)), expect, "{degrees}°");
        }
    }
}
