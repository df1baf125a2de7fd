//! `alberti advise`: errors as `render` and `compare` have them, what is paid for nothing, and wrong input.

use std::ffi::OsStr;

use serde_json::Value;

use crate::{Folder, Run, TRIANGLE, alberti};

/// A square that is seen, and one behind it that is not, half as large; both turned away a little.
const TWO_SQUARES: &str = "v -1 -1 0\nv 1 -1 0.5\nv 1 1 0.5\nv -1 1 0\nv -0.5 -0.5 -1\nv 0.5 -0.5 -1\nv 0.5 0.5 -1\n\
                           v -0.5 0.5 -1\nvt 0 0\nvt 3 0\nvt 3 3\nvt 0 3\nf 1/1 2/2 3/3 4/4\nf 5/1 6/2 7/3 8/4\n";

/// Before them.
const CAMERA: [&str; 8] = ["--eye", "0,0,3", "--target", "0,0,0", "--near", "1", "--far", "10"];

impl Folder {
    fn advise(&self, arguments: &[&str]) -> Run {
        alberti(self.0.path(), &[OsStr::new("advise")], arguments)
    }

    /// The line of JSON of an advice.
    fn advice(&self, arguments: &[&str]) -> Value {
        let run = self.advise(&[arguments, &["--json"]].concat());
        assert_eq!((run.status, run.stdout.lines().count()), (Some(0), 1), "{run:?}");
        serde_json::from_str(&run.stdout).expect("JSON")
    }
}

/// A folder with the squares, and a texture of fine stripes.
fn squares() -> Folder {
    let folder = Folder::with(&[("squares.obj", TWO_SQUARES.as_bytes())]);
    let picture = image::RgbaImage::from_fn(64, 64, |x, y| {
        image::Rgba([if x % 4 < 2 { 230 } else { 20 }, if y % 8 < 4 { 200 } else { 60 }, 90, 255])
    });
    picture.save(folder.path("stripes.png")).expect("a texture");
    folder
}

const SCENE: [&str; 9] = [
    "squares.obj",
    "--texture",
    "stripes.png",
    "--shading",
    "unlit",
    "--filter",
    "nearest",
    "--size",
    "160x120",
];

/// Each trial's error is the one that `compare` finds between the pictures that `render` draws with its options.
#[test]
fn errors_are_those_of_the_pictures() {
    let folder = squares();
    let scene = [&SCENE[..], &CAMERA].concat();
    let advice = folder.advice(&[&scene[..], &["--max-error", "3lsb"]].concat());
    let trials = advice["trials"].as_array().expect("trials");
    let render = |options: &str, output: &str| {
        let options: Vec<&str> = options.split(' ').collect();
        folder.succeeds(&[&scene[..], &options, &["--samples", "1", "-o", output]].concat());
    };
    render("--interpolation exact --arithmetic float --depth f32-reversed --subpixel 8", "right.png");
    let mut wrong = 0;
    for trial in trials {
        let options = trial["options"].as_str().expect("options");
        if !["affine", "bounded:1 ", "spans:32", "u16", "--subpixel 4"]
            .iter()
            .any(|part| options.contains(part))
        {
            continue;
        }
        render(options, "found.png");
        let arguments = ["right.png", "found.png", "--json"];
        let run = alberti(folder.0.path(), &[OsStr::new("compare")], &arguments);
        let compared: Value = serde_json::from_str(&run.stdout).expect("JSON");
        assert_eq!(compared["percentile_99_9"].as_f64(), trial["error"].as_f64(), "{options}");
        assert_eq!(compared["largest"], trial["largest"], "{options}");
        let within = compared["percentile_99_9"].as_f64() <= Some(3.0);
        assert_eq!(trial["within"], within, "{options}");
        wrong += usize::from(!within);
    }
    assert!(wrong > 0, "policies are all alike here: {trials:?}");
}

