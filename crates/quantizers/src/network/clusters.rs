//! Connected components.

use alloc::vec;
use alloc::vec::Vec;

use super::Network;
use crate::{Scalar, UnitId, UnknownUnit};

/// Cluster of each unit. A *cluster* is a connected component of the graph. Clusters are numbered
/// from 0 in the order of their smallest ids.
///
/// ```
/// use tolman_quantizers::{Gng, GngConfig, Quantizer};
///
/// // Points on two rings.
/// let mut config = GngConfig::default();
/// config.max_units = 40;
/// let mut gng = Gng::<f64>::new(2, config)?;
/// for step in 0..20_000_u32 {
///     let angle = f64::from(step) * 0.7;
///     let centre = if step % 2 == 0 { -2.0 } else { 2.0 };
///     gng.observe(&[centre + angle.cos(), angle.sin()])?;
/// }
/// let clusters = gng.network().clusters();
/// let [left, right] = [[-3.0, 0.0], [3.0, 0.0]].map(|point| gng.nearest(&point).unwrap().id);
/// assert_eq!(clusters.count(), 2);
/// assert_ne!(clusters.label(left)?, clusters.label(right)?);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Clusters {
    /// Cluster of each unit, ascending by unit id.
    labels: Vec<(UnitId, u32)>,
    count: u32,
}

impl Clusters {
    /// Returns the number of clusters.
    pub fn count(&self) -> usize {
        self.count as usize
    }

    /// Returns the number of a unit's cluster.
    ///
    /// # Errors
    /// If the unit did not exist when the clusters were computed.
    pub fn label(&self, id: UnitId) -> Result<u32, UnknownUnit> {
        self.labels
            .binary_search_by_key(&id, |(id, _)| *id)
            .map(|place| self.labels[place].1)
            .map_err(|_| UnknownUnit(id))
    }

    /// Returns all units, ascending, each with the number of its cluster.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (UnitId, u32)> + '_ {
        self.labels.iter().copied()
    }
}

impl<S: Scalar> Network<S> {
    /// Returns the connected components of the graph as it is now.
    ///
    /// ```
    /// use tolman_quantizers::{Gng, GngConfig, Quantizer};
    ///
    /// let mut gng = Gng::<f64>::new(1, GngConfig::default())?;
    /// gng.observe(&[0.0])?;
    /// gng.observe(&[1.0])?;
    /// let clusters = gng.network().clusters();
    /// assert_eq!(clusters.count(), 1);
    /// let unit = gng.nearest(&[0.9])?.id;
    /// assert_eq!(clusters.label(unit)?, 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Complexity
    /// Units + edges.
    pub fn clusters(&self) -> Clusters {
        const NONE: u32 = u32::MAX;
        let mut label_of_slot = vec![NONE; self.ids.len()];
        let mut count = 0;
        let mut open = Vec::new();
        for start in self.slots() {
            if label_of_slot[start] != NONE {
                continue;
            }
            label_of_slot[start] = count;
            open.push(start);
            while let Some(slot) = open.pop() {
                for other in self.links.neighbours(slot) {
                    if label_of_slot[other] == NONE {
                        label_of_slot[other] = count;
                        open.push(other);
                    }
                }
            }
            count += 1;
        }
        let labels = self
            .slots()
            .map(|slot| (self.ids[slot], label_of_slot[slot]))
            .collect();
        Clusters { labels, count }
    }
}
