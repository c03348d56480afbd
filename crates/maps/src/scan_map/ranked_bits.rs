use alloc::vec;
use alloc::vec::Vec;

/// A set of slots that gives each member a number: the count of members before it.
///
/// One bit per slot, and 32 bits per 64 slots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct RankedBits {
    words: Vec<u64>,
    /// Number of members before each word.
    before: Vec<u32>,
    len: u32,
}

/// Number of bits in a word.
const WORD: usize = u64::BITS as usize;

impl RankedBits {
    /// Returns the set of those of `slots` slots for which `in_it` is true. O(slots).
    pub(super) fn new(slots: usize, mut in_it: impl FnMut(usize) -> bool) -> Self {
        let mut words = vec![0_u64; slots.div_ceil(WORD)];
        for slot in (0..slots).filter(|slot| in_it(*slot)) {
            words[slot / WORD] |= 1 << (slot % WORD);
        }
        let mut len = 0;
        let before = words
            .iter()
            .map(|word| {
                let before = len;
                len += word.count_ones();
                before
            })
            .collect();
        Self { words, before, len }
    }

    /// Returns the number of members.
    pub(super) const fn len(&self) -> usize {
        self.len as usize
    }

    /// Returns the number of a slot; `None` if it is not in the set. O(1).
    pub(super) fn number(&self, slot: usize) -> Option<u32> {
        let word = *self.words.get(slot / WORD)?;
        let bit = 1_u64 << (slot % WORD);
        (word & bit != 0).then(|| self.before[slot / WORD] + (word & (bit - 1)).count_ones())
    }

    /// Returns the slot of element `number`, or `None` if there are fewer elements. O(log slots).
    pub(super) fn slot(&self, number: u32) -> Option<usize> {
        if number >= self.len {
            return None;
        }
        // This is the last word with at most `number` members before it.
        let index = self.before.partition_point(|before| *before <= number) - 1;
        let mut bits = set_bits(self.words[index]);
        let bit = bits.nth((number - self.before[index]) as usize)?;
        Some(index * WORD + bit)
    }

    /// Returns the slots, by number.
    pub(super) fn slots(&self) -> impl Iterator<Item = usize> + '_ {
        let words = self.words.iter().enumerate();
        words.flat_map(|(index, word)| set_bits(*word).map(move |bit| index * WORD + bit))
    }
}

/// Returns the bits that are set, the lowest first.
fn set_bits(mut word: u64) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let bit = word.trailing_zeros();
        word &= word.wrapping_sub(1);
        (bit < u64::BITS).then_some(bit as usize)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_slot_has_its_number_and_every_number_its_slot() {
        for (slots, every) in [(0, 1), (1, 1), (64, 1), (65, 64), (1000, 7), (1000, 1001)] {
            let is_in = |slot: usize| slot % every == every - 1;
            let bits = RankedBits::new(slots, is_in);
            let expected: Vec<usize> = (0..slots).filter(|slot| is_in(*slot)).collect();
            assert_eq!(bits.slots().collect::<Vec<_>>(), expected);
            assert_eq!(bits.len(), expected.len());
            for slot in 0..slots + 70 {
                let number = expected.binary_search(&slot).ok();
                assert_eq!(bits.number(slot).map(|number| number as usize), number);
            }
            for number in 0..expected.len() + 2 {
                assert_eq!(bits.slot(number as u32), expected.get(number).copied());
            }
        }
    }
}
