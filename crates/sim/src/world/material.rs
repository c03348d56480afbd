/// Look of a wall to sensors other than the laser and the sonar, which meet all walls alike.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Material {
    /// Share of infrared light that the wall reflects, 0 … 1.
    pub reflectance: f64,
    /// Red, green and blue.
    pub colour: [u8; 3],
    /// Height above the floor at which it begins, m: the sill of a window. Files leave out the 0 of
    /// most walls.
    #[serde(skip_serializing_if = "is_nothing")]
    pub base: f64,
    /// Height above the floor at which it ends, m. Files leave out
    /// [`ROOM_HEIGHT`](Self::ROOM_HEIGHT).
    #[serde(skip_serializing_if = "is_as_high_as_a_room")]
    pub height: f64,
    /// Share of its colour that glows by itself, 0 … 1: a window. Files leave out the 0 of most
    /// walls.
    #[serde(skip_serializing_if = "is_nothing")]
    pub glow: f64,
}

impl Material {
    /// Default height of a wall, m.
    pub const ROOM_HEIGHT: f64 = 2.5;

    /// Returns walls of this colour, as high as a room.
    #[must_use]
    pub fn painted(colour: [u8; 3]) -> Self {
        Self {
            colour,
            ..Self::default()
        }
    }

    /// Returns the same material from `base` to `height` above the floor, m.
    #[must_use]
    pub const fn standing(self, base: f64, height: f64) -> Self {
        Self {
            base,
            height,
            ..self
        }
    }

    /// Returns the same material with a glowing share of its colour, 0 … 1.
    #[must_use]
    pub const fn glowing(self, glow: f64) -> Self {
        Self { glow, ..self }
    }
}

impl Default for Material {
    /// Returns a white matt surface: the reference surface of data sheets.
    fn default() -> Self {
        Self {
            reflectance: 1.0,
            colour: [255, 255, 255],
            base: 0.0,
            height: Self::ROOM_HEIGHT,
            glow: 0.0,
        }
    }
}

/// Returns whether a value is exactly zero, so that the file may leave it out.
fn is_nothing(value: &f64) -> bool {
    value.to_bits() == 0
}

fn is_as_high_as_a_room(height: &f64) -> bool {
    height.to_bits() == Material::ROOM_HEIGHT.to_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Files from before walls had heights stay the same, and new ones can be read back.
    #[test]
    fn what_is_as_ever_is_not_written() {
        let white = Material::default();
        let json = serde_json::to_string(&white).unwrap();
        assert_eq!(json, r#"{"reflectance":1.0,"colour":[255,255,255]}"#);
        assert_eq!(serde_json::from_str::<Material>(&json).unwrap(), white);
        let window = Material::painted([1, 2, 3]).standing(0.8, 2.1).glowing(0.9);
        let json = serde_json::to_string(&window).unwrap();
        assert_eq!(serde_json::from_str::<Material>(&json).unwrap(), window);
        assert!(serde_json::from_str::<Material>(r#"{"hight": 1}"#).is_err());
    }
}
