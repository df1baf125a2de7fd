//! Models as their authors meant them: far ones, concave faces, edges, compressed files and standard input.

use std::ffi::OsStr;
use std::fs;
use std::io::Write as _;
use std::process::{Command, Stdio};

use crate::{Folder, TRIANGLE, alberti};

/// A ball of quads around a point, without normals.
fn ball([x, y, z]: [f64; 3]) -> String {
    let (around, up) = (24_u32, 12_u32);
    let mut text = String::new();
    for j in 0..=up {
        let (sin_b, cos_b) = (std::f64::consts::PI * f64::from(j) / f64::from(up)).sin_cos();
        for i in 0..around {
            let (sin_a, cos_a) = (std::f64::consts::TAU * f64::from(i) / f64::from(around)).sin_cos();
            text += &format!("v {:.9} {:.9} {:.9}\n", x + sin_b * cos_a, y + cos_b, z - sin_b * sin_a);
        }
    }
    for j in 0..up {
        for i in 0..around {
            let [a, b] = [i, (i + 1) % around].map(|i| j * around + i + 1);
            text += &format!("f {a} {} {} {b}\n", a + around, b + around);
        }
    }
    text
}

/// The picture's pixels.
fn pixels(folder: &Folder, name: &str) -> Vec<u8> {
    image::open(folder.path(name)).expect("a picture").into_rgb8().into_raw()
}

/// The greatest difference of two pictures, and how many channels differ.
fn difference(folder: &Folder, [a, b]: [&str; 2]) -> (u8, usize) {
    let (a, b) = (pixels(folder, a), pixels(folder, b));
    let all = a.iter().zip(&b).map(|(a, b)| a.abs_diff(*b));
    (all.clone().max().unwrap_or(0), all.filter(|&d| d > 0).count())
}

#[test]
fn a_far_model_looks_as_at_the_origin() {
    let (near, far) = (ball([0.0; 3]), ball([500_000.0, 120.0, 4e6]));
    let folder = Folder::with(&[("near.obj", near.as_bytes()), ("far.obj", far.as_bytes())]);
    for (at_origin, moved) in [
        (&[][..], &[][..]),
        (
            &["--eye", "1.25,2,3.5", "--target", "0,0.1,0"][..],
            &["--eye", "500001.25,122,4000003.5", "--target", "500000,120.1,4000000"][..],
        ),
    ] {
        let picture = ["--size", "160x120", "-o"];
        folder.succeeds(&[&["near.obj"][..], &picture, &["near.png"], at_origin].concat());
        folder.succeeds(&[&["far.obj"][..], &picture, &["far.png"], moved].concat());
        let (greatest, count) = difference(&folder, ["near.png", "far.png"]);
        assert!(greatest <= 2 && count < 200, "{greatest} {count}");
    }
}

/// The camera that a summary tells is in the file's coordinates, and makes the same picture.
#[test]
fn the_camera_of_a_far_model_is_told_where_it_is() {
    let folder = Folder::with(&[("far.obj", ball([500_000.0, 120.0, 4e6]).as_bytes())]);
    let picture = ["far.obj", "--size", "160x120", "-o"];
    let run = folder.succeeds(&[&picture[..], &["fitted.png"]].concat());
    let told = run.stdout.lines().find_map(|line| line.strip_prefix("camera: ")).expect("a camera");
    assert!(told.contains("--target 500000") || told.contains("--target 499999."), "{told}");
    let again: Vec<&str> = told.split(' ').collect();
    folder.succeeds(&[&picture[..], &["again.png"], &again].concat());
    assert_eq!(difference(&folder, ["fitted.png", "again.png"]), (0, 0), "{told}");
}

#[test]
fn scene_files_speak_in_their_own_coordinates() {
    let scene = |model: &str, [x, y, z]: [f64; 3]| {
        format!(
            "[camera]\neye = [{}, {}, {}]\ntarget = [{}, {}, {}]\n[[object]]\nmodel = \"{model}\"\n\
             [[object]]\nsurface = \"sphere\"\nradius = 0.5\nposition = [{}, {}, {}]\n\
             [[light]]\nkind = \"point\"\nposition = [{}, {}, {}]\n[[light]]\nkind = \"spot\"\n\
             position = [{}, {}, {}]\ntarget = [{x}, {y}, {z}]\nrange = 3\n",
            x + 2.0,
            y + 2.5,
            z + 4.0,
            x + 0.25,
            y,
            z,
            x + 1.0,
            y + 0.5,
            z + 1.0,
            x + 3.0,
            y + 3.0,
            z + 3.0,
            x - 1.5,
            y + 2.5,
            z + 1.0
        )
    };
    let origin = [500_000.0, 120.0, 4e6];
    let (near, far) = (ball([0.0; 3]), ball(origin));
    let (near_scene, far_scene) = (scene("near.obj", [0.0; 3]), scene("far.obj", origin));
    let folder = Folder::with(&[
        ("near.obj", near.as_bytes()),
        ("far.obj", far.as_bytes()),
        ("near.toml", near_scene.as_bytes()),
        ("far.toml", far_scene.as_bytes()),
    ]);
    for name in ["near", "far"] {
        let (scene, picture) = (format!("{name}.toml"), format!("{name}.png"));
        folder.succeeds(&[scene.as_str(), "-o", &picture, "--size", "160x120"]);
    }
    let (greatest, count) = difference(&folder, ["near.png", "far.png"]);
    assert!(greatest <= 2 && count < 200, "{greatest} {count}");
    let out = alberti(
        &folder.path(""),
        &[OsStr::new("explain")],
        &["far.toml", "--size", "160x120", "--pixel", "80,60"],
    );
    assert!(out.status == Some(0) && out.stdout.contains("counted from, in the file"), "{out:?}");
    let lit = pixels(&folder, "near.png").into_iter().filter(|&byte| byte > 100).count();
    assert!(lit > 1000, "{lit}");
}

