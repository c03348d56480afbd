//! Advises actions that would help the map: "the planner of actions that the mapper would find
//! useful". Nothing depends on whether they are done.

use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::PointBox;
use tolman_planners::{Graph, path_to, steps_from};

use super::{Action, Link, Observer, PlaceId, PlanStep, Use};

/// An opportunity script: a "short, stereotyped sequence of actions designed to help mapping in
/// particular situations".
#[derive(Clone, Debug, PartialEq)]
pub struct Opportunity {
    /// Purpose of the script.
    pub kind: OpportunityKind,
    /// Place that the script is about.
    pub place: PlaceId,
    /// Actions from the place of the best track; never empty.
    pub script: Vec<Action>,
    /// Expected gain in links: 1 for a new one, less for better knowledge of a known one.
    pub gain: f64,
    /// Cost in moves.
    pub cost: f64,
}

/// Gain of a new link at a place that may equal another, which may have the link already. It is
/// less than that of a few walks round the cycle that would decide.
const IN_DOUBT: f64 = 0.03;

/// Kind of script.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum OpportunityKind {
    /// Exploration, "going where no robot has gone before". The script leads to the nearest action
    /// that was never tried, at a place that is certainly not another.
    GoToUnknown,
    /// Exploration, "priming the pump": "if you know your current position accurately and you are
    /// near a place with high positional uncertainty, go to that place".
    PrimePump,
    /// Experimentation: go back and forth on a link that was hardly used so far.
    Shuttle,
    /// Experimentation: go along the way between two places that may be one, until its box decides.
    CloseLoop,
}

impl Opportunity {
    /// Returns the gain per move, by which scripts are ordered.
    #[must_use]
    pub fn worth(&self) -> f64 {
        self.gain / self.cost
    }
}

impl OpportunityKind {
    fn offer(self, place: PlaceId, script: Vec<Action>, gain: f64) -> Option<Opportunity> {
        Some(Opportunity {
            kind: self,
            place,
            cost: script.len() as f64,
            script,
            gain,
        })
    }
}

impl Observer {
    /// Returns scripts for actions that would help the map, from the place of the best track. The
    /// most worthwhile comes first. Nothing depends on whether they are done. O(places + links ·
    /// degree), and a search for each place with untried actions that may be another.
    ///
    /// The opportunity checker "examines the current mapper state to determine if any scripts are
    /// applicable".
    #[must_use]
    pub fn opportunities(&self) -> Vec<Opportunity> {
        let used = &self.config.opportunities;
        let scripts = [
            (used.unknown == Use::On).then(|| self.go_to_unknown()),
            (used.priming == Use::On).then(|| self.prime_pump()),
            (used.shuttle == Use::On).then(|| self.shuttle()),
            (used.close_loop == Use::On).then(|| self.close_loop()),
        ];
        let mut all: Vec<Opportunity> = scripts.into_iter().flatten().flatten().collect();
        all.retain(|script| script.cost <= f64::from(used.reach));
        all.sort_by(|a, b| {
            let worth = b.worth().total_cmp(&a.worth());
            worth.then(a.kind.cmp(&b.kind)).then(a.place.cmp(&b.place))
        });
        all
    }

    /// Returns the actions that were never tried at `place` and may be possible, by number. Empty
    /// if `place` is not on the map. O(actions · degree).
    #[must_use]
    pub fn untried(&self, place: PlaceId) -> Vec<Action> {
        let Some(place) = self.map.paths.resolve(place) else {
            return Vec::new();
        };
        let all = (0..self.config.actions.len() as u32).map(Action);
        let untried = |action: &Action| self.is_untried(place, *action);
        all.filter(untried).collect()
    }

    fn is_untried(&self, place: PlaceId, action: Action) -> bool {
        let mut along = self.map.paths.along(place, action);
        self.map.place(place).is_open(action) && along.next().is_none()
    }

    /// Returns the script to the nearest action that was never tried, however far that is; `None`
    /// if every action was. O(places + links · degree), and a search for each place with untried
    /// actions that may be another.
    #[must_use]
    pub fn go_to_unknown(&self) -> Option<Opportunity> {
        // From a place that may still be another one, known ground may be explored.
        let unknown = |place| !self.untried(place).is_empty();
        let certain = |place| unknown(place) && self.noted_doubles(place).is_empty();
        let sure = self.script_to(certain).map(|way| (way, 1.0));
        let ((mut script, place), gain) =
            sure.or_else(|| Some((self.script_to(unknown)?, IN_DOUBT)))?;
        script.push(*self.untried(place).first()?);
        OpportunityKind::GoToUnknown.offer(place, script, gain)
    }

    fn prime_pump(&self) -> Option<Opportunity> {
        if self.tracks[0].confidence < self.config.tracks.high {
            return None;
        }
        let (from, least) = (self.place(), self.config.least_distance());
        let neighbours = self.map.paths.ways(from).filter_map(|(_, link)| {
            let width = self.width(from, link.to)?;
            (width >= 0.5 * least).then_some((width, link))
        });
        let (width, link) =
            neighbours.max_by(|(a, one), (b, other)| a.total_cmp(b).then(other.to.cmp(&one.to)))?;
        let script = vec![link.action];
        let gain = (0.5 * width / least).min(1.0) / self.walks(&script);
        OpportunityKind::PrimePump.offer(link.to, script, gain)
    }

