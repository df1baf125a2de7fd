//! `--show`: pictures in false colours and their legends.

use image::RgbImage;
use std::collections::HashMap;

use crate::{Folder, Run, TRIANGLE};

const ALL: [&str; 6] = ["error", "lod", "depth-step", "overdraw", "triangles", "policy"];

/// What is printed and drawn.
fn shown(arguments: &str) -> (Run, RgbImage) {
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes())]);
    let run = folder.succeeds(&arguments.split_whitespace().collect::<Vec<_>>());
    let picture = image::open(folder.path("alberti.png")).expect("a picture").to_rgb8();
    (run, picture)
}

/// The pixels of each colour.
fn colors(picture: &RgbImage) -> HashMap<String, u32> {
    let mut colors = HashMap::new();
    for pixel in picture.pixels() {
        let [r, g, b] = pixel.0;
        *colors.entry(format!("{r:02x}{g:02x}{b:02x}")).or_default() += 1;
    }
    colors
}

#[test]
fn the_legend_has_every_colour_and_its_share() {
    for (what, more) in [
        ("error", "--scene floor --up 1,1,0 --interpolation spans:32 --subpixel 4"),
        ("error", "--scene mesh --profile mcu"),
        ("lod", "--scene floor --filter trilinear"),
        ("lod", "--scene hero --interpolation bounded:0.25 --arithmetic fixed"),
        ("depth-step", "--scene floor --depth u16"),
        ("depth-step", "--scene cube --projection parallel"),
        ("overdraw", "--scene inside"),
        ("overdraw", "--scene hero --profile tiny"),
    ] {
        let (run, picture) = shown(&format!("--size 120x90 --show {what} {more}"));
        let mut lines = run.stdout.lines().skip(2);
        assert!(
            lines.next().is_some_and(|title| title.starts_with(what) && !title.starts_with("error:")),
            "{run:?}"
        );
        let mut left = colors(&picture);
        assert!(left.len() > 1, "{what} {more}");
        for line in lines.filter(|line| line.ends_with('%') && !line.contains("greatest")) {
            let words: Vec<_> = line.split_whitespace().collect();
            let share = f64::from(left.remove(words[0]).unwrap_or(0)) / (120.0 * 90.0) * 100.0;
            let said = words[words.len() - 2];
            let near = said.parse().map_or(share < 0.01, |said: f64| (said - share).abs() < 0.01);
            assert!(near && share > 0.0, "{what} {more}: {line} is {share}");
        }
        assert!(left.is_empty(), "{what} {more}: {left:?} in {}", run.stdout);
    }
}

#[test]
fn any_number_of_threads_shows_the_same() {
    for what in ALL {
        let at = |threads: &str| {
            let scene = "--scene mesh --size 100x80 --interpolation bounded:0.5";
            let (run, picture) = shown(&format!("{scene} --show {what} --threads {threads}"));
            (run.stdout.split_once('\n').map(|(_, legend)| legend.to_owned()), picture)
        };
        assert!(at("1") == at("4"), "{what}");
    }
}

/// Two pictures in true colours tell how far each pixel is off, and so which step it is in.
#[test]
fn errors_are_those_of_the_policies() {
    let (run, picture) = shown("--scene mesh --size 80x60 --profile reference --show error");
    assert!(run.stdout.contains("greatest 0, of "), "{run:?}");
    assert_eq!(colors(&picture).len(), 2);
    for (scene, policies) in [("cube", "--color rgb565"), ("hero", "--interpolation affine --depth u16")] {
        let scene = format!("--scene {scene} --size 80x60 --samples 1");
        let (run, picture) = shown(&format!("{scene} {policies} --show error"));
        let [found, precise] = [policies, "--profile reference"].map(|p| shown(&format!("{scene} {p}")).1);
        // A pixel that neither draws on is white, and is none of those that are counted.
        let drawn = [policies, "--profile reference"].map(|p| {
            let (_, overdraw) = shown(&format!("{scene} {p} --show overdraw").replace("--samples 1", ""));
            overdraw.pixels().map(|pixel| pixel.0 != [255; 3]).collect::<Vec<_>>()
        });
        let drawn: Vec<bool> = drawn[0].iter().zip(&drawn[1]).map(|(a, b)| a | b).collect();
        let count = drawn.iter().filter(|drawn| **drawn).count();
        let mut steps = HashMap::new();
        let mut greatest = 0;
        for (((shown, found), precise), drawn) in
            picture.pixels().zip(found.pixels()).zip(precise.pixels()).zip(drawn)
        {
            if !drawn {
                assert_eq!(shown.0, [255; 3]);
                continue;
            }
            let off = found.0.iter().zip(precise.0).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0);
            greatest = greatest.max(off);
            let color = *steps.entry(off.checked_ilog2()).or_insert(shown.0);
            assert_eq!(shown.0, color, "{off}");
        }
        assert!(run.stdout.contains(&format!("greatest {greatest}, of {count}")), "{run:?}");
        let nothing = usize::from(count < 4800);
        assert!(steps.len() > 3 && colors(&picture).len() == steps.len() + nothing, "{steps:?}");
    }
}