#[test]
fn normals_are_an_option_and_a_key() {
    let ball = ball([0.0; 3]);
    let toml = "[render]\nnormals = \"flat\"\nlight = \"-35,50\"\n[[object]]\nmodel = \"m.obj\"\n";
    let folder = Folder::with(&[("m.obj", ball.as_bytes()), ("s.toml", toml.as_bytes())]);
    let size = ["--size", "96x96", "-o"];
    for (name, normals) in [
        ("default", None),
        ("smooth", Some("smooth")),
        ("crease", Some("crease:60")),
        ("flat", Some("flat")),
        ("sharp", Some("crease:1")),
    ] {
        let option = normals.map(|normals| ["--normals", normals]);
        let picture = format!("{name}.png");
        folder.succeeds(
            &[
                &["m.obj"][..],
                &size,
                &[picture.as_str()],
                option.as_ref().map_or(&[][..], |option| &option[..]),
            ]
            .concat(),
        );
    }
    folder.succeeds(&[&["s.toml"][..], &size, &["scene.png"]].concat());
    let same = |[a, b]: [&str; 2]| {
        let [a, b] = [a, b].map(|name| format!("{name}.png"));
        difference(&folder, [&a, &b]).1 == 0
    };
    assert!(same(["default", "smooth"]) && same(["default", "crease"]));
    // Corners are written to nine decimals, so that the halves of a quad turn by a trace.
    assert!(difference(&folder, ["flat.png", "sharp.png"]).0 <= 4 && same(["flat", "scene"]));
    assert!(!same(["flat", "smooth"]));
    for bad in ["crease:200", "round"] {
        folder.fails(&["m.obj", "--normals", bad], &["--normals: found ", "smooth, flat or crease:DEG"]);
    }
    folder.fails(&["--scene", "cube", "--normals", "flat"], &["--normals: found it without a model"]);
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(bytes).expect("in memory");
    encoder.finish().expect("in memory")
}

#[test]
fn compressed_models_are_models() {
    let obj = format!("mtllib m.mtl\nusemtl red\n{TRIANGLE}");
    let mtl = b"newmtl red\nKd 1 0 0\n";
    let (plain, packed) = (obj.as_bytes(), gzip(obj.as_bytes()));
    let packed_mtl = gzip(mtl);
    let folder = Folder::with(&[("m.obj", plain), ("m.obj.gz", &packed), ("m.mtl", mtl)]);
    folder.succeeds(&["m.obj", "-o", "a.png", "--size", "64x48"]);
    folder.succeeds(&["m.obj.gz", "-o", "b.png", "--size", "64x48"]);
    fs::write(folder.path("m.mtl"), packed_mtl).expect("a file");
    // The bytes count, not the name.
    fs::write(folder.path("c.obj"), &packed).expect("a file");
    folder.succeeds(&["c.obj", "-o", "c.png", "--size", "64x48"]);
    assert_eq!(difference(&folder, ["a.png", "b.png"]), (0, 0));
    assert_eq!(difference(&folder, ["a.png", "c.png"]), (0, 0));
    fs::write(folder.path("cut.gz"), &packed[..packed.len() / 2]).expect("a file");
    folder
        .fails(&["cut.gz"], &["cut.gz: found a gzip file that cannot be decompressed", "compress it again"]);
    fs::write(folder.path("bad.gz"), gzip(b"v 0 0 x\n")).expect("a file");
    folder.fails(&["bad.gz"], &["bad.gz:1: found \"x\", expected a finite number"]);
}

