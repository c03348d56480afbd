use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};
use ros2_client::dds::rustdds::Topic;
use ros2_client::qos::{Durability, History, WhenFull};
use ros2_client::{
    Context, ContextOptions, MessageTypeName, Name, Node, NodeName, NodeOptions, Publisher,
    QosProfile, Server, ServiceMapping, ServiceTypeName, Subscription,
};
use thiserror::Error;
use tolman_geom::{Pose, Twist as Velocity};
use tolman_robot::{BaseReport, Landmark, VelocityBase};

use crate::messages::{
    Header, LaserScan, MarkerArray, OccupancyGrid, Odometry, Text, TfMessage, Time,
    TransformStamped, TriggerRequest, TriggerResponse, Twist, TwistStamped,
};
use crate::mounts::{Mount, Mounts};
use crate::navigation::Navigation;
use crate::params::{Params, RosArguments};
use crate::watch::{Watch, Watched};

/// All that the node hears and says over ROS 2.
pub(crate) struct Link {
    pub(crate) params: Params,
    scans: Subscription<LaserScan>,
    odometry: Subscription<Odometry>,
    statics: Subscription<TfMessage>,
    landmarks: Subscription<Text>,
    velocities: Velocities,
    transforms: Publisher<TfMessage>,
    pub(crate) maps: Publisher<OccupancyGrid>,
    pub(crate) markers: Publisher<MarkerArray>,
    pub(crate) states: Publisher<Text>,
    services: Vec<(Asked, Server<TriggerRequest, TriggerResponse>)>,
    pub(crate) navigation: Navigation,
    watch: Watch,
    /// Set by Ctrl-C.
    stop: Arc<AtomicBool>,
    mounts: Mounts,
    pub(crate) landmark: Option<Landmark>,
    /// What was asked since the last action, with how to answer.
    pub(crate) asked: VecDeque<(Asked, ros2_client::RmwRequestId)>,
    /// Last pose by odometry, and its time.
    pub(crate) odom: Option<(Pose, Time)>,
    /// Pose of the frame `odom` on the map.
    pub(crate) map_from_odom: Pose,
    /// When odometry and a scan were last heard.
    heard: [Instant; 2],
    /// Keeps the node alive.
    _node: Node,
}

/// What a service asks for. Each is a `std_srvs/Trigger`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Asked {
    Explore,
    ReachGoal,
    Localize,
    Stop,
    PutDown,
    SaveMap,
    Report,
}

/// The topic of velocities, in either of its types.
enum Velocities {
    Plain(Publisher<Twist>),
    Stamped(Publisher<TwistStamped>),
}

/// Reason why the robot can no longer be driven or heard.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub(crate) enum LinkError {
    /// Somebody wants the node to end.
    #[error("interrupted")]
    Interrupted,
    /// A sensor is silent.
    #[error("nothing came on {topic} for {seconds} s")]
    Silent {
        /// Name of the topic.
        topic: String,
        /// Time that was allowed, s.
        seconds: String,
    },
    /// A message cannot be sent.
    #[error("cannot send on {topic}")]
    Send {
        /// Name of the topic.
        topic: String,
    },
    /// A message cannot be read.
    #[error("a message on {topic} cannot be read: {why}")]
    Read {
        /// Name of the topic.
        topic: String,
        /// Reason of DDS.
        why: String,
    },
}

const SERVICES: [(Asked, &str); 7] = [
    (Asked::Explore, "explore"),
    (Asked::ReachGoal, "reach_goal"),
    (Asked::Localize, "localize"),
    (Asked::Stop, "stop"),
    (Asked::PutDown, "put_down"),
    (Asked::SaveMap, "save_map"),
    (Asked::Report, "report"),
];

/// Pause between two looks for messages.
const PAUSE: Duration = Duration::from_millis(1);

