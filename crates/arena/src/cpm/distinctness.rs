use tolman_maps::cpm::{PatternId, Sense};
use tolman_maze::Cell;
use tolman_systems::cpm::{CommonPatterns, CpmConfig};

use super::robots::{epuck, walker_config};
use super::survey::survey;
use crate::BoxError;
use crate::course::Course;

/// Whether observations tell the fragments of a maze apart, measured by f_S. These are the
/// constraints of section 4.3: "every path-fragment in the environment is *distinctive*" and
/// *asymmetrical*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distinctness {
    /// Most similar pair of walks that must differ: along different fragments, in both directions,
    /// and along one fragment from both its ends. `None` if there is only one walk.
    pub most_alike: Option<WalkPair>,
    /// Least similar pair of walks along one fragment.
    pub least_alike: Option<WalkPair>,
}

/// Two walks and how similar they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WalkPair {
    /// First walk, by the places from which and to which it led.
    pub one: (Cell, Cell),
    /// Second walk, by the places from which and to which it led.
    pub other: (Cell, Cell),
    /// Whether the second walk is compared as it was walked, or inverted.
    pub sense: Sense,
    /// Similarity f_S of the two walks, 0 to 1.
    pub score: f64,
}

/// A walk along a true fragment.
struct Walked {
    fragment: u32,
    is_forward: bool,
    ends: (Cell, Cell),
    patterns: Vec<PatternId>,
}

/// Lets the paper's robot walk every fragment both ways once with each seed, and compares every two
/// walks, both ways, as online CPM does.
///
/// O(walks² · length) comparisons of patterns.
///
/// # Errors
/// If the robot cannot walk a fragment, comes to another place than its end, or
/// sees nothing on the way.
pub fn distinctness(
    course: &Course,
    patterns: &CommonPatterns,
    seeds: impl IntoIterator<Item = u64>,
) -> Result<Distinctness, BoxError> {
    let config = walker_config(&epuck(), course.corridor_width)?;
    let mut walks = Vec::new();
    for seed in seeds {
        let walked = survey(course, &epuck(), &config, seed)?;
        for walk in walked {
            let ends = (walk.from, walk.way.to);
            if walk.to != Some(walk.way.to) || walk.observations.is_empty() {
                let (from, to) = ends;
                return Err(format!(
                    "the robot saw nothing on the way from {from} to {to}, or came elsewhere: make the way longer than a cell"
                )
                .into());
            }
            walks.push(Walked {
                fragment: walk.way.fragment,
                is_forward: walk.way.is_forward,
                ends,
                patterns: patterns.patterns(&walk.observations),
            });
        }
    }
    let (matching, dictionary) = (CpmConfig::online().matching, patterns.dictionary());
    let mut found = Distinctness {
        most_alike: None,
        least_alike: None,
    };
    for (index, one) in walks.iter().enumerate() {
        // Each with itself as well, which inverted it must not be.
        for other in &walks[..=index] {
            for sense in [Sense::Same, Sense::Inverted] {
                let score = matching.score_as(dictionary, &one.patterns, &other.patterns, sense);
                let pair = WalkPair {
                    one: one.ends,
                    other: other.ends,
                    sense,
                    score,
                };
                let is_same_way = one.is_forward == other.is_forward;
                let is_one =
                    one.fragment == other.fragment && is_same_way == (sense == Sense::Same);
                if is_one {
                    let is_less = |least: WalkPair| score < least.score;
                    if found.least_alike.is_none_or(is_less) {
                        found.least_alike = Some(pair);
                    }
                } else if found.most_alike.is_none_or(|most| score > most.score) {
                    found.most_alike = Some(pair);
                }
            }
        }
    }
    Ok(found)
}
