//! Wrong input: one line that says what is wrong where, and nothing written.

use std::ffi::OsStr;
use std::fmt::Write as _;
use std::fs;

use super::{baked, folder, number};
use crate::{Folder, TRIANGLE, alberti};
use alberti::Geometry as _;
use alberti::baked::{Baked, Tangent};

#[test]
fn mistakes_are_told_in_one_line() {
    let folder = folder();
    fs::write(folder.path("file"), "").expect("a file");
    let far = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e6 0 0\nv 1000001 0 0\nv 1000000 1 0\nf 1 2 3\nf 4 5 6\n";
    fs::write(folder.path("far.obj"), far).expect("a file");
    fs::write(folder.path("flat.obj"), "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").expect("a file");
    let wrapped = TRIANGLE.replace("vt 1 0", "vt 5000 0");
    fs::write(folder.path("wrapped.obj"), wrapped).expect("a file");
    let mut large = String::new();
    for k in 0..30_000 {
        large += &format!("v {k} 0 0\nv {k} 1 0\nv {k} 0 1\nf -3 -2 -1\n");
    }
    fs::write(folder.path("large.obj"), large).expect("a file");
    for (arguments, parts) in [
        (
            &["m.obj", "--out", "out", "--format", "rgb566"][..],
            &["--format: found \"rgb566\", expected one of rgb565,"][..],
        ),
        (&["m.obj"], &["found too few words, expected --out <FOLDER> as well"]),
        (
            &["m.obj", "--out", "file"],
            &["file/m.bin: found a file in the place of its folder", "another with --out"],
        ),
        (&["m.obj", "--out", "file/in"], &["found a file in the place of its folder"]),
        (&["no.obj", "--out", "out"], &["no.obj: found no such file"]),
        (&["m.obj", "--texture", "no.png", "--out", "out"], &["no.png: found no such file"]),
        (
            &["large.obj", "--out", "out"],
            &["large.obj: found 90000 vertices of a part", ", expected at most 65536; ", "--triangles"],
        ),
        (
            &["m.obj", "--out", "out", "--triangles", "0"],
            &["--triangles: found \"0\", expected a whole number from 1 to"],
        ),
        (
            &["m.obj", "--out", "out", "--attributes", "uvw"],
            &["--attributes: found \"uvw\", expected auto, none, or some of"],
        ),
        (
            &["m.obj", "--out", "out", "--triangles", "9999999999"],
            &["--triangles: found \"9999999999\", expected a whole number from 1 to 4294967295"],
        ),
        (
            &["m.obj", "--out", "out", "--attributes", "uv,none"],
            &["--attributes: found \"uv,none\", expected auto, none, or some of"],
        ),
        (
            &["m.obj", "--out", "out", "--meshlets", "-1"],
            &["--meshlets: found \"-1\", expected a whole number"],
        ),
        (&["m.obj", "--out", "out", "--band", "-1"], &["--band: found \"-1\", expected a whole number"]),
        (&["m.obj", "--out", "out", "--scene", "cube"], &["error: a model: found it beside --scene"]),
        // Triangles of one unit at a distance of which that is a millionth, and one on a line.
        (
            &["far.obj", "--out", "out"],
            &[
                "far.obj: found no triangle with an area in steps of 30.5",
                "; leave out what lies far from it",
            ],
        ),
        (&["flat.obj", "--out", "out"], &["flat.obj: found no triangle with an area"]),
        (
            &["wrapped.obj", "--texture", "soft.png", "--out", "out"],
            &["wrapped.obj: found texture coordinates from 0 to 5000", "--attributes"],
        ),
        // Folders on the way are not left behind either.
        (&["no.obj", "--out", "a/b/c"], &["no.obj: found no such file"]),
        (&["flat.obj", "--out", "a/b/c"], &["flat.obj: found"]),
        (
            &["m.obj", "--out", "out", "--color", "rgb999"],
            &["--color: found \"rgb999\", expected one of rgba8, rgb565, rgb444, rgb666, rgb888, xrgb8888,"],
        ),
        (&["m.obj", "--out", "out", "--show", "lod"], &["--show: found an option that `bake` has not"]),
    ] {
        let before = folder.names();
        let run = alberti(folder.0.path(), &[OsStr::new("bake")], arguments);
        assert_eq!((run.status, &run.stdout[..]), (Some(2), ""), "{run:?}");
        let errors = run.stderr.lines().filter(|line| !line.starts_with("warning: "));
        assert_eq!(errors.count(), 1, "{run:?}");
        for part in parts {
            assert!(run.stderr.contains(part), "{part:?} is not in {}", run.stderr);
        }
        assert_eq!(folder.names(), before, "{arguments:?}");
    }
    // What was there stays where the new cannot be made.
    fs::create_dir(folder.path("kept")).expect("a folder");
    fs::write(folder.path("kept/large.bin"), "old").expect("a file");
    alberti(folder.0.path(), &[OsStr::new("bake")], &["large.obj", "--out", "kept"]);
    assert_eq!(fs::read(folder.path("kept/large.bin")).expect("the file"), b"old");
    assert_eq!(fs::read_dir(folder.path("kept")).expect("the folder").count(), 1);
}