#[test]
fn a_model_comes_from_standard_input() {
    let obj = format!("mtllib m.mtl\nusemtl red\n{TRIANGLE}");
    let folder = Folder::with(&[("m.obj", obj.as_bytes()), ("m.mtl", b"newmtl red\nKd 1 0 0\n")]);
    folder.succeeds(&["m.obj", "-o", "a.png", "--size", "64x48"]);
    let run = |bytes: &[u8], output: &str| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_alberti"))
            .current_dir(folder.path(""))
            .args(["render", "-", "-o", output, "--size", "64x48"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command");
        // It may end before it has read everything.
        let _ = child.stdin.take().expect("its input").write_all(bytes);
        child.wait_with_output().expect("its output")
    };
    for (bytes, output) in [(obj.as_bytes().to_vec(), "b.png"), (gzip(obj.as_bytes()), "c.png")] {
        let output_of = run(&bytes, output);
        assert!(output_of.status.success() && output_of.stderr.is_empty(), "{output_of:?}");
        assert_eq!(difference(&folder, ["a.png", output]), (0, 0));
    }
    if cfg!(unix) {
        let command = format!(
            "mkfifo p.obj && (cat m.obj > p.obj & {0} p.obj -o d.png -s 64x48 -q && {0} compare - a.png -q \
             --max-error 0lsb < d.png; s=$?; wait; exit $s) && bash -c '{0} <(cat m.obj) -o e.png -s 64x48 -q && cmp \
             a.png e.png'",
            env!("CARGO_BIN_EXE_alberti")
        );
        let status = Command::new("sh").current_dir(folder.path("")).args(["-c", &command]).status();
        assert!(status.is_ok_and(|status| status.success()));
    }
    for (bytes, wanted) in [
        (&b""[..], "error: standard input: found an empty file, expected a Wavefront OBJ model"),
        (&b"v 1 2 x\n"[..], "error: standard input:1: found \"x\", expected a finite number"),
        (&b"\x1f\x8bxxxx"[..], "error: standard input: found a gzip file that cannot be decompressed"),
    ] {
        let output = run(bytes, "d.png");
        assert_eq!(output.status.code(), Some(2));
        let message = String::from_utf8(output.stderr).expect("text");
        assert!(message.starts_with(wanted) && message.lines().count() == 1, "{message}");
    }
}

#[test]
fn a_model_without_area_is_an_empty_picture() {
    let folder = Folder::with(&[("m.obj", b"v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\nf 1 1 1\n")]);
    let run = folder.succeeds(&["m.obj", "-o", "m.png", "--size", "32x32"]);
    let wanted =
        "warning: m.obj: found only faces without area, expected a surface; there is nothing to see\n";
    assert_eq!(run.stderr, wanted);
    let pixels = pixels(&folder, "m.png");
    assert!(pixels.chunks(3).all(|pixel| *pixel == pixels[..3]));
}

#[test]
fn holes_stay_open() {
    // A square ring with the bridge that modelling programs cut.
    let text = "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nv -1 -1 0\nv -1 1 0\nv 1 1 0\nv 1 -1 0\n\
                f 1 2 3 4 1 5 6 7 8 5\n";
    let folder = Folder::with(&[("m.obj", text.as_bytes())]);
    let front =
        ["--eye", "0,0,8", "--target", "0,0,0", "--size", "80x80", "--background", "ff00ff", "-o", "m.png"];
    folder.succeeds(&[&["m.obj"][..], &front].concat());
    let picture = image::open(folder.path("m.png")).expect("a picture").into_rgb8();
    let is_hole = |x, y| picture.get_pixel(x, y).0 == [255, 0, 255];
    assert!(is_hole(40, 40) && is_hole(34, 46) && is_hole(0, 0));
    assert!(
        [(25, 40), (55, 40), (40, 25), (40, 55), (25, 25), (55, 55)].iter().all(|&(x, y)| !is_hole(x, y))
    );
}

/// Exporters have statements of their own. What is none of the format's is told once.
#[test]
fn statements_that_are_none_are_told() {
    let told = |obj: &str| {
        let folder = Folder::with(&[("m.obj", obj.as_bytes())]);
        let run = folder.succeeds(&["m.obj", "-s", "16x12"]);
        (run.stdout.contains("m.obj: 1 triangle,"), run.stderr)
    };
    let quiet = format!("#no space\nvp 0 0 0\nlod 1\n\tbevel off\n{TRIANGLE}");
    assert_eq!(told(&quiet), (true, String::new()));
    assert_eq!(told(&TRIANGLE.replace("\nf", "\nfo")), (true, String::new()));
    let (_, one) = told(&format!("V 1 2 3\n{TRIANGLE}"));
    assert!(one.starts_with("warning: m.obj:1: found \"V\", expected a statement of OBJ"), "{one}");
    let (_, many) = told(&format!("{TRIANGLE}{}", "F 1 2 3\nweight 1\n".repeat(20_000)));
    let expected = "warning: m.obj:9: found \"F\", the first of 40000 such lines, expected ";
    assert!(many.starts_with(expected) && many.lines().count() == 1, "{many}");
}
