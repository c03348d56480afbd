use tolman_geom::Pose;

/// One reading of a range sensor, wherever it sits and however wide it hears: a sonar's cone or a laser's beam.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sounding {
    /// Where the sensor sits and which way it looks, in the robot's frame.
    pub mount: Pose,
    /// How far to either side of that it hears, rad; 0 for a beam.
    pub half_width: f64,
    /// How far away the nearest thing within its cone is, m; `max_range` where it met nothing.
    pub range: f64,
    /// The most it reads, m.
    pub max_range: f64,
}
