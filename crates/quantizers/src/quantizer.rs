//! Defines the common interface of quantizers.

use crate::{Events, InputError, Nearest, NearestTwo, Network, NetworkSnapshot, Scalar};

/// Learns a graph of prototypes from inputs, one by one.
///
/// A map whose states are units needs only this trait: it observes inputs, finds the nearest unit
/// and reads the [`Network`].
pub trait Quantizer<S: Scalar> {
    /// Learns from one input, and returns the two units nearest to it.
    ///
    /// The first is the unit that now stands for the input, with its distance when the input came.
    /// It is the nearest unit, or the one that was made of the input, at distance 0. The second is
    /// the nearest other unit when the input came, if there was one.
    ///
    /// # Errors
    /// If the input has another number of features than the network, or one that is NaN, infinite
    /// or so large that squares overflow. Nothing is learned then.
    fn observe(&mut self, input: &[S]) -> Result<NearestTwo<S>, InputError>;

    /// Returns the units and their edges.
    fn network(&self) -> &Network<S>;

    /// Returns the log of the changes to units and edges.
    fn events(&mut self) -> &mut Events;

    /// Returns the unit nearest to `input`.
    ///
    /// # Errors
    /// If the input is invalid, as for [`observe`](Self::observe), or there are no units.
    fn nearest(&self, input: &[S]) -> Result<Nearest<S>, InputError> {
        self.network().nearest(input)
    }

    /// Returns the two units nearest to `input`.
    ///
    /// # Errors
    /// As [`nearest`](Self::nearest).
    fn nearest_two(&self, input: &[S]) -> Result<NearestTwo<S>, InputError> {
        self.network().nearest_two(input)
    }

    /// Returns a copy of the units and edges as they are now.
    fn snapshot(&self) -> NetworkSnapshot<S> {
        self.network().snapshot()
    }
}
