use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use alloc::vec::Vec;

use super::map::{CpMap, End, Fragment, FragmentId, JunctionId, Port, PortState, Sign};
use super::similarity::Sense;

/// Maximum angle between two views of one place's ways, rad. It is less than a quarter circle, by
/// which the views from the three ends of a side way differ.
const MOST_APART: f64 = 1.0;

/// Fragments and junctions that were merged, each with the one that it became.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Merges {
    fragments: BTreeMap<FragmentId, (FragmentId, Sense)>,
    junctions: BTreeMap<JunctionId, (JunctionId, u32, u32)>,
}

impl Merges {
    /// Returns the end that an end has become by merges.
    #[must_use]
    pub(super) fn end(&self, mut end: End) -> End {
        while let Some((fragment, sense)) = self.fragments.get(&end.fragment) {
            end = fragment.end(sense.of(end.sign));
        }
        end
    }

    /// Returns whether a fragment has become another.
    fn is_gone(&self, fragment: FragmentId) -> bool {
        self.fragments.contains_key(&fragment)
    }

    /// Returns the port that a port has become by merges.
    #[must_use]
    pub(super) fn port(&self, mut port: Port) -> Port {
        while let Some((junction, offset, degree)) = self.junctions.get(&port.junction) {
            port = junction.port((port.number + offset) % degree);
        }
        port
    }
}

/// Answers whether two fragments may be one, the second walked in the given sense.
pub(super) type Agree<'a> = &'a dyn Fn(&Fragment, &Fragment, Sense) -> bool;

impl CpMap {
    /// Returns the map in which two fragments are one, with all consequences: "given that 𝔸₁ is
    /// approximately identical to 𝔸₂, then junc(𝔸₁⁺) = junc(𝔸₂⁺) and junc(𝔸₁⁻) = junc(𝔸₂⁻)", or +
    /// to − if they are similar inverted.
    ///
    /// "Those similar junctions must be *unified*": laid over each other, turned so that the
    /// fragment's ports meet. If both then have a fragment at a port, these two are one as well,
    /// and so on. If only one has one, the other gets it: both sub-cases of equations (9) and (10).
    /// The older fragments and junctions stay.
    ///
    /// `agree` is asked about all pairs but the first. O(fragments + junctions) and these
    /// questions.
    ///
    /// Returns `None` if it leads to a contradiction:
    ///
    /// - two junctions would be one that differ in their number of ports, bearings or landmark;
    /// - a junction would be itself, turned;
    /// - a fragment would be itself, inverted;
    /// - two fragments would lead out of one port that are not similar.
    pub(super) fn unified(
        &self,
        one: FragmentId,
        other: FragmentId,
        sense: Sense,
        agree: Agree<'_>,
    ) -> Option<(Self, Merges)> {
        let mut new = Unification {
            map: self.clone(),
            merges: Merges::default(),
            queue: Vec::new(),
        };
        new.merge(one, other, sense)?;
        while let Some((a, b)) = new.queue.pop() {
            let (a, b) = (new.merges.end(a), new.merges.end(b));
            let sense = Sense::between(a.sign, b.sign);
            let one = new.map.fragment(a.fragment)?;
            if a.fragment != b.fragment && !agree(one, new.map.fragment(b.fragment)?, sense) {
                return None;
            }
            new.merge(a.fragment, b.fragment, sense)?;
        }
        new.settle();
        Some((new.map, new.merges))
    }
}

struct Unification {
    map: CpMap,
    merges: Merges,
    /// Pairs of ends that meet at a port.
    queue: Vec<(End, End)>,
}

impl Unification {
    fn merge(&mut self, one: FragmentId, other: FragmentId, sense: Sense) -> Option<()> {
        let (kept, gone) = (one.min(other), one.max(other));
        if kept == gone {
            return (sense == Sense::Same).then_some(());
        }
        let survivor = self.map.fragment(kept)?.clone();
        let absorbed = self.map.fragment(gone)?.clone();
        let motion = absorbed.motion.map(|motion| sense.of_motion(motion));
        let motion = match (survivor.motion, motion) {
            (Some(a), Some(b)) => Some(a.intersection(b)?),
            (a, b) => a.or(b),
        };
        // Most that cannot be is found here, before anything is changed.
        for sign in Sign::BOTH {
            self.meet(survivor.port(sense.of(sign)), absorbed.port(sign))?;
        }
        self.map.fragments.remove(gone);
        self.map.index.remove(gone);
        self.merges.fragments.insert(gone, (kept, sense));
        if let Some(fragment) = self.map.fragments.get_mut(kept) {
            fragment.motion = motion;
            fragment.traversals = fragment.traversals.saturating_add(absorbed.traversals);
        }
        Some(())
    }

    /// Makes two ports one, and thus their junctions.
    fn meet(&mut self, a: Port, b: Port) -> Option<()> {
        let (a, b) = (self.merges.port(a), self.merges.port(b));
        let (kept, gone) = if a.junction <= b.junction {
            (a, b)
        } else {
            (b, a)
        };
        if kept.junction == gone.junction {
            return (kept.number == gone.number).then_some(());
        }
        let junctions = &mut self.map.junctions;
        let survivor = junctions.get(kept.junction)?;
        let absorbed = junctions.get(gone.junction)?;
        if survivor.sighting() != absorbed.sighting() {
            return None;
        }
        let degree = survivor.degree();
        let offset = (kept.number + degree - gone.number) % degree;
        if survivor.apart(offset, absorbed.bearings.as_ref()) > MOST_APART {
            return None;
        }
        let merged = (kept.junction, offset, degree);
        self.merges.junctions.insert(gone.junction, merged);
        let absorbed = junctions.remove(gone.junction)?;
        let survivor = junctions.get_mut(kept.junction)?;
        survivor.notice(offset, absorbed.bearings.as_ref());
        for (number, new) in (0..).zip(absorbed.ports) {
            let number: u32 = (number + offset) % degree;
            let Some(old) = survivor.ports.get_mut(number as usize) else {
                continue;
            };
            *old = match (*old, new) {
                (PortState::Filled(a), PortState::Filled(b)) => {
                    self.queue.push((a, b));
                    PortState::Filled(a)
                }
                (PortState::Filled(end), _) | (_, PortState::Filled(end)) => PortState::Filled(end),
                (PortState::Open { at_least: a }, PortState::Open { at_least: b }) => {
                    PortState::Open { at_least: a.max(b) }
                }
            };
        }
        Some(())
    }

    /// Replaces all names of ends and ports by those that remain.
    fn settle(&mut self) {
        for fragment in self.map.fragments.iter_mut() {
            let ends = [fragment.minus, fragment.plus];
            let [minus, plus] = ends.map(|port| self.merges.port(port));
            if ends != [minus, plus] {
                let fragment = Arc::make_mut(fragment);
                (fragment.minus, fragment.plus) = (minus, plus);
            }
        }
        for junction in self.map.junctions.iter_mut() {
            let gone = |port: &PortState| matches!(port, PortState::Filled(end) if self.merges.is_gone(end.fragment));
            if !junction.ports.iter().any(gone) {
                continue;
            }
            for port in &mut Arc::make_mut(junction).ports {
                if let PortState::Filled(end) = port {
                    *end = self.merges.end(*end);
                }
            }
        }
    }
}
