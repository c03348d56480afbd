use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use super::bearings::Bearings;
use super::index::FragmentIndex;
use super::nodes::Nodes;
use super::pattern::{Dictionary, DictionaryError, PatternId, Version};
use super::similarity::FragmentMatching;
use super::traversal::{DeadReckoning, Sighting};
use super::turn::Turn;
use tolman_robot::Landmark;

/// A fragment of a map. The id stays the same as long as the fragment exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FragmentId(pub u32);

impl FragmentId {
    /// Returns the end with this sign.
    #[must_use]
    pub const fn end(self, sign: Sign) -> End {
        let fragment = self;
        End { fragment, sign }
    }
}

/// A junction of a map, a dead end, or a landmark in a corridor. The id stays the same as long as
/// the place exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JunctionId(pub u32);

impl JunctionId {
    /// Returns the port with this number.
    #[must_use]
    pub const fn port(self, number: u32) -> Port {
        let junction = self;
        Port { junction, number }
    }
}

/// "The minus sign (−) denotes the entrance …, whereas a plus sign (+) denotes the exit. For any
/// path-fragment, the signs are assigned only at the *first* time of traversal."
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sign {
    /// End at which the robot entered on its first walk along the fragment.
    Minus,
    /// End at which the robot left on that walk.
    Plus,
}

impl Sign {
    /// Both signs, − first.
    pub const BOTH: [Self; 2] = [Self::Minus, Self::Plus];

    /// Returns the sign of the other end.
    #[must_use]
    pub const fn opposite(self) -> Self {
        match self {
            Self::Minus => Self::Plus,
            Self::Plus => Self::Minus,
        }
    }
}

/// Writes the sign as in the paper.
impl fmt::Display for Sign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Minus => "−",
            Self::Plus => "+",
        })
    }
}

/// One end of a fragment, such as 𝔸⁺.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct End {
    /// Fragment to which the end belongs.
    pub fragment: FragmentId,
    /// The end's sign.
    pub sign: Sign,
}

impl End {
    /// Returns the fragment's other end.
    #[must_use]
    pub const fn opposite(self) -> Self {
        self.fragment.end(self.sign.opposite())
    }
}

/// A port of a junction. As the robot's place, it is the port by which the robot came, which lies
/// behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(from = "(JunctionId, u32)", into = "(JunctionId, u32)")
)]
pub struct Port {
    /// Junction to which the port belongs.
    pub junction: JunctionId,
    /// Number of the port, counter-clockwise from the port of the junction's first entry, which is
    /// 0.
    pub number: u32,
}

impl From<(JunctionId, u32)> for Port {
    fn from((junction, number): (JunctionId, u32)) -> Self {
        junction.port(number)
    }
}

impl From<Port> for (JunctionId, u32) {
    fn from(port: Port) -> Self {
        (port.junction, port.number)
    }
}

/// Knowledge about a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PortState {
    /// The port is unexplored, or was not explored to its end.
    Open {
        /// Number of observations made beyond the port before the robot turned round.
        at_least: u32,
    },
    /// A fragment begins or ends here.
    Filled(End),
}

/// A junction node: "keeps only the fragments connecting to it, including the direction (−, +)",
/// each at its port.
#[derive(Clone, Debug, PartialEq)]
pub struct Junction {
    /// Ports in counter-clockwise order.
    pub ports: Vec<PortState>,
    /// The landmark of the junction; `None` without one.
    pub landmark: Option<Landmark>,
    /// Bearings of the ports, from port 0 on, or `None` if no robot has looked.
    pub bearings: Option<Bearings>,
}

impl Junction {
    /// Returns the number of ports; 1 makes it a dead end.
    #[must_use]
    pub const fn degree(&self) -> u32 {
        self.ports.len() as u32
    }

    /// Returns the sighting of the junction.
    #[must_use]
    pub const fn sighting(&self) -> Sighting {
        Sighting {
            degree: self.degree(),
            landmark: self.landmark,
        }
    }

    /// Returns the bearings of its ways for a robot that enters by `port`; `None` if no robot has
    /// looked.
    #[must_use]
    pub fn bearings_from(&self, port: u32) -> Option<Bearings> {
        Some(self.bearings.as_ref()?.counted_from(port))
    }

    /// Returns the greatest angle between the junction's ways and those seen by a robot that came
    /// in by `port`, rad. It is 0 if no robot has looked or the numbers of ways differ.
    pub(super) fn apart(&self, port: u32, seen: Option<&Bearings>) -> f64 {
        let known = self.bearings_from(port);
        let apart = known.zip(seen).and_then(|(known, seen)| known.apart(seen));
        apart.unwrap_or(0.0)
    }

    /// Takes in the ways seen by a robot that came in by `port`, unless bearings are known.
    pub(super) fn notice(&mut self, port: u32, seen: Option<&Bearings>) {
        let degree = self.degree().max(1);
        if self.bearings.is_none() {
            self.bearings = seen.map(|seen| seen.counted_from(degree - port % degree));
        }
    }

