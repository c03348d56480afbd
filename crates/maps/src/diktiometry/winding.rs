//! Corridors that wind: like turns in a row lead round a rectangle, or along a spiral.
//!
//! Beyond the paper. Corridors do not cross but where the robot would have seen a junction. So each
//! corridor of a spiral is longer than the last but one, as far as it winds outward, and shorter
//! from there on. Where the measured lengths leave no room for that, it is a rectangle, and each
//! fifth corner is the first again.
//!
//! A corner may be a junction at which the robot turns. Then a spiral may meet a place again. It
//! has closed off the ground that it turns to there, and winds inward.
//!
//! It holds if every place lies δ_sep or more beside the corridors that do not lead to it.

use alloc::vec::Vec;

use tolman_geom::{Interval, PointBox};

use super::{Action, CompassAxis, Config, Exits, Use, WorldKind};

/// Number of corners of a rectangle.
pub(super) const ROUND: usize = 4;

/// Maximum number of corridors that are followed each way.
const LONGEST: usize = 32;

/// Places and ways as far as they are known.
pub(super) trait Corridors {
    /// Name of a place.
    type Place: Copy + PartialEq;

    /// Returns the actions that the robot saw to be possible at a place.
    fn exits(&self, place: Self::Place) -> &Exits;

    /// Returns the place to which an action leads in a static world, or `None` if it is unknown.
    fn leads(&self, from: Self::Place, action: Action) -> Option<Self::Place>;
}

/// Corners with a corridor from each to the next, where all turns are like.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chain<P> {
    /// The corners, in order.
    pub(super) corners: Vec<P>,
    /// Turns from the first corner on.
    pub(super) turns: Turns,
}

impl<P: Copy + PartialEq> Chain<P> {
    /// Returns the longest known chain on which one of two places is a round after the other.
    /// `None` if there is none. O(1).
    pub(super) fn through(
        known: &impl Corridors<Place = P>,
        [one, other]: [P; 2],
        config: &Config,
    ) -> Option<Self> {
        let mut turns = Turns::from(known.exits(one), config);
        let turns = turns.find(|turns| turns.round(known, one) == Some(other))?;
        let mut corners = turns.back().follow(known, one, LONGEST);
        corners.reverse();
        let turns_before = corners.len() - 1;
        corners.extend(turns.follow(known, one, LONGEST).drain(1..));
        let turns = turns.earlier(turns_before);
        Some(Self { corners, turns })
    }
}

/// Like turns in a row: the actions along four corridors. The third leads back along the axis of
/// the first, the fourth along that of the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Turns([Action; ROUND]);

impl Turns {
    /// Returns the turns that begin with two actions. `None` if these do not lead straight along
    /// both axes, or if nothing may be concluded from turns.
    pub(super) fn new([first, second]: [Action; 2], config: &Config) -> Option<Self> {
        let is_used = config.restructuring.winding_merge == Use::On;
        let is_turn = config.leads(first)? != config.leads(second)?;
        let is_static = config.world == WorldKind::Static;
        let all = [
            first,
            second,
            config.reverse(first)?,
            config.reverse(second)?,
        ];
        (is_used && is_turn && is_static).then_some(Self(all))
    }

    /// Returns all turns from a place with these exits, both ways round.
    pub(super) fn from(exits: &Exits, config: &Config) -> impl Iterator<Item = Self> {
        let ways = match exits {
            Exits::Seen(seen) => seen.as_slice(),
            Exits::Unknown => &[],
        };
        let pairs = ways.iter().flat_map(|a| ways.iter().map(|b| [*a, *b]));
        pairs.filter_map(|pair| Self::new(pair, config))
    }

    /// Returns the corner that is a round after another, or `None` if it is unknown.
    pub(super) fn round<P: Copy + PartialEq>(
        &self,
        known: &impl Corridors<Place = P>,
        from: P,
    ) -> Option<P> {
        self.follow(known, from, ROUND).get(ROUND).copied()
    }

