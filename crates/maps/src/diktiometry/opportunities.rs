//! Opportunistic mapping: the map advises "the planner of actions that the mapper would find useful". Nothing depends on
//! whether they are done.

use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::PointBox;
use tolman_planners::{Graph, path_to, steps_from};

use super::config::{Config, Use};
use super::ids::{Action, PlaceId};
use super::map::Diktiometry;
use super::path_graph::Link;
use super::track::Track;

/// An opportunity script: a "short, stereotyped sequence of actions designed to help mapping in particular situations".
#[derive(Clone, Debug, PartialEq)]
pub struct Opportunity {
    /// What it is good for.
    pub kind: OpportunityKind,
    /// The place it is about.
    pub place: PlaceId,
    /// The actions, from where the best track is now; never empty.
    pub script: Vec<Action>,
    /// What is to be won, in links: 1 for a new one, less for one that is known better afterwards.
    pub gain: f64,
    /// What it costs: moves.
    pub cost: f64,
}

/// The kinds of scripts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum OpportunityKind {
    /// Exploration, "going where no robot has gone before": to the nearest action that was never tried, from a place that is
    /// certainly no other.
    GoToUnknown,
    /// Exploration, "priming the pump": "if you know your current position accurately and you are near a place with high
    /// positional uncertainty, go to that place".
    PrimePump,
    /// Experimentation: back and forth on a link that was hardly gone yet.
    Shuttle,
    /// Experimentation: along the way between two places that may be one, until its box tells.
    CloseLoop,
}

impl Opportunity {
    /// What is won per move: the scripts are offered in this order.
    #[must_use]
    pub fn worth(&self) -> f64 {
        self.gain / self.cost
    }
}

/// The opportunity checker "examines the current mapper state to determine if any scripts are applicable". The most
/// worthwhile first. O(places + links · degree).
pub(super) fn opportunities(map: &Diktiometry, track: &Track, config: &Config) -> Vec<Opportunity> {
    let chosen = &config.opportunities;
    let mut all = Vec::new();
    if chosen.unknown == Use::On {
        all.extend(go_to_unknown(map, track.place, config));
    }
    if chosen.priming == Use::On && track.confidence >= config.tracks.high {
        all.extend(prime_pump(map, track.place, config));
    }
    if chosen.shuttle == Use::On {
        all.extend(shuttle(map, track, config));
    }
    if chosen.close_loop == Use::On {
        all.extend(close_loop(map, track.place, config));
    }
    all.sort_by(|a, b| {
        let worth = b.worth().total_cmp(&a.worth());
        worth.then(a.kind.cmp(&b.kind)).then(a.place.cmp(&b.place))
    });
    all
}

/// The actions that were never tried at a place and may lead somewhere, by number.
pub(super) fn untried(map: &Diktiometry, place: PlaceId, config: &Config) -> Vec<Action> {
    let here = &map.paths.places[place.index()];
    let all = (0..config.actions.len() as u32).map(Action);
    all.filter(|action| here.is_open(*action))
        .filter(|&action| map.paths.along(place, action).next().is_none())
        .collect()
}

/// Whether a place may still turn out to be another: whoever explores from it may explore what is known already.
fn is_resolved(map: &Diktiometry, place: PlaceId) -> bool {
    map.paths.places[place.index()].notes.is_empty()
}

fn go_to_unknown(map: &Diktiometry, from: PlaceId, config: &Config) -> Option<Opportunity> {
    let walkable = Walkable { map, config };
    let (mut script, place) = walkable.script_to(from, |place| {
        is_resolved(map, place) && !untried(map, place, config).is_empty()
    })?;
    script.push(*untried(map, place, config).first()?);
    offered(OpportunityKind::GoToUnknown, place, script, 1.0, config)
}

fn prime_pump(map: &Diktiometry, from: PlaceId, config: &Config) -> Option<Opportunity> {
    let neighbours = map.paths.ways(from).filter_map(|(_, link)| {
        let width = width(map, from, link.to)?;
        (width >= 0.5 * config.least_distance()).then_some((width, link))
    });
    let widest =
        neighbours.max_by(|(a, one), (b, other)| a.total_cmp(b).then(other.to.cmp(&one.to)));
    let (width, link) = widest?;
    let gain = (0.5 * width / config.least_distance()).min(1.0);
    offered(
        OpportunityKind::PrimePump,
        link.to,
        vec![link.action],
        gain,
        config,
    )
}

