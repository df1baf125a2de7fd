//! `--aov`: numbers beside the picture, read by other decoders, against rays in 64 bits.

#![expect(clippy::cast_precision_loss, reason = "small numbers")]

use std::fmt::Write as _;
use std::path::Path;

use exr::prelude::{ReadChannels as _, ReadLayers as _};

use crate::{Folder, TRIANGLE};

const SIZE: [usize; 2] = [80, 60];
const EYE: [f64; 3] = [0.5, 0.75, 3.0];
/// From there along -z, so that the axes of the picture are those of the world.
const CAMERA: &str =
    "--size 80x60 --eye 0.5,0.75,3 --target 0.5,0.75,0 --fov 60 --near 0.5 --far 9 --quiet -o x.png";

/// A channel by its name.
fn channel(path: &Path, name: &str) -> Vec<f64> {
    let image = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels();
    let image = image.first_valid_layer().all_attributes().from_file(path).expect("an OpenEXR file");
    let channels = &image.layer_data.channel_data.list;
    let names: Vec<_> = channels.iter().map(|channel| channel.name.to_string()).collect();
    let found = names.iter().position(|other| other == name);
    let found = found.unwrap_or_else(|| panic!("{name} is none of {names:?}"));
    match &channels[found].sample_data {
        exr::prelude::FlatSamples::F32(values) => values.iter().map(|&x| f64::from(x)).collect(),
        exr::prelude::FlatSamples::U32(values) => values.iter().map(|&x| f64::from(x)).collect(),
        other => panic!("{other:?}"),
    }
}

/// The direction through the middle of a pixel, with 1 along the line of sight.
fn ray(index: usize) -> [f64; 3] {
    let [width, height] = SIZE.map(|side| side as f64);
    let scale = 30.0_f64.to_radians().tan() / (height / 2.0);
    let [column, row] = [index % SIZE[0], index / SIZE[0]].map(|at| at as f64 + 0.5);
    [(column - width / 2.0) * scale, (height / 2.0 - row) * scale, -1.0]
}

fn words(more: &str) -> Vec<&str> {
    CAMERA.split(' ').chain(more.split(' ')).collect()
}

#[track_caller]
fn near(found: f64, expected: f64, bound: f64) {
    assert!((found - expected).abs() <= bound, "{found} instead of {expected}");
}

/// The plane y = 0 far to all sides, whose texture repeats once a unit.
const FLOOR: &str =
    "v -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\nvt -9 -9\nvt 9 -9\nvt 9 9\nvt -9 9\nf 1/1 2/2 3/3 4/4\n";

#[test]
fn a_plane_has_the_depth_and_the_coordinates_of_rays() {
    let folder = Folder::with(&[("m.obj", FLOOR.as_bytes())]);
    folder.succeeds(&words("m.obj --aov depth,uv --aov-format exr --interpolation affine"));
    let at = |name| channel(&folder.path("x.exr"), name);
    let (depths, us, vs) = (at("Z"), at("UV.U"), at("UV.V"));
    let mut seen = 0;
    for index in 0..SIZE[0] * SIZE[1] {
        let [x, y, _] = ray(index);
        let z = -EYE[1] / y;
        if y < 0.0 && z < 9.0 {
            seen += 1;
            near(depths[index], z, 1e-5 * z);
            near(us[index], EYE[0] + x * z, 4e-5);
            near(vs[index], z - EYE[2], 4e-5);
        } else {
            assert_eq!([depths[index], us[index], vs[index]], [1e10, 0.0, 0.0]);
        }
    }
    assert!(seen > 1000);
    // The same in 16 bits, as the summary says.
    folder.succeeds(&words("m.obj --aov depth,uv"));
    let open = |name| image::open(folder.path(name)).expect("a picture");
    let (depth, uv) = (open("x.depth.png").to_luma16(), open("x.uv.png").to_rgb16());
    for (index, (depth, uv)) in depth.pixels().zip(uv.pixels()).enumerate() {
        if depths[index] > 9.0 {
            assert_eq!((depth.0, uv.0), ([65535], [0; 3]));
            continue;
        }
        near(0.5 + 8.5 * f64::from(depth.0[0]) / 65535.0, depths[index], 8.5 / 65535.0);
        let [u, v, something] = uv.0.map(|word| f64::from(word) / 65535.0);
        near(u, us[index].rem_euclid(1.0), 1e-5);
        near(v, vs[index].rem_euclid(1.0), 1e-5);
        near(something, 1.0, 0.0);
    }
}

