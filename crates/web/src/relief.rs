//! Station 5: one brick wall under a lamp, by each way to have detail.
//!
//! ```text
//!   parameters  0 way, an index of the list below   1 depth of the mortar   2 side from which the eye looks, degrees
//!               3 layers of the last two parallax maps   4 5 6 the lamp: right, up, before the wall
//!   results     0 triangles   1 2 shift of the coordinates in a joint, in texels   3 height found there
//!               4 slant of the ray
//!   ways        0 none   1 bump map   2 normal map   3 parallax   4 parallax with limit   5 steep   6 occlusion
//!               7 displacement
//! ```

use crate::canvas::Canvas;
use crate::numbers::{float, narrow, turn, whole};
use crate::shading::{self, Heights, detail, lit};
use crate::textures::{RISE, Textures, WALL};
use crate::{Drawn, Fault, Parameters};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::{Lanes, Machine};
use alberti::shaders::material::{Bump, Framed, Parallax};
use alberti::texture::format::Rgba8888;
use alberti::texture::surface::{AnyParallax, Grid, HeightMap, MeshBuffers, Plane, Relief, displaced_mesh};
use alberti::texture::{Bilinear, Repeat, Texture};
use alberti::*;
use alloc::vec;
use alloc::vec::Vec;

/// The wall's width and height; a texture is 1 wide and high.
const EXTENT: Vec2 = Vec2::new(4.0, 3.0);

/// The cells of the displaced wall.
const CELLS: Grid = Grid::new(256, 192);

pub(crate) fn draw(
    canvas: &mut Canvas,
    results: &mut Vec<f32>,
    textures: &mut Textures,
    parameters: &Parameters,
) -> Drawn {
    let [way, depth, degrees, layers, x, y, z, ..] = *parameters;
    let (way, wall) = (whole(way, 7), textures.wall()?);
    let heights = Texture::new(Rgba8888, &wall.heights, WALL, WALL)?.sampler(Bilinear, Repeat);
    let relief = Relief { map: heights, low: -depth, high: 0.0, extent: Vec2::ONE };
    let layers = whole(layers, 128).max(1);
    let parallax = match way {
        3 => Some(AnyParallax::Offset),
        4 => Some(AnyParallax::Limited),
        5 => Some(AnyParallax::Steep { layers }),
        6 => Some(AnyParallax::Occlusion { layers }),
        _ => None,
    };

    let [cos, sin] = turn(degrees);
    let (eye, lamp) = (Vec3::new(2.7 * sin, 0.25, 2.7 * cos), Vec3::new(x, y, z.max(0.05)));
    let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y)?;
    let view = camera.perspective(0.75, 0.1..20.0)?;
    let mut target = canvas.target()?;
    // Normals of the map are those of one depth; another makes them as many times as steep.
    let by_map = if way == 2 || parallax.is_some() { depth / RISE } else { 0.0 };
    let mut layers = detail(&wall.colors, &wall.normals, by_map)?;
    layers.0 = parallax.map(|policy| Parallax { relief, policy });
    layers.4 = (way == 1).then_some(Bump(relief));
    let (vertices, triangles) = if way == 7 { displaced_wall(&relief)? } else { flat() };
    let mesh = shading::mesh(&vertices, &triangles);
    let stats = shading::draw(&mut target, &view, &mesh, lit(layers, eye, (lamp, 1.0)));
    results.push(float(usize::try_from(stats.submitted).unwrap_or(usize::MAX)));
    results.extend(joint(&relief, parallax, eye));
    Ok(())
}

type Surface = (Vec<Framed>, Vec<[u32; 3]>);

/// Two triangles.
fn flat() -> Surface {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let vertex = |(x, y): (f32, f32)| {
        let uv = Vec2::new(x, y) * EXTENT / 2.0;
        Framed { position: uv.extend(0.0), axes: [Vec3::X, Vec3::Y, Vec3::Z], uv }
    };
    (corners.map(vertex).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
}

/// A grid whose vertices are moved, with the normals of its triangles.
fn displaced_wall(relief: &Relief<Heights<'_>>) -> Result<Surface, Fault> {
    let count = CELLS.vertices();
    let (mut positions, mut normals) = (vec![Vec3::ZERO; count], vec![Vec3::ZERO; count]);
    let (mut uvs, mut triangles) = (vec![Vec2::ZERO; count], vec![[0; 3]; CELLS.triangles()]);
    let plane = Plane {
        origin: Point3::new((-EXTENT / 2.0).extend(0.0)),
        du: Vector3::new(Vec3::X * EXTENT.x),
        dv: Vector3::new(Vec3::Y * EXTENT.y),
    };
    let on_texture = |uv: Vec2| (uv - 0.5) * EXTENT;
    let stretched = Relief {
        map: |uv: Vec2| relief.map.height(on_texture(uv)),
        low: relief.low,
        high: relief.high,
        extent: EXTENT,
    };
    let buffers = MeshBuffers {
        positions: &mut positions,
        normals: &mut normals,
        uvs: &mut uvs,
        triangles: &mut triangles,
    };
    displaced_mesh(&plane, &stretched, CELLS, buffers)?;
    let vertex = |((position, normal), uv): ((Vec3, Vec3), Vec2)| Framed {
        position,
        axes: [Vec3::X, Vec3::Y, normal],
        uv: on_texture(uv),
    };
    Ok((positions.into_iter().zip(normals).zip(uvs).map(vertex).collect(), triangles))
}

/// The shift of the coordinates in a joint in texels, the height where it leads, and the slant of the ray.
fn joint(relief: &Relief<Heights<'_>>, policy: Option<AnyParallax>, eye: Vec3) -> [f32; 4] {
    // In a joint between two bricks of a row: their faces are where the wall is, and do not shift.
    let uv = Vec2::new(0.25, 0.125);
    let to_eye = (eye - uv.extend(0.0)).normalize();
    let found = policy.map_or(uv, |policy| place(relief, policy, uv, to_eye));
    let shift = (found - uv) * float(WALL as usize);
    [shift.x, shift.y, relief.height(found), slant(to_eye)]
}

/// The place that is seen, by the search of the picture's kernel.
fn place(relief: &Relief<Heights<'_>>, policy: AnyParallax, uv: Vec2, to_eye: Vec3) -> Vec2 {
    let Some(machine) = Machine::all().next() else { return uv };
    for_lanes!(machine, lanes => {
        let everywhere = |x: f32| lanes.splat(x);
        let (uv, to_eye) = (uv.to_array().map(everywhere), to_eye.to_array().map(everywhere));
        let found = relief.parallax_lanes(policy, lanes, uv, to_eye);
        Vec2::from(found.map(|x| lanes.store(x)[0]))
    })
}

/// k = |V_xy|/V_z, in `f64`.
fn slant(to_eye: Vec3) -> f32 {
    let v = to_eye.as_dvec3();
    narrow(v.truncate().length() / v.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Page, Station, hash};

    #[test]
    fn every_way_has_a_picture_of_its_own() {
        let mut page = Page::new();
        let mut seen = Vec::new();
        for way in 0..8 {
            let mut parameters = [0.0; crate::PARAMETERS];
            parameters[..7].copy_from_slice(&[float(way), 0.08, 40.0, 16.0, -0.6, 0.6, 0.8]);
            page.draw(Station::Relief, [160, 120], &parameters).unwrap();
            seen.push(hash(page.canvas.pixels()));
            assert_eq!(page.results[0] > 2.0, way == 7);
        }
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), 8);
    }
}
