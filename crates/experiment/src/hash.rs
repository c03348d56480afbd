//! The 64-bit FNV-1a hash, which is the same on every platform and in every release of Rust.

/// A running FNV-1a hash (Fowler, Noll and Vo). It tells accidental differences apart and is no
/// protection against intent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fnv64(u64);

impl Fnv64 {
    /// The hash of nothing.
    pub(super) const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// The hash of some bytes.
    pub(super) fn of(bytes: &[u8]) -> u64 {
        Self::new().write(bytes).0
    }

    /// Takes in more bytes.
    pub(super) fn write(self, bytes: &[u8]) -> Self {
        Self(bytes.iter().fold(self.0, |hash, &byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        }))
    }

    /// The hash as 16 hexadecimal digits.
    pub(super) fn hex(self) -> String {
        format!("{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::Fnv64;

    #[test]
    fn known_values() {
        // From the reference vectors of the FNV draft (draft-eastlake-fnv).
        assert_eq!(Fnv64::of(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(Fnv64::of(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(Fnv64::of(b"foobar"), 0x8594_4171_f739_67e8);
        assert_eq!(
            Fnv64::new().write(b"foo").write(b"bar").hex(),
            "85944171f73967e8"
        );
    }
}
