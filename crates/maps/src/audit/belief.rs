//! Finds the believed closures: the greatest set in which each has a witness among the others.

use alloc::vec::Vec;

use super::AuditConfig;
use super::chain::Chain;
use super::consistency::{ByOdometry, Pairs};
use super::link::{Gap, Link};
use super::search::Search;
use super::way::Way;

/// Maximum number of rounds in which closures are believed or dropped again.
const MOST_ROUNDS: u32 = 6;

/// Maximum number of a group's members that are compared with what is believed before it.
const PROBED: usize = 40;

/// State of an audit in progress.
pub(super) struct Belief<'a> {
    pub(super) links: &'a [Link],
    pub(super) chain: &'a Chain,
    pub(super) config: &'a AuditConfig,
    pub(super) by_odometry: &'a [ByOdometry],
    pub(super) search: Search,
    pub(super) believed: Vec<bool>,
    /// Surest way of each closure at the last search, and the closure's gap from it.
    pub(super) found: Vec<Option<(Way, Gap)>>,
    /// For each closure, the closures whose ways lead or led over it.
    users: Vec<Vec<u32>>,
}

impl<'a> Belief<'a> {
    pub(super) fn new(
        links: &'a [Link],
        chain: &'a Chain,
        config: &'a AuditConfig,
        by_odometry: &'a [ByOdometry],
    ) -> Self {
        let is_open: Vec<bool> = by_odometry
            .iter()
            .map(|by| *by != ByOdometry::Refutes)
            .collect();
        Self {
            search: Search::new(links, &is_open, chain),
            believed: alloc::vec![false; links.len()],
            found: alloc::vec![None; links.len()],
            users: alloc::vec![Vec::new(); links.len()],
            links,
            chain,
            config,
            by_odometry,
        }
    }

    /// Searches the surest way again and returns the closure's gap from it.
    fn look(&mut self, link: u32) -> Option<Gap> {
        let way = self.search.way(link, self.links, &self.believed, &[]);
        let found = way.map(|way| {
            let gap = way.gap(&self.links[link as usize], self.links, self.chain);
            (way, gap)
        });
        for over in found.iter().flat_map(|(way, _)| way.closures()) {
            self.users[over as usize].push(link);
        }
        let gap = found.as_ref().map(|(_, gap)| *gap);
        self.found[link as usize] = found;
        gap
    }

    fn is_supported(&mut self, link: u32) -> bool {
        let gap = self.look(link);
        gap.is_some_and(|gap| gap.supports(self.config))
    }

    /// Believes the closures of groups that agree, the largest group first, and drops those without
    /// a witness, until nothing changes.
    pub(super) fn settle(&mut self, pairs: &Pairs) {
        for _ in 0..MOST_ROUNDS {
            let before = self.open(true).len();
            let is_candidate: Vec<bool> = (0..self.links.len())
                .map(|link| self.is_candidate(link))
                .collect();
            let groups = pairs.groups(&is_candidate, self.by_odometry);
            let (broad, single): (Vec<_>, Vec<_>) =
                groups.into_iter().partition(|group| self.is_broad(group));
            // Groups of several runs can bear witness to each other; those of single runs have to
            // fit what is settled by then.
            self.take_in(&broad);
            self.take_in(&single);
            if self.open(true).len() <= before {
                break;
            }
        }
        self.drop_contested();
        self.refresh();
    }

    /// Drops closures contested by a way that shares no run with their witness. Then believes those
    /// again that have a witness now: closures that support only each other have none.
    fn drop_contested(&mut self) {
        let believed = self.open(true).into_iter();
        let contested: Vec<u32> = believed.filter(|link| self.is_contested(*link)).collect();
        if contested.is_empty() {
            return;
        }
        for link in contested {
            self.believed[link as usize] = false;
        }
        self.come_to_rest();
    }

