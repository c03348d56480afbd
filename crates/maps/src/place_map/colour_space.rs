/// Conversion of a pixel's colour to three values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ColourSpace {
    /// Red, green and blue, each 0 … 1.
    Rgb,
    /// Hue, saturation and value, each 0 to 1. Hue is compared as a plain number, as in the paper
    /// (section 3.4, "Features"). So a red just below 1 and a red just above 0 are far apart,
    /// although they are neighbours on the circle of hues.
    Hsv,
}

impl ColourSpace {
    /// Returns the three values of a colour whose red, green and blue are 0 … 1.
    #[must_use]
    pub fn values(self, rgb: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Rgb => rgb,
            Self::Hsv => hsv_from_rgb(rgb),
        }
    }

    /// Returns red, green and blue of three values, which are clamped to 0 to 1.
    ///
    /// ```
    /// use tolman_maps::place_map::ColourSpace;
    ///
    /// let values = ColourSpace::Hsv.values([0.0, 0.5, 1.0]);
    /// assert_eq!(ColourSpace::Hsv.colour(values), [0, 128, 255]);
    /// ```
    #[must_use]
    pub fn colour(self, values: [f32; 3]) -> [u8; 3] {
        let values = values.map(|value| value.clamp(0.0, 1.0));
        let rgb = match self {
            Self::Rgb => values,
            Self::Hsv => rgb_from_hsv(values),
        };
        rgb.map(|value| libm::roundf(255.0 * value) as u8)
    }
}

/// Returns hue, saturation and value. Grey, which has no hue, gets hue 0.
fn hsv_from_rgb([red, green, blue]: [f32; 3]) -> [f32; 3] {
    let value = red.max(green).max(blue);
    let spread = value - red.min(green).min(blue);
    if spread <= 0.0 {
        return [0.0, 0.0, value];
    }
    let sixths = if value <= red {
        (green - blue) / spread
    } else if value <= green {
        2.0 + (blue - red) / spread
    } else {
        4.0 + (red - green) / spread
    };
    let hue = if sixths < 0.0 { sixths + 6.0 } else { sixths } / 6.0;
    [hue, spread / value, value]
}

fn rgb_from_hsv([hue, saturation, value]: [f32; 3]) -> [f32; 3] {
    // How far the hue is from that of each primary, in sixths of the circle.
    let primary = |offset: f32| {
        let sixths = libm::fmodf(6.0 * hue + offset, 6.0);
        let away = sixths.min(4.0 - sixths).clamp(0.0, 1.0);
        value - value * saturation * away
    };
    [primary(5.0), primary(3.0), primary(1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn primaries_have_the_hues_of_the_circle() {
        for (rgb, hsv) in [
            ([1.0, 0.0, 0.0], [0.0, 1.0, 1.0]),
            ([1.0, 1.0, 0.0], [1.0 / 6.0, 1.0, 1.0]),
            ([0.0, 1.0, 0.0], [1.0 / 3.0, 1.0, 1.0]),
            ([0.0, 0.0, 0.5], [2.0 / 3.0, 1.0, 0.5]),
            ([0.6, 0.6, 0.6], [0.0, 0.0, 0.6]),
            ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        ] {
            let found = ColourSpace::Hsv.values(rgb);
            for (found, expect) in found.iter().zip(hsv) {
                assert!((found - expect).abs() < 1e-6, "{rgb:?}: {found} {expect}");
            }
        }
    }

    #[test]
    fn colours_survive_both_spaces() {
        for red in (0..=255_u8).step_by(15) {
            for green in (0..=255_u8).step_by(17) {
                for blue in (0..=255_u8).step_by(51) {
                    let rgb = [red, green, blue];
                    for space in [ColourSpace::Rgb, ColourSpace::Hsv] {
                        let values = space.values(rgb.map(|value| f32::from(value) / 255.0));
                        assert_eq!(space.colour(values), rgb);
                    }
                }
            }
        }
    }

    /// Shows a property of the paper's hue that may look like a mistake.
    #[test]
    fn plain_hue_tears_red_apart() {
        let [orange, pink] = [[1.0, 0.02, 0.0], [1.0, 0.0, 0.02]].map(|rgb| {
            let [hue, ..] = ColourSpace::Hsv.values(rgb);
            hue
        });
        assert!(pink - orange > 0.9, "{orange} {pink}");
    }
}
