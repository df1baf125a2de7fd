//! What a picture is made of beside the model: samples, the background, the camera, and the file.

use std::ffi::OsStr;
use std::fs;

use crate::{Folder, TRIANGLE, alberti};

fn folder() -> Folder {
    Folder::with(&[("m.obj", TRIANGLE.as_bytes())])
}

fn picture(folder: &Folder, name: &str) -> image::RgbaImage {
    image::open(folder.path(name)).expect("a picture").to_rgba8()
}

#[test]
fn edges_are_smooth_unless_a_display_is_shown() {
    let folder = folder();
    let colors = |options: &str| {
        let words = ["m.obj", "--size", "64x48", "--shading", "unlit", "--roll", "17", "-o", "a.png"];
        folder.succeeds(&words.into_iter().chain(options.split_whitespace()).collect::<Vec<_>>());
        let mut colors: Vec<_> = picture(&folder, "a.png").pixels().map(|pixel| pixel.0).collect();
        colors.sort_unstable();
        colors.dedup();
        colors.len()
    };
    assert_eq!(colors("--samples 1"), 2);
    assert_eq!(colors("--profile mcu"), 2);
    let (four, sixteen) = (colors(""), colors("--samples 16"));
    assert_eq!(colors("--color rgb888"), four);
    assert!((3..=5).contains(&four) && (8..=17).contains(&sixteen), "{four} {sixteen}");
    folder.fails(&["m.obj", "--samples", "2"], &["--samples: found \"2\", expected one of 1, 4, 16"]);
    let large = ["m.obj", "--samples", "16", "--size", "4097x1"];
    folder.fails(&large, &["--samples: found 16 a pixel of 4097x1, expected pictures of at most 4096x4096"]);
}

#[test]
fn scene_files_have_samples_backgrounds_and_views() {
    let scene = |render: &str| {
        format!("size = [32, 24]\noutput = \"s.png\"\n{render}\n[[object]]\nsurface = \"torus\"\n")
    };
    let folder = Folder::with(&[
        (
            "a.toml",
            scene("background = \"red..blue\"\n[render]\nsamples = 16\n[camera]\nview = \"top\"").as_bytes(),
        ),
        ("b.toml", scene("[render]\nsamples = 3").as_bytes()),
        ("c.toml", scene("background = \"no.png\"").as_bytes()),
        ("d.toml", scene("[camera]\nview = \"top\"\neye = [1, 2, 3]").as_bytes()),
    ]);
    let run = folder.succeeds(&["a.toml"]);
    assert!(run.stdout.contains("--eye 0,3.9213307,0 "), "{run:?}");
    // The other angle is the view's.
    for (more, roll) in [("--azimuth=0", false), ("--azimuth=90", true)] {
        let run = folder.succeeds(&["a.toml", more]);
        assert!(
            run.stdout.contains("--eye 0,3.9213307,0 ") && run.stdout.contains("--roll") == roll,
            "{run:?}"
        );
    }
    let [view, angles] = [&["--elevation", "0"][..], &["--elevation", "0", "--azimuth", "0"]]
        .map(|more| folder.succeeds(&[&["a.toml"], more].concat()).stdout);
    assert!(view.lines().nth(1) == angles.lines().nth(1) && !view.contains("--eye 0,3.9213307,0 "), "{view}");
    let seen = picture(&folder, "s.png");
    let [top, bottom] = [0, 23].map(|y| seen.get_pixel(0, y).0);
    assert!(top[0] > 240 && top[2] < 16 && bottom[0] < 16 && bottom[2] > 240, "{top:?} {bottom:?}");
    folder.fails(&["b.toml"], &["b.toml:4: render.samples: found 3, expected 1, 4 or 16"]);
    folder.fails(&["c.toml"], &["c.toml:3: background: found no such file"]);
    folder.fails(&["d.toml"], &["found it with"]);
}

