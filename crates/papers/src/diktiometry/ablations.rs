//! The mapper without each of its parts.

use tolman_maps::diktiometry::{
    Apart, Config, GeometricIndexing, GeometricMerge, Identity, PerceptualIndexing, Precedence,
    Use, WorldKind,
};

/// Changes the mapper's configuration.
pub type Change = fn(&mut Config);

/// Changes that remove or replace a part, to show its effect. The first changes nothing. The last
/// is the paper's rule of identity with the merge that belongs to it.
pub const ABLATIONS: [(&str, Change); 20] = [
    ("all", |_| {}),
    ("no CONTINUE", |config| {
        config.matching.continuation = Use::Off;
    }),
    ("no LINK", |config| config.matching.link = Use::Off),
    ("no α-MATCH", |config| config.matching.alpha = Use::Off),
    ("no β-MATCH", |config| config.matching.beta = Use::Off),
    ("no expectational indexing", |config| {
        config.indexing.expectational = Use::Off;
    }),
    ("no geometric indexing", |config| {
        config.indexing.geometric = GeometricIndexing::Off;
    }),
    ("active frames", |config| {
        config.indexing.geometric = GeometricIndexing::ActiveFrames;
    }),
    ("no perceptual indexing", |config| {
        config.indexing.perceptual = PerceptualIndexing::Off;
    }),
    ("triangles", |config| {
        config.indexing.perceptual = PerceptualIndexing::Triangles;
    }),
    ("no geometric merge", |config| {
        config.restructuring.geometric_merge = GeometricMerge::Off;
    }),
    ("no geometric split", |config| {
        config.restructuring.geometric_split = Use::Off;
    }),
    ("no local merge", |config| {
        config.restructuring.local_merge = Use::Off;
    }),
    ("no local split", |config| {
        config.restructuring.local_split = Use::Off;
    }),
    ("no non-local merge", |config| {
        config.restructuring.non_local_merge = Use::Off;
    }),
    ("merges by looks", |config| {
        config.restructuring.look_merge = Use::On;
    }),
    ("no transients", |config| {
        config.transients.elision = Use::Off;
    }),
    ("one track", |config| config.tracks.cap = 1),
    ("static priorities", |config| {
        config.matching.order = Precedence::Static;
    }),
    ("boxes that meet are the same", papers_rule),
];

/// Sets the paper's rule, which ignores straight corridors: a place is a known one if their boxes
/// meet, and places merge by estims.
pub(super) fn papers_rule(config: &mut Config) {
    config.actions = Config::compass_actions();
    config.apart = Apart::Distance;
    config.world = WorldKind::Changing;
    config.matching.identity = Identity::Meets;
    config.restructuring.geometric_merge = GeometricMerge::Estims;
}

#[cfg(test)]
mod tests {
    use alloc::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_one_makes_another_mapper() {
        let mappers = ABLATIONS.map(|(_, change)| {
            let mut config = Config::new(Config::compass_actions(), 1.0);
            change(&mut config);
            format!("{config:?}")
        });
        assert_eq!(BTreeSet::from(mappers).len(), ABLATIONS.len());
    }
}
