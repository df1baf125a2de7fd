//! Bilinear is the documented integer formula, and close to the mean in real numbers.

use alberti_math::Rgba8;
use alberti_texture::format::Rgba8888;
use alberti_texture::{Bilinear, Clamp, Mirror, Repeat, Size, Texture};
use glam::Vec2;

use crate::oracle::{Mode, Random, SPECIAL};

/// The texel before the coordinate, not wrapped, and the weight of the next, in 256ths.
pub(crate) fn position(mode: Mode, u: f32, size: u32) -> (i128, i128) {
    let (significand, halvings) = mode.rational(u);
    // floor(256 * (u * size - 1/2) + 1/2), above and below the bar times 2^(halvings + 1).
    let scaled = 512 * significand * i128::from(size);
    let position = match halvings {
        // The product is below 2^48, and so nothing beside a half.
        100.. => -128,
        _ => (scaled - (255 << halvings)).div_euclid(2 << halvings),
    };
    (position.div_euclid(256), position.rem_euclid(256))
}

struct Case<'a> {
    texture: Texture<'a, Rgba8888>,
    modes: [Mode; 2],
}

impl Case<'_> {
    fn sample(&self, uv: Vec2) -> Rgba8 {
        let color = self.sample_as(self.texture, uv);
        if let Some(texture) = self.texture.power_of_two() {
            assert_eq!(self.sample_as(texture, uv), color, "{:?} {texture:?} at {uv:?}", self.modes);
        }
        color
    }

    fn sample_as<Z: Size>(&self, t: Texture<'_, Rgba8888, Z>, uv: Vec2) -> Rgba8 {
        use Mode::{Clamp as C, Mirror as M, Repeat as R};
        match self.modes {
            [R, R] => t.sampler(Bilinear, Repeat).sample(uv),
            [R, C] => t.sampler_per_axis(Bilinear, Repeat, Clamp).sample(uv),
            [C, C] => t.sampler(Bilinear, Clamp).sample(uv),
            [M, M] => t.sampler(Bilinear, Mirror).sample(uv),
            [M, R] => t.sampler_per_axis(Bilinear, Mirror, Repeat).sample(uv),
            modes => panic!("no such case: {modes:?}"),
        }
    }

    /// A texel by indices of the continued image, counted from the bottom left.
    fn texel(&self, i: i128, j: i128) -> [u8; 4] {
        let (width, height) = (self.texture.width(), self.texture.height());
        let x = self.modes[0].index(i, width);
        let y = height - 1 - self.modes[1].index(j, height);
        self.texture.texels()[usize::try_from(y * width + x).unwrap()]
    }

    fn check(&self, uv: Vec2) {
        let (i, a) = position(self.modes[0], uv.x, self.texture.width());
        let (j, b) = position(self.modes[1], uv.y, self.texture.height());
        let corners =
            [self.texel(i, j), self.texel(i + 1, j), self.texel(i, j + 1), self.texel(i + 1, j + 1)];
        let weights = [(256 - a) * (256 - b), a * (256 - b), (256 - a) * b, a * b];
        let found = self.sample(uv).to_bytes();
        for channel in 0..4 {
            let values = corners.map(|corner| corner[channel]);
            let sum: i128 = weights.iter().zip(values).map(|(w, value)| w * i128::from(value)).sum();
            let expected = (2 * sum + 65536) / 131_072;
            assert_eq!(i128::from(found[channel]), expected, "{:?} {:?} at {uv:?}", self.modes, self.texture);
            let range = values.iter().min().unwrap()..=values.iter().max().unwrap();
            assert!(range.contains(&&found[channel]));
        }
    }

    /// The distance in 255ths from the filter in real numbers, for coordinates that are not huge.
    fn error(&self, uv: Vec2) -> f64 {
        let x = f64::from(uv.x) * f64::from(self.texture.width()) - 0.5;
        let y = f64::from(uv.y) * f64::from(self.texture.height()) - 0.5;
        let (i, j) = (x.floor(), y.floor());
        let (s, t) = (x - i, y - j);
        let found = self.sample(uv).to_bytes();
        let errors = (0..4).map(|channel| {
            let at = |di, dj| f64::from(self.texel(i as i128 + di, j as i128 + dj)[channel]);
            let low = at(0, 0) * (1.0 - s) + at(1, 0) * s;
            let high = at(0, 1) * (1.0 - s) + at(1, 1) * s;
            (f64::from(found[channel]) - (low * (1.0 - t) + high * t)).abs()
        });
        errors.fold(0.0, f64::max)
    }
}

