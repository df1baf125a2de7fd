//! `alberti explain` from outside.

use std::ffi::OsStr;

use crate::{Folder, Run, TRIANGLE, alberti};

const VIEW: [&str; 9] =
    ["m.obj", "--size", "32x24", "--eye", "0.3,0.3,3", "--target", "0.3,0.3,0", "--background", "010203"];

fn explain(folder: &Folder, arguments: &[&str]) -> Run {
    alberti(folder.0.path(), &[OsStr::new("explain")], arguments)
}

fn folder() -> Folder {
    Folder::with(&[("m.obj", TRIANGLE.as_bytes())])
}

#[test]
fn a_pixel_is_explained_and_no_file_is_written() {
    let folder = folder();
    let run = explain(&folder, &[&VIEW[..], &["--pixel", "16,12"]].concat());
    assert_eq!((run.status, run.stderr.as_str()), (Some(0), ""), "{run:?}");
    assert!(run.stdout.starts_with("pixel 16,12 of 32x24;"), "{run:?}");
    assert!(
        run.stdout
            .ends_with("the derived colour is that of the picture with one sample a pixel, to the bit\n"),
        "{run:?}"
    );
    let steps =
        ["1. fragments", "3. in eye space", "(theory: The view pipeline", "9. edge functions", "hyperbolic"];
    for step in steps {
        assert!(run.stdout.contains(step), "{step} is not in {}", run.stdout);
    }
    assert_eq!(folder.names(), ["m.obj"]);
    assert!(run.stdout.lines().all(|line| line.trim_end() == line));
}

#[test]
fn json_is_one_line_and_has_the_picture_that_render_writes() {
    let folder = folder();
    let policies =
        ["--interpolation", "affine", "--arithmetic", "fixed", "--color", "rgb565", "--depth", "u16"];
    folder.succeeds(&[&VIEW[..], &policies].concat());
    let picture = image::open(folder.path("alberti.png")).expect("a picture").to_rgba8();
    for (pixel, covered) in [("16,12", true), ("0,0", false)] {
        let run = explain(&folder, &[&VIEW[..], &policies, &["--json", "--pixel", pixel]].concat());
        assert_eq!((run.status, run.stdout.lines().count()), (Some(0), 1), "{run:?}");
        let json: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
        let at = |key: usize| u32::try_from(json["pixel"][key].as_u64().expect("a number")).expect("small");
        assert_eq!(json["stored"]["shown"], serde_json::json!(picture.get_pixel(at(0), at(1)).0), "{json}");
        assert_eq!((&json["covered"], &json["agrees"]), (&covered.into(), &true.into()), "{json}");
        let keys = ["policies", "fragments", "stored", if covered { "weights" } else { "nothing" }];
        assert!(keys.iter().all(|key| json[key].is_object()), "{json}");
    }
}

#[test]
fn scene_files_and_built_in_scenes_are_explained_too() {
    let scene = b"size = [20, 10]\n[[object]]\nmodel = \"m.obj\"\n[camera]\neye = [0.3, 0.3, 2]\ntarget = [0.3, 0.3, 0]\n";
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes()), ("s.toml", scene)]);
    let run = explain(&folder, &["s.toml", "--pixel", "10,5"]);
    assert!(
        run.status == Some(0) && run.stdout.contains("of 20x10") && run.stdout.contains("1st vertex"),
        "{run:?}"
    );
    let run = explain(&folder, &["--scene", "cube", "--size", "40x30", "--pixel", "20,15"]);
    assert!(run.status == Some(0) && run.stdout.contains("red"), "{run:?}");
}

/// A shadow is none of the surfaces that are explained, which is told where the file asks for it.
#[test]
fn a_ground_is_left_out() {
    let scene = b"[[object]]\nsurface = \"sphere\"\n[render]\nground = true\n";
    let folder = Folder::with(&[("s.toml", scene)]);
    let pixel = ["s.toml", "--pixel", "320,240"];
    let with = explain(&folder, &pixel);
    let told = "warning: s.toml:4: render.ground: found it with explain, which has the model alone";
    assert!(with.status == Some(0) && with.stderr.starts_with(told), "{with:?}");
    let without = explain(&folder, &[&pixel[..], &["--ground=false"]].concat());
    assert_eq!((without.status, without.stderr.as_str()), (Some(0), ""));
    // The camera leaves room for the shadow of the picture.
    assert!(without.stdout != with.stdout && with.stdout.ends_with("to the bit\n"), "{with:?}");
}

#[test]
fn wrong_pixels_are_one_error() {
    let folder = folder();
    let cases: [(&[&str], &str); 5] = [
        (
            &["--pixel", "32,0"],
            "--pixel: found the pixel 32,0, expected one of a picture of 32x24: 0,0 to 31,23",
        ),
        (&["--pixel", "0,24"], "--pixel: found the pixel 0,24"),
        (&["--pixel", "7"], "--pixel: found \"7\", expected a column and a row from 0 on, such as 320,240"),
        (&["--pixel", "-1,5"], "--pixel: found \"-1,5\""),
        (&["--pixel", "1,1", "-o", "x.png"], "--output: found an option that `explain` has not"),
    ];
    for (arguments, message) in cases {
        let run = explain(&folder, &[&VIEW[..], arguments].concat());
        assert_eq!(
            (run.status, run.stdout.as_str(), run.stderr.lines().count()),
            (Some(2), "", 1),
            "{run:?}"
        );
        assert!(run.stderr.contains(message), "{message} is not in {}", run.stderr);
    }
    let run = explain(&folder, &VIEW);
    assert!(run.status == Some(2) && run.stderr.contains("--pixel <X,Y>"), "{run:?}");
    assert_eq!(folder.names(), ["m.obj"]);
}
