//! Words on the command line that stand for values, and counts with their nouns.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// Returns a parser of the given words, each with its help and its value.
pub(super) fn words<T: Clone + Send + Sync + 'static, const N: usize>(
    words: [(&'static str, &'static str, T); N],
) -> impl TypedValueParser<Value = T> {
    let shown = words
        .each_ref()
        .map(|(word, help, _)| PossibleValue::new(*word).help(*help));
    PossibleValuesParser::new(shown).try_map(move |given: String| {
        let meant = words.iter().find(|(word, ..)| *word == given);
        meant
            .map(|(.., value)| value.clone())
            .ok_or("this word is not one of them")
    })
}

/// Returns a count with its noun, such as "3 poses".
pub(super) fn counted(count: usize, thing: &str) -> String {
    match count {
        1 => format!("1 {thing}"),
        _ => format!("{count} {thing}s"),
    }
}
