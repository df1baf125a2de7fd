//! Scene files.

use super::{Folder, TRIANGLE};

const SCENE: &str = "size = [40, 30]\nbackground = \"0a141e\"\noutput = \"from-file.png\"\n\
    [camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nfov = 40\n\
    [render]\nshading = \"unlit\"\n\
    [[object]]\nsurface = \"sphere\"\nsegments = [24, 12]\nmaterial = \"red\"\n\
    [material.red]\ncolor = \"ff0000\"\n";

fn pixel(folder: &Folder, name: &str, x: u32, y: u32) -> [u8; 3] {
    image::open(folder.path(name)).expect("a picture").to_rgb8().get_pixel(x, y).0
}

#[test]
fn a_scene_is_drawn_as_its_file_says() {
    let folder = Folder::with(&[("s.toml", SCENE.as_bytes())]);
    let run = folder.succeeds(&["s.toml"]);
    assert!(run.stdout.starts_with("s.toml: 576 triangles, "), "{run:?}");
    assert_eq!(run.stderr, "");
    let size = image::image_dimensions(folder.path("from-file.png")).expect("a picture");
    assert_eq!(size, (40, 30));
    assert_eq!(pixel(&folder, "from-file.png", 20, 15), [255, 0, 0]);
    assert_eq!(pixel(&folder, "from-file.png", 0, 0), [10, 20, 30]);
}

#[test]
fn options_override_a_scene() {
    let folder = Folder::with(&[("s.toml", SCENE.as_bytes())]);
    folder.succeeds(&["s.toml", "-o", "a.png", "--size", "20x10", "--background", "ffffff"]);
    assert_eq!(image::image_dimensions(folder.path("a.png")).expect("a picture"), (20, 10));
    assert_eq!(pixel(&folder, "a.png", 0, 0), [255; 3]);
    assert_eq!(folder.names(), ["a.png", "s.toml"]);
    // From so far away it is smaller than half a pixel.
    folder.succeeds(&["s.toml", "--eye", "0.3,0.3,900"]);
    assert_eq!(pixel(&folder, "from-file.png", 15, 10), [10, 20, 30]);
}

#[test]
fn paths_start_where_the_scene_is() {
    let scene = "[[object]]\nmodel = \"m.obj\"\n";
    let folder = Folder::with(&[]);
    std::fs::create_dir(folder.path("sub")).expect("a folder");
    std::fs::write(folder.path("sub/s.TOML"), scene).expect("a file");
    std::fs::write(folder.path("sub/m.obj"), TRIANGLE).expect("a file");
    folder.succeeds(&["sub/s.TOML"]);
    assert_eq!(folder.names(), ["alberti.png", "sub"]);
}

#[test]
fn what_is_wrong_with_a_scene_is_named_with_line_and_key() {
    let plane = "[[object]]\nsurface = \"plane\"\n";
    let folder = Folder::with(&[("m.obj", TRIANGLE.as_bytes()), ("binary.toml", b"a = \"\xff\"")]);
    for (text, part) in [
        (
            "[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]\n",
            "s.toml:4: camera.eye: found the eye and its target both at 1,2,3, expected two points; \
             move camera.eye or camera.target\n",
        ),
        (
            "[camera]\nfov = 200\n",
            "s.toml:4: camera.fov: found 200 degrees, expected an angle above 0 and below",
        ),
        ("[camera]\nnear = 5\nfar = 2\n", "s.toml:5: camera.far: found near 5 and far 2"),
        ("[camera]\nnear = 1e9\n", "s.toml:4: camera.near: found near 1000000000 and far"),
        ("[camera]\nup = [0, 0, 0]\n", "s.toml:4: camera.up: found 0,0,0, which is no direction"),
        ("[render]\narithmetic = \"fixed\"\n", "s.toml:4: render.arithmetic: found fixed with exact"),
        ("[render]\noutput = \"a.gif\"\n", "s.toml:4: render.output: found the extension \".gif\""),
        ("[render]\noutput = \"s.toml\"\n", "s.toml:4: render.output: found the extension \".toml\""),
        (
            "[projector]\nimage = \"no.png\"\neye = [0, 5, 0]\ntarget = [0, 0, 0]\n",
            "s.toml:4: projector.image: found no such file",
        ),
        (
            "[projector]\nimage = \"no.png\"\neye = [0, 5, 0]\n",
            "s.toml:4: projector.image: found it without projector.target",
        ),
        (
            "[camera]\nprojection = \"parallel\"\nview-height = -1\n",
            "s.toml:5: camera.view-height: found a height of -1",
        ),
    ] {
        std::fs::write(folder.path("s.toml"), format!("{plane}{text}")).expect("a file");
        folder.fails(&["s.toml"], &[&format!("error: {part}")]);
    }
    folder.fails(&["no.toml"], &["error: no.toml: found no such file, expected a scene file in TOML"]);
    folder.fails(&["binary.toml"], &["error: binary.toml:1: found a byte that is not UTF-8"]);
    // What the command line says is not the file's.
    std::fs::write(folder.path("s.toml"), plane).expect("a file");
    folder.fails(&["s.toml", "--fov", "0"], &["error: --fov: found 0 degrees"]);
}

#[test]
fn a_picture_does_not_overwrite_what_a_scene_reads() {
    let scene = "[[object]]\nsurface = \"plane\"\nmaterial = \"a\"\n[material.a]\ncolor-map = \"a.png\"\n";
    let folder = Folder::with(&[("s.toml", scene.as_bytes()), ("a.png", b"")]);
    folder.fails(&["s.toml", "-o", "a.png"], &["error: a.png: found a file that is also read"]);
}

