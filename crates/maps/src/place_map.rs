//! Places as prototypes of what a robot saw, heard and rolled there, learned by a growing neural gas.
//!
//! Source: A. Goldhoorn, H. Stadman, E. Eldering: Implementation of a Simultaneous Localization and Mapping system using
//! Growing Neural Gas, 2006.

mod record;

pub use record::PlaceRecord;
