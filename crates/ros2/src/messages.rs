//! The messages of ROS 2 that the node takes and gives, field by field as their packages define
//! them. Names of fields are for readers: only order and types are sent.

use std::time::Duration as Span;

use ros2_client::Message;
use serde::{Deserialize, Serialize};
use tolman_geom::{Heading, Point as Position, Pose as Standpoint, Twist as Velocity};

/// `builtin_interfaces/Time`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) struct Time {
    sec: i32,
    nanosec: u32,
}

/// `builtin_interfaces/Duration`.
pub(crate) type Duration = Time;

/// `std_msgs/Header`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Header {
    pub(crate) stamp: Time,
    pub(crate) frame_id: String,
}

/// `std_msgs/String`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Text {
    pub(crate) data: String,
}

/// `sensor_msgs/LaserScan`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct LaserScan {
    pub(crate) header: Header,
    pub(crate) angle_min: f32,
    pub(crate) angle_max: f32,
    pub(crate) angle_increment: f32,
    pub(crate) time_increment: f32,
    pub(crate) scan_time: f32,
    pub(crate) range_min: f32,
    pub(crate) range_max: f32,
    pub(crate) ranges: Vec<f32>,
    pub(crate) intensities: Vec<f32>,
}

/// `geometry_msgs/Vector3`, and `geometry_msgs/Point`, which has the same fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Vector3 {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) z: f64,
}

/// `geometry_msgs/Quaternion`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Quaternion {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) z: f64,
    pub(crate) w: f64,
}

/// `geometry_msgs/Pose`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pose {
    pub(crate) position: Vector3,
    pub(crate) orientation: Quaternion,
}

/// `geometry_msgs/PoseStamped`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct PoseStamped {
    pub(crate) header: Header,
    pub(crate) pose: Pose,
}

/// `geometry_msgs/Twist`.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Twist {
    pub(crate) linear: Vector3,
    pub(crate) angular: Vector3,
}

/// `geometry_msgs/TwistStamped`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct TwistStamped {
    pub(crate) header: Header,
    pub(crate) twist: Twist,
}

/// The fields of `nav_msgs/Odometry` up to the pose: what follows is not read.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Odometry {
    pub(crate) header: Header,
    pub(crate) child_frame_id: String,
    pub(crate) pose: Pose,
}

/// `geometry_msgs/TransformStamped`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct TransformStamped {
    pub(crate) header: Header,
    pub(crate) child_frame_id: String,
    pub(crate) translation: Vector3,
    pub(crate) rotation: Quaternion,
}

/// `tf2_msgs/TFMessage`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct TfMessage {
    pub(crate) transforms: Vec<TransformStamped>,
}

/// `nav_msgs/OccupancyGrid`, with its `MapMetaData`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct OccupancyGrid {
    pub(crate) header: Header,
    pub(crate) map_load_time: Time,
    pub(crate) resolution: f32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) origin: Pose,
    pub(crate) data: Vec<i8>,
}

/// `std_msgs/ColorRGBA`.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Color {
    pub(crate) r: f32,
    pub(crate) g: f32,
    pub(crate) b: f32,
    pub(crate) a: f32,
}

/// `visualization_msgs/Marker`. No texture and no mesh: their fields stay empty.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Marker {
    pub(crate) header: Header,
    pub(crate) ns: String,
    pub(crate) id: i32,
    pub(crate) kind: i32,
    pub(crate) action: i32,
    pub(crate) pose: Pose,
    pub(crate) scale: Vector3,
    pub(crate) color: Color,
    pub(crate) lifetime: Duration,
    pub(crate) frame_locked: bool,
    pub(crate) points: Vec<Vector3>,
    pub(crate) colors: Vec<Color>,
    pub(crate) texture_resource: String,
    pub(crate) texture: CompressedImage,
    pub(crate) uv_coordinates: Vec<[f32; 2]>,
    pub(crate) text: String,
    pub(crate) mesh_resource: String,
    pub(crate) mesh_file: MeshFile,
    pub(crate) mesh_use_embedded_materials: bool,
}

/// `sensor_msgs/CompressedImage`, of which none is sent.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct CompressedImage {
    header: Header,
    format: String,
    data: Vec<u8>,
}

/// `visualization_msgs/MeshFile`, of which none is sent.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct MeshFile {
    filename: String,
    data: Vec<u8>,
}

