//! Streaming vectors in, a growing graph of prototypes out.
//!
//! A quantizer observes inputs one by one, each a slice of `f32` or `f64`, and grows a graph. Each
//! *unit* holds a *prototype* near the inputs it stands for. *Edges* join units whose inputs are
//! neighbours. In the order data flows:
//!
//! - [`Scalar`]: what an input is made of;
//! - [`Quantizer::observe`] takes an input and learns: [`Gng`], as its [`GngConfig`] says, or
//!   [`Soinn`], which chooses the number of its units and clusters itself;
//! - it names the [`NearestTwo`] units that it met;
//! - the [`Network`] has the units, their edges and [`Clusters`], answers which unit is nearest to
//!   something, and measures the [`QuantizationError`];
//! - an [`AssociativeMemory`] recalls one part of what was learnt from another;
//! - [`Event`]s tell what came and went, for maps that stand on the units.
//!
//! ```
//! use tolman_quantizers::{Gng, GngConfig, Quantizer};
//!
//! // Points on two rings, in order around each.
//! let mut config = GngConfig::default();
//! config.max_units = 40;
//! let mut gng = Gng::<f64>::new(2, config)?;
//! for step in 0..20_000_u32 {
//!     let angle = f64::from(step) * 0.7;
//!     let centre = if step % 2 == 0 { -2.0 } else { 2.0 };
//!     gng.observe(&[centre + angle.cos(), angle.sin()])?;
//! }
//! // The graph has found that there are two.
//! let clusters = gng.network().clusters();
//! assert_eq!(clusters.count(), 2);
//! let left = gng.nearest(&[-3.0, 0.0])?.id;
//! let right = gng.nearest(&[3.0, 0.0])?.id;
//! assert_ne!(clusters.label(left)?, clusters.label(right)?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Everything is deterministic: ties go to the smaller id, and nothing here draws random numbers
//! unasked. What is invalid (NaN, infinities, the wrong size, values whose squares overflow) is
//! refused with a typed error and not learnt.
//!
//! # A quantizer of your own
//!
//! `cargo run --example own_quantizer`:
#![doc = "```"]
#![doc = include_str!("../examples/own_quantizer.rs")]
#![doc = "```"]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use rand;

mod associative_memory;
mod error;
mod event;
mod gng;
mod network;
mod quantizer;
mod replay;
mod scalar;
mod soinn;
mod unit;

pub use associative_memory::{AssociativeMemory, Chain, Recall};
pub use error::{InputError, QuantizerConfigError, SnapshotError, UnknownUnit};
pub use event::{Event, Events};
pub use gng::{ErrorKind, Gng, GngConfig, GrowthGate, Removal, SavedGng, StepOrder, Utility};
pub use network::{
    Clusters, Edge, Lanes, Network, NetworkSnapshot, QuantizationError, SnapshotUnit, UnitSearch,
};
pub use quantizer::Quantizer;
pub use replay::{ReplayConfig, ReplayMemory, ReplayQuantizer, SavedReplay};
pub use scalar::Scalar;
pub use soinn::{
    Denoising, ErrorInsertion, SavedSoinn, SecondLayerConfig, SecondLayerError, SecondThreshold,
    SimilarityThreshold, Soinn, SoinnConfig, Tally,
};
pub use unit::{Nearest, NearestTwo, UnitId};
