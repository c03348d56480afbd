use tolman_maze::Maze;

use super::fragments::{Quarters, TrueFragments, along, bends, headings};

/// Number of fragments of a maze that look like others by how they bend.
///
/// Along a corridor of constant width only its bends can be observed. Two fragments with the same
/// bends, cell by cell, are not *distinctive*. One with the same bends from both ends is not
/// *asymmetrical* (section 4.3).
///
/// ```
/// use tolman_arena::cpm::BendLikeness;
///
/// // Two ways round: each bends, from its other end, as the other does.
/// let maze = tolman_maze::read("\
/// start = 0 1 east
///
/// o---o---o---o---o---o
/// |   |           |   |
/// o---o   o---o   o---o
/// | S     |   |     G |
/// o---o   o---o   o---o
/// |   |           |   |
/// o---o---o---o---o---o
/// ")?.maze;
/// assert_eq!(BendLikeness::of(&maze), BendLikeness { alike_pairs: 1, symmetrical: 0 });
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BendLikeness {
    /// Pairs of fragments that bend alike, walked from one end or the other.
    pub alike_pairs: u32,
    /// Number of fragments that bend the same from both ends.
    pub symmetrical: u32,
}

impl BendLikeness {
    /// Counts the fragments that can be reached and have a cell between the places at their ends;
    /// nothing is observed of others. O(fragments² · cells).
    #[must_use]
    pub fn of(maze: &Maze) -> Self {
        let fragments = TrueFragments::of(maze);
        let forward = fragments.ways().filter(|(_, _, way)| way.is_forward);
        let ways = forward.filter_map(|(from, out, _)| along(maze, from, out));
        let bends = ways.map(|(cells, _)| bends(&headings(maze, &cells)));
        let bends: Vec<Vec<Quarters>> = bends.filter(|bends| !bends.is_empty()).collect();
        let mut found = Self {
            alike_pairs: 0,
            symmetrical: 0,
        };
        for (index, one) in bends.iter().enumerate() {
            let inverted = inverted(one);
            found.symmetrical += u32::from(*one == inverted);
            let others = bends[..index].iter();
            let alike = others.filter(|other| *other == one || **other == inverted);
            found.alike_pairs += alike.count() as u32;
        }
        found
    }
}

/// Returns the bends of the same fragment from its other end.
fn inverted(bends: &[Quarters]) -> Vec<Quarters> {
    bends.iter().rev().map(|bend| (4 - bend) % 4).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn likeness(text: &str) -> BendLikeness {
        BendLikeness::of(&tolman_maze::read(text).unwrap().maze)
    }

    #[test]
    fn fragments_are_alike_that_bend_alike_from_one_end_or_the_other() {
        // West and east of the fork one cell each, straight; north of it a bend.
        let text = "\
start = 0 0 east

o---o---o---o---o---o
|       |           |
o---o---o   o---o---o
| S               G |
o---o---o---o---o---o
";
        let straight = BendLikeness {
            alike_pairs: 1,
            symmetrical: 2,
        };
        assert_eq!(likeness(text), straight);
        // The eastern one two cells long.
        let longer = "\
start = 0 0 east

o---o---o---o---o---o---o
|       |       |       |
o---o---o   o---o---o---o
| S                   G |
o---o---o---o---o---o---o
";
        let different = BendLikeness {
            alike_pairs: 0,
            ..straight
        };
        assert_eq!(likeness(longer), different);
    }

    #[test]
    fn the_mazes_of_the_paper_have_none() {
        for text in [
            include_str!("../../mazes/cpm-1.maze"),
            include_str!("../../mazes/cpm-2.maze"),
            include_str!("../../mazes/cpm-3.maze"),
        ] {
            let none = BendLikeness {
                alike_pairs: 0,
                symmetrical: 0,
            };
            assert_eq!(likeness(text), none);
        }
    }
}
