//! Matches places: matchers "each indicating a particular state of affairs, including mapping
//! errors", and the order among them.

mod engine;
mod matcher;
mod order;
mod view;

pub(super) use engine::{Choice, choose};
pub use matcher::Matcher;
pub(super) use matcher::Situation;
pub(super) use view::{agrees, alike, remember, share_a_view, similarity};
