//! The report: one HTML file that opens anywhere.

use crate::experiment::Outcome;

/// The whole page.
pub fn html(outcome: &Outcome) -> String {
    outcome.title.clone()
}
