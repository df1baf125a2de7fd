//! `alberti info`: a model in numbers, counted here by hand.

use std::ffi::OsStr;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use super::{Folder, Run, TRIANGLE, alberti};

/// A box of 2 x 1 x 4 far away, in two parts: a floor with coordinates for a texture, and the rest without.
const BOX: &str = "mtllib m.mtl\nv 1000 10 0\nv 1002 10 0\nv 1002 10 4\nv 1000 10 4\nv 1000 11 0\n\
    vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\no floor\nusemtl wood\nf 4/1 3/2 2/3 1/4\no wall\nusemtl glass\nf 1 2 5\n";
const MTL: &str = "newmtl wood\nmap_Kd ./wood.png\nmap_Bump no.png\nnewmtl glass\nd 0.5\n";

fn image() -> Vec<u8> {
    let mut file = std::io::Cursor::new(vec![]);
    image::RgbImage::new(3, 2).write_to(&mut file, image::ImageFormat::Png).expect("an image");
    file.into_inner()
}

fn of_box() -> Folder {
    Folder::with(&[("b.obj", BOX.as_bytes()), ("m.mtl", MTL.as_bytes()), ("wood.png", &image())])
}

fn info(folder: &Folder, arguments: &[&str]) -> Run {
    alberti(folder.0.path(), &[OsStr::new("info")], arguments)
}

fn json_of(folder: &Folder, arguments: &[&str]) -> Value {
    let run = info(folder, &[arguments, &["--json"]].concat());
    assert_eq!(run.status, Some(0), "{run:?}");
    assert_eq!(run.stdout.lines().count(), 1);
    serde_json::from_str(&run.stdout).expect("JSON")
}

#[test]
fn a_model_is_told_in_json() {
    let folder = of_box();
    let told = json_of(&folder, &["b.obj"]);
    for (key, expected) in [
        ("source", json!("b.obj")),
        ("triangles", json!(3)),
        ("vertices", json!(7)),
        ("low", json!([1000.0, 10.0, 0.0])),
        ("high", json!([1002.0, 11.0, 4.0])),
        ("given_normals", json!(0)),
        ("uv", json!(true)),
        ("vertex_colors", json!(false)),
        ("bytes", json!({ "vertices": 7 * 60, "triangles": 36, "maps": 24 })),
        (
            "materials",
            json!([
                { "name": "wood", "maps": [
                    { "key": "color-map", "file": "wood.png", "size": [3, 2], "found": true },
                    { "key": "height-map", "file": "no.png", "size": null, "found": false },
                ] },
                { "name": "glass", "maps": [] },
            ]),
        ),
    ] {
        assert_eq!(told[key], expected, "{key}");
    }
    let parts = told["parts"].as_array().expect("parts");
    assert!(
        parts.iter().all(|part| part["specular"] == json!([0.0, 0.0, 0.0]) && part["exponent"].is_null())
    );
    let expected = [("floor", "wood", 2, Value::Null), ("wall", "glass", 1, json!("blended"))];
    assert_eq!(parts.len(), expected.len());
    for (part, (name, material, triangles, look)) in parts.iter().zip(expected) {
        let found = [&part["name"], &part["material"], &part["triangles"], &part["look"]];
        assert_eq!(found, [&json!(name), &json!(material), &json!(triangles), &look]);
    }
    let warnings = told["warnings"].as_array().expect("warnings");
    assert!(warnings.iter().any(|warning| warning.as_str().is_some_and(|w| w.contains("no.png"))));
    let left_out = told["left_out"].as_array().expect("a list");
    assert!(!left_out.is_empty(), "glass is not drawn on boards");
}

/// Surfaces without a material are named after their kind.
#[test]
fn surfaces_have_names() {
    let scene = "[camera]\neye = [0, 1, 4]\ntarget = [0, 0, 0]\n[[object]]\nsurface = \"sphere\"\n\
        [[object]]\nsurface = \"plane\"\nmaterial = \"wood\"\n[material.wood]\ncolor = \"804020\"\n";
    let folder = Folder::with(&[("s.toml", scene.as_bytes())]);
    let told = json_of(&folder, &["s.toml"]);
    let names =
        told["parts"].as_array().expect("parts").iter().map(|part| [&part["name"], &part["material"]]);
    let expected = [[json!("sphere"), json!("")], [json!("wood"), json!("wood")]];
    assert!(names.eq(expected.iter().map(|[name, material]| [name, material])), "{told}");
}