/// A file counts its parts in two bytes.
#[test]
fn more_parts_than_a_file_counts_are_told() {
    let mut many = String::new();
    for k in 0..=u16::MAX {
        let (x, y) = (k % 256, k / 256);
        writeln!(many, "o {k}\nv {x} {y} 0\nv {x}.5 {y} 0\nv {x} {y}.5 0\nf -3 -2 -1").expect("text");
    }
    let one = many.find("o 65535").expect("the last");
    let folder = Folder::with(&[("many.obj", many.as_bytes()), ("most.obj", &many.as_bytes()[..one])]);
    let bake =
        |name| alberti(folder.0.path(), &[OsStr::new("bake")], &[name, "--out", "out", "--size", "8x8"]);
    let run = bake("many.obj");
    assert_eq!((run.status, &run.stdout[..]), (Some(2), ""), "{run:?}");
    let expected =
        "error: many.obj: found 65536 parts, expected at most 65535 in a file; join those of one material\n";
    assert_eq!(run.stderr, expected);
    assert!(!folder.path("out").exists());
    let run = bake("most.obj");
    assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{run:?}");
    let file = fs::read(folder.path("out/most.bin")).expect("the file");
    assert_eq!(Baked::read(&file).expect("a file").parts().count(), 65535);
}

/// A part that is smaller than a step of the grid is not in the file, and that is said once.
#[test]
fn parts_that_vanish_are_told() {
    let speck = |name: &str| format!("o {name}\nv 1 1 1\nv 1.0001 1 1\nv 1 1.0001 1\nf -3 -2 -1\n");
    let model = format!("o wall\nv 0 0 0\nv 100 0 0\nv 0 100 0\nf 1 2 3\n{}{}", speck("a"), speck("b"));
    let folder = Folder::with(&[("m.obj", model.as_bytes())]);
    let run = alberti(folder.0.path(), &[OsStr::new("bake")], &["m.obj", "--out", "out"]);
    assert_eq!((run.status, run.stderr.lines().count()), (Some(0), 1), "{run:?}");
    let start = "warning: m.obj: found 2 parts without an area in steps of 0.0030518";
    assert!(run.stderr.starts_with(start) && run.stderr.contains("from part 1 (\"a\") on, "), "{run:?}");
    assert!(run.stdout.contains("1 of 3 triangles"), "{run:?}");
}

/// Attributes that the model has not: coordinates are told, and tangents are made.
#[test]
fn attributes_that_are_asked_of_a_model_without() {
    let folder = Folder::with(&[
        ("m.obj", TRIANGLE.as_bytes()),
        ("bare.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ]);
    let run =
        alberti(folder.0.path(), &[OsStr::new("bake")], &["bare.obj", "--out", "out", "--attributes", "uv"]);
    let expected = "warning: --attributes: found uv of a model without texture coordinates, expected one that has some; \
                    all are 0\n";
    assert_eq!((run.status, &run.stderr[..]), (Some(0), expected));
    // The texture runs along x.
    let (report, file) = baked(&folder, "m", &["m.obj", "--attributes", "uv,tangent"]);
    let file = Baked::read(&file).expect("a file");
    let mesh = file.parts().next().expect("a part").mesh::<Tangent>().expect("tangents");
    for k in 0..3 {
        let (_, tangent) = mesh.vertex(k).expect("a vertex");
        assert!(
            (tangent.truncate() - alberti::glam::Vec3::X).length() < 1e-4 && tangent.w == 1.0,
            "{tangent}"
        );
    }
    assert!(number(&report, "tangent_degrees") < 0.65, "{report}");
}

/// A frame of fewer rows is one band.
#[test]
fn bands_are_no_higher_than_the_frame() {
    let folder = folder();
    let of = |band| baked(&folder, "m", &["m.obj", "--size", "32x20", "--band", band]).0;
    let (all, more) = (of("20"), of("100"));
    assert_eq!((&all["ram"], &all["band"]), (&more["ram"], &more["band"]));
    assert!(of("10")["ram"].as_u64() < all["ram"].as_u64());
}
