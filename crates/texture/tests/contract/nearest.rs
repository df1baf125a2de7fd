//! Nearest takes the texel that exact arithmetic takes.

use alberti_texture::{Clamp, Mirror, Nearest, Repeat, Size, Texture};
use glam::Vec2;

use crate::oracle::{Index, MODES, Mode, Random, SPECIAL};

const SIZES: [u32; 14] = [1, 2, 3, 5, 7, 10, 64, 100, 255, 256, 1000, 12345, 16383, 16384];

/// One row and one column of `size` texels, sampled at `u` along their length and at anything across; where the size is
/// a power of two, by that type too.
fn check(texels: &[u16], size: u32, u: f32, across: f32) {
    let row = Texture::new(Index, texels, size, 1).unwrap();
    let column = Texture::new(Index, texels, 1, size).unwrap();
    let (uv, vu) = (Vec2::new(u, across), Vec2::new(across, u));
    for mode in MODES {
        let expected = mode.cell(u, size);
        let check = |x: u32, y: u32, kind: &str| {
            assert_eq!(x, expected, "{mode:?}, u = {u:e}, {size} columns, {kind}");
            assert_eq!(y, size - 1 - expected, "{mode:?}, v = {u:e}, {size} rows, {kind}");
        };
        check(sample(row, mode, uv), sample(column, mode, vu), "any size");
        if let (Some(row), Some(column)) = (row.power_of_two(), column.power_of_two()) {
            check(sample(row, mode, uv), sample(column, mode, vu), "power of two");
        }
        if let (Some(row), Some(column)) = (row.known::<256, 1>(), column.known::<1, 256>()) {
            check(sample(row, mode, uv), sample(column, mode, vu), "known");
        }
    }
}

fn sample<Z: Size>(texture: Texture<'_, Index, Z>, mode: Mode, uv: Vec2) -> u32 {
    let color = match mode {
        Mode::Repeat => texture.sampler(Nearest, Repeat).sample(uv),
        Mode::Clamp => texture.sampler(Nearest, Clamp).sample(uv),
        Mode::Mirror => texture.sampler(Nearest, Mirror).sample(uv),
    };
    color.to_bits()
}

fn for_each_size(mut f: impl FnMut(&[u16], u32)) {
    let texels: Vec<u16> = (0..16384).collect();
    for size in SIZES {
        f(&texels[..usize::try_from(size).unwrap()], size);
    }
}

#[test]
fn special_coordinates() {
    for_each_size(|texels, size| SPECIAL.iter().for_each(|&u| check(texels, size, u, f32::NAN)));
}

#[test]
fn random_coordinates() {
    let mut random = Random(1);
    for_each_size(|texels, size| {
        for _ in 0..100_000 {
            check(texels, size, random.float(), random.near_zero());
            check(texels, size, random.near_zero(), random.float());
        }
    });
}

/// The floats at and next to every border, in copies near and far.
#[test]
fn borders() {
    for_each_size(|texels, size| {
        for j in 0..=size {
            for copy in [0.0, -1.0, 1.0, -2.0, 100.0, 8190.0, -70000.0] {
                let border = (f64::from(j) / f64::from(size) + copy) as f32;
                for u in [border.next_down().next_down(), border.next_down(), border, border.next_up()] {
                    check(texels, size, u, 0.5);
                }
            }
        }
    });
}

/// The picture of the convention: uv and rows.
#[test]
fn v_is_up_and_row_0_is_the_top() {
    let texture = Texture::new(Index, &[0, 1, 2, 3, 4, 5], 3, 2).unwrap();
    let sampler = texture.sampler(Nearest, Clamp);
    let at = |u, v| sampler.sample(Vec2::new(u, v)).to_bits();
    assert_eq!([at(0.0, 1.0), at(0.5, 1.0), at(1.0, 1.0)], [0, 1, 2]);
    assert_eq!([at(0.0, 0.0), at(0.5, 0.0), at(1.0, 0.0)], [3, 4, 5]);
    assert_eq!([at(0.1, 0.5), at(0.1, 0.49)], [0, 3]);
}
