//! The diktiometry.
