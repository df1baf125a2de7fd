//! MikkTSpace, against the original in C.

use crate::support::vec3;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::surface::{LengthError, mikktspace};
use glam::{Vec2, Vec3};
use mikktspace_sys::{MikkTSpaceInterface, gen_tang_space_default};

struct Mesh {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    fn ours(&self) -> Vec<[[f32; 4]; 3]> {
        let mut corners = vec![[[f32::NAN; 4]; 3]; self.triangles.len()];
        mikktspace(&self.positions, &self.normals, &self.uvs, &self.triangles, &mut corners)
            .expect("as many");
        corners
    }

    fn original(&self) -> Vec<[[f32; 4]; 3]> {
        let mut asked = Asked { mesh: self, corners: vec![[[f32::NAN; 4]; 3]; self.triangles.len()] };
        assert!(gen_tang_space_default(&mut asked));
        asked.corners
    }
}

struct Asked<'a> {
    mesh: &'a Mesh,
    corners: Vec<[[f32; 4]; 3]>,
}

impl MikkTSpaceInterface for Asked<'_> {
    fn get_num_faces(&self) -> usize {
        self.mesh.triangles.len()
    }

    fn get_num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn get_position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.positions[self.mesh.triangles[face][corner] as usize].to_array()
    }

    fn get_normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.normals[self.mesh.triangles[face][corner] as usize].to_array()
    }

    fn get_tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.mesh.uvs[self.mesh.triangles[face][corner] as usize].to_array()
    }

    fn set_tspace_basic(&mut self, [x, y, z]: [f32; 3], sign: f32, face: usize, corner: usize) {
        self.corners[face][corner] = [x, y, z, sign];
    }
}

