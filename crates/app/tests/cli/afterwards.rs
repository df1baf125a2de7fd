//! What comes after a fragment's colour: fog, blends, holes and patterns, against their formulas in `f64`.

use super::Folder;

const SIZE: [u32; 2] = [64, 48];
/// The tangents of a pixel's centre from the middle, for a camera that looks along -z from (0, 0, 5), with a right
/// angle from top to bottom.
fn tangents([x, y]: [u32; 2]) -> [f64; 2] {
    let [width, height] = SIZE.map(f64::from);
    [(2.0 * f64::from(x) + 1.0 - width) / height, (height - 2.0 * f64::from(y) - 1.0) / height]
}

const HEAD: &str = "size = [64, 48]\nbackground = \"204060\"\noutput = \"a.png\"\n\
    [camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nfov = 90\nnear = 0.1\nfar = 100\n\
    [render]\nshading = \"unlit\"\nfilter = \"nearest\"\n";

/// A square before the camera, so far from it, with a material; 2.2 distances wide and high.
fn pane(distance: f64, material: &str) -> String {
    let (side, z) = (2.2 * distance, 5.0 - distance);
    format!(
        "[[object]]\nsurface = \"plane\"\nsize = [{side}, {side}]\nrotation = [90, 0, 0]\n\
         position = [0, 0, {z}]\nmaterial = \"{material}\"\n"
    )
}

/// An image whose left half has one alpha and whose right half another.
fn halves(color: [u8; 3], alphas: [u8; 2]) -> Vec<u8> {
    let [r, g, b] = color;
    let picture = image::RgbaImage::from_fn(2, 1, |x, _| image::Rgba([r, g, b, alphas[x as usize]]));
    let mut file = std::io::Cursor::new(vec![]);
    picture.write_to(&mut file, image::ImageFormat::Png).expect("an image");
    file.into_inner()
}

fn drawn(folder: &Folder, scene: &str, arguments: &[&str]) -> image::RgbImage {
    std::fs::write(folder.path("s.toml"), scene).expect("a file");
    let run = folder.succeeds(&[&["s.toml", "--samples", "1"][..], arguments].concat());
    assert_eq!(run.stderr, "", "{scene}");
    image::open(folder.path("a.png")).expect("a picture").to_rgb8()
}

/// Checks a pixel to within so much.
fn near(picture: &image::RgbImage, [x, y]: [u32; 2], expected: [f64; 3], within: f64) {
    let found = picture.get_pixel(x, y).0;
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((f64::from(found) - expected).abs() <= within, "{x},{y}: {found}, expected {expected}");
    }
}

/// A part of one colour and the rest of another.
fn mixed(new: [f64; 3], old: [f64; 3], part: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| new[k] * part + old[k] * (1.0 - part))
}

const SURFACE: [f64; 3] = [192.0, 128.0, 64.0];
const FOG: [f64; 3] = [16.0, 200.0, 240.0];
type Law = fn(f64) -> f64;
const FOGS: [(&str, Law); 3] = [
    ("linear:6,12", |z| ((z - 6.0) / 6.0).clamp(0.0, 1.0)),
    ("exp:0.1", |z| 1.0 - (-0.1 * z).exp()),
    ("exp2:0.1", |z| 1.0 - (-0.01 * z * z).exp()),
];

