use thiserror::Error;
use tolman_quantizers::{InputError, QuantizerConfigError, SnapshotError};

/// Reason why records do not have the chosen features.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FeatureError {
    /// There are no records, from whose variation features are scaled.
    #[error("there are no records to scale the features by: give the records of the places first")]
    NoRecords,
    /// No group is chosen, or a group has no values.
    #[error(
        "the features have no values: choose a group, images of one pixel at least, records with soundings"
    )]
    NoFeatures,
    /// A group stands twice in the choice.
    #[error("the {group} is chosen twice: name each group once, and give it more weight instead")]
    ChosenTwice {
        /// Name of the group.
        group: &'static str,
    },
    /// A record has no picture.
    #[error(
        "record {record} has no picture: leave the record out, or the image out of the features"
    )]
    NoPicture {
        /// Number of the record, from 0.
        record: usize,
    },
    /// A record's picture has no pixels, or not as many as its size.
    #[error(
        "the picture of record {record} has {found} pixels where {width} × {height} were expected: leave the record out"
    )]
    BadPicture {
        /// Number of the record, from 0.
        record: usize,
        /// Number of pixels across.
        width: u32,
        /// Number of pixels down.
        height: u32,
        /// Number of pixels in the picture.
        found: usize,
    },
    /// A record has another number of soundings than the first.
    #[error(
        "record {record} has {found} soundings where the first has {expected}: leave it out, or the sonar out of the features"
    )]
    OtherSoundings {
        /// Number of the record, from 0.
        record: usize,
        /// Number of soundings in the first record.
        expected: usize,
        /// Number of soundings in the refused record.
        found: usize,
    },
    /// A range or a position is NaN or infinite.
    #[error("the {group} of record {record} is not finite: leave the record out or repair it")]
    NotFinite {
        /// Number of the record, from 0.
        record: usize,
        /// Name of the group.
        group: &'static str,
    },
}

/// Reason why a place map cannot be learned, queried or read.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PlaceMapError {
    /// A record has no such features.
    #[error(transparent)]
    Features(#[from] FeatureError),
    /// A parameter of the growing neural gas, or a weight, is outside its range.
    #[error(transparent)]
    Config(#[from] QuantizerConfigError),
    /// The features of a record are too large, or the map has no nodes yet.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The saved network is invalid.
    #[error(transparent)]
    Network(#[from] SnapshotError),
    /// There are fewer than two records, with which the gas begins.
    #[error("{found} records are too few for a map: give at least two")]
    TooFewRecords {
        /// Number found.
        found: usize,
    },
    /// A record's number is beyond the table.
    #[error("there is no record {record}: give a number below {count}")]
    NoSuchRecord {
        /// Number of the record, from 0.
        record: usize,
        /// Number of records in the table.
        count: usize,
    },
    /// The file has another format, or a later version.
    #[error("this is {format:?} of version {version}; give \"tolman-place-map\" of version 1")]
    WrongFormat {
        /// Format that the file states.
        format: alloc::string::String,
        /// Version that the file names.
        version: u32,
    },
    /// The network of a saved map has another number of features than its groups have values.
    #[error(
        "the saved network has {found} features where its groups have {expected}: it was changed or cut off"
    )]
    WrongDimension {
        /// Number of values of all groups.
        expected: usize,
        /// Number of features of the network.
        found: usize,
    },
    /// A saved scale is not above zero.
    #[error("the saved scale of the {group} is {scale}: it has to be finite and above 0")]
    BadScale {
        /// Name of the group.
        group: &'static str,
        /// Scale that was saved.
        scale: f32,
    },
}