/// A scene with an eye of its own is turned at the eye's distance, and its planes go along.
#[test]
fn scenes_are_turned_around_their_target() {
    let scene = "size = [32, 24]\n[camera]\neye = [0, 0, 3]\ntarget = [0, 0, 0]\nnear = 2.9\nfar = 3.1\n\
        [[object]]\nsurface = \"torus\"\n[[object]]\nsurface = \"plane\"\nposition = [0, 0, -40]\n";
    let folder = Folder::with(&[("a.toml", scene.as_bytes())]);
    let camera = |arguments: &[&str]| {
        let run = folder.succeeds(&[&["a.toml", "--stats", "json"], arguments].concat());
        let told: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
        let words: Vec<String> =
            told["camera"]["options"].as_str().expect("options").split(' ').map(str::to_owned).collect();
        move |option: &str| -> Vec<f64> {
            let at = words.iter().position(|word| word == option).expect("the option");
            words[at + 1].split(',').map(|number| number.parse().expect("a number")).collect()
        }
    };
    let own = camera(&[]);
    assert_eq!((own("--eye"), own("--near"), own("--far")), (vec![0.0, 0.0, 3.0], vec![2.9], vec![3.1]));
    // The torus is 0.35 thick and 1.35 wide from its middle.
    for (turn, nearest) in [
        (&["--azimuth", "90", "--elevation", "0"][..], 1.65),
        (&["--view", "top"], 2.65),
        (&["--eye", "0,3,0.1"], 2.62),
    ] {
        let turned = camera(turn);
        let distance = turned("--eye").iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((distance - 3.0).abs() < 0.01, "{turn:?} {distance}");
        let near = turned("--near")[0];
        assert!(
            (0.95 * nearest..nearest + 0.02).contains(&near) && turned("--far")[0] > 4.35,
            "{turn:?} {near}"
        );
    }
    // As large, and as upright, as the file says once.
    fs::write(folder.path("a.toml"), scene.replace("near", "zoom = 2\nroll = 30\nnear")).expect("a file");
    let leaning = camera(&["--view", "front"]);
    let half = (leaning("--fov")[0] / 2.0).to_radians().tan();
    assert!((half - 20_f64.to_radians().tan() / 2.0).abs() < 1e-4);
    assert_eq!((leaning("--up"), leaning("--roll")), (vec![0.0, 1.0, 0.0], vec![30.0]));
    fs::write(folder.path("a.toml"), scene.replace("[0, 0, 3]", "[0, 3, 0]")).expect("a file");
    assert_eq!(camera(&["--view", "front"])("--eye"), [0.0, 0.0, 3.0]);
    let fixed = camera(&["--azimuth", "90", "--far", "77"]);
    assert_eq!(fixed("--far"), [77.0]);
}

