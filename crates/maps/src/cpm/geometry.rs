use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;
use core::f64::consts::{PI, TAU};
use core::mem::replace;

use tolman_geom::{Interval, PointBox};

use super::bearings::wrapped;
use super::map::{CpMap, JunctionId, Port, PortState, Sign};

/// Geometry of a map by dead reckoning. Ours; the paper only suggests it: "Another good choice is
/// to add the odometry data".
impl CpMap {
    /// Returns the position of each junction, by id, relative to `origin`: along the way on which
    /// the bounds grow least (Dijkstra 1959). `None` if no way with dead reckoning leads there.
    /// O(ports · log junctions).
    pub(super) fn positions_from(&self, origin: JunctionId) -> Vec<Option<PointBox>> {
        let mut positions = vec![None; self.junctions.len()];
        let mut settled = vec![false; self.junctions.len()];
        let mut open = BinaryHeap::new();
        // Widths are not negative, so that their bits are in their order.
        let nearest_first = |rank, position: PointBox| Reverse((position.width().to_bits(), rank));
        if let Some(rank) = self.junctions.rank(origin) {
            positions[rank] = Some(PointBox::ORIGIN);
            open.push(nearest_first(rank, PointBox::ORIGIN));
        }
        while let Some(Reverse((_, rank))) = open.pop() {
            let Some(position) = positions[rank] else {
                continue;
            };
            if replace(&mut settled[rank], true) {
                continue;
            }
            for port in self.ports_at(rank) {
                let Some((head, step)) = self.step(*port) else {
                    continue;
                };
                let position = position + step;
                if positions[head].is_none_or(|best| position.width() < best.width()) {
                    positions[head] = Some(position);
                    open.push(nearest_first(head, position));
                }
            }
        }
        positions
    }

    /// Returns the junction beyond a port, by its rank, and its position relative to the port's
    /// junction.
    fn step(&self, port: PortState) -> Option<(usize, PointBox)> {
        let PortState::Filled(end) = port else {
            return None;
        };
        let fragment = self.fragment(end.fragment)?;
        let displacement = fragment.motion?.displacement;
        let head = fragment.port(end.sign.opposite()).junction;
        let step = match end.sign {
            Sign::Minus => displacement,
            Sign::Plus => -displacement,
        };
        Some((self.junctions.rank(head)?, step))
    }

    /// Returns the direction in which a robot leaves by a port, or `None` without dead reckoning
    /// there.
    fn bearing(&self, port: Port) -> Option<Interval> {
        let end = self.end_at(port)?;
        let motion = self.fragment(end.fragment)?.motion?;
        Some(match end.sign {
            Sign::Minus => motion.departure,
            Sign::Plus => motion.reversed().departure,
        })
    }

    /// Returns the cost of a port looking into direction `bearing`, given the junction's other
    /// ports. The cost is a negative log-probability up to a constant, least when ports are evenly
    /// spaced. `None` if it is impossible, as bearings would not ascend with the ports' numbers.
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

/// Standard deviation of the spacing of ports, rad.
const SPREAD: f64 = 0.6;

/// Minimum angle between two ports of a junction, rad.
const LEAST_ANGLE: f64 = 0.35;
