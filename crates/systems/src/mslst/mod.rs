//! MSLST.
