//! The diktiometry: the map as an adaptive planning resource (Engelson and McDermott).
//!
//! "The world is modelled as a set of places with relative positions and known actions that get the
//! robot from place to place." An [`Observer`] watches the moves of any robot and keeps a
//! [`Diktiometry`]. It consists of two graphs, with reference links between them. The *path graph*
//! has places and actions. The *reference graph* has local frames with bounds on their positions.
//!
//! In the order data flows (the paper's figure 1):
//!
//! 1. An [`ObservedMove`] comes in: action, odometry within bounds, percept, how it ended.
//! 2. The *projector* (`projector`) moves every [`Track`].
//! 3. The *indexer* (`indexing`) proposes places it may be at: expected, near, or looking alike.
//! 4. The *matching engine* (`matching`) asks the [`Matcher`]s, in an order that depends on what is
//!    known of the area.
//! 5. The *updater* (`updater`) narrows boxes and counts links.
//! 6. The *restructurer* (`restructuring`) merges, splits and elides.
//! 7. A [`StepReport`] says what was done; [`Observer::opportunities`] what would help.
//!
//! ```
//! use tolman_geom::{Interval, Point, PointBox, PoseBox};
//! use tolman_maps::diktiometry::{Action, Config, Exits, FirstPlace, Matcher, MoveOutcome, ObservedMove, Observer};
//!
//! // Places are a metre apart and look alike; the robot can go north, east, south and west.
//! let config = Config::new(Config::compass_actions(), 1.0);
//! let mut observer = Observer::new(config, FirstPlace::default())?;
//! let home = observer.place();
//! let go = |action, x, y| ObservedMove {
//!     action: Action(action),
//!     odometry: PoseBox::new(PointBox::about(Point::new(x, y), 0.1).unwrap(), Interval::ZERO),
//!     percept: None,
//!     exits: Exits::Unknown,
//!     outcome: MoveOutcome::Arrived,
//! };
//! // East and back: the way back leads to where it began.
//! let out = observer.step(&go(1, 1.0, 0.0))?;
//! assert_eq!(out.tracks[0].matcher, Some(Matcher::NewPlace));
//! let back = observer.step(&go(3, -1.05, 0.02))?;
//! assert_eq!(back.tracks[0].matcher, Some(Matcher::Continue));
//! assert_eq!(back.tracks[0].place, home);
//! // Two estimates of one way have narrowed it.
//! let way = back.tracks[0].motion.unwrap();
//! assert!(way.x.width() < 0.2);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod adapter;
mod config;
mod constancy;
mod counts;
mod coverage_grid;
mod error;
mod estimator;
mod ids;
mod indexing;
mod journal;
mod look_learning;
mod looks;
mod map;
#[cfg(feature = "serde")]
mod map_file;
mod mapper;
mod matching;
mod memory;
mod merge_certificate;
mod observation;
mod observer;
mod open_pairs;
mod opportunities;
mod path_graph;
mod place_belief;
mod projector;
mod reference_graph;
mod report;
mod restructuring;
mod self_check;
mod signature;
mod track;
mod updater;
mod winding;

pub use config::{
    ActionKind, Apart, CompassAxis, Config, DiktiometryConfigError, GeometricIndexing,
    GeometricMerge, Identity, Indexing, JournalLength, Matching, Opportunities, Percepts,
    PerceptualIndexing, Precedence, Restructuring, SearchLimits, SignatureKind, Tracking,
    Transients, Use, ViewRotation, WorldKind,
};
pub use constancy::Constancy;
pub use counts::Counts;
pub use coverage_grid::CoverageGrid;
pub use error::{ObservedMoveError, StartError};
pub use ids::{Action, FrameId, LinkId, PlaceId, TrackId};
pub use indexing::ActiveFrame;
pub use journal::{Distinction, Journal, JournalError, UndoError};
pub use looks::Looks;
pub use map::{Diktiometry, DrawnPlace, Flaw};
#[cfg(feature = "serde")]
pub use map_file::{MapFile, MapFileError};
pub use matching::Matcher;
pub use merge_certificate::{
    CertifiedMerges, JournalSpan, LookEvidence, LookPair, MergeCertificate, MergeCertificateError,
    MergeProof, WindingEvidence, certify_merges, verify_merges,
};
pub use observation::{Exits, FirstPlace, MoveOutcome, ObservedMove};
pub use observer::Observer;
pub use open_pairs::{DecidingWalk, OpenPair};
pub use opportunities::{Opportunity, OpportunityKind};
pub use path_graph::{
    Estim, Fate, Ground, Link, LinkStatus, MergeNote, PathGraph, Place, Successor,
};
pub use place_belief::{Explained, PlaceBelief};
pub use reference_graph::{Excluded, Frame, ReferenceGraph, Relation};
pub use report::{
    Contradiction, Culprit, PlanStep, Predicted, Restructured, Restructurer, StepReport,
    TrackReport,
};
pub use self_check::{MapState, SelfCheck};
pub use signature::{Signature, SignatureError};
pub use track::{Track, TrackEntry};

use counts::Expected;
use estimator::{Rank, trusted_odometry};
use indexing::{Candidate, Expectation, ViewIndex, expected, moved, plies};
use looks::{Agreeing, Similarity};
use matching::{Choice, Situation, agrees, alike, choose, remember, share_a_view, similarity};
use opportunities::steps_along;
use projector::Projection;
use reference_graph::{Reached, search};
use restructuring::{Hints, deposit, elide_place, learn_of_two, restructure, wanted_anywhere};
use updater::merge_estims;
use winding::{Chain, Corridors, Turns, is_rectangle};
