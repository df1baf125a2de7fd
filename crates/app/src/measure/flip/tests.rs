//! FLIP against its authors' own program.
//!
//! The numbers are those of NVIDIA's FLIP 1.7, as the Python package `flip-evaluator` 1.7 has it (C++ behind it), at
//! its default of 67.02064 pixels per degree. The pictures were made there anew from the formulas below, as arrays of
//! bytes, and given to it as
//!
//! ```python
//! errors, mean, _ = flip_evaluator.evaluate(first / numpy.float32(255), second / numpy.float32(255), "LDR",
//!                                           inputsRGB=True, applyMagma=False)
//! ```

use super::*;

/// A picture by formula: the bytes of the pixel in this column and row.
type Formula = fn(u32, u32) -> [u32; 3];

/// Two pictures, and what the authors' program finds between them.
struct Case {
    name: &'static str,
    size: [u32; 2],
    first: Formula,
    second: Formula,
    mean: f64,
    /// Column, row and error of some pixels.
    pixels: &'static [(usize, usize, f32)],
}

const CASES: [Case; 7] = [
    Case {
        name: "colours of faint texture",
        size: [48, 32],
        first: |x, y| [5 * x, 7 * y, 3 * (x + y)],
        second: |x, y| [5 * x + (x % 2) * 3, 7 * y, 3 * (x + y) + 2 * (y % 2)],
        mean: 0.041_387_7,
        pixels: &[
            (0, 0, 0.007_85),
            (24, 16, 0.040_887),
            (47, 31, 0.072_775),
            (16, 8, 0.036_461),
            (32, 30, 0.052_174),
        ],
    },
    Case {
        name: "a board of squares, moved by a pixel",
        size: [40, 40],
        first: |x, y| [255 * ((x / 8 + y / 8) % 2); 3],
        second: |x, y| [255 * (((x + 1) / 8 + y / 8) % 2); 3],
        mean: 0.333_861_4,
        pixels: &[
            (0, 0, 0.0),
            (20, 20, 0.349_499),
            (39, 39, 0.993_284),
            (13, 10, 0.638_285),
            (26, 38, 0.136_817),
        ],
    },
    Case {
        name: "noise, and the same with half the contrast",
        size: [37, 29],
        first: |x, y| [1, 2, 3].map(|seed| noise(x, y, seed)),
        second: |x, y| [1, 2, 3].map(|seed| noise(x, y, seed) / 2 + 64),
        mean: 0.320_673_0,
        pixels: &[
            (0, 0, 0.327_88),
            (18, 14, 0.346_067),
            (36, 28, 0.428_67),
            (12, 7, 0.319_016),
            (24, 27, 0.356_418),
        ],
    },
    Case {
        name: "a slanted edge, moved by two pixels",
        size: [64, 48],
        first: |x, y| if 3 * x + y < 120 { [200, 60, 30] } else { [20, 90, 160] },
        second: |x, y| if 3 * x + y < 126 { [200, 60, 30] } else { [20, 90, 160] },
        mean: 0.061_626_5,
        pixels: &[
            (32, 24, 0.486_147),
            (28, 30, 0.328_324),
            (34, 21, 0.509_76),
            (36, 24, 0.180_754),
            (45, 3, 0.080_54),
        ],
    },
    Case {
        name: "red and green, smaller than the filters",
        size: [5, 3],
        first: |_, _| [255, 0, 0],
        second: |_, _| [0, 255, 0],
        mean: 0.986_664_8,
        pixels: &[(0, 0, 0.986_665), (2, 1, 0.986_665), (4, 2, 0.986_665)],
    },
    Case {
        name: "one pixel",
        size: [1, 1],
        first: |_, _| [128, 64, 32],
        second: |_, _| [130, 60, 32],
        mean: 0.078_212_5,
        pixels: &[(0, 0, 0.078_213)],
    },
    Case {
        name: "columns over three bands",
        size: [24, 300],
        first: |x, y| [y % 256, 128, 40 * (x / 4)],
        second: |x, y| [(y + noise(x / 3, y / 3, 9) / 32) % 256, 128, 40 * (x / 4)],
        mean: 0.071_210_1,
        pixels: &[
            (0, 0, 0.012_908),
            (11, 127, 0.071_651),
            (12, 128, 0.047_843),
            (5, 255, 0.821_795),
            (6, 256, 0.519_414),
            (23, 299, 0.043_365),
        ],
    },
];

/// Two steps of the generator of Numerical Recipes, and its upper byte.
fn noise(x: u32, y: u32, seed: u32) -> u32 {
    let step = |state: u32| state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    step(step(x * 7919 + y * 104_729 + seed * 1_299_709)) >> 24
}

fn picture([width, height]: [u32; 2], formula: Formula) -> Image {
    let byte = |value: u32| u8::try_from(value).unwrap();
    let texels = (0..height).flat_map(|y| {
        (0..width).map(move |x| {
            let [red, green, blue] = formula(x, y).map(byte);
            // Alpha is none of FLIP's business.
            [red, green, blue, byte((x + y) % 256)]
        })
    });
    Image { width, height, texels: texels.collect() }
}

#[test]
fn numbers_are_those_of_the_authors_program() {
    for Case { name, size, first, second, mean, pixels } in CASES {
        let errors = map(&picture(size, first), &picture(size, second)).unwrap();
        assert_eq!(errors.len(), (size[0] * size[1]) as usize);
        for &(x, y, expected) in pixels {
            let found = errors[y * size[0] as usize + x];
            assert!((found - expected).abs() < 1e-5, "{name}, pixel {x},{y}: {found}, expected {expected}");
        }
        let found = errors.iter().copied().map(f64::from).sum::<f64>() / f64::from(size[0] * size[1]);
        assert!((found - mean).abs() < 1e-6, "{name}: {found}, expected {mean}");
    }
}

#[test]
fn bands_leave_no_trace() {
    let Case { size, first, second, .. } = CASES[6];
    let [first, second] = [picture(size, first), picture(size, second)];
    let mut whole = vec![0.0; first.texels.len()];
    fill(&mut whole, 0, 24, &first, &second).unwrap();
    assert_eq!(map(&first, &second).unwrap(), whole);
}