/// A floor in perspective, whose middle is above that of its picture, has a mark at the middle. So many times as large,
/// the mark is where it was, in a still, in each frame of a motion, and along parallel lines.
#[test]
fn a_zoom_is_about_the_middle_of_the_model() {
    let floor = "v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nusemtl grey\nf 1 2 3 4\n";
    let mark = "v -.2 .4 0\nv .2 .4 0\nv .2 .8 0\nv -.2 .8 0\nusemtl red\nf 5 6 7 8\nv 0 1.2 0\nv 0 1.2 .01\nf 7 9 10\n";
    let library = "newmtl grey\nKd .5 .5 .5\nnewmtl red\nKd 1 0 0\n";
    let scene = "[[object]]\nmodel = \"m.obj\"\n[[animation]]\nof = \"camera\"\nkey = \"zoom\"\ntimes = [0, 1]\nvalues = [1.5, 3]\n";
    let folder = Folder::with(&[
        ("m.obj", format!("mtllib m.mtl\n{floor}{mark}").as_bytes()),
        ("m.mtl", library.as_bytes()),
        ("m.toml", scene.as_bytes()),
    ]);
    // The middle of what is red, and its area.
    let seen = |options: &str| {
        let options: Vec<_> = options.split(' ').chain(["--size", "400x300", "--shading", "unlit"]).collect();
        folder.succeeds(&[&options[..], &["-o", "a.png"]].concat());
        let mut sum = [0.0; 3];
        for (x, y, pixel) in picture(&folder, "a.png").enumerate_pixels() {
            let [red, green, ..] = pixel.0.map(f64::from);
            if red - green > 180.0 {
                sum = [sum[0] + f64::from(x), sum[1] + f64::from(y), sum[2] + 1.0];
            }
        }
        [sum[0] / sum[2] - 199.5, 149.5 - sum[1] / sum[2], sum[2]]
    };
    for (first, second, factor) in [
        ("m.obj --zoom 2", "m.obj --zoom 6", 3.0),
        ("m.obj", "m.obj --zoom 5", 5.0),
        ("m.obj --zoom 1.5", "m.toml", 1.0),
        ("m.toml", "m.toml --time 1", 2.0),
        (
            "m.obj --projection parallel --azimuth 10",
            "m.obj --projection parallel --azimuth 10 --zoom 3",
            3.0,
        ),
    ] {
        let [[x, y, area], [other_x, other_y, larger]] = [first, second].map(seen);
        assert!(
            (x - other_x).abs() < 0.7 && (y - other_y).abs() < 0.7,
            "{second}: {x} {y} {other_x} {other_y}"
        );
        let growth = (larger / area).sqrt() / factor;
        assert!((growth - 1.0).abs() < 0.2, "{second}: {growth}");
        assert!(first.contains("parallel") || y > 10.0, "{first}: {y}");
    }
    // A target that is given stays the middle of the picture.
    let [x, y, _] = seen("m.obj --target 0,0.6,0 --zoom 4");
    assert!(x.abs() < 1.5 && y.abs() < 1.5, "{x} {y}");
}

#[test]
fn a_transparent_picture_has_an_alpha_where_the_format_has() {
    let folder = folder();
    let of = |name: &'static str| ["m.obj", "--size", "32x24", "--background", "transparent", "-o", name];
    for name in ["a.png", "a.tga", "a.webp", "a.qoi"] {
        folder.succeeds(&of(name));
        let alphas: Vec<u8> = picture(&folder, name).pixels().map(|pixel| pixel.0[3]).collect();
        assert!(alphas.contains(&0) && alphas.contains(&255) && alphas.iter().any(|a| (1..255).contains(a)));
    }
    for name in ["b.jpg", "b.ppm", "b.bmp"] {
        folder.fails(&of(name), &["found a format without transparency, expected png, tga, webp or qoi"]);
    }
    let wrong = ["m.obj", "--background", "reddish"];
    folder.fails(
        &wrong,
        &["--background: found \"reddish\", expected hexadecimal digits RRGGBB or RGB, or a name"],
    );
}

#[test]
fn the_printed_camera_makes_the_same_picture() {
    let folder = folder();
    let size = ["m.obj", "--size", "40x30"];
    for options in [
        "",
        "--azimuth 200 --elevation -33 --zoom 1.7",
        "--view top --roll 12",
        "--elevation 90",
        "--elevation -90 --azimuth 40 --roll 1e-3",
        "--view iso --projection parallel",
        "--eye 1,2,3 --roll -170",
        "--target 0.1,0.2,0.3 --up 0,0,1 --fov 11.3",
        "--up -z --azimuth 20",
    ] {
        let words = size.into_iter().chain(options.split_whitespace());
        let run = folder.succeeds(&words.chain(["-o", "a.png"]).collect::<Vec<_>>());
        let told = run.stdout.lines().find_map(|line| line.strip_prefix("camera: ")).expect("a camera");
        // Alone, and behind the options that it goes over.
        for before in ["", options] {
            let words = size.into_iter().chain(before.split_whitespace()).chain(told.split(' '));
            let again = folder.succeeds(&words.chain(["-o", "b.png"]).collect::<Vec<_>>());
            assert!(again.stdout.contains(told), "{again:?}\n{told}");
            let [first, second] =
                ["a.png", "b.png"].map(|name| fs::read(folder.path(name)).expect("a picture"));
            assert!(first == second, "{before} {options}: {told}");
        }
        let more = ["--stats", "json"];
        let json = folder
            .succeeds(&size.into_iter().chain(options.split_whitespace()).chain(more).collect::<Vec<_>>());
        let json: serde_json::Value = serde_json::from_str(&json.stdout).expect("JSON");
        assert_eq!(json["camera"]["options"], told);
    }
}

