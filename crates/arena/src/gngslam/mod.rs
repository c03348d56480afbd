//! Makes the arenas and the data of the place map.
//!
//! Goldhoorn, Stadman, Eldering: "Implementation of a Simultaneous Localization and Mapping system
//! using Growing Neural Gas", 2006. In the order data flows:
//!
//! 1. A [`Pitch`] is a [course](crate::course::Course) with two goals: the paper's (section 3.1),
//!    two others, and any number by seed. It knows the truth: where the goals are, and in which of
//!    8 × 8 [cells](CellGrid::cell_of) a point lies.
//! 2. [`gather`] lets a robot wander in one (section 3.2), and writes the truth beside each record:
//!    a [`DataSet`].
//! 3. [`DataSet::to_text`] and [`DataSet::from_text`] keep it in a file.
//! 4. A [`PlaceScorer`] turns and stretches a map onto the cells ([`FieldFromMap`]) and asks it
//!    about some of the records (section 3.4, *Score*). Each answer has a [`PointScore`].

mod cells;
mod data_set;
mod data_text;
mod field_from_map;
mod gather;
mod laid_over;
mod pitch;
mod point_score;
mod random_pitch;
mod score;

pub use cells::CellGrid;
pub use data_set::{DataSet, LabelledRecord};
pub use field_from_map::{FieldFrame, FieldFromMap, whole_field};
pub use gather::{gather, gather_by};
pub use laid_over::LaidOver;
pub(crate) use laid_over::rigid_motion;
pub use pitch::{Goals, PIONEER_2DX, Pitch, paper_robot};
pub use point_score::PointScore;
pub use score::{PlaceScore, PlaceScorer};
