use tolman_control::epuck::{
    MeetPointConfig, PilotConfig, RangeCurve, SegmentConfig, SensorAlignment,
};

/// Parameters by which a walker observes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct WalkerConfig {
    /// The robot's layers.
    pub pilot: PilotConfig,
    /// Averaging of the vectors of a sweep.
    pub alignment: SensorAlignment,
    /// Segmentation by which junctions differ from paths.
    pub segments: SegmentConfig,
    /// Segmentation from which features are computed.
    pub features: SegmentConfig,
    /// Search for the middle of a junction.
    pub meet_point: MeetPointConfig,
    /// Width of the corridors from wall to wall, m.
    pub corridor_width: f64,
    /// Duration of a drive between two observations, s; 0.5 in the paper.
    pub stride_s: f64,
    /// Source of dead reckoning's headings.
    pub heading: HeadingBy,
    /// Maximum number of observations of one fragment before the robot gives up (not in the paper).
    pub longest_fragment: u32,
}

/// Source of dead reckoning's headings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeadingBy {
    /// The encoders alone.
    Encoders,
    /// Headings of the encoders, corrected by walls where they are seen. Walls stand at right
    /// angles to each other.
    Walls,
}

impl WalkerConfig {
    /// Returns the configuration of the paper's robot in corridors `width` wide, m. `curve`
    /// converts its proximity sensors' raw values, and its time step is `step_us` long. A sample
    /// of a sweep takes one time step, so the time step sets the speed of a sweep.
    #[must_use]
    pub fn paper(curve: RangeCurve, step_us: u64, width: f64) -> Self {
        Self {
            pilot: PilotConfig::paper(curve, step_us, width),
            alignment: SensorAlignment::Mounts,
            segments: SegmentConfig::cut(),
            features: SegmentConfig::joined(),
            meet_point: MeetPointConfig::for_width(width),
            corridor_width: width,
            stride_s: 0.5,
            heading: HeadingBy::Encoders,
            longest_fragment: 2000,
        }
    }
}
