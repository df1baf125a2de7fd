//! Parallel projection, and a projector's image, by name.

use image::{Rgb, RgbImage};

use crate::Folder;

/// A square of side 2 around (0.01, 0.02, z), facing +z.
fn square(z: f32) -> String {
    format!("v -0.99 -0.98 {z}\nv 1.01 -0.98 {z}\nv 1.01 1.02 {z}\nv -0.99 1.02 {z}\nf 1 2 3 4\n")
}

/// A light square at this depth, seen from (0, 0, 8) in 64 x 64 pixels.
fn picture(z: f32, arguments: &str) -> RgbImage {
    let folder = Folder::with(&[("m.obj", square(z).as_bytes())]);
    let slide = RgbImage::from_fn(4, 2, |x, _| if x < 2 { RED } else { BLUE });
    slide.save(folder.path("slide.png")).expect("a file");
    let view = "m.obj --samples 1 --size 64x64 --eye 0,0,8 --target 0,0,0 --fov 30 --near 1 --far 30 --shading unlit";
    folder.succeeds(&format!("{view} {arguments}").split_whitespace().collect::<Vec<_>>());
    image::open(folder.path("alberti.png")).expect("a picture").to_rgb8()
}

const RED: Rgb<u8> = Rgb([255, 0, 0]);
const BLUE: Rgb<u8> = Rgb([0, 0, 255]);

/// What of the picture is of this colour, bright or not so bright.
fn of<'a>(picture: &'a RgbImage, color: Rgb<u8>) -> impl Iterator<Item = (u32, u32)> + 'a {
    let like =
        move |p: &Rgb<u8>| p.0.iter().zip(color.0).all(|(a, b)| if b == 0 { *a < 20 } else { *a > 100 });
    picture.enumerate_pixels().filter(move |p| like(p.2)).map(|(x, y, _)| (x, y))
}

fn count(picture: &RgbImage, color: Rgb<u8>) -> usize {
    of(picture, color).count()
}

/// What is not of the background that these tests choose.
fn covered(picture: &RgbImage) -> usize {
    picture.pixels().filter(|p| p.0 != [1, 2, 3]).count()
}

#[test]
fn in_parallel_projection_distance_does_not_count() {
    let parallel = |z| picture(z, "--projection parallel");
    assert_eq!(parallel(0.0), parallel(-5.0));
    assert_ne!(picture(0.0, ""), picture(-5.0, ""));
    assert_eq!(picture(0.0, "--projection perspective"), picture(0.0, ""));
    // It shows as much as the perspective does around the target.
    assert_eq!(parallel(0.0), picture(0.0, ""));
    // A square of side 2, of 8 units in 64 pixels.
    let seen = picture(-5.0, "--projection parallel --view-height 8 --background 010203");
    assert_eq!(covered(&seen), 16 * 16);
}

#[test]
fn a_projector_colours_what_is_before_it() {
    // At the distance 1, this is 1.68 units of height, of the square's 2, and twice as much of width.
    let from = |place: &str| {
        format!("--projector slide.png {place} --projector-fov 80 --filter nearest --background 010203")
    };
    let front = picture(0.0, &from("--projector-eye 0,0,1 --projector-target 0,0,0"));
    let all = covered(&front);
    assert!(all > 800, "{all}");
    let (red, blue) = (count(&front, RED), count(&front, BLUE));
    let lit = (all * 78 / 100)..(all * 90 / 100);
    assert!(lit.contains(&(red + blue)) && red.abs_diff(blue) < all / 20, "{red} {blue} of {all}");
    let side = |picture: &RgbImage, color| of(picture, color).all(|(x, _)| x < 32);
    assert!(side(&front, RED) && !side(&front, BLUE));
    // From behind it is the other way round, and a projector that looks away shows nothing.
    let back = picture(0.0, &from("--projector-eye 0,0,-1 --projector-target 0,0,0"));
    assert!(side(&back, BLUE) && !side(&back, RED) && count(&back, RED) > 100);
    let away = picture(0.0, &from("--projector-eye 0,0,1 --projector-target 0,0,2"));
    assert_eq!((count(&away, RED), count(&away, BLUE), covered(&away)), (0, 0, all));
    let parallel =
        picture(0.0, &from("--projection parallel --projector-eye 0,0,1 --projector-target 0,0,0"));
    assert_eq!(parallel, front);
}

#[test]
fn a_projector_that_misses_the_model_is_warned_of() {
    let folder = Folder::with(&[("m.obj", square(0.0).as_bytes())]);
    RgbImage::new(2, 2).save(folder.path("s.png")).expect("a file");
    let said = |target: &str| {
        let slide = ["--projector", "s.png", "--projector-eye", "0,0,1", "--projector-target", target];
        folder.succeeds(&[&["m.obj", "--size", "16x16"][..], &slide].concat()).stderr
    };
    let warning = "warning: --projector-target: found an image that falls nowhere on the model, expected the model \
                   before the projector\n";
    assert_eq!([said("0,0,0"), said("0,0,2"), said("9,0,1")], ["", warning, warning]);
}