/// A floor 2 below the eye: the ray of a pixel meets it at z = 2/tan, which is the distance along the line of sight.
#[test]
fn fog_is_its_formula_at_each_distance() {
    let folder = Folder::with(&[("white.png", &halves([255; 3], [255; 2]))]);
    let floor = "[[object]]\nsurface = \"plane\"\nsize = [200, 200]\nposition = [0, -2, 0]\nmaterial = \"m\"\n\
        [material.m]\ncolor = \"c08040\"\n";
    let textured = &format!("{floor}color-map = \"white.png\"\n");
    for (fog, law) in FOGS {
        for (floor, arguments) in [
            (floor, &[][..]),
            (textured, &["--interpolation", "plane"]),
            (floor, &["--profile", "mcu", "--color", "rgba8"]),
            (textured, &["--profile", "mcu", "--color", "rgba8", "--interpolation", "spans:8"]),
            // Light by vertex and by pixel, with nothing but what falls everywhere.
            (&format!("{textured}[ambient]\nintensity = 1\n")[..], &["--shading", "phong"]),
            (&format!("{floor}[ambient]\nintensity = 1\n")[..], &["--shading", "gouraud"]),
        ] {
            let scene = format!("{HEAD}fog = \"{fog}\"\nfog-color = \"10c8f0\"\n{floor}");
            let picture = drawn(&folder, &scene, arguments);
            for y in 28..SIZE[1] {
                for x in (1..SIZE[0]).step_by(6) {
                    let [_, down] = tangents([x, y]);
                    let z = -2.0 / down;
                    // Amounts are to 1.3 of 256.
                    near(&picture, [x, y], mixed(FOG, SURFACE, law(z)), 2.0);
                }
            }
            near(&picture, [32, 3], [32.0, 64.0, 96.0], 0.0);
        }
    }
    // In the background's colour, unless there is another, and in a parallel projection, where a wall has one distance.
    for (shading, scene) in [("unlit", pane(8.0, "m")), ("lambert", pane(8.0, "m"))] {
        let scene = format!("{HEAD}{scene}[material.m]\ncolor = \"c08040\"\n");
        let options = ["--fog", "exp:0.1", "--projection", "parallel", "--shading", shading];
        let picture = drawn(&folder, &scene, &options);
        let [plain, all] = [options[4..].to_vec(), options.to_vec()].map(|o| drawn(&folder, &scene, &o));
        let before = plain.get_pixel(32, 24).0.map(f64::from);
        near(&all, [32, 24], mixed([32.0, 64.0, 96.0], before, 1.0 - (-0.8_f64).exp()), 2.0);
        assert!(all == picture);
    }
}

/// Colours of panes, with alphas on their left and on their right.
const GREEN: [f64; 3] = [30.0, 220.0, 90.0];
const ALPHAS: [u8; 2] = [64, 192];

type Mixture = fn(f64, f64, f64) -> f64;
const BLENDS: [(&str, Mixture); 4] = [
    ("over", |new, old, a| new * a + old * (1.0 - a)),
    ("additive", |new, old, a| (new * a + old).min(255.0)),
    ("multiply", |new, old, _| new * old / 255.0),
    ("constant:0.25", |new, old, _| new * 0.25 + old * 0.75),
];

#[test]
fn blends_are_their_formulas() {
    let folder = Folder::with(&[("green.png", &halves([30, 220, 90], ALPHAS))]);
    let wall = [200.0, 100.0, 50.0];
    let each = |of: &dyn Fn(f64, f64) -> f64| [0, 1, 2].map(|k| of(GREEN[k], wall[k]));
    for arguments in [&[][..], &["--profile", "mcu", "--color", "rgba8"], &["--shading", "vertex-color"]] {
        for (blend, of) in BLENDS {
            // The pane comes first in the file, and is drawn last.
            let scene = format!(
                "{HEAD}{}{}[material.wall]\ncolor = \"c86432\"\n\
                 [material.pane]\ncolor-map = \"green.png\"\nblend = \"{blend}\"\n",
                pane(3.0, "pane"),
                pane(6.0, "wall"),
            );
            let picture = drawn(&folder, &scene, arguments);
            for (x, alpha) in [(12, ALPHAS[0]), (50, ALPHAS[1])] {
                if arguments.contains(&"vertex-color") {
                    // White before white.
                    let white = of(255.0, 255.0, 1.0);
                    near(&picture, [x, 20], [white; 3], 1.0);
                } else {
                    near(&picture, [x, 20], each(&|new, old| of(new, old, f64::from(alpha) / 255.0)), 1.0);
                }
            }
        }
    }
}