#[test]
fn the_pick_is_within_the_budget_and_selects_itself() {
    let folder = squares();
    let scene = [&SCENE[..], &CAMERA].concat();
    for budget in ["0.1texel", "1lsb", "0.001flip", "60db"] {
        let advice = folder.advice(&[&scene[..], &["--max-error", budget]].concat());
        assert_eq!(
            (&advice["pick"]["within"], &advice["pick"]["front"]),
            (&true.into(), &true.into()),
            "{advice}"
        );
        let trials = advice["trials"].as_array().expect("trials");
        assert!(trials.iter().any(|trial| trial["options"] == advice["pick"]["options"]));
        // What is listed and keeps the budget in as little time, within a fiftieth, is not nearer to the right picture.
        let cost = |trial: &Value| trial["ms"].as_f64().expect("a time");
        let within = || trials.iter().filter(|trial| trial["within"] == true);
        let least = within().map(cost).fold(f64::INFINITY, f64::min);
        assert!(cost(&advice["pick"]) <= 1.02 * least, "{advice}");
        let error = |trial: &Value| match trial["error"].as_f64() {
            Some(error) if budget.ends_with("db") => -error,
            Some(error) => error,
            None => f64::NEG_INFINITY,
        };
        let close = within().filter(|trial| cost(trial) <= 1.02 * least);
        assert!(close.map(error).all(|other| error(&advice["pick"]) <= other), "{advice}");
        assert!(advice["rust"].as_str().expect("lines").contains("Pass::new"), "{advice}");
    }
}

/// In texels, what is exact is right, and straight lines across a square that is turned away are not.
#[test]
fn texels_are_measured() {
    let folder = squares();
    let scene = [&SCENE[..], &CAMERA].concat();
    let advice = folder.advice(&[&scene[..], &["--max-error", "0.1texel"]].concat());
    let error = |options: &str| {
        let trials = advice["trials"].as_array().expect("trials");
        let trial =
            trials.iter().find(|trial| trial["options"].as_str().expect("options").starts_with(options));
        trial.expect("a trial")["error"].as_f64().expect("a number")
    };
    assert!(error("--interpolation exact --arithmetic float --depth f32-reversed --subpixel 8") == 0.0);
    assert!(error("--interpolation plane") < 0.01);
    assert!(error("--interpolation bounded:0.0625 --arithmetic float") <= 0.0626);
    // The square behind is drawn last. The line of sight to its right edge meets the one before it at x = 1/3, which is
    // 2 in texture coordinates and not 3: 64 texels.
    let hidden = error("--interpolation exact --arithmetic float --depth none");
    assert!((60.0..=64.5).contains(&hidden), "{hidden}");
    // The square spans 192 texels, and q differs by a fifth along it: |Δu| tanh(ln r / 4) is 9.
    assert!((4.0..20.0).contains(&error("--interpolation affine --arithmetic float")));
}

/// The errors of a chip's picture are the host's, and the pick has the fewest instructions of all that keep the budget.
#[test]
fn chips_are_advised_by_a_model() {
    let folder = squares();
    let scene = [&SCENE[..], &CAMERA, &["--max-error", "1texel"]].concat();
    let host = folder.advice(&scene);
    for chip in ["m4f", "m0", "rv32"] {
        let advice = folder.advice(&[&scene[..], &["--target", chip]].concat());
        assert_eq!(advice["target"], chip);
        let least = |trials: &[Value]| {
            let within = trials.iter().filter(|trial| trial["within"] == true);
            let costs = within.map(|trial| trial["instructions"].as_f64().expect("a number"));
            costs.fold(f64::INFINITY, f64::min)
        };
        let trials = advice["trials"].as_array().expect("trials");
        assert!(advice["pick"]["instructions"].as_f64() <= Some(1.02 * least(trials)), "{advice}");
        assert!(
            advice["pick"]["ms"].is_null() && advice["rust"].as_str().expect("lines").contains("Rgb565Le")
        );
        let mut alike = 0;
        for own in host["trials"].as_array().expect("trials") {
            if let Some(trial) = trials.iter().find(|trial| trial["options"] == own["options"]) {
                assert_eq!(trial["error"], own["error"], "{own}");
                alike += 1;
            }
        }
        assert!(alike > 20, "{alike}");
        // All ways to draw keep one that is as cheap, or none that is cheaper.
        let thorough = folder.advice(&[&scene[..], &["--machine", chip, "--thorough"]].concat());
        let all = thorough["trials"].as_array().expect("trials");
        assert_eq!(all.len(), 18 * 6 * 2);
        assert!(least(trials) <= 1.1 * least(all), "{} {}", least(trials), least(all));
        // Two bytes a pixel more, but for the stack.
        let ram = |depth: &str| {
            let options = format!("--interpolation exact --arithmetic float --depth {depth} --subpixel 8");
            all.iter().find(|trial| trial["options"] == options).expect("a trial")["ram"].as_f64()
        };
        let more = ram("u24").expect("bytes") - ram("u16").expect("bytes");
        assert!((more - 2.0 * 160.0 * 120.0).abs() < 1024.0, "{more}");
    }
}