    /// Returns the numbers of the unexplored ports, ascending.
    pub fn open_ports(&self) -> impl Iterator<Item = u32> {
        let open = |port: &&PortState| matches!(port, PortState::Open { .. });
        let numbered = (0..).zip(&self.ports);
        numbered.filter_map(move |(number, port)| open(&port).then_some(number))
    }
}

/// A fragment node: "contains three properties", its sequence, its length and its transitions. The
/// transitions follow from the ports of its two ends: [`CpMap::transition`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fragment {
    /// 𝔸, as observed from − to +.
    pub patterns: Vec<PatternId>,
    /// Dead reckoning from − to +, combined over all walks along the fragment.
    pub motion: Option<DeadReckoning>,
    /// Number of walks along the fragment, either way.
    pub traversals: u32,
    /// Port of 𝔸⁻: junc(𝔸⁻).
    pub minus: Port,
    /// Port of 𝔸⁺: junc(𝔸⁺).
    pub plus: Port,
}

impl Fragment {
    /// Returns ℓ(𝔸), the length in observations; at least 1, as even a fragment too short for an
    /// observation takes time.
    #[must_use]
    pub const fn length(&self) -> u32 {
        let length = self.patterns.len() as u32;
        if length == 0 { 1 } else { length }
    }

    /// Returns the port at which an end lies.
    #[must_use]
    pub const fn port(&self, sign: Sign) -> Port {
        match sign {
            Sign::Minus => self.minus,
            Sign::Plus => self.plus,
        }
    }
}

/// ℳ: the common-pattern map. Fragments, and the junctions that join them.
///
/// Each end of a fragment is at a port that names it. Ids ascend in the order of creation and are
/// not reused.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CpMap {
    pub(super) fragments: Nodes<FragmentId, Fragment>,
    pub(super) junctions: Nodes<JunctionId, Junction>,
    pub(super) next_fragment: u32,
    pub(super) next_junction: u32,
    pub(super) version: Option<Version>,
    pub(super) index: FragmentIndex,
}

impl CpMap {
    /// Returns the fragments by id.
    pub fn fragments(&self) -> impl ExactSizeIterator<Item = (FragmentId, &Fragment)> {
        self.fragments.iter()
    }

    /// Returns the junctions by id.
    pub fn junctions(&self) -> impl ExactSizeIterator<Item = (JunctionId, &Junction)> {
        self.junctions.iter()
    }

    /// Returns the memory of fragments and junctions, each with its id, bytes. O(fragments +
    /// junctions).
    #[must_use]
    pub fn bytes(&self) -> usize {
        let fragments = self.fragments().map(|(id, fragment)| {
            size_of_val(&id) + size_of_val(fragment) + size_of_val(fragment.patterns.as_slice())
        });
        let junctions = self.junctions().map(|(id, junction)| {
            let ways = junction
                .bearings
                .as_ref()
                .map_or(0, |ways| size_of_val(ways.radians()));
            size_of_val(&id) + size_of_val(junction) + size_of_val(junction.ports.as_slice()) + ways
        });
        fragments.sum::<usize>() + junctions.sum::<usize>()
    }

    /// Returns a fragment, or `None` if it was merged into another.
    #[must_use]
    pub fn fragment(&self, id: FragmentId) -> Option<&Fragment> {
        self.fragments.get(id)
    }

    /// Returns a junction, or `None` if it was unified with another.
    #[must_use]
    pub fn junction(&self, id: JunctionId) -> Option<&Junction> {
        self.junctions.get(id)
    }

    /// Returns the number of ports of a junction; 0 if the map has no such junction.
    #[must_use]
    pub fn degree(&self, junction: JunctionId) -> u32 {
        self.junctions.get(junction).map_or(0, Junction::degree)
    }

    /// Returns the version of the dictionary with which its sequences were written, or `None` for
    /// an empty map.
    #[must_use]
    pub const fn version(&self) -> Option<Version> {
        self.version
    }

    /// Refuses a dictionary with which its sequences were not written.
    ///
    /// # Errors
    /// [`DictionaryError::OtherDictionary`].
    pub(super) fn check(&self, dictionary: &Dictionary) -> Result<(), DictionaryError> {
        self.version
            .map_or(Ok(()), |version| dictionary.check_version(version))
    }

    /// Returns the state of a port, or `None` if the map has no such port.
    #[must_use]
    pub fn port(&self, port: Port) -> Option<PortState> {
        let junction = self.junctions.get(port.junction)?;
        junction.ports.get(port.number as usize).copied()
    }

    /// Returns the end of a fragment at a port, or `None` if the port is unexplored.
    #[must_use]
    pub fn end_at(&self, port: Port) -> Option<End> {
        match self.port(port)? {
            PortState::Filled(end) => Some(end),
            PortState::Open { .. } => None,
        }
    }

    /// Returns the port at which a robot arrives if it leaves by `port`, or `None` if it is not
    /// known.
    #[must_use]
    pub fn beyond(&self, port: Port) -> Option<Port> {
        let end = self.end_at(port)?.opposite();
        Some(self.fragment(end.fragment)?.port(end.sign))
    }

    /// Returns the ports of a junction by its rank.
    pub(super) fn ports_at(&self, rank: usize) -> &[PortState] {
        let junction = self.junctions.at(rank);
        junction.map_or(&[][..], |junction| &junction.ports)
    }

