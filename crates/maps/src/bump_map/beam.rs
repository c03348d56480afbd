use alloc::collections::btree_map::Entry;
use alloc::collections::{BTreeMap, BTreeSet, VecDeque};
use alloc::vec;
use alloc::vec::Vec;

use tolman_maze::Direction;

use super::graph::BumpWay;
use super::hypothesis::{Hypothesis, Taken};
use super::{BumpMove, TESTS};

/// Largest number of hypotheses.
const WIDTH: usize = 100;

/// How many bits longer than the best a description may be. Four failures of one in 100 moves have
/// as many.
const WINDOW: f64 = 26.6;

/// Number of moves of a walk that is not worth going over again.
const SHORT_WALK: usize = 300;

/// The likeliest hypotheses about which moves failed, best first, weighed by description length:
/// one bit for each way that is known, and −log₂ of its share for each failure.
#[derive(Clone, Debug)]
pub(super) struct Beam {
    pub(super) best: Hypothesis,
    /// All others, best first.
    rivals: Vec<Hypothesis>,
    /// Number of moves of the walk when it was gone over again.
    checked: usize,
}

impl Beam {
    pub(super) fn new(first: Hypothesis) -> Self {
        Self {
            best: first,
            rivals: Vec::new(),
            checked: SHORT_WALK,
        }
    }

    /// Takes in the last move of a walk, which may have failed: each hypothesis goes on as two, of
    /// which one holds that the robot stayed. Returns whether any is left.
    pub(super) fn learn(&mut self, walk: &[BumpMove], failure: f64) -> bool {
        let next = self.branches(walk, failure);
        let mut next = kept(next);
        let best = least(&next);
        for hypothesis in &mut next {
            if hypothesis.bits < best + WINDOW / 2.0 {
                hypothesis.fold_in_time();
            }
        }
        if next
            .first()
            .is_none_or(|best| self.is_due(best, walk.len()))
        {
            self.checked = walk.len();
            next.extend(again(walk, failure, &self.best));
        }
        self.replace(next)
    }

    /// Returns whether it is time to go over the walk again: a quarter of it is new, or the best
    /// map just passed its test.
    fn is_due(&self, best: &Hypothesis, moves: usize) -> bool {
        let passes = best.foretold == TESTS * best.map().count();
        let late = moves > self.checked + self.checked / 4;
        best.is_folded() && (passes || late) && (best.untried() == 0) == passes
    }

    /// Returns what becomes of the hypotheses by the last move of a walk.
    fn branches(&mut self, walk: &[BumpMove], failure: f64) -> Vec<Hypothesis> {
        let Some(step) = walk.last().copied() else {
            return Vec::new();
        };
        let mut next = Vec::with_capacity(self.rivals.len() * 2 + 2);
        // The best of those that contradict their evidence alone.
        let mut doubted: Option<Hypothesis> = None;
        let rivals = core::mem::take(&mut self.rivals);
        let limit = self.best.bits + WINDOW;
        for went in [self.best.clone()].into_iter().chain(rivals) {
            let may_stay = step.moved && went.bits + failure < limit;
            let stayed = may_stay.then(|| went.that_failed(failure));
            let branches = stayed.into_iter().map(|stayed| (stayed, true));
            for (mut branch, stays) in branches.chain([(went, false)]) {
                match branch.take(step, stays) {
                    Taken::Agrees => next.push(branch),
                    Taken::ContradictsEvidence => {
                        if doubted.as_ref().is_none_or(|it| branch.bits < it.bits) {
                            doubted = Some(branch);
                        }
                    }
                    Taken::ContradictsWalk => {}
                }
            }
        }
        let best = least(&next);
        if let Some(mut doubted) = doubted.filter(|doubted| doubted.bits < best) {
            doubted.refold(doubted.map().count());
            next.push(doubted);
        }
        next
    }

    fn replace(&mut self, next: Vec<Hypothesis>) -> bool {
        let mut next = kept(next).into_iter();
        match next.next() {
            Some(best) => {
                (self.best, self.rivals) = (best, next.collect());
                true
            }
            None => false,
        }
    }

