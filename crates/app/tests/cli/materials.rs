//! Materials of MTL files, as they come out in pictures.

use std::fs;

use crate::Folder;

/// A square that fills the picture, with two triangles in the order in which they are given.
const SQUARE: &str = "mtllib m.mtl\nv -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n\
    usemtl a\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n";

/// It is seen along its normal.
const FRONT: [&str; 10] =
    ["--eye", "0,0,9", "--target", "0,0,0", "--fov", "40", "--size", "16x16", "--background", "204060"];

fn png(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let image = image::RgbaImage::from_fn(width, height, |x, y| image::Rgba(texel(x, y)));
    let mut png = std::io::Cursor::new(Vec::new());
    image.write_to(&mut png, image::ImageFormat::Png).expect("a picture in memory");
    png.into_inner()
}

fn folder(obj: &str, mtl: &str) -> Folder {
    Folder::with(&[("m.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes())])
}

/// The picture from the front, and the warnings.
fn seen(folder: &Folder, more: &[&str]) -> (image::RgbImage, String) {
    let run = folder.succeeds(&[&["m.obj"], &FRONT[..], more].concat());
    (image::open(folder.path("alberti.png")).expect("a picture").to_rgb8(), run.stderr)
}

/// Columns of grey.
const GREYS: [[u8; 4]; 4] =
    [[255, 255, 255, 255], [128, 128, 128, 255], [0, 0, 0, 255], [128, 128, 128, 255]];

fn near([r, g, b]: [u8; 3], expected: [f64; 3]) -> bool {
    [r, g, b].into_iter().zip(expected).all(|(found, expected)| (f64::from(found) - expected).abs() <= 1.0)
}

const BEHIND: [f64; 3] = [32.0, 64.0, 96.0];

/// `d` and `Tr` are shares of the colour over the background.
#[test]
fn glass_is_mixed_with_what_is_behind() {
    for (line, share) in
        [("d 0.3", 0.3), ("Tr 0.7", 0.3), ("D 0.3\nTr 0.1", 0.3), ("d 1", 1.0), ("Tr 0", 1.0)]
    {
        let folder = folder(SQUARE, &format!("newmtl a\nKd 1 0.5 0\n{line}\n"));
        let (picture, warnings) = seen(&folder, &["--shading", "unlit"]);
        let color = [255.0, 127.5, 0.0];
        let expected = [0, 1, 2].map(|k| share * color[k] + (1.0 - share) * BEHIND[k]);
        assert!(near(picture.get_pixel(8, 8).0, expected), "{line} {:?}", picture.get_pixel(8, 8));
        assert_eq!(warnings, "");
    }
}

/// The same picture, whichever of two panes of one object comes first in the file: the farther one is drawn first.
#[test]
fn panes_are_sorted() {
    let pane = |z: f32, material: &str| {
        format!("v -9 -9 {z}\nv 9 -9 {z}\nv 0 9 {z}\nusemtl {material}\nf -3 -2 -1\n")
    };
    let mtl = "newmtl a\nKd 1 0 0\nd 0.5\nnewmtl b\nKd 0 1 0\nd 0.25\n";
    let expected = [0, 1, 2].map(|k| {
        let far = 0.25 * [0.0, 255.0, 0.0][k] + 0.75 * BEHIND[k];
        0.5 * [255.0, 0.0, 0.0][k] + 0.5 * far
    });
    for panes in [[pane(1.0, "a"), pane(-1.0, "b")], [pane(-1.0, "b"), pane(1.0, "a")]] {
        let folder = folder(&format!("mtllib m.mtl\n{}", panes.concat()), mtl);
        let (picture, _) = seen(&folder, &["--shading", "unlit"]);
        assert!(near(picture.get_pixel(8, 8).0, expected), "{:?}", picture.get_pixel(8, 8));
    }
    // In one part, in which the colours are those of the vertices.
    let colored = |z: f32, color: &str| {
        format!("v -9 -9 {z} {color}\nv 9 -9 {z} {color}\nv 0 9 {z} {color}\nf -3 -2 -1\n")
    };
    let [near, far] = [colored(1.0, "1 0 0"), colored(-1.0, "0 1 0")];
    let pictures = [[&near, &far], [&far, &near]].map(|panes| {
        let panes: String = panes.into_iter().map(String::as_str).collect();
        let folder = folder(&format!("mtllib m.mtl\nusemtl a\n{panes}"), "newmtl a\nKd 1 1 1\nd 0.5\n");
        seen(&folder, &["--shading", "unlit"]).0
    });
    assert_eq!(pictures[0], pictures[1]);
    let [r, g, _] = pictures[0].get_pixel(8, 8).0;
    assert!((135..=136).contains(&r) && (79..=81).contains(&g), "{r} {g}");
}

/// The alpha of a texture, of another image, or of either times `d`.
#[test]
fn alpha_of_textures_counts() {
    // Columns of alpha 255, 0, 0, 0; and 255, 128, 0, 128.
    let holes = png(4, 4, |x, _| [250, 250, 250, if x == 0 { 255 } else { 0 }]);
    let shades = png(4, 4, |x, _| [250, 250, 250, [255, 128, 0, 128][x as usize]]);
    let grey = png(4, 4, |x, _| GREYS[x as usize]);
    let wide = png(8, 8, |_, _| [250, 250, 250, 255]);
    let plain = png(1, 1, |_, _| [250, 250, 250, 255]);
    let alpha = |mtl: &str, column: u32| {
        let folder = folder(SQUARE, &format!("newmtl a\nKd 1 1 1\n{mtl}\n"));
        for (name, bytes) in [
            ("holes.png", &holes),
            ("shades.png", &shades),
            ("grey.png", &grey),
            ("plain.png", &plain),
            ("wide.png", &wide),
        ] {
            fs::write(folder.path(name), bytes).expect("a file");
        }
        // The whole square: it is 18 wide, and so is what is seen at a distance of 9.
        let whole = ["m.obj", "--eye", "0,0,9", "--target", "0,0,0", "--fov", "90", "--size", "16x16"];
        let rest = ["--background", "204060", "--shading", "unlit", "--filter", "nearest"];
        let warnings = folder.succeeds(&[&whole[..], &rest].concat()).stderr;
        let picture = image::open(folder.path("alberti.png")).expect("a picture").to_rgb8();
        assert_eq!(warnings, "");
        let found = f64::from(picture.get_pixel(2 + 4 * column, 8).0[0]);
        (found - BEHIND[0]) / (250.0 - BEHIND[0])
    };
    let eq = |found: f64, expected: f64| assert!((found - expected).abs() < 0.01, "{found} {expected}");
    for (mtl, expected) in [
        ("map_Kd holes.png", [1.0, 0.0, 0.0, 0.0]),
        ("map_Kd shades.png", [1.0, 0.5, 0.0, 0.5]),
        ("map_Kd wide.png\nmap_d grey.png", [1.0, 0.5, 0.0, 0.5]),
        ("map_Kd wide.png\nmap_d holes.png", [1.0, 0.0, 0.0, 0.0]),
        ("map_Kd plain.png\nmap_d grey.png", [1.0, 0.5, 0.0, 0.5]),
        ("map_Kd holes.png\nd 0.5", [0.5, 0.0, 0.0, 0.0]),
        ("map_Kd shades.png\nd 0.5", [0.5, 0.25, 0.0, 0.25]),
        ("map_Kd plain.png", [1.0; 4]),
    ] {
        for (column, expected) in (0..4).zip(expected) {
            eq(alpha(mtl, column), expected);
        }
    }
    for (column, expected) in (0..4).zip([1.02, 0.51, 0.0, 0.51]) {
        eq(alpha("map_d grey.png", column), expected);
    }
    // At u = 0.625, 1.625 and so on: its third texel, and beyond its edge the last.
    for (column, expected) in (0..4).zip([0.0, 0.51, 0.51, 0.51]) {
        eq(alpha("map_d -clamp on -s 4 1 1 grey.png", column), expected);
    }
}

/// Of a white lamp along the normal, a surface with `Ks` has a highlight in the middle; one without has none.
#[test]
fn highlights_need_not_be_asked_for() {
    let bright = |mtl: &str, more: &[&str]| {
        let folder = folder(SQUARE, &format!("newmtl a\nKd 0.4 0.4 0.4\n{mtl}\n"));
        for (name, grey) in [("black.png", 0), ("dark.png", 4), ("white.png", 255)] {
            fs::write(folder.path(name), png(1, 1, |_, _| [grey, grey, grey, 255])).expect("a file");
        }
        let (picture, _) = seen(&folder, more);
        picture.pixels().map(|pixel| pixel.0[0]).max().unwrap_or(0)
    };
    let matt = bright("", &["--shading", "lambert"]);
    for mtl in ["", "Ks 0 0 0\nNs 50", "Ks 0.5 0.5 0.5\nNs 0", "Ks 0.5 0.5 0.5\nNs 10\nillum 1"] {
        assert_eq!(bright(mtl, &[]), matt, "{mtl}");
    }
    for mtl in ["Ks 0.5 0.5 0.5\nNs 10", "ks 0.5 0.5 0.5\nns 10\nillum 2", "Pr 0.5"] {
        assert!(bright(mtl, &[]) > matt + 3, "{mtl} {}", bright(mtl, &[]));
        assert_eq!(bright(mtl, &["--shading", "lambert"]), matt, "{mtl}");
    }
    // A map of exponents fades as the exponents themselves do: to nothing at 0, and to an eighth at 1.
    let shine = "Ks 0.8 0.8 0.8\nNs 64\nmap_Ns";
    assert_eq!(bright(&format!("{shine} black.png"), &[]), matt);
    let faded = bright("Ks 0.8 0.8 0.8\nNs 1", &[]);
    assert!(bright(&format!("{shine} dark.png"), &[]).abs_diff(faded) <= 1, "{faded}");
    assert_eq!(bright(&format!("{shine} white.png"), &[]), bright("Ks 0.8 0.8 0.8\nNs 64", &[]));
    // So does an option, which takes the place of the file's.
    assert_eq!(bright("Ks 0.8 0.8 0.8\nNs 64", &["--shininess", "1"]), faded);
    assert_eq!(bright("Ks 0.8 0.8 0.8\nNs 1", &["--shininess", "64"]), bright("Ks 0.8 0.8 0.8\nNs 64", &[]));
}

/// The texture is multiplied by `Kd`, unless that is grey. Where the texture is not there, it is the colour.
#[test]
fn textures_are_multiplied_by_kd() {
    let shown = |kd: &str, more: &[&str]| {
        let folder = folder(SQUARE, &format!("newmtl a\n{kd}\nmap_Kd c.png\n"));
        fs::write(folder.path("c.png"), png(1, 1, |_, _| [200, 100, 50, 255])).expect("a file");
        let (picture, warnings) = seen(&folder, &[&["--shading", "unlit"], more].concat());
        (picture.get_pixel(8, 8).0, warnings)
    };
    assert_eq!(shown("", &[]), ([200, 100, 50], String::new()));
    let (found, warnings) = shown("Kd 0.5 1 0", &[]);
    assert!(near(found, [100.0, 100.0, 0.0]) && warnings.is_empty(), "{found:?} {warnings}");
    for grey in ["Kd 0 0 0", "Kd 0.64"] {
        assert_eq!(shown(grey, &[]), ([200, 100, 50], String::new()));
        assert_eq!(shown(grey, &["--diffuse", "00ff00"]).0, [0, 100, 0]);
    }
    let folder = folder(SQUARE, "newmtl a\nKd 0.5\nmap_Kd gone.png\n");
    let (picture, warnings) = seen(&folder, &["--shading", "unlit"]);
    assert!(picture.get_pixel(8, 8).0 == [128; 3] && warnings.contains("gone.png"), "{warnings}");
}

/// Colours of vertices multiply the material's, under the light that falls on white.
#[test]
fn colours_of_vertices_show() {
    let square = |color: &str| {
        let corner = |[x, y]: [i32; 2]| format!("v {x} {y} 0 {color}\n");
        let corners = [[-9, -9], [9, -9], [9, 9], [-9, 9]].map(corner).concat();
        format!("mtllib m.mtl\n{corners}vn 0 0 1\nusemtl a\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n")
    };
    let mtl = "newmtl a\nKd 1 0.5 1\n";
    let pixel = |color: &str, more: &[&str]| {
        seen(&folder(&square(color), mtl), more).0.get_pixel(8, 8).0.map(f64::from)
    };
    for shading in ["lambert", "gouraud", "phong", "unlit"] {
        let more = ["--shading", shading, "--specular", "000000"];
        let [white, found] = ["1 1 1", "0.5 1 0.25"].map(|color| pixel(color, &more));
        let expected = [0.5 * white[0], white[1], 0.25 * white[2]];
        assert!(
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1.0),
            "{shading} {found:?} {expected:?}"
        );
    }
    // Unless an option gives all of it a colour.
    assert_eq!(pixel("0.5 1 0.25", &["--diffuse", "ff80ff", "--shading", "unlit"]), [255.0, 128.0, 255.0]);
    let asked = |color| seen(&folder(&square(color), mtl), &["--shading", "vertex-color"]).1;
    assert_eq!(asked("0.5 1 0.25"), "");
    assert!(
        asked("1 1 1").contains("--shading: found a model whose vertices have no colours"),
        "{}",
        asked("1 1 1")
    );
}

const STEPS: [u8; 4] = [0, 60, 120, 180];

/// `-s` and `-o` are those of coordinates that a file has itself.
#[test]
fn textures_are_scaled_and_moved() {
    let checks = png(4, 4, |x, y| [STEPS[x as usize], STEPS[y as usize], 9, 255]);
    let picture = |obj: &str, mtl: &str| {
        let folder = folder(obj, mtl);
        fs::write(folder.path("c.png"), &checks).expect("a file");
        seen(&folder, &["--filter", "nearest"]).0
    };
    let moved = SQUARE
        .replace("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1", "vt 0.5 0.25\nvt 2.5 0.25\nvt 2.5 3.25\nvt 0.5 3.25");
    let found = picture(SQUARE, "newmtl a\nKd 1 1 1\nmap_Kd -s 2 3 1 -o 0.5 0.25 0 c.png\n");
    assert_eq!(found, picture(&moved, "newmtl a\nKd 1 1 1\nmap_Kd c.png\n"));
    assert_ne!(found, picture(SQUARE, "newmtl a\nKd 1 1 1\nmap_Kd c.png\n"));
}

/// Names from other machines are found beside the library, and said; `--texture` has nothing to say of them.
#[test]
fn textures_are_found_under_other_names() {
    let blue = png(2, 2, |_, _| [0, 0, 200, 255]);
    for (name, warned) in [
        ("blue.png", false),
        ("\"blue.png\"", false),
        (".\\blue.png", false),
        ("Blue.PNG", true),
        ("C:\\art\\blue.png", true),
        ("/home/x/blue.png", true),
        ("\"D:\\my art\\BLUE.png\"", true),
    ] {
        let folder = folder(SQUARE, &format!("newmtl a\nKd 1 1 1\nmap_Kd {name}\n"));
        fs::write(folder.path("blue.png"), &blue).expect("a file");
        let (picture, warnings) = seen(&folder, &["--shading", "unlit"]);
        assert_eq!(picture.get_pixel(8, 8).0, [0, 0, 200], "{name}");
        assert_eq!(warnings.contains("\"blue.png\" is used"), warned, "{name} {warnings}");
        assert_eq!(warnings.is_empty(), !warned, "{name} {warnings}");
        assert_eq!(seen(&folder, &["--texture", "blue.png"]).1, "", "{name}");
    }
    let folder = folder(SQUARE, "newmtl a\nmap_Kd gone.png\nTf 1 0 1\n");
    fs::write(folder.path("blue.png"), &blue).expect("a file");
    assert_eq!(seen(&folder, &[]).1.lines().count(), 2);
    let warnings = seen(&folder, &["--texture", "blue.png"]).1;
    assert!(warnings.contains("m.mtl:3: found `Tf`") && warnings.lines().count() == 1, "{warnings}");
}

/// An option that no texture has is told, and the file behind it is used.
#[test]
fn unknown_options_of_textures_are_told() {
    let folder = folder(SQUARE, "newmtl a\nmap_Kd -zz 3 c.png\n");
    image::RgbImage::from_pixel(2, 2, image::Rgb([200, 100, 50]))
        .save(folder.path("c.png"))
        .expect("an image");
    let run = folder.succeeds(&["m.obj", "-s", "32x32", "--shading", "unlit", "-o", "a.png"]);
    let expected = "warning: m.mtl:2: found \"-zz 3\" before the file, expected an option of textures";
    assert!(run.stderr.starts_with(expected) && run.stderr.lines().count() == 1, "{run:?}");
    let picture = image::open(folder.path("a.png")).expect("a picture").into_rgb8();
    assert_eq!(picture.get_pixel(16, 16).0, [200, 100, 50]);
}

/// A disc in a texture whose clear texels are black, as programs write them, has no dark rim.
#[test]
fn holes_have_no_rims_of_their_own_colour() {
    let disc = |hole: [u8; 4]| {
        move |x: u32, y: u32| {
            let square = (2 * i64::from(x) - 31).pow(2) + (2 * i64::from(y) - 31).pow(2);
            if square < 700 { [40, 160, 40, 255] } else { hole }
        }
    };
    let drawn = |hole: [u8; 4], filter: &str| {
        let folder = folder(SQUARE, "newmtl a\nmap_Kd d.png\n");
        fs::write(folder.path("d.png"), png(32, 32, disc(hole))).expect("a texture");
        // All of the square is seen, the rim of the disc with it.
        let words =
            ["--size", "160x160", "--fov", "90", "--background", "white", "--shading", "unlit", "--filter"];
        seen(&folder, &[&words[..], &[filter]].concat()).0
    };
    for filter in ["bilinear", "trilinear"] {
        let [black, green] = [[0; 4], [40, 160, 40, 0]].map(|hole| drawn(hole, filter));
        assert!(black == green, "{filter}");
        let is_white = |pixel: &&image::Rgb<u8>| pixel.0 == [255; 3];
        assert!(black.pixels().filter(is_white).count() > 2000, "{filter}");
        // Between the disc and white, nothing is darker than the disc.
        assert!(black.pixels().all(|pixel| pixel.0[1] >= 159), "{filter}");
    }
}

/// A grating of which an eighth is there, each bar narrower than a pixel: an eighth of the light is held back.
#[test]
fn what_is_narrow_does_not_vanish_from_afar() {
    let folder = folder(SQUARE, "newmtl a\nmap_Kd bars.png\n");
    let bars = png(128, 128, |x, y| [0, 0, 0, if (x + y) % 16 < 2 { 255 } else { 0 }]);
    fs::write(folder.path("bars.png"), bars).expect("a texture");
    let light = |byte: u8| {
        let share = f64::from(byte) / 255.0;
        if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
    };
    // The square is 18 wide, so 16 of 160 pixels where 180 are seen.
    let line = "m.obj --eye 0,0,90 --target 0,0,0 --fov 90 --size 160x160 --background white --shading unlit -o a.png";
    for (samples, filter) in
        [("1", "trilinear"), ("1", "anisotropic:8"), ("4", "trilinear"), ("16", "trilinear")]
    {
        let words: Vec<_> = line.split(' ').chain(["--samples", samples, "--filter", filter]).collect();
        assert_eq!(folder.succeeds(&words).stderr, "");
        let picture = image::open(folder.path("a.png")).expect("a picture").into_rgb8();
        let held_back: f64 = picture.pixels().map(|pixel| 1.0 - light(pixel.0[0])).sum();
        assert!((held_back / 256.0 - 0.125).abs() < 0.02, "{samples} {filter}: {held_back}");
    }
    // Of several behind each other, each holds back as much of what comes through those behind it, where nothing of its
    // texels is left to be seen. They are as large as each other for parallel lines.
    let dots = png(512, 512, |x, y| [0, 0, 0, if x % 4 == 0 && y % 2 == 0 { 255 } else { 0 }]);
    fs::write(folder.path("dots.png"), dots).expect("a texture");
    fs::write(folder.path("m.mtl"), "newmtl a\nmap_Kd dots.png\n").expect("a library");
    let sheets = |count: u32| -> String {
        (0..count)
            .map(|k| {
                let (z, first) = (f64::from(k) * 0.01, 4 * k);
                let corner = |x, y| format!("v {x} {y} {z}\n");
                let corners = [corner(-9, -9), corner(9, -9), corner(9, 9), corner(-9, 9)].concat();
                let [a, b, c, d] = [1, 2, 3, 4].map(|k| first + k);
                format!("{corners}f {a}/1 {b}/2 {c}/3 {d}/4\n")
            })
            .collect()
    };
    let line = line.replace("--fov 90", "--projection parallel --view-height 180");
    for count in [2, 5, 12] {
        let model = format!("mtllib m.mtl\nusemtl a\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n{}", sheets(count));
        fs::write(folder.path("m.obj"), model).expect("a model");
        for samples in ["4", "16"] {
            folder.succeeds(&line.split(' ').chain(["--samples", samples]).collect::<Vec<_>>());
            let picture = image::open(folder.path("a.png")).expect("a picture").into_rgb8();
            let held_back: f64 = picture.pixels().map(|pixel| 1.0 - light(pixel.0[0])).sum();
            let expected = 1.0 - 0.875_f64.powi(i32::try_from(count).expect("few"));
            let ratio = held_back / 256.0 / expected;
            assert!((ratio - 1.0).abs() < 0.06, "{count} of {samples}: {ratio}");
        }
    }
    fs::write(folder.path("m.obj"), SQUARE).expect("a model");
    // The least alpha of a scene file is that of every level: it is what the file says.
    let scene = b"[[object]]\nmodel = \"m.obj\"\nmaterial = \"a\"\n[material.a]\ncolor-map = \"bars.png\"\n\
        alpha-test = 0.5\n";
    fs::write(folder.path("s.toml"), scene).expect("a scene");
    folder.succeeds(&[&["s.toml"][..], &line.split(' ').skip(1).collect::<Vec<_>>()].concat());
    let picture = image::open(folder.path("a.png")).expect("a picture").into_rgb8();
    assert!(picture.pixels().all(|pixel| pixel.0 == [255; 3]));
}
