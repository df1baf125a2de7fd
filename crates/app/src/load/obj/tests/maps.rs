//! Tests of the maps that material libraries name.

use super::{image, load_files};
use crate::scene::Detail;

const MAPPED: &str =
    "mtllib m.mtl\nv 0 0 0\nv 2 0 0\nv 0 4 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";

#[test]
fn maps_of_a_library_reach_their_part() {
    let mtl = b"newmtl m\nKs 1 1 1\nNs 50\nmap_Ks a.png\nmap_Ns b.png\nKe 1 0 0\nmap_Ke -clamp on a.png\n\
        map_Bump -bm 2 grey.png\nnorm -bm 0.5 blue.png\nrefl b.png\n";
    let (model, warnings) = load_files(&[
        ("m.obj", MAPPED.as_bytes()),
        ("m.mtl", mtl),
        ("a.png", &image([1, 2, 3])),
        ("b.png", &image([240, 5, 6])),
        ("grey.png", &image([77, 77, 77])),
        ("blue.png", &image([128, 128, 255])),
    ]);
    assert!(warnings.is_empty(), "{warnings:?}");
    let detail = &model.parts[0].detail;
    let red = |index: usize| model.textures[index].texels[0][0];
    let of = |map: Option<crate::scene::Map>| map.map(|map| red(map.image));
    assert_eq!(
        [detail.specular_map, detail.shininess_map, detail.emissive_map].map(of),
        [1, 240, 1].map(Some)
    );
    assert_eq!(detail.emissive_map.unwrap().wrap, Some(crate::options::Wrap::Clamp));
    assert_eq!(
        (detail.specular, detail.shininess, detail.emissive),
        ([1.0; 3], [0.0, 50.0], [1.0, 0.0, 0.0])
    );
    let normal = detail.normal.unwrap();
    assert_eq!((red(normal.map.image), normal.strength.to_bits()), (128, 0.5_f32.to_bits()));
    let height = detail.height.unwrap();
    assert_eq!(model.heights[height.heights].heights, [77 * 257; 4]);
    // Twice a fiftieth of the radius of the triangle.
    assert!((height.range[1] - 0.04 * 5.0_f32.sqrt()).abs() < 1e-6, "{height:?}");
    assert_eq!(height.relief, crate::scene::Relief::Bump);
    let environment = detail.environment.unwrap();
    assert_eq!((red(environment.image), environment.kind), (240, crate::scene::EnvironmentKind::Sphere));
}

#[test]
fn normals_that_are_called_bumps_are_normals() {
    let files = |color| {
        let mtl = &b"newmtl m\nbump -bm 3 n.png\n"[..];
        load_files(&[("m.obj", MAPPED.as_bytes()), ("m.mtl", mtl), ("n.png", &image(color))])
    };
    let (model, warnings) = files([128, 120, 250]);
    let detail = &model.parts[0].detail;
    assert_eq!((detail.normal.map(|n| n.strength), detail.height), (Some(3.0), None));
    assert_eq!(warnings.len(), 1);
    assert!(
        warnings[0]
            .starts_with("m.mtl:2: found normals in \"n.png\" as a bump map, expected heights; they are")
    );
    for color in [[255; 3], [0; 3], [128; 3], [0, 0, 255], [110, 110, 210]] {
        let (model, warnings) = files(color);
        assert!(model.parts[0].detail.height.is_some() && model.textures.is_empty() && warnings.is_empty());
    }
}

#[test]
fn broken_maps_leave_the_surface_without() {
    for key in ["map_Ks", "map_Ns", "map_Ke", "bump", "map_Bump", "norm", "refl"] {
        let mtl = format!("newmtl m\nKd 1 0 0\n{key} no.png\n");
        let (model, warnings) = load_files(&[("m.obj", MAPPED.as_bytes()), ("m.mtl", mtl.as_bytes())]);
        let part = &model.parts[0];
        assert_eq!(
            (part.diffuse, &part.detail),
            ([1.0, 0.0, 0.0], &Detail { specular: part.detail.specular, ..Detail::default() }),
            "{key}"
        );
        assert_eq!(warnings.len(), 1, "{key} {warnings:?}");
        assert!(
            warnings[0].starts_with("m.mtl:3: found no such file for the texture \"no.png\", expected"),
            "{warnings:?}"
        );
    }
}

/// Where the map is white it is metal: half of its colour is scattered, and highlights have the colour.
#[test]
fn maps_of_metal_dull_the_colour_and_tint_highlights() {
    for (lines, metal, [dull, mirrored]) in [
        ("Kd 0.5 0.5 0.5\nPr 0.5", [255; 3], [128, 255]),
        ("Kd 0.5 0.5 0.5\nPr 0.5", [0; 3], [255, 48]),
        ("Kd 0.05 0.05 0.05\nPr 0.5", [255; 3], [128, 62]),
        ("Kd 0.05 0.05 0.05\nPr 0.5\nPm 0.5", [255; 3], [191, 55]),
    ] {
        let mtl = format!("newmtl m\n{lines}\nmap_Pm m.png\n");
        let files = [("m.obj", MAPPED.as_bytes()), ("m.mtl", mtl.as_bytes()), ("m.png", &image(metal))];
        let (model, warnings) = load_files(&files);
        assert!(warnings.is_empty(), "{warnings:?}");
        let part = &model.parts[0];
        let red = |index: Option<usize>| i32::from(model.textures[index.unwrap()].texels[0][0]);
        let highlight = part.detail.specular_map.map(|map| map.image);
        // An exponent of 30 has highlights of (30 + 8)/8.
        let off = [red(part.texture) - dull, red(highlight) - mirrored].map(i32::abs);
        assert!(off[0] <= 1 && off[1] <= 4, "{lines} {off:?}");
        assert_eq!(part.detail.specular, [1.0; 3]);
    }
    // Where a surface is rough, its highlights are as faint as they are broad, before `prepare` has these fade.
    for (rough, mirrored) in [([255; 3], 10), ([0; 3], 255), ([247; 3], 20)] {
        let mtl = b"newmtl m\nKd 0.5 0.5 0.5\nmap_Pr r.png\n";
        let files = [("m.obj", MAPPED.as_bytes()), ("m.mtl", mtl), ("r.png", &image(rough))];
        let (model, _) = load_files(&files);
        let detail = &model.parts[0].detail;
        let highlight = model.textures[detail.specular_map.unwrap().image].texels[0];
        // 0.04 (n + 8)/8: n is 0, 256 and 8.
        assert_eq!((highlight, detail.shininess), ([mirrored, mirrored, mirrored, 255], [0.0, 256.0]));
    }
    // Highlights that the file has stay.
    let mtl = b"newmtl m\nKs 0.25 0.25 0.25\nmap_Pm m.png\n";
    let files = [("m.obj", MAPPED.as_bytes()), ("m.mtl", mtl), ("m.png", &image([255; 3]))];
    let part = &load_files(&files).0.parts[0];
    assert!(part.texture.is_some() && part.detail.specular_map.is_none());
    assert_eq!(part.detail.specular, [0.25; 3]);
}
