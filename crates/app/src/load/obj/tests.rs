//! Tests of the OBJ loader: from files to a model.

use std::fs;

use super::*;
use crate::scene::Detail;

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// A folder with these files, of which `m.obj` is loaded.
fn load_files(files: &[(&str, &[u8])]) -> (Model, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    let loaded = load(&folder.path().join("m.obj"), &mut |done, total| assert!(done <= total)).unwrap();
    let prefix = format!("{}/", folder.path().display());
    (loaded.model, loaded.warnings.lines().map(|l| l.replace(&prefix, "")).collect())
}

fn load_text(text: &str) -> Model {
    let (model, warnings) = load_files(&[("m.obj", text.as_bytes())]);
    assert!(warnings.is_empty(), "{warnings:?}");
    model
}

fn image(color: [u8; 3]) -> Vec<u8> {
    let mut bytes = Vec::new();
    image::RgbImage::from_pixel(2, 2, image::Rgb(color))
        .write_to(&mut io::Cursor::new(&mut bytes), image::ImageFormat::Png)
        .unwrap();
    bytes
}

/// The positions of all corners, in drawing order.
fn corners(model: &Model) -> Vec<[f32; 3]> {
    let all = model.parts.iter().flat_map(|p| &p.triangles).flatten();
    all.map(|&i| model.vertices[i as usize].position).collect()
}

