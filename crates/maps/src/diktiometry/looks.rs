use super::wilson_upper;

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
    /// Those of them of which neighbours by the same action are known.
    pub followed: u32,
    /// Those of them whose neighbours look alike, too.
    pub repeating: u32,
    /// Places before this id were held against all that look like them.
    pub(super) noted: usize,
    /// The fewest kinds of looks so far that would do for a merge where geometry knows nothing.
    pub(super) least_wanted: Option<usize>,
}

impl Looks {
    /// The chance that a place looks like another, at most, if their neighbours do: 1 while nothing is known.
    ///
    /// For places whose looks have nothing to do with their neighbours' it is the upper end of Wilson's score interval at 99 %.
    /// Where looks repeat, room for room, those that deceive have neighbours that deceive, and it is as often as that was met.
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
        // Met once, it is no rule.
        let repeats = f64::from(self.repeating) / (f64::from(self.followed) + 2.0);
        wilson_upper(rate, trials).max(repeats)
    }

    /// Counts two places that geometry has told apart.
    ///
    /// Of two that look alike, `neighbours` says how two look that the same action leads from or to, if any are known.
    pub(super) fn count(&mut self, look: Similarity, neighbours: Option<Similarity>) {
        self.different = self.different.saturating_add(1);
        if look == Similarity::Unlike {
            return;
        }
        self.deceiving = self.deceiving.saturating_add(1);
        if let Some(neighbours) = neighbours {
            self.followed = self.followed.saturating_add(1);
            let repeating = u32::from(neighbours == Similarity::Alike);
            self.repeating = self.repeating.saturating_add(repeating);
        }
    }
}

/// Whether two places may be taken for each other by their looks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Similarity {
    /// They do, or nothing is known of their look.
    #[default]
    Alike,
    Unlike,
}

impl Similarity {
    pub(super) const fn of(alike: bool) -> Self {
        if alike { Self::Alike } else { Self::Unlike }
    }
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
                ..Looks::default()
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

    #[test]
    fn nothing_is_believed_where_rooms_repeat() {
        let mut looks = Looks {
            kinds: 100,
            different: 5000,
            ..Looks::default()
        };
        assert!(looks.chance_of_alike() < 0.01);
        for _ in 0..20 {
            looks.count(Similarity::Alike, Some(Similarity::Unlike));
        }
        assert!(looks.chance_of_alike() < 0.01);
        for _ in 0..20 {
            looks.count(Similarity::Alike, Some(Similarity::Alike));
        }
        assert!(looks.chance_of_alike() > 0.4);
    }
}
