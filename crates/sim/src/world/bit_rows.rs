/// A bit for every place of a few rows, all of one length.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BitRows {
    rows: usize,
    length: usize,
    words: Vec<u64>,
}

impl BitRows {
    /// Returns rows without a set bit.
    pub(super) fn new(rows: usize, length: usize) -> Self {
        Self {
            rows,
            length,
            words: vec![0; (rows * length).div_ceil(64)],
        }
    }

    /// Returns the number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the number of bits in each row.
    pub(crate) fn length(&self) -> usize {
        self.length
    }

    /// Returns whether there are `rows` rows of `length` bits, and enough words for them.
    pub(super) fn has_shape(&self, rows: usize, length: usize) -> bool {
        (self.rows, self.length) == (rows, length)
            && rows
                .checked_mul(length)
                .is_some_and(|places| places.div_ceil(64) == self.words.len())
    }

    /// Sets or clears the bit of a place.
    pub(super) fn set(&mut self, row: usize, place: usize, is_set: bool) {
        let bit = row * self.length + place;
        let mask = 1 << (bit % 64);
        if is_set {
            self.words[bit / 64] |= mask;
        } else {
            self.words[bit / 64] &= !mask;
        }
    }

    /// Returns the bit of a place; `false` outside.
    pub(crate) fn get(&self, row: usize, place: usize) -> bool {
        let bit = row.saturating_mul(self.length).saturating_add(place);
        row < self.rows && place < self.length && self.words[bit / 64] >> (bit % 64) & 1 == 1
    }
}