/// A ball about (0.5, 0.75, 0) with its normals, in squares of 1/128 of half a turn.
fn ball() -> String {
    const STEPS: usize = 128;
    let mut text = String::new();
    let angle = |k: usize| std::f64::consts::PI * k as f64 / STEPS as f64;
    for (down, around) in (0..=STEPS).flat_map(|down| (0..2 * STEPS).map(move |around| (down, around))) {
        let ((r, y), (z, x)) = (angle(down).sin_cos(), angle(around).sin_cos());
        let (x, z) = (x * r, -z * r);
        writeln!(text, "v {} {} {z}\nvn {x} {y} {z}", x + 0.5, y + 0.75).expect("text");
    }
    let number = |down: usize, around: usize| down * 2 * STEPS + around % (2 * STEPS) + 1;
    for (down, around) in (0..STEPS).flat_map(|down| (0..2 * STEPS).map(move |around| (down, around))) {
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(d, a)| number(down + d, around + a));
        let [a, b, c, d] = corners.map(|k| format!("{k}//{k}"));
        writeln!(text, "f {a} {b} {c} {d}").expect("text");
    }
    text
}

#[test]
fn a_ball_has_the_depth_and_the_normals_of_rays() {
    let folder = Folder::with(&[("m.obj", ball().as_bytes())]);
    folder.succeeds(&words("m.obj --aov normal,depth --aov-format exr --shading unlit --samples 4"));
    let at = |name| channel(&folder.path("x.exr"), name);
    let (depths, normals) = (at("Z"), ["N.X", "N.Y", "N.Z"].map(at));
    folder.succeeds(&words("m.obj --aov normal"));
    let words = image::open(folder.path("x.normal.png")).expect("a picture").to_rgb16();
    let mut seen = 0;
    for (index, word) in (0..SIZE[0] * SIZE[1]).zip(words.pixels()) {
        let [x, y, _] = ray(index);
        // From the eye, z times (x, y, -1) has distance 1 to (0, 0, -3).
        let (a, half) = (x * x + y * y + 1.0, 3.0);
        let square = half * half - 8.0 * a;
        if square < 0.01 {
            assert!(square > -0.05 || depths[index] > 1e9);
            continue;
        }
        seen += 1;
        let z = (half - square.sqrt()) / a;
        // Squares of 1.4 degrees lie up to 1e-4 under the ball.
        near(depths[index], z, 1e-3);
        for (k, n) in [x * z, y * z, 3.0 - z].into_iter().enumerate() {
            near(normals[k][index], n, 2e-3);
            near(f64::from(word.0[k]) / 65535.0 * 2.0 - 1.0, normals[k][index], 2e-5);
        }
    }
    assert!(seen > 700, "{seen}");
}

/// A square of two triangles, and one before a part of it that is nearer, in another object.
const THREE: &str = "o a\nv -0.5 -0.25 0\nv 1.5 -0.25 0\nv 1.5 1.75 0\nv -0.5 1.75 0\nf 1 2 3\nf 1 3 4\n\
                     o b\nusemtl b\nv 0.5 0.75 1\nv 0.7 0.75 1\nv 0.5 0.95 1\nf 5 6 7\n";

#[test]
fn triangles_and_objects_have_numbers_of_their_own() {
    let folder = Folder::with(&[("m.obj", THREE.as_bytes())]);
    folder.succeeds(&words("m.obj --aov id,lod --aov-format exr --depth u16"));
    let at = |name| channel(&folder.path("x.exr"), name);
    let (objects, triangles) = (at("id.object"), at("id.triangle"));
    assert!(at("lod.V").iter().all(|&lod| lod == 0.0));
    folder.succeeds(&words("m.obj --aov id,lod"));
    let words = image::open(folder.path("x.id.png")).expect("a picture").to_rgb16();
    let mut counts = [0; 4];
    for (index, word) in (0..SIZE[0] * SIZE[1]).zip(words.pixels()) {
        let [x, y, _] = ray(index);
        let edge = |a: f64| a.abs() < 1e-3;
        let ([fx, fy], [bx, by]) = ([x * 2.0, y * 2.0], [x * 3.0, y * 3.0]);
        if [fx, fy, fx + fy - 0.2, bx - by, bx.abs() - 1.0, by.abs() - 1.0].into_iter().any(edge) {
            continue;
        }
        let expected = if fx > 0.0 && fy > 0.0 && fx + fy < 0.2 {
            3
        } else if bx.abs().max(by.abs()) > 1.0 {
            0
        } else if by < bx {
            1
        } else {
            2
        };
        counts[expected] += 1;
        let object = [0, 1, 1, 2_u16][expected];
        assert_eq!([objects[index], triangles[index]], [f64::from(object), expected as f64]);
        assert_eq!(word.0.map(usize::from), [object.into(), 0, expected]);
    }
    assert!(counts.iter().all(|&count| count > 10), "{counts:?}");
}

