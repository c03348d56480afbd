use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::cp_mapper::MapUpdate;
use super::hypothesis::Hypothesis;
use super::map::CpMap;
use super::mapper::{Comparison, Mapper};
use super::traversal::Traversal;
use super::turn::{NoSuchTurn, Turn};

/// The likeliest explanations of all observations so far: a beam search over hypotheses.
///
/// While many ports are open a beam may lose the truth. That shows by a walk that no hypothesis
/// explains. The beam then goes through the whole record again with a greater width, which shrinks
/// again once walks are explained.
#[derive(Clone, Debug)]
pub(super) struct Beam {
    /// Hypotheses, the likeliest first; never empty. Costs are relative to the first.
    hypotheses: Vec<Hypothesis>,
    /// Maximum number of hypotheses now.
    width: usize,
    /// Configured maximum number of hypotheses.
    narrow: usize,
    /// Number of walks explained since the width last changed.
    understood: u32,
    /// Map before the first event of `met`.
    begin: Mapper,
    met: Vec<Event>,
}

#[derive(Clone, Debug)]
enum Event {
    Walked(Turn, Traversal),
    TurnedBack(Turn, u32),
}

/// Explanation of a walk by the likeliest hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Understood {
    /// The earlier walks keep their explanation.
    As(MapUpdate),
    /// The earlier walks have a new explanation.
    Anew(MapUpdate),
    /// No hypothesis explains the walk.
    Not,
}

/// Reason why a beam explains nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lost {
    /// The beam was full at some time, so a wider one may have kept the truth.
    InNarrowness,
    /// The beam was never full: a wider one would have lost the truth too.
    ForGood,
}

/// One explanation of a walk, derived from a hypothesis of the beam.
struct Child {
    hypothesis: Hypothesis,
    arrival: MapUpdate,
    /// Index of the parent hypothesis in the beam.
    parent: usize,
}

/// Log odds against a hypothesis above which it is dropped.
const HOPELESS: f64 = 25.0;

/// Maximum factor by which a beam that has lost the truth is widened.
const WIDEST: usize = 16;

/// Number of walks in a row that must be understood before a widened beam is halved.
const CALM: u32 = 32;

impl Beam {
    /// Starts from the certain hypothesis `begin`, and keeps at most `width` hypotheses.
    pub(super) fn new(begin: Mapper, width: u32) -> Self {
        let narrow = width.max(1) as usize;
        Self {
            hypotheses: Vec::from([Hypothesis::certain(begin.clone())]),
            width: narrow,
            narrow,
            understood: 0,
            begin,
            met: Vec::new(),
        }
    }

    /// Returns the likeliest map, and the robot's place on it.
    pub(super) fn best(&self) -> &Mapper {
        self.hypotheses
            .first()
            .map_or(&self.begin, |best| &best.mapper)
    }

    /// Returns the probability of the likeliest map among all kept maps that are possible with
    /// places at least `apart` m apart, 0 to 1.
    pub(super) fn certainty(&self, apart: f64) -> f64 {
        let can_be = |other: &&Hypothesis| {
            let Mapper { map, at } = &other.mapper;
            map.doubt(at.junction, apart).is_none()
        };
        let others = self.hypotheses.iter().skip(1).filter(can_be);
        let odds = others.map(|other| libm::exp(-other.cost));
        1.0 / (1.0 + odds.sum::<f64>())
    }

    pub(super) fn best_map_mut(&mut self) -> &mut CpMap {
        match self.hypotheses.first_mut() {
            Some(best) => &mut best.mapper.map,
            None => &mut self.begin.map,
        }
    }

