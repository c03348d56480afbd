//! The mapper without each of its parts.

use super::config::{
    Config, GeometricIndexing, GeometricMerge, Identity, Order, PerceptualIndexing, Use,
};

/// A change to the mapper that leaves a part out, or puts another in its place: what a part is worth shows in what becomes of the map
/// without it.
#[derive(Clone, Copy, Debug)]
pub struct Ablation {
    /// What is different.
    pub name: &'static str,
    /// Makes it so.
    pub change: fn(&mut Config),
}

impl Ablation {
    /// The mapper as it is, then without each part or with another. The last is the paper's rule of identity with the merge that goes with it.
    pub const ALL: [Self; 20] = [
        Self {
            name: "all",
            change: |_| {},
        },
        Self {
            name: "no CONTINUE",
            change: |config| {
                config.matching.continuation = Use::Off;
            },
        },
        Self {
            name: "no LINK",
            change: |config| config.matching.link = Use::Off,
        },
        Self {
            name: "no α-MATCH",
            change: |config| config.matching.alpha = Use::Off,
        },
        Self {
            name: "no β-MATCH",
            change: |config| config.matching.beta = Use::Off,
        },
        Self {
            name: "no expectational indexing",
            change: |config| {
                config.indexing.expectational = Use::Off;
            },
        },
        Self {
            name: "no geometric indexing",
            change: |config| {
                config.indexing.geometric = GeometricIndexing::Off;
            },
        },
        Self {
            name: "active frames",
            change: |config| {
                config.indexing.geometric = GeometricIndexing::ActiveFrames;
            },
        },
        Self {
            name: "no perceptual indexing",
            change: |config| {
                config.indexing.perceptual = PerceptualIndexing::Off;
            },
        },
        Self {
            name: "triangles",
            change: |config| {
                config.indexing.perceptual = PerceptualIndexing::Triangles;
            },
        },
        Self {
            name: "no geometric merge",
            change: |config| {
                config.restructuring.geometric_merge = GeometricMerge::Off;
            },
        },
        Self {
            name: "no geometric split",
            change: |config| {
                config.restructuring.geometric_split = Use::Off;
            },
        },
        Self {
            name: "no local merge",
            change: |config| {
                config.restructuring.local_merge = Use::Off;
            },
        },
        Self {
            name: "no local split",
            change: |config| {
                config.restructuring.local_split = Use::Off;
            },
        },
        Self {
            name: "no non-local merge",
            change: |config| {
                config.restructuring.non_local_merge = Use::Off;
            },
        },
        Self {
            name: "merges by looks",
            change: |config| {
                config.restructuring.look_merge = Use::On;
            },
        },
        Self {
            name: "no transients",
            change: |config| {
                config.transients.elision = Use::Off;
            },
        },
        Self {
            name: "one track",
            change: |config| config.tracks.cap = 1,
        },
        Self {
            name: "static priorities",
            change: |config| {
                config.matching.order = Order::Static;
            },
        },
        Self {
            name: "boxes that meet are the same",
            change: |config| {
                config.matching.identity = Identity::Meets;
                config.restructuring.geometric_merge = GeometricMerge::Estims;
            },
        },
    ];
}

#[cfg(test)]
mod tests {
    use alloc::collections::BTreeSet;
    use alloc::format;

    use super::*;

    #[test]
    fn every_one_makes_another_mapper() {
        let mappers = Ablation::ALL.map(|ablation| {
            let mut config = Config::new(Config::compass_actions(), 1.0);
            (ablation.change)(&mut config);
            format!("{config:?}")
        });
        assert_eq!(BTreeSet::from(mappers).len(), Ablation::ALL.len());
    }
}
