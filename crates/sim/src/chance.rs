use core::convert::Infallible;

use rand::TryRng;

/// The random numbers of one run, for one robot at one tick.
///
/// The generator is counter-based. A channel's number is a pure function of the run, the robot, the
/// tick, the channel, and the count of its draws in this tick. Nothing is shared, so a further
/// consumer never shifts another one's numbers, and a tick can be drawn again without drawing those
/// before it.
///
/// The function is Philox4x32-10 (Salmon, Moraes, Dror, Shaw: *Parallel random numbers: as easy as
/// 1, 2, 3*, SC 2011). It passes BigCrush and, unlike a repositioned stream cipher, costs nothing
/// to position.
///
/// ```
/// use tolman_sim::{Chance, Channel};
///
/// let chance = Chance::of_run(7);
/// let first = chance.draws(Channel::named("compass")).gaussian();
/// // Whatever other channels draw, this one repeats itself.
/// chance.draws(Channel::named("laser")).gaussian();
/// assert_eq!(chance.draws(Channel::named("compass")).gaussian(), first);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chance {
    run: u64,
    robot: u32,
    tick: u64,
}

impl Chance {
    /// Returns the random numbers of the run seeded by `run`: robot 0 at tick 0.
    #[must_use]
    pub const fn of_run(run: u64) -> Self {
        Self {
            run,
            robot: 0,
            tick: 0,
        }
    }

    /// Returns the numbers of the same run for this robot at this tick. Robots differ up to number
    /// 2²⁴, ticks up to 2⁴⁸ (890,000 years of tenths of a second).
    #[must_use]
    pub const fn at(self, robot: u32, tick: u64) -> Self {
        Self {
            run: self.run,
            robot,
            tick,
        }
    }

    /// Returns the numbers of one channel, from its first.
    #[must_use]
    pub fn draws(&self, channel: Channel) -> Draws {
        Draws {
            key: [self.run as u32, (self.run >> 32) as u32],
            // block: 24 bits | tick: 48 bits | robot: 24 bits | channel: 32 bits
            counter: u128::from(self.tick & 0xFFFF_FFFF_FFFF) << 24
                | u128::from(self.robot & 0xFF_FFFF) << 72
                | u128::from(channel.0) << 96,
            block: [0; 4],
            left: 0,
            spare: None,
        }
    }
}

/// Consumer of random numbers from [`Chance`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Channel(u32);

impl Channel {
    /// Returns the channel of this name. Two consumers of one robot must not share a name, or they
    /// draw the same numbers.
    #[must_use]
    pub const fn named(name: &str) -> Self {
        // FNV-1a: constant at compile time, and names are few.
        Self(0x811C_9DC5).joined(name)
    }

    /// Returns the channel whose name is this one's with `more` appended.
    pub(crate) const fn joined(self, more: &str) -> Self {
        let bytes = more.as_bytes();
        let mut hash = self.0;
        let mut index = 0;
        while index < bytes.len() {
            hash = (hash ^ bytes[index] as u32).wrapping_mul(0x0100_0193);
            index += 1;
        }
        Self(hash)
    }

    /// Returns the channel of the `index`-th of several alike consumers under one name.
    #[must_use]
    pub const fn nth(self, index: u32) -> Self {
        // An odd multiplier permutes; the hash of the name is offset by it.
        Self(self.0 ^ index.wrapping_add(1).wrapping_mul(0x9E37_79B9))
    }
}

/// The numbers of one channel at one tick, in order. It is a [`rand`] generator.
#[derive(Clone, Debug)]
pub struct Draws {
    key: [u32; 2],
    counter: u128,
    block: [u32; 4],
    left: usize,
    spare: Option<f64>,
}

impl Draws {
    fn word(&mut self) -> u32 {
        if self.left == 0 {
            self.block = philox(
                [0, 32, 64, 96].map(|bit| (self.counter >> bit) as u32),
                self.key,
            );
            self.counter = self.counter.wrapping_add(1);
            self.left = 4;
        }
        self.left -= 1;
        self.block[3 - self.left]
    }

