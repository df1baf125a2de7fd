//! Pictures of which something is missing: all of the model, smooth edges, the order of glass, or the effect of an
//! option.

use crate::{Folder, TRIANGLE};

#[test]
fn a_picture_of_nothing_says_why() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    for (more, why) in [
        (&["--eye", "9,0,0", "--target", "9,9,0"][..], "all of it is outside the view"),
        (&["--near", "50", "--far", "60"], "all of it is outside the view"),
        (&["--cull", "front", "--view", "front"], "its faces are left out by --cull"),
        (&["--view", "top"], "its faces are seen edge-on"),
    ] {
        let run = folder.succeeds(&[&["m.obj", "-s", "40x30"], more].concat());
        assert!(run.stderr.contains("warning: found nothing of the model in the picture"), "{run:?}");
        assert!(run.stderr.contains(why) && run.stderr.lines().count() == 1, "{why}: {run:?}");
    }
    let run = folder.succeeds(&["m.obj", "-s", "40x30"]);
    assert_eq!(run.stderr, "");
}

#[test]
fn pictures_too_large_for_several_samples_say_so() {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    let run = folder.succeeds(&["m.obj", "-s", "8193x4", "--stats", "json"]);
    assert!(run.stderr.contains("--size: found a picture of 8193x4, too large for 4 samples"), "{run:?}");
    let samples = |run: &crate::Run| {
        serde_json::from_str::<serde_json::Value>(&run.stdout).map(|json| json["samples"].clone())
    };
    assert_eq!(samples(&run).ok(), Some(1.into()));
    for (given, samples_of) in [(&["-s", "8193x4", "--samples", "1"][..], 1), (&["-s", "9x8192"], 4)] {
        let run = folder.succeeds(&[&["m.obj", "--stats", "json"], given].concat());
        assert_eq!((samples(&run).ok(), &run.stderr[..]), (Some(samples_of.into()), ""));
    }
}

/// A glass cube around another, seen through four sides: in either order of the file each is mixed with what is behind.
#[test]
fn glass_in_glass_is_mixed_from_behind() {
    let cube = |name: &str, size: f64, first: usize| {
        let corners = (0..8).map(|k| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { size } else { -size }));
        let corners: String = corners.map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
        let sides = ["4 5 7 6", "0 2 3 1", "1 3 7 5", "0 4 6 2", "2 6 7 3", "0 1 5 4"];
        let side = |side: &&str| {
            let corners: Vec<_> = side
                .split(' ')
                .map(|k| (first + k.parse::<usize>().expect("a number")).to_string())
                .collect();
            format!("f {}\n", corners.join(" "))
        };
        let faces: String = sides.iter().map(side).collect();
        format!("{corners}usemtl {name}\n{faces}")
    };
    let orders = [
        [cube("outer", 1.0, 1), cube("inner", 0.5, 9)].concat(),
        [cube("inner", 0.5, 1), cube("outer", 1.0, 9)].concat(),
    ];
    let mtl = b"newmtl outer\nKd 0 0 1\nd 0.5\nnewmtl inner\nKd 1 1 0\nd 0.5\n";
    for projection in ["perspective", "parallel"] {
        for order in &orders {
            let obj = format!("mtllib m.mtl\n{order}");
            let folder = Folder::with(&[("m.obj", obj.as_bytes()), ("m.mtl", mtl)]);
            let view =
                ["m.obj", "--view", "front", "-s", "33x33", "--background", "black", "--shading", "unlit"];
            folder.succeeds(&[&view[..], &["--projection", projection]].concat());
            let picture = image::open(folder.path("alberti.png")).expect("a picture").to_rgb8();
            // Blue over black, yellow twice, and blue: alpha is 128/255.
            let mut color = [0.0_f64; 3];
            for over in [[0.0, 0.0, 255.0], [255.0, 255.0, 0.0], [255.0, 255.0, 0.0], [0.0, 0.0, 255.0]] {
                color = [0, 1, 2].map(|k: usize| color[k] + (over[k] - color[k]) * 128.0 / 255.0);
            }
            let found = picture.get_pixel(16, 16).0;
            let off = [0, 1, 2].map(|k: usize| (f64::from(found[k]) - color[k]).abs());
            assert!(off.iter().all(|off| *off < 2.5), "{projection}: {found:?} for {color:?}");
        }
    }
}

