use alloc::vec::Vec;
use core::hash::Hasher;

use fnv::FnvHasher;

use super::{JournalSpan, LookEvidence, MergeCertificate, MergeProof, WindingEvidence};
use crate::diktiometry::Action;

/// A checksum of numbers: FNV-1a, 64 bits (Fowler, Noll and Vo). It detects accidental changes, and
/// does not protect against manipulation.
struct Seal(FnvHasher);

impl Seal {
    fn take(&mut self, number: u64) {
        self.0.write(&number.to_le_bytes());
    }

    fn take_all(&mut self, numbers: impl IntoIterator<Item = usize>) {
        numbers
            .into_iter()
            .for_each(|number| self.take(number as u64));
    }

    fn take_routes(&mut self, routes: &[Vec<JournalSpan>]) {
        self.take_all([routes.len()]);
        for route in routes {
            self.take_all([route.len()]);
            let ends = route
                .iter()
                .flat_map(|JournalSpan { begin, end }| [*begin, *end]);
            self.take_all(ends);
        }
    }
}

impl MergeCertificate {
    /// Returns the certificate of a proof, sealed.
    pub(super) fn sealed(visits: [usize; 2], proof: MergeProof, rests_on_looks: bool) -> Self {
        let mut certificate = Self {
            visits,
            proof,
            rests_on_looks,
            seal: 0,
        };
        certificate.seal = certificate.checksum();
        certificate
    }

    /// Returns the seal that matches the certificate's contents.
    pub(super) fn checksum(&self) -> u64 {
        let mut seal = Seal(FnvHasher::default());
        seal.take_all(self.visits);
        seal.take_all([usize::from(self.rests_on_looks)]);
        match &self.proof {
            MergeProof::Bounds(routes) => {
                seal.take_all([0]);
                seal.take_routes(routes);
            }
            MergeProof::Winding(evidence) => {
                seal.take_all([2]);
                evidence.sum_up(&mut seal);
            }
            MergeProof::Looks(evidence) => {
                seal.take_all([1]);
                evidence.sum_up(&mut seal);
            }
        }
        seal.0.finish()
    }
}

impl WindingEvidence {
    fn sum_up(&self, seal: &mut Seal) {
        seal.take_all([self.corners.len()]);
        seal.take_all(self.corners.iter().copied());
        seal.take_all(self.begins.map(|Action(action)| action as usize));
        self.corridors
            .iter()
            .for_each(|routes| seal.take_routes(routes));
    }
}

impl LookEvidence {
    fn sum_up(&self, seal: &mut Seal) {
        for pair in &self.pairs {
            let (before, Action(action)) = pair.after.unwrap_or((usize::MAX, Action(u32::MAX)));
            seal.take_all(pair.visits);
            seal.take_all([before, action as usize]);
        }
        for count in self.looks.counts() {
            seal.take(count);
        }
        seal.take(self.chance.to_bits());
    }
}
