//! Light: two-sided, of the models' materials, from beside the camera, and in linear space.

use std::ffi::OsStr;
use std::fs;

use crate::{Folder, TRIANGLE, alberti};

/// A bent sheet of two squares, with or against its winding.
fn sheet(turned: bool) -> String {
    let normal = |[x, z]: [f64; 2]| {
        let sign = if turned { -1.0 } else { 1.0 };
        format!("vn {} 0 {}\n", sign * x, sign * z)
    };
    let mut text = String::from("v -1 -1 0\nv 0 -1 0.4\nv 1 -1 0\nv -1 1 0\nv 0 1 0.4\nv 1 1 0\n");
    text += "vt 0 0\nvt 1 0\nvt 2 0\nvt 0 1\nvt 1 1\nvt 2 1\n";
    text += &[[-0.6, 0.8], [0.0, 1.0], [0.6, 0.8]].map(normal).concat();
    let [a, b, c] = [[[1, 1], [4, 1]], [[2, 2], [5, 2]], [[3, 3], [6, 3]]];
    for face in [[a[0], b[0], b[1]], [a[0], b[1], a[1]], [b[0], c[0], c[1]], [b[0], c[1], b[1]]] {
        let mut corners = face.map(|[place, normal]| format!("{place}/{place}/{normal}"));
        if turned {
            corners.reverse();
        }
        text += &format!("f {}\n", corners.join(" "));
    }
    text
}

fn checks() -> Vec<u8> {
    let texel = |x: u32, y: u32| if (x + y).is_multiple_of(2) { [250, 90, 40] } else { [60, 130, 240] };
    let image = image::RgbImage::from_fn(4, 4, |x, y| image::Rgb(texel(x, y)));
    let mut png = std::io::Cursor::new(Vec::new());
    image.write_to(&mut png, image::ImageFormat::Png).expect("a picture in memory");
    png.into_inner()
}

/// The back of a sheet is lit as the front of the same sheet that is wound the other way, with opposite normals.
#[test]
fn backs_are_lit_as_fronts() {
    let png = checks();
    let folder = Folder::with(&[
        ("sheet.obj", sheet(false).as_bytes()),
        ("turned.obj", sheet(true).as_bytes()),
        ("checks.png", &png),
    ]);
    let picture = |model: &str, more: &[&str]| {
        let mut arguments = vec![model, "--size", "96x72", "--texture", "checks.png", "--eye", "1,0.5,-5"];
        arguments.extend(more);
        folder.succeeds(&arguments);
        fs::read(folder.path("alberti.png")).expect("a picture")
    };
    for more in [
        &["--shading", "lambert"][..],
        &["--shading", "gouraud", "--specular", "ffffff"],
        &["--shading", "blinn", "--specular", "ffffff"],
        &["--shading", "phong", "--height-map", "checks.png"],
        &["--shading", "phong", "--height-map", "checks.png", "--relief", "occlusion"],
        &["--shading", "lambert", "--projection", "parallel"],
        &["--shading", "lambert", "--profile", "tiny"],
        &["--shading", "lambert", "--cull", "front"],
    ] {
        let found = picture("sheet.obj", more);
        let front = [more, &["--cull", "none"]].concat();
        let expected = picture("turned.obj", if more.contains(&"--cull") { &front[..2] } else { more });
        assert!(found == expected, "{more:?}");
        let one_sided = picture("sheet.obj", &[more, &["--two-sided", "false"]].concat());
        assert!(one_sided != found, "{more:?}");
        // From the front there is nothing to turn.
        let front = |two: &str| picture("turned.obj", &[more, &["--two-sided", two]].concat());
        assert!(front("true") == front("false"), "{more:?}");
    }
    let culled = ["--cull", "back"];
    assert!(
        picture("sheet.obj", &culled) == picture("sheet.obj", &["--cull", "back", "--two-sided", "false"])
    );
}

