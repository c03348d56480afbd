use super::counts::wilson_upper;

/// What the map itself has learned of how well looks tell places apart.
///
/// Beyond the paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Looks {
    /// Looks that were unlike all that were known when they were met.
    pub kinds: u32,
    /// Pairs of places of which geometry has told that they are two.
    pub different: u32,
    /// Those of them that look alike.
    pub deceiving: u32,
}

impl Looks {
    /// The chance that a place looks like another, at most: the upper end of Wilson's score interval at 99 %; 1 while nothing is
    /// known.
    ///
    /// A true place may be many places of a map that is not yet folded, whose pairs are no evidence of their own: all
    /// pairs count for as many as the kinds of looks make.
    pub(super) fn chance_of_alike(&self) -> f64 {
        let kinds = f64::from(self.kinds);
        let trials = f64::from(self.different).min(0.5 * kinds * (kinds - 1.0));
        if trials < 1.0 {
            return 1.0;
        }
        let rate = f64::from(self.deceiving) / f64::from(self.different);
        wilson_upper(rate, trials)
    }

    /// Geometry has told that two places are two.
    pub(super) fn tell_apart(&mut self, look: Similarity) {
        self.different = self.different.saturating_add(1);
        if look == Similarity::Alike {
            self.deceiving = self.deceiving.saturating_add(1);
        }
    }
}

/// Whether two places may be taken for each other by their looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Similarity {
    Alike,
    Unlike,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn little_is_believed_at_first_and_nothing_where_all_look_alike() {
        let chance = |kinds, different, deceiving| {
            let looks = Looks {
                kinds,
                different,
                deceiving,
            };
            looks.chance_of_alike()
        };
        assert!((chance(0, 0, 0) - 1.0).abs() < 1e-12);
        // Two places that were unfolded to many are one pair.
        assert!(chance(2, 900, 0) > 0.8);
        assert!((chance(1, 300, 300) - 1.0).abs() < 1e-12);
        // 0 of n: z² / (n + z²).
        assert!((chance(20, 400, 0) - 6.634_896_6 / 196.634_896_6).abs() < 1e-8);
        assert!(chance(20, 400, 40) > 0.1);
    }
}