impl Link {
    /// Joins ROS 2.
    ///
    /// # Errors
    /// If there is no network for DDS, or a name is invalid.
    pub(crate) fn join(
        arguments: &RosArguments,
        params: Params,
        stop: Arc<AtomicBool>,
    ) -> Result<Self> {
        let domain = match std::env::var("ROS_DOMAIN_ID") {
            Ok(text) => text
                .parse()
                .context("ROS_DOMAIN_ID is not a number from 0 to 232")?,
            Err(_) => 0,
        };
        let options = ContextOptions::new().domain_id(domain);
        let context = Context::with_options(options).context("cannot join the DDS domain")?;
        let name = NodeName::new(arguments.namespace(), arguments.node());
        let name = name.context("the node's name is invalid")?;
        let mut joining = Joining {
            node: context.new_node(name, NodeOptions::new().enable_rosout(true))?,
            arguments,
            topics: Vec::new(),
        };

        let sensor = QosProfile::subscription_default().history(History::KeepLast { depth: 5 });
        let odometry = QosProfile::subscription_default().history(History::KeepLast { depth: 50 });
        let reliable = QosProfile::publisher_default();
        let latched = reliable.clone().durability(Durability::TransientLocal);
        let statics = latched.clone().history(History::KeepLast { depth: 100 });
        let events = reliable.clone().history(History::KeepLast { depth: 10 });
        let own = |name: &str| format!("/{}/{name}", arguments.node());

        let velocity_topic = &params.cmd_vel_topic;
        let velocities = match params.enable_stamped_cmd_vel {
            true => Velocities::Stamped(joining.publish(
                velocity_topic,
                "geometry_msgs/TwistStamped",
                &reliable,
            )?),
            false => Velocities::Plain(joining.publish(
                velocity_topic,
                "geometry_msgs/Twist",
                &reliable,
            )?),
        };
        let mut services = Vec::new();
        for (asked, name) in SERVICES {
            services.push((asked, joining.serve(&own(name))?));
        }
        Ok(Self {
            scans: joining.hear(&params.scan_topic, "sensor_msgs/LaserScan", &sensor)?,
            odometry: joining.hear(&params.odom_topic, "nav_msgs/Odometry", &odometry)?,
            statics: joining.hear("/tf_static", "tf2_msgs/TFMessage", &statics)?,
            landmarks: joining.hear(&params.landmark_topic, "std_msgs/String", &events)?,
            velocities,
            transforms: joining.publish("/tf", "tf2_msgs/TFMessage", &events)?,
            maps: joining.publish("/map", "nav_msgs/OccupancyGrid", &latched)?,
            markers: joining.publish(&own("places"), "visualization_msgs/MarkerArray", &latched)?,
            states: joining.publish(&own("state"), "std_msgs/String", &events)?,
            services,
            navigation: Navigation::new(
                &mut joining.node,
                arguments.renamed("navigate_to_pose"),
                mapping(),
            )?,
            watch: Watch::new(
                context.domain_participant().status_listener(),
                joining.topics,
            ),
            stop,
            mounts: Mounts::default(),
            landmark: None,
            asked: VecDeque::new(),
            odom: None,
            map_from_odom: Pose::default(),
            heard: [Instant::now(); 2],
            params,
            _node: joining.node,
        })
    }

    /// Waits for the robot, and returns its first scan and where the laser is mounted. Says once a
    /// while what it is waiting for.
    ///
    /// # Errors
    /// If it is interrupted.
    pub(crate) fn first_scan(&mut self) -> Result<(LaserScan, Mount), LinkError> {
        let mut last = None;
        let mut said = Instant::now();
        loop {
            self.attend()?;
            self.take_odometry()?;
            last = self.take_scan()?.or(last);
            let base = &self.params.base_frame;
            let laser = last.as_ref().map(|scan| scan.header.frame_id.as_str());
            let mount = laser.and_then(|laser| self.mounts.of(laser, base));
            if let (Some(scan), Some(mount), Some(_)) = (&last, mount, self.odom) {
                return Ok((scan.clone(), mount));
            }
            if said.elapsed() > Duration::from_secs(2) {
                said = Instant::now();
                let waits = match (laser, mount, self.odom) {
                    (None, ..) => format!("a scan on {}", self.params.scan_topic),
                    (Some(laser), None, _) => {
                        format!("transforms on /tf_static from {base} to {laser}")
                    }
                    _ => format!("odometry on {}", self.params.odom_topic),
                };
                eprintln!("tolman waits for {waits}");
            }
            thread::sleep(PAUSE);
        }
    }

    /// Takes in all that came, for a node at rest.
    ///
    /// # Errors
    /// If it is interrupted, or a message cannot be read.
    pub(crate) fn idle(&mut self) -> Result<(), LinkError> {
        self.attend()?;
        self.take_odometry()?;
        while self.take_scan()?.is_some() {}
        self.heard = [Instant::now(); 2];
        thread::sleep(PAUSE);
        Ok(())
    }

