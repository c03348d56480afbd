use thiserror::Error;

/// A transition Δ: the port by which the robot leaves a junction. Ports are counted
/// counter-clockwise from the one it came in by, which is 0.
///
/// In a crossing, 1 turns right, 2 goes straight on and 3 turns left, whatever way the robot came.
/// The paper counts from the robot's heading, which contradicts its equation (2). Counted from the
/// port of entry, Δ runs from 1 to degree − 1, and N_w of (2) is degree − 1. [`BACK`](Self::BACK)
/// is the turn of a dead end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Turn(pub u32);

/// A turn that the junction does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("turn {} does not exist at a junction of {degree} ports; turns run from 0 to {degree} − 1", .turn.0)]
pub struct NoSuchTurn {
    /// Turn that was asked for.
    pub turn: Turn,
    /// The junction's ports.
    pub degree: u32,
}

impl Turn {
    /// Turn that leaves by the port of entry.
    pub const BACK: Self = Self(0);

    /// Returns the turn that leads from port `entry` to port `exit`.
    ///
    /// # Errors
    /// If `entry` or `exit` is not below `degree`.
    pub const fn between(entry: u32, exit: u32, degree: u32) -> Result<Self, NoSuchTurn> {
        if entry >= degree || exit >= degree {
            let turn = Self(if entry > exit { entry } else { exit });
            return Err(NoSuchTurn { turn, degree });
        }
        Ok(Self(sum(exit, degree - entry, degree)))
    }

    /// Returns the port that the turn leads to from port `entry`.
    ///
    /// # Errors
    /// If the junction has no such turn.
    pub const fn exit(self, entry: u32, degree: u32) -> Result<u32, NoSuchTurn> {
        if self.0 >= degree || entry >= degree {
            let turn = self;
            return Err(NoSuchTurn { turn, degree });
        }
        Ok(sum(entry, self.0, degree))
    }

    /// Returns the turn that leads back, equation (2): Λ1, Δ⁻¹ = N_w − Δ + 1, where N_w is `degree`
    /// − 1. It is its own inverse.
    ///
    /// # Errors
    /// If the junction has no such turn.
    pub const fn inverse(self, degree: u32) -> Result<Self, NoSuchTurn> {
        let turn = self;
        if self.0 >= degree {
            return Err(NoSuchTurn { turn, degree });
        }
        Ok(Self(sum(0, degree - self.0, degree)))
    }

    /// Returns the turn that equals this one followed by `next`, equations (9) and (10): (Δ + Δ')
    /// mod n_junc with n_junc = `degree`.
    ///
    /// # Errors
    /// If the junction has no such turn.
    pub const fn then(self, next: Self, degree: u32) -> Result<Self, NoSuchTurn> {
        let turn = if self.0 >= degree { self } else { next };
        if turn.0 >= degree {
            return Err(NoSuchTurn { turn, degree });
        }
        Ok(Self(sum(self.0, next.0, degree)))
    }
}

/// Returns the sum of two turns modulo `degree`, without overflow.
const fn sum(a: u32, b: u32, degree: u32) -> u32 {
    ((a as u64 + b as u64) % degree as u64) as u32
}
