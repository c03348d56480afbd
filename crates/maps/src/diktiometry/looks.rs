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
    /// Least agreement so far that suffices for a merge where geometry knows nothing.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) least_wanted: Option<Agreeing>,
}

impl Looks {
    /// Returns how many looks have to agree for a coincidence to be less likely than `error`.
    /// `None` if there are fewer kinds, or if looks repeat without end. O(kinds²).
    ///
    /// A true place may be many places of a map that is not yet folded, whose pairs are not
    /// independent evidence. So the agreement has to be unlikely both by its kinds and by its
    /// places.
    pub(super) fn enough(&self, error: f64) -> Option<Agreeing> {
        let kinds = (1..=self.kinds as usize).find(|kinds| self.by_kinds(*kinds) < error)?;
        let places = (kinds..=MOST_PLACES).find(|places| self.by_places(*places) < error)?;
        Some(Agreeing { kinds, places })
    }

    /// Returns the probability that looks agree so at two different places; 1 where nothing is
    /// known of looks. O(kinds).
    pub(super) fn chance(&self, agreeing: Agreeing) -> f64 {
        let by_kinds = self.by_kinds(agreeing.kinds);
        by_kinds.max(self.by_places(agreeing.places))
    }

    /// Returns the probability of `agreeing` kinds in agreement if the looks of a place are
    /// independent of its neighbours'.
    ///
    /// Let p be the rate at which two places look alike. It has a beta distribution by the pairs
    /// seen (Jeffreys' prior). The probability of k coincidences in a row is then the mean of pᵏ.
    /// All pairs count for no more than the kinds of looks allow.
    fn by_kinds(&self, agreeing: usize) -> f64 {
        let kinds = f64::from(self.kinds);
        let pairs = f64::from(self.different).min(0.5 * kinds * (kinds - 1.0));
        if pairs < 1.0 {
            return 1.0;
        }
        let alike = pairs * f64::from(self.deceiving) / f64::from(self.different);
        let rates = (0..agreeing).map(|before| {
            let before = before as f64;
            (alike + 0.5 + before) / (pairs + 1.0 + before)
        });
        rates.product()
    }

    /// Returns the probability of `agreeing` places in agreement where looks repeat, room for room:
    /// the power of the rate at which neighbours of places that look alike do so, too.
    fn by_places(&self, agreeing: usize) -> f64 {
        // Once is not a rule.
        let repeats = f64::from(self.repeating) / (f64::from(self.followed) + 2.0);
        libm::pow(repeats, agreeing as f64)
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

/// Number of looks that agree along the same actions from two places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Agreeing {
    /// Number of different looks.
    pub(super) kinds: usize,
    /// Number of pairs of places, each place in one of them.
    pub(super) places: usize,
}

/// Maximum number of places whose agreement is asked for.
const MOST_PLACES: usize = 64;

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
        let kinds = |kinds, different, deceiving| {
            let looks = Looks {
                kinds,
                different,
                deceiving,
                ..Looks::default()
            };
            Some(looks.enough(1e-5)?.kinds)
        };
        assert_eq!(kinds(0, 0, 0), None);
        // Two places that were unfolded to many are one pair.
        assert_eq!(kinds(2, 900, 0), None);
        assert_eq!(kinds(1, 300, 300), None);
        // Mean of pᵏ where 15 pairs were all unlike: 1/32, times 3/34, 5/36, 7/38, 9/40.
        assert_eq!(kinds(6, 900, 0), Some(6));
        assert_eq!(kinds(20, 400, 0), Some(3));
        assert_eq!(kinds(20, 400, 40), Some(6));
    }

    #[test]
    fn each_count_is_a_part_of_the_one_before() {
        let looks = |[different, deceiving, followed, repeating]: [u32; 4]| Looks {
            different,
            deceiving,
            followed,
            repeating,
            ..Looks::default()
        };
        assert!(looks([4, 3, 2, 1]).is_consistent());
        assert!(looks([2; 4]).is_consistent());
        for counts in [[2, 3, 2, 1], [4, 2, 3, 1], [4, 3, 1, 2]] {
            assert!(!looks(counts).is_consistent(), "{counts:?}");
        }
    }

    #[test]
    fn where_rooms_repeat_more_places_have_to_agree_and_in_the_end_none_is_enough() {
        let mut looks = Looks {
            kinds: 100,
            different: 5000,
            ..Looks::default()
        };
        let count = |looks: &mut Looks, neighbours| {
            for _ in 0..20 {
                looks.count(Similarity::Alike, Some(neighbours));
            }
            looks.enough(1e-5)
        };
        let agreeing = |kinds, places| Some(Agreeing { kinds, places });
        assert_eq!(looks.enough(1e-5), agreeing(2, 2));
        assert_eq!(count(&mut looks, Similarity::Unlike), agreeing(3, 3));
        assert_eq!(count(&mut looks, Similarity::Alike), agreeing(3, 16));
        looks.repeating = looks.followed;
        assert_eq!(count(&mut looks, Similarity::Alike), None);
    }

    #[test]
    fn an_agreement_is_as_likely_as_the_likelier_of_its_explanations() {
        let looks = Looks {
            kinds: 100,
            different: 5000,
            deceiving: 500,
            followed: 98,
            repeating: 50,
            ..Looks::default()
        };
        let chance = |kinds, places| looks.chance(Agreeing { kinds, places });
        assert!((chance(5, 3) - 0.125).abs() < 1e-12);
        assert!((chance(1, 20) - 0.1).abs() < 1e-3);
    }
}
