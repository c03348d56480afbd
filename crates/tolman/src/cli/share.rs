//! Shares and similarities on the command line.

/// Parses a number from 0 to 1, for `value_parser`.
///
/// # Errors
/// If it is not a number, or out of that range.
pub(super) fn share(text: &str) -> Result<f64, String> {
    let share = text.parse::<f64>().ok();
    share
        .filter(|share| (0.0..=1.0).contains(share))
        .ok_or_else(|| "give a number from 0 to 1".to_owned())
}
