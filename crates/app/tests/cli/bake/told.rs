//! What the command says: of things that a file has not, of defaults, and of what it made.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;

use alberti::Geometry;
use alberti::baked::{Baked, Texels, Uv};
use alberti::glam::Vec2;
use serde_json::Value;

use super::{bake, baked, folder, image, number};
use crate::{Folder, alberti};

/// A scene with all that a file has not, against the same without.
#[test]
fn what_a_file_has_not_is_told() {
    let pane = |z: i32, material: &str| {
        format!(
            "[[object]]\nsurface = \"plane\"\nrotation = [90, 0, 0]\nposition = [0, 0, {z}]\n\
             material = \"{material}\"\n"
        )
    };
    let panes = pane(0, "wall") + &pane(1, "glass") + &pane(2, "glass") + &pane(3, "lace");
    let materials = |glass: &str, lace: &str| {
        format!(
            "[material.wall]\n[material.glass]\ncolor = \"4080c0\"\n{glass}[material.lace]\n\
             color-map = \"white.png\"\n{lace}"
        )
    };
    let rest = "[render]\nshading = \"unlit\"\n";
    let full = materials("blend = \"constant:0.5\"\n", "blend = \"over\"\nalpha-test = 0.5\n");
    let full = format!("{panes}{full}{rest}fog = \"exp:0.1\"\n");
    let bare = format!("{panes}{}{rest}", materials("", ""));
    let files = [("s.toml", full.as_bytes()), ("bare.toml", bare.as_bytes())];
    let folder = Folder::with(&files);
    image::RgbImage::from_pixel(1, 1, image::Rgb([255; 3])).save(folder.path("white.png")).expect("an image");
    let run = bake(&folder, &["s.toml", "--json"]);
    assert_eq!(run.status, Some(0), "{run:?}");
    let lines: Vec<_> = run.stderr.lines().collect();
    assert_eq!(lines.len(), 4, "{run:?}");
    for (line, part) in lines.into_iter().zip([
        "s.toml: found a surface that is blended (\"",
        "s.toml: found a surface that is blended (\"",
        "s.toml: found a surface that has holes (\"lace\"), expected one without",
        "render.fog: found a fog, expected a scene without",
    ]) {
        assert!(line.starts_with("warning: ") && line.contains(part), "{part:?} is not in {line}");
    }
    // Frames are compared as the file has the scene.
    let report: Value = serde_json::from_str(&run.stdout).expect("one line of JSON");
    let (without, _) = baked(&folder, "bare", &["bare.toml"]);
    assert_eq!(report["lost"], without["lost"]);
    assert!(number(&report, "frame") <= 1.0, "{report}");
}

/// Colours of vertices that multiply a surface: told unless the file has them, and left out of the frames compared.
#[test]
fn colours_of_vertices_are_told() {
    let square = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 0\nf 1 2 3\nf 1 3 4\n";
    let folder = Folder::with(&[("square.obj", square.as_bytes())]);
    let of = |arguments: &[&str], warnings: usize| {
        let run = bake(&folder, &[&["square.obj", "--json"], arguments].concat());
        assert_eq!((run.status, run.stderr.lines().count()), (Some(0), warnings), "{run:?}");
        let found = "square.obj: found a surface that colours of its vertices multiply";
        assert_eq!(run.stderr.contains(found), warnings > 0, "{run:?}");
        let remedy = "no colours of vertices without `bake --attributes normal,color`";
        assert_eq!(run.stderr.contains(remedy), warnings > 0, "{run:?}");
        let report: Value = serde_json::from_str(&run.stdout).expect("one line of JSON");
        assert!(number(&report, "frame") <= 1.0, "{report}");
    };
    of(&[], 1);
    of(&["--attributes", "normal,color"], 0);
    of(&["--shading", "vertex-color"], 0);
}

