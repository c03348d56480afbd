/// A place of the path graph. Ids are given in order of creation and never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlaceId(pub u32);

/// An action link of the path graph. Ids are given in order of creation and never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LinkId(pub u32);

/// A local frame of the reference graph. Ids are given in order of creation and never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FrameId(pub u32);

/// A track: one hypothesis of where the robot is. Ids are given in the order tracks are born.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TrackId(pub u32);

/// One of the robot's control routines, numbered from 0: an index into
/// [`Config::actions`](super::Config::actions).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Action(pub u32);

impl PlaceId {
    pub(super) const fn index(self) -> usize {
        self.0 as usize
    }
}

impl LinkId {
    pub(super) const fn index(self) -> usize {
        self.0 as usize
    }
}

impl FrameId {
    pub(super) const fn index(self) -> usize {
        self.0 as usize
    }
}
