//! The worlds and the data of the place map.
//!
//! Goldhoorn, Stadman, Eldering: "Implementation of a Simultaneous Localization and Mapping system using Growing Neural Gas", 2006.
//! In the order data flows:
//!
//! 1. A [`Pitch`] is an arena with two goals: the paper's (section 3.1), two others, and any number by seed. It knows the truth: where
//!    the goals are, and in which of 8 × 8 [cells](Pitch::cell_of) a point lies.
//! 2. [`gather`] lets a robot wander in one (section 3.2), and writes the truth beside each record: a [`DataSet`].
//! 3. [`learn_online`] and [`localize_online`] run the system that corrects its pose while it learns.
//! 4. [`DataSet::to_text`] and [`DataSet::from_text`] keep it in a file.

mod cells;
mod data_set;
mod data_text;
mod gather;
mod online;
mod pitch;
mod pitches;
mod random_pitch;
mod room;

pub use cells::CellGrid;
pub use data_set::{DataSet, GoalRecords, LabelledRecord};
pub use data_text::DataTextError;
pub use gather::{GatherError, gather, gather_with};
pub use online::{LookedFrom, OnlineRun, OnlineRunError, learn_online, localize_online};
pub use pitch::{Goals, Pitch, PitchError};
