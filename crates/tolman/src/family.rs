use rand_chacha::ChaCha8Rng;
use tolman_arena::BoxError;
use tolman_maze::{Braided, Maze, Perfect, Rooms};

/// A family of worlds: drawings of one kind, each from its seed.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Its name, as in `tolman maze generate family NAME`.
    pub name: &'static str,
    /// What its drawings have in common, in one line.
    pub about: &'static str,
    /// Draws one of so many columns and rows.
    pub draw: fn((u16, u16), &mut ChaCha8Rng) -> Result<Maze, BoxError>,
}

impl Family {
    /// The families that are known here.
    pub(crate) const ALL: [Self; 3] = [
        Self {
            name: "perfect",
            about: "Exactly one way between any two cells",
            draw: |(width, height), rng| Ok(Perfect { width, height }.generate(rng)?),
        },
        Self {
            name: "braided",
            about: "Loops in place of dead ends",
            draw: |(width, height), rng| {
                let share = 1.0;
                let braided = Braided {
                    width,
                    height,
                    share,
                };
                Ok(braided.generate(rng)?)
            },
        },
        Self {
            name: "rooms",
            about: "Rooms with winding corridors between them",
            draw: |(width, height), rng| {
                let rooms = Rooms {
                    width,
                    height,
                    attempts: 20,
                    smallest: 2,
                    largest: 4,
                    extra_doors: 2,
                };
                Ok(rooms.generate(rng)?)
            },
        },
    ];
}
