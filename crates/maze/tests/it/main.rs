//! The formats and generators from outside.

// `cfg(test)` tells clippy that helpers beside the tests may unwrap.
#[cfg(test)]
mod drawings;
#[cfg(test)]
mod faults;
#[cfg(test)]
mod formats;
#[cfg(test)]
mod generators;
#[cfg(test)]
mod mazes_of_others;
#[cfg(test)]
mod robustness;
#[cfg(all(test, feature = "serde"))]
mod serialization;
