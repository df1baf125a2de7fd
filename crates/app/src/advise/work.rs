//! The work that a scene is for a renderer, in counts that do not depend on the machine.

use crate::draw::{Counted, Drawing, Studio};
use crate::error::Error;
use crate::options::{Arithmetic, DepthFormat, Interpolation, RenderOptions};
use crate::render::{any_depth, buffer, render};
use crate::scene::{Camera, Model};
use alberti::{AnyDepth, Rgba8, Rgba8888, Stats, Target};
use std::collections::HashSet;
use std::num::NonZero;

/// Counts of one frame. They are whole numbers, as `f64` for the products that they are made for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// Vertices that are transformed: those of each part's triangles, once each.
    pub vertices: f64,
    /// Triangles of the model.
    pub submitted: f64,
    /// Those that cross a clipping plane.
    pub clipped: f64,
    /// Small triangles on the screen, and those without a sample: in fixed point, by planes of their own.
    pub small: OfKind,
    /// Others whose edge functions fit 32 bits.
    pub narrow: OfKind,
    /// Those whose edge functions take 64 bits: in fixed point all that are not small.
    pub wide: OfKind,
    /// Pieces of rows that straight lines interpolate between two divisions, and samples that a budget leaves to exact
    /// ones. So there are none under `exact`, `plane` and `affine`, nor in a triangle that is one run in all.
    pub runs: f64,
    /// Fragments that pass the depth test, and are written.
    pub written: f64,
}

/// The triangles that are rasterized in one way. Clipping makes several triangles on the screen from one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OfKind {
    /// How many.
    pub triangles: f64,
    /// Pairs of a triangle and a row of which it covers a sample.
    pub rows: f64,
    /// Fragments, whose depths are tested.
    pub samples: f64,
}

impl Work {
    /// The names of the counts, as the table of a chip's costs has them.
    pub const NAMES: [&str; 15] = [
        "frame",
        "vertex",
        "submitted",
        "clipped",
        "small",
        "small_row",
        "small_sample",
        "narrow",
        "narrow_row",
        "narrow_sample",
        "wide",
        "wide_row",
        "wide_sample",
        "run",
        "written",
    ];

    /// Those of a drawing by one thread with these counts.
    pub(super) fn new(vertices: u64, stats: Stats, Counted { kinds, runs, .. }: Counted) -> Self {
        let Stats { submitted, clipped, drawn, written, .. } = stats;
        let number = |count: u64| {
            #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
            let number = count as f64;
            number
        };
        let seen: u64 = kinds.iter().map(|kind| kind.triangles).sum();
        let [mut small, narrow, wide] = kinds.map(|kind| OfKind {
            triangles: number(kind.triangles),
            rows: number(kind.rows),
            samples: number(kind.samples),
        });
        small.triangles += number(drawn.saturating_sub(seen));
        Self {
            vertices: number(vertices),
            submitted: number(submitted),
            clipped: number(clipped),
            small,
            narrow,
            wide,
            runs: number(runs),
            written: number(written),
        }
    }

    /// The counts in their order. There is one frame.
    #[must_use]
    pub fn counts(&self) -> [f64; Self::NAMES.len()] {
        let &Self { vertices, submitted, clipped, small, narrow, wide, runs, written } = self;
        let [[a, b, c], [d, e, f], [g, h, i]] =
            [small, narrow, wide].map(|kind| [kind.triangles, kind.rows, kind.samples]);
        [1.0, vertices, submitted, clipped, a, b, c, d, e, f, g, h, i, runs, written]
    }
}

