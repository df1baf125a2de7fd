//! Station 7: tangent frames of surfaces, and of the triangles that are drawn for them.
//!
//! ```text
//!   parameters  0 surface: torus, sphere, cylinder   1 columns of the mesh   2 3 u, v of the frame that is shown
//!               4 whether the texture is mirrored on one half   5 whether y = z × x there too   6 turn, degrees
//!   results     0..8 the frame in pixels: origin and the tips of x, y, z   8 handedness   9 10 angles between the axes
//!               x and z of the surface and those of its triangle, degrees   11.. the axes x, y, z
//! ```

use crate::canvas::Canvas;
use crate::numbers::{float, index, narrow, turn, whole};
use crate::shading::{self, detail, lit, place, plain};
use crate::textures::Textures;
use crate::{Drawn, Parameters};
use alberti::glam::{Mat3, Vec2, Vec3};
use alberti::shaders::VertexColor;
use alberti::shaders::material::Framed;
use alberti::texture::surface::{Cylinder, Grid, Parametric, Sphere, Tangent, Torus, triangle_frame};
use alberti::*;
use alloc::vec::Vec;

/// A surface of the page.
enum Surface {
    Torus(Torus),
    Sphere(Sphere),
    Cylinder(Cylinder),
}

impl Parametric for Surface {
    fn tangent_frame(&self, uv: Vec2) -> Frame<Tangent, Object> {
        match self {
            Self::Torus(torus) => torus.tangent_frame(uv),
            Self::Sphere(sphere) => sphere.tangent_frame(uv),
            Self::Cylinder(cylinder) => cylinder.tangent_frame(uv),
        }
    }
}

/// The surface with its texture, in the world.
struct Scene {
    surface: Surface,
    /// Textures along u and v.
    repeats: Vec2,
    mirrored: bool,
    /// Whether y is z × x on the mirrored half as well.
    right_handed: bool,
    world: Mat3,
}

pub(crate) fn draw(
    canvas: &mut Canvas,
    results: &mut Vec<f32>,
    textures: &mut Textures,
    parameters: &Parameters,
) -> Drawn {
    let [surface, columns, u, v, mirrored, right_handed, degrees, ..] = *parameters;
    let (surface, repeats) = match whole(surface, 2) {
        0 => (Surface::Torus(Torus { major: 0.95, minor: 0.42 }), Vec2::new(4.0, 2.0)),
        1 => (Surface::Sphere(Sphere { radius: 1.1 }), Vec2::new(4.0, 2.0)),
        _ => (Surface::Cylinder(Cylinder { radius: 0.8, height: 1.8 }), Vec2::new(4.0, 1.5)),
    };
    let [cos, sin] = turn(degrees);
    let about_y = Mat3::from_cols(Vec3::new(cos, 0.0, -sin), Vec3::Y, Vec3::new(sin, 0.0, cos));
    let [cos, sin] = turn(32.0);
    let about_x = Mat3::from_cols(Vec3::X, Vec3::new(0.0, cos, sin), Vec3::new(0.0, -sin, cos));
    let scene = Scene {
        surface,
        repeats,
        mirrored: mirrored > 0.5,
        right_handed: right_handed > 0.5,
        world: about_x * about_y,
    };
    let eye = Vec3::new(0.0, 0.0, 4.4);
    let view = Camera::look_at(eye, Vec3::ZERO, Vec3::Y)?.perspective(0.62, 1.0..10.0)?;
    let wall = textures.wall()?;
    let stage = lit(detail(&wall.colors, &wall.normals, 1.5)?, eye, (Vec3::new(-1.2, 1.6, 2.2), 2.2));

    let halves = [0.0, 0.5].map(|from| scene.half(whole(columns, 128).max(6), from));
    let mut target = canvas.target()?;
    for (vertices, triangles) in &halves {
        shading::draw(&mut target, &view, &shading::mesh(vertices, triangles), stage);
    }
    let needles = scene.needles();
    let lines: Vec<[usize; 2]> = (0..needles.len() / 2).map(|k| [2 * k, 2 * k + 1]).collect();
    let mesh = plain(&needles, &[]);
    Pass::new(&view, &mesh, VertexColor).draw_lines(&mut target, lines);

    let uv = Vec2::new(u, v);
    let (origin, axes) = scene.frame(uv);
    for tip in [Vec3::ZERO, axes.x_axis, axes.y_axis, axes.z_axis] {
        results.extend(place(&view, canvas.size(), origin + tip * 0.55)?.to_array());
    }
    let handedness = axes.determinant().signum();
    let half = &halves[usize::from(u >= 0.5)];
    results.push(handedness);
    results.extend(scene.misses(half, uv));
    results.extend(axes.to_cols_array());
    Ok(())
}

impl Scene {
    /// Whether the texture runs backwards along u.
    fn is_mirrored(&self, u: f32) -> bool {
        self.mirrored && u < 0.5
    }

    /// The texture coordinates at a place of the surface.
    fn texture(&self, uv: Vec2, mirrored: bool) -> Vec2 {
        uv * self.repeats * if mirrored { Vec2::new(-1.0, 1.0) } else { Vec2::ONE }
    }

    /// The point of the world and the axes there, made unit and perpendicular.
    fn frame(&self, uv: Vec2) -> (Vec3, Mat3) {
        self.frame_of(uv, self.is_mirrored(uv.x))
    }

