//! Tests of the OBJ loader: from files to a model.

use std::{fs, io};

use super::*;
use crate::scene::Vertex;

mod maps;

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// A folder with these files, of which `m.obj` is loaded.
fn load_files(files: &[(&str, &[u8])]) -> (Model, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    let loaded = load(&folder.path().join("m.obj"), None, &mut |done, total| assert!(done <= total)).unwrap();
    let prefix = format!("{}/", folder.path().display());
    (loaded.model, loaded.warnings.lines().map(|l| l.replace(&prefix, "")).collect())
}

fn load_text(text: &str) -> Model {
    let (model, warnings) = load_files(&[("m.obj", text.as_bytes())]);
    assert!(warnings.iter().all(|warning| warning.ends_with("they are not drawn")), "{warnings:?}");
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
fn libraries_of_other_names_are_told() {
    let obj = format!("mtllib C:\\x\\M.MTL\n{CORNERS}usemtl a\nf 1 2 3\n");
    let (model, warnings) = load_files(&[("m.obj", obj.as_bytes()), ("m.mtl", b"newmtl a\nKd 1 0 0\n")]);
    assert_eq!(model.parts[0].diffuse, [1.0, 0.0, 0.0]);
    let found = r#"m.obj:1: found no file "C:\x\M.MTL", expected an MTL material library; "m.mtl" is used"#;
    assert_eq!(warnings, [found]);
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
    let model = load_text(&format!(
        "{CORNERS}f 1 2 3\no empty\no one\nf 1 2 3\ng two three\nf 1 3 4\nf 2 3 4\no last\n"
    ));
    let parts: Vec<_> = model.parts.iter().map(|p| (p.name.as_str(), p.triangles.len())).collect();
    assert_eq!(parts, [("", 1), ("one", 1), ("two three", 2)]);
    assert_eq!(model.parts[2].triangles[0], [6, 7, 8]);
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
    assert_eq!(warnings, ["b.mtl:2: found 2 after `Kd`, expected a number from 0 to 1; it is clamped"]);
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
        ("m.mtl", b"newmtl red\nmap_Kd no.png\nnewmtl Blue\nmap_Kd no2.png"),
    ]);
    assert!(warnings[1].ends_with("; the default material is used; did you mean \"Blue\"?"), "{warnings:?}");
    assert!(model.textures.is_empty() && model.parts.iter().all(|p| p.texture.is_none()));
    let starts = [
        "m.obj:10: found `usemtl` \"\"",
        "m.obj:12: found `usemtl` \"blue\"",
        "m.mtl:2: found no such file for the texture \"no.png\"",
    ];
    assert_eq!(warnings.len(), 3, "{warnings:?}");
    for (warning, start) in warnings.iter().zip(starts) {
        assert!(warning.starts_with(start), "{warning}");
    }
}

#[test]
fn what_is_not_drawn_is_told() {
    let obj = format!("{CORNERS}f 1 2 3\np 1\np 2\nl 1 2 3\nsurf 0 1 0 1 1 2 3\n");
    let (_, warnings) = load_files(&[("m.obj", obj.as_bytes())]);
    let told = "m.obj: found 1 line (`l`) and 2 points (`p`) and 1 curve or surface, expected faces; they are not drawn";
    assert_eq!(warnings, [told]);
}

/// Programs write such of what has no area.
#[test]
fn normals_and_coordinates_that_are_no_numbers_are_made() {
    let obj =
        format!("{CORNERS}vt nan 1\nvn -nan(ind) 0 1\nvn 0 1.#QNAN 0\nvn 0 0 -Inf\nf 1/1/1 2/1/2 3/1/3\n");
    let (model, warnings) = load_files(&[("m.obj", obj.as_bytes())]);
    let told = "m.obj:5: found 4 normals or texture coordinates that are no numbers, of which this is the first, \
        expected finite numbers; such normals are made, and such coordinates are 0";
    assert_eq!(warnings, [told]);
    let bare = load_text(&format!("{CORNERS}f 1 2 3\n"));
    assert_eq!(model.vertices, bare.vertices);
    assert!(model.vertices.iter().all(|vertex| vertex.normal == [0.0, 0.0, 1.0]));
}

/// Exporters write such files.
#[test]
fn indices_of_what_a_file_has_not_at_all_are_left_out() {
    let obj = format!("{CORNERS}f 1 2 3\nf 1/4/5 2/4/6 3/9/99999999999\n");
    let (model, warnings) = load_files(&[("m.obj", obj.as_bytes())]);
    let told = |name, line| {
        format!(
            "m.obj:{LINE}: found an index of a {name} in a face, expected `{line}` lines, or none; the file has no \
             such lines; they are left out",
            LINE = CORNERS.lines().count() + 2
        )
    };
    assert_eq!(warnings, [told("texture coordinate", "vt"), told("normal", "vn")]);
    let bare = load_text(&format!("{CORNERS}f 1 2 3\nf 1 2 3\n"));
    assert_eq!(corners(&model), corners(&bare));
    assert_eq!(model.vertices, bare.vertices);
}

#[test]
fn degenerate_faces_are_kept() {
    assert_eq!(load_text(&format!("{CORNERS}f 1 1 1\nf 1 2 3\n")).parts[0].triangles.len(), 2);
    let obj = format!("{CORNERS}f 1 1 1\nf 1 2 1\n");
    let (model, warnings) = load_files(&[("m.obj", obj.as_bytes())]);
    assert_eq!(model.parts[0].triangles.len(), 2);
    assert_eq!(
        warnings,
        ["m.obj: found only faces without area, expected a surface; there is nothing to see"]
    );
}

