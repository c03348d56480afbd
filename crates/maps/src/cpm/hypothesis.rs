use alloc::vec;
use alloc::vec::Vec;
use core::cell::Cell;

use tolman_geom::{Interval, PointBox};

use super::bearings::SHARP;
use super::cp_mapper::MapUpdate;
use super::map::{End, Fragment, FragmentId, Junction, Port, Sign};
use super::mapper::{Comparison, Mapper};
use super::pattern::PatternId;
use super::similarity::Sense;
use super::traversal::{DeadReckoning, Traversal};
use super::turn::{NoSuchTurn, Turn};
use tolman_robot::Landmark;

/// One explanation of all observations: a map and its cost.
///
/// The cost is a negative log-probability, up to a constant that all hypotheses share. Every step
/// adds its cost relative to a walk into the unknown.
#[derive(Clone, Debug)]
pub(super) struct Hypothesis {
    pub(super) mapper: Mapper,
    pub(super) cost: f64,
}

/// Positions of the junctions of a map, by id, relative to the beginning of a walk; `None` if
/// unknown.
type Positions = [Option<PointBox>];

impl Hypothesis {
    pub(super) const fn certain(mapper: Mapper) -> Self {
        Self { mapper, cost: 0.0 }
    }

    /// Returns all hypotheses that follow from this one after a walk; empty if the walk contradicts
    /// it.
    pub(super) fn after(
        &self,
        turn: Turn,
        walk: &Traversal,
        judge: &Comparison<'_>,
    ) -> Result<Vec<(Self, MapUpdate)>, NoSuchTurn> {
        let exit = self.mapper.exit(turn)?;
        if let Some(end) = self.mapper.map.end_at(exit) {
            let known = self.along(exit, end, walk, judge).into_iter();
            return Ok(known.map(|known| (known, MapUpdate::Known)).collect());
        }
        let bearing = |motion: DeadReckoning| self.mapper.map.bearing_cost(exit, motion.departure);
        let Some(departure) = walk.motion.map_or(Some(0.0), bearing) else {
            return Ok(Vec::new());
        };
        let base = Self {
            cost: self.cost + departure,
            ..self.clone()
        };
        let positions = self.mapper.map.positions_from(exit.junction);
        // Without bounds no way leads to known places but over fragments that are known.
        let (mut all, is_known_place) = match walk.motion {
            Some(motion) => (
                base.to_places(exit, walk, motion, &positions),
                self.is_known_place(walk, motion, &positions),
            ),
            None => (Vec::new(), false),
        };
        let mut new = base;
        let fragment = new.mapper.append(exit, walk);
        all.extend(new.duplicates(fragment, &positions, judge));
        if !is_known_place {
            new.cost += NEW_PLACE;
            all.push((new, MapUpdate::New));
        }
        Ok(all)
    }

    /// Returns whether a walk has certainly led to a place of the map. It has if the place is the
    /// only start and its position is known, or if no second place fits the sighting.
    fn is_known_place(
        &self,
        walk: &Traversal,
        motion: DeadReckoning,
        positions: &Positions,
    ) -> bool {
        let is_start = walk.sighting.landmark == Some(Landmark::Start);
        let mut places = self.mapper.map.junctions().zip(positions);
        places.any(|((_, place), position)| {
            position.is_some_and(|position| {
                let apart = || position.distance(motion.displacement).high();
                place.sighting() == walk.sighting && (is_start || apart() < LEAST_APART)
            })
        })
    }