/// In a fog that hides all, a pane changes nothing: what is added or multiplied fades, too.
#[test]
fn mixtures_fade_in_fog() {
    let folder = Folder::with(&[("green.png", &halves([30, 220, 90], ALPHAS))]);
    for (blend, _) in BLENDS {
        let scene = format!(
            "{HEAD}fog = \"linear:1,2\"\nfog-color = \"10c8f0\"\n{}{}[material.wall]\ncolor = \"c86432\"\n\
             [material.pane]\ncolor-map = \"green.png\"\nblend = \"{blend}\"\n",
            pane(3.0, "pane"),
            pane(6.0, "wall"),
        );
        near(&drawn(&folder, &scene, &[]), [32, 20], FOG, 0.0);
    }
}

#[test]
fn the_farthest_is_mixed_first_in_whatever_order_the_file_has_them() {
    let folder = Folder::with(&[]);
    let [red, green, blue] = [[255.0, 0.0, 0.0], [0.0, 255.0, 0.0], [0.0, 0.0, 255.0]];
    let materials = "[material.wall]\ncolor = \"ffffff\"\n\
        [material.red]\ncolor = \"ff0000\"\nblend = \"constant:0.5\"\n\
        [material.green]\ncolor = \"00ff00\"\nblend = \"constant:0.25\"\n\
        [material.blue]\ncolor = \"0000ff\"\nblend = \"constant:0.5\"\n";
    // Blue is behind the wall, and not seen.
    let panes = [pane(9.0, "blue"), pane(6.0, "wall"), pane(4.0, "red"), pane(2.0, "green")];
    let expected = mixed(green, mixed(red, [255.0; 3], 128.0 / 255.0), 64.0 / 255.0);
    let mut pictures = vec![];
    for order in [[0, 1, 2, 3], [3, 2, 1, 0], [2, 0, 3, 1], [3, 1, 0, 2]] {
        let scene = format!("{HEAD}{}{materials}", order.map(|k| &panes[k][..]).concat());
        let picture = drawn(&folder, &scene, &[]);
        near(&picture, [32, 24], expected, 1.5);
        pictures.push(picture);
    }
    assert!(pictures.iter().all(|picture| *picture == pictures[0]));
    // Seen from behind, blue is before the wall, and the others are hidden.
    let scene = format!("{HEAD}{}{materials}", panes.concat());
    let behind = drawn(&folder, &scene, &["--eye", "0,0,-15"]);
    near(&behind, [32, 24], mixed(blue, [255.0; 3], 128.0 / 255.0), 1.0);
}

/// Glass hides no glass: both sides of a ball are seen, whichever of its triangles comes first.
#[test]
fn what_is_mixed_writes_no_depth() {
    let folder = Folder::with(&[]);
    for turn in [0, 90, 180, 270] {
        let scene = format!(
            "{HEAD}[[object]]\nsurface = \"sphere\"\nradius = 2\nrotation = [{turn}, 0, 0]\nmaterial = \"m\"\n\
             [material.m]\ncolor = \"ffc000\"\nblend = \"constant:0.5\"\n"
        );
        for arguments in [&[][..], &["--profile", "mcu", "--color", "rgba8"]] {
            let picture = drawn(&folder, &scene, arguments);
            let (ball, behind) = ([255.0, 192.0, 0.0], [32.0, 64.0, 96.0]);
            let once = mixed(ball, behind, 128.0 / 255.0);
            near(&picture, [29, 21], mixed(ball, once, 128.0 / 255.0), 1.5);
        }
    }
}

