use alloc::vec::Vec;

use tolman_geom::Point;
use tolman_robot::Picture;

use super::OutlinePoint;

/// Returns the positions on the floor at which things stand in a picture, in order of bearing, in
/// the robot's frame, m. In each column it is the first row from below that differs from the floor
/// below it. O(pixels).
///
/// A column has no point if its floor reaches the horizon, or if no floor shows in it.
#[must_use]
pub fn foot_line(picture: &Picture) -> Vec<OutlinePoint> {
    let columns = (0..picture.width).step_by(picture.width.div_ceil(MOST_COLUMNS).max(1) as usize);
    columns.filter_map(|column| foot(picture, column)).collect()
}

/// Maximum number of columns; more are thinned out.
const MOST_COLUMNS: u32 = 40;

/// Number of rows at the bottom that have to be floor.
const FLOOR_ROWS: u32 = 3;

/// Number of rows above the foot whose mean colour counts as the thing's colour.
const COLOUR_ROWS: u32 = 3;

/// Difference of a colour channel from the floor, as a share of the brightness, above which a pixel
/// is not floor.
const UNLIKE: f64 = 0.22;

/// Minimum angle below the horizon at which a foot is used, as a tangent: the distance of farther
/// things is too vague.
const LEAST_DOWN: f64 = 0.09;

/// Minimum distance of a foot, m: nearer things would be under the camera.
const NEAREST: f64 = 0.01;

fn foot(picture: &Picture, column: u32) -> Option<OutlinePoint> {
    let bottom = picture.height.checked_sub(FLOOR_ROWS)?;
    let mut floor = mean(picture, column, bottom..picture.height)?;
    let mut row = bottom;
    loop {
        row = row.checked_sub(1)?;
        let pixel = colour(picture.pixel(column, row)?);
        if unlikeness(pixel, floor) > UNLIKE {
            break;
        }
        // The brightness of the floor changes with the distance.
        for (floor, pixel) in floor.iter_mut().zip(pixel) {
            *floor += 0.3 * (pixel - *floor);
        }
    }
    if row + 1 == bottom {
        // The lowest rows may show something other than floor.
        return None;
    }
    let thing = mean(
        picture,
        column,
        row.saturating_sub(COLOUR_ROWS - 1)..row + 1,
    )?;
    let row_height = picture.upward(row) - picture.upward(row + 1);
    let down = -0.5 * (picture.upward(row) + picture.upward(row + 1));
    if down < LEAST_DOWN {
        return None;
    }
    let ahead = picture.camera.height / down;
    if !(ahead > NEAREST && ahead.is_finite()) {
        return None;
    }
    let position = Point::new(ahead, ahead * picture.leftward(column));
    let total = thing.iter().sum::<f64>().max(1.0);
    Some(OutlinePoint {
        position: position + picture.camera.position.coords,
        normal: None,
        // The exact height of an edge within its row is unknown.
        deviation: 0.01 + 0.3 * row_height * ahead / down,
        colour: Some([thing[0] / total, thing[1] / total]),
    })
}

fn colour(pixel: [u8; 3]) -> [f64; 3] {
    pixel.map(f64::from)
}

fn mean(picture: &Picture, column: u32, rows: core::ops::Range<u32>) -> Option<[f64; 3]> {
    let count = f64::from(
        rows.end
            .checked_sub(rows.start)
            .filter(|count| *count > 0)?,
    );
    let mut sum = [0.0; 3];
    for row in rows {
        for (sum, part) in sum.iter_mut().zip(colour(picture.pixel(column, row)?)) {
            *sum += part / count;
        }
    }
    Some(sum)
}

/// Returns the largest difference of a colour channel, as a share of the brightness.
fn unlikeness(a: [f64; 3], b: [f64; 3]) -> f64 {
    let brightness = (a.iter().sum::<f64>() + b.iter().sum::<f64>()) / 6.0 + 10.0;
    let parts = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    parts.fold(0.0, f64::max) / brightness
}