    /// Takes in services, goals, transforms, landmarks, and what DDS discovered.
    fn attend(&mut self) -> Result<(), LinkError> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(LinkError::Interrupted);
        }
        for sentence in self.watch.news() {
            eprintln!("tolman: {sentence}");
        }
        for (asked, server) in &self.services {
            while let Ok(Some((id, _))) = server.receive_request() {
                self.asked.push_back((*asked, id));
            }
        }
        self.navigation.attend();
        while let Some((message, _)) = self
            .statics
            .take()
            .map_err(|why| read("/tf_static", &why))?
        {
            for transform in &message.transforms {
                self.mounts.add(transform);
            }
        }
        let topic = &self.params.landmark_topic;
        while let Some((message, _)) = self.landmarks.take().map_err(|why| read(topic, &why))? {
            self.landmark = landmark(&message.data);
        }
        Ok(())
    }

    /// Answers a service.
    pub(crate) fn answer(
        &self,
        (asked, id): (Asked, ros2_client::RmwRequestId),
        success: bool,
        message: String,
    ) {
        let server = self.services.iter().find(|(other, _)| *other == asked);
        if let Some((_, server)) = server {
            // Who has gone needs no answer.
            let _ = server.send_response(id, TriggerResponse { success, message });
        }
    }

    /// Takes the newest odometry. What is older came while the system was thinking.
    fn take_odometry(&mut self) -> Result<Option<(Pose, Time)>, LinkError> {
        let topic = &self.params.odom_topic;
        let mut newest = None;
        while let Some((message, _)) = self.odometry.take().map_err(|why| read(topic, &why))? {
            newest = Some((Pose::from(message.pose), message.header.stamp));
        }
        if newest.is_some() {
            self.heard[0] = Instant::now();
            self.odom = newest;
        }
        Ok(newest)
    }

    /// Takes a scan, and says where the frame `odom` lies on the map at its time.
    fn take_scan(&mut self) -> Result<Option<LaserScan>, LinkError> {
        let topic = &self.params.scan_topic;
        let taken = self.scans.take().map_err(|why| read(topic, &why))?;
        let Some((scan, _)) = taken else {
            return Ok(None);
        };
        self.heard[1] = Instant::now();
        let ahead = Duration::from_secs_f64(self.params.transform_timeout);
        let on_map = crate::messages::Pose::from(self.map_from_odom);
        let transform = TransformStamped {
            header: self.on_map(scan.header.stamp.after(ahead)),
            child_frame_id: self.params.odom_frame.clone(),
            translation: on_map.position,
            rotation: on_map.orientation,
        };
        let transforms = vec![transform];
        self.transforms
            .publish(TfMessage { transforms })
            .map_err(|why| unsent("/tf", &why))?;
        Ok(Some(scan))
    }

    /// Returns the header of a message in the map's frame.
    pub(crate) fn on_map(&self, stamp: Time) -> Header {
        Header {
            stamp,
            frame_id: self.params.map_frame.clone(),
        }
    }

    /// Returns the time of the last odometry.
    pub(crate) fn now(&self) -> Time {
        self.odom.map_or_else(Time::default, |(_, stamp)| stamp)
    }

    /// Returns an error if odometry or scans have not come for too long.
    fn check_silence(&self) -> Result<(), LinkError> {
        let Params {
            odom_topic,
            scan_topic,
            source_timeout,
            ..
        } = &self.params;
        for (topic, heard) in [odom_topic, scan_topic].into_iter().zip(self.heard) {
            if heard.elapsed().as_secs_f64() > *source_timeout {
                return Err(LinkError::Silent {
                    topic: topic.clone(),
                    seconds: source_timeout.to_string(),
                });
            }
        }
        Ok(())
    }
}

impl VelocityBase for Link {
    type Error = LinkError;

    fn drive(&mut self, velocity: Velocity) -> Result<(), LinkError> {
        let twist = Twist::from(velocity);
        let topic = &self.params.cmd_vel_topic;
        match &self.velocities {
            Velocities::Plain(to) => to.publish(twist).map_err(|why| unsent(topic, &why)),
            Velocities::Stamped(to) => {
                let header = Header {
                    stamp: self.now(),
                    frame_id: self.params.base_frame.clone(),
                };
                to.publish(TwistStamped { header, twist })
                    .map_err(|why| unsent(topic, &why))
            }
        }
    }

    fn report(&mut self, _: u64) -> Result<Option<BaseReport>, LinkError> {
        loop {
            self.attend()?;
            if let Some((pose, stamp)) = self.take_odometry()? {
                return Ok(Some(BaseReport {
                    time_us: stamp.micros(),
                    pose: Some(pose),
                    compass: Some(pose.heading),
                    ..BaseReport::default()
                }));
            }
            if let Some(scan) = self.take_scan()? {
                let lasted = f64::from(scan.scan_time).max(0.0) * 1e6;
                let stamp = scan.header.stamp.micros();
                return Ok(Some(BaseReport {
                    time_us: self.now().micros(),
                    // A stamp may be that of the last beam.
                    taken_us: Some(stamp.saturating_sub(lasted as u64)),
                    ranges: Some(ranges(&scan)),
                    ..BaseReport::default()
                }));
            }
            self.check_silence()?;
            thread::sleep(PAUSE);
        }
    }
}