fn for_each_case(mut f: impl FnMut(&Case<'_>)) {
    use Mode::{Clamp as C, Mirror as M, Repeat as R};
    let mut random = Random(2);
    // Bytes of 0 and 255 stress the weights, the others the sums.
    let noise = |random: &mut Random, extreme: bool| {
        random.bits().to_le_bytes().map(|byte| if extreme { 255 * (byte & 1) } else { byte })
    };
    let sizes = [(1, 1), (2, 2), (1, 3), (5, 3), (64, 16), (100, 7), (4328, 3), (3, 16384), (16383, 2)];
    for (width, height) in sizes {
        for extreme in [true, false] {
            let texels: Vec<[u8; 4]> = (0..width * height).map(|_| noise(&mut random, extreme)).collect();
            let texture = Texture::new(Rgba8888, &texels, width, height).unwrap();
            for modes in [[R, R], [R, C], [C, C], [M, M], [M, R]] {
                f(&Case { texture, modes });
            }
        }
    }
}

#[test]
fn special_coordinates() {
    for_each_case(|case| {
        for u in SPECIAL {
            SPECIAL.iter().for_each(|&v| case.check(Vec2::new(u, v)));
        }
    });
}

#[test]
fn random_coordinates() {
    let mut random = Random(3);
    for_each_case(|case| {
        for _ in 0..10_000 {
            case.check(Vec2::new(random.float(), random.near_zero()));
            case.check(Vec2::new(random.near_zero(), random.near_zero()));
        }
    });
}

/// Coordinates of which 38 bits of fraction hold a part: at the steps of the weights, beside them, and anywhere.
#[test]
fn coordinates_below_two_to_the_minus_15() {
    const SMALL: f32 = 1.0 / 32768.0;
    assert_eq!(position(Mode::Repeat, -6.769_148_5e-6, 4328), (-1, 121));
    let mut random = Random(5);
    let mut seen = 0;
    for_each_case(|case| {
        let size = [case.texture.width(), case.texture.height()].map(|side| side as f32);
        for _ in 0..4000 {
            let mut any = |size: f32| {
                let odd = 2.0 * (random.bits() % 128) as f32 - 127.0;
                let step = odd / (512.0 * size);
                [SMALL / 4.0 * random.near_zero(), step, step.next_down()][random.bits() as usize % 3]
            };
            let uv = Vec2::new(any(size[0]), any(size[1]));
            seen += u32::from(uv.x.abs() < SMALL && uv.y.abs() < SMALL);
            case.check(uv);
        }
        case.check(Vec2::new(-6.769_148_5e-6, 0.5));
    });
    assert!(seen > 50_000, "{seen}");
}

/// Every step of the weights and the ties between them, across both seams.
#[test]
fn every_weight() {
    for_each_case(|case| {
        for step in -1024..=1024_i16 {
            let x = f32::from(step) / 512.0;
            let u = [x, 1.0 + x].map(|x| x / case.texture.width() as f32);
            let v = x / case.texture.height() as f32;
            u.iter().for_each(|&u| case.check(Vec2::new(u, v)));
        }
    });
}

#[test]
fn within_one_and_a_half_of_real_numbers() {
    let mut random = Random(4);
    let mut worst = 0.0;
    for_each_case(|case| {
        for _ in 0..20_000 {
            worst = case.error(Vec2::new(random.near_zero(), random.near_zero())).max(worst);
        }
    });
    assert!((1.0..1.5).contains(&worst), "{worst}");
}

#[test]
fn centres_are_texels() {
    for_each_case(|case| {
        let (width, height) = (case.texture.width(), case.texture.height());
        for i in 0..width.min(600) {
            for j in 0..height.min(20) {
                let centre = Vec2::new((i as f32 + 0.5) / width as f32, (j as f32 + 0.5) / height as f32);
                assert_eq!(case.sample(centre).to_bytes(), case.texel(i.into(), j.into()));
            }
        }
    });
}
