/// Queue of cells by time: a ring of 2 `N` buckets, each of which holds a cell at most once. `N` is
/// at most 32, so that a row of cells is a word.
#[derive(Clone, Debug)]
pub(super) struct Buckets<const N: usize> {
    ring: [[Bucket<N>; N]; 2],
    /// Bit b: bucket b of the ring is not empty.
    occupied: u64,
}

#[derive(Clone, Copy, Debug)]
struct Bucket<const N: usize> {
    /// Bit y: row y is not empty.
    rows: u32,
    /// Bit x of row y: the cell (x, y).
    cells: [u32; N],
}

impl<const N: usize> Buckets<N> {
    pub(super) const EMPTY: Self = Self {
        ring: [[Bucket {
            rows: 0,
            cells: [0; N],
        }; N]; 2],
        occupied: 0,
    };

    pub(super) fn clear(&mut self) {
        while self.occupied != 0 {
            // Popping the last cell of a bucket marks the bucket as empty.
            self.pop(self.occupied.trailing_zeros() as usize);
        }
    }

    /// Puts `cell` into `bucket`, a number below the lowest occupied one plus 2 N.
    #[inline]
    pub(super) fn insert(&mut self, bucket: usize, cell: usize) {
        let slot = bucket % (2 * N);
        let (x, y) = (cell % N, cell / N);
        if let Some(bucket) = self.ring.as_flattened_mut().get_mut(slot)
            && let Some(row) = bucket.cells.get_mut(y)
        {
            *row |= 1 << x;
            bucket.rows |= 1 << y;
            self.occupied |= 1 << slot;
        }
    }

    /// Returns the first bucket from `bucket` on that holds a cell.
    #[inline]
    pub(super) fn next(&mut self, bucket: usize) -> Option<usize> {
        if self.occupied == 0 {
            return None;
        }
        (bucket..bucket + 2 * N).find(|bucket| self.occupied >> (bucket % (2 * N)) & 1 == 1)
    }

    /// Takes a cell out of `bucket`, south-western ones first.
    #[inline]
    pub(super) fn pop(&mut self, bucket: usize) -> Option<usize> {
        let slot = bucket % (2 * N);
        let bucket = self.ring.as_flattened_mut().get_mut(slot)?;
        if bucket.rows == 0 {
            self.occupied &= !(1 << slot);
            return None;
        }
        let y = bucket.rows.trailing_zeros();
        let row = bucket.cells.get_mut(y as usize)?;
        let x = row.trailing_zeros();
        *row &= row.wrapping_sub(1);
        if *row == 0 {
            bucket.rows &= bucket.rows - 1;
        }
        Some(y as usize * N + x as usize)
    }
}
