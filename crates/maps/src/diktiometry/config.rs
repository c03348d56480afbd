use alloc::vec::Vec;
use core::ops::Bound::{self, Excluded, Included};
use core::ops::RangeInclusive;

use thiserror::Error;
use tolman_geom::{Interval, OutOfRange, POSITIVE, PointBox};

use super::{Action, Exits, Similarity};

/// Knowledge of the observer about robot and world, and the choice of its parts.
///
/// The paper gives no numbers but the error of odometry (10 % of the distance), so there is no
/// `Default`. [`Config::new`] sets the values proposed here, each with its reason. Lengths are in
/// metres of the odometry.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Config {
    /// The robot's control routines.
    pub actions: Vec<ActionKind>,
    /// δ_sep: minimum distance of two places, m, > 0 (*Geometric constraints*).
    pub separation: f64,
    /// Minimum distance of two places that look alike and, if the world is static, have the same
    /// [`Exits`], m; at least `separation`. Where these tell places apart, this lets boxes be
    /// wider.
    pub alike_separation: f64,
    /// Measure of the distances above.
    #[cfg_attr(feature = "serde", serde(default))]
    pub apart: Apart,
    /// Maximum distance across the axis of a straight action between the places at its ends, m, ≥
    /// 0; see [`ActionKind::leads`].
    #[cfg_attr(feature = "serde", serde(default))]
    pub across: f64,
    /// Whether the world may change.
    #[cfg_attr(feature = "serde", serde(default))]
    pub world: WorldKind,
    /// Maximum distance from a place's point at which the robot ends a move, m, ≥ 0.
    pub place_radius: f64,
    /// Bound of an error of scale common to all odometry, as a share of the distance, 0 ≤ … < 1. It
    /// cancels round every cycle, so it widens no box and only brings places nearer together: the
    /// map is in metres of the odometry.
    pub shared_scale: f64,
    /// Whether percepts come with moves.
    pub percepts: Percepts,
    /// Half the maximum width of a new place's box in the frame it was reached from, m, ≥ 0. A
    /// place with a wider box opens a frame of its own; at 0 every place does.
    pub frame_half_width: f64,
    /// Limits of the search through the reference graph.
    pub search: SearchLimits,
    /// Parameters of the paper's *Indexing places*.
    pub indexing: Indexing,
    /// Parameters of the paper's *Matching and updating*.
    pub matching: Matching,
    /// Maximum number of hypotheses (tracks), and the rules for dropping them.
    pub tracks: Tracking,
    /// Parameters of *Transients*.
    pub transients: Transients,
    /// Parameters of *Place restructuring*.
    pub restructuring: Restructuring,
    /// Parameters of *Opportunistic mapping*.
    pub opportunities: Opportunities,
    /// Length of the record from which decisions can be undone.
    pub journal: JournalLength,
}

/// Prior knowledge of an action.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ActionKind {
    /// Action that usually leads back, for advice. The map trusts its observations instead, unless
    /// the world is [static](WorldKind::Static).
    pub reverse: Option<Action>,
    /// Axis of the compass along which the action leads straight; `None` if its ways may bend.
    #[cfg_attr(feature = "serde", serde(default))]
    pub leads: Option<CompassAxis>,
}

/// An axis of the compass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum CompassAxis {
    /// From west to east.
    EastWest,
    /// From south to north.
    NorthSouth,
}

/// Measure in which two places are at least δ_sep apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Apart {
    /// Distance between the two places, as in the paper.
    #[default]
    Distance,
    /// Distance along one axis of the compass. It holds where corridors follow the axes, but not in
    /// halls and slanted corridors.
    Side,
}

impl Apart {
    /// Returns the greatest distance of two places with a displacement in `offset`, m.
    pub(super) fn most(self, offset: PointBox) -> f64 {
        match self {
            Self::Distance => offset.norm().high(),
            Self::Side => {
                let farthest = |side: Interval| side.high().max(-side.low());
                farthest(offset.x).max(farthest(offset.y))
            }
        }
    }
}