    /// Takes in a walk. O(width · fragments · log fragments), and one comparison for each pair of
    /// sequences.
    ///
    /// If the beam has to be wider, it goes through all walks since the beginning again with each
    /// width that it tries. The sum of these widths is less than twice the greatest.
    ///
    /// # Errors
    /// If the robot's place has no such turn; nothing is changed then.
    pub(super) fn walked(
        &mut self,
        turn: Turn,
        walk: &Traversal,
        judge: &Comparison<'_>,
    ) -> Result<Understood, NoSuchTurn> {
        let exit = self.best().exit(turn)?;
        let children = children(&self.hypotheses, turn, walk, judge, self.width)?;
        self.met.push(Event::Walked(turn, walk.clone()));
        if let Some(first) = children.first() {
            let understood = match first.parent {
                0 => Understood::As(first.arrival),
                _ => Understood::Anew(first.arrival),
            };
            self.hypotheses = hypotheses(children);
            self.calm_down();
            return Ok(understood);
        }
        self.understood = 0;
        while self.width < self.narrow.saturating_mul(WIDEST) {
            self.width = self.width.saturating_mul(2);
            match self.look_again(judge) {
                Ok(arrival) => return Ok(Understood::Anew(arrival)),
                Err(Lost::InNarrowness) => {}
                Err(Lost::ForGood) => break,
            }
        }
        // It goes on with what it has found, apart from the rest.
        let mut adrift = self.best().clone();
        adrift.go_adrift(exit, walk);
        *self = Self::new(adrift, self.narrow as u32);
        Ok(Understood::Not)
    }

    /// Makes the beam narrower once it has explained enough walks in a row.
    fn calm_down(&mut self) {
        if self.width <= self.narrow {
            return;
        }
        self.understood += 1;
        if self.understood >= CALM {
            self.width = self.narrow.max(self.width / 2);
            self.understood = 0;
        }
    }

    /// Goes through the whole record again and returns the update by the last walk. If no
    /// hypothesis explains all of it, the beam stays as before.
    fn look_again(&mut self, judge: &Comparison<'_>) -> Result<MapUpdate, Lost> {
        let mut now = Vec::from([Hypothesis::certain(self.begin.clone())]);
        let (mut arrival, mut lost) = (None, Lost::ForGood);
        for event in &self.met {
            match event {
                Event::Walked(turn, walk) => {
                    let children = children(&now, *turn, walk, judge, self.width);
                    let children = children.map_err(|_| lost)?;
                    arrival = Some(children.first().ok_or(lost)?.arrival);
                    now = hypotheses(children);
                    if now.len() >= self.width {
                        lost = Lost::InNarrowness;
                    }
                }
                Event::TurnedBack(turn, observations) => turn_back(&mut now, *turn, *observations),
            }
        }
        self.hypotheses = now;
        arrival.ok_or(lost)
    }

    /// Notes that the robot has turned round in an unknown fragment after `observations`
    /// observations.
    ///
    /// # Errors
    /// If the robot's place has no such turn; nothing is changed then.
    pub(super) fn turned_back(&mut self, turn: Turn, observations: u32) -> Result<(), NoSuchTurn> {
        self.best().exit(turn)?;
        turn_back(&mut self.hypotheses, turn, observations);
        self.met.push(Event::TurnedBack(turn, observations));
        Ok(())
    }
}

fn turn_back(hypotheses: &mut Vec<Hypothesis>, turn: Turn, observations: u32) {
    hypotheses.retain_mut(|hypothesis| {
        let exit = hypothesis.mapper.exit(turn);
        exit.is_ok_and(|exit| {
            hypothesis.mapper.came_back(exit, observations);
            true
        })
    });
}

/// Returns the hypotheses after a walk, the likeliest first, without duplicates.
fn children(
    parents: &[Hypothesis],
    turn: Turn,
    walk: &Traversal,
    judge: &Comparison<'_>,
    width: usize,
) -> Result<Vec<Child>, NoSuchTurn> {
    let mut all = Vec::new();
    for (parent, hypothesis) in parents.iter().enumerate() {
        // The same place looks the same in all, so the turn is there in all.
        for (hypothesis, arrival) in hypothesis.after(turn, walk, judge)? {
            all.push(Child {
                hypothesis,
                arrival,
                parent,
            });
        }
    }
    all.sort_by(|a, b| a.hypothesis.cost.total_cmp(&b.hypothesis.cost));
    let least = all.first().map_or(0.0, |best| best.hypothesis.cost);
    let mut signatures = BTreeSet::new();
    let mut kept = Vec::new();
    for mut child in all {
        child.hypothesis.cost -= least;
        if kept.len() >= width || child.hypothesis.cost >= HOPELESS {
            break;
        }
        if signatures.insert(child.hypothesis.signature()) {
            kept.push(child);
        }
    }
    Ok(kept)
}

