//! Fewer triangles: as few as are asked for, and none without an area.

use std::f64::consts::PI;

use alberti::Geometry as _;
use alberti::baked::Baked;

use super::{COLUMNS, ROWS, bake, baked, folder, image, number};
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

/// A flat sheet beside a ball: triangles that the sheet has no use for are the ball's, and each states its own error.
#[test]
fn a_budget_goes_where_it_is_needed() {
    let mut sheet = "o sheet\n".to_owned();
    for k in 0..21 * 21_u32 {
        sheet += &format!("v {} -3 {}\nvt {} {}\nvn 0 1 0\n", k % 21, k / 21, k % 21, k / 21);
    }
    for k in (0..21 * 20).filter(|k| k % 21 < 20) {
        let [a, b, c, d] = [k, k + 21, k + 22, k + 1].map(|corner| corner + 1);
        sheet += &format!("f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c} {d}/{d}/{d}\n");
    }
    // Indices that count from the end do not care how many vertices there were before.
    let all = (ROWS + 1) * (COLUMNS + 1);
    let ball = super::ball();
    let ball = ball.lines().map(|line| match line.strip_prefix("f ") {
        Some(face) => {
            let corner =
                |word: &str| word.split('/').next().and_then(|k| k.parse::<u32>().ok()).expect("one");
            let back = face.split(' ').map(|word| corner(word).abs_diff(all + 1));
            format!("f {}\n", back.map(|k| format!("-{k}/-{k}/-{k}")).collect::<Vec<_>>().join(" "))
        }
        None => line.to_owned(),
    });
    let ball = ball.collect::<Vec<_>>().join("\n");
    let folder = Folder::with(&[("two.obj", format!("{sheet}o ball\n{ball}\n").as_bytes())]);
    let run = bake(&folder, &["two.obj", "--triangles", "500", "--attributes", "normal", "--json"]);
    assert_eq!(run.status, Some(0), "{run:?}");
    let report: serde_json::Value = serde_json::from_str(&run.stdout).expect("one line of JSON");
    let triangles = report["triangles"].as_u64().expect("a number");
    assert!((400..=500).contains(&triangles), "{report}");
    let parts = report["surfaces"].as_array().expect("a list");
    let of = |part: usize, key: &str| parts[part][key].as_f64().expect("a number");
    // A share of 500 would leave the ball with 329.
    assert!(of(0, "triangles") <= 100.0 && of(1, "triangles") >= 360.0, "{report}");
    assert!(of(0, "moved") < 0.1 * of(1, "moved"), "{report}");
    assert!((number(&report, "surface") - of(1, "moved")).abs() < 1e-9, "{report}");
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