/// Whether the world may change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum WorldKind {
    /// Doors shut and corridors open: earlier results of an action say little about its next one.
    #[default]
    Changing,
    /// An action always leads from a place to the same place, and its reverse back.
    Static,
}

/// Whether a part is active; off for ablations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Use {
    /// The part is active.
    On,
    /// The part is left out.
    #[default]
    Off,
}

/// The kind of view that the robot has of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Percepts {
    /// Nothing.
    None,
    /// Every move comes with a signature.
    Signatures(SignatureKind),
}

/// Form of the signatures, and the rule for two views of one place.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SignatureKind {
    /// Number of values in a column, ≥ 1.
    pub rows: usize,
    /// Number of columns, ≥ 1.
    pub columns: usize,
    /// Maximum difference between values of two views of one place, in the units of the values, ≥
    /// 0: twice the bound of the sensor's noise.
    pub tolerance: f64,
    /// Share of the columns that have to agree, 0 < … ≤ 1.
    pub share: f64,
    /// Whether views may be rotated against each other.
    pub rotation: ViewRotation,
    /// Number of views kept per place, ≥ 1.
    pub views: usize,
}

/// Whether views of one place may be rotated against each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ViewRotation {
    /// Views are not rotated: a compass turns them all north.
    Aligned,
    /// Views may be rotated by any number of columns.
    Free,
}

/// Limits of a search of the reference graph from a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SearchLimits {
    /// Maximum uncertainty of a frame that is reached: the longer side of its box, m, > 0.
    pub width: f64,
    /// Maximum number of frames reached, ≥ 1.
    pub frames: usize,
    /// Maximum number of relations followed in a chain.
    pub depth: u32,
}

impl SearchLimits {
    /// No limits: all related frames are reached.
    pub(super) const UNLIMITED: Self = Self {
        width: f64::INFINITY,
        frames: usize::MAX,
        depth: u32::MAX,
    };
}

/// Modules that propose candidates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Indexing {
    /// Places predicted by the last action.
    pub expectational: Use,
    /// Places near the projected position.
    pub geometric: GeometricIndexing,
    /// Places that look like the percept.
    pub perceptual: PerceptualIndexing,
}

/// Features by which *Perceptual Indexing* tells views apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PerceptualIndexing {
    /// Views are not indexed: places are never proposed by their looks.
    Off,
    /// Indexes views by their columns.
    Columns,
    /// Indexes views by triples of the edges between columns, as triangles. Needs three columns or
    /// more; views with fewer than three edges are not found.
    Triangles,
}

/// The two methods of *Geometric Indexing*.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum GeometricIndexing {
    /// None.
    Off,
    /// Depth-limited search from the track's frame, repeated each time.
    Search,
    /// The set of active frames is carried over from move to move.
    ActiveFrames,
}

/// Rules for matching places.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Matching {
    /// Evidence that an unexpected place needs.
    pub identity: Identity,
    /// Precedence of the matchers.
    pub order: Precedence,
    /// The matcher CONTINUE. Without it an expected place needs the evidence of an unexpected one,
    /// except for α-MATCH.
    pub continuation: Use,
    /// Use of the matcher LINK. Without it, unexpected places are noted at most.
    pub link: Use,
    /// Use of the matcher α-MATCH.
    pub alpha: Use,
    /// Use of the matcher β-MATCH.
    pub beta: Use,
    /// Number of visits of the old place below which α-MATCH precedes a new place, because errors
    /// spoil young boxes.
    pub alpha_visits: u32,
    /// Maximum distance of a place to which β-MATCH snaps, as a share of the distance since the
    /// last CONTINUE, ≥ 0. It is never farther than `separation`.
    pub beta_reach: f64,
    /// Number of traversals from which a cell of the grid is well traversed.
    pub well_traversed: u32,
}

/// Rule by which an unexpected place is recognized as a known one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Identity {
    /// The paper's rule: the boxes meet. A wide box also meets the neighbours', which confuses
    /// different places.
    Meets,
    /// The box of the difference is too narrow to hold two places. Boxes that merely meet are
    /// noted, and merged once the box is narrow.
    Certain,
}

