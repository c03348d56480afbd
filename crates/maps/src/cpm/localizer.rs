use alloc::vec;
use alloc::vec::Vec;
use core::mem::replace;

use thiserror::Error;
use tolman_geom::OutOfRange;

use super::bearings::{Bearings, SHARP, between};
use super::map::{CpMap, End, Port, Sign};
use super::pattern::{Dictionary, DictionaryError, PatternId};
use super::similarity::Sense;
use super::traversal::Sighting;
use super::turn::{NoSuchTurn, Turn};
use tolman_robot::Landmark;

/// Finds the robot's map, fragment and direction of walking, from the first observation on.
///
/// The paper's robot, left in mid-fragment, "continues moving forward until the first junction". It
/// knows its environment by its fourth layer. This localizer keeps a probability for every place of
/// every map (a Bayes filter), which each observation, junction and turn updates.
///
/// ```
/// use tolman_maps::cpm::{CpMapperConfig, Dictionary, CpMapper, Localizer, LocalizerConfig, PatternId, Sighting, Traversal, Turn};
///
/// let mut dictionary = Dictionary::new(1);
/// for pattern in 0..8 {
///     let prototype = [f64::from(pattern)];
///     dictionary.learn(&prototype, &prototype, 0.1)?;
/// }
/// // Two environments of one corridor each.
/// let mut maps = Vec::new();
/// for patterns in [[0, 1, 2, 3], [4, 5, 2, 7]] {
///     let mut mapper = CpMapper::new(CpMapperConfig::online(), Sighting::plain(1))?;
///     let patterns = patterns.map(PatternId).to_vec();
///     let walk = Traversal { patterns, motion: None, sighting: Sighting::plain(1), bearings: None };
///     mapper.arrive(Turn::BACK, &walk, &dictionary)?;
///     maps.push(mapper.map().clone());
/// }
/// let mut localizer = Localizer::new(&maps, &dictionary, LocalizerConfig::usual())?;
/// localizer.observe(PatternId(5))?;
/// localizer.observe(PatternId(2))?;
/// localizer.observe(PatternId(7))?;
/// let found = localizer.location();
/// assert_eq!(found.map, 1);
/// assert!(found.probability > 0.9, "{found:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Localizer {
    /// Copies of maps share all their nodes.
    maps: Vec<CpMap>,
    dictionary: Dictionary,
    config: LocalizerConfig,
    tracks: Vec<Track>,
    /// Probability of any single position of each map before anything is known.
    anywhere: Vec<f64>,
    /// Whether anything was observed so far.
    is_placed: bool,
}

/// Parameters of a [`Localizer`]; probabilities.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LocalizerConfig {
    /// Probability that an observation is another pattern than the map's; above 0, less than 1.
    pub mistake: f64,
    /// Probability that the robot is still at the map's previous observation, and likewise that it
    /// has skipped one; 0 to 0.4.
    pub slip: f64,
    /// Probability that the robot was moved elsewhere between two observations; above 0, at most
    /// 0.1. It lets the filter recover from a wrong belief.
    pub elsewhere: f64,
}

/// The robot's most likely place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Location {
    /// Index of the map in the list.
    pub map: usize,
    /// Fragment, by the end at which the robot entered.
    pub enter: End,
    /// Port to which the fragment leads, or at which the robot has arrived: the argument for
    /// [`CpMapper::place`](super::CpMapper::place).
    pub ahead: Port,
    /// Probability of that place, 0 to 1.
    pub probability: f64,
}