    /// Returns a uniform number in [0, 1), in steps of 2⁻⁵³.
    #[must_use]
    pub fn uniform(&mut self) -> f64 {
        let bits = u64::from(self.word()) << 32 | u64::from(self.word());
        (bits >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Returns a standard normal number: mean 0, standard deviation 1. It uses Marsaglia's polar
    /// method with [`libm`]'s logarithm, so that every platform draws the same bits.
    #[must_use]
    pub fn gaussian(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            // Odd multiples of 2⁻³², so that the square is never 0.
            let mut coordinate = || (f64::from(self.word() as i32) + 0.5) / 2_147_483_648.0;
            let (u, v) = (coordinate(), coordinate());
            let square = u * u + v * v;
            if square < 1.0 {
                let factor = (-2.0 * libm::log(square) / square).sqrt();
                self.spare = Some(v * factor);
                return u * factor;
            }
        }
    }
}

impl TryRng for Draws {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok(self.word())
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(u64::from(self.word()) | u64::from(self.word()) << 32)
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        for chunk in bytes.chunks_mut(4) {
            chunk.copy_from_slice(&self.word().to_le_bytes()[..chunk.len()]);
        }
        Ok(())
    }
}

/// Returns the output of Philox4x32 with ten rounds.
fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for _ in 0..10 {
        let first = u64::from(counter[0]) * 0xD251_1F53;
        let second = u64::from(counter[2]) * 0xCD9E_8D57;
        counter = [
            (second >> 32) as u32 ^ counter[1] ^ key[0],
            second as u32,
            (first >> 32) as u32 ^ counter[3] ^ key[1],
            first as u32,
        ];
        key = [
            key[0].wrapping_add(0x9E37_79B9),
            key[1].wrapping_add(0xBB67_AE85),
        ];
    }
    counter
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The known answers that come with the authors' Random123 library.
    #[test]
    fn philox_gives_the_known_answers() {
        assert_eq!(
            philox([0; 4], [0; 2]),
            [0x6627_E8D5, 0xE169_C58D, 0xBC57_AC4C, 0x9B00_DBD8]
        );
        assert_eq!(
            philox([u32::MAX; 4], [u32::MAX; 2]),
            [0x408F_276D, 0x41C8_3B0E, 0xA20B_C7C6, 0x6D54_51FD]
        );
        assert_eq!(
            philox(
                [0x243F_6A88, 0x85A3_08D3, 0x1319_8A2E, 0x0370_7344],
                [0xA409_3822, 0x299F_31D0]
            ),
            [0xD16C_FE09, 0x94FD_CCEB, 0x5001_E420, 0x2412_6EA1]
        );
    }

    #[test]
    fn the_gaussian_has_the_moments_of_a_standard_normal() {
        let mut draws = Chance::of_run(1).draws(Channel::named("moments"));
        let count = 200_000;
        let mut sums = [0.0; 4];
        for _ in 0..count {
            let value = draws.gaussian();
            for (power, sum) in sums.iter_mut().enumerate() {
                *sum += libm::pow(value, power as f64 + 1.0);
            }
        }
        let [mean, square, cube, fourth] = sums.map(|sum| sum / f64::from(count));
        assert!(mean.abs() < 0.01, "{mean}");
        assert!((square - 1.0).abs() < 0.02, "{square}");
        assert!(cube.abs() < 0.05, "{cube}");
        assert!((fourth - 3.0).abs() < 0.1, "{fourth}");
    }

    proptest! {
        #[test]
        fn runs_robots_ticks_and_channels_draw_apart(
            run in any::<u64>(), robot in 0_u32..1000, tick in 0_u64..1_000_000,
        ) {
            let here = Chance::of_run(run).at(robot, tick);
            let channel = Channel::named("laser");
            let first = |chance: Chance, channel| chance.draws(channel).word();
            prop_assert_ne!(first(here, channel), first(Chance::of_run(run ^ 1).at(robot, tick), channel));
            prop_assert_ne!(first(here, channel), first(here.at(robot + 1, tick), channel));
            prop_assert_ne!(first(here, channel), first(here.at(robot, tick + 1), channel));
            prop_assert_ne!(first(here, channel), first(here, Channel::named("compass")));
            prop_assert_ne!(first(here, channel), first(here, channel.nth(0)));
        }
    }
}