/// A block that leans is wholly in view, and the ground is below it and not below the picture's lower edge.
#[test]
fn leaning_moves_neither_the_model_out_nor_the_ground() {
    let block = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\n\
        f 5 8 7 6\nf 4 3 7 8\nf 3 2 6 7\nf 2 1 5 6\nf 1 4 8 5\n";
    let folder = Folder::with(&[("block.obj", block.as_bytes())]);
    let pixels = |options: &str| {
        let words = ["block.obj", "--size", "120x120", "--background", "white", "-o", "a.png"];
        let words: Vec<_> = words.into_iter().chain(options.split_whitespace()).collect();
        folder.succeeds(&words);
        picture(&folder, "a.png")
    };
    for roll in ["20", "-45", "90"] {
        let leaning = pixels(&format!("--roll {roll}"));
        let border = (0..120).flat_map(|k| [(k, 0), (k, 119), (0, k), (119, k)]);
        assert!(border.into_iter().all(|(x, y)| leaning.get_pixel(x, y).0[0] == 255), "{roll}");
        assert!(pixels("--roll 0") == pixels("") && pixels("--roll 360") == pixels(""));
    }
    // From above there is a shadow on all sides.
    for options in ["--view top", "--elevation 90 --azimuth 0 --roll 180"] {
        let above = pixels(&format!("{options} --ground --zoom 0.7"));
        let dark = |x: u32, y: u32| above.get_pixel(x, y).0[0] < 250;
        let beside =
            |along: &dyn Fn(u32) -> (u32, u32)| (0..60).map(along).filter(|&(x, y)| dark(x, y)).count();
        let sides: [&dyn Fn(u32) -> (u32, u32); 4] =
            [&|k| (k, 60), &|k| (119 - k, 60), &|k| (60, k), &|k| (60, 119 - k)];
        let counts = sides.map(beside);
        let [least, most] = [counts.iter().min(), counts.iter().max()].map(|count| *count.expect("four"));
        assert!(most - least <= 2 && least < 60 && least > 42, "{options}: {counts:?}");
    }
}

/// The same where a scene file turns, narrows or flattens the view; its height is that of its own projection alone.
#[test]
fn the_printed_camera_goes_over_a_scene_files() {
    let camera = "[camera]\nzoom = 2\nroll = 20\nprojection = \"parallel\"\nview-height = 3\n";
    let scene = format!("size = [40, 30]\n{camera}[[object]]\nmodel = \"m.obj\"\n");
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes()), ("s.toml", scene.as_bytes())]);
    for options in
        ["", "--roll 0", "--projection perspective", "--zoom 1 --view top --projection perspective"]
    {
        let words = ["s.toml", "-o", "a.png"].into_iter().chain(options.split_whitespace());
        let run = folder.succeeds(&words.collect::<Vec<_>>());
        let told = run.stdout.lines().find_map(|line| line.strip_prefix("camera: ")).expect("a camera");
        let words = ["s.toml", "-o", "b.png"].into_iter().chain(told.split(' '));
        folder.succeeds(&words.collect::<Vec<_>>());
        let [first, second] = ["a.png", "b.png"].map(|name| fs::read(folder.path(name)).expect("a picture"));
        assert!(first == second, "{options}: {told}");
    }
    folder.fails(
        &["s.toml", "--projection", "perspective", "--view-height", "2"],
        &["--view-height: found it without --projection parallel"],
    );
}