/// Precedence of the matchers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Precedence {
    /// One order for all: CONTINUE, LINK, α, new place, β, as in the paper's prototype.
    Static,
    /// Order that depends on the knowledge of the area and the track's confidence.
    Dynamic,
}

/// Number of hypotheses that are followed, and the rules for dropping them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Tracking {
    /// Maximum number of tracks, ≥ 1.
    pub cap: usize,
    /// Minimum confidence of a track, 0 … 1; below it the track dies.
    pub least_confidence: f64,
    /// Minimum confidence of a confident track, 0 … 1.
    pub high: f64,
    /// Maximum confidence of an unconfident track, 0 … `high`.
    pub low: f64,
    /// Number of matches that a history holds.
    pub history: usize,
}

/// Limits at which links and places count as transient: as hallucinations.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Transients {
    /// Whether transient links and places are removed from the map.
    pub elision: Use,
    /// Minimum share of expectations that are met, 0 … 1. A link or place below it, with 99 %
    /// certainty, is elided.
    pub rate: f64,
    /// Factor by which older counts fade with each expectation, in (0, 1]; at 1 nothing is
    /// forgotten.
    pub fading: f64,
}

/// The three restructurers and the veto among them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Restructuring {
    /// Geometric constraints on merging.
    pub geometric_merge: GeometricMerge,
    /// Geometric constraints on splitting.
    pub geometric_split: Use,
    /// Local path constraints on merging.
    pub local_merge: Use,
    /// Local path constraints on splitting.
    pub local_split: Use,
    /// Non-local path constraints on merging.
    pub non_local_merge: Use,
    /// W: minimum weight of an estim that counts.
    pub weight: f64,
    /// Q: ratio of the weights of two estims, larger to smaller, below which they split a place.
    pub ratio: f64,
    /// φ: share of the first estim's weight, in the union of two places. They merge if every other
    /// estim has less.
    pub minority: f64,
    /// Share of common links that proposes a merge, and share below which a merge is rejected.
    pub links: [f64; 2],
    /// Number of visits on which links have to rest.
    pub visits: u32,
    /// h: number of consistent histories that propose a merge.
    pub histories: usize,
    /// Merging by looks, beyond the paper.
    pub look_merge: Use,
    /// Maximum probability of a wrong merge by looks, 0 < … < 1.
    pub look_error: f64,
    /// Merging round rectangles, beyond the paper. Every place has to lie δ_sep or more beside the
    /// corridors that do not lead to it.
    #[cfg_attr(feature = "serde", serde(default))]
    pub winding_merge: Use,
}

impl Restructuring {
    /// Lets places merge by looks and by turns, beyond the paper. Corridors have to lie δ_sep
    /// apart, and the robot must not overlook a junction.
    pub const fn merge_by_looks_and_turns(&mut self) {
        self.look_merge = Use::On;
        self.winding_merge = Use::On;
    }
}

/// Geometric condition for merging two places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum GeometricMerge {
    /// Geometry never merges.
    Off,
    /// The paper's rule: the union of their estims has one mode.
    Estims,
    /// The box of their difference is too narrow to hold two places. Common links and histories do
    /// not suffice then: in a spiral whose places look alike they merged two places wrongly.
    Narrow,
}

impl GeometricMerge {
    /// Returns whether path constraints alone justify a merge.
    pub(super) const fn trusts_paths(self) -> bool {
        !matches!(self, Self::Narrow)
    }
}

/// Kinds of advice that are given.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Opportunities {
    /// Advice to go where the robot has not been.
    pub unknown: Use,
    /// Advice for *priming the pump*.
    pub priming: Use,
    /// Advice to go back and forth on a new link.
    pub shuttle: Use,
    /// Advice to walk again round a cycle whose ends may be one place.
    pub close_loop: Use,
    /// Number of traversals after which a link needs no shuttling.
    pub traversals: u32,
    /// Maximum length of the way to the beginning of a script, moves.
    pub reach: u32,
}

