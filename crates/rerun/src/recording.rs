//! A replay as a recording: a chunk for each entity, with a row for each of its events.

use core::hash::Hasher;
use std::collections::BTreeMap;

use fnv::FnvHasher;
use re_chunk::{Chunk, ChunkBuilder, ChunkError, ChunkId, EntityPath, RowId, TimePoint};
use re_log_encoding::Encoder;
use re_log_types::external::re_tuid::Tuid;
use re_log_types::{
    LogMsg, SetStoreInfo, StoreId, StoreInfo, StoreKind, StoreSource, TimeInt, Timeline,
};
use re_sdk_types::archetypes::{
    Clear, RecordingInfo, Scalars, SeriesLines, TextDocument, TextLog, ViewCoordinates,
};
use re_sdk_types::components::TextLogLevel;
use re_sdk_types::{AsComponents, SerializedComponentBatch};
use thiserror::Error;
use tolman_replay::{EncodeError, EventContent, Replay, ReplayEvent, WORLD, events, json};

use crate::drawing::{drawing, scan, transform};
use crate::entity::{entity, path};

/// Reason why a replay cannot be written as `.rrd`.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RrdExportError {
    /// The replay itself is invalid.
    #[error(transparent)]
    Replay(#[from] EncodeError),
    /// The rows of an entity do not fit together.
    #[error("the replay does not fit into a chunk of Rerun; write it as HTML")]
    Chunk(#[from] Box<ChunkError>),
    /// The `.rrd` writer refuses the replay.
    #[error("the replay does not fit into .rrd; write it as HTML")]
    Write(#[from] Box<re_log_encoding::EncodeError>),
}

/// Name under which Rerun lists the recordings and remembers how they are shown.
const APPLICATION: &str = "tolman";

/// Returns a replay as the bytes of an `.rrd` file. Times are those of the run, from 0. The same
/// replay gives the same messages; the index behind them may be in another order.
///
/// # Errors
/// As [`json`], and if Rerun's writer refuses the replay.
pub fn rrd(replay: &Replay) -> Result<Vec<u8>, RrdExportError> {
    let content = fnv64(json(replay)?.as_bytes());
    let mut recording = Recording::new(content);
    recording.introduce(replay);
    for event in events(replay)? {
        recording.add(&event, replay.nanos(event.step));
    }
    recording.written()
}

/// Chunks that still grow.
struct Recording {
    /// Hash of the replay. Rerun merges recordings of one id, so each replay has its own.
    content: u64,
    /// Number of rows so far, which orders those of one time.
    rows: u64,
    /// Chunks of the recording, by their entities.
    chunks: BTreeMap<(EntityPath, Lifetime), ChunkBuilder>,
}

/// Validity of an entity's rows: Rerun keeps static data apart from data that holds from a time on.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Lifetime {
    Always,
    FromTime,
}

impl Recording {
    const fn new(content: u64) -> Self {
        Self {
            content,
            rows: 0,
            chunks: BTreeMap::new(),
        }
    }

    /// Adds title, facts, and which way is up.
    fn introduce(&mut self, replay: &Replay) {
        let info = RecordingInfo::new().with_name(replay.title.as_str());
        self.always(EntityPath::properties(), &info);
        self.always(path([WORLD]), &ViewCoordinates::RIGHT_HAND_Z_UP());
        let facts = replay.facts.iter();
        let lines: Vec<String> = facts
            .map(|fact| format!("- {}: {}", fact.name, fact.value))
            .collect();
        let facts = TextDocument::from_markdown(lines.join("\n"));
        self.always(path(["facts"]), &facts);
    }

    fn add(&mut self, event: &ReplayEvent<'_>, nanos: u64) {
        let batches = match &event.content {
            EventContent::Pose { pose, .. } => transform(*pose),
            EventContent::Draw { drawing: drawn, .. } => drawing(drawn),
            EventContent::Erase { .. } => Clear::flat().as_serialized_batches(),
            EventContent::Scan { ring, ranges, .. } => scan(ring, ranges),
            EventContent::Number { value, unit } => {
                self.name_series(event, unit);
                Scalars::single(*value).as_serialized_batches()
            }
            EventContent::Text { text, .. } => TextLog::new(*text)
                .with_level(TextLogLevel::INFO)
                .as_serialized_batches(),
            // None is known today.
            _ => return,
        };
        let time = TimePoint::default()
            .with(Timeline::new_sequence("step"), i64::from(event.step))
            .with(
                Timeline::new_duration("time"),
                TimeInt::new_temporal(nanos as i64),
            );
        self.push(entity(event), Lifetime::FromTime, time, nanos, batches);
    }

    /// Names the curve of a series, with its unit, before its first value.
    fn name_series(&mut self, event: &ReplayEvent<'_>, unit: &str) {
        let entity = entity(event);
        if self
            .chunks
            .contains_key(&(entity.clone(), Lifetime::Always))
        {
            return;
        }
        let name = event.topic.trim_start_matches('/');
        let name = match unit {
            "" => name.to_owned(),
            "%" => format!("{name}, share"),
            unit => format!("{name}, {unit}"),
        };
        self.always(entity, &SeriesLines::new().with_names([name]));
    }

    fn always(&mut self, entity: EntityPath, what: &dyn AsComponents) {
        let batches = what.as_serialized_batches();
        self.push(entity, Lifetime::Always, TimePoint::default(), 0, batches);
    }

    /// Adds a row to the chunk of an entity.
    fn push(
        &mut self,
        entity: EntityPath,
        lifetime: Lifetime,
        time: TimePoint,
        nanos: u64,
        batches: Vec<SerializedComponentBatch>,
    ) {
        self.rows += 1;
        let row = RowId::from_tuid(Tuid::from_nanos_and_inc(nanos, self.rows));
        let key = (entity, lifetime);
        let chunk = self.chunks.remove(&key).unwrap_or_else(|| {
            let id = Tuid::from_nanos_and_inc(self.content, self.rows);
            Chunk::builder_with_id(ChunkId::from_tuid(id), key.0.clone())
        });
        let chunk = chunk.with_serialized_batches(row, time, batches);
        self.chunks.insert(key, chunk);
    }

    /// Returns the bytes of the file.
    fn written(self) -> Result<Vec<u8>, RrdExportError> {
        let id = format!("{:016x}", self.content);
        let store = StoreId::new(StoreKind::Recording, APPLICATION, id);
        let source = StoreSource::Other(env!("CARGO_PKG_NAME").to_owned());
        let start = LogMsg::SetStoreInfo(SetStoreInfo {
            row_id: Tuid::from_nanos_and_inc(0, 0),
            info: StoreInfo::new(store.clone(), source),
        });
        let mut encoder = Encoder::local().map_err(Box::new)?;
        encoder.append(&start).map_err(Box::new)?;
        for (_, chunk) in self.chunks {
            let message = chunk.build().and_then(|chunk| chunk.to_arrow_msg());
            let message = LogMsg::ArrowMsg(store.clone(), message.map_err(Box::new)?);
            encoder.append(&message).map_err(Box::new)?;
        }
        encoder.finish().map_err(Box::new)?;
        Ok(encoder.into_inner().map_err(Box::new)?)
    }
}

/// Returns the hash FNV-1a of some bytes.
fn fnv64(bytes: &[u8]) -> u64 {
    let mut hash = FnvHasher::default();
    hash.write(bytes);
    hash.finish()
}
