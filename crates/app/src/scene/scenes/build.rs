//! Building models from formulas: f64 vectors, and a builder that rounds to f32 once, at the end.
//!
//! Everything is in object space, right-handed, y up; faces are counter-clockwise seen from the front.

use crate::scene::{Image, Model, Part, Vertex};

/// A point or a direction.
pub(super) type Vec3 = [f64; 3];

/// One full turn.
pub(super) const TURN: f64 = core::f64::consts::TAU;

pub(super) fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn scale(a: Vec3, k: f64) -> Vec3 {
    [a[0] * k, a[1] * k, a[2] * k]
}

pub(super) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn unit(a: Vec3) -> Vec3 {
    scale(a, 1.0 / dot(a, a).sqrt())
}

/// The only way from the formulas' f64 to the model's f32.
#[allow(clippy::cast_possible_truncation, reason = "rounding to nearest is what is wanted")]
pub(super) fn round(a: f64) -> f32 {
    a as f32
}

/// The normal of the surface `at(u, v)`, on the side from which du to dv turns counter-clockwise.
pub(super) fn surface_normal(at: impl Fn(f64, f64) -> Vec3, u: f64, v: f64) -> Vec3 {
    // A central difference of an f64 formula: far below an f32's rounding.
    const H: f64 = 1e-5;
    let du = sub(at(u + H, v), at(u - H, v));
    let dv = sub(at(u, v + H), at(u, v - H));
    unit(cross(du, dv))
}

/// A vertex before rounding.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub(super) position: Vec3,
    pub(super) normal: Vec3,
    pub(super) uv: [f64; 2],
    pub(super) color: Vec3,
}

impl Corner {
    /// White, for surfaces whose colour comes from elsewhere.
    pub(super) fn new(position: Vec3, normal: Vec3, uv: [f64; 2]) -> Self {
        Self { position, normal, uv, color: [1.0; 3] }
    }
}

/// A model in the making.
#[derive(Default)]
pub(super) struct Builder {
    model: Model,
    /// Added to the normals of [`Builder::face`]: stands in for the light that comes back from everywhere,
    /// where a single lamp would leave large surfaces dull.
    pub(super) lean: Vec3,
}

impl Builder {
    /// Adds a texture and returns its index.
    pub(super) fn texture(&mut self, image: Image) -> usize {
        self.model.textures.push(image.into());
        self.model.textures.len() - 1
    }

    /// Starts a part; all triangles up to the next call belong to it.
    pub(super) fn part(&mut self, name: &str, texture: Option<usize>) {
        self.model.parts.push(Part { name: name.into(), diffuse: [1.0; 3], texture, ..Part::default() });
    }

    /// Adds a vertex and returns its index.
    pub(super) fn vertex(&mut self, c: Corner) -> u32 {
        let index = u32::try_from(self.model.vertices.len()).expect("a built-in scene is small");
        self.model.vertices.push(Vertex {
            position: c.position.map(round),
            normal: c.normal.map(round),
            uv: c.uv.map(round),
            color: c.color.map(round),
            ..Vertex::default()
        });
        index
    }

    /// Adds a triangle to the current part.
    pub(super) fn triangle(&mut self, indices: [u32; 3]) {
        self.model.parts.last_mut().expect("part() comes first").triangles.push(indices);
    }

    /// A convex flat polygon as a fan, its normal from its first three corners.
    pub(super) fn face(&mut self, corners: &[(Vec3, [f64; 2])]) {
        let [a, b, c] = [corners[0].0, corners[1].0, corners[2].0];
        let normal = unit(add(unit(cross(sub(b, a), sub(c, a))), self.lean));
        let indices: Vec<u32> =
            corners.iter().map(|&(position, uv)| self.vertex(Corner::new(position, normal, uv))).collect();
        for pair in indices[1..].windows(2) {
            self.triangle([indices[0], pair[0], pair[1]]);
        }
    }

    /// A grid of `nu` by `nv` cells, two triangles a cell, with `(nu + 1) * (nv + 1)` vertices of its own.
    ///
    /// ```text
    ///   (i, j+1) +----+ (i+1, j+1)
    ///            |  / |              i to the right, j upwards, seen from the front
    ///     (i, j) +----+ (i+1, j)
    /// ```
    pub(super) fn sheet(&mut self, nu: u32, nv: u32, corner: impl Fn(u32, u32) -> Corner) {
        let mut first = None;
        for j in 0..=nv {
            for i in 0..=nu {
                let index = self.vertex(corner(i, j));
                first.get_or_insert(index);
            }
        }
        let at = |i: u32, j: u32| first.unwrap_or(0) + j * (nu + 1) + i;
        for j in 0..nv {
            for i in 0..nu {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                self.triangle([a, b, c]);
                self.triangle([a, c, d]);
            }
        }
    }

    /// A profile turned around the vertical axis through `foot`: a column, a goblet, with few sides a prism.
    ///
    /// `profile` is (radius, height above the foot) from the bottom up. Edges between its segments are sharp;
    /// the sides are `flat`, or rounded by their normals. The texture spans `around` repeats in one turn and
    /// one repeat in a height of `tall`.
    pub(super) fn lathe(&mut self, foot: Vec3, sides: Sides, profile: &[[f64; 2]], around: f64, tall: f64) {
        let at = |k: u32, [r, y]: [f64; 2]| {
            let angle = TURN * (f64::from(k % sides.count) + sides.phase) / f64::from(sides.count);
            add(foot, [r * angle.sin(), y, r * angle.cos()])
        };
        for segment in profile.windows(2) {
            let [low, high] = [segment[0], segment[1]];
            let (dr, dy) = (high[0] - low[0], high[1] - low[1]);
            // Texture distance along the profile, so that flat rings are not smeared.
            let v = |p: [f64; 2]| (p[1] + (low[0] - p[0]).abs()) / tall;
            let normal = |turn: f64| {
                let angle = TURN * (turn + sides.phase) / f64::from(sides.count);
                unit([dy * angle.sin(), -dr, dy * angle.cos()])
            };
            let u = |k: u32| around * f64::from(k) / f64::from(sides.count);
            for k in 0..sides.count {
                let normals = if sides.flat {
                    [normal(f64::from(k) + 0.5); 2]
                } else {
                    [normal(f64::from(k)), normal(f64::from(k + 1))]
                };
                let [a, b, c, d] = [(k, 0, low), (k + 1, 1, low), (k + 1, 1, high), (k, 0, high)]
                    .map(|(k, side, p)| self.vertex(Corner::new(at(k, p), normals[side], [u(k), v(p)])));
                // A point at the axis leaves one triangle of the two.
                if low[0] > 0.0 {
                    self.triangle([a, b, c]);
                }
                if high[0] > 0.0 {
                    self.triangle([a, c, d]);
                }
            }
        }
    }

    /// The finished model.
    pub(super) fn finish(self) -> Model {
        self.model
    }
}

/// The sides of a turned body.
#[derive(Clone, Copy)]
pub(super) struct Sides {
    pub(super) count: u32,
    /// Turned by this part of a side.
    pub(super) phase: f64,
    pub(super) flat: bool,
}

impl Sides {
    /// So many that they pass for round.
    pub(super) fn round(count: u32) -> Self {
        Self { count, phase: 0.0, flat: false }
    }

    /// A prism with one side facing +z.
    pub(super) fn prism(count: u32) -> Self {
        Self { count, phase: -0.5, flat: true }
    }
}
