//! Interpolation, numbers, formats and subpixels by name, one by one and in profiles.

use image::RgbImage;

use crate::Folder;

/// A small picture of a built-in scene under these options.
fn picture(scene: &str, arguments: &str) -> RgbImage {
    let folder = Folder::with(&[]);
    let all = format!("--scene {scene} --size 160x120 --samples 1 {arguments}");
    folder.succeeds(&all.split_whitespace().collect::<Vec<_>>());
    image::open(folder.path("alberti.png")).expect("a picture").to_rgb8()
}

/// The part of the pixels that differ.
fn difference(a: &RgbImage, b: &RgbImage) -> f64 {
    let differ: u32 = a.pixels().zip(b.pixels()).map(|(a, b)| u32::from(a != b)).sum();
    f64::from(differ) / f64::from(a.width() * a.height())
}

#[test]
fn every_value_draws() {
    for arguments in [
        "--interpolation exact",
        "--interpolation plane",
        "--interpolation spans:4",
        "--interpolation spans:8",
        "--interpolation spans:16",
        "--interpolation spans:32",
        "--interpolation bounded:0.5",
        "--interpolation bounded:0",
        "--interpolation spans:4 --arithmetic fixed",
        "--interpolation bounded:1 --arithmetic fixed",
        "--depth u16",
        "--depth u24",
        "--depth u32",
        "--depth f32",
        "--depth f32-reversed",
        "--color rgba8",
        "--color rgb565",
        "--subpixel 4",
        "--subpixel 8",
        "--profile reference",
        "--profile desktop",
        "--profile mcu",
    ] {
        // The same scene, whatever it costs: no channel is far off but at edges.
        let (found, expected) = (picture("mesh", arguments), picture("mesh", ""));
        let off = |(a, b): (&u8, &u8)| a.abs_diff(*b) > 24;
        let far = found.iter().zip(expected.iter()).filter(|pair| off(*pair)).count();
        assert!(far < expected.len() / 25, "{arguments}: {far}");
    }
    let trilinear = |lod: &str| picture("mesh", &format!("--filter trilinear --lod {lod}"));
    let [pixel, run, triangle] = ["pixel", "run", "triangle"].map(trilinear);
    assert!(pixel == picture("mesh", "--filter trilinear"));
    for (found, expected) in [(&run, &pixel), (&triangle, &pixel), (&triangle, &run)] {
        assert!((0.01..0.9).contains(&difference(found, expected)));
    }
    for arguments in ["--profile tiny", "--depth none", "--interpolation affine --arithmetic fixed"] {
        assert!(difference(&picture("mesh", arguments), &picture("mesh", "")) > 0.0, "{arguments}");
    }
}

#[test]
fn exact_is_the_default_and_others_miss_as_they_say() {
    assert_eq!(picture("floor", "--interpolation exact"), picture("floor", ""));
    // Rolled: in the scene's own view a row is equally far everywhere, and straight lines along it miss nothing.
    let rolled = |policy: &str| picture("floor", &format!("--up 1,1,0 --interpolation {policy}"));
    let exact = rolled("exact");
    let missed = |policy: &str| difference(&rolled(policy), &exact);
    assert!(missed("plane") < 0.001);
    let (bounded, affine) = (missed("bounded:0.0625"), missed("affine"));
    // Where nothing cheaper keeps the budget, it is exact; in fixed point there is nothing exact.
    let fixed = missed("bounded:0.0625 --arithmetic fixed");
    assert!(bounded < 0.01 && bounded < fixed && fixed < 0.1, "{bounded} {fixed}");
    assert!(affine > 0.5, "{affine}");
    let all = ["spans:4", "spans:8", "spans:16", "spans:32", "affine"].map(missed);
    assert!(all.is_sorted_by(|a, b| a < b), "{all:?}");
}

#[test]
fn small_formats_are_seen() {
    let small = picture("hero", "--color rgb565");
    // Five bits widened: the lowest three repeat the highest.
    assert!(small.pixels().all(|p| p.0[0] & 7 == p.0[0] >> 5 && p.0[1] & 3 == p.0[1] >> 6));
    assert!(difference(&picture("hero", "--subpixel 4"), &picture("hero", "")) > 0.1);
    assert!(difference(&picture("hero", "--near 0.01 --depth u16"), &picture("hero", "--near 0.01")) > 0.001);
}