    /// Returns the hypothesis that the walk followed a known fragment, or `None` if it cannot have.
    fn along(
        &self,
        exit: Port,
        end: End,
        walk: &Traversal,
        judge: &Comparison<'_>,
    ) -> Option<Self> {
        let map = &self.mapper.map;
        let arrival = map.beyond(exit)?;
        let place = map.junction(arrival.junction)?;
        if place.sighting() != walk.sighting {
            return None;
        }
        let fragment = map.fragment(end.fragment)?;
        let sense = Sense::entered_at(end.sign);
        let motion = walk.motion.map(|motion| sense.of_motion(motion));
        let gain = judge.evidence(fragment, &walk.patterns, sense)
            + self.motion_evidence(fragment.motion, motion)?;
        let mut next = self.clone();
        next.cost += bearings_cost(place, arrival.number, walk) - gain;
        next.mapper.at = arrival;
        next.mapper.confirm(end, walk);
        Some(next)
    }

    /// Returns the explanations by which the walk was a new fragment to a known place, through an
    /// unexplored port.
    fn to_places(
        &self,
        exit: Port,
        walk: &Traversal,
        motion: DeadReckoning,
        positions: &Positions,
    ) -> Vec<(Self, MapUpdate)> {
        let map = &self.mapper.map;
        let area = self.area();
        let mut all = Vec::new();
        for ((id, place), position) in map.junctions().zip(positions) {
            let Some(position) = position else {
                continue;
            };
            if place.sighting() != walk.sighting || !position.meets(motion.displacement) {
                continue;
            }
            let gain = coincidence(*position - motion.displacement, area);
            let is_other = |number: &u32| id != exit.junction || *number != exit.number;
            let open: Vec<u32> = place.open_ports().filter(is_other).collect();
            let choices = libm::log(open.len().max(1) as f64);
            for number in open {
                let entry = id.port(number);
                let Some(bearing) = map.bearing_cost(entry, motion.reversed().departure) else {
                    continue;
                };
                let mut next = self.clone();
                next.cost += bearing + choices + bearings_cost(place, number, walk) - gain;
                let patterns = walk.patterns.clone();
                next.mapper
                    .map
                    .add_fragment(patterns, walk.motion, exit, entry);
                next.mapper.at = entry;
                next.mapper.notice(walk);
                all.push((next, MapUpdate::Loop));
            }
        }
        all
    }

    /// Returns the maps in which the fragment `new` is a duplicate of another. The place to which
    /// it led is the last one and has no position yet.
    fn duplicates(
        &self,
        new: FragmentId,
        positions: &Positions,
        judge: &Comparison<'_>,
    ) -> Vec<(Self, MapUpdate)> {
        let map = &self.mapper.map;
        let Some(fragment) = map.fragment(new) else {
            return Vec::new();
        };
        let area = self.area();
        let mut all = Vec::new();
        for (id, other) in judge.others(map, new) {
            for sense in [Sense::Same, Sense::Inverted] {
                // Where both fragments begin has to be one place.
                let begin = other.port(sense.of(Sign::Minus)).junction;
                let rank = map.junctions.rank(begin);
                let apart = rank.and_then(|rank| *positions.get(rank)?);
                if apart.is_some_and(|apart| !apart.meets(PointBox::ORIGIN)) {
                    continue;
                }
                let evidence = judge.evidence(other, &fragment.patterns, sense);
                if evidence <= 0.0 {
                    continue;
                }
                let coincide = apart.map_or(0.0, |apart| coincidence(apart, area));
                let gain = Cell::new(evidence + coincide);
                let agree = |a: &Fragment, b: &Fragment, sense: Sense| {
                    let evidence = judge.evidence(a, &b.patterns, sense);
                    gain.set(gain.get() + evidence);
                    evidence > -MOST_EVIDENCE / 2.0
                };
                if let Some((map, merges)) = map.unified(id, new, sense, &agree) {
                    let at = merges.port(self.mapper.at);
                    let next = Self {
                        mapper: Mapper { map, at },
                        cost: self.cost - gain.get(),
                    };
                    all.push((next, MapUpdate::Duplicate));
                }
            }
        }
        all
    }