/// Lights beside the one that programs have, and a projector's image: a line for each.
#[test]
fn lights_and_a_projector_are_told() {
    let lights = "[[light]]\nkind = \"point\"\nposition = [0, 3, 3]\n\
                  [[light]]\nkind = \"directional\"\ndirection = [0, -1, -1]\n\
                  [[light]]\nkind = \"directional\"\ndirection = [1, -1, -1]\n";
    let object = "[[object]]\nsurface = \"plane\"\nrotation = [90, 0, 0]\n";
    let slide = "[projector]\nimage = \"soft.png\"\neye = [0, 0, 3]\ntarget = [0, 0, 0]\n";
    let lit = format!("{object}{lights}{slide}[render]\nshading = \"lambert\"\n");
    let unlit = format!("{object}{lights}[render]\nshading = \"unlit\"\n");
    let files = [("lit.toml", lit.as_bytes()), ("unlit.toml", unlit.as_bytes()), ("soft.png", &image())];
    let folder = Folder::with(&files);
    let run = bake(&folder, &["lit.toml"]);
    let lines: Vec<_> = run.stderr.lines().collect();
    assert_eq!((run.status, lines.len()), (Some(0), 3), "{run:?}");
    for (line, part) in lines.into_iter().zip([
        "found a point light (light[0])",
        "found a further directional light (light[2])",
        "found a projector's image",
    ]) {
        assert!(line.starts_with("warning: ") && line.contains(part), "{part:?} is not in {line}");
    }
    let run = bake(&folder, &["unlit.toml"]);
    assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{run:?}");
}

#[test]
fn help_has_the_defaults_of_this_command() {
    let folder = Folder::with(&[]);
    let run = alberti(folder.0.path(), &[OsStr::new("help")], &["bake", "all"]);
    assert_eq!(run.status, Some(0), "{run:?}");
    let words = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    let defaults = ["320x240", "mcu", "the profile's"];
    for part in defaults {
        assert!(words.contains(&format!("[default: {part}]")), "{part} in {words}");
    }
    for part in ["640x480", "desktop]", "[default: exact]", "[default: float]", "[default: rgba8]"] {
        assert!(!words.contains(part), "{part} in {words}");
    }
}

/// Names are those of the options, and one thing is not several.
#[test]
fn the_report_has_the_words_of_the_options() {
    let folder = folder();
    for format in ["rgb444", "grey8", "grey2", "rgb565-pairs", "rgb888", "rgba8", "rgb565be", "indexed4"] {
        let arguments = ["m.obj", "--texture", "soft.png", "--texture-size", "64", "--format", format];
        let run = bake(&folder, &[&arguments[..], &["--color", "rgb565", "--band", "1"]].concat());
        assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{run:?}");
        for part in [
            &format!("texture 0, colour: 64x64 {format}, 1 level\n"),
            "1 of 1 triangle, 3 vertices,",
            "indices of 1 triangle\n",
            "bands of 1 row of 320 columns",
        ] {
            assert!(run.stdout.contains(part), "{part:?} is not in {}", run.stdout);
        }
    }
}

/// A floor of many repeats and a card upon it, of two materials.
const FLOOR_AND_CARD: &str = "mtllib m.mtl\n\
    v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\n\
    vt -50 -50\nvt 50 -50\nvt 50 50\nvt -50 50\nvt 0.125 0.25\nvt 0.9 0.25\nvt 0.9 0.75\nvt 0.125 0.75\n\
    usemtl floor\nf 4/4 3/3 2/2 1/1\nusemtl card\nf 5/5 6/6 7/7 8/8\n";
const MATERIALS: &str = "newmtl floor\nKd 0.5 0.5 0.5\nmap_Kd soft.png\nnewmtl card\nKd 1 0 0\n";

