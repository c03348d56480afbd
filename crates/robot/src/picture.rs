use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::Point;

/// A colour picture of the view ahead.
///
/// Straight lines stay straight: the camera is a pinhole. The left of the picture is on the robot's
/// left. A map made from a mirrored picture is a mirror image of the world.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Picture {
    /// Number of pixels across.
    pub width: u32,
    /// Number of pixels down.
    pub height: u32,
    /// The camera that took the picture.
    pub camera: PinholeCamera,
    /// Red, green and blue of each pixel, row by row from the top, each from the left; `width` ×
    /// `height` of them.
    pub pixels: Vec<[u8; 3]>,
}

/// Mount and field of view of a camera. It looks straight ahead and level.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PinholeCamera {
    /// Position in the robot's frame, m.
    pub position: Point,
    /// Height above the floor, m.
    pub height: f64,
    /// Horizontal field of view, rad, from edge to edge; below π.
    pub field_across: f64,
    /// Vertical field of view, rad, from edge to edge; below π.
    pub field_down: f64,
}

impl Picture {
    /// Returns a black picture.
    #[must_use]
    pub fn black(width: u32, height: u32, camera: PinholeCamera) -> Self {
        Self {
            width,
            height,
            camera,
            pixels: vec![[0; 3]; width as usize * height as usize],
        }
    }

    /// Returns the colour of the pixel in a column, counted from the left, and a row, counted from
    /// the top; `None` beyond the picture.
    #[must_use]
    pub fn pixel(&self, column: u32, row: u32) -> Option<[u8; 3]> {
        if column >= self.width {
            return None;
        }
        let index = row as usize * self.width as usize + column as usize;
        self.pixels.get(index).copied()
    }

    /// Returns the tangent of the angle between the picture's middle and the middle of a column,
    /// positive to the left.
    ///
    /// ```
    /// use tolman_robot::{Picture, pioneer_2dx};
    ///
    /// let picture = Picture::black(80, 60, pioneer_2dx::CAMERA);
    /// assert!(picture.leftward(0) > 0.0, "column 0 looks to the left");
    /// assert!((picture.leftward(0) + picture.leftward(79)).abs() < 1e-12);
    /// assert!(picture.upward(0) > 0.0, "row 0 looks up");
    /// ```
    #[must_use]
    pub fn leftward(&self, column: u32) -> f64 {
        share_before_middle(column, self.width) * 2.0 * libm::tan(0.5 * self.camera.field_across)
    }

    /// Returns the tangent of the angle between the picture's middle and the middle of a row,
    /// positive upwards.
    #[must_use]
    pub fn upward(&self, row: u32) -> f64 {
        share_before_middle(row, self.height) * 2.0 * libm::tan(0.5 * self.camera.field_down)
    }
}

/// Returns 0.5 at the first edge, −0.5 at the last.
fn share_before_middle(index: u32, count: u32) -> f64 {
    0.5 - (f64::from(index) + 0.5) / f64::from(count.max(1))
}
