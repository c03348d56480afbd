use tolman_geom::Pose;
use tolman_robot::{PoseRelation, Trajectory};

/// Errors of a trajectory by known relations between its poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelationScore {
    /// Number of relations whose two times lie on the trajectory.
    pub relations: usize,
    /// Number of relations whose times do not, which count nowhere.
    pub missed: usize,
    /// Mean error of the second pose's position relative to the first's, m.
    pub error: f64,
    /// Mean error of the heading, rad.
    pub turn_error: f64,
    /// Number of relations whose times lie more than [`FAR`](Self::FAR) apart.
    pub far_relations: usize,
    /// Mean position error over those alone, m; `None` if there are none.
    pub far_error: Option<f64>,
}

impl RelationScore {
    /// Time above which two poses count as far apart, s: the robot has left and come back in
    /// between.
    pub const FAR: f64 = 30.0;

    /// Returns the score of a trajectory; `None` if no relation lies on it. O(relations · log
    /// poses).
    #[must_use]
    pub fn of(trajectory: &Trajectory, relations: &[PoseRelation]) -> Option<Self> {
        let mut all = Means::default();
        let mut far = Means::default();
        for relation in relations {
            let ends = trajectory.at(relation.from).zip(trajectory.at(relation.to));
            let Some((from, to)) = ends else { continue };
            let off = relation.seen.between(from.between(to));
            all.add(off);
            if (relation.to - relation.from).abs() > Self::FAR {
                far.add(off);
            }
        }
        (all.count > 0).then(|| Self {
            relations: all.count,
            missed: relations.len() - all.count,
            error: all.distance / all.count as f64,
            turn_error: all.turn / all.count as f64,
            far_relations: far.count,
            far_error: (far.count > 0).then(|| far.distance / far.count as f64),
        })
    }
}

#[derive(Default)]
struct Means {
    count: usize,
    distance: f64,
    turn: f64,
}

impl Means {
    fn add(&mut self, off: Pose) {
        self.count += 1;
        self.distance += off.position.coords.norm();
        self.turn += off.heading.radians().abs();
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Heading, Point};
    use tolman_robot::TimedPose;

    use super::*;

    #[test]
    fn a_relation_off_by_a_metre_counts_a_metre() {
        let at = |time: f64| TimedPose {
            time,
            pose: Pose::new(Point::new(time, 0.0), Heading::EAST),
        };
        let way = Trajectory::new((0..=100).map(|time| at(f64::from(time))));
        let seen = |x| Pose::new(Point::new(x, 0.0), Heading::EAST);
        let relation = |from, to, seen| PoseRelation { from, to, seen };
        let relations = [
            relation(1.0, 2.0, seen(1.0)),
            relation(1.5, 41.5, seen(41.0)),
            relation(1.0, 200.0, seen(0.0)),
        ];
        let score = RelationScore::of(&way, &relations).unwrap();
        assert_eq!(
            (score.relations, score.missed, score.far_relations),
            (2, 1, 1)
        );
        assert!((score.error - 0.5).abs() < 1e-9);
        assert!((score.far_error.unwrap() - 1.0).abs() < 1e-9);
        assert_eq!(RelationScore::of(&way, &relations[2..]), None);
    }
}