/// One angle of the command line leaves the file's other one.
#[test]
fn an_angle_of_a_scene_file_is_kept_beside_another() {
    let scene = "size = [40, 30]\n[camera]\nazimuth = 70\nelevation = 50\n[[object]]\nmodel = \"m.obj\"\n";
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes()), ("s.toml", scene.as_bytes())]);
    let camera = |options: &[&str]| {
        let run = folder.succeeds(&[&["s.toml"], options].concat());
        run.stdout.lines().find_map(|line| line.strip_prefix("camera: ")).expect("a camera").to_owned()
    };
    let own = camera(&[]);
    assert_eq!([camera(&["--azimuth", "70"]), camera(&["--elevation", "50"])], [own.clone(), own.clone()]);
    let turned = camera(&["--azimuth", "-10"]);
    assert_eq!(turned, camera(&["--azimuth", "-10", "--elevation", "50"]));
    assert!(turned != own && turned != camera(&["--azimuth", "-10", "--elevation", "20"]));
}

/// A flat model hides the ground that is just below it, whatever depths can tell.
#[test]
fn flat_models_lie_on_their_ground() {
    let flat = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 4 3 2\n";
    let folder = Folder::with(&[("flat.obj", flat.as_bytes())]);
    for profile in ["desktop", "mcu", "tiny"] {
        let words =
            ["flat.obj", "--diffuse", "ff0000", "--shading", "unlit", "--ground", "-q", "-s", "240x180"];
        let words: Vec<_> = words.into_iter().chain(["--profile", profile, "-o", "a.png"]).collect();
        for elevation in ["20", "60"] {
            folder.succeeds(&[&words[..], &["--elevation", elevation]].concat());
            let seen = picture(&folder, "a.png");
            let red = |pixel: &&image::Rgba<u8>| pixel.0[0] > 240 && pixel.0[1] < 20;
            // Nothing of it is darkened: red, or no red at all.
            let dark = |pixel: &&image::Rgba<u8>| pixel.0[0] > pixel.0[1] + 40 && !red(pixel);
            let [whole, dark] = [seen.pixels().filter(red).count(), seen.pixels().filter(dark).count()];
            assert!(whole > 3000 && dark * 20 < whole, "{profile} {elevation}: {whole} {dark}");
        }
    }
}

#[test]
fn cameras_that_contradict_themselves_are_refused() {
    let folder = folder();
    for (options, told) in [
        ("--eye 1,2,3 --azimuth 20", "--azimuth: found it with --eye"),
        ("--eye 1,2,3 --view top", "--view: found it with --eye"),
        ("--view top --elevation 3", "--elevation: found it with --view top"),
        ("--view left --azimuth 3", "--azimuth: found it with --view left"),
        ("--view top --eye 1,2,3", "--view: found it with --eye"),
        ("--samples -1", "--samples: found \"-1\", expected one of 1, 4, 16"),
        ("--elevation 91", "--elevation: found \"91\", expected an angle from -90 to 90 degrees"),
        ("--zoom 0", "--zoom: found \"0\", expected a number from 0.01 to 100"),
        ("--fov 1e-30", "--fov: found 1e-30 degrees, expected an angle of at least 0.001 degrees"),
    ] {
        folder.fails(&["m.obj"].into_iter().chain(options.split(' ')).collect::<Vec<_>>(), &[told]);
    }
    // Before a model is looked for.
    folder.fails(&["no.obj", "--fov", "180"], &["--fov: found 180 degrees"]);
    folder.fails(
        &["no.obj", "--eye", "1,2,3", "--target", "1,2,3"],
        &["--eye: found the eye and its target both"],
    );
    folder.fails(&["no.obj", "--texture", "no.png"], &["no.png: found no such file, expected a PNG"]);
    let teapot = Folder::with(&[("Teapot.obj", TRIANGLE.as_bytes()), ("teapo.png", b"")]);
    teapot.fails(&["Teapot.obj", "--background", "wite"], &["--background", "did you mean white?"]);
    teapot.fails(&["Teapot.obj", "--diffuse", "Rebecapurple"], &["did you mean rebeccapurple?"]);
    teapot.fails(&["teapo.obj"], &["teapo.obj: found no such file", "did you mean Teapot.obj?"]);
    folder.fails(&["no.obj"], &["no.obj: found no such file", "check its path"]);
    let [view, angle] = ["--view back", "--azimuth 180"].map(|side| {
        let run = folder.succeeds(&["m.obj --elevation 30", side].join(" ").split(' ').collect::<Vec<_>>());
        run.stdout.lines().nth(1).map(str::to_owned)
    });
    assert!(view.is_some() && view == angle, "{view:?} {angle:?}");
    let tiny = Folder::with(&[("t.obj", &b"v 0 0 0\nv 1e-40 0 0\nv 0 1e-40 0\nf 1 2 3\n"[..])]);
    tiny.fails(&["t.obj"], &["t.obj: found a model of radius "]);
}