/// Moves that the journal keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum JournalLength {
    /// Nothing is kept.
    Off,
    /// All moves since the first.
    All,
}

impl Config {
    /// Returns the values proposed here, for places at least `separation` apart, m, that all look
    /// the same.
    #[must_use]
    pub fn new(actions: Vec<ActionKind>, separation: f64) -> Self {
        Self {
            actions,
            separation,
            alike_separation: separation,
            apart: Apart::Distance,
            across: 0.0,
            world: WorldKind::Changing,
            place_radius: 0.0,
            shared_scale: 0.0,
            percepts: Percepts::None,
            frame_half_width: 0.0,
            search: SearchLimits {
                width: 4.0 * separation,
                frames: 128,
                depth: u32::MAX,
            },
            indexing: Indexing {
                expectational: Use::On,
                geometric: GeometricIndexing::Search,
                perceptual: PerceptualIndexing::Columns,
            },
            matching: Matching {
                identity: Identity::Certain,
                order: Precedence::Dynamic,
                continuation: Use::On,
                link: Use::On,
                alpha: Use::On,
                beta: Use::On,
                alpha_visits: 5,
                beta_reach: 0.25,
                well_traversed: 3,
            },
            tracks: Tracking {
                cap: 8,
                least_confidence: 0.05,
                high: 0.7,
                low: 0.3,
                history: 10,
            },
            transients: Transients {
                elision: Use::On,
                // Together: what is gone is elided after 20 to 40 expectations in vain, what works
                // half the time never.
                rate: 0.3,
                fading: 0.92,
            },
            restructuring: Restructuring {
                geometric_merge: GeometricMerge::Narrow,
                geometric_split: Use::On,
                local_merge: Use::On,
                local_split: Use::On,
                non_local_merge: Use::On,
                weight: 5.0,
                ratio: 3.0,
                minority: 0.2,
                links: [0.8, 0.4],
                visits: 5,
                histories: 2,
                look_merge: Use::Off,
                // Some hundreds of merges are weighed in a run; the bounds behind it are wide.
                look_error: 1e-4,
                winding_merge: Use::Off,
            },
            opportunities: Opportunities {
                unknown: Use::On,
                priming: Use::On,
                shuttle: Use::On,
                close_loop: Use::On,
                traversals: 2,
                reach: 128,
            },
            journal: JournalLength::Off,
        }
    }

    /// Returns four actions in two opposite pairs: 0 and 2, 1 and 3, as north, east, south and west
    /// in [`Direction::ALL`](tolman_maze::Direction::ALL).
    #[must_use]
    pub fn compass_actions() -> Vec<ActionKind> {
        let reverses = [2, 3, 0, 1].map(|reverse| Some(Action(reverse)));
        let kind = |reverse| ActionKind {
            reverse,
            leads: None,
        };
        reverses.map(kind).into()
    }

    /// Returns the actions of [`compass_actions`](Self::compass_actions), each along a straight
    /// corridor on an axis of the compass.
    #[must_use]
    pub fn corridor_actions() -> Vec<ActionKind> {
        let axes = [CompassAxis::NorthSouth, CompassAxis::EastWest];
        let mut actions = Self::compass_actions();
        for (action, axis) in actions.iter_mut().zip(axes.into_iter().cycle()) {
            action.leads = Some(axis);
        }
        actions
    }

    /// Returns the axis along which an action leads straight, or `None` if its ways may bend.
    pub(super) fn leads(&self, action: Action) -> Option<CompassAxis> {
        self.actions.get(action.0 as usize)?.leads
    }

    /// Returns the action that usually leads back, or `None` if there is none.
    pub(super) fn reverse(&self, action: Action) -> Option<Action> {
        self.actions.get(action.0 as usize)?.reverse
    }

    /// Returns the minimum distance of two places, in metres of odometry.
    pub(super) fn least_distance(&self) -> f64 {
        self.separation * (1.0 - self.shared_scale)
    }