/// The costs are those that `alberti bake` reports of the same scene.
#[test]
fn costs_are_those_of_bake() {
    let folder = of_box();
    let told = json_of(&folder, &["b.obj"]);
    let run = alberti(folder.0.path(), &[OsStr::new("bake")], &["b.obj", "--out", "out", "--json"]);
    let baked: Value = serde_json::from_str(&run.stdout).expect("JSON");
    for key in ["flash", "items", "ram", "band", "memory", "chips", "light", "unpriced"] {
        assert_eq!(told["board"][key], baked[key], "{key}");
        assert!(!baked[key].is_null(), "{key}");
    }
}

#[test]
fn text_has_all_of_it() {
    let folder = of_box();
    let run = info(&folder, &["b.obj"]);
    assert_eq!(run.status, Some(0), "{run:?}");
    for part in [
        "b.obj: 3 triangles, 7 vertices\n",
        "  x        1000 to 1002, 2\n",
        "  z        0 to 4, 4\n",
        "  origin   counted from ",
        "  normals  made\n",
        "        2  \"floor\", material \"wood\", color ffffff\n",
        "        1  \"wall\", material \"glass\", color cccccc, blended\n",
        "    color-map      wood.png, 3x2\n",
        "    height-map     no.png, missing\n",
        " bytes of flash:\n",
        " bytes of RAM, in bands of 16 rows of 320 columns:\n",
    ] {
        assert!(run.stdout.contains(part), "{part:?} is not in {}", run.stdout);
    }
    assert!(run.stderr.starts_with("warning: "), "{run:?}");
    assert_eq!(folder.names(), ["b.obj", "m.mtl", "wood.png"]);
    // A replaced map is the option's, and a scene file's material is its own.
    let told = json_of(&folder, &["b.obj", "--texture", "wood.png", "-q"]);
    assert_eq!(told["materials"][1]["maps"][0]["file"], "wood.png");
    let scene = "[[object]]\nmodel = \"b.obj\"\nmaterial = \"stone\"\n[[object]]\nsurface = \"sphere\"\n\
        material = \"stone\"\n[material.stone]\ncolor-map = \"wood.png\"\n";
    std::fs::write(folder.path("s.toml"), scene).expect("a file");
    let told = json_of(&folder, &["s.toml"]);
    let map = json!({ "key": "color-map", "file": "wood.png", "size": [3, 2], "found": true });
    assert_eq!(told["materials"], json!([{ "name": "stone", "maps": [map] }]));
    assert_eq!(json_of(&folder, &["--scene", "floor"])["triangles"], 2);
    // Copies of a model are told apart by their names.
    let copies = "[[object]]\nname = \"a\"\nmodel = \"b.obj\"\n[[object]]\nname = \"c\"\nmodel = \"b.obj\"\n";
    std::fs::write(folder.path("t.toml"), copies).expect("a file");
    let run = info(&folder, &["t.toml"]);
    for part in ["\"a/floor\"", "\"a/wall\"", "\"c/floor\"", "\"c/wall\""] {
        assert!(run.stdout.contains(part), "{part:?} is not in {}", run.stdout);
    }
}

#[test]
fn standard_input_may_be_compressed() {
    use std::io::Write as _;
    let mut gzip = flate2::write::GzEncoder::new(vec![], flate2::Compression::fast());
    gzip.write_all(TRIANGLE.as_bytes()).expect("memory");
    for bytes in [TRIANGLE.as_bytes(), &gzip.finish().expect("memory")] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_alberti"))
            .args(["info", "-", "--json"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the command");
        child.stdin.take().expect("a pipe").write_all(bytes).expect("a reader");
        let output = child.wait_with_output().expect("an end");
        let told: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!((&told["triangles"], &told["given_normals"]), (&json!(1), &json!(3)));
        assert_eq!(told["source"], "standard input");
    }
}

#[test]
fn wrong_input_is_one_error() {
    let folder =
        Folder::with(&[("a.obj", b"f 1 2 3\n"), ("p.png", &image()), ("t.obj", TRIANGLE.as_bytes())]);
    for (arguments, part) in [
        (&["no.obj"][..], "no.obj: found no such file, expected a Wavefront OBJ model"),
        (&["a.obj"], "a.obj:1: found vertex index 1"),
        (&["p.png"], "p.png: found "),
        (
            &["t.obj", "t.obj"],
            "found one file too many, expected no other file: a scene file has several models",
        ),
        (&["t.obj", "--output", "x.png"], "--output: found an option that `info` has not"),
        (&["t.obj", "--sizes", "3"], "--sizes: found no such option, expected one, such as --size"),
    ] {
        let run = info(&folder, arguments);
        assert_eq!((run.status, run.stdout.as_str()), (Some(2), ""), "{run:?}");
        assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
        assert!(run.stderr.contains(part), "{part} is not in {}", run.stderr);
    }
}
