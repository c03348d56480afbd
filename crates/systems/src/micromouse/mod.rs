//! The micromouse.
