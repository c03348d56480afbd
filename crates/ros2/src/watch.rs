use std::collections::BTreeSet;

use ros2_client::dds::rustdds::{
    DomainParticipantStatusListener, StatusEvented, dds::statusevents::DomainParticipantStatusEvent,
};

/// Notices what DDS discovers and ROS does not say: topics of our names with another type, and
/// writers and readers whose quality of service does not fit ours.
pub(crate) struct Watch {
    events: DomainParticipantStatusListener,
    /// DDS name and type of each of the node's topics.
    topics: Vec<(String, String)>,
    told: BTreeSet<String>,
}

impl Watch {
    /// Returns a watch over topics with these DDS names and types.
    pub(crate) fn new(
        events: DomainParticipantStatusListener,
        topics: Vec<(String, String)>,
    ) -> Self {
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
                requested_qos,
                offered_qos,
                ..
            } => Some(format!(
                "a topic's quality of service does not fit: the node asks for {requested_qos:?}, and is offered {offered_qos:?}"
            )),
            Event::RemoteReaderQosIncompatible {
                requested_qos,
                offered_qos,
                ..
            } => Some(format!(
                "a topic's quality of service does not fit: the node offers {offered_qos:?}, and is asked for {requested_qos:?}"
            )),
            _ => None,
        }
    }

    fn other_type(&self, name: &str, given: &str) -> Option<String> {
        let (_, ours) = self.topics.iter().find(|(topic, _)| topic == name)?;
        (ours != given).then(|| {
            let topic = name.trim_start_matches("rt");
            let [given, ours] = [given, ours.as_str()].map(readable);
            format!("{topic} has messages of type {given}, and this node's are {ours}: nothing arrives{}", hint(&given))
        })
    }
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