/// The broad highlight of a ball that is lit from the side ends softly where the light does.
#[test]
fn broad_highlights_have_no_edge() {
    let scene = "[[object]]\nsurface = \"sphere\"\nsegments = [96, 96]\nmaterial = \"wax\"\n\
        [material.wax]\ncolor = \"808080\"\nspecular = \"white\"\nshininess = 4\n\
        [[light]]\nkind = \"directional\"\ndirection = [-1, 0, 0.3]\n\
        [camera]\neye = [0, 0, 6]\ntarget = [0, 0, 0]\n";
    let folder = Folder::with(&[("ball.toml", scene.as_bytes())]);
    for shading in ["phong", "blinn"] {
        folder.succeeds(&["ball.toml", "--shading", shading, "--size", "400x300", "--samples", "1"]);
        let picture = image::open(folder.path("alberti.png")).expect("a picture").to_rgb8();
        let row: Vec<u8> = (140..262).map(|x| picture.get_pixel(x, 150).0[0]).collect();
        let step = row.windows(2).map(|pair| pair[0].abs_diff(pair[1])).max();
        assert!(step < Some(14), "{shading}: {row:?}");
        assert!(row.iter().max() > Some(&150), "{shading}: {row:?}");
    }
}

/// What is said of a pixel that is seen from behind is what is drawn there.
#[test]
fn backs_are_explained() {
    let folder = Folder::with(&[("sheet.obj", sheet(false).as_bytes())]);
    for shading in ["lambert", "blinn", "gouraud"] {
        let arguments =
            ["sheet.obj", "--eye", "1,0.5,-5", "--shading", shading, "--size", "96x72", "--pixel", "48,36"];
        let run = alberti(folder.path("").as_path(), &[OsStr::new("explain")], &arguments);
        assert_eq!(run.status, Some(0), "{run:?}");
        assert!(
            run.stdout.lines().last().is_some_and(|line| line
                .contains("the derived colour is that of the picture with one sample a pixel, to the bit")),
            "{run:?}"
        );
    }
}

/// A box seen from a corner, by default and with a key light from elsewhere: its sides differ.
#[test]
fn models_without_lights_get_three() {
    let corners = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
    let normals = "vn 0 0 1\nvn 1 0 0\nvn 0 1 0\n";
    let faces = "f 5//1 6//1 7//1 8//1\nf 2//2 3//2 7//2 6//2\nf 4//3 8//3 7//3 3//3\n";
    let folder = Folder::with(&[
        ("box.obj", [corners, normals, faces].concat().as_bytes()),
        ("box.toml", b"[[object]]\nmodel = \"box.obj\"\n[render]\nlight = \"-35,50\"\n"),
        ("lit.toml", b"[[object]]\nmodel = \"box.obj\"\n[ambient]\nintensity = 0.5\n"),
    ]);
    let sides = |name: &str, more: &[&str]| {
        let eye = ["--eye", "3,2.5,5", "--target", "0,0,0", "--size", "90x90", "--diffuse", "ffffff"];
        let run = folder.succeeds(&[&[name], &eye[..], &["--samples", "1"], more].concat());
        let picture = image::open(folder.path("alberti.png")).expect("a picture").to_rgb8();
        let mut found: Vec<u8> = picture.pixels().map(|pixel| pixel.0[0]).collect();
        found.sort_unstable();
        found.dedup();
        (found, run.stderr)
    };
    let (found, warnings) = sides("box.obj", &[]);
    // The background and three sides, none of them white, each a tenth from the next.
    assert!(found.len() == 4 && warnings.is_empty(), "{found:?} {warnings}");
    assert!(found[3] < 255 && found.windows(2).all(|pair| pair[1] - pair[0] > 25), "{found:?}");
    assert_eq!(sides("box.toml", &[]).0, found);
    assert_eq!(
        sides("box.obj", &["--light", "-35,50", "--shading", "phong", "--specular", "000000"]).0,
        found
    );
    assert_ne!(sides("box.obj", &["--light", "60,10"]).0, found);
    let (_, warnings) = sides("lit.toml", &["--light", "0,0"]);
    assert!(warnings.contains("--light: found it in a scene with lights of its own"), "{warnings}");
    folder.fails(&["box.obj", "--light", "north"], &["--light", "such as -35,50"]);
    folder.fails(&["box.obj", "--ground=north"], &["--ground: found \"north\"", "one of true, false"]);
}