    fn is_contested(&mut self, link: u32) -> bool {
        let Some((way, _)) = &self.found[link as usize] else {
            return false;
        };
        let shunned: Vec<u32> = way.closures().collect();
        let (links, believed) = (self.links, &self.believed);
        let other = self.search.way(link, links, believed, &shunned);
        other.is_some_and(|way| {
            let gap = way.gap(&links[link as usize], links, self.chain);
            gap.refutes(self.config)
        })
    }

    /// Returns whether no evidence contradicts a closure that is not believed.
    fn is_candidate(&self, link: usize) -> bool {
        let found = self.found[link].as_ref();
        let refuted = found.is_some_and(|(_, gap)| gap.refutes(self.config));
        self.by_odometry[link] != ByOdometry::Refutes && !self.believed[link] && !refuted
    }

    fn take_in(&mut self, groups: &[Vec<u32>]) {
        let before = self.believed.clone();
        for group in groups {
            if self.can_last(group) && self.fits(group) {
                for link in group {
                    self.believed[*link as usize] = true;
                }
            }
        }
        // What was settled before is not asked while others may yet fall.
        let new = self.open(true).into_iter();
        let new: Vec<u32> = new.filter(|link| !before[*link as usize]).collect();
        if !new.is_empty() {
            self.drop_unwitnessed(new);
            self.come_to_rest();
        }
    }

    /// Returns whether a group consists of more than one run.
    fn is_broad(&self, group: &[u32]) -> bool {
        let run = |link: &u32| self.links[*link as usize].run;
        group.iter().any(|link| run(link) != run(&group[0]))
    }

    /// Returns whether a group has more than one member, or one that odometry supports.
    fn can_last(&self, group: &[u32]) -> bool {
        group.len() > 1 || self.by_odometry[group[0] as usize] == ByOdometry::Supports
    }

    /// Returns whether at most three in ten of a group's members lie beyond the bounds of what is
    /// believed.
    fn fits(&mut self, group: &[u32]) -> bool {
        let (mut for_it, mut against) = (0, 0);
        for link in group.iter().take(PROBED) {
            match self.look(*link) {
                Some(gap) if gap.agrees(self.config) => for_it += 1,
                Some(_) => against += 1,
                None => {}
            }
        }
        10 * against <= 3 * (for_it + against)
    }

    /// Believes and drops closures until exactly those are believed that have a witness among the
    /// others.
    fn come_to_rest(&mut self) {
        for _ in 0..MOST_ROUNDS {
            let all = self.open(true);
            self.drop_unwitnessed(all);
            if !self.grow() {
                return;
            }
        }
        let all = self.open(true);
        self.drop_unwitnessed(all);
    }

    /// Searches again for ways that led over closures no longer believed.
    fn refresh(&mut self) {
        for link in self.open(false) {
            let way = self.found[link as usize].as_ref();
            let holds =
                way.is_some_and(|(way, _)| way.closures().all(|over| self.believed[over as usize]));
            if !holds {
                self.look(link);
            }
        }
    }

    /// Returns the closures that odometry does not refute and that are believed, or are not.
    fn open(&self, believed: bool) -> Vec<u32> {
        let of = |link: &u32| {
            let link = *link as usize;
            self.by_odometry[link] != ByOdometry::Refutes && self.believed[link] == believed
        };
        (0..self.links.len() as u32).filter(of).collect()
    }

    /// Computes the greatest fixed point: drops all closures without a witness at once, and
    /// searches again for those whose way led over them.
    fn drop_unwitnessed(&mut self, mut asked: Vec<u32>) {
        while !asked.is_empty() {
            let mut dropped = Vec::new();
            for link in asked {
                if !self.is_supported(link) {
                    dropped.push(link);
                }
            }
            for link in &dropped {
                self.believed[*link as usize] = false;
            }
            asked = Vec::new();
            for link in dropped {
                asked.append(&mut self.users[link as usize]);
            }
            asked.retain(|link| self.believed[*link as usize]);
            asked.sort_unstable();
            asked.dedup();
        }
    }