/// Returns the ranges of a scan, m; 0 for what is no distance.
fn ranges(scan: &LaserScan) -> Vec<f64> {
    let range = |range: &f32| match range.is_nan() || *range < scan.range_min {
        true => 0.0,
        false => f64::from(*range),
    };
    scan.ranges.iter().map(range).collect()
}

/// Returns the landmark that a message names.
fn landmark(text: &str) -> Option<Landmark> {
    match text.trim().to_lowercase().as_str() {
        "goal" => Some(Landmark::Goal),
        "start" => Some(Landmark::Start),
        number => number.parse().ok().map(Landmark::Numbered),
    }
}

/// Returns how the other nodes' middleware maps services onto DDS.
fn mapping() -> ServiceMapping {
    match std::env::var("RMW_IMPLEMENTATION") {
        Ok(name) if name.contains("cyclonedds") => ServiceMapping::Cyclone,
        _ => ServiceMapping::Enhanced,
    }
}

fn read(topic: &str, why: &impl ToString) -> LinkError {
    LinkError::Read {
        topic: topic.to_owned(),
        why: why.to_string(),
    }
}

fn unsent<E>(topic: &str, _: &E) -> LinkError {
    LinkError::Send {
        topic: topic.to_owned(),
    }
}

/// A node that gets its topics and services.
struct Joining<'a> {
    node: Node,
    arguments: &'a RosArguments,
    topics: Vec<Watched>,
}

impl Joining<'_> {
    /// Returns a topic, and the DDS names by which it is watched.
    fn topic(&mut self, name: &str, of: &str, qos: &QosProfile) -> Result<(Topic, [String; 2])> {
        let name = self.arguments.renamed(name);
        let invalid = || format!("{name} is no name of a topic");
        let parsed = Name::parse(name).with_context(invalid)?;
        let (package, kind) = of.split_once('/').unwrap_or(("", of));
        let kind = MessageTypeName::new(package, kind);
        let names = [format!("rt{name}"), kind.dds_msg_type()];
        let topic = self.node.create_topic(&parsed, kind, qos);
        let topic = topic.with_context(|| format!("cannot make the topic {name}"))?;
        Ok((topic, names))
    }

    fn hear<M: 'static>(
        &mut self,
        name: &str,
        of: &str,
        qos: &QosProfile,
    ) -> Result<Subscription<M>> {
        let (topic, [dds_name, of]) = self.topic(name, of, qos)?;
        let made = self.node.create_subscription(&topic, Some(qos.clone()));
        let made = made.with_context(|| format!("cannot hear {name}"))?;
        let end = made.guid();
        self.topics.push(Watched {
            name: dds_name,
            of,
            end,
        });
        Ok(made)
    }

    fn publish<M: serde::Serialize>(
        &mut self,
        name: &str,
        of: &str,
        qos: &QosProfile,
    ) -> Result<Publisher<M>> {
        let (topic, [dds_name, of]) = self.topic(name, of, qos)?;
        let made = self.node.create_publisher(&topic, Some(qos.clone()));
        let made = made.with_context(|| format!("cannot publish {name}"))?;
        let end = made.guid();
        self.topics.push(Watched {
            name: dds_name,
            of,
            end,
        });
        Ok(made)
    }

    fn serve(&mut self, name: &str) -> Result<Server<TriggerRequest, TriggerResponse>> {
        let qos = QosProfile::publisher_default()
            .reliability_reliable(WhenFull::DEFAULT)
            .history(History::KeepLast { depth: 10 });
        let parsed = Name::parse(self.arguments.renamed(name))?;
        let of = ServiceTypeName::new("std_srvs", "Trigger");
        let made = self
            .node
            .create_server(mapping(), &parsed, &of, qos.clone(), qos);
        made.with_context(|| format!("cannot serve {name}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn landmarks_have_names() {
        assert_eq!(landmark("Goal"), Some(Landmark::Goal));
        assert_eq!(landmark("7"), Some(Landmark::Numbered(7)));
        assert_eq!(landmark(""), None);
    }

    #[test]
    fn what_is_no_distance_is_nothing() {
        let scan = LaserScan {
            header: Header::default(),
            angle_min: 0.0,
            angle_max: 0.0,
            angle_increment: 0.0,
            time_increment: 0.0,
            scan_time: 0.0,
            range_min: 0.12,
            range_max: 3.5,
            ranges: vec![f32::NAN, f32::NEG_INFINITY, 0.05, 1.0, f32::INFINITY],
            intensities: Vec::new(),
        };
        assert_eq!(ranges(&scan), [0.0, 0.0, 0.0, 1.0, f64::INFINITY]);
    }
}
