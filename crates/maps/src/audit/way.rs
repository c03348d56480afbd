//! Ways through odometry and believed closures.

use alloc::vec::Vec;

use super::chain::Chain;
use super::link::{Gap, Link};
use super::motion::{Motion, Spread};

/// One part of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Leg {
    /// Along the odometry, from a pose to another of the same piece.
    Span(u32, u32),
    /// Over a closure, from its lower pose to its higher.
    Up(u32),
    /// Over a closure, from its higher pose to its lower.
    Down(u32),
}

/// A way from the lower pose of a closure to its higher.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Way {
    pub(super) legs: Vec<Leg>,
}

impl Way {
    /// Returns the closures that the way leads over.
    pub(super) fn closures(&self) -> impl Iterator<Item = u32> {
        self.legs.iter().filter_map(|leg| match leg {
            Leg::Span(..) => None,
            Leg::Up(link) | Leg::Down(link) => Some(*link),
        })
    }

    /// Adds a span; one of no length is ignored, and one that continues the last lengthens it.
    pub(super) fn span(&mut self, from: u32, to: u32) {
        if let Some(Leg::Span(_, end)) = self.legs.last_mut() {
            *end = to;
        } else if from != to {
            self.legs.push(Leg::Span(from, to));
        }
    }

    /// Returns the way along odometry alone.
    pub(super) fn of_odometry(link: &Link) -> Self {
        let mut way = Self::default();
        way.span(link.first, link.second);
        way
    }

    /// Returns the way over one other closure.
    pub(super) fn over(link: &Link, other: u32, links: &[Link]) -> Self {
        let mut way = Self::default();
        let over = &links[other as usize];
        way.span(link.first, over.first);
        way.legs.push(Leg::Up(other));
        way.span(over.second, link.second);
        way
    }

    /// Returns the gap of `link` from this way. O(legs).
    pub(super) fn gap(&self, link: &Link, links: &[Link], chain: &Chain) -> Gap {
        let (mut off, mut spread) = (Motion::NONE, Spread::default());
        for leg in &self.legs {
            match *leg {
                Leg::Span(from, to) => spread = spread.plus(&chain.span(from, to)),
                Leg::Up(over) => {
                    let over = &links[over as usize];
                    off = off.then(&over.off);
                    spread = spread.seen_from(&over.off_inverse).plus(&over.spread);
                }
                Leg::Down(over) => {
                    let over = &links[over as usize];
                    off = off.then(&over.off_inverse);
                    spread = spread.plus(&over.spread).seen_from(&over.off);
                }
            }
        }
        let spread = spread.plus(&link.spread);
        Gap::of(&off.inverse().then(&link.off), &spread)
    }
}
