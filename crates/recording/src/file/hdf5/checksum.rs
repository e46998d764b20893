//! The two checksums of the format: over pieces of its structure, and over the values of a chunk.

/// The checksum of a piece of structure.
///
/// Source: R. J. Jenkins, lookup3.c (2006), `hashlittle` with the start value 0.
pub(super) fn lookup3(bytes: &[u8]) -> u32 {
    // The length enters modulo 2³² by definition.
    let start = 0xdead_beef_u32.wrapping_add(bytes.len() as u32);
    let [mut a, mut b, mut c] = [start; 3];
    let mut blocks = bytes.chunks(12).peekable();
    while let Some(block) = blocks.next() {
        let mut words = [0; 12];
        words[..block.len()].copy_from_slice(block);
        let word = |k: usize| u32::from_le_bytes([0, 1, 2, 3].map(|byte| words[4 * k + byte]));
        a = a.wrapping_add(word(0));
        b = b.wrapping_add(word(1));
        c = c.wrapping_add(word(2));
        // Every step treats the three sums in turn: they change names behind it.
        if blocks.peek().is_some() {
            for turn in [4, 6, 8, 16, 19, 4] {
                a = a.wrapping_sub(c) ^ c.rotate_left(turn);
                c = c.wrapping_add(b);
                (a, b, c) = (b, c, a);
            }
        } else {
            for turn in [14, 11, 25, 16, 4, 14, 24] {
                c = (c ^ b).wrapping_sub(b.rotate_left(turn));
                (a, b, c) = (b, c, a);
            }
            c = b;
        }
    }
    c
}

/// The checksum of the values of a chunk.
///
/// Source: J. G. Fletcher, IEEE Trans. Commun. 30 (1982) 247, over words of 16 bits, the high byte first.
pub(super) fn fletcher32(bytes: &[u8]) -> u32 {
    let (mut first, mut second) = (0u32, 0u32);
    let fold = |sum: u32| (sum & 0xffff) + (sum >> 16);
    // 360 words: as many as 32 bits hold before the sums are folded.
    for piece in bytes.chunks(720) {
        for word in piece.chunks(2) {
            let low = word.get(1).copied().unwrap_or(0);
            first += u32::from(u16::from_be_bytes([word[0], low]));
            second += first;
        }
        (first, second) = (fold(first), fold(second));
    }
    fold(second) << 16 | fold(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values that lookup3.c prints in its own test, driver5.
    #[test]
    fn lookup3_gives_the_values_of_its_author() {
        assert_eq!(lookup3(b""), 0xdead_beef);
        assert_eq!(lookup3(b"Four score and seven years ago"), 0x1777_0551);
    }

    /// The values that the literature gives for texts of whole words, the low byte first, with the bytes in pairs swapped.
    #[test]
    fn fletcher32_gives_the_published_values() {
        assert_eq!(fletcher32(b"badcfe"), 0x5650_2d2a);
        assert_eq!(fletcher32(b"badcfehg"), 0xebe1_9591);
        // An odd byte is the high one of a last word.
        assert_eq!(fletcher32(&[1, 2, 3]), 0x0504_0402);
        // Folded sums do not overflow, however long the values are.
        assert_eq!(fletcher32(&[0xff; 100_000]), 0xffff_ffff);
    }
}
