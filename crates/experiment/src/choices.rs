//! Suggestions for unknown names.

/// Similarity of two names, 0 … 1, from which one was probably meant for the other.
const LIKE: f64 = 0.8;

/// Returns the part of a message about a name that is not among `known`: which one was probably
/// meant, and all that exist.
///
/// ```
/// use tolman_experiment::choices;
///
/// let known = ["baselines", "mslst", "cpm"];
/// assert_eq!(
///     choices("mslts", known),
///     "did you mean mslst? Known are: baselines, mslst, cpm"
/// );
/// assert_eq!(choices("genius", known), "choose one of: baselines, mslst, cpm");
/// ```
#[must_use]
pub fn choices<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let all = known.join(", ");
    let typed = name.to_lowercase();
    let like = |known: &str| strsim::jaro_winkler(&typed, &known.to_lowercase());
    let mut nearest: Option<(f64, &str)> = None;
    for name in known {
        let like = like(name);
        // Of two equally similar names the first is suggested.
        if like >= LIKE && nearest.is_none_or(|(best, _)| like > best) {
            nearest = Some((like, name));
        }
    }
    match nearest {
        Some((_, name)) => format!("did you mean {name}? Known are: {all}"),
        None => format!("choose one of: {all}"),
    }
}
