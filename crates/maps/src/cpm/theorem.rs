/// Returns the bound of Theorem 1. "Given that all path-fragments in the environment are
/// distinctive and asymmetrical, the time required for reaching the unknown goal is finite".
///
/// `first` are T₁ … T_{n_p}, the times for the fragments "the robot passes before detecting
/// duplication", in any unit. `longest` is max T over all fragments, in the same unit. `fragments`
/// is n_A, the number of fragments of the environment. With all times 1 it bounds the number of
/// fragments walked.
///
/// ```
/// use tolman_maps::cpm::theorem_1;
///
/// // Eight fragments of at most 12 s; the first three were passed in 30 s before one of them came again.
/// assert_eq!(theorem_1(&[12.0, 8.0, 10.0], 12.0, 8), 30.0 + 12.0 * (36.0 - 6.0));
/// ```
#[must_use]
pub fn theorem_1(first: &[f64], longest: f64, fragments: u32) -> f64 {
    let triangle = |n: f64| n * (n + 1.0) / 2.0;
    let before = first.iter().sum::<f64>();
    before + longest * (triangle(f64::from(fragments)) - triangle(first.len() as f64))
}