    /// Returns the minimum distance of two places that look alike, in metres of odometry.
    pub(super) fn least_alike_distance(&self) -> f64 {
        self.alike_separation * (1.0 - self.shared_scale)
    }

    /// Returns the minimum distance of two places with these looks and exits, in metres of
    /// odometry.
    pub(super) fn least_distance_of(&self, look: Similarity, exits: [&Exits; 2]) -> f64 {
        match look {
            Similarity::Alike if self.may_be_same(exits) => self.least_alike_distance(),
            _ => self.least_distance(),
        }
    }

    /// Returns whether a place may have both of these exits. Where the world may change, it may.
    pub(super) fn may_be_same(&self, exits: [&Exits; 2]) -> bool {
        match (self.world, exits) {
            (WorldKind::Static, [Exits::Seen(one), Exits::Seen(other)]) => {
                one.len() == other.len() && one.iter().all(|exit| other.contains(exit))
            }
            _ => true,
        }
    }

    /// Checks that the fields are in their ranges.
    ///
    /// # Errors
    /// [`DiktiometryConfigError`] names the first field that is not.
    pub fn check(&self) -> Result<(), DiktiometryConfigError> {
        let actions = self.actions.len();
        let mut reverses = self.actions.iter().filter_map(|kind| kind.reverse);
        if let Some(reverse) = reverses.find(|action| action.0 as usize >= actions) {
            return Err(DiktiometryConfigError::NoSuchReverse { reverse, actions });
        }
        self.check_numbers()?;
        match self.percepts {
            Percepts::None => Ok(()),
            Percepts::Signatures(kind) => kind.check(self.indexing.perceptual),
        }
    }

    fn check_numbers(&self) -> Result<(), DiktiometryConfigError> {
        let (tracks, limits, transients) = (&self.tracks, &self.restructuring, &self.transients);
        let [most_links, least_links] = limits.links;
        OutOfRange::check("separation", self.separation, POSITIVE)?;
        OutOfRange::check("alike_separation", self.alike_separation, self.separation..)?;
        OutOfRange::check("across", self.across, 0.0..)?;
        OutOfRange::check("place_radius", self.place_radius, 0.0..)?;
        OutOfRange::check("shared_scale", self.shared_scale, 0.0..1.0)?;
        OutOfRange::check("frame_half_width", self.frame_half_width, 0.0..)?;
        OutOfRange::check("search.width", self.search.width, POSITIVE)?;
        OutOfRange::check("matching.beta_reach", self.matching.beta_reach, 0.0..)?;
        OutOfRange::check("tracks.least_confidence", tracks.least_confidence, SHARE)?;
        OutOfRange::check("tracks.high", tracks.high, SHARE)?;
        OutOfRange::check("tracks.low", tracks.low, 0.0..=tracks.high)?;
        OutOfRange::check("transients.rate", transients.rate, SHARE)?;
        OutOfRange::check("transients.fading", transients.fading, POSITIVE_SHARE)?;
        OutOfRange::check("restructuring.weight", limits.weight, POSITIVE)?;
        OutOfRange::check("restructuring.ratio", limits.ratio, 1.0..)?;
        OutOfRange::check("restructuring.minority", limits.minority, SHARE)?;
        let chance = (Excluded(0.0), Excluded(1.0));
        OutOfRange::check("restructuring.look_error", limits.look_error, chance)?;
        OutOfRange::check("restructuring.links[0]", most_links, SHARE)?;
        OutOfRange::check("restructuring.links[1]", least_links, 0.0..=most_links)?;
        not_zero("search.frames", self.search.frames)?;
        not_zero("tracks.cap", tracks.cap)
    }
}

impl SignatureKind {
    /// Returns the number of columns that have to agree, ≥ 1: of 8 at a share of 0.6, 5.
    pub(super) fn enough(&self) -> usize {
        let enough = libm::ceil(self.share * self.columns as f64 - 1e-9) as usize;
        enough.max(1)
    }

