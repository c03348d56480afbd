use nalgebra::Isometry2;
use rand::Rng;
use tolman_geom::{Heading, OutOfRange, Vector};
use tolman_robot::{Picture, PinholeCamera, pioneer_2dx};

use super::Sensor;
use crate::{Chance, Channel, Draws, Motion, Surroundings, WallSegment};

mod column;
mod light;
mod texture;

use column::Column;
pub use light::{Light, LightDrift};
use light::{Shine, Weather};

/// Parameters of a camera's pictures.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct PictureCameraConfig {
    /// Number of pixels across, 1 to 4096.
    pub width: u32,
    /// Number of pixels down, 1 to 4096.
    pub height: u32,
    /// Mount and field of view of the camera.
    pub camera: PinholeCamera,
    /// Range, m.
    pub reach: f64,
    /// Colours beside the walls.
    pub backdrop: Backdrop,
    /// Lighting of the room.
    pub light: Light,
    /// Standard deviation of each pixel's red, green and blue, of 255.
    pub noise_sd: f64,
    /// Number of values of each of red, green and blue, 2 to 256.
    pub levels: u32,
}

/// Colours of a camera's view where no wall is.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Backdrop {
    /// Red, green and blue of the floor.
    pub floor: [u8; 3],
    /// Red, green and blue above and behind all walls.
    pub ceiling: [u8; 3],
    /// Maximum brightness change by stains on walls and floor, as a share.
    pub stains: f64,
}

impl PictureCameraConfig {
    /// Returns the Pioneer 2-DX's camera in steady light: pictures of 80 × 60 pixels without noise
    /// of a green floor.
    #[must_use]
    pub const fn noiseless() -> Self {
        Self {
            width: 80,
            height: 60,
            camera: pioneer_2dx::CAMERA,
            reach: 20.0,
            backdrop: Backdrop {
                floor: [40, 110, 60],
                ceiling: [200, 200, 195],
                stains: 0.0,
            },
            light: Light::steady(),
            noise_sd: 0.0,
            levels: 256,
        }
    }

    /// Returns the same camera in daylight from the west, with stains and noise. It has 32 levels
    /// per colour, like a frame grabber of 16 bits per pixel. The paper names the noise of the
    /// camera but gives no values.
    #[must_use]
    pub const fn noisy() -> Self {
        let perfect = Self::noiseless();
        Self {
            backdrop: Backdrop {
                stains: 0.08,
                ..perfect.backdrop
            },
            light: Light::daylight(Heading::WEST),
            noise_sd: 2.0,
            levels: 32,
            ..perfect
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        let half_circle = core::f64::consts::PI - 1e-6;
        let camera = &self.camera;
        let own = [
            ("width", f64::from(self.width), 1.0, 4096.0),
            ("height", f64::from(self.height), 1.0, 4096.0),
            ("camera.position.x", camera.position.x, -1e3, 1e3),
            ("camera.position.y", camera.position.y, -1e3, 1e3),
            ("camera.height", camera.height, 1e-6, 1e3),
            (
                "camera.field_across",
                camera.field_across,
                1e-6,
                half_circle,
            ),
            ("camera.field_down", camera.field_down, 1e-6, half_circle),
            ("reach", self.reach, 1e-6, 1e6),
            ("backdrop.stains", self.backdrop.stains, 0.0, 1.0),
            ("noise_sd", self.noise_sd, 0.0, 255.0),
            ("levels", f64::from(self.levels), 2.0, 256.0),
        ];
        for (field, value, least, most) in own.into_iter().chain(self.light.parts()) {
            OutOfRange::check(field, value, least..=most)?;
        }
        Ok(())
    }
}

/// A colour camera that looks ahead: the floor, the walls on it with their heights, and everything
/// visible above low ones.
///
/// Each column is one vertical plane: the walls along it, the nearest first, hide what lies behind
/// them from their base to their height. No picture is taken in motion, as it would be blurred.
///
/// # Complexity
/// Walls within reach times columns, and walls in a column times pixels.
#[derive(Clone, Debug)]
pub struct PictureCamera {
    config: PictureCameraConfig,
    weather: Weather,
    /// Walls of the last picture, kept for their memory.
    walls: Vec<WallSegment>,
    canvas: Vec<[f64; 3]>,
}

impl PictureCamera {
    /// Returns a camera for such pictures.
    ///
    /// # Errors
    /// If a number of the configuration is invalid.
    pub fn new(config: PictureCameraConfig) -> Result<Self, OutOfRange> {
        config.check()?;
        Ok(Self {
            config,
            weather: Weather::default(),
            walls: Vec::new(),
            canvas: Vec::new(),
        })
    }