    /// Returns the turns from the same corner the other way round.
    const fn back(self) -> Self {
        let [first, second, third, fourth] = self.0;
        Self([second, first, fourth, third])
    }

    /// Returns the turns from an earlier corner on.
    fn earlier(mut self, corners: usize) -> Self {
        self.0.rotate_right(corners % ROUND);
        self
    }

    /// Returns the action from a corner to the next.
    pub(super) const fn action(&self, corner: usize) -> Action {
        self.0[corner % ROUND]
    }

    /// Returns whether a place with these exits can be a corner of the turns.
    pub(super) fn fit(&self, corner: usize, exits: &Exits) -> bool {
        let Exits::Seen(seen) = exits else {
            return false;
        };
        // What leads back to the corner before also leads on from the next one.
        let ways = [self.action(corner), self.action(corner + 1)];
        ways.iter().all(|way| seen.contains(way))
    }

    /// Returns the corners to which the turns lead from one, at most `corridors` of them.
    fn follow<P: Copy + PartialEq>(
        &self,
        known: &impl Corridors<Place = P>,
        from: P,
        corridors: usize,
    ) -> Vec<P> {
        let mut corners = Vec::from([from]);
        let mut here = from;
        for corner in 0..corridors {
            match known.leads(here, self.action(corner)) {
                Some(next)
                    if self.fit(corner + 1, known.exits(next)) && !corners.contains(&next) =>
                {
                    corners.push(next);
                    here = next;
                }
                _ => break,
            }
        }
        corners
    }

    /// Returns the length of the corridor from a corner to the next, m.
    pub(super) fn length(&self, corner: usize, way: PointBox, config: &Config) -> Interval {
        match config.leads(self.action(corner)) {
            Some(CompassAxis::EastWest) => way.x.abs(),
            _ => way.y.abs(),
        }
    }
}

/// Returns whether corridors with like turns go round a rectangle, as no spiral has such lengths,
/// m. O(corridors²).
pub(super) fn is_rectangle(lengths: &[Interval], config: &Config) -> bool {
    // A corridor bends by `across`, and so do those between two that are compared.
    let gap = config.least_distance() - 4.0 * config.across;
    let mut turns = 0..lengths.len().saturating_sub(2);
    lengths.len() >= ROUND && gap > 0.0 && !turns.any(|turn| is_spiral(lengths, turn, gap))
}

/// Returns whether corridors may wind outward before number `turn`, and inward after it.
///
/// Outward a corridor is shorter than the next but one, by `gap` or more. Inward it is longer.
fn is_spiral(lengths: &[Interval], turn: usize, gap: f64) -> bool {
    let mut most: Vec<f64> = lengths.iter().map(|length| length.high()).collect();
    for outward in (0..turn).rev() {
        most[outward] = most[outward].min(most[outward + 2] - gap);
    }
    for inward in turn + 3..most.len() {
        most[inward] = most[inward].min(most[inward - 2] - gap);
    }
    let mut most = most.iter().zip(lengths);
    most.all(|(most, length)| *most >= length.low())
}

#[cfg(test)]
mod tests {
    use alloc::collections::BTreeSet;
    use alloc::vec;

    use proptest::prelude::*;

    use super::*;

    /// Corridors on the axes, each with its ends in order.
    type Corridor = [[i32; 2]; 2];

    /// Returns the corridors of left turns of these lengths.
    fn drawn(lengths: &[i32]) -> Vec<Corridor> {
        let mut at = [0, 0];
        let corridors = lengths
            .iter()
            .zip([[0, 1], [-1, 0], [0, -1], [1, 0]].iter().cycle());
        let corridors = corridors.map(|(length, [x, y])| {
            let from = at;
            at = [from[0] + length * x, from[1] + length * y];
            [from, at]
        });
        corridors.collect()
    }

