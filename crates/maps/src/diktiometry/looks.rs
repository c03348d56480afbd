/// Reliability of looks for telling places apart, as the map has learned it. Beyond the paper.
///
/// Beyond the paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Looks {
    /// Number of looks that were unlike all looks known before.
    pub kinds: u32,
    /// Number of pairs of places that geometry has told apart.
    pub different: u32,
    /// Number of these pairs of places that look alike.
    pub deceiving: u32,
    /// Number of these alike pairs whose neighbours along the same action are known.
    pub followed: u32,
    /// Number of these pairs whose neighbours look alike, too.
    pub repeating: u32,
    /// Id below which all places were compared with those that look like them.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) noted: usize,
    /// Minimum number of agreeing looks so far that suffices for a merge where geometry knows
    /// nothing.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) least_wanted: Option<usize>,
}

impl Looks {
    /// Returns the number of kinds of looks that have to agree for a coincidence to be less likely
    /// than `error`. `None` if there are not as many kinds. O(kinds²).
    ///
    /// Let p be the rate at which two places look alike. If the looks of a place are independent of
    /// its neighbours', p has a beta distribution by the pairs seen (Jeffreys' prior). The
    /// probability of k coincidences in a row is then the mean of pᵏ. Where looks repeat, room for
    /// room, places that look alike have neighbours that look alike. So the probability is at least
    /// the power of the rate observed there.
    ///
    /// A true place may be many places of a map that is not yet folded, whose pairs are not
    /// independent evidence. All pairs therefore count for no more than the kinds of looks allow.
    pub(super) fn enough(&self, error: f64) -> Option<usize> {
        (1..=self.kinds as usize).find(|agreeing| self.chance(*agreeing) < error)
    }

    /// Returns the probability that `agreeing` kinds of looks agree at two places; 1 where nothing
    /// is known of looks. O(agreeing).
    pub(super) fn chance(&self, agreeing: usize) -> f64 {
        let kinds = f64::from(self.kinds);
        let pairs = f64::from(self.different).min(0.5 * kinds * (kinds - 1.0));
        if pairs < 1.0 {
            return 1.0;
        }
        let alike = pairs * f64::from(self.deceiving) / f64::from(self.different);
        // Once is not a rule.
        let repeats = f64::from(self.repeating) / (f64::from(self.followed) + 2.0);
        let (mut by_chance, mut by_rule) = (1.0_f64, 1.0_f64);
        for before in 0..agreeing {
            let before = before as f64;
            by_chance *= (alike + 0.5 + before) / (pairs + 1.0 + before);
            by_rule *= repeats;
        }
        by_chance.max(by_rule)
    }

    /// Returns whether each count is a part of the one that it is counted from.
    pub(super) const fn is_consistent(&self) -> bool {
        self.deceiving <= self.different
            && self.followed <= self.deceiving
            && self.repeating <= self.followed
    }

    /// Returns all counts.
    pub(super) fn counts(&self) -> [u64; 5] {
        let Self {
            kinds,
            different,
            deceiving,
            followed,
            repeating,
            ..
        } = *self;
        [kinds, different, deceiving, followed, repeating].map(u64::from)
    }

    /// Counts two places that geometry has told apart.
    ///
    /// `neighbours` is used if the two look alike. It compares the looks of their neighbours along
    /// the same action, if any are known.
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

/// Whether the looks of two places allow that they are one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Similarity {
    /// The places may be one, or nothing is known of their look.
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
        let enough = |kinds, different, deceiving| {
            let looks = Looks {
                kinds,
                different,
                deceiving,
                ..Looks::default()
            };
            looks.enough(1e-5)
        };
        assert_eq!(enough(0, 0, 0), None);
        // Two places that were unfolded to many are one pair.
        assert_eq!(enough(2, 900, 0), None);
        assert_eq!(enough(1, 300, 300), None);
        // Mean of pᵏ where 15 pairs were all unlike: 1/32, times 3/34, 5/36, 7/38, 9/40.
        assert_eq!(enough(6, 900, 0), Some(6));
        assert_eq!(enough(20, 400, 0), Some(3));
        assert_eq!(enough(20, 400, 40), Some(6));
    }

    #[test]
    fn nothing_is_believed_where_rooms_repeat() {
        let mut looks = Looks {
            kinds: 100,
            different: 5000,
            ..Looks::default()
        };
        let few = looks.enough(1e-5);
        assert!(few < Some(4), "{few:?}");
        for _ in 0..20 {
            looks.count(Similarity::Alike, Some(Similarity::Unlike));
        }
        assert!(looks.enough(1e-5) < Some(5));
        for _ in 0..20 {
            looks.count(Similarity::Alike, Some(Similarity::Alike));
        }
        assert!(looks.enough(1e-5) > Some(10));
    }
}