#[test]
fn holes_are_where_alpha_is_too_small() {
    let folder = Folder::with(&[("green.png", &halves([30, 220, 90], [127, 128]))]);
    let scene = |least: &str| {
        format!(
            "{HEAD}{}{}[material.wall]\ncolor = \"c86432\"\n\
             [material.pane]\ncolor-map = \"green.png\"\nalpha-test = {least}\n",
            pane(3.0, "pane"),
            pane(6.0, "wall"),
        )
    };
    let wall = [200.0, 100.0, 50.0];
    for arguments in
        [&[][..], &["--profile", "mcu", "--color", "rgba8"], &["--shading", "phong", "--fog", "linear:90,99"]]
    {
        for (least, [left, right]) in
            [("0.5", [wall, GREEN]), ("0", [GREEN, GREEN]), ("1", [wall, wall]), ("0.49", [GREEN, GREEN])]
        {
            let lit = arguments.contains(&"phong");
            let scene = scene(least) + if lit { "[ambient]\nintensity = 1\n" } else { "" };
            let picture = drawn(&folder, &scene, arguments);
            near(&picture, [12, 20], left, 1.0);
            near(&picture, [50, 20], right, 1.0);
        }
    }
}

/// Levels of a channel between which a format has to choose, and what a channel's mean is then.
#[test]
fn patterns_have_the_mean_of_the_colour() {
    let folder = Folder::with(&[]);
    let scene = format!("{HEAD}{}[material.m]\ncolor = \"c86432\"\n", pane(6.0, "m"));
    let color = [200.0, 100.0, 50.0];
    let grey = [(77.0 * 200.0 + 150.0 * 100.0 + 29.0 * 50.0) / 256.0; 3];
    for (format, greatest, color) in [
        ("rgb565", [31.0, 63.0, 31.0], color),
        ("rgb444", [15.0; 3], color),
        ("rgb666", [63.0; 3], color),
        ("rgb888", [255.0; 3], color),
        ("xrgb8888", [255.0; 3], color),
        ("rgb332", [7.0, 7.0, 3.0], color),
        ("indexed8", [5.0; 3], color),
        ("grey8", [255.0; 3], grey),
        ("grey4", [15.0; 3], grey),
        ("grey2", [3.0; 3], grey),
        ("grey1", [1.0; 3], grey),
    ] {
        for (dither, side) in [("none", 8), ("bayer", 8), ("blue-noise", 32)] {
            let picture = drawn(&folder, &scene, &["--color", format, "--dither", dither]);
            for k in 0..3 {
                let level = |x, y| f64::from(picture.get_pixel(x, y).0[k]) * greatest[k] / 255.0;
                let (mut sum, mut least, mut most) = (0.0, f64::INFINITY, 0.0_f64);
                for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (16 + x, 8 + y))) {
                    let level = level(x, y);
                    assert!((level - level.round()).abs() <= 0.6 * greatest[k] / 255.0, "{format} {level}");
                    (sum, least, most) =
                        (sum + level.round(), least.min(level.round()), most.max(level.round()));
                }
                let (mean, exact) = (sum / f64::from(side * side), color[k] * greatest[k] / 255.0);
                // A pattern's steps, a 255th of a level, and luminance to a byte.
                let within =
                    if dither == "none" { 0.51 } else { 0.5 / 64.0 + 1.5 / 255.0 * greatest[k].max(1.0) };
                assert!((mean - exact).abs() <= within, "{format} {dither}: {mean}, {exact}");
                assert!(most - least <= f64::from(u8::from(dither != "none")), "{format} {dither}");
            }
        }
    }
    // What is a level already stays.
    let white = scene.replace("c86432", "ffffff");
    let picture = drawn(&folder, &white, &["--color", "grey1", "--dither", "bayer"]);
    assert!((10..30).all(|x| picture.get_pixel(x, 20).0 == [255; 3]));
}

