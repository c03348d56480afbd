//! The graph as plain data.

use alloc::vec::Vec;

use super::{Edge, Network};
use crate::error::check_count;
use crate::{Scalar, SnapshotError, UnitId};

/// The units and edges of a network at one moment.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NetworkSnapshot<S> {
    /// Number of features of an input.
    pub dimension: usize,
    /// The weights of the features in the squared distance, or `None` if all are 1.
    pub weights: Option<Vec<S>>,
    /// Id that the next unit will get.
    pub next_id: u32,
    /// All units, ascending by id.
    pub units: Vec<SnapshotUnit<S>>,
    /// All edges, each once.
    pub edges: Vec<Edge>,
}

/// A unit at one moment.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SnapshotUnit<S> {
    /// Id of the unit.
    pub id: UnitId,
    /// Features of the unit's prototype, in order.
    pub prototype: Vec<S>,
}

impl<S: Scalar> Network<S> {
    /// Returns a copy of the units and edges as they are now.
    pub fn snapshot(&self) -> NetworkSnapshot<S> {
        let unit = |slot| SnapshotUnit {
            id: self.ids[slot],
            prototype: self.values(slot).collect(),
        };
        NetworkSnapshot {
            dimension: self.dimension(),
            weights: self.weights().map(Into::into),
            next_id: self.next_id,
            units: self.slots().map(unit).collect(),
            edges: self.edges().collect(),
        }
    }

    /// Returns the network that the snapshot is a copy of; slots are units in order. Its events are
    /// not recorded.
    pub(crate) fn from_snapshot(snapshot: &NetworkSnapshot<S>) -> Result<Self, SnapshotError> {
        let mut network = match &snapshot.weights {
            Some(weights) => {
                check_count("weights", snapshot.dimension, weights.len())?;
                Self::weighted(weights)?
            }
            None => Self::new(snapshot.dimension)?,
        };
        for SnapshotUnit { id, prototype } in &snapshot.units {
            let id = *id;
            network
                .check_prototype(prototype)
                .map_err(|source| SnapshotError::BadPrototype { id, source })?;
            if id.0 < network.next_id || id.0 >= snapshot.next_id {
                return Err(SnapshotError::BadId {
                    id,
                    next_id: snapshot.next_id,
                });
            }
            network.next_id = id.0;
            network.insert(prototype);
        }
        network.next_id = snapshot.next_id;
        for Edge { ends, age } in &snapshot.edges {
            let bad = || SnapshotError::BadEdge { ends: *ends };
            let a = network.slot(ends.0).map_err(|_| bad())?;
            let b = network.slot(ends.1).map_err(|_| bad())?;
            if a == b || network.links.neighbours(a).any(|other| other == b) {
                return Err(bad());
            }
            network.link(a, b, *age);
        }
        Ok(network)
    }
}
