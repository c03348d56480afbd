//! Draws mazes of recognizable shapes, each from its size and seed. All drawings of one name have
//! the same kind of shape.
//!
//! All have a closed border and connected corridors, and mark a start and a goal. Unused cells are
//! walled off.

mod blocks;
mod comb;
mod loops;
mod office;
mod pen;
mod pillars;
mod spiral;
mod star;
mod wings;

pub use blocks::blocks;
pub use comb::comb;
pub use loops::{eight, ladder, ladder_of, ring};
pub use office::office;
pub use pillars::pillars;
pub use spiral::spiral;
pub use star::star;
pub use wings::wings;