    /// Returns whether two corridors may be in one world: they are the same, or they meet in a
    /// place at the ends of both, or they keep apart by 1.
    fn go_together(one: Corridor, other: Corridor) -> bool {
        let sides = |corridor: Corridor| {
            [0, 1].map(|axis| {
                let [from, to] = corridor.map(|end| end[axis]);
                [from.min(to), from.max(to)]
            })
        };
        let [one_sides, other_sides] = [one, other].map(sides);
        let shared = [0, 1].map(|axis| {
            let ([a, b], [c, d]) = (one_sides[axis], other_sides[axis]);
            [a.max(c), b.min(d)]
        });
        let keep_apart = shared.iter().any(|[low, high]| low > high);
        let place = shared.map(|[low, _]| low);
        let is_place = shared.iter().all(|[low, high]| low == high);
        let meet = is_place && one.contains(&place) && other.contains(&place);
        keep_apart || meet || one_sides == other_sides
    }

    /// Returns whether left turns of these lengths lead through corridors of one world, and never
    /// to a place where they turned the same way before.
    fn is_way(lengths: &[i32]) -> bool {
        let corridors = drawn(lengths);
        (0..corridors.len()).all(|number| {
            let mut later = corridors.iter().enumerate().skip(number + 1);
            later.all(|(later, other)| {
                let is_round = (later - number) % ROUND == 0 && corridors[number][0] == other[0];
                !is_round && go_together(corridors[number], *other)
            })
        })
    }

    /// A corner has an exit on to the next one, and one back to the one before.
    #[test]
    fn a_corner_has_the_exits_of_its_turn() {
        let config = turning();
        let turns = Turns::new([Action(0), Action(1)], &config).unwrap();
        for corner in 0..8 {
            let ways = [corner, corner + 1].map(|corner| Action(corner as u32 % 4));
            let seen = |exits: &[Action]| turns.fit(corner, &Exits::Seen(exits.to_vec()));
            assert!(seen(&ways) && seen(&[ways[1], ways[0]]), "{corner}");
            let other = Action((ways[1].0 + 1) % 4);
            assert!(!seen(&ways[..1]) && seen(&[ways[0], ways[1], other]));
            assert!(!seen(&[ways[0], other]) && !seen(&[other, ways[1]]) && !seen(&[]));
            assert!(!turns.fit(corner, &Exits::Unknown));
        }
    }

    #[test]
    fn turns_begin_along_both_axes_and_go_both_ways_round() {
        let config = turning();
        let new = |ways: [u32; 2], config: &Config| Turns::new(ways.map(Action), config);
        let turns = new([0, 1], &config).unwrap();
        assert_eq!(turns, Turns([0, 1, 2, 3].map(Action)));
        assert_eq!(turns.back(), Turns([1, 0, 3, 2].map(Action)));
        assert_eq!(turns.earlier(1), Turns([3, 0, 1, 2].map(Action)));
        assert_eq!(turns.action(6), Action(2));
        assert_eq!(new([0, 2], &config), None);
        let exits = Exits::Seen([3, 0].map(Action).to_vec());
        let both: Vec<Turns> = Turns::from(&exits, &config).collect();
        assert_eq!(
            both,
            [[3, 0, 1, 2], [0, 3, 2, 1]].map(|all| Turns(all.map(Action)))
        );
        assert_eq!(Turns::from(&Exits::Unknown, &config).count(), 0);
        let all = |exits: &[u32]| {
            let exits = Exits::Seen(exits.iter().copied().map(Action).collect());
            Turns::from(&exits, &config).count()
        };
        assert_eq!(
            [all(&[0, 2]), all(&[3, 0, 1]), all(&[3, 0, 1, 2])],
            [0, 4, 8]
        );
        let mut changing = turning();
        changing.world = WorldKind::Changing;
        let mut unused = turning();
        unused.restructuring.winding_merge = Use::Off;
        let mut bent = turning();
        bent.actions = Config::compass_actions();
        for config in [changing, unused, bent] {
            assert_eq!(new([0, 1], &config), None);
        }
    }

