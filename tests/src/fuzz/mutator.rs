use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Makes files that are almost valid out of valid ones, always the same for a seed.
#[derive(Debug)]
pub struct Mutator {
    rng: ChaCha8Rng,
}

/// No file becomes longer, bytes.
const LONGEST: usize = 1 << 16;

/// Most changes of one file.
const MOST_CHANGES: u32 = 6;

/// Numbers at the limits of their types, and texts that are not numbers.
const NUMBERS: [&str; 24] = [
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "255",
    "256",
    "65535",
    "65536",
    "2147483647",
    "-2147483648",
    "4294967295",
    "4294967296",
    "9007199254740993",
    "9223372036854775807",
    "18446744073709551615",
    "18446744073709551616",
    "1e308",
    "-1e308",
    "1e309",
    "1e-320",
    "0.1",
    "NaN",
    "inf",
];

/// Pieces that readers treat in a way of their own.
const PIECES: [&[u8]; 20] = [
    b"\n",
    b"\r\n",
    b"\r",
    b" ",
    b"\t",
    b"\0",
    b"\"",
    b"{",
    b"}",
    b"[",
    b"]",
    b",",
    b":",
    b"#",
    b"-",
    b"null",
    b"\xef\xbb\xbf",
    b"\xff",
    "\u{e9}".as_bytes(),
    "\u{2028}".as_bytes(),
];

impl Mutator {
    /// Returns a mutator that draws from this seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            rng: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// Returns one of `seeds`, changed in one place or several; empty if there are none.
    pub fn file(&mut self, seeds: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = self.one_of(seeds);
        for _ in 0..self.rng.random_range(1..=MOST_CHANGES) {
            self.change(&mut bytes, seeds);
            bytes.truncate(LONGEST);
        }
        bytes
    }

    fn one_of(&mut self, seeds: &[Vec<u8>]) -> Vec<u8> {
        match seeds.len() {
            0 => Vec::new(),
            count => seeds[self.below(count)].clone(),
        }
    }

    fn change(&mut self, bytes: &mut Vec<u8>, seeds: &[Vec<u8>]) {
        let (start, end) = self.stretch(bytes.len());
        match self.rng.random_range(0_u32..12) {
            0 => {
                if let Some(byte) = bytes.get_mut(start) {
                    *byte ^= 1 << self.rng.random_range(0_u32..8);
                }
            }
            1 => {
                if let Some(byte) = bytes.get_mut(start) {
                    *byte = self.rng.random_range(0_u32..256) as u8;
                }
            }
            2 => drop(bytes.drain(start..end)),
            3 => bytes.truncate(start),
            4 => {
                // Again and again, so that something becomes long.
                let piece = bytes[start..end].repeat(1 << self.rng.random_range(0_u32..7));
                insert(bytes, start, &piece);
            }
            5 => {
                let piece = PIECES[self.below(PIECES.len())];
                insert(bytes, start, piece);
            }
            6 => {
                let other = self.one_of(seeds);
                let (from, to) = self.stretch(other.len());
                insert(bytes, start, &other[from..to]);
            }
            7 => {
                let deep = 1 << self.rng.random_range(0_u32..14);
                insert(bytes, start, &b"["[..].repeat(deep));
            }
            8 => self.swap_lines(bytes),
            _ => self.renumber(bytes, start),
        }
    }

    /// Puts another number in the place of the next one.
    fn renumber(&mut self, bytes: &mut Vec<u8>, start: usize) {
        let is_part = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte);
        let first = bytes[start..].iter().position(u8::is_ascii_digit);
        let Some(first) = first.map(|at| start + at) else {
            return;
        };
        let length = bytes[first..]
            .iter()
            .take_while(|byte| is_part(byte))
            .count();
        let number = NUMBERS[self.below(NUMBERS.len())];
        bytes.splice(first..first + length, number.bytes());
    }

    fn swap_lines(&mut self, bytes: &mut Vec<u8>) {
        let mut lines: Vec<Vec<u8>> = bytes
            .split(|byte| *byte == b'\n')
            .map(<[u8]>::to_vec)
            .collect();
        let (a, b) = (self.below(lines.len()), self.below(lines.len()));
        lines.swap(a, b);
        *bytes = lines.join(&b'\n');
    }

    /// Returns where a stretch of `length` bytes begins and ends; most are short.
    fn stretch(&mut self, length: usize) -> (usize, usize) {
        let start = self.below(length + 1);
        let most = (length - start).min(1 << self.rng.random_range(0_u32..12));
        (start, start + self.below(most + 1))
    }

    fn below(&mut self, count: usize) -> usize {
        self.rng.random_range(0..count.max(1) as u32) as usize
    }
}

fn insert(bytes: &mut Vec<u8>, at: usize, piece: &[u8]) {
    let piece = &piece[..piece.len().min(LONGEST)];
    bytes.splice(at..at, piece.iter().copied());
}
