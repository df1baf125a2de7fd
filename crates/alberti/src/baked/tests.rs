//! A file written here, byte by byte as the module's table says, read and spoilt in every way.

use super::*;
use crate::shaders::{Sunlit, Unlit, VertexColor};
use crate::{Camera, Geometry, MCU, Meshlet, Pass, Stats, View};
use alberti_math::{Q16, Varying, Vector3};
use alberti_raster::{D16, FragmentStage, Rgb565Le, Target};
use alberti_texture::{Nearest, Repeat};
use std::string::ToString;
use std::vec::Vec;

/// Two triangles of a square from -1 to 1, and one of a part behind it without a texture.
const UNIT: f32 = 1.0 / 32000.0;
const PLACES: [[i16; 3]; 7] = [
    [-32000, -32000, 0],
    [32000, -32000, 0],
    [32000, 32000, 0],
    [-32000, 32000, 0],
    [-32000, -32000, -16000],
    [32000, -32000, -16000],
    [0, 32000, -16000],
];
const COORDINATES: [[u16; 2]; 7] = [[0, 0], [32768, 0], [32768, 65535], [0, 65535], [1, 2], [3, 4], [5, 6]];
const TRIANGLES: [[u16; 3]; 3] = [[0, 1, 2], [0, 2, 3], [0, 1, 2]];
const PALETTE: [[u8; 4]; 2] = [[255, 0, 0, 255], [0, 0, 255, 255]];
/// Texels of two levels, 2 x 2 and 1 x 1: a row begins with a byte of its own.
const INDICES: [u8; 3] = [0x01, 0x10, 0x10];

/// A writer of bytes.
#[derive(Default)]
struct File(Vec<u8>);

impl File {
    fn halves(&mut self, halves: impl IntoIterator<Item = u16>) {
        self.0.extend(halves.into_iter().flat_map(u16::to_le_bytes));
    }

    fn words(&mut self, words: impl IntoIterator<Item = u32>) {
        self.0.extend(words.into_iter().flat_map(u32::to_le_bytes));
    }

    fn floats(&mut self, floats: impl IntoIterator<Item = f32>) {
        self.words(floats.into_iter().map(f32::to_bits));
    }

    /// The header of a file with every attribute, and the sections that follow.
    fn new() -> Self {
        let mut file = Self::default();
        file.0.extend(b"ALBK");
        file.halves([2, 15]);
        // The length, then the numbers of vertices, triangles and meshlets.
        file.words([0, 7, 3, 1]);
        // The numbers of parts and textures.
        file.halves([2, 1]);
        file.floats([UNIT]);

        file.halves(PLACES.as_flattened().iter().map(|c| c.cast_unsigned()));
        file.halves(COORDINATES.as_flattened().iter().copied());
        // Normals along z, tangents along x with a handedness of -1, and grey.
        file.0.extend([[0, 0]; 7].as_flattened());
        file.0.extend([[127, 0, 255]; 7].as_flattened());
        file.0.extend([[51, 102, 255]; 7].as_flattened());
        file.halves(TRIANGLES.as_flattened().iter().copied());
        let meshlet = meshlet();
        file.words(meshlet.triangles);
        file.halves(meshlet.center.map(i16::cast_unsigned));
        file.halves([meshlet.radius]);
        file.halves(meshlet.axis.map(i16::cast_unsigned));
        file.halves([meshlet.squared_sine]);
        file.halves(meshlet.depths.map(i16::cast_unsigned));
        // The grids: u from -1 in steps of 2^-15, v from 0 in steps of 2^-16; and both from 4095 in steps of 2^-4.
        let grids = [([-65536, 0], [1, 0]), ([4095 << 16; 2], [12; 2])];
        let parts = [([0, 4, 0, 2, 0, 1], 0), ([4, 3, 2, 1, 1, 0], u16::MAX)];
        for ((ranges, texture), (origin, shifts)) in parts.into_iter().zip(grids) {
            file.words(ranges);
            file.floats([0.0, 0.0, -0.25, 2.0]);
            file.0.extend([1, 2, 3, 4]);
            file.halves([texture, 0]);
            file.words(origin.map(i32::cast_unsigned));
            file.halves(shifts);
        }
        // Indices of 4 bits, two colours, 2 x 2 texels.
        file.halves([4, 2, 2, 2]);
        let texels = u32::try_from(file.0.len() + 8).expect("small");
        file.words([texels, 11]);
        file.0.extend(PALETTE.as_flattened());
        file.0.extend(INDICES);
        let length = u32::try_from(file.0.len()).expect("small");
        file.0[8..12].copy_from_slice(&length.to_le_bytes());
        file
    }
}

/// All of the first part, facing z.
fn meshlet() -> Meshlet {
    Meshlet {
        triangles: [0, 2],
        center: [0, 0, 1024],
        radius: 5796,
        axis: [0, 0, 16384],
        squared_sine: 500,
        depths: [10, 11],
    }
}