    /// Returns a configuration that concludes from turns.
    fn turning() -> Config {
        let mut config = Config::new(Config::corridor_actions(), 1.0);
        config.restructuring.winding_merge = Use::On;
        config.world = WorldKind::Static;
        config
    }

    fn about(lengths: &[i32], error: f64) -> Vec<Interval> {
        let interval =
            |length: &i32| Interval::about(f64::from(*length), error * f64::from(*length));
        lengths
            .iter()
            .map(|length| interval(length).unwrap())
            .collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            cases: 4000,
            max_global_rejects: 100_000,
            ..ProptestConfig::default()
        })]

        /// Corners have a way on at both ends, so a corridor is added there.
        #[test]
        fn no_spiral_is_a_rectangle(lengths in prop::collection::vec(1..9, 4..8), error in 0.0..0.3) {
            let config = config();
            let whole = [&[1], &lengths[..], &[1]].concat();
            prop_assume!(is_way(&whole));
            prop_assert!(!is_rectangle(&about(&lengths, error), &config), "{:?}", lengths);
        }
    }

    /// All ways of up to nine corridors, also those that meet a place again.
    #[test]
    fn no_way_but_a_round_is_a_rectangle() {
        let config = config();
        let mut met = [0, 0];
        let mut ways: Vec<Vec<i32>> = vec![vec![]];
        while let Some(way) = ways.pop() {
            for length in 1..=5 {
                let longer = [&way[..], &[length]].concat();
                if !is_way(&longer) {
                    continue;
                }
                // At both ends a corridor leads on.
                let known = &longer[1..longer.len().max(2) - 1];
                assert!(!is_rectangle(&about(known, 0.0), &config), "{longer:?}");
                let ends: BTreeSet<[i32; 2]> = drawn(&longer).iter().map(|way| way[1]).collect();
                met[usize::from(ends.len() < longer.len())] += 1;
                if longer.len() < 9 {
                    ways.push(longer);
                }
            }
        }
        assert!(met.iter().all(|ways| *ways > 1000), "{met:?}");
    }

    fn config() -> Config {
        Config::new(Config::corridor_actions(), 1.0)
    }

    #[test]
    fn a_rectangle_is_known_when_its_lengths_leave_no_room() {
        let config = config();
        let is_known = |corridors: usize, error| {
            let lengths: Vec<i32> = [7, 5].into_iter().cycle().take(corridors).collect();
            is_rectangle(&about(&lengths, error), &config)
        };
        assert!(!is_known(3, 0.0), "two corridors with one between");
        assert!(is_known(4, 0.05), "a round: 2 · 5 % of 7 m is under 1 m");
        assert!(!is_known(4, 0.08));
        // Each way from its turn a spiral has room for as many corridors of 5 m as are whole metres
        // in twice their error, and one more.
        let known =
            [0.1, 0.2, 0.3].map(|error| (4..40).find(|corridors| is_known(*corridors, error)));
        assert_eq!(known, [Some(8), Some(12), Some(18)]);
    }

    #[test]
    fn a_spiral_may_wind_outward_and_then_inward() {
        let is_known = |lengths: &[i32]| is_rectangle(&about(lengths, 0.0), &config());
        assert!(!is_known(&[1, 1, 2, 2, 3, 3]));
        assert!(!is_known(&[3, 3, 2, 2, 1, 1]));
        assert!(!is_known(&[1, 1, 2, 3, 4, 2, 3, 1]));
        assert!(is_known(&[3, 3, 2, 2, 3, 3]), "inward, then outward again");
        let turn = vec![Interval::new(0.0, f64::INFINITY).unwrap(); 12];
        assert!(!is_rectangle(&turn, &config()), "nothing is known");
    }
}