/// A factor of all light: of three lights, of one beside the camera, and of a scene's own, in every shading.
#[test]
fn brightness_is_a_factor_of_light() {
    let scene = b"[[object]]\nmodel = \"sheet.obj\"\n[[light]]\nkind = \"point\"\nposition = [0, 3, 5]\n\
        intensity = 0.4\n[ambient]\nintensity = 0.1\n";
    let folder = Folder::with(&[("sheet.obj", sheet(true).as_bytes()), ("s.toml", scene)]);
    let picture = |name: &str, more: &[&str]| {
        let common =
            [name, "--size", "64x48", "--background", "000", "--diffuse", "505050", "--samples", "1"];
        let run = folder.succeeds(&[&common[..], more].concat());
        (image::open(folder.path("alberti.png")).expect("a picture").to_rgb8(), run.stderr)
    };
    for (name, more) in [
        ("sheet.obj", &["--shading", "lambert"][..]),
        ("sheet.obj", &["--shading", "lambert", "--light", "lamp"]),
        ("sheet.obj", &["--shading", "gouraud"]),
        ("sheet.obj", &["--shading", "phong", "--specular", "000000"]),
        ("s.toml", &["--shading", "lambert"]),
        ("s.toml", &["--shading", "blinn", "--specular", "000000"]),
    ] {
        let with = |factor: &str| picture(name, &[more, &["--brightness", factor]].concat()).0;
        let [dark, usual, double] = ["0", "1", "2"].map(with);
        assert!(usual == picture(name, more).0, "{name} {more:?}");
        assert!(dark.pixels().all(|pixel| pixel.0 == [0; 3]), "{name} {more:?}");
        assert!(usual.pixels().any(|pixel| pixel.0[0] > 20), "{name} {more:?}");
        for (one, two) in usual.pixels().zip(double.pixels()) {
            // Each byte is off by a half at most.
            let apart = i32::from(two.0[0]) - 2 * i32::from(one.0[0]);
            assert!(apart.abs() <= 1 || two.0[0] == 255, "{name} {more:?}: {one:?} {two:?}");
        }
    }
    let (_, warnings) = picture("sheet.obj", &["--shading", "unlit", "--brightness", "2"]);
    assert!(warnings.contains("--brightness: found it with --shading unlit"), "{warnings}");
    folder.fails(&["sheet.obj", "--brightness", "-1"], &["--brightness", "a number from 0 to 100"]);
}

/// What is said of a pixel under three lights is what is drawn there.
#[test]
fn three_lights_are_explained() {
    let folder = Folder::with(&[("sheet.obj", sheet(true).as_bytes())]);
    for shading in ["lambert", "blinn"] {
        let arguments = ["sheet.obj", "--shading", shading, "--size", "96x72", "--pixel", "48,36"];
        let run = alberti(folder.path("").as_path(), &[OsStr::new("explain")], &arguments);
        assert_eq!(run.status, Some(0), "{run:?}");
        assert!(
            run.stdout
                .ends_with("the derived colour is that of the picture with one sample a pixel, to the bit\n"),
            "{run:?}"
        );
    }
}

/// A ground that is left out leaves no room for its shadow either.
#[test]
fn a_ground_that_is_not_seen_does_not_move_the_camera() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    let camera = |more: &[&str]| {
        let told = folder.succeeds(&[&["m.obj", "-s", "40x30", "--elevation", "-20"], more].concat()).stdout;
        told.lines().nth(1).map(str::to_owned).expect("a camera")
    };
    assert_eq!(camera(&["--ground"]), camera(&[]));
}