/// A bent grid with a texture that is mirrored, stretched, cut or without area in places, and with vertices that stand
/// at the same place.
fn mesh(rng: &mut Rng) -> Mesh {
    let (columns, rows) = (rng.range(1, 8) as u32, rng.range(1, 8) as u32);
    let mut mesh = Mesh { positions: vec![], normals: vec![], uvs: vec![], triangles: vec![] };
    let (bend, scale) = (vec3(rng, 1.0), rng.log_uniform(1e-2, 1e2));
    let mirrored = rng.one_in(2);
    for j in 0..=rows {
        for i in 0..=columns {
            let (x, y) = (i as f32, j as f32);
            let noise = vec3(rng, 0.2);
            mesh.positions.push((Vec3::new(x, y, bend.x * x * y + bend.y * y * y) + noise) * scale);
            mesh.normals.push((Vec3::Z + vec3(rng, 0.5)).normalize());
            let u = if mirrored { (x - 3.0).abs() } else { x + noise.y };
            mesh.uvs.push(Vec2::new(u, y + bend.z * x) / 8.0);
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            let mut at = |i: u32, j: u32| {
                let k = j * (columns + 1) + i;
                if !rng.one_in(6) {
                    return k;
                }
                // Another vertex, equal to this, or with another normal or coordinate.
                let same = k as usize;
                mesh.positions.push(mesh.positions[same]);
                mesh.normals.push(if rng.one_in(3) { Vec3::Y } else { mesh.normals[same] });
                mesh.uvs.push(if rng.one_in(3) { mesh.uvs[0] } else { mesh.uvs[same] });
                mesh.positions.len() as u32 - 1
            };
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

fn bits(corners: &[[[f32; 4]; 3]]) -> Vec<u32> {
    corners.iter().flatten().flatten().map(|x| x.to_bits()).collect()
}

#[test]
fn the_bits_of_the_original() {
    let mut rng = Rng::new(run_seed());
    let (mut compared, mut split, mut none, mut zero, mut differing) = (0, 0, 0, 0, 0);
    for _ in 0..3000 {
        let mesh = mesh(&mut rng);
        let (ours, mut original) = (mesh.ours(), mesh.original());
        for tangent in original.iter_mut().flatten() {
            // Where the mean is along the normal, the original leaves zero.
            if tangent[..3] == [0.0; 3] {
                *tangent = [1.0, 0.0, 0.0, -1.0];
                zero += 1;
            }
        }
        differing += usize::from(bits(&ours) != bits(&original));
        compared += ours.len() * 3;
        none += ours.iter().flatten().filter(|t| **t == [1.0, 0.0, 0.0, -1.0]).count();
        let mut first = vec![None; mesh.positions.len()];
        for (triangle, corners) in mesh.triangles.iter().zip(&ours) {
            for (vertex, tangent) in triangle.iter().zip(corners) {
                split += usize::from(*first[*vertex as usize].get_or_insert(*tangent) != *tangent);
            }
        }
    }
    println!(
        "{compared} corners, {split} split from their vertex, {none} without a tangent, {zero} of them of length 0"
    );
    assert!(compared > 200_000 && split > 1000 && none > 100 && zero < none / 100);
    assert_eq!(differing, 0);
}

#[test]
fn hostile_meshes() {
    let mut rng = Rng::new(run_seed());
    for round in 0..3000 {
        let mut mesh = mesh(&mut rng);
        for _ in 0..rng.range(1, 20) {
            let (k, f) = (rng.index(mesh.positions.len()), rng.index(mesh.triangles.len()));
            match rng.range(0, 4) {
                0 => mesh.positions[k].x = rng.any_f32(),
                1 => mesh.normals[k] = Vec3::splat(rng.any_f32()),
                2 => mesh.uvs[k].y = rng.any_f32(),
                3 => mesh.triangles[f][1] = rng.u64() as u32,
                _ => mesh.triangles[f][2] = mesh.triangles[f][0],
            }
        }
        // All vertices small, or all large: products underflow, or come near to the greatest numbers.
        let scale = [1.0, 1e-30, 1e9][round % 3];
        mesh.positions.iter_mut().for_each(|p| *p *= scale);
        for [x, y, z, w] in mesh.ours().into_iter().flatten() {
            let length = Vec3::new(x, y, z).as_dvec3().length();
            assert!((length - 1.0).abs() < 1e-5 && w.abs() == 1.0, "{round}: {x}, {y}, {z}, {w}");
        }
    }
    let mut corners = [[[0.0; 4]; 3]];
    let error = mikktspace(&[], &[Vec3::X], &[], &[[0, 1, 2]], &mut corners).unwrap_err();
    assert_eq!(error, LengthError { found: 1, expected: 0 });
    mikktspace(&[], &[], &[], &[[0, 1, 2]], &mut corners).expect("as many");
    assert_eq!(corners, [[[1.0, 0.0, 0.0, -1.0]; 3]]);
}

/// A few triangles between a few vertices of a lattice: edges of more than two, mirrored and turned over, without area
/// in the texture.
fn soup(rng: &mut Rng) -> Mesh {
    let (faces, vertices) = (rng.range(2, 6), rng.range(3, 8));
    let mut mesh = Mesh { positions: vec![], normals: vec![], uvs: vec![], triangles: vec![] };
    for _ in 0..vertices {
        let mut upto = |most: i64| rng.range(0, most) as f32;
        mesh.positions.push(Vec3::new(upto(2), upto(2), upto(1)));
        mesh.normals.push(if upto(4) == 0.0 { Vec3::Y } else { Vec3::Z });
        mesh.uvs.push(Vec2::new(upto(2), upto(2)));
    }
    let triangle = |_| [(); 3].map(|()| rng.range(0, vertices - 1) as u32);
    mesh.triangles = (0..faces).map(triangle).collect();
    mesh
}

/// The bits of the original but where a triangle has two corners at one place; there a few corners differ.
#[test]
fn soups() {
    let mut rng = Rng::stream(run_seed(), 1);
    let (mut plain, mut of_degenerate, mut others) = (0, 0, 0);
    for _ in 0..100_000 {
        let mesh = soup(&mut rng);
        let (ours, mut original) = (mesh.ours(), mesh.original());
        for tangent in original.iter_mut().flatten().filter(|tangent| tangent[..3] == [0.0; 3]) {
            *tangent = [1.0, 0.0, 0.0, -1.0];
        }
        let degenerate = mesh.triangles.iter().any(|triangle| {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
            a == b || b == c || c == a
        });
        if degenerate {
            let pairs = ours.iter().flatten().zip(original.iter().flatten());
            others += pairs.filter(|(ours, original)| ours != original).count();
            of_degenerate += ours.len() * 3;
        } else {
            assert_eq!(bits(&ours), bits(&original), "{:?}", mesh.triangles);
            plain += ours.len() * 3;
        }
    }
    println!("{plain} corners alike; {others} of {of_degenerate} others differ beside degenerate triangles");
    assert!(plain > 50_000 && others > 0 && others * 500 < of_degenerate);
}
