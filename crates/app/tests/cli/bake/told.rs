//! What the command says: of things that a file has not, of defaults, and of what it made.

use std::ffi::OsStr;

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
        format!("[material.wall]\n[material.glass]\ncolor = \"4080c0\"\n{glass}[material.lace]\n{lace}")
    };
    let rest = "[render]\nshading = \"unlit\"\n";
    let full = materials("blend = \"constant:0.5\"\n", "blend = \"over\"\nalpha-test = 0.5\n");
    let full = format!("{panes}{full}{rest}fog = \"exp:0.1\"\n");
    let bare = format!("{panes}{}{rest}", materials("", ""));
    let folder = Folder::with(&[("s.toml", full.as_bytes()), ("bare.toml", bare.as_bytes())]);
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
    let run = alberti(folder.0.path(), &[OsStr::new("bake")], &["--help"]);
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
