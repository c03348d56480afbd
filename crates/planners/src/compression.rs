use alloc::vec::Vec;

/// Returns a sequence of actions without its detours (MSLST, *Path Compression*). `opposite` must
/// return each action's opposite, and be its own inverse.
///
/// Two simplifications are repeated alternately until neither is possible:
///
/// - "If a string of actions is followed by a string of opposite actions, each of length two or
///   more and with lengths not differing by more than one, we remove all of them instead of just
///   canceling out pairs". A robot whose actions cover varying distances may need different numbers
///   of them down a corridor and back.
/// - "Remove any pairs of consecutive opposite actions".
///
/// Strings are as long as they can be, and come first: the pairs would leave none of them. For the
/// same reason each pass removes only those pairs that stand side by side when it begins. The
/// result is a fixed point. O(n²) for n actions.
///
/// ```
/// use tolman_planners::compressed;
///
/// let opposite = |action: &char| match action {
///     'n' => 's', 's' => 'n', 'e' => 'w', _ => 'e',
/// };
/// let compress = |path: &str| -> String {
///     compressed(&path.chars().collect::<Vec<_>>(), opposite).iter().collect()
/// };
/// assert_eq!(compress("new"), "n", "one pair");
/// assert_eq!(compress("ennnssn"), "en", "an uneven string: three north, two south");
/// assert_eq!(compress("nnnews"), "nn", "strings are of length two or more");
/// assert_eq!(compress("nnnewss"), "", "what a pair has kept apart is a string");
/// assert_eq!(compress("nnnnss"), "nn", "lengths differ by more than one");
/// ```
#[must_use]
pub fn compressed<A: Copy + PartialEq>(path: &[A], opposite: impl Fn(&A) -> A) -> Vec<A> {
    let mut path = path.to_vec();
    loop {
        let before = path.len();
        remove_strings(&mut path, &opposite);
        remove_pairs(&mut path, &opposite);
        if path.len() == before {
            return path;
        }
    }
}

/// Removes opposite strings, the earliest first, until none is left.
fn remove_strings<A: Copy + PartialEq>(path: &mut Vec<A>, opposite: &impl Fn(&A) -> A) {
    let mut start = 0;
    while let Some(action) = path.get(start).copied() {
        let there = run(path, start, &action);
        let back = run(path, start + there, &opposite(&action));
        if there >= 2 && back >= 2 && there.abs_diff(back) <= 1 {
            path.drain(start..start + there + back);
            // The actions before and after the removed string may form a string now.
            start = 0;
        } else {
            start += there;
        }
    }
}

/// Returns the number of times that `action` stands in a row from `start` on.
fn run<A: PartialEq>(path: &[A], start: usize, action: &A) -> usize {
    path[start..]
        .iter()
        .take_while(|other| *other == action)
        .count()
}

/// Removes the pairs of opposite actions that are adjacent now, in one pass.
fn remove_pairs<A: Copy + PartialEq>(path: &mut Vec<A>, opposite: &impl Fn(&A) -> A) {
    let mut kept = Vec::with_capacity(path.len());
    let mut rest = path.as_slice();
    while let [action, tail @ ..] = rest {
        rest = match tail {
            [next, behind @ ..] if *next == opposite(action) => behind,
            _ => {
                kept.push(*action);
                tail
            }
        };
    }
    *path = kept;
}
