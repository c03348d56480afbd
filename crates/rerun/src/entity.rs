//! Places the events of a replay in Rerun's tree of entities.

use re_log_types::{EntityPath, EntityPathPart};
use tolman_replay::{EventContent, ReplayEvent, WORLD};

/// Returns the entity of an event. An entity below a robot's moves with the robot.
pub(crate) fn entity(event: &ReplayEvent<'_>) -> EntityPath {
    match &event.content {
        EventContent::Pose { frame, .. } => path([WORLD, frame]),
        EventContent::Scan { frame, .. } => path([WORLD, frame, "scan"]),
        EventContent::Draw { frame, id, .. } | EventContent::Erase { frame, id } => {
            drawn(frame, &event.topic, id)
        }
        EventContent::Text { source, .. } => path(["log", source]),
        _ => path(event.topic.split('/')),
    }
}

fn drawn(frame: &str, topic: &str, id: &str) -> EntityPath {
    if frame == WORLD {
        let topic = topic.split('/');
        path([WORLD].into_iter().chain(topic).chain([id]))
    } else {
        path([WORLD, frame, id])
    }
}

/// Returns the path of these parts, without the empty ones.
pub(crate) fn path<'a>(parts: impl IntoIterator<Item = &'a str>) -> EntityPath {
    let parts = parts.into_iter().map(str::trim);
    let named = parts.filter(|part| !part.is_empty());
    EntityPath::new(named.map(EntityPathPart::new).collect())
}
