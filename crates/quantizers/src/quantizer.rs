//! What all quantizers have in common.

use crate::{InputError, Nearest, NearestTwo, Network, Scalar};

/// Learns a graph of prototypes from one input after the other.
///
/// Maps that are built on states need no more than this: feed it, ask which unit is nearest, look at its
/// [`Network`].
pub trait Quantizer<S: Scalar> {
    /// Learns from one input.
    ///
    /// # Errors
    /// If the input has another number of features than the network, or one that is NaN, infinite
    /// or so large that squares overflow. Nothing is learnt then.
    fn observe(&mut self, input: &[S]) -> Result<Observation<S>, InputError>;

    /// The units, their edges and their events.
    fn network(&self) -> &Network<S>;

    /// The same, to listen to events.
    fn network_mut(&mut self) -> &mut Network<S>;

    /// The unit nearest to `input`.
    ///
    /// # Errors
    /// If the input is invalid, as for [`observe`](Self::observe), or there are no units.
    fn nearest(&self, input: &[S]) -> Result<Nearest<S>, InputError> {
        self.network().nearest(input)
    }

    /// The two units nearest to `input`.
    ///
    /// # Errors
    /// As [`nearest`](Self::nearest).
    fn nearest_two(&self, input: &[S]) -> Result<NearestTwo<S>, InputError> {
        self.network().nearest_two(input)
    }
}

/// What one input met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation<S> {
    /// The unit that stands for the input now, and its distance when the input came: the nearest unit, or the one that was
    /// made of the input, at distance 0.
    pub winner: Nearest<S>,
    /// The nearest unit but the winner when the input came, if there was one.
    pub second: Option<Nearest<S>>,
}
