//! The diktiometry on worlds of places, whose truth is known.

pub(crate) mod abstract_world;
mod certificates;
#[cfg(feature = "serde")]
mod files;
mod learning;
mod mapper;
mod properties;
mod put_down;
mod runs;
mod self_check;
pub(crate) mod walk;
