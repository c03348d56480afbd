// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;

use tolman_quantizers::{Gng, SavedGng};
use tolman_robot::PinholeCamera;

use super::feature_space::Part;
use super::{FeatureSpace, PlaceMap, PlaceMapConfig, PlaceMapError};

const FORMAT: &str = "tolman-place-map";
const VERSION: u32 = 1;

/// Contents of a place map's file; works with any format of serde's. Images are stored as pixels.
///
/// [`PlaceMap`] itself is serialized as this, and refuses invalid contents.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedPlaceMap {
    format: String,
    version: u32,
    parts: Vec<Part>,
    camera: Option<PinholeCamera>,
    config: PlaceMapConfig,
    gng: SavedGng<f32>,
}

impl From<PlaceMap> for SavedPlaceMap {
    fn from(map: PlaceMap) -> Self {
        let PlaceMap {
            space, config, gng, ..
        } = map;
        let mut gng = SavedGng::from(gng);
        let expanded = space.expanded();
        for unit in &mut gng.network.units {
            unit.prototype = space.expand(&unit.prototype);
        }
        gng.network.dimension = expanded.dimension();
        gng.network.weights = Some(expanded.weights(&config.weights));
        Self {
            format: FORMAT.into(),
            version: VERSION,
            parts: expanded.parts,
            camera: expanded.camera,
            config,
            gng,
        }
    }
}

impl TryFrom<SavedPlaceMap> for PlaceMap {
    type Error = PlaceMapError;

    fn try_from(saved: SavedPlaceMap) -> Result<Self, PlaceMapError> {
        saved.check()?;
        let space = FeatureSpace {
            parts: saved.parts,
            camera: saved.camera,
            span: None,
        };
        let (expected, found) = (space.dimension(), saved.gng.network.dimension);
        if expected != found {
            return Err(PlaceMapError::WrongDimension { expected, found });
        }
        let gng = Gng::try_from(saved.gng)?;
        Ok(Self::of(Arc::new(space), saved.config, gng))
    }
}

impl SavedPlaceMap {
    /// Refuses other formats, and scales that are not above zero.
    fn check(&self) -> Result<(), PlaceMapError> {
        if self.format != FORMAT || self.version != VERSION {
            return Err(PlaceMapError::WrongFormat {
                format: self.format.clone(),
                version: self.version,
            });
        }
        let bad = |part: &&Part| !(part.scale.is_finite() && part.scale > 0.0);
        self.parts.iter().find(bad).map_or(Ok(()), |part| {
            Err(PlaceMapError::BadScale {
                group: part.group.name(),
                scale: part.scale,
            })
        })
    }
}