/// `visualization_msgs/MarkerArray`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct MarkerArray {
    pub(crate) markers: Vec<Marker>,
}

/// Request of `std_srvs/Trigger`: one octet, because a structure of DDS has a field.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct TriggerRequest {
    nothing: u8,
}

/// Response of `std_srvs/Trigger`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct TriggerResponse {
    pub(crate) success: bool,
    pub(crate) message: String,
}

/// Goal of `nav2_msgs/NavigateToPose`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct NavigateGoal {
    pub(crate) pose: PoseStamped,
    pub(crate) behavior_tree: String,
}

/// Result of `nav2_msgs/NavigateToPose`. Older releases of nav2 read its first octet, or its first
/// field, and leave the rest.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct NavigateResult {
    pub(crate) error_code: u16,
    pub(crate) error_msg: String,
}

/// Feedback of `nav2_msgs/NavigateToPose`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct NavigateFeedback {
    pub(crate) current_pose: PoseStamped,
    pub(crate) navigation_time: Duration,
    pub(crate) estimated_time_remaining: Duration,
    pub(crate) number_of_recoveries: i16,
    pub(crate) distance_remaining: f32,
}

impl Message for TriggerRequest {}
impl Message for TriggerResponse {}
impl Message for NavigateGoal {}
impl Message for NavigateResult {}
impl Message for NavigateFeedback {}

impl Time {
    /// Returns the time in microseconds; 0 before the epoch.
    pub(crate) fn micros(self) -> u64 {
        let micros = i64::from(self.sec) * 1_000_000 + i64::from(self.nanosec / 1000);
        micros.try_into().unwrap_or(0)
    }

    /// Returns a time so long after this one.
    pub(crate) fn after(self, span: Span) -> Self {
        let nanos = u64::from(self.nanosec) + u64::from(span.subsec_nanos());
        let carried = (nanos / 1_000_000_000) as i32;
        Self {
            sec: self.sec + span.as_secs() as i32 + carried,
            nanosec: (nanos % 1_000_000_000) as u32,
        }
    }
}

impl From<Span> for Time {
    fn from(span: Span) -> Self {
        Self::default().after(span)
    }
}

impl Default for Quaternion {
    fn default() -> Self {
        Self {
            x: 0.0,
            y: 0.0,
            z: 0.0,
            w: 1.0,
        }
    }
}

impl Quaternion {
    /// Returns the turn about the vertical axis.
    pub(crate) fn yaw(self) -> Heading {
        let Self { x, y, z, w } = self;
        Heading::from_radians((2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z)))
    }
}

impl From<Heading> for Quaternion {
    fn from(heading: Heading) -> Self {
        let (z, w) = (0.5 * heading.radians()).sin_cos();
        Self {
            x: 0.0,
            y: 0.0,
            z,
            w,
        }
    }
}

impl From<Position> for Vector3 {
    fn from(at: Position) -> Self {
        Self {
            x: at.x,
            y: at.y,
            z: 0.0,
        }
    }
}

impl From<Standpoint> for Pose {
    fn from(pose: Standpoint) -> Self {
        Self {
            position: pose.position.into(),
            orientation: pose.heading.into(),
        }
    }
}

impl From<Pose> for Standpoint {
    fn from(pose: Pose) -> Self {
        Self {
            position: Position::new(pose.position.x, pose.position.y),
            heading: pose.orientation.yaw(),
        }
    }
}

impl From<Velocity> for Twist {
    fn from(velocity: Velocity) -> Self {
        let along = |x| Vector3 { x, y: 0.0, z: 0.0 };
        let about = |z| Vector3 { x: 0.0, y: 0.0, z };
        Self {
            linear: along(velocity.linear),
            angular: about(velocity.angular),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_survives_its_message() {
        for degrees in [-170.0, -90.0, 0.0, 33.0, 180.0] {
            let pose = Standpoint {
                position: Position::new(1.0, -2.0),
                heading: Heading::from_degrees(degrees),
            };
            let again = Standpoint::from(Pose::from(pose));
            assert!((again.position - pose.position).norm() < 1e-12);
            assert!(again.heading.turn_to(pose.heading).abs() < 1e-12);
        }
    }

    #[test]
    fn times_carry() {
        let time = Time {
            sec: 1,
            nanosec: 900_000_000,
        };
        let later = time.after(Span::from_millis(1200));
        assert_eq!(later.micros(), 3_100_000);
    }
}
