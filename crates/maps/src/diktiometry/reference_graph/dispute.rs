use tolman_geom::PointBox;

use super::Relation;

/// Estimates that contradict a relation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dispute {
    /// Intersection of those that agree with each other, m.
    rival: PointBox,
    /// Number of these.
    agreeing: u32,
    /// Number of all.
    against: u32,
}

impl Dispute {
    /// Returns the dispute of a first estimate.
    pub(super) const fn begun(estimate: PointBox) -> Self {
        Self {
            rival: estimate,
            agreeing: 1,
            against: 1,
        }
    }

    /// Takes in another estimate. One that agrees with no other is forgotten for the next.
    pub(super) fn join(&mut self, estimate: PointBox) {
        self.against = self.against.saturating_add(1);
        if let Some(both) = self.rival.intersection(estimate) {
            self.rival = both;
            self.agreeing = self.agreeing.saturating_add(1);
        } else if self.agreeing == 1 {
            self.rival = estimate;
        }
    }

    /// Puts the rival in the relation's place if it has more estimates, and the relation in the
    /// rival's. Returns whether it did.
    pub(super) fn settle(&mut self, relation: &mut Relation) -> bool {
        let agreeing = relation.estimates.saturating_sub(self.against);
        let is_outvoted = self.agreeing > agreeing;
        if is_outvoted {
            core::mem::swap(&mut relation.position, &mut self.rival);
            self.against = relation.estimates.saturating_sub(self.agreeing);
            self.agreeing = agreeing;
        }
        is_outvoted
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::Point;

    use super::super::ReferenceGraph;
    use super::*;

    /// Returns where a relation puts a frame after these estimates, each ± 0.1 m.
    fn related(estimates: &[f64], is_swapped: bool) -> f64 {
        let mut graph = ReferenceGraph::default();
        let mut ends = [0; 2].map(|_| graph.add_frame());
        if is_swapped {
            ends.reverse();
        }
        for at in estimates {
            let estimate = PointBox::about(Point::new(*at, 0.0), 0.1).unwrap();
            if graph.relate(ends[0], ends[1], estimate).is_err() {
                graph.dispute(ends[0], ends[1], estimate);
            }
        }
        graph.known(ends[0], ends[1]).unwrap().middle().x
    }

    #[test]
    fn a_relation_gives_way_to_more_that_agree_with_each_other() {
        for (estimates, expected) in [
            // An outlier at first, in the middle, and twice.
            (&[1.4, 1.0, 1.0][..], 1.0),
            (&[1.0, 1.4, 1.0], 1.0),
            (&[1.0, 1.4, 1.4, 1.4, 1.0, 1.0, 1.0], 1.0),
            // One against one decides nothing, nor do two outliers that disagree.
            (&[1.4, 1.0], 1.4),
            (&[1.0, 1.4, 0.6], 1.0),
            (&[1.4, 0.6, 1.0, 1.0], 1.0),
            // The older outlier is forgotten, and those in the majority are not outvoted.
            (&[1.0, 1.0, 1.4, 1.4], 1.0),
        ] {
            for is_swapped in [false, true] {
                let found = related(estimates, is_swapped);
                assert!((found - expected).abs() < 1e-9, "{estimates:?}: {found}");
            }
        }
    }
}