fn hypotheses(children: Vec<Child>) -> Vec<Hypothesis> {
    let hypotheses = children.into_iter().map(|child| child.hypothesis);
    hypotheses.collect()
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Interval, Point, PointBox};

    use super::super::config::CpMapperConfig;
    use super::super::map::{Port, PortState};
    use super::super::pattern::{Dictionary, PatternId};
    use super::super::traversal::{DeadReckoning, Sighting};
    use super::*;
    use tolman_robot::Landmark;

    const START: Sighting = Sighting {
        degree: 1,
        landmark: Some(Landmark::Start),
    };

    fn dictionary() -> Dictionary {
        let mut dictionary = Dictionary::new(2);
        dictionary.learn(&[1.0, 0.0], &[1.0, 0.0], 0.0).unwrap();
        dictionary.learn(&[0.0, 1.0], &[0.0, 1.0], 0.0).unwrap();
        dictionary
    }

    /// Returns a walk of ten equal observations to the east or the west.
    fn walk(pattern: u32, east: f64, sighting: Sighting) -> Traversal {
        let heading = if east > 0.0 {
            0.0
        } else {
            core::f64::consts::PI
        };
        let heading = Interval::new(heading - 0.1, heading + 0.1).unwrap();
        let motion = DeadReckoning {
            displacement: PointBox::about(Point::new(east, 0.0), 0.01).unwrap(),
            departure: heading,
            arrival: heading,
        };
        Traversal {
            patterns: [PatternId(pattern); 10].to_vec(),
            motion: Some(motion),
            sighting,
            bearings: None,
        }
    }

    #[test]
    fn a_wide_beam_grows_narrow_while_all_is_understood() {
        let (dictionary, config) = (dictionary(), CpMapperConfig::robust());
        let judge = config.comparison(&dictionary);
        let mut beam = Beam::new(Mapper::new(START), 2);
        beam.width = 8;
        let mut widths = Vec::new();
        for number in 0..3 * CALM {
            let walk = match number % 2 {
                0 => walk(0, 1.0, Sighting::plain(1)),
                _ => walk(0, -1.0, START),
            };
            let understood = beam.walked(Turn::BACK, &walk, &judge).unwrap();
            assert_ne!(understood, Understood::Not);
            if widths.last() != Some(&beam.width) {
                widths.push(beam.width);
            }
        }
        assert_eq!(widths, [8, 4, 2]);
    }

    /// The walk seems to lead to the start, whose only port already has another fragment.
    #[test]
    fn what_nothing_explains_hangs_on_nothing() {
        let (dictionary, config) = (dictionary(), CpMapperConfig::robust());
        let judge = config.comparison(&dictionary);
        let mut beam = Beam::new(Mapper::new(START), 4);
        let start = beam.best().at;
        let first = walk(0, 1.0, Sighting::plain(3));
        beam.walked(Turn::BACK, &first, &judge).unwrap();
        let open = beam.best().exit(Turn(1)).unwrap();
        let second = walk(1, -1.0, START);
        let understood = beam.walked(Turn(1), &second, &judge).unwrap();
        assert_eq!(understood, Understood::Not);
        let Mapper { map, at } = beam.best();
        assert_eq!(map.port(open), Some(PortState::Open { at_least: 0 }));
        assert_eq!(map.fragments().len(), 2);
        assert_ne!(at.junction, start.junction);
        let rank = map.junctions.rank(at.junction).unwrap();
        assert_eq!(map.positions_from(start.junction)[rank], None);
        // The copy of the junction has the fragment at the same turn.
        let port = map.beyond(*at).unwrap();
        assert_ne!(port.junction, open.junction);
        assert_eq!((port.number, map.degree(port.junction)), (1, 3));
        let behind = Port { number: 0, ..port };
        assert_eq!(map.port(behind), Some(PortState::Open { at_least: 0 }));
        // It walks back, and knows that.
        let back = walk(1, 1.0, Sighting::plain(3));
        let understood = beam.walked(Turn::BACK, &back, &judge).unwrap();
        assert_eq!(understood, Understood::As(MapUpdate::Known));
    }
}