/// A box that stands on a ground has a shadow around it, and nothing changes far from it.
#[test]
fn a_ground_has_a_soft_shadow() {
    let corners = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
    let sides = "f 5 6 7 8\nf 2 1 4 3\nf 2 3 7 6\nf 1 5 8 4\nf 4 8 7 3\nf 1 2 6 5\n";
    let folder = Folder::with(&[("box.obj", [corners, sides].concat().as_bytes())]);
    let view =
        ["box.obj", "--eye", "0,4,9", "--target", "0,-0.2,0", "--size", "90x90", "--background", "c0c0c0"];
    let picture = |more: &[&str]| {
        folder.succeeds(&[&view[..], &["--samples", "1"], more].concat());
        image::open(folder.path("alberti.png")).expect("a picture").to_rgb8()
    };
    let (bare, ground) = (picture(&["--ground=false"]), picture(&["--ground"]));
    assert_eq!(bare, picture(&[]));
    let changed: Vec<_> =
        bare.enumerate_pixels().filter(|(x, y, p)| ground.get_pixel(*x, *y) != *p).collect();
    assert!(changed.len() > 30, "{}", changed.len());
    for &(x, y, before) in &changed {
        // Darker, evenly, and on the background alone.
        let [r, g, b] = ground.get_pixel(x, y).0;
        assert!(before.0 == [0xc0; 3] && r < 0xc0 && r == g && g == b, "{x} {y} {before:?} {r} {g} {b}");
    }
    let darkest = changed.iter().map(|&(x, y, _)| ground.get_pixel(x, y).0[0]).min();
    assert!(darkest < Some(0xa8), "{darkest:?}");
    for corner in [(0, 0), (89, 0)] {
        assert_eq!(ground.get_pixel(corner.0, corner.1).0, [0xc0; 3]);
    }
    // A picture that is framed has most of the shadow.
    folder.succeeds(&["box.obj", "--ground", "--size", "90x90", "--background", "c0c0c0"]);
    let framed = image::open(folder.path("alberti.png")).expect("a picture").to_rgb8();
    let edge = framed.enumerate_pixels().filter(|(x, y, _)| [0, 89].contains(x) || [0, 89].contains(y));
    assert!(edge.map(|(.., p)| p.0[0]).min() >= Some(0x98));
    assert!(framed.pixels().any(|p| p.0[0] == p.0[1] && (0x60..0xa0).contains(&p.0[0])));
    for command in [&["explain", "--pixel", "1,1"][..], &["info"], &["bake", "--out", "out"]] {
        let run = alberti(folder.path("").as_path(), &[], &[command, &["box.obj", "--ground"]].concat());
        let told = format!("warning: --ground: found it with {}, which has the model alone", command[0]);
        assert!(run.status == Some(0) && run.stderr.starts_with(&told), "{run:?}");
        assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
    }
    let run = folder.succeeds(&[&view[..], &["--ground", "--shading", "vertex-color"]].concat());
    assert!(run.stderr.contains("--ground: found it with vertex-color"), "{run:?}");
    // Straight lines bend it a little; numbers of pixels, and false colours, are those of the box.
    let affine = picture(&["--ground", "--interpolation", "affine"]);
    let pairs = ground.pixels().zip(affine.pixels());
    let worst = pairs.flat_map(|(a, b)| (0..3).map(|k| a.0[k].abs_diff(b.0[k]))).max();
    assert!(worst <= Some(3), "{worst:?}");
    let seen = |more: &[&str]| {
        picture(&[&["--aov", "id"], more].concat());
        image::open(folder.path("alberti.id.png")).expect("numbers").to_rgb16()
    };
    assert_eq!(seen(&[]), seen(&["--ground"]));
    // False colours are seen by the camera of the picture that they explain.
    let camera = |more: &[&str]| {
        let run = folder.succeeds(&[&["box.obj", "--ground", "--size", "90x90"], more].concat());
        // Its planes are around what is drawn.
        let told = run.stdout.lines().find(|line| line.starts_with("camera: ")).map(str::to_owned);
        told.and_then(|line| Some(line.split_once(" --near")?.0.to_owned()))
    };
    assert!(camera(&[]).is_some());
    assert_eq!(camera(&["--show", "triangles"]), camera(&[]));
    for (more, told) in [
        (&["--show", "overdraw"][..], "--ground: found it with --show"),
        (&["--eye", "0,-4,9"], "--ground: found a camera below the model's lowest point"),
        (&["--profile", "mcu"], "--ground: found a shadow in rgb565 without a dither"),
        (&["--profile", "mcu", "--dither", "blue-noise"], ""),
    ] {
        let run = folder.succeeds(&[&view[..], &["--ground"], more].concat());
        assert!(run.stderr.contains(told) && run.stderr.is_empty() == told.is_empty(), "{run:?}");
    }
}