/// Counts the work of a frame.
///
/// # Errors
/// Those of [`render`](crate::render::render).
pub fn work(model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Work, Error> {
    options.policies.check()?;
    let options = RenderOptions { threads: NonZero::<usize>::MIN, ..*options };
    let stats = render(model, camera, &options, &mut |_, _| ())?.stats;
    Ok(Work::new(vertices(model), stats, counted(model, camera, &options)?))
}

/// The vertices of all parts.
pub(super) fn vertices(model: &Model) -> u64 {
    let vertices = model.parts.iter().map(|part| {
        let indices: HashSet<u32> = part.triangles.iter().flatten().copied().collect();
        indices.len() as u64
    });
    vertices.sum()
}

/// Whether a depth format has so few bits that all triangles near enough to a point are small in fixed point.
pub(super) fn is_shallow(depth: DepthFormat) -> bool {
    matches!(depth, DepthFormat::U16 | DepthFormat::None)
}

/// Triangles and rows by kinds, and the runs between divisions.
pub(super) fn counted(model: &Model, camera: &Camera, options: &RenderOptions) -> Result<Counted, Error> {
    let RenderOptions { width, height, policies, .. } = *options;
    let studio = Studio::new(model, camera, options)?;
    let (mut pixels, mut depth) = (buffer(options, 0)?, buffer(options, 0)?);
    let mut count = |format: AnyDepth| {
        let target = Target::new(Rgba8888, format, width, height, &mut pixels, &mut depth);
        let mut target = target.map_err(|found| Error::new(found.to_string(), "a size that can be drawn"))?;
        target.clear(Rgba8::BLACK);
        Ok(Drawing::new(model, camera, options, &studio)?.count_runs(&mut target))
    };
    // With more bits of depth fewer triangles are small. What is hidden then counts as the kind of what was seen last.
    let format = any_depth(options.depth);
    let all = if is_shallow(options.depth) || policies.arithmetic == Arithmetic::Float {
        AnyDepth::NoDepth
    } else {
        format
    };
    let counted = count(all)?;
    let runs = match (policies.interpolation, policies.arithmetic) {
        (Interpolation::Affine, _) => 0,
        // Exact samples are divided after the depth test, runs begin before it.
        (Interpolation::Bounded(_), Arithmetic::Float) => {
            counted.runs - counted.single + count(format)?.single
        }
        _ => counted.runs,
    };
    Ok(Counted { runs, ..counted })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::{Cull, Filter, Policies, Projection, Shading, Wrap};
    use crate::scene::{Part, Vertex};

    /// Rows and columns.
    const SIDE: u32 = 64;

    /// A pixel is 1/8 at a distance of 4.
    const CAMERA: Camera = Camera {
        eye: [0.0; 3],
        target: [0.0, 0.0, -1.0],
        up: [0.0, 1.0, 0.0],
        roll: 0.0,
        fov: 90.0,
        near: 1.0,
        far: 10.0,
    };

    fn model(corners: &[[f32; 3]], triangles: &[[u32; 3]]) -> Model {
        let vertex = |&position: &[f32; 3]| {
            // Texture coordinates that span the shape.
            Vertex { position, uv: [position[0], position[1] - position[2]], ..Vertex::default() }
        };
        let part = Part { triangles: triangles.to_vec(), ..Part::default() };
        Model { vertices: corners.iter().map(vertex).collect(), parts: vec![part], ..Model::default() }
    }

    fn counted(model: &Model, interpolation: &str, arithmetic: Arithmetic) -> Work {
        counted_with((DepthFormat::U16, Shading::Unlit), model, interpolation, arithmetic)
    }

    fn counted_with(
        (depth, shading): (DepthFormat, Shading),
        model: &Model,
        interpolation: &str,
        arithmetic: Arithmetic,
    ) -> Work {
        let interpolation = interpolation.parse().expect("a name");
        let options = RenderOptions {
            width: SIDE,
            height: SIDE,
            background: [0; 3],
            shading,
            filter: Filter::Nearest,
            wrap: Wrap::Repeat,
            cull: Cull::None,
            depth,
            projection: Projection::Perspective,
            haze: None,
            light: crate::options::LightOptions::default(),
            threads: NonZero::new(2).expect("two"),
            policies: Policies { interpolation, arithmetic, ..Policies::default() },
        };
        work(model, &CAMERA, &options).expect("a picture")
    }

    /// A rectangle across the columns 16 to 48 and the rows 24 to 40, and one behind it, with the same pixels.
    fn rectangles() -> Model {
        let corners = [4.0, 8.0].map(|distance: f32| {
            let [x, y] = [distance / 2.0, distance / 4.0];
            [[-x, -y, -distance], [x, -y, -distance], [x, y, -distance], [-x, y, -distance]]
        });
        model(corners.as_flattened(), &[[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    }

    #[test]
    fn a_rectangle_before_another_is_drawn_once_and_tested_twice() {
        let expected = Work {
            vertices: 8.0,
            submitted: 4.0,
            clipped: 0.0,
            // The diagonal passes between two samples of each of 16 rows, and never at an end.
            narrow: OfKind { triangles: 4.0, rows: 64.0, samples: 1024.0 },
            runs: 0.0,
            written: 512.0,
            ..Work::default()
        };
        for interpolation in ["exact", "plane", "affine"] {
            assert_eq!(counted(&rectangles(), interpolation, Arithmetic::Float), expected);
        }
        // Fixed point has edges of 64 bits alone.
        let in_fixed_point = Work { narrow: OfKind::default(), wide: expected.narrow, ..expected };
        // A row has 32 columns, and the diagonal, at an odd column, cuts a run of more than one in two.
        for arithmetic in [Arithmetic::Float, Arithmetic::Fixed] {
            // Runs of 32 columns end in the middle of a row.
            for (length, pieces) in [(4, 9.0), (8, 5.0), (16, 3.0), (32, 3.0)] {
                let work = counted(&rectangles(), &format!("spans:{length}"), arithmetic);
                let expected = if arithmetic == Arithmetic::Fixed { in_fixed_point } else { expected };
                assert_eq!(work, Work { runs: 2.0 * 16.0 * pieces, ..expected }, "{length} {arithmetic:?}");
            }
        }
        // In boxes of no more than 32 columns floats are exact: each visible sample is divided.
        let work = counted(&rectangles(), "bounded:0.25", Arithmetic::Float);
        assert_eq!(work, Work { runs: 512.0, ..expected });
        // In fixed point a budget with room for the steps along 64 columns leaves a run a row.
        let work = counted(&rectangles(), "bounded:1", Arithmetic::Fixed);
        assert_eq!(work, Work { runs: 64.0, ..in_fixed_point });
    }

    /// Colours have no say in which triangles are small: prices are those of textures.
    #[test]
    fn other_attributes_do_not_make_triangles_large() {
        // Eight pixels wide and high, all at one place of the texture, and q changes by a quarter.
        let mut shape = model(&[[0.0, 0.0, -4.0], [1.25, 0.0, -5.0], [0.0, 1.125, -4.5]], &[[0, 1, 2]]);
        for (vertex, color) in shape.vertices.iter_mut().zip([[0.0; 3], [1.0; 3], [1.0, 0.0, 1.0]]) {
            (vertex.uv, vertex.color) = ([0.0; 2], color);
        }
        let kind = (DepthFormat::U16, Shading::VertexColor);
        let work = counted_with(kind, &shape, "bounded:0.01", Arithmetic::Fixed);
        let none = OfKind::default();
        assert_eq!((work.small.triangles, work.narrow, work.wide), (1.0, none, none));
    }

    #[test]
    fn triangles_are_small_where_depths_have_few_bits() {
        // Six pixels wide and high, from z = 4 to 4.1: zs changes by 10/9 (1/4 - 1/4.1) = 0.0068, more than 2^-10.
        let speck = model(&[[0.0, 0.0, -4.0], [0.75, 0.0, -4.0], [0.0, 0.77, -4.1]], &[[0, 1, 2]]);
        let small = |depth| {
            counted_with((depth, Shading::Unlit), &speck, "affine", Arithmetic::Fixed).small.triangles
        };
        assert_eq!([DepthFormat::U16, DepthFormat::None].map(small), [1.0; 2]);
        assert_eq!([DepthFormat::U24, DepthFormat::F32Reversed].map(small), [0.0; 2]);
    }

    #[test]
    fn a_triangle_from_behind_the_camera_is_clipped() {
        // Two corners are behind; what is left at the near plane is the screen's lower edge.
        let floor = model(&[[-0.5, -1.0, 1.0], [0.5, -1.0, 1.0], [0.5, -1.0, -4.0]], &[[0, 1, 2]]);
        let found = counted(&floor, "spans:32", Arithmetic::Float);
        // On the screen its corners are (36, 40), (28.8, 64) and (48, 64).
        let (mut rows, mut samples, mut runs) = (0.0, 0.0, 0.0);
        for row in 40..64 {
            let down = f64::from(row) + 0.5 - 40.0;
            let [left, right] = [-7.2, 12.0].map(|across| 36.0 + across * down / 24.0);
            let columns: Vec<u32> =
                (0..SIDE).filter(|&column| (left..right).contains(&(f64::from(column) + 0.5))).collect();
            rows += f64::from(u8::from(!columns.is_empty()));
            samples += f64::from(u32::try_from(columns.len()).expect("few"));
            let cells: HashSet<u32> = columns.iter().map(|column| column / 32).collect();
            runs += f64::from(u32::try_from(cells.len()).expect("two"));
        }
        let expected = Work {
            vertices: 3.0,
            submitted: 1.0,
            clipped: 1.0,
            narrow: OfKind { triangles: 1.0, rows, samples },
            runs,
            written: samples,
            ..Work::default()
        };
        assert_eq!(found, expected);
        assert!(rows < 24.0 && runs > rows, "the point is between samples, and runs of 32 columns end at 32");
    }
}