/// Each part has texture coordinates in steps of its own, in the file and in the source.
#[test]
fn a_floor_of_many_repeats_leaves_other_parts_as_fine() {
    let files =
        [("f.obj", FLOOR_AND_CARD.as_bytes()), ("m.mtl", MATERIALS.as_bytes()), ("soft.png", &image())];
    let folder = Folder::with(&files);
    let (_, file) = baked(&folder, "f", &["f.obj", "--attributes", "uv"]);
    let file = Baked::read(&file).expect("a file");
    let corners = |part: usize| {
        let mesh = file.parts().nth(part).expect("two parts").mesh::<Uv>().expect("coordinates");
        let mut all: Vec<_> = (0..mesh.vertices()).filter_map(|n| mesh.vertex(n)).map(|(_, uv)| uv).collect();
        all.sort_by(|a, b| a.to_array().map(f32::to_bits).cmp(&b.to_array().map(f32::to_bits)));
        all
    };
    let off = |found: &[Vec2], expected: [[f32; 2]; 4]| {
        let far = |uv: &Vec2| {
            let to = |corner: [f32; 2]| (Vec2::from_array(corner) - *uv).abs().max_element();
            expected.into_iter().map(to).fold(f32::MAX, f32::min)
        };
        assert_eq!(found.len(), 4, "{found:?}");
        found.iter().map(far).fold(0.0, f32::max)
    };
    // A hundred repeats are steps of 2^-9; one is steps of 2^-16.
    let floor = off(&corners(0), [[-50.0, -50.0], [50.0, -50.0], [50.0, 50.0], [-50.0, 50.0]]);
    let card = off(&corners(1), [[0.125, 0.25], [0.9, 0.25], [0.9, 0.75], [0.125, 0.75]]);
    assert!(floor <= 1.0 / 1024.0 && card > 0.0 && card <= 1.0 / 131_072.0, "{floor} {card}");
    let source = fs::read_to_string(folder.path("out/f.rs")).expect("the source");
    let halves: Vec<_> = source.split("pub fn mesh_").skip(1).collect();
    assert!(halves[0].contains("i32::from(u) << 7") && !halves[1].contains("<<"), "{source}");
}

/// An image has mip maps if any of its readers has a filter for them, whichever comes first.
#[test]
fn mip_maps_are_those_of_all_parts() {
    let object = |filter: &str| format!("[[object]]\nsurface = \"plane\"\nmaterial = \"{filter}\"\n");
    let material =
        |filter: &str| format!("[material.{filter}]\ncolor-map = \"soft.png\"\nfilter = \"{filter}\"\n");
    let levels = |filters: [&str; 2]| {
        let scene = filters.map(object).concat() + &filters.map(material).concat();
        let folder = Folder::with(&[("s.toml", scene.as_bytes()), ("soft.png", &image())]);
        let (_, file) = baked(&folder, "s", &["s.toml", "--attributes", "uv"]);
        let Some(Texels::Rgb565(map)) = Baked::read(&file).expect("a file").texture(0) else {
            panic!("Rgb565")
        };
        map.levels()
    };
    assert_eq!(levels(["nearest", "trilinear"]), 7);
    assert_eq!(levels(["trilinear", "nearest"]), 7);
    assert_eq!(levels(["nearest", "bilinear"]), 1);
}

/// Parts are passes: the report says how many, and names the chapter that has their lines.
#[test]
fn several_parts_are_told_as_passes() {
    let files =
        [("f.obj", FLOOR_AND_CARD.as_bytes()), ("m.mtl", MATERIALS.as_bytes()), ("soft.png", &image())];
    let folder = Folder::with(&files);
    let run = bake(&folder, &["f.obj"]);
    assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{run:?}");
    let passes = "\n2 passes a frame, as docs/bake.md has them under \"Several parts\":\n\n        \
                  0  2 triangles, 4 vertices, texture 0";
    assert!(run.stdout.contains(passes), "{}", run.stdout);
    assert!(run.stdout.contains("        1  2 triangles, 4 vertices, no texture"), "{}", run.stdout);
    assert!(include_str!("../../../../../docs/bake.md").contains("\n### Several parts\n"));
    let json: Value = serde_json::from_str(&bake(&folder, &["f.obj", "--json"]).stdout).expect("JSON");
    let of = |part: usize, key: &str| json["surfaces"][part][key].clone();
    assert_eq!((of(0, "texture"), of(1, "texture"), of(1, "vertices")), (0.into(), Value::Null, 4.into()));
    let run = bake(&self::folder(), &["ball.obj"]);
    assert!(run.status == Some(0) && !run.stdout.contains("passes"), "{}", run.stdout);
}