/// A triangle that faces the eye at ten units: z²/(65535 |β|) with β = AB/(B - A).
#[test]
fn resolutions_are_those_of_the_formula() {
    let (run, _) = shown(
        "m.obj --size 60x60 --eye 0.3,0.3,10 --target 0.3,0.3,0 --near 1 --far 100 --fov 10 --depth u16 \
         --show depth-step",
    );
    assert!(run.stdout.contains("by u16 between planes at 1 and 100"), "{run:?}");
    assert!(run.stdout.contains("least 0.00151, median 0.00151, greatest 0.00151"), "{run:?}");
    assert!(run.stdout.contains("  0.001 to 0.00316"), "{run:?}");
}

#[test]
fn a_triangle_alone_is_one_colour_on_white() {
    for what in ["overdraw", "triangles"] {
        let (run, picture) = shown(&format!("m.obj --size 60x60 --show {what}"));
        let found = colors(&picture);
        assert!(found.len() == 2 && found.contains_key("ffffff"), "{what}: {found:?}");
        assert!(what != "triangles" || run.stdout.contains("1 of 1 triangles are seen"), "{run:?}");
    }
}

/// On a row of the picture, as wide as its triangles, a division is where the shade changes.
#[test]
fn divisions_are_where_shades_change() {
    let scene = "--scene floor --size 160x120 --shading vertex-color --show policy --interpolation";
    let changes = |policy: &str| {
        let (run, picture) = shown(&format!("{scene} {policy}"));
        // The lowest row, which the floor fills.
        let row: Vec<_> = (0..160).map(|x| picture.get_pixel(x, 119).0).collect();
        (run, (1..160).filter(|&x| row[x - 1] != row[x]).collect::<Vec<_>>())
    };
    let (run, found) = changes("spans:16");
    assert_eq!(run.stderr, "");
    let multiples = found.iter().filter(|&&x| x % 16 == 0).count();
    assert_eq!(multiples, 9, "{found:?}");
    let (run, found) = changes("exact");
    assert_eq!(found.len(), 159);
    let warning = "warning: --show: found policy with --interpolation exact, expected spans:N or bounded:TEXELS; \
                   every pixel is a run of its own\n";
    assert_eq!(run.stderr, warning);
    let (run, _) = changes("affine");
    assert!(run.stdout.contains("triangle without a division in it"), "{run:?}");
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let folder = Folder::with(&[
        ("m.obj", TRIANGLE.as_bytes()),
        ("s.toml", b"[render]\nshow = \"lod\"\n[[object]]\nsurface = \"plane\"\n"),
    ]);
    let fails = |arguments: &str, part: &str| {
        folder.fails(&arguments.split(' ').collect::<Vec<_>>(), &[part]);
    };
    let textured = "error: --show: found lod of a model without a texture, expected a model with one; \
                    give it one with --texture";
    fails("m.obj --show lod", textured);
    fails("--scene cube --show lod", "error: --show: found lod");
    fails("--shading vertex-color --show lod", "error: --show: found lod with --shading vertex-color");
    let depth = "error: --show: found depth-step without a depth buffer, expected one; choose a format";
    fails("--show depth-step --depth none", depth);
    fails("--show depth-step --profile tiny", depth);
    fails("--show policy --arithmetic fixed", "error: --arithmetic: found fixed with exact");
    fails("--show error --stats", "error: --show: found it with --stats");
    fails("--show error --stats json", "error: --show: found it with --stats");
    fails("s.toml", "s.toml:2: ");
    let run = folder.render(&["--show", "heat"]);
    assert!(run.status == Some(2) && run.stderr.contains("depth-step"), "{run:?}");
}

/// A floor of two triangles, which the near plane cuts in three, has a level for each pixel, for each row of a
/// triangle, or for each of the three.
#[test]
fn levels_are_found_where_the_policy_says() {
    let levels = |lod: &str| {
        shown(&format!("--scene floor --size 120x90 --filter trilinear --lod {lod} --show lod")).1
    };
    let [pixel, run, triangle] = ["pixel", "run", "triangle"].map(levels);
    assert!(colors(&pixel).len() > 6, "{:?}", colors(&pixel));
    // And the background.
    assert!((3..=4).contains(&colors(&triangle).len()), "{:?}", colors(&triangle));
    assert!(run != pixel && colors(&run).len() > 6);
    for row in run.rows() {
        let changes = row.clone().zip(row.skip(1)).filter(|(a, b)| a != b);
        // From the background to a triangle, to the others, and to the background.
        assert!(changes.count() <= 4);
    }
}
