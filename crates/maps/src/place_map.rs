//! Places as prototypes of what a robot saw, heard and rolled there, learned by a growing neural
//! gas.
//!
//! Source: A. Goldhoorn, H. Stadman, E. Eldering: Implementation of a Simultaneous Localization and
//! Mapping system using Growing Neural Gas, 2006. In the order data flows:
//!
//! - a [`PlaceRecord`] is what was recorded at one place (section 3.2);
//! - a [`FeatureChoice`] names the features that describe it: the image, smaller and in some
//!   [`ColourSpace`], the ranges, the odometry ("Features");
//! - a [`FeatureTable`] computes them for many records, scaled by how they vary;
//! - a [`PlaceMap`] learns from the table by its [`PlaceMapConfig`] ("Learning"). It then answers
//!   which node is nearest to a record, where nodes lie, what they look like, and which way leads
//!   from one to another.
//!
//! Squared distances are those of equation 3.1, d² = Σ w (a − b)², with one weight a group: see
//! [`FeatureScaling`] for what a group's size does.

mod colour_space;
mod config;
mod error;
mod feature_choice;
mod feature_space;
mod feature_table;
mod image_feature;
mod map;
mod record;
mod record_span;
#[cfg(feature = "serde")]
mod saved;
mod way;

pub use colour_space::ColourSpace;
pub use config::PlaceMapConfig;
pub use error::{FeatureError, PlaceMapError};
pub use feature_choice::{FeatureChoice, FeatureGroup, FeatureScaling, FeatureWeights};
pub use feature_space::FeatureSpace;
pub use feature_table::{FeatureTable, ImageForm};
pub use image_feature::ImageFeature;
pub use map::PlaceMap;
pub use record::PlaceRecord;
#[cfg(feature = "serde")]
pub use saved::SavedPlaceMap;