    fn frame_of(&self, uv: Vec2, mirrored: bool) -> (Vec3, Mat3) {
        let frame = self.surface.orthonormal_frame(uv);
        let lowered =
            if let Surface::Cylinder(cylinder) = self.surface { cylinder.height / 2.0 } else { 0.0 };
        let origin = self.world * (frame.origin().coords - Vec3::Y * lowered);
        let Mat3 { mut x_axis, mut y_axis, z_axis } = frame.axes();
        if mirrored {
            x_axis = -x_axis;
            // y is −z × x on mirrored textures, and the same as before. The mistake has z × x.
            y_axis = if self.right_handed { z_axis.cross(x_axis) } else { y_axis };
        }
        (origin, self.world * Mat3::from_cols(x_axis, y_axis, z_axis))
    }

    /// The half of the mesh that begins at `from`, with vertices of its own along the seam.
    fn half(&self, columns: u32, from: f32) -> (Vec<Framed>, Vec<[u32; 3]>) {
        let grid = Grid::new(columns.div_ceil(2), columns.div_ceil(2));
        let mirrored = self.is_mirrored(from);
        let vertex = |k: u32| {
            let uv = grid.uv(k) * Vec2::new(0.5, 1.0) + Vec2::new(from, 0.0);
            let (position, axes) = self.frame_of(uv, mirrored);
            let axes = [axes.x_axis, axes.y_axis, axes.z_axis];
            Framed { position, axes, uv: self.texture(uv, mirrored) }
        };
        let vertices = (0..index(grid.vertices())).map(vertex).collect();
        (vertices, (0..index(grid.triangles())).map(|k| grid.triangle(k)).collect())
    }

    /// Frames all over the surface, as pairs of a colour's ends.
    fn needles(&self) -> Vec<(Vec3, Vec3)> {
        const COLORS: [Vec3; 3] =
            [Vec3::new(1.0, 0.45, 0.4), Vec3::new(0.5, 0.95, 0.5), Vec3::new(0.55, 0.7, 1.0)];
        let places = (0..12).flat_map(|i| (0..6).map(move |j| [i, j]));
        let ends = places.flat_map(|[i, j]| {
            let (origin, axes) = self.frame(Vec2::new((float(i) + 0.5) / 12.0, (float(j) + 0.5) / 6.0));
            // A little above the surface, which they would fight with.
            let foot = origin + axes.z_axis * 0.015;
            let axes = [axes.x_axis, axes.y_axis, axes.z_axis].into_iter().zip(COLORS);
            axes.flat_map(move |(axis, color)| [(foot, color), (foot + axis * 0.14, color)])
        });
        ends.collect()
    }

    /// The angles in degrees, in `f64`, between the axes x and z of the surface and those of the triangle there.
    fn misses(&self, (vertices, triangles): &(Vec<Framed>, Vec<[u32; 3]>), uv: Vec2) -> [f32; 2] {
        let (_, axes) = self.frame(uv);
        let texture = self.texture(uv, self.is_mirrored(uv.x));
        let corners =
            |triangle: &[u32; 3]| triangle.map(|k| vertices.get(k as usize).copied().unwrap_or_default());
        let holds = |corners: &[Framed; 3]| {
            let [a, b, c] = corners.map(|corner| corner.uv - texture);
            let sides = [a.perp_dot(b), b.perp_dot(c), c.perp_dot(a)];
            sides.iter().all(|side| *side >= -1e-6) || sides.iter().all(|side| *side <= 1e-6)
        };
        let found = triangles.iter().map(corners).find(holds).and_then(|corners| {
            triangle_frame(
                corners.map(|corner| Point3::new(corner.position)),
                corners.map(|corner| corner.uv),
            )
        });
        let Some(frame) = found else { return [f32::NAN; 2] };
        [(axes.x_axis, frame.axes().x_axis), (axes.z_axis, frame.axes().z_axis)].map(|(a, b)| {
            let (a, b) = (a.as_dvec3(), b.as_dvec3());
            narrow(libm::atan2(a.cross(b).length(), a.dot(b)).to_degrees())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Page, Station};

    fn results(parameters: [f32; 7]) -> Vec<f32> {
        let mut page = Page::new();
        let mut all = [0.0; crate::PARAMETERS];
        all[..7].copy_from_slice(&parameters);
        page.draw(Station::Frames, [160, 120], &all).unwrap();
        page.results
    }

    #[test]
    fn a_mirrored_texture_has_a_left_handed_frame() {
        let handedness = |mirrored, wrong, u| results([0.0, 24.0, u, 0.3, mirrored, wrong, 20.0])[8];
        let found = [(0.0, 0.0, 0.2), (1.0, 0.0, 0.2), (1.0, 0.0, 0.7), (1.0, 1.0, 0.2)]
            .map(|(mirrored, wrong, u)| handedness(mirrored, wrong, u));
        assert_eq!(found, [1.0, -1.0, 1.0, 1.0]);
    }

    #[test]
    fn triangles_come_nearer_to_the_surface_as_there_are_more() {
        for surface in [0.0, 1.0, 2.0] {
            // At several places, since a triangle's frame is right somewhere in it.
            let miss = |columns: f32| -> f32 {
                let at =
                    |u: f32| results([surface, columns, u, 0.37, 0.0, 0.0, 20.0])[9..11].iter().sum::<f32>();
                [0.11, 0.23, 0.31, 0.62, 0.83].map(at).iter().sum()
            };
            let (few, many) = (miss(8.0), miss(96.0));
            assert!(many < few / 2.0, "surface {surface}: {few} {many}");
        }
    }
}
