//! Past inputs mixed into a stream, so that its order does not matter.

use alloc::string::String;
use alloc::vec::Vec;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::error::{AT_LEAST_1, check_count, check_header, within};
use crate::{
    Events, InputError, NearestTwo, Network, Quantizer, QuantizerConfigError, Scalar, SnapshotError,
};

/// A quantizer that remembers some of its inputs and learns from them again and again.
///
/// A robot's inputs come in the order of its way: one place for a while, then another. A quantizer
/// that learns from them as they come spends its units on where the robot has been last. This one
/// keeps a sample of the past. For every new input it lets the quantizer learn from `per_input`
/// remembered ones, drawn at random. The input itself is learnt when it is drawn.
///
/// ```
/// use tolman_quantizers::{Gng, GngConfig, Quantizer, ReplayConfig, ReplayQuantizer};
///
/// let gng = Gng::<f32>::new(2, GngConfig::in_order(30))?;
/// let mut gng = ReplayQuantizer::new(gng, ReplayConfig::measured(7))?;
/// // Slowly once around a ring.
/// let ring = (0..5000_u16).map(|step| f32::from(step) * 0.00125);
/// let ring: Vec<_> = ring.map(|angle| [angle.cos(), angle.sin()]).collect();
/// for input in &ring {
///     gng.observe(input)?;
/// }
/// assert!(gng.network().quantization_error(&ring)?.mean < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Complexity
/// `per_input` inputs of the quantizer for one. The memory takes `capacity` × features numbers.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        try_from = "SavedReplay<S, Q>",
        into = "SavedReplay<S, Q>",
        bound(
            serialize = "S: Scalar + serde::Serialize, Q: Quantizer<S> + Clone + serde::Serialize",
            deserialize = "S: Scalar + serde::Deserialize<'de>, Q: Quantizer<S> + serde::Deserialize<'de>"
        )
    )
)]
pub struct ReplayQuantizer<S, Q> {
    config: ReplayConfig,
    quantizer: Q,
    /// Features of the remembered inputs, one input after another.
    memory: Vec<S>,
    /// Input that is copied from the memory to the quantizer. The vector is kept to avoid an
    /// allocation.
    drawn: Vec<S>,
    /// Number of inputs so far.
    seen: u64,
    chance: ChaCha8Rng,
}

/// Choice of remembered inputs, and how often they are learnt.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ReplayConfig {
    /// Number of remembered inputs, at least 1.
    pub capacity: u32,
    /// Number of remembered inputs learnt for each new one, at least 1.
    pub per_input: u32,
    /// Rule for the inputs that are remembered.
    pub memory: ReplayMemory,
    /// Seed of the draws.
    pub seed: u64,
}

/// Rule for the inputs that are kept once there are more than fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ReplayMemory {
    /// Keeps each input so far with the same probability (reservoir sampling, algorithm R of Vitter
    /// 1985): for worlds that do not change.
    #[default]
    Reservoir,
    /// Keeps the most recent inputs: for worlds that change.
    Recent,
}

impl ReplayConfig {
    /// Returns a reservoir of 10,000 inputs, of which 8 are learned for each new one. It suits all
    /// streams that we tried (`docs/quantizers.md`), and is not from a paper.
    pub fn measured(seed: u64) -> Self {
        Self {
            capacity: 10_000,
            per_input: 8,
            memory: ReplayMemory::Reservoir,
            seed,
        }
    }

    fn check(&self) -> Result<(), QuantizerConfigError> {
        within("capacity", self.capacity, AT_LEAST_1)?;
        within("per_input", self.per_input, AT_LEAST_1)
    }
}

impl<S: Scalar, Q: Quantizer<S>> ReplayQuantizer<S, Q> {
    /// Returns a quantizer that learns through a memory of past inputs.
    ///
    /// # Errors
    /// If a field of `config` is outside its range.
    pub fn new(quantizer: Q, config: ReplayConfig) -> Result<Self, QuantizerConfigError> {
        config.check()?;
        Ok(Self {
            config,
            quantizer,
            memory: Vec::new(),
            drawn: Vec::new(),
            seen: 0,
            chance: ChaCha8Rng::seed_from_u64(config.seed),
        })
    }

    /// Returns the quantizer that learns.
    pub fn quantizer(&self) -> &Q {
        &self.quantizer
    }

    /// Returns the inner quantizer; the remembered inputs are dropped.
    pub fn into_quantizer(self) -> Q {
        self.quantizer
    }

