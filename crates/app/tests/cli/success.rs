//! What works: pictures in every format and size, reports, and models with broken materials.

use std::ffi::OsStr;
use std::fs;

use crate::{Folder, TRIANGLE, alberti};

#[test]
fn without_arguments_there_is_a_picture() {
    let folder = Folder::with(&[]);
    let run = folder.succeeds::<&str>(&[]);
    assert_eq!(folder.names(), ["alberti.png"]);
    let size = image::image_dimensions(folder.path("alberti.png")).expect("a picture");
    assert_eq!(size, (640, 480));
    assert_eq!(run.stderr, "");
    assert_eq!(run.stdout.lines().count(), 2);
    for part in ["hero", "640x480", " triangles", " ms", "alberti.png"] {
        assert!(run.stdout.contains(part), "{part} is not in {}", run.stdout);
    }
}

#[test]
fn every_scene_draws() {
    let folder = Folder::with(&[]);
    for name in alberti_app::scenes::NAMES {
        folder.succeeds(&["--scene", name, "--size", "32x24", "--eye", "3,2,9"]);
    }
}

#[test]
fn any_number_of_threads_makes_the_same_picture() {
    let folder = Folder::with(&[]);
    let made = ["1", "2", "7", "256"].map(|threads| {
        folder.succeeds(&["--scene", "mesh", "--size", "96x64", "--threads", threads]);
        fs::read(folder.path("alberti.png")).expect("a picture")
    });
    assert!(made.iter().all(|other| *other == made[0]));
}

#[test]
fn the_extension_says_the_format() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for (name, start) in [
        ("a.png", &b"\x89PNG"[..]),
        ("a.PNG", b"\x89PNG"),
        ("a.jpg", b"\xff\xd8\xff"),
        ("a.jpeg", b"\xff\xd8\xff"),
        ("a.bmp", b"BM"),
        ("a.tga", b"\0\0"),
    ] {
        folder.succeeds(&["m.obj", "-o", name, "--size", "17x5"]);
        assert!(fs::read(folder.path(name)).expect("the picture").starts_with(start), "{name}");
        assert_eq!(image::image_dimensions(folder.path(name)).expect("a picture"), (17, 5));
    }
}

#[test]
fn every_choice_is_accepted() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for (option, values) in [
        ("--filter", &["nearest", "bilinear", "trilinear", "anisotropic:8"][..]),
        ("--wrap", &["repeat", "clamp", "mirror"]),
        ("--shading", &["unlit", "vertex-color", "lambert", "gouraud", "phong", "blinn"]),
        ("--specular", &["ff8000"]),
        ("--shininess", &["0", "8,64"]),
        ("--cull", &["back", "front", "none"]),
        ("--depth", &["f32", "f32-reversed", "u32", "u24", "u16", "none"]),
        ("--background", &["ff0000", "#00FF00"]),
        ("--eye", &["-1,2,3"]),
        ("--target", &["-1,-2,-3"]),
        ("--up", &["-1,0,0", "0,0,1", "z", "-Y"]),
        ("--fov", &["0.5", "90", "179"]),
        ("--near", &["0.01"]),
        ("--far", &["100"]),
        ("--size", &["1x1", "16384x1", "1x16384"]),
    ] {
        for value in values {
            folder.succeeds(&["m.obj", option, value]);
        }
    }
    folder.succeeds(&["--scene", "hero", "--size", "8x8", "--filter", "nearest", "--near", "0.5"]);
}

#[test]
fn background_and_size_reach_the_picture() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    folder.succeeds(&["m.obj", "--size", "40x30", "--background", "0a141e"]);
    let picture = image::open(folder.path("alberti.png")).expect("a picture").to_rgb8();
    assert_eq!(picture.dimensions(), (40, 30));
    // A corner, which a model in view leaves free.
    assert_eq!(picture.get_pixel(0, 0).0, [10, 20, 30]);
}

