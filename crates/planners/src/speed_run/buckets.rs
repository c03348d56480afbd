/// Queue of cells by time: a ring of 2 `N` buckets, each of which holds a cell at most once. `N` is
/// at most 32, so that a row of cells is a word.
#[derive(Clone, Debug)]
pub(super) struct Buckets<const N: usize> {
    ring: [[Bucket<N>; N]; 2],
}

#[derive(Clone, Copy, Debug)]
struct Bucket<const N: usize> {
    /// Bit y: row y is not empty.
    rows: u32,
    /// Bit x of row y: the cell (x, y).
    cells: [u32; N],
}

impl<const N: usize> Bucket<N> {
    const EMPTY: Self = Self {
        rows: 0,
        cells: [0; N],
    };
}

impl<const N: usize> Buckets<N> {
    pub(super) const EMPTY: Self = Self {
        ring: [[Bucket::EMPTY; N]; 2],
    };

    pub(super) fn clear(&mut self) {
        for bucket in self.ring.as_flattened_mut() {
            if bucket.rows != 0 {
                *bucket = Bucket::EMPTY;
            }
        }
    }

    /// Puts `cell` into `bucket`. A bucket 2 N or more beyond the first is one of those before it,
    /// so its cells come too early, and again if they are reached sooner.
    #[inline(always)]
    pub(super) fn insert(&mut self, bucket: usize, cell: usize) {
        let (x, y) = (cell % N, cell / N % N);
        if let Some(bucket) = self.ring.as_flattened_mut().get_mut(bucket % (2 * N))
            && let Some(row) = bucket.cells.get_mut(y)
        {
            *row |= 1 << x;
            bucket.rows |= 1 << y;
        }
    }

    /// Returns the first bucket from `bucket` on that holds a cell.
    #[inline(always)]
    pub(super) fn next(&self, bucket: usize) -> Option<usize> {
        let ring = self.ring.as_flattened();
        (bucket..bucket + 2 * N).find(|bucket| {
            ring.get(bucket % (2 * N))
                .is_some_and(|bucket| bucket.rows != 0)
        })
    }

    /// Takes a cell out of `bucket`, north-eastern ones first. They lie beyond the goal from a
    /// start in the south-west, so what they reach is seldom reached again.
    #[inline(always)]
    pub(super) fn pop(&mut self, bucket: usize) -> Option<usize> {
        let bucket = self.ring.as_flattened_mut().get_mut(bucket % (2 * N))?;
        if bucket.rows == 0 {
            return None;
        }
        let y = (31 - bucket.rows.leading_zeros()) as usize % N;
        let row = bucket.cells.get_mut(y)?;
        let x = (31 - row.leading_zeros()) as usize & 31;
        *row &= !(1 << x);
        // No branch, because nothing foresees how many cells are left.
        bucket.rows &= !(u32::from(*row == 0) << y);
        Some(y * N + x)
    }
}