#[test]
fn a_file_is_what_was_written() {
    let file = File::new();
    let baked = Baked::read(&file.0).expect("a file");
    assert_eq!((baked.unit(), baked.attributes()), (UNIT, Attributes::ALL));
    let parts: Vec<_> = baked.parts().collect();
    assert_eq!(parts.iter().map(BakedPart::texture).collect::<Vec<_>>(), [Some(0), None]);
    assert_eq!(parts[1].color().to_bytes(), [1, 2, 3, 4]);
    let mesh = parts[0].mesh::<(Tangent, Normal, Color, Uv)>().expect("all attributes");
    assert_eq!((mesh.vertices(), mesh.triangles()), (4, 2));
    let (place, (tangent, normal, color, uv)) = mesh.vertex(2).expect("a vertex");
    assert_eq!(place.coords.to_array(), [1.0, 1.0, 0.0]);
    // -1 + 32768 / 32768, and 65535 / 65536.
    assert_eq!(uv.to_array(), [0.0, 65535.0 / 65536.0]);
    assert_eq!((tangent.to_array(), normal.to_array()), ([1.0, 0.0, 0.0, -1.0], [0.0, 0.0, 1.0]));
    let off = (color - Vec3::new(0.2, 0.4, 1.0)).abs().max_element();
    assert!(off < 1.0 / 32768.0, "{color}");
    assert!(mesh.vertex(4).is_none() && mesh.triangle(2).is_none());
    assert_eq!((mesh.meshlet(0), mesh.meshlet(1)), (Some(meshlet()), None));
    assert_eq!(mesh.ball(), Ball { center: Vec3::new(0.0, 0.0, -0.25), radius: 2.0 });
    // The numbers of the second part are its own.
    let mesh = parts[1].mesh::<Uv>().expect("coordinates");
    assert_eq!(mesh.triangle(0), Some([0, 1, 2]));
    assert_eq!(mesh.integers(1).map(|vertex| vertex.place), Some(PLACES[5]));
    // So is the grid.
    let (_, uv) = mesh.vertex(1).expect("a vertex");
    assert_eq!(uv.to_array(), [4095.0 + 3.0 / 16.0, 4095.0 + 4.0 / 16.0]);

    let Some(Texels::Indexed4(map)) = baked.texture(0) else { panic!("indices of 4 bits") };
    assert_eq!(map.levels(), 2);
    let [red, blue] = PALETTE;
    let texel = |x, y| map.level(0).texel(x, y).to_bytes();
    assert_eq!([texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)], [red, blue, blue, red]);
    assert_eq!(map.level(1).texel(0, 0).to_bytes(), blue);
    assert!(baked.texture(1).is_none());
}

#[test]
fn faults_are_told_with_their_place() {
    let file = File::new().0;
    let spoilt = |at: usize, bytes: &[u8]| {
        let mut file = file.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        Baked::read(&file).expect_err("a fault").to_string()
    };
    let triangles = HEADER + 7 * (6 + 4 + 2 + 3 + 3);
    let meshlets = triangles + 3 * 6;
    let parts = meshlets + 28;
    let textures = parts + 2 * PART;
    for (at, bytes, message) in [
        (0, &b"ELF."[..], "byte 0 of a baked file: found \"ELF.\", expected \"ALBK\"".to_string()),
        (4, &[1], "byte 4 of a baked file: found version 1, expected 2".to_string()),
        (7, &[1], "byte 6 of a baked file: found attributes 0b100001111, expected 0b1111".to_string()),
        (8, &[0, 0], std::format!("found 0 bytes, expected {}", file.len())),
        (14, &[1], "byte 12 of a baked file: found 65543 elements, expected at most".to_string()),
        (16, &[255; 4], "byte 16 of a baked file: found 4294967295 elements, expected at most".to_string()),
        (28, &[0; 4], "byte 28 of a baked file: found 0e0, expected a finite number above 0".to_string()),
        (28, &[0, 0, 192, 127], "byte 28 of a baked file: found NaN".to_string()),
        (
            triangles + 8,
            &[4, 0],
            std::format!("byte {} of a baked file: found vertex 4, expected one below 4", triangles + 6),
        ),
        (
            meshlets + 4,
            &[3],
            std::format!("byte {meshlets} of a baked file: found a range up to 3, expected at most 2"),
        ),
        (parts + 4, &[8], std::format!("byte {parts} of a baked file: found a range up to 8")),
        (parts + 36, &[0, 0, 128, 127], std::format!("byte {parts} of a baked file: found inf")),
        (
            parts + 44,
            &[1],
            std::format!("byte {parts} of a baked file: found texture 1, expected one below 1"),
        ),
        (
            parts + 56,
            &[13],
            std::format!("byte {parts} of a baked file: found a grid of 13, expected at most 12"),
        ),
        (
            parts + PART + 51,
            &[0x10],
            std::format!("byte {} of a baked file: found a grid of 285147136, expected", parts + PART),
        ),
        (textures, &[15], std::format!("byte {textures} of a baked file: found texels of format 15")),
        (textures + 4, &[3], std::format!("byte {textures} of a baked file: found 3 bytes of texels")),
        (textures + 12, &[12], std::format!("byte {textures} of a baked file: found 12 bytes of texels")),
    ] {
        let found = spoilt(at, bytes);
        assert!(found.contains(&message), "{found}, not {message}");
    }
    // Without normals there is no mesh of them: the sections move, so the file is one of other vertices.
    let mut poor = File::default();
    poor.0.extend(b"ALBK");
    poor.halves([2, 1]);
    poor.words([32 + 60, 0, 0, 0]);
    poor.halves([1, 0]);
    poor.floats([1.0]);
    poor.0.resize(HEADER + 40, 0);
    poor.0.extend([0; 4]);
    poor.halves([u16::MAX, 0]);
    poor.0.extend([0; 12]);
    let baked = Baked::read(&poor.0).expect("a file of nothing");
    let part = baked.parts().next().expect("a part");
    assert!(part.mesh::<Uv>().is_ok());
    let message = part.mesh::<(Normal, Uv)>().expect_err("no normals").to_string();
    assert_eq!(message, "byte 6 of a baked file: found attributes 0b1, expected 0b11");
}