#[test]
fn statistics_come_as_text_or_json() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    let run = folder.succeeds(&["m.obj", "--size", "64x48", "--stats", "json"]);
    let json: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON alone");
    assert_eq!(run.stdout.lines().count(), 1);
    assert_eq!((&json["model"], &json["output"]), (&"m.obj".into(), &"alberti.png".into()));
    assert_eq!((&json["width"], &json["height"]), (&64.into(), &48.into()));
    assert_eq!(json["triangles_in"], 1);
    for count in ["clipped", "culled", "drawn", "fragments"] {
        assert!(json[count].is_u64(), "{json}");
    }
    for time in ["load", "draw", "encode"] {
        assert!(json["ms"][time].is_f64(), "{json}");
    }
    let run = folder.succeeds(&["m.obj", "--stats"]);
    assert!(run.stdout.contains("\nfragments"), "{run:?}");
}

#[test]
fn broken_materials_are_warnings() {
    let obj = format!("mtllib m.mtl\nusemtl red\n{TRIANGLE}usemtl blue\nf 1 2 3\n");
    for (mtl, place) in [
        (&b"newmtl red\nmap_Kd\n"[..], "warning: m.mtl:2: found `map_Kd` without a file"),
        (b"newmtl red\nmap_Kd no.png\n", "warning: m.mtl:2: found no such file for the texture \"no.png\""),
        (
            b"newmtl red\nmap_Kd m.obj\n",
            "warning: m.mtl:2: found a file of another format for the texture \"m.obj\"",
        ),
        (b"newmtl red\nmap_Kd .\n", "warning: m.mtl:2: found a directory for the texture \".\""),
        (b"newmtl red\n", "warning: m.obj:11: found `usemtl` \"blue\""),
        (b"\0\x01\x02", "warning: m.mtl: found a binary file"),
        (b"", "warning: m.mtl: found an empty file"),
    ] {
        let folder = Folder::with(&[("m.obj", obj.as_bytes()), ("m.mtl", mtl)]);
        let run = folder.succeeds(&["m.obj", "--size", "16x16"]);
        assert!(run.stderr.lines().any(|line| line.starts_with(place)), "{place} is not in {}", run.stderr);
        assert!(run.stderr.lines().all(|line| line.starts_with("warning: ")), "{run:?}");
        assert_eq!(folder.names(), ["alberti.png", "m.mtl", "m.obj"]);
    }
    let folder = Folder::with(&[("m.obj", obj.as_bytes())]);
    let run = folder.succeeds(&["m.obj"]);
    assert!(run.stderr.starts_with("warning: m.obj:1: found no file \"m.mtl\", expected an MTL"), "{run:?}");
    assert!(run.stderr.ends_with("; its materials are the default one\n"), "{run:?}");
    assert_eq!(run.stderr.lines().count(), 1);
}

#[test]
fn files_are_found_from_another_folder() {
    let folder = Folder::with(&[]);
    fs::create_dir_all(folder.path("in/maps")).expect("folders");
    fs::create_dir(folder.path("out")).expect("a folder");
    fs::write(folder.path("in/m.obj"), format!("mtllib maps\\m.mtl\nusemtl a\n{TRIANGLE}")).expect("a file");
    fs::write(folder.path("in/maps/m.mtl"), "newmtl a\nmap_Kd t.png\n").expect("a file");
    image::RgbImage::new(2, 2).save(folder.path("in/maps/t.png")).expect("a file");
    let run = folder.succeeds(&["in/m.obj", "-o", "out/p.png", "--texture", "in/maps/t.png"]);
    assert_eq!(run.stderr, "");
    assert!(folder.path("out/p.png").exists());
}