#[test]
fn concave_faces_are_cut_and_crossing_ones_told() {
    let model = load_text("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 2 3 4 5 6 1\n");
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| model.vertices[i as usize].position);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let areas: Vec<_> = model.parts[0].triangles.iter().map(area).collect();
    assert!(
        areas.iter().all(|&area| area > 0.0) && (areas.iter().sum::<f32>() - 8.0).abs() < 1e-6,
        "{areas:?}"
    );

    let text = format!("{CORNERS}f 1 2 3 4\nf 1 3 2 4\nf 3 1 2 4\n");
    let (_, warnings) = load_files(&[("m.obj", text.as_bytes())]);
    assert_eq!(
        warnings,
        ["m.obj:6: found 2 faces that cross themselves, expected outlines that do not cross themselves; \
          this is the first; their fill may be wrong"]
    );
}

/// The vertices of a box whose faces are quads, loaded with these lines before them.
fn box_with(lines: [&str; 2], normals: Option<Normals>) -> Model {
    let mut text = "vn 0 0 1\n".to_owned();
    for corner in 0..8 {
        text += &format!("v {} {} {}\n", corner & 1, corner >> 1 & 1, corner >> 2);
    }
    let faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"];
    for (i, face) in faces.iter().enumerate() {
        text += &format!("{}\nf {face}\n", lines[i / 3]);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.obj");
    fs::write(&path, text).unwrap();
    load(&path, normals, &mut |_, _| {}).unwrap().model
}

#[test]
fn smoothing_groups_are_obeyed_unless_normals_are_asked_for() {
    let vertices = |lines, normals| box_with(lines, normals).vertices.len();
    // Of angles, of no groups, of one group.
    assert_eq!(vertices(["", ""], None), 24);
    assert_eq!(vertices(["s off", "s 0"], None), 24);
    assert_eq!(vertices(["s 1", "s 1"], None), 8);
    // Three faces that have all corners, and the three opposite ones.
    assert_eq!(vertices(["s 1", "s 2"], None), 16);
    // Those before any `s` have an angle.
    assert_eq!(vertices(["", "s 2"], None), 3 * 4 + 8);
    for (normals, wanted) in
        [(Normals::Smooth, 8), (Normals::Flat, 24), (Normals::Crease(60.0), 24), (Normals::Crease(91.0), 8)]
    {
        for lines in [["", ""], ["s 1", "s off"]] {
            assert_eq!(vertices(lines, Some(normals)), wanted, "{normals:?}");
        }
    }
    let flat = box_with(["s off", "s off"], None);
    for triangle in &flat.parts[0].triangles {
        let normals = triangle.map(|i| flat.vertices[i as usize].normal);
        assert!(normals == [normals[0]; 3] && normals[0].iter().filter(|x| x.abs() == 1.0).count() == 1);
    }
}

#[test]
fn normals_of_the_file_come_first_unless_others_are_asked_for() {
    let text = format!("{CORNERS}vn 0 1 0\nf 1//1 2//1 3//1\n");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.obj");
    fs::write(&path, text).unwrap();
    let normal = |normals| load(&path, normals, &mut |_, _| {}).unwrap().model.vertices[0].normal;
    assert_eq!(normal(None), [0.0, 1.0, 0.0]);
    assert_eq!(normal(Some(Normals::Flat)), [0.0, 0.0, 1.0]);
}

#[test]
fn far_models_keep_their_shape() {
    let text = |[x, y, z]: [f64; 3]| {
        let at = |[a, b, c]: [f64; 3]| format!("v {} {} {}\n", x + a, y + b, z + c);
        let corners = [[0.0, 0.015_625, 0.0], [1.0, 0.0, 0.031_25], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        corners.map(at).concat() + "f 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n"
    };
    let (near, far) = (load_text(&text([0.0; 3])), load_text(&text([500_000.0, 120.0, 4e6])));
    // The unit of the origin is the extent of 1.
    let shift = [0, 1, 2].map(|axis| far.origin[axis] - [500_000.0, 120.0, 4e6][axis]);
    assert_eq!((near.origin, shift.map(f64::abs)), ([0.0; 3], [1.0; 3].map(|x| shift[0].abs() * x)));
    for (a, b) in near.vertices.iter().zip(&far.vertices) {
        let moved = [0, 1, 2].map(|axis| f64::from(b.position[axis]) + shift[axis]);
        assert_eq!((a.position.map(f64::from), a.normal), (moved, b.normal));
    }
}

#[test]
fn corners_of_many_kinds_at_one_position_are_found_again() {
    use std::fmt::Write as _;
    let mut text = format!("{CORNERS}vn 0 0 1\n");
    for i in 0..40 {
        writeln!(text, "vt 0.{i} 0").unwrap();
    }
    // Twice the same, so that half of the corners are known; then in an object of its own.
    for object in 0..4 {
        if object == 2 {
            text += "o next\n";
        }
        for i in 1..=40 {
            writeln!(text, "f 1/{i}/1 2/1/1 3/1/1").unwrap();
        }
    }
    let model = load_text(&text);
    assert_eq!((model.vertices.len(), model.parts.len()), (2 * 42, 2));
    for part in &model.parts {
        for (i, triangle) in part.triangles.iter().enumerate() {
            let wanted: f32 = format!("0.{}", i % 40).parse().unwrap();
            assert_eq!(model.vertices[triangle[0] as usize].uv, [wanted, 0.0]);
        }
    }
}

#[test]
fn a_ten_megabyte_file_loads() {
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
    assert_eq!(load_text(&text).vertices.len(), n);
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
        match load(&obj, None, &mut |_, _| {}) {
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
