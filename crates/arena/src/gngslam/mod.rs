//! The place map's pitch, and how good maps of it are.
//!
//! A [`PlaceScorer`] knows the cell in which each record was taken. It turns and stretches a map onto the field
//! ([`FieldFromMap`]) and asks it about some of the records; each answer has a [`PointScore`].

mod field_from_map;
mod point_score;
mod score;

pub use field_from_map::{FieldExtent, FieldFrame, FieldFromMap};
pub use point_score::{FIELD_CELLS, PointScore};
pub use score::{GoalNodes, GoalRecords, PlaceScore, PlaceScorer};
