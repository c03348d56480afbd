//! Loop closures: finds places that are seen again.

use alloc::vec::Vec;

use tolman_geom::nalgebra::{Matrix3, Vector3};

use super::correlate::{self, Pyramid, Window};
use super::grid::LikelihoodGrid;
use super::mapper::{ScanMatching, ScanMatchingError};
use super::outline::ScanOutline;
use super::refine::{self, Prior};
use super::{ClosureConfig, ClosureSites};
use crate::pose_graph::{OptimizerConfig, PoseEdge, PoseEdgeKind, PoseGraph};

/// State of the search for closures while the robot drives.
#[derive(Clone, Debug, Default)]
pub(super) struct Closing {
    /// Length of the way at the last search, m.
    searched_at: f64,
    /// Length of the way at the last closure, m.
    closed_at: f64,
    /// Matches that become closures when another match agrees.
    waiting: Vec<Candidate>,
}

/// A match of the last keyframes to old ones.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    edge: PoseEdge,
    is_accepted: bool,
}

/// Window and threshold of the search for a match.
#[derive(Clone, Copy, Debug)]
struct Reach {
    window: f64,
    turn: f64,
}

/// Maximum number of old stretches that are tried, the nearest first.
const STRETCHES: usize = 3;
/// Margin beyond the window within which old keyframes are considered, m.
const SIGHT: f64 = 2.5;
/// Number of points of the last keyframes with which poses are searched, and with which the best is
/// refined.
const SEARCHED_POINTS: usize = 200;
const REFINED_POINTS: usize = 600;
/// Number of steps of the optimizer while the robot drives.
const STEPS_ON_THE_WAY: u32 = 3;
/// Number of iterations in each of these steps.
const ITERATIONS_ON_THE_WAY: usize = 150;
/// Squared error, in standard deviations, above which a closure corrects the map at once.
const OFF: f64 = 4.0;

impl ScanMatching {
    /// Searches for closures from the last keyframe, and corrects the map if it finds any.
    pub(super) fn close(&mut self) -> Result<(), ScanMatchingError> {
        let Some(config) = self.config.closures.clone() else {
            return Ok(());
        };
        let last = self.keyframes.len() - 1;
        let way = self.keyframes[last].way;
        let is_due = way - self.closing.searched_at >= config.every;
        if config.sites == ClosureSites::Named || !is_due {
            return Ok(());
        }
        self.closing.searched_at = way;
        let found = self.candidates(&config, last, self.reach(&config, last));
        self.accept(&config, found, way)?;
        Ok(())
    }

    /// Matches the keyframes up to `here` with those about `there`, and returns whether they match.
    /// They count as the same place if an earlier or later match agrees. Returns `false` if the
    /// configuration has no closures, or there are no such keyframes.
    ///
    /// # Errors
    /// If a measurement does not fit the graph.
    pub fn recognize(&mut self, here: usize, there: usize) -> Result<bool, ScanMatchingError> {
        let Some(config) = self.config.closures.clone() else {
            return Ok(false);
        };
        if here >= self.keyframes.len() || there >= here {
            return Ok(false);
        }
        let reach = self.reach(&config, here);
        let query = self.put_together(
            (here + 1).saturating_sub(config.query_keyframes),
            here,
            here,
        );
        let found = self.closure(&config, &query, here, there, reach);
        let matches = found.is_some();
        self.accept(&config, found, self.keyframes[here].way)?;
        Ok(matches)
    }

    /// Returns the maximum distance of a keyframe from its pose on the map, m: the window in which
    /// places are searched.
    #[must_use]
    pub fn doubt(&self, keyframe: usize) -> f64 {
        let config = self.config.closures.as_ref();
        let known = config.filter(|_| keyframe < self.keyframes.len());
        known.map_or(0.0, |config| self.reach(config, keyframe).window)
    }

    /// Returns the window in which places are searched from a keyframe.
    fn reach(&self, config: &ClosureConfig, keyframe: usize) -> Reach {
        let since = self.keyframes[keyframe].way - self.closing.closed_at;
        let since = since.max(0.0);
        Reach {
            window: (config.window + config.window_growth * since).min(config.most_window),
            turn: (config.window_turn + config.window_turn_growth * since)
                .min(config.most_window_turn),
        }
    }

