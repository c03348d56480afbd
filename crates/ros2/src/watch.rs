use std::collections::BTreeSet;

use ros2_client::dds::rustdds::policy::{Durability, Reliability};
use ros2_client::dds::rustdds::{
    DomainParticipantStatusEvent, DomainParticipantStatusListener, GUID, QosPolicies, StatusEvented,
};

/// Notices what DDS discovers and ROS does not say: topics of our names with another type, and
/// writers and readers whose quality of service does not fit ours.
pub(crate) struct Watch {
    events: DomainParticipantStatusListener,
    topics: Vec<Watched>,
    told: BTreeSet<String>,
}

/// A topic of the node.
pub(crate) struct Watched {
    /// DDS name of the topic.
    pub(crate) name: String,
    /// DDS name of the type of its messages.
    pub(crate) of: String,
    /// The node's end of it.
    pub(crate) end: GUID,
}

impl Watch {
    /// Returns a watch over these topics.
    pub(crate) fn new(events: DomainParticipantStatusListener, topics: Vec<Watched>) -> Self {
        Self {
            events,
            topics,
            told: BTreeSet::new(),
        }
    }

    /// Returns what does not fit and was not yet said.
    pub(crate) fn news(&mut self) -> Vec<String> {
        let mut news = Vec::new();
        while let Some(event) = self.events.try_recv_status() {
            if let Some(sentence) = self.judge(&event)
                && self.told.insert(sentence.clone())
            {
                news.push(sentence);
            }
        }
        news
    }

    fn judge(&self, event: &DomainParticipantStatusEvent) -> Option<String> {
        use DomainParticipantStatusEvent as Event;
        match event {
            Event::ReaderDetected { reader: end } | Event::WriterDetected { writer: end } => {
                self.other_type(&end.topic_name, &end.type_name)
            }
            Event::RemoteWriterQosIncompatible {
                local_reader: end,
                requested_qos: wanted,
                offered_qos: offered,
                ..
            }
            | Event::RemoteReaderQosIncompatible {
                local_writer: end,
                requested_qos: wanted,
                offered_qos: offered,
                ..
            } => {
                let topic = self.topics.iter().find(|topic| topic.end == *end);
                let topic = topic.map_or("a service", |topic| ros_name(&topic.name));
                let [wanted, offered] = [wanted, offered].map(|qos| quality(qos));
                Some(format!(
                    "{topic} does not get through: one side asks for {wanted}, and the other offers {offered}"
                ))
            }
            _ => None,
        }
    }

    fn other_type(&self, name: &str, given: &str) -> Option<String> {
        let ours = self.topics.iter().find(|topic| topic.name == name)?;
        (ours.of != given).then(|| {
            let topic = ros_name(name);
            let [given, ours] = [given, ours.of.as_str()].map(readable);
            format!("{topic} has messages of type {given}, and this node's are {ours}: nothing arrives{}", hint(&given))
        })
    }
}

/// Returns a DDS topic's name in ROS.
fn ros_name(topic: &str) -> &str {
    topic.trim_start_matches("rt")
}

/// Returns what of a quality of service keeps ends apart: `reliable and transient local`.
fn quality(qos: &QosPolicies) -> String {
    let reliability = match qos.reliability() {
        Some(Reliability::Reliable { .. }) => "reliable",
        _ => "best effort",
    };
    let durability = match qos.durability() {
        Some(Durability::Volatile) | None => "volatile",
        Some(_) => "transient local",
    };
    format!("{reliability} and {durability} messages")
}

/// Returns a DDS type as ROS names it: `geometry_msgs/msg/Twist`.
fn readable(dds_type: &str) -> String {
    dds_type
        .replace("dds_::", "")
        .replace("::", "/")
        .trim_end_matches('_')
        .to_owned()
}

/// Returns what repairs a wrong type, if something does.
fn hint(given: &str) -> &'static str {
    match given {
        "geometry_msgs/msg/TwistStamped" => "; set enable_stamped_cmd_vel to true",
        "geometry_msgs/msg/Twist" => "; set enable_stamped_cmd_vel to false",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_read_as_in_ros() {
        assert_eq!(
            readable("geometry_msgs::msg::dds_::TwistStamped_"),
            "geometry_msgs/msg/TwistStamped"
        );
        assert!(hint("geometry_msgs/msg/Twist").contains("false"));
    }
}
