//! The 64-bit FNV-1a hash, which is the same on every platform and in every release of Rust.

use core::hash::Hasher;

use fnv::FnvHasher;

/// Returns the FNV-1a hash (Fowler, Noll and Vo) of some bytes. It detects accidental differences,
/// and does not protect against manipulation.
pub(super) fn fnv64(bytes: &[u8]) -> u64 {
    let mut hash = FnvHasher::default();
    hash.write(bytes);
    hash.finish()
}

#[cfg(test)]
mod tests {
    use super::fnv64;

    #[test]
    fn known_values() {
        // From the reference vectors of the FNV draft (draft-eastlake-fnv).
        assert_eq!(fnv64(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv64(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv64(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
