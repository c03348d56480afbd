//! Converts drawings to Rerun's archetypes.

use re_sdk_types::archetypes::{LineStrips3D, Points3D, Transform3D};
use re_sdk_types::components::Color;
use re_sdk_types::datatypes::Quaternion;
use re_sdk_types::{AsComponents, SerializedComponentBatch};
use tolman_geom::{Heading, Point, Pose};
use tolman_replay::{FloorDrawing, Rgba};
use tolman_robot::Ring;

/// Half the width of lines, in points of the screen: below 0, as Rerun wants it.
const LINE: f32 = -1.0;
/// Radius of the points where beams ended, points of the screen.
const HIT: f32 = -2.0;
/// Colour of the points where beams ended.
const GREY: Rgba = [0.5, 0.5, 0.5, 1.0];

/// Returns the components of a drawing.
pub(crate) fn drawing(drawing: &FloorDrawing) -> Vec<SerializedComponentBatch> {
    match drawing {
        FloorDrawing::Segments(segments, ink) => {
            let strips = segments.iter().map(|ends| ends.map(xyz).to_vec());
            lines(strips.collect(), *ink)
        }
        FloorDrawing::Outline(corners, ink) => {
            let closed = corners.iter().chain(corners.first());
            lines(vec![closed.copied().map(xyz).collect()], *ink)
        }
        FloorDrawing::Discs(discs) => Points3D::new(discs.iter().map(|disc| xyz(disc.centre)))
            .with_radii(discs.iter().map(|disc| disc.radius as f32))
            .with_colors(discs.iter().map(|disc| colour(disc.colour)))
            .as_serialized_batches(),
    }
}

fn lines(strips: Vec<Vec<[f32; 3]>>, ink: Rgba) -> Vec<SerializedComponentBatch> {
    LineStrips3D::new(strips)
        .with_radii([LINE])
        .with_colors([colour(ink)])
        .as_serialized_batches()
}

/// Returns the transform from a robot's frame into that of the world.
pub(crate) fn transform(pose: Pose) -> Vec<SerializedComponentBatch> {
    let half = 0.5 * pose.heading.radians();
    let turn = [0.0, 0.0, libm::sin(half) as f32, libm::cos(half) as f32];
    let turn = Quaternion::from_xyzw(turn);
    Transform3D::from_translation_rotation(xyz(pose.position), turn).as_serialized_batches()
}

/// Returns the points that the beams of a scan met, in the robot's frame. Beams that met nothing
/// are left out.
pub(crate) fn scan(ring: &Ring, ranges: &[f64]) -> Vec<SerializedComponentBatch> {
    let beams = (0..).zip(ranges);
    let met = beams.filter(|(_, range)| **range < ring.max_range);
    let hits = met.map(|(beam, range)| {
        let bearing = Heading::from_radians(ring.bearing(beam));
        xyz(Point::origin() + *range * bearing.unit())
    });
    Points3D::new(hits)
        .with_radii([HIT])
        .with_colors([colour(GREY)])
        .as_serialized_batches()
}

fn xyz(point: Point) -> [f32; 3] {
    [point.x as f32, point.y as f32, 0.0]
}

fn colour(ink: Rgba) -> Color {
    let [r, g, b, a] = ink.map(|part| (255.0 * part).round() as u8);
    Color::from_unmultiplied_rgba(r, g, b, a)
}