/// A chip's picture has 16 bits a pixel: the error is that of such pictures.
#[test]
fn a_chips_colours_have_16_bits() {
    let folder = squares();
    let scene = [&SCENE[..], &CAMERA].concat();
    let advice = folder.advice(&[&scene[..], &["--target", "m4f", "--max-error", "8lsb"]].concat());
    let render = |options: &str, output: &str| {
        let options: Vec<&str> = options.split(' ').collect();
        folder.succeeds(
            &[&scene[..], &options, &["--color", "rgb565", "--samples", "1", "-o", output]].concat(),
        );
    };
    render("--interpolation exact --arithmetic float --depth f32-reversed --subpixel 8", "right.png");
    for trial in advice["trials"].as_array().expect("trials").iter().step_by(4) {
        render(trial["options"].as_str().expect("options"), "found.png");
        let run = alberti(folder.0.path(), &[OsStr::new("compare")], &["right.png", "found.png", "--json"]);
        let compared: Value = serde_json::from_str(&run.stdout).expect("JSON");
        assert_eq!(compared["percentile_99_9"].as_f64(), trial["error"].as_f64(), "{trial}");
    }
}

/// What a combination takes is not what its parts promise, where these decide together which triangles are small: the
/// search finds it nevertheless.
#[test]
fn a_combination_may_be_cheaper_than_its_parts() {
    let folder = squares();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/reflection-sphere.toml");
    let scene = [scene, "--size", "160x120", "--max-error", "0.5texel", "--machine", "m4f"];
    let cost = |more: &[&str]| {
        let advice = folder.advice(&[&scene[..], more].concat());
        advice["pick"]["instructions"].as_f64().expect("a number")
    };
    let [found, best] = [cost(&[]), cost(&["--thorough"])];
    assert!(found <= 1.1 * best, "{found} {best}");
}

#[test]
fn what_is_paid_for_nothing_is_told() {
    let folder = squares();
    let scene = [&SCENE[..], &CAMERA].concat();
    let wastes = |more: &[&str]| folder.advice(&[&scene[..], more].concat())["waste"].to_string();
    let from_before = wastes(&[]);
    assert!(
        from_before
            .contains("triangles: 2 of 4 (50 %) show in no pixel from this camera; to leave them out saves"),
        "{from_before}"
    );
    assert!(from_before.contains("gives the same picture"), "{from_before}");
    // `u16` in the place of four bytes a pixel.
    assert!(from_before.contains("`u16` gives the same picture as f32-reversed; it saves"), "{from_before}");
    assert!(from_before.contains("38 KB of memory"), "{from_before}");
    let on_chip = wastes(&["--target", "m0"]);
    assert!(on_chip.contains("M instructions a frame") && on_chip.contains("37 KB of RAM"), "{on_chip}");
    let around = wastes(&["--turntable", "4"]);
    assert!(!around.contains("triangles: "), "all are seen: {around}");
}

