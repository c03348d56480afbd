use alloc::collections::{BTreeMap, BTreeSet};
use core::f64::consts::{PI, TAU};

use tolman_geom::{Interval, PointBox};

use super::bearings::wrapped;
use super::map::{CpMap, JunctionId, Port, Sign};

/// What dead reckoning has to say of a map. Ours, not the paper's, which only suggests it: "Another good choice is to add the
/// odometry data".
impl CpMap {
    /// Where junctions lie, seen from one of them: along the way on which the bounds grow least. Those that no reckoned way leads
    /// to are missing. O(fragments · junctions).
    pub(super) fn positions_from(&self, origin: JunctionId) -> BTreeMap<JunctionId, PointBox> {
        let mut reached = BTreeMap::from([(origin, PointBox::ORIGIN)]);
        let mut settled = BTreeSet::new();
        loop {
            let left = reached.iter().filter(|(id, _)| !settled.contains(*id));
            let next = left.min_by(|(_, a), (_, b)| a.width().total_cmp(&b.width()));
            let Some((&junction, &position)) = next else {
                return reached;
            };
            settled.insert(junction);
            for number in 0..self.degree(junction) {
                let exit = Port { junction, number };
                let Some((head, step)) = self.step(exit) else {
                    continue;
                };
                let position = position + step;
                let best = reached.entry(head).or_insert(position);
                if position.width() < best.width() {
                    *best = position;
                }
            }
        }
    }

    /// Where the junction beyond a port lies, seen from the port's.
    fn step(&self, exit: Port) -> Option<(JunctionId, PointBox)> {
        let end = self.end_at(exit)?;
        let displacement = self.fragment(end.fragment)?.motion?.displacement;
        let step = match end.sign {
            Sign::Minus => displacement,
            Sign::Plus => -displacement,
        };
        Some((self.beyond(exit)?.junction, step))
    }

    /// The direction in which one leaves by a port, if a fragment is known there and was reckoned.
    fn bearing(&self, port: Port) -> Option<Interval> {
        let end = self.end_at(port)?;
        let motion = self.fragment(end.fragment)?.motion?;
        Some(match end.sign {
            Sign::Minus => motion.departure,
            Sign::Plus => motion.reversed().departure,
        })
    }

    /// How unlikely it is that a port looks into some direction, given those of the junction's other ports: none if it cannot be, as
    /// bearings would not ascend with the ports' numbers; else a negative logarithm up to a constant, which is least where
    /// the ports are evenly spaced.
    pub(super) fn bearing_cost(&self, port: Port, bearing: Interval) -> Option<f64> {
        let degree = self.degree(port.junction);
        let (mut cost, mut before) = (0.0_f64, None);
        for offset in 1..degree {
            let number = (port.number + offset) % degree;
            let Some(known) = self.bearing(Port { number, ..port }) else {
                continue;
            };
            let slack = (bearing.width() + known.width()) / 2.0;
            if slack >= PI {
                continue;
            }
            let angle = wrapped(known.middle() - bearing.middle());
            let even = TAU * f64::from(offset) / f64::from(degree);
            let off = (angle - even).abs();
            let off = (off.min(TAU - off) - slack).max(0.0) / SPREAD;
            cost = cost.max(0.5 * off * off);
            if angle <= slack || angle >= TAU - slack {
                // It may lie on either side; two ports do not look into one direction.
                if slack < LEAST_ANGLE && angle.min(TAU - angle) + slack < LEAST_ANGLE {
                    return None;
                }
                continue;
            }
            if let Some((previous, width)) = before
                && angle + slack + width < previous
            {
                return None;
            }
            before = Some((angle, slack));
        }
        Some(cost)
    }
}

/// How unevenly ports are spaced, rad.
const SPREAD: f64 = 0.6;

/// No two ports of a junction are nearer to each other, rad.
const LEAST_ANGLE: f64 = 0.35;