    fn check(&self, indexing: PerceptualIndexing) -> Result<(), DiktiometryConfigError> {
        let columns = self.columns;
        OutOfRange::check("tolerance", self.tolerance, 0.0..)?;
        OutOfRange::check("share", self.share, POSITIVE_SHARE)?;
        if indexing == PerceptualIndexing::Triangles && columns < 3 {
            return Err(DiktiometryConfigError::NoTriangles { columns });
        }
        not_zero("rows", self.rows)?;
        not_zero("columns", columns)?;
        not_zero("views", self.views)
    }
}

const SHARE: RangeInclusive<f64> = 0.0..=1.0;
const POSITIVE_SHARE: (Bound<f64>, Bound<f64>) = (Excluded(0.0), Included(1.0));

const fn not_zero(field: &'static str, count: usize) -> Result<(), DiktiometryConfigError> {
    match count {
        0 => Err(DiktiometryConfigError::Zero { field }),
        _ => Ok(()),
    }
}

/// Reason why a configuration is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DiktiometryConfigError {
    /// An action's reverse does not exist.
    #[error(
        "action {} is named as a reverse, but there are only {actions} actions; name one of them or none",
        reverse.0
    )]
    NoSuchReverse {
        /// The reverse that was named.
        reverse: Action,
        /// Number of actions.
        actions: usize,
    },
    /// A number is out of its range or not finite.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The views have too few columns for triangles of edges.
    #[error("views of {columns} columns have no triangles; give 3 or more, or index `Columns`")]
    NoTriangles {
        /// Number of columns of the views.
        columns: usize,
    },
    /// A count is 0.
    #[error("`{field}` is 0; give at least 1")]
    Zero {
        /// Name of the field.
        field: &'static str,
    },
}

#[cfg(test)]
mod tests {
    use alloc::format;
    use alloc::string::ToString;

    use super::*;

    /// Changes one number of a configuration.
    type Set = fn(&mut Config, f64);