#[test]
fn a_profile_sets_what_nothing_overrides() {
    let same = |a: &str, b: &str| assert_eq!(picture("floor", a), picture("floor", b), "{a} and {b}");
    let mcu = "--interpolation spans:16 --arithmetic fixed --depth u16 --color rgb565 --subpixel 4";
    same("--profile desktop", "");
    same("--profile reference", "--depth f32-reversed");
    same("--profile mcu", mcu);
    same(
        "--profile tiny",
        "--interpolation affine --arithmetic fixed --depth none --color rgb565 --subpixel 4",
    );
    same("--profile tiny --depth u16 --interpolation spans:16", mcu);
    let reference =
        "--arithmetic float --interpolation exact --depth f32-reversed --color rgba8 --subpixel 8";
    same(&format!("{reference} --profile tiny"), "--profile reference");
}

#[test]
fn values_are_read_in_any_case() {
    let folder = Folder::with(&[("m.obj", crate::TRIANGLE.as_bytes())]);
    let lower = "m.obj -s 8x8 --interpolation affine --two-sided false --ground=true --normals flat --light lamp \
                 --fog exp:1 --filter bilinear --aov depth,uv --cull none";
    let words: Vec<_> = lower.split_whitespace().map(str::to_owned).collect();
    let cased = words.iter().map(|word| match word.strip_prefix("--ground=") {
        Some(value) => format!("--ground={}", value.to_uppercase()),
        None if word.starts_with('-') || word.contains('.') || word == "8x8" => word.clone(),
        None => word.to_uppercase(),
    });
    let pictures = [words.clone(), cased.collect()].map(|words: Vec<String>| {
        let words: Vec<_> = words.iter().map(String::as_str).collect();
        folder.succeeds(&words);
        std::fs::read(folder.path("alberti.png")).expect("a picture")
    });
    assert!(pictures[0] == pictures[1]);
}

#[test]
fn what_does_not_go_together_is_refused() {
    let folder = Folder::with(&[]);
    let fails = |arguments: &str, part: &str| {
        folder.fails(&arguments.split(' ').collect::<Vec<_>>(), &[part]);
    };
    let lines = "expected spans:4, spans:8, spans:16, spans:32, bounded:TEXELS or affine; choose one";
    for (arguments, found) in [
        ("--arithmetic fixed", "--arithmetic: found fixed with exact"),
        ("--arithmetic fixed --interpolation plane", "--arithmetic: found fixed with plane"),
        ("--profile mcu --interpolation exact", "--profile: found fixed with exact"),
        ("--profile desktop --arithmetic fixed", "--arithmetic: found fixed with exact"),
    ] {
        fails(arguments, &format!("error: {found}, {lines}"));
    }
    for value in [
        "",
        "exactly",
        "spans",
        "spans:",
        "spans:5",
        "spans:64",
        "spans:016",
        "spans:-4",
        "bounded",
        "bounded:",
        "bounded:x",
        "bounded:-1",
        "bounded:nan",
        "bounded:inf",
        "affine:4",
        "exacter",
    ] {
        let part = format!("error: --interpolation: found \"{value}\", expected exact, plane, spans:4");
        folder.fails(&["--interpolation", value], &[&part]);
    }
    for arguments in ["--depth f16", "--color rgb999", "--subpixel 6", "--arithmetic int", "--profile fast"] {
        let run = folder.render(&arguments.split(' ').collect::<Vec<_>>());
        assert!(run.status == Some(2) && run.stderr.starts_with("error: "), "{run:?}");
    }
    assert!(folder.names().is_empty());
}

/// A format of colours changes no filter and no samples, so that pictures show what it costs alone; profiles do.
#[test]
fn formats_keep_filters_and_samples() {
    let model = "v 0 0 0\nv 1 0 0\nv 1 0 9\nv 0 0 9\nvt 0 0\nvt 9 0\nvt 9 70\nvt 0 70\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    let texels =
        RgbImage::from_fn(16, 16, |x, y| image::Rgb([if (x / 4 + y / 4) % 2 == 0 { 250 } else { 20 }; 3]));
    let folder = Folder::with(&[("m.obj", model.as_bytes())]);
    texels.save(folder.path("t.png")).expect("an image");
    let picture = |arguments: &str| {
        let all = format!("m.obj --texture t.png -s 64x48 --two-sided true {arguments}");
        folder.succeeds(&all.split_whitespace().collect::<Vec<_>>());
        image::open(folder.path("alberti.png")).expect("a picture").to_rgb8()
    };
    for (given, same, other) in [
        ("--color rgb565", "--filter trilinear --samples 4", "--filter bilinear"),
        ("--color xrgb8888", "--filter trilinear --samples 4", "--samples 1"),
        ("--profile mcu", "--filter bilinear --samples 1", "--samples 4"),
        ("--profile tiny", "--filter bilinear --samples 1", "--samples 4"),
    ] {
        let usual = picture(given);
        assert!(usual == picture(&format!("{given} {same}")), "{given} {same}");
        assert!(usual != picture(&format!("{given} {other}")), "{given} {other}");
    }
}
