//! Small meshes of any shape: normals and tangents are unit vectors at right angles, and triangles' directions those of
//! f64.

use super::{ensure, rng};
use crate::Found;
use alberti::glam::{DVec3, Vec2, Vec3};
use alberti::{Object, Point3};
use alberti_oracle::rng::Rng;
use alberti_texture::surface::{triangle_directions, vertex_normals, vertex_tangents};

/// Meshes of a block.
const MESHES: u64 = 10_000;

/// In units of 2^-24: of lengths and cosines as documented, with the rounding of this test's own sums.
const BOUND: f64 = 1.1;
const EPSILON: f64 = 1.0 / 16_777_216.0;

fn place(rng: &mut Rng, size: f32) -> Vec3 {
    let mut coordinate = || (rng.uniform(-1.0, 1.0) as f32) * size;
    Vec3::new(coordinate(), coordinate(), coordinate())
}

/// The angle between a vector and the exact direction, in units of 2^-24.
fn off(found: Vec3, exact: DVec3) -> f64 {
    let (found, exact) = (found.as_dvec3().normalize(), exact.normalize());
    found.cross(exact).length() / EPSILON
}

/// So many meshes of eight vertices and ten triangles.
///
/// # Errors
/// A vector that is not as documented.
pub fn block(block: u64, seed: u64) -> Result<Found, String> {
    let (mut rng, mut worst) = (rng(block, seed), 0.0_f64);
    for _ in 0..MESHES {
        let size = rng.log_uniform(1e-6, 1e6);
        let positions = [(); 8].map(|()| place(&mut rng, size));
        let uvs = [(); 8].map(|()| Vec2::new(rng.uniform(-4.0, 4.0) as f32, rng.uniform(-4.0, 4.0) as f32));
        let triangles = [(); 10].map(|()| [(); 3].map(|()| rng.index(8) as u32));
        let (mut normals, mut tangents) = ([Vec3::ZERO; 8], [[0.0; 4]; 8]);
        let made = vertex_normals(&positions, &triangles, &mut normals);
        let made = made.and_then(|()| vertex_tangents(&positions, &normals, &uvs, &triangles, &mut tangents));
        made.map_err(|error| error.to_string())?;
        for (normal, [x, y, z, w]) in normals.into_iter().zip(tangents) {
            let tangent = Vec3::new(x, y, z);
            let lengths = [normal, tangent].map(|v| (v.as_dvec3().length() - 1.0).abs() / EPSILON);
            let cosine = tangent.as_dvec3().dot(normal.as_dvec3()).abs() / EPSILON;
            let most = lengths[0].max(lengths[1]).max(cosine);
            ensure!(most <= BOUND + 1.0 && (w == 1.0 || w == -1.0), "{normal:?} {tangent:?} {w}: {most}");
            worst = worst.max(most);
        }
        let [a, b, c] = triangles[0].map(|k| positions[k as usize]);
        let [s, t, u] = triangles[0].map(|k| uvs[k as usize].as_dvec2());
        let [p, q] = [b, c].map(|corner| corner.as_dvec3() - a.as_dvec3());
        let [e, f] = [t - s, u - s];
        let area = e.perp_dot(f);
        let sine = area.abs() / (e.length() * f.length());
        let flat = p.cross(q).length() / (p.length() * q.length());
        let found =
            triangle_directions([a, b, c].map(Point3::<Object>::new), triangles[0].map(|k| uvs[k as usize]));
        if let Some([along_u, along_v]) = found
            && sine > 1e-3
            && flat > 1e-3
        {
            let exact = [(p * f.y - q * e.y) * area.signum(), (q * e.x - p * f.x) * area.signum()];
            let most = off(along_u.coords, exact[0]).max(off(along_v.coords, exact[1]));
            ensure!(most <= BOUND + 0.1, "directions off by {most}: {a} {b} {c} {s} {t} {u}");
            worst = worst.max(most);
        }
    }
    Ok(Found { cases: MESHES, worst })
}
