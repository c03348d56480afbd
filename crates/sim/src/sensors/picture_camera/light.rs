use tolman_geom::{Heading, Vector};

use crate::Draws;

/// Lighting of a room, and its changes between pictures.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Light {
    /// Average brightness; 1 shows colours as they are.
    pub brightness: f64,
    /// Average brightness of red, green and blue, each 1 in white light.
    pub cast: [f64; 3],
    /// Direction from which most of the light comes.
    pub from: Heading,
    /// Additional brightness of a wall that faces the light, as a share. A wall that faces away is
    /// darker by the same share.
    pub shade: f64,
    /// Share of full light that glowing walls would add to the whole picture if they filled it.
    pub glare: f64,
    /// Changes of the light.
    pub drift: LightDrift,
}

/// Drift of the light: slow random changes round its average.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightDrift {
    /// Number of pictures over which the light forgets its earlier deviations.
    pub pictures: f64,
    /// Standard deviation of the brightness, as a share.
    pub brightness_sd: f64,
    /// Standard deviation of each colour's brightness, as a share.
    pub cast_sd: f64,
    /// Standard deviation of the direction of the light, rad.
    pub from_sd: f64,
    /// Standard deviation of the brightness outside, which windows show, as a share.
    pub outside_sd: f64,
    /// Standard deviation of the brightness from picture to picture, beside the drift, as a share.
    pub flicker_sd: f64,
}

impl Light {
    /// Returns white light from everywhere that never changes.
    #[must_use]
    pub const fn steady() -> Self {
        Self {
            brightness: 1.0,
            cast: [1.0; 3],
            from: Heading::EAST,
            shade: 0.0,
            glare: 0.0,
            drift: LightDrift {
                pictures: 0.0,
                brightness_sd: 0.0,
                cast_sd: 0.0,
                from_sd: 0.0,
                outside_sd: 0.0,
                flicker_sd: 0.0,
            },
        }
    }

    /// Returns daylight through windows that look to `from`, and lamps. It changes within some
    /// fifty pictures, and windows glare. The paper names changing light but gives no values
    /// (section 3.4).
    #[must_use]
    pub const fn daylight(from: Heading) -> Self {
        Self {
            brightness: 0.8,
            cast: [1.0; 3],
            from,
            shade: 0.15,
            glare: 0.3,
            drift: LightDrift {
                pictures: 50.0,
                brightness_sd: 0.1,
                cast_sd: 0.03,
                from_sd: 0.4,
                outside_sd: 0.25,
                flicker_sd: 0.02,
            },
        }
    }

    /// Returns the numbers of the light, with their names and their least and greatest valid
    /// values.
    pub(super) fn parts(&self) -> [(&'static str, f64, f64, f64); 13] {
        let [red, green, blue] = self.cast;
        let drift = &self.drift;
        [
            ("light.brightness", self.brightness, 0.0, 10.0),
            ("light.cast", red, 0.0, 10.0),
            ("light.cast", green, 0.0, 10.0),
            ("light.cast", blue, 0.0, 10.0),
            ("light.from", self.from.radians(), -4.0, 4.0),
            ("light.shade", self.shade, 0.0, 1.0),
            ("light.glare", self.glare, 0.0, 1.0),
            ("light.drift.pictures", drift.pictures, 0.0, 1e9),
            ("light.drift.brightness_sd", drift.brightness_sd, 0.0, 10.0),
            ("light.drift.cast_sd", drift.cast_sd, 0.0, 10.0),
            ("light.drift.from_sd", drift.from_sd, 0.0, 10.0),
            ("light.drift.outside_sd", drift.outside_sd, 0.0, 10.0),
            ("light.drift.flicker_sd", drift.flicker_sd, 0.0, 10.0),
        ]
    }
}

/// Drift of the light: standard normal numbers, each to be scaled by its standard deviation.
#[derive(Clone, Debug, Default)]
pub(super) struct Weather {
    now: Option<Drifts>,
}

/// Brightness, three colours, direction, outside.
type Drifts = [f64; 6];

impl Weather {
    /// Advances the weather by one picture, and returns its light.
    pub(super) fn next(&mut self, light: &Light, draws: &mut Draws) -> Shine {
        let fresh: Drifts = core::array::from_fn(|_| draws.gaussian());
        let kept = match self.now {
            Some(_) if light.drift.pictures > 1.0 => 1.0 - light.drift.pictures.recip(),
            _ => 0.0,
        };
        let new = (1.0 - kept * kept).sqrt();
        let before = self.now.unwrap_or_default();
        let now = core::array::from_fn(|index| kept * before[index] + new * fresh[index]);
        self.now = Some(now);
        Shine::new(light, &now, draws.gaussian())
    }
}

/// The light of one picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shine {
    gain: [f64; 3],
    /// Unit vector towards the light.
    to_light: Vector,
    shade: f64,
    outside: f64,
    glare: f64,
}

impl Shine {
    fn new(light: &Light, drifts: &Drifts, flicker: f64) -> Self {
        let [brightness, red, green, blue, from, outside] = *drifts;
        let drift = &light.drift;
        let brightness = light.brightness
            * (1.0 + drift.brightness_sd * brightness).max(0.1)
            * (1.0 + drift.flicker_sd * flicker).max(0.1);
        let [r, g, b] = light.cast;
        let gain = [(r, red), (g, green), (b, blue)]
            .map(|(cast, drifted)| brightness * cast * (1.0 + drift.cast_sd * drifted).max(0.1));
        Self {
            gain,
            to_light: light.from.turned(drift.from_sd * from).unit(),
            shade: light.shade,
            outside: (1.0 + drift.outside_sd * outside).max(0.1),
            glare: light.glare,
        }
    }

    /// Returns the seen colour of a wall of this colour and glow whose `normal` points at the
    /// camera.
    pub(super) fn on_wall(&self, colour: [f64; 3], glow: f64, normal: Vector) -> [f64; 3] {
        let facing = 1.0 + self.shade * normal.dot(&self.to_light);
        let lit = self.on_floor(colour);
        core::array::from_fn(|part| {
            (1.0 - glow) * facing * lit[part] + glow * self.outside * colour[part]
        })
    }

    /// Returns the seen colour of a floor or ceiling of this colour.
    pub(super) fn on_floor(&self, colour: [f64; 3]) -> [f64; 3] {
        core::array::from_fn(|part| colour[part] * self.gain[part])
    }

    /// Returns the share of full light added to a picture of which `share` glows.
    pub(super) fn veil(&self, share: f64) -> f64 {
        (self.glare * self.outside * share).min(0.9)
    }
}
