//! Light: two-sided, of the models' materials, from beside the camera, and in linear space.

use std::ffi::OsStr;
use std::fs;

use crate::{Folder, alberti};

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
            run.stdout
                .lines()
                .last()
                .is_some_and(|line| line.contains("the derived colour is the picture's, to the bit")),
            "{run:?}"
        );
    }
}