/// A floor of the scene's own has the shadow on it, and the ground beside it, and nothing else changes. Things that are
/// no floor stand on a ground.
#[test]
fn floors_have_shadows_on_them() {
    let scene = |floor: &str, ground: bool| {
        format!(
            "size = [64, 48]\nbackground = \"a0a0a0\"\n[render]\nsamples = 1\nground = {ground}\n[camera]\nelevation = 40\n\
             {floor}[[object]]\nsurface = \"sphere\"\nname = \"ball\"\nposition = [0, 1, 0]\n"
        )
    };
    let floor = "[[object]]\nsurface = \"plane\"\nsize = [6, 6]\n";
    let shelf = "[[object]]\nsurface = \"plane\"\nsize = [4, 4]\nposition = [0, 3, 0]\n";
    let upside_down = "[[object]]\nsurface = \"plane\"\nsize = [4, 4]\nrotation = [180, 0, 0]\n";
    // But for the planes, between which there is more.
    let camera = |run: &crate::Run| {
        let line = run.stdout.lines().nth(1)?;
        Some(line.split(" --near").next()?.to_owned())
    };
    let beside = "[[object]]\nsurface = \"plane\"\nsize = [6, 6]\nposition = [-5, 0, 0]\n";
    let sunk = "[[object]]\nsurface = \"plane\"\nsize = [6, 6]\nposition = [0, 0.1, 0]\n";
    let motion = "[[animation]]\nof = \"ball\"\nkey = \"position\"\ntimes = [0, 1]\nvalues = [[0, 1, 0], [0, 1.5, 0]]\n";
    for (floor, motion, is_floor) in [
        (floor, "", true),
        (floor, motion, true),
        (sunk, "", true),
        (beside, "", true),
        (shelf, "", false),
        (upside_down, "", false),
        ("", "", false),
    ] {
        let texts = [true, false].map(|ground| scene(floor, ground) + motion);
        let folder = Folder::with(&[("s.toml", texts[0].as_bytes()), ("bare.toml", texts[1].as_bytes())]);
        let runs = ["s", "bare"]
            .map(|name| folder.succeeds(&[format!("{name}.toml"), "-o".to_owned(), format!("{name}.png")]));
        assert!(runs.iter().all(|run| run.stderr.is_empty()), "{runs:?}");
        assert_eq!(camera(&runs[0]) == camera(&runs[1]), is_floor, "{runs:?}");
        if is_floor {
            let [with, without] = ["s.png", "bare.png"]
                .map(|name| image::open(folder.path(name)).expect("a picture").to_rgb8());
            let pairs = || with.pixels().zip(without.pixels()).map(|(a, b)| [a.0, b.0]);
            assert!(pairs().all(|[with, without]| with.iter().zip(without).all(|(a, b)| *a <= b)));
            let darker = pairs().filter(|[with, without]| u32::from(with[0]) * 5 < u32::from(without[0]) * 4);
            assert!((40..800).contains(&darker.count()));
        }
    }
}

