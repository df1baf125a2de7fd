//! `defmt`: the bytes that are sent, of which the texts are numbers. In this build defmt keeps them for tests.

use alberti::raster::color::AnyBlend;
use alberti::texture::TextureError;
use alberti::*;

/// The bytes of a value after the number of its format: of enums the variant's number, then fields, little-endian.
fn sent(value: &impl defmt::Format) -> Vec<u8> {
    let _ = defmt::export::fetch_bytes();
    defmt::export::fmt(value);
    let mut bytes = defmt::export::fetch_bytes();
    assert!(bytes.len() >= 2, "the number of a format");
    bytes.drain(..2);
    bytes
}

#[test]
fn errors_are_sent_with_their_numbers() {
    assert_eq!(sent(&ViewError::Aspect), [4]);
    assert_eq!(sent(&TargetError::Size), [0]);
    assert_eq!(sent(&TargetError::Rows { pixels: 0x1_02, width: 5 }), [1, 2, 1, 0, 0, 5, 0, 0, 0]);
    let error = TextureError::ZeroSize { width: 0, height: 3 };
    assert_eq!(sent(&error), [0, 0, 0, 0, 0, 3, 0, 0, 0]);
    // One of three, around the number of its format and its bytes.
    let around = sent(&Error::Target(TargetError::Size));
    assert_eq!((around.len(), around[0], around[3]), (4, 1, 0));
}

#[test]
fn counts_are_sent_as_numbers() {
    let stats = Stats {
        submitted: 1,
        dropped: 2,
        clipped: 3,
        culled: 4,
        missed: 5,
        drawn: 6,
        fragments: 7,
        written: 1 << 40,
    };
    let expected: Vec<u8> =
        [1_u64, 2, 3, 4, 5, 6, 7, 1 << 40].iter().flat_map(|count| count.to_le_bytes()).collect();
    assert_eq!(sent(&stats), expected);
}

#[test]
fn small_values_are_sent() {
    assert_eq!(sent(&AnyDepth::D24), [2]);
    assert_eq!(sent(&AnyBlend::Constant(9)), [2, 9]);
    assert_eq!(sent(&Sub8), [1]);
    assert_eq!(sent(&Rgba8::new(1, 2, 3, 4)), [1, 2, 3, 4]);
    // A name, and after it the numbers of the fields.
    let biased = sent(&Biased { format: OrEqual(D16), constant: 1.0, slope: -2.5, clamp: 0.25 });
    let numbers: Vec<u8> = [1.0_f32, -2.5, 0.25].iter().flat_map(|number| number.to_le_bytes()).collect();
    assert!(biased.ends_with(&numbers), "{biased:?}");
    assert!(!sent(&Exact).is_empty());
}