/// What `bounded:TEXELS` means for the model's own texture does not depend on the projected image's size.
#[test]
fn a_projected_image_has_no_part_in_a_budget_of_texels() {
    let folder = Folder::with(&[(
        "m.obj",
        b"v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 4/4 3/3 2/2\n",
    )]);
    RgbImage::from_fn(16, 16, |x, y| if (x + y) % 2 == 0 { RED } else { BLUE })
        .save(folder.path("t.png"))
        .expect("a file");
    let drawn = |side: u32, texels: f32| {
        RgbImage::from_pixel(side, side, Rgb([255; 3])).save(folder.path("s.png")).expect("a file");
        let arguments = format!(
            "m.obj --size 64x64 --eye 0,1,10 --target 0,0,0 --up 1,1,0 --shading unlit --filter nearest --texture \
             t.png --projector s.png --projector-eye 0,0.2,0 --projector-target 0,0,0 --arithmetic fixed \
             --interpolation bounded:{texels}"
        );
        folder.succeeds(&arguments.split(' ').collect::<Vec<_>>());
        image::open(folder.path("alberti.png")).expect("a picture").to_rgb8()
    };
    assert_eq!(drawn(1, 4.0), drawn(1024, 4.0));
    assert_ne!(drawn(1, 4.0), drawn(1, 4.0 * 16.0 / 1024.0));
}

#[test]
fn both_go_with_all_policies() {
    let front = "--projector slide.png --projector-eye 0.3,0,2 --projector-target 0,0,0";
    let expected = picture(-1.0, front);
    for policy in [
        "--interpolation plane",
        "--interpolation spans:8",
        "--interpolation bounded:0.1",
        "--interpolation spans:16 --arithmetic fixed",
        "--profile mcu --color rgba8",
        "--depth u32",
        "--depth none",
        "--filter nearest",
        "--subpixel 4",
    ] {
        let found = picture(-1.0, &format!("{front} {policy}"));
        let off = |(a, b): (&u8, &u8)| a.abs_diff(*b) > 90;
        let far = found.iter().zip(expected.iter()).filter(|pair| off(*pair)).count();
        assert!(far < expected.len() / 25, "{policy}: {far}");
        assert!(count(&found, RED) > 50, "{policy}: no red");
    }
}

/// All policies are straight lines there, but for rounding; what is taken without asking is that.
#[test]
fn in_parallel_projection_policies_do_not_differ() {
    let view = "--projection parallel --up 1,1,0 \
                --projector slide.png --projector-eye 1,0.5,2 --projector-target 0,0,0";
    let expected = picture(0.0, view);
    assert_eq!(picture(0.0, &format!("{view} --interpolation affine")), expected);
    for policy in [
        "exact",
        "plane",
        "spans:8",
        "bounded:0.01",
        "spans:16 --arithmetic fixed",
        "affine --arithmetic fixed",
    ] {
        let found = picture(0.0, &format!("{view} --interpolation {policy}"));
        let off = found.iter().zip(expected.iter()).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(off <= Some(2), "{policy}: {off:?}");
    }
    assert!(count(&expected, RED) > 50 && count(&expected, BLUE) > 50);
}

#[test]
fn in_parallel_projection_planes_may_lie_behind_the_eye() {
    let folder = Folder::with(&[("m.obj", square(12.0).as_bytes())]);
    let view = "m.obj --size 64x64 --eye 0,0,8 --target 0,0,0 --shading unlit --background 010203";
    let seen = |arguments: &str| {
        let run = folder.succeeds(&format!("{view} {arguments}").split(' ').collect::<Vec<_>>());
        (covered(&image::open(folder.path("alberti.png")).expect("a picture").to_rgb8()), run.stderr)
    };
    let parallel = "--projection parallel --view-height 8";
    assert_eq!(seen(&format!("{parallel} --near -5 --far -3")), (16 * 16, String::new()));
    assert_eq!(seen(&format!("{parallel} --near -5 --far 0")), (16 * 16, String::new()));
    let warning =
        "warning: --eye: found a camera that looks away from the model, expected the model in view\n";
    assert_eq!(seen(&format!("{parallel} --near 0 --far 3")), (0, warning.to_owned()));
    let refused = |arguments: &str, message: &str| {
        folder.fails(&format!("{view} {arguments}").split(' ').collect::<Vec<_>>(), &[message]);
    };
    refused(
        &format!("{parallel} --near -3 --far -5"),
        "error: --far: found near -3 and far -5, expected near < far",
    );
    refused(
        "--near -5 --far 3",
        "error: --near: found near -5, expected a finite number above 0; try --near ",
    );
}