    /// Returns the number of remembered inputs.
    pub fn remembered(&self) -> usize {
        self.memory.len() / self.network().dimension()
    }

    fn remember(&mut self, input: &[S]) {
        let capacity = u64::from(self.config.capacity);
        self.seen += 1;
        if self.seen <= capacity {
            self.memory.extend_from_slice(input);
            return;
        }
        let place = match self.config.memory {
            ReplayMemory::Recent => (self.seen - 1) % capacity,
            ReplayMemory::Reservoir => self.chance.random_range(0..self.seen),
        };
        if place < capacity {
            let start = place as usize * input.len();
            self.memory[start..start + input.len()].copy_from_slice(input);
        }
    }

    fn draw(&mut self) {
        let dimension = self.network().dimension();
        let remembered = self.seen.min(self.config.capacity.into()) as u32;
        let start = self.chance.random_range(0..remembered) as usize * dimension;
        self.drawn.clear();
        self.drawn
            .extend_from_slice(&self.memory[start..start + dimension]);
    }
}

/// Complete state of a [`ReplayQuantizer`], to be saved and resumed.
///
/// With the feature `serde`, `ReplayQuantizer` itself is serialized in this form. Deserializing
/// refuses invalid values.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SavedReplay<S, Q> {
    /// Name of the format: `tolman-replay-quantizer`. Earlier releases wrote `tolman-replay`.
    pub format: String,
    /// Version of the format.
    pub version: u32,
    /// Parameters of the memory.
    pub config: ReplayConfig,
    /// The quantizer that learns.
    pub quantizer: Q,
    /// Features of the remembered inputs, one input after another.
    pub memory: Vec<S>,
    /// Number of inputs so far.
    pub seen: u64,
    /// Number of 32-bit random words drawn so far.
    pub words: u64,
}

const FORMAT: &str = "tolman-replay-quantizer";
const VERSION: u32 = 1;

/// Earlier name of the format, which replays of runs have too.
const FORMER_FORMAT: &str = "tolman-replay";

impl<S: Scalar, Q: Quantizer<S>> From<ReplayQuantizer<S, Q>> for SavedReplay<S, Q> {
    fn from(replay: ReplayQuantizer<S, Q>) -> Self {
        Self {
            format: FORMAT.into(),
            version: VERSION,
            config: replay.config,
            quantizer: replay.quantizer,
            memory: replay.memory,
            seen: replay.seen,
            // 2⁶⁴ words are more than can be drawn.
            words: replay.chance.get_word_pos() as u64,
        }
    }
}

impl<S: Scalar, Q: Quantizer<S>> TryFrom<SavedReplay<S, Q>> for ReplayQuantizer<S, Q> {
    type Error = SnapshotError;

    /// Resumes a saved quantizer.
    fn try_from(saved: SavedReplay<S, Q>) -> Result<Self, SnapshotError> {
        let format = match saved.format.as_str() {
            FORMER_FORMAT => FORMAT,
            format => format,
        };
        check_header(format, saved.version, FORMAT, VERSION)?;
        saved.config.check()?;
        let network = saved.quantizer.network();
        let remembered = saved.seen.min(saved.config.capacity.into()) as usize;
        let expected = remembered.saturating_mul(network.dimension());
        check_count("remembered features", expected, saved.memory.len())?;
        for (input, values) in saved.memory.chunks(network.dimension()).enumerate() {
            network
                .check(values)
                .map_err(|source| SnapshotError::BadMemory { input, source })?;
        }
        let mut chance = ChaCha8Rng::seed_from_u64(saved.config.seed);
        chance.set_word_pos(saved.words.into());
        Ok(Self {
            config: saved.config,
            quantizer: saved.quantizer,
            memory: saved.memory,
            drawn: Vec::new(),
            seen: saved.seen,
            chance,
        })
    }
}

impl<S: Scalar, Q: Quantizer<S>> Quantizer<S> for ReplayQuantizer<S, Q> {
    fn observe(&mut self, input: &[S]) -> Result<NearestTwo<S>, InputError> {
        self.network().check(input)?;
        self.remember(input);
        for _ in 0..self.config.per_input {
            self.draw();
            self.quantizer.observe(&self.drawn)?;
        }
        self.nearest_two(input)
    }

    fn network(&self) -> &Network<S> {
        self.quantizer.network()
    }

    fn events(&mut self) -> &mut Events {
        self.quantizer.events()
    }
}