    /// Returns the log odds, by displacement, that two walks went along one fragment. `None` if the
    /// displacements cannot be the same; 0 if one is unknown.
    fn motion_evidence(
        &self,
        known: Option<DeadReckoning>,
        walked: Option<DeadReckoning>,
    ) -> Option<f64> {
        match (known, walked) {
            (Some(known), Some(walked)) => {
                known.intersection(walked)?;
                Some(coincidence(
                    known.displacement - walked.displacement,
                    self.area(),
                ))
            }
            _ => Some(0.0),
        }
    }

    /// Returns the area in which one junction is expected, m². It reaches as far as fragments do.
    fn area(&self) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for (_, fragment) in self.mapper.map.fragments() {
            if let Some(motion) = fragment.motion {
                let way = motion.displacement.middle();
                sum += way.x * way.x + way.y * way.y;
                count += 1.0;
            }
        }
        if count > 0.0 { sum / count } else { 1.0 }
    }

    /// Returns a form that is equal for equal hypotheses: everything reachable from the robot's
    /// place, in order.
    pub(super) fn signature(&self) -> Vec<u32> {
        let Mapper { map, at } = &self.mapper;
        // Junctions by rank, with the port by which each is entered first; and the place of each in
        // this order, by rank.
        let mut order = Vec::new();
        let mut places = vec![None; map.junctions.len()];
        if let Some(rank) = map.junctions.rank(at.junction) {
            order.push((rank, at.number));
            places[rank] = Some(0);
        }
        let mut signature = Vec::new();
        let mut next = 0;
        while let Some(&(rank, entry)) = order.get(next) {
            next += 1;
            let ports = map.ports_at(rank);
            signature.push(ports.len() as u32);
            let (before, onward) = ports.split_at(ports.len().min(entry as usize));
            for port in onward.iter().chain(before) {
                let Some((rank, number)) = map.led_to(*port) else {
                    signature.push(u32::MAX);
                    continue;
                };
                let place = *places[rank].get_or_insert_with(|| {
                    order.push((rank, number));
                    order.len() - 1
                });
                let (_, first) = order[place];
                let degree = (map.ports_at(rank).len() as u32).max(1);
                signature.push(place as u32);
                signature.push((number + degree - first) % degree);
            }
        }
        signature
    }
}

impl Comparison<'_> {
    /// Returns the log odds, by observations, that two walks went along one fragment.
    fn evidence(&self, known: &Fragment, patterns: &[PatternId], sense: Sense) -> f64 {
        let score = self.score(patterns, &known.patterns, sense);
        let length = known.patterns.len().min(patterns.len()).max(1) as f64;
        let evidence = EVIDENCE * length * (score - self.matching.threshold());
        evidence.clamp(-MOST_EVIDENCE, MOST_EVIDENCE)
    }
}

/// Returns the cost of the belief that the ways seen from `port` are those of `place`, as a
/// negative logarithm of odds.
fn bearings_cost(place: &Junction, port: u32, walk: &Traversal) -> f64 {
    let off = place.apart(port, walk.bearings.as_ref()) / SHARP;
    (0.5 * off * off).min(MOST_EVIDENCE)
}

/// Returns the log-ratio of two likelihoods of two places lying within a box of each other: for one
/// place, and for any two places. It is the log of the area that holds places over the area of the
/// box.
fn coincidence(apart: PointBox, area: f64) -> f64 {
    let side = |side: Interval| side.width().max(1e-3);
    libm::log(area / (side(apart.x) * side(apart.y))).clamp(-MOST_EVIDENCE, MOST_EVIDENCE)
}

/// Minimum distance of two places, m: less than the width of any robot that could tell them apart.
const LEAST_APART: f64 = 0.05;

/// Cost of a new place: a map with fewer places is simpler.
const NEW_PLACE: f64 = 1.0;

/// Log odds that an observation adds, for a score of 1 above the threshold.
const EVIDENCE: f64 = 5.0;

/// Maximum evidence of a single fragment. Observations and bounds may err in ways that no model
/// has.
const MOST_EVIDENCE: f64 = 10.0;