/// Each names the option, and what it calls usable is.
#[test]
fn what_is_too_large_or_too_small_is_told_from_what_is_impossible() {
    let folder = Folder::with(&[("m.obj", square(0.0).as_bytes())]);
    RgbImage::new(2, 2).save(folder.path("s.png")).expect("a file");
    let slide = "--projector s.png --projector-eye 0,0,3 --projector-target 0,0,0";
    let height = "too small or too large for 32-bit floats, expected a height from 1e-30 to 1e30";
    let angle = "expected an angle of at least 0.001 degrees";
    let planes = "expected planes farther apart, and neither too near nor too far for 32-bit floats; try";
    for (view, bad, message, good) in [
        (
            "--projection parallel",
            "--view-height 1e-40",
            format!("error: --view-height: found a height of 1e-40, {height}"),
            "--view-height 1e-30",
        ),
        (
            "--projection parallel",
            "--view-height 3e38",
            format!("error: --view-height: found a height of 3e38, {height}"),
            "--view-height 1e30",
        ),
        ("--eye 0,0,8", "--fov 1e-38", format!("error: --fov: found 1e-38 degrees, {angle}"), "--fov 0.001"),
        (
            slide,
            "--projector-fov 1e-38",
            format!("error: --projector-fov: found 1e-38 degrees, {angle}"),
            "--projector-fov 0.001",
        ),
        (
            "--eye 0,0,8",
            "--near 3e38 --far 3.0000003e38",
            format!("error: --near: found near 3e38 and far 3.0000002e38, {planes} --near 1e27 --far 1e30"),
            "--near 1e27 --far 1e30",
        ),
        (
            "--projection parallel",
            "--near -3.1e38 --far -3e38",
            format!("error: --near: found near -3.1e38 and far -3e38, {planes} --near -2e30 --far -1e30"),
            "--near -2e30 --far -1e30",
        ),
    ] {
        let split = |more| format!("m.obj {view} {more}").split(' ').map(str::to_owned).collect::<Vec<_>>();
        folder.fails(&split(bad), &[&message]);
        folder.succeeds(&split(good));
    }
}

#[test]
fn options_without_their_partners_are_refused() {
    let folder = Folder::with(&[("m.obj", square(0.0).as_bytes()), ("broken.png", b"")]);
    RgbImage::new(2, 2).save(folder.path("s.png")).expect("a file");
    let at = "--projector-eye 1,2,3 --projector-target 0,0,0";
    for (arguments, message) in [
        (
            "--projector-eye 1,2,3",
            "error: --projector-eye: found it without --projector and --projector-target, expected all three",
        ),
        (
            "--projector-target 1,2,3",
            "error: --projector-target: found it without --projector and --projector-eye, expected all three",
        ),
        (
            at,
            "error: --projector-eye: found it without --projector, expected all three of --projector, --proj",
        ),
        (
            "--projector-fov 30",
            "error: --projector-fov: found it without --projector and --projector-eye and --projector-target,",
        ),
        (
            "--projector s.png",
            "error: --projector: found it without --projector-eye and --projector-target, expected all three",
        ),
        (
            "--projector s.png --projector-eye 1,2,3 --projector-fov 9",
            "error: --projector: found it without --projector-target, expected all three",
        ),
        (
            "--projector s.png --projector-eye 1,2",
            "error: --projector-eye: found \"1,2\", expected three finite",
        ),
        (
            "--projector s.png --projector-eye 1,2,3 --projector-target 1,2,3",
            "error: --projector-eye: found the eye and its target both at 1,2,3, expected two points",
        ),
        (&format!("--projector s.png {at} --projector-fov 180"), "error: --projector-fov: found 180 degrees"),
        (&format!("--projector no.png {at}"), "error: no.png: found no such file, expected a PNG"),
        (&format!("--projector broken.png {at}"), "error: broken.png: found "),
        (&format!("--projector s.png {at} -o s.png"), "error: s.png: found a file that is also read"),
        ("--view-height 3", "error: --view-height: found it without --projection parallel, expected --pro"),
        (
            "--projection perspective --view-height 3",
            "error: --view-height: found it without --projection par",
        ),
        ("--projection parallel --view-height 0", "error: --view-height: found a height of 0, expected"),
        ("--projection parallel --view-height -2", "error: --view-height: found a height of -2, expected"),
        (
            "--projection parallel --view-height nan",
            "error: --view-height: found \"nan\", expected a finite number",
        ),
    ] {
        let arguments: Vec<_> = "m.obj".split(' ').chain(arguments.split(' ')).collect();
        folder.fails(&arguments, &[message]);
    }
    let run = folder.render(&["m.obj", "--projection", "oblique"]);
    assert!(run.status == Some(2) && run.stderr.starts_with("error: "), "{run:?}");
}
