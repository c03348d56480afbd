//! The bytes of a saved map: four that name the format and the size, two bits for each inner edge,
//! and a checksum.

use tolman_maze::{Cell, Direction, Knowledge, Walls};

use crate::{TOLMAN_SAVED_BYTES, TOLMAN_SIDE};

/// Format 1 of maps of this size.
const HEAD: [u8; 4] = [b'T', b'M', 1, TOLMAN_SIDE as u8];

/// Edges to the north and east of each cell.
const EDGES: usize = 2 * TOLMAN_SIDE * TOLMAN_SIDE;

/// Number of bytes of a map.
pub(crate) const BYTES: usize = HEAD.len() + EDGES / 4 + 4;

const _: () = assert!(BYTES <= TOLMAN_SAVED_BYTES);

/// Writes a map into as many bytes as it has, which are 0.
pub(crate) fn save(walls: &impl Walls, bytes: &mut [u8]) {
    for (byte, head) in bytes.iter_mut().zip(HEAD) {
        *byte = head;
    }
    for cell in walls.grid().cells() {
        for side in [Direction::North, Direction::East] {
            let (byte, shift) = place(cell, side);
            let known = match walls.knowledge(cell, side) {
                Knowledge::Unknown => 0,
                Knowledge::Open => 1,
                Knowledge::Wall => 2,
            };
            if let Some(byte) = bytes.get_mut(byte) {
                *byte |= known << shift;
            }
        }
    }
    if let Some((map, sum)) = bytes.split_last_chunk_mut::<4>() {
        *sum = checksum(map).to_le_bytes();
    }
}

/// Returns whether these are the bytes of a map of this size.
pub(crate) fn is_whole(bytes: &[u8]) -> bool {
    let sum_is_right = |(map, sum): (&[u8], &[u8; 4])| {
        checksum(map).to_le_bytes() == *sum && map.starts_with(&HEAD)
    };
    bytes.len() == BYTES && bytes.split_last_chunk().is_some_and(sum_is_right)
}

/// Returns what a map knows of a wall.
pub(crate) fn wall(bytes: &[u8], cell: Cell, side: Direction) -> Knowledge {
    let (cell, side) = match side {
        Direction::North | Direction::East => (cell, side),
        _ => match cell.beyond(side) {
            Some(beyond) => (beyond, side.opposite()),
            None => return Knowledge::Wall,
        },
    };
    let is_border = match side {
        Direction::North => usize::from(cell.y) + 1 >= TOLMAN_SIDE,
        _ => usize::from(cell.x) + 1 >= TOLMAN_SIDE,
    };
    let (byte, shift) = place(cell, side);
    match bytes.get(byte).map(|byte| byte >> shift & 3) {
        _ if is_border => Knowledge::Wall,
        Some(1) => Knowledge::Open,
        Some(2) => Knowledge::Wall,
        _ => Knowledge::Unknown,
    }
}

/// Returns the byte of an edge, and its bits in it.
fn place(cell: Cell, side: Direction) -> (usize, usize) {
    let edge = 2 * (usize::from(cell.y) * TOLMAN_SIDE + usize::from(cell.x))
        + usize::from(side == Direction::East);
    (HEAD.len() + edge / 4, 2 * (edge % 4))
}

/// Returns the checksum of bytes, FNV-1a.
fn checksum(bytes: &[u8]) -> u32 {
    bytes.iter().fold(0x811c_9dc5, |sum, byte| {
        (sum ^ u32::from(*byte)).wrapping_mul(0x0100_0193)
    })
}