/// Attributes without a use, a texture of one colour, and levels of detail where all are the same.
#[test]
fn attributes_colours_and_levels_are_told() {
    let folder = squares();
    let white = image::RgbaImage::from_pixel(64, 64, image::Rgba([200, 100, 50, 255]));
    white.save(folder.path("white.png")).expect("a texture");
    let wastes = |arguments: &[&str]| {
        let all = [&["squares.obj"], &CAMERA[..], arguments].concat();
        folder.advice(&all)["waste"].to_string()
    };
    let has =
        |text: &str, part: &str, expected: bool| assert_eq!(text.contains(part), expected, "{part}: {text}");
    // Eight vertices; normals are those of the faces, which differ.
    let plain = wastes(&["--shading", "unlit", "--size", "160x120"]);
    has(
        &plain,
        "normals: they change no pixel; to leave them out of the vertices, as floats, saves 96 bytes of",
        true,
    );
    has(
        &plain,
        "texture coordinates: they change no pixel; to leave them out of the vertices, as floats, saves 64",
        true,
    );
    has(&plain, "vertex colours", false);
    has(&plain, "levels of detail", false);
    let striped = wastes(&["--texture", "stripes.png", "--filter", "trilinear", "--size", "480x360"]);
    for name in ["colour maps", "texture coordinates", "normals"] {
        has(&striped, name, false);
    }
    // A pixel is well below a texel, so that only the largest level is read.
    has(&striped, "levels of detail: one a triangle looks the same (mean FLIP 0.0000)", true);
    let constant = wastes(&["--texture", "white.png", "--size", "160x120"]);
    has(&constant, "colour maps: they change no pixel; to take each one's mean colour instead saves", true);
    // 64 x 64 texels of four bytes on the host, and of two in flash.
    has(&constant, "16 KB of memory", true);
    // Of a small thing the pattern is seen, however little of the picture it is; of one that is a few pixels it is not.
    let halves =
        image::RgbaImage::from_fn(64, 64, |x, _| image::Rgba([if x < 32 { 250 } else { 5 }, 90, 90, 255]));
    halves.save(folder.path("halves.png")).expect("a texture");
    let small = wastes(&["--texture", "halves.png", "--zoom", "0.06", "--size", "640x480"]);
    has(&small, "colour maps: nobody sees them", false);
    let tiny = wastes(&["--texture", "halves.png", "--zoom", "0.01", "--size", "640x480"]);
    has(&tiny, "colour maps: nobody sees them", true);
    let on_chip = wastes(&["--texture", "white.png", "--size", "160x120", "--target", "m4f"]);
    has(&on_chip, "instead saves 8192 bytes of flash", true);
}

#[test]
fn pictures_are_written_on_request() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    let run = folder.advise(&["m.obj", "--size", "40x30", "--max-error", "0.01flip", "--image", "out"]);
    assert_eq!(run.status, Some(0), "{run:?}");
    for part in
        ["Cheapest within 0.01flip", "The pick takes", "--interpolation ", "Target::new", "Paid for nothing"]
    {
        assert!(run.stdout.contains(part), "{part:?} is not in {}", run.stdout);
    }
    for name in ["pick.png", "right.png", "difference.png"] {
        assert_eq!(image::open(folder.path("out").join(name)).expect("a picture").width(), 40);
    }
}

#[test]
fn wrong_input_is_one_line() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes()), ("file", b"")]);
    for (arguments, part) in [
        (&["m.obj", "--max-error", "2furlong"][..], "one of the units lsb, flip, db and texel"),
        (&["m.obj", "--turntable", "0"], "--turntable: found \"0\", expected an integer from 1 to 360"),
        (&["m.obj", "--max-error", "1texel"], "a scene without textures, expected one with texels"),
        (
            &["m.obj", "--target", "m0", "--filter", "anisotropic:2"],
            "expected nearest, bilinear or trilinear",
        ),
        (&["m.obj", "--thorogh"], "--thorogh: found no such option, expected one, such as --thorough"),
        (&["m.obj", "--scene", "hero"], "--scene"),
        (&["m.obj", "--target", "m7"], "--target: found \"m7\", expected one of host, m4f, m0, rv32"),
        (&["no.obj"], "no.obj"),
        (&["m.obj", "--image", "file/out"], "file/out"),
        (&["m.obj", "--max-error", "1texel", "--image", "made"], "a scene without textures"),
        (&["m.obj", "--interpolation", "affine"], "--interpolation: found an option that `advise` has not"),
        (&["m.obj", "--show", "error"], "--show: found an option that `advise` has not"),
    ] {
        let run = folder.advise(arguments);
        assert_eq!((run.status, run.stdout.as_str()), (Some(2), ""), "{run:?}");
        let lines = run.stderr.lines().filter(|line| !line.starts_with("warning: --filter: "));
        assert!(run.stderr.contains(part) && lines.count() == 1, "{run:?}");
    }
    assert_eq!(folder.names(), ["file", "m.obj"]);
}