/// A texture that is a hole but for its last texel is one in the numbers too; glass of a third is looked through.
#[test]
fn holes_are_seen_through() {
    let texels = |alpha: [u8; 4]| {
        let texels =
            image::RgbaImage::from_fn(2, 2, |x, y| image::Rgba([255, 255, 255, alpha[(2 * y + x) as usize]]));
        let mut png = std::io::Cursor::new(Vec::new());
        texels.write_to(&mut png, image::ImageFormat::Png).expect("a picture");
        png.into_inner()
    };
    let card = "mtllib m.mtl\nv -0.5 -0.25 0\nv 1.5 -0.25 0\nv 1.5 1.75 0\nv -0.5 1.75 0\nvt 0 0\nvt 1 0\nvt 1 1\n\
                vt 0 1\nusemtl holes\nf 1/1 2/2 3/3 4/4\nusemtl glass\nv -0.5 -0.25 1\nv 1.5 -0.25 1\nv 1.5 1.75 1\n\
                f 5/1 6/2 7/3\n";
    let material = "newmtl holes\nmap_Kd a.png\nnewmtl glass\nd 0.3\n";
    let files =
        [("m.obj", card.as_bytes()), ("m.mtl", material.as_bytes()), ("a.png", &texels([0, 0, 0, 255]))];
    let folder = Folder::with(&files);
    folder.succeeds(&words("m.obj --aov depth,lod --aov-format exr --filter nearest"));
    let (depths, lods) = (channel(&folder.path("x.exr"), "Z"), channel(&folder.path("x.exr"), "lod.V"));
    for index in 0..SIZE[0] * SIZE[1] {
        let [x, y, _] = ray(index).map(|x| x * 3.0);
        if x > 0.05 && y < -0.05 && x < 0.95 && y > -0.95 {
            near(depths[index], 3.0, 1e-5);
            // Two texels are two units wide, and the picture's height shows 2 * 3 * tan 30 degrees.
            near(lods[index], (2.0 * 3.0 * 30.0_f64.to_radians().tan() / 60.0).log2(), 1e-3);
        } else if x < -0.05 || y > 0.05 {
            near(depths[index], 1e10, 0.0);
        }
    }
    // What hides more than half counts.
    std::fs::write(folder.path("m.mtl"), material.replace("0.3", "0.8")).expect("a file");
    folder.succeeds(&words("m.obj --aov depth --aov-format exr"));
    let glass = channel(&folder.path("x.exr"), "Z").iter().filter(|z| (**z - 2.0).abs() < 1e-5).count();
    assert!(glass > 1000, "{glass}");
}

/// Numbers that a model cannot have are told, and are 0.
#[test]
fn numbers_of_nothing_are_told() {
    let folder = Folder::with(&[("m.obj", &b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"[..])]);
    let run = folder.succeeds(&["m.obj", "-s", "40x30", "--aov", "depth,uv,lod"]);
    let told = "warning: --aov: found uv of a model without texture coordinates, expected a model with some; it is 0 \
                everywhere\nwarning: --aov: found lod of a model without a texture, expected a model with some; it is \
                0 everywhere\n";
    assert_eq!(run.stderr, told);
    let lod = image::open(folder.path("alberti.lod.png")).expect("numbers").to_luma16();
    assert!(lod.pixels().all(|pixel| pixel.0 == [0]));
}

#[test]
fn none_is_written_where_one_cannot_be() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    std::fs::create_dir(folder.path("x.uv.png")).expect("a folder");
    folder.fails(&["m.obj", "-o", "x.png", "--aov", "depth,uv"], &["x.uv.png: found a directory"]);
    folder.fails(&["m.obj", "-o", "-", "--aov", "uv"], &["--aov: found it with a picture that is no file"]);
    folder.fails(&["m.obj", "--aov", "uw"], &["--aov: found \"uw\"", "depth, normal, uv, id, lod"]);
    folder.fails(&["m.obj", "--aov-format", "exr"], &["--aov-format: found it without --aov"]);
    let own = ["m.obj", "-o", "x.exr", "--output-format", "png", "--aov", "uv", "--aov-format", "exr"];
    folder.fails(&own, &["x.exr: found the name of the file with --aov"]);
    std::fs::copy(folder.path("m.obj"), folder.path("y.uv.png")).expect("a file");
    let read = ["m.obj", "--texture", "y.uv.png", "-o", "y.png", "--aov", "uv"];
    folder.fails(&read, &["y.uv.png: found a file that is also read"]);
}

#[test]
fn scene_files_ask_for_numbers_and_the_summary_tells_them() {
    let scene = "[render]\naov = \"depth,normal\"\naov-format = \"png16\"\n[[object]]\nmodel = \"m.obj\"\n";
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes()), ("s.toml", scene.as_bytes())]);
    let run = folder.succeeds(&["s.toml", "--near", "0.5", "--far", "8.5", "--size", "20x20"]);
    assert!(run.stdout.contains("aov: alberti.depth.png: z = 0.5 + 8 * v / 65535; 65535 where"), "{run:?}");
    assert_eq!(folder.names(), ["alberti.depth.png", "alberti.normal.png", "alberti.png", "m.obj", "s.toml"]);
}
