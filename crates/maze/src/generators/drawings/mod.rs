//! Draws mazes that a person recognizes, each from its size and seed. All of one name have the same
//! kind of shape.
//!
//! All are closed and joined, mark a start and a goal, and wall off what they do not use.

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
