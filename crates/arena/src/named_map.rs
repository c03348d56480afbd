//! Maps and beliefs as programs in other languages write them; see the page `docs/brain.md`.

use alloc::collections::BTreeSet;

use serde::Deserialize;
use thiserror::Error;
use tolman_geom::Point;
use tolman_robot::{Guess, Landmark, MapLink, MapPlace, MapView, Position};

/// A map of places and links, which has not been [checked](Self::checked) yet.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct NamedMap {
    places: Vec<NamedPlace>,
    links: Vec<[u32; 2]>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct NamedPlace {
    id: u32,
    position: Option<[f64; 2]>,
    landmark: Option<Landmark>,
}

/// A place or a point where a program believes its robot to be.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct NamedGuess {
    place: Option<u32>,
    point: Option<[f64; 2]>,
    #[serde(default = "whole")]
    weight: f64,
}

const fn whole() -> f64 {
    1.0
}

/// Reason why a map or a belief cannot be one.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NamedError {
    /// Two places have one id.
    #[error("its map has place {id} twice; give each place an id of its own")]
    Twice {
        /// The id.
        id: u32,
    },
    /// A link leads to no place.
    #[error("link {link} of its map is with place {id}, which is not on the map")]
    Link {
        /// Number of the link, from 0.
        link: usize,
        /// The id.
        id: u32,
    },
    /// A belief names a place that the map has not.
    #[error("it believes to be at place {id}, which is not on its map")]
    NoPlace {
        /// The id.
        id: u32,
    },
    /// A guess has no position, or two.
    #[error("guess {guess} of its belief needs one of `place` and `point`")]
    Guess {
        /// Number of the guess, from 0.
        guess: usize,
    },
    /// A weight is no probability.
    #[error("guess {guess} of its belief has the weight {weight}; weights are from 0 to 1")]
    Weight {
        /// Number of the guess, from 0.
        guess: usize,
        /// The weight.
        weight: f64,
    },
    /// A certainty is no probability.
    #[error("its verdict has the certainty {certainty}; it is from 0 to 1")]
    Certainty {
        /// The certainty.
        certainty: f64,
    },
}

impl NamedMap {
    /// Returns the map, whatever its ids name.
    pub(crate) fn view(&self) -> MapView {
        let place = |place: &NamedPlace| MapPlace {
            id: place.id,
            position: place.position.map(Point::from),
            landmark: place.landmark,
        };
        let link = |[from, to]: &[u32; 2]| MapLink {
            from: *from,
            to: *to,
        };
        MapView {
            places: self.places.iter().map(place).collect(),
            links: self.links.iter().map(link).collect(),
            ..MapView::default()
        }
    }

    /// Returns the map, whose ids name its places. O(map · log places).
    ///
    /// # Errors
    /// [`NamedError`] if two places have one id, or a link leads to no place.
    pub(crate) fn checked(&self) -> Result<MapView, NamedError> {
        let mut ids = BTreeSet::new();
        for NamedPlace { id, .. } in &self.places {
            if !ids.insert(*id) {
                return Err(NamedError::Twice { id: *id });
            }
        }
        for (link, ends) in self.links.iter().enumerate() {
            if let Some(id) = ends.iter().find(|id| !ids.contains(id)) {
                return Err(NamedError::Link { link, id: *id });
            }
        }
        Ok(self.view())
    }
}

impl NamedGuess {
    /// Returns the guesses of a belief.
    ///
    /// # Errors
    /// [`NamedError`] if one is no guess.
    pub(crate) fn all(belief: &[Self]) -> Result<Vec<Guess>, NamedError> {
        let numbered = belief.iter().enumerate();
        let guess = |(guess, named): (usize, &Self)| {
            let weight = named.weight;
            if !(0.0..=1.0).contains(&weight) {
                return Err(NamedError::Weight { guess, weight });
            }
            let at = match (named.place, named.point) {
                (Some(place), None) => Position::Place(place),
                (None, Some(point)) => Position::Point(Point::from(point)),
                _ => return Err(NamedError::Guess { guess }),
            };
            Ok(Guess { at, weight })
        };
        numbered.map(guess).collect()
    }
}
