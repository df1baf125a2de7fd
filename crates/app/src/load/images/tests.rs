//! Tests of textures that are made of others, against their relations in f64.

use super::*;

/// Four colours, and an image of two by one for red.
fn images() -> (tempfile::TempDir, Images, usize, usize) {
    let folder = tempfile::tempdir().unwrap();
    let mut images = Images::new();
    let mut read = |name: &str, width: u32, texels: &[[u8; 4]]| {
        let path = folder.path().join(name);
        let height = u32::try_from(texels.len()).unwrap() / width;
        image::RgbaImage::from_raw(width, height, texels.concat()).unwrap().save(&path).unwrap();
        images.texture(&MapFile::given(&path)).unwrap().unwrap()
    };
    let colors = read("c.png", 2, &[[200, 100, 50, 255], [10, 20, 30, 9], [255; 4], [0, 128, 64, 0]]);
    let metal = read("m.png", 2, &[[255, 9, 9, 255], [64, 9, 9, 255]]);
    (folder, images, colors, metal)
}

fn texels(images: &Images, index: Option<usize>) -> Vec<[u8; 4]> {
    images.textures.all[index.unwrap()].texels.clone()
}

#[test]
fn metal_mirrors_in_its_colour_and_scatters_less() {
    const SHARE: u8 = 128;
    const COLOR: [u8; 3] = [255, 200, 100];
    let (_folder, mut images, colors, metal) = images();
    for (first, gloss) in
        [(Some(colors), None), (None, None), (Some(colors), Some(metal)), (None, Some(metal))]
    {
        let dull = images.dull(first, (metal, SHARE));
        let of = Mirroring {
            colors: (first, COLOR),
            metal: (Some(metal), SHARE),
            gloss: (gloss, [1.0_f32, 5.0].map(f32::to_bits)),
        };
        let mirroring = images.mirroring(of, |exponent| exponent / 2.0);
        assert_eq!(images.dull(first, (metal, SHARE)), dull, "made once");
        let (dull, mirroring) = (texels(&images, dull), texels(&images, mirroring));
        let count = if first.is_some() { 4 } else { 2 };
        assert_eq!((dull.len(), mirroring.len()), (count, count));
        for (i, (dull, mirroring)) in dull.into_iter().zip(mirroring).enumerate() {
            let color = if first.is_some() { texels(&images, first)[i] } else { [255; 4] };
            let red = f64::from([255, 64][i % 2]) / 255.0;
            let m = red * f64::from(SHARE) / 255.0;
            let height = (1.0 + 4.0 * if gloss.is_some() { red } else { 1.0 }) / 2.0;
            for axis in 0..3 {
                let c = f64::from(color[axis]);
                let off = f64::from(dull[axis]) - c * (1.0 - m / 2.0);
                assert!(off.abs() <= 1.5, "{off}");
                let own = c / 255.0 * f64::from(COLOR[axis]) / 255.0;
                let exact = ((0.04 + (own - 0.04) * m) * height).min(1.0) * 255.0;
                // A byte of metal and one of the colour are rounded, and what follows is times the height.
                let off = f64::from(mirroring[axis]) - exact;
                assert!(off.abs() <= 0.5 + height, "{off}");
            }
            assert_eq!((dull[3], mirroring[3]), (color[3], 255));
        }
    }
}

#[test]
fn broad_highlights_are_fainter() {
    let (_folder, mut images, colors, gloss) = images();
    // Reds of 255 and 64 are exponents of 20 and, within a byte, 5.77.
    let share = |exponent: f32| (exponent / 8.0).min(1.0);
    for first in [Some(colors), None] {
        let fainter = images.fainter(first, gloss, [1.0, 20.0], share);
        let fainter = texels(&images, fainter);
        assert_eq!(fainter.len(), if first.is_some() { 4 } else { 2 });
        for (i, texel) in fainter.into_iter().enumerate() {
            let color = if first.is_some() { texels(&images, first)[i] } else { [255; 4] };
            let share = [1.0, (1.0 + 19.0 * 64.0 / 255.0) / 8.0][i % 2];
            for axis in 0..3 {
                assert!((f64::from(texel[axis]) - share * f64::from(color[axis])).abs() <= 1.0);
            }
        }
    }
    // Where no highlight is that broad nothing is made.
    assert_eq!(images.fainter(Some(colors), gloss, [8.0, 20.0], share), None);
}

#[test]
fn ranges_are_a_factor_and_a_term() {
    let (folder, mut images, colors, _) = images();
    let plain = texels(&images, Some(colors));
    let path = folder.path().join("c.png");
    for range in [[0.25, 0.5], [1.0, -1.0], [-0.5, 3.0]] {
        let map = MapFile { range: Some(range), ..MapFile::given(&path) };
        let index = images.texture(&map).unwrap();
        assert_eq!(images.texture(&map).unwrap(), index, "made once");
        for (ranged, plain) in texels(&images, index).iter().zip(&plain) {
            for axis in 0..3 {
                let [base, gain] = range.map(f64::from);
                let exact = (base * 255.0 + gain * f64::from(plain[axis])).clamp(0.0, 255.0);
                assert!((f64::from(ranged[axis]) - exact).abs() <= 0.501);
            }
            assert_eq!(ranged[3], plain[3]);
        }
    }
}

#[test]
fn maps_together_are_as_between_texels() {
    let (folder, mut images, colors, metal) = images();
    let of = |images: &Images, index| {
        texels(images, index).into_iter().map(|[.., alpha]| alpha).collect::<Vec<_>>()
    };
    let alphas = |images: &mut Images, first, second| {
        let index = images.with_alpha(first, second);
        of(images, index)
    };
    // Red where there is no alpha.
    assert_eq!(alphas(&mut images, Some(colors), metal), [255, 64, 255, 64]);
    assert_eq!(alphas(&mut images, None, metal), [255, 64]);
    // As fine as the alpha, where the colours are coarser: their one row is each of its two.
    assert_eq!(alphas(&mut images, Some(metal), colors), [255, 9, 255, 0]);
    let masked = images.with_alpha(Some(metal), colors);
    let reds: Vec<u8> = texels(&images, masked).into_iter().map(|[red, ..]| red).collect();
    assert_eq!(reds, [255, 64, 255, 64]);
    let faded = images.faded(colors, 51);
    // Colours between texels: those of two by two for a mask of five by three.
    let path = folder.path().join("mask.png");
    image::RgbaImage::from_pixel(5, 3, image::Rgba([7, 0, 0, 255])).save(&path).unwrap();
    let mask = images.texture(&MapFile::given(&path)).unwrap().unwrap();
    let fine = images.with_alpha(Some(colors), mask);
    let (fine, coarse) = (texels(&images, fine), texels(&images, Some(colors)));
    for (i, texel) in fine.iter().enumerate() {
        let i = u32::try_from(i).unwrap();
        let place = |k: u32, of: f64| ((f64::from(k) + 0.5) * 2.0 / of - 0.5).clamp(0.0, 1.0);
        let [x, y] = [place(i % 5, 5.0), place(i / 5, 3.0)];
        for axis in 0..3 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k: usize| f64::from(coarse[k][axis]));
            let exact = (a * (1.0 - x) + b * x) * (1.0 - y) + (c * (1.0 - x) + d * x) * y;
            // Places are rounded down to 256ths.
            assert!((f64::from(texel[axis]) - exact).abs() <= 0.5 + 2.0 * 245.0 / 256.0, "{exact} {texel:?}");
        }
        assert_eq!(texel[3], 7);
    }
    assert_eq!(of(&images, Some(faded)), [51, 2, 51, 0]);
}
