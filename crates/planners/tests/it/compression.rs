//! Properties of every compressed path.

use proptest::prelude::*;
use tolman_planners::compressed;

/// A unit step on a plane.
type Step = (i32, i32);

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![Just((0, 1)), Just((1, 0)), Just((0, -1)), Just((-1, 0))]
}

/// Paths with long strings in them, as robots make.
fn path() -> impl Strategy<Value = Vec<Step>> {
    prop::collection::vec((step(), 1..5_usize), 0..20).prop_map(|strings| {
        let repeat = |(step, count)| core::iter::repeat_n(step, count);
        strings.into_iter().flat_map(repeat).collect()
    })
}

fn opposite(step: &Step) -> Step {
    (-step.0, -step.1)
}

fn end(path: &[Step]) -> Step {
    path.iter()
        .fold((0, 0), |at, step| (at.0 + step.0, at.1 + step.1))
}

proptest! {
    #[test]
    fn compression_is_idempotent(path in path()) {
        let once = compressed(&path, opposite);
        prop_assert_eq!(compressed(&once, opposite), once);
    }

    #[test]
    fn nothing_is_left_to_cancel(path in path()) {
        let short = compressed(&path, opposite);
        prop_assert!(short.windows(2).all(|pair| pair[1] != opposite(&pair[0])));
    }

    /// Two opposite runs of an action may differ by one in length. Then their removal moves the end
    /// by one step, and the two runs have five actions or more. Nothing else moves the end.
    #[test]
    fn the_end_moves_by_no_more_than_the_rule_allows(path in path()) {
        let short = compressed(&path, opposite);
        let (there, here) = (end(&path), end(&short));
        let moved = there.0.abs_diff(here.0) + there.1.abs_diff(here.1);
        let removed = (path.len() - short.len()) as u32;
        prop_assert!(5 * moved <= removed, "{removed} removed moved the end by {moved}");
        prop_assert_eq!(moved % 2, removed % 2);
    }

    #[test]
    fn a_path_that_never_turns_back_stays_as_it_is(
        path in prop::collection::vec(prop_oneof![Just((0, 1)), Just((1, 0))], 0..40)
    ) {
        prop_assert_eq!(compressed(&path, opposite), path);
    }
}

#[test]
fn detours_end_one_in_another() {
    let compress = |path: &str| -> String {
        let opposite = |action: &char| match action {
            'n' => 's',
            's' => 'n',
            'e' => 'w',
            _ => 'e',
        };
        let path: Vec<char> = path.chars().collect();
        compressed(&path, opposite).iter().collect()
    };
    for (path, expected) in [
        ("", ""),
        ("ns", ""),
        ("nns", "n"),
        ("nnsss", ""),
        ("nnssss", "ss"),
        ("nnneess", "nnneess"),
        // A side way with an uneven way back.
        ("nneeewwss", ""),
        ("nneeewwssse", "e"),
        // Strings are taken as long as they are: four against two is not one of our strings.
        ("nnnnss", "nn"),
        // The first string first: nn ss leaves nn.
        ("nnssnn", "nn"),
    ] {
        assert_eq!(compress(path), expected, "{path}");
    }
}