    /// Turns matches into closures if another match agrees with them. Corrects the map if it is far
    /// off.
    fn accept(
        &mut self,
        config: &ClosureConfig,
        found: impl IntoIterator<Item = PoseEdge>,
        way: f64,
    ) -> Result<(), ScanMatchingError> {
        let before = self.graph.edges().len();
        let mut is_closed = false;
        for candidate in found {
            is_closed |= self.weigh(config, candidate)?;
        }
        if is_closed {
            self.closing.closed_at = way;
        }
        let mut added = before..self.graph.edges().len();
        let is_off = |edge| self.graph.squared_error(edge) > Some(OFF);
        if added.any(is_off) {
            self.graph.optimize(&OptimizerConfig {
                most_steps: STEPS_ON_THE_WAY,
                most_iterations: ITERATIONS_ON_THE_WAY,
                ..optimizer(config)
            });
        }
        Ok(())
    }

    /// Searches all closures again on the present map, and corrects the map with them. It stops
    /// when it finds the same closures twice, or after the maximum number of rounds. After that the
    /// map does not change any more.
    ///
    /// # Errors
    /// If a measurement does not fit the graph.
    pub fn finish(&mut self) -> Result<(), ScanMatchingError> {
        let Some(config) = self.config.closures.clone() else {
            return Ok(());
        };
        self.graph.optimize(&optimizer(&config));
        if config.sites == ClosureSites::Named {
            return Ok(());
        }
        for _ in 0..config.most_rounds {
            let before = self.closed();
            self.close_again(&config)?;
            if self.closed() == before {
                break;
            }
        }
        Ok(())
    }

    /// Replaces all closures by these, as they were audited, and optimizes the map.
    ///
    /// # Errors
    /// If one of them does not fit the graph.
    pub fn close_by(
        &mut self,
        closures: impl IntoIterator<Item = PoseEdge>,
    ) -> Result<(), ScanMatchingError> {
        let mut graph = self.without_closures()?;
        for edge in closures {
            graph.add_edge(edge)?;
        }
        let config = self.config.closures.clone();
        graph.optimize(&optimizer(&config.unwrap_or_else(ClosureConfig::indoor)));
        self.graph = graph;
        Ok(())
    }

    /// Returns the graph with its odometry alone.
    fn without_closures(&self) -> Result<PoseGraph, ScanMatchingError> {
        let mut graph = PoseGraph::new();
        for pose in self.graph.poses() {
            graph.add_pose(*pose);
        }
        let edges = self.graph.edges().iter();
        for edge in edges.filter(|edge| edge.kind == PoseEdgeKind::Odometry) {
            graph.add_edge(*edge)?;
        }
        Ok(graph)
    }

    /// Returns the pairs of keyframes that closures join.
    fn closed(&self) -> Vec<[u32; 2]> {
        let closures = self.graph.closures();
        closures.map(|edge| [edge.from, edge.to]).collect()
    }

    fn close_again(&mut self, config: &ClosureConfig) -> Result<(), ScanMatchingError> {
        let reach = Reach {
            window: config.window,
            turn: config.window_turn,
        };
        let mut graph = self.without_closures()?;
        let mut searched_at = 0.0;
        for last in 1..self.keyframes.len() {
            let way = self.keyframes[last].way;
            if way - searched_at < config.every {
                continue;
            }
            searched_at = way;
            for edge in self.candidates(config, last, reach) {
                graph.add_edge(edge)?;
            }
        }
        graph.optimize(&optimizer(config));
        self.graph = graph;
        Ok(())
    }

    /// Accepts a match as a closure if another agrees with it, and returns whether it did.
    fn weigh(&mut self, config: &ClosureConfig, edge: PoseEdge) -> Result<bool, ScanMatchingError> {
        let way = |keyframe: u32| self.keyframes[keyframe as usize].way;
        let now = way(edge.to);
        self.closing.waiting.retain(|other| {
            now - self.keyframes[other.edge.to as usize].way <= config.agreement_way
        });
        let poses = self.graph.poses();
        let seen = |edge: &PoseEdge| poses[edge.from as usize].compose(edge.measured);
        let agrees = |other: &Candidate| {
            let between = poses[other.edge.to as usize].between(poses[edge.to as usize]);
            let off = seen(&other.edge).compose(between).between(seen(&edge));
            other.edge.to != edge.to
                && off.position.coords.norm() < config.agreement
                && off.heading.radians().abs() < config.agreement_turn
        };
        let agreeing: Vec<usize> = (self.closing.waiting.iter().enumerate())
            .filter_map(|(place, other)| agrees(other).then_some(place))
            .collect();
        for place in &agreeing {
            let other = &mut self.closing.waiting[*place];
            if !other.is_accepted {
                other.is_accepted = true;
                self.graph.add_edge(other.edge)?;
            }
        }
        let is_accepted = !agreeing.is_empty();
        if is_accepted {
            self.graph.add_edge(edge)?;
        }
        self.closing.waiting.push(Candidate { edge, is_accepted });
        Ok(is_accepted)
    }