/// Options without an effect are told, and are without one.
#[test]
fn options_that_change_nothing_are_told() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    let folder = Folder::with(&[("m.obj", square.as_bytes())]);
    let steep = image::RgbImage::from_fn(4, 4, |x, y| {
        image::Rgb([[10, 90, 180, 250][x as usize], 60 + u8::from(y > 1) * 90, 200])
    });
    steep.save(folder.path("n.png")).expect("a map for the test");
    let draw = |options: &str, output: &str| {
        let words: Vec<&str> = options.split_whitespace().chain(["-s", "40x30", "-o", output]).collect();
        folder.succeeds(&[&["m.obj"], &words[..]].concat()).stderr
    };
    let picture = |name: &str| std::fs::read(folder.path(name)).expect("a picture");
    for (base, idle, told) in [
        (
            "--shading unlit",
            "--light 10,20",
            "--light: found it with --shading unlit, which is without light",
        ),
        (
            "--shading unlit",
            "--light-space linear --normal-map n.png",
            "--light-space: found it and --normal-map ",
        ),
        ("--shading unlit", "--two-sided=false", "--two-sided: found it with"),
        ("--shading unlit", "--specular fff --shininess 3", "--specular: found it and --shininess with"),
        (
            "--shading lambert",
            "--shininess 3",
            "--shininess: found it with --shading lambert, which is without hi",
        ),
        (
            "--shading lambert",
            "--specular fff --shininess-map n.png",
            "--specular: found it and --shininess-map",
        ),
        (
            "--texture n.png --filter nearest",
            "--lod run",
            "--lod: found it with --filter nearest, which has one",
        ),
        ("--texture n.png", "--dither bayer", "--dither: found it with --color rgba8, whose steps are"),
        ("--show overdraw", "--samples 16", "--samples: found it with --show, which has one sample a pixel"),
        ("--show overdraw", "--background red", "--background: found it with --show, which"),
        (
            "--texture n.png --show lod",
            "--light 10,20 --fog linear:1,9 --ao n.png --normal-map n.png",
            "--fog: found it and --light, --normal-map, --ao with --show of a number",
        ),
        (
            "--show triangles",
            "--texture n.png --filter nearest --wrap clamp --lod run --normals flat",
            "--normals: found it and --texture, --filter, --wrap, --lod with --show of a number",
        ),
        ("--shading unlit", "--normals flat", "--normals: found it with --shading unlit"),
        ("--show overdraw", "--diffuse f00", "--diffuse: found it with --show of a number"),
        ("--shading unlit", "--height-map n.png", "--height-map: found it with --shading unlit"),
        (
            "--shading unlit",
            "--filter nearest --wrap mirror",
            "--filter: found it and --wrap on a model without",
        ),
        ("", "--lod run", "--lod: found it on a model without textures"),
        ("--fog none", "--fog-color f00", "--fog-color: found it with --fog none"),
        (
            "--show triangles",
            "--color rgb565 --projector n.png --projector-eye 0,0,9 --projector-target 0,0,0",
            "--color: found it and --projector with --show of a number",
        ),
    ] {
        assert_eq!(draw(base, "a.png"), "", "{base}");
        let warning = draw(&format!("{base} {idle}"), "b.png");
        assert!(warning.starts_with(&format!("warning: {told}")), "{idle}: {warning}");
        assert!(
            warning.ends_with("; nothing changes\n") && warning.lines().count() == 1,
            "{idle}: {warning}"
        );
        assert!(picture("a.png") == picture("b.png"), "{base} {idle}");
    }
    let scene = "[render]\nlight = \"lamp\"\n[[object]]\nsurface = \"sphere\"\n[ambient]\n[[light]]\n\
        kind = \"directional\"\ndirection = [0, -1, 0]\n";
    std::fs::write(folder.path("s.toml"), scene).expect("a scene");
    let warning = folder.succeeds(&["s.toml", "-s", "40x30"]).stderr;
    assert!(
        warning.starts_with("warning: s.toml:2: render.light: found it in a scene with lights"),
        "{warning}"
    );
    // But not where the command line asks for another picture of it.
    for (file, line, told) in [
        ("light = \"lamp\"\nshading = \"unlit\"", "", 1),
        ("light = \"lamp\"", "--shading unlit", 0),
        ("light = \"lamp\"\nsamples = 1\nbackground = \"red\"", "--show overdraw", 0),
        ("shading = \"unlit\"", "--light lamp", 1),
        ("", "--shading unlit --light lamp", 1),
    ] {
        let scene = format!("[render]\n{file}\n[[object]]\nsurface = \"sphere\"\n");
        std::fs::write(folder.path("s.toml"), scene).expect("a scene");
        let words: Vec<&str> = line.split_whitespace().collect();
        let run = folder.succeeds(&[&["s.toml", "-s", "40x30"], &words[..]].concat());
        assert_eq!(run.stderr.matches("nothing changes").count(), told, "{file} {line}: {run:?}");
    }
    for used in [
        "--shading blinn --specular fff --shininess 3 --light 10,20 --light-space linear",
        "--shading lambert --normal-map n.png --ao n.png --two-sided=false",
        "--texture n.png --lod run",
        "--show error --background red",
        "--projector n.png --projector-eye 0,0,3 --projector-target 0.5,0.5,0 --filter nearest --wrap clamp",
        "--texture n.png --color rgb565 --dither bayer",
    ] {
        assert_eq!(draw(used, "c.png"), "", "{used}");
    }
}