    fn shuttle(&self) -> Option<Opportunity> {
        let link = self.map.link(self.tracks[0].link?);
        let [from, to] = [link.from, link.to].map(|end| self.map.place(end).frame);
        let estimates = self.map.reference.relation(from, to)?.estimates;
        let back = self.config.reverse(link.action)?;
        let enough = estimates >= self.config.opportunities.traversals;
        if enough || !self.is_proved_by_return(link) {
            return None;
        }
        let gain = self.width(link.from, link.to)? / self.config.least_distance();
        let script = vec![back, link.action];
        OpportunityKind::Shuttle.offer(link.from, script, gain.min(1.0))
    }

    fn close_loop(&self) -> Option<Opportunity> {
        let from = self.place();
        let doubles = self.noted_doubles(from);
        if doubles.is_empty() {
            return None;
        }
        let steps = steps_from(&Walkable(self), [from.0]);
        let others = doubles.into_iter();
        let others = others.filter_map(|other| Some((steps[other.index()]?, other)));
        let (_, other) = others.min()?;
        let (script, _) = self.script_to(|place| place == other)?;
        // A place that is one with another saves a place and its links.
        let gain = 1.0 / self.walks(&script);
        OpportunityKind::CloseLoop.offer(other, script, gain)
    }

    /// Returns the noted places that `place` may be one with, by the bounds between them and by
    /// everything along the same actions. Many are noted when they are new, and settled by what
    /// became known since. O(notes · ways from both), and a search if any is left.
    fn noted_doubles(&self, place: PlaceId) -> Vec<PlaceId> {
        let notes = self.map.place(place).notes.iter();
        let others = notes.filter_map(|note| self.map.paths.resolve(note.other));
        let mut others: Vec<PlaceId> = others
            .filter(|other| self.may_be_one(place, *other))
            .collect();
        if !others.is_empty() {
            let near = self.near(place);
            others.retain(|other| near.contains(other));
        }
        others
    }

    /// Returns the mean number of walks along the ways of a script, in either direction, after one
    /// more. The first walk is worth most, so no script is preferred forever.
    fn walks(&self, script: &[Action]) -> f64 {
        let walkable = Walkable(self);
        let walks = script.iter().scan(self.place(), |at, action| {
            let step = walkable.ways(*at).find(|step| step.action == *action)?;
            let from = core::mem::replace(at, step.to);
            Some(self.traversed(from, step.to) + self.traversed(step.to, from))
        });
        1.0 + walks.sum::<f64>() / script.len().max(1) as f64
    }

    /// Returns the number of times that the robot went straight from one place to another.
    fn traversed(&self, from: PlaceId, to: PlaceId) -> f64 {
        let links = self.map.paths.outgoing(from);
        let there = links.filter(|(_, link)| link.to == to);
        there.map(|(_, link)| f64::from(link.traversed)).sum()
    }

    /// Returns the actions from here to the nearest place for which `is_goal` is true, and that
    /// place.
    fn script_to(&self, is_goal: impl Fn(PlaceId) -> bool) -> Option<(Vec<Action>, PlaceId)> {
        let walkable = Walkable(self);
        let way = path_to(&walkable, self.place().0, |place| is_goal(PlaceId(place)))?;
        let end = PlaceId(*way.last()?);
        let steps = steps_along(&way, |place| walkable.ways(place))?;
        Some((steps.into_iter().map(|step| step.action).collect(), end))
    }

    /// Returns whether geometry alone recognizes the beginning of a link when a robot goes along
    /// the link and back. After a longer way it might be at another place, and going back would add
    /// a place that cannot be told apart.
    fn is_proved_by_return(&self, link: &Link) -> bool {
        self.map.related(link.from, link.to).is_some_and(|there| {
            // Another measurement within the same bounds: there and back are off by the box's width
            // at most.
            let back = there;
            self.config.apart.most(there - back) < self.config.least_alike_distance()
        })
    }

    /// Returns the uncertainty of the displacement between two linked places: the box's longer
    /// side, m.
    fn width(&self, from: PlaceId, to: PlaceId) -> Option<f64> {
        self.map.related(from, to).map(PointBox::width)
    }
}

/// The ways that scripts take: those that a plan may follow, and one more. The latter is the
/// untried action back along the robot's last link, if its end will be recognized. The world may
/// lack such a way; then the script fails.
struct Walkable<'a>(&'a Observer);

impl Walkable<'_> {
    fn ways(&self, place: PlaceId) -> impl Iterator<Item = PlanStep> {
        let Self(observer) = *self;
        let paths = &observer.map.paths;
        let known = paths.ways(place).map(|(_, link)| link.step());
        let back = paths.incoming(place).filter_map(move |(_, link)| {
            let action = observer.config.reverse(link.action)?;
            let walkable = observer.is_untried(place, action) && observer.is_proved_by_return(link);
            let to = link.from;
            walkable.then_some(PlanStep { action, to })
        });
        known.chain(back)
    }
}

impl Graph for Walkable<'_> {
    fn node_count(&self) -> usize {
        self.0.map.paths.node_count()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        for step in self.ways(PlaceId(node)) {
            visit(step.to.0, 1);
        }
    }
}

/// Returns the steps from place to place along `way`, or `None` if two of its places are not
/// joined. `ways` gives the steps from a place.
pub(super) fn steps_along<I: Iterator<Item = PlanStep>>(
    way: &[u32],
    ways: impl Fn(PlaceId) -> I,
) -> Option<Vec<PlanStep>> {
    let hops = way.windows(2);
    hops.map(|hop| ways(PlaceId(hop[0])).find(|step| step.to.0 == hop[1]))
        .collect()
}