    /// Believes all closures that have a witness now, and returns whether there was one.
    fn grow(&mut self) -> bool {
        let mut grew = false;
        for link in self.open(false) {
            if self.is_supported(link) {
                self.believed[link as usize] = true;
                grew = true;
            }
        }
        grew
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::nalgebra::Matrix3;
    use tolman_geom::{Heading, Point, Pose};

    use super::super::link::links;
    use super::*;
    use crate::pose_graph::{PoseEdge, PoseEdgeKind, PoseGraph};

    fn edge(from: u32, to: u32, metres: f64, kind: PoseEdgeKind) -> PoseEdge {
        PoseEdge {
            from,
            to,
            measured: Pose::new(Point::new(metres, 0.0), Heading::EAST),
            information: Matrix3::identity() * 2500.0,
            kind,
        }
    }

    /// Returns a way straight ahead with `right` closures that agree with it, and then `wrong` ones
    /// that are two metres off. Each is a run of its own.
    fn straight(right: u32, wrong: u32) -> PoseGraph {
        let count = 5 * (right + wrong) + 8;
        let mut graph = PoseGraph::new();
        for _ in 0..=count {
            graph.add_pose(Pose::IDENTITY);
        }
        for to in 1..=count {
            let step = edge(to - 1, to, 1.0, PoseEdgeKind::Odometry);
            graph.add_edge(step).unwrap();
        }
        for number in 0..right + wrong {
            let metres = if number < right { 7.0 } else { 9.0 };
            let closure = edge(5 * number, 5 * number + 7, metres, PoseEdgeKind::Closure);
            graph.add_edge(closure).unwrap();
        }
        graph
    }

    #[test]
    fn a_group_fits_if_at_most_three_of_ten_do_not() {
        let config = AuditConfig::standard();
        for (right, wrong, fits) in [
            (4, 0, true),
            (3, 1, true),
            (2, 2, false),
            (8, 2, true),
            (7, 3, true),
            (6, 4, false),
            (14, 6, true),
            (13, 7, false),
            (0, 1, false),
        ] {
            let graph = straight(right, wrong);
            let chain = Chain::of(&graph, &config).unwrap();
            let links = links(&graph, &chain, &config);
            let by_odometry = alloc::vec![ByOdometry::Silent; links.len()];
            let mut belief = Belief::new(&links, &chain, &config, &by_odometry);
            let group: Vec<u32> = (0..right + wrong).collect();
            assert_eq!(belief.fits(&group), fits, "{right} {wrong}");
        }
    }

    #[test]
    fn a_single_closure_lasts_only_if_odometry_supports_it() {
        let config = AuditConfig::standard();
        let graph = straight(3, 0);
        let chain = Chain::of(&graph, &config).unwrap();
        let links = links(&graph, &chain, &config);
        let by_odometry = [ByOdometry::Silent, ByOdometry::Supports, ByOdometry::Silent];
        let belief = Belief::new(&links, &chain, &config, &by_odometry);
        let lasts = [&[0][..], &[1], &[0, 2], &[0, 1, 2]].map(|group| belief.can_last(group));
        assert_eq!(lasts, [false, true, true, true]);
        // One drive of closures is one run.
        let broad = [&[0][..], &[0, 1], &[2]].map(|group| belief.is_broad(group));
        assert_eq!(broad, [false, false, false]);
    }

    #[test]
    fn closures_that_contradict_each_other_are_no_run() {
        let config = AuditConfig::standard();
        let graph = straight(1, 1);
        let chain = Chain::of(&graph, &config).unwrap();
        let links = links(&graph, &chain, &config);
        let belief = Belief::new(&links, &chain, &config, &[ByOdometry::Silent; 2]);
        assert!(belief.is_broad(&[0, 1]));
    }
}