/// Reason why a robot cannot be localized, or an event is refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LocalizeError {
    /// The maps have no fragments.
    #[error("the maps have no fragments; learn one first")]
    Empty,
    /// A probability is outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// A map was written with other patterns, or an observed pattern is not in the dictionary.
    #[error(transparent)]
    Dictionary(#[from] DictionaryError),
    /// No junction at which the robot may be has such a turn.
    #[error(transparent)]
    Turn(#[from] NoSuchTurn),
}

/// A fragment, walked one way.
#[derive(Clone, Debug)]
struct Track {
    map: usize,
    enter: End,
    ahead: Port,
    /// View of the robot at the end of the fragment.
    place: Sighting,
    bearings: Option<Bearings>,
    patterns: Vec<PatternId>,
    /// Probability of each number of observations that the robot may have passed, from none to all.
    passed: Vec<f64>,
}

impl Track {
    /// Returns the likelihood of seeing the ways `seen` from the middle of the place ahead. The
    /// sighting has already weighed a wrong number of ways.
    fn seen(&self, seen: &Bearings) -> f64 {
        let expected = self.bearings.as_ref();
        let apart = expected.and_then(|expected| expected.apart(seen));
        apart.map_or(1.0, |apart| near(apart, SHARP).max(UNSEEN))
    }

    /// Returns the likelihood of glimpsing the ways `glimpse` before the place ahead. A glimpse may
    /// be false, and ways may be hidden.
    fn glimpsed(&self, glimpse: &Bearings) -> f64 {
        let dead_end = [];
        let expected = match &self.bearings {
            Some(bearings) => bearings.onward(),
            None if self.place.degree == 1 => &dead_end,
            None => return 1.0,
        };
        let nearest = |way: f64, ways: &[f64]| {
            let likelihoods = ways.iter().map(|other| near(between(way, *other), BLURRED));
            likelihoods.fold(0.0, f64::max)
        };
        let glimpsed = glimpse.onward().iter();
        let seen = glimpsed.map(|way| nearest(*way, expected).max(NO_WAY));
        let there = expected.iter();
        let hidden = there.map(|way| nearest(*way, glimpse.onward()).max(HIDDEN));
        seen.product::<f64>() * hidden.product::<f64>()
    }
}

/// Returns the likelihood of an observation of the place, by whether it equals the map's.
const fn seen_as(is_the_same: bool) -> f64 {
    if is_the_same { 1.0 } else { UNSEEN }
}

/// Returns the likelihood that two directions `apart`, rad, are one, relative to no distance.
fn near(apart: f64, deviation: f64) -> f64 {
    libm::exp(-0.5 * (apart / deviation) * (apart / deviation))
}

impl LocalizerConfig {
    /// Returns the probabilities for a robot that mistakes one observation in ten and slips by a
    /// tenth.
    #[must_use]
    pub const fn usual() -> Self {
        Self {
            mistake: 0.1,
            slip: 0.1,
            elsewhere: 1e-6,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::check("mistake", self.mistake, 1e-9..=1.0 - 1e-9)?;
        OutOfRange::check("slip", self.slip, 0.0..=0.4)?;
        OutOfRange::check("elsewhere", self.elsewhere, 1e-12..=0.1)
    }
}

impl Localizer {
    /// Starts with the robot equally likely on each of `maps`.
    ///
    /// # Errors
    /// [`LocalizeError`] if there is no map, a map belongs to another dictionary, or a field is out
    /// of its range.
    pub fn new(
        maps: &[CpMap],
        dictionary: &Dictionary,
        config: LocalizerConfig,
    ) -> Result<Self, LocalizeError> {
        config.check()?;
        let mut tracks = Vec::new();
        for (index, map) in maps.iter().enumerate() {
            map.check(dictionary)?;
            for (id, fragment) in map.fragments() {
                for sign in Sign::BOTH {
                    let walked = Sense::entered_at(sign);
                    let patterns = walked.of_sequence(dictionary, &fragment.patterns)?;
                    let ahead = fragment.port(sign.opposite());
                    let Some(place) = map.junction(ahead.junction) else {
                        continue;
                    };
                    tracks.push(Track {
                        map: index,
                        enter: id.end(sign),
                        ahead,
                        place: place.sighting(),
                        bearings: place.bearings_from(ahead.number),
                        passed: vec![0.0; patterns.len() + 1],
                        patterns: patterns.into_owned(),
                    });
                }
            }
        }
        if tracks.is_empty() {
            return Err(LocalizeError::Empty);
        }
        let mut localizer = Self {
            maps: maps.to_vec(),
            dictionary: dictionary.clone(),
            config,
            anywhere: anywhere(maps.len(), &tracks),
            tracks,
            is_placed: false,
        };
        localizer.spread(1.0);
        Ok(localizer)
    }

    /// Takes in one observation on the way. O(all sequences' lengths and the distances of
    /// prototypes).
    ///
    /// # Errors
    /// [`LocalizeError::Dictionary`] if the dictionary does not have the pattern.
    pub fn observe(&mut self, pattern: PatternId) -> Result<(), LocalizeError> {
        self.dictionary.check(&[pattern])?;
        let LocalizerConfig {
            mistake,
            slip,
            elsewhere,
        } = self.config;
        // Not yet on its way, it may be anywhere: that is where it already is.
        let moves = replace(&mut self.is_placed, true);
        let slips = [(0, slip), (1, 1.0 - 2.0 * slip), (2, slip)];
        let steps: &[(usize, f64)] = if moves { &slips } else { &[(0, 1.0)] };
        let chance = mistake / self.dictionary.len() as f64;
        let near = NEAR * self.dictionary.greatest_distance();
        for track in &mut self.tracks {
            let count = track.patterns.len();
            let mut next = vec![0.0; count + 1];
            for (passed, belief) in track.passed.iter().enumerate() {
                for (step, probability) in steps {
                    // At the end it stays until the junction is seen.
                    next[(passed + step).min(count)] += belief * probability;
                }
            }
            // To have passed none and to observe something is to be still at the junction.
            for (passed, belief) in next.iter_mut().enumerate() {
                let likelihood = match passed.checked_sub(1).and_then(|at| track.patterns.get(at)) {
                    Some(expected) if near > 0.0 => {
                        let distance = self.dictionary.distance(*expected, pattern) / near;
                        (1.0 - mistake) * libm::exp(-distance)
                    }
                    Some(expected) if *expected == pattern => 1.0 - mistake,
                    _ => 0.0,
                };
                *belief *= likelihood + chance;
            }
            track.passed = next;
        }
        self.normalize();
        self.spread(elsewhere);
        Ok(())
    }

    /// Takes in the end of the fragment as it comes into sight: its landmark, and the ways out
    /// glimpsed from before it. O(all sequences' lengths).
    pub fn end_in_sight(&mut self, landmark: Option<Landmark>, glimpse: Option<&Bearings>) {
        self.pass_all();
        self.weigh(|track| {
            let ways = glimpse.map_or(1.0, |glimpse| track.glimpsed(glimpse));
            ways * seen_as(track.place.landmark == landmark)
        });
    }

    /// Takes in the arrival at the end of a fragment. `sighting` is the junction, dead end or
    /// landmark seen. `bearings` are those of its ways, if the robot looks. O(all sequences'
    /// lengths).
    pub fn arrive(&mut self, sighting: Sighting, bearings: Option<&Bearings>) {
        self.pass_all();
        self.weigh(|track| {
            let ways = bearings.map_or(1.0, |seen| track.seen(seen));
            ways * seen_as(track.place == sighting)
        });
        self.is_placed = true;
    }

    /// Takes in that the robot turns round in mid-fragment, or before the place at its end, and
    /// goes back along it. O(all sequences' lengths).
    pub fn turn_round(&mut self) {
        let back: Vec<Vec<f64>> = self
            .tracks
            .iter()
            .map(|track| {
                let other = self.index(track.map, track.enter.opposite());
                let passed = &other.map_or(track, |other| &self.tracks[other]).passed;
                // What it has passed comes next, the last first.
                passed.iter().rev().copied().collect()
            })
            .collect();
        for (track, passed) in self.tracks.iter_mut().zip(back) {
            track.passed = passed;
        }
    }

    /// Moves the belief to the end of each fragment, past all its observations.
    fn pass_all(&mut self) {
        let seen = self.config.slip.max(1e-3);
        for track in &mut self.tracks {
            let count = track.patterns.len();
            let mut here = 0.0;
            for (passed, belief) in track.passed.iter().enumerate() {
                // Each observation that the map has still to come was missed.
                here += belief * libm::pow(2.0 * seen, (count - passed) as f64);
            }
            track.passed.fill(0.0);
            track.passed[count] = here;
        }
    }

    /// Weighs each fragment by the likelihood of the observation at its end.
    fn weigh(&mut self, likelihood: impl Fn(&Track) -> f64) {
        for track in &mut self.tracks {
            let count = track.patterns.len();
            track.passed[count] *= likelihood(track);
        }
        self.normalize();
    }

    /// Returns the probability that the maps have a fragment where a turn leads. If it is low, the
    /// robot would enter unknown ground. O(tracks).
    #[must_use]
    pub fn knows(&self, turn: Turn) -> f64 {
        self.entered(turn)
            .map_or(0.0, |entered| entered.iter().sum())
    }

    /// Takes in a turn at the junction, by which the robot enters the next fragment.
    ///
    /// # Errors
    /// [`LocalizeError::Turn`] if no junction at which the robot may be has such a turn. Nothing is
    /// learned then.
    pub fn turn(&mut self, turn: Turn) -> Result<(), LocalizeError> {
        let entered = self.entered(turn)?;
        for (track, entered) in self.tracks.iter_mut().zip(entered) {
            track.passed.fill(0.0);
            track.passed[0] = entered;
        }
        self.is_placed = true;
        self.normalize();
        self.spread(self.config.elsewhere);
        Ok(())
    }

    /// Returns the likeliest fragment and direction along it, the first of equals.
    #[must_use]
    pub fn location(&self) -> Location {
        let likelihood = |track: &Track| track.passed.iter().sum();
        // There is a track at least.
        let mut best = &self.tracks[0];
        let mut probability: f64 = likelihood(best);
        for track in &self.tracks[1..] {
            let other = likelihood(track);
            if other > probability {
                (best, probability) = (track, other);
            }
        }
        Location {
            map: best.map,
            enter: best.enter,
            ahead: best.ahead,
            probability,
        }
    }

    /// Returns the probability of each map: "which environment the robot is in".
    #[must_use]
    pub fn maps(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.maps.len()];
        for track in &self.tracks {
            sums[track.map] += track.passed.iter().sum::<f64>();
        }
        sums
    }

    /// Returns the probability that a turn leads into each track, in order of tracks.
    fn entered(&self, turn: Turn) -> Result<Vec<f64>, NoSuchTurn> {
        let mut entered = vec![0.0; self.tracks.len()];
        let mut refused = None;
        for track in &self.tracks {
            let map = &self.maps[track.map];
            let degree = map.degree(track.ahead.junction);
            let number = match turn.exit(track.ahead.number, degree) {
                Ok(number) => number,
                Err(error) => {
                    refused = Some(error);
                    continue;
                }
            };
            let enter = map.end_at(track.ahead.junction.port(number));
            let next = enter.and_then(|enter| self.index(track.map, enter));
            if let Some(entered) = next.and_then(|next| entered.get_mut(next)) {
                *entered += track.passed.last().copied().unwrap_or(0.0);
            }
        }
        match refused {
            Some(error) if entered.iter().all(|belief| *belief <= 0.0) => Err(error),
            _ => Ok(entered),
        }
    }

    /// Returns the index of the track with this map and end. Tracks are sorted by map and end.
    fn index(&self, map: usize, enter: End) -> Option<usize> {
        let key = (map, enter);
        self.tracks
            .binary_search_by_key(&key, |track| (track.map, track.enter))
            .ok()
    }

    /// Moves the share `part` of the belief to any place of any map.
    fn spread(&mut self, part: f64) {
        for track in &mut self.tracks {
            let anywhere = self.anywhere[track.map];
            for (passed, belief) in track.passed.iter_mut().enumerate() {
                // A robot put into a fragment has been observed to be in it.
                let here = if passed > 0 { part * anywhere } else { 0.0 };
                *belief = *belief * (1.0 - part) + here;
            }
        }
    }

    /// Scales all beliefs to a sum of 1. If nothing was possible, the robot may be anywhere.
    fn normalize(&mut self) {
        let sum: f64 = self.tracks.iter().flat_map(|track| &track.passed).sum();
        if sum > 0.0 {
            let beliefs = self.tracks.iter_mut().flat_map(|track| &mut track.passed);
            for belief in beliefs {
                *belief /= sum;
            }
        } else {
            self.spread(1.0);
        }
    }
}

/// Returns the probability of any single position of each map. All maps that have observations are
/// equally likely, and so are all positions of a map.
fn anywhere(maps: usize, tracks: &[Track]) -> Vec<f64> {
    let mut places = vec![0_usize; maps];
    for track in tracks {
        places[track.map] += track.patterns.len();
    }
    let seen = places.iter().filter(|places| **places > 0).count();
    let each = |places: &usize| match places {
        0 => 0.0,
        places => 1.0 / (seen * places) as f64,
    };
    places.iter().map(each).collect()
}

/// Mean distance between the observed prototype and that of the map's position, as a fraction of
/// the greatest distance in the dictionary.
///
/// The likelihood is exponential, not normal. Errors of observations a stride apart are correlated,
/// so a distant one says less than independent ones would. With it beliefs are right as often as
/// they claim.
const NEAR: f64 = 0.14;

/// Probability of mistaking a junction for another kind.
const UNSEEN: f64 = 1e-3;

/// Standard deviation of directions of ways glimpsed from before a place, rad.
const BLURRED: f64 = 0.5;

/// Likelihood of glimpsing a way that does not exist, relative to one that does.
const NO_WAY: f64 = 0.1;

/// Probability of missing a way from before a place.
const HIDDEN: f64 = 0.3;