#[test]
fn mistakes_are_told_where_they_are() {
    let folder = Folder::with(&[]);
    for (text, part) in [
        (
            "[render]\nfog = \"linear:5,2\"\n",
            "s.toml:2: render.fog: found \"linear:5,2\", expected none, linear:START,END with START below END, exp:DENSITY",
        ),
        (
            "[render]\nfog-color = \"ffffff\"\n",
            "s.toml:2: render.fog-color: found it without render.fog, expected",
        ),
        (
            "[render]\ndither = \"noise\"\n",
            "s.toml:2: render.dither: found \"noise\", expected one of none, bayer, blue-noise",
        ),
        (
            "[material.a]\nblend = \"screen\"\n",
            "s.toml:2: material.a.blend: found \"screen\", expected over, additive, multiply or constant:ALPHA",
        ),
        ("[material.a]\nblend = \"constant:2\"\n", "s.toml:2: material.a.blend: found \"constant:2\""),
        (
            "[material.a]\nalpha-test = 128\n",
            "s.toml:2: material.a.alpha-test: found 128, expected a number from 0 to 1",
        ),
    ] {
        let scene = format!("{text}[[object]]\nsurface = \"plane\"\n");
        std::fs::write(folder.path("s.toml"), scene).expect("a file");
        folder.fails(&["s.toml"], &[part]);
    }
    for (arguments, part) in [
        (
            &["--scene", "cube", "--fog", "exp:0"][..],
            "--fog: found \"exp:0\", expected none, linear:START,END",
        ),
        (
            &["--scene", "cube", "--fog-color", "ffffff"],
            "--fog-color: found it without --fog, expected --fog as well",
        ),
        (
            &["--scene", "cube", "--dither", "on"],
            "--dither: found \"on\", expected one of none, bayer, blue-noise",
        ),
        (
            &["--scene", "cube", "--color", "rgb999"],
            "--color: found \"rgb999\", expected one of rgba8, rgb565, rgb444,",
        ),
    ] {
        folder.fails(arguments, &[part]);
    }
    // A journey ends at the surface's colour.
    let panes = [pane(8.0, "wall"), pane(6.0, "m").replace("size = [13.2", "size = [1, 1] # ")].concat();
    let scene =
        format!("{HEAD}{panes}[material.m]\nblend = \"additive\"\n[material.wall]\ncolor = \"ff0000\"\n");
    std::fs::write(folder.path("s.toml"), &scene).expect("a file");
    for (arguments, part) in [
        (
            &["s.toml"][..],
            "--pixel: found triangle 1 of \"m\" that is blended, before triangle 1 of \"wall\", expected a pixel",
        ),
        (&["--scene", "cube", "--fog", "exp:1"][..], "--fog: found a fog, expected a picture without"),
        (&["--scene", "cube", "--dither", "bayer"], "--dither: found a pattern, expected a picture without"),
    ] {
        let arguments = [arguments, &["--pixel", "32,24"]].concat();
        let run = super::alberti(folder.0.path(), &[std::ffi::OsStr::new("explain")], &arguments);
        assert!(run.status == Some(2) && run.stderr.contains(part), "{run:?}");
    }
    // Beside it there is a journey, of the picture that has it.
    let run =
        super::alberti(folder.0.path(), &[std::ffi::OsStr::new("explain")], &["s.toml", "--pixel", "32,2"]);
    assert!(
        run.stdout.contains("the derived colour is that of the picture with one sample a pixel, to the bit"),
        "{run:?}"
    );
}

/// The fog of a scene file, taken away.
#[test]
fn no_fog_is_a_fog_too() {
    let folder = Folder::with(&[]);
    let bright = "[material.m]\ncolor = \"c08040\"\n";
    let clear = format!("{HEAD}{}{bright}", pane(6.0, "m"));
    let hazy = clear.replace("[render]\n", "[render]\nfog = \"exp:0.1\"\nfog-color = \"10c8f0\"\n");
    let without = drawn(&folder, &clear, &[]);
    assert!(drawn(&folder, &hazy, &[]) != without);
    assert!(drawn(&folder, &hazy, &["--fog", "none"]) == without);
    assert!(drawn(&folder, &hazy.replace("exp:0.1", "none"), &[]) == without);
}