/// Instructions grow with the frame, from its edges to its pixels, and the report names what has no price.
#[test]
fn estimates_are_of_the_size_and_say_what_they_leave_out() {
    let folder = folder();
    let of = |size: &str| {
        let (report, _) = baked(&folder, "ball", &["ball.obj", "--texture", "soft.png", "--size", size]);
        let chips = report["chips"].as_array().expect("chips").clone();
        chips.iter().map(|chip| chip["instructions"].as_f64().expect("a number")).collect::<Vec<_>>()
    };
    let [small, middle, large] = ["160x120", "320x240", "640x480"].map(of);
    for ((small, middle), large) in small.into_iter().zip(middle).zip(large) {
        // Of a sum of a constant, a side and its square, differences grow by two to four.
        let growth = (large - middle) / (middle - small);
        assert!(small > 0.0 && growth > 2.0 && growth < 4.0, "{small} {middle} {large}");
    }
    // Light at vertices is an alternative where there is light, in fixed point.
    for (arguments, is_told) in
        [(&[][..], true), (&["--shading", "unlit"], false), (&["--profile", "reference"], false)]
    {
        let arguments = [&["ball.obj", "--texture", "soft.png"], arguments].concat();
        let (report, _) = baked(&folder, "ball", &arguments);
        for chip in report["chips"].as_array().expect("chips") {
            let [pixels, vertices] =
                ["instructions", "instructions_lit_at_vertices"].map(|key| chip[key].as_f64());
            assert_eq!(vertices.is_some(), is_told, "{arguments:?}");
            assert!(vertices.is_none_or(|count| count > 1e5 && Some(count * 2.0) < pixels), "{chip}");
        }
        let words = ",\nfound at pixels, or at the vertices and then on the nearest texel:";
        assert_eq!(bake(&folder, &arguments).stdout.contains(words), is_told, "{arguments:?}");
    }
    let of = |arguments: &[&str]| {
        let run = bake(&folder, &[&["ball.obj", "--texture", "soft.png"], arguments].concat());
        assert_eq!(run.status, Some(0), "{run:?}");
        run.stdout.lines().find(|line| line.starts_with("Not in these: ")).map(str::to_owned)
    };
    let bands = "setting up triangles again that reach into further bands.";
    assert_eq!(of(&["--band", "240"]), None);
    assert_eq!(of(&[]), Some(format!("Not in these: {bands}")));
    let found = of(&["--color", "rgb666", "--format", "indexed8"]);
    assert_eq!(found, Some(format!("Not in these: pixels of rgb666, texels of indexed8, {bands}")));
    let found = of(&["--filter", "anisotropic:4", "--band", "240"]);
    let probes = "Not in these: all but one of the probes of the anisotropic filter.";
    assert_eq!(found.as_deref(), Some(probes));
}

/// The report on docs/bake.md, of a model from beside the repository, where there is one.
#[test]
fn the_page_shows_what_is_told() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let models = root.join("../shared/models/spot");
    if !models.is_dir() {
        eprintln!("SKIPPED: no model in {}", models.display());
        return;
    }
    let folder = Folder::with(&[]);
    let clone = folder.path("clone");
    fs::create_dir(&clone).expect("a folder for the test");
    for (from, to) in [("spot_triangulated.obj", "spot.obj"), ("spot_texture.png", "spot.png")] {
        fs::copy(models.join(from), clone.join(to)).expect("a file of the model");
    }
    let page = fs::read_to_string(root.join("docs/bake.md")).expect("the page");
    let (_, shown) = page.split_once("$ cargo run --release -- ").expect("a command");
    let (command, shown) = shown.split_once('\n').expect("a report");
    let (report, _) = shown.split_once("```").expect("an end");
    let run = alberti(&clone, &[], &command.split(' ').collect::<Vec<_>>());
    assert_eq!((run.status, &run.stderr[..]), (Some(0), ""), "{run:?}");
    assert_eq!(run.stdout, report);
}
