//! Errors in texels: how far off the place on the texture is that a pixel shows.

use crate::measure::{MOST, percentile};
use crate::probe::{Probes, Seen};
use crate::scene::{COLOR_STEPS, Model};

/// The 99.9 % percentile over the pixels on which either drawing shows something, in texels of the part's texture. A
/// part without one counts as having as many texels along a side as a colour has steps.
///
/// Where both show the same part, texture coordinates are compared, whichever triangles they are on: beyond an edge
/// within a surface they go on nearly the same. Another part, or the background, is beyond every budget, and so is
/// another place of the same part by its texture coordinates.
pub(super) fn error(model: &Model, right: &Probes, found: &Probes) -> f64 {
    let sides: Vec<[f64; 2]> = model.parts.iter().map(|part| sides(model, part.texture)).collect();
    let errors: Vec<f64> = (0..right.pixels())
        .filter_map(|index| match (right.seen(index), found.seen(index)) {
            (None, None) => None,
            (Some(right), Some(found)) if right.part == found.part => {
                Some(apart(&right, &found, *sides.get(right.part)?))
            }
            _ => Some(f64::INFINITY),
        })
        .collect();
    percentile(&errors, MOST).unwrap_or_default()
}

/// The distance of two places on a part, by the axis on which it is greater; NaN if there is none.
fn apart(right: &Seen, found: &Seen, sides: [f64; 2]) -> f64 {
    let (Some(right), Some(found)) = (right.uv, found.uv) else { return 0.0 };
    let [u, v] = [0, 1].map(|axis| (right[axis] - found[axis]).abs() * sides[axis]);
    if u > v || u.is_nan() { u } else { v }
}

fn sides(model: &Model, texture: Option<usize>) -> [f64; 2] {
    let image = texture.and_then(|index| model.textures.get(index));
    image.map_or([f64::from(COLOR_STEPS); 2], |image| [image.width, image.height].map(f64::from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::{
        Cull, DepthFormat, Filter, Policies, Projection, RenderOptions, Shading, Subpixel, Wrap,
    };
    use crate::probe::probe;
    use crate::scene::{Camera, Image, Part, Vertex};
    use std::num::NonZero;

    const CAMERA: Camera = Camera {
        eye: [0.0, 0.0, 4.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 60.0,
        near: 1.0,
        far: 10.0,
    };

    /// Two squares with a texture of 64 texels, turned about the vertical axis by the same angle to either side. So
    /// half of each is before the other. They are two parts, or one.
    fn crossing(parts: usize) -> Model {
        let square = |turn: f32| {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0f32]].map(|[x, y]| Vertex {
                position: [x, y, x * turn],
                uv: [(x + 1.0) / 2.0, (y + 1.0) / 2.0],
                ..Vertex::default()
            })
        };
        let vertices = [square(0.5), square(-0.5)].concat();
        let triangles = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        let texture = Image { width: 64, height: 64, texels: vec![[255; 4]; 64 * 64] };
        let part = |triangles: &[[u32; 3]]| Part {
            triangles: triangles.to_vec(),
            texture: Some(0),
            ..Part::default()
        };
        let parts = triangles.chunks(4 / parts).map(part).collect();
        Model { vertices, parts, textures: vec![texture.into()], ..Model::default() }
    }

    fn probes(model: &Model, depth: DepthFormat, subpixel: Subpixel) -> Probes {
        let options = RenderOptions {
            width: 160,
            height: 120,
            background: [0; 3],
            shading: Shading::Unlit,
            filter: Filter::Nearest,
            wrap: Wrap::Repeat,
            cull: Cull::None,
            depth,
            projection: Projection::Perspective,
            haze: None,
            light: crate::options::LightOptions::default(),
            threads: NonZero::<usize>::MIN,
            policies: Policies { subpixel, ..Policies::default() },
        };
        probe(model, &CAMERA, &options).expect("a picture")
    }

    /// Without a depth buffer the second square is seen where the first one is nearer: a quarter of the pixels or more.
    #[test]
    fn what_another_surface_hides_counts() {
        for parts in [1, 2] {
            let model = crossing(parts);
            let right = probes(&model, DepthFormat::F32Reversed, Subpixel::Sub8);
            let found = probes(&model, DepthFormat::None, Subpixel::Sub8);
            let error = error(&model, &right, &found);
            // The line of sight to the right edge of the second square meets the first at x = 0.8: 6.4 texels before.
            let expected = if parts == 2 { f64::INFINITY..=f64::INFINITY } else { 6.0..=6.5 };
            assert!(expected.contains(&error), "{parts}: {error}");
        }
    }

    /// Half of the picture's pixels show nothing by one of two drawings.
    #[test]
    fn a_surface_that_is_missing_counts() {
        let model = crossing(2);
        let right = probes(&model, DepthFormat::F32, Subpixel::Sub8);
        let nothing = Model { parts: vec![Part::default(); 2], ..model.clone() };
        let found = probes(&nothing, DepthFormat::F32, Subpixel::Sub8);
        for (a, b) in [(&right, &found), (&found, &right)] {
            assert!(error(&model, a, b).is_infinite());
        }
        assert!(error(&nothing, &found, &found) == 0.0);
    }

    /// A grid of 1/16 pixel moves the diagonal between two triangles of a square by about 1/32 pixel, and places with
    /// it. A pixel is a fifth of a texel.
    #[test]
    fn an_edge_within_a_surface_is_none() {
        let mut model = crossing(1);
        model.parts[0].triangles.truncate(2);
        // Beyond the picture on all sides, and with a diagonal that is that of no pixels.
        for vertex in &mut model.vertices {
            let [x, y, z] = vertex.position;
            vertex.position = [6.1 * x + 0.3, 5.3 * y - 0.2, z];
        }
        let right = probes(&model, DepthFormat::F32, Subpixel::Sub8);
        let found = probes(&model, DepthFormat::F32, Subpixel::Sub4);
        let moved = (0..right.pixels())
            .filter_map(|k| Some((right.seen(k)?.triangle, found.seen(k)?.triangle)))
            .filter(|(a, b)| a != b)
            .count();
        assert!(moved > 0, "no pixel is on the other side of the diagonal");
        let error = error(&model, &right, &found);
        assert!(error > 0.0 && error < 0.05, "{error}");
    }
}