    /// Returns a black picture of the camera's size.
    fn blank(&self) -> Picture {
        let config = &self.config;
        Picture::black(config.width, config.height, config.camera)
    }

    /// Paints the canvas row by row and returns the share of it that glows, 0 … 1.
    fn paint(&mut self, around: &Surroundings<'_>, blank: &Picture, shine: &Shine) -> f64 {
        let config = &self.config;
        let world_from_robot = Isometry2::from(around.truth.pose);
        let eye = world_from_robot * config.camera.position;
        around.standing_near(eye, config.reach, &mut self.walls);
        self.canvas.clear();
        self.canvas.resize(blank.pixels.len(), [0.0; 3]);
        let width = config.width as usize;
        let mut glow = 0.0;
        for across in 0..config.width {
            let direction = world_from_robot * Vector::new(1.0, blank.leftward(across));
            let height = config.camera.height;
            let column = Column::new(eye, height, direction, &self.walls, config.reach);
            for down in 0..config.height {
                let pixel = column.pixel(blank.upward(down), &config.backdrop, shine);
                self.canvas[down as usize * width + across as usize] = pixel.colour;
                glow += pixel.glow;
            }
        }
        glow / blank.pixels.len() as f64
    }

    /// Converts the canvas to pixels, with glare, noise and the configured number of levels.
    fn develop(&self, veil: f64, picture: &mut Picture, draws: &mut Draws) {
        let step = 255.0 / f64::from(self.config.levels - 1);
        for (pixel, colour) in picture.pixels.iter_mut().zip(&self.canvas) {
            let grain = grain(self.config.noise_sd, draws);
            *pixel = core::array::from_fn(|part| {
                let lit = colour[part] + veil * (255.0 - colour[part]) + grain[part];
                ((lit.clamp(0.0, 255.0) / step).round() * step).round() as u8
            });
        }
    }
}

/// Returns the noise of one pixel's colours: sums of two bytes, which look Gaussian in a picture.
fn grain(sd: f64, draws: &mut Draws) -> [f64; 3] {
    if sd <= 0.0 {
        return [0.0; 3];
    }
    /// Standard deviation of the sum of two bytes.
    const SUM_SD: f64 = 104.510_765;
    let bytes = draws.next_u64().to_le_bytes();
    [0, 2, 4].map(|part| {
        let sum = f64::from(bytes[part]) + f64::from(bytes[part + 1]);
        (sum - 255.0) * (sd / SUM_SD)
    })
}

impl Sensor for PictureCamera {
    type Reading = Picture;

    fn sense(&mut self, around: &Surroundings<'_>, chance: &Chance, reading: &mut Option<Picture>) {
        if around.truth.motion != Motion::default() {
            *reading = None;
            return;
        }
        let mut draws = chance.draws(Channel::named("camera light"));
        let shine = self.weather.next(&self.config.light, &mut draws);
        let mut picture = self.blank();
        let glowing = self.paint(around, &picture, &shine);
        let mut draws = chance.draws(Channel::named("camera noise"));
        self.develop(shine.veil(glowing), &mut picture, &mut draws);
        *reading = Some(picture);
    }
}