    /// Name of a number, its change, good values, bad ones, and its range in words.
    type Field<'a> = (&'a str, Set, [f64; 2], &'a [f64], &'a str);

    /// Each number with values that are in its range, values that are not, and the range in words.
    #[test]
    fn a_number_out_of_its_range_is_refused_by_its_name() {
        let most = f64::MAX;
        let fields: [Field<'_>; 18] = [
            (
                "alike_separation",
                |c, v| c.alike_separation = v,
                [2.0, most],
                &[1.9],
                "finite number, at least 2",
            ),
            (
                "across",
                |c, v| c.across = v,
                [0.0, most],
                &[-0.1],
                "finite number, at least 0",
            ),
            (
                "place_radius",
                |c, v| c.place_radius = v,
                [0.0, most],
                &[-0.1],
                "finite number, at least 0",
            ),
            (
                "shared_scale",
                |c, v| c.shared_scale = v,
                [0.0, 0.9],
                &[-0.1, 1.0],
                "finite number, at least 0, below 1",
            ),
            (
                "frame_half_width",
                |c, v| c.frame_half_width = v,
                [0.0, most],
                &[-0.1],
                "finite number, at least 0",
            ),
            (
                "search.width",
                |c, v| c.search.width = v,
                [1e-9, most],
                &[0.0],
                "finite number above 0",
            ),
            (
                "matching.beta_reach",
                |c, v| c.matching.beta_reach = v,
                [0.0, most],
                &[-0.1],
                "finite number, at least 0",
            ),
            (
                "tracks.least_confidence",
                |c, v| c.tracks.least_confidence = v,
                [0.0, 1.0],
                &[-0.1, 1.1],
                "number from 0 to 1",
            ),
            (
                "tracks.high",
                |c, v| c.tracks.high = v,
                [0.3, 1.0],
                &[-0.1, 1.1],
                "number from 0 to 1",
            ),
            (
                "tracks.low",
                |c, v| c.tracks.low = v,
                [0.0, 0.7],
                &[-0.1, 0.8],
                "number from 0 to 0.7",
            ),
            (
                "transients.rate",
                |c, v| c.transients.rate = v,
                [0.0, 1.0],
                &[-0.1, 1.1],
                "number from 0 to 1",
            ),
            (
                "transients.fading",
                |c, v| c.transients.fading = v,
                [1e-9, 1.0],
                &[0.0, 1.1],
                "finite number above 0, at most 1",
            ),
            (
                "restructuring.weight",
                |c, v| c.restructuring.weight = v,
                [1e-9, most],
                &[0.0],
                "finite number above 0",
            ),
            (
                "restructuring.ratio",
                |c, v| c.restructuring.ratio = v,
                [1.0, most],
                &[0.9],
                "finite number, at least 1",
            ),
            (
                "restructuring.minority",
                |c, v| c.restructuring.minority = v,
                [0.0, 1.0],
                &[-0.1, 1.1],
                "number from 0 to 1",
            ),
            (
                "restructuring.look_error",
                |c, v| c.restructuring.look_error = v,
                [1e-9, 0.999],
                &[0.0, 1.0],
                "finite number above 0, below 1",
            ),
            (
                "restructuring.links[0]",
                |c, v| c.restructuring.links[0] = v,
                [0.4, 1.0],
                &[-0.1, 1.1],
                "number from 0 to 1",
            ),
            (
                "restructuring.links[1]",
                |c, v| c.restructuring.links[1] = v,
                [0.0, 0.8],
                &[-0.1, 0.9],
                "number from 0 to 0.8",
            ),
        ];
        for (name, set, good, bad, range) in fields {
            let config = |value| {
                let mut config = Config::new(Config::compass_actions(), 2.0);
                set(&mut config, value);
                config.check()
            };
            for value in good {
                assert_eq!(config(value), Ok(()), "{name} {value}");
            }
            for value in bad.iter().copied().chain([f64::NAN, f64::INFINITY]) {
                let told = config(value).unwrap_err().to_string();
                let expect = format!("`{name}` is {value}; give a {range}");
                assert_eq!(told, expect);
            }
        }
    }

    #[test]
    fn counts_and_actions_are_checked() {
        let told = |set: fn(&mut Config)| {
            let mut config = Config::new(Config::compass_actions(), 2.0);
            set(&mut config);
            config.check().unwrap_err().to_string()
        };
        assert_eq!(
            told(|c| c.search.frames = 0),
            "`search.frames` is 0; give at least 1"
        );
        assert_eq!(
            told(|c| c.tracks.cap = 0),
            "`tracks.cap` is 0; give at least 1"
        );
        let reverse = told(|c| c.actions[1].reverse = Some(Action(4)));
        assert!(
            reverse.contains("action 4") && reverse.contains("only 4 actions"),
            "{reverse}"
        );
        let separation = told(|c| c.separation = 0.0);
        assert!(separation.contains("`separation` is 0"), "{separation}");
    }

    #[test]
    fn distances_shrink_by_the_error_that_all_moves_share() {
        let mut config = Config::new(Config::compass_actions(), 2.0);
        (config.alike_separation, config.shared_scale) = (3.0, 0.25);
        assert!((config.least_distance() - 1.5).abs() < 1e-12);
        assert!((config.least_alike_distance() - 2.25).abs() < 1e-12);
    }

    #[test]
    fn places_of_a_static_world_with_other_exits_do_not_look_alike() {
        let mut config = Config::new(Config::compass_actions(), 2.0);
        config.alike_separation = 4.0;
        let seen = |actions: [u32; 2]| Exits::Seen(actions.map(Action).into());
        let (way, corner) = (seen([0, 2]), seen([0, 1]));
        for (world, exits, alike) in [
            (WorldKind::Static, [&way, &corner], 2.0),
            (WorldKind::Static, [&way, &seen([2, 0])], 4.0),
            (WorldKind::Static, [&way, &Exits::Unknown], 4.0),
            (WorldKind::Changing, [&way, &corner], 4.0),
        ] {
            config.world = world;
            let least = |look| config.least_distance_of(look, exits);
            assert!((least(Similarity::Alike) - alike).abs() < 1e-12);
            assert!((least(Similarity::Unlike) - 2.0).abs() < 1e-12);
        }
    }
}