#[test]
fn options_of_materials_override_those_of_a_scene() {
    let folder = Folder::with(&[("s.toml", SCENE.as_bytes()), ("m.obj", TRIANGLE.as_bytes())]);
    image::RgbImage::from_pixel(2, 2, image::Rgb([0, 255, 0]))
        .save(folder.path("green.png"))
        .expect("a file");
    folder.succeeds(&["s.toml", "--texture", "green.png"]);
    assert_eq!(pixel(&folder, "from-file.png", 20, 15), [0, 255, 0]);
    // A displaced triangle, of 2x2 heights.
    let options = ["--height-map", "green.png", "--relief", "displacement", "--height-range", "0,0.5"];
    let mut arguments = vec!["m.obj", "--size", "8x8"];
    arguments.extend(options);
    let run = folder.succeeds(&arguments);
    assert!(run.stdout.starts_with("m.obj: 4 triangles"), "{run:?}");
    assert_eq!(run.stderr, "");
}

#[test]
fn options_say_what_is_made_of_a_scenes_maps() {
    let scene = |relief: &str| {
        let material = "[material.rough]\nheight-map = \"h.png\"\nheight-range = [-0.3, 0]\n";
        let object = "[[object]]\nsurface = \"plane\"\nsegments = [1, 1]\nmaterial = \"rough\"\n";
        format!("size = [32, 24]\n[camera]\neye = [0, 1, 2]\n{object}{material}relief = \"{relief}\"\n")
    };
    let files =
        [("steep.toml", scene("steep")), ("bump.toml", scene("bump")), ("m.obj", TRIANGLE.to_owned())];
    let folder = Folder::with(&files.each_ref().map(|(name, text)| (*name, text.as_bytes())));
    let heights =
        image::GrayImage::from_fn(4, 4, |x, y| image::Luma([[0, 255, 80, 30][((x + y) % 4) as usize]]));
    heights.save(folder.path("h.png")).expect("a file");
    let bytes = |arguments: &[&str]| {
        folder.succeeds(&[arguments, &["-o", "p.png"]].concat());
        std::fs::read(folder.path("p.png")).expect("a picture")
    };
    assert_eq!(bytes(&["bump.toml", "--relief", "steep"]), bytes(&["steep.toml"]));
    assert_ne!(bytes(&["bump.toml"]), bytes(&["steep.toml"]));
    // Another map is used as the one before it.
    assert_eq!(bytes(&["steep.toml", "--height-map", "h.png"]), bytes(&["steep.toml"]));
    folder.fails(
        &["steep.toml", "--environment", "h.png", "--environment-kind", "cube"],
        &["error: h.png: found an image of 4x4 texels for a cube, expected six squares, one below the other"],
    );
    assert_ne!(bytes(&["steep.toml", "--height-range", "-0.1,0"]), bytes(&["steep.toml"]));
    folder.fails(
        &["m.obj", "--relief", "steep"],
        &["error: --relief: found a model without a height map, expected a height map for it; give one with --height-map"],
    );
    folder.fails(
        &["steep.toml", "--normal-strength", "2"],
        &["error: --normal-strength: found a model without a normal map"],
    );
}

#[test]
fn light_by_vertex_says_what_it_leaves_out() {
    let material = "[material.a]\ncolor = \"ff0000\"\nheight-map = \"h.png\"\n";
    let object = "[[object]]\nsurface = \"plane\"\nmaterial = \"a\"\n";
    let scene = format!("size = [8, 6]\n[camera]\neye = [0, 1, 2]\n{object}{material}");
    let folder = Folder::with(&[("s.toml", scene.as_bytes())]);
    image::GrayImage::from_pixel(2, 2, image::Luma([9])).save(folder.path("h.png")).expect("a file");
    let warning = "warning: --shading: found gouraud with relief, normals, occlusion or reflections, which are left \
                   out, expected phong or blinn for these\n";
    assert_eq!(folder.succeeds(&["s.toml", "--shading", "gouraud"]).stderr, warning);
    assert_eq!(folder.succeeds(&["s.toml", "--shading", "phong"]).stderr, "");
}

/// Things that a file says and that do nothing: one warning each, and a picture.
#[test]
fn what_does_nothing_is_told() {
    let mut png = std::io::Cursor::new(Vec::new());
    let leaf = image::RgbaImage::from_pixel(2, 2, image::Rgba([0, 200, 0, 90]));
    leaf.write_to(&mut png, image::ImageFormat::Png).expect("a picture in memory");
    let scene = "[ambient]\nintensity = 0.4\n[[object]]\nsurface = \"plane\"\nmaterial = \"leaf\"\n\
        [material.leaf]\ncolor-map = \"leaf.png\"\n[material.spare]\ncolor = \"red\"\n";
    let other = scene.replace("[material.leaf]", "[material.leaf]\nblend = \"over\"");
    let other = other.replace("0.4", "1").replace("spare", "two").replace("[[object]]", "[[object]]\n");
    let other = other + "[[object]]\nsurface = \"sphere\"\nmaterial = \"two\"\n";
    let folder = Folder::with(&[
        ("s.toml", scene.as_bytes()),
        ("t.toml", other.as_bytes()),
        ("leaf.png", png.get_ref().as_slice()),
    ]);
    let told = folder.succeeds(&["s.toml", "--size", "32x24"]).stderr;
    for part in [
        "s.toml:1: ambient: found it without a [[light]], expected a [[light]] as well",
        "s.toml:7: material.leaf.color-map: found an image with alpha, which is left out, expected blend",
        "s.toml:8: material.spare: found a material of no object",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    assert_eq!(told.lines().count(), 3, "{told}");
    assert_eq!(folder.succeeds(&["t.toml", "--size", "32x24"]).stderr, "");
}