#[test]
fn a_model_fills_the_picture_from_every_side() {
    // A box ten times as long as it is high.
    let corner = |k: u32| format!("v {} {} {}\n", k & 1, 10 * (k >> 1 & 1), k >> 2 & 1);
    let mut text: String = (0..8).map(corner).collect();
    for face in ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"] {
        text += &format!("f {face}\n");
    }
    let folder = Folder::with(&[("box.obj", text.as_bytes())]);
    for view in ["front", "back", "left", "right", "top", "bottom", "iso"] {
        for projection in ["perspective", "parallel"] {
            let size = ["box.obj", "--size", "200x100", "--view", view, "--projection", projection];
            folder.succeeds(
                &size.into_iter().chain(["--background", "black", "-o", "a.png"]).collect::<Vec<_>>(),
            );
            let seen = picture(&folder, "a.png");
            let lit = seen.enumerate_pixels().filter(|(_, _, pixel)| pixel.0[..3] != [0; 3]);
            let (mut low, mut high) = ([u32::MAX; 2], [0; 2]);
            for (x, y, _) in lit {
                low = [low[0].min(x), low[1].min(y)];
                high = [high[0].max(x), high[1].max(y)];
            }
            let free = [low[0], 199 - high[0], low[1], 99 - high[1]];
            let (side, other) = (free[0].min(free[1]), free[2].min(free[3]));
            // 4 % of half a side.
            assert!(side >= 3 && other >= 1, "{view} {projection} {free:?}");
            assert!(side <= 5 || other <= 3, "{view} {projection} {free:?}");
            assert!(
                free[0].abs_diff(free[1]) <= 2 && free[2].abs_diff(free[3]) <= 2,
                "{view} {projection} {free:?}"
            );
        }
    }
}

#[test]
fn pictures_have_more_formats_and_standard_output() {
    let folder = folder();
    let small = ["m.obj", "--size", "16x12", "-o"];
    for (name, start) in [("a.webp", &b"RIFF"[..]), ("a.qoi", b"qoif"), ("a.ppm", b"P6")] {
        folder.succeeds(&small.into_iter().chain([name]).collect::<Vec<_>>());
        assert!(fs::read(folder.path(name)).expect("the picture").starts_with(start), "{name}");
        assert_eq!(image::open(folder.path(name)).expect("a picture").to_rgb8().dimensions(), (16, 12));
    }
    let before = folder.names();
    for (more, start) in [(&["-"][..], &b"\x89PNG"[..]), (&["-", "--output-format", "ppm"], b"P6")] {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_alberti"))
            .current_dir(folder.path(""))
            .arg("render")
            .args(small)
            .args(more)
            .output()
            .expect("the command");
        assert!(output.status.success() && output.stdout.starts_with(start), "{more:?}");
        let told = String::from_utf8(output.stderr).expect("text");
        assert!(told.contains("pixels in -; "), "{told}");
    }
    folder.succeeds(&["m.obj", "--size", "16x12", "-o", "plain", "--output-format", "png"]);
    assert_eq!(folder.names().len(), before.len() + 1);
    for (name, found) in [
        ("x.png/", "found the name of a folder"),
        (&format!("{}.png", "x".repeat(300)), "found a name that no file"),
    ] {
        folder.fails(&["missing.obj", "-o", name], &[found]);
    }
    let run =
        alberti(&folder.path(""), &[OsStr::new("explain")], &["m.obj", "--pixel", "1,1", "--samples", "4"]);
    assert!(
        run.status == Some(2) && run.stderr.contains("--samples: found an option that `explain`"),
        "{run:?}"
    );
}