/// Draws all of a file into a few pixels, in floats and in integers.
fn draw(baked: &Baked<'_>, view: &View) -> u64 {
    let mut drawn = 0;
    for part in baked.parts() {
        let map = part.texture().and_then(|number| baked.texture(number));
        if let (Ok(mesh), Some(Texels::Indexed4(map))) = (part.mesh::<(Normal, Uv)>(), map) {
            let light = Vector3::new(Vec3::Z);
            drawn += drawn_by(
                view,
                &mesh,
                Sunlit::new(Unlit(map.level(0).sampler(Nearest, Repeat)), light, 0.1, 0.9),
            );
        }
        if let Ok(mesh) = part.mesh::<Color>() {
            drawn += drawn_by(view, &mesh, VertexColor);
        }
    }
    drawn
}

fn drawn_by<A: Attribute>(
    view: &View,
    mesh: &BakedMesh<'_, A>,
    stage: impl FragmentStage<A::Varying>,
) -> u64 {
    let (mut colors, mut depths) = ([0_u16; 64], [0_u16; 64]);
    let mut target = Target::new(Rgb565Le, D16, 8, 8, &mut colors, &mut depths).expect("8 x 8");
    target.clear(Rgba8::BLACK);
    let floats: Stats = Pass::new(view, mesh, stage).draw_counted(&mut target);
    target.clear(Rgba8::BLACK);
    let integers = Pass::new(view, mesh, stage).with(MCU).draw_counted(&mut target);
    floats.written + integers.written
}

fn view() -> View {
    let camera = Camera::look_at(Vec3::Z * 4.0, Vec3::ZERO, Vec3::Y).expect("a camera");
    camera.perspective(0.8, 0.1..10.0).expect("a view")
}

/// Everything that can be asked of a mesh.
fn walk<A: Attribute>(mesh: &BakedMesh<'_, A>) {
    for triangle in (0..=mesh.triangles()).filter_map(|number| mesh.triangle(number)) {
        for index in triangle {
            assert!(mesh.vertex(index).is_some());
            let vertex = mesh.integers(index).expect("checked");
            let _ = A::Varying::map(&vertex.components, &Q16::to_f32);
        }
    }
    for number in 0..4 {
        let _ = mesh.meshlet(number);
    }
}

#[test]
fn no_bytes_panic() {
    let file = File::new().0;
    let view = view();
    assert!(draw(&Baked::read(&file).expect("a file"), &view) > 60);
    for length in 0..file.len() {
        let error = Baked::read(&file[..length]).expect_err("it ends too early");
        assert_eq!(error.fault, Fault::Length);
    }
    let (mut read, mut refused) = (0, 0);
    let mut noise = 1_u32;
    for round in 0..60_000_usize {
        let mut spoilt = file.clone();
        // Every byte with each of 64 values, then several bytes at once.
        let count = if round < 64 * file.len() { 1 } else { 2 + round % 7 };
        for k in 0..count {
            noise = noise.wrapping_mul(0x9e37_79b9).wrapping_add(0x7f4a_7c15);
            let at = if count == 1 { round % file.len() } else { noise as usize / 7 % file.len() };
            let [.., high] = noise.to_le_bytes();
            spoilt[at] =
                if (round + k) % 3 == 0 { high } else { [0, 1, 127, 128, 255][usize::from(high) % 5] };
        }
        match Baked::read(&spoilt) {
            Ok(baked) => {
                read += 1;
                for part in baked.parts() {
                    if let Ok(mesh) = part.mesh::<(Tangent, Normal, Color, Uv)>() {
                        walk(&mesh);
                    }
                }
                if round % 16 == 0 {
                    draw(&baked, &view);
                }
            }
            Err(error) => {
                refused += 1;
                assert!((error.offset as usize) < file.len() && !error.to_string().is_empty());
            }
        }
    }
    assert!(read > 10_000 && refused > 10_000, "{read} {refused}");
}