#[test]
fn odd_views_are_warnings() {
    let folder = Folder::with(&[("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")]);
    let run = folder.succeeds(&["m.obj", "--eye", "0,0,9", "--target", "0,0,99"]);
    assert!(run.stderr.starts_with("warning: --eye: found a camera that looks away"), "{run:?}");
    image::RgbImage::new(2, 2).save(folder.path("t.png")).expect("a file");
    let run = folder.succeeds(&["m.obj", "--texture", "t.png"]);
    assert!(run.stderr.starts_with("warning: --texture: found a model without texture coord"), "{run:?}");
}

#[test]
fn maps_that_cannot_be_seen_are_warnings() {
    let bare = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let mtl = |maps: &str| format!("newmtl a\n{maps}");
    let obj = |text: &str| format!("mtllib m.mtl\nusemtl a\n{text}");
    let both = "map_Bump h.png\nnorm h.png\n";
    let scene = "[[object]]\nsurface = \"plane\"\nmaterial = \"a\"\n[material.a]\n\
                 normal-map = \"h.png\"\nheight-map = \"h.png\"\n";
    let two = format!("{scene}[[object]]\nsurface = \"sphere\"\nmaterial = \"a\"\n");
    let no_uv = "m.obj: found a model without texture coordinates (`vt` lines), expected some";
    let some_uv = "m.obj: found faces of \"a\" without texture coordinates, expected some for its texture";
    let partly = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\nf 3 2 1\n";
    let unused = "found a normal map and heights for bumps on the surface";
    for (name, obj, mtl, text, wanted) in [
        ("m.obj", obj(bare), mtl("map_Kd h.png\n"), "", Some(no_uv)),
        ("m.obj", obj(bare), mtl("map_Ns h.png\n"), "", Some(no_uv)),
        ("m.obj", obj(bare), mtl("Kd 1 0 0\nrefl h.png\n"), "", None),
        ("m.obj", obj(partly), mtl("map_Kd h.png\n"), "", Some(some_uv)),
        ("m.obj", obj(partly), mtl("Kd 1 0 0\n"), "", None),
        ("m.obj", obj(TRIANGLE), mtl("map_Kd h.png\n"), "", None),
        ("m.obj", obj(TRIANGLE), mtl(both), "", Some(unused)),
        ("s.toml", String::new(), String::new(), two.as_str(), Some(unused)),
        ("s.toml", String::new(), String::new(), &format!("{scene}relief = \"parallax\"\n"), None),
    ] {
        let files = [("m.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes()), ("s.toml", text.as_bytes())];
        let folder = Folder::with(&files);
        image::RgbImage::from_pixel(2, 2, image::Rgb([90; 3])).save(folder.path("h.png")).expect("a file");
        let run = folder.succeeds(&[name, "--size", "16x16"]);
        assert_eq!(run.stderr.lines().count(), usize::from(wanted.is_some()), "{name} {mtl:?} {run:?}");
        assert!(run.stderr.contains(wanted.unwrap_or_default()), "{run:?}");
    }
}

#[test]
fn help_and_version_are_printed() {
    let folder = Folder::with(&[]);
    let run = |arguments: &[&str]| alberti(&folder.path("."), &[] as &[&OsStr], arguments);
    for (arguments, part) in [
        (&[][..], "Usage: alberti"),
        (&["--help"], "Usage: alberti"),
        (&["--version"], env!("CARGO_PKG_VERSION")),
        (&["render", "--help"], "--view <SIDE>"),
        (&["render", "-h"], "Examples:"),
    ] {
        let run = run(arguments);
        assert!(run.status == Some(0) && run.stdout.contains(part) && run.stderr.is_empty(), "{run:?}");
    }
    assert!(folder.names().is_empty());
}

#[cfg(unix)]
#[test]
fn pictures_are_files_like_any_other() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = Folder::with(&[("plain", b"")]);
    folder.succeeds(&["--size", "8x8"]);
    let mode = |name: &str| fs::metadata(folder.path(name)).expect("a file").permissions().mode();
    fs::write(folder.path("new"), "").expect("a file");
    assert_eq!(mode("alberti.png"), mode("new"));
}