fn shuttle(map: &Diktiometry, track: &Track, config: &Config) -> Option<Opportunity> {
    let link = map.paths.link(track.link?)?;
    let [from, to] = [link.from, link.to].map(|end| map.paths.places[end.index()].frame);
    let estimates = map.reference.relation(from, to)?.estimates;
    let back = config.actions.get(link.action.0 as usize)?.reverse?;
    let enough = estimates >= config.opportunities.traversals;
    if enough || !is_proved_by_return(map, link, config) {
        return None;
    }
    let gain = width(map, link.from, link.to)? / config.least_distance();
    offered(
        OpportunityKind::Shuttle,
        link.from,
        vec![back, link.action],
        gain.min(1.0),
        config,
    )
}

fn close_loop(map: &Diktiometry, from: PlaceId, config: &Config) -> Option<Opportunity> {
    let notes = &map.paths.places[from.index()].notes;
    if notes.is_empty() {
        return None;
    }
    let walkable = Walkable { map, config };
    let steps = steps_from(&walkable, [from.0]);
    let others = notes.iter().filter_map(|note| {
        let other = map.paths.resolve(note.other)?;
        let steps = steps[other.index()].filter(|steps| *steps > 0)?;
        Some((steps, other))
    });
    let (_, other) = others.min()?;
    let (script, _) = walkable.script_to(from, |place| place == other)?;
    // A place that is one with another saves a place and its links.
    offered(OpportunityKind::CloseLoop, other, script, 1.0, config)
}

/// The script, if it is not too long.
fn offered(
    kind: OpportunityKind,
    place: PlaceId,
    script: Vec<Action>,
    gain: f64,
    config: &Config,
) -> Option<Opportunity> {
    let cost = script.len();
    (cost <= config.opportunities.reach as usize).then_some(Opportunity {
        kind,
        place,
        script,
        gain,
        cost: cost as f64,
    })
}

/// The ways that scripts take: those a plan may follow and, where the robot came along a link, the action back, if it was never
/// tried and its end will be recognized. The world may have no such way; a script may fail.
struct Walkable<'a> {
    map: &'a Diktiometry,
    config: &'a Config,
}

impl Walkable<'_> {
    fn ways(&self, place: PlaceId) -> impl Iterator<Item = (Action, PlaceId)> {
        let Self { map, config } = *self;
        let known = map.paths.ways(place);
        let known = known.map(|(_, link)| (link.action, link.to));
        let back = map.paths.incoming(place).filter_map(move |(_, link)| {
            let back = config.actions.get(link.action.0 as usize)?.reverse?;
            let walkable = map.paths.places[place.index()].is_open(back)
                && map.paths.along(place, back).next().is_none()
                && is_proved_by_return(map, link, config);
            walkable.then_some((back, link.from))
        });
        known.chain(back)
    }

    /// The actions from one place to the nearest that is a goal, and that place.
    fn script_to(
        &self,
        from: PlaceId,
        is_goal: impl Fn(PlaceId) -> bool,
    ) -> Option<(Vec<Action>, PlaceId)> {
        let way = path_to(self, from.0, |place| is_goal(PlaceId(place)))?;
        let end = PlaceId(*way.last()?);
        Some((actions_along(&way, |place| self.ways(place))?, end))
    }
}

impl Graph for Walkable<'_> {
    fn node_count(&self) -> usize {
        self.map.paths.node_count()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        for (_, to) in self.ways(PlaceId(node)) {
            visit(to.0, 1);
        }
    }
}

/// The actions that lead from each place of a way to the next, by the ways there are from each.
pub(super) fn actions_along<I: Iterator<Item = (Action, PlaceId)>>(
    way: &[u32],
    ways: impl Fn(PlaceId) -> I,
) -> Option<Vec<Action>> {
    let hops = way.iter().zip(way.iter().skip(1));
    hops.map(|(&tail, &head)| {
        let mut ways = ways(PlaceId(tail));
        ways.find(|(_, to)| to.0 == head).map(|(action, _)| action)
    })
    .collect()
}

/// Whether a robot that goes along a link and back is recognized where it began, by geometry alone: after a longer way it might be
/// at a place of its own, and going back would make one more place that nobody can tell.
fn is_proved_by_return(map: &Diktiometry, link: &Link, config: &Config) -> bool {
    map.related(link.from, link.to).is_some_and(|there| {
        // Another measurement within the same bounds: there and back are off by the box's width at most.
        let back = there;
        (there - back).norm().high() < config.least_alike_distance()
    })
}

/// How well the displacement between two linked places is known: the box's longer side, m.
fn width(map: &Diktiometry, from: PlaceId, to: PlaceId) -> Option<f64> {
    map.related(from, to).map(PointBox::width)
}