    /// Returns the matches of the keyframes up to `last` to old ones.
    fn candidates(&self, config: &ClosureConfig, last: usize, reach: Reach) -> Vec<PoseEdge> {
        let stretches = self.stretches(config, last, reach);
        if stretches.is_empty() {
            return Vec::new();
        }
        let query = self.put_together(last.saturating_sub(config.query_keyframes - 1), last, last);
        let stretches = stretches.into_iter();
        stretches
            .filter_map(|old| self.closure(config, &query, last, old, reach))
            .collect()
    }

    /// Returns keyframes as one outline, seen from one of them.
    pub(super) fn put_together(&self, first: usize, last: usize, from: usize) -> ScanOutline {
        let poses = self.graph.poses();
        let mut together = ScanOutline::default();
        for index in first..=last {
            let pose = poses[from].between(poses[index]);
            together.add(&self.keyframes[index].outline, pose);
        }
        together
    }

    /// Returns old keyframes near the last one, the nearest of each stretch of the way.
    fn stretches(&self, config: &ClosureConfig, last: usize, reach: Reach) -> Vec<usize> {
        let poses = self.graph.poses();
        let here = poses[last].position;
        let way = self.keyframes[last].way;
        let mut nearest: Vec<(f64, usize)> = Vec::new();
        let mut open: Option<(f64, usize, usize)> = None;
        for (index, keyframe) in self.keyframes[..last].iter().enumerate() {
            if way - keyframe.way < config.least_way {
                break;
            }
            let off = (poses[index].position - here).norm();
            if off > reach.window + SIGHT {
                continue;
            }
            open = match open {
                Some((best, at, end)) if index - end <= config.old_keyframes / 2 => {
                    let (best, at) = if off < best { (off, index) } else { (best, at) };
                    Some((best, at, index))
                }
                other => {
                    nearest.extend(other.map(|(best, at, _)| (best, at)));
                    Some((off, index, index))
                }
            };
        }
        nearest.extend(open.map(|(best, at, _)| (best, at)));
        nearest.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        nearest
            .into_iter()
            .take(STRETCHES)
            .map(|(_, at)| at)
            .collect()
    }

    /// Compares the last keyframes with those near `old`.
    fn closure(
        &self,
        config: &ClosureConfig,
        query: &ScanOutline,
        last: usize,
        old: usize,
        reach: Reach,
    ) -> Option<PoseEdge> {
        let poses = self.graph.poses();
        let half = config.old_keyframes / 2;
        let end = (old + half).min(last.saturating_sub(config.query_keyframes));
        let range = old.saturating_sub(half)..end.max(old) + 1;
        let outlines = self.keyframes[range.clone()]
            .iter()
            .map(|keyframe| &keyframe.outline);
        let mut grid = LikelihoodGrid::default();
        grid.draw(
            &self.stamp,
            outlines.zip(poses[range].iter().copied()),
            reach.window,
        );
        let pyramid = Pyramid::of(&grid, reach.window);
        let window = Window {
            reach: reach.window,
            turn: reach.turn,
            prior: 0.05,
            prior_turn: 0.05,
        };
        let expected = poses[last];
        let found = correlate::best(
            &grid,
            &pyramid,
            &query.thinned(SEARCHED_POINTS),
            expected,
            window,
        )?;
        let sd = reach.window.max(0.3);
        let turn_sd = reach.turn.max(0.1);
        let sure = Vector3::new(sd * sd, sd * sd, turn_sd * turn_sd);
        let prior = Prior {
            pose: found,
            information: Matrix3::from_diagonal(&sure.map(|variance| 1.0 / variance)),
        };
        let refined = refine::refine(
            &grid,
            &query.thinned(REFINED_POINTS),
            found,
            &prior,
            self.config.kernel,
        );
        if refined.score < config.least_score {
            return None;
        }
        let information = bounded(refined.information + prior.information, config)?;
        Some(PoseEdge {
            from: old as u32,
            to: last as u32,
            measured: poses[old].between(refined.pose),
            information,
            kind: PoseEdgeKind::Closure,
        })
    }
}

/// Returns the information of a match, limited to the certainty that closures may have.
fn bounded(information: Matrix3<f64>, config: &ClosureConfig) -> Option<Matrix3<f64>> {
    let (sd, turn_sd) = (config.sd, config.turn_sd);
    let least = Vector3::new(sd * sd, sd * sd, turn_sd * turn_sd);
    let covariance = information.try_inverse()? + Matrix3::from_diagonal(&least);
    let bounded = covariance.try_inverse()?;
    Some((bounded + bounded.transpose()) * 0.5)
}

fn optimizer(config: &ClosureConfig) -> OptimizerConfig {
    OptimizerConfig {
        doubt: Some(config.doubt),
        ..OptimizerConfig::plain()
    }
}
