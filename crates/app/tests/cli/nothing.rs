//! Pictures of which something is missing: all of the model, smooth edges, or the order of glass.

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
