use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;

/// Number of costs that have a bucket of their own; a power of two.
const RING: usize = 256;

/// A queue of nodes by cost, of which none is queued for less than the last that was taken: a ring
/// of buckets for the next [`RING`] costs (Dial 1969), and a heap for those beyond.
pub(crate) struct Ring {
    buckets: Vec<Vec<u32>>,
    /// Bit b of word w: bucket 64 w + b holds a node.
    held: [u64; RING / 64],
    beyond: BinaryHeap<Reverse<(u32, u32)>>,
    /// Least cost that may be queued.
    now: u32,
}

impl Ring {
    pub(crate) fn new() -> Self {
        Self {
            buckets: vec![Vec::new(); RING],
            held: [0; RING / 64],
            beyond: BinaryHeap::new(),
            now: 0,
        }
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, cost: u32, node: u32) {
        if ((cost - self.now) as usize) < RING {
            let bucket = cost as usize % RING;
            self.buckets[bucket].push(node);
            self.held[bucket / 64] |= 1 << (bucket % 64);
        } else {
            self.beyond.push(Reverse((cost, node)));
        }
    }

    /// Returns the least cost of a node, or `None` if none is queued.
    pub(crate) fn least(&self) -> Option<u32> {
        let beyond = self.beyond.peek().map(|Reverse((cost, _))| *cost);
        let both = [self.near(), beyond].into_iter();
        both.flatten().min()
    }

    /// Takes a node of least cost, and returns the cost first.
    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Option<(u32, u32)> {
        let near = self.near();
        if let Some(Reverse((cost, node))) = self.beyond.peek().copied()
            && near.is_none_or(|near| cost <= near)
        {
            self.beyond.pop();
            self.now = cost;
            return Some((cost, node));
        }
        self.now = near?;
        let number = self.now as usize % RING;
        let bucket = &mut self.buckets[number];
        let node = bucket.pop()?;
        if bucket.is_empty() {
            self.held[number / 64] &= !(1 << (number % 64));
        }
        Some((self.now, node))
    }

    /// Returns the least cost in the buckets.
    #[inline(always)]
    fn near(&self) -> Option<u32> {
        let first = self.now as usize % RING;
        let words = self.held.len();
        let ahead = self.held[first / 64] & (u64::MAX << (first % 64));
        if ahead != 0 {
            let bucket = first / 64 * 64 + ahead.trailing_zeros() as usize;
            return Some(self.now + (bucket - first) as u32);
        }
        // The last word is the first again: what lies before `first` comes a round later.
        let later = (1..=words).map(|word| (first / 64 + word) % words);
        let word = { later }.find(|word| self.held[*word] != 0)?;
        let bucket = word * 64 + self.held[word].trailing_zeros() as usize;
        Some(self.now + ((bucket + RING - first) % RING) as u32)
    }
}