    /// Returns the junction to which a port leads, by its rank, and the number of its port there.
    pub(super) fn led_to(&self, port: PortState) -> Option<(usize, u32)> {
        let PortState::Filled(end) = port else {
            return None;
        };
        let there = self.fragment(end.fragment)?.port(end.sign.opposite());
        Some((self.junctions.rank(there.junction)?, there.number))
    }

    /// Returns Λ2(X, Y) = Δ_{X→Y}, equation (6): the turn from the end where a robot leaves one
    /// fragment to the end where it enters another. `None` if the two ends are at different
    /// junctions.
    ///
    /// The map stores ports, not transitions, so all that (7) to (10) derive holds already.
    #[must_use]
    pub fn transition(&self, from: End, to: End) -> Option<Turn> {
        let from = self.fragment(from.fragment)?.port(from.sign);
        let to = self.fragment(to.fragment)?.port(to.sign);
        let junction = self.junction(from.junction)?;
        let turn = Turn::between(from.number, to.number, junction.degree());
        turn.ok().filter(|_| from.junction == to.junction)
    }

    /// Returns whether a landmark stands at a junction.
    #[must_use]
    pub fn has(&self, junction: JunctionId, landmark: Landmark) -> bool {
        let place = self.junction(junction);
        place.is_some_and(|place| place.landmark == Some(landmark))
    }

    /// Returns the junctions with a landmark, by id.
    pub fn landmarks(&self, landmark: Landmark) -> impl Iterator<Item = JunctionId> {
        let marked = self
            .junctions()
            .filter(move |(_, junction)| junction.landmark == Some(landmark));
        marked.map(|(id, _)| id)
    }

    /// Returns the port behind a robot at the map's first start, or `None` if the map has no start.
    #[must_use]
    pub fn start(&self) -> Option<Port> {
        Some(self.landmarks(Landmark::Start).next()?.port(0))
    }

    /// Returns the unexplored ports, by id.
    pub fn open_ports(&self) -> impl Iterator<Item = Port> {
        self.junctions()
            .flat_map(|(id, place)| place.open_ports().map(move |number| id.port(number)))
    }

    /// Returns whether the map is optimized, Definition 2: "ℳ is optimized if and only if … 𝔸ᵢ is
    /// distinctive", no two fragments are similar, either way. O(fragments²) comparisons.
    #[must_use]
    pub fn is_optimized(&self, matching: &FragmentMatching, dictionary: &Dictionary) -> bool {
        let mut pairs = self.fragments().enumerate().flat_map(|(i, (_, first))| {
            let others = self.fragments().skip(i + 1);
            others.map(move |(_, second)| (first, second))
        });
        pairs.all(|(first, second)| {
            matching
                .matches(dictionary, &first.patterns, &second.patterns)
                .is_none()
        })
    }

    /// Returns whether the map is complete, Definition 3: "every port (gateway) … has been filled,
    /// and ℳ contains an A-Pattern which represents the goal path-fragment", one that ends at the
    /// goal.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.is_explored() && self.has_goal()
    }

    /// Returns whether "every port (gateway) has been filled": Definition 3, 1).
    #[must_use]
    pub fn is_explored(&self) -> bool {
        self.open_ports().next().is_none()
    }

    /// Returns whether a fragment leads to the goal: Definition 3, 2).
    #[must_use]
    pub fn has_goal(&self) -> bool {
        let mut fragments = self.fragments();
        fragments.any(|(_, fragment)| {
            let ends = [fragment.minus, fragment.plus];
            ends.iter()
                .any(|port| self.has(port.junction, Landmark::Goal))
        })
    }

    pub(super) fn add_junction(
        &mut self,
        sighting: Sighting,
        bearings: Option<Bearings>,
    ) -> JunctionId {
        let id = JunctionId(self.next_junction);
        self.next_junction += 1;
        let open = PortState::Open { at_least: 0 };
        let junction = Junction {
            ports: vec![open; sighting.degree as usize],
            landmark: sighting.landmark,
            bearings,
        };
        self.junctions.insert(id, junction);
        id
    }

    pub(super) fn add_fragment(
        &mut self,
        patterns: Vec<PatternId>,
        motion: Option<DeadReckoning>,
        minus: Port,
        plus: Port,
    ) -> FragmentId {
        let fragment = FragmentId(self.next_fragment);
        self.next_fragment += 1;
        for (sign, port) in Sign::BOTH.into_iter().zip([minus, plus]) {
            if let Some(state) = self.port_state_mut(port) {
                *state = PortState::Filled(fragment.end(sign));
            }
        }
        let traversals = 1;
        self.index.insert(fragment, &patterns);
        let new = Fragment {
            patterns,
            motion,
            traversals,
            minus,
            plus,
        };
        self.fragments.insert(fragment, new);
        fragment
    }

    pub(super) fn port_state_mut(&mut self, port: Port) -> Option<&mut PortState> {
        let junction = self.junctions.get_mut(port.junction)?;
        junction.ports.get_mut(port.number as usize)
    }
}
