use tolman_robot::{Ring, Scan};

/// A place of a map of places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SitePlace {
    /// Kind of place.
    pub kind: SiteKind,
    /// Number of the keyframe in the middle of the place.
    pub keyframe: usize,
    /// Number of the place on the map: its own, or that of an earlier place.
    pub id: u32,
}

/// Kind of a place, by which of the four ways lead on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SiteKind {
    /// One way or none.
    DeadEnd,
    /// Two ways, side by side.
    Bend,
    /// Two ways, opposite: a wide part of a corridor, or a room with a door on either side.
    Passage,
    /// Three ways or four.
    Junction,
}

/// Minimum distance of the nearest thing in a way that leads on, in corridor widths.
const OPEN_WIDTHS: f64 = 1.25;

impl SiteKind {
    /// Returns the kind of place in a scan, where corridors are `width` wide, m. The `ring` of the
    /// scan looks along the axes of a building.
    #[must_use]
    pub fn of(scan: &Scan, width: f64) -> Self {
        let open = ways_on(scan, width);
        match open.iter().filter(|open| **open).count() {
            0 | 1 => Self::DeadEnd,
            2 if open[0] == open[2] => Self::Passage,
            2 => Self::Bend,
            _ => Self::Junction,
        }
    }
}

/// Returns whether a way leads on in each of the four quarters, by a scan aligned with the
/// building's axes. Corridors are `width` wide, m.
pub(super) fn ways_on(scan: &Scan, width: f64) -> [bool; 4] {
    [0, 1, 2, 3].map(|quarter| is_open(&scan.ranges, &scan.ring, quarter, width))
}

/// Returns whether the mean range of the middle half of a quarter's beams is far.
fn is_open(ranges: &[f64], ring: &Ring, quarter: u32, width: f64) -> bool {
    let beams = ring.beams as usize;
    let spread = beams / 36;
    let middle = quarter as usize * beams / 4 + beams;
    let seen = (middle - spread..=middle + spread).filter_map(|beam| ranges.get(beam % beams));
    seen.fold(f64::INFINITY, |least, range| least.min(*range)) > OPEN_WIDTHS * width
}