    /// Returns whether no rival gets by with one failure more: then it is known where the robot is,
    /// too.
    pub(super) fn is_sure(&self, failure: f64) -> bool {
        let rival = self.rivals.first();
        rival.is_none_or(|rival| rival.bits > self.best.bits + failure + 1.0)
    }

    /// Returns how likely all rivals are together that go back to before the last move that showed
    /// something new.
    pub(super) fn doubt(&self) -> f64 {
        let weights = self
            .old_rivals()
            .map(|it| libm::exp2(self.best.bits - it.bits));
        let others: f64 = weights.sum();
        others / (1.0 + others)
    }

    /// Returns the rivals that hold something else of the walk up to the last news.
    fn old_rivals(&self) -> impl Iterator<Item = &Hypothesis> {
        let news = self.best.news();
        let rivals = self.rivals.iter();
        rivals.filter(move |it| it.failed_until(news) != self.best.failed_until(news))
    }

    /// Returns the first move of the shortest walk that tells the best hypothesis from one of the
    /// likeliest old rivals. O(rivals · places).
    pub(super) fn telling(&self) -> Option<Direction> {
        let likeliest = self.old_rivals().next()?.bits;
        let rivals = self
            .old_rivals()
            .take_while(|it| it.bits <= likeliest + 1.0);
        let walks = rivals.filter_map(|rival| telling(&self.best, rival));
        walks
            .min_by_key(|(length, _)| *length)
            .map(|(_, first)| first)
    }
}

/// Returns the length and the first move of the shortest walk that tells two hypotheses apart:
/// whose last move goes where one has a way and the other a wall, or where only the rival knows.
fn telling(best: &Hypothesis, rival: &Hypothesis) -> Option<(usize, Direction)> {
    let start = (best.here(), rival.here());
    let mut seen = BTreeSet::from([start]);
    let mut queue = VecDeque::from([(start, 1, None)]);
    while let Some(((one, other), length, first)) = queue.pop_front() {
        for action in Direction::ALL {
            let begin = first.unwrap_or(action);
            match (best.map().way(one, action), rival.map().way(other, action)) {
                (_, BumpWay::Untried) | (BumpWay::Closed, BumpWay::Closed) => {}
                (BumpWay::To(next), BumpWay::To(with)) => {
                    if seen.insert((next, with)) {
                        queue.push_back(((next, with), length + 1, Some(begin)));
                    }
                }
                _ => return Some((length, begin)),
            }
        }
    }
    None
}

/// Returns the hypotheses about a whole walk that do without evidence until its end, and then are
/// folded.
fn again(walk: &[BumpMove], failure: f64, about: &Hypothesis) -> Vec<Hypothesis> {
    let mut beam = Beam::new(about.unmoved());
    for moves in 1..=walk.len() {
        let next = beam.branches(walk.get(..moves).unwrap_or_default(), failure);
        if !beam.replace(next) {
            return Vec::new();
        }
    }
    let mut all = vec![beam.best];
    all.append(&mut beam.rivals);
    for hypothesis in &mut all {
        hypothesis.refold(about.map().count());
    }
    all
}

/// Returns the best of these, each but once.
fn kept(mut next: Vec<Hypothesis>) -> Vec<Hypothesis> {
    next.sort_by(|one, other| one.bits.total_cmp(&other.bits));
    let best = least(&next);
    let mut seen = BTreeMap::new();
    let mut each: Vec<Hypothesis> = Vec::new();
    for hypothesis in next.into_iter().take_while(|it| it.bits < best + WINDOW) {
        match seen.entry(hypothesis.fingerprint()) {
            Entry::Vacant(entry) => {
                entry.insert(each.len());
                each.push(hypothesis);
            }
            Entry::Occupied(entry) => {
                if let Some(same) = each.get_mut(*entry.get()) {
                    same.foretold = same.foretold.max(hypothesis.foretold);
                }
            }
        }
    }
    each.truncate(WIDTH);
    each
}

fn least(hypotheses: &[Hypothesis]) -> f64 {
    let bits = hypotheses.iter().map(|hypothesis| hypothesis.bits);
    bits.fold(f64::INFINITY, f64::min)
}
