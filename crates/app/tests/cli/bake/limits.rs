//! Fewer triangles: as few as are asked for, and none without an area.

use std::f64::consts::PI;

use alberti::Geometry as _;
use alberti::baked::Baked;

use super::{COLUMNS, bake, baked, folder, image, number};
use crate::Folder;

#[test]
fn a_budget_of_triangles_is_kept() {
    let folder = folder();
    let (report, file) = baked(&folder, "ball", &["ball.obj", "--triangles", "300"]);
    let triangles = report["triangles"].as_u64().expect("a number");
    assert!((200..=300).contains(&triangles), "{report}");
    // The middles of triangles, by how far they are inside of the ball: no more than the surface has moved, and what
    // it had been inside before.
    let moved = number(&report, "surface");
    let file = Baked::read(&file).expect("a file");
    let mesh = file.parts().next().expect("a part").mesh::<()>().expect("places");
    let inside = (0..mesh.triangles()).filter_map(|number| mesh.triangle(number)).map(|corners| {
        let corners = corners.map(|index| mesh.vertex(index).expect("a vertex").0.coords);
        2.0 - f64::from(((corners[0] + corners[1] + corners[2]) / 3.0).length())
    });
    let deepest = inside.fold(0.0, f64::max);
    let before = 2.0 * (1.0 - (PI / f64::from(COLUMNS)).cos().powi(2));
    assert!(moved > 0.005 && deepest <= 2.0 * moved + before, "{deepest} {moved} {before}");
}

/// Parts whose borders hold them, and a part with a seam along each edge.
#[test]
fn a_budget_is_kept_whatever_the_borders() {
    let (mut soup, mut faces) = (String::new(), String::new());
    for k in 0..200_u32 {
        let [x, y] = [k % 20, k / 20];
        for [dx, dy] in [[0, 0], [1, 0], [1, 1], [0, 1]] {
            soup += &format!("v {} {} 0\nvt {k} {dx}{dy}\n", x + dx, y + dy);
        }
        let [a, b, c, d] = [1, 2, 3, 4].map(|corner| 4 * k + corner);
        faces += &format!("f {a}/{a} {b}/{b} {c}/{c} {d}/{d}\n");
    }
    let folder = Folder::with(&[("soup.obj", (soup + &faces).as_bytes()), ("soft.png", &image())]);
    for (name, arguments, most) in [
        ("hero", &["--scene", "hero", "--texture-size", "16"][..], 500),
        ("fill", &["--scene", "fill", "--texture-size", "16"], 20),
        ("soup", &["soup.obj", "--texture", "soft.png"], 40),
    ] {
        let (report, _) = baked(&folder, name, &[arguments, &["--triangles", &most.to_string()]].concat());
        let triangles = report["triangles"].as_u64().expect("a number");
        assert!((1..=most).contains(&triangles) && number(&report, "surface") >= 0.0, "{report}");
    }
}

/// A part keeps a triangle, so that a budget may be too small: then the command says so.
#[test]
fn a_budget_that_cannot_be_kept_is_told() {
    let folder = Folder::with(&[]);
    let run = bake(&folder, &["--scene", "hero", "--texture-size", "16", "--triangles", "1"]);
    assert_eq!((run.status, run.stderr.lines().count()), (Some(0), 1), "{run:?}");
    let found = run.stderr.strip_prefix("warning: --triangles: found ").expect("a warning");
    let (number, expected) = found.split_once(' ').expect("a number");
    assert_eq!(expected, "triangles that cannot be fewer, expected at most 1\n");
    assert!(run.stdout.contains(&format!("rs: {number} of ")), "{run:?}");
}

/// Triangles whose corners are on a line, not only those with two equal ones.
#[test]
fn triangles_without_an_area_are_left_out() {
    let model = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\nf 1 2 4\n";
    let folder = Folder::with(&[("m.obj", model.as_bytes())]);
    let (report, _) = baked(&folder, "m", &["m.obj"]);
    assert_eq!((report["triangles"].as_u64(), report["vertices"].as_u64()), (Some(1), Some(3)), "{report}");
}