/// The same face in either space, by the relations of each in `f64`; by an option and by a key of a scene.
#[test]
fn light_is_added_up_in_linear_space() {
    let decoded = |s: f64| if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) };
    let encoded = |x: f64| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    let scene = |intensity: f64, key: &str| {
        format!(
            "[camera]\neye = [0, 0, 3]\ntarget = [0, 0, 0]\n[[object]]\nsurface = \"plane\"\nrotation = [90, 0, 0]\n\
             material = \"m\"\n[material.m]\ncolor = \"c08040\"\n[ambient]\ncolor = \"806040\"\nintensity = 0.5\n\
             [[light]]\nkind = \"directional\"\ndirection = [0, -0.8, -0.6]\ncolor = \"c0ffe0\"\n\
             intensity = {intensity}\n[render]\nsize = [32, 32]\nsamples = 1\n{key}"
        )
    };
    let texts = [0.9, 6.0, 9.0]
        .map(|intensity| [scene(intensity, ""), scene(intensity, "light-space = \"linear\"\n")]);
    let middle = |text: &str, more: &[&str]| {
        let folder = Folder::with(&[("s.toml", text.as_bytes())]);
        folder.succeeds(&[&["s.toml"], more].concat());
        image::open(folder.path("alberti.png")).expect("a picture").to_rgb8().get_pixel(16, 16).0
    };
    for ([plain, keyed], intensity) in texts.iter().zip([0.9, 6.0, 9.0]) {
        let linear = middle(keyed, &[]);
        assert_eq!(middle(plain, &["--light-space", "linear"]), linear);
        assert_eq!(middle(keyed, &["--light-space", "srgb"]), middle(plain, &[]));
        let channels = [(0xc0, 0x80, 0xc0), (0x80, 0x60, 0xff), (0x40, 0x40, 0xe0)];
        let sum = |of: &dyn Fn(f64) -> f64| {
            channels.map(|(own, ambient, light)| {
                let [own, ambient, light] = [own, ambient, light].map(|byte| of(f64::from(byte) / 255.0));
                own * (0.5 * ambient + 0.6 * intensity * light)
            })
        };
        let bytes = middle(plain, &[]);
        for (found, exact) in bytes.into_iter().zip(sum(&|s| s)) {
            assert!((f64::from(found) - (255.0 * exact).min(255.0)).abs() < 0.6, "{bytes:?}");
        }
        let light = sum(&decoded);
        let peak = light.into_iter().fold(0.0, f64::max);
        let new = if peak > 0.8 { 1.0 - 0.04 / (peak - 0.6) } else { peak };
        let white = 1.0 - 1.0 / (1.0 + 0.15 * (peak - new));
        for (found, exact) in linear.into_iter().zip(light) {
            let shown = exact * new / peak * (1.0 - white) + new * white;
            assert!((f64::from(found) - 255.0 * encoded(shown)).abs() < 0.7, "{linear:?} {light:?}");
        }
    }
    let [_, [six, _], [nine, _]] = &texts;
    let [six, nine] = [six, nine].map(|text| middle(text, &["--light-space", "linear"]));
    assert!(six != nine && six.iter().max() < Some(&255), "{six:?} {nine:?}");
    // Without light there is no space of it.
    let unlit =
        ["linear", "srgb"].map(|space| middle(&texts[0][0], &["--shading", "unlit", "--light-space", space]));
    assert_eq!(unlit[0], unlit[1]);
    let folder = Folder::with(&[("s.toml", texts[0][0].as_bytes())]);
    folder.fails(&["s.toml", "--light-space", "gamma"], &["--light-space", "srgb", "linear"]);
}

/// What is said of a pixel in linear light is what is drawn there.
#[test]
fn linear_light_is_explained() {
    let folder = Folder::with(&[("sheet.obj", sheet(true).as_bytes())]);
    for shading in ["lambert", "blinn", "gouraud"] {
        let arguments = ["sheet.obj", "--shading", shading, "--light-space", "linear", "--pixel", "320,240"];
        let run = alberti(folder.path("").as_path(), &[OsStr::new("explain")], &arguments);
        assert_eq!(run.status, Some(0), "{run:?}");
        assert!(run.stdout.contains("amounts of light"), "{run:?}");
        assert!(
            run.stdout
                .ends_with("the derived colour is that of the picture with one sample a pixel, to the bit\n"),
            "{run:?}"
        );
    }
}