#[test]
fn polygons_become_fans() {
    let model = load_text(&format!("{CORNERS}v -1 0.5 0\nf 1 2 3 4\nf 1 2 3 4 5\n"));
    assert_eq!(model.parts[0].triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    assert_eq!(model.vertices.len(), 5);
}

#[test]
fn negative_indices_count_back_from_where_they_stand() {
    let model = load_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -3 -2\n");
    let wanted: [[f32; 3]; 6] =
        [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [5., 5., 5.], [1., 0., 0.], [0., 1., 0.]];
    assert_eq!(corners(&model), wanted);
}

#[test]
fn objects_become_parts() {
    let model =
        load_text(&format!("o empty\n{CORNERS}o one\nf 1 2 3\ng two three\nf 1 3 4\nf 2 3 4\no last\n"));
    let parts: Vec<_> = model.parts.iter().map(|p| (p.name.as_str(), p.triangles.len())).collect();
    assert_eq!(parts, [("one", 1), ("two three", 2)]);
    assert_eq!(model.parts[1].triangles[0], [3, 4, 5]);
    assert_eq!(model.parts[0].diffuse, DEFAULT_DIFFUSE);
}

#[test]
fn vertex_colours_are_read_even_if_some_are_missing() {
    let model = load_text("v 0 0 0\nv 1 0 0 1 0 0.5\nv 0 1 0\nf 1 2 3\n");
    let colors: Vec<_> = model.vertices.iter().map(|v| v.color).collect();
    assert_eq!(colors, [[1.0; 3], [1.0, 0.0, 0.5], [1.0; 3]]);
}

#[test]
fn vertex_colours_are_clamped_with_a_warning() {
    let (model, warnings) = load_files(&[("m.obj", b"v 0 0 0 255 -1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")]);
    assert_eq!(model.vertices[0].color, [1.0, 0.0, 0.0]);
    assert!(warnings[0].starts_with("m.obj: found 1 vertex colours outside 0 to 1"), "{warnings:?}");
}

#[test]
fn missing_normals_and_texture_coordinates_do_not_shift_the_others() {
    let model = load_text(&format!("{CORNERS}vt 0.25 0.75\nvn 0 1 0\nf 1 2/1 3//1\nf 1/1/1 3 4\n"));
    let at = |i: usize| (model.vertices[i].normal, model.vertices[i].uv);
    let made = [0.0, 0.0, 1.0];
    assert_eq!(at(0), (made, [0.0, 0.0]));
    assert_eq!(at(1), (made, [0.25, 0.75]));
    assert_eq!(at(2), ([0.0, 1.0, 0.0], [0.0, 0.0]));
    assert_eq!(at(3), ([0.0, 1.0, 0.0], [0.25, 0.75]));
    assert_eq!(at(4), (made, [0.0, 0.0]));
}

#[test]
fn line_ends_tabs_and_continuations_do_not_matter() {
    let plain = load_text(&format!("{CORNERS}o x\nf 1 2 3\nf 1 3 4\n"));
    let odd = format!("\u{feff}# é\n{CORNERS}\to\tx\nl 1 2\np 1\n f\t1 \\\n2 3 # c\nf 1 3 4")
        .replace('\n', "\r\n")
        .replace(" 0 0", "\t0  0 ");
    let odd = load_text(&odd);
    assert_eq!((plain.vertices, plain.parts), (odd.vertices, odd.parts));
}

#[test]
fn materials_and_textures_come_from_beside_the_files() {
    let obj = format!(
        "mtllib a.mtl  b.mtl\n{CORNERS}usemtl red\nf 1 2 3\n\tusemtl\tred wood\nf 1 3 4\nusemtl red\nf 2 3 4"
    );
    let (model, warnings) = load_files(&[
        ("m.obj", obj.as_bytes()),
        ("a.mtl", b"newmtl red\nKd 1 0 0\n"),
        ("b.mtl", b"newmtl red wood\r\nKd 2 .5 .5\r\nmap_Kd a wood.png\r\n"),
        ("a wood.png", &image([10, 20, 30])),
    ]);
    assert!(warnings.is_empty(), "{warnings:?}");
    let parts: Vec<_> = model.parts.iter().map(|p| (p.diffuse, p.texture)).collect();
    assert_eq!(parts, [([1.0, 0.0, 0.0], None), ([1.0, 0.5, 0.5], Some(0)), ([1.0, 0.0, 0.0], None)]);
    assert_eq!(model.textures[0].texels, [[10, 20, 30, 255]; 4]);
}

#[test]
fn broken_materials_leave_the_default() {
    for broken in ["map_Kd", "newmtl"] {
        let mtl = format!("newmtl red\n{broken}\n");
        let obj = format!("mtllib m.mtl\n{CORNERS}usemtl red\nf 1 2 3\n");
        let (model, warnings) = load_files(&[("m.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes())]);
        assert_eq!(model.parts[0].diffuse, DEFAULT_DIFFUSE);
        assert_eq!(warnings.len(), 1);
        assert!(warnings[0].starts_with("m.mtl:2: found "), "{warnings:?}");
    }
}

#[test]
fn missing_files_leave_the_default() {
    let obj = format!("mtllib no.mtl\n{CORNERS}usemtl red\nf 1 2 3\n");
    let (model, warnings) = load_files(&[("m.obj", obj.as_bytes())]);
    assert_eq!(model.parts.len(), 1);
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].starts_with("m.obj:1: found no file \"no.mtl\""), "{warnings:?}");

    let obj = format!(
        "mtllib m.mtl\n{CORNERS}usemtl red\nf 1 2 3\no two\nf 1 2 3\nusemtl\nf 1 2 4\nusemtl blue\nf 1 2 3\n"
    );
    let (model, warnings) = load_files(&[
        ("m.obj", obj.as_bytes()),
        ("m.mtl", b"newmtl red\nmap_Kd no.png\nnewmtl green\nmap_Kd no2.png"),
    ]);
    assert!(model.textures.is_empty() && model.parts.iter().all(|p| p.texture.is_none()));
    let starts = [
        "m.obj:10: found `usemtl` \"\"",
        "m.obj:12: found `usemtl` \"blue\"",
        "m.mtl:2: found a texture \"no.png\"",
    ];
    assert_eq!(warnings.len(), 3, "{warnings:?}");
    for (warning, start) in warnings.iter().zip(starts) {
        assert!(warning.starts_with(start), "{warning}");
    }
}

#[test]
fn degenerate_faces_are_kept() {
    assert_eq!(load_text(&format!("{CORNERS}f 1 1 1\nf 1 2 1\n")).parts[0].triangles.len(), 2);
}

#[test]
fn a_ten_megabyte_file_loads_within_seconds() {
    use std::fmt::Write as _;
    let mut text = String::new();
    let n = 90_000;
    for i in 0..n {
        writeln!(text, "v {}.123456 {}.654321 0.5\nvt 0.123456 0.{i}\nvn 0 0.6 0.8", i % 300, i / 300)
            .unwrap();
    }
    for i in 3..=n {
        writeln!(text, "f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}", i - 2, i - 1, i).unwrap();
    }
    assert!(text.len() > 9_000_000, "{}", text.len());
    let start = std::time::Instant::now();
    let model = load_text(&text);
    assert_eq!(model.vertices.len(), n);
    // About half a second alone; the bound leaves room for a loaded machine.
    assert!(start.elapsed().as_secs_f64() < 5.0, "{:?}", start.elapsed());
}

#[test]
fn mutated_files_load_or_are_refused_on_one_line() {
    let seeds: [&[u8]; 2] = [
        b"mtllib m.mtl\no a\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 2\nvt 0 1\nvn 0 0 1\nusemtl r\nf 1/1/1 2//1 -1/-1 \\\n3\n",
        b"newmtl r\nKd 1 0.5 0\nmap_Kd -s 1 1 a.png\nNs 10\nillum 2\nnewmtl g\nKa 0 0 0\nmap_Kd a.png\n",
    ];
    let pieces: [&[u8]; 16] = [
        b"\n",
        b"\r",
        b"\\\n",
        b" ",
        b"\t",
        b"/",
        b"-",
        b"#",
        b"0",
        b"9223372036854775807",
        b"nan",
        b"1e400",
        b"\xff",
        b"\0",
        b"f 1 2 3",
        b"Kd",
    ];
    let folder = tempfile::tempdir().unwrap();
    let [obj, mtl] = ["m.obj", "m.mtl"].map(|name| folder.path().join(name));
    fs::write(folder.path().join("a.png"), image([1, 2, 3])).unwrap();
    let mut state = 0x2545_f491_u32;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state as usize % below
    };
    let (mut loaded, mut refused) = (0, 0);
    for _ in 0..500 {
        for (path, seed) in [&obj, &mtl].into_iter().zip(seeds) {
            let mut bytes = seed.to_vec();
            for _ in 0..random(4) {
                let at = random(bytes.len());
                let to = (at + random(4)).min(bytes.len());
                bytes.splice(at..to, pieces[random(pieces.len())].iter().copied());
                bytes.push(b'\n');
            }
            fs::write(path, bytes).unwrap();
        }
        match load(&obj, &mut |_, _| {}) {
            Ok(Loaded { model, warnings, .. }) => {
                loaded += 1;
                assert!(warnings.lines().all(|w| w.lines().count() == 1));
                let vertices = model.vertices.len();
                assert!(
                    model.parts.iter().flat_map(|p| &p.triangles).flatten().all(|&i| (i as usize) < vertices)
                );
                assert!(model.parts.iter().all(|p| p.texture.is_none_or(|t| t < model.textures.len())));
                let numbers = |v: &Vertex| [v.position, v.normal, v.color, [v.uv[0], v.uv[1], 0.0]];
                assert!(model.vertices.iter().flat_map(numbers).flatten().all(f32::is_finite));
            }
            Err(error) => {
                refused += 1;
                assert_eq!(error.to_string().lines().count(), 1);
            }
        }
    }
    assert!(loaded > 50 && refused > 50, "{loaded} {refused}");
}

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
        ("b.png", &image([4, 5, 6])),
        ("grey.png", &image([77, 77, 77])),
        ("blue.png", &image([128, 128, 255])),
    ]);
    assert!(warnings.is_empty(), "{warnings:?}");
    let detail = &model.parts[0].detail;
    let red = |index: usize| model.textures[index].texels[0][0];
    let of = |map: Option<crate::scene::Map>| map.map(|map| red(map.image));
    assert_eq!([detail.specular_map, detail.shininess_map, detail.emissive_map].map(of), [1, 4, 1].map(Some));
    assert_eq!(detail.emissive_map.unwrap().wrap, Some(crate::options::Wrap::Clamp));
    assert_eq!(
        (detail.specular, detail.shininess, detail.emissive),
        ([1.0; 3], [1.0, 50.0], [1.0, 0.0, 0.0])
    );
    let normal = detail.normal.unwrap();
    assert_eq!((red(normal.map.image), normal.strength.to_bits()), (128, 0.5_f32.to_bits()));
    let height = detail.height.unwrap();
    assert_eq!(model.heights[height.heights].heights, [77 * 257; 4]);
    // Twice a fiftieth of the radius of the triangle.
    assert!((height.range[1] - 0.04 * 5.0_f32.sqrt()).abs() < 1e-6, "{height:?}");
    assert_eq!(height.relief, crate::scene::Relief::Bump);
    let environment = detail.environment.unwrap();
    assert_eq!((red(environment.image), environment.kind), (4, crate::scene::EnvironmentKind::Sphere));
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
        warnings[0].starts_with("m.mtl:2: found normals in \"n.png\" of `bump`, expected heights; they are")
    );
    for color in [[255; 3], [0; 3], [128; 3], [0, 0, 255]] {
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
            warnings[0].starts_with("m.mtl:3: found a texture \"no.png\" that cannot be used"),
            "{warnings:?}"
        );
    }
}
